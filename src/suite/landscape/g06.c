/* g06 of CEC 2006 [Liang et al. 2006]: two cubics over a thin sickle between two circles. */
#include "suite/landscape.h"

static const double bounds[][2] = {{13, 100}, {0, 100}};

static double optimum(int n, double *x)
{
    (void)n;
    x[0] = 14.095;
    x[1] = 0.842960789215455; /* 5 - sqrt(100 - 9.095^2) */
    return -6961.81387558015;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    double a = x[0] - 10, b = x[1] - 20, p = x[0] - 5, q = x[0] - 6, r = x[1] - 5;
    out->value = a * a * a + b * b * b;
    out->constraint[0] = 1 - (p * p + r * r) / 100;
    out->constraint[1] = (q * q + r * r) / 82.81 - 1;
    if (!slopes) return VES_OK;
    out->gradient[0] = 3 * a * a;
    out->gradient[1] = 3 * b * b;
    out->jacobian[0] = -2 * p / 100;
    out->jacobian[1] = -2 * r / 100;
    out->jacobian[n] = 2 * q / 82.81;
    out->jacobian[n + 1] = 2 * r / 82.81;
    return VES_OK;
}

const ves_landscape ves_landscape_g06 = {
    .name = "g06",
    .about = "CEC 2006 g06: two cubics over a thin sickle",
    .least = 2,
    .most = 2,
    .bounds = bounds,
    .inequalities = 2,
    .optimum = optimum,
    .eval = eval,
};

/* g11 of CEC 2006 [Liang et al. 2006]; the tabled 0.7499 uses a tolerance up. */
#include <math.h>

#include "suite/landscape.h"

static double optimum(int n, double *x)
{
    (void)n;
    x[0] = sqrt(0.5);
    x[1] = 0.5;
    return 0.75;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    (void)n;
    out->value = x[0] * x[0] + (x[1] - 1) * (x[1] - 1);
    out->constraint[0] = x[1] - x[0] * x[0];
    if (!slopes) return VES_OK;
    out->gradient[0] = 2 * x[0];
    out->gradient[1] = 2 * (x[1] - 1);
    out->jacobian[0] = -2 * x[0];
    out->jacobian[1] = 1;
    return VES_OK;
}

const ves_landscape ves_landscape_g11 = {
    .name = "g11",
    .about = "CEC 2006 g11: a circle's distance on a parabola",
    .least = 2,
    .most = 2,
    .lower = -1,
    .upper = 1,
    .equalities = 1,
    .optimum = optimum,
    .eval = eval,
};

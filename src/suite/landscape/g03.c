/* g03 of CEC 2006 [Liang et al. 2006]: -sqrt(n)^n prod x_i on the unit sphere; its tabled -1.0005 uses a
 * tolerance of 1e-4 on the sphere up, exactly it is -1. */
#include <math.h>

#include "suite/landscape.h"

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = 1 / sqrt(n);
    return -1;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    double head[VES_LANDSCAPE_MOST], root = sqrt(n), product = -1, tail = 1, square = 0;
    for (int i = 0; i < n; i++) {
        head[i] = product; /* of those before i */
        product *= root * x[i];
        square += x[i] * x[i];
    }
    out->value = product;
    out->constraint[0] = square - 1;
    for (int i = n - 1; slopes && i >= 0; i--) {
        out->gradient[i] = head[i] * root * tail;
        out->jacobian[i] = 2 * x[i];
        tail *= root * x[i];
    }
    return VES_OK;
}

const ves_landscape ves_landscape_g03 = {
    .name = "g03",
    .about = "CEC 2006 g03: a product on the unit sphere; 10 variables there",
    .least = 2,
    .most = 40,
    .lower = 0,
    .upper = 1,
    .equalities = 1,
    .optimum = optimum,
    .eval = eval,
};

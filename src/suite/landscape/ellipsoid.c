/* f = sum 10^(6 i/(n-1)) x_i^2, i = 0 ... n-1: condition number 1e6, f2 of BBOB without its oscillations
 * [Hansen et al. 2009, RR-6829]. */
#include <math.h>

#include "suite/landscape.h"

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = 0;
    return 0;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    out->value = 0;
    double factor = n > 1 ? pow(1e6, 1.0 / (n - 1)) : 1, weight = 1;
    for (int i = 0; i < n; i++, weight *= factor) {
        out->value += weight * x[i] * x[i];
        if (slopes) out->gradient[i] = 2 * weight * x[i];
    }
    return VES_OK;
}

const ves_landscape ves_landscape_ellipsoid = {
    .name = "ellipsoid",
    .about = "a quadratic of condition number 1e6",
    .least = 1,
    .lower = -5,
    .upper = 5,
    .free = true,
    .optimum = optimum,
    .eval = eval,
};

/* f = sum x_i^2. */
#include "suite/landscape.h"

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = 0;
    return 0;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    out->value = 0;
    for (int i = 0; i < n; i++) out->value += x[i] * x[i];
    for (int i = 0; slopes && i < n; i++) out->gradient[i] = 2 * x[i];
    return VES_OK;
}

const ves_landscape ves_landscape_sphere = {
    .name = "sphere",
    .about = "sum of squares: the easiest of all",
    .least = 1,
    .lower = -5,
    .upper = 5,
    .free = true,
    .optimum = optimum,
    .eval = eval,
};

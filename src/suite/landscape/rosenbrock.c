/* f = sum 100 (x_{i+1} - x_i^2)^2 + (1 - x_i)^2 [Rosenbrock 1960]: a curved valley; from n = 4 on with a
 * second minimum near (-1, 1, ..., 1). */
#include "suite/landscape.h"

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = 1;
    return 0;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    out->value = 0;
    for (int i = 0; slopes && i < n; i++) out->gradient[i] = 0;
    for (int i = 0; i + 1 < n; i++) {
        double off = x[i + 1] - x[i] * x[i], rest = 1 - x[i];
        out->value += 100 * off * off + rest * rest;
        if (!slopes) continue;
        out->gradient[i] += -400 * off * x[i] - 2 * rest;
        out->gradient[i + 1] += 200 * off;
    }
    return VES_OK;
}

const ves_landscape ves_landscape_rosenbrock = {
    .name = "rosenbrock",
    .about = "a curved valley, flat along its floor",
    .least = 2,
    .lower = -5,
    .upper = 10,
    .free = true,
    .optimum = optimum,
    .eval = eval,
};

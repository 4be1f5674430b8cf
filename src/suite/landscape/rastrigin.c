/* f = sum x_i^2 + 10 (1 - cos 2 pi x_i) [Rastrigin 1974]: 11^n minima in the box, on a bowl. */
#include <math.h>

#include "base/vector.h"
#include "suite/landscape.h"

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = 0;
    return 0;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    out->value = 0;
    for (int i = 0; i < n; i++) {
        double half = sin(VES_PI * x[i]); /* 1 - cos 2t = 2 sin^2 t keeps its digits near 0 */
        out->value += x[i] * x[i] + 20 * half * half;
        if (slopes) out->gradient[i] = 2 * x[i] + 10 * VES_TWO_PI * sin(VES_TWO_PI * x[i]);
    }
    return VES_OK;
}

const ves_landscape ves_landscape_rastrigin = {
    .name = "rastrigin",
    .about = "a bowl covered with equal dimples, 11^n minima",
    .least = 1,
    .lower = -5.12,
    .upper = 5.12,
    .free = true,
    .optimum = optimum,
    .eval = eval,
};

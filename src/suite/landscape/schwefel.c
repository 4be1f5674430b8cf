/* f = sum c - x_i sin sqrt|x_i| [Schwefel 1981]: the optimum lies in a corner, far from the second best.
 * Beyond the box it falls without end, so it is neither moved nor turned. c makes the least value 0. */
#include <math.h>

#include "suite/landscape.h"

/* Where sin s + s/2 cos s = 0, s = sqrt(x); by Newton's method in 40 digits. */
static const double where = 420.968746359982027312, level = 418.982887272433706275;

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = where;
    return 0;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    out->value = 0;
    for (int i = 0; i < n; i++) {
        double root = sqrt(fabs(x[i]));
        out->value += level - x[i] * sin(root);
        if (slopes) out->gradient[i] = -sin(root) - root / 2 * cos(root);
    }
    return VES_OK;
}

const ves_landscape ves_landscape_schwefel = {
    .name = "schwefel",
    .about = "wide waves, the best near a corner and far from the second best",
    .least = 1,
    .lower = -500,
    .upper = 500,
    .optimum = optimum,
    .eval = eval,
};

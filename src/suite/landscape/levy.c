/* w = 1 + (x - 1)/4; f = sin^2(pi w_1) + sum (w_i - 1)^2 (1 + 10 sin^2(pi w_i + 1)) + (w_n - 1)^2 (1 +
 * sin^2(2 pi w_n)), the sum without the last [Levy and Montalvo 1985, problem 8, in the form of Laguna and
 * Marti 2005]. */
#include <math.h>

#include "base/vector.h"
#include "suite/landscape.h"

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = 1;
    return 0;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    double first = sin(VES_PI * x[0] / 4 + VES_PI * 0.75);
    out->value = first * first;
    for (int i = 0; i < n; i++) {
        bool last = i == n - 1;
        double d = (x[i] - 1) / 4, w = 1 + d, factor = last ? 1 : 10;
        double s = last ? sin(VES_TWO_PI * d) : sin(VES_PI * w + 1);
        double bump = last ? VES_TWO_PI * sin(2 * VES_TWO_PI * d) : VES_PI * sin(2 * (VES_PI * w + 1));
        out->value += d * d * (1 + factor * s * s);
        if (slopes) out->gradient[i] = (2 * d * (1 + factor * s * s) + d * d * factor * bump) / 4;
    }
    if (slopes) out->gradient[0] += VES_PI / 4 * sin(2 * (VES_PI * x[0] / 4 + VES_PI * 0.75));
    return VES_OK;
}

const ves_landscape ves_landscape_levy = {
    .name = "levy",
    .about = "ripples that grow with the distance from the optimum",
    .least = 1,
    .lower = -10,
    .upper = 10,
    .free = true,
    .optimum = optimum,
    .eval = eval,
};

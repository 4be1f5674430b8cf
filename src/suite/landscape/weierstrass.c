/* f = sum_i sum_k 0.5^k (1 + cos(2 pi 3^k (x_i + 1/2))) for odd 3^k = sum 0.5^k 2 sin^2(pi 3^k x_i), k = 0
 * ... 11: the function of Weierstrass cut off, as in CEC 2005 (there k to 20, with the same optimum). */
#include <math.h>

#include "base/vector.h"
#include "suite/landscape.h"

enum { OCTAVES = 12 };

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = 0;
    return 0;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    out->value = 0;
    for (int i = 0; i < n; i++) {
        double slope = 0, height = 1, wave = VES_PI;
        for (int k = 0; k < OCTAVES; k++, height /= 2, wave *= 3) {
            double s = sin(wave * x[i]);
            out->value += height * 2 * s * s;
            slope += height * 2 * wave * sin(2 * wave * x[i]);
        }
        if (slopes) out->gradient[i] = slope;
    }
    return VES_OK;
}

const ves_landscape ves_landscape_weierstrass = {
    .name = "weierstrass",
    .about = "rough on every scale: twelve octaves of waves",
    .least = 1,
    .lower = -0.5,
    .upper = 0.5,
    .free = true,
    .optimum = optimum,
    .eval = eval,
};

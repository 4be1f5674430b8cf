/* f = 20 (1 - e^(-0.2 sqrt(sum x^2/n))) + e - e^(sum cos(2 pi x)/n) [Ackley 1987]: a funnel with a kink at
 * its bottom, rough outside. */
#include <math.h>

#include "base/vector.h"
#include "suite/landscape.h"

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = 0;
    return 0;
}

/* e - e^c = -e expm1(c - 1), and c - 1 = -2 mean sin^2(pi x): no digits are lost near the optimum. At the
 * optimum itself, where the funnel has its kink, the slope is that of the second part, 0. */
static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    double square = 0, below = 0;
    for (int i = 0; i < n; i++) {
        double s = sin(VES_PI * x[i]);
        square += x[i] * x[i] / n;
        below -= 2 * s * s / n;
    }
    double root = sqrt(square), wave = exp(1 + below);
    out->value = -20 * expm1(-0.2 * root) - exp(1) * expm1(below);
    double pull = root > 0 ? 4 * exp(-0.2 * root) / (root * n) : 0;
    for (int i = 0; slopes && i < n; i++)
        out->gradient[i] = pull * x[i] + wave * VES_TWO_PI * sin(VES_TWO_PI * x[i]) / n;
    return VES_OK;
}

const ves_landscape ves_landscape_ackley = {
    .name = "ackley",
    .about = "a funnel in a rough plain, with a kink at its bottom",
    .least = 1,
    .lower = -32.768,
    .upper = 32.768,
    .free = true,
    .optimum = optimum,
    .eval = eval,
};

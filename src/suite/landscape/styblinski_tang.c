/* f = 1/2 sum x^4 - 16 x^2 + 5 x [Styblinski and Tang 1990]: 2^n minima. */
#include "suite/landscape.h"

/* The least root of 4 x^3 - 32 x + 5, and half of x^4 - 16 x^2 + 5 x there. */
static const double where = -2.903534027771177095, level = -39.166165703771415464;

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = where;
    return n * level;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    out->value = 0;
    for (int i = 0; i < n; i++) {
        double square = x[i] * x[i];
        out->value += (square * square - 16 * square + 5 * x[i]) / 2;
        if (slopes) out->gradient[i] = (4 * square * x[i] - 32 * x[i] + 5) / 2;
    }
    return VES_OK;
}

const ves_landscape ves_landscape_styblinski_tang = {
    .name = "styblinski_tang",
    .about = "a quartic with 2^n minima, in each coordinate one of two",
    .least = 1,
    .lower = -5,
    .upper = 5,
    .free = true,
    .optimum = optimum,
    .eval = eval,
};

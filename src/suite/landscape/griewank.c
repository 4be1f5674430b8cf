/* f = sum x_i^2/4000 + 1 - prod cos(x_i/sqrt(i)), i = 1 ... n [Griewank 1981]. */
#include <math.h>

#include "suite/landscape.h"

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = 0;
    return 0;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    double square = 0, product = 1, head[VES_LANDSCAPE_MOST];
    for (int i = 0; i < n; i++) {
        square += x[i] * x[i] / 4000;
        head[i] = product; /* of those before i */
        product *= cos(x[i] / sqrt(i + 1));
    }
    out->value = square + (1 - product);
    double tail = 1; /* of those behind i */
    for (int i = n - 1; slopes && i >= 0; i--) {
        double root = sqrt(i + 1);
        out->gradient[i] = x[i] / 2000 + head[i] * tail * sin(x[i] / root) / root;
        tail *= cos(x[i] / root);
    }
    return VES_OK;
}

const ves_landscape ves_landscape_griewank = {
    .name = "griewank",
    .about = "a wide bowl with ripples that grow finer and fainter with n",
    .least = 1,
    .lower = -600,
    .upper = 600,
    .free = true,
    .optimum = optimum,
    .eval = eval,
};

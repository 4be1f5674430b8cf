/* f = -sum sin(x_i) sin^20(i x_i^2/pi), i = 1 ... n [Michalewicz 1992]: flat but for narrow valleys. */
#include <math.h>

#include "base/vector.h"
#include "suite/landscape.h"

enum { SHARP = 20, GRID = 400 };

static double term(int i, double x)
{
    return -sin(x) * pow(sin(i * x * x / VES_PI), SHARP);
}

static double slope(int i, double x)
{
    double phase = i * x * x / VES_PI, s = sin(phase), power = pow(s, SHARP - 1);
    return -cos(x) * power * s - sin(x) * SHARP * power * cos(phase) * 2 * i * x / VES_PI;
}

/* The least of one term: the best node of a grid, then halving by the slope's sign. The valleys of sin^20(i
 * x^2/pi) are about pi/(2 i) apart at x = pi: the grid has 400 nodes for each i. */
static double least(int i, double *where)
{
    double best = 0, step = VES_PI / (GRID * i);
    for (int k = 1; k < GRID * i; k++)
        if (term(i, k * step) < best) best = term(i, k * step), *where = k * step;
    double a = *where - step, b = *where + step;
    for (int k = 0; k < 60; k++) {
        double c = (a + b) / 2;
        if (slope(i, c) < 0)
            a = c;
        else
            b = c;
    }
    *where = (a + b) / 2;
    return term(i, *where);
}

static double optimum(int n, double *x)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += least(i + 1, &x[i]);
    return sum;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    out->value = 0;
    for (int i = 0; i < n; i++) {
        out->value += term(i + 1, x[i]);
        if (slopes) out->gradient[i] = slope(i + 1, x[i]);
    }
    return VES_OK;
}

const ves_landscape ves_landscape_michalewicz = {
    .name = "michalewicz",
    .about = "a plain with narrow valleys that cross, n! minima",
    .least = 1,
    .most = 50,
    .lower = 0,
    .upper = VES_PI,
    .optimum = optimum,
    .eval = eval,
};

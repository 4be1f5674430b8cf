/* g01 of CEC 2006 [Liang et al. 2006]: a concave quadratic over a polytope. */
#include "suite/landscape.h"

static const double bounds[][2] = {{0, 1}, {0, 1}, {0, 1},   {0, 1},   {0, 1},   {0, 1}, {0, 1},
                                   {0, 1}, {0, 1}, {0, 100}, {0, 100}, {0, 100}, {0, 1}};

/* Rows of the polytope, each <= 0 with its constant; divided by 10, 10, 10, then 1. */
static const double row[9][13] = {
    {2, 2, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0},   {2, 0, 2, 0, 0, 0, 0, 0, 0, 1, 0, 1, 0},
    {0, 2, 2, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0},   {-8, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0},
    {0, -8, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0},  {0, 0, -8, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0},
    {0, 0, 0, -2, -1, 0, 0, 0, 0, 1, 0, 0, 0}, {0, 0, 0, 0, 0, -2, -1, 0, 0, 0, 1, 0, 0},
    {0, 0, 0, 0, 0, 0, 0, -2, -1, 0, 0, 1, 0}};

static double optimum(int n, double *x)
{
    for (int i = 0; i < n; i++) x[i] = i >= 9 && i < 12 ? 3 : 1;
    return -15;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    out->value = 0;
    for (int i = 0; i < 4; i++) out->value += 5 * x[i] - 5 * x[i] * x[i];
    for (int i = 4; i < n; i++) out->value -= x[i];
    for (int j = 0; j < 9; j++) {
        double size = j < 3 ? 10 : 1, sum = j < 3 ? -10 : 0;
        for (int i = 0; i < n; i++) sum += row[j][i] * x[i];
        out->constraint[j] = sum / size;
        for (int i = 0; slopes && i < n; i++) out->jacobian[j * n + i] = row[j][i] / size;
    }
    for (int i = 0; slopes && i < n; i++) out->gradient[i] = i < 4 ? 5 - 10 * x[i] : -1;
    return VES_OK;
}

const ves_landscape ves_landscape_g01 = {
    .name = "g01",
    .about = "CEC 2006 g01: a concave quadratic over a polytope with many corners",
    .least = 13,
    .most = 13,
    .bounds = bounds,
    .inequalities = 9,
    .optimum = optimum,
    .eval = eval,
};

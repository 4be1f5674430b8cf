/* g07 of CEC 2006 [Liang et al. 2006; Hock and Schittkowski 1981, problem 113]: a convex quadratic. */
#include "suite/landscape.h"

static double optimum(int n, double *x)
{
    static const double place[] = {2.17199637003276,  2.36368297245585, 8.7739257300086,  5.09598444621395,
                                   0.990654746981456, 1.4305739376533,  1.32164420817215, 9.82872580912291,
                                   8.28009166154751,  8.37592664619358};
    for (int i = 0; i < n; i++) x[i] = place[i];
    return 24.3062090681797;
}

static void values(const double *x, double *c)
{
    double p = x[0] - 2, q = x[1] - 3, r = x[2] - 6, s = x[1] - 2, t = x[0] - 8, u = x[1] - 4, w = x[8] - 8;
    c[0] = (4 * x[0] + 5 * x[1] - 3 * x[6] + 9 * x[7] - 105) / 100;
    c[1] = (10 * x[0] - 8 * x[1] - 17 * x[6] + 2 * x[7]) / 100;
    c[2] = (-8 * x[0] + 2 * x[1] + 5 * x[8] - 2 * x[9] - 12) / 100;
    c[3] = (3 * p * p + 4 * q * q + 2 * x[2] * x[2] - 7 * x[3] - 120) / 100;
    c[4] = (5 * x[0] * x[0] + 8 * x[1] + r * r - 2 * x[3] - 40) / 100;
    c[5] = (x[0] * x[0] + 2 * s * s - 2 * x[0] * x[1] + 14 * x[4] - 6 * x[5]) / 100;
    c[6] = (0.5 * t * t + 2 * u * u + 3 * x[4] * x[4] - x[5] - 30) / 100;
    c[7] = (-3 * x[0] + 6 * x[1] + 12 * w * w - 7 * x[9]) / 100;
}

static void rows(const double *x, double *out)
{
    double p = x[0] - 2, q = x[1] - 3, r = x[2] - 6, s = x[1] - 2, t = x[0] - 8, u = x[1] - 4, w = x[8] - 8;
    const double row[8][10] = {
        {4, 5, 0, 0, 0, 0, -3, 9, 0, 0},
        {10, -8, 0, 0, 0, 0, -17, 2, 0, 0},
        {-8, 2, 0, 0, 0, 0, 0, 0, 5, -2},
        {6 * p, 8 * q, 4 * x[2], -7, 0, 0, 0, 0, 0, 0},
        {10 * x[0], 8, 2 * r, -2, 0, 0, 0, 0, 0, 0},
        {2 * x[0] - 2 * x[1], 4 * s - 2 * x[0], 0, 0, 14, -6, 0, 0, 0, 0},
        {t, 4 * u, 0, 0, 6 * x[4], -1, 0, 0, 0, 0},
        {-3, 6, 0, 0, 0, 0, 0, 0, 24 * w, -7},
    };
    for (int j = 0; j < 8; j++)
        for (int i = 0; i < 10; i++) out[10 * j + i] = row[j][i] / 100;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    /* weight (x - centre)^2 of each variable, besides x0^2 + x0 x1 + x1^2 - 14 x0 - 16 x1 */
    static const double weight[] = {0, 0, 1, 4, 1, 2, 5, 7, 2, 1},
                        centre[] = {0, 0, 10, 5, 3, 1, 0, 11, 10, 7};
    out->value = x[0] * x[0] + x[1] * x[1] + x[0] * x[1] - 14 * x[0] - 16 * x[1] + 45;
    for (int i = 2; i < n; i++) out->value += weight[i] * (x[i] - centre[i]) * (x[i] - centre[i]);
    values(x, out->constraint);
    if (!slopes) return VES_OK;
    for (int i = 2; i < n; i++) out->gradient[i] = 2 * weight[i] * (x[i] - centre[i]);
    out->gradient[0] = 2 * x[0] + x[1] - 14;
    out->gradient[1] = 2 * x[1] + x[0] - 16;
    rows(x, out->jacobian);
    return VES_OK;
}

const ves_landscape ves_landscape_g07 = {
    .name = "g07",
    .about = "CEC 2006 g07: a convex quadratic, eight constraints",
    .least = 10,
    .most = 10,
    .lower = -10,
    .upper = 10,
    .inequalities = 8,
    .optimum = optimum,
    .eval = eval,
};

/* g09 of CEC 2006 [Liang et al. 2006; Hock and Schittkowski 1981, problem 100]. */
#include "suite/landscape.h"

static double optimum(int n, double *x)
{
    static const double place[] = {2.33049934694993,   1.95137231903337, -0.477541384782912, 4.36572636604847,
                                   -0.624486887924652, 1.03813101739459, 1.59422669471538};
    for (int i = 0; i < n; i++) x[i] = place[i];
    return 680.630057374402;
}

static double cube(double x)
{
    return x * x * x;
}

static void constraints(const double *x, double *c)
{
    c[0] = (2 * x[0] * x[0] + 3 * x[1] * cube(x[1]) + x[2] + 4 * x[3] * x[3] + 5 * x[4]) / 127 - 1;
    c[1] = (7 * x[0] + 3 * x[1] + 10 * x[2] * x[2] + x[3] - x[4]) / 282 - 1;
    c[2] = (23 * x[0] + x[1] * x[1] + 6 * x[5] * x[5] - 8 * x[6]) / 196 - 1;
    c[3] = (4 * x[0] * x[0] + x[1] * x[1] - 3 * x[0] * x[1] + 2 * x[2] * x[2] + 5 * x[5] - 11 * x[6]) / 100;
}

static void slope(const double *x, ves_verdict *out)
{
    const double g[7] = {2 * (x[0] - 10),
                         10 * (x[1] - 12),
                         4 * cube(x[2]),
                         6 * (x[3] - 11),
                         60 * x[4] * x[4] * cube(x[4]),
                         14 * x[5] - 4 * x[6] - 10,
                         4 * cube(x[6]) - 4 * x[5] - 8};
    const double row[4][7] = {{4 * x[0], 12 * cube(x[1]), 1, 8 * x[3], 5, 0, 0},
                              {7, 3, 20 * x[2], 1, -1, 0, 0},
                              {23, 2 * x[1], 0, 0, 0, 12 * x[5], -8},
                              {8 * x[0] - 3 * x[1], 2 * x[1] - 3 * x[0], 4 * x[2], 0, 0, 5, -11}};
    static const double size[] = {127, 282, 196, 100};
    for (int i = 0; i < 7; i++) out->gradient[i] = g[i];
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < 7; i++) out->jacobian[7 * j + i] = row[j][i] / size[j];
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    (void)n;
    double a = x[0] - 10, b = x[1] - 12, d = x[3] - 11;
    out->value = a * a + 5 * b * b + x[2] * cube(x[2]) + 3 * d * d + 10 * cube(x[4]) * cube(x[4]) +
                 7 * x[5] * x[5] + x[6] * cube(x[6]) - 4 * x[5] * x[6] - 10 * x[5] - 8 * x[6];
    constraints(x, out->constraint);
    if (slopes) slope(x, out);
    return VES_OK;
}

const ves_landscape ves_landscape_g09 = {
    .name = "g09",
    .about = "CEC 2006 g09: a polynomial of degree six, four constraints",
    .least = 7,
    .most = 7,
    .lower = -10,
    .upper = 10,
    .inequalities = 4,
    .optimum = optimum,
    .eval = eval,
};

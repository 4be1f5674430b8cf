/* g10 of CEC 2006 [Liang et al. 2006; Hock and Schittkowski 1981, problem 106]: a heat exchanger. Badly
 * scaled on purpose. */
#include "suite/landscape.h"

static const double bounds[][2] = {{100, 10000}, {1000, 10000}, {1000, 10000}, {10, 1000},
                                   {10, 1000},   {10, 1000},    {10, 1000},    {10, 1000}};

static double optimum(int n, double *x)
{
    static const double place[] = {579.306684954859, 1359.9706612903,  5109.97067428353, 182.017699625343,
                                   295.601173028659, 217.982300374657, 286.416526596684, 395.601173028659};
    for (int i = 0; i < n; i++) x[i] = place[i];
    return 7049.248020528685;
}

enum { SIZE = 1000000 }; /* of the three last */

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    double *c = out->constraint;
    out->value = x[0] + x[1] + x[2];
    c[0] = 0.0025 * (x[3] + x[5]) - 1;
    c[1] = 0.0025 * (x[4] + x[6] - x[3]) - 1;
    c[2] = 0.01 * (x[7] - x[4]) - 1;
    c[3] = (100 * x[0] - x[0] * x[5] + 833.33252 * x[3] - 83333.333) / SIZE;
    c[4] = (x[1] * x[3] - x[1] * x[6] - 1250 * x[3] + 1250 * x[4]) / SIZE;
    c[5] = (x[2] * x[4] - x[2] * x[7] - 2500 * x[4] + 1250000) / SIZE;
    if (!slopes) return VES_OK;
    const double row[6][8] = {{0, 0, 0, 2500, 0, 2500, 0, 0},
                              {0, 0, 0, -2500, 2500, 0, 2500, 0},
                              {0, 0, 0, 0, -10000, 0, 0, 10000},
                              {100 - x[5], 0, 0, 833.33252, 0, -x[0], 0, 0},
                              {0, x[3] - x[6], 0, x[1] - 1250, 1250, 0, -x[1], 0},
                              {0, 0, x[4] - x[7], 0, x[2] - 2500, 0, 0, -x[2]}};
    for (int i = 0; i < n; i++) out->gradient[i] = i < 3;
    for (int j = 0; j < 6; j++)
        for (int i = 0; i < n; i++) out->jacobian[j * n + i] = row[j][i] / SIZE;
    return VES_OK;
}

const ves_landscape ves_landscape_g10 = {
    .name = "g10",
    .about = "CEC 2006 g10: a heat exchanger, badly scaled",
    .least = 8,
    .most = 8,
    .bounds = bounds,
    .inequalities = 6,
    .optimum = optimum,
    .eval = eval,
};

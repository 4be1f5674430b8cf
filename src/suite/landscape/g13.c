/* g13 of CEC 2006 [Liang et al. 2006; Hock and Schittkowski 1981, problem 80]. Exactly the least value is
 * 0.05394985; the tabled 0.0539415 uses a tolerance up. */
#include <math.h>

#include "suite/landscape.h"

static const double bounds[][2] = {{-2.3, 2.3}, {-2.3, 2.3}, {-3.2, 3.2}, {-3.2, 3.2}, {-3.2, 3.2}};

static double optimum(int n, double *x)
{
    static const double place[] = {-1.71714357047629, 1.5957096902784, 1.82724575277501, -0.763643078175024,
                                   -0.763643078175024};
    for (int i = 0; i < n; i++) x[i] = place[i];
    return 0.053949847770272;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    double square = 0, product = 1;
    for (int i = 0; i < n; i++) square += x[i] * x[i], product *= x[i];
    out->value = exp(product);
    out->constraint[0] = square / 10 - 1;
    out->constraint[1] = x[1] * x[2] - 5 * x[3] * x[4];
    out->constraint[2] = x[0] * x[0] * x[0] + x[1] * x[1] * x[1] + 1;
    if (!slopes) return VES_OK;
    const double row[2][5] = {{0, x[2], x[1], -5 * x[4], -5 * x[3]},
                              {3 * x[0] * x[0], 3 * x[1] * x[1], 0, 0, 0}};
    for (int i = 0; i < n; i++) {
        double others = out->value;
        for (int k = 0; k < n; k++)
            if (k != i) others *= x[k];
        out->gradient[i] = others;
        out->jacobian[i] = x[i] / 5;
        out->jacobian[n + i] = row[0][i];
        out->jacobian[2 * n + i] = row[1][i];
    }
    return VES_OK;
}

const ves_landscape ves_landscape_g13 = {
    .name = "g13",
    .about = "CEC 2006 g13: three equations of five variables, several minima",
    .least = 5,
    .most = 5,
    .bounds = bounds,
    .equalities = 3,
    .optimum = optimum,
    .eval = eval,
};

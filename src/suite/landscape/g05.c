/* g05 of CEC 2006 [Liang et al. 2006; Hock and Schittkowski 1981, problem 74]: an economic power flow. The
 * tabled 5126.4967 uses a tolerance up. */
#include <math.h>

#include "suite/landscape.h"

static const double bounds[][2] = {{0, 1200}, {0, 1200}, {-0.55, 0.55}, {-0.55, 0.55}};

static double optimum(int n, double *x)
{
    static const double place[] = {679.945319863783, 1026.06713259703, 0.118876364484137, -0.396233553207465};
    for (int i = 0; i < n; i++) x[i] = place[i];
    return 5126.498109595272;
}

enum { SIZE = 1000 }; /* of the three equations */

static void jacobian(const double *x, double *row)
{
    double a = x[2], b = x[3];
    const double rows[5][4] = {{0, 0, 1, -1},
                               {0, 0, -1, 1},
                               {-1.0 / SIZE, 0, -cos(-a - 0.25), -cos(-b - 0.25)},
                               {0, -1.0 / SIZE, cos(a - 0.25) + cos(a - b - 0.25), -cos(a - b - 0.25)},
                               {0, 0, -cos(b - a - 0.25), cos(b - 0.25) + cos(b - a - 0.25)}};
    for (int j = 0; j < 5; j++)
        for (int i = 0; i < 4; i++) row[4 * j + i] = rows[j][i];
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    (void)n;
    double p = x[0], q = x[1], a = x[2], b = x[3], *c = out->constraint;
    out->value = 3 * p + 1e-6 * p * p * p + 2 * q + 2e-6 / 3 * q * q * q;
    c[0] = a - b - 0.55;
    c[1] = b - a - 0.55;
    c[2] = sin(-a - 0.25) + sin(-b - 0.25) + (894.8 - p) / SIZE;
    c[3] = sin(a - 0.25) + sin(a - b - 0.25) + (894.8 - q) / SIZE;
    c[4] = sin(b - 0.25) + sin(b - a - 0.25) + 1294.8 / SIZE;
    if (!slopes) return VES_OK;
    out->gradient[0] = 3 + 3e-6 * p * p;
    out->gradient[1] = 2 + 2e-6 * q * q;
    out->gradient[2] = out->gradient[3] = 0;
    jacobian(x, out->jacobian);
    return VES_OK;
}

const ves_landscape ves_landscape_g05 = {
    .name = "g05",
    .about = "CEC 2006 g05: a power flow, three equations of four variables",
    .least = 4,
    .most = 4,
    .bounds = bounds,
    .inequalities = 2,
    .equalities = 3,
    .optimum = optimum,
    .eval = eval,
};

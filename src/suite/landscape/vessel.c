/* A pressure vessel of least cost [Sandgren 1990], all four sizes continuous, in inches: thickness of shell
 * and head, radius, length; they must stand the pressure and hold 1296000 cubic inches. */
#include "base/vector.h"
#include "suite/landscape.h"

static const double bounds[][2] = {{0, 99}, {0, 99}, {10, 200}, {10, 200}};

static double optimum(int n, double *x)
{
    static const double place[] = {0.778168641375105, 0.384649162627902, 40.3196187240987, 200};
    for (int i = 0; i < n; i++) x[i] = place[i];
    return 5885.33277361645;
}

enum { VOLUME = 1296000, LENGTH = 240 };

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    double shell = x[0], head = x[1], r = x[2], l = x[3], *c = out->constraint;
    out->value = 0.6224 * shell * r * l + 1.7781 * head * r * r + 3.1661 * shell * shell * l +
                 19.84 * shell * shell * r;
    c[0] = 0.0193 * r - shell;
    c[1] = 0.00954 * r - head;
    c[2] = 1 - VES_PI * (r * r * l + 4.0 / 3 * r * r * r) / VOLUME;
    c[3] = l / LENGTH - 1;
    if (!slopes) return VES_OK;
    const double g[4] = {0.6224 * r * l + 2 * 3.1661 * shell * l + 2 * 19.84 * shell * r, 1.7781 * r * r,
                         0.6224 * shell * l + 2 * 1.7781 * head * r + 19.84 * shell * shell,
                         0.6224 * shell * r + 3.1661 * shell * shell};
    const double row[4][4] = {{-1, 0, 0.0193, 0},
                              {0, -1, 0.00954, 0},
                              {0, 0, -VES_PI * (2 * r * l + 4 * r * r) / VOLUME, -VES_PI * r * r / VOLUME},
                              {0, 0, 0, 1.0 / LENGTH}};
    for (int i = 0; i < n; i++) out->gradient[i] = g[i];
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < n; i++) out->jacobian[j * n + i] = row[j][i];
    return VES_OK;
}

const ves_landscape ves_landscape_vessel = {
    .name = "vessel",
    .about = "a pressure vessel of least cost, continuous sizes",
    .least = 4,
    .most = 4,
    .bounds = bounds,
    .inequalities = 4,
    .optimum = optimum,
    .eval = eval,
};

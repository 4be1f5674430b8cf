/* A tension spring of least mass [Arora 1989; Belegundu 1982]: diameters of wire and coil, number of
 * coils. */
#include "suite/landscape.h"

static const double bounds[][2] = {{0.05, 2}, {0.25, 1.3}, {2, 15}};

static double optimum(int n, double *x)
{
    static const double place[] = {0.0516890609532812, 0.356717736684437, 11.2889659342363};
    for (int i = 0; i < n; i++) x[i] = place[i];
    return 0.0126652327883194;
}

/* The second: a/b + 1/(5108 d^2) - 1 with a = 4 w^2 - d w, b = 12566 (w d^3 - d^4). */
static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    double d = x[0], w = x[1], k = x[2], *c = out->constraint;
    double d2 = d * d, d4 = d2 * d2, w2 = w * w, a = 4 * w2 - d * w, b = 12566 * (w * d2 * d - d4);
    out->value = (k + 2) * w * d2;
    c[0] = 1 - w2 * w * k / (71785 * d4);
    c[1] = a / b + 1 / (5108 * d2) - 1;
    c[2] = 1 - 140.45 * d / (w2 * k);
    c[3] = (d + w) / 1.5 - 1;
    if (!slopes) return VES_OK;
    double ad = -w, aw = 8 * w - d, bd = 12566 * (3 * w * d2 - 4 * d2 * d), bw = 12566 * d2 * d;
    const double g[3] = {2 * (k + 2) * w * d, (k + 2) * d2, w * d2};
    const double row[4][3] = {
        {4 * w2 * w * k / (71785 * d4 * d), -3 * w2 * k / (71785 * d4), -w2 * w / (71785 * d4)},
        {(ad - a / b * bd) / b - 2 / (5108 * d2 * d), (aw - a / b * bw) / b, 0},
        {-140.45 / (w2 * k), 2 * 140.45 * d / (w2 * w * k), 140.45 * d / (w2 * k * k)},
        {1 / 1.5, 1 / 1.5, 0}};
    for (int i = 0; i < n; i++) out->gradient[i] = g[i];
    for (int j = 0; j < 4; j++)
        for (int i = 0; i < n; i++) out->jacobian[j * n + i] = row[j][i];
    return VES_OK;
}

const ves_landscape ves_landscape_spring = {
    .name = "spring",
    .about = "a tension spring of least mass",
    .least = 3,
    .most = 3,
    .bounds = bounds,
    .inequalities = 4,
    .optimum = optimum,
    .eval = eval,
};

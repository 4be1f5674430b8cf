/* A welded beam of least cost [Ragsdell and Phillips 1976; the constraints as in Coello 2000]: weld h x l,
 * bar t x b; shear in the weld, bending stress, buckling and deflection are limited. */
#include <math.h>

#include "suite/landscape.h"

static const double bounds[][2] = {{0.1, 2}, {0.1, 10}, {0.1, 10}, {0.1, 2}};

static const double P = 6000, L = 14, E = 30e6, G = 12e6, tau_most = 13600, sigma_most = 30000,
                    delta_most = 0.25;

static double optimum(int n, double *x)
{
    static const double place[] = {0.205729639786079, 3.470488665628, 9.03662391035764, 0.205729639786079};
    for (int i = 0; i < n; i++) x[i] = place[i];
    return 1.724852308597365;
}

/* tau^2 = a^2 + a b l/R + b^2, the shear a = P/(sqrt2 h l) and the torsion b = M R/J with M = P (L + l/2),
 * R^2 = l^2/4 + (h + t)^2/4, J = 2 sqrt2 h l (l^2/12 + (h + t)^2/4). As b/R = M/J =: q, tau^2 = a^2 + a q l +
 * q^2 R^2. */
static double shear(const double *x, double *slope)
{
    double h = x[0], l = x[1], s = (x[0] + x[2]) / 2, root = sqrt(2);
    double a = P / (root * h * l), M = P * (L + l / 2), R2 = l * l / 4 + s * s;
    double K = l * l / 12 + s * s, J = 2 * root * h * l * K, q = M / J;
    double tau = sqrt(a * a + a * q * l + q * q * R2);
    /* by a, q, l (as it stands there) and s */
    double by_a = (2 * a + q * l) / (2 * tau), by_q = (a * l + 2 * q * R2) / (2 * tau);
    double by_l = (a * q + q * q * l / 2) / (2 * tau), by_s = q * q * 2 * s / (2 * tau);
    double q_h = -q / h, q_l = P / 2 / J - q / l - q * (l / 6) / K, q_s = -q * 2 * s / K;
    slope[0] = by_a * (-a / h) + by_q * (q_h + q_s / 2) + by_s / 2;
    slope[1] = by_a * (-a / l) + by_q * q_l + by_l;
    slope[2] = by_q * q_s / 2 + by_s / 2;
    slope[3] = 0;
    return tau;
}

static double buckling(const double *x, double *slope)
{
    double t = x[2], b = x[3], k = sqrt(E / (4 * G)) / (2 * L), factor = 4.013 * E / (6 * L * L);
    double most = factor * t * b * b * b * (1 - k * t);
    slope[2] = factor * b * b * b * (1 - 2 * k * t);
    slope[3] = 3 * most / b;
    return most;
}

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    double h = x[0], l = x[1], t = x[2], b = x[3], *c = out->constraint, tau[4], carry[4] = {0, 0, 0, 0};
    double sigma = 6 * P * L / (b * t * t), delta = 4 * P * L * L * L / (E * t * t * t * b);
    out->value = 1.10471 * h * h * l + 0.04811 * t * b * (14 + l);
    c[0] = shear(x, tau) / tau_most - 1;
    c[1] = sigma / sigma_most - 1;
    c[2] = h - b;
    c[3] = (0.10471 * h * h + 0.04811 * t * b * (14 + l)) / 5 - 1;
    c[4] = 0.125 - h;
    c[5] = delta / delta_most - 1;
    c[6] = 1 - buckling(x, carry) / P;
    if (!slopes) return VES_OK;
    const double g[4] = {2 * 1.10471 * h * l, 1.10471 * h * h + 0.04811 * t * b, 0.04811 * b * (14 + l),
                         0.04811 * t * (14 + l)};
    const double row[7][4] = {
        {tau[0] / tau_most, tau[1] / tau_most, tau[2] / tau_most, 0},
        {0, 0, -2 * sigma / t / sigma_most, -sigma / b / sigma_most},
        {1, 0, 0, -1},
        {2 * 0.10471 * h / 5, 0.04811 * t * b / 5, 0.04811 * b * (14 + l) / 5, 0.04811 * t * (14 + l) / 5},
        {-1, 0, 0, 0},
        {0, 0, -3 * delta / t / delta_most, -delta / b / delta_most},
        {0, 0, -carry[2] / P, -carry[3] / P}};
    for (int i = 0; i < n; i++) out->gradient[i] = g[i];
    for (int j = 0; j < 7; j++)
        for (int i = 0; i < n; i++) out->jacobian[j * n + i] = row[j][i];
    return VES_OK;
}

const ves_landscape ves_landscape_beam = {
    .name = "beam",
    .about = "a welded beam of least cost",
    .least = 4,
    .most = 4,
    .bounds = bounds,
    .inequalities = 7,
    .optimum = optimum,
    .eval = eval,
};

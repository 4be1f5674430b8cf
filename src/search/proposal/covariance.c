#include <math.h>

#include "search/point.h"
#include "search/proposal/proposal.h"

/* Adaptive Metropolis (Haario, Saksman and Tamminen 2001): normal steps along all coordinates, spread as the
 * points where the chain has been, with a scale that begins at 2.38 / sqrt n and follows the acceptance to 0.234
 * (Roberts, Gelman and Gilks 1997). The temperature falls meanwhile: older points are forgotten, a window of
 * WINDOW n of them is left. Covariance C, mean; L L^T = C anew after n / 2 points. Above DENSE variables only the
 * variances.
 * cost   a step n^2 / 2 multiplications and n normal numbers; a point n^2, L n^3 / 6
 * state  log of the scale, points learnt, mean[n], z[n], C[n][n], L by columns [n][n]
 * test   mean energy n T / 2 in a quadratic well; the covariance of an oblique well is found */

enum { SCALE, LEARNT, MEAN, WINDOW = 5, DENSE = 100 };

static const double target = 0.234, gain = 0.3, ridge = 1e-9;

static bool dense(int n)
{
    return n <= DENSE;
}

static int square(int n)
{
    return dense(n) ? n * n : n;
}

static int room(int n)
{
    return MEAN + 2 * n + 2 * square(n);
}

static void init(int n, double step, double *state)
{
    double *mean = state + MEAN, *c = mean + 2 * n, *l = c + square(n);
    int stride = dense(n) ? n + 1 : 1;
    state[SCALE] = log(2.38 / sqrt(n));
    state[LEARNT] = 0;
    for (int i = 0; i < n; i++) mean[i] = 0;
    for (int i = 0; i < square(n); i++) c[i] = l[i] = 0;
    for (int i = 0; i < n; i++) c[i * stride] = step * step;
    for (int i = 0; i < n; i++) l[i * stride] = step;
}

static void propose(int n, double *state, double heat, ves_random *random, double *u)
{
    double *z = state + MEAN + n;
    const double *l = state + MEAN + 2 * n + square(n);
    double scale = exp(state[SCALE]);
    (void)heat;
    ves_random_normals(random, n, z);
    for (int j = 0; j < n; j++) {
        double by = scale * z[j];
        if (!dense(n)) u[j] += by * l[j];
        for (int i = j; dense(n) && i < n; i++) u[i] += by * l[j * n + i];
    }
    for (int i = 0; i < n; i++) u[i] = ves_point_reflect(u[i]);
}

static void adapt(int n, double *state, bool accepted)
{
    (void)n;
    state[SCALE] += gain * ((accepted ? 1 : 0) - target);
    state[SCALE] = fmin(fmax(state[SCALE], -30), 12);
}

/* L L^T = C, by columns, with as much of a ridge as it needs. */
static void factor(int n, const double *c, double *l)
{
    double trace = 0;
    for (int i = 0; i < n; i++) trace += c[i * n + i];
    double least = ridge * trace / n + 1e-24;
    for (int j = 0; j < n; j++) {
        double *column = l + j * n;
        for (int i = j; i < n; i++) column[i] = c[i * n + j];
        for (int k = 0; k < j; k++) {
            double by = l[k * n + j];
            for (int i = j; i < n; i++) column[i] -= by * l[k * n + i];
        }
        double pivot = sqrt(fmax(column[j], least));
        for (int i = j; i < n; i++) column[i] = i == j ? pivot : column[i] / pivot;
    }
}

static void learn(int n, double *state, const double *u)
{
    double *mean = state + MEAN, *d = mean + n, *c = d + n, *l = c + square(n);
    double learnt = ++state[LEARNT], eta = 1 / fmin(learnt + 1, WINDOW * n + 1);
    for (int i = 0; i < n; i++) d[i] = u[i] - mean[i];
    if (learnt == 1) {
        for (int i = 0; i < n; i++) mean[i] = u[i];
        return;
    }
    for (int i = 0; i < n; i++) mean[i] += eta * d[i];
    if (!dense(n)) {
        for (int i = 0; i < n; i++) c[i] += eta * (d[i] * d[i] - c[i]);
        for (int i = 0; i < n; i++) l[i] = sqrt(c[i]);
        return;
    }
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) c[i * n + j] += eta * (d[i] * d[j] - c[i * n + j]);
    if ((long)learnt % (n / 2 + 1) == 0) factor(n, c, l);
}

static double width(int n, double heat, const double *state)
{
    (void)heat;
    const double *c = state + MEAN + 2 * n;
    double sum = 0;
    for (int i = 0; i < n; i++) sum += c[dense(n) ? i * n + i : i];
    return exp(state[SCALE]) * sqrt(sum / n);
}

const ves_proposal ves_proposal_covariance = {
    .name = "covariance",
    .about = "all coordinates, along the covariance of where the chain has been",
    .room = room,
    .init = init,
    .propose = propose,
    .adapt = adapt,
    .learn = learn,
    .width = width,
};

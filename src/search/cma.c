#include "search/cma.h"

#include <math.h>
#include <string.h>

#include "base/eigen.h"
#include "base/random.h"
#include "search/point.h"

/* Letters and equation numbers as in the tutorial (Hansen 2016, arXiv 1604.00772, appendix A). Departures:
 * - Equal values share the weights of their ranks, so that the order of the candidates never steers.
 * - Candidates that could not be measured have no positive weight; the weights of the others grow to sum 1, and
 *   mu_eff is that of the weights used.
 * - The eigenvectors are followed from one decomposition to the next, not made anew (eigen.h). Besides being fast
 *   it keeps their signs and order, so that runs on f(R x) from a turned basis are turned runs to rounding.
 * - Candidates drawn beyond the walls are ranked lower.
 * - C may change by 1 part in 2 n between decompositions, not 10 n as in B.2: the evaluations that an ellipsoid
 *   of 1e6 in 20 variables takes stay the same (13.3k; 13.1k with 1 in n), and the own time halves.
 * cost  lambda (n^2 + n^2 / 2) for steps and update, 2 n^3 and some sweeps of 2 n^3 every `gap` generations
 * test  tests/search_cma.c: invariances, weights against closed forms, rates of convergence, Hessians learned */

/* What a standard deviation beyond a wall costs, in parts of all ranks (by its square). Without it a population
 * that sees a minimum and its image contracts between them, on the wall: of bench/restarts.c in 10 variables
 * rotated Rastrigin was solved in 0 of 15 runs, with it in 13; of all functions in 137 of 180, with 0.05, 0.1, 0.2
 * and 0.4 in 165, 166, 169 and 165. */
static const double wall = 0.2;

enum { RING = VES_CMA_RING, CANDIDATES = 1 << 20 };

ves_cma_options ves_cma_default(void)
{
    return (ves_cma_options){.tol_x = 1e-12, .tol_fun = 1e-12, .hopeless = 0.1};
}

int ves_cma_population(int n)
{
    return 4 + (int)floor(3 * log(n)); /* (48) */
}

bool ves_cma_create(ves_arena *arena, int n, int most, const ves_cma_options *options, ves_cma *cma)
{
    size_t d = (size_t)n, p = (size_t)most;
    *cma = (ves_cma){.options = *options, .n = n, .most = most, .rival = HUGE_VAL};
    double **const plane[] = {&cma->weight,     &cma->used,   &cma->square,     &cma->score,
                              &cma->told,       &cma->step,   &cma->mean,       &cma->axis,
                              &cma->path_sigma, &cma->path_c, &cma->basis,      &cma->best,
                              &cma->median,     &cma->sorted, &cma->covariance, &cma->scratch};
    const size_t size[] = {p, p, p, p, p, p * d, d, d, d, d, d * d, RING, RING, RING, d * d, 3 * d * d};
    for (size_t k = 0; k < sizeof plane / sizeof *plane; k++)
        if (!(*plane[k] = ves_arena_take(arena, size[k], sizeof(double)))) return false;
    cma->order = ves_arena_take(arena, p, sizeof(int));
    cma->merged = ves_arena_take(arena, p, sizeof(int));
    return cma->order && cma->merged;
}

/* ---- what follows from n and lambda ---- */

static double mu_eff(int count, const double *weight)
{
    double sum = 0, squares = 0;
    for (int i = 0; i < count; i++) {
        sum += weight[i];
        squares += weight[i] * weight[i];
    }
    return squares > 0 ? sum * sum / squares : 0;
}

/* (55)-(58) and alpha_cov = 2 */
static ves_cma_rates rates_of(int n, int mu, double mue)
{
    ves_cma_rates r = {.mu = mu, .mu_eff = mue};
    r.c_sigma = (mue + 2) / (n + mue + 5);
    r.d_sigma = 1 + 2 * fmax(0, sqrt((mue - 1) / (n + 1)) - 1) + r.c_sigma;
    r.c_c = (4 + mue / n) / (n + 4 + 2 * mue / n);
    r.c_1 = 2 / ((n + 1.3) * (n + 1.3) + mue);
    r.c_mu = fmin(1 - r.c_1, 2 * (mue - 2 + 1 / mue) / ((n + 2) * (n + 2.) + mue));
    r.normal = sqrt(2) * exp(lgamma((n + 1) / 2.) - lgamma(n / 2.));
    r.gap = fmax(1, 1 / (2 * n * (r.c_1 + r.c_mu)));
    return r;
}

/* (49)-(53): the negative weights never sum to more than leaves C its positive eigenvalues. */
static void weigh(int n, int lambda, double *weight, ves_cma_rates *rates)
{
    int mu = lambda / 2;
    double positive = 0, negative = 0;
    for (int i = 0; i < lambda; i++) {
        weight[i] = log((lambda + 1) / 2.) - log(i + 1);
        if (i < mu)
            positive += weight[i];
        else
            negative -= weight[i];
    }
    double minus = mu_eff(lambda - mu, weight + mu);
    *rates = rates_of(n, mu, mu_eff(mu, weight));
    /* one parent (lambda 2 and 3): c_mu is 0, and both quotients are infinite */
    double alpha = fmin(1 + rates->c_1 / rates->c_mu, 1 + 2 * minus / (rates->mu_eff + 2));
    alpha = fmin(alpha, (1 - rates->c_1 - rates->c_mu) / (n * rates->c_mu));
    for (int i = 0; i < mu; i++) weight[i] /= positive;
    for (int i = mu; i < lambda; i++) weight[i] *= alpha / negative;
}

void ves_cma_restart(ves_cma *cma, const double *mean, double sigma, int lambda)
{
    int n = cma->n;
    cma->lambda = lambda;
    weigh(n, lambda, cma->weight, &cma->rates);
    cma->sigma = cma->first_sigma = sigma;
    for (int i = 0; i < n; i++) {
        cma->mean[i] = mean[i];
        cma->axis[i] = 1;
        cma->path_sigma[i] = cma->path_c[i] = 0;
        for (int j = 0; j < n; j++) cma->covariance[i * n + j] = cma->basis[i * n + j] = i == j;
    }
    cma->age = cma->decomposed = 0;
    cma->failed = 0;
    cma->broken = false;
    cma->spread = 0;
    cma->least = cma->rival = HUGE_VAL;
    cma->worst = -HUGE_VAL;
    ves_cma_fold(cma);
}

void ves_cma_ask(ves_cma *cma, int k, double *raw, double *u)
{
    int n = cma->n;
    double *restrict y = &cma->step[(size_t)k * n], square = 0;
    ves_random random = {.seed = cma->options.seed, .chain = cma->options.stream};
    random.step = cma->generation * CANDIDATES + (uint64_t)k;
    for (int i = 0; i < n; i++) y[i] = 0;
    for (int j = 0; j < n; j += 2) {
        double z[2];
        ves_random_normals(&random, 2, z);
        for (int e = 0; e < 2 && j + e < n; e++) {
            const double *row = &cma->basis[(j + e) * n];
            double length = cma->axis[j + e] * z[e];
            square += z[e] * z[e];
            for (int i = 0; i < n; i++) y[i] += length * row[i];
        }
    }
    cma->square[k] = square;
    for (int i = 0; i < n; i++) {
        double x = cma->mean[i] + cma->sigma * y[i];
        if (raw) raw[i] = x;
        if (u) u[i] = ves_point_reflect(x);
    }
}

/* ---- ranks ---- */

/* Candidates by value, equal ones by number: merges from below. */
static void rank(int lambda, const double *value, int *order, int *merged)
{
    for (int k = 0; k < lambda; k++) order[k] = k;
    for (int width = 1; width < lambda; width *= 2) {
        for (int low = 0; low < lambda; low += 2 * width) {
            int middle = low + width < lambda ? low + width : lambda;
            int high = middle + width < lambda ? middle + width : lambda;
            for (int k = low, a = low, b = middle; k < high; k++) {
                bool first = b == high || (a < middle && value[order[a]] <= value[order[b]]);
                merged[k] = order[first ? a++ : b++];
            }
        }
        memcpy(order, merged, (size_t)lambda * sizeof *order);
    }
}

/* How far candidate k lies beyond the walls, in standard deviations: the sum of squares. */
static double beyond(const ves_cma *cma, int k)
{
    double sum = 0;
    for (int i = 0; i < cma->n; i++) {
        double x = cma->mean[i] + cma->sigma * cma->step[(size_t)k * cma->n + i];
        double out = x < 0 ? x : x > 1 ? x - 1 : 0;
        if (out != 0) sum += out * out / (cma->sigma * cma->sigma * cma->covariance[i * cma->n + i]);
    }
    return sum;
}

/* What the candidates are ordered by in the end: their rank among the values, from 0 to 1, equal values at their
 * mean, and more the farther beyond the walls. Ranks, so that the values' scale does not matter; deviations, so
 * that the box's does not. */
static void judge(ves_cma *cma, const double *value)
{
    int lambda = cma->lambda, *order = cma->order;
    for (int i = 0, j; i < lambda; i = j) {
        for (j = i + 1; j < lambda && value[order[j]] == value[order[i]]; j++) continue;
        for (int k = i; k < j; k++)
            cma->score[order[k]] = value[order[k]] < HUGE_VAL
                                       ? (i + j) / (2. * lambda) + wall * beyond(cma, order[k])
                                       : HUGE_VAL;
    }
    rank(lambda, cma->score, order, cma->merged);
}

/* The weights of this generation, of which the first `measured` ranks are of known value; returns mu_eff. */
static double share(ves_cma *cma, int measured)
{
    int lambda = cma->lambda, parents = 0;
    double *w = cma->used, sum = 0;
    for (int i = 0, j; i < lambda; i = j) {
        double mean = cma->weight[i];
        for (j = i + 1; j < lambda && cma->score[cma->order[j]] == cma->score[cma->order[i]]; j++)
            mean += cma->weight[j];
        for (int k = i; k < j; k++) w[k] = j > i + 1 ? mean / (j - i) : mean;
    }
    for (int i = measured; i < lambda; i++) w[i] = fmin(w[i], 0);
    while (parents < lambda && w[parents] > 0) sum += w[parents++];
    for (int i = 0; i < parents; i++) w[i] /= sum;
    return mu_eff(parents, w);
}

/* ---- the update ---- */

/* out = C^(-1/2) y = B' D^-1 B y */
static void whiten(const ves_cma *cma, const double *y, double *out)
{
    int n = cma->n;
    for (int i = 0; i < n; i++) out[i] = 0;
    for (int j = 0; j < n; j++) {
        const double *row = &cma->basis[j * n];
        double dot = 0;
        for (int i = 0; i < n; i++) dot += row[i] * y[i];
        dot /= cma->axis[j];
        for (int i = 0; i < n; i++) out[i] += dot * row[i];
    }
}

/* (43)-(45): both paths; returns h_sigma, 0 while the steps grow too fast for C to follow. */
static bool walk(ves_cma *cma, const double *y, double effective)
{
    const ves_cma_rates *r = &cma->rates;
    int n = cma->n;
    double *white = cma->scratch + n, square = 0;
    double a = sqrt(r->c_sigma * (2 - r->c_sigma) * effective), b = sqrt(r->c_c * (2 - r->c_c) * effective);
    whiten(cma, y, white);
    for (int i = 0; i < n; i++) {
        cma->path_sigma[i] = (1 - r->c_sigma) * cma->path_sigma[i] + a * white[i];
        square += cma->path_sigma[i] * cma->path_sigma[i];
    }
    double grown = 1 - pow(1 - r->c_sigma, 2 * (double)(cma->age + 1));
    bool h = sqrt(square / grown) < (1.4 + 2 / (n + 1.)) * r->normal;
    for (int i = 0; i < n; i++) cma->path_c[i] = (1 - r->c_c) * cma->path_c[i] + (h ? b * y[i] : 0);
    cma->sigma *= exp(fmin(1, r->c_sigma / r->d_sigma * (sqrt(square) / r->normal - 1)));
    return h;
}

static void add(int n, double factor, const double *y, double *restrict c)
{
    for (int i = 0; i < n; i++) {
        double f = factor * y[i];
        for (int j = 0; j <= i; j++) c[i * n + j] += f * y[j];
    }
}

/* (46), (47): a step of negative weight counts by its direction alone, at the length of a mean one. */
static void adapt(ves_cma *cma, bool h)
{
    const ves_cma_rates *r = &cma->rates;
    int n = cma->n;
    double sum = 0;
    for (int i = 0; i < cma->lambda; i++) sum += cma->used[i];
    double keep = 1 + r->c_1 * (h ? 0 : r->c_c * (2 - r->c_c)) - r->c_1 - r->c_mu * sum;
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) cma->covariance[i * n + j] *= keep;
    add(n, r->c_1, cma->path_c, cma->covariance);
    for (int i = 0; i < cma->lambda && r->c_mu > 0; i++) {
        int k = cma->order[i];
        double w = cma->used[i];
        if (w < 0) w *= n / (cma->square[k] + 1e-8);
        if (w != 0) add(n, r->c_mu * w, &cma->step[(size_t)k * n], cma->covariance);
    }
}

void ves_cma_fold(ves_cma *cma)
{
    int n = cma->n;
    for (int i = 0; i < n; i++) {
        double x = cma->mean[i];
        bool turned = fmod(floor(fabs(x)), 2) != (x < 0); /* past an odd number of walls */
        cma->mean[i] = ves_point_reflect(x);
        if (!turned) continue;
        cma->path_sigma[i] = -cma->path_sigma[i];
        cma->path_c[i] = -cma->path_c[i];
        for (int k = 0; k < n; k++) cma->basis[k * n + i] = -cma->basis[k * n + i];
        for (int k = 0; k < n; k++)
            if (k != i) cma->covariance[k > i ? k * n + i : i * n + k] *= -1;
    }
}

static void decompose(ves_cma *cma)
{
    int n = cma->n;
    double *value = cma->scratch + 2 * n * n;
    ves_eigen_follow(n, cma->covariance, cma->basis, value, cma->scratch);
    for (int i = 0; i < n; i++) {
        if (!(value[i] > 0 && isfinite(value[i]))) cma->broken = true;
        if (!cma->broken) cma->axis[i] = sqrt(value[i]);
    }
    cma->decomposed = cma->age;
}

static void remember(ves_cma *cma, const double *value, int measured)
{
    double best = value[cma->order[0]], median = value[cma->order[(measured - 1) / 2]];
    cma->best[cma->age % RING] = best;
    cma->median[cma->age % RING] = median;
    cma->worst = value[cma->order[measured - 1]];
    cma->least = fmin(cma->least, best);
    if (!(cma->spread > 0)) cma->spread = median - best;
}

/* (42): the parents' mean step; the mean goes there. */
static void move(ves_cma *cma, double *y)
{
    int n = cma->n;
    for (int i = 0; i < n; i++) y[i] = 0;
    for (int i = 0; i < cma->lambda && cma->used[i] > 0; i++) {
        const double *step = &cma->step[(size_t)cma->order[i] * n];
        for (int j = 0; j < n; j++) y[j] += cma->used[i] * step[j];
    }
    for (int i = 0; i < n; i++) cma->mean[i] += cma->sigma * y[i];
}

void ves_cma_tell(ves_cma *cma, const double *told)
{
    int lambda = cma->lambda, measured = 0;
    double *value = cma->told, *y = cma->scratch;
    for (int k = 0; k < lambda; k++) value[k] = isnan(told[k]) ? HUGE_VAL : told[k];
    cma->generation++;
    rank(lambda, value, cma->order, cma->merged);
    while (measured < lambda && value[cma->order[measured]] < HUGE_VAL) measured++;
    cma->failed = measured ? 0 : cma->failed + 1;
    if (!measured) return;
    remember(cma, value, measured);
    if (measured == lambda && cma->worst == value[cma->order[0]]) { /* nothing to go by: look further, B.3 */
        cma->sigma *= exp(0.2 + cma->rates.c_sigma / cma->rates.d_sigma);
        cma->age++;
        return;
    }
    judge(cma, value);
    double effective = share(cma, measured);
    move(cma, y);
    adapt(cma, walk(cma, y, effective));
    ves_cma_fold(cma);
    cma->age++;
    if ((double)(cma->age - cma->decomposed) >= cma->rates.gap) decompose(cma);
}

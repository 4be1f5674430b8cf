#include "suite/statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/random.h"

enum { SAMPLES = 1000, EXACT = 600 };

static const double z95 = 1.959963984540054; /* of the normal distribution, two-sided 95 % */

ves_interval ves_statistics_share(int hits, int n)
{
    if (n < 1) return (ves_interval){NAN, NAN, NAN};
    double p = (double)hits / n, z2 = z95 * z95 / n, middle = (p + z2 / 2) / (1 + z2);
    double half = z95 / (1 + z2) * sqrt(p * (1 - p) / n + z2 / (4 * n));
    return (ves_interval){p, hits ? middle - half : 0, hits < n ? middle + half : 1};
}

static double ert_of(const double *spent, const bool *hit, int n, ves_random *random)
{
    double sum = 0;
    int hits = 0;
    for (int k = 0; k < n; k++) {
        int j = random ? ves_random_below(random, n) : k;
        sum += spent[j];
        hits += hit[j];
    }
    return hits ? sum / hits : INFINITY;
}

ves_interval ves_statistics_ert(const double *spent, const bool *hit, int n, uint64_t seed)
{
    double sample[SAMPLES];
    if (n < 1) return (ves_interval){NAN, NAN, NAN};
    for (int s = 0; s < SAMPLES; s++) {
        ves_random random = {.seed = seed, .step = (uint64_t)s};
        sample[s] = ert_of(spent, hit, n, &random);
    }
    ves_statistics_sort(sample, SAMPLES);
    return (ves_interval){ert_of(spent, hit, n, NULL), ves_statistics_quantile(sample, SAMPLES, 0.025),
                          ves_statistics_quantile(sample, SAMPLES, 0.975)};
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    if (isnan(x) || isnan(y)) return (isnan(x) != 0) - (isnan(y) != 0);
    return (x > y) - (x < y);
}

void ves_statistics_sort(double *x, int n)
{
    if (n > 0) qsort(x, (size_t)n, sizeof *x, ascending);
}

double ves_statistics_quantile(const double *x, int n, double p)
{
    if (n < 1) return NAN;
    double at = p * (n - 1), part = at - floor(at);
    int k = (int)at;
    if (part == 0 || k + 1 >= n || x[k] == x[k + 1]) return x[k];
    return x[k] + part * (x[k + 1] - x[k]);
}

double ves_statistics_effect(const double *x, int nx, const double *y, int ny)
{
    double sum = 0;
    for (int i = 0; i < nx; i++)
        for (int j = 0; j < ny; j++) sum += x[i] < y[j] ? 1 : x[i] == y[j] ? 0.5 : 0;
    return nx && ny ? sum / ((double)nx * ny) : NAN;
}

typedef struct item {
    double value;
    int index;
} item;

static int by_value(const void *a, const void *b)
{
    return ascending(&((const item *)a)->value, &((const item *)b)->value);
}

/* Twice the midrank of each: whole numbers. Returns the sum of t^3 - t over ties; -1: out of memory. */
static double ranks(const double *value, int n, int *rank)
{
    item *sorted = ves_memory_take((size_t)n * sizeof *sorted);
    double ties = 0;
    if (!sorted) return -1;
    for (int k = 0; k < n; k++) sorted[k] = (item){value[k], k};
    qsort(sorted, (size_t)n, sizeof *sorted, by_value);
    for (int k = 0, end; k < n; k = end) {
        for (end = k + 1; end < n && sorted[end].value == sorted[k].value;) end++;
        for (int j = k; j < end; j++) rank[sorted[j].index] = k + end + 1; /* 2 (k + 1 + end) / 2 */
        double t = end - k;
        ties += t * t * t - t;
    }
    ves_memory_free(sorted);
    return ties;
}

static double normal_tails(double z)
{
    return erfc(fabs(z) / sqrt(2));
}

/* Of a distribution over whole numbers, symmetric about `middle`: both tails from `at` on. */
static double tails(const double *chance, int count, double middle, double at)
{
    double sum = 0;
    for (int k = 0; k < count; k++)
        if (fabs(k - middle) >= fabs(at - middle) - 1e-9) sum += chance[k];
    return fmin(sum, 1);
}

/* Chances of each sum of the ranks with a plus sign. */
static double exact_paired(const int *rank, int n, int observed)
{
    int total = n * (n + 1) + 1;
    double *chance = ves_memory_take((size_t)total * sizeof *chance);
    if (!chance) return NAN;
    chance[0] = 1;
    for (int k = 0; k < n; k++)
        for (int sum = total - 1; sum >= 0; sum--)
            chance[sum] = 0.5 * (chance[sum] + (sum >= rank[k] ? chance[sum - rank[k]] : 0));
    double p = tails(chance, total, n * (n + 1) / 2.0, observed);
    ves_memory_free(chance);
    return p;
}

double ves_statistics_least(int n)
{
    return fmin(1, ldexp(1, 1 - n));
}

ves_paired ves_statistics_paired(const double *x, const double *y, int n)
{
    double *size = ves_memory_take((size_t)(n + 1) * sizeof *size);
    ves_paired paired = {.p = NAN};
    int *rank = ves_memory_take((size_t)(n + 1) * sizeof *rank), count = 0, plus = 0;
    bool *sign = ves_memory_take((size_t)(n + 1) * sizeof *sign);
    if (size && rank && sign) {
        for (int k = 0; k < n; k++) {
            if (x[k] == y[k] || isnan(x[k]) || isnan(y[k])) continue;
            sign[count] = x[k] > y[k];
            size[count++] = fabs(x[k] - y[k]);
        }
        double ties = ranks(size, count, rank), N = count;
        for (int k = 0; k < count; k++) plus += sign[k] ? rank[k] : 0;
        if (count) paired.lead = 1 - 2 * plus / (N * (N + 1));
        double variance = N * (N + 1) * (2 * N + 1) / 24 - ties / 48;
        double off = fmax(fabs(plus / 2.0 - N * (N + 1) / 4) - 0.5, 0);
        if (ties >= 0 && count <= EXACT)
            paired.p = count ? exact_paired(rank, count, plus) : 1;
        else if (ties >= 0)
            paired.p = normal_tails(off / sqrt(variance));
    }
    ves_memory_free(size);
    ves_memory_free(rank);
    ves_memory_free(sign);
    return paired;
}

/* The smallest p times count, the next times count - 1 ..., none less than one before it. What is done bears
 * a minus sign meanwhile. */
void ves_statistics_holm(double *p, int count)
{
    double least = 0;
    for (int left = count; left > 0; left--) {
        int next = -1, tests = 0;
        for (int k = 0; k < count; k++) {
            if (isnan(p[k]) || signbit(p[k])) continue;
            tests++;
            if (next < 0 || p[k] < p[next]) next = k;
        }
        if (next < 0) break;
        least = fmax(least, fmin(1, p[next] * tests));
        p[next] = -least;
    }
    for (int k = 0; k < count; k++) p[k] = isnan(p[k]) ? p[k] : fabs(p[k]);
}

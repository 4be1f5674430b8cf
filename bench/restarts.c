/* Restarted CMA-ES on functions with known minima: how often and after how many evaluations it comes within 1e-6.
 * Fifteen seeds, each with an instance of its own (the minimum moved, rot_: the coordinates turned); at most
 * min(1e4 d, 2e5) evaluations. ERT: evaluations of all seeds over the number of hits. Prints JSON Lines.
 *
 *     bench_restarts [d=5,10,20] [only=NAME] [seeds=15] [trace=0] [hopeless=0.1] [tol=1e-12]
 *                    [two=0] [first=1] [growth=2] [sigma=0.3]
 *
 * first: of the default population, times; the others are fields of ves_cma_options and ves_ipop_options. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/random.h"
#include "base/vector.h"
#include "search/cma.h"
#include "search/ipop.h"

enum { MOST = 40, PEAKS = 21, POPULATION = 1 << 14 };

typedef struct instance {
    int n;
    double shift[MOST], turn[MOST * MOST], peak[PEAKS * MOST], weight[PEAKS];
} instance;

/* ---- functions of the distance x from the minimum, which is 0 at x = 0 ---- */

static double sphere(const instance *f, const double *x)
{
    double sum = 0;
    for (int i = 0; i < f->n; i++) sum += x[i] * x[i];
    return sum;
}

static double ellipsoid(const instance *f, const double *x)
{
    double sum = 0;
    for (int i = 0; i < f->n; i++) sum += pow(10, 6. * i / (f->n - 1)) * x[i] * x[i];
    return sum;
}

static double rastrigin(const instance *f, const double *x)
{
    double sum = 0;
    for (int i = 0; i < f->n; i++) sum += x[i] * x[i] + 10 * (1 - cos(VES_TWO_PI * x[i]));
    return sum;
}

static double ackley(const instance *f, const double *x)
{
    double waves = 0;
    for (int i = 0; i < f->n; i++) waves += cos(VES_TWO_PI * x[i]);
    return 20 - 20 * exp(-0.2 * sqrt(sphere(f, x) / f->n)) + exp(1) - exp(waves / f->n);
}

static double griewank(const instance *f, const double *x)
{
    double product = 1;
    for (int i = 0; i < f->n; i++) product *= cos(x[i] / sqrt(i + 1));
    return 1 + sphere(f, x) / 4000 - product;
}

/* Not moved: the minimum lies near a corner of its box. */
static double schwefel(const instance *f, const double *x)
{
    double sum = 0;
    for (int i = 0; i < f->n; i++) sum += 418.98288727243378 - x[i] * sin(sqrt(fabs(x[i])));
    return sum;
}

static double rosenbrock(const instance *f, const double *x)
{
    double sum = 0;
    for (int i = 0; i < f->n - 1; i++) {
        double a = x[i] + 1, b = x[i + 1] + 1 - a * a;
        sum += 100 * b * b + x[i] * x[i];
    }
    return sum;
}

static double levy(const instance *f, const double *x)
{
    double sum = 0, pi = VES_TWO_PI / 2;
    for (int i = 0; i < f->n; i++) {
        double w = x[i] / 4, s = sin(i ? pi * w : pi * (w + 1)), t = sin(pi * (w + 1) + 1);
        if (i == 0) sum += s * s;
        s = sin(VES_TWO_PI * (w + 1));
        sum += i < f->n - 1 ? w * w * (1 + 10 * t * t) : w * w * (1 + s * s);
    }
    return sum;
}

static double schaffer(const instance *f, const double *x)
{
    double sum = 0;
    for (int i = 0; i < f->n - 1; i++) {
        double s = sqrt(x[i] * x[i] + x[i + 1] * x[i + 1]), w = sin(50 * pow(s, 0.2));
        sum += sqrt(s) * (1 + w * w);
    }
    return sum / (f->n - 1) * sum / (f->n - 1);
}

static double bowls(const instance *f, const double *x)
{
    double near = 0, far = 0, waves = 0, s = 1 - 1 / (2 * sqrt(f->n + 20.) - 8.2);
    double other = -sqrt((2.5 * 2.5 - 1) / s);
    for (int i = 0; i < f->n; i++) {
        near += x[i] * x[i];
        far += (x[i] + 2.5 - other) * (x[i] + 2.5 - other);
        waves += 1 - cos(VES_TWO_PI * x[i]);
    }
    return fmin(near, f->n + s * far) + 10 * waves;
}

static double peaks(const instance *f, const double *x)
{
    double best = 0;
    for (int k = 0; k < PEAKS; k++) {
        double square = 0;
        for (int i = 0; i < f->n; i++) {
            double d = x[i] - f->peak[k * MOST + i];
            square += d * d * pow(10, 2. * ((i * 7 + k * 3) % f->n) / (f->n - 1) - 1);
        }
        best = fmax(best, f->weight[k] * exp(-square / (2 * f->n)));
    }
    return (10 - best) * (10 - best);
}

static const struct function {
    const char *name;
    double (*value)(const instance *, const double *);
    double low, high;
    bool turned;
} FUNCTION[] = {
    {"rastrigin", rastrigin, -5.12, 5.12, false},
    {"ackley", ackley, -32.768, 32.768, false},
    {"griewank", griewank, -600, 600, false},
    {"schwefel", schwefel, -500, 500, false},
    {"rosenbrock", rosenbrock, -5, 10, false},
    {"levy", levy, -10, 10, false},
    {"rot_rastrigin", rastrigin, -5.12, 5.12, true},
    {"rot_ellipsoid", ellipsoid, -5, 5, true},
    {"rot_griewank", griewank, -20, 20, true},
    {"rot_schaffer", schaffer, -100, 100, true},
    {"rot_bowls", bowls, -5, 5, true},
    {"rot_peaks", peaks, -5, 5, true},
};

enum { FUNCTIONS = sizeof FUNCTION / sizeof *FUNCTION };

/* Rows of normal numbers, made orthonormal one after the other. */
static void turn(instance *f, ves_random *random)
{
    int n = f->n;
    for (int i = 0; i < n; i++) {
        double *row = &f->turn[i * n], length = 0;
        for (int j = 0; j < n; j++) row[j] = ves_random_normal(random);
        for (int k = 0; k < i; k++) {
            double dot = 0;
            for (int j = 0; j < n; j++) dot += row[j] * f->turn[k * n + j];
            for (int j = 0; j < n; j++) row[j] -= dot * f->turn[k * n + j];
        }
        for (int j = 0; j < n; j++) length += row[j] * row[j];
        for (int j = 0; j < n; j++) row[j] /= sqrt(length);
    }
}

static void pose(const struct function *kind, int n, int seed, instance *f)
{
    ves_random random = {.seed = 77, .chain = (uint32_t)seed, .step = (uint64_t)n};
    f->n = n;
    for (int i = 0; i < n; i++)
        f->shift[i] = kind->low + (kind->high - kind->low) * (0.1 + 0.8 * ves_random_uniform(&random));
    if (kind->value == schwefel) memset(f->shift, 0, sizeof f->shift);
    turn(f, &random);
    for (int k = 0; k < PEAKS; k++) {
        f->weight[k] = k ? 1.1 + 8 * (k - 1.) / (PEAKS - 2) : 10;
        for (int i = 0; i < n; i++)
            f->peak[k * MOST + i] = k ? -4.9 + 9.8 * ves_random_uniform(&random) - f->shift[i] : 0;
    }
}

static double value_of(const struct function *kind, const instance *f, const double *u)
{
    double x[MOST], y[MOST];
    int n = f->n;
    for (int i = 0; i < n; i++) x[i] = kind->low + (kind->high - kind->low) * u[i] - f->shift[i];
    if (!kind->turned) return kind->value(f, x);
    for (int i = 0; i < n; i++) {
        y[i] = 0;
        for (int j = 0; j < n; j++) y[i] += f->turn[i * n + j] * x[j];
    }
    return kind->value(f, y);
}

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- one seed ---- */

typedef struct settings {
    ves_cma_options cma;
    ves_ipop_options ipop;
    double first;
    int seeds;
    bool trace; /* a line for each run */
    const char *d, *only;
} settings;

enum { ENDS = VES_CMA_HOPELESS + 1 };

typedef struct outcome {
    bool hit;
    long evaluations;
    int runs, ends[ENDS];
    double best;
} outcome;

static const double target = 1e-6;

static outcome solve(const struct function *kind, const instance *f, const settings *s, long budget, int seed)
{
    ves_arena arena = {0};
    ves_cma cma;
    ves_ipop ipop;
    ves_ipop_run run;
    ves_cma_options options = s->cma;
    ves_ipop_options restarts = s->ipop;
    outcome o = {.best = HUGE_VAL};
    double mean[MOST], u[MOST], *value = malloc(POPULATION * sizeof *value), best_before = HUGE_VAL;
    options.seed = restarts.seed = (uint64_t)seed;
    restarts.stream = 1;
    restarts.most = POPULATION;
    restarts.first = (int)(s->first * ves_cma_population(f->n));
    if (!value || !ves_cma_create(&arena, f->n, POPULATION, &options, &cma)) exit(1);
    ves_ipop_init(&ipop, f->n, &restarts);
    for (long spent = 0; !o.hit && o.evaluations < budget; o.runs++) {
        ves_ipop_next(&ipop, spent, &run, mean);
        ves_cma_restart(&cma, mean, run.sigma, run.lambda);
        cma.rival = best_before;
        spent = 0;
        ves_cma_stop stop = VES_CMA_RUNNING;
        while (!stop && !o.hit && o.evaluations < budget && !(run.limit && spent >= run.limit)) {
            for (int k = 0; k < run.lambda && !o.hit && o.evaluations < budget; k++) {
                ves_cma_ask(&cma, k, NULL, u);
                value[k] = value_of(kind, f, u);
                o.best = fmin(o.best, value[k]);
                o.hit = value[k] <= target;
                o.evaluations++;
                spent++;
            }
            if (o.hit || o.evaluations >= budget) break;
            ves_cma_tell(&cma, value);
            stop = ves_cma_stopped(&cma);
        }
        o.ends[stop]++;
        if (s->trace)
            printf("{\"seed\": %d, \"lambda\": %d, \"evaluations\": %ld, \"least\": %g, \"end\": \"%s\"}\n",
                   seed, run.lambda, spent, cma.least, ves_cma_stop_text(stop));
        best_before = o.best;
    }
    free(value);
    ves_arena_destroy(&arena);
    return o;
}

/* All seeds of one function: the number of hits. log10 of the ERT is added to score; without a hit, of what all
 * seeds and one more would have spent. */
static int table(const struct function *kind, int n, const settings *s, double *score)
{
    static const char *const end[ENDS] = {
#define END(name, sentence) #name,
        VES_CMA_STOP_LIST(END)
#undef END
    };
    long budget = n < 20 ? 10000L * n : 200000, cost = 0;
    int hits = 0, runs = 0, ends[ENDS] = {0};
    double from = now();
    for (int seed = 0; seed < s->seeds; seed++) {
        static instance f;
        pose(kind, n, seed, &f);
        outcome o = solve(kind, &f, s, budget, seed);
        hits += o.hit;
        cost += o.evaluations;
        runs += o.runs;
        for (int k = 0; k < ENDS; k++) ends[k] += o.ends[k];
    }
    double us = 1e6 * (now() - from) / (double)cost, ert = (double)cost / hits;
    printf("{\"function\": \"%s\", \"d\": %d, \"hits\": %d, \"seeds\": %d, \"ert\": ", kind->name, n, hits,
           s->seeds);
    if (hits)
        printf("%.0f", ert);
    else
        printf("null");
    printf(", \"runs\": %d, \"us an evaluation\": %.2f, \"ends\": {", runs, us);
    for (int k = 0, some = 0; k < ENDS; k++)
        if (ends[k]) printf("%s\"%s\": %d", some++ ? ", " : "", end[k], ends[k]);
    printf("}}\n");
    fflush(stdout);
    *score += log10(hits ? ert : (double)(cost + budget));
    return hits;
}

int main(int count, char **word)
{
    settings s = {
        .cma = ves_cma_default(), .ipop = ves_ipop_default(10), .first = 1, .seeds = 15, .d = "5,10,20"};
    for (int k = 1; k < count; k++) {
        const char *at = strchr(word[k], '=');
        if (!at) return 2;
        double x = atof(++at);
        if (!strncmp(word[k], "d=", 2)) s.d = at;
        if (!strncmp(word[k], "only=", 5)) s.only = at;
        if (!strncmp(word[k], "seeds=", 6)) s.seeds = (int)x;
        if (!strncmp(word[k], "trace=", 6)) s.trace = x > 0;
        if (!strncmp(word[k], "hopeless=", 9)) s.cma.hopeless = x;
        if (!strncmp(word[k], "tol=", 4)) s.cma.tol_fun = x;
        if (!strncmp(word[k], "two=", 4)) s.ipop.two = x > 0;
        if (!strncmp(word[k], "first=", 6)) s.first = x;
        if (!strncmp(word[k], "growth=", 7)) s.ipop.growth = x;
        if (!strncmp(word[k], "sigma=", 6)) s.ipop.sigma = x;
    }
    for (const char *at = s.d; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        int n = atoi(at), hits = 0, asked = 0;
        double score = 0;
        if (n < 2 || n > MOST) return 2;
        for (int k = 0; k < FUNCTIONS; k++) {
            if (s.only && strcmp(s.only, FUNCTION[k].name)) continue;
            hits += table(&FUNCTION[k], n, &s, &score);
            asked++;
        }
        printf("{\"d\": %d, \"hits\": %d, \"of\": %d, \"mean log10 ert\": %.3f}\n", n, hits, asked * s.seeds,
               score / asked);
    }
    return 0;
}

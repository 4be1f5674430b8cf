/* Problems with known answers for the tests of the search, and a way to run one in one line. */
#ifndef SEARCH_PROBLEMS_H
#define SEARCH_PROBLEMS_H

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "vesica/search.h"

#define PI 3.14159265358979323846

enum { MOST = 24 };

typedef struct given {
    ves_status (*evaluate)(void *, int, const ves_ask *, ves_verdict *);
    int n, m;
    double lower[MOST], upper[MOST], start[MOST];
    bool equality[MOST];
    double tolerance; /* 0: 1e-6 */
    bool gradients;
    int workers;
    void *data;
} given;

static inline ves_status run(const given *g, const ves_search_options *options, const ves_search_hooks *hooks,
                             ves_search_result **result)
{
    ves_search_problem problem = {.n = g->n,
                                  .m = g->m,
                                  .lower = g->lower,
                                  .upper = g->upper,
                                  .start = g->start,
                                  .equality = g->equality,
                                  .tolerance = g->tolerance,
                                  .gradients = g->gradients,
                                  .workers = g->workers,
                                  .evaluate = g->evaluate,
                                  .data = g->data};
    return ves_search_run(&problem, options, hooks, result);
}

/* The first note with the word in it, or NULL. */
static inline const char *noted(const ves_search_result *r, const char *word)
{
    for (int k = 0; k < r->notes; k++)
        if (strstr(r->note[k], word)) return r->note[k];
    return NULL;
}

static inline ves_search_options only_polish(const char *algorithm)
{
    ves_search_options o = ves_search_options_default();
    o.stages = 1;
    o.stage[0] = (ves_stage){.kind = VES_STAGE_POLISH, .polish = ves_polish_default()};
    o.stage[0].polish.algorithm = algorithm;
    return o;
}

static inline ves_search_options only_anneal(long evaluations)
{
    ves_search_options o = ves_search_options_default();
    o.stages = 1;
    o.stage[0] = (ves_stage){.kind = VES_STAGE_ANNEAL, .anneal = ves_anneal_default()};
    o.stage[0].anneal.evaluations = evaluations;
    o.stage[0].anneal.polish = "none";
    return o;
}

/* Chains, each of whose ends is polished. */
static inline ves_search_options chains_and_polish(int chains)
{
    ves_search_options o = only_anneal(0);
    o.stages = 2;
    o.stage[0].anneal.chains = chains;
    o.stage[1] = (ves_stage){.kind = VES_STAGE_POLISH, .polish = ves_polish_default()};
    return o;
}

static inline double *gradient_of(const ves_ask *ask, ves_verdict *verdict)
{
    return ask->want & VES_WANT_GRADIENT ? verdict->gradient : NULL;
}

/* n variables around 0.3, in the caller's units */
static inline ves_status quadratic(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const given *problem = data;
    (void)worker;
    double *g = gradient_of(ask, v);
    v->value = 7;
    for (int i = 0; i < problem->n; i++) {
        double d = ask->x[i] - 0.3;
        v->value += (1 + i) * d * d;
        if (g) g[i] = 2 * (1 + i) * d;
    }
    return VES_OK;
}

/* CEC 2006 g06: f* = -6961.81387558015; both constraints active, thin feasible sickle, multipliers of 1e5 */
static inline ves_status g06(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    const double *x = ask->x;
    double p = x[0] - 10, q = x[1] - 20, *g = gradient_of(ask, v);
    v->value = p * p * p + q * q * q;
    v->constraint[0] = (100 - (x[0] - 5) * (x[0] - 5) - (x[1] - 5) * (x[1] - 5)) / 100;
    v->constraint[1] = ((x[0] - 6) * (x[0] - 6) + (x[1] - 5) * (x[1] - 5) - 82.81) / 82.81;
    if (!g) return VES_OK;
    g[0] = 3 * p * p;
    g[1] = 3 * q * q;
    v->jacobian[0] = -2 * (x[0] - 5) / 100;
    v->jacobian[1] = -2 * (x[1] - 5) / 100;
    v->jacobian[2] = 2 * (x[0] - 6) / 82.81;
    v->jacobian[3] = 2 * (x[1] - 5) / 82.81;
    return VES_OK;
}

static const given problem_g06 = {
    .evaluate = g06, .n = 2, .m = 2, .lower = {13, 0}, .upper = {100, 100}, .start = {20.1, 5.84}};

/* The largest closed can of area 3 pi [Ugail 2011, 7.2]: r = 1/sqrt 2, h = sqrt 2, f* = -pi / sqrt 2 */
static inline ves_status can(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double r = ask->x[0], h = ask->x[1], *g = gradient_of(ask, v);
    v->value = -PI * r * r * h;
    v->constraint[0] = (2 * r * h + 2 * r * r - 3) / 3;
    if (!g) return VES_OK;
    g[0] = -2 * PI * r * h;
    g[1] = -PI * r * r;
    v->jacobian[0] = (2 * h + 4 * r) / 3;
    v->jacobian[1] = 2 * r / 3;
    return VES_OK;
}

static const given problem_can = {.evaluate = can,
                                  .n = 2,
                                  .m = 1,
                                  .lower = {0.1, 0.1},
                                  .upper = {2, 5},
                                  .start = {0.31, 2.27},
                                  .equality = {true}};

/* The same with the area as two inequalities and a lid on the height: h = 1.2, r (h + r) = 3 / 2 */
static inline ves_status low_can(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    can(data, worker, ask, v);
    v->constraint[1] = -v->constraint[0];
    v->constraint[2] = (ask->x[1] - 1.2) / 1.2;
    if (!gradient_of(ask, v)) return VES_OK;
    for (int i = 0; i < 2; i++) v->jacobian[2 + i] = -v->jacobian[i];
    v->jacobian[4] = 0;
    v->jacobian[5] = 1 / 1.2;
    return VES_OK;
}

static const given problem_low_can = {
    .evaluate = low_can, .n = 2, .m = 3, .lower = {0.1, 0.1}, .upper = {2, 5}, .start = {0.31, 2.27}};

/* Rosenbrock's valley, any n: f* = 0 at (1, ..., 1) */
static inline ves_status rosenbrock(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const given *problem = data;
    (void)worker;
    const double *x = ask->x;
    double *g = gradient_of(ask, v);
    int n = problem->n;
    v->value = 0;
    for (int i = 0; g && i < n; i++) g[i] = 0;
    for (int i = 0; i < n - 1; i++) {
        double d = x[i + 1] - x[i] * x[i], b = 1 - x[i];
        v->value += 100 * d * d + b * b;
        if (!g) continue;
        g[i] += -400 * d * x[i] - 2 * b;
        g[i + 1] += 200 * d;
    }
    return VES_OK;
}

static inline given problem_rosenbrock(int n)
{
    given g = {.evaluate = rosenbrock, .n = n};
    for (int i = 0; i < n; i++) {
        g.lower[i] = -2;
        g.upper[i] = 2.2;
        g.start[i] = i % 2 ? 0.93 : -1.17;
    }
    return g;
}

/* Rosenbrock's valley in the disk x^2 + y^2 <= 1.5, active at the optimum */
static inline ves_status disk(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    static const given two = {.n = 2};
    (void)data;
    rosenbrock((void *)&two, worker, ask, v);
    double x = ask->x[0], y = ask->x[1];
    v->constraint[0] = (x * x + y * y - 1.5) / 1.5;
    if (!(ask->want & VES_WANT_GRADIENT)) return VES_OK;
    v->jacobian[0] = 2 * x / 1.5;
    v->jacobian[1] = 2 * y / 1.5;
    return VES_OK;
}

static const given problem_disk = {
    .evaluate = disk, .n = 2, .m = 1, .lower = {-2, -2}, .upper = {2, 2}, .start = {-1.13, 0.42}};

/* The least value on the rim, by a fine scan and golden section: an oracle that knows nothing of optimizers.
 */
static inline double disk_least(void)
{
    double low = 0.6, high = 0.9;
    for (int k = 0; k < 200; k++) {
        double t[2] = {low + 0.381966011250105 * (high - low), low + 0.618033988749895 * (high - low)}, f[2];
        for (int e = 0; e < 2; e++) {
            double x = sqrt(1.5) * cos(t[e]), y = sqrt(1.5) * sin(t[e]);
            f[e] = 100 * (y - x * x) * (y - x * x) + (1 - x) * (1 - x);
        }
        if (f[0] < f[1])
            high = t[1];
        else
            low = t[0];
    }
    double x = sqrt(1.5) * cos(low), y = sqrt(1.5) * sin(low);
    return 100 * (y - x * x) * (y - x * x) + (1 - x) * (1 - x);
}

#endif

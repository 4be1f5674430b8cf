/* The search: the annealer's statistics, and what every search promises whatever its stages. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>
#include <stdio.h>

#include "search/point.h"
#include "search/proposal/proposal.h"
#include "search/schedule/schedule.h"
#include "search_problems.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

/* ---- proposals and schedule by themselves ---- */

Test(search, reflection_stays_in_the_box_and_has_period_two)
{
    ves_random random = {.seed = 3};
    for (int k = 0; k < 2000; k++) {
        double u = 20 * (ves_random_uniform(&random) - 0.5), v = ves_point_reflect(u);
        cr_assert(v >= 0 && v <= 1, "%g -> %g", u, v);
        /* u + 2 is rounded to an ulp of numbers up to 12, 2e-15 */
        cr_assert(fabs(v - ves_point_reflect(u + 2)) < 1e-14 && fabs(v - ves_point_reflect(-u)) < 1e-14, "%g",
                  u);
        if (u >= 0 && u <= 1) cr_assert(v == u);
    }
}

/* Plain Metropolis on a descriptor: energies after each trial. */
typedef struct walk {
    const ves_proposal *proposal;
    int n;
    double T, step;
    double (*energy)(int n, const double *u);
    double (*feature)(int n, const double *u);
    bool adapt;
} walk;

enum { BATCHES = 64 };

/* Mean of the feature, its standard error from batch means, and the acceptance. */
static void metropolis(const walk *w, long trials, double *mean, double *error, double *acceptance)
{
    double state[64], u[MOST], v[MOST], batch[BATCHES] = {0};
    w->proposal->init(w->n, w->step, state);
    for (int i = 0; i < w->n; i++) u[i] = 0.5;
    double e = w->energy(w->n, u);
    long accepted = 0, warm = trials / 10, each = trials / BATCHES;
    for (long k = -warm; k < each * BATCHES; k++) {
        ves_random random = {.seed = 5, .chain = 1, .step = (uint64_t)(k + warm)};
        memcpy(v, u, sizeof u);
        w->proposal->propose(w->n, state, &random, v);
        double next = w->energy(w->n, v);
        bool yes = next - e < -w->T * log(ves_random_uniform(&random));
        if (yes) memcpy(u, v, sizeof u), e = next;
        if (w->adapt) w->proposal->adapt(w->n, state, yes);
        if (k < 0) continue;
        accepted += yes;
        batch[k / each] += w->feature(w->n, u) / (double)each;
    }
    *mean = *error = 0;
    for (int b = 0; b < BATCHES; b++) *mean += batch[b] / BATCHES;
    for (int b = 0; b < BATCHES; b++) *error += (batch[b] - *mean) * (batch[b] - *mean);
    *error = sqrt(*error / (BATCHES * (BATCHES - 1.0)));
    *acceptance = (double)accepted / (double)(each * BATCHES);
}

static double well(int n, const double *u)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += (1 + i) * (u[i] - 0.5) * (u[i] - 0.5);
    return sum;
}

/* Boltzmann (7.2) in a quadratic well: mean energy n T / 2. T = 1e-3: a wall is 7 standard deviations away.
 * Four standard errors: one false alarm in 16000. These are 3 % of the mean at most, or the test would say
 * little. */
Test(search, proposals_sample_a_quadratic_well)
{
    const ves_proposal *const proposal[] = {&ves_proposal_gaussian, &ves_proposal_heavy};
    const int size[] = {1, 3, 6};
    for (int p = 0; p < 2; p++)
        for (int k = 0; k < 3; k++) {
            walk w = {proposal[p], size[k], 1e-3, 0.04, well, well, false};
            double mean, error, acceptance, want = 0.5 * size[k] * w.T;
            metropolis(&w, 600000, &mean, &error, &acceptance);
            cr_expect(error < 0.03 * want, "%s n %d: standard error %g of %g", proposal[p]->name, size[k],
                      error, want);
            cr_expect(fabs(mean - want) < 4 * error, "%s n %d: got %g, want %g +- %g", proposal[p]->name,
                      size[k], mean, want, error);
        }
}

static double two_wells(int n, const double *u)
{
    (void)n;
    double x = 4 * u[0] - 2; /* [-2, 2] */
    return (x * x - 1) * (x * x - 1) + 0.2 * x;
}

static double is_left(int n, const double *u)
{
    (void)n;
    return u[0] < 0.5;
}

/* Populations of a double well, walls included, against the integral of e^{-E/T} by Simpson's rule. */
Test(search, proposals_fill_a_double_well_as_boltzmann_says)
{
    const ves_proposal *const proposal[] = {&ves_proposal_gaussian, &ves_proposal_heavy};
    const double T = 0.4;
    double left = 0, all = 0;
    enum { N = 4000 };
    for (int k = 0; k <= N; k++) {
        double u = (double)k / N, weight = k == 0 || k == N ? 1 : k % 2 ? 4 : 2;
        double p = weight * exp(-two_wells(1, &u) / T);
        all += p;
        left += k < N / 2 ? p : k == N / 2 ? p / 2 : 0;
    }
    for (int p = 0; p < 2; p++) {
        walk w = {proposal[p], 1, T, 0.3, two_wells, is_left, false};
        double mean, error, acceptance;
        metropolis(&w, 400000, &mean, &error, &acceptance);
        /* as above: a sharper bound than the share itself, which is of the size of 1 */
        cr_expect(error < 0.01, "%s: standard error %g", proposal[p]->name, error);
        cr_expect(fabs(mean - left / all) < 4 * error, "%s: got %g, want %g +- %g", proposal[p]->name, mean,
                  left / all, error);
    }
}

/* Widths that begin a hundred times too small or too large end where the acceptance is the target, 0.44 for
 * one coordinate. */
Test(search, adapted_widths_meet_the_target_acceptance)
{
    const double step[] = {1e-4, 1};
    for (int k = 0; k < 2; k++) {
        walk w = {&ves_proposal_gaussian, 1, 1e-3, step[k], well, well, true};
        double mean, error, acceptance;
        metropolis(&w, 200000, &mean, &error, &acceptance);
        cr_expect(fabs(acceptance - 0.44) < 0.01, "from %g: %g", step[k],
                  acceptance); /* some standard errors of 1e-3 */
    }
}

Test(search, schedule_is_equation_7_3)
{
    const double s[] = {0, 0.3, 0.9, 0.999};
    const long budget[] = {1, 7, 100, 5000, 1000000};
    for (int k = 0; k < 4; k++)
        for (int b = 0; b < 5; b++) {
            ves_anneal options = ves_anneal_default();
            options.s = s[k];
            options.c_end = 1e-4;
            ves_cooling c;
            ves_schedule_exponential.init(&options, 2.5, 9, budget[b], &c);
            cr_assert(c.trials >= 1 && c.temperatures * c.trials <= budget[b], "s %g, budget %ld", s[k],
                      budget[b]);
            cr_assert(c.s > 0 && c.s < 1);
            if (s[k] > 0) cr_assert(c.s == s[k]);
            for (int m = 0; m < 20; m++) {
                double got = ves_schedule_exponential.temperature(&c, m), want = 2.5 * exp((c.s - 1) * m);
                cr_assert(fabs(got - want) <= 1e-15 * want); /* rounding */
            }
            double last = ves_schedule_exponential.temperature(&c, c.temperatures - 1);
            /* rounding of the exponent: 5e-14 was seen */
            if (k == 0 && budget[b] >= 100)
                cr_expect(fabs(last / c.c_end - 1) < 1e-12, "ends at %g, want %g", last, c.c_end);
            if (k == 2 && budget[b] >= 5000) cr_expect(last <= c.c_end, "s 0.9 ends at %g", last);
        }
}

/* ---- the annealer ---- */

/* quadratic in n variables around 0.3, in the caller's units */
static ves_status bowl(void *data, int worker, const ves_ask *ask, ves_verdict *v)
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

static given problem_bowl(int n)
{
    given g = {.evaluate = bowl, .n = n};
    for (int i = 0; i < n; i++) g.lower[i] = -8, g.upper[i] = 9, g.start[i] = 0.3;
    return g;
}

/* The whole chain at a fixed temperature and a fixed step: n T / 2 above the bottom, and the variance n T^2 /
 * 2 (7.2). The standard error comes from 16 seeds. */
Test(search, chains_at_one_temperature_are_in_equilibrium)
{
    enum { N = 3, SEEDS = 16 };
    const double T = 0.1;
    given g = problem_bowl(N);
    g.data = &g;
    double mean = 0, square = 0, variance = 0;
    for (int k = 0; k < SEEDS; k++) {
        ves_search_options o = only_anneal(80000);
        ves_anneal *a = &o.stage[0].anneal;
        o.seed = (uint64_t)k;
        a->c0 = T, a->c_end = 1, a->s = 0.5, a->fixed = true, a->step = 0.02;
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        cr_assert(r->temperatures == 1 && r->temperature[0].c == T, "%d temperatures", r->temperatures);
        double energy = r->temperature[0].mean - 7;
        mean += energy / SEEDS;
        square += energy * energy / SEEDS;
        variance += r->temperature[0].variance / SEEDS;
        cr_expect(r->temperature[0].trials > 79000 && r->temperature[0].accepted > 20000);
        ves_search_result_destroy(r);
    }
    double error = sqrt((square - mean * mean) / (SEEDS - 1));
    cr_expect(fabs(mean - N * T / 2) < 4 * error, "got %g, want %g +- %g", mean, N * T / 2, error);
    cr_expect(error < 0.02 * mean, "standard error %g", error); /* or the line above would say little */
    cr_expect(fabs(variance / (N * T * T / 2) - 1) < 0.1, "variance %g",
              variance); /* four times its spread over seeds */
}

static int count_feasible(const given *g, long evaluations, double want, double within)
{
    int hits = 0;
    for (uint64_t seed = 1; seed <= 10; seed++) {
        ves_search_options o = only_anneal(evaluations);
        o.seed = seed;
        ves_search_result *r;
        cr_assert(eq(int, run(g, &o, NULL, &r), VES_OK));
        hits += r->feasible && fabs(r->value - want) < within;
        ves_search_result_destroy(r);
    }
    return hits;
}

/* Without any polish: the penalty found from the data leads to feasible ends near the optimum. */
Test(search, annealing_alone_solves_constrained_problems)
{
    int disks = count_feasible(&problem_disk, 40000, disk_least(), 1e-3);
    cr_expect(eq(int, disks, 10));
}

/* Frozen, with temperatures that follow (7.3) and an acceptance that goes down. */
Test(search, annealing_reports_itself)
{
    given g = problem_bowl(4);
    g.data = &g;
    ves_search_options o = only_anneal(8000);
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    cr_assert(r->temperatures > 20, "%d", r->temperatures);
    double ratio = r->temperature[1].c / r->temperature[0].c;
    for (int m = 1; m < r->temperatures; m++) /* powers of one number: rounding, 1e-15 was seen */
        cr_assert(fabs(r->temperature[m].c / r->temperature[m - 1].c - ratio) < 1e-12);
    const ves_temperature *first = &r->temperature[0], *last = &r->temperature[r->temperatures - 1];
    cr_expect(fabs(last->c / first->c - 1e-4) < 1e-12);
    cr_expect(last->mean < 1e-2 * first->mean + 7 && last->variance < first->variance);
    cr_expect(strstr(r->stop, "frozen") != NULL, "%s", r->stop);
    /* of the order of the last temperature, 1e-4 of the first; 0 was seen */
    cr_expect(fabs(r->value - 7) < 1e-3, "%g", r->value);
    ves_search_result_destroy(r);

    o.stage[0].anneal.s = 0.99; /* needs 922 temperatures */
    o.stage[0].anneal.evaluations = 400;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    cr_expect(r->notes == 1 && strstr(r->note[0], "too short") != NULL);
    ves_search_result_destroy(r);
}

/* An evaluator that stops at the cutoff changes no decision: what it cut would have been rejected. */
typedef struct cutting {
    bool cuts;
    long cut;
} cutting;

static ves_status cut_disk(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    cutting *c = data;
    disk(NULL, worker, ask, v);
    double excess = v->constraint[0] > 0 ? v->constraint[0] : 0;
    if (excess <= ask->cutoff || !c->cuts) return VES_OK;
    c->cut++;
    return VES_CUT;
}

Test(search, a_cut_candidate_would_have_been_rejected)
{
    cutting c[2] = {{false, 0}, {true, 0}};
    double value[2], x[2];
    for (int k = 0; k < 2; k++) {
        given g = problem_disk;
        g.evaluate = cut_disk;
        g.data = &c[k];
        ves_search_options o = only_anneal(8000);
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        value[k] = r->value;
        x[k] = r->x[0];
        cr_expect(eq(int, (int)r->failed, 0)); /* cut is not failed */
        ves_search_result_destroy(r);
    }
    cr_expect(c[1].cut > 100, "only %ld were cut", c[1].cut);
    cr_expect(value[0] == value[1] && x[0] == x[1], "%.17g and %.17g", value[0], value[1]);
}

/* ---- global search ---- */

/* Rastrigin's function with its optimum off centre: 11^n minima */
static ves_status rastrigin(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const given *problem = data;
    (void)worker;
    double *g = gradient_of(ask, v);
    v->value = 0;
    for (int i = 0; i < problem->n; i++) {
        double d = ask->x[i] - 0.7 + 0.31 * i;
        v->value += d * d - 10 * cos(2 * PI * d) + 10;
        if (g) g[i] = 2 * d + 20 * PI * sin(2 * PI * d);
    }
    return VES_OK;
}

Test(search, auto_finds_the_global_optimum)
{
    for (int gradients = 0; gradients < 2; gradients++) {
        given g = {.evaluate = rastrigin, .n = 5, .gradients = gradients, .data = &g};
        for (int i = 0; i < g.n; i++) g.lower[i] = -5.12, g.upper[i] = 5.12, g.start[i] = 3.3;
        int hits = 0;
        for (uint64_t seed = 1; seed <= 10; seed++) {
            ves_search_options o = ves_search_options_default();
            o.seed = seed;
            ves_search_result *r;
            cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
            hits += r->value < 1e-9; /* polished; the next best minimum is at 0.99 */
            ves_search_result_destroy(r);
        }
        cr_expect(hits >= 9, "gradients %d: %d of 10", gradients, hits);
    }
}

/* x^4/4 - x^2/2 + x/20 in each of two variables: four minima, all listed, best first */
static ves_status four(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double *g = gradient_of(ask, v);
    v->value = 0;
    for (int i = 0; i < 2; i++) {
        double x = ask->x[i];
        v->value += x * x * x * x / 4 - x * x / 2 + x / 20;
        if (g) g[i] = x * x * x - x + 0.05;
    }
    return VES_OK;
}

Test(search, distinct_optima_are_listed_best_first)
{
    given g = {
        .evaluate = four, .n = 2, .lower = {-2, -2}, .upper = {2, 2}, .start = {1, 1}, .gradients = true};
    ves_search_options o = ves_search_options_default();
    o.stages = 2;
    o.stage[0] = (ves_stage){.kind = VES_STAGE_ANNEAL, .anneal = ves_anneal_default()};
    o.stage[0].anneal.chains = 24; /* quenched: ends everywhere */
    o.stage[0].anneal.evaluations = 1600;
    o.stage[0].anneal.c0 = 1e-3;
    o.stage[1] = (ves_stage){.kind = VES_STAGE_POLISH, .polish = ves_polish_default()};
    ves_search_result *r;
    int most = 0;
    for (uint64_t seed = 1; seed <= 5; seed++) {
        o.seed = seed;
        for (int i = 0; i < 2; i++) g.start[i] = seed % 2 ? 0.03 : -0.02;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        int hits = 0;
        for (int k = 0; k < r->optima; k++) {
            hits += r->optimum[k].hits;
            cr_expect(k == 0 || r->optimum[k].value >= r->optimum[k - 1].value);
        }
        cr_expect(r->optimum[0].value == r->value && r->optima <= 4 && hits >= 20, "%d optima, %d hits",
                  r->optima, hits);
        if (r->optima > most) most = r->optima;
        ves_search_result_destroy(r);
    }
    cr_expect(most >= 2, "%d", most);
}

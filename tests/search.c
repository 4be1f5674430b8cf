/* The search: the annealer as a whole, and what every search promises whatever its stages. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>
#include <stdio.h>

#include "base/random.h"
#include "search/point.h"
#include "search_problems.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

/* ---- the box ---- */

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

/* ---- the annealer ---- */

static given problem_bowl(int n)
{
    given g = {.evaluate = quadratic, .n = n};
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
    o.stage[0].anneal.c_end = 1e-4;
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    cr_assert(r->temperatures > 20, "%d", r->temperatures);
    double ratio = r->temperature[1].c / r->temperature[0].c;
    for (int m = 1; m < r->temperatures; m++) { /* powers of one number: rounding, 1e-15 was seen */
        const ves_temperature *t = &r->temperature[m];
        bool again = t->leg != t[-1].leg;
        if (again) ratio = t[1].c / t->c;
        cr_assert(again ? t->c == r->temperature[0].c : fabs(t->c / t[-1].c - ratio) < 1e-12);
    }
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

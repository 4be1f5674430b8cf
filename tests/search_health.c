/* What an annealing says of itself: heat capacities with a known peak, and a log that does not grow with the budget. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "search_problems.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

/* Two levels, 0 in a part of the range and 1 in the rest. Of that, with g states above for each below, the heat
 * capacity is p (1 - p) / c^2, p = g e^{-1/c} / (1 + g e^{-1/c}): Schottky's, with its peak at 0.417 for g = 1. */
static ves_status levels(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    v->value = ask->x[0] < *(const double *)data ? 0 : 1;
    return VES_OK;
}

static double schottky(double part)
{
    double most = 0, at = 0, g = (1 - part) / part;
    for (double c = 0.05; c < 3; c *= 1.0001) {
        double boltzmann = g * exp(-1 / c), p = boltzmann / (1 + boltzmann), capacity = p * (1 - p) / (c * c);
        if (capacity > most) most = capacity, at = c;
    }
    return at;
}

static ves_search_result *annealed(given *g, const char *schedule, const char *proposal, double c0,
                                   uint64_t seed)
{
    ves_search_options o = only_anneal(800000);
    ves_anneal *a = &o.stage[0].anneal;
    ves_search_result *r;
    a->schedule = schedule, a->proposal = proposal, a->c0 = c0, a->c_end = 1e-4;
    o.seed = seed;
    cr_assert(eq(int, run(g, &o, NULL, &r), VES_OK));
    return r;
}

static given problem_levels(double *part)
{
    return (given){.evaluate = levels, .n = 1, .lower = {0}, .upper = {1}, .start = {0.93}, .data = part};
}

Test(search_health, the_heat_capacity_has_schottkys_peak)
{
    for (uint64_t seed = 1; seed <= 5; seed++)
        for (int k = 0; k < 2; k++) {
            double part = k ? 0.1 : 0.5;
            given g = problem_levels(&part);
            ves_search_result *r = annealed(&g, "book", "heavy", 10, seed);
            double off = log(r->annealing[0].peak / schottky(part));
            cr_expect(fabs(off) < 0.25, "seed %d: %g, want %g", (int)seed, r->annealing[0].peak,
                      schottky(part));
            ves_search_result_destroy(r);
        }
}

/* Annealed from below the peak, or from little above it, the heat capacity is largest at the first temperatures: whether
 * it falls beyond them nobody has seen. */
Test(search_health, an_edge_is_no_peak)
{
    static const double c0[] = {0.2, 0.3, 0.42};
    for (uint64_t seed = 1; seed <= 3; seed++)
        for (size_t k = 0; k < sizeof c0 / sizeof *c0; k++) {
            double part = 0.5;
            given g = problem_levels(&part);
            ves_search_result *r = annealed(&g, "book", "heavy", c0[k], seed);
            cr_expect(isnan(r->annealing[0].peak), "seed %d, from %g: %g", (int)seed, c0[k],
                      r->annealing[0].peak);
            ves_search_result_destroy(r);
        }
}

/* The first temperatures of the legs behind the first are those of the peak. */
Test(search_health, reheating_begins_at_the_peak)
{
    for (uint64_t seed = 1; seed <= 5; seed++) {
        double part = 0.5;
        given g = problem_levels(&part);
        ves_search_result *r = annealed(&g, "reheat", "heavy", 10, seed);
        cr_expect(r->annealing[0].legs >= 6, "%d legs", r->annealing[0].legs);
        for (int k = 1; k < r->temperatures; k++) {
            const ves_temperature *t = &r->temperature[k];
            if (t->leg == t[-1].leg) continue;
            cr_expect(fabs(log(t->c / schottky(part))) < 0.5, "seed %d, leg %d from %g", (int)seed, t->leg,
                      t->c);
        }
        ves_search_result_destroy(r);
    }
}

static ves_status rastrigin(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const given *problem = data;
    (void)worker;
    v->value = 0;
    for (int i = 0; i < problem->n; i++) {
        double d = ask->x[i] - 0.7 + 0.31 * i;
        v->value += d * d - 10 * cos(2 * PI * d) + 10;
    }
    return VES_OK;
}

/* Where chains freeze in different basins what lies between them is no heat capacity: it would be the larger the colder
 * it is. In equilibrium this one has peaks at 0.5 and 0.05 of c0. */
Test(search_health, chains_that_are_apart_do_not_count_as_heat)
{
    int high = 0, legs = 0;
    for (uint64_t seed = 1; seed <= 5; seed++) {
        given g = {.evaluate = rastrigin, .n = 5};
        for (int i = 0; i < 5; i++) g.lower[i] = -5.12, g.upper[i] = 5.12, g.start[i] = 3.3;
        g.data = &g;
        ves_search_options o = only_anneal(120000);
        ves_anneal *a = &o.stage[0].anneal;
        a->schedule = "reheat", a->c_end = 1e-4;
        o.seed = seed;
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        for (int k = 1; k < r->temperatures; k++) {
            const ves_temperature *t = &r->temperature[k];
            legs += t->leg > t[-1].leg;
            high += t->leg > t[-1].leg && t->c > 0.01 * r->annealing[0].c0;
        }
        ves_search_result_destroy(r);
    }
    cr_expect(legs >= 25 && high >= legs - 4, "%d of %d legs begin above 0.01 c0", high, legs);
    given g = {.evaluate = quadratic, .n = 2, .lower = {-2, -2}, .upper = {2, 2}, .start = {1.1, 1.1}};
    g.data = &g;
    ves_search_result *r = annealed(&g, "book", "mixture", 0, 1);
    cr_expect(isnan(r->annealing[0].peak), "a bowl has none, n / 2 everywhere: %g", r->annealing[0].peak);
    ves_search_result_destroy(r);
}

/* Lines of the log, and the temperatures and trials that they stand for. */
static int lines(const char *as, const char *schedule, double s, long *steps)
{
    given g = {.evaluate = quadratic, .n = 2, .lower = {-2, -2}, .upper = {2, 2}, .start = {1.1, 1.1}};
    const long evaluations = 400000;
    ves_search_options o = only_anneal(evaluations);
    ves_anneal *a = &o.stage[0].anneal;
    ves_search_result *r;
    a->as = as, a->schedule = schedule, a->s = s, a->c0 = 1, a->proposal = "fixed", a->step = 0.02,
    a->c_end = 1e-3;
    g.data = &g;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    int count = r->temperatures;
    long trials = 0;
    double most = HUGE_VAL;
    *steps = 0;
    for (int k = 0; k < count; k++) {
        const ves_temperature *t = &r->temperature[k];
        *steps += t->steps;
        trials += t->trials;
        cr_assert(strcmp(schedule, "book") || t->c < most);
        most = t->c;
    }
    cr_expect(trials == r->annealing[0].count[0].trials && trials > evaluations / 2, "%ld trials", trials);
    ves_search_result_destroy(r);
    return count;
}

Test(search_health, the_log_does_not_grow_with_the_budget)
{
    long steps;
    int count = lines(NULL, "book", 0, &steps);
    cr_expect(count > 100 && count <= 200 && steps == count, "%d lines, %ld temperatures", count, steps);
    count = lines(NULL, "book", 0.998, &steps); /* given: all of them are gone through */
    cr_expect(count > 100 && count <= 200 && steps > 2000, "%d lines, %ld temperatures", count, steps);
    count = lines("book", "book", 0, &steps);
    cr_expect(count > 100 && count <= 200 && steps > 2000, "%d lines, %ld temperatures", count, steps);
    count = lines(NULL, "lam", 0, &steps);
    cr_expect(count > 100 && count <= 200 && steps > 2000, "%d lines, %ld temperatures", count, steps);
}

/* The width that is told is that of the steps at that temperature. */
Test(search_health, the_width_of_tsallis_falls_with_the_temperature)
{
    given g = {.evaluate = quadratic, .n = 2, .lower = {-2, -2}, .upper = {2, 2}, .start = {1.1, 1.1}};
    g.data = &g;
    ves_search_result *r = annealed(&g, "book", "tsallis", 1, 1);
    for (int k = 0; k < r->temperatures; k++) {
        const ves_temperature *t = &r->temperature[k];
        double want = fmax(0.1 * pow(t->c, 1 / 0.38), 1e-9);
        cr_assert(fabs(t->move[0].width / want - 1) < 1e-9, "%g: %g, want %g", t->c, t->move[0].width, want);
    }
    ves_search_result_destroy(r);
}

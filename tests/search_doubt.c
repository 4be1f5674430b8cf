/* Gradients that are not those of the values are told, right ones never are. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>
#include <stdio.h>

#include "search_problems.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

enum { N = 4 };

typedef struct liar {
    given g;
    ves_status (*honest)(void *, int, const ves_ask *, ves_verdict *);
    double factor;        /* of all slopes */
    int forgets, flips;   /* a variable whose slope is 0, or has the wrong sign; -1: none */
    double row;           /* factor of the constraint's slopes */
    double offset, scale; /* of the value */
    bool single;          /* the value is of single precision */
    double noise;
    long asked;
} liar;

static ves_status lie(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    liar *l = data;
    ves_status status = l->honest(&l->g, worker, ask, v);
    double *g = gradient_of(ask, v);
    l->asked++;
    v->value = l->offset + l->scale * v->value;
    v->value += l->noise * sin(1e9 * ask->x[0]);
    if (l->single) v->value = (float)v->value;
    for (int i = 0; g && i < l->g.n; i++) {
        g[i] *= l->scale * l->factor * (i == l->forgets ? 0 : i == l->flips ? -1 : 1);
        if (l->g.m) v->jacobian[i] *= l->row;
    }
    return status;
}

static liar true_of(given g)
{
    liar l = {.g = g, .honest = g.evaluate, .factor = 1, .forgets = -1, .flips = -1, .row = 1, .scale = 1};
    l.g.gradients = true;
    return l;
}

/* The note, or "". */
static const char *doubted(liar *l, bool polish, uint64_t seed, long evaluations)
{
    static char note[600];
    given g = l->g;
    g.evaluate = lie, g.data = l, l->asked = 0;
    ves_search_options o = polish ? only_polish("slsqp") : ves_search_options_default();
    o.seed = seed;
    o.evaluations = evaluations;
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    const char *text = noted(r, "seems to be wrong");
    snprintf(note, sizeof note, "%s", text ? text : "");
    cr_expect(r->evaluations == l->asked && r->evaluations <= r->budget, "%ld, %ld asked, of %ld",
              r->evaluations, l->asked, r->budget);
    ves_search_result_destroy(r);
    return note;
}

Test(search_doubt, wrong_gradients_are_told)
{
    for (uint64_t seed = 1; seed <= 3; seed++)
        for (int polish = 0; polish < 2; polish++)
            for (int k = 0; k < 6; k++) {
                liar l = true_of(k == 5 ? problem_disk : problem_rosenbrock(N));
                if (k == 0) l.factor = 10;
                if (k == 1) l.factor = -1;
                if (k == 2) l.factor = 1.05;
                if (k == 3) l.forgets = 2;
                if (k == 4) l.flips = 1;
                if (k == 5) l.row = 10;
                const char *want = k == 5 ? "gradient of constraint 1 seems to be wrong"
                                          : "the gradient seems to be",
                           *got = doubted(&l, polish, seed, polish ? 0 : 3000);
                cr_expect(strstr(got, want) != NULL, "%d, seed %d, polish %d: \"%s\"", k, (int)seed, polish,
                          got);
            }
}

/* The two numbers are slopes: of a factor of ten one is ten times the other. */
Test(search_doubt, both_slopes_are_told)
{
    liar l = true_of(problem_rosenbrock(N));
    l.factor = 10;
    const char *note = doubted(&l, true, 1, 0), *at = strstr(note, "value is ");
    double by, of;
    cr_assert(at && sscanf(at, "value is %lf by differences and %lf by the gradient", &by, &of) == 2, "%s",
              note);
    cr_expect(fabs(of / by - 10) < 1e-3, "%g and %g", by, of);
}

/* |x - 0.3| in each variable; a root with an edge; a valley with waves of a fiftieth of the box. */
static ves_status kinks(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const given *problem = data;
    double *g = gradient_of(ask, v);
    (void)worker;
    v->value = 0;
    for (int i = 0; i < problem->n; i++) {
        v->value += fabs(ask->x[i] - 0.3);
        if (g) g[i] = ask->x[i] > 0.3 ? 1 : -1;
    }
    return VES_OK;
}

static ves_status edge(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    quadratic(data, worker, ask, v);
    double *g = gradient_of(ask, v);
    v->value += sqrt(ask->x[0] - 0.1);
    if (g) g[0] += 0.5 / sqrt(ask->x[0] - 0.1);
    return VES_OK;
}

static ves_status waves(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const given *problem = data;
    quadratic(data, worker, ask, v);
    double *g = gradient_of(ask, v);
    for (int i = 0; i < problem->n; i++) {
        v->value += cos(80 * ask->x[i]);
        if (g) g[i] -= 80 * sin(80 * ask->x[i]);
    }
    return VES_OK;
}

static given problem_of(ves_status (*evaluate)(void *, int, const ves_ask *, ves_verdict *), double start)
{
    given g = {.evaluate = evaluate, .n = N};
    for (int i = 0; i < N; i++) g.lower[i] = -2, g.upper[i] = 2, g.start[i] = start;
    return g;
}

Test(search_doubt, right_gradients_are_not_doubted)
{
    for (uint64_t seed = 1; seed <= 8; seed++) {
        for (int k = 0; k < 16; k++) {
            liar l = true_of(problem_rosenbrock(N));
            if (k == 1) l.offset = 1e9;
            if (k == 2) l.scale = 1e-12;
            if (k == 3) l.scale = 1e15;
            if (k == 4) l.single = true;
            if (k == 5) l.single = true, l.offset = 1e5;
            if (k == 6) l.noise = 1e-7;
            if (k == 7) l.noise = 1e-2;
            if (k == 8) l.noise = 1;
            if (k == 9) l = true_of(problem_of(kinks, 0.3));
            if (k == 10) l = true_of(problem_of(edge, 0.1));
            if (k == 11) l = true_of(problem_of(edge, 0.1005));
            if (k == 12) l = true_of(problem_of(waves, 0.3));
            if (k == 13) l = true_of(problem_of(quadratic, 0.3));
            if (k == 14) l = true_of(problem_of(quadratic, -2));
            if (k == 15) l = true_of(problem_g06);
            const char *got = doubted(&l, true, seed, 400);
            cr_expect(got[0] == 0, "%d, seed %d: %s", k, (int)seed, got);
        }
        liar l = true_of(problem_disk);
        cr_expect(doubted(&l, false, seed, 600)[0] == 0);
    }
}

/* Too few evaluations are for the search. */
Test(search_doubt, a_small_budget_is_not_spent_on_doubts)
{
    for (long budget = 1; budget < 60; budget++) {
        liar l = true_of(problem_rosenbrock(N));
        l.factor = 10;
        doubted(&l, budget % 2, 1, budget);
    }
}

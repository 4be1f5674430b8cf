/* A grid chosen at the start design that is too coarse for the best. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "vesica/run.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#define PI 3.14159265358979323846

/* Of all tori, the Willmore energy is least for R = sqrt(2) r: 2 pi^2. A thin one needs fewer nodes. */
#define TORI                                                                                                 \
    "vesica: 1\nvariables: {R: [1.1, 3, 5]}\npatches:\n  t:\n    surface: {formula: [\"(R + "                \
    "cos(u))*cos(v)\", \"(R + cos(u))*sin(v)\", \"sin(u)\"]}\n    domain: {u: [0, 2*pi], v: [0, 2*pi]}\n"    \
    "shape: {closed: true}\nmeasures: {hh: {integral: \"H^2\"}}\n"
#define TORUS TORI "minimize: hh\n"

#define CHAINS "search: [{anneal: {chains: 16}}, {polish: {}}]\n"

typedef struct trial {
    ves_problem *problem;
    ves_run *run;
} trial;

static trial run_with(const char *text, const ves_run_options *options)
{
    trial t = {0};
    cr_assert(ves_problem_read_text("test.yaml", text, strlen(text), NULL, &t.problem, NULL) == VES_OK);
    cr_assert(ves_run_create(t.problem, options, NULL, &t.run, NULL) == VES_OK);
    return t;
}

static void finish(trial *t)
{
    ves_run_destroy(t->run);
    ves_problem_destroy(t->problem);
}

static bool noted(const ves_run *run, const char *words)
{
    for (int k = 0; k < run->notes; k++)
        if (strstr(run->note[k], words)) return true;
    return false;
}

static double off(const ves_run *run)
{
    return fabs(run->best.objective / (2 * PI * PI) - 1);
}

Test(settle, the_grid_is_chosen_again_at_the_best)
{
    trial one = run_with(TORUS, &(ves_run_options){.jobs = 1}),
          two = run_with(TORUS, &(ves_run_options){.jobs = 2});
    const ves_run *a = one.run, *b = two.run;
    cr_expect(a->quadrature[0] > 16 && noted(a, "chosen at the best"), "%d x %d", a->quadrature[0],
              a->quadrature[1]);
    cr_expect(a->feasible && a->finer_change < 1e-9 && a->change <= 1e-9, "%g", a->finer_change);
    cr_expect(off(a) < 1e-9, "off by %g", off(a)); /* what the choice of a grid allows */
    cr_expect(fabs(a->best.x[0] - sqrt(2)) < 1e-6, "%.9g",
              a->best.x[0]); /* rounding of the value, its root */
    cr_expect(a->optima >= 1 && a->optimum[0].value == a->best.objective && a->optimum[0].hits > 1);
    cr_expect(fabs(a->start.objective / (PI * PI * 9 / sqrt(8)) - 1) < 1e-9, "%.12g", a->start.objective);
    /* the same for any number of jobs */
    cr_expect(a->best.x[0] == b->best.x[0] && a->best.objective == b->best.objective);
    cr_expect(a->evaluations == b->evaluations && a->gradients == b->gradients && a->notes == b->notes);
    finish(&one);
    finish(&two);
}

/* The last polish counts no descents of its own, but it is the one that tells of the slope: here it ends at a kink. */
Test(settle, the_verdict_is_that_of_the_finer_grid_with_the_counts_of_the_coarser)
{
#define STARTS "search: [{auto: starts}, {polish: {}}]\n"
    static const char *const text[] = {TORUS STARTS, TORI "minimize: hh + 30*abs(R - 1.4)\n" STARTS};
    static const ves_trust trust[] = {VES_TRUST_REPEATED, VES_TRUST_KINK};
    for (int k = 0; k < 2; k++) {
        trial t = run_with(text[k], &(ves_run_options){.jobs = 1, .evaluations = 2000});
        const ves_evidence *e = &t.run->evidence;
        cr_expect(noted(t.run, "chosen at the best"), "%d x %d", t.run->quadrature[0], t.run->quadrature[1]);
        cr_expect(e->trust == trust[k] && e->hits > 1 && e->descents >= e->hits, "%d: %s", e->trust,
                  e->sentence);
        cr_expect(strstr(e->sentence, "independent descents ended there") &&
                      !strstr(e->sentence, "no independent"),
                  "%s", e->sentence);
        cr_expect(k == 0 || fabs(t.run->best.x[0] - 1.4) < 1e-6, "%g", t.run->best.x[0]);
        finish(&t);
    }
}

Test(settle, a_search_that_cannot_go_on_says_which_grid_to_give)
{
    static const struct {
        const char *text;
        long evaluations;
        const char *want;
    } given[] = {
        {TORUS "quadrature: {u: 16, v: 16}\n", 300, "give quadrature: {u: 40, v: 16}"},
        {TORUS "quadrature: {u: 16}\n", 300, "give quadrature: {u: 40, v: 16}"},
        {TORUS "search: [{anneal: {evaluations: 400}}]\n", 400, "give quadrature: {u: "},
        {TORUS, 50, "give quadrature: {u: "}, /* nothing is left of the budget */
    };
    for (int k = 0; k < 4; k++) {
        trial t = run_with(given[k].text, &(ves_run_options){.jobs = 1, .evaluations = given[k].evaluations});
        const ves_run *run = t.run;
        cr_expect(noted(run, "unsettled by") && noted(run, given[k].want), "%d: %d notes: %s", k, run->notes,
                  run->notes ? run->note[0] : "");
        cr_expect(run->quadrature[0] < 40 && run->evaluations <= given[k].evaluations);
        finish(&t);
    }
    trial t =
        run_with(TORUS "quadrature: {u: 40, v: 16}\n", &(ves_run_options){.jobs = 1, .evaluations = 400});
    cr_expect(off(t.run) < 1e-9 && !noted(t.run, "unsettled"));
    finish(&t);
}

Test(settle, the_budget_is_for_both_searches)
{
    int again = 0;
    for (long budget = 20; budget <= 500; budget += 60) {
        trial t = run_with(TORUS CHAINS, &(ves_run_options){.jobs = 1, .evaluations = budget});
        cr_expect(t.run->evaluations <= budget, "%ld of %ld", t.run->evaluations, budget);
        again += noted(t.run, "chosen at the best");
        finish(&t);
    }
    cr_expect(again > 2, "chosen again %d times", again);
}

/* A budget that is the sum of those of the stages, the start and 16 proofs. */
Test(settle, budgets_of_stages_are_for_both_searches)
{
    int again = 0;
    for (int anneal = 0; anneal < 2; anneal++)
        for (int polish = 20; polish <= 180; polish += 40) {
            char text[1000];
            snprintf(text, sizeof text, TORUS "search: [%s{polish: {algorithm: cobyla, evaluations: %d}}]\n",
                     anneal ? "{anneal: {evaluations: 150}}, " : "", polish);
            trial t = run_with(text, &(ves_run_options){.jobs = 1});
            long budget = 150 * anneal + polish + 1 + 16;
            cr_expect(t.run->evaluations <= budget, "%ld of %ld", t.run->evaluations, budget);
            again += noted(t.run, "chosen at the best");
            finish(&t);
        }
    cr_expect(again > 2, "chosen again %d times", again);
}

/* Tori no thicker than a wide tolerance allows, and two wells in y: at R = 1.3 + 0.01 y the Willmore energy is
 * pi^2 R^2 / sqrt(R^2 - 1), and y^2 is near 1/4. */
#define WELLS                                                                                                \
    "vesica: 1\nvariables: {R: [1.1, 3, 5], y: [-1, 0.1, 1]}\npatches:\n  t:\n    surface: {formula: [\"(R " \
    "+ cos(u))*cos(v)\", \"(R + cos(u))*sin(v)\", \"sin(u)\"]}\n    domain: {u: [0, 2*pi], v: [0, "          \
    "2*pi]}\nshape: {closed: true}\nmeasures: {hh: {integral: \"H^2\"}}\n"                                   \
    "minimize: hh + 20*(y^2-0.25)^2 + 0.01*y\n"                                                              \
    "constraints: [{require: R <= 1.3 + y*0.01, within: 0.01}]\n"

static double well(double y)
{
    double r = 1.3 + 0.01 * y, d = y * y - 0.25;
    return PI * PI * r * r / sqrt(r * r - 1) + 20 * d * d + 0.01 * y;
}

/* The least near y, by golden section. */
static double well_least(double low, double high)
{
    for (int k = 0; k < 200; k++) {
        double a = low + 0.381966011250105 * (high - low), b = low + 0.618033988749895 * (high - low);
        if (well(a) < well(b))
            high = b;
        else
            low = a;
    }
    return well(low);
}

Test(settle, optima_are_polished_and_measured_on_the_finer_grid)
{
    trial t = run_with(WELLS CHAINS, &(ves_run_options){.jobs = 2});
    const ves_run *run = t.run;
    cr_assert(noted(run, "chosen at the best") && run->feasible);
    cr_assert(eq(int, run->optima, 2));
    const double want[] = {well_least(0.3, 0.7), well_least(-0.7, -0.3)};
    const int least = want[0] < want[1] ? 0 : 1;
    const ves_plan_options grid = {{run->quadrature[0], run->quadrature[1]}};
    ves_plan *plan;
    cr_assert(ves_plan_create(t.problem, &grid, &plan, NULL) == VES_OK);
    int hits = 0;
    for (int k = 0; k < 2; k++) {
        const ves_optimum *o = &run->optimum[k];
        ves_design design;
        cr_assert(ves_plan_measure(plan, o->x, 0, &design) == VES_OK);
        cr_expect(design.objective == o->value && design.violation == o->violation && design.feasible);
        /* 1e-6 of the violation is rounding, a ten-thousandth of `within`; the multiplier is 12, the grid 1e-9 */
        cr_expect(fabs(o->value - want[k == 0 ? least : 1 - least]) < 2e-5, "%.12g", o->value);
        cr_expect(o->violation <= 1e-6, "%g", o->violation);
        hits += o->hits;
    }
    cr_expect(run->optimum[0].value == run->best.objective && run->optimum[0].value <= run->optimum[1].value);
    cr_expect(run->optimum[0].x[1] * run->optimum[1].x[1] < -0.2, "one shape twice");
    cr_expect(eq(int, hits, 16)); /* as many as the chains */
    ves_plan_destroy(plan);
    finish(&t);
}

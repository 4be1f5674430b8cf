/* A grid chosen at the start design that is too coarse for the best. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>
#include <math.h>
#include <string.h>

#include "vesica/run.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#define PI 3.14159265358979323846

/* Of all tori, the Willmore energy is least for R = sqrt(2) r: 2 pi^2. A thin one needs fewer nodes. */
#define TORUS                                                                                                \
    "vesica: 1\nvariables: {R: [1.1, 3, 5]}\npatches:\n  t:\n    surface: {formula: [\"(R + "                \
    "cos(u))*cos(v)\", \"(R + cos(u))*sin(v)\", \"sin(u)\"]}\n    domain: {u: [0, 2*pi], v: [0, 2*pi]}\n"    \
    "shape: {closed: true}\nmeasures: {hh: {integral: \"H^2\"}}\nminimize: hh\n"

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
        trial t = run_with(TORUS, &(ves_run_options){.jobs = 1, .evaluations = budget});
        cr_expect(t.run->evaluations <= budget, "%ld of %ld", t.run->evaluations, budget);
        again += noted(t.run, "chosen at the best");
        finish(&t);
    }
    cr_expect(again > 2, "chosen again %d times", again);
}

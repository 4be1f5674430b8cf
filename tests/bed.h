/* A problem text made ready to be evaluated; whatever goes wrong on the way fails the test with its message. */
#ifndef TESTS_BED_H
#define TESTS_BED_H

#include <criterion/criterion.h>
#include <string.h>

#include "problem/problem.h"
#include "vesica/plan.h"

typedef struct bed {
    ves_problem *problem;
    ves_plan *plan;
    ves_diag *diag;
} bed;

/* On a grid of nu x nv nodes a patch; 0, 0: chosen, or as the text says. plugin: more measures, or NULL. */
static inline bed bed_with(const char *text, const ves_measure *const *plugin, int nu, int nv)
{
    bed b = {.diag = ves_diag_create()};
    ves_read_options options = {.plugin = plugin};
    char message[2000] = "";
    ves_status status = ves_problem_read_text("test.yaml", text, strlen(text), &options, &b.problem, b.diag);
    if (status == VES_OK) status = ves_plan_create(b.problem, &(ves_plan_options){{nu, nv}}, &b.plan, b.diag);
    if (ves_diag_count(b.diag)) ves_diag_text(b.diag, 0, message, sizeof message);
    cr_assert_eq(status, VES_OK, "%s", message);
    return b;
}

static inline void bed_clear(bed *b)
{
    ves_plan_destroy(b->plan);
    ves_problem_destroy(b->problem);
    ves_diag_destroy(b->diag);
}

/* The objective at x, which must be measurable; four constraints at most. */
static inline double value_at(const bed *b, const double *x)
{
    double constraint[4];
    ves_verdict verdict = {.constraint = constraint};
    ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    cr_assert_eq(ves_plan_evaluate(b->plan, &ask, &verdict), VES_OK);
    cr_assert_eq(verdict.status, VES_OK, "%s", ves_status_text(verdict.status));
    return verdict.value;
}

#endif

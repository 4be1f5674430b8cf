/* Memory of problems with shells: nothing of ours is allocated for a candidate and its gradient, CHOLMOD takes the same for
 * each, and every allocation that fails is a clean VES_MEMORY. */
#include <criterion/criterion.h>

#include <math.h>
#include <string.h>

#include "memory.h"
#include "problem/problem.h"
#include "vesica/plan.h"

/* A quarter of a bowl with a flange across a fold, by elements that are tied and, for proofs, by such that are not; a place and a
 * spring, loads of all kinds, stresses, factors of four classes. */
static const char TEXT[] =
    "vesica: 1\nquadrature: {u: 12, v: 24}\nvariables: {r: [0.8, 1, 1.2], t: [0.01, 0.02, 0.05]}\n"
    "curves:\n  base: {circle: {radius: 0.7, axis: [0, 1, 0]}}\n"
    "  rim: {circle: {radius: 1, axis: [0, 1, 0], centre: [0, 1, 0]}, apply: [{dilate: [r, 1, 1]}]}\n"
    "  lip: {circle: {radius: 1.2, axis: [0, 1, 0], centre: [0, 1, 0]}, apply: [{dilate: [r, 1, 1]}]}\n"
    "patches:\n  bowl: {operator: {power: 1, a: 0.5}, conditions: [{u: 0, position: base}, {u: 1, position: "
    "rim}]}\n"
    "  flange: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: rim}, {u: 1, position: lip}]}\n"
    "places: {tip: {patch: flange, u: 1, v: 0}}\n"
    "shell:\n  parts: {bowl: {thickness: \"t*(1 + 0.2*u)\"}, flange: {thickness: t}}\n"
    "  material: {E: 1, nu: 0.3, density: 1}\n  mesh: {order: 2, elements: [2, 8]}\n"
    "  verify: {order: 6, elements: [1, 4]}\n"
    "  supports: [{at: base, fix: all}, {at: lip, spring: [0, 1e-3, 0]}]\n"
    "  cases:\n    a: [{at: rim, line: [0, -1e-6, 0]}, {gravity: [0, -1e-6, 0]}]\n    b: [{pressure: 1e-7}]\n"
    "measures: {s: {max_shear: {case: a, smooth: 8}}, c: {compliance: {case: b}}, d: {displacement: {case: "
    "a, at: "
    "tip}}, f: {buckling: {case: a}}}\n"
    "minimize: s + c + d + f\n";

static const double STEP = 1e-3;

typedef struct work {
    ves_problem *problem;
    ves_plan *plan;
    ves_diag *diag;
} work;

static ves_status begin(work *w)
{
    *w = (work){.diag = ves_diag_create()};
    ves_status status = ves_problem_read_text("shell.yaml", TEXT, strlen(TEXT), NULL, &w->problem, w->diag);
    if (status == VES_OK) status = ves_plan_create(w->problem, NULL, &w->plan, w->diag);
    return status != VES_OK && w->diag && ves_diag_errors(w->diag) != 1 ? VES_FAULT : status;
}

static void end(work *w)
{
    ves_plan_destroy(w->plan);
    ves_problem_destroy(w->problem);
    ves_diag_destroy(w->diag);
}

static ves_status evaluate(const work *w, int k, int level)
{
    double x[2] = {1 + STEP * k, 0.02 + STEP * k}, gradient[2];
    ves_verdict verdict = {.value = NAN, .gradient = gradient};
    const ves_ask ask = {.x = x, .level = level, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
    ves_status status = ves_plan_evaluate(w->plan, &ask, &verdict);
    return status == VES_OK ? verdict.status : status;
}

Test(shell_memory, a_candidate_takes_nothing_of_ours, .timeout = 280)
{
    work w;
    cr_assert_eq(begin(&w), VES_OK);
    memory_begin(0, false);
    for (int k = 1; k < 7; k++) cr_assert_eq(evaluate(&w, k, k % 2), VES_OK);
    memory_end();
    cr_expect_eq(memory.asked, 0, "%ld allocations in 6 evaluations", memory.asked);
    end(&w);
}

#ifndef __SANITIZE_ADDRESS__ /* whose allocator counts for itself */
Test(shell_memory, a_factor_takes_the_same_each_time, .timeout = 280)
{
    work w;
    long asked[4];
    cr_assert_eq(begin(&w), VES_OK);
    for (int k = 0; k < 4; k++) {
        memory_begin(0, true);
        cr_assert_eq(evaluate(&w, k, 0), VES_OK);
        memory_end();
        asked[k] = memory.asked;
    }
    for (int k = 2; k < 4; k++)
        cr_expect_eq(asked[k], asked[1], "candidate %d: %ld calls, %ld before", k, asked[k], asked[1]);
    cr_log_info("%ld calls of libraries a candidate", asked[3]);
    end(&w);
}
#endif

static ves_status whole(void)
{
    work w;
    ves_status status = begin(&w);
    if (status == VES_OK) status = evaluate(&w, 1, 0);
    end(&w);
    return status;
}

/* Ours and CHOLMOD's, `most` of them. */
static void starve(bool libraries, long most)
{
    memory_begin(0, libraries);
    cr_assert_eq(whole(), VES_OK);
    memory_end();
    long all = memory.asked, step = 1 + (all - 1) / most, noticed = 0, done = 0;
    for (long k = 1; k <= all; k += step, done++) {
        memory_begin(k, libraries);
        ves_status status = whole();
        memory_end();
        cr_assert(status == VES_MEMORY || status == VES_OK, "allocation %ld of %ld: %s", k, all,
                  ves_status_text(status));
        cr_assert(memory.live == 0, "allocation %ld of %ld: %ld blocks lost", k, all, memory.live);
        noticed += status == VES_MEMORY;
    }
    cr_log_info("%ld calls, %ld failed, %ld of them noticed", all, done, noticed);
    cr_expect(noticed >= done - done / 20 - 1, "only %ld of %ld failures were noticed", noticed, done);
}

Test(shell_memory, every_failing_allocation_is_a_clean_status, .timeout = 280)
{
    starve(false, 70);
#ifndef __SANITIZE_ADDRESS__
    starve(true, 40);
#endif
}

/* Memory: nothing is allocated in the loop, and every allocation that fails is a clean VES_MEMORY. The linker
 * sends our calls of the allocator through the functions below (--wrap); those of the libraries are not
 * touched. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "problem/problem.h"
#include "surface/figure.h"
#include "vesica/plan.h"

static struct {
    long calls, fail_at; /* counts from 1; 0: never fail */
} memory;

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);

static bool granted(void)
{
    return __atomic_add_fetch(&memory.calls, 1, __ATOMIC_SEQ_CST) != memory.fail_at;
}

void *__wrap_malloc(size_t size)
{
    return granted() ? __real_malloc(size) : NULL;
}

void *__wrap_calloc(size_t count, size_t size)
{
    return granted() ? __real_calloc(count, size) : NULL;
}

void *__wrap_realloc(void *block, size_t size)
{
    return granted() ? __real_realloc(block, size) : NULL;
}

/* Curves of several kinds, a patch with a remainder, equations, measures of several sites. */
static const char TEXT[] =
    "vesica: 1\nquadrature: {u: 16, v: 16}\nvariables: {r: [0.8, 1.1, 1.6], t: [-0.3, 0.1, "
    "0.3]}\nparameters: {lid: r + 1}\n"
    "solve: {unknown: h, in: [0.2, 9], equation: volume == 3 + 0.1*t}\n"
    "curves:\n  p: {circle: {radius: 1}}\n"
    "  q: {bspline: {points: [[r, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]}, apply: [{translate: [t, 0, "
    "h]}]}\n"
    "patches: {wall: {operator: {power: 1, a: 1.3}, modes: 6, conditions: [{u: 0, position: p}, {u: 1, "
    "position: q}]}}\n"
    "shape: {closed: true, caps: [wall.u0, wall.u1]}\nplaces: {tip: {patch: wall, u: 0.5, v: 1}}\n"
    "measures: {d: {distance: {from: tip, to: p}}, m: {integral: {of: \"H^2*x\"}}}\n"
    "minimize: area + bending + d + m\nconstraints: [area <= 14*lid]\n"
    "search: [{anneal: {evaluations: 40, chains: 2}}, {polish: {evaluations: 20, starts: 1, escape: "
    "false}}]\n";

static ves_status judge(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    (void)worker;
    return ves_plan_evaluate(data, ask, verdict);
}

static ves_status search(const ves_problem *p, ves_plan *plan)
{
    double lower[2], upper[2], begin[2];
    for (int k = 0; k < 2; k++)
        lower[k] = p->variable[k].min, upper[k] = p->variable[k].max, begin[k] = p->variable[k].start;
    ves_search_problem problem = {.n = 2,
                                  .m = 1,
                                  .lower = lower,
                                  .upper = upper,
                                  .start = begin,
                                  .gradients = true,
                                  .workers = 1,
                                  .evaluate = judge,
                                  .data = plan};
    ves_search_result *result = NULL;
    ves_status status = ves_search_run(&problem, &p->search, NULL, &result);
    ves_search_result_destroy(result);
    return status;
}

static ves_status whole(void)
{
    ves_problem *problem = NULL;
    ves_plan *plan = NULL;
    ves_figure *figure = NULL;
    ves_read_options options = {0};
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_problem_read_text("memory.yaml", TEXT, strlen(TEXT), &options, &problem, diag);
    if (status == VES_OK) status = ves_plan_create(problem, &(ves_plan_options){{0, 0}}, &plan, diag);
    if (status == VES_OK) status = search(problem, plan);
    double x[2] = {1.1, 0.1};
    if (status == VES_OK) status = ves_plan_figure(plan, x, 8, 8, &figure, diag);
    if (figure) ves_figure_destroy(figure);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
    return status;
}

Test(allocation, every_failing_allocation_is_a_clean_status, .timeout = 280)
{
    memory.fail_at = 0, memory.calls = 0;
    cr_assert_eq(whole(), VES_OK);
    long all = memory.calls, done = 0;
    for (long k = 1; k <= all; k += k < 400 ? 1 : 7) {
        memory.calls = 0, memory.fail_at = k;
        ves_status status = whole();
        memory.fail_at = 0;
        /* diagnostics and proofs may do without: the run then goes on */
        cr_assert(status == VES_MEMORY || status == VES_OK, "allocation %ld of %ld: %s", k, all,
                  ves_status_text(status));
        done += status == VES_MEMORY;
    }
    cr_expect(done > 50, "only %ld of %ld failures were noticed", done, all);
}

Test(allocation, an_evaluation_allocates_nothing)
{
    ves_problem *problem;
    ves_plan *plan;
    ves_read_options options = {0};
    ves_diag *diag = ves_diag_create();
    cr_assert_eq(ves_problem_read_text("memory.yaml", TEXT, strlen(TEXT), &options, &problem, diag), VES_OK);
    cr_assert_eq(ves_plan_create(problem, &(ves_plan_options){{0, 0}}, &plan, diag), VES_OK);
    double x[2] = {1.1, 0.1}, constraint[1], gradient[2], jacobian[2];
    ves_verdict verdict = {.constraint = constraint, .gradient = gradient, .jacobian = jacobian};
    long before = memory.calls;
    for (int k = 0; k < 50; k++)
        for (int level = 0; level < 2; level++) {
            x[0] = 1.1 + 0.001 * k, x[1] = 0.1 - 0.002 * k;
            ves_ask ask = {.x = x,
                           .level = level,
                           .cutoff = HUGE_VAL,
                           .want = k % 2 ? VES_WANT_GRADIENT : VES_WANT_VALUE};
            cr_assert_eq(ves_plan_evaluate(plan, &ask, &verdict), VES_OK);
            cr_assert_eq(verdict.status, VES_OK);
        }
    cr_expect_eq(memory.calls, before, "%ld allocations in 100 evaluations", memory.calls - before);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}

/* Pose: the problem as a search sees it. */
#include "plan/inside.h"

#include <math.h>
#include <string.h>

/* Points of a patch by which shapes are compared; two are one shape within this part of their size. */
enum { ALONG = 5, AROUND = 16, NODES = ALONG * AROUND, PLANES = 3 * VES_FIELDS };

static const double ALIKE = 1e-3;

bool ves_plan_differentiable(const ves_plan *plan)
{
    const ves_problem *p = plan->problem;
    for (int m = 0; m < p->measures; m++) {
        const ves_measure *measure = p->measure[m].measure;
        if (!plan->runs[PROGRAM_JUDGE][m] && !plan->runs[PROGRAM_SCALE][m]) continue;
        if (!measure->gradient) return false;
        if (measure->shell && measure->cost > 0 && !ves_shell_differentiable(plan)) return false;
    }
    return true;
}

ves_status ves_plan_pose(ves_plan *plan)
{
    const ves_problem *p = plan->problem;
    ves_arena *a = &plan->arena;
    size_t n = (size_t)p->variables;
    plan->lower = ves_arena_take(a, n, sizeof(double));
    plan->upper = ves_arena_take(a, n, sizeof(double));
    plan->start = ves_arena_take(a, n, sizeof(double));
    plan->name = ves_arena_take(a, n, sizeof *plan->name);
    plan->equality = ves_arena_take(a, (size_t)p->constraints, sizeof *plan->equality);
    if (!plan->lower || !plan->upper || !plan->start || !plan->name || !plan->equality) return VES_MEMORY;
    for (int k = 0; k < p->variables; k++) {
        const ves_variable *v = &p->variable[k];
        plan->lower[k] = v->min, plan->start[k] = v->start, plan->upper[k] = v->max;
        plan->name[k] = v->name;
    }
    for (int k = 0; k < p->constraints; k++) plan->equality[k] = p->constraint[k].relation == VES_EQUAL;
    size_t points = p->scale ? (size_t)(3 * NODES * p->patches) : 0;
    plan->shape[0] = ves_arena_doubles(a, points);
    plan->shape[1] = ves_arena_doubles(a, points);
    plan->planes = ves_arena_doubles(a, p->scale ? NODES * PLANES : 0);
    return plan->shape[0] && plan->shape[1] && plan->planes ? VES_OK : VES_MEMORY;
}

/* Points of the shape at x, in the size that it is scaled to; a patch after the other. */
static ves_status shape_take(ves_plan *plan, const double *x, double *X)
{
    double u[NODES], v[NODES];
    ves_plan_lattice(ALONG, AROUND, u, v);
    VES_TRY(ves_plan_forward(plan, x, 0, PROGRAM_JUDGE, false));
    for (int k = 0; k < plan->problem->patches; k++, X += 3 * NODES) {
        VES_TRY(ves_plan_points(plan, k, NODES, u, v, plan->planes));
        memcpy(X, plan->planes, sizeof *X * 3 * NODES);
    }
    return VES_OK;
}

/* With scale: a design and its copy in another size are one: they are compared as shapes. */
static ves_status same(void *data, const double *a, const double *b, bool *same)
{
    ves_plan *plan = *(ves_plan **)data;
    *same = false;
    ves_status status = shape_take(plan, a, plan->shape[0]);
    if (status == VES_OK) status = shape_take(plan, b, plan->shape[1]);
    if (status != VES_OK) return status < VES_OK ? status : VES_OK;
    const double *X = plan->shape[0], *Y = plan->shape[1];
    double size = 0, apart = 0;
    for (int k = 0; k < 3 * NODES * plan->problem->patches; k++) {
        size = fmax(size, fabs(X[k] - X[k / NODES % 3 * NODES])); /* from the first point of all */
        apart = fmax(apart, fabs(X[k] - Y[k]));
    }
    *same = apart <= ALIKE * size;
    return VES_OK;
}

static ves_status evaluate(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    ves_plan **plan = data;
    return ves_plan_evaluate(plan[worker], ask, verdict);
}

/* A search may have the answer from a journal: the proof is made again. */
static bool why(void *data, const double *x, ves_status status, char *text, size_t size)
{
    ves_plan **plan = data;
    ves_verdict verdict = {.status = VES_OK};
    ves_ask ask = {.x = x, .level = 1, .cutoff = HUGE_VAL, .want = VES_WANT_PROOF};
    return status == VES_BROKEN && ves_plan_evaluate(plan[0], &ask, &verdict) == VES_OK &&
           ves_plan_broken(plan[0], text, size);
}

ves_search_problem ves_plan_search(ves_plan **plan, int workers)
{
    const ves_plan *first = plan[0];
    return (ves_search_problem){.n = first->problem->variables,
                                .m = first->problem->constraints,
                                .lower = first->lower,
                                .upper = first->upper,
                                .start = first->start,
                                .equality = first->equality,
                                .tolerance = VES_FEASIBLE,
                                .gradients = first->gradients,
                                .workers = workers,
                                .evaluate = evaluate,
                                .data = plan,
                                .name = first->name,
                                .same = first->problem->scale ? same : NULL,
                                .why = why};
}

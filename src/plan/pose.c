/* Pose: the problem as a search sees it. */
#include "plan/inside.h"

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
    return VES_OK;
}

/* Whether every measure that is judged has a gradient. */
static bool gradients(const ves_plan *plan)
{
    for (int m = 0; m < plan->problem->measures; m++)
        if ((plan->runs[PROGRAM_JUDGE][m] || plan->runs[PROGRAM_SCALE][m]) &&
            !plan->problem->measure[m].measure->gradient)
            return false;
    return true;
}

static ves_status evaluate(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    ves_plan **plan = data;
    return ves_plan_evaluate(plan[worker], ask, verdict);
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
                                .gradients = gradients(first),
                                .workers = workers,
                                .evaluate = evaluate,
                                .data = plan,
                                .name = first->name};
}

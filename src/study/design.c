#include "study/design.h"

#include <math.h>
#include <string.h>

/* NULL when out of memory. */
static void *copy(ves_arena *arena, const void *from, int count, size_t size)
{
    void *to = ves_arena_take(arena, (size_t)count, size);
    if (to && count) memcpy(to, from, (size_t)count * size);
    return to;
}

static double *start_of(const ves_problem *problem, ves_arena *arena)
{
    double *x = ves_arena_take(arena, (size_t)problem->variables, sizeof *x);
    for (int k = 0; x && k < problem->variables; k++) x[k] = problem->variable[k].start;
    return x;
}

ves_status ves_design_measure(ves_plan *plan, const ves_problem *problem, const double *x, int level,
                              ves_arena *arena, ves_design *design)
{
    ves_design d;
    if (!x) x = start_of(problem, arena);
    if (!x) return VES_MEMORY;
    ves_status status = ves_plan_measure(plan, x, level, &d);
    if (status < VES_OK) return status;
    d.x = d.slot = copy(arena, d.slot, problem->slots, sizeof *d.slot);
    d.measure = copy(arena, d.measure, problem->measures, sizeof *d.measure);
    d.side = copy(arena, d.side, problem->constraints, sizeof *d.side);
    d.check = copy(arena, d.check, problem->validity.checks, sizeof *d.check);
    if (!d.slot || !d.measure || !d.side || !d.check) return VES_MEMORY;
    *design = d;
    return VES_OK;
}

const char *ves_design_kind(const ves_problem *problem, int kind)
{
    return kind < 0 ? "none of these" : problem->kind[kind].name;
}

double ves_design_excess(double constraint, double within)
{
    return constraint * (within / VES_FEASIBLE);
}

double ves_design_violation(const ves_problem *problem, const ves_record *record)
{
    if (record->status != VES_OK) return NAN;
    double worst = 0;
    for (int k = 0; k < problem->constraints; k++) {
        const ves_constraint_def *c = &problem->constraint[k];
        double e = ves_design_excess(record->constraint[k], c->within);
        worst = fmax(worst, c->relation == VES_EQUAL ? fabs(e) : e);
    }
    return worst;
}

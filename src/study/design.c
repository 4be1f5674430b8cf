#include "study/design.h"

#include <math.h>
#include <string.h>

static const double NOTHING = 1e-9;

static void forget(const ves_problem *problem, ves_design *design)
{
    for (int k = 0; k < problem->measures; k++) design->measure[k] = NAN;
    for (int k = 0; k < problem->constraints; k++) design->side[k] = (ves_sides){NAN, NAN, NAN};
    design->objective = design->violation = design->similarity = NAN;
    design->feasible = false;
}

ves_status ves_design_init(const ves_problem *problem, ves_arena *arena, ves_design *design)
{
    double *x = ves_arena_take(arena, (size_t)problem->variables, sizeof *x);
    *design = (ves_design){.status = VES_NO_NUMBER, .x = x};
    design->slot = ves_arena_take(arena, (size_t)problem->slots, sizeof *design->slot);
    design->measure = ves_arena_take(arena, (size_t)problem->measures, sizeof *design->measure);
    design->side = ves_arena_take(arena, (size_t)problem->constraints, sizeof *design->side);
    if (!x || !design->slot || !design->measure || !design->side) return VES_MEMORY;
    for (int k = 0; k < problem->variables; k++) x[k] = problem->variable[k].start;
    forget(problem, design);
    return VES_OK;
}

static void judge(const ves_plan *plan, const ves_problem *problem, ves_design *design)
{
    design->feasible = true;
    design->violation = 0;
    for (int k = 0; k < problem->constraints; k++) {
        ves_sides *s = &design->side[k];
        ves_plan_constraint(plan, k, &s->value, &s->limit, &s->violation);
        design->violation = fmax(design->violation, s->violation);
        if (!(s->violation <= problem->constraint[k].within)) design->feasible = false;
    }
}

static ves_status objective(const ves_problem *problem, ves_design *design)
{
    if (!problem->objective) return VES_OK;
    size_t size = (size_t)ves_formula_room(problem->objective) * sizeof(double);
    double *room = ves_memory_take(size);
    if (!room) return VES_MEMORY;
    design->objective = ves_formula_eval(problem->objective, design->slot, design->measure, room);
    ves_memory_free(room);
    if (!isfinite(design->objective)) design->status = VES_NO_NUMBER;
    return VES_OK;
}

ves_status ves_design_measure(ves_plan *plan, const ves_problem *problem, const double *x, int level,
                              ves_arena *arena, ves_design *design)
{
    VES_TRY(ves_design_init(problem, arena, design));
    if (problem->variables) memcpy((double *)design->x, x, sizeof *x * (size_t)problem->variables);
    ves_status status = ves_plan_measure(plan, design->x, level, design->measure);
    if (status < VES_OK) return status;
    memcpy(design->slot, ves_plan_slots(plan), sizeof(double) * (size_t)problem->slots);
    design->status = status;
    if (status > VES_OK) return VES_OK;
    design->similarity = ves_plan_similarity(plan);
    judge(plan, problem, design);
    return objective(problem, design);
}

static double difference(double a, double b)
{
    double size = fmax(fabs(a), fabs(b));
    return size > NOTHING ? fabs(a - b) / size : 0;
}

double ves_design_change(const ves_problem *problem, const ves_design *a, const ves_design *b)
{
    if (a->status != VES_OK || b->status != VES_OK) return NAN;
    double worst = problem->objective ? difference(a->objective, b->objective) : 0;
    for (int k = 0; k < problem->measures; k++) worst = fmax(worst, difference(a->measure[k], b->measure[k]));
    return worst;
}

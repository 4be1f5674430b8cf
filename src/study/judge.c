#include "study/judge.h"

#include <math.h>
#include <string.h>

#include "problem/problem.h"
#include "study/design.h"

ves_status ves_judge_joints(ves_plan *plan, ves_run *run, ves_arena *arena)
{
    ves_design design;
    int count = ves_plan_joints(plan);
    if (!run->any || count == 0) return VES_OK;
    ves_joint *joint = ves_arena_take(arena, (size_t)count, sizeof *joint);
    if (!joint) return VES_MEMORY;
    ves_status status = ves_plan_measure(plan, run->best.x, 0, &design);
    for (int k = 0; k < count && status == VES_OK; k++) status = ves_plan_joint(plan, k, &joint[k]);
    if (status == VES_OK) run->joint = joint, run->joints = count;
    return status < VES_OK ? status : VES_OK;
}

ves_status ves_judge_kind(const ves_run *run, ves_arena *arena, const char **note)
{
    const ves_design *a = &run->start, *b = &run->best;
    *note = NULL;
    if (!run->searched || !run->any || a->status != VES_OK || b->status != VES_OK || a->kind == b->kind)
        return VES_OK;
    *note = ves_arena_format(arena, "the search has left the kind of its start: %s, was %s",
                             ves_design_kind(run->problem, b->kind), ves_design_kind(run->problem, a->kind));
    return *note ? VES_OK : VES_MEMORY;
}

static bool holds(const ves_run *run, const ves_formula *formula, const double *argument, double *room)
{
    double value = ves_formula_eval(formula, run->best.slot, argument, room);
    return !isnan(value) && value != 0;
}

static double *arguments(const ves_run *run, ves_arena *arena)
{
    int first = run->problem->measures;
    double *argument = ves_arena_take(arena, (size_t)(first + VES_EXPECT_NAMES), sizeof *argument);
    if (!argument) return NULL;
    if (first) memcpy(argument, run->best.measure, sizeof *argument * (size_t)first);
    argument[first + VES_EXPECT_OBJECTIVE] = run->best.objective;
    argument[first + VES_EXPECT_VIOLATION] = run->best.violation;
    argument[first + VES_EXPECT_FEASIBLE] = run->feasible;
    argument[first + VES_EXPECT_EVALUATIONS] = (double)run->evaluations;
    argument[first + VES_EXPECT_GRADIENTS] = (double)run->gradients;
    argument[first + VES_EXPECT_OPTIMA] = run->optima;
    return argument;
}

ves_status ves_judge_expect(ves_run *run, bool test, ves_arena *arena)
{
    const ves_problem *p = run->problem;
    bool own = test && p->test_expects > 0;
    const ves_expect_def *list = own ? p->test_expect : p->expect;
    int count = own ? p->test_expects : p->expects;
    ves_run_expect *expect = ves_arena_take(arena, (size_t)count, sizeof *expect);
    double *argument = arguments(run, arena);
    if (!expect || !argument) return VES_MEMORY;
    run->expect = expect;
    run->expects = count;
    for (int k = 0; k < count; k++) {
        double *room = ves_arena_take(arena, (size_t)ves_formula_room(list[k].formula), sizeof *room);
        if (!room) return VES_MEMORY;
        expect[k] = (ves_run_expect){list[k].text, holds(run, list[k].formula, argument, room)};
        run->passed = run->passed && expect[k].passed;
    }
    return VES_OK;
}

/* What the public header tells about a problem. */
#include "problem/problem.h"

static bool there(int index, int count)
{
    return index >= 0 && index < count;
}

const char *ves_problem_title(const ves_problem *problem)
{
    return problem->title;
}

const char *ves_problem_objective(const ves_problem *problem, bool *maximize)
{
    if (maximize) *maximize = problem->maximize;
    return problem->objective ? problem->objective_text : NULL;
}

int ves_problem_variables(const ves_problem *problem)
{
    return problem->variables;
}

const char *ves_problem_variable(const ves_problem *problem, int index, double *min, double *start,
                                 double *max)
{
    if (!there(index, problem->variables)) return NULL;
    const ves_variable *v = &problem->variable[index];
    if (min) *min = v->min;
    if (start) *start = v->start;
    if (max) *max = v->max;
    return v->name;
}

int ves_problem_slots(const ves_problem *problem)
{
    return problem->slots;
}

const char *ves_problem_slot(const ves_problem *problem, int index)
{
    int unknown = problem->variables, parameter = unknown + problem->unknowns;
    if (!there(index, problem->slots)) return NULL;
    if (index < unknown) return problem->variable[index].name;
    return index < parameter ? problem->solve->name : problem->parameter[index - parameter].name;
}

int ves_problem_measures(const ves_problem *problem)
{
    return problem->measures;
}

const char *ves_problem_measure(const ves_problem *problem, int index)
{
    return there(index, problem->measures) ? problem->measure[index].name : NULL;
}

int ves_problem_constraints(const ves_problem *problem)
{
    return problem->constraints;
}

const char *ves_problem_constraint(const ves_problem *problem, int index, ves_relation *relation)
{
    if (!there(index, problem->constraints)) return NULL;
    if (relation) *relation = problem->constraint[index].relation;
    return problem->constraint[index].text;
}

int ves_problem_checks(const ves_problem *problem)
{
    return problem->validity.checks;
}

const char *ves_problem_check(const ves_problem *problem, int index)
{
    return there(index, problem->validity.checks) ? problem->validity.check[index].text : NULL;
}

int ves_problem_kinds(const ves_problem *problem)
{
    return problem->kinds;
}

const char *ves_problem_kind(const ves_problem *problem, int index)
{
    return there(index, problem->kinds) ? problem->kind[index].name : NULL;
}

int ves_problem_patches(const ves_problem *problem)
{
    return problem->patches;
}

const char *ves_problem_patch(const ves_problem *problem, int index)
{
    return there(index, problem->patches) ? problem->patch[index].name : NULL;
}

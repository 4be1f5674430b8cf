/* What the public header tells about a problem. */
#include "problem/problem.h"

const char *ves_problem_title(const ves_problem *problem)
{
    return problem->title;
}

int ves_problem_variables(const ves_problem *problem)
{
    return problem->variables;
}

const char *ves_problem_variable(const ves_problem *problem, int index, double *min, double *start,
                                 double *max)
{
    const ves_variable *v = &problem->variable[index];
    *min = v->min, *start = v->start, *max = v->max;
    return v->name;
}

int ves_problem_measures(const ves_problem *problem)
{
    return problem->measures;
}

const char *ves_problem_measure(const ves_problem *problem, int index)
{
    return problem->measure[index].name;
}

int ves_problem_constraints(const ves_problem *problem)
{
    return problem->constraints;
}

const char *ves_problem_constraint(const ves_problem *problem, int index)
{
    return problem->constraint[index].text;
}

int ves_problem_patches(const ves_problem *problem)
{
    return problem->patches;
}

const char *ves_problem_patch(const ves_problem *problem, int index)
{
    return problem->patch[index].name;
}

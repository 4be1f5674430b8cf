/* x -> the number block -> curves -> patches, and the way back for gradients; ranges of numbers that vary. */
#include "plan/inside.h"

#include <string.h>

static void parameters_bind(ves_plan *plan)
{
    const ves_problem *p = plan->problem;
    int first = p->variables + p->unknowns;
    for (int k = 0; k < p->parameters; k++)
        if (p->varying[first + k])
            plan->block[first + k] =
                ves_formula_eval(p->parameter[k].formula, plan->block, NULL, plan->formula_room);
}

void ves_plan_unscale(ves_plan *plan)
{
    plan->similarity = 1;
    plan->scaled = !plan->problem->scale;
}

void ves_plan_bind(ves_plan *plan, const double *x, double unknown)
{
    const ves_problem *p = plan->problem;
    if (p->variables) memcpy(plan->block, x, sizeof *x * (size_t)p->variables);
    if (p->unknowns) plan->block[p->variables] = unknown;
    parameters_bind(plan);
    for (int k = 0; k < p->numbers; k++)
        if (p->varying[p->slots + k])
            plan->block[p->slots + k] = ves_formula_eval(p->number[k], plan->block, NULL, plan->formula_room);
    ves_curves_bind(plan->curves, plan->block);
    ves_plan_bind_patches(plan);
    ves_plan_unscale(plan); /* or a design that fails early would be drawn in the size of the one before */
}

const ves_limit *ves_plan_limit(const ves_plan *plan)
{
    const ves_problem *p = plan->problem;
    for (int k = 0; k < p->limits; k++) {
        const ves_limit *l = &p->limit[k];
        double value = plan->block[l->number];
        if (!(value >= l->low && value <= l->high)) return l; /* or it is no number */
    }
    return NULL;
}

void ves_plan_bind_patches(ves_plan *plan)
{
    for (int k = 0; k < plan->problem->patches; k++) ves_patch_bind(plan->patch[k], &plan->bound);
}

/* Numbers are formulas of slots, parameters formulas of earlier slots: followed back in the reverse order,
 * what remains is the derivative with respect to variables and unknown (the places of the parameters are left
 * as rubbish). */
void ves_plan_pull(ves_plan *plan, const double *number_adjoint, double *slot_row)
{
    const ves_problem *p = plan->problem;
    int first = p->variables + p->unknowns;
    for (int k = 0; k < p->slots; k++) slot_row[k] += number_adjoint[k];
    for (int k = 0; k < p->numbers; k++) {
        double seed = number_adjoint[p->slots + k];
        if (p->varying[p->slots + k] && seed != 0)
            ves_formula_gradient(p->number[k], plan->block, NULL, seed, slot_row, NULL, plan->formula_room);
    }
    for (int k = p->parameters - 1; k >= 0; k--) {
        double seed = slot_row[first + k];
        if (p->varying[first + k] && seed != 0)
            ves_formula_gradient(p->parameter[k].formula, plan->block, NULL, seed, slot_row, NULL,
                                 plan->formula_room);
    }
}

#include "formula/graph.h"

#include <stddef.h>

static int total(const ves_formula *formula)
{
    return formula->constants + formula->slots + formula->arguments + formula->steps;
}

int ves_formula_room(const ves_formula *formula)
{
    return 2 * total(formula); /* values, and for the gradient as many adjoints */
}

ves_dim ves_formula_dim(const ves_formula *formula)
{
    return formula->dim;
}

bool ves_formula_has_units(const ves_formula *formula)
{
    return formula->units;
}

bool ves_formula_is_constant(const ves_formula *formula, double *value)
{
    if (formula->steps || !formula->constants) return false;
    if (value) *value = formula->constant[0];
    return true;
}

int ves_formula_slots(const ves_formula *formula)
{
    int slots = 0;
    for (int k = 0; k < formula->slots; k++)
        if (formula->slot[k] >= slots) slots = formula->slot[k] + 1;
    return slots;
}

bool ves_formula_uses_slot(const ves_formula *formula, int slot)
{
    for (int k = 0; k < formula->slots; k++)
        if (formula->slot[k] == slot) return true;
    return false;
}

bool ves_formula_uses_argument(const ves_formula *formula, int argument)
{
    for (int k = 0; k < formula->arguments; k++)
        if (formula->argument[k] == argument) return true;
    return false;
}

const ves_formula *ves_formula_constant(double value, ves_arena *arena)
{
    ves_formula *formula = ves_arena_take(arena, 1, sizeof *formula + sizeof value);
    if (!formula) return NULL;
    double *constant = (double *)(formula + 1);
    *constant = value;
    *formula = (ves_formula){.constants = 1, .constant = constant, .dim = {.any = true}};
    return formula;
}

double ves_formula_eval(const ves_formula *formula, const double *slot, const double *argument, double *room)
{
    double *value = room;
    for (int k = 0; k < formula->constants; k++) *value++ = formula->constant[k];
    for (int k = 0; k < formula->slots; k++) *value++ = slot[formula->slot[k]];
    for (int k = 0; k < formula->arguments; k++) *value++ = argument[formula->argument[k]];
    const ves_step *step = formula->step, *end = step + formula->steps;
    for (; step < end; step++)
        *value++ = ves_operation_eval(step->operation, room[step->a], room[step->b], room[step->c]);
    return value[-1];
}

/* adds weight * partial; a branch not taken (partial 0) stays clean even if weight is inf or nan. */
static inline void add(double *adjoint, double weight, double partial)
{
    if (partial != 0) *adjoint += weight * partial;
}

/* Spreads the adjoint w of one step over the adjoints g of its operands. */
static void spread(const ves_step *step, const double *value, double v, double w, double *g)
{
    double x = value[step->a], y = value[step->b];
    switch (step->operation) {
#define VES_OPERATION_CASE(name, operands, value, dx, dy, dz)                                                \
    case VES_OP_##name:                                                                                      \
        if (operands > 0) add(&g[step->a], w, dx);                                                           \
        if (operands > 1) add(&g[step->b], w, dy);                                                           \
        if (operands > 2) add(&g[step->c], w, dz);                                                           \
        break;
        VES_OPERATION_LIST(VES_OPERATION_CASE)
#undef VES_OPERATION_CASE
    }
}

double ves_formula_gradient(const ves_formula *formula, const double *slot, const double *argument,
                            double seed, double *slot_adjoint, double *argument_adjoint, double *room)
{
    double result = ves_formula_eval(formula, slot, argument, room);
    int count = total(formula), leaves = count - formula->steps;
    double *g = room + count;
    for (int k = 0; k < count; k++) g[k] = 0;
    g[count - 1] = seed;
    for (int k = count - 1; k >= leaves; k--)
        if (g[k] != 0) spread(&formula->step[k - leaves], room, room[k], g[k], g);
    g += formula->constants;
    for (int k = 0; slot_adjoint && k < formula->slots; k++) slot_adjoint[formula->slot[k]] += g[k];
    g += formula->slots;
    for (int k = 0; argument_adjoint && k < formula->arguments; k++)
        argument_adjoint[formula->argument[k]] += g[k];
    return result;
}

/* Backward: from outputs (objective, constraints) to variables. One pass for each output: formulas ->
 * measures -> samples -> fields -> modes -> curves -> numbers -> slots; afterwards the equations of scale:
 * and solve: are followed by the implicit function theorem. */
#include "plan/inside.h"

#include <math.h>
#include <string.h>

static int slots(const ves_plan *plan)
{
    return plan->problem->slots;
}

static double *row(const ves_plan *plan, int output)
{
    return plan->rows + (size_t)(output * slots(plan));
}

/* From the adjoints of measures (measure_adjoint) to number block adjoints. Samples must be those of this
 * program. */
ves_status ves_plan_sweep(ves_plan *plan, int index, plan_program which, double *by_similarity)
{
    const ves_problem *p = plan->problem;
    plan_level *l = &plan->level[index];
    ves_status worst = VES_OK;
    *by_similarity = 0;
    ves_curves_clear(plan->curves);
    for (int k = 0; k < p->patches; k++) ves_patch_clear(plan->patch[k]);
    for (int k = 0; k < l->sites; k++) l->site[k].slopes = 0;
    for (int m = 0; m < p->measures; m++) {
        if (!plan->runs[which][m] || plan->measure_adjoint[m] == 0) continue;
        const plan_instance *in = &l->instance[m];
        for (int k = 0; k < in->input.samples; k++) l->site[in->site[k]].slopes |= in->need[k];
        p->measure[m].measure->gradient(&in->input, plan->measure_adjoint[m], in->adjoint,
                                        plan->block_adjoint);
    }
    worst = ves_shell_sweep(plan, index);
    for (int k = 0; k < l->sites; k++) {
        ves_status status = ves_site_scatter(plan, &l->site[k], by_similarity);
        if (status != VES_OK) worst = status;
    }
    for (int k = 0; k < l->sites; k++)
        if (l->site[k].slopes) ves_site_gather(plan, &l->site[k]);
    for (int k = 0; k < p->patches; k++) ves_patch_unbind(plan->patch[k], &plan->bound, plan->block_adjoint);
    ves_curves_scatter(plan->curves, plan->block, plan->block_adjoint);
    return worst;
}

/* One output, sum of seed[k] * formula[k], into its row. */
ves_status ves_plan_gradient(ves_plan *plan, int index, int output, const ves_formula *const *formula,
                             const double *seed, int count, plan_program which)
{
    const ves_problem *p = plan->problem;
    memset(plan->measure_adjoint, 0, sizeof(double) * (size_t)p->measures);
    memset(plan->block_adjoint, 0, sizeof(double) * (size_t)p->block);
    memset(row(plan, output), 0, sizeof(double) * (size_t)slots(plan));
    for (int k = 0; k < count; k++)
        ves_formula_gradient(formula[k], plan->block, plan->value, seed[k], plan->block_adjoint,
                             plan->measure_adjoint, plan->formula_room);
    VES_TRY(ves_plan_sweep(plan, index, which, &plan->row_similarity[output]));
    ves_plan_pull(plan, plan->block_adjoint, row(plan, output));
    return VES_OK;
}

/* s = (target / m)^(1/d) with m on the unscaled shape: ds = s / d (d target / target - dm / m). */
static ves_status follow_scale(ves_plan *plan, int index, int outputs)
{
    const ves_scale *sc = plan->problem->scale;
    double s = plan->similarity;
    plan->similarity = 1;
    plan_level *l = &plan->level[index];
    for (int k = 0; k < l->sites; k++)
        VES_TRY(ves_site_sample(plan, &l->site[k], l->site[k].needs[PROGRAM_SCALE], true));
    double m, by_similarity, target = ves_plan_formula(plan, sc->target);
    VES_TRY(plan->problem->measure[sc->measure].measure->eval(&l->instance[sc->measure].input, &m));
    double f = s / plan->problem->measure[sc->measure].measure->degree;
    memset(plan->measure_adjoint, 0, sizeof(double) * (size_t)plan->problem->measures);
    memset(plan->block_adjoint, 0, sizeof(double) * (size_t)plan->problem->block);
    memset(plan->unit_row, 0, sizeof(double) * (size_t)slots(plan));
    plan->measure_adjoint[sc->measure] = -f / m;
    VES_TRY(ves_plan_sweep(plan, index, PROGRAM_SCALE, &by_similarity));
    ves_formula_gradient(sc->target, plan->block, plan->value, f / target, plan->block_adjoint, NULL,
                         plan->formula_room);
    ves_plan_pull(plan, plan->block_adjoint, plan->unit_row);
    for (int o = 0; o < outputs; o++)
        for (int k = 0; k < slots(plan); k++) row(plan, o)[k] += plan->row_similarity[o] * plan->unit_row[k];
    plan->similarity = s;
    return VES_OK;
}

/* The residual's row is the last one: dh/dx = -(dg/dx) / (dg/dh). */
static void follow_solve(ves_plan *plan, int outputs)
{
    int h = plan->problem->variables;
    const double *g = row(plan, outputs - 1);
    for (int o = 0; o < outputs - 1; o++) {
        double f = row(plan, o)[h] / g[h];
        for (int k = 0; k < h; k++) row(plan, o)[k] -= f * g[k];
    }
}

/* Makes the rows of all outputs total derivatives. With solve:, the residual's row is computed here as one
 * more output. */
ves_status ves_plan_follow(ves_plan *plan, int index, int outputs)
{
    const ves_solve *solve = plan->problem->solve;
    if (solve) {
        const ves_formula *formula[2] = {solve->left, solve->right};
        const double seed[2] = {1, -1};
        VES_TRY(ves_plan_gradient(plan, index, outputs++, formula, seed, 2, PROGRAM_JUDGE));
    }
    if (plan->problem->scale) VES_TRY(follow_scale(plan, index, outputs));
    if (solve) follow_solve(plan, outputs);
    return VES_OK;
}

/* Judge: from measures to the Verdict. */
#include "plan/inside.h"

#include <math.h>
#include <string.h>

/* Signed excess of constraint k over what is allowed, in units of its size: an inequality holds when <= 0. */
static double excess(ves_plan *plan, int k)
{
    const ves_constraint_def *c = &plan->problem->constraint[k];
    double left = plan_formula(plan, c->left), right = plan_formula(plan, c->right);
    return (c->relation == VES_AT_LEAST ? right - left : left - right) / plan->size[k];
}

static double violation(const ves_constraint_def *c, double e)
{
    return c->relation == VES_EQUAL ? fabs(e) : e > 0 ? e : 0;
}

/* `within` is a feasibility tolerance of its own. The search knows one tolerance for all: it sees excesses in
 * units of theirs. */
static double own_tolerance(const ves_constraint_def *c)
{
    return VES_FEASIBLE / c->within;
}

void ves_plan_constraint(const ves_plan *plan, int k, double *left, double *right, double *v)
{
    ves_plan *p = (ves_plan *)plan; /* formulas need scratch, which is the plan's */
    const ves_constraint_def *c = &plan->problem->constraint[k];
    *left = plan_formula(p, c->left);
    *right = plan_formula(p, c->right);
    *v = violation(c, excess(p, k));
}

double plan_cheap_violation(ves_plan *plan)
{
    double worst = 0;
    for (int k = 0; k < plan->problem->constraints; k++) {
        const ves_constraint_def *c = &plan->problem->constraint[k];
        if (plan->cheap[k]) worst = fmax(worst, violation(c, excess(plan, k) * own_tolerance(c)));
    }
    return worst;
}

static double objective(ves_plan *plan)
{
    const ves_problem *p = plan->problem;
    double value = p->objective ? plan_formula(plan, p->objective) : 0;
    return p->maximize ? -value : value;
}

static ves_status values(ves_plan *plan, ves_verdict *verdict)
{
    const ves_problem *p = plan->problem;
    double worst = 0;
    for (int k = 0; k < p->constraints; k++) {
        const ves_constraint_def *c = &p->constraint[k];
        double e = excess(plan, k) * own_tolerance(c), v = violation(c, e);
        if (!isfinite(e)) return VES_NO_NUMBER;
        if (verdict->constraint) verdict->constraint[k] = e;
        worst = v > worst ? v : worst;
    }
    verdict->value = objective(plan);
    verdict->violation = worst;
    return isfinite(verdict->value) ? VES_OK : VES_NO_NUMBER;
}

static ves_status gradients(ves_plan *plan, int index, ves_verdict *verdict)
{
    const ves_problem *p = plan->problem;
    const double sign = p->maximize ? -1 : 1;
    int n = p->variables, outputs = 1 + p->constraints;
    plan_gradient(plan, index, 0, &p->objective, &sign, p->objective ? 1 : 0, PROGRAM_JUDGE);
    for (int k = 0; k < p->constraints; k++) {
        const ves_constraint_def *c = &p->constraint[k];
        const ves_formula *formula[2] = {c->left, c->right};
        double f = own_tolerance(c) / plan->size[k] * (c->relation == VES_AT_LEAST ? -1 : 1);
        const double seed[2] = {f, -f};
        plan_gradient(plan, index, 1 + k, formula, seed, 2, PROGRAM_JUDGE);
    }
    VES_TRY(plan_follow(plan, index, outputs));
    memcpy(verdict->gradient, plan->rows, sizeof(double) * (size_t)n);
    for (int k = 0; k < p->constraints && verdict->jacobian; k++)
        memcpy(verdict->jacobian + (size_t)(k * n), plan->rows + (size_t)((1 + k) * p->slots),
               sizeof(double) * (size_t)n);
    for (int k = 0; k < n; k++)
        if (!isfinite(verdict->gradient[k])) return VES_NO_NUMBER;
    return VES_OK;
}

static ves_status judge(ves_plan *plan, const ves_ask *ask, int index, ves_verdict *verdict)
{
    bool gradient = ask->want & VES_WANT_GRADIENT;
    plan->cutoff = ask->cutoff;
    VES_TRY(plan_forward(plan, ask->x, index, PROGRAM_JUDGE, gradient));
    VES_TRY(plan_validity(plan, index));
    VES_TRY(values(plan, verdict));
    if (verdict->violation > ask->cutoff) return VES_CUT;
    return gradient ? gradients(plan, index, verdict) : VES_OK;
}

static ves_status fail(ves_plan *plan, ves_status status, ves_verdict *verdict)
{
    if (status < 0) return status;
    plan->counts.failed[status]++;
    verdict->status = status;
    if (status != VES_CUT) verdict->violation = HUGE_VAL;
    return VES_OK;
}

/* The finer grid must tell the same story, or the optimizer has found a hole between the nodes. */
static const double AGREE = 1e-2;

static ves_status prove(ves_plan *plan, const ves_ask *ask, ves_verdict *verdict)
{
    double coarse = verdict->value, coarse_violation = verdict->violation;
    ves_ask fine = *ask;
    fine.want = VES_WANT_VALUE;
    plan->counts.proofs++;
    VES_TRY(judge(plan, &fine, 1, verdict));
    double size = fmax(fabs(coarse), fabs(verdict->value));
    bool agree =
        fabs(verdict->value - coarse) <= AGREE * size && verdict->violation <= coarse_violation + AGREE;
    verdict->value = coarse, verdict->violation = coarse_violation;
    if (!agree) return VES_COARSE;
    return plan->problem->validity.self_intersection ? plan_crosses(plan) : VES_OK;
}

ves_status ves_plan_evaluate(ves_plan *plan, const ves_ask *ask, ves_verdict *verdict)
{
    verdict->status = VES_OK;
    plan->counts.values++;
    if (ask->want & VES_WANT_GRADIENT) plan->counts.gradients++;
    ves_ask first = *ask;
    if (ask->want & VES_WANT_PROOF) first.want = VES_WANT_VALUE;
    ves_status status = judge(plan, &first, ask->want & VES_WANT_PROOF ? 0 : ask->level, verdict);
    if (status == VES_OK && ask->want & VES_WANT_PROOF) status = prove(plan, ask, verdict);
    return status == VES_OK ? VES_OK : fail(plan, status, verdict);
}

ves_status ves_plan_measure(ves_plan *plan, const double *x, int level, double *value)
{
    int measures = plan->problem->measures;
    ves_status status = plan_forward(plan, x, level, PROGRAM_ALL, false);
    if (status == VES_OK) status = plan_validity(plan, level);
    for (int m = 0; m < measures; m++) value[m] = status == VES_OK ? plan->value[m] : NAN;
    return status;
}

/* Judge: from measures to the Verdict. */
#include "plan/inside.h"

#include <math.h>
#include <string.h>

/* Signed excess of constraint k over what is allowed, in units of its size: an inequality holds when <= 0. */
static double excess(ves_plan *plan, int k)
{
    const ves_constraint_def *c = &plan->problem->constraint[k];
    double left = ves_plan_formula(plan, c->left), right = ves_plan_formula(plan, c->right);
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

double ves_plan_cheap_violation(ves_plan *plan)
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
    double value = p->objective ? ves_plan_formula(plan, p->objective) : 0;
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
    VES_TRY(ves_plan_gradient(plan, index, 0, &p->objective, &sign, p->objective ? 1 : 0, PROGRAM_JUDGE));
    for (int k = 0; k < p->constraints; k++) {
        const ves_constraint_def *c = &p->constraint[k];
        const ves_formula *formula[2] = {c->left, c->right};
        double f = own_tolerance(c) / plan->size[k] * (c->relation == VES_AT_LEAST ? -1 : 1);
        const double seed[2] = {f, -f};
        VES_TRY(ves_plan_gradient(plan, index, 1 + k, formula, seed, 2, PROGRAM_JUDGE));
    }
    VES_TRY(ves_plan_follow(plan, index, outputs));
    memcpy(verdict->gradient, plan->rows, sizeof(double) * (size_t)n);
    for (int k = 0; k < p->constraints && verdict->jacobian; k++)
        memcpy(verdict->jacobian + (size_t)(k * n), plan->rows + (size_t)((1 + k) * p->slots),
               sizeof(double) * (size_t)n);
    for (int o = 0; o < outputs; o++)
        for (int k = 0; k < n; k++)
            if (!isfinite(plan->rows[(size_t)(o * p->slots + k)])) return VES_NO_NUMBER;
    return VES_OK;
}

static ves_status judge_all(ves_plan *plan, const ves_ask *ask, int index, ves_verdict *verdict)
{
    bool gradient = ask->want & VES_WANT_GRADIENT;
    ves_status status = ves_plan_forward(plan, ask->x, index, PROGRAM_JUDGE, gradient);
    if (status == VES_CUT) verdict->violation = ves_plan_cheap_violation(plan);
    VES_TRY(status);
    VES_TRY(ves_plan_validity(plan, index));
    VES_TRY(values(plan, verdict));
    if (verdict->violation > ask->cutoff) return VES_CUT;
    return gradient ? gradients(plan, index, verdict) : VES_OK;
}

static ves_status judge(ves_plan *plan, const ves_ask *ask, int index, ves_verdict *verdict)
{
    plan->cutoff = ask->cutoff;
    ves_status status = judge_all(plan, ask, index, verdict);
    plan->cutoff = HUGE_VAL;
    if (status != VES_OK) verdict->value = NAN;
    if (status != VES_OK && status != VES_CUT) verdict->violation = HUGE_VAL;
    return status;
}

double ves_plan_rate(const ves_plan *plan, int constraint, double multiplier)
{
    const ves_problem *p = plan->problem;
    const ves_constraint_def *c = &p->constraint[constraint];
    double gain = multiplier * own_tolerance(c) / plan->size[constraint]; /* of the verdict's value */
    bool costs = (c->relation == VES_AT_LEAST) != p->maximize;            /* more on the right */
    return costs != ves_plan_turned(p, c) ? gain : -gain;
}

/* The finer grid must tell the same story, or the optimizer has found a hole between the nodes. Two grids
 * agree when the objective does, or, should it be near zero by cancellation, when every measure that is
 * judged does. 1 %: a hole is a matter of factors, and a coarse grid chosen by hand is the user's right. No
 * constraint may be violated by 1 % of its size more than on the coarse one, whatever its `within`: it is met
 * to its tolerance on the grid of the search, and how well that grid measures it is the same question as for
 * the objective. Were it 1e-6 here, an equality could be proved on no grid that measures its sides less well
 * than that. A chosen grid measures to 1e-9 or is refined at the best; what is left is told (`checked`). */
static const double AGREE = 1e-2;

static bool near(double a, double b)
{
    return fabs(a - b) <= AGREE * fmax(fabs(a), fabs(b));
}

static bool measures_near(const ves_plan *plan, const double *fine)
{
    for (int m = 0; m < plan->problem->measures; m++)
        if (plan->runs[PROGRAM_JUDGE][m] && !near(plan->value[m], fine[m])) return false;
    return true;
}

static void violations(ves_plan *plan, double *out)
{
    for (int k = 0; k < plan->problem->constraints; k++)
        out[k] = violation(&plan->problem->constraint[k], excess(plan, k));
}

static bool violations_near(ves_plan *plan, const double *fine)
{
    for (int k = 0; k < plan->problem->constraints; k++)
        if (!(fine[k] <= violation(&plan->problem->constraint[k], excess(plan, k)) + AGREE)) return false;
    return true;
}

/* First the fine grid and the mesh, then the question itself: what is left in the plan and in the verdict is
 * the coarse one. */
static ves_status prove(ves_plan *plan, const ves_ask *ask, ves_verdict *verdict)
{
    ves_ask only = *ask;
    ves_verdict fine = {.status = VES_OK};
    only.want &= ~(unsigned)(VES_WANT_PROOF | VES_WANT_GRADIENT);
    ves_status status = judge(plan, &only, 1, &fine);
    verdict->value = fine.value, verdict->violation = fine.violation; /* where it ends here: CUT, a fold */
    VES_TRY(status);
    VES_TRY(ves_plan_checks(plan, 1));
    memcpy(plan->fine, plan->value, sizeof(double) * (size_t)plan->problem->measures);
    violations(plan, plan->fine_violation);
    if (plan->problem->validity.self_intersection) VES_TRY(ves_plan_crosses(plan));
    only.want = ask->want & ~(unsigned)VES_WANT_PROOF;
    VES_TRY(judge(plan, &only, 0, verdict));
    VES_TRY(ves_plan_checks(plan, 0));
    bool agree = near(verdict->value, fine.value) || measures_near(plan, plan->fine);
    return agree && violations_near(plan, plan->fine_violation) ? VES_OK : VES_COARSE;
}

static ves_status failed(ves_status status, ves_verdict *verdict)
{
    if (status <= VES_OK) return status;
    verdict->status = status;
    if (status != VES_CUT) verdict->violation = HUGE_VAL;
    if (status == VES_BROKEN) verdict->value = NAN;
    return VES_OK;
}

ves_status ves_plan_evaluate(ves_plan *plan, const ves_ask *ask, ves_verdict *verdict)
{
    if (ask->level < 0 || ask->level >= LEVELS) return VES_RANGE;
    if ((ask->want & VES_WANT_GRADIENT) && !plan->gradients) return VES_ABSENT;
    verdict->status = VES_OK;
    plan->broken = -1;
    bool proof = ask->want & VES_WANT_PROOF;
    return failed(proof ? prove(plan, ask, verdict) : judge(plan, ask, ask->level, verdict), verdict);
}

/* --- a design as people see it --- */

ves_status ves_plan_measure_all(ves_plan *plan, const double *x, int level)
{
    ves_status status = ves_plan_forward(plan, x, level, PROGRAM_ALL, false);
    return status == VES_OK ? ves_plan_validity(plan, level) : status;
}

static void tell(ves_plan *plan, ves_design *design)
{
    const ves_problem *p = plan->problem;
    memcpy(plan->told, plan->value, sizeof(double) * (size_t)p->measures);
    design->violation = 0;
    design->feasible = true;
    for (int k = 0; k < p->constraints; k++) {
        const ves_constraint_def *c = &p->constraint[k];
        double e = excess(plan, k), v = isfinite(e) ? violation(c, e) : NAN;
        plan->sides[k] =
            (ves_sides){ves_plan_formula(plan, c->left), ves_plan_formula(plan, c->right), v, v <= c->within};
        if (isnan(v)) design->status = VES_NO_NUMBER; /* as in values(): the search does not accept it */
        design->violation = fmax(design->violation, v);
        design->feasible = design->feasible && plan->sides[k].holds;
    }
    for (int k = 0; k < p->validity.checks; k++)
        plan->checked[k] = ves_plan_holds(plan, p->validity.check[k].formula);
    for (int k = p->kinds - 1; k >= 0; k--)
        if (ves_plan_holds(plan, p->kind[k].formula)) design->kind = k;
    if (p->objective) design->objective = ves_plan_formula(plan, p->objective);
    if (p->objective && !isfinite(design->objective)) design->status = VES_NO_NUMBER;
    if (design->status == VES_OK) return;
    design->kind = -1;
    design->objective = design->violation = NAN;
    design->feasible = false;
}

ves_status ves_plan_measure(ves_plan *plan, const double *x, int level, ves_design *design)
{
    const ves_problem *p = plan->problem;
    if (level < 0 || level >= LEVELS) return VES_RANGE;
    ves_status status = ves_plan_measure_all(plan, x, level);
    if (status < VES_OK) return status;
    *design = (ves_design){.status = status,
                           .x = plan->block,
                           .slot = plan->block,
                           .measure = plan->told,
                           .side = plan->sides,
                           .check = plan->checked,
                           .kind = -1,
                           .objective = NAN,
                           .violation = NAN,
                           .similarity = plan->scaled ? plan->similarity : NAN};
    for (int m = 0; m < p->measures; m++) plan->told[m] = NAN;
    for (int k = 0; k < p->constraints; k++) plan->sides[k] = (ves_sides){NAN, NAN, NAN, false};
    for (int k = 0; k < p->validity.checks; k++) plan->checked[k] = false;
    if (status == VES_OK) tell(plan, design);
    return design->status;
}

/* Forward: programs. A program is a set of measures; running it samples what they read, once, and measures.
 * With solve: the unknown is found first, with scale: the similarity. */
#include "plan/shell.h"

#include <math.h>

static ves_status sample(ves_plan *plan, int index, plan_program which, bool gradient)
{
    plan_level *l = &plan->level[index];
    if (l->shell) l->shell->solved = false;
    for (int k = 0; k < l->sites; k++)
        VES_TRY(ves_site_sample(plan, &l->site[k], l->site[k].needs[which], gradient));
    return VES_OK;
}

static ves_status measure_cost(ves_plan *plan, int index, plan_program which, bool dear)
{
    const ves_problem *p = plan->problem;
    for (int m = 0; m < p->measures; m++) {
        if (!plan->runs[which][m] || (p->measure[m].measure->cost > 0) != dear) continue;
        if (p->measure[m].measure->shell && dear) VES_TRY(ves_shell_run(plan, index));
        ves_status status =
            p->measure[m].measure->eval(&plan->level[index].instance[m].input, &plan->value[m]);
        /* a plugin's own word for "cannot be measured"; only the plan cuts, only modes of buckling are loose, only shells
         * lack a wall */
        const ves_measure *measure = p->measure[m].measure;
        bool own = (measure->buckles && (status == VES_LOOSE || status == VES_NO_CONVERGENCE)) ||
                   (measure->shell && status == VES_NO_WALL);
        if ((status >= VES_NO_SCALE && !own) || status == VES_CUT) status = VES_NO_NUMBER;
        if (status == VES_OK && !isfinite(plan->value[m])) status = VES_NO_NUMBER;
        if (status == VES_NO_NUMBER) plan->numberless = m;
        VES_TRY(status);
    }
    return VES_OK;
}

/* Cheap measures first: a candidate that they already put beyond the cutoff never pays for the dear ones. */
static ves_status measure(ves_plan *plan, int index, plan_program which)
{
    VES_TRY(measure_cost(plan, index, which, false));
    if (which == PROGRAM_JUDGE && plan->any_dear && ves_plan_cheap_violation(plan) > plan->cutoff)
        return VES_CUT;
    return measure_cost(plan, index, which, true);
}

double ves_plan_formula(ves_plan *plan, const ves_formula *formula)
{
    return ves_formula_eval(formula, plan->block, plan->value, plan->formula_room);
}

/* The similarity of scale: MEASURE == target, for a measure of degree d: s = (target / measure)^(1/d). */
static ves_status scale(ves_plan *plan, int index, bool gradient)
{
    const ves_scale *sc = plan->problem->scale;
    if (!sc || plan->frozen) return VES_OK;
    VES_TRY(sample(plan, index, PROGRAM_SCALE, gradient));
    VES_TRY(measure(plan, index, PROGRAM_SCALE));
    double ratio = ves_plan_formula(plan, sc->target) / plan->value[sc->measure];
    double s = pow(ratio, 1. / plan->problem->measure[sc->measure].measure->degree);
    if (!(ratio > 0) || !isfinite(s)) return VES_NO_SCALE;
    plan->similarity = s, plan->scaled = true;
    return VES_OK;
}

ves_status ves_plan_run(ves_plan *plan, int index, plan_program which, bool gradient)
{
    plan->numberless = -1;
    if (ves_plan_limit(plan)) return VES_OUTSIDE;
    for (int k = 0; k < plan->problem->patches; k++) VES_TRY(ves_patch_status(plan->patch[k]));
    VES_TRY(scale(plan, index, gradient));
    VES_TRY(sample(plan, index, which, gradient));
    return measure(plan, index, which);
}

/* left - right of solve's equation when the unknown is h. */
static ves_status residual(ves_plan *plan, const double *x, int index, double h, double *value)
{
    ves_plan_bind(plan, x, h);
    VES_TRY(ves_plan_run(plan, index, PROGRAM_SOLVE, false));
    *value = ves_plan_formula(plan, plan->problem->solve->left) -
             ves_plan_formula(plan, plan->problem->solve->right);
    return isfinite(*value) ? VES_OK : VES_NO_NUMBER;
}

/* An end of the bracket; where it cannot be measured (a tube of no height, say), a point a little inside,
 * the first of a few that can: the same for every candidate. */
static ves_status bracket_end(ves_plan *plan, const double *x, int index, bool upper, double *h,
                              double *value)
{
    static const double inward[] = {0, 1e-6, 1e-4, 1e-2};
    const ves_solve *s = plan->problem->solve;
    for (size_t k = 0; k < sizeof inward / sizeof *inward; k++) {
        double way = inward[k] * (s->hi - s->lo);
        *h = upper ? s->hi - way : s->lo + way;
        ves_status status = residual(plan, x, index, *h, value);
        if (status <= VES_OK) return status;
    }
    /* ves_plan_why is to tell of the end that the file gives */
    ves_plan_bind(plan, x, upper ? s->hi : s->lo);
    return ves_plan_limit(plan) ? VES_OUTSIDE : VES_NO_BRACKET;
}

/* Where a function that is continuous changes its sign it is small: h is exact to 4e-16 of it, so that even
 * a root's infinite slope, as of sqrt(h), leaves 2e-8. Across a jump or a pole it stays as large as it
 * was. */
static const double VANISHES = 1e-6;

/* A bracketed root by inverse quadratic interpolation, secant or bisection (Brent 1973, ch. 4). It starts
 * from the whole bracket for every candidate: the same x gives the same bits whatever was evaluated
 * before. */
static ves_status solve(ves_plan *plan, const double *x, int index, double *root)
{
    double a, b, fa, fb;
    VES_TRY(bracket_end(plan, x, index, false, &a, &fa));
    VES_TRY(bracket_end(plan, x, index, true, &b, &fb));
    if ((fa > 0) == (fb > 0) && fa != 0 && fb != 0) return VES_NO_ROOT;
    double c = a, fc = fa, step = b - a, before = step, small = VANISHES * fmax(fabs(fa), fabs(fb));
    for (int k = 0; k < 100; k++) {
        if ((fb > 0) == (fc > 0)) c = a, fc = fa, step = before = b - a;
        if (fabs(fc) < fabs(fb)) {
            a = b, b = c, c = a;
            fa = fb, fb = fc, fc = fa;
        }
        double tolerance = 4e-16 * fabs(b), half = (c - b) / 2;
        if (fabs(half) <= tolerance || fb == 0) break;
        if (fabs(before) >= tolerance && fabs(fa) > fabs(fb)) {
            double r = fb / fa, p, q;
            if (a == c) {
                p = 2 * half * r, q = 1 - r;
            } else {
                double t = fa / fc, w = fb / fc;
                p = r * (2 * half * t * (t - w) - (b - a) * (w - 1)), q = (t - 1) * (w - 1) * (r - 1);
            }
            if (p > 0) q = -q;
            p = fabs(p);
            bool good = 2 * p < fmin(3 * half * q - fabs(tolerance * q), fabs(before * q));
            before = good ? step : half;
            step = good ? p / q : half;
        } else {
            step = before = half;
        }
        a = b, fa = fb;
        b += fabs(step) > tolerance ? step : half > 0 ? tolerance : -tolerance;
        ves_status status = residual(plan, x, index, b, &fb);
        if (isinf(fb)) return VES_NO_ROOT; /* a pole, met exactly */
        VES_TRY(status);
    }
    *root = b;
    return fabs(fb) <= small ? VES_OK : VES_NO_ROOT;
}

ves_status ves_plan_forward(ves_plan *plan, const double *x, int index, plan_program which, bool gradient)
{
    double unknown = 0;
    ves_status status = plan->problem->solve ? solve(plan, x, index, &unknown) : VES_OK;
    if (status != VES_OK) ves_plan_unscale(plan); /* the size was that of a trial */
    VES_TRY(status);
    ves_plan_bind(plan, x, unknown);
    return ves_plan_run(plan, index, which, gradient);
}

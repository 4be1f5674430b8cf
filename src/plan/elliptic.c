/* Elliptic or not, and of a size that can be solved: what is wrong with the coefficients of a patch, in words. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plan/inside.h"

enum { NAME = 100, TEXT = 300 };

/* The operator of coordinate k as the block has it. */
static ves_operator operator_of(const ves_plan *plan, const ves_patch_def *d, int k)
{
    ves_operator op = {.power = d->power, .general = d->general};
    memcpy(op.parameter, plan->block + d->parameter[k],
           sizeof(double) * (size_t)ves_operator_parameters(&op));
    return op;
}

/* "c0 t^2 + c1 t + c2" */
static void polynomial(int N, char text[NAME])
{
    int at = 0;
    for (int k = 0; k < N - 1; k++) at += snprintf(text + at, (size_t)(NAME - at), "c%d t^%d + ", k, N - k);
    snprintf(text + at, (size_t)(NAME - at), "c%d t + c%d", N - 1, N);
}

/* Its value at t; what is rounding beside its terms is 0. */
static double value_at(const ves_operator *op, double t)
{
    double sum = 0, size = 0;
    for (int k = 0; k <= op->power; k++) {
        sum = sum * t + op->parameter[k];
        size = size * t + fabs(op->parameter[k]);
    }
    return fabs(sum) < 1e-14 * size ? 0 : sum;
}

static void reason(const ves_operator *op, double t, char text[TEXT])
{
    char name[NAME];
    polynomial(op->power, name);
    for (int k = 0; k <= op->power; k++)
        if (!isfinite(op->parameter[k])) {
            snprintf(text, TEXT, "c%d is not a finite number", k);
            return;
        }
    if (isfinite(t))
        snprintf(text, TEXT, "%s is %.3g at t = %.3g", name, value_at(op, t), t);
    else
        snprintf(text, TEXT, "%s: c0 must be greater than 0, got %.6g", name, op->parameter[0]);
}

/* The first coordinate whose operator is not elliptic, or else cannot be solved, or -1. */
static int culprit(const ves_plan *plan, const ves_patch_def *d, bool elliptic)
{
    for (int k = 0; k < d->operators; k++) {
        double t;
        ves_operator op = operator_of(plan, d, k);
        if (elliptic ? !ves_operator_measure(&op).solvable : !ves_operator_elliptic(&op, &t)) return k;
    }
    return -1;
}

/* Why an elliptic operator cannot be solved. */
static void oversize(const ves_operator *op, char text[TEXT])
{
    ves_operator_size s = ves_operator_measure(op);
    if (s.odd >= 0)
        snprintf(
            text, TEXT,
            "c%d is %.3g, coefficients other than 0 must be between 1e-%d and 1e%d (only their ratios count)",
            s.odd, op->parameter[s.odd], VES_COEFFICIENT_DECADES, VES_COEFFICIENT_DECADES);
    else if (s.fast > VES_RATE_MOST)
        snprintf(text, TEXT,
                 "by the ratios of its coefficients mode n dies out like e^(-%.2g n u), at most e^(-%.2g n "
                 "u) is possible: make those after c0 smaller",
                 s.fast, (double)VES_RATE_MOST);
    else
        snprintf(
            text, TEXT,
            "by the ratios of its coefficients parts of mode n die out like e^(-%.2g n u) and e^(-%.2g n u), "
            "at most %.2g times as fast as others is possible: bring the coefficients nearer together",
            s.slow, s.fast, (double)VES_RATE_SPREAD);
}

static bool tell(const ves_plan *plan, const ves_patch_def *d, ves_severity severity, const char *what,
                 ves_diag *diag)
{
    static const char *const coordinate[] = {" for x", " for y", " for z"};
    char text[TEXT];
    double t;
    int k = culprit(plan, d, false);
    bool elliptic = k < 0;
    if (elliptic) k = culprit(plan, d, true);
    if (k < 0) return false;
    ves_operator op = operator_of(plan, d, k);
    ves_status status = elliptic ? VES_UNDETERMINED : VES_NOT_ELLIPTIC;
    if (elliptic)
        oversize(&op, text);
    else
        ves_operator_elliptic(&op, &t), reason(&op, t, text);
    ves_diag_add(diag, severity, severity == VES_ERROR ? VES_RANGE : status, d->mark,
                 "%s%sthe operator of patch \"%s\"%s %s: %s%s", what, *what ? ": " : "", d->name,
                 d->operators > 1 ? coordinate[k] : "", elliptic ? "cannot be solved" : "is not elliptic",
                 text, elliptic ? "" : "; waves would run along u instead of dying out");
    return true;
}

static bool varies(const ves_plan *plan, const ves_patch_def *d)
{
    const bool *varying = plan->problem->varying;
    bool found = false;
    for (int k = 0; k < d->operators; k++)
        for (int i = 0; i <= (d->general ? d->power : 0); i++) found = found || varying[d->parameter[k] + i];
    return found;
}

ves_status ves_plan_elliptic(const ves_plan *plan, int patch, ves_diag *diag)
{
    const ves_problem *p = plan->problem;
    const ves_patch_def *d = &p->patch[patch];
    if (ves_patch_status(plan->patch[patch]) == VES_OK) return VES_OK;
    if (p->solve && varies(plan, d)) return VES_OK; /* the unknown may make it so: each candidate tells */
    const char *what = varies(plan, d) ? "at the start" : "";
    return tell(plan, d, VES_ERROR, what, diag) ? VES_RANGE : VES_OK;
}

bool ves_plan_elliptic_tell(const ves_plan *plan, const char *what, ves_diag *diag)
{
    for (int k = 0; k < plan->problem->patches; k++) {
        const ves_patch_def *d = &plan->problem->patch[k];
        if (ves_patch_status(plan->patch[k]) != VES_OK && tell(plan, d, VES_WARNING, what, diag)) return true;
    }
    return false;
}

/* Elliptic or not: what is wrong with the coefficients of a patch, in words. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plan/inside.h"

enum { NAME = 100, TEXT = 200 };

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

/* The first coordinate whose operator is not elliptic, or -1; and why. */
static int culprit(const ves_plan *plan, const ves_patch_def *d, char text[TEXT])
{
    for (int k = 0; k < d->operators; k++) {
        double t;
        ves_operator op = operator_of(plan, d, k);
        if (ves_operator_elliptic(&op, &t)) continue;
        reason(&op, t, text);
        return k;
    }
    return -1;
}

static bool tell(const ves_plan *plan, const ves_patch_def *d, ves_severity severity, const char *what,
                 ves_diag *diag)
{
    static const char *const coordinate[] = {" for x", " for y", " for z"};
    char text[TEXT];
    int k = culprit(plan, d, text);
    if (k < 0) return false;
    ves_diag_add(diag, severity, severity == VES_ERROR ? VES_RANGE : VES_NOT_ELLIPTIC, d->mark,
                 "%s%sthe operator of patch \"%s\"%s is not elliptic: %s; waves would run along u instead of "
                 "dying out",
                 what, *what ? ": " : "", d->name, d->operators > 1 ? coordinate[k] : "", text);
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
    if (ves_patch_status(plan->patch[patch]) != VES_NOT_ELLIPTIC) return VES_OK;
    if (p->solve && varies(plan, d)) return VES_OK; /* the unknown may make it so: each candidate tells */
    const char *what = varies(plan, d) ? "at the start" : "";
    return tell(plan, d, VES_ERROR, what, diag) ? VES_RANGE : VES_OK;
}

bool ves_plan_elliptic_tell(const ves_plan *plan, const char *what, ves_diag *diag)
{
    for (int k = 0; k < plan->problem->patches; k++) {
        const ves_patch_def *d = &plan->problem->patch[k];
        if (ves_patch_status(plan->patch[k]) == VES_NOT_ELLIPTIC && tell(plan, d, VES_WARNING, what, diag))
            return true;
    }
    return false;
}

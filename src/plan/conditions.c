/* Do the conditions of a patch determine its surface, and what do they make of small changes of the data? Looked
 * at mode by mode, at the start design. */
#include <math.h>
#include <stdio.h>

#include "plan/inside.h"

/* Beyond what e^(lam u_N) explains, and beyond what 32 digits can tell from singular. */
static const double SINGULAR = 1e10, CONDITION = 1e28;

enum { TEXT = 400, LISTED = 8 };

/* Half of the conditions at each end, each with all lower derivatives: regular for every operator. */
static bool hermite(const ves_patch_def *d)
{
    for (int end = 0; end < 2; end++)
        for (int k = 0; k < d->power; k++) {
            bool found = false;
            for (int j = 0; j < d->conditions; j++)
                found = found || (d->condition[j].u == end && d->condition[j].derivative == k);
            if (!found) return false;
        }
    return true;
}

/* "X at u = 0, X_u at u = 0.5, ..." */
static void list(const ves_patch_def *d, char text[TEXT])
{
    static const char *const name[] = {"X", "X_u", "X_uu"};
    int at = 0;
    text[0] = 0;
    for (int j = 0; j < d->conditions && j < LISTED; j++) {
        const ves_condition *c = &d->condition[j];
        char derivative[32];
        if (c->derivative < 3)
            snprintf(derivative, sizeof derivative, "%s", name[c->derivative]);
        else
            snprintf(derivative, sizeof derivative, "d^%dX/du^%d", c->derivative, c->derivative);
        at += snprintf(text + at, (size_t)(TEXT - at), "%s%s at u = %.6g", j ? ", " : "", derivative, c->u);
    }
    if (d->conditions > LISTED) snprintf(text + at, (size_t)(TEXT - at), " ... (%d in all)", d->conditions);
}

static ves_status refuse(const ves_patch_def *d, int n, ves_diag *diag)
{
    char text[TEXT];
    list(d, text);
    return ves_diag_add(
        diag, VES_ERROR, VES_SINGULAR, d->mark,
        "the conditions of patch \"%s\" do not determine a surface (mode %d is left free): %s; "
        "a derivative is safe where the position and all lower derivatives are given too",
        d->name, n, text);
}

static void warn(const ves_patch_def *d, int n, double lebesgue, ves_diag *diag)
{
    ves_diag_add(
        diag, VES_WARNING, VES_OK, d->mark,
        "patch \"%s\": conditions inside it amplify mode %d of their curves up to %.2g times; place them "
        "by nodes: chebyshev, or solve fewer modes (remainder: {modes: %d})",
        d->name, n, lebesgue, n > 0 ? n - 1 : 0);
}

/* The decay rate of mode n; a general operator's is not known, and of order n. */
static double rate(const ves_plan *plan, const ves_patch_def *d, int n)
{
    return d->general ? n : n * plan->block[d->parameter[0]];
}

ves_status ves_plan_conditions(const ves_plan *plan, int patch, ves_diag *diag)
{
    const ves_patch_def *d = &plan->problem->patch[patch];
    ves_patch *p = plan->patch[patch];
    if (d->kind != VES_PATCH_PDE || ves_patch_status(p) != VES_OK || hermite(d)) return VES_OK;
    int told = -1;
    double largest = 0;
    for (int n = 0; n <= ves_patch_modes(p); n++) {
        ves_amplification found;
        if (!ves_patch_amplification(p, n, &found)) return VES_OK;
        double expected = exp(fmin(700, rate(plan, d, n) * ves_patch_depth(p)));
        if (found.condition > CONDITION || found.lebesgue > SINGULAR * expected) return refuse(d, n, diag);
        if (found.lebesgue > VES_PATCH_AMPLIFIED && told < 0) told = n;
        largest = fmax(largest, found.lebesgue);
    }
    if (told >= 0) warn(d, told, largest, diag);
    return VES_OK;
}

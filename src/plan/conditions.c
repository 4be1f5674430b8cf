/* Do the conditions of a patch determine its surface, and what do they make of small changes of the data? Looked
 * at mode by mode, at the start design. */
#include <math.h>
#include <stdio.h>

#include "base/vector.h"
#include "plan/inside.h"

/* Beyond what e^(lam u_N) explains, and beyond what 32 digits can tell from singular. */
static const double SINGULAR = 1e10, CONDITION = 1e28;

/* So near to Chebyshev's nodes, others are as good. */
static const double CHEBYSHEV = 0.01;

enum { TEXT = 400, LISTED = 8 };

/* Half of the conditions of this order at each end, each with all lower derivatives: regular for every
 * operator. */
static bool hermite(const ves_patch_def *d, int power)
{
    for (int end = 0; end < 2; end++)
        for (int k = 0; k < power; k++) {
            bool found = false;
            for (int j = 0; j < 2 * power; j++)
                found = found || (d->condition[j].u == end && d->condition[j].derivative == k);
            if (!found) return false;
        }
    return true;
}

static bool regular(const ves_patch_def *d)
{
    return hermite(d, d->power) && (!d->lower || hermite(d, d->lower));
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

static ves_status refuse(const ves_patch_def *d, double n, ves_diag *diag)
{
    char text[TEXT];
    list(d, text);
    return ves_diag_add(
        diag, VES_ERROR, VES_SINGULAR, d->mark,
        "the conditions of patch \"%s\" do not determine a surface (mode %g is left free): %s; "
        "a derivative is safe where the position and all lower derivatives are given too",
        d->name, n, text);
}

/* How many positions there are, when they are all of the conditions and not at Chebyshev's nodes; else 0. */
static int misplaced(const ves_patch_def *d)
{
    double far = 0;
    for (int j = 0; j < d->conditions; j++) {
        int before = 0;
        if (d->condition[j].derivative) return 0;
        for (int i = 0; i < d->conditions; i++) before += d->condition[i].u < d->condition[j].u;
        double node = (1 - cos(VES_PI * before / (d->conditions - 1))) / 2;
        far = fmax(far, fabs(d->condition[j].u - node));
    }
    return far > CHEBYSHEV ? d->conditions : 0;
}

/* The largest amplification, and the first mode beyond what is harmless. */
typedef struct findings {
    int first, worst; /* modes; -1: none */
    double at_first, at_worst;
} findings;

static void warn(const ves_patch_def *d, const findings *f, ves_diag *diag)
{
    char high[80] = "", fewer[80] = "", place[160];
    int count = misplaced(d);
    if (f->worst != f->first) snprintf(high, sizeof high, ", of mode %d %.2g times", f->worst, f->at_worst);
    if (f->first > 1)
        snprintf(fewer, sizeof fewer, "solve fewer modes, remainder: {modes: %d}, or ", f->first - 1);
    if (count)
        snprintf(
            place, sizeof place,
            "place them nearer to the ends, as Chebyshev's nodes are, u = (1 - cos(pi*i/%d))/2 for i = 0 "
            "to %d (nodes: chebyshev of sections)",
            count - 1, count - 1);
    else
        snprintf(place, sizeof place, "%s",
                 f->first > 1 ? "place them nearer to the ends" : "move them, or give others");
    ves_diag_add(diag, VES_WARNING, VES_OK, d->mark,
                 "patch \"%s\": its conditions make of mode %d of their curves %.2g times as much%s: digits "
                 "are lost, and fine detail swamps the surface; %s%s",
                 d->name, f->first, f->at_first, high, fewer, place);
}

/* The decay rate of mode n; a general operator's is not known, and of order n. */
static double rate(const ves_plan *plan, const ves_patch_def *d, double n)
{
    return d->general ? n : n * plan->block[d->parameter[0]];
}

double ves_plan_omega(const ves_plan *plan, int patch)
{
    const ves_patch_def *d = &plan->problem->patch[patch];
    const ves_patch *p = plan->patch[patch];
    if (d->kind != VES_PATCH_PDE || ves_patch_band(p) == ves_patch_modes(p)) return NAN;
    if (d->omega >= 0) return plan->block[d->omega];
    return d->general ? NAN : rate(plan, d, ves_patch_modes(p) + 1);
}

/* The mode, whole or not, at which all of the remainder is taken. */
static double rest(const ves_plan *plan, int patch)
{
    const ves_patch_def *d = &plan->problem->patch[patch];
    double a = d->omega < 0 ? 0 : plan->block[d->parameter[0]];
    return a > 0 ? plan->block[d->omega] / a : ves_patch_modes(plan->patch[patch]) + 1;
}

/* Looks at mode n; true: it is left free. */
static bool look(const ves_plan *plan, int patch, double n, findings *f)
{
    const ves_patch *p = plan->patch[patch];
    ves_amplification found;
    if (!ves_patch_amplification(p, n, &found)) return false;
    double depth = rate(plan, &plan->problem->patch[patch], n) * ves_patch_depth(p);
    if (found.condition > CONDITION || found.lebesgue > SINGULAR * exp(fmin(700, depth))) return true;
    if (n != floor(n) || n > ves_patch_modes(p)) return false;
    if (found.amplified > VES_PATCH_AMPLIFIED && f->first < 0)
        f->first = (int)n, f->at_first = found.amplified;
    if (found.amplified > f->at_worst) f->worst = (int)n, f->at_worst = found.amplified;
    return false;
}

/* The mode that the conditions leave free, or -1. */
static double free_find(const ves_plan *plan, int patch, findings *f)
{
    const ves_patch *p = plan->patch[patch];
    *f = (findings){.first = -1, .worst = -1};
    for (int n = 0; n <= ves_patch_modes(p); n++)
        if (look(plan, patch, n, f)) return n;
    double n = rest(plan, patch);
    return ves_patch_band(p) > ves_patch_modes(p) && look(plan, patch, n, f) ? n : -1;
}

ves_status ves_plan_conditions(const ves_plan *plan, int patch, ves_diag *diag)
{
    const ves_patch_def *d = &plan->problem->patch[patch];
    findings f;
    if (d->kind != VES_PATCH_PDE || ves_patch_status(plan->patch[patch]) != VES_OK || regular(d))
        return VES_OK;
    double n = free_find(plan, patch, &f);
    if (n >= 0) return refuse(d, n, diag);
    if (f.first >= 0) warn(d, &f, diag);
    return VES_OK;
}

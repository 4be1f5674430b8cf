/* Do the conditions of a patch determine its surface, and what do they make of small changes of the data? Looked
 * at mode by mode, at the start design. */
#include <math.h>
#include <stdio.h>

#include "base/vector.h"
#include "plan/inside.h"

/* So near to Chebyshev's nodes, others are as good. */
static const double CHEBYSHEV = 0.01;

enum { TEXT = 400, LISTED = 8, STEPS = 40 };

/* Is the derivative below this one given at the same place? */
static bool supported(const ves_patch_def *d, const ves_condition *c)
{
    for (int j = 0; j < d->conditions; j++)
        if (d->condition[j].u == c->u && d->condition[j].derivative == c->derivative - 1) return true;
    return c->derivative == 0;
}

/* "X at u = 0, X_u at u = 0.5, ...": all conditions, or derivatives without the next lower one only. How many. */
static int list(const ves_patch_def *d, bool all, char text[TEXT])
{
    static const char *const name[] = {"X", "X_u", "X_uu"};
    int at = 0, count = 0;
    text[0] = 0;
    for (int j = 0; j < d->conditions; j++) {
        const ves_condition *c = &d->condition[j];
        char derivative[32];
        if (!all && supported(d, c)) continue;
        if (++count > LISTED) continue;
        if (c->derivative < 3)
            snprintf(derivative, sizeof derivative, "%s", name[c->derivative]);
        else
            snprintf(derivative, sizeof derivative, "d^%dX/du^%d", c->derivative, c->derivative);
        at += snprintf(text + at, (size_t)(TEXT - at), "%s%s at u = %.6g", count > 1 ? ", " : "", derivative,
                       c->u);
    }
    if (count > LISTED) snprintf(text + at, (size_t)(TEXT - at), " ... (%d in all)", count);
    return count;
}

/* Where, how gravely and after what words something is told. */
typedef struct telling {
    const ves_plan *plan;
    int patch;
    ves_severity severity;
    ves_status status;
    const char *what;
    ves_diag *diag;
} telling;

static const ves_patch_def *def_of(const telling *t)
{
    return &t->plan->problem->patch[t->patch];
}

static void tell_free(const telling *t, double n)
{
    const ves_patch_def *d = def_of(t);
    char text[TEXT];
    list(d, true, text);
    ves_diag_add(t->diag, t->severity, t->status, d->mark,
                 "%s%sthe conditions of patch \"%s\" do not determine a surface (mode %g is left free): %s; "
                 "a derivative is safe where the position and all lower derivatives are given too",
                 t->what, *t->what ? ": " : "", d->name, n, text);
}

enum { REST = -1 };

/* Of a mode, or of the remainder. */
static bool amplification(const ves_plan *plan, int patch, double n, ves_amplification *found)
{
    const ves_patch *p = plan->patch[patch];
    int omega = plan->problem->patch[patch].omega;
    if (n == REST && omega >= 0) return ves_patch_amplification_at(p, plan->block[omega], found);
    return ves_patch_amplification(p, n == REST ? ves_patch_rest(p) : n, found);
}

/* The largest lam that can still be solved, a little less. `bad` is what cannot. */
static double limit(const telling *t, double n, const ves_amplification *bad)
{
    const ves_patch *p = t->plan->patch[t->patch];
    bool given = n == REST && def_of(t)->omega >= 0;
    double low = 0, high = 1, whole = n == REST ? ves_patch_rest(p) : n;
    for (int k = 0; k < STEPS; k++) {
        double middle = (low + high) / 2;
        ves_amplification found;
        if (given)
            ves_patch_amplification_at(p, middle * bad->lam, &found);
        else
            ves_patch_amplification(p, middle * whole, &found);
        *(found.solvable ? &low : &high) = middle;
    }
    return 0.99 * low * bad->lam;
}

static void tell_close(const telling *t)
{
    char text[TEXT];
    list(def_of(t), true, text);
    ves_diag_add(
        t->diag, t->severity, t->status, def_of(t)->mark,
        "%s%sthe conditions of patch \"%s\" are too near to each other to be solved: %s; move them apart",
        t->what, *t->what ? ": " : "", def_of(t)->name, text);
}

static void tell_beyond(const telling *t, double n, const ves_amplification *found)
{
    const ves_patch_def *d = def_of(t);
    char which[40] = "the remainder", advice[80] = "make omega smaller, or auto", reason[160];
    double depth = ves_layout_depth(ves_patch_layout(t->plan->patch[t->patch])),
           most = n == 0 ? 0 : limit(t, n, found);
    if (most <= 0) {
        tell_close(t);
        return;
    }
    if (n > 0) snprintf(which, sizeof which, "mode %g", n);
    if (n > 1)
        snprintf(advice, sizeof advice, "solve fewer modes, remainder: {modes: %g}", n - 1);
    else if (n > 0 || d->omega < 0)
        snprintf(advice, sizeof advice, "make %s smaller", d->general ? "the coefficients after c0" : "a");
    if (depth > 0)
        snprintf(reason, sizeof reason,
                 "its conditions make about e^(lam u_N) = e^%.3g times as much of it (u_N = %.3g, how far "
                 "number %d "
                 "stands from its nearer end)",
                 found->lam * depth, depth, d->power);
    else
        snprintf(reason, sizeof reason, "parts of it die out too fast beside others");
    ves_diag_add(t->diag, t->severity, t->status, d->mark,
                 "%s%spatch \"%s\" cannot be solved for %s: %s; lam = %.4g can be %.3g at most: %s", t->what,
                 *t->what ? ": " : "", d->name, which, reason, found->lam, most, advice);
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

/* What to do about it, besides solving fewer modes. */
static void place_advise(const ves_plan *plan, int patch, const findings *f, char place[2 * TEXT])
{
    const ves_patch_def *d = &plan->problem->patch[patch];
    int count = misplaced(d);
    char text[TEXT];
    if (list(d, false, text))
        snprintf(place, 2 * TEXT,
                 "give the position and all lower derivatives at the same u, or give others, in place of %s",
                 text);
    else if (count)
        snprintf(
            place, 2 * TEXT,
            "place them nearer to the ends, as Chebyshev's nodes are, u = (1 - cos(pi*i/%d))/2 for i = 0 "
            "to %d (nodes: chebyshev of sections)",
            count - 1, count - 1);
    else if (f->first)
        snprintf(place, 2 * TEXT, "place them nearer to the ends");
    else
        snprintf(place, 2 * TEXT, "move them apart");
}

static void warn(const ves_plan *plan, int patch, const findings *f, ves_diag *diag)
{
    const ves_patch_def *d = &plan->problem->patch[patch];
    char high[80] = "", fewer[80] = "", place[2 * TEXT];
    if (f->worst != f->first) snprintf(high, sizeof high, ", of mode %d %.2g times", f->worst, f->at_worst);
    if (f->first > 1)
        snprintf(fewer, sizeof fewer, "solve fewer modes, remainder: {modes: %d}, or ", f->first - 1);
    place_advise(plan, patch, f, place);
    ves_diag_add(diag, VES_WARNING, VES_OK, d->mark,
                 "patch \"%s\": its conditions make of mode %d of their curves %.2g times as much%s: digits "
                 "are lost, and fine detail swamps the surface; %s%s",
                 d->name, f->first, f->at_first, high, fewer, place);
}

double ves_plan_omega(const ves_plan *plan, int patch)
{
    const ves_patch_def *d = &plan->problem->patch[patch];
    const ves_patch *p = plan->patch[patch];
    if (d->kind != VES_PATCH_PDE || ves_patch_band(p) == ves_patch_modes(p)) return NAN;
    if (d->omega >= 0) return plan->block[d->omega];
    return d->general ? NAN : ves_patch_rest(p) * plan->block[d->parameter[0]];
}

double ves_plan_rest(const ves_plan *plan, int patch)
{
    const ves_patch_def *d = &plan->problem->patch[patch];
    const ves_patch *p = plan->patch[patch];
    if (d->kind != VES_PATCH_PDE || ves_patch_band(p) == ves_patch_modes(p) || d->omega >= 0) return NAN;
    return ves_patch_rest(p);
}

/* Tells of mode n, or of the remainder, if it cannot be solved; else enters what it finds. */
static bool look(const telling *t, double n, findings *f)
{
    ves_amplification found;
    if (!amplification(t->plan, t->patch, n, &found)) return false;
    if (!found.solvable) {
        if (found.free)
            tell_free(t, n == REST ? ves_patch_rest(t->plan->patch[t->patch]) : n);
        else
            tell_beyond(t, n, &found);
        return true;
    }
    if (n == REST || ves_layout_regular(ves_patch_layout(t->plan->patch[t->patch]))) return false;
    if (found.amplified > VES_PATCH_AMPLIFIED && f->first < 0)
        f->first = (int)n, f->at_first = found.amplified;
    if (found.amplified > f->at_worst) f->worst = (int)n, f->at_worst = found.amplified;
    return false;
}

/* Tells of the first mode that cannot be solved. */
static bool unsolved(const telling *t, findings *f)
{
    const ves_patch *p = t->plan->patch[t->patch];
    const ves_patch_def *d = def_of(t);
    *f = (findings){.first = -1, .worst = -1};
    if (d->kind != VES_PATCH_PDE || ves_patch_status(p) != VES_OK ||
        (!d->general && ves_layout_regular(ves_patch_layout(p))))
        return false;
    for (int n = 0; n <= ves_patch_modes(p); n++)
        if (look(t, n, f)) return true;
    return ves_patch_band(p) > ves_patch_modes(p) && look(t, REST, f);
}

int ves_plan_worst(const ves_plan *plan, int patch)
{
    findings f;
    telling t = {plan, patch, VES_NOTE, VES_OK, "", NULL};
    return unsolved(&t, &f) ? 0 : f.worst;
}

/* More than this share of the curves in the remainder is no detail of them any more. */
static const double LEFT = 0.01;

/* The file did not say how many modes to solve, and few were chosen: what is drawn is not what it asks for. */
static void warn_left(const ves_plan *plan, int patch, ves_diag *diag)
{
    const ves_patch *p = plan->patch[patch];
    const ves_patch_def *d = &plan->problem->patch[patch];
    double left = d->kind == VES_PATCH_PDE && d->modes == 0 ? ves_patch_tail(p) : 0;
    if (left <= LEFT) return;
    ves_diag_add(
        diag, VES_WARNING, VES_OK, d->mark,
        "patch \"%s\": %d of its %d modes are solved, the next would be amplified too much; %.3g %% of its "
        "curves are left to the remainder, which meets the conditions but not the equation: say how many "
        "are meant (remainder: {modes: N}), take a smaller a, or put conditions nearer the ends",
        d->name, ves_patch_modes(p), ves_patch_band(p), 100 * left);
}

ves_status ves_plan_conditions(const ves_plan *plan, int patch, ves_diag *diag)
{
    telling t = {plan, patch, VES_ERROR, VES_SINGULAR, "", diag};
    findings f;
    if (unsolved(&t, &f)) return VES_SINGULAR;
    if (f.first >= 0) warn(plan, patch, &f, diag);
    warn_left(plan, patch, diag);
    return VES_OK;
}

bool ves_plan_conditions_tell(const ves_plan *plan, const char *what, ves_diag *diag)
{
    telling t = {plan, 0, VES_WARNING, VES_UNDETERMINED, what, diag};
    findings f;
    for (; t.patch < plan->problem->patches; t.patch++)
        if (unsolved(&t, &f)) return true;
    return false;
}

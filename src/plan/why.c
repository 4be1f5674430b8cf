/* Why: what is behind a verdict that has no number, with its place in the file. None of it is hot: the design
 * is still bound, and is looked at again. */
#include "base/vector.h"
#include "plan/shell.h"

#include <math.h>

/* Where a coordinate is not finite. */
typedef struct spot {
    int patch, c;
    double u, v; /* 0 .. 1, 0 .. 2 pi */
} spot;

static const char *kind_of(double value)
{
    return isnan(value) ? "not a number" : "infinite";
}

static bool outside_tell(const ves_plan *plan, const char *what, ves_diag *diag)
{
    const ves_problem *p = plan->problem;
    const ves_limit *l = ves_plan_limit(plan);
    char limit[96], got[VES_QUANTITY], root[VES_QUANTITY];
    if (!l) return false; /* a plugin's own word */
    ves_limit_text(l->low, l->high, limit);
    ves_quantity_text(plan->block[l->number], l->dim, p->units, got);
    if (p->solve) ves_quantity_text(plan->block[p->variables], p->solve->dim, p->units, root);
    ves_diag_add(diag, VES_WARNING, VES_OUTSIDE, l->mark, "%s: \"%s\" must be %s, got %s%s%s%s%s", what,
                 l->key, limit, got, p->solve ? ", with " : "", p->solve ? p->solve->name : "",
                 p->solve ? " = " : "", p->solve ? root : "");
    return true;
}

/* --- points --- */

/* In the u and v of the patch's own formulas. */
static void spot_tell(const ves_plan *plan, ves_severity severity, const spot *at, const char *what,
                      ves_diag *diag)
{
    const ves_patch_def *d = &plan->problem->patch[at->patch];
    double own[2];
    ves_plan_domain_at(plan, at->patch, at->u, at->v, own);
    const char axis = "xyz"[at->c];
    ves_diag_add(diag, severity, VES_NO_POINT, d->mark,
                 "%s: %c of patch \"%s\" is not a finite number (at u = %.4g, v = %.4g)", what, axis, d->name,
                 own[0], own[1]);
}

static bool spot_at(const ves_plan *plan, double *room, spot *at)
{
    double out[3 * VES_FIELDS];
    ves_patch_point(plan->patch[at->patch], &plan->bound, 1, &at->u, &at->v, out, room);
    for (at->c = 0; at->c < 3; at->c++)
        if (!isfinite(out[at->c])) return true;
    return false;
}

/* On a regular grid, edges included. */
static bool spot_regular(const ves_plan *plan, int nu, int nv, double *room, spot *at)
{
    for (int i = 0; i <= nu; i++)
        for (int j = 0; j <= nv; j++) {
            at->u = (double)i / nu, at->v = VES_TWO_PI * j / nv;
            if (spot_at(plan, room, at)) return true;
        }
    return false;
}

/* On what an evaluation looks at. */
static bool spot_sampled(const ves_plan *plan, double *room, spot *at)
{
    for (int l = 0; l < LEVELS; l++)
        for (int k = 0; k < plan->level[l].sites; k++) {
            const plan_site *s = &plan->level[l].site[k];
            if (s->patch != at->patch || s->samples.site == VES_SITE_LOOK) continue;
            for (int n = 0; n < s->grid.count; n++) {
                at->u = s->grid.u[n % s->grid.nu], at->v = s->grid.v[n / s->grid.nu];
                if (spot_at(plan, room, at)) return true;
            }
        }
    return false;
}

/* Where people would look first comes first. */
static bool spot_find(const ves_plan *plan, spot *at)
{
    bool found = false;
    for (int k = 0; k < plan->problem->patches && !found; k++) {
        ves_arena arena = {0};
        double *room = ves_arena_doubles(&arena, (size_t)ves_patch_point_room(plan->patch[k]));
        at->patch = k;
        found = room && (spot_regular(plan, 16, 32, room, at) || spot_sampled(plan, room, at) ||
                         spot_regular(plan, 48, 96, room, at));
        ves_arena_destroy(&arena);
    }
    return found;
}

static bool figure_spot(const ves_figure *figure, spot *at)
{
    for (at->patch = 0; at->patch < figure->patches; at->patch++) {
        const ves_figure_patch *f = &figure->patch[at->patch];
        for (int n = 0; n < f->rows * f->columns; n++)
            for (at->c = 0; at->c < 3; at->c++) {
                if (isfinite(f->X[at->c][n])) continue;
                at->u = ves_figure_u(f, n), at->v = ves_figure_v(f, n);
                return true;
            }
    }
    return false;
}

bool ves_plan_figure_finite(const ves_plan *plan, const ves_figure *figure, const char *what, ves_diag *diag)
{
    spot at;
    if (!figure_spot(figure, &at)) return true;
    spot_tell(plan, VES_ERROR, &at, what, diag);
    return false;
}

/* --- numbers --- */

static void side_tell(const ves_constraint_def *c, double left, double right, const char *what,
                      ves_diag *diag)
{
    bool first = !isfinite(left);
    ves_diag_add(diag, VES_WARNING, VES_NO_NUMBER, c->mark, "%s: the %s side of \"%s\" is %s", what,
                 first ? "left" : "right", c->text, kind_of(first ? left : right));
}

/* In the order of an evaluation. */
static bool number_tell(ves_plan *plan, const char *what, ves_diag *diag)
{
    const ves_problem *p = plan->problem;
    if (plan->numberless >= 0) {
        const ves_measure_def *m = &p->measure[plan->numberless];
        ves_diag_add(diag, VES_WARNING, VES_NO_NUMBER, m->mark, "%s: measure \"%s\" is not a finite number",
                     what, m->name);
        return true;
    }
    double left = p->solve ? ves_plan_formula(plan, p->solve->left) : 0,
           right = p->solve ? ves_plan_formula(plan, p->solve->right) : 0;
    if (!isfinite(left - right)) {
        char root[VES_QUANTITY];
        ves_quantity_text(plan->block[p->variables], p->solve->dim, p->units, root);
        ves_diag_add(diag, VES_WARNING, VES_NO_NUMBER, p->solve->mark,
                     "%s: the %s side of the equation is %s where %s = %s", what,
                     isfinite(left) ? "right" : "left", kind_of(isfinite(left) ? right : left),
                     p->solve->name, root);
        return true;
    }
    for (int k = 0; k < p->constraints; k++) {
        const ves_constraint_def *c = &p->constraint[k];
        left = ves_plan_formula(plan, c->left), right = ves_plan_formula(plan, c->right);
        if (isfinite(left - right)) continue;
        side_tell(c, left, right, what, diag);
        return true;
    }
    double objective = p->objective ? ves_plan_formula(plan, p->objective) : 0;
    if (isfinite(objective)) return false;
    ves_diag_add(diag, VES_WARNING, VES_NO_NUMBER, p->objective_mark, "%s: \"%s\" is %s", what,
                 p->objective_text, kind_of(objective));
    return true;
}

static bool broken_tell(const ves_plan *plan, const char *what, ves_diag *diag)
{
    char text[512];
    if (!ves_plan_broken(plan, text, sizeof text)) return false;
    ves_diag_add(diag, VES_WARNING, VES_BROKEN, plan->problem->validity.check[plan->broken].mark,
                 "%s: %s: %s", what, ves_status_text(VES_BROKEN), text);
    return true;
}

void ves_plan_why(ves_plan *plan, ves_status status, const char *what, ves_diag *diag)
{
    spot at;
    if (status <= VES_OK || ves_shell_why(plan, status, what, diag)) return;
    if (status == VES_OUTSIDE && outside_tell(plan, what, diag)) return;
    if (status == VES_NO_POINT && spot_find(plan, &at)) {
        spot_tell(plan, VES_WARNING, &at, what, diag);
        return;
    }
    if (status == VES_NO_NUMBER && number_tell(plan, what, diag)) return;
    if (status == VES_BROKEN && broken_tell(plan, what, diag)) return;
    if ((status == VES_NOT_ELLIPTIC || status == VES_UNDETERMINED) &&
        ves_plan_elliptic_tell(plan, what, diag))
        return;
    if (status == VES_UNDETERMINED && ves_plan_conditions_tell(plan, what, diag)) return;
    ves_diag_add(diag, VES_WARNING, status, (ves_mark){0}, "%s: %s", what, ves_status_text(status));
}

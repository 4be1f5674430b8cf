/* Which patches meet, which way their normals point, and whether the shape encloses a volume.
 *
 * Two patches meet where they have a position condition on the same curve. Seen along that curve their
 * normals Xu x Xv agree when one arrives there (u = 1) and the other leaves (u = 0), and disagree when both
 * arrive or both leave. */
#include "plan/inside.h"

#include <math.h>
#include <stdio.h>

enum { HINT = 160 };

static const ves_patch_def *def(const ves_plan *plan, int patch)
{
    return &plan->problem->patch[patch];
}

/* The curve that an end of a patch lies on, -1: no curve (a sheet, or an end without a position). What raises
 * the order says how far the surface departs, not where it lies. */
int ves_end_curve(const ves_plan *plan, int patch, int end)
{
    const ves_patch_def *p = def(plan, patch);
    int own = p->lower ? 2 * p->lower : p->conditions;
    for (int k = 0; p->kind == VES_PATCH_PDE && k < own; k++)
        if (p->condition[k].u == end && p->condition[k].derivative == 0)
            return p->condition[k].share[0].curve;
    return -1;
}

bool ves_end_is_pole(const ves_plan *plan, int patch, int end)
{
    int curve = ves_end_curve(plan, patch, end);
    if (def(plan, patch)->kind != VES_PATCH_PDE) return plan->sheet[patch].pole[end];
    return curve >= 0 && ves_curves_modes(plan->curves, curve) == 0;
}

bool ves_end_is_capped(const ves_plan *plan, int patch, int end)
{
    const ves_shape_def *shape = &plan->problem->shape;
    for (int k = 0; k < shape->caps; k++)
        if (shape->cap[k].patch == patch && shape->cap[k].end == end) return true;
    return false;
}

int ves_ends_on(const ves_plan *plan, int curve)
{
    int count = 0;
    for (int p = 0; p < plan->problem->patches; p++)
        for (int e = 0; e < 2; e++) count += ves_end_curve(plan, p, e) == curve;
    return count;
}

/* Spreads the side of patch a over the curve at one of its ends; true when that reached a patch. A walk over
 * shared curves passes each patch forward or backward, so with two ends on each curve there is no
 * contradiction to meet. */
static bool spread(ves_plan *plan, int a, int end)
{
    int curve = ves_end_curve(plan, a, end);
    if (curve < 0 || ves_end_is_pole(plan, a, end) || ves_ends_on(plan, curve) > 2) return false;
    for (int b = 0; b < plan->problem->patches; b++)
        for (int e = 0; e < 2; e++) {
            if (plan->side[b] != 0 || ves_end_curve(plan, b, e) != curve) continue;
            plan->side[b] = e == end ? -plan->side[a] : plan->side[a];
            plan->part[b] = plan->part[a];
            return true;
        }
    return false;
}

static void spread_all(ves_plan *plan)
{
    int patches = plan->problem->patches;
    for (int seed = 0; seed < patches; seed++) {
        if (plan->side[seed] != 0) continue;
        plan->side[seed] = 1, plan->part[seed] = seed;
        for (bool changed = true; changed;) {
            changed = false;
            for (int a = 0; a < patches; a++)
                for (int end = 0; end < 2 && plan->side[a] != 0; end++) changed |= spread(plan, a, end);
        }
    }
}

/* An end goes all the way round: only then is there something to close. */
static bool is_round(const ves_plan *plan, int patch)
{
    const plan_sheet *sheet = &plan->sheet[patch];
    return ves_patch_periodic(plan->patch[patch]) || (sheet->sides.joined && !sheet->sides.reversed);
}

/* How the surface goes on at an end. */
typedef enum beyond { FREE, SHUT, JOINED, BRANCHED } beyond;

static beyond beyond_end(const ves_plan *plan, int patch, int end)
{
    int curve = ves_end_curve(plan, patch, end);
    if (ves_end_is_pole(plan, patch, end)) return SHUT;
    if (plan->sheet[patch].ends.joined) return JOINED;
    int ends = curve < 0 ? 1 : ves_ends_on(plan, curve);
    return ends == 1 ? FREE : ends == 2 ? JOINED : BRANCHED;
}

/* A cap belongs on a free end that goes all the way round. */
static ves_status caps_check(const ves_plan *plan, ves_diag *diag)
{
    const ves_shape_def *shape = &plan->problem->shape;
    for (int k = 0; k < shape->caps; k++) {
        const ves_end *cap = &shape->cap[k];
        const char *name = def(plan, cap->patch)->name;
        if (!is_round(plan, cap->patch))
            return ves_diag_add(diag, VES_ERROR, VES_SINGULAR, cap->mark,
                                "\"%s.u%d\" cannot be capped: it is an open line, not a closed curve", name,
                                cap->end);
        if (beyond_end(plan, cap->patch, cap->end) == JOINED)
            return ves_diag_add(diag, VES_ERROR, VES_SINGULAR, cap->mark,
                                "\"%s.u%d\" needs no cap: the surface goes on there; take it out of caps",
                                name, cap->end);
    }
    return VES_OK;
}

/* What would close an end that is open, besides a cap. */
static const char *way_out(const ves_plan *plan, int patch, int end)
{
    if (def(plan, patch)->kind != VES_PATCH_PDE)
        return "a surface that is given is joined to no other patch: end it in a point";
    if (ves_end_curve(plan, patch, end) < 0)
        return "give its position there: a curve of another patch, or a point,";
    return "let one other patch end on the same curve, end it in a point,";
}

static ves_status open_end(const ves_plan *plan, int patch, int end, beyond what, ves_diag *diag)
{
    const ves_problem *p = plan->problem;
    char hint[HINT] = "";
    ves_end other;
    double gap;
    if (what == FREE && ves_edge_near(plan, patch, end, &other, &gap))
        snprintf(hint, sizeof hint, "; it is at most %.3g%s from \"%.64s.u%d\": both should use one curve",
                 gap, p->units ? " m" : "", p->patch[other.patch].name, other.end);
    return ves_diag_add(diag, VES_ERROR, VES_SINGULAR, p->shape.mark,
                        "the shape is not closed: \"%s.u%d\" is %s; %s or close it with caps: [%s.u%d]%s",
                        p->patch[patch].name, end, what == BRANCHED ? "shared by more than two ends" : "free",
                        way_out(plan, patch, end), p->patch[patch].name, end, hint);
}

/* A closed shape has two sides and no free edge. */
static ves_status closed_check(const ves_plan *plan, ves_diag *diag)
{
    const ves_problem *p = plan->problem;
    for (int k = 0; k < p->patches && p->shape.closed; k++) {
        if (ves_sheet_one_sided(&plan->sheet[k]))
            return ves_diag_add(
                diag, VES_ERROR, VES_SINGULAR, p->shape.mark,
                "the shape encloses no volume: surface \"%s\" has one side only (it meets itself "
                "the other way round)",
                p->patch[k].name);
        if (!is_round(plan, k))
            return ves_diag_add(
                diag, VES_ERROR, VES_SINGULAR, p->shape.mark,
                "the shape is not closed: surface \"%s\" has free sides at v = 0 and v = 2 pi",
                p->patch[k].name);
        for (int end = 0; end < 2; end++) {
            beyond what = beyond_end(plan, k, end);
            if (what == SHUT || what == JOINED || ves_end_is_capped(plan, k, end)) continue;
            return open_end(plan, k, end, what, diag);
        }
    }
    return VES_OK;
}

/* Where more than two patches meet there is no inside, and no mesh that CGAL would take. */
static void branches_find(ves_plan *plan, ves_diag *diag)
{
    for (int c = 0; c < plan->problem->curves; c++) {
        if (ves_ends_on(plan, c) <= 2 || ves_curves_modes(plan->curves, c) == 0) continue;
        plan->branched = true;
        ves_diag_add(diag, VES_WARNING, VES_OK, plan->problem->curve[c].mark,
                     "more than two patches end on curve \"%s\": the normals of each keep their own side "
                     "there, and the shape is not "
                     "checked for crossing itself",
                     plan->problem->curve[c].name);
    }
}

ves_status ves_plan_orient(ves_plan *plan, ves_diag *diag)
{
    VES_TRY(ves_plan_sheets(plan, diag));
    branches_find(plan, diag);
    ves_edges_cross(plan, diag);
    spread_all(plan);
    VES_TRY(caps_check(plan, diag));
    return closed_check(plan, diag);
}

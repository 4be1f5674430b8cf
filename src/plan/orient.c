/* Which patches meet, which way their normals point, and whether the shape encloses a volume.
 *
 * Two patches meet where they have a position condition on the same curve. Seen along that curve their
 * normals Xu x Xv agree when one arrives there (u = 1) and the other leaves (u = 0), and disagree when both
 * arrive or both leave. */
#include "plan/inside.h"

#include <math.h>

static const ves_patch_def *def(const ves_plan *plan, int patch)
{
    return &plan->problem->patch[patch];
}

/* The curve that an end of a patch lies on, -1: no curve (a sheet). */
int ves_end_curve(const ves_plan *plan, int patch, int end)
{
    const ves_patch_def *p = def(plan, patch);
    for (int k = 0; p->kind == VES_PATCH_PDE && k < p->conditions; k++)
        if (p->condition[k].u == end && p->condition[k].derivative == 0) return p->condition[k].curve;
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

/* How many ends lie on a curve; the last one met. */
static int ends_on(const ves_plan *plan, int curve)
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
    if (curve < 0 || ves_end_is_pole(plan, a, end) || ends_on(plan, curve) > 2) return false;
    for (int b = 0; b < plan->problem->patches; b++)
        for (int e = 0; e < 2; e++) {
            if (plan->side[b] != 0 || ves_end_curve(plan, b, e) != curve) continue;
            plan->side[b] = e == end ? -plan->side[a] : plan->side[a];
            return true;
        }
    return false;
}

static void spread_all(ves_plan *plan)
{
    int patches = plan->problem->patches;
    for (int seed = 0; seed < patches; seed++) {
        if (plan->side[seed] != 0) continue;
        plan->side[seed] = 1;
        for (bool changed = true; changed;) {
            changed = false;
            for (int a = 0; a < patches; a++)
                for (int end = 0; end < 2 && plan->side[a] != 0; end++) changed |= spread(plan, a, end);
        }
    }
}

/* A closed shape has no free end. */
static ves_status closed_check(const ves_plan *plan, ves_diag *diag)
{
    const ves_problem *p = plan->problem;
    if (!p->shape.closed) return VES_OK;
    for (int k = 0; k < p->patches; k++)
        for (int end = 0; end < 2; end++) {
            int curve = ves_end_curve(plan, k, end);
            bool round = ves_patch_periodic(plan->patch[k]);
            bool shut = (round && ves_end_is_pole(plan, k, end)) || ves_end_is_capped(plan, k, end) ||
                        (curve >= 0 && ends_on(plan, curve) == 2);
            if (!shut)
                return ves_diag_add(diag, VES_ERROR, VES_SINGULAR, p->shape.mark,
                                    "the shape is not closed: \"%s.u%d\" is %s; let one other patch end on "
                                    "the same curve, end "
                                    "it in a point, or close it with caps: [%s.u%d]",
                                    p->patch[k].name, end,
                                    curve >= 0 && ends_on(plan, curve) > 2 ? "shared by more than two ends"
                                                                           : "free",
                                    p->patch[k].name, end);
        }
    return VES_OK;
}

enum { LOOKS = 8 };

static const double SAME = 1e-9; /* of the sheet's size: points that are meant to be one */

/* A sheet says nothing about its ends: they are looked at, at the start design. An end where X does not
 * depend on v is a pole; a periodic sheet must come back to where it began. */
static ves_status sheet_look(ves_plan *plan, int patch, ves_diag *diag)
{
    enum { PLACES = 4 * LOOKS };
    static const double TWO_PI = 6.283185307179586;
    double u[PLACES], v[PLACES], size = 0, apart[4] = {0};
    ves_arena arena = {0};
    double *room = ves_arena_doubles(&arena, (size_t)ves_patch_point_room(plan->patch[patch]));
    double *X = ves_arena_doubles(&arena, (size_t)(3 * VES_FIELDS * PLACES));
    for (int k = 0; k < LOOKS; k++) { /* the end u = 0, the end u = 1, the seam v = 0 and v = 2 pi */
        double t = (k + 0.5) / LOOKS;
        u[k] = 0, u[LOOKS + k] = 1, u[2 * LOOKS + k] = u[3 * LOOKS + k] = t;
        v[k] = v[LOOKS + k] = TWO_PI * t, v[2 * LOOKS + k] = 0, v[3 * LOOKS + k] = TWO_PI;
    }
    if (room && X) ves_patch_point(plan->patch[patch], &plan->bound, PLACES, u, v, X, room);
    for (int c = 0; c < 3 && room && X; c++)
        for (int k = 0; k < PLACES; k++) {
            const double *x = X + c * PLACES;
            int group = k / LOOKS, other = group < 2 ? group * LOOKS : 2 * LOOKS + k % LOOKS;
            size = fmax(size, fabs(x[k] - x[0]));
            apart[group] = fmax(apart[group], fabs(x[k] - x[other]));
        }
    ves_arena_destroy(&arena);
    if (!room || !X) return VES_MEMORY;
    for (int end = 0; end < 2; end++) plan->sheet[patch].pole[end] = apart[end] <= SAME * size;
    if (!def(plan, patch)->periodic || apart[3] <= SAME * size) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_SINGULAR, def(plan, patch)->mark,
                        "surface \"%s\" is periodic but does not close: at v = 2 pi it is %.3g away from "
                        "where it was at v = 0; write "
                        "periodic: false, or mend the formula",
                        def(plan, patch)->name, apart[3]);
}

static ves_status sheets_look(ves_plan *plan, ves_diag *diag)
{
    for (int k = 0; k < plan->problem->patches; k++)
        if (def(plan, k)->kind != VES_PATCH_PDE) VES_TRY(sheet_look(plan, k, diag));
    return VES_OK;
}

/* Where more than two patches meet there is no inside, and no mesh that CGAL would take. */
static void branches_find(ves_plan *plan, ves_diag *diag)
{
    for (int c = 0; c < plan->problem->curves; c++) {
        if (ends_on(plan, c) <= 2 || ves_curves_modes(plan->curves, c) == 0) continue;
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
    VES_TRY(sheets_look(plan, diag));
    branches_find(plan, diag);
    spread_all(plan);
    return closed_check(plan, diag);
}

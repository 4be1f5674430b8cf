/* Sheets: surfaces by formula or points. A file says nothing about their ends, so they are looked at: which
 * end is a point, and where the sheet meets itself. So are the ends of a PDE patch that lie on two curves, each
 * of it alone: these may be one line (a torus or a Klein bottle through sections). */
#include "base/random.h"
#include "base/vector.h"
#include "plan/inside.h"

#include <math.h>

enum { LOOKS = 16, AROUND = 256, TURNS = 40, DESIGNS = 3 };

/* Of the sheet's size: points that are meant to be one. Formulas are rounded at 1e-16 of their largest terms,
 * so this forgives terms a million times as large as what is left of them, and is far below any mesh. */
static const double SAME = 1e-9;

/* A look at the sheet as it is bound. Points X[c][k], and Xv after them. */
typedef struct look {
    const ves_plan *plan;
    const ves_patch *patch;
    int curve[2]; /* of a PDE patch, on which its ends lie; else -1 */
    bool periodic;
    double *room, *out, near; /* near: what counts as no distance */
} look;

static double wrapped(const look *l, double v)
{
    if (!l->periodic) return v;
    double t = fmod(v, VES_TWO_PI);
    return t < 0 ? t + VES_TWO_PI : t;
}

/* X and Xv on the ends of a PDE patch, u = 0 and 1: those of its curves. */
static void end_points(const look *l, int count, const double *u, const double *v)
{
    const ves_curves *curves = l->plan->curves;
    for (int k = 0; k < count; k++) {
        double point[6];
        int curve = l->curve[u[k] > 0.5];
        ves_curve_point(ves_curves_coef(curves, curve), ves_curves_modes(curves, curve), v[k], 1, point);
        for (int c = 0; c < 3; c++) {
            l->out[c * count + k] = point[c];
            l->out[(VES_FIELD_V * 3 + c) * count + k] = point[3 + c];
        }
    }
}

/* Fields of `count` points, as ves_patch_point lays them out. */
static const double *points(const look *l, int count, const double *u, double *v)
{
    for (int k = 0; k < count; k++) v[k] = wrapped(l, v[k]);
    if (l->curve[0] >= 0)
        end_points(l, count, u, v);
    else
        ves_patch_point(l->patch, &l->plan->bound, count, u, v, l->out, l->room);
    return l->out;
}

/* The largest distance between point k and point LOOKS + k. NaN: some point is no number; or `known`: along
 * the coordinates that are. */
static double apart_along(const look *l, bool known, const double u[2 * LOOKS], double v[2 * LOOKS])
{
    const double *X = points(l, 2 * LOOKS, u, v);
    double most = 0;
    for (int k = 0; k < LOOKS; k++) {
        double square = 0;
        for (int c = 0; c < 3; c++) {
            double d = X[c * 2 * LOOKS + k] - X[c * 2 * LOOKS + LOOKS + k];
            if (!known || isfinite(d)) square += d * d;
        }
        if (isnan(square)) return NAN;
        most = fmax(most, square);
    }
    return sqrt(most);
}

static double apart(const look *l, const double u[2 * LOOKS], double v[2 * LOOKS])
{
    return apart_along(l, false, u, v);
}

/* Places along an edge that no symmetry of a formula prefers. */
static double place(int k)
{
    return (k + 0.37) / LOOKS;
}

/* X(1, v) = X(0, shift + v), reversed: X(0, shift - v)? */
static bool ends_meet(const look *l, bool reversed, double shift)
{
    double u[2 * LOOKS], v[2 * LOOKS];
    for (int k = 0; k < LOOKS; k++) {
        u[k] = 1, v[k] = VES_TWO_PI * place(k);
        u[LOOKS + k] = 0, v[LOOKS + k] = reversed ? shift - v[k] : shift + v[k];
    }
    return apart(l, u, v) <= l->near;
}

/* How far X(u, 2 pi) is from X(u, 0), reversed: from X(1 - u, 0). */
static double sides_apart(const look *l, bool reversed, bool known)
{
    double u[2 * LOOKS], v[2 * LOOKS];
    look plain = *l;
    plain.periodic = false; /* 2 pi must not be wrapped to 0 */
    for (int k = 0; k < LOOKS; k++) {
        u[k] = place(k), v[k] = VES_TWO_PI;
        u[LOOKS + k] = reversed ? 1 - u[k] : u[k], v[LOOKS + k] = 0;
    }
    return apart_along(&plain, known, u, v);
}

static bool end_is_point(const look *l, int end)
{
    double u[2 * LOOKS], v[2 * LOOKS];
    for (int k = 0; k < LOOKS; k++) {
        u[k] = u[LOOKS + k] = end;
        v[k] = VES_TWO_PI * place(k), v[LOOKS + k] = VES_TWO_PI * place(0);
    }
    return apart(l, u, v) <= l->near;
}

/* Of the box round the four edges and a diagonal; of a PDE patch round its ends. */
static double size_of(const look *l)
{
    enum { COUNT = 5 * LOOKS };
    double u[COUNT], v[COUNT], size = 0;
    for (int k = 0; k < COUNT; k++) {
        if (l->curve[0] >= 0) {
            u[k] = k % 2, v[k] = VES_TWO_PI * (k + 0.37) / COUNT;
            continue;
        }
        double t = place(k % LOOKS), edge = k / LOOKS;
        u[k] = edge == 0 ? 0 : edge == 1 ? 1 : t;
        v[k] = VES_TWO_PI * (edge == 2 ? 0 : edge == 3 ? 0.5 : t);
    }
    const double *X = points(l, COUNT, u, v);
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < COUNT; k++) {
            double d = fabs(X[c * COUNT + k] - X[c * COUNT]);
            if (isfinite(d)) size = fmax(size, d);
        }
    return size;
}

/* The v near a given one at which X(0, v) is nearest to a point: Gauss-Newton, which is Newton's method where
 * the distance vanishes. false: it does not. */
static bool descend(const look *l, const double at[3], double *v)
{
    for (int turn = 0; turn < TURNS; turn++) {
        const double *X = points(l, 1, &(double){0}, &(double){*v}), *Xv = X + 3 * VES_FIELD_V;
        double slope = 0, square = 0, distance = 0;
        for (int c = 0; c < 3; c++) {
            double d = at[c] - X[c];
            distance += d * d, slope += d * Xv[c], square += Xv[c] * Xv[c];
        }
        if (sqrt(distance) <= 1e-6 * l->near) return true;
        double step = slope / square;
        if (!isfinite(step)) break;
        *v += step;
        if (fabs(step) < 1e-15 * VES_TWO_PI) return sqrt(distance) <= l->near;
    }
    return false;
}

/* Round a periodic sheet the ends may be turned against each other: by how much is found where the first end
 * passes through one point of the last. */
static bool turn_find(const look *l, plan_seam *seam)
{
    double u[AROUND] = {0}, v[AROUND], at[3], far[AROUND], v1 = VES_TWO_PI * place(0);
    const double *X = points(l, 1, &(double){1}, &(double){v1});
    for (int c = 0; c < 3; c++) at[c] = X[c];
    for (int k = 0; k < AROUND; k++) v[k] = VES_TWO_PI * k / AROUND;
    X = points(l, AROUND, u, v);
    for (int k = 0; k < AROUND; k++) {
        far[k] = 0;
        for (int c = 0; c < 3; c++) far[k] += (X[c * AROUND + k] - at[c]) * (X[c * AROUND + k] - at[c]);
    }
    for (int k = 0; k < AROUND; k++) {
        double found = VES_TWO_PI * k / AROUND;
        if (far[k] > far[(k + 1) % AROUND] || far[k] > far[(k + AROUND - 1) % AROUND]) continue;
        if (!descend(l, at, &found)) continue;
        for (int reversed = 0; reversed < 2; reversed++) {
            double shift = wrapped(l, reversed ? found + v1 : found - v1);
            if (!ends_meet(l, reversed, shift)) continue;
            *seam = (plan_seam){.joined = true, .reversed = reversed, .shift = shift};
            return true;
        }
    }
    return false;
}

static void sides_find(const look *l, plan_sheet *found)
{
    found->gap = sides_apart(l, false, true);
    found->gaping = found->gap > l->near;
    found->pointless = isnan(sides_apart(l, false, false));
    for (int reversed = 0; reversed < 2 && !found->sides.joined; reversed++)
        if (sides_apart(l, reversed, false) <= l->near)
            found->sides = (plan_seam){.joined = true, .reversed = reversed};
}

static void ends_find(const look *l, plan_sheet *found)
{
    for (int end = 0; end < 2; end++) found->pole[end] = end_is_point(l, end);
    if (found->pole[0] || found->pole[1]) return;
    for (int reversed = 0; reversed < 2; reversed++) {
        double shift = reversed && !l->periodic ? VES_TWO_PI : 0;
        if (!ends_meet(l, reversed, shift)) continue;
        found->ends = (plan_seam){.joined = true, .reversed = reversed, .shift = shift};
        return;
    }
    if (l->periodic) turn_find(l, &found->ends);
}

/* The curves of a PDE patch whose ends may be one line: two, on which nothing else ends. */
static bool end_curves(const ves_plan *plan, int patch, int curve[2])
{
    for (int end = 0; end < 2; end++) curve[end] = ves_end_curve(plan, patch, end);
    for (int end = 0; end < 2; end++)
        if (curve[end] < 0 || ves_end_is_pole(plan, patch, end) || ves_ends_on(plan, curve[end]) > 1)
            return false;
    return true;
}

ves_status ves_sheet_look(const ves_plan *plan, int patch, plan_sheet *found)
{
    ves_arena arena = {0};
    look l = {.plan = plan,
              .patch = plan->patch[patch],
              .curve = {-1, -1},
              .periodic = ves_patch_periodic(plan->patch[patch])};
    l.room = ves_arena_doubles(&arena, (size_t)ves_patch_point_room(l.patch));
    l.out = ves_arena_doubles(&arena, (size_t)(3 * VES_FIELDS * AROUND));
    bool good = l.room && l.out;
    bool pde = plan->problem->patch[patch].kind == VES_PATCH_PDE;
    *found = (plan_sheet){0};
    if (good && (!pde || end_curves(plan, patch, l.curve))) {
        l.near = SAME * size_of(&l);
        if (!pde) sides_find(&l, found);
        ends_find(&l, found);
    }
    ves_arena_destroy(&arena);
    return good ? VES_OK : VES_MEMORY;
}

static void seam_agree(plan_seam *seam, const plan_seam *other)
{
    seam->joined = seam->joined && other->joined && seam->reversed == other->reversed;
}

/* What one design shows may be chance: it is believed when designs elsewhere show it too. One that has no
 * number there says nothing. */
static ves_status look_elsewhere(ves_plan *plan, int patch, int design, double *x, plan_sheet *sheet)
{
    const ves_problem *p = plan->problem;
    ves_random random = {.seed = 1, .step = (uint64_t)design};
    plan_sheet other;
    double unknown = 0;
    for (int k = 0; k < p->variables; k++) {
        const ves_variable *v = &p->variable[k];
        x[k] = v->min + (v->max - v->min) * ves_random_uniform(&random);
    }
    if (p->solve) unknown = p->solve->lo + (p->solve->hi - p->solve->lo) * ves_random_uniform(&random);
    ves_plan_bind(plan, x, unknown);
    VES_TRY(ves_sheet_look(plan, patch, &other));
    if (other.pointless) return VES_OK;
    for (int end = 0; end < 2; end++) sheet->pole[end] = sheet->pole[end] && other.pole[end];
    seam_agree(&sheet->sides, &other.sides);
    seam_agree(&sheet->ends, &other.ends);
    return VES_OK;
}

static ves_status look_everywhere(ves_plan *plan, int patch)
{
    const ves_problem *p = plan->problem;
    plan_sheet *sheet = &plan->sheet[patch];
    VES_TRY(ves_sheet_look(plan, patch, sheet));
    bool settled = p->patch[patch].kind == VES_PATCH_PDE && !sheet->ends.joined;
    if (settled || !ves_patch_varies(plan->patch[patch])) return VES_OK;
    ves_arena arena = {0};
    double *x = ves_arena_take(&arena, (size_t)p->variables, sizeof *x);
    ves_status status = x ? VES_OK : VES_MEMORY;
    for (int design = 1; design < DESIGNS && status == VES_OK; design++)
        status = look_elsewhere(plan, patch, design, x, sheet);
    for (int k = 0; k < p->variables && x; k++) x[k] = p->variable[k].start;
    if (x) ves_plan_bind(plan, x, p->solve ? (p->solve->lo + p->solve->hi) / 2 : 0);
    ves_arena_destroy(&arena);
    return status;
}

/* A Moebius band or a Klein bottle: no choice of normals holds all round. */
bool ves_sheet_one_sided(const plan_sheet *sheet)
{
    return (sheet->ends.joined && sheet->ends.reversed) || (sheet->sides.joined && sheet->sides.reversed);
}

ves_status ves_plan_sheets(ves_plan *plan, ves_diag *diag)
{
    for (int k = 0; k < plan->problem->patches; k++) {
        const ves_patch_def *def = &plan->problem->patch[k];
        VES_TRY(look_everywhere(plan, k));
        if (def->periodic && plan->sheet[k].gaping)
            return ves_diag_add(
                diag, VES_ERROR, VES_SINGULAR, def->mark,
                "surface \"%s\" is periodic but does not close: at v = 2 pi it is %.3g away from "
                "where it was at v = 0; write periodic: false, or mend the formula",
                def->name, plan->sheet[k].gap);
        if (ves_sheet_one_sided(&plan->sheet[k]))
            ves_diag_add(
                diag, VES_WARNING, VES_OK, def->mark,
                "surface \"%s\" meets itself the other way round and so has one side only: its normals "
                "turn over at the seam, and the shape is not checked for crossing itself",
                def->name);
        plan->branched |= ves_sheet_one_sided(&plan->sheet[k]);
    }
    return VES_OK;
}

/* Joints: how two ends of patches on one curve go on into each other. Definitions: vesica/plan.h. */
#include <math.h>

#include "base/vector.h"
#include "plan/inside.h"

enum { EVERYTHING = (1 << VES_FIELDS) - 1, EACH_MODE = 16, LEAST = 256, MOST = 4096 };

/* Reasons: vesica/plan.h. GAP: of the curve's radius; ANGLE: rad; the others are relative. */
static const double GAP = 1e-9, ANGLE = 1e-3 * VES_PI / 180, CURVATURE = 1e-4, SLOPE = 1e-5, SECOND = 1e-4;

/* X_u x X_v of a surface is no direction below this share of |X_u|^2 + |X_v|^2 (surface/forms.h). */
static const double FLAT = 1e-12;

/* --- which --- */

/* A closed patch that meets itself at its ends, which are not one curve by name. */
static bool meets_itself(const ves_plan *plan, int patch)
{
    return plan->sheet[patch].ends.joined && ves_patch_periodic(plan->patch[patch]);
}

/* Fills in the ends of joint `index`; returns how many joints there are up to that one. */
static int find(const ves_plan *plan, int index, ves_joint *joint)
{
    int count = 0, ends = 2 * plan->problem->patches;
    for (int a = 0; a < ends; a++) {
        int curve = ves_end_curve(plan, a / 2, a % 2);
        if (curve < 0 || ves_end_is_pole(plan, a / 2, a % 2)) continue;
        for (int b = a + 1; b < ends; b++) {
            if (ves_end_curve(plan, b / 2, b % 2) != curve || count++ != index) continue;
            *joint = (ves_joint){
                .patch = {a / 2, b / 2}, .end = {a % 2, b % 2}, .curve = plan->problem->curve[curve].name};
            return count;
        }
    }
    for (int k = 0; k < plan->problem->patches; k++) {
        if (!meets_itself(plan, k) || count++ != index) continue;
        int curve = ves_end_curve(plan, k, 1);
        *joint = (ves_joint){
            .patch = {k, k}, .end = {1, 0}, .curve = curve < 0 ? NULL : plan->problem->curve[curve].name};
        return count;
    }
    return count;
}

int ves_plan_joints(const ves_plan *plan)
{
    ves_joint none;
    return find(plan, -1, &none);
}

/* --- what is there --- */

/* One end of a patch at so many places: at[(f * 3 + c) * count + j], v = shift + run j / count, run 2 pi or,
 * where two ends run against each other, -2 pi. */
typedef struct rim {
    int count;
    double shift, run;
    double *at;
} rim;

static ves_status rim_sample(ves_plan *plan, int patch, int end, ves_arena *arena, rim *r)
{
    const double u = end;
    ves_grid *grid = ves_arena_take(arena, 1, sizeof *grid);
    double *v = ves_arena_doubles(arena, (size_t)r->count);
    ves_chart *chart;
    r->at = ves_arena_doubles(arena, (size_t)(3 * VES_FIELDS * r->count));
    if (!grid || !v || !r->at) return VES_MEMORY;
    for (int j = 0; j < r->count; j++) {
        v[j] = r->shift + r->run * j / r->count;
        v[j] -= VES_TWO_PI * floor(v[j] / VES_TWO_PI);
    }
    VES_TRY(ves_patch_status(plan->patch[patch]));
    VES_TRY(ves_grid_given(1, &u, r->count, v, true, arena, grid));
    VES_TRY(ves_chart_create(plan->patch[patch], grid, EVERYTHING, arena, &chart));
    VES_TRY(ves_chart_prepare(chart, &plan->bound, false));
    for (int t = 0; t < ves_tile_count(grid); t++) {
        ves_tile tile;
        ves_tile_at(grid, t, EVERYTHING, &tile);
        ves_chart_sample(chart, &tile, plan->field);
        ves_tile_scale(&tile, plan->similarity, plan->field);
        for (int p = 0; p < 3 * VES_FIELDS; p++)
            for (int row = 0; row < tile.rows; row++)
                r->at[p * r->count + tile.row[row]] = plan->field->at[p][row * VES_LANES];
    }
    return VES_OK;
}

/* The surface at one place, its first parameter running across the joint: X, Xw, Xv, Xww, Xwv, Xvv. */
typedef struct side {
    double field[VES_FIELDS][3], normal[3];
    double curvature; /* across; normal and curvature are NAN where there is no tangent plane */
} side;

/* With p the part of X_w that is perpendicular to X_v, X_w = p + (F/G) X_v, the conormal is p / |p|, and
 * |p|^2 = |X_w x X_v|^2 / G. */
static void forms(side *s)
{
    const double *w = s->field[VES_FIELD_U], *v = s->field[VES_FIELD_V];
    double n[3], G = ves_dot(v, v), share = ves_dot(w, v) / G;
    ves_cross(w, v, n);
    double length = sqrt(ves_dot(n, n));
    if (!(length > FLAT * (ves_dot(w, w) + G))) length = NAN;
    for (int c = 0; c < 3; c++) s->normal[c] = n[c] / length;
    double across = ves_dot(s->normal, s->field[VES_FIELD_UU]) -
                    2 * share * ves_dot(s->normal, s->field[VES_FIELD_UV]) +
                    share * share * ves_dot(s->normal, s->field[VES_FIELD_VV]);
    s->curvature = across * G / (length * length);
}

/* sign: of u across the joint. v runs as it does at the first end. */
static void side_at(const rim *r, int j, double sign, side *s)
{
    double along = r->run < 0 ? -1 : 1;
    for (int f = 0; f < VES_FIELDS; f++) {
        double turned = (ves_field_d[f] == 1 ? sign : 1) * (ves_field_e[f] == 1 ? along : 1);
        for (int c = 0; c < 3; c++) s->field[f][c] = turned * r->at[(f * 3 + c) * r->count + j];
    }
    forms(s);
}

/* --- how they differ --- */

/* The larger; what is no number stays. */
static double worse(double most, double value)
{
    return isnan(most) || value <= most ? most : value;
}

static double apart(const double a[3], const double b[3])
{
    double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(ves_dot(d, d));
}

/* The larger of two vectors. */
static double longer(const double a[3], const double b[3])
{
    return sqrt(fmax(ves_dot(a, a), ves_dot(b, b)));
}

static double turn(const double a[3], const double b[3])
{
    double n[3];
    ves_cross(a, b, n);
    return atan2(sqrt(ves_dot(n, n)), ves_dot(a, b));
}

/* Sizes that jumps are compared with. */
typedef struct sizes {
    double curvature, second;
} sizes;

static void compare(const side *a, const side *b, ves_joint *j, sizes *size)
{
    const double *aw = a->field[VES_FIELD_U], *bw = b->field[VES_FIELD_U], slope = longer(aw, bw);
    const double *aww = a->field[VES_FIELD_UU], *bww = b->field[VES_FIELD_UU];
    j->gap = worse(j->gap, apart(a->field[VES_FIELD_X], b->field[VES_FIELD_X]));
    j->angle = worse(j->angle, turn(a->normal, b->normal));
    j->slope_jump = worse(j->slope_jump, apart(aw, bw) / slope);
    j->second_jump = worse(j->second_jump, apart(aww, bww));
    j->curvature_jump = worse(j->curvature_jump, fabs(a->curvature - b->curvature));
    size->curvature = worse(size->curvature, fmax(fabs(a->curvature), fabs(b->curvature)));
    size->second = worse(size->second, fmax(slope, longer(aww, bww)));
}

/* The root mean square distance of a rim from its middle. */
static double radius(const rim *r)
{
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        double mean = 0;
        for (int j = 0; j < r->count; j++) mean += r->at[c * r->count + j] / r->count;
        for (int j = 0; j < r->count; j++) {
            double d = r->at[c * r->count + j] - mean;
            sum += d * d / r->count;
        }
    }
    return sqrt(sum);
}

static ves_joint_class class_of(const ves_joint *j, double radius)
{
    if (!(j->gap <= GAP * radius)) return VES_JOINT_OPEN;
    if (!(j->angle <= ANGLE)) return VES_JOINT_C0;
    bool curvature = j->curvature_relative <= CURVATURE, slope = j->slope_jump <= SLOPE;
    if (curvature && slope) return j->second_jump <= SECOND ? VES_JOINT_C2 : VES_JOINT_C1_G2;
    return curvature ? VES_JOINT_G2 : slope ? VES_JOINT_C1 : VES_JOINT_G1;
}

static int places(const ves_plan *plan, const ves_joint *j)
{
    int band = 0;
    for (int k = 0; k < 2; k++) {
        int own = ves_patch_band(plan->patch[j->patch[k]]);
        if (own > band) band = own;
    }
    int count = EACH_MODE * band;
    return count < LEAST ? LEAST : count > MOST ? MOST : count;
}

static ves_status measure(ves_plan *plan, ves_arena *arena, ves_joint *j)
{
    rim r[2];
    sizes size = {0, 0};
    plan_sheet now = {0}; /* how the ends lie on each other: the shift may vary */
    if (j->patch[0] == j->patch[1] && meets_itself(plan, j->patch[0]))
        VES_TRY(ves_sheet_look(plan, j->patch[0], &now));
    for (int k = 0; k < 2; k++) {
        r[k] = (rim){.count = places(plan, j),
                     .shift = k ? now.ends.shift : 0,
                     .run = k && now.ends.reversed ? -VES_TWO_PI : VES_TWO_PI};
        VES_TRY(rim_sample(plan, j->patch[k], j->end[k], arena, &r[k]));
    }
    for (int i = 0; i < r[0].count; i++) {
        side a, b; /* u leaves the first patch at its end 1 and enters the second at its end 0 */
        side_at(&r[0], i, j->end[0] == 1 ? 1 : -1, &a);
        side_at(&r[1], i, j->end[1] == 0 ? 1 : -1, &b);
        compare(&a, &b, j, &size);
    }
    double round = radius(&r[0]);
    j->second_jump /= size.second;
    j->curvature_relative = j->curvature_jump / fmax(size.curvature, 1 / round);
    j->continuity = class_of(j, round);
    return VES_OK;
}

ves_status ves_plan_joint(ves_plan *plan, int index, ves_joint *found)
{
    ves_joint joint;
    ves_arena arena = {0};
    if (index < 0 || index >= ves_plan_joints(plan)) return VES_RANGE;
    find(plan, index, &joint);
    ves_status status = measure(plan, &arena, &joint);
    ves_arena_destroy(&arena);
    if (status == VES_OK) *found = joint;
    return status;
}

const char *ves_joint_text(ves_joint_class continuity)
{
    static const char *const text[] = {"open", "C0", "G1", "C1", "G2", "C1 G2", "C2"};
    return (unsigned)continuity < sizeof text / sizeof *text ? text[continuity] : "unknown";
}

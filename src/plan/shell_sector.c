/* Sectors: what a shell has in common with itself, turned about an axis or mirrored in a plane through it. Patches go
 * round in v; the shell is the same turned by 2 pi / N when X(u, v + 2 pi / N) is X(u, v) turned, in all its parts, and
 * so are thicknesses, supports, loads and what measures ask; mirrored when X(u, 2 v0 - v) is X(u, v) mirrored. Looked at on a
 * lattice of places, close enough around to see what is local, at several designs: what holds there to rounding holds
 * always, since it is the file that makes it so. */
#include "plan/shell.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

enum {
    ALONG = 8,
    AROUND = 96,
    COARSE = 16,
    PLACES = ALONG * AROUND,
    FEW = 6,
    FOLDS = 64,
    LOW_FOLDS = 8,
    ENDS = 6
};

/* Rows of places: those inside, then (ENDS) the two ends. */
static const double ROW[ALONG] = {0.43, 0.1, 0.77, 0.27, 0.61, 0.93, 0, 1};

static const double SAME = 1e-9;  /* of the shell's size, or of the largest value */
static const double STRIP = 1e-3; /* rad: the ring's strip; what it leaves out is of the square of this */

typedef struct seeker {
    ves_plan *plan;
    const plan_shell *shell;
    double *room, *out;
    const double *here;              /* positions of a part at places */
    double *few, *there;             /* room for those of few, and for those of images */
    double **all;                    /* [parts] of all places */
    bool *taken;                     /* [parts] at this design */
    double axis[3], centre[3], size; /* at the design that is bound */
    int around, places; /* of those below, at which is looked: a few of them tell most that is not alike */
    double u[PLACES], v[PLACES];
} seeker;

static void rotation(const double axis[3], double angle, double Q[3][3])
{
    double c = cos(angle), s = sin(angle);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            int k = 3 - i - j;
            double across = i == j ? 0 : (j == (i + 1) % 3 ? -axis[k] : axis[k]);
            Q[i][j] = (i == j) * c + (1 - c) * axis[i] * axis[j] + s * across;
        }
}

static void reflection(const double normal[3], double Q[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) Q[i][j] = (i == j) - 2 * normal[i] * normal[j];
}

static void apply(double Q[3][3], const double a[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = ves_dot(Q[i], a);
}

/* Positions of one part at the places, v taken to sign * v + shift: into out, as ves_patch_point lays them out. */
static const double *points(seeker *k, int part, double sign, double shift)
{
    const ves_patch *patch = k->plan->patch[k->shell->def->part[part].patch];
    double v[PLACES];
    for (int i = 0; i < k->places; i++) {
        v[i] = fmod(sign * k->v[i] + shift, VES_TWO_PI);
        if (v[i] < 0) v[i] += VES_TWO_PI;
    }
    ves_patch_point(patch, &k->plan->bound, k->places, k->u, v, k->out, k->room);
    return k->out;
}

/* Axis and centre of a ring of the first part, and the size of all: A = closed integral of X x dX / 2. False: there is
 * none at this design. */
static bool measure(seeker *k)
{
    double most = 0;
    k->size = 0;
    k->places = ALONG * k->around;
    const double *X = points(k, 0, 1, 0);
    for (int row = 0; row < ALONG; row++) {
        double mean[3] = {0}, area[3] = {0};
        for (int c = 0; c < 3; c++)
            for (int j = 0; j < k->around; j++) mean[c] += X[c * k->places + row * k->around + j] / k->around;
        for (int j = 0; j < k->around; j++) {
            double a[3], b[3], cross[3];
            for (int c = 0; c < 3; c++) {
                a[c] = X[c * k->places + row * k->around + j] - mean[c];
                b[c] = X[c * k->places + row * k->around + (j + 1) % k->around] - mean[c];
            }
            ves_cross(a, b, cross);
            for (int c = 0; c < 3; c++) area[c] += cross[c];
            k->size = fmax(k->size, sqrt(ves_dot(a, a)));
        }
        double length = sqrt(ves_dot(area, area));
        if (!(length > most)) continue;
        most = length;
        for (int c = 0; c < 3; c++) k->axis[c] = area[c] / length, k->centre[c] = mean[c];
    }
    return most > 0 && isfinite(most) && isfinite(k->size);
}

/* Values of a formula at the places of a part, in `out` (positions) given. */
static double formula_at(const seeker *k, int part, const double *X, int i, double v,
                         const ves_formula *formula)
{
    double at[VES_SHELL_ARGUMENTS] = {X[i], X[k->places + i], X[2 * k->places + i]};
    ves_plan_domain_at(k->plan, k->shell->def->part[part].patch, k->u[i], v, &at[VES_SHELL_U]);
    return ves_formula_eval(formula, k->plan->block, at, k->plan->formula_room);
}

typedef struct likeness { /* v -> sign v + shift goes with X -> Q (X - centre) + centre */
    double sign, shift, Q[3][3];
} likeness;

static double image_v(const seeker *k, const likeness *l, int i)
{
    double v = fmod(l->sign * k->v[i] + l->shift, VES_TWO_PI);
    return v < 0 ? v + VES_TWO_PI : v;
}

/* Positions of a part, for what follows. */
static void part_take(seeker *k, const likeness *l, int part)
{
    const size_t size = (size_t)(3 * k->places) * sizeof *k->out;
    double *here = k->places == FEW ? k->few : k->all[part];
    if (k->places == FEW || !k->taken[part]) memcpy(here, points(k, part, 1, 0), size);
    if (k->places != FEW) k->taken[part] = true;
    k->here = here;
    memcpy(k->there, points(k, part, l->sign, l->shift), size);
}

static bool shape_alike(const seeker *k, const likeness *l)
{
    for (int i = 0; i < k->places; i++) {
        double r[3], turned[3];
        for (int c = 0; c < 3; c++) r[c] = k->here[c * k->places + i] - k->centre[c];
        apply((double(*)[3])l->Q, r, turned);
        for (int c = 0; c < 3; c++)
            if (!(fabs(k->there[c * k->places + i] - turned[c] - k->centre[c]) <= SAME * k->size))
                return false;
    }
    return true;
}

/* One formula, or three that are a vector, at places and at their images. end: of the part, -1: all over it. */
static bool formulas_alike(const seeker *k, const likeness *l, int part, int end, int count,
                           const ves_formula *const *formula)
{
    double most = 0, worst = 0;
    int from = end < 0 ? 0 : (ENDS + end) * k->around, to = end < 0 ? k->places : from + k->around;
    for (int i = from; i < to; i++) {
        double f[3] = {0}, turned[3];
        for (int c = 0; c < count; c++) {
            f[c] = turned[c] = formula_at(k, part, k->here, i, k->v[i], formula[c]);
            most = fmax(most, fabs(f[c]));
        }
        if (count == 3) apply((double(*)[3])l->Q, f, turned);
        for (int c = 0; c < count; c++) {
            double apart = fabs(formula_at(k, part, k->there, i, image_v(k, l, i), formula[c]) - turned[c]);
            if (!(apart <= worst)) worst = apart;
        }
    }
    return worst <= SAME * most || most == 0;
}

/* --- what measures ask --- */

/* Of stresses: whether a place counts, not at the ends, where rounding may tell. */
static bool counts(const seeker *k, int part, const double *X, int i, double v, const ves_formula *where)
{
    enum { THICKNESS = VES_SHELL_ARGUMENTS };
    double at[THICKNESS + 1] = {X[i], X[k->places + i], X[2 * k->places + i]};
    ves_plan_domain_at(k->plan, k->shell->def->part[part].patch, k->u[i], v, &at[VES_SHELL_U]);
    at[THICKNESS] = formula_at(k, part, X, i, v, k->shell->def->part[part].thickness);
    return ves_formula_eval(where, k->plan->block, at, k->plan->formula_room) != 0;
}

static bool where_alike(const seeker *k, const likeness *l, int part, const ves_formula *where)
{
    for (int i = 0; i < ENDS * k->around; i++)
        if (counts(k, part, k->here, i, k->v[i], where) !=
            counts(k, part, k->there, i, image_v(k, l, i), where))
            return false;
    return true;
}

/* The largest displacement along a direction, of all: that direction, or its opposite. */
static bool direction_alike(const likeness *l, const double d[3])
{
    double turned[3], size = sqrt(ves_dot(d, d));
    apply((double(*)[3])l->Q, d, turned);
    return fabs(fabs(ves_dot(turned, d)) - size * size) <= SAME * size * size;
}

static bool measure_alike(const seeker *k, const likeness *l, int part, const ves_measure_def *m)
{
    const double *along = NULL;
    bool placed = false;
    for (int a = 0; a < m->args.count; a++) {
        const ves_key *key = &m->args.key[a];
        const ves_arg *arg = &m->args.arg[a];
        if (!arg->given) continue;
        if (key->kind == VES_SHELLWISE && !where_alike(k, l, part, arg->formula[0])) return false;
        if (key->kind == VES_SHELL_AT || key->kind == VES_SHELL_HELD) placed = true;
        if (key->kind == VES_VECTOR) along = k->plan->block + arg->first;
    }
    return placed || !along || direction_alike(l, along);
}

static bool measures_alike(const seeker *k, const likeness *l, int part)
{
    const ves_problem *p = k->plan->problem;
    for (int m = 0; m < p->measures; m++)
        if (p->measure[m].measure->shell && !measure_alike(k, l, part, &p->measure[m])) return false;
    return true;
}

/* A subspace, by its projector, is taken to itself. */
static bool space_alike(const likeness *l, const double P[3][3])
{
    double QP[3][3], most = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            QP[i][j] = 0;
            for (int m = 0; m < 3; m++) QP[i][j] += l->Q[i][m] * P[m][j] - P[i][m] * l->Q[m][j];
            most = fmax(most, fabs(QP[i][j]));
        }
    return most <= SAME;
}

static bool support_alike(const seeker *k, const likeness *l, const ves_support_def *s)
{
    double move[3][3] = {{0}}, turn[3][3] = {{0}};
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++)
            if (s->kind == VES_SUPPORT_SYMMETRY || s->kind == VES_SUPPORT_DIAPHRAGM)
                move[i][j] = s->axis[i] * s->axis[j];
        if (s->kind == VES_SUPPORT_FIX) move[i][i] = s->fix >> i & 1, turn[i][i] = s->fix >> (3 + i) & 1;
        if (s->kind == VES_SUPPORT_SPRING) move[i][i] = k->plan->block[s->spring + i];
    }
    double size = 0;
    for (int i = 0; i < 3; i++) size = fmax(size, move[i][i]);
    for (int i = 0; i < 9 && size > 0; i++) move[i / 3][i % 3] /= size;
    return s->at.kind != VES_AT_PLACE && space_alike(l, (const double(*)[3])move) &&
           space_alike(l, (const double(*)[3])turn);
}

/* On one part. */
static bool load_alike(const seeker *k, const likeness *l, int part, const ves_load_def *load)
{
    bool edge = load->kind == VES_LOAD_LINE || load->kind == VES_LOAD_FORCE;
    if (edge && load->at.kind == VES_AT_PLACE) return false;
    int count = load->kind == VES_LOAD_PRESSURE ? 1 : 3;
    const ves_shell_edge *on = &load->at.on[0]; /* of a curve: where the load is taken */
    if (edge) return on->part != part || formulas_alike(k, l, part, on->edge, count, load->formula);
    for (int i = 0; i < load->parts; i++)
        if (load->part[i] == part && !formulas_alike(k, l, part, -1, count, load->formula)) return false;
    return true;
}

static bool part_alike(seeker *k, const likeness *l, int part)
{
    const ves_shell_def *def = k->shell->def;
    part_take(k, l, part);
    if (!shape_alike(k, l)) return false;
    if (k->places == FEW) return true;
    if (!formulas_alike(k, l, part, -1, 1, &def->part[part].thickness)) return false;
    for (int c = 0; c < def->cases; c++)
        for (int i = 0; i < def->load_case[c].loads; i++)
            if (!load_alike(k, l, part, &def->load_case[c].load[i])) return false;
    return measures_alike(k, l, part);
}

static bool alike(seeker *k, const likeness *l)
{
    const ves_shell_def *def = k->shell->def;
    for (int s = 0; s < def->supports; s++)
        if (!support_alike(k, l, &def->support[s])) return false;
    for (int pass = 0; pass < 2; pass++) {
        k->places = pass ? ALONG * k->around : FEW;
        for (int p = 0; p < def->parts; p++)
            if (!part_alike(k, l, p)) return false;
    }
    return true;
}

static bool turned_alike(seeker *k, double angle, likeness *l)
{
    *l = (likeness){.sign = 1, .shift = angle};
    rotation(k->axis, angle, l->Q);
    return alike(k, l);
}

/* The normal of the plane through the axis and X(., v0) of the first part. */
static bool plane_at(seeker *k, double v0, double normal[3])
{
    double r[3];
    k->places = FEW;
    const double *X = points(k, 0, 0, v0);
    for (int i = 0; i < k->places; i++) {
        for (int c = 0; c < 3; c++) r[c] = X[c * k->places + i] - k->centre[c];
        ves_cross(k->axis, r, normal);
        double length = sqrt(ves_dot(normal, normal));
        if (!(length > 1e-3 * k->size)) continue;
        for (int c = 0; c < 3; c++) normal[c] /= length;
        return true;
    }
    return false;
}

static bool mirrored_alike(seeker *k, double v0, double normal[3])
{
    likeness l = {.sign = -1, .shift = 2 * v0};
    if (!plane_at(k, v0, normal)) return false;
    reflection(normal, l.Q);
    return alike(k, &l);
}

/* --- what holds at every design --- */

enum { PLANES = 2 };

typedef struct finding {
    int folds;
    bool ring, fold, mirror[PLANES], any; /* mirror: a plane at v = 0, or at a quarter of a fold */
} finding;

static double mirror_at(int folds, int which)
{
    return which ? VES_PI / (2 * folds) : 0;
}

static void look(seeker *k, finding *f)
{
    likeness l;
    double normal[3];
    f->ring = f->ring && turned_alike(k, 1, &l) && turned_alike(k, 2.4, &l);
    f->fold = f->fold && (f->ring || turned_alike(k, VES_TWO_PI / f->folds, &l));
    for (int w = 0; w < PLANES; w++)
        f->mirror[w] =
            f->mirror[w] && (w == 0 || f->fold) && mirrored_alike(k, mirror_at(f->folds, w), normal);
}

static bool possible(const ves_plan *plan, const plan_shell *shell)
{
    bool round = shell->def->symmetric;
    for (int k = 0; k < shell->def->parts; k++)
        round = round && ves_patch_periodic(plan->patch[shell->def->part[k].patch]);
    return round;
}

/* Elements that are tied need a width: strips of a ring are of those that are not. */
static bool low_order(const plan_shell *shell)
{
    const ves_shell_def *def = shell->def;
    return def->mesh.order && def->mesh.order < VES_SHELL_FULL;
}

static void sector_fill(seeker *k, const finding *f, plan_sector *s)
{
    int n = f->fold ? f->folds : 1;
    bool plane = f->mirror[0] || f->mirror[1];
    s->ring = f->ring && !low_order(k->shell);
    if (f->ring && !s->ring) n = LOW_FOLDS;
    if (!s->ring && n == 1 && !plane) return;
    /* Modes of buckling that go round are in no half of a sector, but where there are no more than two. */
    if (k->shell->buckles && n > 2) plane = false;
    s->whole = false, s->mirrored = !s->ring && plane, s->folds = s->ring ? (int)(VES_TWO_PI / STRIP) : n;
    s->from = s->mirrored ? mirror_at(n, !f->mirror[0]) : 0;
    s->to = s->from + (s->ring ? STRIP : s->mirrored ? VES_PI / n : VES_TWO_PI / n);
    s->copies = VES_TWO_PI / (s->to - s->from);
    rotation(k->axis, s->to - s->from, s->turn);
    for (int end = 0; end < 2 && s->mirrored; end++) plane_at(k, end ? s->to : s->from, s->mirror[end]);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            s->share[i][j] =
                n > 1 || s->ring ? k->axis[i] * k->axis[j] : (i == j) - s->mirror[0][i] * s->mirror[0][j];
    memcpy(s->axis, k->axis, sizeof s->axis);
}

static ves_status rooms_make(seeker *k, int parts)
{
    ves_arena *arena = &k->plan->arena;
    k->few = ves_arena_doubles(arena, 3 * FEW);
    k->there = ves_arena_doubles(arena, 3 * PLACES);
    k->all = ves_arena_take(arena, (size_t)parts, sizeof *k->all);
    k->taken = ves_arena_take(arena, (size_t)parts, sizeof *k->taken);
    if (!k->few || !k->there || !k->all || !k->taken) return VES_MEMORY;
    for (int p = 0; p < parts; p++)
        if (!(k->all[p] = ves_arena_doubles(arena, 3 * PLACES))) return VES_MEMORY;
    return VES_OK;
}

/* Close around at one design; the others tell what varies. */
static void places_lay(seeker *k, int around)
{
    k->around = around;
    for (int i = 0; i < ALONG * around; i++) {
        k->u[i] = ROW[i / around];
        k->v[i] = VES_TWO_PI * (i % around + 0.1) / around; /* the first few: of one ring */
    }
}

ves_status ves_shell_sector_find(ves_plan *plan, plan_shell *shell)
{
    plan_sector *s = &shell->sector;
    seeker k = {.plan = plan, .shell = shell};
    bool round = shell->folds == 0;
    int folds = round ? LOW_FOLDS : shell->folds < FOLDS ? shell->folds : FOLDS;
    finding f = {folds, round, round || folds > 1, {true, true}, false};
    long room = 0;
    *s = (plan_sector){
        .whole = true, .to = VES_TWO_PI, .folds = 1, .copies = 1, .share = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    if (!possible(plan, shell)) return VES_OK;
    for (int p = 0; p < shell->def->parts; p++) {
        long own = ves_patch_point_room(plan->patch[shell->def->part[p].patch]);
        if (own > room) room = own;
    }
    k.room = ves_arena_doubles(&plan->arena, (size_t)room);
    k.out = ves_arena_doubles(&plan->arena, (size_t)(3 * VES_POLE_FIELDS * PLACES));
    if (!k.room || !k.out) return VES_MEMORY;
    VES_TRY(rooms_make(&k, shell->def->parts));
    for (int d = SHELL_DESIGNS - 1; d >= 0; d--) {
        ves_shell_design(plan, d);
        places_lay(&k, d == 0 ? AROUND : COARSE);
        memset(k.taken, 0, sizeof *k.taken * (size_t)shell->def->parts);
        if (!measure(&k)) continue;
        look(&k, &f);
        f.any = true;
    }
    if (f.any && measure(&k)) sector_fill(&k, &f, s);
    return VES_OK;
}

/* --- places --- */

double ves_sector_place(const plan_sector *s, double v, double map[3][3])
{
    double period = s->ring ? 0 : VES_TWO_PI / s->folds, at = v - s->from, turned = at;
    for (int i = 0; i < 9; i++) map[i / 3][i % 3] = i % 4 == 0;
    if (s->whole) return v;
    if (s->ring)
        turned = 0;
    else
        turned = at - period * floor(at / period + 1e-12);
    rotation(s->axis, at - turned, map);
    if (!s->mirrored || turned <= s->to - s->from + 1e-12) return s->from + turned;
    double M[3][3], product[3][3] = {{0}};
    reflection(s->mirror[1], M);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            for (int k = 0; k < 3; k++) product[i][j] += map[i][k] * M[k][j];
    memcpy(map, product, sizeof product);
    return s->from + period - turned;
}

/* What the end curves look like at the start: those that cross themselves, and ends that nearly meet. */
#include <math.h>

#include "base/vector.h"
#include "plan/inside.h"

enum { LEAST = 256, MOST = 1024, AROUND = 64, STEPS = 4 };

/* Two pieces cross where they come this near to each other, relative to the curve, and are not parallel: a
 * curve pressed flat runs over its own way back, and that is no crossing. */
static const double TOUCH = 1e-6, SLANT = 1e-3;

/* Ends this near to each other, relative to their size, were probably meant to meet. */
static const double NEAR = 0.05;

static double distance(const double a[3], const double b[3])
{
    double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return sqrt(ves_dot(d, d));
}

typedef struct edge {
    int count;
    double (*point)[3]; /* [count + 1]: the last is the first */
    double size;        /* largest distance from the first, about the width */
} edge;

static bool edge_make(const ves_plan *plan, int curve, int count, ves_arena *arena, edge *e)
{
    const double *coef = ves_curves_coef(plan->curves, curve);
    int modes = ves_curves_modes(plan->curves, curve);
    *e = (edge){.count = count, .point = ves_arena_take(arena, (size_t)count + 1, sizeof *e->point)};
    for (int j = 0; e->point && j <= count; j++) {
        ves_curve_point(coef, modes, j < count ? VES_TWO_PI * j / count : 0, 0, e->point[j]);
        e->size = fmax(e->size, distance(e->point[j], e->point[0]));
    }
    return e->point && isfinite(e->size);
}

/* Steps s along a and t along b that close `apart` best, from the one line to the other; false: they are
 * nearly parallel. */
static bool approach(const double a[3], const double b[3], const double apart[3], double *s, double *t)
{
    double aa = ves_dot(a, a), bb = ves_dot(b, b), ab = ves_dot(a, b), d = aa * bb - ab * ab;
    if (!(d > SLANT * SLANT * aa * bb)) return false;
    *s = (bb * ves_dot(a, apart) - ab * ves_dot(b, apart)) / d;
    *t = (ab * ves_dot(a, apart) - aa * ves_dot(b, apart)) / d;
    return true;
}

/* Where pieces i and j cross: s and t from 0 to 1 along them. */
static bool cross(const edge *e, int i, int j, double *s, double *t)
{
    const double *p = e->point[i], *q = e->point[j];
    double a[3], b[3], apart[3], miss[3];
    for (int c = 0; c < 3; c++) {
        a[c] = e->point[i + 1][c] - p[c];
        b[c] = e->point[j + 1][c] - q[c];
        apart[c] = q[c] - p[c];
    }
    if (ves_dot(apart, apart) > 4 * (ves_dot(a, a) + ves_dot(b, b)) || !approach(a, b, apart, s, t))
        return false;
    if (fmin(*s, *t) < -TOUCH || fmax(*s, *t) > 1 + TOUCH) return false;
    for (int c = 0; c < 3; c++) miss[c] = apart[c] + *t * b[c] - *s * a[c];
    return sqrt(ves_dot(miss, miss)) <= TOUCH * e->size;
}

/* What is rounding beside a size is 0. */
static double plain(double value, double size)
{
    return fabs(value) < TOUCH * size ? 0 : value;
}

static void warn(const ves_plan *plan, int curve, const double v[2], double size, ves_diag *diag)
{
    double x[3];
    ves_curve_point(ves_curves_coef(plan->curves, curve), ves_curves_modes(plan->curves, curve), v[0], 0, x);
    for (int c = 0; c < 3; c++) x[c] = plain(x[c], size);
    ves_diag_add(diag, VES_WARNING, VES_OK, plan->problem->curve[curve].mark,
                 "curve \"%s\" crosses itself at v = %.4g and v = %.4g, both at (%.3g, %.3g, %.3g)%s: a "
                 "surface that ends on it folds there",
                 plan->problem->curve[curve].name, plain(v[0], 1), v[1], x[0], x[1], x[2],
                 plan->problem->units ? " m" : "");
}

/* From pieces to the curve itself: Gauss-Newton on X(v[1]) - X(v[0]). */
static void refine(const ves_plan *plan, int curve, double v[2])
{
    const double *coef = ves_curves_coef(plan->curves, curve);
    int modes = ves_curves_modes(plan->curves, curve);
    for (int k = 0; k < STEPS; k++) {
        double p[6], q[6], apart[3], s, t;
        ves_curve_point(coef, modes, v[0], 1, p);
        ves_curve_point(coef, modes, v[1], 1, q);
        for (int c = 0; c < 3; c++) apart[c] = q[c] - p[c];
        if (!approach(p + 3, q + 3, apart, &s, &t)) return;
        v[0] += s, v[1] += t;
    }
}

/* The first crossing; a space curve seldom has one, a flat one often. */
static void crossing_find(const ves_plan *plan, int curve, const edge *e, ves_diag *diag)
{
    double s, t, step = VES_TWO_PI / e->count;
    for (int i = 0; i < e->count; i++)
        for (int j = i + 2; j < e->count - (i == 0); j++) {
            if (!cross(e, i, j, &s, &t)) continue;
            double v[2] = {step * (i + s), step * (j + t)};
            refine(plan, curve, v);
            warn(plan, curve, v, e->size, diag);
            return;
        }
}

static bool is_end(const ves_plan *plan, int curve)
{
    for (int p = 0; p < plan->problem->patches; p++)
        for (int end = 0; end < 2; end++)
            if (ves_end_curve(plan, p, end) == curve) return true;
    return false;
}

void ves_edges_cross(const ves_plan *plan, ves_diag *diag)
{
    for (int c = 0; diag && c < plan->problem->curves; c++) {
        int modes = ves_curves_modes(plan->curves, c), count = 4 * modes;
        ves_arena arena = {0};
        edge e;
        count = count < LEAST ? LEAST : count > MOST ? MOST : count;
        if (modes > 0 && is_end(plan, c) && edge_make(plan, c, count, &arena, &e))
            crossing_find(plan, c, &e, diag);
        ves_arena_destroy(&arena);
    }
}

/* How far a strays from b: the largest distance of its points from those of b. */
static double stray(const edge *a, const edge *b)
{
    double most = 0;
    for (int i = 0; i < a->count; i++) {
        double least = HUGE_VAL;
        for (int j = 0; j < b->count; j++) least = fmin(least, distance(a->point[i], b->point[j]));
        most = fmax(most, least);
    }
    return most;
}

bool ves_edge_near(const ves_plan *plan, int patch, int end, ves_end *other, double *gap)
{
    int curve = ves_end_curve(plan, patch, end);
    ves_arena arena = {0};
    edge own, e;
    *gap = HUGE_VAL;
    bool good = curve >= 0 && edge_make(plan, curve, AROUND, &arena, &own);
    for (int p = 0; good && p < plan->problem->patches; p++)
        for (int k = 0; k < 2; k++) {
            int there = ves_end_curve(plan, p, k);
            if (there < 0 || there == curve || !edge_make(plan, there, 4 * AROUND, &arena, &e)) continue;
            double found = stray(&own, &e);
            if (found >= *gap) continue;
            *gap = found;
            *other = (ves_end){.patch = p, .end = k};
        }
    good = good && *gap < NEAR * own.size;
    ves_arena_destroy(&arena);
    return good;
}

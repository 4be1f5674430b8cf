/* Joins: two ends on one curve that take their derivatives there from one field, seen in the points of both
 * patches beside what the plan tells of its joints. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/vector.h"
#include "bed.h"
#include "vesica/verdict.h"

enum { TEXT = 4000, AROUND = 7, N = 4 };

/* A wavy pipe from `top` over `rim` to `foot`. %d: the end of each patch at the rim; the join's scale and more;
 * the power. */
#define PIPE                                                                                                 \
    "vesica: 1\nvalidity: {jacobian: any}\nvariables: {m: [0.5, 1.5, 2], n: [0.5, 0.7, 2], q: [-1, 0.3, "    \
    "1]}\n"                                                                                                  \
    "curves:\n"                                                                                              \
    "  top: {circle: {radius: 1.2, centre: [0.1, 0, 1 + q]}}\n"                                              \
    "  rim: {formula: [\"(1 + 0.1*cos(3*v))*cos(v)\", \"(1 + 0.1*q*cos(3*v))*sin(v)\", \"0.2*sin(2*v)\"]}\n" \
    "  foot: {ellipse: {radii: [0.8, 1.1], centre: [0, 0.2, -1.3]}}\n"                                       \
    "  tilt: {formula: [\"0.4*cos(v)\", \"0.3*sin(v)\", \"-1 + 0.1*cos(v + q)\"]}\n"                         \
    "  arch: {formula: [\"-0.5*cos(v)\", \"-0.6*sin(v)\", \"0.2*q*sin(v)\"]}\n"                              \
    "patches:\n"                                                                                             \
    "  a: {operator: {power: %d, a: 0.9}, conditions: [{u: %d, position: top}, {u: %d, position: rim}%s]}\n" \
    "  b: {operator: {power: %d}, conditions: [{u: %d, position: rim}, {u: %d, position: foot}%s]}\n"        \
    "joins: [{ends: [a.u%d, b.u%d], tangent: tilt%s}]\nminimize: bending + area + m*n\n"

/* Without bend one condition of each patch is left, an X_u at its far end. */
static bed pipe_make(int a, int b, bool bends, const char *scale)
{
    char text[2 * TEXT], more[2][200] = {"", ""}, join[200];
    for (int k = 0; k < 2 && !bends; k++)
        snprintf(more[k], sizeof more[k], ", {u: %d, derivative: 1, field: tilt, scale: %g}",
                 k ? 1 - b : 1 - a, (k ? b : a) == 1 - k ? 0.5 : -0.5);
    snprintf(join, sizeof join, "%s%s", scale, bends ? ", bend: arch" : "");
    snprintf(text, sizeof text, PIPE, 2, 1 - a, a, more[0], 2, b, 1 - b, more[1], a, b, join);
    return bed_with(text, NULL, 16, 32);
}

static double measure(const bed *b, double x[3])
{
    ves_design design;
    cr_assert_eq(ves_plan_measure(b->plan, x, 0, &design), VES_OK);
    return design.objective;
}

/* X_w, the derivative that leads from patch a into patch b, X_v, X_uu, X_uv, X_vv of one side at one v. */
typedef struct side {
    double w[3], v[3], ww[3], wv[3], vv[3], normal[3];
} side;

static side side_at(const bed *b, int patch, int end, double v)
{
    double X[18], sign = patch == 0 ? (end ? 1 : -1) : (end ? -1 : 1), length;
    side s;
    cr_assert_eq(ves_plan_points(b->plan, patch, 1, (double[]){end}, &v, X), VES_OK);
    for (int c = 0; c < 3; c++) {
        s.w[c] = sign * X[3 + c], s.v[c] = X[6 + c];
        s.ww[c] = X[9 + c], s.wv[c] = sign * X[12 + c], s.vv[c] = X[15 + c];
    }
    ves_cross(s.w, s.v, s.normal);
    length = sqrt(ves_dot(s.normal, s.normal));
    for (int c = 0; c < 3; c++) s.normal[c] /= length;
    return s;
}

/* The normal curvature conormal to the curve: of the direction w - (w.v / v.v) v. */
static double across(const side *s)
{
    double t = ves_dot(s->w, s->v) / ves_dot(s->v, s->v), d[3], L = ves_dot(s->ww, s->normal),
           M = ves_dot(s->wv, s->normal), P = ves_dot(s->vv, s->normal);
    for (int c = 0; c < 3; c++) d[c] = s->w[c] - t * s->v[c];
    return (L - 2 * t * M + t * t * P) / ves_dot(d, d);
}

static double far(const double a[3], const double b[3])
{
    return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* Whatever ends meet: the tangent planes agree always, X_w where the scale is one, curvatures and X_ww with bend.
 * Derivatives of size 2 out of double precision: 1e-13; of second order, with e^-a and its like, 1e-12. */
Test(joins, continue_the_surface_as_they_say)
{
    static const char *const scale[] = {"", ", scale: m", ", scale: [m, n]"};
    for (int way = 0; way < 8; way++)
        for (int k = 0; k < 3; k++) {
            int a = way & 1, b = way >> 1 & 1;
            bool bends = way >> 2, same = k < 2;
            bed bd = pipe_make(a, b, bends, scale[k]);
            double x[3] = {1.5, 0.7, 0.3}, m[2] = {k ? 1.5 : 1, k == 2 ? 0.7 : k ? 1.5 : 1};
            measure(&bd, x);
            for (int j = 0; j < AROUND; j++) {
                double v = 0.1 + 6 * j / (double)AROUND;
                side p = side_at(&bd, 0, a, v), q = side_at(&bd, 1, b, v);
                double tilt[3] = {0.4 * cos(v), 0.3 * sin(v), -1 + 0.1 * cos(v + 0.3)}, want[3];
                for (int c = 0; c < 3; c++) want[c] = m[0] * tilt[c] * (a ? 1 : -1);
                cr_expect(far(p.w, want) < 1e-13, "way %d, scale %d: tangent off by %g", way, k,
                          far(p.w, want));
                cr_expect(far(p.normal, q.normal) < 1e-12, "way %d, scale %d: G1 off by %g", way, k,
                          far(p.normal, q.normal));
                if (same) cr_expect(far(p.w, q.w) < 1e-13, "way %d: C1 off by %g", way, far(p.w, q.w));
                if (!same) cr_expect(fabs(sqrt(ves_dot(p.w, p.w) / ves_dot(q.w, q.w)) - 1.5 / 0.7) < 1e-12);
                if (bends)
                    cr_expect(fabs(across(&p) - across(&q)) < 1e-12, "way %d: G2 off by %g", way,
                              across(&p) - across(&q));
                if (bends && same)
                    cr_expect(far(p.ww, q.ww) < 1e-12, "way %d: C2 off by %g", way, far(p.ww, q.ww));
            }
            ves_joint joint;
            cr_assert_eq(ves_plan_joints(bd.plan), 1);
            cr_assert_eq(ves_plan_joint(bd.plan, 0, &joint), VES_OK);
            ves_joint_class wanted = bends  ? (same ? VES_JOINT_C2 : VES_JOINT_G2)
                                     : same ? VES_JOINT_C1
                                            : VES_JOINT_G1;
            cr_expect_eq(joint.continuity, wanted, "way %d, scale %d: class %d, want %d", way, k,
                         joint.continuity, wanted);
            bed_clear(&bd);
        }
}

/* d/d scale reaches the bend through its square. Fourth-order differences, bar as in tests/plan.c. */
Test(joins, have_exact_gradients)
{
    for (int bends = 0; bends < 2; bends++) {
        bed b = pipe_make(1, 0, bends, ", scale: [m, n*m]");
        double x[3] = {1.5, 0.7, 0.3}, g[3], h = 1e-3;
        ves_verdict verdict = {.gradient = g};
        ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
        cr_assert_eq(ves_plan_evaluate(b.plan, &ask, &verdict), VES_OK);
        cr_assert_eq(verdict.status, VES_OK);
        for (int k = 0; k < 3; k++) {
            static const double at[4] = {-2, -1, 1, 2}, weight[4] = {1, -8, 8, -1};
            double keep = x[k], want = 0;
            for (int s = 0; s < 4; s++) {
                x[k] = keep + at[s] * h;
                want += weight[s] * value_at(&b, x) / (12 * h);
            }
            x[k] = keep;
            cr_expect(fabs(g[k] - want) <= 1e-7 * (1 + fabs(want) + fabs(verdict.value)),
                      "%d: got %.12g, differences %.12g", k, g[k], want);
        }
        bed_clear(&b);
    }
}

/* Both ends of one patch, and units: a lens-shaped ring whose tube closes smoothly on itself. */
Test(joins, of_a_patch_with_itself_and_in_units)
{
    bed b = bed_with(
        "vesica: 1\ncurves:\n"
        "  inner: {circle: {radius: 10 mm}}\n"
        "  outer: {circle: {radius: 20 mm}}\n"
        "  high: {circle: {radius: 15 mm, centre: [0 mm, 0 mm, 5 mm]}}\n"
        "  low: {circle: {radius: 15 mm, centre: [0 mm, 0 mm, -5 mm]}}\n"
        "  up: {formula: [\"0\", \"0\", \"1\"]}\n"
        "  out: {formula: [cos(v)/m, sin(v)/m, \"0\"]}\n"
        "parameters: {m: 1 m}\npatches:\n"
        "  ring: {conditions: [{u: 0, position: inner}, {u: 0.25, position: high}, {u: 0.5, position: "
        "outer}, {u: 0.75, position: low}, {u: 1, position: inner}, {u: 0.5, derivative: 1, field: "
        "up, scale: -30 mm}], operator: {power: 5}}\n"
        "joins: [{ends: [ring.u1, ring.u0], tangent: up, scale: 30 mm, bend: out}]\n"
        "shape: {closed: true}\nexpect: [volume > 0 ml]\n",
        NULL, 32, 16);
    ves_design design;
    cr_assert_eq(ves_plan_measure(b.plan, NULL, 0, &design), VES_OK);
    for (int j = 0; j < AROUND; j++) {
        double u[2] = {0, 1}, v[2] = {j, j}, X[36];
        cr_assert_eq(ves_plan_points(b.plan, 0, 2, u, v, X), VES_OK);
        for (int f = 0; f < 6; f++)
            for (int c = 0; c < 3; c++) { /* to rounding of derivatives of size 1 m */
                cr_expect(fabs(X[(3 * f + c) * 2] - X[(3 * f + c) * 2 + 1]) < 1e-13, "field %d", f);
                if (f == 3)
                    cr_expect(fabs(X[(9 + c) * 2] - 9e-4 * (c ? c < 2 ? sin(j) : 0 : cos(j))) < 1e-13);
            }
    }
    bed_clear(&b);
}

/* What a packaging engineer asks of a container: draft, undercut, radii, what it holds. Closed forms, with the orders
 * at which cut integrals converge. (Gradients: tests/measure_gradient.c.) */
#include "samples.h"

#include "bed.h"
#include "problem/problem.h"
#include "vesica/plan.h"

/* Some thousand terms; a row that is cut is integrated twice. */
static const double ROUNDING = 1e-12;

/* A frustum or a tube with its caps, or a body without. */
static void stand(rig *r, const body *b, bool caps, int nu, int nv)
{
    rig_surface(r, b, nu, nv);
    if (caps) rig_ring(r, b, 0, nv, -1), rig_ring(r, b, 1, nv, 1);
}

static double along(const body *b, bool caps, const char *measure, const double axis[3], int nu, int nv)
{
    rig r;
    rig_open(&r);
    stand(&r, b, caps, nu, nv);
    rig_measure(&r, measure);
    rig_vector(&r, "axis", axis[0], axis[1], axis[2]);
    double value = rig_eval(&r);
    rig_close(&r);
    return value;
}

/* The body's own z, wherever it was turned; of any length. */
static void own_axis(const body *b, double axis[3])
{
    for (int c = 0; c < 3; c++) axis[c] = 2.5 * b->turn[c][2];
}

Test(measure_container, draft_of_cones_either_way_round)
{
    double h = 1.713;
    for (uint64_t seed = 0; seed < 5; seed++)
        for (int k = -2; k <= 2; k++) {
            double axis[3], r = 1.129, want = atan(0.217 * k / h);
            body b = body_init(frustum, -1, r, r + 0.217 * k, h);
            if (seed) b = body_moved(b, seed);
            own_axis(&b, axis);
            near(along(&b, false, "draft_angle", axis, 8, 12), want, ROUNDING, "cone");
            for (int c = 0; c < 3; c++) axis[c] = -axis[c];
            near(along(&b, false, "draft_angle", axis, 8, 12), -want, ROUNDING, "from the other side");
        }
}

/* Over a ball seen along any axis, sin of the draft is spread evenly over -1 .. 1: the mean of exp(-p d) is
 * integral of exp(-p d) cos d / 2 over -pi/2 .. pi/2 = cosh(p pi/2) / (p^2 + 1). */
Test(measure_container, soft_drafts_of_cone_and_ball)
{
    double axis[3] = {0, 0, 1}, p[] = {0.7, 3, 20};
    for (int k = 0; k < 3; k++) {
        body b = body_init(frustum, -1, 0.731, 1.129, 1.713),
             ball = body_init(ellipsoid, 1, 2.385, 2.385, 2.385);
        for (int ballish = 0; ballish < 2; ballish++) {
            double want = ballish ? -log(cosh(p[k] * PI / 2) / (p[k] * p[k] + 1)) / p[k]
                                  : atan((1.129 - 0.731) / 1.713);
            rig r;
            rig_open(&r);
            stand(&r, ballish ? &ball : &b, false, 48, 16);
            rig_measure(&r, "draft_angle");
            rig_vector(&r, "axis", axis[0], axis[1], axis[2]);
            rig_number(&r, "smooth", p[k]);
            near(rig_eval(&r), want, 1e-10, "soft draft"); /* what 48 nodes make of exp(20 d) at the poles */
            rig_close(&r);
        }
    }
}

/* The upper half of a ball is its disc, along any axis; of a ring along its own axis the annulus. */
Test(measure_container, undercut_is_what_is_seen_from_above)
{
    double R = 2.385, r = 0.731, axis[3];
    body ball = body_init(ellipsoid, 1, R, R, R), ring = body_init(torus, -1, R, r, 0);
    body cup = body_init(frustum, -1, r, R, 1.7), bell = body_init(frustum, -1, R, r, 1.7);
    own_axis(&ball, axis);
    near(along(&ball, false, "undercut", axis, 40, 16), PI * R * R, ROUNDING, "ball");
    near(along(&ring, false, "undercut", axis, 40, 16), 4 * PI * R * r, ROUNDING, "ring");
    near(along(&cup, true, "undercut", axis, 8, 16), 0, 0, "cup");
    near(along(&bell, true, "undercut", axis, 8, 16), PI * (R * R - r * r), ROUNDING, "bell");
}

static void falls(const char *what, const double *error, int count, double least)
{
    for (int k = 0; k + 1 < count; k++)
        cr_assert(log2(error[k] / error[k + 1]) > least, "%s: order %.2f (errors %.2e, %.2e), want %.2f",
                  what, log2(error[k] / error[k + 1]), error[k], error[k + 1], least);
}

/* Meridians of a ball that leans touch the silhouette nowhere: rows are cut and the order is that of the rows' ends.
 * A tube that lies is cut along rows, where nothing is gained: order 2. */
Test(measure_container, undercut_of_what_lies_is_of_order_2)
{
    double r = 0.731, h = 1.713, across[3] = {0.3, 1, 0}, error[4];
    body tube = body_init(frustum, -1, r, r, h);
    for (int k = 0; k < 4; k++)
        error[k] = fabs(along(&tube, false, "undercut", across, 4, 10 << k) - 2 * r * h);
    falls("tube", error, 4, 1.0);
    cr_assert(error[3] < 2e-3, "got %.2e", error[3]); /* (2 pi / 80)^2 / 3 */
}

Test(measure_container, undercut_of_a_leaning_ball)
{
    double R = 1.3, axis[3] = {0.2, -0.4, 1.1}, error[3];
    body ball = body_init(ellipsoid, 1, R, R, R);
    for (int k = 0; k < 3; k++)
        error[k] = fabs(along(&ball, false, "undercut", axis, 12 << k, 16 << k) - PI * R * R);
    cr_assert(error[2] < 1e-9, "errors %.2e %.2e %.2e", error[0], error[1], error[2]);
}

/* --- what it holds --- */

static double filled(const body *b, bool caps, const double axis[3], const char *key, double value, int nu,
                     int nv)
{
    rig r;
    rig_open(&r);
    stand(&r, b, caps, nu, nv);
    rig_measure(&r, "fill_volume");
    rig_vector(&r, "axis", axis[0], axis[1], axis[2]);
    if (key) rig_number(&r, key, value);
    double got = rig_eval(&r);
    rig_close(&r);
    return got;
}

static double cone_volume(double r0, double r1, double h)
{
    return PI * h / 3 * (r0 * r0 + r0 * r1 + r1 * r1);
}

Test(measure_container, a_cup_holds_frustums)
{
    double r0 = 0.731, r1 = 1.129, h = 1.713;
    for (uint64_t seed = 0; seed < 6; seed++) {
        body b = body_init(frustum, -1, r0, r1, h);
        if (seed) b = body_moved(b, seed);
        double axis[3], base = 0;
        own_axis(&b, axis);
        for (int c = 0; c < 3; c++) base += b.turn[c][2] * b.shift[c];
        for (int k = -1; k <= 11; k++) {
            double t = fmin(fmax(0.1 * k, 0), 1), want = cone_volume(r0, r0 + (r1 - r0) * t, h * t);
            near(filled(&b, true, axis, "height", base + 0.1 * k * h, 8, 12), want, ROUNDING, "height");
            near(filled(&b, true, axis, "below", (1 - 0.1 * k) * h, 8, 12), want, ROUNDING, "below");
        }
        near(along(&b, true, "brimful_volume", axis, 8, 12), cone_volume(r0, r1, h), ROUNDING, "brimful");
        near(filled(&b, true, axis, NULL, 0, 8, 12), cone_volume(r0, r1, h), ROUNDING,
             "nothing said: brimful");
    }
}

/* Upright: every row crosses the level, and the error falls geometrically. */
Test(measure_container, a_ball_holds_spherical_caps)
{
    double R = 2.385, axis[3] = {0, 0, 1};
    body ball = body_init(ellipsoid, 1, R, R, R);
    for (int k = 1; k < 20; k++) {
        double t = 0.1 * k * R;
        near(filled(&ball, false, axis, "height", t - R, 32, 12), PI * t * t * (3 * R - t) / 3, ROUNDING,
             "ball");
    }
}

/* 24 nodes along u, as few as a search has. */
Test(measure_container, levels_of_a_leaning_ball_are_good_to_a_millionth)
{
    double R = 2.385, axis[3] = {0.2, -0.4, 1.1}, worst = 0;
    body ball = body_init(ellipsoid, 1, R, R, R);
    for (int k = 1; k < 20; k++) {
        double t = 0.1 * k * R, want = PI * t * t * (3 * R - t) / 3;
        worst = fmax(worst, fabs(filled(&ball, false, axis, "height", t - R, 24, 64) - want));
    }
    cr_assert(worst < 1e-6 * 4 * PI / 3 * R * R * R, "off by %.2e", worst);
}

/* A tube that leans spills over the lowest point of its rim: pi r^2 (h - r tan) is left, while the base is covered. */
Test(measure_container, a_leaning_tube_holds_what_is_under_its_lip)
{
    double r = 0.731, h = 2.713;
    for (int k = 0; k < 11; k++) {
        double lean = 0.1 * k, turn = 0.37 * k, want = PI * r * r * (h - r * tan(lean));
        double axis[3] = {sin(lean) * cos(turn), sin(lean) * sin(turn), cos(lean)};
        body tube = body_init(frustum, -1, r, r, h);
        near(along(&tube, true, "brimful_volume", axis, 8, 16), want, ROUNDING, "all rows are cut");
        near(filled(&tube, true, axis, "below", 0, 8, 16), want, ROUNDING, "below");
    }
}

/* The level through the middle of the base leaves a hoof, 2/3 r^3 tan: spokes of the cap come under it with a kink. */
Test(measure_container, a_level_across_the_base_is_of_order_2)
{
    double r = 0.731, h = 2.713, lean = 0.4, axis[3] = {sin(lean), 0, cos(lean)}, error[4];
    body tube = body_init(frustum, -1, r, r, h);
    for (int k = 0; k < 4; k++)
        error[k] = fabs(filled(&tube, true, axis, "height", 0, 8, 16 << k) - 2. / 3 * r * r * r * tan(lean));
    falls("hoof", error, 4, 1.9);
    cr_assert(error[3] < r * r * r * pow(2 * PI / 128, 2) / 6, "got %.2e", error[3]);
}

/* The part of a lying tube under a level: a segment of its disc times its height. */
Test(measure_container, a_level_along_rows_is_of_order_2)
{
    double r = 0.731, h = 1.713, axis[3] = {1, 0, 0}, error[4], t = 0.31;
    double want = h * (r * r * acos(t / r) - t * sqrt(r * r - t * t));
    body tube = body_init(frustum, -1, r, r, h);
    for (int k = 0; k < 4; k++) error[k] = fabs(filled(&tube, true, axis, "height", -t, 4, 16 << k) - want);
    cr_assert(error[3] < 3 * r * r * h * pow(2 * PI / 128, 2), "errors %.2e %.2e %.2e %.2e", error[0],
              error[1], error[2], error[3]);
}

/* The lowest points of a wavy rim lie between its nodes, at three places. */
Test(measure_container, the_lip_of_a_wavy_rim_is_found_between_nodes)
{
    double axis[3] = {0, 0, 1}, w = 0.217, h = 1.713, least = h - w;
    body b = body_init(wavy_tube, -1, 1.129, w, h);
    double want = filled(&b, true, axis, "height", least, 16, 64);
    near(along(&b, true, "brimful_volume", axis, 16, 64), want, ROUNDING, "brimful");
    near(filled(&b, true, axis, "below", 0.25, 16, 64),
         filled(&b, true, axis, "height", least - 0.25, 16, 64), ROUNDING, "below");
}

Test(measure_container, without_a_rim_there_is_no_lip)
{
    static const char *const name[] = {"brimful_volume", "fill_volume"};
    body ball = body_init(ellipsoid, 1, 1.3, 1.3, 1.3);
    for (int k = 0; k < 2; k++) {
        double value = 42;
        rig r;
        rig_open(&r);
        rig_surface(&r, &ball, 8, 16);
        rig_measure(&r, name[k]);
        cr_assert(rig_try(&r, &value) == VES_NO_NUMBER && value == 42, "%s", name[k]);
        rig_close(&r);
        rig_open(&r);
        rig_surface(&r, &ball, 24, 16);
        rig_ring(&r, &ball, 0.5, 16, 0); /* the equator */
        rig_measure(&r, name[k]);
        rig_vector(&r, "axis", 0, 0, 1);
        rig_key(&r, "rim")->given = true;
        near(rig_eval(&r), 2 * PI / 3 * 1.3 * 1.3 * 1.3, ROUNDING, name[k]);
        rig_close(&r);
    }
}

/* --- on surfaces with looks --- */

static double asked(const char *text, const char *name)
{
    bed b = bed_with(text, NULL, 17, 24);
    double x[1] = {1}, value = NAN;
    ves_design design;
    cr_assert(ves_plan_measure(b.plan, x, 0, &design) == VES_OK, "%s", text);
    for (int k = 0; k < b.problem->measures; k++)
        if (!strcmp(b.problem->measure[k].name, name)) value = design.measure[k];
    bed_clear(&b);
    return value;
}

#define RING                                                                                                 \
    "vesica: 1\nvariables: {s: [0.5, 1, 2]}\n"                                                               \
    "patches: {p: {surface: {formula: [(2 + 0.6*s*cos(2*pi*u))*cos(v), 0.6*s*sin(2*pi*u), -(2 + "            \
    "0.6*s*cos(2*pi*u))*sin(v)]}}}\nshape: {closed: true}\n"

Test(measure_container, radii_and_draft_of_a_ring_are_attained)
{
    const char *text =
        RING "measures: {a: {min_radius: {}}, b: {min_radius: {side: inside}}, c: {min_radius: {side: "
             "outside}}, d: {draft_angle: {}}}\nminimize: a + b + c + d\n";
    near(asked(text, "a"), 0.6, 1e-10, "both");
    near(asked(text, "b"), 1.4, 1e-10, "inside: the hole");
    near(asked(text, "c"), 0.6, 1e-10, "outside");
    near(asked(text, "d"), -PI / 2, 1e-6, "draft: its crest, where the cosine has a root");
}

/* A bowl of angle t from its lowest point: least at its rim, pi/2 - t. */
Test(measure_container, the_draft_of_a_bowl_is_that_of_its_rim)
{
    static const double t[] = {0.9, 1.4, 1.9};
    for (int k = 0; k < 3; k++) {
        char text[512];
        snprintf(
            text, sizeof text,
            "vesica: 1\nvariables: {s: [0.5, 1, 2]}\npatches: {p: {surface: {formula: [sin(%g*u)*cos(v), "
            "-cos(%g*u), -sin(%g*u)*sin(v)]}}}\nshape: {closed: true, caps: [p.u1]}\n"
            "measures: {d: {draft_angle: {}}, r: {min_radius: {side: inside}}, b: brimful_volume}\n"
            "minimize: d + r + b + s\n",
            t[k], t[k], t[k]);
        double c = cos(t[k]);
        near(asked(text, "d"), PI / 2 - t[k], ROUNDING, "rim");
        near(asked(text, "r"), 1e6 * sqrt(2 * PI * (1 - c)), ROUNDING, "nowhere hollow");
        near(asked(text, "b"), PI * (2. / 3 - c + c * c * c / 3), ROUNDING, "brimful");
    }
}

/* --- gradients through a plan --- */

/* A cup that leans and waves, from a curved base to a rim that is level nowhere, bulging and drawn in. */
#define CUP                                                                                                  \
    "vesica: 1\n"                                                                                            \
    "variables: {a: [0.1, 1.1, 5], w: [0, 0.05, 1], t: [-1, 0.13, 1], g: [0.1, 1.3, 3], h: [0.1, 1.5, 5], "  \
    "x: [-1, "                                                                                               \
    "0.17, 1]}\n"                                                                                            \
    "curves:\n"                                                                                              \
    "  base: {ellipse: {radii: [0.7, 0.8], axis: [0, 1, 0]}}\n"                                              \
    "  rim: {circle: {radius: 1, axis: [0, 1, 0]}, apply: [{ridge: {points: 4, by: w, along: radial}}, "     \
    "{rotate: [t, 0, 0]}, {translate: "                                                                      \
    "[0.1, h, 0]}]}\n"                                                                                       \
    "  out: {like: base, apply: [{dilate: g}, {translate: [0, 0.6, 0]}]}\n"                                  \
    "  in: {like: rim, apply: [{dilate: 0.9}, {translate: [0, 0.4, 0]}]}\n"                                  \
    "patches:\n"                                                                                             \
    "  p: {operator: {power: 2, a: a}, conditions: [{u: 0, position: base}, {u: 1, position: rim}, {u: 0, "  \
    "derivative: 1, from: base, to: out}, {u: 1, derivative: 1, from: rim, to: in}]}\n"                      \
    "shape: {closed: true, caps: [p.u0, p.u1]}\n"

Test(measure_container, gradients_follow_the_shape_through_the_plan)
{
    static const char *const form[] = {"draft_angle: {axis: [x, 1, 0.1]}",
                                       "draft_angle: {smooth: 20}",
                                       "undercut: {axis: [x, 1, 0.1]}",
                                       "min_radius: {}",
                                       "min_radius: {side: inside}",
                                       "min_radius: {side: outside}",
                                       "fill_volume: {axis: [x, 1, 0.1], height: h/2}",
                                       "fill_volume: {below: h/4}",
                                       "brimful_volume: {axis: [x, 1, 0.1]}",
                                       "brimful_volume: {rim: rim}"};
    double x[6] = {1.1, 0.05, 0.13, 1.3, 1.5, 0.17}, step = 1e-4;
    for (size_t f = 0; f < sizeof form / sizeof *form; f++) {
        char text[2048];
        double gradient[6];
        snprintf(text, sizeof text, CUP "measures: {m: {%s}}\nminimize: m + 0*(a + w + t + g + h + x)\n",
                 form[f]);
        bed b = bed_with(text, NULL, 20, 32);
        ves_verdict verdict = {.gradient = gradient};
        ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE | VES_WANT_GRADIENT};
        cr_assert(ves_plan_evaluate(b.plan, &ask, &verdict) == VES_OK && verdict.status == VES_OK, "%s: %s",
                  form[f], ves_status_text(verdict.status));
        for (int k = 0; k < 6; k++) {
            double at[6], side[2];
            for (int i = 0; i < 2; i++) {
                memcpy(at, x, sizeof at);
                at[k] += i ? step : -step;
                side[i] = value_at(&b, at);
            }
            /* step^2 times third derivatives up to 1e2; what is left of the way to a summit, over the step */
            double want = (side[1] - side[0]) / (2 * step);
            cr_expect(fabs(gradient[k] - want) < 2e-6 * fmax(1, fabs(want)),
                      "%s by %s: got %.12g, differences %.12g", form[f], b.problem->variable[k].name,
                      gradient[k], want);
        }
        bed_clear(&b);
    }
}

/* Joints: how patches that share a curve go on into each other, against closed forms. Lengths are of order 1. */
#include <math.h>
#include <stdio.h>

#include "base/vector.h"
#include "bed.h"
#include "plan/inside.h"

static const double PI = 3.14159265358979323846;

static bed bed_make(const char *text)
{
    return bed_with(text, NULL, 16, 16);
}

/* Joint k of the start design. */
static ves_joint joint_at(const bed *b, int k)
{
    double x[4];
    ves_design design;
    ves_joint joint;
    for (int i = 0; i < b->problem->variables; i++) x[i] = b->problem->variable[i].start;
    cr_assert_geq(ves_plan_measure(b->plan, x, 0, &design), VES_OK);
    cr_assert_eq(ves_plan_joint(b->plan, k, &joint), VES_OK);
    return joint;
}

static ves_joint only_joint(const char *text)
{
    bed b = bed_make(text);
    cr_assert_eq(ves_plan_joints(b.plan), 1, "%d joints", ves_plan_joints(b.plan));
    ves_joint joint = joint_at(&b, 0);
    joint.curve = NULL; /* the problem's */
    bed_clear(&b);
    return joint;
}

static void expect_class(const ves_joint *j, ves_joint_class want, const char *what)
{
    cr_expect_eq(j->continuity, want,
                 "%s: %s instead of %s (gap %.2g, angle %.2g, slope %.2g, curvature %.2g, second %.2g)", what,
                 ves_joint_text(j->continuity), ves_joint_text(want), j->gap, j->angle, j->slope_jump,
                 j->curvature_relative, j->second_jump);
}

#define STRAIGHT(name, from, to)                                                                             \
    "  " name ": {operator: {power: 1, a: 0}, conditions: [{u: 0, position: " from "}, {u: 1, position: " to \
    "}]}\n"

/* A cylinder of radius 1.3 and a cone that narrows by 0.4 over a height of 0.7, whichever way their u runs; all
 * along u = 0 .. 1 straight, so |X_u| is the length of the side. */
Test(joint, a_cylinder_and_a_cone_meet_at_the_cones_angle)
{
    static const char curves[] = "vesica: 1\ncurves: {low: {circle: {radius: 1.3}}, mid: {like: low, apply: "
                                 "[{translate: [0, 0, 2.1]}]},\n  top: {circle: {radius: 0.9, centre: "
                                 "[0, 0, 2.8]}}}\nexpect: [area > 0]\npatches:\n";
    static const char *const wall[] = {STRAIGHT("wall", "low", "mid"), STRAIGHT("wall", "mid", "low")},
                             *const cone[] = {STRAIGHT("cone", "mid", "top"), STRAIGHT("cone", "top", "mid")};
    double length = hypot(0.4, 0.7), jump = hypot(0.4, 2.1 - 0.7) / 2.1; /* the cylinder's X_u is longer */
    for (int k = 0; k < 4; k++) {
        char text[1000];
        snprintf(text, sizeof text, "%s%s%s", curves, wall[k / 2], cone[k % 2]);
        ves_joint j = only_joint(text);
        cr_assert(length < 2.1);
        cr_expect_eq(j.patch[0], 0);
        cr_expect_eq(j.patch[1], 1);
        cr_expect_eq(j.end[0], k / 2 == 0);
        cr_expect_eq(j.end[1], k % 2);
        expect_class(&j, VES_JOINT_C0, "crease");
        /* rounding */
        cr_expect(fabs(j.angle - atan2(0.4, 0.7)) < 1e-14, "%.17g", j.angle);
        cr_expect(fabs(j.slope_jump - jump) < 1e-14, "%.17g %.17g", j.slope_jump, jump);
        cr_expect(j.gap < 1e-14 && j.curvature_jump < 1e-13 && j.second_jump < 1e-13);
    }
}

/* Both patches go up from one ring: the surface turns back on itself. */
Test(joint, a_surface_that_turns_back_has_a_crease_of_half_a_turn)
{
    ves_joint j = only_joint("vesica: 1\ncurves: {low: {circle: {radius: 1.3}}, mid: {like: low, apply: "
                             "[{translate: [0, 0, 1]}]}, top: {like: low, apply: [{translate: [0, 0, 2]}]}}\n"
                             "expect: [area > 0]\npatches:\n" STRAIGHT("one", "low", "mid")
                                 STRAIGHT("two", "low", "top"));
    expect_class(&j, VES_JOINT_C0, "fold");
    cr_expect(fabs(j.angle - PI) < 1e-14, "%.17g", j.angle);
    cr_expect(fabs(j.slope_jump - 1.5) < 1e-14, "%.17g", j.slope_jump); /* |1 + 2| of 2 */
}

/* The catenoid is met exactly by Laplace patches with a = length: cut anywhere it stays one analytic surface. Cut
 * in the middle, X_u and X_uu agree; elsewhere only what does not depend on the parameter does. */
Test(joint, a_surface_that_is_cut_stays_smooth)
{
    static const double cut[] = {0, 0.31};
    static const ves_joint_class want[] = {VES_JOINT_C2, VES_JOINT_G2};
    for (int k = 0; k < 2; k++) {
        char text[1000];
        snprintf(text, sizeof text,
                 "vesica: 1\nparameters: {c: %.17g}\ncurves:\n  low: {circle: {radius: cosh(1), centre: [0, "
                 "0, -1]}}\n  mid: {circle: {radius: cosh(c), centre: [0, 0, c]}}\n  high: {circle: {radius: "
                 "cosh(1), centre: [0, 0, 1]}}\npatches:\n  a: {operator: {power: 1, a: 1 + c}, conditions: "
                 "[{u: 0, position: low}, {u: 1, position: mid}]}\n  b: {operator: {power: 1, a: 1 - c}, "
                 "conditions: [{u: 0, position: mid}, {u: 1, position: high}]}\nexpect: [area > 0]\n",
                 cut[k]);
        ves_joint j = only_joint(text);
        expect_class(&j, want[k], "catenoid");
        cr_expect(j.angle < 1e-13 && j.curvature_jump < 1e-12, "%.2g %.2g", j.angle, j.curvature_jump);
        double shorter = (1 - cut[k]) / (1 + cut[k]); /* X_u is as long as a */
        cr_expect(fabs(j.slope_jump - (1 - shorter)) < 1e-13, "%.17g", j.slope_jump);
    }
}

/* Two domes pole to pole over one equator of radius 1.3, order 4, a = 0: along u the radius and the height are
 * cubics. p, q: |X_u| at the equator, below and above; s: how the radius falls at the upper pole (-2 at the
 * lower). At the equator r'' = -6 R - 2 s R, z'' comes from the heights, and the curvature across is |r''| / p^2.
 */
static ves_joint domes(double p, double q, double s, const char *tilt)
{
    char text[2000];
    snprintf(text, sizeof text,
             "vesica: 1\nparameters: {R: 1.3, p: %.17g, q: %.17g, s: %.17g}\ncurves:\n"
             "  south: {point: [0, 0, -R]}\n  north: {point: [0, 0, R]}\n  equator: {circle: {radius: R}}\n"
             "  ring: {circle: {radius: 1}}\n  up: {point: [0, 0, 1]}\n  tilt: {formula: [\"%s*cos(v)\", "
             "\"%s*sin(v)\", \"1\"]}\n"
             "patches:\n"
             "  lower: {operator: {power: 2, a: 0}, conditions: [{u: 0, position: south}, {u: 0, derivative: "
             "1, field: ring, scale: 2*R}, {u: 1, position: equator}, {u: 1, derivative: 1, field: up, "
             "scale: p}]}\n"
             "  upper: {operator: {power: 2, a: 0}, conditions: [{u: 0, position: equator}, {u: 0, "
             "derivative: 1, field: tilt, scale: q}, {u: 1, position: north}, {u: 1, derivative: 1, field: "
             "ring, scale: s*R}]}\n"
             "validity: {jacobian: any}\nexpect: [area > 0]\n",
             p, q, s, tilt, tilt);
    return only_joint(text);
}

Test(joint, domes_are_as_smooth_as_they_are_made)
{
    double R = 1.3, p = 1.7, q = 2.3, bend = 2 * R; /* |r''| with s = -2 */
    ves_joint same = domes(p, p, -2, "0");          /* r'' agrees, z'' is opposite */
    expect_class(&same, VES_JOINT_C1_G2, "mirrored");
    cr_expect(same.slope_jump < 1e-13 && same.angle < 1e-13 && same.curvature_jump < 1e-12);
    /* below z'' = 4 p - 6 R (its slope at the pole is 0), above the opposite */
    double second = 2 * fabs(4 * p - 6 * R) / fmax(p, hypot(bend, 4 * p - 6 * R));
    cr_expect(fabs(same.second_jump - second) < 1e-12, "%.17g %.17g", same.second_jump, second);

    ves_joint longer = domes(p, q, -2, "0"); /* one direction, unlike lengths: the curvatures differ too */
    expect_class(&longer, VES_JOINT_G1, "unlike lengths");
    double jump = bend / (p * p) - bend / (q * q);
    cr_expect(fabs(longer.slope_jump - (q - p) / q) < 1e-13, "%.17g", longer.slope_jump);
    cr_expect(fabs(longer.curvature_jump - jump) < 1e-12, "%.17g %.17g", longer.curvature_jump, jump);

    ves_joint blunt = domes(p, p, -1.5, "0"); /* same X_u, r'' = -3 R above */
    expect_class(&blunt, VES_JOINT_C1, "unlike poles");
    cr_expect(fabs(blunt.curvature_jump - R / (p * p)) < 1e-12, "%.17g", blunt.curvature_jump);
    /* relative to the larger curvature, 3 R / p^2, which is more than 1 / R */
    cr_expect(fabs(blunt.curvature_relative - 1. / 3) < 1e-12, "%.17g", blunt.curvature_relative);

    ves_joint crease = domes(p, p, -2, "0.3");
    expect_class(&crease, VES_JOINT_C0, "tilted");
    cr_expect(fabs(crease.angle - atan(0.3)) < 1e-13, "%.17g", crease.angle);
}

/* Order 6 on both sides of a wavy curve p, with X_u = f, X_uu = g below. Above, the same surface as another u
 * sees it: X(s u, v + t u) has X_u = s f + t p', X_uu = s^2 g + 2 s t f' + t^2 p''. Whatever s and t, that is G2;
 * with s = 1, t = 0 it is C2. A change of g is a jump of the curvature across of n.dg / |f across p'|^2. */
static ves_joint waves(double s, double t, double off)
{
    char text[3000];
    snprintf(
        text, sizeof text,
        "vesica: 1\nparameters: {s: %.17g, t: %.17g, off: %.17g}\ncurves:\n"
        "  p: {formula: [\"1.2*cos(v) + 0.1*cos(3*v)\", \"sin(v)\", \"0.2*cos(2*v)\"]}\n"
        "  p1: {formula: [\"-1.2*sin(v) - 0.3*sin(3*v)\", \"cos(v)\", \"-0.4*sin(2*v)\"]}\n"
        "  p2: {formula: [\"-1.2*cos(v) - 0.9*cos(3*v)\", \"-sin(v)\", \"-0.8*cos(2*v)\"]}\n"
        "  f: {formula: [\"0.3*cos(v)\", \"0.2*sin(v)\", \"1 + 0.1*sin(2*v)\"]}\n"
        "  f1: {formula: [\"-0.3*sin(v)\", \"0.2*cos(v)\", \"0.2*cos(2*v)\"]}\n"
        "  g: {formula: [\"-0.5*cos(v)\", \"0.1 - 0.4*sin(v)\", \"0.3*cos(v)\"]}\n"
        "  slope: {combine: [[s, f], [t, p1]]}\n"
        "  bend: {combine: [[s^2, g], [2*s*t, f1], [t^2, p2], [off, p2]]}\n"
        "  low: {circle: {radius: 1, centre: [0, 0, -2]}}\n  high: {circle: {radius: 1, centre: [0, 0, "
        "3]}}\n  up: {point: [0, 0, 1]}\npatches:\n"
        "  a: {operator: {power: 3, a: 0.8}, conditions: [{u: 0, position: low}, {u: 0, derivative: 1, "
        "field: up}, {u: 0, derivative: 2, field: g}, {u: 1, position: p}, {u: 1, derivative: 1, field: "
        "f}, {u: 1, derivative: 2, field: g}]}\n"
        "  b: {operator: {power: 3, a: 1.1}, conditions: [{u: 0, position: p}, {u: 0, derivative: 1, "
        "field: slope}, {u: 0, derivative: 2, field: bend}, {u: 1, position: high}, {u: 1, derivative: 1, "
        "field: up}, {u: 1, derivative: 2, field: g}]}\n"
        "validity: {jacobian: any}\nexpect: [area > 0]\n",
        s, t, off);
    return only_joint(text);
}

Test(joint, curvature_does_not_depend_on_the_parameters)
{
    ves_joint same = waves(1, 0, 0), faster = waves(1.7, 0, 0), sheared = waves(1.7, 0.4, 0),
              bent = waves(1, 0, 0.3);
    expect_class(&same, VES_JOINT_C2, "same");
    expect_class(&faster, VES_JOINT_G2, "faster");
    expect_class(&sheared, VES_JOINT_G2, "sheared");
    cr_expect(fabs(faster.slope_jump - 0.7 / 1.7) < 1e-12, "%.17g", faster.slope_jump);
    /* rounding of second derivatives of size 10 */
    cr_expect(sheared.angle < 1e-12 && sheared.curvature_jump < 1e-11, "%.3g %.3g", sheared.angle,
              sheared.curvature_jump);
    expect_class(&bent, VES_JOINT_C1, "bent");
    double most = 0;
    for (int j = 0; j < 256; j++) { /* the places that are looked at */
        double v = 2 * PI * j / 256, x[3], out = 0;
        const double f[] = {0.3 * cos(v), 0.2 * sin(v), 1 + 0.1 * sin(2 * v)},
                     d[] = {-1.2 * sin(v) - 0.3 * sin(3 * v), cos(v), -0.4 * sin(2 * v)},
                     dd[] = {-1.2 * cos(v) - 0.9 * cos(3 * v), -sin(v), -0.8 * cos(2 * v)};
        ves_cross(f, d, x);
        for (int c = 0; c < 3; c++) out += 0.3 * dd[c] * x[c];
        double n = sqrt(ves_dot(x, x));
        most = fmax(most, fabs(out / n) * ves_dot(d, d) / (n * n));
    }
    cr_expect(fabs(bent.curvature_jump - most) < 1e-11, "%.17g %.17g", bent.curvature_jump, most);
}

/* `joins:` make what they say, and both ways round: also where two ends at u = 1 meet. */
Test(joint, joins_make_what_they_say)
{
    static const struct {
        const char *scale, *bend;
        ves_joint_class want;
    } join[] = {{"0.8", "", VES_JOINT_C1},
                {"[0.8, 1.3]", "", VES_JOINT_G1},
                {"0.8", ", bend: g", VES_JOINT_C2},
                {"[0.8, 1.3]", ", bend: g", VES_JOINT_G2}};
    for (int k = 0; k < 8; k++) {
        char text[2000];
        bool bends = *join[k / 2].bend, back = k % 2; /* the upper patch from above */
        const char *more = bends ? ", {u: 0, derivative: 2, field: g}" : "",
                   *upper = bends ? ", {u: 1, derivative: 2, field: g}" : "";
        snprintf(
            text, sizeof text,
            "vesica: 1\ncurves:\n  low: {circle: {radius: 1, centre: [0, 0, -2]}}\n  high: {circle: "
            "{radius: 1, centre: [0, 0, 3]}}\n  up: {point: [0, 0, 1]}\n  p: {formula: [\"1.2*cos(v) + "
            "0.1*cos(3*v)\", \"sin(v)\", \"0.2*cos(2*v)\"]}\n  f: {formula: [\"0.3*cos(v)\", "
            "\"0.2*sin(v)\", \"1 + 0.1*sin(2*v)\"]}\n  g: {formula: [\"-0.5*cos(v)\", \"0.1 - "
            "0.4*sin(v)\", \"0.3*cos(v)\"]}\npatches:\n"
            "  a: {operator: {power: %d, a: 0.8}, conditions: [{u: 0, position: low}, {u: 0, derivative: "
            "1, field: up}, {u: 1, position: p}%s]}\n"
            "  b: {operator: {power: %d, a: 1.1}, conditions: [{u: %d, position: p}, {u: %d, position: "
            "high}, {u: %d, derivative: 1, field: up, scale: %d}%s]}\n"
            "joins: [{ends: [a.u1, b.u%d], tangent: f, scale: %s%s}]\n"
            "validity: {jacobian: any}\nexpect: [area > 0]\n",
            bends ? 3 : 2, more, bends ? 3 : 2, back, 1 - back, 1 - back, back ? -1 : 1, back ? more : upper,
            back, join[k / 2].scale, join[k / 2].bend);
        ves_joint j = only_joint(text);
        expect_class(&j, join[k / 2].want, join[k / 2].scale);
        cr_expect_eq(j.end[1], back);
    }
}

/* A slope of 0 leaves no tangent plane: nothing is known of the normal there. */
Test(joint, without_a_tangent_plane_it_is_not_smooth)
{
    ves_joint j = domes(0, 1, -2, "0");
    expect_class(&j, VES_JOINT_C0, "no slope");
    cr_expect(isnan(j.angle) && isnan(j.curvature_jump) && j.gap < 1e-14);
}

/* A dome whose curvature at the rim is 1/R, as a hemisphere's, on a cylinder: r'' = -2 R and |X_u| = sqrt(2) R.
 * Exactly as large in a file that scales everything. */
Test(joint, a_hemisphere_on_a_cylinder_jumps_by_one_over_its_radius)
{
    static const char *const scale[] = {"", "scale: {equation: width == 7.8}\n"};
    for (int k = 0; k < 2; k++) {
        char text[1000];
        snprintf(text, sizeof text,
                 "vesica: 1\nparameters: {R: 1.3}\ncurves: {low: {circle: {radius: R, centre: [0, 0, -1]}}, "
                 "rim: {circle: {radius: R}}, north: {point: [0, 0, R]}, ring: {circle: {radius: 1}}, up: "
                 "{point: [0, 0, 1]}}\n%spatches:\n" STRAIGHT("wall", "low", "rim") //
                 "  dome: {operator: {power: 2, a: 0}, conditions: [{u: 0, position: rim}, {u: 0, "
                 "derivative: 1, field: up, scale: sqrt(2)*R}, {u: 1, position: north}, {u: 1, derivative: "
                 "1, field: ring, scale: -2*R}]}\nexpect: [width > 0]\n",
                 scale[k]);
        ves_joint j = only_joint(text);
        double R = k ? 3.9 : 1.3;
        expect_class(&j, VES_JOINT_G1, "hemisphere");
        cr_expect(fabs(j.curvature_jump - 1 / R) < 1e-12, "%.17g", j.curvature_jump);
        cr_expect(fabs(j.curvature_relative - 1) < 1e-12, "%.17g", j.curvature_relative);
        cr_expect(j.angle < 1e-14);
    }
}

/* Three ends on one ring: the wall goes on, the brim stands off at a right angle from both. */
Test(joint, of_three_ends_on_a_curve_every_two_are_a_joint)
{
    static const double angle[] = {0, PI / 2, PI / 2};
    bed b =
        bed_make("vesica: 1\ncurves: {low: {circle: {radius: 1}}, mid: {circle: {radius: 1, centre: [0, 0, "
                 "1]}}, high: {circle: {radius: 1, centre: [0, 0, 2]}}, out: {circle: {radius: 2, centre: "
                 "[0, 0, 1]}}}\nexpect: [area > 0]\npatches:\n" STRAIGHT("wall", "low", "mid")
                     STRAIGHT("neck", "mid", "high") STRAIGHT("brim", "out", "mid"));
    cr_assert_eq(ves_plan_joints(b.plan), 3);
    for (int k = 0; k < 3; k++) {
        ves_joint j = joint_at(&b, k);
        cr_expect_str_eq(j.curve, "mid");
        cr_expect_eq(j.patch[0], k == 2);
        cr_expect_eq(j.patch[1], k ? 2 : 1);
        cr_expect(fabs(j.angle - angle[k]) < 1e-14, "joint %d: %.17g", k, j.angle);
        expect_class(&j, k ? VES_JOINT_C0 : VES_JOINT_C2, "brim");
    }
    ves_joint j = {.gap = 7};
    cr_expect_eq(ves_plan_joint(b.plan, 3, &j), VES_RANGE);
    cr_expect_eq(ves_plan_joint(b.plan, -1, &j), VES_RANGE);
    cr_expect_eq(j.gap, 7);
    bed_clear(&b);
}

/* A patch may begin and end on one curve: a joint with itself. Here it goes up and comes back. */
Test(joint, a_patch_joins_itself)
{
    ves_joint j =
        only_joint("vesica: 1\ncurves: {p: {circle: {radius: 1.3}}, up: {point: [0, 0, 1]}}\npatches:\n"
                   "  t: {operator: {power: 2, a: 0}, conditions: [{u: 0, position: p}, {u: 1, "
                   "position: p}, {u: 0, derivative: 1, field: up}, {u: 1, derivative: 1, field: "
                   "up}]}\nvalidity: {jacobian: any}\nexpect: [area > 0]\n");
    expect_class(&j, VES_JOINT_C1_G2, "itself"); /* z'' jumps from 6 to -6 */
    cr_expect(fabs(j.second_jump - 2) < 1e-13, "%.17g", j.second_jump);
}

/* A torus by formula goes on at its ends, whichever way these are turned against each other; a Klein bottle's
 * figure of eight too, whose ends run against each other. One whose tube bulges on its way has a crease
 * there. */
Test(joint, surfaces_meet_themselves)
{
    static const char *const text[] = {
        "[\"(2 + 0.7*cos(v))*cos(2*pi*u)\", \"(2 + 0.7*cos(v))*sin(2*pi*u)\", \"0.7*sin(v)\"]",
        "[\"(2 + 0.7*cos(v + 1.234*u))*cos(2*pi*u)\", \"(2 + 0.7*cos(v + 1.234*u))*sin(2*pi*u)\", "
        "\"0.7*sin(v + 1.234*u)\"]",
        "[\"(3 + cos(pi*u)*sin(v) - sin(pi*u)*sin(2*v))*cos(2*pi*u)\", \"(3 + cos(pi*u)*sin(v) - "
        "sin(pi*u)*sin(2*v))*sin(2*pi*u)\", \"sin(pi*u)*sin(v) + cos(pi*u)*sin(2*v)\"]",
        "[\"(2 + (0.7 + u*(1 - u))*cos(v))*cos(2*pi*u)\", \"(2 + (0.7 + u*(1 - u))*cos(v))*sin(2*pi*u)\", "
        "\"(0.7 + u*(1 - u))*sin(v)\"]"};
    for (int k = 0; k < 4; k++) {
        char file[1000];
        snprintf(file, sizeof file,
                 "vesica: 1\npatches: {s: {surface: {formula: %s}}}\nvalidity: {jacobian: any, "
                 "self_intersection: never}\nexpect: [area > 0]\n",
                 text[k]);
        ves_joint j = only_joint(file);
        cr_expect(j.patch[0] == 0 && j.patch[1] == 0 && j.end[0] == 1 && j.end[1] == 0);
        cr_expect(j.gap < 1e-12, "surface %d: %.3g", k,
                  j.gap); /* the turn is found to rounding, as an angle */
        if (k == 0) expect_class(&j, VES_JOINT_C2, "torus");
        if (k == 1) expect_class(&j, VES_JOINT_C2, "turned torus");
        if (k == 2) expect_class(&j, VES_JOINT_C2, "Klein bottle");
        if (k ==
            3) { /* the tube leaves at slope -1 and enters at +1, by u; along the inner side u is slowest */
            expect_class(&j, VES_JOINT_C0, "bulge");
            double want = 2 * atan(1 / (2 * PI * 1.3));
            cr_expect(fabs(j.angle - want) < 1e-12, "%.17g %.17g", j.angle, want);
        }
    }
}

/* Points and free ends join nothing. */
Test(joint, points_are_no_joints)
{
    bed b = bed_make(
        "vesica: 1\ncurves: {tip: {point: [0, 0, 0]}, low: {circle: {radius: 1, centre: [0, 0, "
        "-1]}}, high: {circle: {radius: 1, centre: [0, 0, 1]}}}\nexpect: [area > 0]\npatches:\n" STRAIGHT(
            "a", "low", "tip") STRAIGHT("b", "tip", "high"));
    cr_expect_eq(ves_plan_joints(b.plan), 0);
    bed_clear(&b);
}

/* Patches that share a curve meet; a gap is measured all the same. Here one of them is bound to the curve before,
 * and one to the curve after it moved. */
Test(joint, a_gap_is_told)
{
    bed b = bed_make(
        "vesica: 1\nvariables: {h: [1, 2, 3]}\ncurves: {low: {circle: {radius: 1.3}}, mid: {like: "
        "low, apply: [{translate: [0, 0, h]}]}, top: {like: low, apply: [{translate: [0, 0, "
        "4]}]}}\nexpect: [area > 0]\npatches:\n" STRAIGHT("a", "low", "mid") STRAIGHT("b", "mid", "top"));
    ves_joint j = joint_at(&b, 0);
    expect_class(&j, VES_JOINT_C2, "bound together");
    for (double gap = 1e-10; gap < 1e-7; gap *= 100) {
        ves_plan_bind(b.plan, &(double){2 + gap}, 0);
        double *mid = (double *)ves_curves_coef(b.plan->curves, ves_end_curve(b.plan, 0, 1));
        mid[2 * (1 + 2 * 1)] = 2; /* the mean of z, beside one mode */
        ves_patch_bind(b.plan->patch[0], &b.plan->bound);
        cr_assert_eq(ves_plan_joint(b.plan, 0, &j), VES_OK);
        cr_expect(fabs(j.gap - gap) < 1e-15, "%.3g", j.gap);
        expect_class(&j, gap < 1.3e-9 ? VES_JOINT_C2 : VES_JOINT_OPEN, "moved");
    }
    bed_clear(&b);
}

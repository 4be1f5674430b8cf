/* How containers stand in each other: cones, tubes, bells and barrels against closed forms and a slow search. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bed.h"
#include "problem/problem.h"
#include "vesica/plan.h"

/* Newton's steps end at the rounding of second derivatives; the height feels the square of what is left. */
static const double EXACT = 1e-10;

static double pitch(const char *text, const double *x, int level)
{
    bed b = bed_with(text, NULL, 14, 24);
    ves_design design;
    cr_assert(ves_plan_measure(b.plan, x, level, &design) == VES_OK, "%s", text);
    double value = design.measure[0];
    bed_clear(&b);
    return value;
}

static void near(double got, double want, double tolerance, const char *what)
{
    cr_assert(fabs(got - want) <= tolerance * fmax(1, fabs(want)), "%s: got %.16g, want %.16g (off by %.2e)",
              what, got, want, got - want);
}

/* From radius r to R over the height h along y, with walls t thick; r and R along z times e. */
#define CONE(SHAPE)                                                                                          \
    "vesica: 1\nvariables: {r: [0.1, 1, 9], R: [0.1, 1, 9], h: [0.1, 1, 9], t: [0.001, 0.1, 9], e: [0.1, "   \
    "1, 9]}\n"                                                                                               \
    "patches: {p: {surface: {formula: [(r + (R - r)*u)*cos(v + 0.1), h*u, -e*(r + (R - r)*u)*sin(v + "       \
    "0.1)]}}}\n" SHAPE                                                                                       \
    "measures: {m: {nesting_pitch: {thickness: t}}}\nminimize: m + 0*(r + R + h + t + e)\n"

/* Along a straight wall of length L at the angle d to the axis. */
static double straight(double L, double d, double t)
{
    if (L * sin(d) >= t * cos(d)) return t / sin(d);
    return L * cos(d) + sqrt(t * t - pow(L * sin(d), 2));
}

Test(measure_nesting, cones_nest_by_their_draft_if_they_are_long_enough)
{
    static const double R[] = {1.02, 1.1, 1.3, 1.9, 3, 0.9, 0.6}, t[] = {0.01, 0.05, 0.2, 0.6};
    for (int k = 0; k < 7; k++)
        for (int n = 0; n < 4; n++)
            for (int level = 0; level < 2; level++) {
                double x[5] = {1, R[k], 1.7, t[n], 1}, way = fabs(R[k] - 1);
                double want = straight(hypot(way, 1.7), atan2(way, 1.7), t[n]);
                near(pitch(CONE(""), x, level), want, EXACT, "cone");
            }
}

Test(measure_nesting, tubes_stand_on_each_other)
{
    double x[5] = {1, 1, 1.7, 0.05, 1};
    near(pitch(CONE(""), x, 0), 1.75, EXACT, "tube");
    near(pitch(CONE("shape: {closed: true, caps: [p.u0, p.u1]}\n"), x, 0), 1.75, EXACT, "with a base");
}

/* Narrower above, it slips over the one below it, unless it has a base. */
Test(measure_nesting, a_bell_with_a_base_does_not_nest)
{
    double x[5] = {1, 0.6, 1.7, 0.05, 1};
    near(pitch(CONE(""), x, 0), 0.05 / sin(atan(0.4 / 1.7)), EXACT, "open");
    near(pitch(CONE("shape: {closed: true, caps: [p.u0, p.u1]}\n"), x, 0), 1.75, EXACT, "with a base");
    x[1] = 1.4;
    near(pitch(CONE("shape: {closed: true, caps: [p.u0, p.u1]}\n"), x, 0), 0.05 / sin(atan(0.4 / 1.7)), EXACT,
         "a cup");
}

/* A cone is convex: between it and its copy all tangent planes are d sin(draft) apart. Least at the short axis, which
 * is no row of nodes. */
Test(measure_nesting, an_oval_cone_by_its_least_draft)
{
    for (int k = 0; k < 6; k++) {
        double e = 0.4 + 0.25 * k, x[5] = {1, 1.5, 1.7, 0.02, e};
        near(pitch(CONE(""), x, 0), 0.02 / sin(atan(0.5 * fmin(1, e) / 1.7)), EXACT, "oval cone");
    }
}

/* Two cones on each other, of which the steeper one has the say; t / sin of its draft while it is long enough. */
Test(measure_nesting, a_bowl_of_two_cones)
{
    for (int low = 0; low < 2; low++) {
        char text[1024];
        double r[3] = {1, low ? 1.2 : 1.6, 1.8}, draft = atan(0.2), x[1] = {0};
        snprintf(text, sizeof text,
                 "vesica: 1\nvariables: {s: [-1, 0, 1]}\ncurves:\n"
                 "  a: {circle: {radius: %g + s, axis: [0, 1, 0]}}\n"
                 "  b: {circle: {radius: %g, axis: [0, 1, 0], centre: [0, 1, 0]}}\n"
                 "  c: {circle: {radius: %g, axis: [0, 1, 0], centre: [0, 2, 0]}}\n"
                 "patches:\n"
                 "  p: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: a}, {u: 1, position: b}]}\n"
                 "  q: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: b}, {u: 1, position: c}]}\n"
                 "measures: {m: {nesting_pitch: {thickness: 0.03}}}\nminimize: m + s\n",
                 r[0], r[1], r[2]);
        near(pitch(text, x, 0), 0.03 / sin(draft), EXACT, "two cones");
    }
}

/* --- a wavy wall against a slow search over its meridian --- */

#define WAVY                                                                                                 \
    "vesica: 1\nvariables: {w: [0, 0.02, 1], k: [0, 0.3, 3], t: [0.001, 0.05, 1], f: [0, 1, 9], n: [0, 0, "  \
    "1]}\n"                                                                                                  \
    "patches: {p: {surface: {formula: [(1 + k*u + w*sin(f*u) + n*cos(3*v))*cos(v), 1.6*u, -(1 + k*u + "      \
    "w*sin(f*u) + n*cos(3*v))*sin(v)]}}}\n"                                                                  \
    "measures: {m: {nesting_pitch: {thickness: t}}}\nminimize: m + 0*(w + k + t + f + n)\n"

static double slow(const double *x, int count)
{
    double best = 0;
    for (int i = 0; i <= count; i++)
        for (int j = 0; j <= i; j++) {
            double u = (double)i / count, v = (double)j / count;
            double s = x[1] * (u - v) + x[0] * (sin(x[3] * u) - sin(x[3] * v)), square = x[2] * x[2] - s * s;
            if (square >= 0) best = fmax(best, 1.6 * (u - v) + sqrt(square));
        }
    return best;
}

Test(measure_nesting, wavy_walls_lock_where_a_slow_search_says)
{
    const double set[][5] = {{0.02, 0.3, 0.05, 6.3, 0}, {0.1, 0.3, 0.05, 6.3, 0},
                             {0.15, 0.2, 0.03, 5, 0},   {0.1, 0, 0.05, 3.14159265358979, 0},
                             {0.08, 0.5, 0.02, 9, 0},   {0.03, 0.2, 0.15, 4, 0},
                             {0.2, 0.3, 0.004, 6.3, 0}};
    for (size_t k = 0; k < sizeof set / sizeof *set; k++) {
        double got = pitch(WAVY, set[k], 0), want = slow(set[k], 3000);
        /* 1 / 3000 along u: what a pair misses is its square over t, times slopes of 1 */
        cr_assert(got > want - 1e-9 && got < want + 1e-4, "set %zu: got %.10g, slow search %.10g", k, got,
                  want);
    }
}

/* --- gradients --- */

static void check_gradient(const char *text, const double *x, int n)
{
    double gradient[5], h = 1e-4;
    bed b = bed_with(text, NULL, 14, 24);
    ves_verdict verdict = {.gradient = gradient};
    ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE | VES_WANT_GRADIENT};
    cr_assert(ves_plan_evaluate(b.plan, &ask, &verdict) == VES_OK && verdict.status == VES_OK, "%s", text);
    for (int k = 0; k < n; k++) {
        double at[5], side[2];
        for (int i = 0; i < 2; i++) {
            memcpy(at, x, sizeof *at * (size_t)n);
            at[k] += i ? h : -h;
            side[i] = value_at(&b, at);
        }
        double want = (side[1] - side[0]) / (2 * h); /* h^2 times third derivatives up to 1e2 */
        cr_expect(fabs(gradient[k] - want) < 2e-6 * fmax(1, fabs(want)),
                  "by %s: got %.12g, differences %.12g\n%s", b.problem->variable[k].name, gradient[k], want,
                  text);
    }
    bed_clear(&b);
}

Test(measure_nesting, gradients_follow_the_points_that_touch)
{
    const double oval[5] = {1, 1.5, 1.7, 0.1, 0.8}, shorter[5] = {1, 1.05, 1.7, 0.3, 0.8},
                 bell[5] = {1, 0.6, 1.7, 0.05, 0.8};
    const double wave[5] = {0.02, 0.3, 0.05, 6.3, 0.03}, lock[5] = {0.1, 0.3, 0.05, 6.3, 0.03};
    check_gradient(CONE(""), oval, 5);
    check_gradient(CONE(""), shorter, 5);
    check_gradient(CONE("shape: {closed: true, caps: [p.u0, p.u1]}\n"), bell, 5);
    check_gradient(WAVY, wave, 5);
    check_gradient(WAVY, lock, 5);
}

Test(measure_nesting, scales_with_the_shape_and_its_thickness)
{
    const double set[][5] = {{1, 1.5, 1.7, 0.1, 0.8}, {1, 1.05, 1.7, 0.3, 0.8}, {1, 0.6, 1.7, 0.05, 0.7}};
    for (int k = 0; k < 3; k++) {
        double large[5];
        for (int i = 0; i < 5; i++) large[i] = (i < 4 ? 2.385 : 1) * set[k][i];
        near(pitch(CONE(""), large, 0), 2.385 * pitch(CONE(""), set[k], 0), EXACT, "scaled");
    }
}

/* A copy that comes off at an angle. */
Test(measure_nesting, follows_the_axis)
{
    const char *text =
        "vesica: 1\nvariables: {x: [-1, 0.03, 1], z: [-1, 0.05, 1], t: [0.001, 0.02, 1]}\n"
        "patches: {p: {surface: {formula: [(1 + 0.5*u)*cos(v), 1.2*u, -(1 + 0.5*u)*sin(v)]}}}\n"
        "measures: {m: {nesting_pitch: {axis: [x, 1, z], thickness: t}}}\nminimize: m + 0*(x + z + t)\n";
    double x[3] = {0.03, 0.05, 0.02}, draft = atan(0.5 / 1.2) - atan(hypot(x[0], x[1]));
    near(pitch(text, x, 0), 0.02 / sin(draft), EXACT, "least draft along another axis");
    check_gradient(text, x, 3);
}

/* Outward: where the outside of a shape is when its start does not show it, and that every part keeps its
 * own. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bed.h"
#include "vesica/plan.h"

static const double PI = 3.14159265358979323846;

/* Nothing is said of these problems. */
static bed bed_make(const char *text)
{
    bed b = bed_with(text, NULL, 0, 0);
    cr_assert_eq(ves_diag_count(b.diag), 0, "%s", text);
    return b;
}

static ves_status judged(const bed *b, const double *x, unsigned want, double *value)
{
    double constraint[4];
    ves_verdict verdict = {.constraint = constraint};
    ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = want};
    cr_assert_eq(ves_plan_evaluate(b->plan, &ask, &verdict), VES_OK);
    *value = verdict.value;
    return verdict.status;
}

/* A can of three patches, each written from either of its ends. */
static void can_write(char *text, size_t size, const char *head, const char *radius, int way)
{
    const char *end[3][2] = {{"floor", "low"}, {"low", "high"}, {"high", "lid"}};
    int length = snprintf(text, size,
                          "vesica: 1\n%scurves:\n"
                          "  floor: {point: [0, 0, 0]}\n"
                          "  lid: {point: [0, 0, h]}\n"
                          "  low: {circle: {radius: %s}}\n"
                          "  high: {like: low, apply: [{translate: [0, 0, h]}]}\npatches:\n",
                          head, radius);
    for (int k = 0; k < 3; k++)
        length += snprintf(text + length, size - (size_t)length,
                           "  p%d: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: %s}, {u: 1, "
                           "position: %s}]}\n",
                           k, end[k][way], end[k][1 - way]);
    snprintf(text + length, size - (size_t)length, "shape: {closed: true}\nminimize: volume\n");
}

static void has_volume(const bed *b, const double *x, double want)
{
    double value;
    ves_status status = judged(b, x, VES_WANT_PROOF, &value);
    /* rounding of some hundred terms */
    cr_expect(status == VES_OK && fabs(value - want) < 1e-13 * want, "status %d, volume %.15g want %.15g",
              status, value, want);
}

Test(outward, a_start_that_encloses_nothing_or_is_no_number_leaves_the_outside_to_another_design)
{
    static const struct {
        const char *head, *radius;
        double x[2], want;
        ves_status start;
    } can[] = {
        {"variables: {h: [0, 0, 2], r: [0.5, 1, 2]}\n", "r", {1.5, 1.2}, 1.5 * 1.44, VES_DEGENERATE},
        {"variables: {h: [0.5, 1, 2], r: [0.2, 0.5, 3]}\n", "sqrt(r-1)", {1.5, 2.2}, 1.5 * 1.2, VES_OUTSIDE},
        /* one design in fifty has a radius */
        {"variables: {h: [0.5, 1, 2], r: [0, 0.5, 1]}\n", "sqrt(r-0.98)", {1.5, 0.99}, 0.015, VES_OUTSIDE},
    };
    for (size_t k = 0; k < sizeof can / sizeof *can; k++)
        for (int way = 0; way < 2; way++) {
            char text[1500];
            can_write(text, sizeof text, can[k].head, can[k].radius, way);
            bed b = bed_make(text);
            ves_design design;
            int grid[2];
            cr_expect_eq(ves_plan_measure(b.plan, ves_plan_search(&b.plan, 1).start, 0, &design),
                         can[k].start);
            cr_expect(!isnan(ves_plan_grid(b.plan, grid)), "can %zu: no grid was chosen", k);
            has_volume(&b, can[k].x, PI * can[k].want);
            bed_clear(&b);
        }
}

/* Two cones on one rim: the start is flat and can be measured. Its range says on which side it grows. */
Test(outward, a_flat_start_that_can_be_measured_grows_to_the_outside)
{
    for (int way = 0; way < 2; way++)
        for (int side = -1; side < 2; side += 2) {
            char text[1000];
            snprintf(text, sizeof text,
                     "vesica: 1\nvariables: {h: [%d, 0, %d]}\n"
                     "curves: {p: {point: [0, 0, 0]}, q: {point: [0, 0, h]}, rim: {circle: {radius: 1}}}\n"
                     "patches:\n"
                     "  a: {operator: {power: 1, a: 0}, conditions: [{u: %d, position: p}, {u: %d, position: "
                     "rim}]}\n"
                     "  b: {operator: {power: 1, a: 0}, conditions: [{u: %d, position: q}, {u: %d, position: "
                     "rim}]}\n"
                     "shape: {closed: true}\nminimize: volume\n",
                     side < 0 ? -2 : 0, side < 0 ? 0 : 2, way, 1 - way, way, 1 - way);
            bed b = bed_make(text);
            double x = side * 0.7, wrong = -x, value;
            has_volume(&b, &x, PI * 0.7 / 3);
            cr_expect_eq(judged(&b, &wrong, VES_WANT_VALUE, &value), VES_INVERTED);
            bed_clear(&b);
        }
}

/* The middle of the interval of the unknown is flat. */
Test(outward, a_root_shows_the_outside_where_the_guess_does_not)
{
    for (int way = 0; way < 2; way++) {
        char text[1500];
        can_write(text, sizeof text, "variables: {r: [0.5, 1, 2]}\n", "r", way);
        strcat(text, "solve: {unknown: h, in: [-9, 9], equation: volume == 3}\n");
        bed b = bed_make(text);
        double x = 1.3;
        has_volume(&b, &x, 3);
        bed_clear(&b);
    }
}

static void balls_write(char *text, size_t size, const char *variable, const char *x, const char *r)
{
    snprintf(
        text, size,
        "vesica: 1\nvariables: {%s}\npatches:\n"
        "  big: {surface: {formula: [\"3*sin(pi*u)*cos(v)\", \"3*sin(pi*u)*sin(v)\", \"3*cos(pi*u)\"]}}\n"
        "  small: {surface: {formula: [\"%s + %s*sin(pi*u)*cos(v)\", \"%s*sin(pi*u)*sin(v)\", "
        "\"%s*cos(pi*u)\"]}}\n"
        "shape: {closed: true}\nminimize: volume\n",
        variable, x, r, r, r);
}

/* Beside the other ball, and as a hollow in it: written either way round. */
Test(outward, one_part_of_two_may_not_turn_inside_out)
{
    static const struct {
        const char *x, *r;
        double sign;
    } ball[] = {{"9", "r", 1}, {"9", "-r", 1}, {"0.5", "r", -1}, {"0.5", "-r", -1}};
    for (size_t k = 0; k < sizeof ball / sizeof *ball; k++) {
        char text[1500];
        balls_write(text, sizeof text, "r: [-1, 0.5, 1]", ball[k].x, ball[k].r);
        bed b = bed_make(text);
        double good = 0.8, wrong = -0.8, value;
        has_volume(&b, &good, 4 * PI / 3 * (27 + ball[k].sign * 0.512));
        cr_expect_eq(judged(&b, &wrong, VES_WANT_VALUE, &value), VES_INVERTED, "ball %zu: volume %g", k,
                     value);
        bed_clear(&b);
    }
}

/* No grid shows it, the proof does. */
Test(outward, a_hollow_stays_in_its_body_and_a_body_out_of_the_other)
{
    char text[1500];
    const double in = 1, across = 3, out = 9;
    double value;
    balls_write(text, sizeof text, "x: [0, 0.5, 9]", "x", "1");
    bed b = bed_make(text);
    has_volume(&b, &in, 4 * PI / 3 * 26);
    cr_expect_eq(judged(&b, &across, VES_WANT_PROOF, &value), VES_SELF_INTERSECTS);
    cr_expect_eq(judged(&b, &out, VES_WANT_PROOF, &value), VES_INVERTED);
    bed_clear(&b);
    balls_write(text, sizeof text, "x: [0, 9, 9]", "x", "1");
    b = bed_make(text);
    has_volume(&b, &out, 4 * PI / 3 * 28);
    cr_expect_eq(judged(&b, &in, VES_WANT_PROOF, &value), VES_INVERTED);
    bed_clear(&b);
}

/* Whichever node lies in the other ball: what overlaps at the start is no hollow, and has no wrong sign. */
Test(outward, parts_that_overlap_at_the_start_are_both_solid)
{
    static const char *const variable[] = {"x: [-9, 3.3, 9]", "x: [-9, 2.2, 9]", "x: [-9, -2.2, 9]",
                                           "x: [-9, -3.9, 9]"};
    const double start[] = {3.3, 2.2, -2.2, -3.9}, out = -8.5, in = 0.5;
    for (int k = 0; k < 4; k++) {
        char text[1500];
        double value;
        balls_write(text, sizeof text, variable[k], "x", "1");
        bed b = bed_make(text);
        cr_expect_eq(judged(&b, &start[k], VES_WANT_VALUE, &value), VES_OK);
        cr_expect(fabs(value / (4 * PI / 3 * 28) - 1) < 1e-12, "from %g: volume %.15g", start[k], value);
        cr_expect_eq(judged(&b, &start[k], VES_WANT_PROOF, &value), VES_SELF_INTERSECTS);
        has_volume(&b, &out, 4 * PI / 3 * 28);
        cr_expect_eq(judged(&b, &in, VES_WANT_PROOF, &value), VES_INVERTED);
        bed_clear(&b);
    }
}

/* Two capped cylinders, wherever they stand. Over one of them its caps count, and no other. */
Test(outward, what_is_measured_over_one_closed_part_has_its_caps_alone)
{
    static const double at[] = {0, 3, -7.5};
    for (int k = 0; k < 3; k++) {
        char text[1500];
        snprintf(
            text, sizeof text,
            "vesica: 1\nvariables: {r: [0.5, 1, 2]}\nparameters: {z: %g}\ncurves:\n"
            "  a: {circle: {radius: r, centre: [0, 0, z]}}\n"
            "  b: {circle: {radius: r, centre: [0, 0, z + 2]}}\n"
            "  c: {circle: {radius: 2*r, centre: [9, 0, z]}}\n"
            "  d: {circle: {radius: 2*r, centre: [9, 0, z + 1]}}\npatches:\n"
            "  one: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: a}, {u: 1, position: b}]}\n"
            "  two: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: c}, {u: 1, position: d}]}\n"
            "shape: {closed: true, caps: [one.u0, one.u1, two.u0, two.u1]}\nmeasures:\n"
            "  one_holds: {volume: {over: one}}\n  two_holds: {volume: {over: [two]}}\n"
            "  middle: {centroid: {of: volume, over: two, along: [0, 0, 1]}}\nminimize: volume\n",
            at[k]);
        bed b = bed_make(text);
        ves_design design;
        double r = 1.3, one = 2 * PI * r * r;
        const double want[] = {one, 2 * one, at[k] + 0.5, 3 * one};
        cr_assert_eq(ves_plan_measure(b.plan, &r, 0, &design), VES_OK);
        for (int m = 0; m < 4; m++)
            cr_expect(fabs(design.measure[m] - want[m]) < 1e-11, "%s at %g: got %.15g, want %.15g",
                      b.problem->measure[m].name, at[k], design.measure[m], want[m]);
        bed_clear(&b);
    }
}

/* What needs no inside is measured on a shape that has none. */
Test(outward, a_shape_without_an_inside_has_an_area)
{
    bed b = bed_make(
        "vesica: 1\ncurves: {p: {point: [0, 0, 0]}, q: {point: [0.1, 0, 0]}, rim: {circle: {radius: 1}}}\n"
        "patches:\n"
        "  a: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: rim}]}\n"
        "  b: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: q}, {u: 1, position: rim}]}\n"
        "shape: {closed: true}\nvalidity: {self_intersection: never}\nminimize: area\n");
    double value;
    cr_expect_eq(judged(&b, NULL, VES_WANT_VALUE, &value), VES_OK);
    cr_expect(fabs(value - 2 * PI) < 1e-12, "area %.15g", value);
    bed_clear(&b);
}

Test(outward, a_start_that_cannot_be_measured_is_no_failure_of_the_plan)
{
    static const struct {
        const char *radius, *rest;
        ves_status want;
    } tube[] = {
        {"sqrt(r - 1.5)", "", VES_OUTSIDE},
        {"(r - 1)^2", "", VES_DEGENERATE},
        {"r", "measures: {none: {integral: {of: log(z - 5)}}}\n", VES_NO_NUMBER},
        {"r", "solve: {unknown: h, in: [1, 2], equation: area == 100}\n", VES_NO_ROOT},
    };
    for (size_t k = 0; k < sizeof tube / sizeof *tube; k++) {
        char text[1000];
        snprintf(
            text, sizeof text,
            "vesica: 1\nvariables: {r: [0, 1, 2]}\n%s"
            "curves: {p: {circle: {radius: %s}}, q: {like: p, apply: [{translate: [0, 0, h]}]}}\n"
            "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: "
            "q}]}}\nminimize: area\n%s",
            strstr(tube[k].rest, "solve") ? "" : "parameters: {h: 1}\n", tube[k].radius, tube[k].rest);
        bed b = bed_make(text);
        ves_design design;
        double start = 1;
        cr_expect_eq(ves_plan_measure(b.plan, &start, 0, &design), tube[k].want, "tube %zu: %d", k,
                     design.status);
        bed_clear(&b);
    }
}

/* The plan through problem texts: exact gradients with respect to every kind of number that a file can hold,
 * elimination by solve: and scale:, verdicts, and no allocation in the loop. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bed.h"
#include "gradient.h"
#include "problem/problem.h"
#include "surface/figure.h"
#include "vesica/plan.h"

static const double PI = 3.14159265358979323846;

static bed bed_make(const char *text)
{
    return bed_with(text, NULL, 0, 0);
}

/* A tube whose every number hangs on a variable through `q`; %s: curves, then the rest. */
#define TUBE(curves, rest)                                                                                   \
    "vesica: 1\n"                                                                                            \
    "quadrature: {u: 16, v: 32}\n"                                                                           \
    "variables: {q: [-2, 0.37, 2], w: [0.1, 0.83, 3]}\n"                                                     \
    "parameters: {half: q/2, both: half + w}\n"                                                              \
    "curves:\n"                                                                                              \
    "  low: {circle: {radius: 1.1 + 0.1*w}}\n"                                                               \
    "  up: {formula: [\"0.1*cos(v)\", \"0.2*sin(v)\", \"1.4\"]}\n" curves "patches:\n"                       \
    "  wall:\n"                                                                                              \
    "    operator: {power: 2, a: 0.9}\n"                                                                     \
    "    conditions: [{u: 0, position: low}, {u: 0, derivative: 1, field: up}, {u: 1, position: high}, {u: " \
    "1, derivative: 1, field: up}]\n" rest

#define GOAL "minimize: bending + 0.3*area*both - 0.2*mean_curvature + 0.1*gauss_curvature + willmore*q\n"

static const char *const CASE[] = {
    TUBE("  high: {circle: {radius: 0.9 + 0.2*q, centre: [0.1*q, q*w, 2.1 - half], axis: [0.1*q, 0.2*w, "
         "1]}}\n",
         GOAL),
    TUBE("  high: {ellipse: {radii: [0.9 + 0.2*q, 0.7 + 0.1*both], centre: [0.1*q, 0, 2.1 - half], axis: "
         "[0.1*q, 0.2, 1]}}\n",
         GOAL),
    TUBE("  high: {fourier: {mean: [0.1, q/5, 2], cos: [[1, 0.1*q, 0], [0.1*q, 0, 0.1*w]], sin: [[0, 1, "
         "0.1], [0, 0.07*q, 0.1*q]]}}\n",
         GOAL),
    TUBE("  high: {bspline: {points: [[1.2 + 0.1*q, 0, 2], [0, 1.1, 2 + 0.1*q], [-1 - 0.1*w, 0, 2], [0, "
         "-1.2, 2 + 0.2*q*w]]}}\n",
         GOAL),
    TUBE("  high: {bspline: {interpolate: true, points: [[1 + 0.1*q, 0, 2], [0, 1.1, 2], [-1, 0, 2 + 0.1*q], "
         "[0, -1.2, 2 + 0.2*q*w]]}}\n",
         GOAL),
    TUBE("  high: {points: {points: [[1 + 0.1*q, 0, 2], [0, 1.1, 2], [-1, 0, 2 + 0.1*q], [0, -1.2, 2 + "
         "0.2*q*w], [0.7, -0.8, 2]]}}\n",
         GOAL),
    TUBE("  high: {formula: [\"(1 + 0.1*q)*cos(v) + 0.05*cos(3*v + w)\", \"(1 - 0.1*q)*sin(v)\", \"2 + "
         "0.1*sin(q*w)\"]}\n",
         GOAL),
    TUBE(
        "  high: {combine: [[1 + 0.1*q, low], [0.3*w, up], [1, shelf]]}\n  shelf: {point: [0, 0.1*q, 1.6]}\n",
        GOAL),
    TUBE("  high: {like: low, apply: [{translate: [0.1*q, 0.2*w*q, 2]}]}\n", GOAL),
    TUBE("  high: {like: low, apply: [{rotate: [0.3*q, 0.2*w, q]}, {translate: [0, 0, 2]}]}\n", GOAL),
    TUBE("  high: {like: low, apply: [{translate: [0.3, 0, 2]}, {rotate: {by: [0.3*q, 0.2*w, q], about: "
         "centre}}]}\n",
         GOAL),
    TUBE("  high: {like: low, apply: [{dilate: [1 + 0.1*q, 1 - 0.1*w, 1]}, {translate: [0, 0, 2]}, {dilate: "
         "1 + 0.1*half}]}\n",
         GOAL),
    TUBE("  high: {circle: {radius: 1}, apply: [{ridge: {points: 8, by: 0.1*q, along: radial}}, {translate: "
         "[0, 0, 2]}]}\n",
         GOAL),
    TUBE("  high: {ellipse: {radii: [1, 0.8]}, apply: [{shift: 0.5*q + 0.1*w}, {translate: [0, 0, 2]}]}\n",
         GOAL),
    TUBE("  high: {circle: {radius: 1}, apply: [{bump: {from: 0.2 + 0.1*q, to: 2.1 - 0.1*w, by: [0.2*q, 0.1, "
         "0.1*w]}}, {translate: [0, 0, 2]}]}\n",
         GOAL),
};

static const char *const WHOLE[] = {
    /* a and the scale of a condition; constraints of all three kinds; a derived parameter in a limit */
    "vesica: 1\nquadrature: {u: 16, v: 32}\nvariables: {a: [0.1, 1.7, 5], s: [0.1, 1.9, 3], r: [0.5, 1.2, "
    "2]}\nparameters: {lid: 4*pi*r^2}\n"
    "curves: {p: {circle: {radius: r}}, q: {like: p, apply: [{translate: [0, 0, 2]}]}, d: {circle: {radius: "
    "1.3*r}, apply: [{translate: [0.1, 0, 0.9]}]}}\n"
    "patches: {wall: {operator: {power: 2, a: a}, conditions: [{u: 0, position: p}, {u: 1, position: q}, {u: "
    "0, derivative: 1, from: p, to: d, "
    "scale: s}, {u: 1, derivative: 1, from: d, to: q, scale: 2*s}]}}\n"
    "minimize: bending*(1 + 0.1*area)\nconstraints: [area <= lid, willmore >= 0.2*s, mean_curvature == 6]\n",
    /* the remainder: a spline of a band limit far above the modes solved */
    "vesica: 1\nquadrature: {u: 16, v: 64}\nvariables: {a: [0.1, 0.8, 5], x: [-1, 0.2, 1]}\n"
    "curves: {p: {bspline: {points: [[1 + x, 0, 0], [0, 1, 0], [-1, 0, 0.1*x], [0, -1.4, 0]]}}, q: {like: p, "
    "apply: [{translate: [0, 0, 2]}]}, up: {point: [0, 0.1*x, 1]}}\n"
    "patches: {wall: {operator: {power: 2, a: a}, modes: 5, conditions: [{u: 0, position: p}, {u: 1, "
    "position: q}, {u: 0, derivative: 1, field: up}, "
    "{u: 1, derivative: 1, field: up}]}}\nminimize: bending + area\n",
    /* closed, capped, volume, power 1; scale and solve together */
    "vesica: 1\nquadrature: {u: 16, v: 32}\nvariables: {r: [0.5, 1.2, 2], t: [-1, 0.2, 1]}\nsolve: {unknown: "
    "h, in: [0.5, 6], equation: volume == 3 + t}\n"
    "curves: {p: {circle: {radius: 1}}, q: {circle: {radius: r, centre: [t, 0, h]}}}\n"
    "patches: {wall: {operator: {power: 1, a: 1.3}, conditions: [{u: 0, position: p}, {u: 1, position: "
    "q}]}}\n"
    "shape: {closed: true, caps: [wall.u0, wall.u1]}\nminimize: area + 0.1*h + bending\nconstraints: [area "
    "<= 9 + t]\n",
    "vesica: 1\nquadrature: {u: 16, v: 32}\nvariables: {r: [0.5, 1.2, 2], t: [-1, 0.2, 1]}\nscale: "
    "{equation: area == 4*pi + t}\n"
    "curves: {p: {circle: {radius: 1}}, q: {circle: {radius: r, centre: [t, 0.1, 1.5]}}}\n"
    "patches: {wall: {operator: {power: 1, a: 1.3}, conditions: [{u: 0, position: p}, {u: 1, position: "
    "q}]}}\n"
    "shape: {closed: true, caps: [wall.u0, wall.u1]}\nminimize: mean_curvature - volume\nconstraints: "
    "[volume == 3, bending <= 20*r]\n",
    "vesica: 1\nquadrature: {u: 16, v: 32}\nvariables: {r: [0.5, 1.2, 2], t: [-1, 0.2, 1]}\nscale: "
    "{equation: area == 4*pi + t}\n"
    "solve: {unknown: h, in: [0.5, 9], equation: volume == 3.2 + 0.1*t}\n"
    "curves: {p: {circle: {radius: 1}}, q: {circle: {radius: r, centre: [t, 0.1, h]}}}\n"
    "patches: {wall: {operator: {power: 1, a: 1.3}, conditions: [{u: 0, position: p}, {u: 1, position: "
    "q}]}}\n"
    "shape: {closed: true, caps: [wall.u0, wall.u1]}\nminimize: mean_curvature + bending*h\n",
    /* sheets: a formula and points */
    "vesica: 1\nquadrature: {u: 16, v: 16}\nvariables: {k: [0.5, 1.2, 2], t: [-1, 0.2, 1]}\n"
    "patches: {roof: {surface: {formula: [\"k*u\", \"v\", \"t*u*v + 0.3*sin(k*u)*cos(v)\"]}, periodic: "
    "false}}\nminimize: bending + area\n",
    "vesica: 1\nquadrature: {u: 16, v: 16}\nvariables: {k: [0.5, 1.2, 2], t: [-1, 0.2, 1]}\n"
    "patches: {roof: {surface: {points: [[[0, 0, 0], [1, 0, t], [2, 0, 0], [3, 0, 0]], [[0, 1, 0.2], [1, 1, "
    "k], [2, 1, 0.1], [3.1, 1, 0]], "
    "[[0, 2, 0], [1, 2, 0.3*k], [2, 2, t], [3, 2, 0]], [[0, 3, 0], [1, 3, 0], [2, 3, 0.2], [3, 3, k*t]]]}, "
    "periodic: false}}\nminimize: bending + area\n",
    /* pointwise formulas, extents, distances, places and centroids */
    "vesica: 1\nquadrature: {u: 16, v: 32}\nvariables: {r: [0.5, 1.2, 2], t: [-1, 0.2, 1]}\n"
    "curves: {p: {circle: {radius: 1}}, q: {ellipse: {radii: [r, 0.9], centre: [t, 0.1, 1.5]}}, far: {point: "
    "[3 + t, 1, 0]}}\n"
    "patches: {wall: {operator: {power: 1, a: 1.3}, conditions: [{u: 0, position: p}, {u: 1, position: "
    "q}]}}\n"
    "places: {tip: {patch: wall, u: 0.4, v: 1.1}}\n"
    "measures: {I: {integral: {of: \"H^2 + t*x*z + 0.1*k1 + K*y\"}}, d: {distance: {from: tip, to: far}}, e: "
    "{distance: {from: q, to: far}}, m: {max_curvature: {smooth: 8}}, "
    "c: {centroid: {of: surface, along: [1, 0.2, t]}}}\nminimize: I + d + e*r + 0.1*m + c\n",
};

enum { CASES = sizeof CASE / sizeof *CASE, WHOLES = sizeof WHOLE / sizeof *WHOLE };

Test(plan, gradients_agree_with_differences_for_every_curve_and_move)
{
    for (int k = 0; k < CASES; k++) gradient_check(CASE[k]);
}

Test(plan, gradients_agree_with_differences_for_whole_problems)
{
    for (int k = 0; k < WHOLES; k++) gradient_check(WHOLE[k]);
}

static double measured(const bed *b, const char *name, const double *x)
{
    ves_design design;
    cr_assert_eq(ves_plan_measure(b->plan, x, 0, &design), VES_OK);
    for (int k = 0; k < b->problem->measures; k++)
        if (!strcmp(b->problem->measure[k].name, name)) return design.measure[k];
    cr_assert_fail("no measure %s", name);
    return NAN;
}

/* Exact elimination: the equation holds to rounding (1e-12 of the value; 4e-15 was seen) at any x. */
Test(plan, solve_and_scale_meet_their_equations)
{
    bed b = bed_make(WHOLE[4]);
    for (double t = -0.5; t < 0.6; t += 0.173) {
        double x[2] = {1.31, t};
        cr_expect(fabs(measured(&b, "area", x) - (12.566370614359172 + t)) < 1e-12 * 12);
        cr_expect(fabs(measured(&b, "volume", x) - (3.2 + 0.1 * t)) < 1e-12 * 3, "volume %.15g",
                  measured(&b, "volume", x));
    }
    bed_clear(&b);
    b = bed_make(WHOLE[2]);
    double x[2] = {1.31, 0.4};
    cr_expect(fabs(measured(&b, "volume", x) - 3.4) < 1e-12);
    bed_clear(&b);
}

Test(plan, an_equation_without_a_root_is_a_verdict)
{
    bed b = bed_make(
        "vesica: 1\nvariables: {r: [0.1, 1, 2]}\nsolve: {unknown: h, in: [0.5, 2], equation: volume == 3}\n"
        "curves: {p: {circle: {radius: r}}, q: {like: p, apply: [{translate: [0, 0, h]}]}}\n"
        "patches: {wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: "
        "q}]}}\n"
        "shape: {closed: true, caps: [wall.u0, wall.u1]}\nminimize: area\n");
    double x = 0.2;
    ves_verdict verdict = {0};
    ves_ask ask = {.x = &x, .cutoff = HUGE_VAL};
    cr_assert_eq(ves_plan_evaluate(b.plan, &ask, &verdict), VES_OK);
    cr_expect_eq(verdict.status, VES_NO_ROOT);
    cr_expect_eq(verdict.violation, HUGE_VAL);
    x = 1;
    cr_assert_eq(ves_plan_evaluate(b.plan, &ask, &verdict), VES_OK);
    cr_expect_eq(verdict.status, VES_OK);
    /* the root is bracketed to 4e-16 of it: rounding, 9e-16 was seen */
    cr_expect(fabs(verdict.value - 6) < 1e-12, "2 pi h with h = 3/pi: got %.15g", verdict.value);
    bed_clear(&b);
}

/* Where the equation changes its sign by a jump or over a pole there is no root. */
#define TUBE_OF(equation, in)                                                                                \
    "vesica: 1\nvariables: {r: [0.5, 1, 2]}\nquadrature: {u: 8, v: 16}\n"                                    \
    "solve: {unknown: h, in: " in ", equation: \"" equation "\"}\n"                                          \
    "curves: {p: {circle: {radius: r}}, q: {like: p, apply: [{translate: [0, 0, h]}]}}\n"                    \
    "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"   \
    "shape: {closed: true, caps: [w.u0, w.u1]}\nminimize: area\n"

Test(plan, a_change_of_sign_is_not_yet_a_root)
{
    const struct {
        const char *text;
        ves_status want;
        double height;
    } table[] = {
        {TUBE_OF("volume == 3", "[0.5, 2]"), VES_OK, 3 / PI},
        {TUBE_OF("1/(area - 7.7) == 0", "[0.5, 2]"), VES_NO_ROOT, 0},
        {TUBE_OF("1/(depth - 4/3)^3 == 0.5", "[0.5, 1.9]"), VES_NO_ROOT, 0},
        {TUBE_OF("sign(depth - 1.3) == 0.5", "[0.5, 1.9]"), VES_NO_ROOT, 0},
        {TUBE_OF("depth + 0.01*sign(depth - 1.3) == 1.305", "[0.5, 1.9]"), VES_NO_ROOT, 0},
        {TUBE_OF("sign(depth - 1.3)*sqrt(abs(depth - 1.3)) == 0", "[0.5, 1.9]"), VES_OK, 1.3},
        {TUBE_OF("1/depth^2 == 0.64", "[1e-3, 1.9]"), VES_OK, 1.25},
        /* no shape at 0, a shape without volume at the lower end that is taken instead */
        {TUBE_OF("volume == 3", "[0, 4]"), VES_OK, 3 / PI},
        {TUBE_OF("volume == 3", "[-4, 0]"), VES_OK, -3 / PI},
        {TUBE_OF("volume + sqrt(depth - 1) == 3", "[0, 4]"), VES_NO_BRACKET, 0},
        {TUBE_OF("volume*sqrt(3.99 - depth) == 0.01*pi", "[2, 4]"), VES_NO_ROOT, 0},
        {TUBE_OF("volume + 0.1*sqrt(3.99 - depth) == 3*pi + 0.1*sqrt(0.99)", "[0.5, 4]"), VES_OK, 3}};
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        bed b = bed_make(table[k].text);
        double x = 1;
        ves_design design;
        ves_status got = ves_plan_measure(b.plan, &x, 0, &design);
        cr_expect_eq(got, table[k].want, "case %zu: %s", k, ves_status_text(got));
        /* the bracket ends 4e-16 of h wide, and rounding of the measures is as large */
        if (got == VES_OK)
            cr_expect(fabs(design.slot[1] - table[k].height) < 1e-13 * fabs(table[k].height),
                      "case %zu: h %.17g", k, design.slot[1]);
        bed_clear(&b);
    }
}

/* A wall that runs out, back and out again: somewhere its normal turns over. */
Test(plan, a_fold_is_a_verdict)
{
    bed b = bed_make("vesica: 1\nvariables: {m: [-9, 1, 9]}\nquadrature: {u: 32, v: 16}\n"
                     "curves: {p: {circle: {radius: 1}}, q: {circle: {radius: 2}}, out: {formula: "
                     "[\"cos(v)\", \"sin(v)\", \"0\"]}}\n"
                     "patches: {ring: {operator: {power: 2, a: 0.2}, conditions: [{u: 0, position: p}, {u: "
                     "1, position: q}, {u: 0, derivative: 1, field: out, scale: m}, "
                     "{u: 1, derivative: 1, field: out, scale: 1}]}}\nminimize: area\n");
    double x = -6;
    ves_verdict verdict = {0};
    ves_ask ask = {.x = &x, .cutoff = HUGE_VAL};
    cr_assert_eq(ves_plan_evaluate(b.plan, &ask, &verdict), VES_OK);
    cr_expect_eq(verdict.status, VES_FOLDED);
    x = 1;
    cr_assert_eq(ves_plan_evaluate(b.plan, &ask, &verdict), VES_OK);
    cr_expect_eq(verdict.status, VES_OK);
    /* a flat ring is a polynomial in u: the quadrature is exact */
    cr_expect(fabs(verdict.value - 3 * 3.141592653589793) < 1e-12, "ring of area 3 pi: %.15g", verdict.value);
    bed_clear(&b);
}

/* A cone, its copy in another size, the same cone upside down, and another one. */
Test(plan, with_scale_a_shape_in_two_sizes_is_one)
{
    const char *text = "vesica: 1\nvariables: {p: [0.1, 1, 9], q: [0.1, 2, 9], h: [0.1, 1.3, 9]}\n"
                       "quadrature: {u: 16, v: 16}\n"
                       "curves: {low: {circle: p}, high: {circle: {radius: q, centre: [0, 0, h]}}}\n"
                       "patches: {wall: {operator: {power: 1}, conditions: [{u: 0, position: low}, {u: 1, "
                       "position: high}]}}\n%sminimize: mean_curvature\n";
    const double x[4][3] = {{1, 2, 1.3}, {2.41, 4.82, 3.133}, {2, 1, 1.3}, {1, 2, 1.33}};
    char whole[800];
    snprintf(whole, sizeof whole, text, "scale: {equation: area == 7}\n");
    bed b = bed_make(whole);
    ves_search_problem search = ves_plan_search(&b.plan, 1);
    for (int k = 0; k < 4; k++) {
        bool same = k > 1;
        cr_assert_eq(search.same(search.data, x[0], x[k], &same), VES_OK);
        cr_expect(same == (k < 2), "case %d: %d", k, same);
    }
    bed_clear(&b);
    snprintf(whole, sizeof whole, text, "");
    b = bed_make(whole);
    cr_expect(ves_plan_search(&b.plan, 1).same == NULL, "variables tell sizes apart");
    bed_clear(&b);
}

/* --- sizes --- */

#define GROWN(rest)                                                                                          \
    "vesica: 1\nvariables: {r: [0.1, 1, 2], z: [-1, 1, 1]}\nquadrature: {u: 8, v: 16}\n"                     \
    "curves: {p: {circle: {radius: 1}}, q: {circle: {radius: r - 0.5, centre: [0, 0, 1]}}}\n"                \
    "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"   \
    "minimize: depth + z^2\n" rest

/* How far the figure of x, a point and the spine go along z. */
typedef struct reach {
    double figure, point, spine, similarity;
    ves_status status;
    char said[400];
} reach;

static reach reach_of(const bed *b, double r, double z)
{
    const double x[2] = {r, z}, u = 1, v = 0.3;
    double point[18], spine[9];
    ves_figure *figure;
    ves_diag *diag = ves_diag_create();
    ves_design design;
    reach got = {.said = ""};
    cr_assert_eq(ves_plan_points(b->plan, 0, 1, &u, &v, point), VES_OK);
    got.status = ves_plan_measure(b->plan, x, 0, &design);
    got.similarity = design.similarity;
    cr_assert_eq(ves_plan_points(b->plan, 0, 1, &u, &v, point), VES_OK);
    cr_assert_eq(ves_plan_spine(b->plan, 0, 1, &u, spine), VES_OK);
    got.point = point[2], got.spine = spine[2], got.figure = NAN;
    if (ves_plan_figure(b->plan, x, 8, 16, &figure, diag) == VES_OK) {
        ves_mesh mesh;
        got.figure = 0;
        cr_assert_eq(ves_figure_mesh(figure, true, &mesh), VES_OK);
        for (int k = 0; k < mesh.vertices; k++) got.figure = fmax(got.figure, mesh.point[3 * k + 2]);
        ves_figure_destroy(figure);
    }
    if (ves_diag_count(diag)) ves_diag_text(diag, 0, got.said, sizeof got.said);
    ves_diag_destroy(diag);
    return got;
}

Test(plan, what_is_drawn_of_a_design_does_not_depend_on_the_one_before)
{
    const struct {
        const char *text;
        double r, z;
        ves_status want;
        double top; /* NAN: no figure */
        bool scaled;
        const char *says;
    } table[] = {
        {GROWN("scale: {equation: area == 100*r}\n"), 0.25, 1, VES_OUTSIDE, 1, false,
         "warning: the shape is drawn, not scaled, although a number of the problem has left its range"},
        {GROWN("scale: {equation: area == 9*z}\n"), 1, -1, VES_NO_SCALE, NAN, false,
         "error: there is no shape to show: no size of the shape meets the scale equation"},
        {GROWN("scale: {equation: area == 9*z}\n"), 1, 0, VES_NO_SCALE, NAN, false, "error: there is no"},
        {GROWN("scale: {equation: width == 9}\nmeasures: {m: {max: {of: log(x - 99)}}}\nconstraints: [m <= "
               "1]\n"),
         1, 1, VES_NO_NUMBER, 4.5, true,
         "warning: the shape is drawn although a measure is not a finite number"},
        {GROWN(""), 0.25, 1, VES_OUTSIDE, 1, true, "warning: the shape is drawn although a number of"},
        {GROWN("solve: {unknown: s, in: [1, 5], equation: area == s}\nscale: {equation: depth == s - 3*z}\n"),
         1, 1, VES_NO_BRACKET, NAN, false, "error: there is no shape to show"}};
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        bed b = bed_make(table[k].text);
        const double before[3] = {2, 0.6, 1.3};
        for (int n = 0; n < 3; n++) {
            reach_of(&b, before[n], 1);
            reach got = reach_of(&b, table[k].r, table[k].z);
            bool drawn = !isnan(table[k].top);
            cr_expect_eq(got.status, table[k].want, "case %zu: %s", k, ves_status_text(got.status));
            cr_expect_eq(isnan(got.similarity), !table[k].scaled, "case %zu: %g", k, got.similarity);
            cr_expect_eq(isnan(got.figure), !drawn, "case %zu: %g", k, got.figure);
            cr_expect(strstr(got.said, table[k].says) != NULL, "case %zu: %s", k, got.said);
            /* the top lies at u = 1, and a width is climbed to 1e-13 of its size */
            cr_expect(!drawn || fabs(got.figure - table[k].top) < 1e-12, "case %zu after %g: %.15g high", k,
                      before[n], got.figure);
            cr_expect(!drawn || (got.point == got.figure && got.spine == got.figure),
                      "case %zu: %.15g, %.15g", k, got.point, got.spine);
        }
        bed_clear(&b);
    }
}

/* Surfaces against closed forms and properties, through problem texts. Lengths are of order 1, so absolute
 * errors are relative ones. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bed.h"
#include "plan/inside.h"
#include "problem/problem.h"
#include "surface/figure.h"
#include "surface/grid.h"

enum { X, XU, XV, XUU, XUV, XVV, FIELDS, POINTS = 40 };

static const double PI = 3.141592653589793;

static bed bed_make(const char *text)
{
    return bed_with(text, NULL, 0, 0);
}

static void start(const bed *b, double *x)
{
    for (int k = 0; k < b->problem->variables; k++) x[k] = b->problem->variable[k].start;
}

static double measured(const bed *b, const char *name, int level)
{
    double x[8];
    ves_design design;
    start(b, x);
    cr_assert_eq(ves_plan_measure(b->plan, x, level, &design), VES_OK);
    for (int k = 0; k < b->problem->measures; k++)
        if (!strcmp(b->problem->measure[k].name, name)) return design.measure[k];
    cr_assert_fail("no measure %s", name);
    return NAN;
}

/* Scattered (u, v), ends included. */
static void scatter(double *u, double *v)
{
    for (int k = 0; k < POINTS; k++)
        u[k] = k < 4 ? k % 2 : fmod(0.618033988 * k, 1), v[k] = fmod(2.399963 * k, 2 * PI);
}

static void sampled(const bed *b, const double *u, const double *v, double out[FIELDS][3][POINTS])
{
    double x[8];
    ves_design design;
    start(b, x);
    ves_plan_measure(b->plan, x, 0, &design);
    cr_assert_eq(ves_plan_points(b->plan, 0, POINTS, u, v, &out[0][0][0]), VES_OK);
}

#define CATENOID(power, slopes)                                                                              \
    "vesica: 1\nquadrature: {u: 32, v: 16}\nparameters: {L: 2.385}\n"                                        \
    "curves:\n  low: {circle: {radius: cosh(L/2), centre: [0, 0, -L/2]}}\n  high: {like: low, apply: "       \
    "[{translate: [0, 0, L]}]}\n"                                                                            \
    "  flare: {formula: [\"L*sinh(L/2)*cos(v)\", \"L*sinh(L/2)*sin(v)\", \"L\"]}\n  close: {like: flare, "   \
    "apply: [{dilate: [-1, -1, 1]}]}\n"                                                                      \
    "patches:\n  neck: {operator: {power: " power                                                            \
    ", a: L}, conditions: [{u: 0, position: low}, {u: 1, position: high}" slopes "]}\n"                      \
    "expect: [willmore < 1e-20, area > 0, bending > 0, gauss_curvature < 0, mean_curvature < 1]\n"

/* The catenoid is harmonic in isothermal coordinates: with a = L it is met exactly by one mode, for power 1
 * and, since harmonic is biharmonic, for power 2 with its own slopes. */
Test(surface, the_catenoid_is_met_exactly_at_the_right_a)
{
    static const char *const text[] = {
        CATENOID("1", ""),
        CATENOID("2", ", {u: 0, derivative: 1, field: close}, {u: 1, derivative: 1, field: flare}")};
    double u[POINTS], v[POINTS], got[FIELDS][3][POINTS], L = 2.385;
    scatter(u, v);
    for (int k = 0; k < 2; k++) {
        bed b = bed_make(text[k]);
        sampled(&b, u, v, got);
        for (int i = 0; i < POINTS; i++) {
            double t = L * (u[i] - 0.5), c = cosh(t), s = sinh(t), co = cos(v[i]), si = sin(v[i]);
            double want[FIELDS][3] = {{c * co, c * si, t},          {L * s * co, L * s * si, L},
                                      {-c * si, c * co, 0},         {L * L * c * co, L * L * c * si, 0},
                                      {-L * s * si, L * s * co, 0}, {-c * co, -c * si, 0}};
            for (int f = 0; f < FIELDS; f++)
                for (int d = 0; d < 3; d++)
                    /* 1e-12 (weights) of the largest, L^2 cosh(L/2); 5e-15 was seen */
                    cr_expect(fabs(got[f][d][i] - want[f][d]) < 1e-12 * 6,
                              "power %d field %d: got %.16g want %.16g", k + 1, f, got[f][d][i], want[f][d]);
        }
        cr_expect(measured(&b, "willmore", 0) < 1e-20); /* H^2 of an H that is rounding; 4e-31 was seen */
        /* area of revolution: 2 pi int cosh^2 = pi (L + sinh L) */
        /* (here and below: sums of some hundred terms, 1e-12 of a size of about 10; 7e-15 was seen) */
        cr_expect(fabs(measured(&b, "area", 0) - PI * (L + sinh(L))) < 1e-11);
        /* K = -1 / cosh^4, dA = cosh^2: total -4 pi tanh(L / 2) */
        cr_expect(fabs(measured(&b, "gauss_curvature", 0) + 4 * PI * tanh(L / 2)) < 1e-11);
        bed_clear(&b);
    }
}

Test(surface, a_zero_gives_straight_lines_and_cubics)
{
    static const char *const text[] = {
        "vesica: 1\ncurves: {p: {circle: {radius: 1.3}}, q: {like: p, apply: [{translate: [0, 0, 2.1]}]}}\n"
        "patches: {wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: "
        "q}]}}\nexpect: [area > 0, bending > 0, mean_curvature > 0]\n",
        "vesica: 1\ncurves: {p: {circle: {radius: 1.3}}, q: {like: p, apply: [{translate: [0, 0, 2.1]}]}}\n"
        "patches: {wall: {operator: {power: 2, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}, "
        "{u: 0, derivative: 1, from: p, to: q}, "
        "{u: 1, derivative: 1, from: p, to: q}]}}\nexpect: [area > 0, bending > 0, mean_curvature > 0]\n"};
    for (int k = 0; k < 2;
         k++) { /* a cylinder of radius R and height h: area 2 pi R h, H = 1/(2R) outward, K = 0 */
        bed b = bed_make(text[k]);
        /* rounding; 4e-15 was seen */
        cr_expect(fabs(measured(&b, "area", 0) - 2 * PI * 1.3 * 2.1) < 1e-12);
        cr_expect(fabs(measured(&b, "mean_curvature", 0) - PI * 2.1) < 1e-12,
                  "H is +1/(2R) with the outward normal");
        cr_expect(fabs(measured(&b, "bending", 0) - 2 * PI * 2.1 / 1.3) < 1e-12);
        bed_clear(&b);
    }
}

#define SPLINES                                                                                              \
    "vesica: 1\nparameters: {a: 1.2}\ncurves:\n"                                                             \
    "  p: {bspline: {points: [[1.4, 0, 0], [0.9, 1.1, 0.1], [-1, 0.8, 0], [-1.2, -0.9, 0], [0.3, -1.3, "     \
    "0.2]]}}\n"                                                                                              \
    "  q: {like: p, apply: [{shift: 0.3}, {translate: [0.2, 0, 2]}]}\n  up: {bspline: {points: [[0, 0, 2], " \
    "[0.4, 0, 2], [0, 0.5, 2], [0.1, 0, 1]]}}\n"

static const char WALL[] = "conditions: [{u: 0, position: p}, {u: 1, position: q}, {u: 0, derivative: 1, "
                           "field: up}, {u: 1, derivative: 1, field: up}]}}\n"
                           "expect: [area > 0]\n";

/* However few modes are solved one by one, the remainder makes position and slope at both ends those of the
 * curves. */
Test(surface, the_remainder_meets_the_end_curves)
{
    for (int modes = 2; modes <= 130; modes = modes * 2 + 3) {
        char text[2000];
        snprintf(text, sizeof text, SPLINES "patches: {wall: {operator: {power: 2, a: a}, modes: %d, %s",
                 modes, WALL);
        bed b = bed_make(text);
        double u[POINTS], v[POINTS], got[FIELDS][3][POINTS];
        scatter(u, v);
        for (int i = 0; i < POINTS; i++) u[i] = i % 2;
        sampled(&b, u, v, got);
        ves_curves *curves;
        ves_arena arena = {0};
        const ves_problem *p = b.problem;
        ves_curve_set set = {p->curve, p->curves, p->curve_limit, b.plan->block, p->varying, NULL};
        cr_assert_eq(ves_curves_create(&set, &arena, &curves, NULL), VES_OK);
        for (int i = 0; i < POINTS; i++) {
            double at[9], slope[9];
            int position = -1, field = -1;
            for (int k = 0; k < p->curves; k++) {
                if (!strcmp(p->curve[k].name, u[i] > 0 ? "q" : "p")) position = k;
                if (!strcmp(p->curve[k].name, "up")) field = k;
            }
            ves_curve_point(ves_curves_coef(curves, position), ves_curves_modes(curves, position), v[i], 2,
                            at);
            ves_curve_point(ves_curves_coef(curves, field), ves_curves_modes(curves, field), v[i], 2, slope);
            /* the remainder is made of these data: rounding of numbers of size 1, 4e-16 was seen */
            for (int d = 0; d < 3; d++) {
                cr_expect(fabs(got[X][d][i] - at[d]) < 4e-15, "modes %d: %.17g %.17g", modes, got[X][d][i],
                          at[d]);
                cr_expect(fabs(got[XV][d][i] - at[3 + d]) < 1e-13);
                cr_expect(fabs(got[XU][d][i] - slope[d]) < 1e-13);
            }
        }
        ves_arena_destroy(&arena);
        bed_clear(&b);
    }
}

/* The more modes are solved one by one, the nearer to the solution of the equation: the error falls like the
 * tail of the curve. */
Test(surface, the_remainder_vanishes_with_more_modes)
{
    double u[POINTS], v[POINTS], exact[FIELDS][3][POINTS], got[FIELDS][3][POINTS], before = 1;
    scatter(u, v);
    for (int modes = 127; modes >= 3; modes = modes == 127 ? 3 : modes * 2 + 1) {
        char text[2000];
        snprintf(text, sizeof text, SPLINES "patches: {wall: {operator: {power: 2, a: a}, modes: %d, %s",
                 modes, WALL);
        bed b = bed_make(text);
        sampled(&b, u, v, modes == 127 ? exact : got);
        bed_clear(&b);
        if (modes == 127) continue;
        if (modes > 40) break;
        double error = 0;
        for (int i = 0; i < POINTS; i++)
            for (int d = 0; d < 3; d++) error = fmax(error, fabs(got[X][d][i] - exact[X][d][i]));
        cr_expect(error < before / 4, "modes %d: %.3g after %.3g", modes, error, before);
        before = error;
    }
    cr_expect(before < 1e-5); /* 4e-8 was seen */
}

/* Tiles, rings and scattered points are three ways to the same surface. */
Test(surface, all_ways_of_sampling_agree)
{
    char text[2000];
    snprintf(text, sizeof text, SPLINES "patches: {wall: {operator: {power: 2, a: a}, modes: 9, %s", WALL);
    bed b = bed_make(text);
    ves_figure *figure;
    double x[1] = {0}, u[POINTS], v[POINTS], got[FIELDS][3][POINTS];
    cr_assert_eq(ves_plan_figure(b.plan, x, 7, 12, &figure, b.diag), VES_OK);
    const ves_figure_patch *f = &figure->patch[0];
    for (int i = 0; i < POINTS; i++) u[i] = (double)(i % 8) / 7, v[i] = 2 * PI * (i % 12) / 12;
    sampled(&b, u, v, got);
    for (int i = 0; i < POINTS; i++)
        for (int d = 0; d < 3; d++) /* rounding of the same sum in another order; 2e-15 was seen */
            cr_expect(fabs(f->X[d][(i % 8) * f->columns + i % 12] - got[X][d][i]) < 1e-14);
    ves_figure_destroy(figure);
    /* the spine is the mean over v */
    double spine[9 * 3], at[3] = {0.13, 0.5, 0.91};
    cr_assert_eq(ves_plan_spine(b.plan, 0, 3, at, spine), VES_OK);
    for (int k = 0; k < 3; k++)
        for (int d = 0; d < 3; d++) {
            enum { AROUND = 320 };
            double mean = 0;
            for (int j = 0; j < AROUND; j += POINTS) {
                for (int i = 0; i < POINTS; i++) u[i] = at[k], v[i] = 2 * PI * (j + i) / AROUND;
                cr_assert_eq(ves_plan_points(b.plan, 0, POINTS, u, v, &got[0][0][0]), VES_OK);
                for (int i = 0; i < POINTS; i++) mean += got[X][d][i] / AROUND;
            }
            /* rounding of 320 terms */
            cr_expect(fabs(mean - spine[d * 3 + k]) < 1e-13, "%.16g %.16g", mean, spine[d * 3 + k]);
        }
    bed_clear(&b);
}

/* Two hemispheres as sheets, and as order-4 patches that only nearly are: outward, volume positive, H > 0. */
Test(surface, formula_sheets_are_exact)
{
    bed b = bed_make("vesica: 1\nquadrature: {u: 24, v: 32}\nparameters: {R: 1.3}\npatches: {ball: {surface: "
                     "{formula: [\"R*sin(pi*u)*cos(v)\", \"R*sin(pi*u)*sin(v)\", \"-R*cos(pi*u)\"]}}}\n"
                     "shape: {closed: true}\nexpect: [area > 0, volume > 0, mean_curvature > 0, "
                     "gauss_curvature > 0, willmore > 0]\n");
    /* 24 Gauss nodes see the sines to rounding: 7e-15 was seen */
    cr_expect(fabs(measured(&b, "area", 0) - 4 * PI * 1.69) < 1e-11);
    cr_expect(fabs(measured(&b, "volume", 0) - 4 * PI / 3 * 2.197) < 1e-11);
    cr_expect(fabs(measured(&b, "mean_curvature", 0) - 4 * PI * 1.3) < 1e-11);
    cr_expect(fabs(measured(&b, "gauss_curvature", 0) - 4 * PI) < 1e-11);
    cr_expect(fabs(measured(&b, "willmore", 0) - 4 * PI) < 1e-11);
    bed_clear(&b);
}

static double height_at(double s, double t, bool round)
{
    return sin(2 * s) * cos(1 + (round ? 2 * PI * t : t));
}

static double spline_error(int rows, bool round)
{
    char text[60000];
    size_t at = (size_t)snprintf(text, sizeof text, "vesica: 1\npatches: {roof: {surface: {points: [");
    for (int r = 0; r < rows; r++) {
        at += (size_t)snprintf(text + at, sizeof text - at, "%s[", r ? ", " : "");
        for (int c = 0; c < rows; c++) {
            double s = (double)r / (rows - 1), t = (double)c / (round ? rows : rows - 1);
            at += (size_t)snprintf(text + at, sizeof text - at, "%s[%.17g, %.17g, %.17g]", c ? ", " : "", s,
                                   t, height_at(s, t, round));
        }
        at += (size_t)snprintf(text + at, sizeof text - at, "]");
    }
    snprintf(text + at, sizeof text - at,
             "]}, periodic: %s}}\nvalidity: {jacobian: any}\nexpect: [area > 0]\n", round ? "true" : "false");
    bed b = bed_make(text);
    double u[POINTS], v[POINTS], got[FIELDS][3][POINTS], error = 0;
    scatter(u, v);
    sampled(&b, u, v, got);
    for (int i = 0; i < POINTS; i++)
        error = fmax(error, fabs(got[X][2][i] - height_at(u[i], v[i] / (2 * PI), round)));
    bed_clear(&b);
    return error;
}

/* Cubic splines are of fourth order, with not-a-knot ends and without ends: about 5/384 f'''' h^4, which is 3e-6
 * for 17 points and, where f turns round once, 3e-4. */
Test(surface, point_sheets_converge_with_order_four)
{
    static const double error[] = {1e-5, 1e-3};
    for (int round = 0; round < 2; round++) {
        double order = log2(spline_error(9, round) / spline_error(17, round));
        cr_expect(order > 3.6 && order < 5.2, "observed order %.2f", order);
        cr_expect(spline_error(17, round) < error[round]);
    }
}

/* Gauss-Legendre with n nodes is exact up to degree 2n - 1. */
Test(surface, gauss_nodes_are_exact_to_their_degree)
{
    for (int n = 1; n <= 64; n++) {
        double node[64], weight[64];
        ves_gauss_nodes(n, node, weight);
        for (int p = 0; p < 2 * n; p++) {
            double sum = 0;
            for (int k = 0; k < n; k++) sum += weight[k] * pow(node[k], p);
            /* rounding of 64 terms; 9e-16 was seen */
            cr_expect(fabs(sum - 1. / (p + 1)) < 1e-14, "n %d degree %d: %.17g", n, p, sum);
        }
    }
}

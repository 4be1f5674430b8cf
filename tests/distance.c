/* Distances in problems: exact on any grid, for curves of any number of modes, and their gradients. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bed.h"
#include "problem/problem.h"
#include "vesica/plan.h"

/* Rounding of some hundred terms. */
static const double EXACT = 1e-12;

static double evaluated(const bed *b, const double *x, double *gradient)
{
    double constraint[1];
    ves_verdict verdict = {.constraint = constraint, .gradient = gradient};
    ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE | (gradient ? VES_WANT_GRADIENT : 0)};
    cr_assert_eq(ves_plan_evaluate(b->plan, &ask, &verdict), VES_OK);
    cr_assert_eq(verdict.status, VES_OK, "%s", ves_status_text(verdict.status));
    return verdict.value;
}

static void near(double got, double want, double tolerance, const char *what)
{
    cr_expect(fabs(got - want) <= tolerance * fmax(1, fabs(want)), "%s: got %.16g, want %.16g (off by %.2e)",
              what, got, want, got - want);
}

/* Differences of fourth order, h = 1e-3: truncation h^4 times fifth derivatives up to 1e4. */
static void check_gradient(const bed *b, const double *x, int n)
{
    double gradient[8], at[8], side[4], h = 1e-3;
    evaluated(b, x, gradient);
    for (int k = 0; k < n; k++) {
        memcpy(at, x, sizeof *x * (size_t)n);
        for (int i = 0; i < 4; i++)
            at[k] = x[k] + (i < 2 ? i - 2 : i - 1) * h, side[i] = evaluated(b, at, NULL);
        double want = (side[0] - 8 * side[1] + 8 * side[2] - side[3]) / (12 * h);
        near(gradient[k], want, 1e-8, b->problem->variable[k].name);
    }
}

static const int GRID[][2] = {{8, 8}, {8, 9}, {16, 32}, {5, 21}};

#define TUBE                                                                                                 \
    "vesica: 1\n"                                                                                            \
    "variables: {a: [0.1, 1, 1100], r: [0.1, 1, 3], t: [-2, 0.3, 2]}\n"                                      \
    "curves:\n"                                                                                              \
    "  low: {ellipse: {radii: [r, 1]}, apply: [{shift: 0.3}, {ridge: {points: 10, by: 0.1}}]}\n"             \
    "  high: {circle: {radius: 1}, apply: [{rotate: [t, 0, 0]}, {translate: [0.3, 0, 3]}]}\n"                \
    "  up: {formula: [\"0\", \"0\", \"1\"]}\n"                                                               \
    "patches:\n  wall: {operator: {power: 2, a: a}, conditions: [{u: 0, position: low}, {u: 0, derivative: " \
    "1, field: up}, {u: 1, position: high}, {u: 1, derivative: 1, field: up}]}\n"                            \
    "validity: {jacobian: any}\n"

/* Wherever the nodes lie; and the distance has no slope there that an optimizer could be led astray by. */
Test(distance, a_place_on_its_own_end_curve_is_no_distance_away)
{
    for (int g = 0; g < 4; g++)
        for (int v = 0; v < 7; v++) {
            char text[2000];
            snprintf(text, sizeof text, "%splaces: {tip: {patch: wall, u: %d, v: %g}}\n%s", TUBE, v % 2,
                     0.917 * v,
                     v % 2 ? "measures: {d: {distance: {from: tip, to: high}}}\nminimize: d\n"
                           : "measures: {d: {distance: {from: low, to: tip}}}\nminimize: d\n");
            bed b = bed_with(text, NULL, GRID[g][0], GRID[g][1]);
            for (int k = 0; k < 4; k++) {
                double x[3] = {pow(10, k), 0.8 + 0.1 * k, 0.2 * k}, gradient[3];
                near(evaluated(&b, x, gradient), 0, EXACT, "distance");
                for (int c = 0; c < 3; c++) cr_expect(gradient[c] == 0, "a slope of %g", gradient[c]);
            }
            bed_clear(&b);
        }
}

Test(distance, gradients_agree_with_differences)
{
    static const char *const rest[] = {
        "minimize: d\n",
        "scale: {equation: area == 20}\nminimize: d\n",
        "scale: {equation: d == 3}\nminimize: area\n",
    };
    static const char *const pair[] = {"from: low, to: high", "from: tip, to: high", "from: low, to: up",
                                       "from: tip, to: far"};
    const double x[3] = {1.3, 1.2, 0.3};
    for (int p = 0; p < 4; p++)
        for (int k = 0; k < 3; k++) {
            char text[2000];
            snprintf(text, sizeof text,
                     "%splaces: {tip: {patch: wall, u: 0.4, v: 1.1}, far: {patch: wall, u: 1, v: 3}}\n"
                     "measures: {d: {distance: {%s}}}\n%s",
                     TUBE, pair[p], rest[k]);
            bed b = bed_with(text, NULL, 16, 32);
            check_gradient(&b, x, 3);
            bed_clear(&b);
        }
}

/* A wave of 40 on a ring, more than any of the grids has nodes for: its crests come nearest to the point. */
Test(distance, a_curve_of_many_modes_is_seen_whole)
{
    for (int g = 0; g < 4; g++) {
        bed b = bed_with("vesica: 1\nvariables: {r: [0.1, 1, 3], s: [-4, 0.1, 4]}\n"
                         "curves:\n"
                         "  o: {point: [0, 0, 2]}\n"
                         "  p: {circle: {radius: r}}\n"
                         "  q: {formula: [r*cos(v), r*sin(v), 0.05*cos(40*v)], apply: [{shift: s}]}\n"
                         "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: o}, {u: 1, "
                         "position: p}]}}\n"
                         "measures: {d: {distance: {from: o, to: q}}}\nminimize: d\n",
                         NULL, GRID[g][0], GRID[g][1]);
        for (int k = 0; k < 20; k++) {
            double x[2] = {0.7 + 0.031 * k, -0.5 + 0.071 * k};
            near(evaluated(&b, x, NULL), hypot(1.95, x[0]), EXACT, "crest");
        }
        bed_clear(&b);
    }
}

/* From (p, 0, 1/2) to the ellipse with half axes 1 and 2: sqrt(1/4 + (1 - |p|)^2), at one end or the other.
 */
Test(distance, the_value_does_not_jump_where_one_valley_overtakes_another)
{
    static const double p[] = {-1e-1, -1e-3, -1e-5, -1e-9, 0, 1e-9, 1e-5, 1e-3, 1e-1};
    bed b = bed_with("vesica: 1\nvariables: {p: [-1, 0, 1], s: [-4, 0.1, 4]}\n"
                     "curves:\n"
                     "  ring: {ellipse: {radii: [1, 2]}, apply: [{shift: s}]}\n"
                     "  top: {point: [p, 0, 0.5]}\n"
                     "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: ring}, {u: 1, "
                     "position: top}]}}\n"
                     "measures: {d: {distance: {from: top, to: ring}}}\nminimize: d\n",
                     NULL, 8, 8);
    for (int k = 0; k < 9; k++)
        for (int n = 0; n < 30; n++) {
            double x[2] = {p[k], -0.4 + 0.031 * n};
            near(evaluated(&b, x, NULL), hypot(0.5, 1 - fabs(p[k])), EXACT, "d");
        }
    bed_clear(&b);
}

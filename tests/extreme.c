/* Extremes on the surface itself, between nodes and on the ends of patches: against closed forms on grids of
 * any fineness, and their gradients against differences. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/random.h"
#include "bed.h"
#include "problem/problem.h"
#include "vesica/plan.h"

static const double PI = 3.14159265358979323846;

/* Rounding of some hundred terms; a summit is missed by the fourth power of 1e-4 times a cell. */
static const double EXACT = 1e-12;

static bed bed_make(const char *text, int nu, int nv)
{
    return bed_with(text, NULL, nu, nv);
}

static double measured(const bed *b, const double *x, int level, const char *name)
{
    ves_design design;
    ves_status status = ves_plan_measure(b->plan, x, level, &design);
    cr_assert_eq(status, VES_OK, "%s", ves_status_text(status));
    for (int k = 0; k < b->problem->measures; k++)
        if (!strcmp(b->problem->measure[k].name, name)) return design.measure[k];
    cr_assert_fail("no measure %s", name);
    return NAN;
}

static void near(double got, double want, double tolerance, const char *what)
{
    cr_assert(fabs(got - want) <= tolerance * fmax(1, fabs(want)), "%s: got %.16g, want %.16g (off by %.2e)",
              what, got, want, got - want);
}

static double draw(ves_random *random, double low, double high)
{
    return low + (high - low) * ves_random_uniform(random);
}

/* --- between two circles: straight from one to the other, so that every extreme lies on a rim --- */

#define CONE                                                                                                 \
    "vesica: 1\n"                                                                                            \
    "variables: {s: [0.1, 0.6, 3], t: [-9, 0.4, 9], d: [-9, 0.7, 9], h: [0.1, 1.5, 5], "                     \
    "ex: [-9, 0.3, 9], ey: [-9, 0.5, 9], ez: [-9, 1, 9]}\n"                                                  \
    "curves:\n"                                                                                              \
    "  p: {circle: {radius: 1.129}, apply: [{shift: d}]}\n"                                                  \
    "  q: {circle: {radius: s}, apply: [{shift: 0.3}, {rotate: [t, 0, 0]}, {rotate: [0, 0, d]}, "            \
    "{translate: [0.2, 0, h]}]}\n"                                                                           \
    "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"

/* The farthest point of a circle along e. */
static double reach(const double centre[3], const double normal[3], double radius, const double e[3])
{
    double along = 0, across = 0, square = 0;
    for (int c = 0; c < 3; c++) along += centre[c] * e[c], across += normal[c] * e[c], square += e[c] * e[c];
    return along + radius * sqrt(fmax(0, square - across * across));
}

static double cone_reach(const double *x, double sign)
{
    double e[3], length = sqrt(x[4] * x[4] + x[5] * x[5] + x[6] * x[6]);
    for (int c = 0; c < 3; c++) e[c] = sign * x[4 + c] / length;
    const double low[3] = {0, 0, 0}, up[3] = {0, 0, 1}, high[3] = {0.2, 0, x[3]};
    const double normal[3] = {sin(x[1]) * sin(x[2]), -sin(x[1]) * cos(x[2]), cos(x[1])};
    return fmax(reach(low, up, 1.129, e), reach(high, normal, x[0], e));
}

Test(extreme, what_reaches_farthest_between_two_circles_is_one_of_them)
{
    static const int grid[][2] = {{8, 16}, {16, 32}, {9, 21}, {5, 12}};
    for (int g = 0; g < 4; g++) {
        bed b =
            bed_make(CONE "measures: {E: {extent: {along: [ex, ey, ez]}}, M: {max: {of: (ex*x + ey*y + "
                          "ez*z)/sqrt(ex^2 + ey^2 + ez^2)}}, N: {min: {of: (ex*x + ey*y + ez*z)/sqrt(ex^2 "
                          "+ ey^2 + ez^2)}}}\nvalidity: {jacobian: any}\nminimize: E + M + N\n",
                     grid[g][0], grid[g][1]);
        for (uint64_t k = 0; k < 60; k++) {
            ves_random random = {.seed = k + 1};
            double x[7] = {draw(&random, 0.2, 2), draw(&random, -1.2, 1.2), draw(&random, -3, 3),
                           draw(&random, 0.2, 3)};
            for (int c = 0; c < 3; c++) x[4 + c] = ves_random_normal(&random);
            double most = cone_reach(x, 1), least = -cone_reach(x, -1);
            for (int level = 0; level < 2; level++) {
                near(measured(&b, x, level, "E"), most - least, EXACT, "extent");
                near(measured(&b, x, level, "M"), most, EXACT, "max");
                near(measured(&b, x, level, "N"), least, EXACT, "min");
            }
        }
        bed_clear(&b);
    }
}

Test(extreme, width_height_and_depth_see_the_rims)
{
    bed b = bed_make(CONE "minimize: width + height + depth + ex + ey + ez\n", 16, 32);
    double x[7] = {0.6, 0.4, 0.7, 1.5, 0, 0, 1};
    near(measured(&b, x, 0, "depth"), 1.5 + 0.6 * sin(0.4), EXACT, "depth");
    near(measured(&b, x, 0, "width"), 2 * 1.129, EXACT, "width");
    x[0] = 2, x[4] = 1, x[6] = 0;
    near(measured(&b, x, 0, "width"), cone_reach(x, 1) + cone_reach(x, -1), EXACT, "width of the upper one");
    bed_clear(&b);
}

/* --- inside: where curvature, radius or height are largest or least between the nodes --- */

/* (c cosh(k (2u - 1)) (cos v, sin v), c k (2u - 1)): a = 2 k carries it exactly. H = 0 and |k1| = 1 / (c
 * cosh^2) are largest at the neck. */
Test(extreme, the_neck_of_a_catenoid)
{
    bed b =
        bed_make("vesica: 1\n"
                 "variables: {c: [0.1, 1, 3], k: [0.1, 1, 3], s: [0.1, 0.3, 1]}\n"
                 "parameters: {m: \"c*cosh(k)\", t: \"k*(1 + s)/2\"}\n"
                 "curves:\n"
                 "  p: {circle: {radius: m, centre: [0, 0, -c*k]}}\n"
                 "  q: {circle: {radius: \"c*cosh(s*k)\", centre: [0, 0, s*c*k]}}\n"
                 "patches: {w: {operator: {power: 1, a: k*(1 + s)}, conditions: [{u: 0, position: p}, {u: 1, "
                 "position: q}]}}\n"
                 "measures: {r: {min: {of: \"hypot(x, y)\"}}, R: {max: {of: \"hypot(x, y)\"}}, K: {min: {of: "
                 "K}}}\nminimize: max_curvature + r + R + K\n",
                 16, 16);
    for (int n = 0; n < 20; n++) {
        double x[3] = {0.5 + 0.071 * n, 0.4 + 0.053 * n, 0.2 + 0.031 * n};
        near(measured(&b, x, 0, "max_curvature"), 1 / x[0], 1e-11, "curvature"); /* twice differentiated */
        near(measured(&b, x, 0, "r"), x[0], EXACT, "neck");
        near(measured(&b, x, 0, "R"), x[0] * cosh(x[1]), EXACT, "rim");
        near(measured(&b, x, 0, "K"), -1 / (x[0] * x[0]), 1e-11, "K");
    }
    bed_clear(&b);
}

#define PEBBLE                                                                                               \
    "vesica: 1\nvariables: {a: [0.1, 1.9, 5], b: [0.1, 1.2, 5], c: [0.1, 0.8, 5], w: [-9, 0.7, 9]}\n"        \
    "patches: {p: {surface: {formula: [a*sin(pi*u)*cos(v + w), b*sin(pi*u)*sin(v + w), c*cos(pi*u)]}}}\n"    \
    "measures: {E: {extent: {along: [0.4, -1.3, 0.7]}}, least: {min: {of: k2}}, high: {max: {of: z}}}\n"     \
    "minimize: max_curvature + E + least + high\n"

/* Half axes a, b, c: the curvatures at the end of a are a / b^2 and a / c^2. The top of z is a pole, where X
 * is smooth; a sheet, with nothing known of its Fourier modes. */
Test(extreme, an_ellipsoid_of_any_shape)
{
    bed bed_ = bed_make(PEBBLE, 24, 32);
    for (uint64_t n = 0; n < 40; n++) {
        ves_random random = {.seed = n + 3};
        double x[4] = {draw(&random, 1.6, 2), draw(&random, 1.1, 1.4), draw(&random, 0.7, 0.9),
                       draw(&random, -3, 3)};
        double e[3] = {0.4, -1.3, 0.7}, length = sqrt(0.4 * 0.4 + 1.3 * 1.3 + 0.7 * 0.7), sum = 0;
        for (int c = 0; c < 3; c++) sum += pow(x[c] * e[c] / length, 2);
        near(measured(&bed_, x, 0, "E"), 2 * sqrt(sum), EXACT, "extent");
        near(measured(&bed_, x, 0, "max_curvature"), x[0] / (x[2] * x[2]), 1e-10, "curvature");
        near(measured(&bed_, x, 0, "high"), x[2], EXACT, "pole");
        near(measured(&bed_, x, 0, "least"), x[2] / (x[0] * x[0]), 1e-10, "at the pole");
    }
    bed_clear(&bed_);
}

Test(extreme, a_cap_of_a_sphere_is_the_same_everywhere)
{
    bed b =
        bed_make("vesica: 1\nvariables: {R: [0.1, 2.385, 5], t: [0.1, 1.1, 1.5]}\n"
                 "patches: {p: {surface: {formula: [R*sin(t*u)*cos(v), R*sin(t*u)*sin(v), R*cos(t*u)]}}}\n"
                 "minimize: max_curvature + depth\n",
                 16, 16);
    double x[2] = {2.385, 1.1};
    near(measured(&b, x, 0, "max_curvature"), 1 / 2.385, 1e-10, "1/R");
    near(measured(&b, x, 0, "depth"), 2.385 * (1 - cos(1.1)), EXACT, "height of the cap");
    bed_clear(&b);
}

/* Not periodic: corners and edges along v are seen too. */
Test(extreme, edges_and_corners_of_an_open_sheet)
{
    bed b = bed_make("vesica: 1\nvariables: {f: [0.1, 1, 5]}\n"
                     "patches: {p: {surface: {formula: [u, v, f*(u - 0.3)^2 + 0.1*v]}, periodic: false}}\n"
                     "measures: {M: {max: {of: z}}, U: {max: {of: u}}, V: {max: {of: v}}, L: {min: {of: z + "
                     "abs(v - 2.385)}}}\nminimize: height + M + U + V + L\n",
                     8, 8);
    double f = 1.37;
    near(measured(&b, &f, 0, "height"), 2 * PI, EXACT, "height");
    near(measured(&b, &f, 0, "M"), f * 0.49 + 0.2 * PI, EXACT, "corner");
    near(measured(&b, &f, 0, "U"), 1, 0, "u");
    near(measured(&b, &f, 0, "V"), 2 * PI, EXACT, "v");
    near(measured(&b, &f, 0, "L"), 0.2385, 1e-3, "a crease"); /* a cell of 0.8 shrunk by 512 */
    bed_clear(&b);
}

/* Splines through points: smooth but for the third derivative. */
Test(extreme, sheets_of_points_and_their_edges)
{
    bed b = bed_make("vesica: 1\nvariables: {h: [0.1, 1, 5]}\n"
                     "patches: {p: {surface: {points: [[[0, 0, 0], [0, 1, h], [0, 2, 0]], [[1, 0, 0], [1, 1, "
                     "2*h], [1, 2, 0]]]}, periodic: false}}\n"
                     "minimize: depth\n",
                     8, 9);
    double h = 1.37;
    near(measured(&b, &h, 0, "depth"), 2 * h, EXACT, "the parabola of the far edge");
    bed_clear(&b);
}

/* The curvature of a cone grows like 1 / u towards its tip: no grid has the largest. That of a dome is found.
 */
Test(extreme, what_grows_without_bound_towards_a_pole_fails_its_proof)
{
    static const char *const text[2] = {
        "vesica: 1\nvariables: {r: [0.1, 1, 5]}\n"
        "curves: {o: {point: [0, 0, 1]}, p: {circle: {radius: r}}}\n"
        "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: o}, {u: 1, position: p}]}}\n"
        "minimize: max_curvature\n",
        "vesica: 1\nvariables: {r: [0.1, 1, 5]}\n"
        "patches: {w: {surface: {formula: [r*u*cos(v), r*u*sin(v), -0.7*u^2]}}}\n"
        "minimize: max_curvature\n"};
    for (int k = 0; k < 2; k++) {
        bed b = bed_make(text[k], 16, 32);
        double r = 1.37, constraint[1];
        ves_verdict verdict = {.constraint = constraint};
        ves_ask ask = {.x = &r, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE | VES_WANT_PROOF};
        cr_assert_eq(ves_plan_evaluate(b.plan, &ask, &verdict), VES_OK);
        cr_expect_eq(verdict.status, k ? VES_OK : VES_COARSE, "%s", ves_status_text(verdict.status));
        if (k) near(verdict.value, 1.4 / (r * r), EXACT, "at the top");
        bed_clear(&b);
    }
}

/* --- two hills --- */

/* max x^2 + q x on the unit circle is 1 + |q|, at x = 1 or x = -1: the value goes through q = 0 without a
 * jump, wherever the nodes lie. */
Test(extreme, the_value_does_not_jump_where_one_hill_overtakes_another)
{
    bed b =
        bed_make("vesica: 1\nvariables: {q: [-1, 0, 1], s: [-4, 0.1, 4]}\n"
                 "curves: {p: {circle: {radius: 1}, apply: [{shift: s}]}, o: {circle: {radius: 0.5, centre: "
                 "[0, 0, 1]}}}\n"
                 "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, "
                 "position: o}]}}\n"
                 "measures: {M: {max: {of: x^2 + q*x}}, L: {min: {of: -x^2 + q*x}}}\nminimize: M + L\n",
                 8, 16);
    static const double q[] = {-1e-1, -1e-3, -1e-5, -1e-9, 0, 1e-9, 1e-5, 1e-3, 1e-1};
    for (int k = 0; k < 9; k++)
        for (int n = 0; n < 30; n++) {
            double x[2] = {q[k], -0.4 + 0.031 * n};
            near(measured(&b, x, 0, "M"), 1 + fabs(q[k]), EXACT, "M");
            near(measured(&b, x, 0, "L"), -1 - fabs(q[k]), EXACT, "L");
        }
    bed_clear(&b);
}

/* --- gradients --- */

/* Differences of fourth order, h = 1e-3: truncation h^4 times fifth derivatives up to 1e3. The gradient
 * itself is off by the way that is left to the summit, 1e-7 of a cell. */
static void check_gradient(const char *text, const ves_measure *const *plugin, const double *x, int n)
{
    double gradient[8], constraint[4], jacobian[32], h = 1e-3;
    bed b = bed_with(text, plugin, 16, 32);
    ves_verdict verdict = {.constraint = constraint, .gradient = gradient, .jacobian = jacobian};
    ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE | VES_WANT_GRADIENT};
    cr_assert_eq(ves_plan_evaluate(b.plan, &ask, &verdict), VES_OK);
    cr_assert_eq(verdict.status, VES_OK, "%s", ves_status_text(verdict.status));
    for (int k = 0; k < n; k++) {
        double at[8], side[4];
        memcpy(at, x, sizeof *x * (size_t)n);
        for (int i = 0; i < 4; i++) {
            at[k] = x[k] + (i < 2 ? i - 2 : i - 1) * h;
            side[i] = value_at(&b, at);
        }
        double want = (side[0] - 8 * side[1] + 8 * side[2] - side[3]) / (12 * h);
        cr_expect(fabs(gradient[k] - want) < 1e-6 * fmax(1, fabs(want)),
                  "by %s: got %.12g, differences %.12g\n%s", b.problem->variable[k].name, gradient[k], want,
                  text);
    }
    bed_clear(&b);
}

/* A patch of order 4 between a tilted oval and a circle, with a as a variable. */
#define VASE                                                                                                 \
    "vesica: 1\n"                                                                                            \
    "variables: {s: [0.1, 0.8, 3], t: [-2, 0.3, 2], g: [0.1, 1.2, 3], a: [0.1, 1.3, 5], h: [0.1, 1.5, 5]}\n" \
    "curves:\n"                                                                                              \
    "  p: {ellipse: {radii: [1.1, s]}, apply: [{shift: 0.1}]}\n"                                             \
    "  q: {circle: {radius: 0.7}, apply: [{rotate: [t, 0.1, 0]}, {translate: [0.1, 0, h]}]}\n"               \
    "  pd: {like: p, apply: [{dilate: g}, {translate: [0, 0, 0.9]}]}\n"                                      \
    "  qd: {like: q, apply: [{dilate: 1.3}, {translate: [0.1, -0.2, 0.4]}]}\n"                               \
    "patches:\n  w: {operator: {power: 2, a: a}, conditions: [{u: 0, position: p}, {u: 1, position: q}, "    \
    "{u: 0, derivative: 1, from: p, to: pd, scale: 2}, {u: 1, derivative: 1, from: q, to: qd, scale: "       \
    "2}]}\n"

Test(extreme, gradients_agree_with_differences)
{
    static const double x[5] = {0.8, 0.3, 1.2, 1.3, 1.5};
    static const char *const rest[] = {
        "minimize: depth\n",
        "minimize: width\n",
        "measures: {E: {extent: {along: [0.4, -1.3, t]}}}\nminimize: E\n",
        "minimize: max_curvature\n",
        "measures: {M: {max: {of: x + t*y^2 + 0.2*H - g*z}}}\nminimize: M\n",
        "measures: {M: {min: {of: \"hypot(x - 0.05, y) + 0.1*u*cos(v)\"}}}\nminimize: M\n",
        "measures: {M: {max: {of: \"k1*k1 + K\"}}}\nminimize: M\n",
        "measures: {M: {max: {of: z}}}\nscale: {equation: area == 4}\nminimize: M + width/depth\n",
        "measures: {M: {max: {of: z}}}\nscale: {equation: depth == 3}\nminimize: M + width + bending\n",
        "solve: {unknown: r, in: [0.5, 3], equation: width*r == 4}\nminimize: depth*r^2 + area\n",
    };
    for (size_t k = 0; k < sizeof rest / sizeof *rest; k++) {
        char text[2000];
        snprintf(text, sizeof text, "%s%s", VASE, rest[k]);
        check_gradient(text, NULL, x, 5);
    }
    static const double pebble[4] = {1.9, 1.2, 0.8, 0.7}, h = 1.37;
    check_gradient(
        "vesica: 1\nvariables: {a: [0.1, 1.9, 5], b: [0.1, 1.2, 5], c: [0.1, 0.8, 5], w: [-9, 0.7, 9]}\n"
        "patches: {p: {surface: {formula: [a*sin(pi*u)*cos(v + w), b*sin(pi*u)*sin(v + w), "
        "c*cos(pi*u)]}}}\nmeasures: {E: {extent: {along: [0.4, -1.3, 0.7]}}}\n"
        "minimize: max_curvature + E\n",
        NULL, pebble, 4);
    check_gradient(
        "vesica: 1\nvariables: {h: [0.1, 1, 5]}\n"
        "patches: {p: {surface: {points: [[[0, 0, 0], [0, 1, h], [0, 2, 0]], [[1, 0, 0], [1, 1, 2*h], "
        "[1, 2, 0]]]}, periodic: false}}\nminimize: depth*height\n",
        NULL, &h, 1);
}

/* --- looks of a measure from outside --- */

/* The height of one point at the end of the second surface, plus H at one point of the first times x at
 * another of the same look, plus y at the third node of a curve, if one is named. */
static ves_status peep_eval(const ves_measure_input *in, double *value)
{
    in->look(in, 0, 0, (double[3]){0.1, 0.1, 0.1}, (double[3]){1, 1, 1}); /* forgotten by the next */
    int high = in->look(in, 1, 1, (double[3]){1, 1, 0.2}, (double[3]){0.7, 1.7, 0.7});
    int round = in->look(in, 0, 0, (double[3]){0.31, 0.5, 0.9}, (double[3]){4.1, 0.2, 2});
    const ves_samples *curve = ves_sample_of(in, 0);
    if (high != in->first_look + 3 || round != in->first_look) return VES_NO_NUMBER;
    *value = in->sample[high]->X[2][0] + in->sample[round]->H[0] * in->sample[round]->X[0][5];
    if (curve) *value += curve->X[1][2];
    return VES_OK;
}

static void peep_gradient(const ves_measure_input *in, double seed, const ves_adjoint *const *adjoint,
                          double *number)
{
    (void)number;
    int high = in->first_look + 3, round = in->first_look, curve = ves_sample_index(in, 0);
    adjoint[high]->X[2][0] += seed;
    adjoint[round]->H[0] += seed * in->sample[round]->X[0][5];
    adjoint[round]->X[0][5] += seed * in->sample[round]->H[0];
    if (curve >= 0) adjoint[curve]->X[1][2] += seed;
}

static const ves_key PEEP_KEYS[] = {{.name = "at", .kind = VES_CURVE, .about = "test"}, {0}};
static const ves_measure PEEP = {.name = "peep",
                                 .about = "test",
                                 .unit = "m",
                                 .degree = VES_NO_DEGREE,
                                 .looks = 2,
                                 .surface = VES_X | VES_CURVATURE,
                                 .curve = VES_X,
                                 .keys = PEEP_KEYS,
                                 .eval = peep_eval,
                                 .gradient = peep_gradient};
static const ves_measure *const PEEPERS[] = {&PEEP, NULL};

#define TWO                                                                                                  \
    VASE "  top: {operator: {power: 1, a: 0.4}, conditions: [{u: 0, position: q}, {u: 1, position: qd}]}\n"

static double inner(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* |H| by the textbook, from X, Xu, Xv, Xuu, Xuv, Xvv. */
static double curvature(double f[6][3])
{
    const double *a = f[1], *b = f[2];
    double n[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    double E = inner(a, a), F = inner(a, b), G = inner(b, b), J = sqrt(inner(n, n));
    return fabs(E * inner(n, f[5]) - 2 * F * inner(n, f[4]) + G * inner(n, f[3])) / (2 * J * J * J);
}

Test(extreme, a_measure_from_outside_looks_where_it_wants)
{
    static const double x[5] = {0.8, 0.3, 1.2, 1.3, 1.5};
    double u[2] = {0.31, 0.9}, v[2] = {4.1, 0.2}, one = 1, where = 0.7, out[36], top[18], f[6][3];
    bed b = bed_with(TWO "minimize: peep\n", PEEPERS, 8, 8);
    double got = measured(&b, x, 0, "peep");
    cr_assert_eq(ves_plan_points(b.plan, 0, 2, u, v, out), VES_OK);
    cr_assert_eq(ves_plan_points(b.plan, 1, 1, &one, &where, top), VES_OK);
    for (int k = 0; k < 6; k++)
        for (int c = 0; c < 3; c++) f[k][c] = out[(k * 3 + c) * 2];
    near(fabs(got - top[2]), curvature(f) * fabs(out[1]), EXACT, "H x");
    near(measured(&b, x, 1, "peep"), got, EXACT, "on a finer grid");
    bed_clear(&b);
    check_gradient(TWO "measures: {P: {peep: {at: pd}}}\nminimize: P\n", PEEPERS, x, 5);
    check_gradient(TWO "measures: {P: {peep: {at: pd}}}\nscale: {equation: area == 4}\nminimize: P\n",
                   PEEPERS, x, 5);
}

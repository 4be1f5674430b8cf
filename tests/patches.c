/* Patches as files write them: orders, coefficients and conditions anywhere, against surfaces in closed
 * form. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bed.h"

/* x = e^(a u) cos v, y = e^(a u) sin v solve (d_uu + a^2 d_vv) X = 0, and z = 1 + u - u^2 is a mean of every
 * order from 4 on: c_k(u) is d_u^k X there. */
#define CURVE(name, k, u, z)                                                                                 \
    "  " name ": {circle: {radius: a^" #k "*exp(a*" #u "), centre: [0, 0, " #z "]}}\n"
#define HEAD                                                                                                 \
    "vesica: 1\nparameters: {a: 0.7}\ncurves:\n" CURVE("x0", 0, 0, 1) CURVE("x3", 0, 0.3, 1.21)              \
        CURVE("x6", 0, 0.6, 1.24) CURVE("x1", 0, 1, 1) CURVE("d0", 1, 0, 1) CURVE("d3", 1, 0.3, 0.4)         \
            CURVE("d1", 1, 1, -1) CURVE("e5", 2, 0.5, -2) CURVE("e1", 2, 1, -2) CURVE("f0", 3, 0, 0)

static void expect_surface(const char *operator, const char * conditions)
{
    char text[4000];
    enum { POINTS = 35 };
    double u[POINTS], v[POINTS], X[18 * POINTS], worst = 0;
    snprintf(text, sizeof text,
             HEAD "patches: {w: {operator: %s, conditions: [%s]}}\nminimize: area\n", operator, conditions);
    bed b = bed_with(text, NULL, 8, 8);
    for (int k = 0; k < POINTS; k++) u[k] = k / (POINTS - 1.), v[k] = 0.9 * k;
    cr_assert_eq(ves_plan_points(b.plan, 0, POINTS, u, v, X), VES_OK);
    for (int k = 0; k < POINTS; k++) {
        double r = exp(0.7 * u[k]), want[3] = {r * cos(v[k]), r * sin(v[k]), 1 + u[k] - u[k] * u[k]};
        for (int c = 0; c < 3; c++) worst = fmax(worst, fabs(X[c * POINTS + k] - want[c]));
    }
    cr_expect(worst < 1e-13, "%s, %s: off by %.2g", operator, conditions, worst);
    bed_clear(&b);
}

Test(patches, every_layout_meets_the_surface_that_its_conditions_are_of)
{
    static const char *const power[] = {
        "{u: 0, position: x0}, {u: 0.3, position: x3}, {u: 0.6, position: x6}, {u: 1, position: x1}",
        "{u: 1, position: x1}, {u: 0, position: x0}, {u: 0.3, position: x3}, {u: 0.3, derivative: 1, field: "
        "d3}",
        "{u: 0, position: x0}, {u: 0, derivative: 3, field: f0}, {u: 1, derivative: 1, field: d1}, {u: 1, "
        "position: x1}"};
    for (size_t k = 0; k < sizeof power / sizeof *power; k++) expect_surface("{power: 2, a: a}", power[k]);
    expect_surface(
        "{power: 3, a: a}",
        "{u: 0, position: x0}, {u: 0.3, position: x3}, {u: 0.6, position: x6}, {u: 1, position: x1}, "
        "{u: 1, derivative: 1, field: d1}, {u: 1, derivative: 2, field: e1}");
    expect_surface(
        "{power: 4, a: a}",
        "{u: 0, position: x0}, {u: 0.3, position: x3}, {u: 0.6, position: x6}, {u: 1, position: x1}, "
        "{u: 0, derivative: 1, field: d0}, {u: 1, derivative: 1, field: d1}, {u: 1/2, derivative: 2, "
        "field: e5}, {u: 1, derivative: 2, field: e1}");
}

/* s^2 - (0.49 + b) s + 0.49 b has the root s = a^2: e^(a u) cos v solves the equation whatever b is. */
Test(patches, coefficients_make_the_operator)
{
    static const char conditions[] =
        "{u: 0, position: x0}, {u: 1, position: x1}, {u: 0, derivative: 1, field: "
        "d0}, {u: 1, derivative: 1, field: d1}";
    expect_surface("{coefficients: [1, 2*a^2, a^4]}", conditions);
    expect_surface("{coefficients: [2, 2*(0.49 + 3), 2*0.49*3]}", conditions);
    expect_surface("{x: [1, 2*a^2, a^4], y: [1, 0.49 + 5, 0.49*5], z: [1, 1, 9]}", conditions);
    expect_surface(
        "{coefficients: [1, 3*a^2, 3*a^4, a^6]}",
        "{u: 0, position: x0}, {u: 0.3, position: x3}, {u: 0.6, position: x6}, {u: 1, position: x1}, "
        "{u: 1, derivative: 1, field: d1}, {u: 1, derivative: 2, field: e1}");
}

/* Which of the curves have which shares in the last condition of this derivative. */
Test(patches, differences_are_those_of_the_curves_in_their_order)
{
    static const struct {
        const char *text;
        int derivative;
        double factor[4]; /* of x0, x3, x6, x1 */
    } table[] = {{"derivative: 1, differences: [x0, x3]", 1, {-1, 1, 0, 0}},
                 {"derivative: 1, from: x0, to: x3", 1, {-1, 1, 0, 0}},
                 {"derivative: 2, differences: [x0, x3, x6]", 2, {1, -2, 1, 0}},
                 {"derivative: 3, differences: [x0, x3, x6, x1], scale: 2", 3, {-1, 3, -3, 1}},
                 {"derivative: 3, from: x6, to: x1", 3, {0, 0, -1, 1}},
                 {"derivative: 2, field: x6", 2, {0, 0, 1, 0}}};
    static const char *const name[] = {"x0", "x3", "x6", "x1"};
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        char text[4000];
        snprintf(text, sizeof text,
                 HEAD
                 "patches: {w: {operator: {power: 2}, conditions: [{u: 0, position: x0}, {u: 0, derivative: "
                 "1, field: d0}, {u: 0.25, %s}, {u: 1, position: x1}]}}\n",
                 table[k].text);
        bed b = bed_with(text, NULL, 8, 8);
        const ves_condition *c = &b.problem->patch[0].condition[2];
        cr_expect(c->u == 0.25 && c->derivative == table[k].derivative);
        cr_expect_eq(c->scale >= 0, strstr(table[k].text, "scale") != NULL);
        double sum[4] = {0};
        for (int s = 0; s < c->shares; s++)
            for (int i = 0; i < 4; i++)
                if (!strcmp(b.problem->curve[c->share[s].curve].name, name[i])) sum[i] += c->share[s].factor;
        for (int i = 0; i < 4; i++)
            cr_expect_eq(sum[i], table[k].factor[i], "%s: %s has %g", table[k].text, name[i], sum[i]);
        bed_clear(&b);
    }
}

#define BOWL(head, operator)                                                                                 \
    "vesica: 1\n" head                                                                                       \
    "curves: {p: {bspline: {points: [[1, 0, 0], [0, 1.2, 0.1], [-1, 0, 0], [0, -1, 0]]}}, "                  \
    "q: {circle: {radius: 0.6, centre: [0, 0.1, 1.5]}}, m: {like: p, apply: [{dilate: 1.2}, {translate: "    \
    "[0, 0, "                                                                                                \
    "0.5]}]}}\n"                                                                                             \
    "patches:\n  w:\n    operator: "                                                                         \
    operator"\n    conditions: [{u: 0, position: p}, {u: 1, position: q}, {u: 0.4, position: m}, {u: 0, "    \
            "derivative: 2, "                                                                                \
            "differences: [p, m, q], scale: 1.5}]\n    modes: 3\nminimize: area\n"

/* Central differences of the objective. */
static void expect_gradient(const bed *b, const double *at)
{
    int n = b->problem->variables;
    double gradient[8], x[8];
    ves_verdict verdict = {.gradient = gradient};
    ves_ask ask = {.x = at, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
    cr_assert_eq(ves_plan_evaluate(b->plan, &ask, &verdict), VES_OK);
    cr_assert_eq(verdict.status, VES_OK, "%s", ves_status_text(verdict.status));
    for (int k = 0; k < n; k++) {
        const double h = 1e-5;
        memcpy(x, at, sizeof *x * (size_t)n);
        x[k] = at[k] + h;
        double up = value_at(b, x);
        x[k] = at[k] - h;
        double want = (up - value_at(b, x)) / (2 * h);
        cr_expect(fabs(gradient[k] - want) < 1e-8 * fmax(1, fabs(want)), "variable %d: got %.12g, want %.12g",
                  k, gradient[k], want);
    }
}

Test(patches, gradients_go_through_coefficients)
{
    bed b =
        bed_with(BOWL("variables: {c: [0.1, 1.3, 2], d: [0.1, 0.6, 2]}\n", "{coefficients: [1, c, 'c*d']}"),
                 NULL, 12, 24);
    expect_gradient(&b, (double[]){1.3, 0.6});
    bed_clear(&b);
    b = bed_with(BOWL("variables: {c: [0.1, 1.3, 2], d: [0.1, 0.6, 2]}\n",
                      "{x: [1, c, d], y: [d, 1, 1.5], z: [1, 2, c]}"),
                 NULL, 12, 24);
    expect_gradient(&b, (double[]){1.1, 0.8});
    bed_clear(&b);
}

Test(patches, coefficients_that_are_not_elliptic_are_a_verdict_with_its_numbers)
{
    bed b = bed_with(BOWL("variables: {c: [-3, 1.3, 2]}\n", "{x: [1, 2, 1], y: [1, c, 1], z: [1, 2, 1]}"),
                     NULL, 8, 8);
    double x = -2.5, constraint[4];
    char text[1000];
    ves_verdict verdict = {.constraint = constraint};
    ves_ask ask = {.x = &x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    cr_assert_eq(ves_plan_evaluate(b.plan, &ask, &verdict), VES_OK);
    cr_expect_eq(verdict.status, VES_NOT_ELLIPTIC);
    ves_plan_why(b.plan, verdict.status, "here", b.diag);
    ves_diag_text(b.diag, 0, text, sizeof text);
    cr_expect(
        strstr(text,
               "test.yaml:5:3: warning: here: the operator of patch \"w\" for y is not elliptic: "
               "c0 t^2 + c1 t + c2 is -0.556 at t = 1.33; waves would run along u instead of dying out"),
        "%s", text);
    bed_clear(&b);
}

/* --- raised orders, spines, remainders --- */

enum { MANY = 40 };

static void points_of(const char *text, double X[18 * MANY])
{
    double u[MANY], v[MANY];
    bed b = bed_with(text, NULL, 8, 8);
    for (int k = 0; k < MANY; k++) u[k] = k / (MANY - 1.), v[k] = 0.7 * k;
    cr_assert_eq(ves_plan_points(b.plan, 0, MANY, u, v, X), VES_OK);
    bed_clear(&b);
}

/* The largest difference of X, Xu ... Xvv. */
static double apart(const double *X, const double *Y)
{
    double worst = 0;
    for (int k = 0; k < 18 * MANY; k++) worst = fmax(worst, fabs(X[k] - Y[k]));
    return worst;
}

#define VASE(rest)                                                                                           \
    "vesica: 1\ncurves: {p: {bspline: {points: [[1, 0, 0], [0, 1.2, 0.1], [-1, 0, 0], [0, -1, 0]]}}, "       \
    "q: {circle: {radius: 0.6, centre: [0, 0.1, 1.5]}}, f: {circle: {radius: 0.5, centre: [0, 0, 1]}}, "     \
    "nil: {point: [0, 0, 0]}}\n"                                                                             \
    "patches:\n  w:\n    operator: {power: 2, a: 0.8}\n"                                                     \
    "    conditions: [{u: 0, position: p}, {u: 1, position: q}, {u: 0, derivative: 1, field: f}, {u: 1, "    \
    "derivative: 1, field: f}]\n" rest "\nminimize: area\n"

Test(patches, a_raised_order_leaves_the_surface_until_it_departs)
{
    static double low[18 * MANY], same[18 * MANY], away[18 * MANY], further[18 * MANY];
    points_of(VASE(""), low);
    points_of(VASE("    raise: [{u: 0, derivative: 2}, {u: 1, derivative: 2, field: nil}]"), same);
    cr_expect(apart(low, same) < 1e-13, "off by %.2g", apart(low, same));
    points_of(VASE("    modes: 12"), low);
    points_of(VASE("    modes: 12\n    raise: [{u: 0.5, field: nil}, {u: 0.25, derivative: 1}, {u: 0, "
                   "derivative: 3}, {u: 1, "
                   "derivative: 2, from: f, to: f}]"),
              same);
    cr_expect(apart(low, same) < 1e-12, "off by %.2g", apart(low, same));
    points_of(VASE(""), low);
    points_of(VASE("    raise: [{u: 0, derivative: 2, field: f, scale: 0.5}, {u: 1, derivative: 2}]"), away);
    points_of(VASE("    raise: [{u: 0, derivative: 2, differences: [nil, nil, f]}, {u: 1, derivative: 2}]"),
              further);
    double moved = 0, line = 0;
    for (int k = 0; k < 3 * MANY; k++) {
        moved = fmax(moved, fabs(away[k] - low[k]));
        line = fmax(line, fabs(further[k] - low[k] - 2 * (away[k] - low[k])));
    }
    cr_expect(moved > 1e-3 && line < 1e-14, "moved by %g, off a line by %g", moved, line);
    /* d_uu X at u = 0 is that of the lower order and half of f */
    for (int c = 0; c < 3; c++) {
        double f[3] = {0.5, 0, 1}, got = away[(9 + c) * MANY] - low[(9 + c) * MANY];
        cr_expect(fabs(got - 0.5 * f[c]) < 1e-12, "%d: %g", c, got);
    }
}

/* Cubic from the middle of p to that of q with these ends; a B-spline with two inner points is the cubic
 * Bezier curve, whose ends have the derivatives 3 (p1 - p0) and 3 (p3 - p2). */
Test(patches, a_spine_that_is_given_is_the_mean_of_the_surface)
{
    static double solved[18 * MANY], hermite[18 * MANY], bspline[18 * MANY], mapped[18 * MANY];
    points_of(VASE(""), solved);
    points_of(VASE("    spine: {hermite: [[0.3, 0, 1.2], [0, -0.6, 0.9]]}"), hermite);
    points_of(VASE("    spine: {bspline: [[0.1, 1/30, 0.02 + 0.4], [0, 0.3, 1.2]]}"), bspline);
    points_of(VASE("    spine: {bspline: {points: [[0.1, 1/30, 0.02 + 0.4], [0, 0.3, 1.2]]}}"), mapped);
    cr_expect(apart(bspline, mapped) == 0);
    cr_expect(apart(solved, hermite) > 0.01, "a spine of its own");
    for (const char *const *text = (const char *const[]){"hermite: [[0.3, 0, 1.2], [0, -0.6, 0.9]]",
                                                         "bspline: [[0.1, p1, p2], [0, 0.3, 1.2]]", NULL};
         *text; text++) {
        char file[2000];
        double u[3] = {0, 0.5, 1}, A[27];
        snprintf(file, sizeof file, "%sparameters: {p1: 1/30, p2: 0.42}\n", VASE("    spine: {"));
        char *at = strstr(file, "spine: {") + 8, rest[1000];
        snprintf(rest, sizeof rest, "%s", at);
        snprintf(at, sizeof file - (size_t)(at - file), "%s}%s", *text, rest);
        bed b = bed_with(file, NULL, 8, 8);
        cr_assert_eq(ves_plan_spine(b.plan, 0, 3, u, A), VES_OK);
        double p[3] = {A[0], A[3], A[6]}, q[3] = {A[2], A[5], A[8]};
        cr_expect(fabs(q[1] - 0.1) < 1e-15 && fabs(q[2] - 1.5) < 1e-15 && fabs(p[0]) < 1e-15);
        if (!strncmp(*text, "hermite", 7)) {
            double middle = (p[2] + q[2]) / 2 + (1.2 - 0.9) / 8;
            cr_expect(fabs(A[7] - middle) < 1e-15, "z(1/2) = %.17g, want %.17g", A[7], middle);
            cr_expect(fabs(A[9 + 0] - 0.3) < 1e-14 && fabs(A[9 + 5] + 0.6) < 1e-14);
        } else {
            double middle = (p[2] + 3 * 0.42 + 3 * 1.2 + q[2]) / 8;
            cr_expect(fabs(A[7] - middle) < 1e-15, "z(1/2) = %.17g, want %.17g", A[7], middle);
        }
        bed_clear(&b);
    }
}

Test(patches, modes_of_a_remainder_are_those_of_the_patch_and_auto_is_the_first_that_is_not_solved)
{
    static double by_patch[18 * MANY], by_rest[18 * MANY], given[18 * MANY], other[18 * MANY];
    points_of(VASE("    modes: 3"), by_patch);
    points_of(VASE("    remainder: {modes: 3}"), by_rest);
    points_of(VASE("    remainder: {modes: 3, omega: 0.8*4}"), given);
    points_of(VASE("    remainder: {modes: 3, omega: 9}"), other);
    cr_expect(apart(by_patch, by_rest) == 0);
    cr_expect(apart(by_patch, given) < 1e-12, "off by %g", apart(by_patch, given));
    cr_expect(apart(by_patch, other) > 1e-4);
    for (int c = 0; c < 3; c++) /* the ends are met all the same */
        cr_expect(fabs(by_patch[c * MANY] - other[c * MANY]) < 1e-14);
}

Test(patches, gradients_go_through_spines_raised_orders_and_omega)
{
    static const char *const text[] = {
        VASE(
            "    spine: {hermite: [[g, 0, 1.2], [0, -0.6, h]]}\nvariables: {g: [0, 0.3, 1], h: [0, 0.9, 2]}"),
        VASE("    spine: {bspline: [[0.1, g, 0.3], [0, 0.3, h], [0, 0, 1.2]]}\nvariables: {g: [0, 0.3, 1], "
             "h: [0, 0.9, 2]}"),
        VASE("    raise: [{u: 0, derivative: 2, field: f, scale: g}, {u: 0.5, field: f, scale: h - "
             "0.9}]\nvariables: {g: [0, 0.3, 1], h: [0, 0.9, 2]}"),
        VASE("    remainder: {modes: 2, omega: 3*h + g}\nvariables: {g: [0, 0.3, 1], h: [0, 0.9, 2]}")};
    for (size_t k = 0; k < sizeof text / sizeof *text; k++) {
        bed b = bed_with(text[k], NULL, 12, 24);
        expect_gradient(&b, (double[]){0.35, 0.8});
        bed_clear(&b);
    }
}

/* --- what conditions inside do --- */

/* Eight wavy sections of a tube at u[i]. */
static bed tube_of(const char *operator, const double u[8], const char *rest)
{
    char text[8000];
    int at = snprintf(text, sizeof text, "vesica: 1\ncurves:\n");
    for (int i = 0; i < 8; i++)
        at += snprintf(text + at, sizeof text - (size_t)at,
                       "  c%d: {bspline: {points: [[1, 0, %.17g], [0, %.17g, %.17g], [-1, 0, %.17g], [0, -1, "
                       "%.17g]]}}\n",
                       i, u[i], 1 + 0.2 * sin(5 * u[i]), u[i], u[i], u[i]);
    at += snprintf(text + at, sizeof text - (size_t)at,
                   "patches:\n  w:\n    operator: %s\n    conditions:\n", operator);
    for (int i = 0; i < 8; i++)
        at += snprintf(text + at, sizeof text - (size_t)at, "      - {u: %.17g, position: c%d}\n", u[i], i);
    snprintf(text + at, sizeof text - (size_t)at, "%s\n", rest);
    return bed_with(text, NULL, 8, 8);
}

static bed tube(const double u[8], const char *rest)
{
    return tube_of("{power: 4}", u, rest);
}

static void expect_warning(const bed *b, const char *want)
{
    char text[2000] = "";
    cr_expect_eq(ves_diag_count(b->diag), want != NULL);
    if (ves_diag_count(b->diag)) ves_diag_text(b->diag, 0, text, sizeof text);
    cr_expect(want == NULL || strstr(text, want) != NULL, "got %s\nwant %s", text, want);
}

/* The amplification of equispaced positions of order 8 and of Chebyshev's, by 60-digit arithmetic: 6.7 and 2.2 at
 * lam = 0, 230 and 9 at lam = 20, 9e3 and 260 at lam = 30. */
Test(patches, conditions_inside_tell_what_they_amplify)
{
    double even[8], node[8];
    for (int i = 0; i < 8; i++) even[i] = i / 7., node[i] = (1 - cos(acos(-1) * i / 7)) / 2;
    node[7] = 1;
    bed b = tube(even, "");
    ves_patch_facts f = ves_plan_patch(b.plan, 0);
    cr_expect(f.order == 8 && f.inside && f.modes == 24 && f.omega == 25, "%d %d %g", f.order, f.modes,
              f.omega);
    cr_expect(f.amplification[0] > 6.6 && f.amplification[0] < 7, "%g", f.amplification[0]);
    cr_expect(f.amplification[1] > 230 && f.amplification[1] < 1000, "%g", f.amplification[1]);
    cr_expect(f.condition[0] > 1 && f.condition[0] < 1000 && f.condition[1] > 1);
    expect_warning(&b, NULL);
    bed_clear(&b);
    b = tube(even, "    remainder: {modes: 40}");
    cr_expect(ves_plan_patch(b.plan, 0).modes == 40);
    expect_warning(
        &b, "patch \"w\": its conditions make of mode 25 of their curves 1.3e+03 times as much, of mode 40 "
            "4.8e+05 times: digits are lost, and fine detail swamps the surface; solve fewer modes, "
            "remainder: {modes: 24}, or place them nearer to the ends, as Chebyshev's nodes are, u = (1 - "
            "cos(pi*i/7))/2 for i = 0 to 7 (nodes: chebyshev of sections)");
    bed_clear(&b);
    b = tube(node, "");
    f = ves_plan_patch(b.plan, 0);
    cr_expect(f.amplification[0] > 2.1 && f.amplification[0] < 2.3 && f.modes == 33, "%g, %d",
              f.amplification[0], f.modes);
    bed_clear(&b);
    b = tube(node, "    remainder: {modes: 34, omega: 30}");
    expect_warning(
        &b, "its conditions make of mode 34 of their curves 1.1e+03 times as much: digits are lost, and fine "
            "detail swamps the surface; solve fewer modes, remainder: {modes: 33}, or place them nearer to "
            "the ends\n");
    cr_expect(ves_plan_patch(b.plan, 0).omega == 30);
    bed_clear(&b);
}

Test(patches, facts_of_patches_without_conditions_inside)
{
    bed b = bed_with(VASE("    raise: [{u: 0, derivative: 2}, {u: 1, derivative: 2}]"), NULL, 8, 8);
    ves_patch_facts f = ves_plan_patch(b.plan, 0);
    cr_expect(f.order == 6 && f.inside == false && f.amplification[0] == 0 && f.modes == 40, "%d", f.modes);
    cr_expect(f.omega == 0.8 * 41, "%g", f.omega);
    bed_clear(&b);
    b = bed_with("vesica: 1\npatches: {w: {surface: {formula: [u, v, \"u*v\"]}, periodic: false}}\n", NULL, 8,
                 8);
    cr_expect(ves_plan_patch(b.plan, 0).order == 0);
    bed_clear(&b);
}

#define LEANING(raised)                                                                                      \
    "vesica: 1\ncurves: {p: {bspline: {points: [[1, 0, 0], [0, 1.2, 0.1], [-1, 0, 0], [0, -1, 0]]}}, "       \
    "q: {circle: {radius: 0.6, centre: [0, 0.1, 1.5]}}, f: {circle: {radius: 0.5, centre: [0, 0, 1]}}}\n"    \
    "patches: {w: {operator: {power: 2, a: 0.8}, conditions: [{u: 0, position: p}, {u: 0, derivative: 1, "   \
    "field: f}, {u: 0, derivative: 2, field: f}, {u: 1, position: q}]" raised "}}\nminimize: area\n"

/* Three conditions at one end and one at the other are amplified. Two more at the other end make it an order that is
 * not, but the surface is that of the lower one still, with as many modes. */
Test(patches, a_raised_order_is_amplified_as_its_lower_one)
{
    static const char *const text[] = {LEANING(""),
                                       LEANING(", raise: [{u: 1, derivative: 1}, {u: 1, derivative: 2}]")};
    static double X[2][18 * MANY];
    ves_patch_facts f[2];
    for (int k = 0; k < 2; k++) {
        bed b = bed_with(text[k], NULL, 8, 8);
        f[k] = ves_plan_patch(b.plan, 0);
        expect_warning(&b, NULL);
        cr_expect(f[k].order == (k ? 6 : 4) && f[k].band == 127, "%d", f[k].order);
        bed_clear(&b);
        points_of(text[k], X[k]);
    }
    cr_expect(f[0].modes > 5 && f[0].modes < 20, "%d", f[0].modes);
    cr_expect(f[1].modes == f[0].modes && f[1].omega == f[0].omega, "%d, %g", f[1].modes, f[1].omega);
    cr_expect(apart(X[0], X[1]) < 1e-12, "off by %.2g", apart(X[0], X[1]));
}

/* Positions are never singular: where they amplify beyond all numbers fewer modes are solved, and the remainder as a
 * lower one. */
Test(patches, modes_that_conditions_inside_make_unsolvable_are_left_to_a_remainder_that_is_not)
{
    static const struct {
        const char *operator;
        int modes;
        double most; /* of omega, or 0 */
    } row[] = {{"{power: 4, a: 2}", 12, 26},
               {"{power: 4, a: 2000}", 0, 60},
               {"{power: 4, a: 1e4}", 0, 60},
               {"{power: 4, a: 1e6}", 0, 60},
               {"{coefficients: [1, 4e8, 6e16, 4e24, 1e32]}", 0, 0}};
    double even[8];
    for (int i = 0; i < 8; i++) even[i] = i / 7.;
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        char rest[200];
        bed b = tube_of(row[k].operator, even, "");
        ves_patch_facts f = ves_plan_patch(b.plan, 0);
        expect_warning(
            &b, f.modes ? NULL
                        : "patch \"w\": 0 of its 127 modes are solved, the next would be amplified too "
                          "much; 100 % of its curves are left to the remainder");
        snprintf(rest, sizeof rest, "%s", row[k].operator);
        cr_expect(f.modes == row[k].modes && f.rest > 0 && f.rest <= f.modes + 1, "%s: %d, %g", rest, f.modes,
                  f.rest);
        cr_expect(row[k].most == 0 ? isnan(f.omega) : f.omega > 5 && f.omega <= row[k].most, "%s: %g", rest,
                  f.omega);
        double X[18], u = 0.3, v = 1;
        cr_assert_eq(ves_plan_points(b.plan, 0, 1, &u, &v, X), VES_OK);
        cr_expect(fabs(X[0]) < 3 && fabs(X[1]) < 3 && X[2] > 0.2 && X[2] < 0.4, "%s: %g %g %g", rest, X[0],
                  X[1], X[2]);
        bed_clear(&b);
    }
}

Test(patches, a_design_that_cannot_be_solved_is_a_verdict_with_patch_and_mode)
{
    double even[8], x = 9e4, constraint[4];
    char text[1000] = "";
    for (int i = 0; i < 8; i++) even[i] = i / 7.;
    bed b = tube_of("{power: 4, a: k}", even, "variables: {k: [1, 2, 1e5]}\nminimize: area");
    ves_verdict verdict = {.constraint = constraint};
    ves_ask ask = {.x = &x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    cr_assert_eq(ves_plan_evaluate(b.plan, &ask, &verdict), VES_OK);
    cr_expect_eq(verdict.status, VES_UNDETERMINED);
    ves_plan_why(b.plan, verdict.status, "here", b.diag);
    if (ves_diag_count(b.diag)) ves_diag_text(b.diag, ves_diag_count(b.diag) - 1, text, sizeof text);
    cr_expect(
        strstr(
            text,
            "warning: here: patch \"w\" cannot be solved for mode 1: its conditions make about e^(lam u_N) "
            "= e^3.86e+04 times as much of it (u_N = 0.429, how far number 4 stands from its nearer "
            "end); lam = 9e+04 can be 1.59e+03 at most: make a smaller"),
        "%s", text);
    bed_clear(&b);
}

/* Roots r = +-0.005 +-i wave: positions amplify modes 10, 19 .. far more than the modes between. */
Test(patches, modes_are_chosen_below_the_first_that_waves_amplify)
{
    for (const char *const *middle = (const char *const[]){"-1.9999", "-1.99", NULL}; *middle; middle++) {
        char text[2000];
        snprintf(text, sizeof text,
                 "vesica: 1\ncurves:\n"
                 "  p: {bspline: {points: [[1, 0, 0], [0, 1.2, 0.1], [-1, 0, 0], [0, -1, 0]]}}\n"
                 "  q: {like: p, apply: [{translate: [0, 0, 0.3]}]}\n"
                 "  r: {like: p, apply: [{translate: [0, 0, 0.6]}]}\n"
                 "  s: {like: p, apply: [{translate: [0, 0, 1]}]}\n"
                 "patches: {w: {operator: {coefficients: [1, %s, 1]}, conditions: [{u: 0, position: p}, {u: "
                 "0.333, "
                 "position: q}, {u: 0.667, position: r}, {u: 1, position: s}]}}\n",
                 *middle);
        bed b = bed_with(text, NULL, 8, 8);
        ves_patch_facts f = ves_plan_patch(b.plan, 0);
        expect_warning(&b, NULL);
        cr_expect(f.modes == 9 && f.worst == 9 && f.rest == 10 && isnan(f.omega), "%d %d %g", f.modes,
                  f.worst, f.rest);
        cr_expect(f.amplification[2] < 1000 && f.amplification[2] == f.amplification[1]);
        bed_clear(&b);
    }
}

/* X_u at 1/2 - d and 1/2 + d with X at the ends: singular for the mean at d = 1/(2 sqrt 3), docs/errata.md. */
Test(patches, conditions_that_nearly_leave_a_mode_free_are_told)
{
    bed b = bed_with(
        "vesica: 1\ncurves: {p: {circle: {radius: 1}}, q: {circle: {radius: 1, centre: [0, 0, 1]}}, f: "
        "{point: [0, 0, 1]}}\npatches: {w: {operator: {power: 2}, conditions: [{u: 0, position: p}, {u: 1, "
        "position: q}, {u: 0.2113, derivative: 1, field: f}, {u: 0.7887, derivative: 1, field: f}]}}\n",
        NULL, 8, 8);
    expect_warning(
        &b, "patch \"w\": its conditions make of mode 0 of their curves 2.2e+03 times as much: digits are "
            "lost, and fine detail swamps the surface; give the position and all lower derivatives at the "
            "same u, or "
            "give others, in place of X_u at u = 0.2113, X_u at u = 0.7887");
    bed_clear(&b);
}

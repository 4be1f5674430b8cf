/* Families of curves and patches through sections of them: what the surface between Chebyshev sections comes
 * to, up to order 40, the Klein bottle of [Ugail 2011, 4.55-4.57], ends that meet, and gradients. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "bed.h"
#include "surface/figure.h"
#include "vesica/verdict.h"

static const double PI = 3.14159265358979323846;

enum { TEXT = 4000, PLACES = 300, N = 4 };

static bed bed_make(const char *text)
{
    return bed_with(text, NULL, 16, 16);
}

/* Places that follow no grid. */
static void scatter(double *u, double *v)
{
    for (int k = 0; k < PLACES; k++) {
        u[k] = fmod((k + 0.5) * 0.61803398874989484820, 1);
        v[k] = 2 * PI * fmod((k + 0.5) * 0.41421356237309504880, 1);
    }
}

/* Points of the one patch; out[c * PLACES + k]. */
static void points(const bed *b, int patch, const double *u, const double *v, double *out)
{
    static double all[18 * PLACES];
    cr_assert_eq(ves_plan_points(b->plan, patch, PLACES, u, v, all), VES_OK);
    memcpy(out, all, 3 * PLACES * sizeof *out);
}

/* r(w) = 2 + sin(3 w) + e^(w/2)/5 turned round the z axis, 0 <= w <= 2: analytic, and nothing that the
 * equation solves by itself. */
#define VASE                                                                                                 \
    "vesica: 1\nvalidity: {jacobian: any}\ncurves:\n"                                                        \
    "  sec: {family: w, formula: [\"(2 + sin(3*w) + exp(w/2)/5)*cos(v)\", \"(2 + sin(3*w) + "                \
    "exp(w/2)/5)*sin(v)\", \"w\"]}\npatches:\n"

static double vase_error(const char *patch)
{
    char text[2 * TEXT];
    double u[PLACES], v[PLACES], X[3 * PLACES], most = 0;
    snprintf(text, sizeof text, VASE "  vase: %s\n", patch);
    bed b = bed_make(text);
    scatter(u, v);
    points(&b, 0, u, v, X);
    for (int k = 0; k < PLACES; k++) {
        double w = 2 * u[k], r = 2 + sin(3 * w) + exp(w / 2) / 5;
        const double want[3] = {r * cos(v[k]), r * sin(v[k]), w};
        for (int c = 0; c < 3; c++) most = fmax(most, fabs(X[c * PLACES + k] - want[c]));
    }
    bed_clear(&b);
    return most;
}

/* An analytic surface of size 4 is met faster than any power of the number of sections, down to rounding: 4 eps,
 * times the Lebesgue number of 40 Chebyshev nodes, 3.3. */
Test(sections, of_an_analytic_family_come_to_its_surface_with_spectral_accuracy)
{
    static const struct {
        int count;
        double most;
    } bar[] = {{4, 0.3}, {8, 1e-3}, {12, 4e-7}, {16, 5e-11}, {24, 4e-15}, {32, 4e-15}, {40, 4e-15}};
    for (size_t k = 0; k < sizeof bar / sizeof *bar; k++) {
        char patch[TEXT];
        snprintf(patch, sizeof patch, "{sections: {of: sec, w: [0, 2], count: %d}}", bar[k].count);
        double error = vase_error(patch);
        cr_expect(error <= bar[k].most, "%d sections: %g, want %g", bar[k].count, error, bar[k].most);
    }
}

/* Equal spacing costs the Lebesgue number of 40 such nodes, 2.4e9 [docs/errata.md, Fig. 4.5]; ten are as good as
 * Chebyshev's but for a factor. */
Test(sections, equally_spaced_swing)
{
    double ten = vase_error("{sections: {of: sec, w: [0, 2], count: 10, nodes: equal}}"),
           forty = vase_error("{sections: {of: sec, w: [0, 2], count: 40, nodes: equal}}");
    cr_expect(ten < 1e-3 && ten > 1e-7, "ten: %g", ten);
    cr_expect(forty > 1e-12 && forty < 4 * 2.4e9 * 2.2e-16, "forty: %g", forty);
}

/* The operator may be given with `a` alone, with the power that follows anyway, or with coefficients. */
Test(sections, take_the_operator_that_is_given)
{
    static const char *const operator[] = {"{a: 0.7}", "{power: 6, a: 0.7}", "{power: 6}", ""};
    double error[4];
    for (int k = 0; k < 4; k++) {
        char patch[TEXT];
        snprintf(patch, sizeof patch, "{sections: {of: sec, w: [0, 2], count: 12}%s%s}",
                 *operator[k] ? ", operator: " : "", operator[k]);
        error[k] = vase_error(patch);
        cr_expect(error[k] < 1e-6, "%s: %g", operator[k], error[k]);
    }
    cr_expect(error[0] == error[1] && error[2] == error[3] && error[0] != error[2]);
}

/* Sections and conditions together: X_u = X_w dw/du at both ends of a torus's tube makes it smooth there. */
Test(sections, and_conditions_count_together)
{
    static const char text[] = "vesica: 1\ncurves:\n"
                               "  sec: {family: w, formula: [\"w*cos(v)\", \"w*sin(v)\", \"w^3\"]}\n"
                               "  slope: {formula: [\"cos(v)\", \"sin(v)\", \"0.75\"]}\npatches:\n"
                               "  bowl: {sections: {of: sec, w: [0.5, 1.5], count: 3, nodes: equal}, "
                               "conditions: [{u: 0, derivative: "
                               "1, field: slope}]}\n";
    double u[PLACES], v[PLACES], X[3 * PLACES];
    bed b = bed_make(text);
    cr_assert_eq(b.problem->patch[0].power, 2);
    scatter(u, v);
    points(&b, 0, u, v, X);
    for (int k = 0; k < PLACES; k++) /* z has mode 0 alone: a cubic in u, met exactly */
        cr_expect(fabs(X[2 * PLACES + k] - pow(0.5 + u[k], 3)) < 1e-14);
    bed_clear(&b);
}

/* --- the Klein bottle --- */

#define KLEIN                                                                                                \
    "vesica: 1\ncurves:\n  sec:\n    family: w\n    formula:\n"                                              \
    "      - 6*cos(w)*(1 + sin(w)) + 4*(1 - cos(w)/2)*if(w < pi, cos(w)*cos(v), cos(v + pi))\n"              \
    "      - 16*sin(w) + if(w < pi, 4*(1 - cos(w)/2)*sin(w)*cos(v), 0)\n"                                    \
    "      - 4*(1 - cos(w)/2)*sin(v)\npatches:\n"                                                            \
    "  bottle: {sections: {of: sec, w: [0, 2*pi], count: 40%s}, modes: 6}\nvalidity: {jacobian: any}\n%s"

/* [Ugail 2011, eqs 4.55-4.57] */
static void klein(double w, double v, double out[3])
{
    bool bottle = w < PI;
    double gamma = 4 * (1 - cos(w) / 2);
    out[0] = 6 * cos(w) * (1 + sin(w)) + gamma * (bottle ? cos(w) * cos(v) : cos(v + PI));
    out[1] = 16 * sin(w) + (bottle ? gamma * sin(w) * cos(v) : 0);
    out[2] = gamma * sin(v);
}

/* Errors as in docs/errata.md, Fig. 4.5, where they were found with 60 digits: y has a kink at w = pi, at which
 * 40 nodes overshoot by 0.24, x one of its second derivative, 4e-3; the spine is analytic. Printed digits. */
Test(sections, of_the_klein_bottle_have_the_errors_of_the_errata)
{
    enum { ALONG = 401 };
    static double u[ALONG], v[ALONG], X[18 * ALONG], A[9 * ALONG];
    char text[TEXT];
    double most[3] = {0}, spine = 0;
    snprintf(text, sizeof text, KLEIN, "", "");
    bed b = bed_make(text);
    for (int round = 0; round < 8; round++) {
        for (int k = 0; k < ALONG; k++) u[k] = k / (ALONG - 1.0), v[k] = PI * round / 4;
        cr_assert_eq(ves_plan_points(b.plan, 0, ALONG, u, v, X), VES_OK);
        for (int k = 0; k < ALONG; k++) {
            double want[3];
            klein(2 * PI * u[k], v[k], want);
            for (int c = 0; c < 3; c++) most[c] = fmax(most[c], fabs(X[c * ALONG + k] - want[c]));
        }
    }
    cr_assert_eq(ves_plan_spine(b.plan, 0, ALONG, u, A), VES_OK);
    for (int k = 0; k < ALONG; k++) {
        double w = 2 * PI * u[k], want[3] = {6 * cos(w) * (1 + sin(w)), 16 * sin(w), 0};
        for (int c = 0; c < 3; c++) spine = fmax(spine, fabs(A[c * ALONG + k] - want[c]));
    }
    cr_expect(most[1] > 0.235 && most[1] < 0.245, "y: %g", most[1]);
    cr_expect(most[0] > 3.5e-3 && most[0] < 4.5e-3, "x: %g", most[0]);
    cr_expect(most[2] < 2e-13, "z: %g", most[2]);                  /* trigonometric in w: analytic too */
    cr_expect(spine < 16 * 3.3 * 2.2e-16 * 4, "spine: %g", spine); /* size, Lebesgue number, rounding */
    bed_clear(&b);
}

/* (2 pi, v) ~ (0, pi - v), as corrected there: the surface has one side, and its mesh is left open. */
Test(sections, whose_ends_meet_the_other_way_round_make_a_surface_with_one_side)
{
    char text[TEXT], message[TEXT] = "";
    ves_figure *figure;
    ves_mesh mesh;
    snprintf(text, sizeof text, KLEIN, "", "");
    bed b = bed_make(text);
    cr_assert_eq(ves_diag_count(b.diag), 1);
    ves_diag_text(b.diag, 0, message, sizeof message);
    cr_expect(strstr(message, "has one side only") != NULL, "%s", message);
    cr_assert_eq(ves_plan_figure(b.plan, NULL, 48, 32, &figure, b.diag), VES_OK);
    cr_expect(figure->patch[0].one_sided && figure->patch[0].ends_meet);
    cr_assert_eq(ves_figure_mesh(figure, true, &mesh), VES_OK);
    cr_expect_eq(mesh.vertices, 49 * 32, "%d", mesh.vertices);
    ves_figure_destroy(figure);
    bed_clear(&b);
}

/* --- ends that meet --- */

/* The only number that is measured. */
static double measured(const bed *b)
{
    ves_design design;
    cr_assert_eq(ves_plan_measure(b->plan, NULL, 0, &design), VES_OK);
    return design.measure[0];
}

/* A torus, R = 2, r = 0.7, through sections whose first and last lie on each other, turned against each other by
 * 0.3 w: closed, and its volume 2 pi^2 R r^2 to what 40 sections of a circle in w leave, rounding; 64 x 16 nodes
 * integrate e^{i w} and its squares, and the product of three modes of v, to rounding. */
Test(sections, that_come_back_to_where_they_began_close_the_shape)
{
    bed b =
        bed_with("vesica: 1\nshape: {closed: true}\ncurves:\n"
                 "  sec: {family: t, formula: [\"(2 + 0.7*cos(v + 0.3*t))*cos(t)\", \"(2 + 0.7*cos(v + "
                 "0.3*t))*sin(t)\", \"0.7*sin(v + 0.3*t)\"]}\n"
                 "patches: {ring: {sections: {of: sec, w: [0, 2*pi], count: 40}}}\nexpect: [volume > 0]\n",
                 NULL, 64, 16);
    double want = 2 * PI * PI * 2 * 0.49, got = measured(&b);
    cr_expect(fabs(got - want) < 1e-13 * want, "%.17g, want %.17g", got, want);
    bed_clear(&b);
}

/* Patches that end on one section of a family, given by the same number (the other end may vary) or, where it varies, by the same
 * formula, end on one curve; and so do patches that name it. Closed shapes, or the plan would refuse them. A barrel of
 * r = 1 + 0.2 w (2 - w), 0 <= w <= 2, flat lids: its volume pi * integral of r^2, a polynomial. */
Test(sections, that_patches_share_join_them)
{
    const double BARREL = 2 + 4 * 0.2 * 2 / 3 + 0.04 * 16 / 15;
    static const char *const text[] = {
        "patches:\n  a: {sections: {of: sec, w: [0, 0.5 + 0.3], count: 4}}\n"
        "  b: {sections: {of: sec, w: [0.8, 2], count: 6}}\n",
        "patches:\n  a: {sections: {of: sec, w: [0*q, 0.5 + 0.3], count: 4}}\n"
        "  b: {sections: {of: sec, w: [0.8, 2], count: 6}}\n",
        "patches:\n  a: {sections: {of: sec, w: [0, q], count: 4}}\n"
        "  b: {sections: {of: sec, w: [q, 2], count: 6}}\n",
        "  s0: {formula: [cos(v), sin(v), \"0\"]}\n  s1: {formula: [1.192*cos(v), 1.192*sin(v), \"0.8\"]}\n"
        "patches:\n  a: {sections: {curves: [s0, s1]}, operator: {a: 0}}\n"
        "  b: {sections: {curves: [s1, s0]}, operator: {a: 0}}\n"};
    const double want[] = {BARREL, BARREL, BARREL, 0};
    for (int k = 0; k < 4; k++) {
        char whole[TEXT];
        snprintf(
            whole, sizeof whole,
            "vesica: 1\nvariables: {q: [0.5, 0.8, 1]}\nshape: {closed: true%s}\nmeasures: {z: {centroid: "
            "{along: [0, 0, 1]}}}\nminimize: %s\ncurves:\n  sec: {family: w, formula: [\"(1 + 0.2*w*(2 - "
            "w))*cos(v)\", \"(1 + 0.2*w*(2 - w))*sin(v)\", \"w\"]}\n%s",
            k < 3 ? ", caps: [a.u0, b.u1]" : "", k < 3 ? "volume + 0*q" : "area + q", text[k]);
        ves_problem *problem = NULL;
        ves_plan *plan = NULL;
        ves_diag *diag = ves_diag_create();
        char message[TEXT] = "";
        ves_status status = ves_problem_read_text("t", whole, strlen(whole), NULL, &problem, diag);
        if (status == VES_OK) status = ves_plan_create(problem, &(ves_plan_options){{32, 8}}, &plan, diag);
        if (ves_diag_count(diag)) ves_diag_text(diag, 0, message, sizeof message);
        if (k == 3) { /* there and back: closed, and nothing inside */
            cr_expect(status == VES_OK, "%s", message);
        } else {
            ves_design design;
            double x = 0.8;
            cr_assert_eq(status, VES_OK, "%s", message);
            cr_assert_eq(ves_plan_measure(plan, &x, 0, &design), VES_OK);
            /* 4 sections of a parabola times cos v leave 1e-3 of it */
            cr_expect(fabs(design.objective - PI * want[k]) < 1e-3, "%g, want %g", design.objective,
                      PI * want[k]);
        }
        ves_plan_destroy(plan);
        ves_problem_destroy(problem);
        ves_diag_destroy(diag);
    }
}

/* --- gradients --- */

static double judge(const bed *b, const double *x, double *gradient)
{
    ves_verdict verdict = {.gradient = gradient};
    ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = gradient ? VES_WANT_GRADIENT : VES_WANT_VALUE};
    cr_assert_eq(ves_plan_evaluate(b->plan, &ask, &verdict), VES_OK);
    cr_assert_eq(verdict.status, VES_OK, "%s", ves_status_text(verdict.status));
    return verdict.value;
}

/* Of all that a family reads: variables and parameters in its formula, in its moves, and in the range of its
 * number; a as well. Fourth-order differences, bar as in tests/plan.c. */
Test(sections, have_exact_gradients)
{
    bed b =
        bed_make("vesica: 1\nvariables: {p: [0.5, 1, 2], q: [-1, 0.2, 1], t: [1, 1.7, 3], a: [0.1, 0.8, 2]}\n"
                 "parameters: {pq: p + q/3}\ncurves:\n"
                 "  sec: {family: w, formula: [\"(2 + pq*sin(w))*cos(v)\", \"(2 + sin(w + p))*sin(v)\", \"w "
                 "+ 0.1*q*cos(v)\"], apply: [{translate: [q, 0, 0]}, {dilate: 1 + q/10}]}\n"
                 "patches:\n  wall: {sections: {of: sec, w: [q/2, t], count: 6}, operator: {a: a}}\n"
                 "minimize: bending + area\n");
    double x[N] = {1, 0.2, 1.7, 0.8}, g[N], h = 1e-3, value = judge(&b, x, g);
    for (int k = 0; k < N; k++) {
        static const double at[4] = {-2, -1, 1, 2}, weight[4] = {1, -8, 8, -1};
        double keep = x[k], want = 0;
        for (int s = 0; s < 4; s++) {
            x[k] = keep + at[s] * h;
            want += weight[s] * judge(&b, x, NULL) / (12 * h);
        }
        x[k] = keep;
        cr_expect(fabs(g[k] - want) <= 1e-7 * (1 + fabs(want) + fabs(value)),
                  "%d: got %.12g, differences %.12g", k, g[k], want);
    }
    bed_clear(&b);
}

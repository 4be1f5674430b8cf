/* Verdicts: what the plan says of candidates that are odd in some way, and of the grids that it chooses. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bed.h"
#include "measure/registry.h"
#include "problem/problem.h"
#include "vesica/plan.h"

static bed bed_make(const char *text, const ves_measure *const *plugin)
{
    return bed_with(text, plugin, 0, 0);
}

static ves_verdict judged(const bed *b, const double *x, unsigned want, double cutoff, double *arrays)
{
    ves_verdict verdict = {
        .value = 55, .violation = 123, .constraint = arrays, .gradient = arrays + 8, .jacobian = arrays + 16};
    ves_ask ask = {.x = x, .cutoff = cutoff, .want = want};
    cr_assert_eq(ves_plan_evaluate(b->plan, &ask, &verdict), VES_OK);
    return verdict;
}

#define CONE(head, rest)                                                                                     \
    "vesica: 1\n" head "curves: {p: {circle: {radius: 1}}, q: {circle: {radius: r, centre: [0, 0, 1.5]}}}\n" \
    "patches: {wall: {operator: {power: 1, a: 1.1}, conditions: [{u: 0, position: p}, {u: 1, position: "     \
    "q}]}}\n" rest

/* --- measures of a plugin --- */

/* The integral of |Xuu|^2 + Xuv . Xvv: area and all second derivatives, but no curvature. */
static ves_status stretch_eval(const ves_measure_input *in, double *value)
{
    const ves_samples *s = in->sample[0];
    *value = 0;
    for (int k = 0; k < s->count; k++)
        for (int c = 0; c < 3; c++)
            *value += (s->Xuu[c][k] * s->Xuu[c][k] + s->Xuv[c][k] * s->Xvv[c][k]) * s->dA[k];
    return VES_OK;
}

static void stretch_gradient(const ves_measure_input *in, double seed, const ves_adjoint *const *adjoint,
                             double *number)
{
    (void)number;
    const ves_samples *s = in->sample[0];
    for (int k = 0; k < s->count; k++)
        for (int c = 0; c < 3; c++) {
            adjoint[0]->Xuu[c][k] += seed * 2 * s->Xuu[c][k] * s->dA[k];
            adjoint[0]->Xuv[c][k] += seed * s->Xvv[c][k] * s->dA[k];
            adjoint[0]->Xvv[c][k] += seed * s->Xuv[c][k] * s->dA[k];
            adjoint[0]->dA[k] += seed * (s->Xuu[c][k] * s->Xuu[c][k] + s->Xuv[c][k] * s->Xvv[c][k]);
        }
}

/* Counts its calls: a dear measure that a cheap constraint should spare. */
static int dear_calls;

static ves_status dear_eval(const ves_measure_input *in, double *value)
{
    (void)in;
    dear_calls++;
    *value = 1;
    return VES_OK;
}

static ves_status odd_eval(const ves_measure_input *in, double *value)
{
    (void)in, (void)value;
    return (ves_status)99;
}

/* To cut is the plan's part: it knows the violation that it cuts at. */
static ves_status cutter_eval(const ves_measure_input *in, double *value)
{
    (void)in, (void)value;
    return VES_CUT;
}

/* A value without a slope. */
static ves_status blunt_eval(const ves_measure_input *in, double *value)
{
    (void)in;
    *value = 1;
    return VES_OK;
}

static void blunt_gradient(const ves_measure_input *in, double seed, const ves_adjoint *const *adjoint,
                           double *number)
{
    (void)in, (void)seed, (void)number;
    adjoint[0]->X[0][0] += NAN;
}

static int prepared, released;

static ves_status holder_prepare(const ves_measure_input *in, void **state)
{
    static const double three = 3;
    prepared += 1 + in->level;
    *state = (void *)&three;
    return VES_OK;
}

static void holder_release(void *state)
{
    released += state != NULL;
}

static ves_status holder_eval(const ves_measure_input *in, double *value)
{
    *value = *(const double *)in->state;
    return VES_OK;
}

static const ves_measure STRETCH = {.name = "stretch",
                                    .about = "test",
                                    .unit = "1",
                                    .degree = VES_NO_DEGREE,
                                    .surface = VES_AREA | VES_XUU | VES_XUV | VES_XVV,
                                    .eval = stretch_eval,
                                    .gradient = stretch_gradient};
static const ves_measure DEAR = {
    .name = "dear", .about = "test", .unit = "1", .cost = 1, .surface = VES_X, .eval = dear_eval};
static const ves_measure ODD = {
    .name = "odd", .about = "test", .unit = "1", .surface = VES_X, .eval = odd_eval};
static const ves_measure CUTTER = {
    .name = "cutter", .about = "test", .unit = "1", .surface = VES_X, .eval = cutter_eval};
static const ves_measure BLUNT = {.name = "blunt",
                                  .about = "test",
                                  .unit = "1",
                                  .surface = VES_X,
                                  .eval = blunt_eval,
                                  .gradient = blunt_gradient};
static const ves_measure HOLDER = {.name = "holder",
                                   .about = "test",
                                   .unit = "1",
                                   .surface = VES_X,
                                   .prepare = holder_prepare,
                                   .release = holder_release,
                                   .eval = holder_eval};
static const ves_measure *const PLUGIN[] = {&STRETCH, &DEAR, &ODD, &CUTTER, &BLUNT, &HOLDER, NULL};

/* Fourth-order differences, as in plan.c: 1e-7. */
Test(verdicts, second_derivatives_without_curvature_have_the_right_gradient)
{
    bed b = bed_make(
        CONE("variables: {r: [0.3, 1.4, 2]}\nquadrature: {u: 16, v: 16}\n", "minimize: stretch\n"), PLUGIN);
    double x = 1.4, h = 1e-3, arrays[24], side[4];
    ves_verdict verdict = judged(&b, &x, VES_WANT_GRADIENT, HUGE_VAL, arrays);
    double got = verdict.gradient[0];
    for (int k = 0; k < 4; k++) {
        double at = x + (k < 2 ? k - 2 : k - 1) * h;
        side[k] = judged(&b, &at, VES_WANT_VALUE, HUGE_VAL, arrays).value;
    }
    double want = (side[0] - 8 * side[1] + 8 * side[2] - side[3]) / (12 * h);
    cr_expect(fabs(got - want) < 1e-7 * (1 + fabs(want)), "got %.10g, differences %.10g", got, want);
    bed_clear(&b);
}

Test(verdicts, a_cheap_constraint_spares_the_dear_measure)
{
    bed b = bed_make(CONE("variables: {r: [0.3, 1.4, 2]}\n", "minimize: dear\nconstraints: [area <= 5]\n"),
                     PLUGIN);
    double x = 1.4, arrays[24];
    dear_calls = 0;
    ves_verdict verdict = judged(&b, &x, VES_WANT_VALUE, 1e-3, arrays);
    cr_expect_eq(verdict.status, VES_CUT);
    cr_expect_eq(dear_calls, 0);
    cr_expect(verdict.violation > 0.5 && verdict.violation < 2, "the violation so far: %g",
              verdict.violation);
    cr_expect(isnan(verdict.value));
    judged(&b, &x, VES_WANT_VALUE, HUGE_VAL, arrays);
    cr_expect_eq(dear_calls, 1);
    bed_clear(&b);
}

Test(verdicts, a_foreign_status_is_no_number)
{
    const char *const text[] = {
        CONE("variables: {r: [0.3, 1.4, 2]}\nquadrature: {u: 16, v: 16}\n", "minimize: odd\n"),
        CONE("variables: {r: [0.3, 1.4, 2]}\nquadrature: {u: 16, v: 16}\n", "minimize: cutter\n")};
    for (int k = 0; k < 2; k++) {
        bed b = bed_make(text[k], PLUGIN);
        double x = 1.4, arrays[24];
        ves_verdict verdict = judged(&b, &x, VES_WANT_VALUE, HUGE_VAL, arrays);
        cr_expect(verdict.status == VES_NO_NUMBER && verdict.violation == HUGE_VAL, "case %d: %s, %g", k,
                  ves_status_text(verdict.status), verdict.violation);
        bed_clear(&b);
    }
}

Test(verdicts, a_slope_that_is_no_number_is_noticed_in_objective_and_constraints)
{
    const char *const text[] = {
        CONE("variables: {r: [0.3, 1.4, 2]}\nquadrature: {u: 16, v: 16}\n", "minimize: blunt\n"),
        CONE("variables: {r: [0.3, 1.4, 2]}\nquadrature: {u: 16, v: 16}\n",
             "minimize: area\nconstraints: [area <= 99, blunt <= 2]\n")};
    for (int k = 0; k < 2; k++) {
        bed b = bed_make(text[k], PLUGIN);
        double x = 1.4, arrays[24];
        cr_expect_eq(judged(&b, &x, VES_WANT_VALUE, HUGE_VAL, arrays).status, VES_OK);
        cr_expect_eq(judged(&b, &x, VES_WANT_GRADIENT, HUGE_VAL, arrays).status, VES_NO_NUMBER, "case %d", k);
        bed_clear(&b);
    }
}

/* The disc has infinite tangents at its middle, where the looks of depth stand: nothing depends on them. */
Test(verdicts, infinite_tangents_that_nothing_reads_do_not_spoil_the_gradient_of_a_scaled_shape)
{
    bed b = bed_make(
        "vesica: 1\nvariables: {r: [0.5, 1, 2], k: [0.1, 0.3, 1]}\nquadrature: {u: 16, v: 24}\n"
        "patches: {disc: {surface: {formula: [\"r*sqrt(u)*cos(v)\", \"r*sqrt(u)*sin(v)\", \"k*u\"]}}}\n"
        "scale: {equation: area == 9}\nminimize: area\nconstraints: [depth <= 0.3]\n",
        NULL);
    double x[2] = {1, 0.3}, arrays[24], side[2][2];
    judged(&b, x, VES_WANT_GRADIENT, HUGE_VAL, arrays);
    double got[2] = {arrays[16], arrays[17]}, h = 1e-5;
    for (int k = 0; k < 2; k++) {
        for (int s = 0; s < 2; s++) {
            double at[2] = {x[0], x[1]};
            at[k] += s ? h : -h;
            cr_assert_eq(judged(&b, at, VES_WANT_VALUE, HUGE_VAL, arrays).status, VES_OK);
            side[k][s] = arrays[0];
        }
        double want = (side[k][1] - side[k][0]) / (2 * h);
        /* differences: truncation h^2, rounding 1e-15 / h */
        cr_expect(fabs(got[k] - want) < 1e-8 * (1 + fabs(want)), "got %.10g, differences %.10g", got[k],
                  want);
    }
    bed_clear(&b);
}

Test(verdicts, a_measure_may_hold_a_state_for_each_plan_and_level)
{
    prepared = released = 0;
    bed b = bed_make(
        CONE("variables: {r: [0.3, 1.4, 2]}\nquadrature: {u: 16, v: 16}\n", "minimize: holder\n"), PLUGIN);
    double x = 1.4, arrays[24];
    cr_expect_eq(judged(&b, &x, VES_WANT_VALUE, HUGE_VAL, arrays).value, 3);
    cr_expect_eq(prepared, 1 + 2);
    bed_clear(&b);
    cr_expect_eq(released, 2);
}

/* --- verdicts --- */

/* (area - A0)^2 is 0 at its best: the two grids agree in the area, and that is what counts. */
Test(verdicts, an_objective_that_vanishes_can_be_proved)
{
    bed b = bed_make(
        CONE("variables: {r: [0.3, 1.4, 2]}\nquadrature: {u: 16, v: 16}\n", "minimize: (area - 13)^2\n"),
        NULL);
    double arrays[24], low = 0.3, high = 2;
    for (int k = 0; k < 60; k++) { /* the root, by bisection on the sign of the slope */
        double x = (low + high) / 2;
        judged(&b, &x, VES_WANT_GRADIENT, HUGE_VAL, arrays);
        if (arrays[8] < 0)
            low = x;
        else
            high = x;
    }
    ves_verdict verdict = judged(&b, &low, VES_WANT_PROOF | VES_WANT_GRADIENT, HUGE_VAL, arrays);
    cr_expect_eq(verdict.status, VES_OK, "%s", ves_status_text(verdict.status));
    /* the root of the slope to an ulp of the area: squares of 1e-14, slopes of twice that; 3e-14 was seen */
    cr_expect(verdict.value < 1e-20 && fabs(verdict.gradient[0]) < 1e-12,
              "a proof may ask for gradients too");
    bed_clear(&b);
}

/* A ripple between the nodes. Depth is the same on every grid; what the constraint reads is not. The proof
 * asks for 1 % of the size of a constraint, whatever its own tolerance. */
#define RIPPLE(within)                                                                                       \
    "vesica: 1\nvariables: {q: [1, 3, 40]}\nquadrature: {u: 8, v: 8}\n"                                      \
    "patches: {p: {surface: {formula: [u, v, \"0.02*sin(q*v)\"]}, periodic: false}}\n"                       \
    "validity: {jacobian: any, self_intersection: never}\nmeasures: {b: {willmore: {}}}\nminimize: depth\n"  \
    "constraints: [{require: " within "}]\n"

Test(verdicts, a_proof_compares_violations_in_units_of_their_sizes)
{
    const struct {
        const char *text;
        double q;
        ves_status want;
    } table[] = {
        {RIPPLE("b <= 0.1"), 4, VES_OK},
        {RIPPLE("b <= 0.1"), 4.5, VES_COARSE}, /* 8 % below its limit, 21 % above on the finer grid */
        {RIPPLE("b <= 0.1, within: 0.01"), 4.5, VES_COARSE},
        {RIPPLE("b <= 0.1, within: 1e-11"), 4.5, VES_COARSE},
        {RIPPLE("b <= 0.001588"), 1.5, VES_OK}, /* 0.1 % above on the finer grid */
        {RIPPLE("b <= 0.001588, within: 1e-11"), 1.5, VES_OK},
        {RIPPLE("0.001588 >= b, within: 1"), 1.5, VES_OK}};
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        bed b = bed_make(table[k].text, NULL);
        double arrays[24];
        ves_status got = judged(&b, &table[k].q, VES_WANT_PROOF, HUGE_VAL, arrays).status;
        cr_expect_eq(got, table[k].want, "case %zu: %s", k, ves_status_text(got));
        bed_clear(&b);
    }
}

/* The checks of a file are asked by proofs, on both grids, and by nobody else. */
Test(verdicts, a_check_that_does_not_hold_refuses_a_best)
{
    const struct {
        const char *holds;
        double q;
        ves_status want;
        const char *text;
    } table[] = {{"b <= 0.1", 4, VES_OK, ""},
                 {"b <= 0.1", 4.5, VES_BROKEN, "\"b <= 0.1\", with b = 0.12"}, /* 0.092 on the coarse one */
                 {"b >= 0.1", 4.5, VES_BROKEN, "\"b >= 0.1\", with b = 0.09"},
                 {"b > 0 and q < 4 + 1e-9", 4, VES_OK, ""},
                 {"area > 0, q*b < 4", 4.5, VES_OK, ""},
                 {"area > 0, q < 4", 4.5, VES_BROKEN, "\"q < 4\", with q = 4.5 on the finer grid"},
                 {"sqrt(4 - q) >= 0", 4.5, VES_BROKEN, "with q = 4.5"}};
    char text[1000], why[200] = "";
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        snprintf(text, sizeof text,
                 "vesica: 1\nvariables: {q: [1, 3, 40]}\nquadrature: {u: 8, v: 8}\n"
                 "patches: {p: {surface: {formula: [u, v, \"0.02*sin(q*v)\"]}, periodic: false}}\n"
                 "validity: {jacobian: any, self_intersection: never, holds: [\"%.*s\"%s%s%s]}\n"
                 "measures: {b: {willmore: {}}}\nminimize: depth\n",
                 (int)strcspn(table[k].holds, ","), table[k].holds, strchr(table[k].holds, ',') ? ", \"" : "",
                 strchr(table[k].holds, ',') ? strchr(table[k].holds, ',') + 2 : "",
                 strchr(table[k].holds, ',') ? "\"" : "");
        bed b = bed_make(text, NULL);
        double arrays[24];
        cr_expect_eq(judged(&b, &table[k].q, VES_WANT_VALUE, HUGE_VAL, arrays).status, VES_OK);
        ves_verdict got = judged(&b, &table[k].q, VES_WANT_PROOF, HUGE_VAL, arrays);
        cr_expect_eq(got.status, table[k].want, "case %zu: %s", k, ves_status_text(got.status));
        cr_expect_eq(ves_plan_broken(b.plan, why, sizeof why), table[k].want == VES_BROKEN);
        cr_expect(strstr(why, table[k].text) != NULL, "%s", why);
        cr_expect(got.status == VES_OK || (isnan(got.value) && got.violation == HUGE_VAL));
        bed_clear(&b);
    }
}

Test(verdicts, what_only_checks_read_is_measured_for_proofs_alone)
{
    bed b = bed_make(CONE("variables: {r: [0.3, 1.4, 2]}\nquadrature: {u: 16, v: 16}\n",
                          "minimize: area\nvalidity: {holds: [dear < 2]}\n"),
                     PLUGIN);
    double x = 1.4, arrays[24];
    dear_calls = 0;
    judged(&b, &x, VES_WANT_VALUE, HUGE_VAL, arrays);
    judged(&b, &x, VES_WANT_GRADIENT, HUGE_VAL, arrays); /* it has none: nobody asks */
    cr_expect_eq(dear_calls, 0);
    cr_expect_eq(judged(&b, &x, VES_WANT_PROOF, HUGE_VAL, arrays).status, VES_OK);
    cr_expect_eq(dear_calls, 2);
    bed_clear(&b);
}

/* A search asks for proofs without a cutoff, others may give one. */
Test(verdicts, a_proof_that_is_cut_short_tells_the_violation)
{
    bed b = bed_make(CONE("variables: {r: [0.3, 1, 2]}\nquadrature: {u: 16, v: 16}\n",
                          "minimize: area\nconstraints: [area <= 1]\n"),
                     NULL);
    double x = 1, arrays[24], want = judged(&b, &x, VES_WANT_VALUE, HUGE_VAL, arrays).violation;
    unsigned ask[] = {VES_WANT_VALUE, VES_WANT_PROOF, VES_WANT_PROOF | VES_WANT_GRADIENT};
    for (int k = 0; k < 3; k++) {
        ves_verdict verdict = judged(&b, &x, ask[k], 0.5, arrays);
        cr_expect_eq(verdict.status, VES_CUT);
        /* what 16 nodes leave of an area that 8 would do for */
        cr_expect(isnan(verdict.value) && want > 7 && fabs(verdict.violation - want) < 1e-11 * want,
                  "case %d: %g, %.15g", k, verdict.value, verdict.violation);
    }
    bed_clear(&b);
}

Test(verdicts, no_number_anywhere_is_noticed)
{
    bed b = bed_make("vesica: 1\nvariables: {b: [-1, -0.5, 1]}\nquadrature: {u: 16, v: 16}\n"
                     "patches: {w: {surface: {formula: [\"v\", \"u\", \"sqrt(u - b)\"]}, periodic: "
                     "false}}\nminimize: depth + area\n",
                     NULL);
    double arrays[24], good = -0.5, half = 0.5, all = 2;
    cr_expect_eq(judged(&b, &good, VES_WANT_VALUE, HUGE_VAL, arrays).status, VES_OK);
    cr_expect_eq(judged(&b, &half, VES_WANT_VALUE, HUGE_VAL, arrays).status, VES_NO_POINT);
    cr_expect_eq(judged(&b, &all, VES_WANT_VALUE, HUGE_VAL, arrays).status, VES_NO_POINT);
    bed_clear(&b);
}

Test(verdicts, a_capped_shape_may_not_turn_inside_out)
{
    bed b = bed_make(
        "vesica: 1\nvariables: {h: [-3, 1, 3]}\ncurves: {p: {circle: {radius: 1}}, q: {circle: {radius: 1, "
        "centre: [0, 0, h]}}}\n"
        "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"
        "shape: {closed: true, caps: [w.u0, w.u1]}\nminimize: volume\n",
        NULL);
    double arrays[24], out = 1, in = -1;
    cr_expect_eq(judged(&b, &out, VES_WANT_VALUE, HUGE_VAL, arrays).status, VES_OK);
    cr_expect_eq(judged(&b, &in, VES_WANT_VALUE, HUGE_VAL, arrays).status, VES_INVERTED);
    bed_clear(&b);
}

Test(verdicts, a_smoothing_parameter_below_zero_is_outside)
{
    bed b = bed_make("vesica: 1\nvariables: {b: [-9, 1, 9]}\ncurves: {p: {circle: {radius: 1}}, q: {circle: "
                     "{radius: 1, centre: [0, 0, 1]}}}\n"
                     "patches: {w: {operator: {power: 1, a: \"b + 0\"}, conditions: [{u: 0, position: p}, "
                     "{u: 1, position: q}]}}\nminimize: area\n",
                     NULL);
    double arrays[24], x = -8;
    cr_expect_eq(judged(&b, &x, VES_WANT_VALUE, HUGE_VAL, arrays).status, VES_OUTSIDE);
    bed_clear(&b);
}

/* Every number of a key with a range, through parameters and lists too; what nothing uses may be anything. */
Test(verdicts, a_number_that_leaves_the_range_of_its_key_is_outside)
{
    bed b = bed_make("vesica: 1\nvariables: {r: [0.2, 1.4, 2], s: [-2, 1, 2]}\nparameters: {q: 2*r - 1}\n"
                     "curves:\n"
                     "  p: {circle: {radius: q/2}}\n"
                     "  q: {ellipse: {radii: [1.5, \"r - 0.3\"], centre: [0, 0, 1.5]}}\n"
                     "  idle: {circle: {radius: r - 1}}\n"
                     "patches: {w: {operator: {power: 1, a: 1}, conditions: [{u: 0, position: p}, {u: 1, "
                     "position: q}]}}\n"
                     "measures: {k: {max_curvature: {smooth: s + 1}}}\n"
                     "validity: {least_radius: {value: \"0.15 - 0.1*s\"}}\nminimize: area\n",
                     NULL);
    const struct {
        double x[2];
        ves_status want;
        const char *says;
    } table[] = {
        {{1.4, 1}, VES_OK, NULL},
        {{0.6, 1}, VES_OK, NULL},
        {{0.4, 1}, VES_OUTSIDE, "test.yaml:5:24: warning: here: \"radius\" must be >= 0, got -0.1\n"},
        {{0.25, 1}, VES_OUTSIDE, "test.yaml:5:24"},
        {{1.4, 1.6}, VES_OUTSIDE, "\"value\" must be >= 0, got -0.01\n"},
        {{1.4, -1.5}, VES_OUTSIDE, "\"smooth\" must be >= 0, got -0.5\n"}};
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        double arrays[24];
        char text[1000] = "";
        ves_diag *diag = ves_diag_create();
        ves_diag_source(diag, "test.yaml", "", 0);
        ves_status got = judged(&b, table[k].x, VES_WANT_GRADIENT, HUGE_VAL, arrays).status;
        cr_expect_eq(got, table[k].want, "case %zu: %s", k, ves_status_text(got));
        ves_plan_why(b.plan, got, "here", diag);
        cr_expect_eq(ves_diag_count(diag), table[k].says != NULL, "case %zu", k);
        ves_diag_text(diag, 0, text, sizeof text);
        strcat(text, "\n");
        cr_expect(!table[k].says || strstr(text, table[k].says), "case %zu: %s", k, text);
        ves_diag_destroy(diag);
    }
    bed_clear(&b);
}

/* The sides of a constraint stay those of the scaled shape after a gradient. */
Test(verdicts, constraints_are_told_on_the_scaled_shape)
{
    bed b = bed_make(CONE("variables: {r: [0.3, 1.4, 2]}\nscale: {equation: area == 5}\n",
                          "minimize: bending\nconstraints: [area <= 6]\n"),
                     NULL);
    double x = 1.4, arrays[24];
    ves_design design;
    judged(&b, &x, VES_WANT_GRADIENT, HUGE_VAL, arrays);
    /* scaled exactly: rounding */
    cr_expect(fabs(arrays[0] - (5. - 6) / 6) < 1e-12, "%.15g", arrays[0]);
    cr_assert_eq(ves_plan_measure(b.plan, &x, 0, &design), VES_OK);
    const ves_sides *s = design.side;
    cr_expect(fabs(s->value - 5) < 1e-12 && s->limit == 6 && s->violation == 0 && s->holds, "%.15g",
              s->value);
    bed_clear(&b);
}

Test(verdicts, levels_that_are_not_there_are_refused)
{
    bed b = bed_make(CONE("variables: {r: [0.3, 1.4, 2]}\nquadrature: {u: 16, v: 16}\n", "minimize: area\n"),
                     NULL);
    double x = 1.4;
    ves_design design;
    for (int level = -1; level < 4; level += 3) {
        ves_verdict verdict = {0};
        ves_ask ask = {.x = &x, .level = level, .cutoff = HUGE_VAL};
        cr_expect_eq(ves_plan_evaluate(b.plan, &ask, &verdict), VES_RANGE);
        cr_expect_eq(ves_plan_measure(b.plan, &x, level, &design), VES_RANGE);
    }
    bed_clear(&b);
}

/* --- grids --- */

/* Sixty waves seen by sixteen nodes look slow: the grid must be able to see them before it may be content. */
Test(verdicts, the_chosen_grid_sees_the_modes)
{
    bed b = bed_make("vesica: 1\ncurves: {p: {formula: [\"(1 + 0.02*cos(60*v))*cos(v)\", \"(1 + "
                     "0.02*cos(60*v))*sin(v)\", \"0\"]}, q: {circle: {radius: 1, centre: [0, 0, 1]}}}\n"
                     "patches: {w: {operator: {power: 1, a: 0.1}, conditions: [{u: 0, position: p}, {u: 1, "
                     "position: q}]}}\nexpect: [area > 0]\n",
                     NULL);
    int grid[2];
    double value[2], change = ves_plan_grid(b.plan, grid);
    cr_expect_geq(grid[1], 2 * 61);
    cr_expect_eq(ves_plan_patch(b.plan, 0).modes, 61, "all modes of the data are solved");
    for (int level = 0; level < 2; level++) {
        ves_design design;
        cr_assert_eq(ves_plan_measure(b.plan, NULL, level, &design), VES_OK);
        value[level] = design.measure[0];
    }
    /* twice the modes are seen: an endless spectrum is left, 2e-9 was seen */
    cr_expect(fabs(value[0] - value[1]) < 1e-8 * value[1], "%.12g %.12g", value[0], value[1]);
    cr_expect(change < 1e-6, "%g",
              change); /* the waves' square roots have endless spectra: the largest grid */
    bed_clear(&b);
}

Test(verdicts, a_start_that_cannot_be_measured_does_not_choose_the_grid)
{
    bed b = bed_make(
        "vesica: 1\nvariables: {h: [0, 0, 2]}\ncurves: {p: {formula: [\"(1 + 0.1*cos(11*v))*cos(v)\", \"(1 + "
        "0.1*cos(11*v))*sin(v)\", \"0\"]}, q: {like: p, apply: [{translate: [0, 0, h]}]}}\n"
        "patches: {w: {operator: {power: 1, a: 1}, conditions: [{u: 0, position: p}, {u: 1, position: "
        "q}]}}\nminimize: bending\n",
        NULL);
    int grid[2];
    double change = ves_plan_grid(b.plan, grid), x = 1, arrays[24];
    /* 1e-9 is what ves_plan_grid promises */
    cr_expect(grid[1] >= 32 && change <= 1e-9, "%d x %d, %g", grid[0], grid[1], change);
    cr_expect_eq(judged(&b, &x, VES_WANT_VALUE, HUGE_VAL, arrays).status, VES_OK);
    bed_clear(&b);
}

/* A needle beside the nodes of two grids in a row (64 and 96), seen by the one before and by the first that is too
 * fine to be chosen: two calm steps would be enough, but there were not two. */
Test(verdicts, a_change_that_is_known_is_not_forgotten_after_a_calm_step)
{
    bed b = bed_make(
        "vesica: 1\npatches: {s: {surface: {formula: [u, v, \"0\"]}, periodic: false, domain: {u: [0, 1], v: "
        "[0, 1]}}}\nmeasures: {a: {integral: \"1 + exp(-((u - 0.2940485)/0.0008)^2)\"}}\nexpect: [a > 0]\n",
        NULL);
    int grid[2];
    double change = ves_plan_grid(b.plan, grid);
    cr_expect(grid[0] == 96 && change > 1e-4, "%d nodes along u, change %g", grid[0], change);
    bed_clear(&b);
}

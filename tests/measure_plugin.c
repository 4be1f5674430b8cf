/* The measure of examples/plugin, as its source stands there. */
#include "../examples/plugin/sphericity.c"

#include "problem/problem.h"
#include "samples.h"
#include "study/run.h"

/* Rounding of some thousand terms. */
static const double ROUNDING = 1e-12;

static double of_shape(rig *r, const body *b, bool bottom, double top_side)
{
    rig_surface(r, b, 16, 32);
    if (bottom) rig_ring(r, b, 0, 32, -1);
    if (top_side != 0) rig_ring(r, b, 1, 32, top_side);
    rig_measure_with(r, ves_plugin_entry.measure[0]);
    return rig_eval(r);
}

static double once(const body *b, bool bottom, double top_side)
{
    rig r;
    rig_open(&r);
    double value = of_shape(&r, b, bottom, top_side);
    rig_close(&r);
    return value;
}

static double psi(double V, double A)
{
    return cbrt(36 * 3.14159265358979323846 * V * V) / A;
}

Test(measure_plugin, sphericity_of_ball_torus_cone_and_half_ball)
{
    double R = 2.385, r = 0.731, r1 = 1.129, h = 1.713;
    for (uint64_t seed = 0; seed < 4; seed++) {
        body all[] = {body_init(ellipsoid, 1, R, R, R), body_init(torus, -1, R, r, 0),
                      body_init(frustum, -1, r, r1, h), body_init(half_ball, 1, R, 0, 0)};
        for (int k = 0; seed && k < 4; k++) all[k] = body_moved(all[k], seed);
        near(once(&all[0], false, 0), 1, ROUNDING, "ball");
        near(once(&all[1], false, 0), psi(2 * PI * PI * R * r * r, 4 * PI * PI * R * r), ROUNDING, "torus");
        double area = PI * (r + r1) * hypot(h, r1 - r) + PI * (r * r + r1 * r1);
        near(once(&all[2], true, 1), psi(PI * h / 3 * (r * r + r * r1 + r1 * r1), area), ROUNDING, "frustum");
        near(once(&all[3], false, -1), psi(2 * PI / 3 * R * R * R, 3 * PI * R * R), ROUNDING, "half ball");
    }
}

/* Central differences with steps of 1e-5: truncation and rounding are below 1e-9. */
Test(measure_plugin, its_gradient_agrees_with_differences)
{
    rig r;
    body b = body_moved(body_init(wavy_tube, -1, 1.129, 0.217, 1.713), 3);
    rig_open(&r);
    of_shape(&r, &b, true, 1);
    rig_gradient(&r, -1.7);
    for (int i = 0; i < r.samples; i++)
        for (int k = 0; k < RIG_PLANES; k++)
            for (int n = k % 7; n < r.site[i].count; n += 7) {
                double *place = &r.plane[i].at[k][n], keep = *place, up, down;
                *place = keep + 1e-5, up = rig_eval(&r);
                *place = keep - 1e-5, down = rig_eval(&r);
                *place = keep;
                near(r.back[i].at[k][n], -1.7 * (up - down) / 2e-5, 1e-8, "plane entry");
            }
    rig_close(&r);
}

Test(measure_plugin, a_shape_inside_out_is_a_verdict)
{
    body b = body_init(ellipsoid, -1, 2.385, 2.385, 2.385);
    double value = 42;
    rig r;
    rig_open(&r);
    rig_surface(&r, &b, 8, 16);
    rig_measure_with(&r, ves_plugin_entry.measure[0]);
    cr_assert(rig_try(&r, &value) == VES_INVERTED && value == 42);
    rig_close(&r);
}

Test(measure_plugin, says_which_interface_it_was_built_for)
{
    cr_assert(ves_plugin_entry.abi == VES_ABI && ves_plugin_entry.size == sizeof(ves_measure));
    cr_assert(ves_plugin_entry.given ==
              sizeof(ves_measure_input) + sizeof(ves_samples) + sizeof(ves_adjoint));
    cr_assert(ves_plugin_entry.measure[0] && !ves_plugin_entry.measure[1]);
    cr_assert(ves_measures_check(ves_plugin_entry.measure, NULL) == VES_OK);
}

/* ---- the whole stream: text, plan, annealing, polish with the gradient, result ---- */

/* A can of radius 1: psi = (36 pi V^2)^(1/3) / A is largest for h = 2, where V = 2 pi and A = 6 pi. */
static const char CAN[] =
    "vesica: 1\nvariables: {h: [0.5, 1, 6], t: [-1, 0.4, 1]}\n"
    "curves: {p: {circle: {radius: 1}}, q: {like: p, apply: [{translate: [t, 0, h]}]}}\n"
    "patches: {wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"
    "shape: {closed: true, caps: [wall.u0, wall.u1]}\nmaximize: sphericity\nconstraints: [area <= 30]\n"
    "expect: [feasible, sphericity > 0.87, optima == 1]\n";

static void stream(const ves_measure *measure, int jobs, double x_tolerance)
{
    const ves_measure *const known[] = {measure, NULL};
    ves_problem *problem;
    ves_run *run;
    ves_diag *diag = ves_diag_create();
    ves_read_options options = {.plugin = known};
    cr_assert(ves_problem_read_text("can.yaml", CAN, strlen(CAN), &options, &problem, diag) == VES_OK);
    cr_assert(ves_run_create(problem, &(ves_run_options){.jobs = jobs, .evaluations = 3000}, NULL, &run,
                             diag) == VES_OK);
    cr_assert(run->any && run->feasible && run->passed, "%s", run->stop);
    cr_assert((run->gradients > 0) == (measure->gradient != NULL), "%ld gradients", run->gradients);
    /* the value is flat at the best: it is off by the square of what x is off */
    near(run->best.objective, psi(2 * PI, 6 * PI), 1e-11, "the roundest can");
    near(run->best.x[0], 2, x_tolerance, "its height");
    near(run->best.x[1], 0, x_tolerance, "its lean");
    ves_run_destroy(run);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}

/* slsqp stops where a step changes the value by less than 1e-12 of it: steps below 1e-6. Without a gradient
 * cobyla shrinks its trust region to 1e-9. */
Test(measure_plugin, goes_through_the_whole_stream)
{
    ves_measure plain = *ves_plugin_entry.measure[0];
    for (int jobs = 1; jobs < 3; jobs++) stream(ves_plugin_entry.measure[0], jobs, 3e-6);
    plain.gradient = NULL;
    stream(&plain, 2, 3e-6);
}

/* Nothing that vesica decides may depend on how large a shape is: a vesicle of a micron and a tank of a
 * kilometre are searched alike. With sizes that differ by a power of two every number is rounded alike too, so
 * that variables without a unit end in the same bits. */
#include <criterion/criterion.h>
#include <stdio.h>
#include <string.h>

#include "vesica/vesica.h"

static const char TUBE[] =
    "vesica: 1\nparameters: {L: 1 m}\n"
    "variables: {r: [0.3, 0.5, 1.1], h: [0.2, 1, 4], q: [-0.2, 0.05, 0.2], a: [0.5, 1, 5]}\n"
    "curves:\n"
    "  low: {circle: {radius: r*L}, apply: [{ridge: {points: 6, by: q*L, along: radial}}]}\n"
    "  high: {circle: {radius: 0.8*L}, apply: [{translate: [0.3*L, 0 m, h*L]}]}\n"
    "  out: {circle: {radius: L}}\n"
    "patches: {wall: {operator: {power: 2, a: a}, conditions: [{u: 0, position: low}, {u: 1, position: "
    "high}, "
    "{u: 0, derivative: 1, from: low, to: out, scale: 0.3}, {u: 1, derivative: 1, from: high, to: low, "
    "scale: "
    "-0.8}]}}\n"
    "shape: {closed: true, caps: [wall.u0, wall.u1]}\n";

static const char *const tail[] = {
    "measures: {c: {centroid: {of: volume, along: [1, 0, 0]}}, y: {centroid: {along: [0, 1, 0]}}}\n"
    "minimize: bending + 0.1*c/L + y/L\nconstraints: [volume >= 2*L^3, width <= 1.9*L]\n",
    "measures: {d: {distance: {from: low, to: high}}, k: {max_curvature: {}}}\n"
    "minimize: area/L^2 + d/L + 0.1*k*L\nconstraints: [volume == 2*L^3]\n",
    "measures: {i: {integral: {of: \"z + x\"}}, s: {integral: {of: y}}}\n"
    "scale: {equation: area == 9*L^2}\nminimize: i\nconstraints: [volume >= 1.9*L^3, s <= L^3]\n",
};

static ves_run *run(const char *end, const char *L, ves_problem **problem)
{
    char text[3000], message[1000] = "";
    snprintf(text, sizeof text, "%s%s", TUBE, end);
    ves_diag *diag = ves_diag_create();
    ves_override set = {"L", L};
    ves_status status = ves_problem_read_text(
        "t", text, strlen(text), &(ves_read_options){.overrides = 1, .override = &set}, problem, diag);
    ves_run *made = NULL;
    if (status == VES_OK)
        status =
            ves_run_create(*problem, &(ves_run_options){.evaluations = 120, .jobs = 1}, NULL, &made, diag);
    if (status != VES_OK) ves_diag_text(diag, 0, message, sizeof message);
    cr_assert(status == VES_OK, "%s", message);
    ves_diag_destroy(diag);
    return made;
}

Test(scale_free, a_shape_of_any_size_is_searched_alike)
{
    static const char *const size[] = {"2^-20 * 1 m", "2^20 * 1 m"};
    for (size_t t = 0; t < sizeof tail / sizeof *tail; t++) {
        ves_problem *one, *other;
        ves_run *a = run(tail[t], "1 m", &one);
        for (int k = 0; k < 2; k++) {
            ves_run *b = run(tail[t], size[k], &other);
            cr_expect(a->quadrature[0] == b->quadrature[0] && a->quadrature[1] == b->quadrature[1],
                      "problem %zu: %d x %d and %d x %d", t, a->quadrature[0], a->quadrature[1],
                      b->quadrature[0], b->quadrature[1]);
            cr_expect(a->evaluations == b->evaluations && a->feasible == b->feasible, "problem %zu: %ld, %ld",
                      t, a->evaluations, b->evaluations);
            for (int i = 0; i < 4; i++)
                cr_expect(a->best.x[i] == b->best.x[i], "problem %zu, x[%d]: %.17g and %.17g", t, i,
                          a->best.x[i], b->best.x[i]);
            cr_expect(a->change == b->change && a->finer_change == b->finer_change,
                      "problem %zu: %g %g, %g %g", t, a->change, b->change, a->finer_change, b->finer_change);
            ves_run_destroy(b);
            ves_problem_destroy(other);
        }
        ves_run_destroy(a);
        ves_problem_destroy(one);
    }
}

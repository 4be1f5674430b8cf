/* Validity at the edges of a patch, where no node lies. */
#include <math.h>
#include <stdio.h>

#include "bed.h"

typedef struct trial {
    const char *text;
    double x;
    ves_status want[2]; /* on each level */
} trial;

static void judge_all(const trial *table, size_t count)
{
    for (size_t k = 0; k < count; k++) {
        bed b = bed_with(table[k].text, NULL, 16, 16);
        for (int level = 0; level < 2; level++) {
            ves_verdict got = {0};
            ves_ask ask = {.x = &table[k].x, .level = level, .cutoff = HUGE_VAL};
            cr_assert_eq(ves_plan_evaluate(b.plan, &ask, &got), VES_OK);
            cr_expect_eq(got.status, table[k].want[level], "case %zu, level %d, x = %g: %s\n%s", k, level,
                         table[k].x, ves_status_text(got.status), table[k].text);
        }
        bed_clear(&b);
    }
}
#define JUDGE(table) judge_all(table, sizeof table / sizeof *table)

#define HEAD "vesica: 1\nvariables: {r: [-3, 1, 3]}\nminimize: area + r^2\n"
#define TWO_CURVES(low)                                                                                      \
    HEAD "curves: {low: " low ", high: {circle: {radius: 5, centre: [0, 0, 1]}}}\n"                          \
         "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: "   \
         "high}]}}\n"
#define AWAY "validity: {self_intersection: never, least_radius: {value: 0.7}}\n"
#define BOTH(status)                                                                                         \
    {                                                                                                        \
        VES_##status, VES_##status                                                                           \
    }
#define FORMULA(x, y, z, rest) HEAD "patches: {w: {surface: {formula: [" x ", " y ", " z "]}" rest "}}\n"
#define FLAT                   ", periodic: false, domain: {u: [0, 1], v: [0, 1]}"

Test(validity, the_least_radius_holds_at_the_edges)
{
    static const trial table[] = {
        {TWO_CURVES("{circle: {radius: \"abs(r)\"}}") AWAY, 0.7,
         BOTH(OK)}, /* on the limit: rounding does not decide */
        {TWO_CURVES("{circle: {radius: \"abs(r)\"}}") AWAY, 0.7 * (1 - 1e-6), BOTH(NARROW)},
        /* the nearest points lie between the nodes of the end */
        {TWO_CURVES("{ellipse: {radii: [1, \"abs(r)\"]}}") AWAY, 0.7 * (1 - 1e-6), BOTH(NARROW)},
        {TWO_CURVES("{ellipse: {radii: [\"abs(r)\", 1]}}") AWAY, 0.7 * (1 - 1e-6), BOTH(NARROW)},
        /* a corner, and the sides of a sheet */
        {FORMULA("r + u + v", "0", "u - v", FLAT) AWAY, 0.7, BOTH(OK)},
        {FORMULA("r + u + v", "0", "u - v", FLAT) AWAY, 0.7 * (1 - 1e-6), BOTH(NARROW)},
        {FORMULA("r + 3 - u - v", "0", "u - v", FLAT) AWAY, -0.3 - 1e-6, BOTH(NARROW)},
        {HEAD "patches: {w: {surface: {points: [[[r, 0, 0], [3, 0, 0]], [[r, 0, 1], [3, 0, 1]]]}, periodic: "
              "false}}\n" AWAY,
         0.7 * (1 - 1e-6), BOTH(NARROW)},
        {HEAD "patches: {w: {surface: {points: [[[r, 0, 0], [3, 0, 0]], [[r, 0, 1], [3, 0, 1]]]}, periodic: "
              "false}}\n" AWAY,
         0.7, BOTH(OK)}};
    JUDGE(table);
}

#define UP "validity: {jacobian: any, self_intersection: never, monotone: {along: [0, 0, 1]}}\n"

Test(validity, the_height_does_not_turn_back_at_an_end)
{
    static const trial table[] = {
        /* the first node of the finer grid lies at u = 0.0014 */
        {FORMULA("cos(v)", "sin(v)", "(u - r)^2", "") UP, 0.001, BOTH(NOT_MONOTONE)},
        {FORMULA("cos(v)", "sin(v)", "(u + r - 1)^2", "") UP, 1e-7, BOTH(NOT_MONOTONE)},
        {FORMULA("cos(v)", "sin(v)", "(u - r)^2", "") UP, 0, BOTH(OK)}, /* level is not back */
        {FORMULA("cos(v)", "sin(v)", "(u - r)^2", "") UP, -0.001, BOTH(OK)},
        {FORMULA("u", "v", "v + (u - r)^2", FLAT) UP, 0.001, BOTH(NOT_MONOTONE)},
        {FORMULA("u", "v", "u^2/2 - (v - r)*u/1000", FLAT) UP, 0, BOTH(NOT_MONOTONE)},
        {FORMULA("u", "v", "u^2/2 + (v - r)*u/1000", FLAT) UP, 0, BOTH(OK)},
        /* poles are level, and a slope may be infinite */
        {FORMULA("sin(u)*cos(v)", "sin(u)*sin(v)", "-cos(u)", ", domain: {u: [0, pi], v: [0, 2*pi]}") UP, 1,
         BOTH(OK)},
        {FORMULA("sqrt(u)*cos(v)", "sqrt(u)*sin(v)", "u", "") UP, 1, BOTH(OK)},
        {FORMULA("cos(v)", "sin(v)", "sqrt(u)", "") UP, 1, BOTH(OK)}};
    JUDGE(table);
}

#define REAL "validity: {self_intersection: never}\n"

/* The loop does not pay for it: on the grid of a proof alone. */
Test(validity, a_fold_between_an_edge_and_its_next_nodes_is_seen_by_a_proof)
{
    static const trial table[] = {
        {FORMULA("(u - r)^2", "v", "u/9999", FLAT) REAL, 0.001, {VES_OK, VES_FOLDED}},
        {FORMULA("(u - 1 + r)^2", "v", "u/9999", FLAT) REAL, 0.001, {VES_OK, VES_FOLDED}},
        {FORMULA("(u - r)^2", "v", "u/9999", FLAT) REAL, -0.001, BOTH(OK)},
        {FORMULA("(u - r)^2", "v", "0", FLAT) REAL, 0, BOTH(OK)}, /* no tangent plane at the end */
        {FORMULA("u", "(v - r)^2", "v/9999", FLAT) REAL, 0.001, {VES_OK, VES_FOLDED}},
        {FORMULA("u", "(v - 1 + r)^2", "v/9999", FLAT) REAL, 0.001, {VES_OK, VES_FOLDED}},
        {FORMULA("u", "(v - r)^2", "0", FLAT) REAL, 0, BOTH(OK)},
        {FORMULA("cos(v)*(2 + (u - r)^2)", "sin(v)*(2 + (u - r)^2)", "u/9999", "") REAL,
         0.001,
         {VES_OK, VES_FOLDED}},
        /* poles have no plane of their own */
        {FORMULA("sin(u)*cos(v)", "sin(u)*sin(v)", "-cos(u)", ", domain: {u: [0, pi], v: [0, 2*pi]}") REAL, 1,
         BOTH(OK)},
        {FORMULA("sqrt(u)*cos(v)", "sqrt(u)*sin(v)", "u", "") REAL, 1, BOTH(OK)},
        {TWO_CURVES("{point: [0, 0, r]}") REAL, 1, BOTH(OK)},
        {TWO_CURVES("{point: [0, 0, r]}") REAL, -3, BOTH(OK)}};
    JUDGE(table);
}

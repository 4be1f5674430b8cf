/* What the limits of a problem file cost, and runs by stages of one's own, through the public headers alone. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <vesica/vesica.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

static const double PI = 3.14159265358979323846;

/* A can, told in five ways. With A = 6 pi r^2 and V = 2 pi r^3: dA/dV = 2 / r, dV/dA = r / 2; 150 ml: r = 28.794 mm. */
Test(api_rate, what_a_limit_costs_is_told_in_the_terms_of_the_file)
{
    static const struct {
        const char *goal, *constraint;
        bool volume; /* is held */
    } can[] = {{"minimize: area", "volume >= 150 ml", true},
               {"minimize: area", "150 ml <= volume", true},
               {"minimize: area", "\"volume == 150 ml\"", true},
               {"maximize: volume", "area <= 156.28 cm^2", false},
               {"maximize: volume", "{require: area == 156.28 cm^2, within: 1e-4}", false}};
    for (int k = 0; k < 5; k++) {
        double best[3], rate = 0;
        for (int moved = 0; moved < 3; moved++) {
            char text[1500], limit[40];
            const double to = (k < 3 ? 150 : 156.28) * (1 + 1e-4 * (moved - 1));
            snprintf(limit, sizeof limit, k < 3 ? "%.10g ml" : "%.10g cm^2", to);
            const char *c = can[k].constraint, *old = k < 3 ? "150 ml" : "156.28 cm^2", *at = strstr(c, old);
            snprintf(
                text, sizeof text,
                "vesica: 1\nvariables: {r: [10 mm, 20 mm, 60 mm], h: [10 mm, 40 mm, 200 mm]}\n"
                "curves:\n  floor: {point: [0 mm, 0 mm, 0 mm]}\n  lid: {point: [0 mm, 0 mm, h]}\n"
                "  low: {circle: {radius: r}}\n  high: {like: low, apply: [{translate: [0 mm, 0 mm, h]}]}\n"
                "patches:\n"
                "  base: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: floor}, {u: 1, position: "
                "low}]}\n"
                "  wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: "
                "high}]}\n"
                "  top: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: high}, {u: 1, position: "
                "lid}]}\n"
                "shape: {closed: true}\n%s\nconstraints: [%.*s%s%s]\nsearch: [{polish: {}}]\n",
                can[k].goal, (int)(at - c), c, limit, at + strlen(old));
            ves_problem *problem;
            ves_run *run;
            ves_diag *diag = ves_diag_create();
            ves_status status = ves_problem_read_text("can.yaml", text, strlen(text), NULL, &problem, diag);
            char complaint[500] = "";
            if (status != VES_OK) ves_diag_text(diag, 0, complaint, sizeof complaint);
            cr_assert_eq(status, VES_OK, "%s", complaint);
            cr_assert_eq(ves_run_create(problem, NULL, NULL, &run, NULL), VES_OK);
            cr_assert(run->feasible && run->kkt.known && run->kkt.unique);
            best[moved] = run->best.objective;
            if (moved == 1) rate = run->kkt.multiplier[0];
            ves_run_destroy(run);
            ves_problem_destroy(problem);
            ves_diag_destroy(diag);
        }
        const double limit = (k < 3 ? 150e-6 : 156.28e-4), slope = (best[2] - best[0]) / (2e-4 * limit);
        const double r = can[k].volume ? cbrt(limit / (2 * PI)) : sqrt(limit / (6 * PI));
        const double want = can[k].volume ? 2 / r : r / 2;
        cr_expect(fabs(rate / want - 1) < 1e-6, "%s: %.10g, by hand %.10g", can[k].constraint, rate, want);
        /* truncation 1e-8; values exact to 1e-10 or, with `within`, to what that leaves open */
        cr_expect(fabs(rate / slope - 1) < 1e-5, "%s: %.10g, solved again %.10g", can[k].constraint, rate,
                  slope);
    }
}

/* A constraint's excess is told in units of its limit. */
Test(api_rate, a_multiplier_becomes_a_rate)
{
    static const char format[] = "vesica: 1\nvariables: {r: [0.1, 1, 2]}\n"
                                 "curves: {p: {circle: r}, q: {circle: {radius: 1, centre: [0, 0, 1]}}}\n"
                                 "patches: {w: {operator: {power: 1}, conditions: [{u: 0, position: p}, "
                                 "{u: 1, position: q}]}}\n%s: area\nconstraints: [%s]\n";
    static const struct {
        const char *goal, *constraint;
        double rate;
    } row[] = {{"minimize", "r >= 0.5", 4},      {"minimize", "0.5 <= r", 4},    {"maximize", "r <= 0.5", 4},
               {"maximize", "0.5 >= r", 4},      {"minimize", "r <= 0.5", -4},   {"maximize", "r >= 0.5", -4},
               {"minimize", "\"r == 0.5\"", -4}, {"maximize", "\"r == 0.5\"", 4}};
    for (int k = 0; k < 8; k++) {
        char text[600];
        ves_problem *problem;
        ves_plan *plan;
        snprintf(text, sizeof text, format, row[k].goal, row[k].constraint);
        cr_assert_eq(ves_problem_read_text("f.yaml", text, strlen(text), NULL, &problem, NULL), VES_OK);
        cr_assert_eq(ves_plan_create(problem, NULL, &plan, NULL), VES_OK);
        cr_expect_eq(ves_plan_rate(plan, 0, 2), row[k].rate, "%s: %g", row[k].constraint,
                     ves_plan_rate(plan, 0, 2));
        ves_plan_destroy(plan);
        ves_problem_destroy(problem);
    }
}

/* V = 2 pi (A / 6 pi)^1.5, so that dV/dA = r / 2 = 1 / sqrt(8); the slope of V is exact to 1e-9. */
Test(api_rate, a_run_tells_how_far_its_best_can_be_trusted)
{
    ves_problem *problem;
    ves_run *run;
    cr_assert_eq(ves_problem_read(VESICA_SOURCE "/problems/bottle.yaml", NULL, &problem, NULL), VES_OK);
    cr_assert_eq(ves_run_create(problem, NULL, NULL, &run, NULL), VES_OK);
    cr_expect(run->kkt.known && run->kkt.unique && fabs(run->kkt.multiplier[0] - 1 / sqrt(8)) < 1e-8, "%.12g",
              run->kkt.multiplier[0]);
    cr_expect(run->kkt.residual < 1e-8 && run->kkt.bound[0] == 0 && run->kkt.bound[1] == 0);
    cr_expect(run->evidence.trust == VES_TRUST_REPEATED && run->evidence.minima == 1 &&
                  run->evidence.unseen < 0.01,
              "%s", run->evidence.sentence);
    cr_expect(run->evaluations < 3000 && run->strategies > 1 && run->strategy[1].evaluations > 0);
    ves_run_destroy(run);
    ves_problem_destroy(problem);
}

/* Stages of one's own instead of those of the file, with its seed; a folder would not keep them. */
Test(api_rate, a_run_takes_stages_of_ones_own)
{
    ves_problem *problem = NULL;
    ves_run *run = NULL;
    ves_search_options polish = {.stages = 1, .seed = 5};
    polish.stage[0].kind = VES_STAGE_POLISH;
    cr_assert_eq(ves_problem_read(VESICA_SOURCE "/problems/bottle.yaml", NULL, &problem, NULL), VES_OK);
    const ves_run_options kept = {.search = &polish, .files = true}, free = {.search = &polish};
    cr_expect_eq(ves_run_create(problem, &kept, NULL, &run, NULL), VES_RANGE);
    cr_assert_eq(ves_run_create(problem, &free, NULL, &run, NULL), VES_OK);
    cr_expect(run->times.stages == 1 && run->seed == 1 && run->evaluations < 300 && run->strategies == 0);
    cr_expect(run->feasible && fabs(run->best.objective - PI / sqrt(2)) < 1e-9);
    ves_run_destroy(run);
    ves_problem_destroy(problem);
}

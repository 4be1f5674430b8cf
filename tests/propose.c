/* What check proposes: equations that need not be searched for. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>
#include <stdio.h>
#include <string.h>

#include "study/propose.h"
#include "vesica/run.h"

#define CYLINDER                                                                                             \
    "vesica: 1\nvariables: {r: [0.2, 1, 3], h: [0.2, 1, 4]%s}\ncurves:\n  low: {circle: {radius: r, axis: "  \
    "[0, 0, 1]}}\n  high: {like: low, apply: [{translate: [0, 0, h]}]}\npatches:\n  wall:\n    operator: "   \
    "{power: 1, a: 1e-6}\n    conditions: [{u: 0, position: low}, {u: 1, position: high}]\nshape: {closed: " \
    "true, caps: [wall.u0, wall.u1]}\n%s"

static ves_problem *read_text(const char *more, const char *rest)
{
    char text[2000];
    ves_problem *problem;
    ves_diag *diag = ves_diag_create();
    int length = snprintf(text, sizeof text, CYLINDER, more, rest);
    ves_status status = ves_problem_read_text("cylinder.yaml", text, (size_t)length, NULL, &problem, diag);
    char message[500] = "";
    if (status != VES_OK) ves_diag_text(diag, 0, message, sizeof message);
    cr_assert(status == VES_OK, "%s", message);
    ves_diag_destroy(diag);
    return problem;
}

static int propose(const ves_problem *problem, ves_elimination list[2])
{
    ves_arena arena = {0};
    ves_plan *plan;
    int count;
    cr_assert(ves_plan_create(problem, NULL, &plan, NULL) == VES_OK);
    cr_assert(ves_study_propose(plan, problem, &arena, list, &count) == VES_OK);
    ves_plan_destroy(plan);
    ves_arena_destroy(&arena);
    return count;
}

/* 2 pi r h = 5: by size, or by r, whose range moves it by 17.6 against h's 23.9: by h. */
Test(propose, an_area_is_met_by_size_or_by_the_variable_that_moves_it_most)
{
    ves_problem *problem = read_text("", "maximize: volume\nconstraints: [area == 5]\n");
    ves_elimination list[2];
    cr_assert(eq(int, propose(problem, list), 2));
    cr_expect(list[0].constraint == 0 && list[0].variable == -1);
    cr_expect(list[1].constraint == 0 && !strcmp(ves_problem_slot(problem, list[1].variable), "h"));
    ves_problem_destroy(problem);
}

/* Inequalities are left alone; so is what scale and solve see to already; a quotient is no measure to scale. */
Test(propose, what_cannot_be_eliminated_is_not_proposed)
{
    static const struct {
        const char *more, *rest;
        int count;
    } given[] = {
        {"", "minimize: volume\nconstraints: [area <= 5]\n", 0},
        {"", "minimize: volume\n", 0},
        {"", "maximize: volume\nconstraints: [area/r == 5]\n", 1},      /* solve only */
        {"", "maximize: volume\nconstraints: [area == 5*volume]\n", 1}, /* measures on both sides */
        {"", "maximize: volume\nconstraints: [area == 500]\n", 1}, /* scale only: no root in the ranges */
        {"", "minimize: area\nscale: {equation: area == 5}\nconstraints: [volume == 1]\n", 1},
    };
    for (size_t k = 0; k < sizeof given / sizeof *given; k++) {
        ves_problem *problem = read_text(given[k].more, given[k].rest);
        ves_elimination list[2];
        cr_expect(eq(int, propose(problem, list), given[k].count), "%s", given[k].rest);
        ves_problem_destroy(problem);
    }
}

static double best_of(ves_problem *problem, double *violation)
{
    ves_run *run;
    const ves_run_options options = {.jobs = 1, .evaluations = 1500};
    cr_assert(ves_run_create(problem, &options, NULL, &run, NULL) == VES_OK);
    cr_assert(run->feasible);
    double value = run->best.objective;
    *violation = run->best.violation;
    ves_run_destroy(run);
    ves_problem_destroy(problem);
    return value;
}

/* What is proposed is the same problem: least bending, integral of H^2 = pi h / (2 r), of a wall of area 5 that
 * is no lower than 0.5: r as large as it may be. */
Test(propose, what_is_proposed_ends_in_the_same_optimum)
{
    double violation[2];
    double searched =
        best_of(read_text("", "minimize: bending\nconstraints: [area == 5, \"r <= 1.2\"]\n"), &violation[0]);
    static const char solved[] =
        "vesica: 1\nvariables: {r: [0.2, 1, 3]}\nsolve: {unknown: h, in: [0.2, 4], equation: area == "
        "5}\ncurves:\n  low: {circle: {radius: r, axis: [0, 0, 1]}}\n  high: {like: low, apply: [{translate: "
        "[0, 0, "
        "h]}]}\npatches:\n  wall:\n    operator: {power: 1, a: 1e-6}\n    conditions: [{u: 0, position: "
        "low}, {u: 1, "
        "position: high}]\nminimize: bending\nconstraints: [\"r <= 1.2\"]\n";
    ves_problem *problem;
    cr_assert(ves_problem_read_text("solved.yaml", solved, strlen(solved), NULL, &problem, NULL) == VES_OK);
    double exact = best_of(problem, &violation[1]);
    cr_expect(epsilon_eq(dbl, searched, exact, 1e-7 * exact));
    cr_expect(violation[1] <= violation[0] + 1e-12);
}

/* Along r there are designs without a value, the square root of less than nothing: r is not proposed, and the rest
 * is looked at. */
Test(propose, designs_that_cannot_be_measured_are_passed_over)
{
    ves_problem *problem =
        read_text("", "minimize: area\nconstraints: [sqrt(r - 0.5) + 0*area == 1, area == 5]\n");
    ves_elimination list[2];
    cr_assert(eq(int, propose(problem, list), 2));
    cr_expect(list[0].constraint == 1 && list[0].variable == -1);
    cr_expect(list[1].constraint == 1 && !strcmp(ves_problem_slot(problem, list[1].variable), "h"));
    ves_problem_destroy(problem);
}

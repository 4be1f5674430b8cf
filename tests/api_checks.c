/* Checks and kinds of a file, by the installed headers alone. */
#include <criterion/criterion.h>
#include <math.h>
#include <string.h>

#include <vesica/vesica.h>

Test(api_checks, a_check_that_does_not_hold_is_told_with_its_numbers_and_a_kind_by_its_name)
{
    static const char file[] =
        "vesica: 1\nvariables: {r: [0.1, 1, 2]}\n"
        "curves: {p: {circle: {radius: 1}}, q: {circle: {radius: r, centre: [0, 0, 1]}}}\n"
        "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"
        "minimize: area\nvalidity: {holds: [r > 0.25, r < 1.5]}\nkinds: {narrow: r < 1, wide: r > 1.5}\n";
    ves_problem *problem;
    ves_diag *diag = ves_diag_create();
    cr_assert_eq(ves_problem_read_text("f.yaml", file, strlen(file), NULL, &problem, diag), VES_OK);
    cr_expect_eq(ves_problem_checks(problem), 2);
    cr_expect_str_eq(ves_problem_check(problem, 1), "r < 1.5");
    cr_expect(ves_problem_check(problem, 2) == NULL && ves_problem_check(problem, -1) == NULL);
    cr_expect_eq(ves_problem_kinds(problem), 2);
    cr_expect_str_eq(ves_problem_kind(problem, 1), "wide");
    cr_expect(ves_problem_kind(problem, 2) == NULL && ves_problem_kind(problem, -1) == NULL);
    ves_plan *plan;
    cr_assert_eq(ves_plan_create(problem, &(ves_plan_options){{8, 8}}, &plan, diag), VES_OK);
    ves_design design;
    double x = 1.75;
    char text[500] = "";
    ves_verdict verdict = {0};
    ves_ask ask = {.x = &x, .cutoff = HUGE_VAL, .want = VES_WANT_PROOF};
    cr_expect(ves_plan_measure(plan, &x, 0, &design) == VES_OK && design.check[0] && !design.check[1]);
    cr_expect_eq(design.kind, 1);
    cr_assert(ves_plan_evaluate(plan, &ask, &verdict) == VES_OK && verdict.status == VES_BROKEN);
    cr_expect(ves_plan_broken(plan, text, sizeof text));
    cr_expect_str_eq(text, "\"r < 1.5\", with r = 1.75 on the finer grid");
    ves_plan_why(plan, VES_BROKEN, "mine", diag);
    ves_diag_text(diag, 0, text, sizeof text);
    cr_expect(strstr(text, "f.yaml:6:30: warning: mine: a check of the file does not hold: \"r < 1.5\""),
              "%s", text);
    x = 1;
    cr_assert(ves_plan_evaluate(plan, &ask, &verdict) == VES_OK && verdict.status == VES_OK);
    cr_expect(ves_plan_broken(plan, text, sizeof text) == false);
    cr_expect(ves_plan_measure(plan, &x, 0, &design) == VES_OK && design.kind == -1 && design.check[1]);
    ves_diag_destroy(diag);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
}

/* The public headers alone are enough to read a problem, evaluate it with gradients, run it and write its
 * shape. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <vesica/vesica.h>

static ves_problem *bottle(ves_diag *diag)
{
    ves_problem *problem;
    ves_read_options options = {0};
    cr_assert_eq(ves_problem_read(VESICA_SOURCE "/problems/bottle.yaml", &options, &problem, diag), VES_OK);
    return problem;
}

Test(api, a_problem_tells_its_names)
{
    ves_diag *diag = ves_diag_create();
    ves_problem *problem = bottle(diag);
    double min, start, max;
    cr_expect_eq(ves_problem_variables(problem), 2);
    cr_expect_str_eq(ves_problem_variable(problem, 1, &min, &start, &max), "h");
    cr_expect(min == 0.2 && start == 1 && max == 4);
    cr_expect_eq(ves_problem_measures(problem), 2);
    cr_expect_str_eq(ves_problem_measure(problem, 0), "volume");
    cr_expect_eq(ves_problem_constraints(problem), 1);
    cr_expect_str_eq(ves_problem_constraint(problem, 0), "area == 3*pi");
    cr_expect_eq(ves_problem_patches(problem), 3);
    cr_expect_str_eq(ves_problem_patch(problem, 2), "top");
    cr_expect(strstr(ves_problem_title(problem), "bottle") != NULL);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}

/* V = pi r^2 h and A = 2 pi r (r + h), to rounding: cylinders and discs are met exactly. */
Test(api, a_plan_gives_values_and_gradients)
{
    ves_diag *diag = ves_diag_create();
    ves_problem *problem = bottle(diag);
    ves_plan *plan;
    cr_assert_eq(ves_plan_create(problem, &(ves_plan_options){{0, 0}}, &plan, diag), VES_OK);
    const double pi = 3.141592653589793;
    double x[2] = {0.7, 1.3}, gradient[2], constraint[1], jacobian[2], r = x[0], h = x[1];
    ves_verdict verdict = {.constraint = constraint, .gradient = gradient, .jacobian = jacobian};
    ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
    cr_assert_eq(ves_plan_evaluate(plan, &ask, &verdict), VES_OK);
    /* the quadrature of polynomials is exact: rounding, 1e-15 was seen */
    cr_expect(fabs(verdict.value + pi * r * r * h) < 1e-13, "a maximum is the minimum of its negative");
    cr_expect(fabs(gradient[0] + 2 * pi * r * h) < 1e-12 && fabs(gradient[1] + pi * r * r) < 1e-12);
    double area = 2 * pi * r * (r + h), size = 3 * pi;
    cr_expect(fabs(constraint[0] - (area - size) / size) < 1e-13);
    cr_expect(fabs(jacobian[0] - 2 * pi * (2 * r + h) / size) < 1e-12);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}

Test(api, a_run_finds_the_best_and_writes_it)
{
    ves_diag *diag = ves_diag_create();
    ves_problem *problem = bottle(diag);
    ves_run *run;
    ves_run_options options = {.jobs = 1};
    cr_assert_eq(ves_run_create(problem, &options, NULL, &run, diag), VES_OK);
    double objective, violation;
    const double *measures, *x = ves_run_best(run, &objective, &violation, &measures);
    cr_assert(x != NULL);
    cr_expect(ves_run_feasible(run) && ves_run_passed(run) && ves_run_folder(run) == NULL);
    /* slsqp ends a step after its tolerance of 1e-12 is met: 2e-15 and a violation of 6e-16 were seen */
    cr_expect(fabs(objective - 3.141592653589793 / sqrt(2)) < 1e-9, "%.12g", objective);
    cr_expect(measures[0] == objective && violation < 1e-9 && strlen(ves_run_stop(run)) > 0);
    ves_plan *plan;
    ves_figure *figure;
    char path[] = "/tmp/vesica-api-XXXXXX", file[100];
    cr_assert(mkdtemp(path) != NULL);
    snprintf(file, sizeof file, "%s/bottle.stl", path);
    cr_assert_eq(ves_plan_create(problem, &(ves_plan_options){{0, 0}}, &plan, diag), VES_OK);
    cr_assert_eq(ves_plan_figure(plan, x, 8, 16, &figure, diag), VES_OK);
    cr_expect_eq(ves_figure_write(figure, file, diag), VES_OK);
    cr_expect_eq(remove(file), 0);
    cr_expect_eq(ves_figure_write(figure, "/tmp/bottle.dwg", diag), VES_USAGE);
    rmdir(path);
    ves_figure_destroy(figure);
    ves_plan_destroy(plan);
    ves_run_destroy(run);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}

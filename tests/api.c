/* What a program that links an installed vesica does, with the installed headers alone: read a problem, look
 * at it, run it and read all of the result, search it with options of its own, take its mesh, bring a
 * measure. tests/symbols.sh looks that every public function is called here. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <vesica/vesica.h>

static const double PI = 3.14159265358979323846;

/* fontconfig keeps what it has read about the fonts until the process ends; nothing of it points there. */
const char *__lsan_default_suppressions(void);
const char *__asan_default_options(void);

const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig\n";
}

const char *__asan_default_options(void)
{
    return "print_suppressions=0";
}

/* --- a problem --- */

static ves_problem *read_file(const char *name)
{
    char path[300], message[1000] = "";
    ves_problem *problem;
    ves_diag *diag = ves_diag_create();
    snprintf(path, sizeof path, "%s/problems/%s.yaml", VESICA_SOURCE, name);
    ves_status status = ves_problem_read(path, NULL, &problem, diag);
    if (status != VES_OK) ves_diag_text(diag, 0, message, sizeof message);
    cr_assert_eq(status, VES_OK, "%s", message);
    ves_diag_destroy(diag);
    return problem;
}

static ves_problem *read_text(const char *text, const ves_read_options *options)
{
    ves_problem *problem;
    ves_diag *diag = ves_diag_create();
    char message[1000] = "";
    ves_status status = ves_problem_read_text("text.yaml", text, strlen(text), options, &problem, diag);
    if (status != VES_OK) ves_diag_text(diag, 0, message, sizeof message);
    cr_assert_eq(status, VES_OK, "%s", message);
    ves_diag_destroy(diag);
    return problem;
}

/* A cylinder of radius r whose height h is solved for: pi r^2 h = 2. */
static const char SOLVED[] =
    "vesica: 1\n"
    "title: solved\n"
    "variables: {r: [0.2, 0.5, 2]}\n"
    "parameters: {half: r/2, goal: 2}\n"
    "curves:\n"
    "  low: {circle: {radius: 2*half}}\n"
    "  high: {like: low, apply: [{translate: [0, 0, h]}]}\n"
    "patches: {wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: "
    "high}]}}\n"
    "shape: {closed: true, caps: [wall.u0, wall.u1]}\n"
    "solve: {unknown: h, in: [0.01, 100], equation: volume == goal}\n"
    "minimize: area\n"
    "constraints: [r <= 1.5, height >= 0.1]\n";

static int slot_of(const ves_problem *problem, const char *name)
{
    for (int k = 0; k < ves_problem_slots(problem); k++)
        if (!strcmp(ves_problem_slot(problem, k), name)) return k;
    return -1;
}

Test(api, a_problem_tells_its_names)
{
    ves_problem *problem = read_file("bottle");
    double min, start, max;
    bool maximize = false;
    ves_relation relation = VES_AT_MOST;
    cr_expect_eq(ves_problem_variables(problem), 2);
    cr_expect_str_eq(ves_problem_variable(problem, 1, &min, &start, &max), "h");
    cr_expect(min == 0.2 && start == 1 && max == 4);
    cr_expect_str_eq(ves_problem_variable(problem, 0, NULL, NULL, NULL), "r");
    cr_expect_str_eq(ves_problem_objective(problem, &maximize), "volume");
    cr_expect(maximize);
    cr_expect_eq(ves_problem_measures(problem), 2);
    cr_expect_str_eq(ves_problem_measure(problem, 0), "volume");
    cr_expect_eq(ves_problem_constraints(problem), 1);
    cr_expect_str_eq(ves_problem_constraint(problem, 0, &relation), "area == 3*pi");
    cr_expect_eq(relation, VES_EQUAL);
    cr_expect_eq(ves_problem_patches(problem), 3);
    cr_expect_str_eq(ves_problem_patch(problem, 2), "top");
    cr_expect(strstr(ves_problem_title(problem), "bottle") != NULL);
    ves_problem_destroy(problem);
    problem = read_text(SOLVED, NULL);
    cr_expect_str_eq(ves_problem_objective(problem, &maximize), "area");
    cr_expect(!maximize);
    cr_assert_eq(ves_problem_slots(problem), 4);
    cr_expect_str_eq(ves_problem_slot(problem, 0), "r");
    cr_expect_str_eq(ves_problem_slot(problem, 1), "h");
    cr_expect(slot_of(problem, "half") + slot_of(problem, "goal") == 2 + 3);
    ves_problem_constraint(problem, 0, &relation);
    cr_expect_eq(relation, VES_AT_MOST);
    cr_expect_str_eq(ves_problem_constraint(problem, 1, NULL), "height >= 0.1");
    ves_problem_constraint(problem, 1, &relation);
    cr_expect_eq(relation, VES_AT_LEAST);
    ves_problem_destroy(problem);
}

Test(api, an_index_that_is_not_there_is_null)
{
    ves_problem *problem = read_file("bottle");
    for (int k = -1; k < 100; k += 100) {
        cr_expect(!ves_problem_variable(problem, k, NULL, NULL, NULL) && !ves_problem_slot(problem, k));
        cr_expect(!ves_problem_measure(problem, k) && !ves_problem_constraint(problem, k, NULL));
        cr_expect(!ves_problem_patch(problem, k));
    }
    ves_problem_destroy(problem);
    ves_problem_destroy(NULL);
    problem = read_text("vesica: 1\ncurves: {p: {circle: {radius: 1}}, q: {point: [0, 0, 1]}}\n"
                        "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, "
                        "position: q}]}}\nexpect: [area > 0]\n",
                        NULL);
    cr_expect(ves_problem_objective(problem, NULL) == NULL);
    ves_problem_destroy(problem);
}

Test(api, what_is_wrong_is_told_or_kept_quiet)
{
    static const char wrong[] = "vesica: 1\ncurves: {p: {circle: {raduis: 1}}}\n";
    ves_problem *problem = (ves_problem *)&wrong;
    ves_diag *diag = ves_diag_create();
    char text[500];
    ves_status status = ves_problem_read_text("w.yaml", wrong, strlen(wrong), NULL, &problem, diag);
    cr_expect(status < 0 && !problem && ves_diag_errors(diag) > 0 && ves_diag_count(diag) > 0);
    cr_expect(ves_diag_severity(diag, 0) == VES_ERROR && ves_diag_status(diag, 0) < 0);
    cr_expect(ves_diag_text(diag, 0, text, sizeof text) == strlen(text) && strstr(text, "w.yaml:1:1: error:"),
              "%s", text);
    problem = (ves_problem *)&wrong;
    cr_expect_eq(ves_problem_read_text("w.yaml", wrong, strlen(wrong), NULL, &problem, NULL), status);
    cr_expect(problem == NULL, "without a diag");
    cr_expect_eq(ves_problem_read("/nowhere.yaml", NULL, &problem, NULL), VES_IO);
    cr_expect(problem == NULL && strlen(ves_status_text(VES_IO)) > 0);
    ves_diag_destroy(diag);
    diag = ves_diag_create();
    ves_mark mark = {.source = ves_diag_source(diag, "mine", "one two\n", 8), .line = 1, .column = 5};
    cr_expect_eq(ves_diag_add(diag, VES_WARNING, VES_RANGE, mark, "not %d", 2), VES_RANGE);
    cr_expect(ves_diag_count(diag) == 1 && ves_diag_errors(diag) == 0);
    ves_diag_text(diag, 0, text, sizeof text);
    cr_expect(strstr(text, "mine:1:5: warning: not 2"), "%s", text);
    for (int k = -1; k <= 1; k += 2) {
        cr_expect(ves_diag_text(diag, k, text, sizeof text) == 0 && text[0] == 0);
        cr_expect(ves_diag_severity(diag, k) == VES_NOTE && ves_diag_status(diag, k) == VES_OK);
    }
    ves_diag_destroy(diag);
    cr_expect(ves_diag_text(NULL, 0, text, sizeof text) == 0 && ves_diag_status(NULL, 0) == VES_OK);
    cr_expect(ves_diag_severity(NULL, 0) == VES_NOTE && ves_diag_count(NULL) == 0);
    ves_diag_destroy(NULL);
}

/* --- a plan --- */

static ves_plan *plan_make(const ves_problem *problem)
{
    ves_plan *plan;
    cr_assert_eq(ves_plan_create(problem, NULL, &plan, NULL), VES_OK);
    return plan;
}

/* V = pi r^2 h and A = 2 pi r (r + h), to rounding: cylinders and discs are met exactly. */
Test(api, a_plan_gives_values_and_gradients)
{
    ves_problem *problem = read_file("bottle");
    ves_plan *plan = plan_make(problem);
    double x[2] = {0.7, 1.3}, gradient[2], constraint[1], jacobian[2], r = x[0], h = x[1];
    ves_verdict verdict = {.constraint = constraint, .gradient = gradient, .jacobian = jacobian};
    ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
    cr_assert_eq(ves_plan_evaluate(plan, &ask, &verdict), VES_OK);
    /* the quadrature of polynomials is exact: rounding, 1e-15 was seen */
    cr_expect(fabs(verdict.value + PI * r * r * h) < 1e-13, "a maximum is the minimum of its negative");
    cr_expect(fabs(gradient[0] + 2 * PI * r * h) < 1e-12 && fabs(gradient[1] + PI * r * r) < 1e-12);
    double area = 2 * PI * r * (r + h), size = 3 * PI;
    cr_expect(fabs(constraint[0] - (area - size) / size) < 1e-13);
    cr_expect(fabs(jacobian[0] - 2 * PI * (2 * r + h) / size) < 1e-12);
    ves_verdict better = verdict, failed = {.status = VES_FOLDED, .violation = HUGE_VAL};
    better.violation = 0;
    cr_expect(ves_verdict_better(&better, &verdict, VES_FEASIBLE) &&
              !ves_verdict_better(&failed, &verdict, VES_FEASIBLE));
    cr_expect(ves_verdict_energy(&better, 10, VES_FEASIBLE) == verdict.value);
    cr_expect(ves_verdict_energy(&failed, 10, VES_FEASIBLE) == HUGE_VAL);
    ves_plan_destroy(plan);
    ves_plan_destroy(NULL);
    ves_problem_destroy(problem);
}

Test(api, a_design_has_the_sign_and_the_names_of_the_file)
{
    ves_problem *problem = read_file("bottle");
    ves_plan *plan = plan_make(problem);
    ves_design design;
    double x[2] = {0.5, 1};
    for (int level = 0; level < 2; level++) {
        cr_assert_eq(ves_plan_measure(plan, x, level, &design), VES_OK);
        cr_expect(fabs(design.objective - PI / 4) < 1e-12 && design.measure[0] == design.objective);
        cr_expect(fabs(design.side[0].value - 1.5 * PI) < 1e-12 && design.side[0].limit == 3 * PI);
        cr_expect(fabs(design.violation - 0.5) < 1e-12 && !design.side[0].holds && !design.feasible);
        cr_expect(design.x[0] == 0.5 && design.slot[1] == 1 && design.similarity == 1);
    }
    cr_expect_eq(ves_plan_measure(plan, x, 2, &design), VES_RANGE);
    ves_design other = design;
    double measure[2] = {design.measure[0] * 1.25, design.measure[1]};
    other.measure = measure;
    cr_expect(ves_plan_change(plan, &design, &other) == 0.2 && ves_plan_change(plan, &other, &other) == 0);
    other.status = VES_FOLDED;
    cr_expect(isnan(ves_plan_change(plan, &design, &other)));
    cr_expect(ves_plan_measure_size(plan, 0) > 0 && ves_plan_measure_size(plan, -1) == 0);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    problem = read_text(SOLVED, NULL);
    plan = plan_make(problem);
    cr_assert_eq(ves_plan_measure(plan, x, 0, &design), VES_OK);
    cr_expect(fabs(design.slot[1] - 8 / PI) < 1e-12, "pi / 4 h = 2, got %.15g", design.slot[1]);
    cr_expect(design.slot[slot_of(problem, "half")] == 0.25 && design.slot[slot_of(problem, "goal")] == 2);
    cr_expect(design.feasible);
    x[0] = 50; /* far too wide: h would have to be less than 0.01 */
    cr_expect_eq(ves_plan_measure(plan, x, 0, &design), VES_NO_ROOT);
    cr_expect(design.status == VES_NO_ROOT && design.x[0] == 50 && isnan(design.measure[0]));
    cr_expect(isnan(design.objective) && !design.feasible && !design.side[0].holds);
    ves_figure *figure = (ves_figure *)plan;
    ves_diag *diag = ves_diag_create();
    cr_expect_eq(ves_plan_figure(plan, x, 0, 0, &figure, diag), VES_NO_ROOT);
    cr_expect(figure == NULL && ves_diag_errors(diag) == 1);
    ves_diag_destroy(diag);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
}

Test(api, a_plan_tells_its_grid_and_its_patches)
{
    ves_problem *problem = read_file("curvature");
    ves_plan *plan = plan_make(problem), *same;
    int grid[2], again[2];
    double change = ves_plan_grid(plan, grid), u[2] = {0, 1}, v[2] = {0, 0}, at[6][3][2], spine[3][3][2];
    cr_expect(grid[0] >= 16 && grid[1] >= 16 && change <= 1e-9, "%d x %d, %g", grid[0], grid[1], change);
    cr_assert_eq(ves_plan_create(problem, &(ves_plan_options){{grid[0], 40}}, &same, NULL), VES_OK);
    cr_expect(isnan(ves_plan_grid(same, again)) && again[0] == grid[0] && again[1] == 40);
    ves_plan_destroy(same);
    static const int wrong[][2] = {{-1, 8}, {8, -1}, {4097, 8},    {8, 1 << 30},
                                   {4, 8},  {8, 4},  {4096, 4096}, {0, 65536}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++)
        cr_expect_eq(ves_plan_create(problem, &(ves_plan_options){{wrong[k][0], wrong[k][1]}}, &same, NULL),
                     VES_RANGE);
    double left;
    cr_assert_eq(ves_plan_choose(problem, NULL, again, &left), VES_OK);
    cr_expect(left == change && again[0] == grid[0] && again[1] == grid[1]);
    cr_expect(ves_plan_joints(plan) == 0 && ves_plan_joint(plan, 0, NULL) == VES_RANGE);
    cr_expect_str_eq(ves_joint_text(VES_JOINT_C2), "C2");
    ves_patch_facts facts = ves_plan_patch(plan, 0);
    cr_expect(facts.band >= 1 && facts.modes == facts.band && facts.tail == 0);
    cr_assert_eq(ves_plan_points(plan, 0, 2, u, v, &at[0][0][0]), VES_OK);
    /* the rings have radius 1 and lie in the planes y = 0 and y = 2 */
    cr_expect(fabs(at[0][1][0]) < 1e-14 && fabs(at[0][1][1] - 2) < 1e-14);
    cr_expect(fabs(hypot(at[0][0][0], at[0][2][0]) - 1) < 1e-14);
    cr_assert_eq(ves_plan_spine(plan, 0, 2, u, &spine[0][0][0]), VES_OK);
    cr_expect(fabs(spine[0][1][0]) < 1e-14 && fabs(spine[0][1][1] - 2) < 1e-14);
    for (int k = -1; k < 2; k += 2) {
        cr_expect_eq(ves_plan_points(plan, k, 2, u, v, &at[0][0][0]), VES_RANGE);
        cr_expect_eq(ves_plan_spine(plan, k, 2, u, &spine[0][0][0]), VES_RANGE);
        cr_expect(ves_plan_patch(plan, k).band + ves_plan_shell(plan, 0).order == 0);
    }
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
}

/* The wall's radius is r - 0.5 at its upper end. */
Test(api, a_number_outside_its_range_is_told_with_its_place)
{
    static const char file[] =
        "vesica: 1\nvariables: {r: [0.1, 1, 2]}\n"
        "curves: {p: {circle: {radius: 1}}, q: {circle: {radius: r - 0.5, centre: [0, 0, 1]}}}\n"
        "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"
        "minimize: area\n";
    ves_problem *problem;
    ves_diag *diag = ves_diag_create();
    cr_assert_eq(ves_problem_read_text("f.yaml", file, strlen(file), NULL, &problem, diag), VES_OK);
    ves_plan *plan = plan_make(problem);
    ves_design design;
    double x = 0.25;
    char text[500];
    cr_expect_eq(ves_plan_measure(plan, &x, 0, &design), VES_OUTSIDE);
    ves_plan_why(plan, VES_OUTSIDE, "mine", diag);
    ves_diag_text(diag, 0, text, sizeof text);
    cr_expect(strstr(text, "f.yaml:3:") && strstr(text, "warning: mine: \"radius\" must be >= 0, got -0.25"),
              "%s", text);
    ves_diag_destroy(diag);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
}

Test(api, a_run_finds_the_best_and_tells_all_about_it)
{
    ves_problem *problem = read_file("bottle");
    ves_run *run;
    static const ves_run_options wrong[] = {
        {.evaluations = -1}, {.jobs = -1}, {.trace = (ves_trace)9}, {.trace = (ves_trace)-1}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++)
        cr_expect_eq(ves_run_create(problem, &wrong[k], NULL, &run, NULL), VES_RANGE);
    cr_assert_eq(ves_run_create(problem, NULL, NULL, &run, NULL), VES_OK);
    cr_assert(run->any && run->searched && run->problem == problem);
    cr_expect(run->feasible && run->passed && run->expects >= 1 && run->expect[0].passed);
    cr_expect(run->folder == NULL && run->jobs >= 1 && run->quadrature[0] >= 16);
    /* slsqp ends a step after its tolerance of 1e-12 is met: 2e-15 and a violation of 6e-16 were seen */
    cr_expect(fabs(run->best.objective - PI / sqrt(2)) < 1e-9, "%.12g", run->best.objective);
    cr_expect(run->best.measure[0] == run->best.objective && run->best.violation < 1e-9);
    cr_expect(run->best.side[0].holds && run->best.side[0].limit == 3 * PI);
    cr_assert(run->joints == 2 && !strcmp(run->joint[1].curve, "high") && run->joint[1].end[0] == 1);
    cr_expect(fabs(run->joint[1].angle - PI / 2) < 1e-14 && run->joint[1].continuity == VES_JOINT_C0);
    cr_expect(fabs(run->best.x[0] - sqrt(0.5)) < 1e-6 && run->finer_change < 1e-9);
    cr_expect(fabs(run->start.objective - PI / 4) < 1e-12 && !run->start.feasible);
    cr_assert(run->optima >= 1);
    cr_expect(run->optimum[0].value > 0 && run->optimum[0].hits >= 1 && !run->optimum[0].saddle);
    cr_expect(fabs(run->optimum[0].x[0] - run->best.x[0]) < 1e-12);
    cr_expect(run->evaluations > 100 && run->gradients > 0);
    cr_expect(run->ending == VES_ENDED_DONE && strstr(run->stop, "converged"), "%s", run->stop);
    for (int k = 0; k < run->notes; k++) cr_expect(strlen(run->note[k]) > 0);
    for (int k = 0; k < run->failures; k++) cr_expect(run->failure[k].count > 0 && run->failure[k].status);
    cr_expect(run->times.wall >= run->times.search && run->times.stages == 2);
    ves_run_destroy(run);
    ves_run_destroy(NULL);
    ves_problem_destroy(problem);
}

typedef struct listener {
    int begun, heard;
    bool stop;
} listener;

static void begun(void *data, const ves_run *run)
{
    listener *l = data;
    l->begun++;
    cr_expect(run->searched && run->seed == 5 && run->jobs == 2 && run->start.status == VES_OK);
}

static void heard(void *data, const ves_progress *progress)
{
    listener *l = data;
    l->heard++;
    cr_expect(!progress->any || progress->value > 0, "the sign of the file");
}

static bool stopped(void *data)
{
    const listener *l = data;
    return l->stop && l->heard > 0;
}

Test(api, a_run_says_why_it_ended)
{
    ves_problem *problem = read_file("bottle");
    for (int k = 0; k < 2; k++) {
        listener l = {.stop = k};
        ves_run *run;
        ves_run_options options = {.seeded = true, .seed = 5, .evaluations = k ? 0 : 20, .jobs = 2};
        ves_run_hooks hooks = {begun, heard, stopped, &l};
        cr_assert_eq(ves_run_create(problem, &options, &hooks, &run, NULL), VES_OK);
        cr_expect_eq(run->ending, k ? VES_ENDED_STOPPED : VES_ENDED_BUDGET, "%s", run->stop);
        cr_expect(k || (run->evaluations <= 20 && run->notes > 0), "%ld", run->evaluations);
        cr_expect(l.begun == 1 && l.heard > 0);
        ves_run_destroy(run);
    }
    ves_problem_destroy(problem);
}

static bool at_once(void *data)
{
    (void)data;
    return true;
}

Test(api, a_run_that_is_stopped_before_it_begins_has_its_start)
{
    ves_problem *problem = read_file("bottle");
    ves_run *run;
    ves_run_hooks hooks = {.stopped = at_once};
    cr_assert_eq(ves_run_create(problem, NULL, &hooks, &run, NULL), VES_OK);
    cr_expect(run->ending == VES_ENDED_STOPPED && run->any && !run->feasible);
    cr_expect(run->best.objective == run->start.objective);
    ves_run_destroy(run);
    ves_problem_destroy(problem);
}

Test(api, a_plan_is_searched_with_options_of_ones_own)
{
    ves_problem *problem = read_file("bottle");
    ves_plan *plan[2] = {plan_make(problem), NULL};
    int grid[2];
    double x[2], mine[2] = {1, 3};
    ves_plan_grid(plan[0], grid);
    cr_assert_eq(ves_plan_create(problem, &(ves_plan_options){{grid[0], grid[1]}}, &plan[1], NULL), VES_OK);
    for (int workers = 1; workers <= 2; workers++) {
        ves_search_problem search = ves_plan_search(plan, workers);
        cr_expect(search.n == 2 && search.m == 1 && search.equality[0] && search.gradients);
        cr_expect(search.lower[0] == 0.2 && search.upper[1] == 4 && search.start[1] == 1);
        cr_expect_str_eq(search.name[0], "r");
        search.start = mine;
        ves_search_options options = ves_search_options_default();
        options.stages = 2;
        options.stage[0] = (ves_stage){.kind = VES_STAGE_ANNEAL, .anneal = ves_anneal_default()};
        options.stage[0].anneal.evaluations = 400;
        options.stage[1] = (ves_stage){.kind = VES_STAGE_POLISH, .polish = ves_polish_default()};
        options.stage[1].polish.algorithm = "slsqp";
        ves_search_result *result;
        cr_assert_eq(ves_search_run(&search, &options, NULL, &result), VES_OK);
        cr_expect(result->feasible && fabs(result->value + PI / sqrt(2)) < 1e-9, "%.12g", result->value);
        cr_expect(result->ending == VES_ENDED_DONE && strncmp(result->stop, "slsqp", 5) == 0);
        ves_design best;
        cr_assert_eq(ves_plan_measure(plan[0], result->x, 0, &best), VES_OK);
        cr_expect(best.objective == -result->value && best.feasible, "the sign of the file");
        for (int k = 0; k < 2; k++) {
            cr_expect(workers == 1 || x[k] == result->x[k], "the same for any number of threads");
            x[k] = result->x[k];
        }
        ves_search_result_destroy(result);
    }
    ves_search_result_destroy(NULL);
    bool slsqp = false;
    for (const ves_algorithm *a = ves_search_algorithms(); a->name; a++)
        slsqp = slsqp || (!strcmp(a->name, "slsqp") && a->gradient && a->inequality && a->equality);
    cr_expect(slsqp);
    for (int k = 0; k < 2; k++) ves_plan_destroy(plan[k]);
    ves_problem_destroy(problem);
}

/* --- a mesh --- */

static void edge(const ves_mesh *m, int t, int e, double sum[3])
{
    const double *a = m->point + 3 * m->corner[3 * t + e], *b = m->point + 3 * m->corner[3 * t + (e + 1) % 3];
    for (int c = 0; c < 3; c++) sum[c] = b[c] - a[c];
}

/* Area, volume, and the volume's change when everything is moved: 0 only of a closed mesh. */
static void by_hand(const ves_mesh *m, double out[2], double *open)
{
    double vector[3] = {0};
    out[0] = out[1] = 0;
    for (int t = 0; t < m->triangles; t++) {
        double e[3], f[3], n[3];
        edge(m, t, 0, e), edge(m, t, 1, f);
        for (int c = 0; c < 3; c++)
            n[c] = e[(c + 1) % 3] * f[(c + 2) % 3] - e[(c + 2) % 3] * f[(c + 1) % 3], vector[c] += n[c];
        out[0] += sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]) / 2;
        for (int c = 0; c < 3; c++) out[1] += m->point[3 * m->corner[3 * t] + c] * n[c] / 6;
    }
    *open = fabs(vector[0]) + fabs(vector[1]) + fabs(vector[2]);
}

/* A cylinder of radius 0.8 and height 2 / (0.64 pi), capped; the figure outlives plan and problem. */
Test(api, a_figure_gives_its_mesh)
{
    ves_problem *problem = read_text(SOLVED, NULL);
    ves_plan *plan = plan_make(problem);
    ves_figure *figure;
    ves_mesh m[2];
    double x = 0.8, h = 2 / (PI * x * x), sizes[2][2], open;
    enum { U = 6, V = 200 };
    static const int wrong[][2] = {{-1, 0}, {10001, 8}, {8, 2}, {8, 10001}, {65536, 65536}, {10000, 10000}};
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++)
        cr_expect_eq(ves_plan_figure(plan, &x, wrong[k][0], wrong[k][1], &figure, NULL), VES_RANGE);
    cr_assert_eq(ves_plan_figure(plan, &x, U, V, &figure, NULL), VES_OK);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    for (int welded = 0; welded < 2; welded++) {
        cr_assert_eq(ves_figure_mesh(figure, welded, &m[welded]), VES_OK);
        by_hand(&m[welded], sizes[welded], &open);
        cr_expect(open < 1e-12, "closed: %g", open);
    }
    cr_expect_eq(m[0].triangles, 2 * U * V + 2 * V);
    cr_expect_eq(m[1].triangles, m[0].triangles);
    cr_expect_eq(m[0].vertices, (U + 1) * V + 2 * (V + 1));
    cr_expect_eq(m[1].vertices, (U + 1) * V + 2);
    /* 200 chords: an area and a volume less by (pi / 200)^2 times at most 1 */
    double error = pow(PI / V, 2);
    cr_expect(fabs(sizes[0][1] / 2 - 1) < error && fabs(sizes[1][1] - sizes[0][1]) < 1e-12);
    cr_expect(fabs(sizes[0][0] / (2 * PI * x * (x + h)) - 1) < error);
    cr_expect(!m[1].normal && !m[1].H && !m[1].K && !m[1].k1 && !m[1].k2);
    for (int k = 0; k < m[0].vertices; k++) {
        const double *p = m[0].point + 3 * k, *n = m[0].normal + 3 * k, out = p[2] > h / 2 ? 1 : -1;
        bool cap = m[0].patch[k] < 0, wall = m[0].patch[k] == 0;
        cr_assert(cap || wall);
        cr_assert(m[0].u[k] >= 0 && m[0].u[k] <= 1 && m[0].v[k] >= 0 && m[0].v[k] < 2 * PI);
        if (wall) cr_assert(fabs(p[2] - m[0].u[k] * h) < 1e-12 && fabs(p[0] - x * cos(m[0].v[k])) < 1e-12);
        /* a wall has k1 = 1/r, k2 = 0 */
        cr_assert(fabs(m[0].k1[k] - (wall ? 1 / x : 0)) < 1e-12 && fabs(m[0].k2[k]) < 1e-12);
        cr_assert(fabs(m[0].H[k] - (wall ? 0.5 / x : 0)) < 1e-12 && fabs(m[0].K[k]) < 1e-12);
        if (wall) cr_assert(fabs(n[0] - p[0] / x) < 1e-12 && fabs(n[1] - p[1] / x) < 1e-12);
        if (cap) cr_assert(fabs(n[2] - out) < 1e-12);
    }
    for (int k = 0; k < m[1].vertices; k++) cr_assert(m[1].patch[k] == 0 || m[1].patch[k] == -1);
    ves_mesh again;
    cr_expect(ves_figure_mesh(figure, true, &again) == VES_OK && again.point == m[1].point, "made once");
    ves_figure_destroy(figure);
    ves_figure_destroy(NULL);
}

Test(api, a_figure_is_written_and_drawn)
{
    ves_problem *problem = read_file("bottle");
    ves_plan *plan = plan_make(problem);
    ves_figure *figure;
    ves_diag *diag = ves_diag_create();
    char path[] = "/tmp/vesica-api-XXXXXX", file[100];
    double x[2] = {0.7, 1.4};
    cr_assert(mkdtemp(path) != NULL);
    cr_assert_eq(ves_plan_figure(plan, x, 8, 16, &figure, diag), VES_OK);
    snprintf(file, sizeof file, "%s/bottle.stl", path);
    cr_expect_eq(ves_figure_write(figure, file, diag), VES_OK);
    cr_expect_eq(remove(file), 0);
    cr_expect_eq(ves_figure_write(figure, "/tmp/bottle.dwg", diag), VES_USAGE);
    ves_view view = ves_view_default();
    view.width = 200, view.height = 100, view.colour = "H";
    for (int k = 0; k < 2; k++) {
        snprintf(file, sizeof file, "%s/bottle.%s", path, k ? "svg" : "png");
        cr_expect_eq(ves_picture_write(figure, k ? NULL : &view, file, diag), VES_OK);
        cr_expect_eq(remove(file), 0);
    }
    cr_expect_eq(ves_picture_write(figure, &view, "bottle.jpg", diag), VES_NAME);
    rmdir(path);
    ves_figure_destroy(figure);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}

/* --- a measure of one's own --- */

static const ves_key keys[] = {
    {.name = "twice", .kind = VES_FLAG, .about = "count it twice"},
    {.name = "near", .kind = VES_CURVE, .about = "a curve that is left out"},
    {.name = "of", .kind = VES_CURVE, .required = true, .about = "the curve"},
    {.name = "along", .kind = VES_VECTOR, .fallback = 1e300, .about = "three of any size"},
    {0},
};

/* Length of a curve: the integral of |Xv| dv. */
static ves_status length(const ves_measure_input *input, double *value)
{
    const ves_samples *s = ves_sample_of(input, 2);
    double sum = 0;
    for (int n = 0; n < s->count; n++)
        sum += s->weight[n] * hypot(hypot(s->Xv[0][n], s->Xv[1][n]), s->Xv[2][n]);
    *value = (ves_sample_index(input, 1) < 0 ? 1 : -1) * (input->args->arg[0].value ? 2 : 1) * sum;
    return VES_OK;
}

static const ves_measure LENGTH = {.name = "girth",
                                   .about = "length of a curve",
                                   .unit = "m",
                                   .degree = 1,
                                   .curve = VES_XV,
                                   .keys = keys,
                                   .eval = length};

Test(api, a_program_brings_a_measure)
{
    static const ves_measure *const list[] = {&LENGTH, NULL};
    static const ves_override set[] = {{"r", "1.25"}};
    const ves_read_options options = {.overrides = 1, .override = set, .plugin = list};
    ves_problem *problem = read_text(
        "vesica: 1\nvariables: {r: [0.5, 1, 2]}\n"
        "curves: {p: {circle: {radius: r}}, q: {circle: {radius: 1, centre: [0, 0, 1]}}}\n"
        "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"
        "measures: {one: {girth: {of: p}}, two: {girth: {of: p, twice: true}}, three: {girth: {near: q, of: "
        "p}}}\n"
        "minimize: one\nconstraints: [two >= 3, three <= 1]\n",
        &options);
    ves_plan *plan = plan_make(problem);
    ves_design design;
    double start;
    ves_problem_variable(problem, 0, NULL, &start, NULL);
    cr_expect(start == 1.25, "--set");
    cr_assert_eq(ves_plan_measure(plan, &start, 0, &design), VES_OK);
    static const double times[] = {1, 2, -1};
    for (int k = 0; k < 3; k++)
        cr_expect(fabs(design.measure[k] - times[k] * 2.5 * PI) < 1e-12, "%s: %.15g",
                  ves_problem_measure(problem, k), design.measure[k]);
    cr_expect(!ves_plan_search(&plan, 1).gradients, "it has none");
    double gradient, constraint[2], jacobian[2];
    ves_verdict verdict = {.gradient = &gradient, .constraint = constraint, .jacobian = jacobian};
    ves_ask ask = {.x = &start, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
    cr_expect_eq(ves_plan_evaluate(plan, &ask, &verdict), VES_ABSENT);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
}

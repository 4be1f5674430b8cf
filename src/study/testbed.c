#include "study/testbed.h"

#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "problem/problem.h"
#include "study/run.h"

/* Evaluations are timed until so many have been asked or so many seconds are over. */
enum { TIMED = 200 };
static const double timed_seconds = 0.02;

static ves_status evaluate_instance(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    ves_pose *pose = data;
    (void)worker;
    return ves_instance_eval(&pose->instance, ask->x, ask->want & VES_WANT_GRADIENT, verdict, pose->room);
}

static double width(const ves_search_problem *p, int i)
{
    return p->upper[i] - p->lower[i];
}

void ves_testbed_place(const ves_pose *pose, const double *u, double *x)
{
    const ves_search_problem *p = &pose->file;
    for (int i = 0; i < p->n; i++) {
        x[i] = p->lower[i] + u[i] * width(p, i);
        x[i] = fmin(fmax(x[i], p->lower[i]), p->upper[i]);
    }
}

static ves_status evaluate_file(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    ves_pose *pose = data;
    const ves_search_problem *p = &pose->file;
    ves_ask inner = *ask;
    inner.x = pose->x;
    (void)worker;
    ves_testbed_place(pose, ask->x, pose->x);
    ves_status status = p->evaluate(p->data, 0, &inner, verdict);
    if (status != VES_OK || verdict->status != VES_OK || !(ask->want & VES_WANT_GRADIENT)) return status;
    for (int i = 0; i < p->n; i++) {
        verdict->gradient[i] *= width(p, i);
        for (int j = 0; j < p->m; j++) verdict->jacobian[(size_t)j * p->n + i] *= width(p, i);
    }
    return VES_OK;
}

static ves_status same_file(void *data, const double *a, const double *b, bool *same)
{
    ves_pose *pose = data;
    const ves_search_problem *p = &pose->file;
    double *other = pose->room;
    ves_testbed_place(pose, a, pose->x);
    ves_testbed_place(pose, b, other);
    return p->same(p->data, pose->x, other, same);
}

static ves_status pose_instance(ves_testbed *testbed, int seed, ves_arena *arena, ves_pose *pose)
{
    const ves_suite_problem *problem = testbed->problem;
    VES_TRY(ves_instance_init(arena, problem->landscape, problem->n, problem->turned, testbed->seed, seed,
                              &pose->instance));
    pose->problem.n = pose->instance.n;
    pose->problem.m = pose->instance.m;
    pose->problem.equality = pose->instance.equality;
    pose->problem.gradients = true;
    pose->problem.evaluate = evaluate_instance;
    pose->optimum = pose->instance.optimum;
    return VES_OK;
}

static ves_status plan_of(ves_testbed *testbed, int worker, ves_diag *diag)
{
    const ves_plan_options grid = {{testbed->grid[0], testbed->grid[1]}};
    if (testbed->plan[worker]) return VES_OK;
    return ves_plan_create(testbed->source, testbed->grid[0] ? &grid : NULL, &testbed->plan[worker], diag);
}

static ves_status pose_file(ves_testbed *testbed, int worker, ves_pose *pose)
{
    VES_TRY(plan_of(testbed, worker, NULL));
    pose->file = ves_plan_search(&testbed->plan[worker], 1);
    pose->problem = pose->file;
    pose->problem.evaluate = evaluate_file;
    if (pose->file.same) pose->problem.same = same_file;
    pose->optimum = testbed->facts.maximize ? -testbed->problem->optimum : testbed->problem->optimum;
    return VES_OK;
}

/* In its own units: behind evaluate_file, as a problem file is. */
static ves_status evaluate_plugin(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    ves_pose *pose = data;
    (void)worker;
    return pose->objective->eval(pose->state, ask->x, ask->want & VES_WANT_GRADIENT, verdict);
}

static ves_status pose_plugin(ves_testbed *testbed, int worker, ves_pose *pose)
{
    const ves_objective *o = testbed->objective;
    if (o->create && !testbed->state[worker]) testbed->state[worker] = o->create();
    if (o->create && !testbed->state[worker]) return VES_MEMORY;
    pose->objective = o;
    pose->state = testbed->state[worker];
    pose->file = (ves_search_problem){.n = o->n,
                                      .m = o->m,
                                      .lower = o->lower,
                                      .upper = o->upper,
                                      .equality = o->equality,
                                      .gradients = o->gradients,
                                      .evaluate = evaluate_plugin,
                                      .data = pose};
    pose->problem = pose->file;
    pose->problem.evaluate = evaluate_file;
    pose->optimum = isnan(testbed->problem->optimum) ? o->optimum : testbed->problem->optimum;
    return VES_OK;
}

ves_status ves_testbed_pose(ves_testbed *testbed, int worker, int seed, ves_arena *arena, ves_pose *pose)
{
    *pose = (ves_pose){.optimum = NAN};
    if (testbed->problem->kind == VES_SUITE_LANDSCAPE)
        VES_TRY(pose_instance(testbed, seed, arena, pose));
    else if (testbed->problem->kind == VES_SUITE_PLUGIN)
        VES_TRY(pose_plugin(testbed, worker, pose));
    else
        VES_TRY(pose_file(testbed, worker, pose));
    size_t n = (size_t)pose->problem.n;
    double *bound = ves_arena_take(arena, 2 * n, sizeof *bound);
    pose->room = ves_arena_take(arena, 2 * n, sizeof *pose->room);
    pose->x = ves_arena_take(arena, n, sizeof *pose->x);
    if (!bound || !pose->room || !pose->x) return VES_MEMORY;
    for (size_t i = 0; i < n; i++) bound[n + i] = 1;
    pose->problem.lower = bound;
    pose->problem.upper = bound + n;
    pose->problem.start = NULL;
    pose->problem.name = NULL;
    pose->problem.others = 0;
    pose->problem.data = pose;
    pose->problem.workers = 1;
    return VES_OK;
}

/* Seconds of one evaluation at random points; NAN: none could be measured. */
static double timed(const ves_search_problem *p, bool slopes, ves_arena *arena)
{
    size_t n = (size_t)p->n, m = (size_t)p->m;
    double *u = ves_arena_take(arena, 2 * n + m + m * n, sizeof *u);
    if (!u || (slopes && !p->gradients)) return NAN;
    ves_verdict verdict = {.gradient = u + n, .constraint = u + 2 * n, .jacobian = u + 2 * n + m};
    const ves_ask ask = {.x = u, .cutoff = HUGE_VAL, .want = slopes ? VES_WANT_GRADIENT : VES_WANT_VALUE};
    double sum = 0;
    int count = 0;
    for (int k = 0; k < TIMED && sum < timed_seconds; k++) {
        ves_instance_start(1, k, p->n, u);
        verdict.status = VES_OK;
        double begin = ves_study_clock();
        bool good = p->evaluate(p->data, 0, &ask, &verdict) == VES_OK && verdict.status == VES_OK;
        if (good) sum += ves_study_clock() - begin, count++;
    }
    return count ? sum / count : NAN;
}

static const char *eliminated(const ves_problem *problem)
{
    if (!problem || (!problem->scale && !problem->solve)) return "";
    return !problem->solve ? "scale" : problem->scale ? "scale, solve" : "solve";
}

static ves_status facts_find(ves_testbed *testbed, ves_diag *diag)
{
    ves_arena arena = {0};
    ves_pose pose;
    ves_status status = ves_testbed_pose(testbed, 0, 0, &arena, &pose);
    if (status == VES_OK) {
        const ves_search_problem *p = &pose.problem;
        testbed->facts = (ves_bench_problem){.n = p->n,
                                             .m = p->m,
                                             .maximize = testbed->facts.maximize,
                                             .eliminated = eliminated(testbed->source),
                                             .gradients = p->gradients,
                                             .optimum = pose.optimum};
        for (int j = 0; j < p->m; j++) testbed->facts.equalities += p->equality && p->equality[j];
        testbed->facts.seconds = timed(p, false, &arena);
        testbed->facts.seconds_gradient = timed(p, true, &arena);
    }
    ves_arena_destroy(&arena);
    return status == VES_OK ? VES_OK : ves_diag_fail(diag, status);
}

static ves_status file_open(ves_testbed *testbed, ves_diag *diag)
{
    const ves_suite_problem *problem = testbed->problem;
    const ves_read_options options = {.overrides = problem->sets, .override = problem->set, .inner = true};
    int base = ves_diag_base(diag, -1); /* of the marks in this file */
    ves_status status = ves_problem_read(problem->path, &options, &testbed->source, diag);
    bool named = status == VES_OK && ves_problem_variables(testbed->source) >= 1 &&
                 ves_problem_objective(testbed->source, &testbed->facts.maximize);
    if (named) status = plan_of(testbed, 0, diag);
    ves_diag_base(diag, base);
    if (status != VES_OK)
        return ves_diag_add(diag, VES_NOTE, status, problem->mark, "it is a problem of this suite");
    if (!named)
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, problem->mark,
                            "\"%s\" has no objective or no variables: there is nothing to compare",
                            problem->path);
    ves_plan_grid(testbed->plan[0], testbed->grid);
    return VES_OK;
}

static ves_status plugin_open(ves_testbed *testbed, ves_diag *diag)
{
    const ves_suite_problem *problem = testbed->problem;
    if (!testbed->hooks->load)
        return ves_diag_add(diag, VES_ERROR, VES_ABSENT, problem->mark, "this program loads no plugins");
    ves_status status =
        testbed->hooks->load(testbed->hooks->data, problem->path, problem->objective, &testbed->objective);
    if (status != VES_OK)
        ves_diag_add(diag, VES_NOTE, status, problem->mark, "it is a problem of this suite");
    return status;
}

ves_status ves_testbed_open(ves_testbed *testbed, ves_arena *arena, ves_diag *diag)
{
    testbed->plan = ves_arena_take(arena, (size_t)testbed->jobs, sizeof(ves_plan *));
    testbed->state = ves_arena_take(arena, (size_t)testbed->jobs, sizeof(void *));
    if (!testbed->plan || !testbed->state) return ves_diag_fail(diag, VES_MEMORY);
    if (testbed->problem->kind == VES_SUITE_PLUGIN) VES_TRY(plugin_open(testbed, diag));
    if (testbed->problem->kind == VES_SUITE_FILE) VES_TRY(file_open(testbed, diag));
    return facts_find(testbed, diag);
}

void ves_testbed_close(ves_testbed *testbed)
{
    for (int k = 0; testbed->plan && k < testbed->jobs; k++) ves_plan_destroy(testbed->plan[k]);
    for (int k = 0; testbed->state && k < testbed->jobs; k++)
        if (testbed->state[k]) testbed->objective->destroy(testbed->state[k]);
    ves_problem_destroy(testbed->source);
    testbed->plan = NULL;
    testbed->state = NULL;
    testbed->source = NULL;
}

/* Memory: nothing is allocated in the loop, and every allocation that fails is a clean VES_MEMORY. */
#include <criterion/criterion.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/arena.h"
#include "fonts.h"
#include "memory.h"
#include "problem/problem.h"
#include "surface/figure.h"
#include "vesica/plan.h"
#include "vesica/run.h"

static bool libraries, pieces;

/* A piece of an arena is rarely a call of the allocator, and whoever takes it must still look at what it got.
 */
void *__real_ves_arena_take(ves_arena *arena, size_t count, size_t size);
double *__real_ves_arena_doubles(ves_arena *arena, size_t count);
char *__real_ves_arena_text(ves_arena *arena, const char *text, size_t length);
void *__wrap_ves_arena_take(ves_arena *arena, size_t count, size_t size);
double *__wrap_ves_arena_doubles(ves_arena *arena, size_t count);
char *__wrap_ves_arena_text(ves_arena *arena, const char *text, size_t length);

void *__wrap_ves_arena_take(ves_arena *arena, size_t count, size_t size)
{
    return !pieces || memory_granted() ? __real_ves_arena_take(arena, count, size) : NULL;
}

double *__wrap_ves_arena_doubles(ves_arena *arena, size_t count)
{
    return !pieces || memory_granted() ? __real_ves_arena_doubles(arena, count) : NULL;
}

char *__wrap_ves_arena_text(ves_arena *arena, const char *text, size_t length)
{
    return !pieces || memory_granted() ? __real_ves_arena_text(arena, text, length) : NULL;
}

/* Curves of several kinds, a patch with a remainder, equations, measures of several sites. */
static const char TEXT[] =
    "vesica: 1\nquadrature: {u: 16, v: 16}\nvariables: {r: [0.8, 1.1, 1.6], t: [-0.3, 0.1, "
    "0.3]}\nparameters: {lid: r + 1}\n"
    "solve: {unknown: h, in: [0.2, 9], equation: volume == 3 + 0.1*t}\n"
    "curves:\n  p: {circle: {radius: 1}}\n"
    "  q: {bspline: {points: [[r, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]}, apply: [{translate: [t, 0, "
    "h]}]}\n"
    "patches: {wall: {operator: {power: 1, a: 1.3}, modes: 6, conditions: [{u: 0, position: p}, {u: 1, "
    "position: q}]}}\n"
    "shape: {closed: true, caps: [wall.u0, wall.u1]}\nplaces: {tip: {patch: wall, u: 0.5, v: 1}}\n"
    "measures: {d: {distance: {from: tip, to: p}}, m: {integral: {of: \"H^2*x\"}}, top: {max: {of: \"z + "
    "k1\"}}}\n"
    "minimize: area + bending + d + m + top + width\nconstraints: [area <= 14*lid]\n"
    "search: [{anneal: {evaluations: 40, chains: 2}}, {polish: {evaluations: 20, starts: 1, escape: "
    "false}}]\n";

static ves_status search(const ves_problem *p, ves_plan *plan)
{
    ves_search_problem problem = ves_plan_search(&plan, 1);
    ves_search_result *result = NULL;
    ves_status status = ves_search_run(&problem, &p->search, NULL, &result);
    ves_search_result_destroy(result);
    return status;
}

static ves_status whole(void)
{
    ves_problem *problem = NULL;
    ves_plan *plan = NULL;
    ves_figure *figure = NULL;
    ves_read_options options = {0};
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_problem_read_text("memory.yaml", TEXT, strlen(TEXT), &options, &problem, diag);
    if (status == VES_OK) status = ves_plan_create(problem, NULL, &plan, diag);
    if (status == VES_OK) status = search(problem, plan);
    double x[2] = {1.1, 0.1};
    if (status == VES_OK) status = ves_plan_figure(plan, x, 8, 8, &figure, diag);
    ves_mesh mesh;
    if (status == VES_OK) status = ves_figure_mesh(figure, false, &mesh);
    ves_figure_destroy(figure);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
    return status;
}

/* The whole of `vesica run`: plans for two threads, the search, the folder with its files and the picture. */
static ves_status run(void)
{
    static const char *const file[] = {"problem.yaml", "result.json", "times.json", "trace.jsonl",  "log.txt",
                                       "best.vtp",     "start.vtp",   "best.png",   "run.json",     "journal",
                                       "journal.part", "lock",        "optima.png", "annealing.png"};
    char folder[300], path[400];
    snprintf(folder, sizeof folder, "%s/test_allocation.%ld", VESICA_BUILD, (long)getpid());
    ves_problem *problem = NULL;
    ves_run *all = NULL;
    ves_run_options options = {.evaluations = 40, .jobs = 2, .files = true, .out = folder};
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_problem_read_text("memory.yaml", TEXT, strlen(TEXT), NULL, &problem, diag);
    if (status == VES_OK) status = ves_run_create(problem, &options, NULL, &all, diag);
    bool silent = status != VES_OK && diag && ves_diag_errors(diag) != 1, half = status == VES_OK && !all;
    ves_run_destroy(all);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
    for (size_t k = 0; k < sizeof file / sizeof *file; k++) {
        snprintf(path, sizeof path, "%s/%s", folder, file[k]);
        remove(path);
    }
    rmdir(folder);
    return half || silent ? VES_FAULT : status;
}

/* Everything that is made once, of sheets too: what comes before the search. */
static ves_status ready(void)
{
    static const char sheets[] =
        "vesica: 1\nquadrature: {u: 16, v: 8}\nvariables: {k: [0.5, 1.2, 2]}\n"
        "curves: {p: {fourier: {mean: [0, 0, k], cos: [[1, 0, 0]], sin: [[0, 1, 0]]}}, "
        "q: {points: {points: [[2, 0, 0], [0, 2, 0], [-2, 0, 0]]}}, r: {combine: [[1, p], [k, q]]}}\n"
        "patches:\n  wall: {operator: {power: 2, a: 1}, conditions: [{u: 0, position: p}, {u: 1, position: "
        "r}, "
        "{u: 0, derivative: 1, from: p, to: q}, {u: 1, derivative: 1, from: p, to: q, scale: k}]}\n"
        "  roof: {surface: {formula: [\"k*u\", \"v\", \"sin(k*u)*cos(v)\"]}, periodic: false}\n"
        "  net: {surface: {points: [[[0, 0, k], [1, 0, 0], [2, 0, 0], [3, 0, 0]], [[0, 1, 0], [1, 1, k], "
        "[2, 1, 0], [3, 1, 0]], [[0, 2, 0], [1, 2, 0], [2, 2, 0], [3, 2, 0]], [[0, 3, 0], [1, 3, 0], "
        "[2, 3, 0], [3, 3, 0]]]}, periodic: false}\n"
        "measures: {e: {distance: {from: p, to: q}}, b: {max: {of: H, smooth: 4}}}\n"
        "scale: {equation: area == 2}\nminimize: e + b\nexpect: [feasible]\n";
    static const char seams[] = /* a ring turned against itself, and caps that CGAL must cut */
        "vesica: 1\nquadrature: {u: 16, v: 8}\nvariables: {t: [-2, 1, 2]}\npatches:\n"
        "  ring: {surface: {formula: [\"(3 + cos(v + t*u))*cos(2*pi*u)\", \"(3 + cos(v + "
        "t*u))*sin(2*pi*u)\", "
        "\"sin(v + t*u)\"]}}\n"
        "  wall: {surface: {formula: [\"2*cos(v) + 9\", \"0.4*sin(v) + 1.2*cos(v)^2\", \"2*u\"]}}\n"
        "shape: {closed: true, caps: [wall.u0, wall.u1]}\nminimize: volume\n";
    static const char *const text[] = {TEXT, sheets, seams};
    ves_status status = VES_OK;
    for (int k = 0; k < 3 && status == VES_OK; k++) {
        ves_problem *problem = NULL;
        ves_plan *plan = NULL;
        ves_diag *diag = ves_diag_create();
        status = ves_problem_read_text("memory.yaml", text[k], strlen(text[k]), NULL, &problem, diag);
        if (status == VES_OK) status = ves_plan_create(problem, &(ves_plan_options){{0, 0}}, &plan, diag);
        if (status != VES_OK && diag && ves_diag_errors(diag) != 1) status = VES_FAULT;
        ves_plan_destroy(plan);
        ves_problem_destroy(problem);
        ves_diag_destroy(diag);
    }
    return status;
}

/* Lets call number k fail, for k = 1, 1 + step, ... with `most` of them at most. */
static void starve(const char *what, ves_status (*work)(void), long most)
{
    memory_begin(0, libraries);
    cr_assert_eq(work(), VES_OK, "%s", what);
    memory_end();
    long all = memory.asked, noticed = 0, done = 0, step = 1 + (all - 1) / most;
    cr_assert(memory.live == 0, "%s: %ld blocks lost", what, memory.live);
    for (long k = 1; k <= all; k += step, done++) {
        memory_begin(k, libraries);
        ves_status status = work();
        memory_end();
        /* diagnostics and proofs may do without: the run then goes on */
        cr_assert(status == VES_MEMORY || status == VES_OK, "%s: allocation %ld of %ld: %s", what, k, all,
                  ves_status_text(status));
        cr_assert(memory.live == 0, "%s: allocation %ld of %ld: %ld blocks lost", what, k, all, memory.live);
        noticed += status == VES_MEMORY;
    }
    cr_log_info("%s: %ld calls, %ld failed, %ld of them noticed", what, all, done, noticed);
    cr_expect(noticed >= done - done / 20 - 1, "%s: only %ld of %ld failures were noticed", what, noticed,
              done);
}

Test(allocation, every_failing_allocation_is_a_clean_status, .timeout = 280)
{
    starve("read, plan", ready, LONG_MAX);
    pieces = true;
    starve("read, plan: pieces", ready, 500);
}

Test(allocation, a_run_without_memory_ends_cleanly, .timeout = 280)
{
    starve("run", run, 20);
    pieces = true;
    starve("run: pieces", run, 40);
}

/* Pictures are left out: the libraries below cairo die in their own code then. */
Test(allocation, a_library_without_memory_is_a_clean_status, .timeout = 280)
{
    libraries = true;
    starve("read, plan, search, figure", whole, 60);
}

Test(allocation, an_evaluation_allocates_nothing)
{
    ves_problem *problem;
    ves_plan *plan;
    ves_read_options options = {0};
    ves_diag *diag = ves_diag_create();
    cr_assert_eq(ves_problem_read_text("memory.yaml", TEXT, strlen(TEXT), &options, &problem, diag), VES_OK);
    cr_assert_eq(ves_plan_create(problem, NULL, &plan, diag), VES_OK);
    double x[2] = {1.1, 0.1}, constraint[1], gradient[2], jacobian[2];
    ves_verdict verdict = {.constraint = constraint, .gradient = gradient, .jacobian = jacobian};
    memory_begin(0, true);
    for (int k = 0; k < 50; k++)
        for (int level = 0; level < 2; level++) {
            x[0] = 1.1 + 0.001 * k, x[1] = 0.1 - 0.002 * k;
            ves_ask ask = {.x = x,
                           .level = level,
                           .cutoff = HUGE_VAL,
                           .want = k % 2 ? VES_WANT_GRADIENT : VES_WANT_VALUE};
            cr_assert_eq(ves_plan_evaluate(plan, &ask, &verdict), VES_OK);
            cr_assert_eq(verdict.status, VES_OK);
        }
    memory_end();
    cr_expect_eq(memory.asked, 0, "%ld allocations in 100 evaluations", memory.asked);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}

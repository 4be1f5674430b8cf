#include "study/bench.h"

#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "base/pool.h"
#include "problem/problem.h"
#include "problem/suite.h"
#include "study/bench_about.h"
#include "study/bench_charts.h"
#include "study/bench_folder.h"
#include "study/bench_gallery.h"
#include "study/bench_polish.h"
#include "study/folder.h"
#include "study/optima.h"
#include "study/run.h"
#include "study/team.h"
#include "study/testbed.h"

/* What ves_bench_run makes: first what the caller holds. */
typedef struct bench {
    ves_bench shown;
    ves_arena arena;
    const ves_bench_hooks *hooks;
    const ves_team *team; /* NULL: alone */
    ves_diag *diag;
    ves_testbed *testbed; /* [problems] */
    ves_pool *pool;
    ves_bench_files files;
    int *waiting; /* [mine] runs to be made here, in the order in which they are begun */
    int mine;
    ves_status status; /* the first failure; under the pool's lock */
} bench;

static bool stopped(void *data)
{
    const bench *b = data;
    return b->hooks->stopped && b->hooks->stopped(b->hooks->data);
}

/* --- ranks --- */

/* The first rank tells the others its folder, and what is done. */
static ves_status join(bench *b)
{
    size_t runs = (size_t)b->shown.runs;
    if (!b->team) return VES_OK;
    unsigned char *done = ves_arena_take(&b->arena, runs, 1);
    VES_TRY(ves_team_meet(b->team, done ? VES_OK : ves_diag_fail(b->diag, VES_MEMORY)));
    for (size_t k = 0; k < runs; k++) done[k] = b->shown.outcome[k].done;
    VES_TRY(b->team->tell(b->team->data, done, runs));
    ves_status status = ves_team_path(b->team, &b->shown.folder, &b->arena, b->diag);
    if (ves_team_leads(b->team)) return ves_team_meet(b->team, status);
    for (size_t k = 0; k < runs; k++) b->shown.outcome[k].done = done[k];
    if (status == VES_OK) status = ves_bench_files_join(&b->files, b->shown.folder, b->team->rank, b->diag);
    return ves_team_meet(b->team, status);
}

/* --- one run --- */

static ves_status outcome_take(const ves_trial *trial, ves_outcome *o)
{
    ves_meter *meter = trial->meter;
    o->failed = trial->failed;
    o->hit = meter->hit;
    o->any = meter->any;
    o->budget = meter->budget;
    o->spent = meter->spent;
    o->evaluations = meter->evaluations;
    o->gradients = meter->gradients;
    o->failures = meter->failed;
    o->starts = trial->starts;
    o->value = meter->value;
    o->violation = meter->violation;
    o->n = meter->inner->n;
    o->inside = meter->inside;
    memcpy(o->reason, trial->reason, sizeof o->reason);
    o->x = ves_memory_take((size_t)o->n * sizeof *o->x);
    if (!o->x) return VES_MEMORY;
    memcpy(o->x, meter->x, (size_t)o->n * sizeof *o->x);
    o->steps = meter->steps;
    o->step = meter->step; /* taken over */
    meter->step = NULL;
    return VES_OK;
}

static ves_status trial_run(bench *b, int worker, int index, ves_arena *arena, ves_outcome *outcome)
{
    const ves_suite *suite = b->shown.suite;
    ves_suite_place place = ves_suite_run(suite, index);
    const ves_suite_problem *problem = &suite->problem[place.problem];
    ves_pose pose;
    VES_TRY(ves_testbed_pose(&b->testbed[place.problem], worker, place.seed, arena, &pose));
    bool own = problem->kind == VES_SUITE_FILE;
    ves_meter meter = {.inner = &pose.problem,
                       .budget = ves_suite_budget(suite, pose.problem.n),
                       .cost = suite->cost,
                       .cost_gradient = suite->cost_gradient,
                       .inequality = own ? 0 : suite->inequality,
                       .equality = suite->equality,
                       .target = isnan(pose.optimum)
                                     ? -HUGE_VAL
                                     : ves_suite_value(problem, pose.optimum, suite->target[VES_TARGETS - 1]),
                       .clock = ves_study_clock};
    ves_trial trial = {.method = &suite->method[place.method],
                       .meter = &meter,
                       .seed = ves_suite_seed(suite, problem, place.seed),
                       .stopped = stopped,
                       .data = b};
    ves_status status = ves_meter_begin(&meter) ? VES_OK : VES_MEMORY;
    double begin = ves_study_clock(), cpu = ves_study_thread_clock();
    if (status == VES_OK) status = ves_trial_run(&trial);
    double wall = ves_study_clock() - begin, all = ves_study_thread_clock() - cpu;
    bool inside = trial.method->kind != VES_METHOD_PROGRAM;
    outcome->wall = fmax(wall - trial.aside, 0);
    outcome->cpu = inside ? all * outcome->wall / fmax(wall, 1e-9) : NAN;
    if (status == VES_OK) status = outcome_take(&trial, outcome);
    ves_meter_end(&meter);
    return status;
}

/* Under the lock. */
static ves_status commit(bench *b, int index, ves_outcome *outcome)
{
    outcome->done = true;
    if (b->files.folder) {
        VES_TRY(ves_bench_journal_write(&b->files, index, outcome));
        VES_TRY(ves_bench_line_write(&b->files, b->shown.suite, index, outcome));
    }
    b->shown.done++;
    if (b->hooks->progress) b->hooks->progress(b->hooks->data, &b->shown, index);
    return VES_OK;
}

/* What ended the benchmark: one that has said so of several runs at once would say it twice. */
static ves_status broken(bench *b, int index, ves_status status)
{
    const ves_suite *s = b->shown.suite;
    ves_suite_place place = ves_suite_run(s, index);
    const ves_suite_problem *problem = &s->problem[place.problem];
    if (status == VES_MEMORY || b->status != VES_OK || (status == VES_INTERRUPTED && stopped(b)))
        return status;
    ves_diag_add(b->diag, VES_ERROR, status, problem->mark,
                 "\"%s\" could not be evaluated in run %d of %s, which ends the benchmark: %s (%s)",
                 problem->name, place.seed, s->method[place.method].name, ves_status_word(status),
                 ves_status_text(status));
    return status == VES_INTERRUPTED ? VES_FAULT : status; /* a plugin may return anything */
}

static void task(void *data, int worker, int number)
{
    bench *b = data;
    int index = b->waiting[number];
    ves_outcome *outcome = &b->shown.outcome[index];
    ves_arena arena = {0};
    ves_pool_lock(b->pool);
    ves_status status = b->status;
    ves_pool_unlock(b->pool);
    if (status != VES_OK || stopped(b)) return;
    status = trial_run(b, worker, index, &arena, outcome);
    ves_arena_destroy(&arena);
    ves_pool_lock(b->pool);
    if (status != VES_OK) status = broken(b, index, status);
    if (status == VES_OK) status = commit(b, index, outcome);
    if (status != VES_OK && b->status == VES_OK) b->status = status;
    ves_pool_unlock(b->pool);
}

/* --- all of them --- */

static ves_status testbeds_open(bench *b)
{
    ves_suite *suite = b->shown.suite;
    ves_bench_problem *facts = ves_arena_take(&b->arena, (size_t)suite->problems, sizeof *facts);
    const char **name = ves_arena_take(&b->arena, (size_t)suite->problems, sizeof *name);
    b->testbed = ves_arena_take(&b->arena, (size_t)suite->problems, sizeof *b->testbed);
    if (!b->testbed || !facts || !name) return ves_diag_fail(b->diag, VES_MEMORY);
    for (int k = 0; k < suite->problems; k++) name[k] = suite->problem[k].name;
    if (!ves_folder_names(name, suite->problems, &b->arena)) return ves_diag_fail(b->diag, VES_MEMORY);
    for (int k = 0; k < suite->problems; k++) {
        b->testbed[k] = (ves_testbed){
            .problem = &suite->problem[k], .hooks = b->hooks, .jobs = b->shown.jobs, .seed = suite->seed};
        VES_TRY(ves_testbed_open(&b->testbed[k], &b->arena, b->diag));
        facts[k] = b->testbed[k].facts;
        facts[k].picture = name[k];
    }
    b->shown.problem = facts;
    return VES_OK;
}

/* Of the best run on each problem whose optimum is not known. */
static ves_status polish(bench *b, ves_tally_input *input)
{
    const ves_suite *s = b->shown.suite;
    double *value = ves_arena_take(&b->arena, (size_t)s->problems, sizeof *value);
    if (!value) return ves_diag_fail(b->diag, VES_MEMORY);
    for (int k = 0; k < s->problems; k++) {
        ves_reference best = ves_tally_reference(input, k);
        value[k] = NAN;
        if (best.known || isnan(best.value) || stopped(b)) continue;
        int run = (best.method * s->problems + k) * s->seeds + best.seed;
        ves_status status =
            ves_bench_polish(&b->testbed[k], s, &b->shown.outcome[run], stopped, b, &value[k]);
        if (status != VES_OK) return ves_diag_fail(b->diag, status);
    }
    input->polished = value;
    return VES_OK;
}

/* What the runs that are done add up to. */
static ves_status count_up(bench *b)
{
    ves_bench *shown = &b->shown;
    int problems = shown->suite->problems, *n = ves_arena_take(&b->arena, (size_t)problems, sizeof *n);
    double *optimum = ves_arena_take(&b->arena, (size_t)problems, sizeof *optimum);
    if (!n || !optimum) return ves_diag_fail(b->diag, VES_MEMORY);
    for (int k = 0; k < problems; k++) n[k] = shown->problem[k].n, optimum[k] = shown->problem[k].optimum;
    ves_tally_input input = {.suite = shown->suite, .outcome = shown->outcome, .optimum = optimum, .n = n};
    VES_TRY(polish(b, &input));
    if (!ves_tally_init(&input, &shown->tally)) return ves_diag_fail(b->diag, VES_MEMORY);
    for (int k = 0; k < problems; k++) {
        if (shown->suite->problem[k].kind == VES_SUITE_LANDSCAPE) continue;
        ves_status status = ves_optima_find(&b->testbed[k], k, shown, &b->arena);
        if (status != VES_OK) return ves_diag_fail(b->diag, status);
    }
    if (!b->files.folder) return VES_OK;
    VES_TRY(ves_bench_charts_write(shown, &input, b->diag));
    return ves_bench_gallery_write(shown, b->testbed, b->diag);
}

/* All methods on all problems, then once more: what is broken off can be compared. Ranks take turns. */
static ves_status line_up(bench *b)
{
    const ves_suite *s = b->shown.suite;
    int count = 0, left = 0, ranks = b->team ? b->team->ranks : 1;
    b->waiting = ves_arena_take(&b->arena, (size_t)b->shown.runs, sizeof *b->waiting);
    if (!b->waiting) return ves_diag_fail(b->diag, VES_MEMORY);
    for (int k = 0; k < s->seeds; k++)
        for (int p = 0; p < s->problems; p++)
            for (int e = 0; e < s->methods; e++) {
                int index = (e * s->problems + p) * s->seeds + k;
                if (b->shown.outcome[index].done) continue;
                if (left++ % ranks == (b->team ? b->team->rank : 0)) b->waiting[count++] = index;
            }
    b->shown.done = b->shown.before = b->shown.runs - left;
    b->mine = count;
    return VES_OK;
}

/* What the other ranks have done. */
static ves_status gather(bench *b)
{
    ves_status status = ves_bench_files_gather(&b->files, &b->shown);
    b->shown.done = 0;
    for (int k = 0; k < b->shown.runs; k++) b->shown.done += b->shown.outcome[k].done;
    return status;
}

static ves_status all_run(bench *b)
{
    ves_status status = line_up(b);
    if (status == VES_OK && b->hooks->begun) b->hooks->begun(b->hooks->data, &b->shown);
    b->pool = status == VES_OK ? ves_pool_create(b->shown.jobs) : NULL;
    if (status == VES_OK && !b->pool) status = ves_diag_fail(b->diag, VES_MEMORY);
    if (status == VES_OK) {
        int before = b->shown.done;
        ves_pool_run(b->pool, b->mine, task, b);
        status = b->status;
        if (status == VES_OK && stopped(b) && b->shown.done - before < b->mine) status = VES_INTERRUPTED;
        if (status == VES_MEMORY) ves_diag_fail(b->diag, status);
    }
    ves_pool_destroy(b->pool);
    status = ves_team_meet(b->team, status);
    if (b->team && ves_team_leads(b->team)) {
        ves_status gathered = gather(b);
        if (status == VES_OK) status = gathered;
    }
    if (!ves_team_leads(b->team)) return status;
    if (status == VES_OK || status == VES_INTERRUPTED) {
        ves_status counted = count_up(b);
        if (counted != VES_OK) status = counted;
    }
    return status;
}

static bench *bench_create(ves_suite *suite, const ves_bench_options *options, const ves_bench_hooks *hooks,
                           ves_diag *diag)
{
    bench *b = ves_memory_take(sizeof *b);
    if (!b) {
        ves_suite_destroy(suite);
        ves_diag_fail(diag, VES_MEMORY);
        return NULL;
    }
    b->hooks = hooks;
    b->team = options->team;
    b->diag = diag;
    b->shown.suite = suite;
    b->shown.jobs = ves_team_jobs(options->team, options->jobs);
    b->shown.runs = ves_suite_runs(suite);
    b->shown.outcome = ves_arena_take(&b->arena, (size_t)b->shown.runs, sizeof *b->shown.outcome);
    if (b->shown.outcome) return b;
    ves_diag_fail(diag, VES_MEMORY);
    ves_bench_destroy(&b->shown);
    return NULL;
}

/* Runs what is left, and hands out what there is. */
static ves_status finish(bench *b, ves_status status, ves_bench **out)
{
    double begin = ves_study_clock();
    status = ves_team_meet(b->team, status);
    if (status == VES_OK) status = join(b);
    if (status == VES_OK) status = all_run(b);
    b->shown.wall = ves_study_clock() - begin;
    ves_status closed = VES_OK;
    if (ves_team_leads(b->team) && b->files.folder && b->shown.tally.score)
        closed = ves_bench_report_write(&b->shown, b->diag);
    for (int k = 0; b->testbed && k < b->shown.suite->problems; k++) ves_testbed_close(&b->testbed[k]);
    ves_status ended = ves_bench_files_end(&b->files, &b->shown);
    if (closed == VES_OK) closed = ended;
    if (status == VES_OK) status = closed;
    if (b->shown.tally.score && b->shown.done > 0)
        *out = &b->shown;
    else
        ves_bench_destroy(&b->shown);
    return status;
}

static ves_status about_write(bench *b)
{
    const ves_suite *suite = b->shown.suite;
    const char **text = ves_arena_take(&b->arena, (size_t)suite->problems, sizeof *text);
    if (!text) return ves_diag_fail(b->diag, VES_MEMORY);
    for (int k = 0; k < suite->problems; k++)
        text[k] = b->testbed[k].source ? b->testbed[k].source->text : NULL;
    return ves_bench_about_write(b->files.folder, suite, text, b->diag);
}

ves_status ves_bench_run(ves_suite *suite, const ves_bench_options *options, const ves_bench_hooks *hooks,
                         ves_bench **out, ves_diag *diag)
{
    char *folder = NULL;
    *out = NULL;
    bench *b = bench_create(suite, options, hooks, diag);
    if (!b) return VES_MEMORY;
    ves_status status = testbeds_open(b);
    if (status == VES_OK && b->team && options->no_files)
        status = ves_diag_add(diag, VES_ERROR, VES_USAGE, (ves_mark){0},
                              "under mpirun a benchmark is gathered in its folder: not with --no-files");
    if (!ves_team_leads(b->team)) return finish(b, status, out);
    if (status == VES_OK && !options->no_files)
        status = options->out ? ves_folder_make(options->out, &b->arena, &folder, diag)
                              : ves_folder_number("runs", suite->name, &b->arena, &folder, diag);
    b->shown.folder = folder;
    if (status == VES_OK && folder) status = ves_bench_files_take(&b->files, folder, &b->arena, diag);
    if (status == VES_OK && folder) status = ves_bench_files_begin(&b->files);
    if (status == VES_OK && folder) status = about_write(b);
    return finish(b, status, out);
}

/* Methods that were there first, in their order; then those that have been added. */
static void order(ves_suite *suite, const ves_bench_about *about, ves_method *room)
{
    int count = 0;
    for (int k = 0; k < about->methods; k++)
        for (int e = 0; e < suite->methods; e++)
            if (!strcmp(suite->method[e].name, about->method[k])) room[count++] = suite->method[e];
    for (int e = 0; e < suite->methods; e++) {
        bool old = false;
        for (int k = 0; k < about->methods; k++)
            old = old || !strcmp(suite->method[e].name, about->method[k]);
        if (!old) room[count++] = suite->method[e];
    }
    suite->method = room;
}

/* Problem files are read from the copies in the folder, in which what was set stands. */
static ves_status copies_use(ves_suite *suite, const char *folder)
{
    ves_suite_problem *problem = ves_arena_take(&suite->arena, (size_t)suite->problems, sizeof *problem);
    if (!problem) return VES_MEMORY;
    memcpy(problem, suite->problem, (size_t)suite->problems * sizeof *problem);
    for (int k = 0; k < suite->problems; k++) {
        if (problem[k].kind != VES_SUITE_FILE) continue;
        problem[k].sets = 0;
        problem[k].path = ves_bench_about_problem(folder, k, &suite->arena);
        if (!problem[k].path) return VES_MEMORY;
    }
    suite->problem = problem;
    return VES_OK;
}

static ves_status reopen(const char *folder, const ves_read_options *added, ves_suite **suite, ves_diag *diag)
{
    ves_arena arena = {0};
    ves_bench_about about;
    static const char prefix[] = "methods.";
    ves_status status = ves_bench_about_read(folder, &arena, &about, diag);
    for (int k = 0; status == VES_OK && added->overrides && k < about.methods; k++)
        if (!strcmp(added->override->name + strlen(prefix), about.method[k]))
            status = ves_diag_add(diag, VES_ERROR, VES_USAGE, (ves_mark){0},
                                  "\"%s\" has a method \"%s\" already: give this one another name", folder,
                                  about.method[k]);
    if (status == VES_OK)
        status = ves_suite_read_text(about.path, about.text, about.length, added, suite, diag);
    if (status == VES_OK) {
        ves_method *room =
            ves_arena_take(&(*suite)->arena, (size_t)((*suite)->methods + about.methods), sizeof *room);
        if (room) order(*suite, &about, room);
        if (!room || copies_use(*suite, folder) != VES_OK)
            status = ves_diag_fail(diag, VES_MEMORY), ves_suite_destroy(*suite), *suite = NULL;
    }
    ves_arena_destroy(&arena);
    return status;
}

ves_status ves_bench_resume(const char *folder, const ves_read_options *added,
                            const ves_bench_options *options, const ves_bench_hooks *hooks, ves_bench **out,
                            ves_diag *diag)
{
    ves_suite *suite = NULL;
    *out = NULL;
    ves_status status = ves_team_meet(options->team, reopen(folder, added, &suite, diag));
    if (status != VES_OK) ves_suite_destroy(suite);
    VES_TRY(status); /* all have read what the first may write */
    bench *b = bench_create(suite, options, hooks, diag);
    if (!b) return VES_MEMORY;
    b->shown.folder = ves_arena_text(&b->arena, folder, strlen(folder));
    if (!b->shown.folder) status = ves_diag_fail(diag, VES_MEMORY);
    if (!ves_team_leads(b->team)) return finish(b, status == VES_OK ? testbeds_open(b) : status, out);
    if (status == VES_OK) status = ves_bench_files_take(&b->files, b->shown.folder, &b->arena, diag);
    if (status == VES_OK) status = testbeds_open(b);
    if (status == VES_OK) status = ves_bench_files_again(&b->files, &b->shown);
    if (status == VES_OK && added->overrides) status = about_write(b);
    return finish(b, status, out);
}

void ves_bench_destroy(ves_bench *shown)
{
    if (!shown) return;
    bench *b = (bench *)shown;
    for (int k = 0; b->shown.outcome && k < b->shown.runs; k++) ves_outcome_clear(&b->shown.outcome[k]);
    for (int k = 0; k < b->shown.optima; k++) ves_memory_free(b->shown.optimum[k].hits);
    ves_memory_free(b->shown.optimum);
    ves_tally_destroy(&b->shown.tally);
    ves_suite_destroy(b->shown.suite);
    ves_arena arena = b->arena;
    ves_memory_free(b);
    ves_arena_destroy(&arena);
}

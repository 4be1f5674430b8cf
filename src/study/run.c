#include "study/run.h"

#include <math.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/diag.h"
#include "study/folder.h"
#include "study/idle.h"
#include "study/judge.h"
#include "study/keep.h"
#include "study/settle.h"
#include "study/trace.h"

enum { JOBS_MOST = 256, STATUS_KINDS = 64, SENTENCE = 200 };

/* A grid that changes a measure by more than this is worth a word. */
static const double UNSETTLED = 1e-6;

/* All that one study holds while it runs. */
typedef struct study {
    const ves_problem *problem;
    const ves_run_options *options;
    const ves_run_hooks *hooks;
    ves_diag *diag;
    ves_run *run;
    ves_arena *arena; /* of the run */
    ves_plan **plan;  /* [run->jobs] */
    ves_search_options search;
    ves_tracer tracer;
    double wall, cpu, mark; /* clocks: the beginning; the stage's beginning */
    int stage;
    int stages_before; /* of searches that are over, and their evaluations */
    long evaluations_before;
    long left;        /* of the budget */
    ves_verdict seen; /* the best that the search has told, and its violation as in a design */
    double seen_violation;
    long failed[STATUS_KINDS]; /* candidates that could not be measured, by status */
    ves_status files;          /* the first file that could not be written */
    const double *from;        /* [variables] where the search at hand began */
} study;

/* Appends a sentence to what the result says of itself. */
static ves_status note(study *s, const char *text)
{
    ves_run *run = s->run;
    const char **list = ves_arena_take(s->arena, (size_t)run->notes + 1, sizeof *list);
    char *copy = ves_arena_text(s->arena, text, strlen(text));
    if (!list || !copy) return VES_MEMORY;
    for (int k = 0; k < run->notes; k++) list[k] = run->note[k];
    list[run->notes++] = copy;
    run->note = list;
    return VES_OK;
}

static ves_status keep_note(study *s, const char *text)
{
    return note(s, text) == VES_OK ? VES_OK : ves_diag_fail(s->diag, VES_MEMORY);
}

/* What is wrong with the design that the result shows is on the screen at once, and in the result. */
static ves_status warn(study *s, ves_status why, const char *text)
{
    ves_diag_add(s->diag, VES_WARNING, why, (ves_mark){0}, "%s", text);
    return keep_note(s, text);
}

static double seconds(clockid_t clock)
{
    struct timespec now;
    clock_gettime(clock, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

double ves_study_clock(void)
{
    return seconds(CLOCK_MONOTONIC);
}

/* --- making ready --- */

static int machine_threads(void)
{
    long count = sysconf(_SC_NPROCESSORS_ONLN);
    return count < 1 ? 1 : count > JOBS_MOST ? JOBS_MOST : (int)count;
}

static bool searches(const study *s)
{
    const ves_problem *p = s->problem;
    return !s->options->once && p->variables > 0 && (p->objective || p->constraints);
}

static void set_up(study *s)
{
    ves_run *run = s->run;
    const ves_run_options *o = s->options;
    s->search = o->test ? s->problem->test : s->problem->search;
    if (o->seeded) s->search.seed = o->seed;
    if (o->evaluations > 0) s->search.evaluations = o->evaluations;
    run->problem = s->problem;
    run->searched = searches(s);
    run->seed = s->search.seed;
    run->jobs = !run->searched ? 1 : o->jobs > 0 ? o->jobs : machine_threads();
    if (run->jobs > JOBS_MOST) run->jobs = JOBS_MOST;
    run->times.threads = machine_threads();
    run->stop = s->problem->variables ? "nothing to optimize" : "nothing to vary";
    run->change = run->finer_change = NAN;
    run->passed = true;
    time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc))
        strftime(run->times.started, sizeof run->times.started, "%Y-%m-%dT%H:%M:%SZ", &utc);
}

static void plans_destroy(ves_plan **plan, int count)
{
    for (int k = 0; plan && k < count; k++) ves_plan_destroy(plan[k]);
}

/* As many as jobs; the others share the grid of the first, which speaks for all. */
static ves_status plans_fill(study *s, const ves_plan_options *options, ves_plan **plan, ves_diag *diag)
{
    int grid[2];
    VES_TRY(ves_plan_create(s->problem, options, &plan[0], diag));
    ves_plan_grid(plan[0], grid);
    const ves_plan_options same = {{grid[0], grid[1]}};
    for (int k = 1; k < s->run->jobs; k++) {
        ves_status status = ves_plan_create(s->problem, &same, &plan[k], NULL);
        if (status != VES_OK) return ves_diag_fail(s->diag, status);
    }
    return VES_OK;
}

static ves_status plans_make(study *s)
{
    ves_run *run = s->run;
    s->plan = ves_arena_take(s->arena, (size_t)run->jobs, sizeof *s->plan);
    if (!s->plan) return ves_diag_fail(s->diag, VES_MEMORY);
    VES_TRY(plans_fill(s, NULL, s->plan, s->diag));
    run->change = ves_plan_grid(s->plan[0], run->quadrature);
    return VES_OK;
}

static ves_status measure(study *s, const double *x, int level, ves_design *design)
{
    ves_status status = ves_design_measure(s->plan[0], s->problem, x, level, s->arena, design);
    return status == VES_OK ? VES_OK : ves_diag_fail(s->diag, status);
}

static ves_status start_measure(study *s)
{
    ves_run *run = s->run;
    VES_TRY(measure(s, NULL, 0, &run->start));
    char text[SENTENCE];
    ves_status status = run->start.status;
    if (status != VES_OK) {
        run->change = NAN;
        snprintf(text, sizeof text, "the start design cannot be measured: %s", ves_status_text(status));
        ves_plan_why(s->plan[0], status, "the start design cannot be measured", s->diag);
        return run->searched ? VES_OK : keep_note(s, text); /* a search notes it itself */
    }
    if (!(run->change > UNSETTLED)) return VES_OK;
    snprintf(text, sizeof text,
             "%d x %d nodes a patch still change a measure of the start design by %.1e of its size",
             run->quadrature[0], run->quadrature[1], run->change);
    return warn(s, VES_COARSE, text);
}

/* Says which variables seem to do nothing. */
static ves_status idle_find(study *s)
{
    const ves_problem *p = s->problem;
    size_t n = (size_t)p->variables;
    bool *idle = ves_arena_take(s->arena, n, sizeof *idle);
    if (!idle) return ves_diag_fail(s->diag, VES_MEMORY);
    s->run->idle = idle;
    if (!ves_study_idle(s->plan[0], p, s->arena, idle)) memset(idle, 0, n * sizeof *idle);
    char *text = NULL;
    for (int k = 0; k < p->variables; k++) {
        if (!idle[k]) continue;
        text = ves_arena_format(s->arena, "%s%s%s", text ? text : "", text ? ", " : "", p->variable[k].name);
        if (!text) return ves_diag_fail(s->diag, VES_MEMORY);
    }
    if (!text) return VES_OK;
    text = ves_arena_format(s->arena, "%s: no effect on what is judged, in the designs looked at", text);
    return text ? keep_note(s, text) : ves_diag_fail(s->diag, VES_MEMORY);
}

/* --- the folder: a disk that fills up later does not stop the search --- */

static void folder_begin(study *s)
{
    const ves_run_options *o = s->options;
    ves_run *run = s->run;
    const char *name = o->name ? o->name : s->problem->name;
    if (!o->files) return;
    char *folder = NULL;
    s->files = o->out ? ves_folder_make(o->out, s->arena, &folder, s->diag)
                      : ves_folder_number(o->parent ? o->parent : "runs", name, s->arena, &folder, s->diag);
    run->folder = folder;
    if (s->files != VES_OK) return;
    s->files = ves_keep_problem(run, s->arena, s->diag);
    s->tracer = (ves_tracer){.problem = s->problem, .which = o->trace, .diag = s->diag};
    char *path = ves_folder_path(run->folder, "trace.jsonl", s->arena);
    if (s->files != VES_OK || !run->searched || o->trace == VES_TRACE_NONE) return;
    s->files = path ? ves_tracer_begin(&s->tracer, path, s->arena) : ves_diag_fail(s->diag, VES_MEMORY);
}

static void folder_end(study *s)
{
    if (!s->run->folder) return;
    ves_status trace = ves_tracer_end(&s->tracer),
               kept = ves_keep_result(s->run, s->plan[0], s->arena, s->diag);
    if (s->files == VES_OK) s->files = trace != VES_OK ? trace : kept;
}

/* --- the search --- */

/* Stages are timed by the records that they send. */
static void stage_enter(study *s, int index)
{
    ves_run_times *t = &s->run->times;
    double now = ves_study_clock();
    if (s->stage >= 0) t->stage[s->stage].wall += now - s->mark;
    s->mark = now;
    s->stage = index;
    if (index >= t->stages) t->stages = index + 1;
}

static void hear_record(void *data, const ves_record *heard)
{
    study *s = data;
    ves_record record = *heard;
    int kind = (int)record.status;
    record.evaluation += s->evaluations_before;
    record.stage += s->stages_before;
    if (record.stage >= VES_STAGES) record.stage = VES_STAGES - 1;
    if (record.stage != s->stage && record.stage >= 0) stage_enter(s, record.stage);
    s->run->times.stage[s->stage].evaluations++;
    bool failed = record.status != VES_CUT && !record.proof; /* cut and refused ones could be measured */
    if (failed && kind > 0 && kind < STATUS_KINDS) s->failed[kind]++;
    const ves_verdict verdict = {
        .status = record.status, .value = record.value, .violation = record.violation};
    if (ves_verdict_better(&verdict, &s->seen, VES_FEASIBLE)) {
        s->seen = verdict;
        s->seen_violation = ves_design_violation(s->problem, &record);
    }
    ves_tracer_write(&s->tracer, &record);
}

static void hear_progress(void *data, const ves_progress *progress)
{
    study *s = data;
    ves_progress shown = *progress;
    if (s->problem->maximize) shown.value = -shown.value;
    if (shown.any) shown.violation = s->seen_violation;
    shown.stage += s->stages_before;
    shown.evaluations += s->evaluations_before;
    shown.budget += s->evaluations_before;
    if (shown.stage >= 0 && shown.stage < VES_STAGES && shown.stage_name)
        snprintf(s->run->times.stage[shown.stage].name, VES_RUN_NAME, "%s", shown.stage_name);
    if (s->hooks->progress) s->hooks->progress(s->hooks->data, &shown);
}

static bool hear_stopped(void *data)
{
    study *s = data;
    return s->hooks->stopped && s->hooks->stopped(s->hooks->data);
}

static void stage_names(study *s)
{
    for (int k = 0; k < VES_STAGES; k++) {
        bool polish = s->search.stages ? s->search.stage[k].kind == VES_STAGE_POLISH : k == 1;
        snprintf(s->run->times.stage[k].name, VES_RUN_NAME, "%s", polish ? "polish" : "anneal");
    }
}

/* Variables that do nothing go back to their start. */
static void rest(study *s, double *x)
{
    const bool *idle = s->run->idle;
    for (int k = 0; k < s->problem->variables; k++)
        if (idle && idle[k]) {
            ves_study_rest(s->plan[0], s->problem, idle, s->arena, x);
            return;
        }
}

static ves_status optima_take(study *s, const ves_search_result *r)
{
    double sign = s->problem->maximize ? -1 : 1;
    ves_optimum *optimum = ves_arena_take(s->arena, (size_t)r->optima, sizeof *optimum);
    if (!optimum) return VES_MEMORY;
    for (int k = 0; k < r->optima; k++) {
        double *x = ves_arena_take(s->arena, (size_t)r->n, sizeof *x);
        if (!x) return VES_MEMORY;
        memcpy(x, r->optimum[k].x, sizeof *x * (size_t)r->n);
        rest(s, x);
        optimum[k] = r->optimum[k];
        optimum[k].x = x;
        optimum[k].value *= sign;
        ves_design design; /* its violation is in units of sizes, a verdict's in those of each `within` */
        VES_TRY(ves_design_measure(s->plan[0], s->problem, x, 0, s->arena, &design));
        optimum[k].violation = design.violation;
    }
    s->run->optimum = optimum;
    s->run->optima = r->optima;
    return VES_OK;
}

static ves_status words_take(study *s, const ves_search_result *r)
{
    ves_run *run = s->run;
    run->stop = ves_arena_text(s->arena, r->stop, strlen(r->stop));
    if (!run->stop) return VES_MEMORY;
    for (int k = 0; k < r->notes; k++) VES_TRY(note(s, r->note[k]));
    return VES_OK;
}

static ves_status counts_take(study *s, const ves_search_result *r)
{
    ves_run *run = s->run;
    ves_temperature *temperature = ves_arena_take(s->arena, (size_t)r->temperatures, sizeof *temperature);
    ves_run_failure *failure = ves_arena_take(s->arena, STATUS_KINDS, sizeof *failure);
    if (!temperature || !failure) return VES_MEMORY;
    for (int k = 0; k < r->temperatures; k++) temperature[k] = r->temperature[k];
    run->failures = 0;
    for (int k = 0; k < STATUS_KINDS; k++)
        if (s->failed[k]) failure[run->failures++] = (ves_run_failure){(ves_status)k, s->failed[k]};
    run->failure = failure;
    if (!r->temperatures) return VES_OK;
    run->temperature = temperature;
    run->temperatures = r->temperatures;
    return VES_OK;
}

static ves_status result_take(study *s, const ves_search_result *r)
{
    ves_run *run = s->run;
    run->ending = r->ending;
    run->any = r->any || run->start.status == VES_OK; /* a search may be stopped before it has begun */
    run->evaluations += r->evaluations;
    run->gradients += r->gradients;
    run->refused += r->refused;
    if (words_take(s, r) != VES_OK || counts_take(s, r) != VES_OK || optima_take(s, r) != VES_OK)
        return ves_diag_fail(s->diag, VES_MEMORY);
    double *x = ves_arena_take(s->arena, (size_t)r->n, sizeof *x);
    if (!x) return ves_diag_fail(s->diag, VES_MEMORY);
    const double *from = r->any ? r->x : s->from; /* or no point is better than another */
    memcpy(x, from, sizeof *x * (size_t)r->n);
    rest(s, x);
    VES_TRY(measure(s, x, 1, &run->finer));
    VES_TRY(measure(s, x, 0, &run->best));
    run->feasible = r->any && r->feasible && run->best.status == VES_OK;
    return VES_OK;
}

/* from: where to begin, or NULL for the start of the file. */
static ves_status search_with(study *s, const ves_search_options *options, const double *const *from,
                              int count)
{
    ves_run *run = s->run;
    ves_search_problem problem = ves_plan_search(s->plan, run->jobs);
    ves_search_result *result = NULL;
    ves_search_hooks hooks = {
        .progress = hear_progress, .record = hear_record, .stopped = hear_stopped, .data = s};
    if (from) problem.start = from[0], problem.other = from + 1, problem.others = count - 1;
    s->from = problem.start;
    s->stages_before = run->times.stages;
    s->evaluations_before = run->evaluations;
    s->stage = -1;
    s->seen = (ves_verdict){.status = VES_NO_NUMBER};
    double begun = ves_study_clock();
    ves_status status = ves_search_run(&problem, options, &hooks, &result);
    stage_enter(s, s->stage);
    run->times.search += ves_study_clock() - begun;
    if (!result) return ves_diag_fail(s->diag, status);
    s->left = result->budget - result->evaluations;
    status = result_take(s, result);
    ves_search_result_destroy(result);
    return status;
}

/* The optima, the best first, polished once more on the finer grid; what is reported is measured there. */
static ves_status polish_again(study *s, const ves_search_options *again)
{
    ves_run *run = s->run;
    const ves_optimum *old = run->optimum;
    const int count = run->optima;
    const double **from = ves_arena_take(s->arena, (size_t)count + 1, sizeof *from);
    if (!from) return ves_diag_fail(s->diag, VES_MEMORY);
    from[0] = run->best.x;
    for (int k = 1; k < count; k++) from[k] = old[k].x;
    VES_TRY(search_with(s, again, from, count > 1 ? count : 1));
    if (ves_settle_hits(old, count, s->arena, run) != VES_OK) return ves_diag_fail(s->diag, VES_MEMORY);
    if (run->optima >= count) return VES_OK;
    char text[SENTENCE];
    snprintf(text, sizeof text, "of the %d optima on the coarser grid %d were%s found again on the finer one",
             count, run->optima, run->ending == VES_ENDED_STOPPED ? ", before the stop," : "");
    return keep_note(s, text);
}

static ves_status search_finer(study *s, const ves_search_options *again, const int grid[2], double change)
{
    ves_run *run = s->run;
    const ves_plan_options finer = {{grid[0], grid[1]}};
    ves_plan **coarse = s->plan, **plan = ves_arena_take(s->arena, (size_t)run->jobs, sizeof *plan);
    if (!plan) return ves_diag_fail(s->diag, VES_MEMORY);
    s->plan = plan;
    ves_status status = plans_fill(s, &finer, plan, NULL);
    plans_destroy(coarse, run->jobs);
    if (status != VES_OK) return ves_diag_fail(s->diag, status);
    run->quadrature[0] = grid[0], run->quadrature[1] = grid[1];
    run->change = change;
    VES_TRY(measure(s, NULL, 0, &run->start));
    return polish_again(s, again);
}

/* When the grid does not settle the best: another one, or the advice to give one. */
static ves_status settle_best(study *s)
{
    ves_run *run = s->run;
    const int *q = run->quadrature;
    const double off = ves_plan_change(s->plan[0], &run->best, &run->finer);
    if (!(off > UNSETTLED)) return VES_OK;
    int grid[2];
    double change;
    char text[SENTENCE];
    ves_search_options again;
    ves_status status = ves_settle_grid(run, grid, &change);
    if (status != VES_OK) return ves_diag_fail(s->diag, status);
    if (grid[0] == q[0] && grid[1] == q[1]) return VES_OK;
    bool chosen = s->problem->quadrature[0] == 0 && s->problem->quadrature[1] == 0;
    if (hear_stopped(s)) run->ending = VES_ENDED_STOPPED; /* the choice of a grid takes its time */
    if (chosen && run->ending != VES_ENDED_STOPPED && ves_settle_search(&s->search, run, s->left, &again)) {
        snprintf(text, sizeof text,
                 "%d x %d nodes a patch, chosen at the start design, left the best unsettled by %.1e: "
                 "polished once more on %d x %d, chosen at the best",
                 q[0], q[1], off, grid[0], grid[1]);
        VES_TRY(keep_note(s, text));
        return search_finer(s, &again, grid, change);
    }
    snprintf(text, sizeof text,
             "%d x %d nodes a patch leave the result unsettled by %.1e: give quadrature: {u: %d, v: %d}",
             q[0], q[1], off, grid[0], grid[1]);
    return keep_note(s, text);
}

/* The dear checks of the start; a note where they fail. */
static ves_status start_prove(study *s, const char *what, ves_status *proof)
{
    char text[SENTENCE];
    ves_verdict verdict = {0};
    ves_ask ask = {.x = s->run->start.x, .level = 1, .cutoff = HUGE_VAL, .want = VES_WANT_PROOF};
    ves_status status = ves_plan_evaluate(s->plan[0], &ask, &verdict);
    if (status != VES_OK) return ves_diag_fail(s->diag, status);
    if (proof) *proof = verdict.status;
    snprintf(text, sizeof text, "the %s did not pass its checks: %s", what, ves_status_text(verdict.status));
    return verdict.status == VES_OK ? VES_OK : keep_note(s, text);
}

static ves_status search(study *s)
{
    stage_names(s);
    /* a search goes on from a start that fails its proof */
    if (s->run->start.status == VES_OK) VES_TRY(start_prove(s, "start design", NULL));
    VES_TRY(search_with(s, &s->search, NULL, 0));
    return s->run->any ? settle_best(s) : VES_OK;
}

/* --- without a search --- */

static ves_status once(study *s)
{
    ves_run *run = s->run;
    run->evaluations = 1;
    run->any = run->start.status == VES_OK;
    run->feasible = run->start.feasible;
    VES_TRY(measure(s, run->start.x, 1, &run->finer));
    VES_TRY(measure(s, run->start.x, 0, &run->best));
    if (!run->any || (s->options->once && !s->options->prove)) return VES_OK;
    VES_TRY(start_prove(s, "design", &run->proof));
    if (run->proof == VES_OK) return VES_OK;
    run->feasible = false;
    ves_plan_why(s->plan[0], run->proof, "the design did not pass its checks", s->diag);
    return VES_OK;
}

/* --- the whole --- */

static ves_status work(study *s)
{
    ves_run *run = s->run;
    VES_TRY(plans_make(s));
    VES_TRY(start_measure(s));
    if (run->searched || s->options->prove) VES_TRY(idle_find(s));
    folder_begin(s);
    if (s->files != VES_OK) return s->files; /* told before the search has cost anything */
    if (s->hooks->begun) s->hooks->begun(s->hooks->data, run);
    VES_TRY(run->searched ? search(s) : once(s));
    run->finer_change = ves_plan_change(s->plan[0], &run->best, &run->finer);
    if (ves_judge_joints(s->plan[0], run, s->arena) != VES_OK ||
        (!s->options->once && ves_judge_expect(run, s->options->test, s->arena) != VES_OK))
        return ves_diag_fail(s->diag, VES_MEMORY);
    run->times.wall = ves_study_clock() - s->wall;
    run->times.cpu = seconds(CLOCK_PROCESS_CPUTIME_ID) - s->cpu;
    folder_end(s);
    return VES_OK;
}

static ves_status options_check(const ves_run_options *o, ves_diag *diag)
{
    if (o->evaluations >= 0 && o->evaluations <= 1L << 53 && o->jobs >= 0 &&
        (unsigned)o->trace <= VES_TRACE_NONE)
        return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_RANGE, (ves_mark){0},
                        "options of a run: evaluations %ld must be 0 to 2^53, jobs %d >= 0, trace %d 0 to %d",
                        o->evaluations, o->jobs, (int)o->trace, (int)VES_TRACE_NONE);
}

ves_status ves_run_create(const ves_problem *problem, const ves_run_options *options,
                          const ves_run_hooks *hooks, ves_run **out, ves_diag *diag)
{
    static const ves_run_hooks deaf = {0};
    static const ves_run_options plain = {0};
    *out = NULL;
    if (options) VES_TRY(options_check(options, diag));
    ves_run_box *box = ves_memory_take(sizeof *box);
    if (!box) return ves_diag_fail(diag, VES_MEMORY);
    study s = {.problem = problem,
               .options = options ? options : &plain,
               .hooks = hooks ? hooks : &deaf,
               .diag = diag,
               .run = &box->run,
               .arena = &box->arena};
    s.wall = ves_study_clock();
    s.cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
    set_up(&s);
    ves_status status = work(&s);
    plans_destroy(s.plan, s.run->jobs);
    ves_tracer_end(&s.tracer);
    if (status != VES_OK) {
        ves_run_destroy(&box->run);
        return status;
    }
    *out = &box->run;
    return s.files;
}

void ves_run_destroy(ves_run *run)
{
    if (!run) return;
    ves_run_box *box = (ves_run_box *)run;
    ves_arena_destroy(&box->arena);
    ves_memory_free(box);
}

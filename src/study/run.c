#include <math.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "base/diag.h"
#include "study/folder.h"
#include "study/idle.h"
#include "study/inside.h"
#include "study/judge.h"
#include "study/keep.h"
#include "study/saved.h"
#include "study/settle.h"

ves_status ves_study_note(ves_study *s, const char *text)
{
    ves_run *run = s->run;
    const char **list = ves_arena_take(s->arena, (size_t)run->notes + 1, sizeof *list);
    char *copy = ves_arena_text(s->arena, text, strlen(text));
    if (!list || !copy) return ves_diag_fail(s->diag, VES_MEMORY);
    for (int k = 0; k < run->notes; k++) list[k] = run->note[k];
    list[run->notes++] = copy;
    run->note = list;
    return VES_OK;
}

/* What is wrong with the design that the result shows is on the screen at once, and in the result. */
static ves_status warn(ves_study *s, ves_status why, const char *text)
{
    ves_diag_add(s->diag, VES_WARNING, why, (ves_mark){0}, "%s", text);
    return ves_study_note(s, text);
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

double ves_study_thread_clock(void)
{
    return seconds(CLOCK_THREAD_CPUTIME_ID);
}

/* --- making ready --- */

static bool searches(const ves_study *s)
{
    const ves_problem *p = s->problem;
    return !s->options->once && p->variables > 0 && (p->objective || p->constraints);
}

static void set_up(ves_study *s)
{
    ves_run *run = s->run;
    const ves_run_options *o = s->options;
    s->search = o->test ? s->problem->test : s->problem->search;
    if (o->search) {
        s->search = *o->search;
        s->search.seed = s->problem->search.seed;
    }
    if (o->seeded) s->search.seed = o->seed;
    if (o->evaluations > 0) s->search.evaluations = o->evaluations;
    run->problem = s->problem;
    run->searched = searches(s);
    run->seed = s->search.seed;
    run->jobs = !run->searched ? 1 : ves_team_jobs(o->team, o->jobs);
    run->times.threads = ves_machine_threads();
    run->stop = s->problem->variables ? "nothing to optimize" : "nothing to vary";
    run->change = run->finer_change = NAN;
    run->passed = true;
    run->recalled = -1;
    time_t now = time(NULL);
    struct tm utc;
    if (gmtime_r(&now, &utc))
        strftime(run->times.started, sizeof run->times.started, "%Y-%m-%dT%H:%M:%SZ", &utc);
}

void ves_study_plans_destroy(ves_plan **plan, int count)
{
    for (int k = 0; plan && k < count; k++) ves_plan_destroy(plan[k]);
}

ves_status ves_study_plans(ves_study *s, const ves_plan_options *options, ves_plan **plan, ves_diag *diag)
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

static ves_status plans_make(ves_study *s)
{
    ves_run *run = s->run;
    s->plan = ves_arena_take(s->arena, (size_t)run->jobs, sizeof *s->plan);
    if (!s->plan) return ves_diag_fail(s->diag, VES_MEMORY);
    VES_TRY(ves_study_plans(s, NULL, s->plan, s->diag));
    run->change = ves_plan_grid(s->plan[0], run->quadrature);
    return VES_OK;
}

ves_status ves_study_measure(ves_study *s, const double *x, int level, ves_design *design)
{
    ves_status status = ves_design_measure(s->plan[0], s->problem, x, level, s->arena, design);
    return status == VES_OK ? VES_OK : ves_diag_fail(s->diag, status);
}

static ves_status start_measure(ves_study *s)
{
    ves_run *run = s->run;
    VES_TRY(ves_study_measure(s, NULL, 0, &run->start));
    char text[VES_SENTENCE];
    ves_status status = run->start.status;
    if (status != VES_OK) {
        run->change = NAN;
        snprintf(text, sizeof text, "the start design cannot be measured: %s", ves_status_text(status));
        ves_plan_why(s->plan[0], status, "the start design cannot be measured", s->diag);
        return run->searched ? VES_OK : ves_study_note(s, text); /* a search notes it itself */
    }
    if (!(run->change > VES_UNSETTLED)) return VES_OK;
    snprintf(text, sizeof text,
             "%d x %d nodes a patch still change a measure of the start design by %.1e of its size",
             run->quadrature[0], run->quadrature[1], run->change);
    return warn(s, VES_COARSE, text);
}

/* Says which variables seem to do nothing. */
static ves_status idle_find(ves_study *s)
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
    return text ? ves_study_note(s, text) : ves_diag_fail(s->diag, VES_MEMORY);
}

/* --- the folder: a disk that fills up later does not stop the search --- */

static ves_status folder_make(ves_study *s)
{
    const ves_run_options *o = s->options;
    const char *name = o->name ? o->name : s->problem->name;
    char *folder = NULL;
    ves_status status =
        o->out ? ves_folder_make(o->out, s->arena, &folder, s->diag)
               : ves_folder_number(o->parent ? o->parent : "runs", name, s->arena, &folder, s->diag);
    s->run->folder = folder;
    return status;
}

static ves_journal_head head_of(ves_study *s)
{
    const ves_problem *p = s->problem;
    return (ves_journal_head){p->variables, p->constraints, ves_saved_head(s->run, s->options, s->arena)};
}

/* What makes a folder one of a run that can be resumed. */
static ves_status folder_fill(ves_study *s)
{
    const ves_run *run = s->run;
    VES_TRY(ves_lock_take(&s->lock, run->folder, s->arena, s->diag));
    VES_TRY(ves_keep_problem(run, s->arena, s->diag));
    VES_TRY(ves_saved_write(run, s->options, s->arena, s->diag));
    if (!run->searched || s->options->forget) return VES_OK;
    const ves_journal_head head = head_of(s);
    if (!head.text) return ves_diag_fail(s->diag, VES_MEMORY);
    return ves_journal_create(&s->journal, run->folder, &head, s->arena, s->diag);
}

static ves_status tracer_begin(ves_study *s)
{
    const ves_run_options *o = s->options;
    s->tracer = (ves_tracer){.problem = s->problem, .which = o->trace, .diag = s->diag};
    if (!s->run->searched || o->trace == VES_TRACE_NONE) return VES_OK;
    char *path = ves_folder_path(s->run->folder, "trace.jsonl", s->arena);
    return path ? ves_tracer_begin(&s->tracer, path, o->resume, s->arena)
                : ves_diag_fail(s->diag, VES_MEMORY);
}

static ves_status folder_begin(ves_study *s)
{
    if (!s->options->files || s->run->over || !ves_team_leads(s->options->team)) return VES_OK;
    if (!s->options->resume) {
        VES_TRY(folder_make(s));
        VES_TRY(folder_fill(s));
    }
    s->run->journaled = s->journal.open;
    return tracer_begin(s);
}

/* Is it done, and is its result there? */
static bool is_over(const ves_study *s)
{
    char *path = ves_folder_path(s->run->folder, "result.json", s->arena);
    return s->journal.done && path && access(path, R_OK) == 0;
}

static ves_status folder_resume(ves_study *s)
{
    ves_run *run = s->run;
    if (!s->options->resume || !ves_team_leads(s->options->team)) return VES_OK;
    run->folder = ves_arena_text(s->arena, s->options->out, strlen(s->options->out));
    const ves_journal_head head = head_of(s);
    if (!run->folder || !head.text) return ves_diag_fail(s->diag, VES_MEMORY);
    VES_TRY(ves_lock_take(&s->lock, run->folder, s->arena, s->diag));
    ves_folder_tidy(run->folder, s->arena);
    if (!run->searched) return VES_OK;
    VES_TRY(ves_journal_reopen(&s->journal, run->folder, &head, s->arena, s->diag));
    run->journaled = true;
    run->recalled = s->journal.evaluations;
    if (s->journal.torn)
        ves_diag_add(s->diag, VES_NOTE, VES_OK, (ves_mark){0},
                     "the last %llu bytes of \"%s\" are not whole: what they told is asked again",
                     (unsigned long long)s->journal.torn, s->journal.path);
    run->over = is_over(s);
    s->recalls = true;
    return VES_OK;
}

/* Rank 0 alone reads the folder; the others learn whether there is something to recall. */
static ves_status journal_agree(ves_study *s)
{
    VES_TRY(ves_team_follow(s->options->team, folder_resume(s)));
    ves_status none = ves_team_follow(s->options->team, s->recalls ? VES_OK : VES_ABSENT);
    s->recalls = none == VES_OK;
    return none == VES_OK || none == VES_ABSENT ? VES_OK : none;
}

static void folder_end(ves_study *s)
{
    bool done = s->run->ending != VES_ENDED_STOPPED;
    if (s->run->folder && !s->run->over) {
        ves_status trace = ves_tracer_end(&s->tracer),
                   kept = ves_keep_result(s->run, s->plan[0], s->arena, s->diag);
        if (s->files == VES_OK) s->files = trace != VES_OK ? trace : kept;
    }
    ves_journal_end(&s->journal, done && s->files == VES_OK);
    ves_study_journal_tell(s);
}

/* --- the search --- */

/* The dear checks of the start; a note where they fail. */
static ves_status start_prove(ves_study *s, const char *what, ves_status *proof)
{
    char more[2 * VES_SENTENCE], text[3 * VES_SENTENCE];
    ves_verdict verdict = {0};
    ves_ask ask = {.x = s->run->start.x, .level = 1, .cutoff = HUGE_VAL, .want = VES_WANT_PROOF};
    ves_status status = ves_plan_evaluate(s->plan[0], &ask, &verdict);
    if (status != VES_OK) return ves_diag_fail(s->diag, status);
    if (proof) *proof = verdict.status;
    if (verdict.status == VES_OK) return VES_OK;
    bool broken = ves_plan_broken(s->plan[0], more, sizeof more);
    snprintf(text, sizeof text, "the %s did not pass its checks: %s%s%s", what,
             ves_status_text(verdict.status), broken ? ": " : "", broken ? more : "");
    return ves_study_note(s, text);
}

/* Stages behind those of the search polish again, from its end. */
static void stage_names(ves_study *s)
{
    static const char *const name[] = {
        [VES_STAGE_ANNEAL] = "anneal", [VES_STAGE_POLISH] = "polish", [VES_STAGE_AUTO] = "auto"};
    for (int k = 0; k < VES_STAGES; k++) {
        ves_stage_kind kind = k < s->search.stages          ? s->search.stage[k].kind
                              : !s->search.stages && k == 0 ? VES_STAGE_AUTO
                                                            : VES_STAGE_POLISH;
        snprintf(s->run->times.stage[k].name, VES_RUN_NAME, "%s", name[kind]);
    }
}

static ves_status search(ves_study *s)
{
    stage_names(s);
    /* a search goes on from a start that fails its proof */
    if (s->run->start.status == VES_OK) VES_TRY(start_prove(s, "start design", NULL));
    VES_TRY(ves_study_search(s, &s->search, NULL, 0));
    return s->run->any ? ves_settle_best(s) : VES_OK;
}

/* --- without a search --- */

static ves_status once(ves_study *s)
{
    ves_run *run = s->run;
    run->evaluations = 1;
    run->any = run->start.status == VES_OK;
    run->feasible = run->start.feasible;
    VES_TRY(ves_study_measure(s, run->start.x, 1, &run->finer));
    VES_TRY(ves_study_measure(s, run->start.x, 0, &run->best));
    if (!run->any || (s->options->once && !s->options->prove)) return VES_OK;
    VES_TRY(start_prove(s, "design", &run->proof));
    if (run->proof == VES_OK) return VES_OK;
    run->feasible = false;
    ves_plan_why(s->plan[0], run->proof, "the design did not pass its checks", s->diag);
    return VES_OK;
}

/* --- the whole --- */

static ves_status work(ves_study *s)
{
    ves_run *run = s->run;
    VES_TRY(journal_agree(s));
    VES_TRY(plans_make(s));
    VES_TRY(start_measure(s));
    if (run->searched || s->options->prove) VES_TRY(idle_find(s));
    VES_TRY(
        ves_team_follow(s->options->team, folder_begin(s))); /* told before the search has cost anything */
    if (s->hooks->begun) s->hooks->begun(s->hooks->data, run);
    VES_TRY(run->searched ? search(s) : once(s));
    run->finer_change = ves_plan_change(s->plan[0], &run->best, &run->finer);
    const char *note;
    if (ves_judge_kind(run, s->arena, &note) != VES_OK) return ves_diag_fail(s->diag, VES_MEMORY);
    if (note) VES_TRY(ves_study_note(s, note));
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
        (unsigned)o->trace <= VES_TRACE_NONE && !(o->search && o->files))
        return VES_OK;
    return ves_diag_add(
        diag, VES_ERROR, VES_RANGE, (ves_mark){0},
        "options of a run: evaluations %ld must be 0 to 2^53, jobs %d >= 0, trace %d 0 to %d, "
        "search without files",
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
    ves_study s = {.problem = problem,
                   .options = options ? options : &plain,
                   .hooks = hooks ? hooks : &deaf,
                   .diag = diag,
                   .run = &box->run,
                   .arena = &box->arena,
                   .lock = {.fd = -1}};
    s.wall = ves_study_clock();
    s.cpu = seconds(CLOCK_PROCESS_CPUTIME_ID);
    set_up(&s);
    ves_status status = work(&s);
    ves_study_plans_destroy(s.plan, s.run->jobs);
    ves_tracer_end(&s.tracer);
    ves_journal_end(&s.journal, false);
    ves_lock_drop(&s.lock);
    ves_memory_free(s.told_block);
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

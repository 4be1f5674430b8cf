#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "study/idle.h"
#include "study/inside.h"

/* The search of a run: what it tells while it goes on, and what is taken from it. */

/* Stages are timed by the records that they send. */
static void stage_enter(ves_study *s, int index)
{
    ves_run_times *t = &s->run->times;
    double now = ves_study_clock();
    if (s->stage >= 0) t->stage[s->stage].wall += now - s->mark;
    s->mark = now;
    s->stage = index;
    if (index >= t->stages) t->stages = index + 1;
}

/* Once, and at once: who reads it may make room, or end the run while most of it is in the journal. */
void ves_study_journal_tell(ves_study *s)
{
    if (!s->journal.error || s->told) return;
    s->told = true;
    if (s->files == VES_OK) s->files = VES_IO;
    ves_diag_add(s->diag, VES_WARNING, VES_IO, (ves_mark){0},
                 "cannot write \"%s\": %s. The search goes on, but can be resumed only from here",
                 s->journal.path, strerror(s->journal.error));
}

static void hear_record(void *data, const ves_record *heard)
{
    ves_study *s = data;
    ves_record record = *heard;
    int kind = (int)record.status;
    record.evaluation += s->evaluations_before;
    record.stage += s->stages_before;
    if (record.stage >= VES_STAGES) record.stage = VES_STAGES - 1;
    if (record.stage != s->stage && record.stage >= 0) stage_enter(s, record.stage);
    s->run->times.stage[s->stage].evaluations++;
    bool failed = record.status != VES_CUT && !record.proof; /* cut and refused ones could be measured */
    if (failed && kind > 0 && kind < VES_FAILURES) s->failed[kind]++;
    const ves_verdict verdict = {
        .status = record.status, .value = record.value, .violation = record.violation};
    if (ves_verdict_better(&verdict, &s->seen, VES_FEASIBLE)) {
        s->seen = verdict;
        s->seen_violation = ves_design_violation(s->problem, &record);
    }
    ves_tracer_write(&s->tracer, &record);
    ves_study_journal_tell(s);
}

static void hear_progress(void *data, const ves_progress *progress)
{
    ves_study *s = data;
    ves_progress shown = *progress;
    if (s->problem->maximize) shown.value = -shown.value;
    if (shown.any) shown.violation = s->seen_violation;
    shown.stage += s->stages_before;
    shown.evaluations += s->evaluations_before;
    shown.budget += s->evaluations_before;
    if (s->hooks->progress) s->hooks->progress(s->hooks->data, &shown);
}

static bool hear_stopped(void *data)
{
    const ves_study *s = data;
    return s->hooks->stopped && s->hooks->stopped(s->hooks->data);
}

bool ves_study_stopped(ves_study *study)
{
    return ves_team_follow(study->options->team, hear_stopped(study) ? VES_INTERRUPTED : VES_OK) ==
           VES_INTERRUPTED;
}

/* Variables that do nothing go back to their start. */
static void rest(ves_study *s, double *x)
{
    const bool *idle = s->run->idle;
    for (int k = 0; k < s->problem->variables; k++)
        if (idle && idle[k]) {
            ves_study_rest(s->plan[0], s->problem, idle, s->arena, x);
            return;
        }
}

static ves_status optima_take(ves_study *s, const ves_search_result *r)
{
    double sign = s->problem->maximize ? -1 : 1;
    ves_optimum *optimum = ves_arena_take(s->arena, (size_t)r->optima, sizeof *optimum);
    int *kind = ves_arena_take(s->arena, (size_t)r->optima, sizeof *kind);
    if (!optimum || !kind) return VES_MEMORY;
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
        kind[k] = design.kind;
    }
    s->run->optimum = optimum;
    s->run->optimum_kind = kind;
    s->run->optima = r->optima;
    return VES_OK;
}

static ves_status words_take(ves_study *s, const ves_search_result *r)
{
    ves_run *run = s->run;
    run->stop = ves_arena_text(s->arena, r->stop, strlen(r->stop));
    if (!run->stop) return ves_diag_fail(s->diag, VES_MEMORY);
    for (int k = 0; k < r->notes; k++) VES_TRY(ves_study_note(s, r->note[k]));
    return VES_OK;
}

static ves_status counts_take(ves_study *s, const ves_search_result *r)
{
    ves_run *run = s->run;
    ves_temperature *temperature = ves_arena_take(s->arena, (size_t)r->temperatures, sizeof *temperature);
    ves_run_failure *failure = ves_arena_take(s->arena, VES_FAILURES, sizeof *failure);
    ves_annealing_report *annealing = ves_arena_take(s->arena, (size_t)r->annealings, sizeof *annealing);
    if (!temperature || !failure || !annealing) return VES_MEMORY;
    for (int k = 0; k < r->annealings; k++) {
        const char *sentence = r->annealing[k].sentence;
        annealing[k] = r->annealing[k];
        annealing[k].sentence = ves_arena_text(s->arena, sentence, strlen(sentence));
        if (!annealing[k].sentence) return VES_MEMORY;
    }
    for (int k = 0; k < r->temperatures; k++) temperature[k] = r->temperature[k];
    run->failures = 0;
    for (int k = 0; k < VES_FAILURES; k++)
        if (s->failed[k]) failure[run->failures++] = (ves_run_failure){(ves_status)k, s->failed[k]};
    run->failure = failure;
    if (!r->temperatures) return VES_OK;
    run->annealing = annealing;
    run->annealings = r->annealings;
    run->temperature = temperature;
    run->temperatures = r->temperatures;
    return VES_OK;
}

/* Appended: what searches again polishes only. */
static ves_status strategies_take(ves_study *s, const ves_search_result *r)
{
    ves_run *run = s->run;
    size_t count = (size_t)(run->strategies + r->strategies);
    ves_strategy_report *strategy = ves_arena_take(s->arena, count, sizeof *strategy);
    if (!strategy) return VES_MEMORY;
    for (int k = 0; k < run->strategies; k++) strategy[k] = run->strategy[k];
    for (int k = 0; k < r->strategies; k++) strategy[run->strategies++] = r->strategy[k];
    run->strategy = strategy;
    return VES_OK;
}

/* In the terms of the file. */
static ves_status kkt_take(ves_study *s, const ves_search_result *r)
{
    double *rate = ves_arena_take(s->arena, (size_t)r->m, sizeof *rate);
    double *bound = ves_arena_take(s->arena, (size_t)r->n, sizeof *bound);
    if (!rate || !bound) return VES_MEMORY;
    s->run->kkt = r->kkt;
    if (!r->kkt.known) return VES_OK;
    for (int k = 0; k < r->m; k++) rate[k] = ves_plan_rate(s->plan[0], k, r->kkt.multiplier[k]);
    for (int i = 0; i < r->n; i++) bound[i] = s->problem->maximize ? -r->kkt.bound[i] : r->kkt.bound[i];
    s->run->kkt.multiplier = rate;
    s->run->kkt.bound = bound;
    return VES_OK;
}

static ves_status evidence_take(ves_study *s, const ves_search_result *r)
{
    ves_evidence *e = &s->run->evidence;
    *e = r->evidence;
    e->sentence = ves_arena_text(s->arena, e->sentence, strlen(e->sentence));
    VES_TRY(e->sentence ? VES_OK : VES_MEMORY);
    VES_TRY(strategies_take(s, r));
    return kkt_take(s, r);
}

static ves_status result_take(ves_study *s, const ves_search_result *r)
{
    ves_run *run = s->run;
    run->ending = r->ending;
    run->any = r->any || run->start.status == VES_OK; /* a search may be stopped before it has begun */
    run->evaluations += r->evaluations;
    run->gradients += r->gradients;
    run->refused += r->refused;
    VES_TRY(words_take(s, r));
    if (counts_take(s, r) != VES_OK || optima_take(s, r) != VES_OK || evidence_take(s, r) != VES_OK)
        return ves_diag_fail(s->diag, VES_MEMORY);
    double *x = ves_arena_take(s->arena, (size_t)r->n, sizeof *x);
    if (!x) return ves_diag_fail(s->diag, VES_MEMORY);
    const double *from = r->any ? r->x : s->from; /* or no point is better than another */
    memcpy(x, from, sizeof *x * (size_t)r->n);
    rest(s, x);
    VES_TRY(ves_study_measure(s, x, 1, &run->finer));
    VES_TRY(ves_study_measure(s, x, 0, &run->best));
    run->feasible = r->any && r->feasible && run->best.status == VES_OK;
    return VES_OK;
}

static void hear_block(void *data, const void *block, size_t size, bool whole)
{
    ves_study *s = data;
    ves_journal_keep(&s->journal, block, size, whole, s->stages_before);
}

/* --- ranks --- */

static ves_status exchange(void *data, const void *mine, size_t size, const void **all, size_t *total)
{
    const ves_team *team = ((ves_study *)data)->options->team;
    return team->exchange(team->data, mine, size, all, total);
}

/* The block that rank 0 has read, or nothing where it has no more. */
static bool tell_all(ves_study *s, const void **block, size_t *size, bool *whole)
{
    const ves_team *team = s->options->team;
    struct {
        uint64_t size;
        uint32_t any, whole;
    } head = {*size, *block != NULL, *whole};
    if (team->tell(team->data, &head, sizeof head) != VES_OK || !head.any) return false;
    if (!ves_team_leads(s->options->team) && head.size > s->told_room) {
        unsigned char *room = ves_memory_grow(s->told_block, head.size);
        if (!room) return false; /* the others go on, and notice that this rank runs another round */
        s->told_block = room;
        s->told_room = head.size;
    }
    void *bytes = ves_team_leads(s->options->team) ? (void *)*block : s->told_block;
    *block = bytes, *size = head.size, *whole = head.whole;
    return team->tell(team->data, bytes, head.size) == VES_OK;
}

static bool tell_block(void *data, const void **block, size_t *size, bool *whole)
{
    ves_study *s = data;
    *block = NULL, *size = 0, *whole = false;
    bool any = ves_team_leads(s->options->team) && ves_journal_recall(&s->journal, block, size, whole);
    if (!s->options->team) return any;
    if (!any) *block = NULL;
    return tell_all(s, block, size, whole);
}

static double hear_clock(void *data)
{
    (void)data;
    return ves_study_clock();
}

static ves_status stale(const ves_study *s)
{
    return ves_diag_add(
        s->diag, VES_ERROR, VES_STALE, (ves_mark){0},
        "\"%s\" does not fit this search: it comes from another build of vesica, or from another "
        "kind of machine. Go on with that one, or run \"%s/problem.yaml\" anew",
        s->journal.path, s->run->folder);
}

ves_status ves_study_search(ves_study *s, const ves_search_options *options, const double *const *from,
                            int count)
{
    ves_run *run = s->run;
    ves_search_problem problem = ves_plan_search(s->plan, run->jobs);
    ves_search_result *result = NULL;
    ves_search_hooks hooks = {
        .progress = hear_progress, .record = hear_record, .stopped = hear_stopped, .data = s};
    const ves_team *team = s->options->team;
    if (s->journal.open) hooks.keep = hear_block, hooks.clock = hear_clock;
    if (s->recalls) hooks.recall = tell_block;
    if (team) hooks.rank = team->rank, hooks.ranks = team->ranks, hooks.exchange = exchange;
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
    if (status == VES_STALE || s->journal.stale) {
        ves_search_result_destroy(result);
        return stale(s);
    }
    if (!result) return ves_diag_fail(s->diag, status);
    ves_study_journal_tell(s);
    s->left = result->budget - result->evaluations;
    status = result_take(s, result);
    ves_search_result_destroy(result);
    return status;
}

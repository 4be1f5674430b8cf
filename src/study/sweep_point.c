#include "study/sweep_point.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/diag.h"
#include "base/text.h"
#include "output/output.h"
#include "study/design.h"
#include "study/folder.h"
#include "study/run.h"

enum { SENTENCE = 400, MESSAGE = 2000, SMALL_U = 32, SMALL_V = 48 /* cells of a patch in a small picture */ };

/* What may be left of the slope where a budget ended: in a flat valley the last digits take for ever. */
static const double CONVERGED = 1e-3;

static const double ROUNDED = 1e-9; /* of a step */
static const double LEAST = 1e-6;   /* of the step between two values: no smaller ones are taken */

/* A point while it is searched. */
typedef struct search {
    const ves_sweep_task *task;
    int index;
    ves_sweep_point *point;
    double value;       /* of the first parameter: that of the point, or on the way to it */
    const double *from; /* [variables]; NULL: where the branch begins */
    ves_arena *kept, scratch;
    ves_diag *diag; /* of this point alone */
    int said;       /* in it, before this search */
} search;

/* --- the problem there --- */

static ves_status value_set(const ves_problem *p, const ves_sweep_axis *axis, double value, ves_arena *arena,
                            ves_override *set)
{
    const ves_parameter *q = &p->parameter[axis->parameter];
    char digits[32];
    ves_text_shortest(value, digits);
    const char *number = ves_arena_text(arena, digits, strlen(digits));
    *set = (ves_override){axis->name, NULL};
    if (number) set->value = ves_study_quantity(number, ves_formula_dim(q->formula), &q->shown, arena);
    return set->value ? VES_OK : VES_MEMORY;
}

/* What makes the problem out of the file: a branch. */
static void settings(const ves_sweep *sweep, int branch, ves_override *set, int *count)
{
    const ves_sweep_def *def = sweep->def;
    *count = 0;
    if (def->branches)
        for (int k = 0; k < def->branch[branch].sets; k++) set[(*count)++] = def->branch[branch].set[k];
}

/* And then the parameters. */
static ves_status settings_here(search *s, ves_override *set, int *count)
{
    const ves_sweep *sweep = s->task->sweep;
    const ves_sweep_def *def = sweep->def;
    const ves_sweep_walk *walk = &sweep->walk[s->index / sweep->count];
    settings(sweep, walk->branch, set, count);
    const double value[VES_SWEEP_AXES] = {s->value, def->axes > 1 ? def->axis[1].value[walk->second] : 0};
    for (int k = 0; k < def->axes; k++)
        VES_TRY(value_set(sweep->problem, &def->axis[k], value[k], &s->scratch, &set[(*count)++]));
    return VES_OK;
}

static int settings_most(const ves_sweep *sweep, int branch)
{
    const ves_sweep_def *def = sweep->def;
    return (def->branches ? def->branch[branch].sets : 0) + VES_SWEEP_AXES + sweep->problem->variables;
}

static bool same_variables(const ves_problem *a, const ves_problem *b)
{
    bool same = a->variables == b->variables && a->unknowns == b->unknowns;
    for (int k = 0; same && k < a->variables + a->unknowns; k++)
        same = !strcmp(ves_problem_slot(a, k), ves_problem_slot(b, k));
    return same;
}

static bool same_measures(const ves_problem *a, const ves_problem *b)
{
    bool same = a->measures == b->measures;
    for (int k = 0; same && k < a->measures; k++)
        same =
            a->measure[k].measure == b->measure[k].measure && !strcmp(a->measure[k].name, b->measure[k].name);
    return same;
}

static bool same_goal(const ves_problem *a, const ves_problem *b)
{
    return !a->objective == !b->objective && a->maximize == b->maximize &&
           (!a->objective || !strcmp(a->objective_text, b->objective_text));
}

static bool same_constraints(const ves_problem *a, const ves_problem *b)
{
    bool same = a->constraints == b->constraints;
    for (int k = 0; same && k < a->constraints; k++)
        same = !strcmp(a->constraint[k].text, b->constraint[k].text) &&
               a->constraint[k].within == b->constraint[k].within;
    return same;
}

static bool same_kinds(const ves_problem *a, const ves_problem *b)
{
    bool same = a->kinds == b->kinds;
    for (int k = 0; same && k < a->kinds; k++)
        same = !strcmp(a->kind[k].name, b->kind[k].name) && !strcmp(a->kind[k].text, b->kind[k].text);
    return same;
}

/* Points are told in the same columns and ranked by the same measure of them. What of it is not so; NULL: all is. */
static const char *unlike(const ves_problem *a, const ves_problem *b)
{
    return !same_variables(a, b)     ? "the names of the variables"
           : !same_goal(a, b)        ? "what is minimized or maximized"
           : !same_constraints(a, b) ? "the constraints"
           : !same_kinds(a, b)       ? "the kinds"
           : !same_measures(a, b)    ? "the measures"
                                     : NULL;
}

/* mark: where it stands what is set. */
static ves_status read(const ves_sweep_task *task, const ves_override *set, int count, ves_mark mark,
                       ves_problem **problem, ves_diag *diag)
{
    const ves_problem *base = task->sweep->problem;
    const ves_read_options options = {.overrides = count,
                                      .override = set,
                                      .plugin = task->options->plugin,
                                      .plugin_file = base->plugin_file,
                                      .inner = true};
    ves_status status =
        ves_problem_read_text(base->path, base->text, strlen(base->text), &options, problem, diag);
    const char *what = status == VES_OK ? unlike(base, *problem) : NULL;
    if (!what) return status;
    ves_problem_destroy(*problem);
    *problem = NULL;
    return ves_diag_add(diag, VES_ERROR, VES_USAGE, mark,
                        "what is set here changes %s: its points could not be compared with the others; "
                        "sweep it as a file of its own",
                        what);
}

ves_status ves_sweep_branch_check(const ves_sweep_task *task, int branch, ves_diag *diag)
{
    ves_arena arena = {0};
    ves_problem *problem = NULL;
    int count = 0;
    ves_override *set = ves_arena_take(&arena, (size_t)settings_most(task->sweep, branch), sizeof *set);
    ves_status status = set ? VES_OK : VES_MEMORY;
    if (set) settings(task->sweep, branch, set, &count);
    if (set)
        status = read(task, set, count, task->sweep->def->branch[branch].mark, &problem, diag);
    else
        ves_diag_fail(diag, status);
    ves_problem_destroy(problem);
    ves_arena_destroy(&arena);
    return status;
}

/* Appends where the variables begin: what the last good point found, in the ranges that hold here. */
static ves_status start_set(search *s, const ves_problem *here, ves_override *set, int *count)
{
    VES_TRY(ves_study_starts(here, s->from, &s->scratch, set + *count));
    *count += here->variables;
    return VES_OK;
}

/* Read twice where it begins at the neighbour's best: ranges may depend on the parameter. */
static ves_status read_here(search *s, ves_problem **problem)
{
    const ves_sweep *sweep = s->task->sweep;
    const int branch = sweep->walk[s->index / sweep->count].branch;
    int count = 0;
    ves_override *set = ves_arena_take(&s->scratch, (size_t)settings_most(sweep, branch), sizeof *set);
    if (!set) return VES_MEMORY;
    VES_TRY(settings_here(s, set, &count));
    VES_TRY(read(s->task, set, count, sweep->def->mark, problem, s->diag));
    if (!s->from) return VES_OK;
    ves_problem *first = *problem; /* whose names are set */
    *problem = NULL;
    ves_status status = start_set(s, first, set, &count);
    if (status == VES_OK) status = read(s->task, set, count, sweep->def->mark, problem, s->diag);
    ves_problem_destroy(first);
    return status;
}

/* --- what came of it --- */

static ves_status lose(search *s, const char *text)
{
    s->point->good = false;
    s->point->reason = ves_arena_text(s->kept, text, strcspn(text, "\n"));
    return s->point->reason ? VES_OK : VES_MEMORY;
}

/* The first error, without the line that it quotes. */
static ves_status lose_by_diag(search *s, ves_status status)
{
    char text[MESSAGE];
    for (int k = s->said; k < ves_diag_count(s->diag); k++) {
        if (ves_diag_severity(s->diag, k) != VES_ERROR) continue;
        ves_diag_text(s->diag, k, text, sizeof text);
        return lose(s, text);
    }
    return lose(s, ves_status_text(status));
}

static ves_status lose_unmeasured(search *s, const ves_run *run)
{
    char text[SENTENCE];
    ves_status why = run->start.status;
    long most = 0;
    for (int k = 0; k < run->failures; k++)
        if (run->failure[k].count > most) most = run->failure[k].count, why = run->failure[k].status;
    snprintf(text, sizeof text, "nothing could be measured: %s", ves_status_text(why));
    return lose(s, text);
}

static ves_status lose_infeasible(search *s, const ves_run *run)
{
    const ves_problem *p = run->problem;
    char text[SENTENCE];
    int worst = 0;
    for (int k = 1; k < p->constraints; k++)
        if (run->best.side[k].violation > run->best.side[worst].violation) worst = k;
    snprintf(text, sizeof text, "infeasible: %.200s is violated by %.2g of its size",
             p->constraint[worst].text, run->best.side[worst].violation);
    return lose(s, text);
}

/* With the reason of its proofs, if they had but one. */
static ves_status lose_unproved(search *s, const ves_run *run)
{
    static const char refused[] = "a best was refused by its proof: ";
    const char *why = NULL;
    char text[SENTENCE];
    int reasons = 0;
    for (int k = 0; k < run->notes; k++)
        if (!strncmp(run->note[k], refused, sizeof refused - 1))
            why = run->note[k] + sizeof refused - 1, reasons++;
    snprintf(text, sizeof text, "the best did not pass its checks%s%s", reasons == 1 ? ": " : "",
             reasons == 1 ? why : "");
    return lose(s, text);
}

/* The kind that the branch is of. */
static ves_status lose_branch(search *s, const ves_run *run, int kind)
{
    char text[SENTENCE];
    snprintf(text, sizeof text, "left its branch: %.100s, not %.100s",
             ves_design_kind(run->problem, run->best.kind), ves_design_kind(run->problem, kind));
    return lose(s, text);
}

static ves_status judge(search *s, const ves_run *run)
{
    const ves_sweep *sweep = s->task->sweep;
    const int branch = sweep->walk[s->index / sweep->count].branch;
    const int kind = sweep->def->branches ? sweep->def->branch[branch].kind : -1;
    s->point->good = true;
    if (!run->any) return lose_unmeasured(s, run);
    if (!run->best.feasible) return lose_infeasible(s, run);
    if (!run->feasible) return lose_unproved(s, run);
    if (run->searched && run->ending == VES_ENDED_BUDGET &&
        !(run->kkt.known && run->kkt.residual <= CONVERGED))
        return lose(s, "not converged: the budget was too short");
    if (kind >= 0 && run->best.kind != kind) return lose_branch(s, run, kind);
    return VES_OK;
}

static void columns_fill(const ves_sweep *sweep, const ves_run *run, double *column)
{
    const ves_problem *p = run->problem;
    const ves_design *d = &run->best;
    const int *first = sweep->first;
    column[first[VES_SWEEP_OBJECTIVE]] = d->objective;
    column[first[VES_SWEEP_VIOLATION]] = d->violation;
    memcpy(column + first[VES_SWEEP_VARIABLE], d->slot,
           sizeof *column * (size_t)(p->variables + p->unknowns));
    memcpy(column + first[VES_SWEEP_MEASURE], d->measure, sizeof *column * (size_t)p->measures);
    for (int k = 0; k < p->constraints; k++) {
        column[first[VES_SWEEP_VALUE] + k] = d->side[k].value;
        column[first[VES_SWEEP_LIMIT] + k] = d->side[k].limit;
        if (run->kkt.known) column[first[VES_SWEEP_PRICE] + k] = run->kkt.multiplier[k];
    }
}

static ves_status notes_take(search *s, const ves_run *run)
{
    s->point->note = ves_arena_take(s->kept, (size_t)run->notes, sizeof *s->point->note);
    if (!s->point->note) return VES_MEMORY;
    for (int k = 0; k < run->notes; k++) {
        s->point->note[k] = ves_arena_text(s->kept, run->note[k], strlen(run->note[k]));
        if (!s->point->note[k]) return VES_MEMORY;
        s->point->notes++;
    }
    return VES_OK;
}

static ves_status shape_write(search *s, const ves_run *run)
{
    const ves_plan_options grid = {{run->quadrature[0], run->quadrature[1]}};
    ves_plan *plan = NULL;
    ves_figure *figure = NULL;
    char name[48];
    snprintf(name, sizeof name, "shapes/%04d.vtp", s->index);
    char *path = ves_folder_path(s->task->sweep->folder, name, &s->scratch);
    if (!path) return VES_MEMORY;
    ves_status status = ves_plan_create(run->problem, &grid, &plan, NULL);
    if (status == VES_OK) status = ves_plan_figure(plan, run->best.x, 0, 0, &figure, NULL);
    if (status == VES_OK) status = ves_format_find("vtp")->write(figure, path, s->diag);
    ves_figure_destroy(figure);
    ves_plan_destroy(plan);
    return status;
}

/* Of the point. */
static double value_of(const search *s)
{
    const ves_sweep *sweep = s->task->sweep;
    return sweep->def->axis[0].value[ves_sweep_place(sweep, s->index)];
}

static ves_status take(search *s, const ves_run *run)
{
    if (run->ending == VES_ENDED_STOPPED) return VES_INTERRUPTED;
    s->point->evaluations += run->evaluations;
    s->point->gradients += run->gradients;
    VES_TRY(judge(s, run));
    VES_TRY(notes_take(s, run));
    s->point->feasible = run->any && run->best.feasible;
    s->point->slope = run->kkt.known ? run->kkt.slope : NAN;
    if (run->any) s->point->kind = run->best.kind;
    if (run->any) columns_fill(s->task->sweep, run, s->point->column);
    return s->point->good && s->value == value_of(s) ? shape_write(s, run) : VES_OK;
}

/* --- the search --- */

static ves_status go(search *s, const ves_problem *problem)
{
    const ves_sweep_task *t = s->task;
    const ves_sweep_def *def = t->sweep->def;
    const ves_run_options options = {.seeded = t->options->seeded,
                                     .seed = t->options->seed,
                                     .jobs = t->jobs,
                                     .search = s->from       ? &def->search
                                               : def->begins ? &def->first
                                                             : NULL};
    const ves_run_hooks hooks = {.stopped = t->hooks->stopped, .data = t->hooks->data};
    ves_run *run = NULL;
    ves_status status = ves_run_create(problem, &options, &hooks, &run, s->diag);
    if (run) status = take(s, run);
    ves_run_destroy(run);
    return status;
}

/* What no other place would be spared. */
static bool is_fault(ves_status status)
{
    return status == VES_MEMORY || status == VES_IO || status == VES_FAULT || status == VES_INTERRUPTED;
}

static ves_status find(search *s)
{
    const int columns = s->task->sweep->first[VES_SWEEP_GROUPS];
    ves_problem *problem = NULL;
    *s->point = (ves_sweep_point){.slope = NAN,
                                  .reached = NAN,
                                  .kind = -1,
                                  .evaluations = s->point->evaluations,
                                  .gradients = s->point->gradients};
    s->said = ves_diag_count(s->diag);
    s->point->column = ves_arena_take(s->kept, (size_t)columns, sizeof *s->point->column);
    if (!s->point->column) return VES_MEMORY;
    for (int k = 0; k < columns; k++) s->point->column[k] = NAN;
    ves_status status = read_here(s, &problem);
    if (status == VES_OK) status = go(s, problem);
    ves_problem_destroy(problem);
    return status == VES_OK || is_fault(status) ? status : lose_by_diag(s, status);
}

/* A point that was lost in one step from its neighbour: steps half as long, each from the end of the one before, and
 * shorter ones where these lose the branch too. What they cost is the point's. */
static ves_status follow(search *s, double near)
{
    const ves_sweep *sweep = s->task->sweep;
    const double target = value_of(s), finest = fmax(sweep->def->finest, LEAST * fabs(target - near));
    const int first = sweep->first[VES_SWEEP_VARIABLE];
    ves_sweep_point *point = s->point, tried = *point, kept = *point;
    double step = (target - near) / 2, reached = near;
    ves_status status = VES_OK;
    for (s->point = &tried; !kept.good && status == VES_OK && fabs(step) >= finest * (1 - ROUNDED);) {
        const bool last = fabs(target - reached) <= fabs(step) * (1 + ROUNDED);
        s->value = last ? target : reached + step;
        status = find(s);
        if (last && status == VES_OK) kept = tried;
        if (tried.good)
            reached = s->value, s->from = tried.column + first;
        else
            step /= 2;
    }
    s->point = point;
    *point = kept;
    point->reached = kept.good ? NAN : reached;
    point->evaluations = tried.evaluations;
    point->gradients = tried.gradients;
    return status;
}

ves_status ves_sweep_point_find(const ves_sweep_task *task, int index, int from, ves_arena *arena,
                                ves_diag *diag)
{
    const ves_sweep *sweep = task->sweep;
    search s = {.task = task, .index = index, .kept = arena, .diag = diag};
    s.point = &task->sweep->point[index];
    *s.point = (ves_sweep_point){0};
    s.value = value_of(&s);
    if (from >= 0) s.from = sweep->point[from].column + sweep->first[VES_SWEEP_VARIABLE];
    double begin = ves_study_clock();
    ves_status status = find(&s);
    if (status == VES_OK && !s.point->good && from >= 0 && from == index - 1 && sweep->def->finest > 0)
        status = follow(&s, sweep->def->axis[0].value[ves_sweep_place(sweep, from)]);
    s.point->wall = ves_study_clock() - begin;
    s.point->done = status == VES_OK;
    ves_arena_destroy(&s.scratch);
    return status;
}

ves_status ves_sweep_point_figure(const ves_sweep_task *task, int index, ves_figure **figure)
{
    const ves_sweep *sweep = task->sweep;
    search s = {.task = task, .index = index, .diag = ves_diag_create()};
    ves_problem *problem = NULL;
    ves_plan *plan = NULL;
    *figure = NULL;
    s.value = value_of(&s);
    s.from = sweep->point[index].column + sweep->first[VES_SWEEP_VARIABLE];
    ves_status status = s.diag ? read_here(&s, &problem) : VES_MEMORY;
    if (status == VES_OK) status = ves_plan_create(problem, NULL, &plan, NULL);
    if (status == VES_OK) status = ves_plan_figure(plan, s.from, SMALL_U, SMALL_V, figure, NULL);
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    ves_diag_destroy(s.diag);
    ves_arena_destroy(&s.scratch);
    return status;
}

#include "study/sweep.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/diag.h"
#include "base/pool.h"
#include "study/folder.h"
#include "study/lock.h"
#include "study/run.h"
#include "study/sweep_folder.h"
#include "study/sweep_gallery.h"
#include "study/sweep_point.h"
#include "study/sweep_report.h"
#include "study/team.h"

enum { NAME = 200, POINTS_MOST = 1000000 };

/* What ves_sweep_run makes: first what the caller holds. */
typedef struct whole {
    ves_sweep shown;
    ves_arena arena;
    const ves_sweep_options *options;
    const ves_sweep_hooks *hooks;
    ves_diag *diag;
    ves_sweep_task task;
    ves_arena *kept; /* [walks] */
    int *ready;      /* [walks] points that are done */
    int *mine;       /* the walks of this rank */
    int share;       /* how many they are */
    ves_pool *pool;
    ves_lock lock;
    ves_status status; /* the first failure; under the pool's lock */
    bool told;         /* the points have been compared: there is something to show */
} whole;

/* --- the shape of it --- */

int ves_sweep_place(const ves_sweep *sweep, int index)
{
    int step = index % sweep->count;
    return sweep->walk[index / sweep->count].back ? sweep->count - 1 - step : step;
}

int ves_sweep_point_at(const ves_sweep *sweep, int walk, int place)
{
    return walk * sweep->count + (sweep->walk[walk].back ? sweep->count - 1 - place : place);
}

int ves_sweep_return(const ves_sweep *sweep, int walk)
{
    if (!sweep->def->forth || !sweep->def->back) return -1;
    return sweep->walk[walk].back ? walk - 1 : walk + 1; /* the two stand side by side */
}

const char *ves_sweep_direction(const ves_sweep *sweep, bool back)
{
    const ves_sweep_axis *axis = &sweep->def->axis[0];
    bool rises = axis->count < 2 || axis->value[1] > axis->value[0];
    return rises != back ? "up" : "down";
}

void ves_sweep_text(const ves_sweep *sweep, int axis, int value, char text[VES_QUANTITY])
{
    const ves_sweep_axis *a = &sweep->def->axis[axis];
    const ves_shown *shown = &sweep->problem->parameter[a->parameter].shown;
    char number[32];
    ves_number_text(a->value[value] / shown->factor, number);
    snprintf(text, VES_QUANTITY, "%.40s = %.20s%s%.30s", a->name, number, *shown->unit ? " " : "",
             shown->unit);
}

static const char *walk_name(whole *w, const ves_sweep_walk *walk)
{
    const ves_sweep_def *def = w->shown.def;
    char second[VES_QUANTITY] = "";
    const char *part[3] = {"", "", ""}, *gap[2] = {"", ""};
    if (def->branches) part[0] = def->branch[walk->branch].name;
    if (def->axes > 1) ves_sweep_text(&w->shown, 1, walk->second, second), part[1] = second;
    if (def->forth && def->back) part[2] = ves_sweep_direction(&w->shown, walk->back);
    if (*part[0] && (*part[1] || *part[2])) gap[0] = ", ";
    if (*part[1] && *part[2]) gap[1] = ", ";
    return ves_arena_format(&w->arena, "%.100s%s%s%s%s", part[0], gap[0], part[1], gap[1], part[2]);
}

static ves_status walks_make(whole *w)
{
    ves_sweep *s = &w->shown;
    const ves_sweep_def *def = s->def;
    const int branches = def->branches ? def->branches : 1, ways = def->forth + def->back;
    const int seconds = def->axes > 1 ? def->axis[1].count : 1;
    s->count = def->axis[0].count;
    if ((double)branches * seconds * ways * s->count > POINTS_MOST)
        return ves_diag_add(w->diag, VES_ERROR, VES_RANGE, def->mark, "a sweep has at most %d points",
                            POINTS_MOST);
    ves_sweep_walk *walk = ves_arena_take(&w->arena, (size_t)(branches * seconds * ways), sizeof *walk);
    if (!walk) return ves_diag_fail(w->diag, VES_MEMORY);
    s->walk = walk;
    for (int b = 0; b < branches; b++) {
        const int before = s->walks;
        for (int j = 0; j < seconds; j++)
            for (int way = 0; way < 2; way++)
                if ((way ? def->back : def->forth) && ves_sweep_walked(def, b, j))
                    walk[s->walks++] = (ves_sweep_walk){.branch = b, .second = j, .back = way};
        if (s->walks == before)
            ves_diag_add(w->diag, VES_WARNING, VES_OK, def->branch[b].mark,
                         "branch \"%s\" is not walked: no value is one that `at` names", def->branch[b].name);
    }
    for (int k = 0; k < s->walks; k++)
        if (!(walk[k].name = walk_name(w, &walk[k]))) return ves_diag_fail(w->diag, VES_MEMORY);
    if (s->walks) return VES_OK;
    return ves_diag_add(w->diag, VES_ERROR, VES_RANGE, def->mark, "no branch is walked at these values");
}

static ves_status room_make(whole *w)
{
    ves_sweep *s = &w->shown;
    const ves_problem *p = s->problem;
    const int size[VES_SWEEP_GROUPS] = {
        1, 1, p->variables, p->unknowns, p->measures, p->constraints, p->constraints, p->constraints};
    for (int g = 0; g < VES_SWEEP_GROUPS; g++) s->first[g + 1] = s->first[g] + size[g];
    s->point = ves_arena_take(&w->arena, (size_t)(s->walks * s->count), sizeof *s->point);
    w->kept = ves_arena_take(&w->arena, (size_t)s->walks, sizeof *w->kept);
    w->ready = ves_arena_take(&w->arena, (size_t)s->walks, sizeof *w->ready);
    w->mine = ves_arena_take(&w->arena, (size_t)s->walks, sizeof *w->mine);
    if (!s->point || !w->kept || !w->ready || !w->mine) return ves_diag_fail(w->diag, VES_MEMORY);
    const ves_team *team = w->options->team;
    for (int k = 0; k < s->walks; k++)
        if (!team || k % team->ranks == team->rank) w->mine[w->share++] = k;
    return VES_OK;
}

/* --- walking --- */

static bool stopped(const whole *w)
{
    return w->hooks->stopped && w->hooks->stopped(w->hooks->data);
}

static ves_status status_of(whole *w)
{
    ves_pool_lock(w->pool);
    ves_status status = w->status;
    ves_pool_unlock(w->pool);
    return status;
}

/* Where the next point begins: at the best of this one; -1: there is none. */
static int last_good(const ves_sweep *s, int walk, int ready)
{
    int index = walk * s->count + ready - 1;
    while (index >= walk * s->count && !s->point[index].good) index--;
    return index < walk * s->count ? -1 : index;
}

/* A fault of one point ends all: its message becomes one of the sweep. Under the lock. */
static void fault(whole *w, ves_status status, const ves_diag *own)
{
    if (w->status != VES_OK) return;
    w->status = status;
    if (status == VES_INTERRUPTED) return;
    char text[VES_QUANTITY + NAME];
    const char *why = ves_status_text(status);
    for (int k = 0; k < ves_diag_count(own); k++) /* the last: those before have but lost the point */
        if (ves_diag_severity(own, k) == VES_ERROR) {
            ves_diag_text(own, k, text, sizeof text);
            why = strncmp(text, "error: ", 7) ? text : text + 7;
        }
    ves_diag_add(w->diag, VES_ERROR, status, (ves_mark){0}, "%s", why);
}

static ves_status step(whole *w, int walk)
{
    ves_sweep *s = &w->shown;
    ves_arena scratch = {0};
    ves_diag *own = ves_diag_create();
    const int index = walk * s->count + w->ready[walk];
    ves_status status = own ? VES_OK : VES_MEMORY;
    if (status == VES_OK)
        status =
            ves_sweep_point_find(&w->task, index, last_good(s, walk, w->ready[walk]), &w->kept[walk], own);
    if (status == VES_OK) status = ves_sweep_line_write(s, index, &scratch, own);
    ves_pool_lock(w->pool);
    if (status == VES_OK) {
        w->ready[walk]++;
        s->done++;
        if (w->hooks->progress) w->hooks->progress(w->hooks->data, s, index);
    } else {
        s->point[index].done = false;
        fault(w, status, own);
    }
    ves_pool_unlock(w->pool);
    ves_diag_destroy(own);
    ves_arena_destroy(&scratch);
    return status;
}

static void walk_along(void *data, int worker, int number)
{
    whole *w = data;
    const int walk = w->mine[number];
    (void)worker;
    while (w->ready[walk] < w->shown.count && status_of(w) == VES_OK && !stopped(w))
        if (step(w, walk) != VES_OK) return;
}

static ves_status walk_all(whole *w)
{
    ves_sweep *s = &w->shown;
    int workers = s->jobs < w->share ? s->jobs : w->share;
    if (workers < 1) workers = 1;
    w->task.jobs = s->jobs / workers;
    w->pool = ves_pool_create(workers);
    if (!w->pool) return ves_diag_fail(w->diag, VES_MEMORY);
    ves_pool_run(w->pool, w->share, walk_along, w);
    ves_pool_destroy(w->pool);
    w->pool = NULL;
    bool all = true;
    for (int k = 0; k < w->share; k++) all = all && w->ready[w->mine[k]] == s->count;
    return w->status == VES_OK && !all ? VES_INTERRUPTED : w->status;
}

/* --- the folder --- */

static ves_status folder_take(whole *w)
{
    const ves_sweep_options *o = w->options;
    char *folder = NULL, *name = ves_arena_format(&w->arena, "%s-sweep", w->shown.problem->name);
    if (!ves_team_leads(w->options->team)) return VES_OK;
    if (!name) return ves_diag_fail(w->diag, VES_MEMORY);
    if (o->resume)
        folder = ves_arena_text(&w->arena, o->out, strlen(o->out));
    else
        VES_TRY(o->out ? ves_folder_make(o->out, &w->arena, &folder, w->diag)
                       : ves_folder_number("runs", name, &w->arena, &folder, w->diag));
    if (!folder) return ves_diag_fail(w->diag, VES_MEMORY);
    w->shown.folder = folder;
    VES_TRY(ves_lock_take(&w->lock, folder, &w->arena, w->diag));
    if (!o->resume) return ves_sweep_folder_begin(&w->shown, o, &w->arena, w->diag);
    VES_TRY(ves_lock_alone(folder, &w->arena, w->diag));
    ves_folder_tidy(folder, &w->arena);
    char *shapes = ves_folder_path(folder, "shapes", &w->arena);
    if (shapes) ves_folder_tidy(shapes, &w->arena);
    return VES_OK;
}

/* cut: what a kill has torn; only who goes on with a walk may do that. */
static ves_status walks_read(whole *w, bool others)
{
    ves_sweep *s = &w->shown;
    const ves_team *team = w->options->team;
    for (int k = 0; k < s->walks; k++) {
        bool mine = !team || k % team->ranks == team->rank;
        if (mine == others) continue;
        VES_TRY(ves_sweep_lines_read(s, k, mine, &w->kept[k], &w->ready[k], w->diag));
        s->done += w->ready[k];
    }
    return VES_OK;
}

/* --- the whole --- */

static ves_status prepare(whole *w)
{
    ves_sweep *s = &w->shown;
    VES_TRY(walks_make(w));
    VES_TRY(room_make(w));
    for (int k = 0; k < s->def->branches; k++) VES_TRY(ves_sweep_branch_check(&w->task, k, w->diag));
    VES_TRY(ves_team_follow(w->options->team, folder_take(w)));
    return ves_team_path(w->options->team, &w->shown.folder, &w->arena, w->diag);
}

/* The other ranks, which have no lock of the folder, say that they are there. */
static ves_status help(whole *w)
{
    return ves_team_leads(w->options->team) ? VES_OK
                                            : ves_lock_help(&w->lock, w->shown.folder, &w->arena, w->diag);
}

static ves_status walk(whole *w)
{
    VES_TRY(help(w));
    if (w->options->resume) VES_TRY(walks_read(w, false));
    w->shown.before = w->shown.done;
    if (w->hooks->begun) w->hooks->begun(w->hooks->data, &w->shown);
    return walk_all(w);
}

static ves_status work(whole *w)
{
    double begin = ves_study_clock();
    VES_TRY(prepare(w));
    ves_status status = ves_team_meet(w->options->team, walk(w));
    if (!ves_team_leads(w->options->team)) return status;
    if (w->options->team && w->status == VES_OK && status != VES_OK && status != VES_INTERRUPTED)
        ves_diag_add(w->diag, VES_ERROR, status, (ves_mark){0}, "another process failed: %s",
                     ves_status_text(status));
    if (status == VES_OK || status == VES_INTERRUPTED) {
        ves_status read = walks_read(w, true);
        w->shown.wall = ves_study_clock() - begin;
        if (read == VES_OK && ves_sweep_compare(&w->shown) != VES_OK)
            read = ves_diag_fail(w->diag, VES_MEMORY);
        w->told = read == VES_OK;
        if (read == VES_OK) read = ves_sweep_report_write(&w->shown, w->diag);
        if (read == VES_OK && status == VES_OK) read = ves_sweep_gallery_write(&w->task, w->diag);
        if (read != VES_OK) status = read;
    }
    return status;
}

static ves_status options_check(const ves_problem *problem, const ves_sweep_options *o, ves_diag *diag)
{
    if (o->resume && !o->out)
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, (ves_mark){0}, "which folder is to be gone on with?");
    if (problem->sweep) return VES_OK;
    return ves_diag_add(
        diag, VES_ERROR, VES_USAGE, (ves_mark){0},
        "\"%s\" has no \"sweep\": say over which parameter, --over NAME=FROM..TO:COUNT, or in "
        "the file, sweep: {over: {NAME: {from: ..., to: ..., count: ...}}}",
        problem->path);
}

ves_status ves_sweep_run(const ves_problem *problem, const ves_sweep_options *options,
                         const ves_sweep_hooks *hooks, ves_sweep **sweep, ves_diag *diag)
{
    *sweep = NULL;
    VES_TRY(options_check(problem, options, diag));
    whole *w = ves_memory_take(sizeof *w);
    if (!w) return ves_diag_fail(diag, VES_MEMORY);
    w->shown.problem = problem;
    w->shown.def = problem->sweep;
    w->shown.jobs = ves_team_jobs(options->team, options->jobs);
    w->options = options;
    w->hooks = hooks;
    w->diag = diag;
    w->lock = (ves_lock){.fd = -1};
    w->task = (ves_sweep_task){.sweep = &w->shown, .options = options, .hooks = hooks};
    ves_status status = work(w);
    ves_lock_drop(&w->lock);
    if (w->told)
        *sweep = &w->shown;
    else
        ves_sweep_destroy(&w->shown);
    return status;
}

void ves_sweep_destroy(ves_sweep *sweep)
{
    if (!sweep) return;
    whole *w = (whole *)sweep;
    for (int k = 0; w->kept && k < sweep->walks; k++) ves_arena_destroy(&w->kept[k]);
    ves_arena arena = w->arena;
    ves_memory_free(w);
    ves_arena_destroy(&arena);
}

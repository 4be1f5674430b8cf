/* vesica run */
#include <string.h>

#include "app/app.h"
#include "study/folder.h"
#include "study/ranks.h"
#include "study/result.h"
#include "study/saved.h"

typedef struct listener {
    app *a;
    ves_progress_bar *bar;
} listener;

static void heading(void *data, const ves_run *run)
{
    listener *l = data;
    const ves_problem *p = run->problem;
    char v[64], c[64];
    app_patience_end();
    app_say(l->a); /* what the file made us warn of comes first */
    fprintf(stderr, "%s  %s\n  %s, %s, %d x %d nodes a patch", p->name, p->title,
            app_screen_plural(p->variables, "variable", "variables", v),
            app_screen_plural(p->constraints, "constraint", "constraints", c), run->quadrature[0],
            run->quadrature[1]);
    if (run->searched)
        fprintf(stderr, ", seed %llu, %d %s", (unsigned long long)run->seed, run->jobs,
                run->jobs == 1 ? "job" : "jobs");
    if (run->recalled >= 0)
        fprintf(stderr, "\n  goes on after %s",
                app_screen_plural(run->recalled, "evaluation", "evaluations", v));
    fputs("\n\n", stderr);
}

static void show(void *data, const ves_progress *progress)
{
    listener *l = data;
    if (ves_diag_count(l->a->diag) > l->a->said) { /* a disk that is full is told while there is time */
        ves_progress_break(l->bar);
        app_say(l->a);
    }
    ves_progress_show(l->bar, progress);
}

static bool stopped(void *data)
{
    (void)data;
    return app_interrupt_asked();
}

static void json_print(const ves_run *run)
{
    ves_json json = {.out = stdout};
    ves_json_object(&json, NULL);
    ves_result_write(run, &json);
    ves_json_number(&json, "wall_s", run->times.wall);
    ves_json_number(&json, "cpu_s", run->times.cpu);
    ves_json_text(&json, "folder", run->folder);
    ves_json_flag(&json, "interrupted", run->ending == VES_ENDED_STOPPED);
    ves_json_end(&json, '}');
}

static int verdict(const ves_run *run, ves_status status)
{
    if (run->ending == VES_ENDED_STOPPED) return APP_INTERRUPTED;
    if (status != VES_OK) return app_code(status);
    return run->any && run->feasible && run->passed ? APP_DONE : APP_UNMET;
}

static ves_run_options options_of(const app *a, const ves_opened *opened)
{
    const app_options *o = &a->options;
    return (ves_run_options){.seeded = o->seeded,
                             .seed = o->seed,
                             .evaluations = o->evaluations,
                             .jobs = o->jobs,
                             .test = o->test,
                             .files = !o->no_files,
                             .out = o->out,
                             .name = opened->name,
                             .trace = o->trace,
                             .forget = o->forget,
                             .team = a->team};
}

static void say_end(const ves_run *run, const ves_run_options *options)
{
    if (run->over) fprintf(stderr, "%s: this run is done, nothing was asked again\n", run->folder);
    if (run->ending == VES_ENDED_STOPPED && run->folder && !options->forget)
        fprintf(stderr, "to go on: %s run --resume %s\n", app_called(), run->folder);
}

/* Runs it, and tells what came out. */
static int work(app *a, const ves_opened *opened, const ves_run_options *options)
{
    ves_run *run;
    listener l = {a, ves_progress_create(stderr, a->options.progress)};
    ves_run_hooks hooks = {heading, show, stopped, &l};
    app_interrupt_listen();
    if (a->options.progress != VES_PROGRESS_NONE) app_patience_begin();
    ves_status status = ves_run_create(opened->problem, options, &hooks, &run, a->diag);
    app_patience_end();
    ves_progress_destroy(l.bar);
    app_say(a);
    a->torn = !run && (status == VES_MEMORY || status == VES_FAULT || status == VES_STALE);
    if (!run) return app_code(status);
    if (a->options.json)
        json_print(run);
    else
        app_screen_run(run, stdout);
    say_end(run, options);
    int code = verdict(run, status);
    ves_run_destroy(run);
    return code;
}

/* --- going on --- */

ves_status app_plugins_again(app *a, const ves_saved *saved)
{
    app_options *o = &a->options;
    if (!o->plugins) {
        for (int k = 0; k < saved->plugins && k < APP_PLUGINS; k++)
            o->plugin[o->plugins++] = saved->plugin[k].path;
        VES_TRY(app_plugins_load(a));
    }
    if (o->plugins == saved->plugins) return ves_saved_compare(saved, o->plugin, a->diag);
    app_fail(a, VES_USAGE, "\"%s\" was made with %d plugins, not %d", saved->folder, saved->plugins,
             o->plugins);
    return VES_USAGE;
}

static int resume(app *a)
{
    ves_saved saved;
    ves_opened opened;
    const char *folder = a->options.resume;
    if (a->operands || a->options.decides)
        return app_fail(
            a, VES_USAGE,
            "--resume takes from the folder \"%s\" how the run was begun: %s%s cannot be given with it",
            folder, a->operands ? "" : "--", a->operands ? a->operand[0] : a->options.decides);
    ves_status status = ves_saved_read(folder, &a->arena, &saved, a->diag);
    if (status == VES_OK) status = app_plugins_again(a, &saved);
    if (status == VES_OK) status = ves_saved_open(&saved, a->measure, &opened, a->diag);
    app_say(a);
    if (status != VES_OK) return app_code(status);
    saved.options.jobs = a->options.jobs;
    saved.options.team = a->team;
    int code = work(a, &opened, &saved.options);
    ves_study_close(&opened);
    return code;
}

static int run_one(app *a)
{
    ves_opened opened;
    int code;
    if (a->options.resume) return resume(a);
    if (!a->operands)
        return app_fail(a, VES_USAGE, "something is missing: vesica run FILE, or vesica run --resume RUN");
    if (ves_folder_is(a->operand[0]))
        return app_fail(a, VES_USAGE,
                        "\"%s\" is a folder: vesica run needs a problem file; --resume goes on with a run "
                        "that was interrupted, "
                        "--start begins at its best design",
                        a->operand[0]);
    if (!app_open(a, &opened, &code)) return code;
    const ves_run_options options = options_of(a, &opened);
    code = work(a, &opened, &options);
    ves_study_close(&opened);
    return code;
}

int app_together(app *a, int (*alone)(app *a))
{
    ves_ranks ranks;
    int rank;
    if (ves_ranks_asked(&rank) == 1) return alone(a);
    bool muted = rank == 0 || (freopen("/dev/null", "w", stdout) && freopen("/dev/null", "w", stderr));
    if (!muted) return APP_MISSING;
    if (a->operands && !strcmp(a->operand[0], "-"))
        return app_fail(a, VES_USAGE,
                        "stdin goes to one process alone: under mpirun the problem must be a file");
    ves_status status = ves_ranks_begin(&ranks, a->diag);
    if (status != VES_OK) return app_code(status);
    a->team = &ranks.team;
    int code = alone(a);
    ves_ranks_end(&ranks, !a->torn); /* one that fails alone would be waited for */
    return code;
}

int app_run(app *a)
{
    return app_together(a, run_one);
}

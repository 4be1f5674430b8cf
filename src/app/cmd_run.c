/* vesica run */
#include <stdlib.h>
#include <string.h>

#include "app/app.h"
#include "study/folder.h"
#include "study/result.h"

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
    fputs("\n\n", stderr);
}

static void show(void *data, const ves_progress *progress)
{
    ves_progress_show(((listener *)data)->bar, progress);
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

static ves_status work(app *a, const ves_opened *opened, ves_run **run)
{
    const app_options *o = &a->options;
    ves_run_options options = {.seeded = o->seeded,
                               .seed = o->seed,
                               .evaluations = o->evaluations,
                               .jobs = o->jobs,
                               .test = o->test,
                               .files = !o->no_files,
                               .out = o->out,
                               .name = opened->name,
                               .trace = o->trace};
    listener l = {a, ves_progress_create(stderr, o->progress)};
    ves_run_hooks hooks = {heading, show, stopped, &l};
    app_interrupt_listen();
    if (o->progress != VES_PROGRESS_NONE) app_patience_begin();
    ves_status status = ves_run_create(opened->problem, &options, &hooks, run, a->diag);
    app_patience_end();
    ves_progress_destroy(l.bar);
    app_say(a);
    return status;
}

int app_run(app *a)
{
    ves_opened opened;
    ves_run *run;
    int code;
    if (ves_folder_is(a->operand[0]))
        return app_fail(
            a, VES_USAGE,
            "\"%s\" is a folder: vesica run needs a problem file; to go on from a run use --start",
            a->operand[0]);
    if (!app_open(a, &opened, &code)) return code;
    ves_status status = work(a, &opened, &run);
    code = app_code(status);
    if (run) {
        if (a->options.json)
            json_print(run);
        else
            app_screen_run(run, stdout);
        code = verdict(run, status);
        ves_run_destroy(run);
    }
    ves_study_close(&opened);
    return code;
}

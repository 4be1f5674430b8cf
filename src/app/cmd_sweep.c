/* vesica sweep */
#include <string.h>
#include <unistd.h>

#include "app/screen_sweep.h"
#include "study/folder.h"
#include "study/sweep_folder.h"

enum { IN_LOG = 10 }; /* s */

typedef struct listener {
    app *a;
    double spoken;       /* s */
    bool terminal, open; /* open: a line that is to be written over */
} listener;

static void begun(void *data, const ves_sweep *sweep)
{
    listener *l = data;
    char text[64];
    app_say(l->a);
    app_screen_sweep_head(sweep, stderr);
    if (sweep->before)
        fprintf(stderr, "  %s there already\n",
                app_screen_plural(sweep->before, "point is", "points are", text));
    l->spoken = ves_study_clock();
}

/* On a terminal one line that changes, else a line from time to time. */
static void progress(void *data, const ves_sweep *sweep, int point)
{
    listener *l = data;
    const ves_sweep_walk *walk = &sweep->walk[point / sweep->count];
    double now = ves_study_clock();
    char place[VES_QUANTITY];
    if (l->a->options.progress == VES_PROGRESS_NONE || now - l->spoken < (l->terminal ? 0.1 : IN_LOG)) return;
    l->spoken = now;
    ves_sweep_text(sweep, 0, ves_sweep_place(sweep, point), place);
    fprintf(stderr, "%s  %d of %d points, at %s%s%s%s", l->terminal ? "\r" : "", sweep->done,
            sweep->walks * sweep->count, place, *walk->name ? ", " : "", walk->name,
            l->terminal ? "\033[K" : "\n");
    l->open = l->terminal;
}

static bool stopped(void *data)
{
    (void)data;
    return app_interrupt_asked();
}

static void json_print(const ves_sweep *sweep, bool interrupted)
{
    ves_json json = {.out = stdout};
    ves_json_object(&json, NULL);
    ves_sweep_json(sweep, &json);
    ves_json_number(&json, "wall_s", sweep->wall);
    ves_json_flag(&json, "interrupted", interrupted);
    ves_json_end(&json, '}');
}

/* Has every place a best? */
static bool complete(const ves_sweep *sweep)
{
    const int seconds = sweep->def->axes > 1 ? sweep->def->axis[1].count : 1;
    int bests = 0;
    for (int k = 0; k < sweep->walks * sweep->count; k++) bests += sweep->point[k].best;
    return bests == sweep->count * seconds;
}

static int tell(app *a, const ves_sweep *sweep, ves_status status)
{
    if (a->options.json)
        json_print(sweep, status == VES_INTERRUPTED);
    else
        app_screen_sweep(sweep, stdout);
    if (status == VES_INTERRUPTED)
        fprintf(stderr, "to go on: %s sweep --resume %s\n", app_called(), sweep->folder);
    if (status != VES_OK) return app_code(status);
    return complete(sweep) ? APP_DONE : APP_UNMET;
}

static int walk(app *a, const ves_opened *opened, const ves_sweep_options *options)
{
    listener l = {.a = a, .terminal = a->options.progress == VES_PROGRESS_AUTO && isatty(STDERR_FILENO)};
    const ves_sweep_hooks hooks = {.begun = begun, .progress = progress, .stopped = stopped, .data = &l};
    ves_sweep *sweep = NULL;
    app_interrupt_listen();
    ves_status status = ves_sweep_run(opened->problem, options, &hooks, &sweep, a->diag);
    if (l.open) fputs("\r\033[K", stderr);
    app_say(a);
    int code = sweep ? tell(a, sweep, status) : app_code(status);
    ves_sweep_destroy(sweep);
    return code;
}

static int resume(app *a)
{
    const app_options *o = &a->options;
    ves_sweep_about about;
    ves_opened opened;
    if (a->operands || o->decides)
        return app_fail(
            a, VES_USAGE,
            "--resume takes from the folder \"%s\" how the sweep was begun: %s%s cannot be given with it",
            o->resume, a->operands ? "" : "--", a->operands ? a->operand[0] : o->decides);
    ves_status status = ves_sweep_about_read(o->resume, &a->arena, &about, a->diag);
    const ves_saved saved = {.folder = o->resume, .plugins = about.plugins, .plugin = about.plugin};
    if (status == VES_OK) status = app_plugins_again(a, &saved);
    if (status == VES_OK) status = ves_sweep_about_open(o->resume, &about, a->measure, &opened, a->diag);
    app_say(a);
    if (status != VES_OK) return app_code(status);
    const ves_sweep_options options = {.jobs = o->jobs,
                                       .out = o->resume,
                                       .seeded = about.seeded,
                                       .seed = about.seed,
                                       .resume = true,
                                       .plugin = a->measure,
                                       .team = a->team};
    int code = walk(a, &opened, &options);
    ves_study_close(&opened);
    return code;
}

/* --over is --set sweep.over={...}. */
static bool over_set(app *a)
{
    app_options *o = &a->options;
    if (!o->over) return true;
    const char *value = ves_arena_format(&a->arena, "{%s}", o->over);
    if (!value || o->sets == APP_SETS) {
        app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
        return false;
    }
    o->set[o->sets++] = (ves_override){"sweep.over", value};
    return true;
}

static int sweep_one(app *a)
{
    const app_options *o = &a->options;
    ves_opened opened;
    int code;
    if (o->resume) return resume(a);
    if (!a->operands)
        return app_fail(a, VES_USAGE,
                        "something is missing: vesica sweep FILE, or vesica sweep --resume DIR");
    if (ves_folder_is(a->operand[0]))
        return app_fail(
            a, VES_USAGE,
            "\"%s\" is a folder: vesica sweep needs a problem file; --resume goes on with a sweep that "
            "was interrupted, --start begins at the best design of a run",
            a->operand[0]);
    if (!over_set(a)) return APP_MISSING;
    if (!app_open(a, &opened, &code)) return code;
    const ves_sweep_options options = {.jobs = o->jobs,
                                       .out = o->out,
                                       .seeded = o->seeded,
                                       .seed = o->seed,
                                       .plugin = a->measure,
                                       .team = a->team};
    code = walk(a, &opened, &options);
    ves_study_close(&opened);
    return code;
}

int app_sweep(app *a)
{
    return app_together(a, sweep_one);
}

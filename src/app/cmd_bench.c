/* vesica bench */
#include <string.h>

#include "app/screen_bench.h"
#include "problem/suite.h"
#include "study/bench_json.h"

typedef struct listener {
    app *a;
    double spoken; /* s */
} listener;

static void begun(void *data, const ves_bench *bench)
{
    listener *l = data;
    const ves_suite *s = bench->suite;
    char p[64], m[64], r[64];
    app_say(l->a);
    fprintf(stderr, "%s  %s\n  %s, %s, %s of each, %d %s\n", s->name, s->title,
            app_screen_plural(s->problems, "problem", "problems", p),
            app_screen_plural(s->methods, "method", "methods", m),
            app_screen_plural(s->seeds, "run", "runs", r), bench->jobs, bench->jobs == 1 ? "job" : "jobs");
    if (bench->before) fprintf(stderr, "  %d of %d runs are there already\n", bench->before, bench->runs);
    l->spoken = ves_study_clock();
}

static void progress(void *data, const ves_bench *bench, int index)
{
    listener *l = data;
    double now = ves_study_clock(), every = 10;
    (void)index;
    if (l->a->options.progress == VES_PROGRESS_NONE || now - l->spoken < every) return;
    l->spoken = now;
    ves_suite_place place = ves_suite_run(bench->suite, index);
    fprintf(stderr, "  %d of %d runs, at %s on %s\n", bench->done, bench->runs,
            bench->suite->method[place.method].name, bench->suite->problem[place.problem].name);
}

static bool stopped(void *data)
{
    (void)data;
    return app_interrupt_asked();
}

static ves_status load(void *data, const char *path, const char *name, const ves_objective **objective)
{
    return app_objective_load(((listener *)data)->a, path, name, objective);
}

/* --add NAME={...} is --set methods.NAME={...}. */
static bool added(app *a, ves_override *add)
{
    const char *text = a->options.add, *equals = text ? strchr(text, '=') : NULL;
    if (!text) return false;
    if (!equals || equals == text) {
        app_fail(a, VES_USAGE, "--add needs NAME={...} as under `methods`, got \"%s\"", text);
        return false;
    }
    add->name = ves_arena_format(&a->arena, "methods.%.*s", (int)(equals - text), text);
    add->value = equals + 1;
    if (!add->name) app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    return add->name;
}

static ves_status resume(app *a, const ves_bench_options *options, const ves_bench_hooks *hooks,
                         ves_bench **bench)
{
    const app_options *o = &a->options;
    ves_override add;
    if (a->operands || o->sets || o->out || o->no_files) {
        app_fail(a, VES_USAGE,
                 "--resume goes on with the suite of its folder: no file, --set, --out or --no-files");
        return VES_USAGE;
    }
    bool more = added(a, &add);
    if (o->add && !more) return VES_USAGE;
    const ves_read_options read = {.overrides = more, .override = &add};
    return ves_bench_resume(o->resume, &read, options, hooks, bench, a->diag);
}

static ves_status begin(app *a, const ves_bench_options *options, const ves_bench_hooks *hooks,
                        ves_bench **bench)
{
    const app_options *o = &a->options;
    ves_suite *suite = NULL;
    if (!a->operands || o->add) {
        app_fail(a, VES_USAGE,
                 o->add ? "--add goes with --resume" : "vesica bench needs a suite file, or --resume DIR");
        return VES_USAGE;
    }
    const ves_read_options read = {.overrides = o->sets, .override = o->set};
    VES_TRY(ves_suite_read(a->operand[0], &read, &suite, a->diag));
    return ves_bench_run(suite, options, hooks, bench, a->diag);
}

static void json_print(const ves_bench *bench)
{
    ves_json json = {.out = stdout};
    ves_json_object(&json, NULL);
    ves_bench_json(bench, true, &json);
    ves_json_end(&json, '}');
}

static int bench_one(app *a)
{
    const app_options *o = &a->options;
    listener l = {.a = a};
    const ves_bench_hooks hooks = {
        .begun = begun, .progress = progress, .stopped = stopped, .load = load, .data = &l};
    const ves_bench_options options = {
        .jobs = o->jobs, .out = o->out, .no_files = o->no_files, .team = a->team};
    ves_bench *bench = NULL;
    app_interrupt_listen();
    ves_status status = (o->resume ? resume : begin)(a, &options, &hooks, &bench);
    app_say(a);
    a->torn = status == VES_MEMORY || status == VES_FAULT;
    if (bench && o->json)
        json_print(bench);
    else if (bench)
        app_screen_bench(bench, stdout);
    if (bench && bench->folder && bench->done < bench->runs)
        fprintf(stderr, "to go on: %s bench --resume %s\n", app_called(), bench->folder);
    ves_bench_destroy(bench);
    return status == VES_INTERRUPTED ? APP_INTERRUPTED : app_code(status);
}

int app_bench(app *a)
{
    return app_together(a, bench_one);
}

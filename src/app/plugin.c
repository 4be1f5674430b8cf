/* Plugins: measures from shared objects. */
#include <dlfcn.h>
#include <math.h>
#include <stddef.h>
#include <string.h>

#include "app/app.h"
#include "measure/registry.h"

static int listed(const ves_plugin *plugin)
{
    int count = 0;
    while (plugin->measure && plugin->measure[count]) count++;
    return count;
}

/* dlopen looks for a bare name in the system's folders; people mean a file here. */
static const char *as_file(app *a, const char *path)
{
    return strchr(path, '/') ? path : ves_arena_format(&a->arena, "./%s", path);
}

/* The members that the first version of the interface had: no plugin was built with fewer. */
static const size_t FIRST = offsetof(ves_measure, gradient) + sizeof((ves_measure *)NULL)->gradient;

static const ves_plugin OURS = {VES_PLUGIN, "", NULL};

static ves_status check(app *a, const char *path, const ves_plugin *plugin)
{
    if (plugin->abi != OURS.abi) {
        app_fail(a, VES_ABSENT,
                 "the plugin \"%s\" was built for interface %d; this is vesica %s with interface %d: build "
                 "it again",
                 path, plugin->abi, VESICA_VERSION, OURS.abi);
        return VES_ABSENT;
    }
    if (plugin->size > OURS.size || plugin->given > OURS.given) {
        app_fail(
            a, VES_ABSENT,
            "the plugin \"%s\" was built for a newer vesica (its measures have %zu bytes and are given %zu, "
            "those of vesica %s %zu and %zu): build it again with the headers of this one",
            path, plugin->size, plugin->given, VESICA_VERSION, OURS.size, OURS.given);
        return VES_ABSENT;
    }
    bool sized = plugin->size >= FIRST && plugin->given > 0;
    if (sized && plugin->name && plugin->measure) return VES_OK;
    app_fail(a, VES_USAGE,
             sized ? "the plugin \"%s\" lacks its name or its list of measures"
                   : "the plugin \"%s\" does not say which vesica it was built with: ves_plugin_entry = "
                     "{VES_PLUGIN, name, measures}",
             path);
    return VES_USAGE;
}

/* NULL: the reason is in diag. */
static void *load(app *a, const char *path)
{
    const char *file = as_file(a, path);
    void *handle = NULL;
    if (a->shared < APP_PLUGINS) handle = file ? dlopen(file, RTLD_NOW | RTLD_LOCAL) : NULL;
    if (!handle) {
        const char *why = a->shared < APP_PLUGINS ? dlerror() : "too many plugins";
        app_fail(a, VES_USAGE, "cannot load the plugin \"%s\": %s", path, why ? why : "out of memory");
        return NULL;
    }
    a->handle[a->shared++] = handle;
    return handle;
}

static ves_status open_one(app *a, const char *path, const ves_plugin **plugin)
{
    void *handle = load(a, path);
    if (!handle) return VES_USAGE;
    *plugin = dlsym(handle, "ves_plugin_entry");
    if (!*plugin) {
        app_fail(a, VES_USAGE, "\"%s\" is no plugin of vesica: it has no ves_plugin_entry", path);
        return VES_USAGE;
    }
    return check(a, path, *plugin);
}

/* A descriptor as this program knows it: members that the plugin was built without are 0. */
static const ves_measure *copy(app *a, const ves_plugin *plugin, const ves_measure *measure)
{
    ves_measure *m = ves_arena_take(&a->arena, 1, sizeof *m);
    if (!m) {
        app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
        return NULL;
    }
    memcpy(m, measure, plugin->size);
    return m;
}

static ves_status add(app *a, const char *path, const ves_plugin *plugin, int *count)
{
    for (int k = 0; k < listed(plugin); k++) {
        const ves_measure *m = copy(a, plugin, plugin->measure[k]);
        if (!m) return VES_MEMORY;
        ves_status status = ves_measure_check(m, a->diag);
        if (status != VES_OK) {
            ves_diag_add(a->diag, VES_NOTE, status, (ves_mark){0}, "it is in the plugin \"%s\"", path);
            return status;
        }
        if (ves_measure_find(m->name, a->measure)) {
            app_fail(a, VES_USAGE,
                     "the plugin \"%s\" brings a measure \"%s\", but there is one of that name already", path,
                     m->name);
            return VES_USAGE;
        }
        a->measure[(*count)++] = m;
    }
    return VES_OK;
}

ves_status app_plugins_load(app *a)
{
    const ves_plugin *plugin[APP_PLUGINS];
    int total = 0, count = 0;
    for (int k = 0; k < a->options.plugins; k++) {
        VES_TRY(open_one(a, a->options.plugin[k], &plugin[k]));
        total += listed(plugin[k]);
    }
    if (!a->options.plugins) return VES_OK;
    a->measure = ves_arena_take(&a->arena, (size_t)total + 1, sizeof *a->measure);
    if (!a->measure) {
        app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
        return VES_MEMORY;
    }
    for (int k = 0; k < a->options.plugins; k++) VES_TRY(add(a, a->options.plugin[k], plugin[k], &count));
    return VES_OK;
}

/* --- objectives, for bench --- */

static ves_status check_objectives(app *a, const char *path, const ves_objectives *o)
{
    if (o->abi == VES_OBJECTIVE_ABI && o->size == sizeof(ves_objective) && o->name && o->objective &&
        *o->objective)
        return VES_OK;
    app_fail(
        a, VES_ABSENT,
        "the plugin \"%s\" was built for interface %d of objectives, %zu bytes each; this is vesica %s with "
        "interface %d, %zu bytes: build it again with the headers of this one",
        path, o->abi, o->size, VESICA_VERSION, VES_OBJECTIVE_ABI, sizeof(ves_objective));
    return VES_ABSENT;
}

static ves_status check_objective(app *a, const char *path, const ves_objective *o)
{
    bool good =
        o->name && o->n >= 1 && o->m >= 0 && o->lower && o->upper && o->eval && !o->create == !o->destroy;
    for (int i = 0; good && i < o->n; i++)
        good = isfinite(o->lower[i]) && isfinite(o->upper[i]) && o->lower[i] < o->upper[i];
    if (good) return VES_OK;
    app_fail(a, VES_USAGE,
             "the objective \"%s\" of the plugin \"%s\" is not whole: it needs variables between finite "
             "bounds, lower "
             "< upper, an eval, and create and destroy or neither",
             o->name ? o->name : "", path);
    return VES_USAGE;
}

ves_status app_objective_load(app *a, const char *path, const char *name, const ves_objective **objective)
{
    void *handle = load(a, path);
    if (!handle) return VES_USAGE;
    const ves_objectives *all = dlsym(handle, "ves_objectives_entry");
    if (!all) {
        app_fail(a, VES_USAGE, "\"%s\" brings no objectives: it has no ves_objectives_entry", path);
        return VES_USAGE;
    }
    VES_TRY(check_objectives(a, path, all));
    for (const ves_objective *const *o = all->objective; *o; o++)
        if (!name || ((*o)->name && !strcmp((*o)->name, name))) {
            *objective = *o;
            return check_objective(a, path, *o);
        }
    app_fail(a, VES_NAME, "the plugin \"%s\" brings no objective \"%s\"; its first is \"%s\"", path, name,
             all->objective[0]->name ? all->objective[0]->name : "");
    return VES_NAME;
}

void app_plugins_close(app *a)
{
    while (a->shared > 0) dlclose(a->handle[--a->shared]);
}

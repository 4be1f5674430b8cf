#include "study/saved.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "base/diag.h"
#include "base/text.h"
#include "output/file.h"
#include "study/folder.h"
#include "study/load.h"

static const char TRACES[] = "short|all|accepted|none";
static const ves_mark NOWHERE = {0};

/* --- writing --- */

ves_status ves_saved_plugins_write(const ves_problem *problem, ves_arena *arena, ves_json *json)
{
    ves_status status = VES_OK;
    ves_json_array(json, "plugins");
    for (const char *const *file = problem->plugin_file; file && *file; file++) {
        const char *path = ves_study_absolute(*file, arena);
        if (!path) status = VES_MEMORY;
        ves_json_object(json, NULL);
        ves_json_text(json, "given", *file);
        ves_json_text(json, "path", path);
        ves_json_count(json, "crc", ves_study_sum(*file));
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
    return status;
}

static ves_status options_write(const ves_run *run, const ves_run_options *o, ves_arena *arena, FILE *out)
{
    int length;
    char trace[16];
    const char *word = ves_words_at(TRACES, (int)o->trace, &length);
    snprintf(trace, sizeof trace, "%.*s", length, word);
    ves_json json = {.out = out};
    ves_json_object(&json, NULL);
    ves_json_text(&json, "version", VESICA_VERSION);
    ves_json_text(&json, "problem", run->problem->path);
    ves_json_count(&json, "seed", run->seed);
    ves_json_integer(&json, "evaluations", o->evaluations);
    ves_json_flag(&json, "test", o->test);
    ves_json_text(&json, "trace", trace);
    ves_json_flag(&json, "journal", !o->forget);
    ves_status status = ves_saved_plugins_write(run->problem, arena, &json);
    ves_json_end(&json, '}');
    return status;
}

ves_status ves_saved_write(const ves_run *run, const ves_run_options *options, ves_arena *arena,
                           ves_diag *diag)
{
    ves_file file;
    char *path = ves_folder_path(run->folder, "run.json", arena);
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    VES_TRY(ves_file_begin(&file, path, "json", diag));
    ves_status status = options_write(run, options, arena, file.out);
    if (status != VES_OK) ves_diag_fail(diag, status);
    return ves_file_end(&file, status, diag);
}

static void head_write(const ves_run *run, const ves_run_options *o, ves_json *json)
{
    static const char *const relation[] = {"<=", ">=", "=="};
    const ves_problem *p = run->problem;
    ves_json_object(json, NULL);
    ves_json_text(json, "vesica", VESICA_VERSION);
    ves_json_count(json, "problem", crc32_z(0, (const unsigned char *)p->text, strlen(p->text)));
    ves_json_count(json, "seed", run->seed);
    ves_json_integer(json, "evaluations", o->evaluations);
    ves_json_flag(json, "test", o->test);
    ves_json_flag(json, "maximize", p->maximize);
    ves_json_array(json, "variables");
    for (int k = 0; k < p->variables; k++) ves_json_text(json, NULL, p->variable[k].name);
    ves_json_end(json, ']');
    ves_json_array(json, "constraints");
    for (int k = 0; k < p->constraints; k++) {
        const ves_constraint_def *c = &p->constraint[k];
        ves_json_object(json, NULL);
        ves_json_text(json, "text", c->text);
        ves_json_text(json, "relation", relation[c->relation]);
        ves_json_number(json, "within", c->within);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
    ves_json_end(json, '}');
}

/* More than head_write can need: each byte of a name may be written as six. */
static size_t head_room(const ves_problem *p)
{
    size_t room = 512;
    for (int k = 0; k < p->variables; k++) room += 6 * strlen(p->variable[k].name) + 4;
    for (int k = 0; k < p->constraints; k++) room += 6 * strlen(p->constraint[k].text) + 128;
    return room;
}

char *ves_saved_head(const ves_run *run, const ves_run_options *options, ves_arena *arena)
{
    size_t room = head_room(run->problem);
    char *text = ves_arena_take(arena, room + 1, 1);
    FILE *out = text ? fmemopen(text, room, "w") : NULL;
    if (!out) return NULL;
    ves_json json = {.out = out, .line = true};
    head_write(run, options, &json);
    bool whole = !ferror(out);
    return fclose(out) == 0 && whole ? text : NULL;
}

/* --- reading --- */

ves_status ves_saved_plugins_read(const ves_node *list, ves_arena *arena, const ves_saved_plugin **out,
                                  int *count)
{
    *count = 0;
    if (!list || list->kind != VES_NODE_LIST || !list->count) return VES_OK;
    ves_saved_plugin *plugin = ves_arena_take(arena, (size_t)list->count, sizeof *plugin);
    if (!plugin) return VES_MEMORY;
    for (int k = 0; k < list->count; k++) {
        plugin[k].given = ves_json_word(list->item[k], "given");
        plugin[k].path = ves_json_word(list->item[k], "path");
        plugin[k].sum = (unsigned long)ves_json_double(list->item[k], "crc", 0);
        if (!plugin[k].given || !plugin[k].path) return VES_SYNTAX;
    }
    *out = plugin;
    *count = list->count;
    return VES_OK;
}

static ves_status fill(const ves_node *root, const char *folder, ves_arena *arena, ves_saved *saved)
{
    const char *seed = ves_json_word(root, "seed"), *trace = ves_json_word(root, "trace");
    *saved = (ves_saved){.folder = folder, .problem = ves_json_word(root, "problem")};
    saved->options = (ves_run_options){.seeded = true,
                                       .seed = seed ? strtoull(seed, NULL, 10) : 0,
                                       .evaluations = (long)ves_json_double(root, "evaluations", -1),
                                       .test = ves_json_true(root, "test"),
                                       .trace = (ves_trace)(trace ? ves_words_find(TRACES, trace) : -1),
                                       .files = true,
                                       .out = folder,
                                       .resume = true,
                                       .forget = !ves_json_true(root, "journal")};
    bool whole = seed && saved->problem && saved->options.evaluations >= 0 && (int)saved->options.trace >= 0;
    return whole ? ves_saved_plugins_read(ves_node_find(root, "plugins"), arena, &saved->plugin,
                                          &saved->plugins)
                 : VES_SYNTAX;
}

ves_status ves_saved_read(const char *folder, ves_arena *arena, ves_saved *saved, ves_diag *diag)
{
    const ves_node *root = NULL;
    char *path = ves_folder_path(folder, "run.json", arena);
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    ves_status status = ves_json_load(path, arena, &root);
    const char *bench = ves_folder_path(folder, "bench.json", arena);
    if (status == VES_IO && bench && !access(bench, F_OK))
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, NOWHERE,
                            "\"%s\" is the folder of a benchmark: vesica bench --resume %s", folder, folder);
    if (status == VES_IO)
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, NOWHERE,
                            "there is no run to go on with in \"%s\": \"%s\" cannot be read: %s", folder,
                            path, errno ? strerror(errno) : "it is no file of a run");
    if (status == VES_OK) status = fill(root, folder, arena, saved);
    if (status == VES_MEMORY) return ves_diag_fail(diag, VES_MEMORY);
    if (status != VES_OK)
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, NOWHERE,
                            "\"%s\" is damaged: run \"%s/problem.yaml\" anew", path, folder);
    if (!saved->options.forget) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_USAGE, NOWHERE,
                        "the run \"%s\" keeps no journal (--journal none) to go on with: run "
                        "\"%s/problem.yaml\" anew",
                        folder, folder);
}

ves_status ves_saved_compare(const ves_saved *saved, const char *const *path, ves_diag *diag)
{
    for (int k = 0; k < saved->plugins; k++)
        if (ves_study_sum(path[k]) != saved->plugin[k].sum)
            return ves_diag_add(
                diag, VES_ERROR, VES_STALE, NOWHERE,
                "the plugin \"%s\" is not the one that the run \"%s\" was made with: give that "
                "one (--plugin FILE), or run \"%s/problem.yaml\" anew",
                path[k], saved->folder, saved->folder);
    return VES_OK;
}

static ves_status names(const ves_saved *saved, ves_arena *arena, const char *const **list)
{
    const char **given = ves_arena_take(arena, (size_t)saved->plugins + 1, sizeof *given);
    if (!given) return VES_MEMORY;
    for (int k = 0; k < saved->plugins; k++) given[k] = saved->plugin[k].given;
    *list = given;
    return VES_OK;
}

static ves_status load(const char *path, char **text, size_t *length, ves_diag *diag)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, NOWHERE, "cannot read \"%s\": %s", path,
                            strerror(errno));
    ves_status status = ves_problem_load(file, path, text, length, diag);
    fclose(file);
    return status;
}

static ves_status open_here(const ves_saved *saved, const ves_measure *const *plugin, ves_opened *opened,
                            ves_diag *diag)
{
    ves_read_options options = {.plugin = plugin};
    char *path = ves_folder_path(saved->folder, "problem.yaml", &opened->arena), *text = NULL;
    size_t length = 0;
    if (!path || (saved->plugins && names(saved, &opened->arena, &options.plugin_file) != VES_OK))
        return ves_diag_fail(diag, VES_MEMORY);
    ves_status status = load(path, &text, &length, diag);
    if (status == VES_OK)
        status = ves_problem_read_text(saved->problem, text, length, &options, &opened->problem, diag);
    ves_memory_free(text);
    return status;
}

ves_status ves_saved_open(const ves_saved *saved, const ves_measure *const *plugin, ves_opened *opened,
                          ves_diag *diag)
{
    *opened = (ves_opened){0};
    ves_status status = open_here(saved, plugin, opened, diag);
    if (status == VES_OK)
        opened->name = opened->problem->name;
    else
        ves_study_close(opened);
    return status;
}

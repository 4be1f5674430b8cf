#include "study/best.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/diag.h"
#include "study/folder.h"
#include "study/load.h"
#include "study/open.h"

static const ves_mark NOWHERE = {0};

static bool is_map(const ves_node *node)
{
    return node && node->kind == VES_NODE_MAP;
}

/* Does the folder have that file? */
static bool has(const char *folder, const char *name, ves_arena *arena)
{
    char *path = ves_folder_path(folder, name, arena);
    return path && access(path, F_OK) == 0;
}

/* --- runs --- */

/* The lines of points.jsonl are its points, from 0. */
static ves_status sweep_refuse(const char *sweep, ves_arena *arena, ves_diag *diag)
{
    char *path = ves_folder_path(sweep, "points.jsonl", arena), *text = NULL;
    size_t length;
    int count = 0;
    ves_status status = path ? ves_study_load(path, arena, &text, &length) : VES_MEMORY;
    if (status == VES_MEMORY) return ves_diag_fail(diag, status);
    for (const char *at = text; status == VES_OK && (at = strchr(at, '\n')); at++) count++;
    if (count > 1)
        return ves_diag_add(
            diag, VES_ERROR, VES_USAGE, NOWHERE,
            "\"%s\" is a sweep: name one of its points, %s:0 to %s:%d; sweep.csv tells what each is", sweep,
            sweep, sweep, count - 1);
    return ves_diag_add(diag, VES_ERROR, VES_USAGE, NOWHERE,
                        "\"%s\" is a sweep: name its point, %s:0, if it has come so far", sweep, sweep);
}

static ves_status result_read(const char *run, ves_arena *arena, const ves_node **root, ves_diag *diag)
{
    char *path = ves_folder_path(run, "result.json", arena);
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    char *sweep = ves_folder_path(run, "sweep.json", arena);
    if (!sweep) return ves_diag_fail(diag, VES_MEMORY);
    if (access(path, F_OK) && !access(sweep, F_OK)) return sweep_refuse(run, arena, diag);
    ves_status status = ves_json_load(path, arena, root);
    if (status == VES_MEMORY) return ves_diag_fail(diag, VES_MEMORY);
    if (status == VES_IO)
        return ves_diag_add(diag, VES_ERROR, VES_IO, NOWHERE,
                            "\"%s\" is not the folder of a finished run: \"%s\" cannot be read: %s", run,
                            path, errno ? strerror(errno) : "it is no file of a run");
    if (status != VES_OK)
        return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, NOWHERE,
                            "\"%s\" is damaged or not whole: run \"%s/problem.yaml\" again", path, run);
    return VES_OK;
}

ves_status ves_best_read(const char *run, ves_arena *arena, ves_best *best, ves_diag *diag)
{
    const ves_node *root = NULL;
    *best = (ves_best){.run = run};
    VES_TRY(result_read(run, arena, &root, diag));
    best->variables = ves_node_find(root, "variables");
    best->plugins = ves_node_find(root, "plugins");
    if (is_map(best->variables)) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, NOWHERE, "\"%s/result.json\" holds no variables", run);
}

static ves_status optimum_read(const char *run, long k, ves_arena *arena, ves_best *best, ves_diag *diag)
{
    const ves_node *root = NULL;
    VES_TRY(result_read(run, arena, &root, diag));
    const ves_node *list = ves_node_find(root, "optima");
    const int count = list && list->kind == VES_NODE_LIST ? list->count : 0;
    const ves_node *optimum = k >= 1 && k <= count ? list->item[k - 1] : NULL;
    best->variables = is_map(optimum) ? ves_node_find(optimum, "variables") : NULL;
    best->plugins = ves_node_find(root, "plugins");
    if (is_map(best->variables)) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_RANGE, NOWHERE,
                        "the run \"%s\" has no optimum %ld: it has found %d", run, k, count);
}

/* --- sweeps --- */

/* The line of a point; NULL: there is none. */
static const ves_node *line_find(const char *text, long point, ves_arena *arena)
{
    for (const char *at = text; *at; at += strcspn(at, "\n"), at += *at == '\n') {
        static const char head[] = "{\"point\":";
        if (strncmp(at, head, sizeof head - 1) || strtol(at + sizeof head - 1, NULL, 10) != point) continue;
        return ves_study_json(at, strcspn(at, "\n"), arena);
    }
    return NULL;
}

static ves_status point_read(const char *sweep, long point, ves_arena *arena, ves_best *best, ves_diag *diag)
{
    char *path = ves_folder_path(sweep, "points.jsonl", arena), *text = NULL;
    size_t length = 0;
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    errno = 0;
    ves_status status = ves_study_load(path, arena, &text, &length);
    if (status == VES_MEMORY) return ves_diag_fail(diag, VES_MEMORY);
    if (status != VES_OK)
        return ves_diag_add(diag, VES_ERROR, VES_IO, NOWHERE, "cannot read \"%s\": %s", path,
                            errno ? strerror(errno) : "it is no file of a sweep");
    const ves_node *line = line_find(text, point, arena);
    const char *word = line ? ves_json_word(line, "status") : NULL;
    best->variables = word && !strcmp(word, "ok") ? ves_node_find(line, "variables") : NULL;
    best->branch = line ? ves_json_word(line, "branch") : NULL;
    best->parameters = line ? ves_node_find(line, "parameters") : NULL;
    if (is_map(best->variables)) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_RANGE, NOWHERE,
                        word ? "point %ld of the sweep \"%s\" is lost: it is no start"
                             : "there is no point %ld in the sweep \"%s\": sweep.csv numbers them",
                        point, sweep);
}

/* --- what --start names --- */

bool ves_best_split(const char *start, ves_arena *arena, char **folder, long *number)
{
    const char *colon = strrchr(start, ':');
    size_t digits = colon ? strspn(colon + 1, "0123456789") : 0;
    if (!digits || digits > 9 || colon[1 + digits] || ves_folder_is(start)) return false;
    *folder = ves_arena_text(arena, start, (size_t)(colon - start));
    *number = strtol(colon + 1, NULL, 10);
    return *folder;
}

ves_status ves_best_find(const char *start, ves_arena *arena, ves_best *best, ves_diag *diag)
{
    char *folder = NULL;
    long number = 0;
    *best = (ves_best){.run = start};
    if (!ves_best_split(start, arena, &folder, &number)) {
        if (!has(start, "sweep.json", arena)) return ves_best_read(start, arena, best, diag);
        return ves_diag_add(
            diag, VES_ERROR, VES_USAGE, NOWHERE,
            "\"%s\" is a sweep: say which of its points, --start %s:N, as sweep.csv numbers them", start,
            start);
    }
    if (has(folder, "sweep.json", arena)) return point_read(folder, number, arena, best, diag);
    return optimum_read(folder, number, arena, best, diag);
}

#include "study/open.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/diag.h"
#include "base/text.h"
#include "problem/tree.h"
#include "study/best.h"
#include "study/folder.h"

enum { LIMIT = 64 * 1024 * 1024, NUMBER = 96 };

/* Where a problem is read from, more than once: stdin cannot be. */
typedef struct source {
    const char *path;
    char *text; /* of stdin; NULL: path is a file */
    size_t length;
} source;

static const ves_mark NOWHERE = {0};

/* --- result.json --- */

static ves_status file_length(FILE *file, size_t *length)
{
    if (fseek(file, 0, SEEK_END)) return VES_IO;
    long end = ftell(file);
    if (fseek(file, 0, SEEK_SET)) return VES_IO; /* rewind would forget errno */
    *length = (size_t)end;
    return end >= 0 && end <= LIMIT ? VES_OK : VES_IO;
}

ves_status ves_study_load(const char *path, ves_arena *arena, char **text, size_t *length)
{
    FILE *file = fopen(path, "rb");
    if (!file) return VES_IO;
    ves_status status = file_length(file, length);
    if (status == VES_OK) {
        *text = ves_arena_take(arena, *length + 1, 1);
        if (!*text) status = VES_MEMORY;
    }
    if (status == VES_OK && fread(*text, 1, *length, file) != *length) status = VES_IO;
    fclose(file);
    return status;
}

const ves_node *ves_study_json(const char *text, size_t length, ves_arena *arena)
{
    ves_script *script = ves_arena_take(arena, 1, sizeof *script);
    const ves_node *root = NULL;
    if (!script || ves_script_init(script, text, length, arena) != VES_OK) return NULL;
    bool read = ves_tree_read(script, arena, &root, NULL) == VES_OK;
    return read && root && root->kind == VES_NODE_MAP ? root : NULL;
}

/* --- the numbers of a run as overrides --- */

const char *ves_study_quantity(const char *number, ves_dim dim, const ves_shown *shown, ves_arena *arena)
{
    char unit[48];
    ves_dim_text(dim, unit);
    if (!strcmp(shown->unit, "deg")) return ves_arena_format(arena, "%s rad", number);
    if (!strcmp(shown->unit, "%")) return ves_arena_format(arena, "(%s)", number); /* a formula needs none */
    if (dim.any || !strcmp(unit, "1")) return number;
    if (*unit != '1' && !strchr(unit, ' ')) return ves_arena_format(arena, "%s %s", number, unit);
    /* 1/m and kg m^2/s^2 can be read by people only; powers come in sixths */
    return ves_arena_format(arena, "%s*(1 kg)^(%d/6)*(1 m)^(%d/6)*(1 s)^(%d/6)", number, dim.kg, dim.m,
                            dim.s);
}

ves_status ves_study_starts(const ves_problem *problem, const double *x, ves_arena *arena, ves_override *set)
{
    for (int k = 0; k < problem->variables; k++) {
        const ves_variable *v = &problem->variable[k];
        char digits[32];
        ves_text_shortest(fmin(fmax(x[k], v->min), v->max), digits);
        const char *number = ves_arena_text(arena, digits, strlen(digits));
        set[k] =
            (ves_override){v->name, number ? ves_study_quantity(number, v->dim, &v->shown, arena) : NULL};
        if (!set[k].value) return VES_MEMORY;
    }
    return VES_OK;
}

static bool is_number(const ves_node *node)
{
    double value;
    return node->kind == VES_NODE_WORD && ves_text_number(node->text, &value);
}

/* The names that the run has not. */
static char *missing(const ves_best *b, const ves_problem *problem, ves_arena *arena, int *count)
{
    char *list = ves_arena_text(arena, "", 0);
    *count = 0;
    for (int k = 0; list && k < problem->variables; k++) {
        const char *name = problem->variable[k].name;
        if (ves_node_find(b->variables, name)) continue;
        list = ves_arena_format(arena, "%s%s\"%s\"", list, *list ? ", " : "", name);
        ++*count;
    }
    return list;
}

/* A start from another problem may leave some variables at the start of the file, but not all. */
static ves_status missing_tell(const ves_best *b, const ves_problem *problem, ves_arena *arena,
                               ves_diag *diag)
{
    int count;
    const char *list = missing(b, problem, arena, &count);
    if (!list) return ves_diag_fail(diag, VES_MEMORY);
    if (!count) return VES_OK;
    if (b->other && count < problem->variables) {
        ves_diag_add(diag, VES_NOTE, VES_OK, NOWHERE,
                     "the run \"%s\" has no variable %s: %s at the start that the file gives", b->run, list,
                     count == 1 ? "it stands" : "they stand");
        return VES_OK;
    }
    return ves_diag_add(diag, VES_ERROR, VES_NAME, NOWHERE,
                        b->other ? "the run \"%s\" has none of the variables of the problem: %s"
                                 : "the run \"%s\" has no variable %s, but its problem has",
                        b->run, list);
}

/* What a point of a sweep is asked with: its branch's settings, then its parameters. */
static ves_status point_apply(const ves_best *b, const ves_problem *problem, ves_arena *arena,
                              ves_override *override, int *count, ves_diag *diag)
{
    const ves_sweep_def *sweep = problem->sweep;
    for (int k = 0; b->branch && sweep && k < sweep->branches; k++)
        for (int j = 0; !strcmp(sweep->branch[k].name, b->branch) && j < sweep->branch[k].sets; j++)
            override[(*count)++] = sweep->branch[k].set[j];
    for (int k = 0; b->parameters && k < problem->parameters; k++) {
        const ves_parameter *p = &problem->parameter[k];
        const ves_node *number = ves_node_find(b->parameters, p->name);
        if (!number || !is_number(number)) continue;
        ves_override *o = &override[(*count)++];
        *o = (ves_override){p->name,
                            ves_study_quantity(number->text, ves_formula_dim(p->formula), &p->shown, arena)};
        if (!o->value) return ves_diag_fail(diag, VES_MEMORY);
    }
    return VES_OK;
}

static int overrides_most(const ves_problem *problem)
{
    int sets = 0;
    for (int k = 0; problem->sweep && k < problem->sweep->branches; k++)
        sets += problem->sweep->branch[k].sets;
    return sets + problem->parameters + problem->variables;
}

/* Appends one override for each variable of the problem that the run has. */
static ves_status best_apply(const ves_best *b, const ves_problem *problem, ves_arena *arena,
                             ves_override *override, int *count, ves_diag *diag)
{
    *count = 0;
    VES_TRY(point_apply(b, problem, arena, override, count, diag));
    VES_TRY(missing_tell(b, problem, arena, diag));
    for (int k = 0; k < problem->variables; k++) {
        const ves_variable *v = &problem->variable[k];
        const ves_node *number = ves_node_find(b->variables, v->name);
        if (!number) continue;
        if (!is_number(number))
            return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, NOWHERE,
                                "the run \"%s\" has no number for \"%s\"", b->run, v->name);
        ves_override *o = &override[(*count)++];
        *o = (ves_override){v->name, ves_study_quantity(number->text, v->dim, &v->shown, arena)};
        if (!o->value) return ves_diag_fail(diag, VES_MEMORY);
    }
    return VES_OK;
}

static ves_status read(const source *from, const ves_read_options *options, ves_problem **problem,
                       ves_diag *diag)
{
    if (!from->text) return ves_problem_read(from->path, options, problem, diag);
    return ves_problem_read_text(from->path, from->text, from->length, options, problem, diag);
}

/* Reads the problem twice: first to learn its variables and their dimensions. */
static ves_status read_at(const source *from, const ves_best *b, const ves_read_options *options,
                          ves_opened *opened, ves_diag *diag)
{
    ves_arena *arena = &opened->arena;
    ves_problem *first = NULL;
    ves_diag *quiet = ves_diag_create();
    if (!quiet) return ves_diag_fail(diag, VES_MEMORY);
    ves_status status = read(from, options, &first, quiet);
    ves_diag_destroy(quiet);
    if (status != VES_OK) return read(from, options, &opened->problem, diag);
    int count = 0;
    ves_override *all =
        ves_arena_take(arena, (size_t)(overrides_most(first) + options->overrides), sizeof *all);
    status = all ? best_apply(b, first, arena, all, &count, diag) : ves_diag_fail(diag, VES_MEMORY);
    if (status == VES_OK) {
        ves_read_options whole = *options;
        for (int k = 0; k < options->overrides; k++) all[count + k] = options->override[k];
        whole.overrides = count + options->overrides;
        whole.override = all;
        status = read(from, &whole, &opened->problem, diag);
    }
    ves_problem_destroy(first);
    return status;
}

/* --- opening --- */

/* The last part of a path, without slashes at its end. */
static const char *last_part(const char *path, ves_arena *arena)
{
    size_t end = strlen(path);
    while (end > 1 && path[end - 1] == '/') end--;
    size_t begin = end;
    while (begin > 0 && path[begin - 1] != '/') begin--;
    return ves_arena_text(arena, path + begin, end - begin);
}

/* What cannot be read may only lack the measures that the run was made with. */
static void plugins_tell(const ves_best *b, const char *folder, ves_arena *arena, ves_diag *diag)
{
    char *list = ves_arena_text(arena, "", 0);
    if (!b->plugins || b->plugins->kind != VES_NODE_LIST) return;
    for (int k = 0; list && k < b->plugins->count; k++)
        if (b->plugins->item[k]->kind == VES_NODE_WORD)
            list = ves_arena_format(arena, "%s --plugin %s", list, b->plugins->item[k]->text);
    if (list && *list)
        ves_diag_add(diag, VES_NOTE, VES_OK, NOWHERE,
                     "the run \"%s\" was made with measures of a plugin, which it needs again:%s", folder,
                     list);
}

/* A file without a title is called as its run, not as the copy in the folder. */
static ves_status name_run(ves_opened *opened, ves_diag *diag)
{
    ves_problem *p = opened->problem;
    if (p->title != p->name) return VES_OK;
    p->title = ves_arena_text(&p->arena, opened->name, strlen(opened->name));
    return p->title ? VES_OK : ves_diag_fail(diag, VES_MEMORY);
}

/* FOLDER:NUMBER: an optimum of a run, a point of a sweep, in its problem. */
static ves_status open_part(const char *path, const char *folder, const ves_open_options *options,
                            ves_opened *opened, ves_diag *diag)
{
    ves_best own = {0};
    const source from = {.path = ves_folder_path(folder, "problem.yaml", &opened->arena)};
    opened->name = last_part(folder, &opened->arena);
    if (!from.path || !opened->name) return ves_diag_fail(diag, VES_MEMORY);
    VES_TRY(ves_best_find(path, &opened->arena, &own, diag));
    ves_status status = read_at(&from, &own, &options->read, opened, diag);
    if (status == VES_NAME) plugins_tell(&own, folder, &opened->arena, diag);
    return status == VES_OK ? name_run(opened, diag) : status;
}

static ves_status open_run(const char *path, const ves_open_options *options, ves_opened *opened,
                           ves_diag *diag)
{
    ves_best own = {0}, other = {0};
    const source from = {.path = ves_folder_path(path, "problem.yaml", &opened->arena)};
    opened->name = last_part(path, &opened->arena);
    if (!from.path || !opened->name) return ves_diag_fail(diag, VES_MEMORY);
    ves_status status = ves_best_read(path, &opened->arena, &own, options->start ? NULL : diag);
    if (options->start) status = ves_best_find(options->start, &opened->arena, &other, diag);
    if (status != VES_OK) return status;
    other.other = true;
    status = read_at(&from, options->start ? &other : &own, &options->read, opened, diag);
    if (status == VES_NAME) plugins_tell(&own, path, &opened->arena, diag);
    return status == VES_OK ? name_run(opened, diag) : status;
}

static ves_status open_source(const source *from, const ves_open_options *options, ves_opened *opened,
                              ves_diag *diag)
{
    ves_best b;
    if (options->start) {
        VES_TRY(ves_best_find(options->start, &opened->arena, &b, diag));
        b.other = true;
        VES_TRY(read_at(from, &b, &options->read, opened, diag));
    } else {
        VES_TRY(read(from, &options->read, &opened->problem, diag));
    }
    opened->name = opened->problem->name;
    return VES_OK;
}

static ves_status open_file(const char *path, const ves_open_options *options, ves_opened *opened,
                            ves_diag *diag)
{
    source from = {.path = path};
    if (strcmp(path, "-")) return open_source(&from, options, opened, diag);
    from.path = "stdin";
    ves_status status = ves_problem_load(stdin, from.path, &from.text, &from.length, diag);
    if (status == VES_OK) status = open_source(&from, options, opened, diag);
    ves_memory_free(from.text);
    return status;
}

ves_status ves_study_open(const char *path, const ves_open_options *options, ves_opened *opened,
                          ves_diag *diag)
{
    *opened = (ves_opened){0};
    char *folder;
    long number;
    ves_status status;
    if (ves_folder_is(path))
        status = open_run(path, options, opened, diag);
    else if (!options->start && ves_best_split(path, &opened->arena, &folder, &number) &&
             ves_folder_is(folder))
        status = open_part(path, folder, options, opened, diag);
    else
        status = open_file(path, options, opened, diag);
    if (status == VES_OK) return status;
    ves_study_close(opened);
    return ves_diag_errors(diag)
               ? status
               : ves_diag_fail(diag, VES_MEMORY); /* who has no memory may have had none to say so */
}

void ves_study_close(ves_opened *opened)
{
    ves_problem_destroy(opened->problem);
    ves_arena_destroy(&opened->arena);
    *opened = (ves_opened){0};
}

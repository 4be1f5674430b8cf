#include "study/sweep_folder.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/diag.h"
#include "output/file.h"
#include "study/design.h"
#include "study/folder.h"
#include "study/load.h"

static const ves_mark NOWHERE = {0};

/* --- writing --- */

static ves_status problem_write(const ves_sweep *sweep, ves_arena *arena, ves_diag *diag)
{
    ves_file file;
    const char *text = sweep->problem->text;
    char *path = ves_folder_path(sweep->folder, "problem.yaml", arena);
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    VES_TRY(ves_file_begin(&file, path, "yaml", diag));
    fwrite(text, 1, strlen(text), file.out);
    return ves_file_end(&file, VES_OK, diag);
}

static ves_status about_write(const ves_sweep *sweep, const ves_sweep_options *o, ves_arena *arena,
                              ves_diag *diag)
{
    ves_file file;
    char *path = ves_folder_path(sweep->folder, "sweep.json", arena);
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    VES_TRY(ves_file_begin(&file, path, "json", diag));
    ves_json json = {.out = file.out};
    ves_json_object(&json, NULL);
    ves_json_text(&json, "version", VESICA_VERSION);
    ves_json_text(&json, "problem", sweep->problem->path);
    ves_json_flag(&json, "seeded", o->seeded); /* else the file tells, which a branch may set */
    ves_json_count(&json, "seed", o->seed);
    ves_status status = ves_saved_plugins_write(sweep->problem, arena, &json);
    ves_json_array(&json, "walks");
    for (int k = 0; k < sweep->walks; k++) ves_json_text(&json, NULL, sweep->walk[k].name);
    ves_json_end(&json, ']');
    ves_json_integer(&json, "points", sweep->walks * sweep->count);
    ves_json_end(&json, '}');
    if (status != VES_OK) ves_diag_fail(diag, status);
    return ves_file_end(&file, status, diag);
}

/* sweep.json last: a folder that has it has all. */
ves_status ves_sweep_folder_begin(const ves_sweep *sweep, const ves_sweep_options *options, ves_arena *arena,
                                  ves_diag *diag)
{
    static const char *const below[] = {"walks", "shapes"};
    for (int k = 0; k < 2; k++) {
        char *path = ves_folder_path(sweep->folder, below[k], arena);
        if (!path) return ves_diag_fail(diag, VES_MEMORY);
        VES_TRY(ves_folder_open(path, arena, diag));
    }
    VES_TRY(problem_write(sweep, arena, diag));
    return about_write(sweep, options, arena, diag);
}

static void numbers_json(const ves_sweep *sweep, const ves_sweep_point *point, ves_json *json)
{
    const ves_problem *p = sweep->problem;
    const double *c = point->column;
    const int *first = sweep->first;
    ves_json_object(json, "variables");
    for (int k = 0; k < p->variables; k++)
        ves_json_number(json, p->variable[k].name, c[first[VES_SWEEP_VARIABLE] + k]);
    ves_json_end(json, '}');
    if (p->solve) {
        ves_json_object(json, "unknown");
        ves_json_number(json, p->solve->name, c[first[VES_SWEEP_UNKNOWN]]);
        ves_json_end(json, '}');
    }
    ves_json_object(json, "measures");
    for (int k = 0; k < p->measures; k++)
        ves_json_number(json, p->measure[k].name, c[first[VES_SWEEP_MEASURE] + k]);
    ves_json_end(json, '}');
    ves_json_array(json, "constraints");
    for (int k = 0; k < p->constraints; k++) {
        ves_json_object(json, NULL);
        ves_json_text(json, "text", p->constraint[k].text);
        ves_json_number(json, "value", c[first[VES_SWEEP_VALUE] + k]);
        ves_json_number(json, "limit", c[first[VES_SWEEP_LIMIT] + k]);
        ves_json_number(json, "price", c[first[VES_SWEEP_PRICE] + k]);
        ves_json_end(json, '}');
    }
    ves_json_end(json, ']');
}

/* Where it stands. */
static void place_json(const ves_sweep *sweep, int index, ves_json *json)
{
    const ves_sweep_def *def = sweep->def;
    const ves_sweep_walk *walk = &sweep->walk[index / sweep->count];
    const int at[VES_SWEEP_AXES] = {ves_sweep_place(sweep, index), walk->second};
    ves_json_integer(json, "point", index);
    ves_json_integer(json, "walk", index / sweep->count);
    if (def->branches) ves_json_text(json, "branch", def->branch[walk->branch].name);
    ves_json_text(json, "direction", ves_sweep_direction(sweep, walk->back));
    ves_json_object(json, "parameters");
    for (int k = 0; k < def->axes; k++) ves_json_number(json, def->axis[k].name, def->axis[k].value[at[k]]);
    ves_json_end(json, '}');
}

void ves_sweep_point_json(const ves_sweep *sweep, int index, bool compared, bool clocks, ves_json *json)
{
    const ves_sweep_point *point = &sweep->point[index];
    ves_json_object(json, NULL);
    place_json(sweep, index, json);
    ves_json_text(json, "status", point->good ? "ok" : "lost");
    ves_json_text(json, "reason", point->reason);
    if (sweep->def->finest > 0) ves_json_number(json, "reached", point->reached);
    if (sweep->problem->kinds) ves_json_text(json, "kind", ves_problem_kind(sweep->problem, point->kind));
    if (compared) {
        const int before = ves_sweep_turned(sweep, index);
        if (before >= 0)
            ves_json_text(json, "was", ves_design_kind(sweep->problem, sweep->point[before].kind));
        ves_json_integer(json, "optimum", point->optimum);
        ves_json_flag(json, "best", point->best);
    }
    ves_json_number(json, "objective", point->column[sweep->first[VES_SWEEP_OBJECTIVE]]);
    ves_json_flag(json, "feasible", point->feasible);
    ves_json_number(json, "violation", point->column[sweep->first[VES_SWEEP_VIOLATION]]);
    ves_json_number(json, "slope", point->slope);
    numbers_json(sweep, point, json);
    ves_json_integer(json, "evaluations", point->evaluations);
    ves_json_integer(json, "gradients", point->gradients);
    ves_json_array(json, "notes");
    for (int k = 0; k < point->notes; k++) ves_json_text(json, NULL, point->note[k]);
    ves_json_end(json, ']');
    if (clocks) ves_json_number(json, "wall_s", point->wall);
    ves_json_end(json, '}');
}

static char *walk_path(const ves_sweep *sweep, int walk, ves_arena *arena)
{
    return ves_arena_format(arena, "%s/walks/%04d.jsonl", sweep->folder, walk);
}

ves_status ves_sweep_line_write(const ves_sweep *sweep, int index, ves_arena *arena, ves_diag *diag)
{
    char *path = walk_path(sweep, index / sweep->count, arena);
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    FILE *out = fopen(path, "ab");
    if (!out) return ves_file_complain(path, errno, diag);
    ves_json json = {.out = out, .line = true};
    ves_sweep_point_json(sweep, index, false, true, &json);
    bool bad = ferror(out);
    bad = fclose(out) || bad;
    return bad ? ves_file_complain(path, errno, diag) : VES_OK;
}

/* --- reading back --- */

static void named_read(const ves_node *line, const char *key, int count,
                       const char *(*name)(const ves_problem *, int), const ves_problem *problem,
                       double *column)
{
    const ves_node *map = ves_node_find(line, key);
    for (int k = 0; k < count; k++) column[k] = ves_json_double(map, name(problem, k), NAN);
}

static const char *variable_name(const ves_problem *problem, int k)
{
    return problem->variable[k].name;
}

static const char *unknown_name(const ves_problem *problem, int k)
{
    (void)k;
    return problem->solve->name;
}

static void constraints_read(const ves_sweep *sweep, const ves_node *list, double *column)
{
    const int *first = sweep->first;
    for (int k = 0; k < sweep->problem->constraints; k++) {
        const ves_node *c = list && list->kind == VES_NODE_LIST && k < list->count ? list->item[k] : NULL;
        column[first[VES_SWEEP_VALUE] + k] = ves_json_double(c, "value", NAN);
        column[first[VES_SWEEP_LIMIT] + k] = ves_json_double(c, "limit", NAN);
        column[first[VES_SWEEP_PRICE] + k] = ves_json_double(c, "price", NAN);
    }
}

static void columns_read(const ves_sweep *sweep, const ves_node *line, double *column)
{
    const ves_problem *p = sweep->problem;
    const int *first = sweep->first;
    column[first[VES_SWEEP_OBJECTIVE]] = ves_json_double(line, "objective", NAN);
    column[first[VES_SWEEP_VIOLATION]] = ves_json_double(line, "violation", NAN);
    named_read(line, "variables", p->variables, variable_name, p, column + first[VES_SWEEP_VARIABLE]);
    named_read(line, "unknown", p->unknowns, unknown_name, p, column + first[VES_SWEEP_UNKNOWN]);
    named_read(line, "measures", p->measures, ves_problem_measure, p, column + first[VES_SWEEP_MEASURE]);
    constraints_read(sweep, ves_node_find(line, "constraints"), column);
}

static const char *kept(const char *text, ves_arena *arena)
{
    return text ? ves_arena_text(arena, text, strlen(text)) : NULL;
}

static bool notes_read(const ves_node *list, ves_sweep_point *point, ves_arena *arena)
{
    if (!list || list->kind != VES_NODE_LIST) return false;
    point->note = ves_arena_take(arena, (size_t)list->count, sizeof *point->note);
    for (int k = 0; point->note && k < list->count; k++)
        point->note[point->notes++] = kept(list->item[k]->text, arena);
    return point->note;
}

/* Is the line the one of this point, where it is now asked for? */
static bool is_point(const ves_sweep *sweep, const ves_node *line, int index)
{
    const ves_sweep_def *def = sweep->def;
    const ves_node *parameters = ves_node_find(line, "parameters");
    const int at[VES_SWEEP_AXES] = {ves_sweep_place(sweep, index), sweep->walk[index / sweep->count].second};
    bool same = ves_json_double(line, "point", -1) == index;
    for (int k = 0; same && k < def->axes; k++)
        same = ves_json_double(parameters, def->axis[k].name, NAN) == def->axis[k].value[at[k]];
    return same;
}

static int kind_read(const ves_problem *problem, const ves_node *line)
{
    const char *word = ves_json_word(line, "kind");
    int kind = word ? problem->kinds - 1 : -1;
    while (kind >= 0 && strcmp(problem->kind[kind].name, word)) kind--;
    return kind;
}

static bool point_read(const ves_sweep *sweep, const ves_node *line, int index, ves_arena *arena)
{
    ves_sweep_point *point = &sweep->point[index];
    const char *status = ves_json_word(line, "status");
    if (!status || !is_point(sweep, line, index)) return false;
    *point = (ves_sweep_point){.good = !strcmp(status, "ok"),
                               .feasible = ves_json_true(line, "feasible"),
                               .reached = ves_json_double(line, "reached", NAN),
                               .kind = kind_read(sweep->problem, line)};
    if (!point->good) point->reason = kept(ves_json_word(line, "reason"), arena);
    point->column = ves_arena_take(arena, (size_t)sweep->first[VES_SWEEP_GROUPS], sizeof *point->column);
    if (!point->column || !notes_read(ves_node_find(line, "notes"), point, arena)) return false;
    columns_read(sweep, line, point->column);
    point->slope = ves_json_double(line, "slope", NAN);
    point->evaluations = (long)ves_json_double(line, "evaluations", 0);
    point->gradients = (long)ves_json_double(line, "gradients", 0);
    point->wall = ves_json_double(line, "wall_s", NAN);
    return point->done = point->good || point->reason;
}

/* The bytes of the lines that hold. */
static size_t lines_take(const ves_sweep *sweep, int walk, const char *text, ves_arena *arena, int *count)
{
    const char *at = text;
    for (*count = 0; *count < sweep->count; ++*count) {
        size_t length = strcspn(at, "\n");
        ves_arena scratch = {0};
        const ves_node *line = at[length] ? ves_study_json(at, length, &scratch) : NULL;
        bool whole = line && point_read(sweep, line, walk * sweep->count + *count, arena);
        ves_arena_destroy(&scratch);
        if (!whole) break;
        at += length + 1;
    }
    return (size_t)(at - text);
}

ves_status ves_sweep_lines_read(const ves_sweep *sweep, int walk, bool cut, ves_arena *arena, int *count,
                                ves_diag *diag)
{
    ves_arena scratch = {0};
    char *path = walk_path(sweep, walk, arena), *text = NULL;
    size_t length = 0;
    *count = 0;
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    if (access(path, F_OK)) return VES_OK; /* not begun */
    errno = 0;
    ves_status status = ves_study_load(path, &scratch, &text, &length);
    if (status == VES_MEMORY) {
        ves_diag_fail(diag, VES_MEMORY);
    } else if (status != VES_OK) {
        ves_diag_add(diag, VES_ERROR, VES_IO, NOWHERE, "cannot read \"%s\": %s", path,
                     errno ? strerror(errno) : "it is no file of a sweep");
    } else {
        size_t end = lines_take(sweep, walk, text, arena, count);
        const char *rest = text + end;
        if (rest[strcspn(rest, "\n")])
            status = ves_diag_add(diag, VES_ERROR, VES_SYNTAX, NOWHERE,
                                  "\"%s\": line %d is not point %d of this sweep: another sweep, or damaged",
                                  path, *count + 1, walk * sweep->count + *count);
        else if (cut && end < length && truncate(path, (off_t)end))
            status = ves_file_complain(path, errno, diag);
    }
    ves_arena_destroy(&scratch);
    return status;
}

static ves_status about_fill(const ves_node *root, const char *folder, ves_arena *arena,
                             ves_sweep_about *about, ves_diag *diag)
{
    const char *seed = ves_json_word(root, "seed"), *version = ves_json_word(root, "version");
    *about = (ves_sweep_about){.problem = ves_json_word(root, "problem")};
    if (!seed || !version || !about->problem ||
        ves_saved_plugins_read(ves_node_find(root, "plugins"), arena, &about->plugin, &about->plugins) !=
            VES_OK)
        return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, NOWHERE, "\"%s/sweep.json\" is damaged or not whole",
                            folder);
    about->seeded = ves_json_true(root, "seeded");
    about->seed = strtoull(seed, NULL, 10);
    if (!strcmp(version, VESICA_VERSION)) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_STALE, NOWHERE,
                        "vesica %s has begun the sweep \"%s\", this is %s: go on with that one, or sweep "
                        "\"%s/problem.yaml\" anew",
                        version, folder, VESICA_VERSION, folder);
}

ves_status ves_sweep_about_read(const char *folder, ves_arena *arena, ves_sweep_about *about, ves_diag *diag)
{
    const ves_node *root = NULL;
    char *path = ves_folder_path(folder, "sweep.json", arena);
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    ves_status status = ves_json_load(path, arena, &root);
    if (status == VES_MEMORY) return ves_diag_fail(diag, VES_MEMORY);
    if (status == VES_IO)
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, NOWHERE,
                            "there is no sweep to go on with in \"%s\": \"%s\" cannot be read: %s", folder,
                            path, errno ? strerror(errno) : "it is no file of a sweep");
    if (status != VES_OK)
        return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, NOWHERE, "\"%s\" is damaged or not whole", path);
    return about_fill(root, folder, arena, about, diag);
}

ves_status ves_sweep_about_open(const char *folder, const ves_sweep_about *about,
                                const ves_measure *const *plugin, ves_opened *opened, ves_diag *diag)
{
    const ves_saved saved = {
        .folder = folder, .problem = about->problem, .plugins = about->plugins, .plugin = about->plugin};
    return ves_saved_open(&saved, plugin, opened, diag);
}

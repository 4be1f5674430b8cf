#include "problem/problem.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/diag.h"
#include "measure/registry.h"
#include "problem/override.h"
#include "problem/reader.h"

enum { FORMAT = 1, LIMIT = 16 * 1024 * 1024, CHUNK = 64 * 1024 };

/* `vesica: 1` decides how the rest is to be read: nothing else is said about a file of another format. */
bool ves_reader_format(ves_reader *reader, const ves_node *root)
{
    const ves_node *node = ves_node_find(root, "vesica");
    if (!node) return true; /* the table asks for it */
    const ves_key key = {.name = "vesica", .kind = VES_COUNT};
    long format = ves_reader_count(reader, node, &key);
    if (reader->status || format == FORMAT) return !reader->status;
    if (format > FORMAT)
        ves_reader_error(reader, VES_ABSENT, node,
                         "this file is for format %ld; this is vesica %s (format %d)", format, VESICA_VERSION,
                         FORMAT);
    else
        ves_reader_error(reader, VES_RANGE, node, "there is no format %ld; this is vesica %s (format %d)",
                         format, VESICA_VERSION, FORMAT);
    return false;
}

static void read_title(ves_reader *reader, const ves_node *node)
{
    reader->problem->title = reader->problem->name;
    if (node && ves_reader_word(reader, node, "text")) reader->problem->title = node->text;
}

/* Patches and places get their numbers before anything that names them is read. */
static void number_names(ves_names *names)
{
    for (int k = 0; k < names->count; k++) names->name[k].index = k;
}

static void read_sections(ves_reader *reader, const ves_fields *root)
{
    read_title(reader, ves_fields_find(root, "title"));
    reader->vary = ves_fields_find(root, "vary");
    ves_names_read(reader, ves_fields_find(root, "curves"), "curve", false, &reader->curves);
    ves_names_read(reader, ves_fields_find(root, "patches"), "patch", false, &reader->patches);
    ves_names_read(reader, ves_fields_find(root, "places"), "place", false, &reader->places);
    ves_names_read(reader, ves_fields_find(root, "measures"), "measure", true, &reader->measures);
    ves_names_read(reader, ves_fields_find(root, "kinds"), "kind", false, &reader->kinds);
    number_names(&reader->kinds);
    number_names(&reader->patches);
    number_names(&reader->places);
    static void (*const part[])(ves_reader *, const ves_fields *) = {
        ves_reader_slots,       ves_reader_curves, ves_reader_joins,  ves_reader_patches_section,
        ves_reader_joins_check, ves_reader_places, ves_reader_shell,  ves_reader_settings,
        ves_reader_measures,    ves_reader_goals,  ves_reader_search, ves_reader_sweep};
    for (size_t k = 0; k < sizeof part / sizeof *part && reader->status != VES_MEMORY; k++)
        part[k](reader, root);
}

void ves_reader_settings(ves_reader *reader, const ves_fields *root)
{
    ves_reader_shape(reader, ves_fields_find(root, "shape"));
    ves_reader_validity(reader, ves_fields_find(root, "validity"));
    ves_reader_quadrature(reader, ves_fields_find(root, "quadrature"));
}

/* Keys given twice: of each the first holds, so that all other mistakes are found too. What an alias stands
 * for is looked at where it is written. */
void ves_reader_repeats(ves_reader *reader, const ves_node *node)
{
    for (int k = 0; k < node->count + node->repeats; k++) {
        if (k >= node->count)
            ves_reader_error(reader, VES_SYNTAX, node->key[k], "key \"%s\" given twice", node->key[k]->text);
        if (!node->item[k]->alias) ves_reader_repeats(reader, node->item[k]);
    }
}

static ves_status read_root(ves_reader *reader, const ves_node *root)
{
    ves_fields fields;
    if (!root || (root->kind == VES_NODE_WORD && root->plain && !*root->text)) {
        ves_reader_fail(reader, VES_SYNTAX, (ves_mark){0, 1, 1, 1},
                        "the file is empty; a problem begins with vesica: 1");
    } else if (root->kind != VES_NODE_MAP) {
        ves_reader_error(reader, VES_SYNTAX, root,
                         "a problem file is a mapping of keys, beginning with vesica: 1");
    } else if (ves_node_find(root, "suite") && ves_node_find(root, "methods")) {
        ves_reader_error(reader, VES_SYNTAX, root,
                         "this is a suite, not a problem file: it is for vesica bench");
    } else if (ves_reader_format(reader, root) &&
               ves_fields_read(reader, root, ves_schema_root.table, "problem", &fields)) {
        ves_reader_repeats(reader, root);
        read_sections(reader, &fields);
        if (reader->status != VES_MEMORY) ves_reader_finish(reader, &fields);
    }
    return reader->status;
}

/* The problem takes the arena over, with all that lies in it. */
static ves_problem *problem_create(const char *path, ves_arena *arena)
{
    ves_problem *problem = ves_memory_take(sizeof *problem);
    if (!problem) return NULL;
    problem->arena = *arena;
    arena->block = NULL;
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    problem->path = ves_arena_text(&problem->arena, path, strlen(path));
    problem->name =
        ves_arena_text(&problem->arena, base, dot && dot > base ? (size_t)(dot - base) : strlen(base));
    if (problem->path && problem->name) return problem;
    ves_problem_destroy(problem);
    return NULL;
}

/* What is to be read. The arena holds the tree, whose words the problem keeps. */
typedef struct task {
    const char *path;
    const ves_script *script;
    const ves_node *root;
    const ves_measure *const *plugin;
    const char *const *plugin_file;
    ves_arena *arena;
} task;

static bool keep_files(ves_problem *p, const char *const *file)
{
    int count = 0;
    while (file && file[count]) count++;
    if (!count) return true;
    const char **copy = ves_arena_take(&p->arena, (size_t)count + 1, sizeof *copy);
    p->plugin_file = copy;
    for (int k = 0; copy && k < count; k++) {
        copy[k] = ves_arena_text(&p->arena, file[k], strlen(file[k]));
        if (!copy[k]) return false;
    }
    return copy;
}

/* One reading, with dimensions checked or not. */
static ves_status pass(const task *t, ves_arena *arena, ves_problem **problem, bool *units, ves_diag *diag)
{
    bool dimensions = *units;
    ves_problem *p = *problem = problem_create(t->path, arena);
    if (!p) return VES_MEMORY;
    ves_reader reader = {.arena = &p->arena, .script = t->script, .dimensions = dimensions};
    reader.problem = p;
    reader.plugin = t->plugin;
    reader.owner = -1;
    p->units = dimensions;
    p->text = ves_arena_text(&p->arena, t->script->text, t->script->length);
    bool good = p->text && keep_files(p, t->plugin_file);
    ves_status status = good ? read_root(&reader, t->root) : VES_MEMORY;
    *units = reader.units;
    if (diag) ves_reader_tell(&reader, diag);
    ves_memory_free(reader.message);
    ves_memory_free(reader.number);
    ves_memory_free(reader.use);
    ves_memory_free(reader.limit);
    ves_memory_free(reader.room);
    ves_memory_free(reader.at);
    return status;
}

/* Whether a file has units is known only after reading it: the first pass finds out, the second speaks. */
static ves_status two_passes(const task *t, ves_problem **problem, ves_diag *diag)
{
    bool units = false;
    ves_arena scratch = {0};
    ves_status status = pass(t, &scratch, problem, &units, NULL);
    ves_problem_destroy(*problem);
    *problem = NULL;
    if (status == VES_MEMORY) return status;
    status = pass(t, t->arena, problem, &units, diag);
    if (status == VES_OK) return status;
    ves_problem_destroy(*problem);
    *problem = NULL;
    return status;
}

static ves_status check_bytes(const char *text, size_t length, ves_diag *diag)
{
    const ves_mark start = {0, 1, 1, 1};
    bool wide = length >= 2 && (!memcmp(text, "\xFF\xFE", 2) || !memcmp(text, "\xFE\xFF", 2));
    if (wide)
        return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, start, "this file is UTF-16; save it as UTF-8");
    if (length <= LIMIT) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, (ves_mark){0}, "a problem file may have at most 16 MB");
}

static ves_status read_text(ves_arena *arena, const char *path, const char *text, size_t length,
                            const ves_read_options *options, ves_problem **problem, ves_diag *diag)
{
    ves_script script; /* does not outlive this: the problem keeps no marks that would need it */
    task t = {.path = path, .script = &script, .arena = arena};
    if (options) t.plugin = options->plugin, t.plugin_file = options->plugin_file;
    bool marked = length >= 3 && !memcmp(text, "\xEF\xBB\xBF", 3); /* the byte order mark of some editors */
    if (marked) text += 3, length -= 3;
    ves_diag_source(diag, path, text, length);
    VES_TRY(check_bytes(text, length, diag));
    if (options) VES_TRY(ves_measures_check(options->plugin, diag));
    VES_TRY(ves_script_init(&script, text, length, arena));
    VES_TRY(ves_override_apply(&script, options, &t.root, diag));
    return two_passes(&t, problem, diag);
}

ves_status ves_problem_read_text(const char *name, const char *text, size_t length,
                                 const ves_read_options *options, ves_problem **problem, ves_diag *diag)
{
    ves_arena arena = {0};
    *problem = NULL;
    ves_status status = read_text(&arena, name, text, length, options, problem, diag);
    ves_arena_destroy(&arena);
    return status == VES_MEMORY ? ves_diag_fail(diag, VES_MEMORY) : status;
}

static ves_status io_error(const char *path, const char *what, ves_diag *diag)
{
    return ves_diag_add(diag, VES_ERROR, VES_IO, (ves_mark){0}, "cannot %s \"%s\": %s", what, path,
                        strerror(errno));
}

ves_status ves_problem_load(FILE *file, const char *path, char **text, size_t *length, ves_diag *diag)
{
    size_t room = 0, got = 1;
    *text = NULL;
    for (*length = 0; got && *length <= LIMIT; *length += got) {
        if (room - *length < CHUNK) {
            room = 2 * room + CHUNK;
            char *more = ves_memory_grow(*text, room);
            if (!more) return ves_diag_fail(diag, VES_MEMORY);
            *text = more;
        }
        got = fread(*text + *length, 1, CHUNK, file);
    }
    return ferror(file) ? io_error(path, "read", diag) : VES_OK;
}

ves_status ves_problem_read(const char *path, const ves_read_options *options, ves_problem **problem,
                            ves_diag *diag)
{
    char *text = NULL;
    size_t length = 0;
    *problem = NULL;
    FILE *file = fopen(path, "rb");
    if (!file) return io_error(path, "open", diag);
    ves_status status = ves_problem_load(file, path, &text, &length, diag);
    fclose(file);
    if (status == VES_OK) status = ves_problem_read_text(path, text, length, options, problem, diag);
    ves_memory_free(text);
    return status;
}

void ves_problem_destroy(ves_problem *problem)
{
    if (!problem) return;
    ves_arena arena = problem->arena;
    ves_memory_free(problem);
    ves_arena_destroy(&arena);
}

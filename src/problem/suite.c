/* suite, problems, methods: files for vesica bench. */
#include "problem/suite.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "problem/override.h"
#include "problem/reader.h"
#include "suite/trial.h"

enum { NAMES = 300, BOUTS = 1000 };

typedef struct task {
    ves_reader reader;
    ves_suite *suite;
    ves_suite_problem *problem; /* growing: [room] */
    int room;
} task;

static ves_arena *arena_of(task *t)
{
    return &t->suite->arena;
}

static const char *text_at(task *t, const ves_node *node, const char *what)
{
    return node && ves_reader_word(&t->reader, node, what) ? node->text : NULL;
}

/* A path as the file means it: from its own folder on. */
static const char *beside(task *t, const char *path)
{
    const char *slash = strrchr(t->suite->path, '/');
    if (*path == '/' || !slash) return path;
    const char *whole =
        ves_arena_format(arena_of(t), "%.*s/%s", (int)(slash - t->suite->path), t->suite->path, path);
    return ves_reader_memory(&t->reader, whole) ? whole : path;
}

static double number_at(task *t, const ves_fields *f, const char *name)
{
    const ves_field *field = ves_fields_field(f, name);
    return field->node ? ves_reader_constant(&t->reader, field->node, field->key) : field->key->fallback;
}

static bool flag_at(task *t, const ves_fields *f, const char *name)
{
    const ves_field *field = ves_fields_field(f, name);
    return field->node ? ves_reader_flag(&t->reader, field->node, field->key) : field->key->fallback != 0;
}

/* Of these keys exactly one must be given; its index, or -1 after a complaint. */
static int one_of(task *t, const ves_node *node, const ves_fields *f, const char *what,
                  const char *const key[3])
{
    int found = -1, count = 0;
    for (int k = 0; k < 3; k++)
        if (ves_fields_find(f, key[k])) found = k, count++;
    for (int k = 0; k < 3; k++)
        if (ves_fields_excused(f, key[k])) return -1;
    if (count != 1)
        ves_reader_error(&t->reader, VES_SYNTAX, node, "\"%s\" needs %s of \"%s\", \"%s\" and \"%s\"", what,
                         count ? "only one" : "one", key[0], key[1], key[2]);
    return count == 1 ? found : -1;
}

/* Keys that belong to one kind only. */
static void only_with(task *t, const ves_fields *f, const char *kind, const char *const *key)
{
    for (; *key; key++) {
        const ves_field *field = ves_fields_field(f, *key);
        if (field->word)
            ves_reader_error(&t->reader, VES_SYNTAX, field->word, "\"%s\" goes with \"%s\" only", *key, kind);
    }
}

/* --- problems --- */

static const ves_landscape *landscape_at(task *t, const ves_node *node)
{
    const char *name[NAMES], *text = text_at(t, node, "name of a function");
    int count = 0;
    const ves_landscape *found = text ? ves_landscape_find(text) : NULL;
    if (found || !text) return found;
    for (const ves_landscape *const *l = ves_landscapes(); *l && count < NAMES; l++)
        name[count++] = (*l)->name;
    const char *near = ves_reader_suggestion(&t->reader, text, name, count);
    ves_reader_error(&t->reader, VES_NAME, node, "no function \"%.80s\"%s%s", text, near,
                     *near ? "" : " (vesica list functions)");
    return NULL;
}

static bool name_free(task *t, const ves_suite_problem *problem)
{
    for (int k = 0; k < t->suite->problems; k++)
        if (!strcmp(t->problem[k].name, problem->name)) return false;
    return true;
}

static void add_problem(task *t, const ves_node *node, ves_suite_problem problem)
{
    if (!problem.name) return;
    if (t->suite->problems == BOUTS) {
        ves_reader_error(&t->reader, VES_RANGE, node, "more than %d problems", BOUTS);
        return;
    }
    if (!name_free(t, &problem)) {
        ves_reader_error(&t->reader, VES_NAME, node,
                         "there is a problem \"%.80s\" already: give this one a \"name\" of its own",
                         problem.name);
        return;
    }
    if (t->suite->problems == t->room) {
        int room = t->room ? 2 * t->room : 16;
        ves_suite_problem *more = ves_memory_grow(t->problem, (size_t)room * sizeof *more);
        if (!ves_reader_memory(&t->reader, more)) return;
        t->problem = more;
        t->room = room;
    }
    t->problem[t->suite->problems++] = problem;
}

static void add_size(task *t, const ves_node *node, ves_suite_problem problem, int n)
{
    const ves_landscape *l = problem.landscape;
    if (!ves_landscape_takes(l, n)) {
        int most = l->most ? l->most : VES_LANDSCAPE_MOST;
        if (l->least == most)
            ves_reader_error(&t->reader, VES_RANGE, node, "\"%s\" has %d variables, not %d", l->name, most,
                             n);
        else
            ves_reader_error(&t->reader, VES_RANGE, node, "\"%s\" has %d to %d variables%s, not %d", l->name,
                             l->least, most, l->step == 3 ? ", three for each atom" : "", n);
        return;
    }
    problem.n = n;
    problem.name = ves_arena_format(arena_of(t), "%s %d", problem.name, n);
    if (ves_reader_memory(&t->reader, problem.name)) add_problem(t, node, problem);
}

static void read_sizes(task *t, const ves_node *node, const ves_fields *f, ves_suite_problem problem)
{
    const ves_landscape *l = problem.landscape;
    const ves_node *n = ves_fields_find(f, "n");
    const ves_key *key = &ves_fields_field(f, "n")->key[0];
    if (!n && l->least == l->most) {
        problem.n = l->least;
        add_problem(t, node, problem);
    } else if (!n) {
        ves_reader_error(&t->reader, VES_SYNTAX, node, "\"%s\" takes any number of variables: give \"n\"",
                         l->name);
    }
    if (!n) return;
    ves_key each = *key;
    each.kind = VES_COUNT, each.min = 1, each.max = VES_LANDSCAPE_MOST;
    bool list = n->kind == VES_NODE_LIST;
    for (int k = 0; k < (list ? n->count : 1); k++) {
        const ves_node *item = list ? n->item[k] : n;
        int before = t->reader.errors;
        long size = ves_reader_count(&t->reader, item, &each);
        if (t->reader.errors == before) add_size(t, item, problem, (int)size);
    }
}

static void read_function(task *t, const ves_node *node, const ves_fields *f, ves_suite_problem problem)
{
    problem.kind = VES_SUITE_LANDSCAPE;
    problem.landscape = landscape_at(t, ves_fields_find(f, "function"));
    problem.turned = flag_at(t, f, "rotate");
    if (!problem.landscape) return;
    const ves_node *rotate = ves_fields_find(f, "rotate");
    if (problem.turned && !problem.landscape->free) {
        ves_reader_error(&t->reader, VES_RANGE, rotate, "\"%s\" ends at its box and cannot be turned",
                         problem.landscape->name);
        return;
    }
    if (!problem.name)
        problem.name =
            ves_arena_format(arena_of(t), "%s%s", problem.turned ? "rot_" : "", problem.landscape->name);
    if (ves_reader_memory(&t->reader, problem.name)) read_sizes(t, node, f, problem);
}

static const char *stem(task *t, const char *path)
{
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    const char *name =
        ves_arena_text(arena_of(t), base, dot && dot > base ? (size_t)(dot - base) : strlen(base));
    return ves_reader_memory(&t->reader, name) ? name : "";
}

static void read_file(task *t, const ves_node *node, const ves_fields *f, ves_suite_problem problem)
{
    const char *path = text_at(t, ves_fields_find(f, "file"), "file name");
    if (!path) return;
    problem.kind = VES_SUITE_FILE;
    problem.path = beside(t, path);
    const ves_node *set = ves_fields_find(f, "set");
    if (set) problem.set = ves_reader_overrides(&t->reader, set, &problem.sets);
    if (!problem.name) problem.name = stem(t, path);
    add_problem(t, node, problem);
}

static void read_plugin(task *t, const ves_node *node, const ves_fields *f, ves_suite_problem problem)
{
    const ves_node *objective = ves_fields_find(f, "objective");
    const char *path = text_at(t, ves_fields_find(f, "plugin"), "file name");
    if (!path) return;
    problem.kind = VES_SUITE_PLUGIN;
    problem.path = beside(t, path);
    if (objective) problem.objective = text_at(t, objective, "name of an objective");
    if (!problem.name) problem.name = problem.objective ? problem.objective : stem(t, path);
    add_problem(t, node, problem);
}

static void read_problem(task *t, const ves_node *node, const ves_entry *table)
{
    static const char *const kinds[] = {"function", "file", "plugin"};
    static const char *const others[][5] = {
        {"set", "objective", NULL}, {"n", "rotate", "objective", NULL}, {"n", "rotate", "set", NULL}};
    static const char *const owner[][4] = {
        {"file", "plugin"}, {"function", "function", "plugin"}, {"function", "function", "file"}};
    ves_fields f;
    if (!ves_fields_read(&t->reader, node, table, "problem", &f)) return;
    int kind = one_of(t, node, &f, "problem", kinds);
    if (kind < 0) return;
    for (int k = 0; others[kind][k]; k++)
        only_with(t, &f, owner[kind][k], (const char *[]){others[kind][k], NULL});
    ves_suite_problem problem = {.mark = ves_reader_mark(&t->reader, node),
                                 .optimum = number_at(t, &f, "optimum")};
    const ves_node *name = ves_fields_find(&f, "name");
    if (name) problem.name = text_at(t, name, "name");
    const ves_node *optimum = ves_fields_find(&f, "optimum");
    if (kind == 0 && optimum)
        ves_reader_error(&t->reader, VES_SYNTAX, optimum,
                         "the optimum of a function is known: leave \"optimum\" out");
    static void (*const read[])(task *, const ves_node *, const ves_fields *,
                                ves_suite_problem) = {read_function, read_file, read_plugin};
    read[kind](t, node, &f, problem);
}

/* --- methods --- */

static const char *algorithm_at(task *t, const ves_node *node, bool *needs)
{
    const char *name[NAMES], *text = text_at(t, node, "name of an algorithm of NLopt");
    int count = 0;
    *needs = false;
    if (!text || ves_trial_algorithm(text, needs)) return text;
    while (count < NAMES && ves_trial_algorithms(count)) name[count] = ves_trial_algorithms(count), count++;
    ves_reader_error(&t->reader, VES_NAME, node, "NLopt has no algorithm \"%.80s\"%s", text,
                     ves_reader_suggestion(&t->reader, text, name, count));
    return NULL;
}

static void read_nlopt(task *t, const ves_node *node, const ves_fields *f, ves_method *method)
{
    const ves_node *local = ves_fields_find(f, "local");
    bool needs, nested = false;
    method->kind = VES_METHOD_NLOPT;
    method->algorithm = algorithm_at(t, ves_fields_find(f, "nlopt"), &needs);
    if (local) method->local = algorithm_at(t, local, &nested);
    if (!method->algorithm || (local && !method->local)) return;
    if (needs && !local)
        ves_reader_error(&t->reader, VES_SYNTAX, node,
                         "\"%s\" needs another algorithm inside: give \"local\"", method->algorithm);
    if (local && (nested || !needs))
        ves_reader_error(&t->reader, VES_SYNTAX, local, "\"%s\" has no use for \"%s\" inside",
                         method->algorithm, method->local);
}

static void read_program(task *t, const ves_node *node, ves_method *method)
{
    method->kind = VES_METHOD_PROGRAM;
    bool list = node->kind == VES_NODE_LIST;
    int count = list ? node->count : 1;
    if (!count || count > VES_SUITE_WORDS) {
        ves_reader_error(&t->reader, VES_RANGE, node, "a command has 1 to %d words", VES_SUITE_WORDS);
        return;
    }
    for (int k = 0; k < count; k++) {
        const char *word = text_at(t, list ? node->item[k] : node, "word");
        bool here = word && (!strncmp(word, "./", 2) || !strncmp(word, "../", 3));
        method->word[k] = here ? beside(t, word) : word;
    }
}

static void read_method(task *t, const ves_named *named, const ves_entry *table, ves_method *method)
{
    static const char *const kinds[] = {"search", "nlopt", "program"};
    ves_fields f;
    *method = (ves_method){.name = named->text, .mark = ves_reader_mark(&t->reader, named->word)};
    method->search = ves_search_options_default();
    if (!ves_fields_read(&t->reader, named->value, table, "method", &f)) return;
    int kind = one_of(t, named->value, &f, "method", kinds);
    if (kind < 0) return;
    if (kind != 0) only_with(t, &f, "search", (const char *[]){"doubling", NULL});
    if (kind != 1) only_with(t, &f, "nlopt", (const char *[]){"local", NULL});
    if (kind != 2) only_with(t, &f, "program", (const char *[]){"seconds", NULL});
    method->values = !flag_at(t, &f, "gradients");
    method->doubling = flag_at(t, &f, "doubling");
    method->seconds = number_at(t, &f, "seconds");
    if (kind == 0) ves_reader_stages(&t->reader, ves_fields_find(&f, "search"), &method->search);
    if (kind == 1) read_nlopt(t, named->value, &f, method);
    if (kind == 2) read_program(t, ves_fields_find(&f, "program"), method);
}

/* --- the file --- */

static bool fields_at(task *t, const ves_fields *root, const char *name, ves_fields *f)
{
    static const ves_node nothing = {.kind = VES_NODE_MAP};
    const ves_node *node = ves_fields_find(root, name);
    const ves_entry *entry = ves_schema_find(ves_schema_suite.table, name);
    return ves_fields_read(&t->reader, node ? node : &nothing, entry->table, name, f);
}

static void read_targets(task *t, const ves_node *node)
{
    static const double usual[VES_TARGETS] = {1e-1, 1e-3, 1e-6};
    ves_suite *suite = t->suite;
    memcpy(suite->target, usual, sizeof usual);
    if (!node) return;
    const ves_key key = {.name = "targets", .unit = "1", .min = VES_POSITIVE, .max = HUGE_VAL};
    if (node->kind != VES_NODE_LIST || node->count != VES_TARGETS) {
        ves_reader_error(&t->reader, VES_SYNTAX, node, "\"targets\" must be a list of three gaps, falling");
        return;
    }
    int before = t->reader.errors;
    for (int k = 0; k < VES_TARGETS; k++)
        suite->target[k] = ves_reader_constant(&t->reader, node->item[k], &key);
    for (int k = 1; k < VES_TARGETS && t->reader.errors == before; k++)
        if (!(suite->target[k] < suite->target[k - 1]))
            ves_reader_error(&t->reader, VES_RANGE, node->item[k], "\"targets\" must fall, but %g follows %g",
                             suite->target[k], suite->target[k - 1]);
}

static void read_numbers(task *t, const ves_fields *root)
{
    ves_suite *suite = t->suite;
    ves_fields f;
    suite->title = text_at(t, ves_fields_find(root, "suite"), "text");
    if (!suite->title) suite->title = suite->name;
    const ves_field *seeds = ves_fields_field(root, "seeds");
    suite->seeds =
        seeds->node ? (int)ves_reader_count(&t->reader, seeds->node, seeds->key) : (int)seeds->key->fallback;
    suite->seed = 1;
    if (ves_fields_find(root, "seed"))
        ves_reader_seed(&t->reader, ves_fields_find(root, "seed"), &suite->seed);
    if (fields_at(t, root, "budget", &f))
        suite->per_dimension = number_at(t, &f, "per_dimension"), suite->most = number_at(t, &f, "most");
    if (fields_at(t, root, "cost", &f))
        suite->cost = number_at(t, &f, "value"), suite->cost_gradient = number_at(t, &f, "gradient");
    const ves_node *cost = ves_fields_find(root, "cost");
    if (suite->cost_gradient < suite->cost)
        ves_reader_error(&t->reader, VES_RANGE, cost,
                         "a value with its gradient cannot cost less than without");
    if (fields_at(t, root, "feasible", &f))
        suite->inequality = number_at(t, &f, "inequality"), suite->equality = number_at(t, &f, "equality");
    read_targets(t, ves_fields_find(root, "targets"));
}

static void read_problems(task *t, const ves_node *node)
{
    const ves_entry *entry = ves_schema_find(ves_schema_suite.table, "problems")->table;
    if (!node) return;
    if (node->kind != VES_NODE_LIST || !node->count) {
        ves_reader_error(&t->reader, VES_SYNTAX, node, "\"problems\" must be a list of at least one problem");
        return;
    }
    for (int k = 0; k < node->count; k++) read_problem(t, node->item[k], entry->table);
    ves_suite_problem *problem = ves_arena_take(arena_of(t), (size_t)t->suite->problems, sizeof *problem);
    if (ves_reader_memory(&t->reader, problem) && t->suite->problems)
        memcpy(problem, t->problem, (size_t)t->suite->problems * sizeof *problem);
    t->suite->problem = problem;
}

static void read_methods(task *t, const ves_node *node)
{
    const ves_entry *entry = ves_schema_find(ves_schema_suite.table, "methods")->table;
    ves_names names;
    if (!node) return;
    ves_names_read(&t->reader, node, "method", false, &names);
    ves_method *method = ves_arena_take(arena_of(t), (size_t)names.count, sizeof *method);
    if (!ves_reader_memory(&t->reader, method)) return;
    for (int k = 0; k < names.count; k++) read_method(t, &names.name[k], entry->table, &method[k]);
    t->suite->methods = names.count;
    t->suite->method = method;
    if (!names.count && !t->reader.errors)
        ves_reader_error(&t->reader, VES_SYNTAX, node, "\"methods\" must name at least one method");
}

static void read_root(task *t, const ves_node *root)
{
    ves_reader *reader = &t->reader;
    ves_fields fields;
    if (!root || (root->kind == VES_NODE_WORD && root->plain && !*root->text)) {
        ves_reader_fail(reader, VES_SYNTAX, (ves_mark){0, 1, 1, 1},
                        "the file is empty; a suite begins with vesica: 1");
    } else if (root->kind != VES_NODE_MAP) {
        ves_reader_error(reader, VES_SYNTAX, root,
                         "a suite file is a mapping of keys, beginning with vesica: 1");
    } else if (!ves_node_find(root, "suite") && ves_node_find(root, "patches")) {
        ves_reader_error(reader, VES_SYNTAX, root,
                         "this is a problem file, not a suite: name it in one, {file: %s}", t->suite->path);
    } else if (ves_reader_format(reader, root) &&
               ves_fields_read(reader, root, ves_schema_suite.table, "suite", &fields)) {
        ves_reader_repeats(reader, root);
        read_numbers(t, &fields);
        read_problems(t, ves_fields_find(&fields, "problems"));
        read_methods(t, ves_fields_find(&fields, "methods"));
    }
}

static ves_status read_script(ves_suite *suite, const ves_script *script, const ves_node *root,
                              ves_diag *diag)
{
    ves_problem empty = {.variables = 0};
    task t = {.suite = suite};
    t.reader = (ves_reader){.arena = &suite->arena, .script = script, .problem = &empty, .owner = -1};
    suite->text = ves_arena_text(&suite->arena, script->text, script->length);
    if (ves_reader_memory(&t.reader, suite->text)) read_root(&t, root);
    ves_reader_tell(&t.reader, diag);
    ves_memory_free(t.problem);
    ves_memory_free(t.reader.message);
    ves_memory_free(t.reader.number);
    ves_memory_free(t.reader.use);
    ves_memory_free(t.reader.limit);
    ves_memory_free(t.reader.room);
    return t.reader.status;
}

static ves_suite *suite_create(const char *path)
{
    ves_suite *suite = ves_memory_take(sizeof *suite);
    if (!suite) return NULL;
    const char *slash = strrchr(path, '/'), *base = slash ? slash + 1 : path, *dot = strrchr(base, '.');
    suite->path = ves_arena_text(&suite->arena, path, strlen(path));
    suite->name =
        ves_arena_text(&suite->arena, base, dot && dot > base ? (size_t)(dot - base) : strlen(base));
    if (suite->path && suite->name) return suite;
    ves_suite_destroy(suite);
    return NULL;
}

ves_status ves_suite_read_text(const char *path, const char *text, size_t length,
                               const ves_read_options *options, ves_suite **suite, ves_diag *diag)
{
    ves_script *script = NULL;
    const ves_node *root = NULL;
    *suite = suite_create(path);
    ves_status status = *suite ? VES_OK : VES_MEMORY;
    ves_diag_source(diag, path, text, length);
    if (status == VES_OK) script = ves_arena_take(&(*suite)->arena, 1, sizeof *script);
    if (!script) status = VES_MEMORY;
    if (status == VES_OK) status = ves_script_init(script, text, length, &(*suite)->arena);
    if (status == VES_OK) status = ves_override_apply(script, options, &root, diag);
    if (status == VES_OK) status = read_script(*suite, script, root, diag);
    if (status == VES_OK) return VES_OK;
    ves_suite_destroy(*suite);
    *suite = NULL;
    return status == VES_MEMORY ? ves_diag_fail(diag, VES_MEMORY) : status;
}

ves_status ves_suite_read(const char *path, const ves_read_options *options, ves_suite **suite,
                          ves_diag *diag)
{
    char *text = NULL;
    size_t length = 0;
    *suite = NULL;
    FILE *file = fopen(path, "rb");
    if (!file)
        return ves_diag_add(diag, VES_ERROR, VES_IO, (ves_mark){0}, "cannot %s \"%s\": %s", "open", path,
                            strerror(errno));
    ves_status status = ves_problem_load(file, path, &text, &length, diag);
    fclose(file);
    if (status == VES_OK) status = ves_suite_read_text(path, text, length, options, suite, diag);
    ves_memory_free(text);
    return status;
}

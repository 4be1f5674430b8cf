/* measures: configured instances, and the plain ones that formulas name. */
#include <string.h>

#include "formula/dimension.h"
#include "measure/registry.h"
#include "problem/reader.h"

static int all_measures(const ves_reader *reader, const char **name, const ves_measure **measure, int room)
{
    int count = 0;
    const ves_measure *const *lists[2] = {ves_measures(), reader->plugin};
    for (int l = 0; l < 2; l++)
        for (const ves_measure *const *m = lists[l]; m && *m && count < room; m++) {
            if (name) name[count] = (*m)->name;
            if (measure) measure[count] = *m;
            count++;
        }
    return count;
}

_Static_assert(VES_MEASURE_KEYS < VES_KEYS - 1, "a measure's keys and `over` fit into ves_fields");

static int key_count(const ves_measure *measure)
{
    int count = 0;
    while (measure->keys && measure->keys[count].name) count++;
    return count;
}

/* unit NULL: the dimension of the key `of`; "*m^2": that times a unit. */
static ves_dim dim_of(const ves_measure *measure, const ves_args *args)
{
    ves_dim dim = {0}, factor = {0};
    const char *unit = measure->unit;
    if (unit && *unit != '*') {
        ves_dim_read(unit, &dim, NULL);
        return dim;
    }
    dim.any = true;
    for (int k = 0; k < args->count; k++)
        if (!strcmp(args->key[k].name, "of") && args->arg[k].formula && args->arg[k].formula[0])
            dim = ves_formula_dim(args->arg[k].formula[0]);
    if (unit && ves_dim_read(unit + 1, &factor, NULL)) ves_dim_multiply(dim, factor, 1, &dim);
    return dim;
}

static void note_curves(ves_reader *reader, const ves_args *args)
{
    for (int k = 0; k < args->count; k++) {
        const ves_arg *arg = &args->arg[k];
        bool curve = args->key[k].kind == VES_CURVE || (args->key[k].kind == VES_PLACE && !arg->place);
        if (curve && arg->ref && arg->ref[0] >= 0) reader->curve_used[arg->ref[0]] = true;
    }
}

static void check_closed(ves_reader *reader, const ves_node *node, const ves_measure *measure,
                         const ves_args *args)
{
    bool needed = measure->closed || (measure->closes && measure->closes(args));
    if (!needed || reader->problem->shape.closed) return;
    ves_reader_error(
        reader, VES_RANGE, node,
        "\"%s\" needs a closed shape: write shape: {closed: true}, with caps: [PATCH.u0, ...] for open ends",
        measure->name);
}

static void check_shell(ves_reader *reader, const ves_node *node, const ves_measure *measure)
{
    bool needed = measure->shell;
    for (const ves_key *key = measure->keys; key && key->name; key++)
        needed = needed || ves_reader_of_shell(key);
    if (!needed || reader->shell) return;
    ves_reader_error(
        reader, VES_NAME, node,
        "\"%s\" is of a shell: say under \"shell\" what is one, and of what (vesica explain shell)",
        measure->name);
}

/* One instance from its fields. */
static void make(ves_reader *reader, const ves_measure *measure, const char *name, const ves_node *node,
                 ves_fields *fields)
{
    ves_measure_def *def = &reader->measure[reader->measures_read];
    ves_dim *outer = reader->free, dim = {.any = true};
    const ves_node *over = measure->surface ? ves_fields_find(fields, "over") : NULL;
    *def = (ves_measure_def){.name = name, .mark = ves_reader_mark(reader, node), .measure = measure};
    reader->free = &dim;
    int count = key_count(measure);
    ves_reader_args(reader, fields, count < fields->count ? count : fields->count, node, &def->args);
    reader->free = outer;
    if (reader->status == VES_MEMORY) return;
    check_closed(reader, node, measure, &def->args);
    check_shell(reader, node, measure);
    if (over) def->patch = ves_reader_patches(reader, over, &def->over);
    note_curves(reader, &def->args);
    def->dim = dim_of(measure, &def->args);
    reader->measures_read++;
}

static void unknown_measure(ves_reader *reader, const ves_node *word)
{
    const char *name[256];
    int count = all_measures(reader, name, NULL, 256);
    const char *near = ves_reader_suggestion(reader, word->text, name, count);
    ves_reader_error(reader, VES_NAME, word, "no measure \"%.80s\"%s%s", word->text, near,
                     *near ? "" : " (vesica list measures)");
}

static void read_instance(ves_reader *reader, ves_named *name)
{
    const ves_node *value = name->value, *word = value, *args = NULL;
    const ves_node nothing = {.kind = VES_NODE_MAP, .begin = value->begin, .end = value->end};
    if (value->kind == VES_NODE_MAP && value->count == 1) word = value->key[0], args = value->item[0];
    if (word->kind != VES_NODE_WORD) {
        ves_reader_error(reader, VES_SYNTAX, value, "a measure must be {MEASURE: {...}}, with one MEASURE");
        return;
    }
    const ves_measure *measure = ves_measure_find(word->text, reader->plugin);
    ves_fields fields;
    if (!measure) {
        unknown_measure(reader, word);
    } else if (ves_fields_read_keys(reader, args ? args : &nothing, measure->keys,
                                    measure->surface ? &ves_schema_over : NULL, measure->name, &fields)) {
        name->index = reader->measures_read;
        make(reader, measure, name->text, name->word, &fields);
    }
}

static bool is_slot(const ves_reader *reader, const char *name)
{
    for (int k = 0; k < reader->slots; k++)
        if (!strcmp(reader->slot[k].name, name)) return true;
    return false;
}

static void check_name(ves_reader *reader, const ves_named *name)
{
    if (is_slot(reader, name->text))
        ves_reader_error(reader, VES_NAME, name->word, "the name \"%s\" is taken by a variable or parameter",
                         name->text);
}

void ves_reader_measures(ves_reader *reader, const ves_fields *root)
{
    (void)root;
    int all = all_measures(reader, NULL, NULL, 1 << 20);
    reader->measure =
        ves_arena_take(reader->arena, (size_t)(reader->measures.count + all), sizeof *reader->measure);
    if (!ves_reader_memory(reader, reader->measure)) return;
    for (int k = 0; k < reader->measures.count && reader->status != VES_MEMORY; k++) {
        check_name(reader, &reader->measures.name[k]);
        read_instance(reader, &reader->measures.name[k]);
    }
}

static const char *required_keys(ves_reader *reader, const ves_measure *measure)
{
    const char *text = NULL;
    for (const ves_key *key = measure->keys; key && key->name; key++)
        if (key->required)
            text =
                ves_arena_format(reader->arena, "%s%s\"%s\"", text ? text : "", text ? ", " : "", key->name);
    return text;
}

/* A plain measure in a formula becomes an instance with its defaults. */
static void add_plain(ves_reader *reader, const ves_measure *measure, const ves_node *node)
{
    ves_fields fields;
    const char *required = required_keys(reader, measure);
    if (required) {
        ves_reader_error(reader, VES_NAME, node,
                         "measure \"%s\" needs %s: give it a name under \"measures\" and use that",
                         measure->name, required);
        return;
    }
    const ves_node nothing = {.kind = VES_NODE_MAP, .begin = node->begin, .end = node->end};
    ves_fields_read_keys(reader, &nothing, measure->keys, measure->surface ? &ves_schema_over : NULL,
                         measure->name, &fields);
    make(reader, measure, measure->name, node, &fields);
}

ves_symbol *ves_reader_symbols(ves_reader *reader, bool expect, int *count)
{
    static const char *const checks[VES_EXPECT_NAMES] = {"objective",   "violation", "feasible",
                                                         "evaluations", "gradients", "optima"};
    int all = all_measures(reader, NULL, NULL, 1 << 20), at = 0;
    const ves_measure **measure = ves_arena_take(reader->arena, (size_t)all, sizeof *measure);
    ves_symbol *symbol = ves_arena_take(
        reader->arena, (size_t)(reader->measures_read + VES_EXPECT_NAMES + all + VES_MATERIAL_NAMES),
        sizeof *symbol);
    *count = 0;
    if (!ves_reader_memory(reader, symbol) || !ves_reader_memory(reader, measure)) return NULL;
    all_measures(reader, NULL, measure, all);
    for (int k = 0; k < reader->measures_read; k++)
        symbol[at++] = (ves_symbol){reader->measure[k].name, reader->measure[k].dim};
    for (int k = 0; expect && k < VES_EXPECT_NAMES; k++)
        symbol[at++] = (ves_symbol){checks[k], {.any = k == 0}};
    if (expect && reader->problem->objective)
        symbol[reader->measures_read].dim = ves_formula_dim(reader->problem->objective);
    for (int k = 0; k < all; k++) {
        bool named = is_slot(reader, measure[k]->name);
        for (int i = 0; i < reader->measures_read && !named; i++)
            named = !strcmp(symbol[i].name, measure[k]->name);
        if (!named) symbol[at++] = (ves_symbol){measure[k]->name, {.any = true}};
    }
    ves_reader_material_symbols(symbol + at);
    *count = at + VES_MATERIAL_NAMES;
    return symbol;
}

void ves_reader_plain_measures(ves_reader *reader, const ves_node *node)
{
    int count, known = reader->measures_read;
    if (!node || node->kind != VES_NODE_WORD) return;
    ves_symbol *symbol = ves_reader_symbols(reader, true, &count);
    if (!symbol) return;
    const ves_scope scope = {reader->slot, reader->slots, symbol, count, false};
    const ves_formula *formula = NULL;
    ves_formula_error error;
    ves_arena scratch = {0};
    ves_status status = ves_formula_compile(node->text, &scope, &scratch, &formula, &error);
    if (status == VES_MEMORY) reader->status = status;
    for (int k = known + VES_EXPECT_NAMES;
         status == VES_OK && k < count - VES_MATERIAL_NAMES && reader->status != VES_MEMORY; k++)
        if (ves_formula_uses_argument(formula, k))
            add_plain(reader, ves_measure_find(symbol[k].name, reader->plugin), node);
    ves_arena_destroy(&scratch);
}

/* search, seed, test: the stages of the search and their settings. */
#include <string.h>

#include "base/text.h"
#include "problem/reader.h"

static const ves_entry *stage_table(void)
{
    return ves_schema_find(ves_schema_root.table, "search")->table->table;
}

static const ves_field *field(const ves_fields *f, const char *name)
{
    int k = 0;
    while (strcmp(f->field[k].key->name, name)) k++;
    return &f->field[k];
}

/* Each leaves the default where the file says nothing. */
static void set_long(ves_reader *reader, const ves_fields *f, const char *name, long *value)
{
    const ves_field *x = field(f, name);
    if (x->node) *value = ves_reader_count(reader, x->node, x->key);
}

static void set_int(ves_reader *reader, const ves_fields *f, const char *name, int *value)
{
    long wide = *value;
    set_long(reader, f, name, &wide);
    *value = (int)wide;
}

static void set_number(ves_reader *reader, const ves_fields *f, const char *name, double *value)
{
    const ves_field *x = field(f, name);
    if (x->node) *value = ves_reader_constant(reader, x->node, x->key);
}

static void set_flag(ves_reader *reader, const ves_fields *f, const char *name, bool *value)
{
    const ves_field *x = field(f, name);
    if (x->node) *value = ves_reader_flag(reader, x->node, x->key);
}

/* A field that is the opposite of its key. */
static void set_opposite(ves_reader *reader, const ves_fields *f, const char *name, bool *value)
{
    bool flag = !*value;
    set_flag(reader, f, name, &flag);
    *value = !flag;
}

/* Words of the slots, and what their errors call them. */
static void set_choice(ves_reader *reader, const ves_fields *f, const char *name, const char **value)
{
    const ves_field *x = field(f, name);
    const char *known[64];
    ves_choice choice;
    int count = 0;
    if (!x->node || !ves_reader_word(reader, x->node, name)) return;
    for (; count < 64 && ves_search_choice((ves_slot)x->key->max, count, &choice); count++) {
        known[count] = choice.name;
        if (!strcmp(choice.name, x->node->text)) *value = choice.name;
    }
    if (*value) return;
    const char *near = ves_reader_suggestion(reader, x->node->text, known, count);
    ves_reader_error(reader, VES_NAME, x->node, "\"%s\" knows no \"%.80s\"%s%s", name, x->node->text, near,
                     *near ? "" : " (vesica explain tells the words)");
}

/* A setting that a choice (of these) does not read would look as if it did something. */
static void idle(ves_reader *reader, const ves_fields *f, const char *setting, const char *slot,
                 const char *choices)
{
    const ves_node *node = field(f, setting)->node, *choice = field(f, slot)->node;
    if (node && choice && choice->kind == VES_NODE_WORD && ves_words_find(choices, choice->text) >= 0)
        ves_reader_error(reader, VES_RANGE, node, "\"%s: %s\" does not use \"%s\": leave it out", slot,
                         choice->text, setting);
}

static void read_slots(ves_reader *reader, const ves_fields *f, ves_anneal *a)
{
    set_choice(reader, f, "as", &a->as);
    set_choice(reader, f, "proposal", &a->proposal);
    set_choice(reader, f, "schedule", &a->schedule);
    set_choice(reader, f, "population", &a->population);
    set_choice(reader, f, "constraints", &a->constraints);
    set_choice(reader, f, "polish", &a->polish);
    const ves_node *chains = field(f, "chains")->node;
    if (chains && a->chains > 1 && a->population && !strcmp(a->population, "chain"))
        ves_reader_error(reader, VES_RANGE, chains, "\"population: chain\" is 1, got %d: say chains",
                         a->chains);
    idle(reader, f, "s", "schedule", "lam|fixed");
    idle(reader, f, "c_end", "schedule", "lam|fixed");
    idle(reader, f, "step", "proposal", "heavy");
}

static ves_anneal read_anneal(ves_reader *reader, const ves_fields *f)
{
    ves_anneal a = ves_anneal_default();
    set_long(reader, f, "evaluations", &a.evaluations);
    set_int(reader, f, "chains", &a.chains);
    set_number(reader, f, "c0", &a.c0);
    int before = reader->errors;
    set_number(reader, f, "s", &a.s);
    const ves_node *s = field(f, "s")->node;
    if (s && !(a.s > 0 && a.s < 1) && reader->errors == before)
        ves_reader_error(reader, VES_RANGE, s, "\"s\" must lie between 0 and 1");
    set_number(reader, f, "c_end", &a.c_end);
    set_number(reader, f, "step", &a.step);
    set_opposite(reader, f, "adapt", &a.fixed);
    set_number(reader, f, "weight", &a.weight);
    read_slots(reader, f, &a);
    return a;
}

static const char *read_algorithm(ves_reader *reader, const ves_node *node)
{
    const char *name[64];
    int count = 0;
    if (!ves_reader_word(reader, node, "name of an algorithm")) return NULL;
    for (const ves_algorithm *a = ves_search_algorithms(); a->name && count < 64; a++) {
        if (!strcmp(a->name, node->text)) return a->name;
        name[count++] = a->name;
    }
    const char *near = ves_reader_suggestion(reader, node->text, name, count);
    ves_reader_error(reader, VES_NAME, node, "no algorithm \"%.80s\"%s%s", node->text, near,
                     *near ? "" : " (vesica list algorithms)");
    return NULL;
}

static ves_polish read_polish(ves_reader *reader, const ves_fields *f)
{
    ves_polish p = ves_polish_default();
    const ves_node *algorithm = field(f, "algorithm")->node;
    if (algorithm) p.algorithm = read_algorithm(reader, algorithm);
    set_long(reader, f, "evaluations", &p.evaluations);
    set_number(reader, f, "x_tolerance", &p.x_tolerance);
    set_number(reader, f, "f_tolerance", &p.f_tolerance);
    set_int(reader, f, "starts", &p.starts);
    set_opposite(reader, f, "escape", &p.stay);
    return p;
}

static void unknown_stage(ves_reader *reader, const ves_node *word)
{
    static const char *const name[] = {"auto", "anneal", "polish"};
    const char *near = ves_reader_suggestion(reader, word->text, name, 3);
    ves_reader_error(reader, VES_NAME, word, "no stage \"%.80s\"%s (known: auto, anneal, polish)", word->text,
                     near);
}

/* Either a mapping of keys, or the first key alone: {polish: slsqp}. */
static bool stage_fields(ves_reader *reader, const ves_entry *stage, const ves_node *value, ves_fields *f)
{
    const ves_node nothing = {.kind = VES_NODE_MAP, .begin = value->begin, .end = value->end};
    bool word = value->kind == VES_NODE_WORD, empty = word && value->plain && !*value->text;
    bool good = ves_fields_read(reader, word ? &nothing : value, stage->table, stage->key.name, f);
    if (word && !empty) f->field[0].node = value;
    return good;
}

static void read_stage(ves_reader *reader, const ves_node *node, ves_search_options *options)
{
    const ves_node nothing = {.kind = VES_NODE_MAP, .begin = node->begin, .end = node->end};
    const ves_node *word = node, *value = &nothing;
    if (node->kind == VES_NODE_MAP && node->count == 1) word = node->key[0], value = node->item[0];
    if (word->kind != VES_NODE_WORD) {
        ves_reader_error(reader, VES_SYNTAX, node,
                         "a stage must be {auto: {...}}, {anneal: {...}} or {polish: {...}}");
        return;
    }
    const ves_entry *stage = ves_schema_find(stage_table(), word->text);
    ves_fields f;
    if (!stage) {
        unknown_stage(reader, word);
    } else if (stage_fields(reader, stage, value, &f) && options->stages < VES_STAGES) {
        ves_stage *out = &options->stage[options->stages++];
        *out = (ves_stage){.kind = VES_STAGE_ANNEAL};
        if (!strcmp(stage->key.name, "polish")) {
            out->kind = VES_STAGE_POLISH;
            out->polish = read_polish(reader, &f);
        } else if (!strcmp(stage->key.name, "auto")) {
            out->kind = VES_STAGE_AUTO;
            set_choice(reader, &f, "only", &out->automatic.only);
            set_long(reader, &f, "evaluations", &out->automatic.evaluations);
        } else {
            out->anneal = read_anneal(reader, &f);
        }
    }
}

void ves_reader_stages(ves_reader *reader, const ves_node *node, ves_search_options *options)
{
    const ves_node *const single[1] = {node};
    bool list = node->kind == VES_NODE_LIST;
    const ves_node *const *item = list ? node->item : single;
    int count = list ? node->count : 1;
    options->stages = 0;
    if (node->kind == VES_NODE_WORD && !strcmp(node->text, "auto")) return;
    if (!count) ves_reader_error(reader, VES_SYNTAX, node, "this list of stages is empty; write auto");
    if (count > VES_STAGES) ves_reader_error(reader, VES_RANGE, node, "more than %d stages", VES_STAGES);
    for (int k = 0; k < count && k < VES_STAGES; k++) read_stage(reader, item[k], options);
}

void ves_reader_seed(ves_reader *reader, const ves_node *node, uint64_t *seed)
{
    ves_key key = ves_schema_find(ves_schema_root.table, "seed")->key;
    key.max = 9007199254740992.0;
    long value = ves_reader_count(reader, node, &key);
    if (value >= 0) *seed = (uint64_t)value;
}

static void read_test(ves_reader *reader, const ves_node *node, ves_search_options *options)
{
    ves_fields f;
    if (!ves_fields_read(reader, node, ves_schema_find(ves_schema_root.table, "test")->table, "test", &f))
        return;
    const ves_node *search = ves_fields_find(&f, "search");
    set_long(reader, &f, "evaluations", &options->evaluations);
    if (search) ves_reader_stages(reader, search, options);
}

void ves_reader_search(ves_reader *reader, const ves_fields *root)
{
    ves_problem *problem = reader->problem;
    const ves_node *search = ves_fields_find(root, "search"), *seed = ves_fields_find(root, "seed"),
                   *test = ves_fields_find(root, "test");
    problem->search = ves_search_options_default();
    if (search) ves_reader_stages(reader, search, &problem->search);
    if (seed) ves_reader_seed(reader, seed, &problem->search.seed);
    problem->test = problem->search;
    if (test) read_test(reader, test, &problem->test);
}

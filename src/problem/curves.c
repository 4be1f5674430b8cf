/* curves: each one source and its moves; curves that others are made of come first. */
#include <string.h>

#include "formula/dimension.h"
#include "problem/reader.h"

enum { MOVES = 256 };

typedef struct steps {
    ves_curve_step *step;
    int count, room;
} steps;

static int operation_names(bool moves, const char **name, int room)
{
    int count = 0;
    for (const ves_curve_op *const *op = ves_curve_ops(); *op && count < room; op++)
        if ((*op)->move == moves) name[count++] = (*op)->name;
    return count;
}

static void unknown_operation(ves_reader *reader, const ves_node *word, bool move)
{
    const char *name[64];
    int count = operation_names(move, name, 63);
    if (!move) name[count++] = "apply";
    if (!move && ves_curve_op_find(word->text, true)) {
        ves_reader_error(reader, VES_NAME, word, "\"%s\" is a move: it goes into the list apply", word->text);
    } else if (move && ves_curve_op_find(word->text, false)) {
        ves_reader_error(reader, VES_NAME, word, "\"%s\" makes a curve, it does not move one", word->text);
    } else {
        const char *near = ves_reader_suggestion(reader, word->text, name, count);
        ves_reader_error(reader, VES_NAME, word, "no %s \"%.80s\"%s%s", move ? "move" : "curve kind",
                         word->text, near,
                         *near  ? ""
                         : move ? " (vesica list moves)"
                                : " (vesica list curves)");
    }
}

static void check_input_dim(ves_reader *reader, const ves_node *node, int input)
{
    if (!reader->dimensions || input < 0) return;
    ves_dim dim = reader->curve[input].dim;
    if (reader->free->any) *reader->free = dim;
    if (ves_dim_equal(*reader->free, dim)) return;
    char want[64], found[64];
    ves_dim_describe(*reader->free, want);
    ves_dim_describe(dim, found);
    ves_reader_error(reader, VES_UNIT, node, "points of this curve are %s, but those of \"%s\" are %s", want,
                     reader->curve[input].name, found);
}

static int references(const ves_args *args)
{
    int count = 0;
    for (int k = 0; k < args->count; k++)
        if (args->arg[k].given && (args->key[k].kind == VES_CURVE || args->key[k].kind == VES_TERMS))
            count += args->arg[k].count;
    return count;
}

static void note_inputs(ves_reader *reader, const ves_node *node, const ves_args *args, ves_curve_def *curve)
{
    int *input = ves_arena_take(reader->arena, (size_t)references(args), sizeof *input);
    if (!ves_reader_memory(reader, input)) return;
    for (int k = 0; k < args->count; k++) {
        if (!args->arg[k].given || !args->arg[k].ref) continue;
        if (args->key[k].kind != VES_CURVE && args->key[k].kind != VES_TERMS) continue;
        for (int i = 0; i < args->arg[k].count; i++) {
            input[curve->inputs++] = args->arg[k].ref[i];
            check_input_dim(reader, node, args->arg[k].ref[i]);
        }
    }
    curve->input = input;
}

static void add_step(ves_reader *reader, const ves_curve_op *op, const ves_node *word, const ves_node *value,
                     steps *s)
{
    ves_fields fields;
    if (!ves_fields_read_keys(reader, value, op->keys, NULL, op->name, &fields)) return;
    ves_curve_step *step = &s->step[s->count++];
    step->op = op;
    ves_reader_args(reader, &fields, fields.count, word, &step->args);
}

static void read_move(ves_reader *reader, const ves_node *node, steps *s)
{
    if (node->kind != VES_NODE_MAP || node->count != 1) {
        ves_reader_error(reader, VES_SYNTAX, node, "expected a move {MOVE: ...}%s",
                         node->kind == VES_NODE_MAP && node->count > 1
                             ? "; each move is an item of its own, in the order of application"
                             : "");
        return;
    }
    const ves_curve_op *op = ves_curve_op_find(node->key[0]->text, true);
    if (!op)
        unknown_operation(reader, node->key[0], true);
    else
        add_step(reader, op, node->key[0], node->item[0], s);
}

static void read_apply(ves_reader *reader, const ves_node *apply, steps *s)
{
    const ves_node *const single[1] = {apply};
    bool list = apply->kind == VES_NODE_LIST;
    const ves_node *const *item = list ? apply->item : single;
    int count = list ? apply->count : 1;
    if (count > MOVES) ves_reader_error(reader, VES_RANGE, apply, "more than %d moves", MOVES);
    for (int k = 0; k < count && k < MOVES; k++) read_move(reader, item[k], s);
}

/* Finds the one source of a curve; reports any other key. */
static const ves_curve_op *find_source(ves_reader *reader, const ves_named *name, int *at)
{
    const ves_entry *keys = ves_schema_find(ves_schema_root.table, "curves")->table->table;
    const ves_node *value = name->value;
    const ves_curve_op *source = NULL;
    bool wrong = false;
    for (int k = 0; k < value->count; k++) {
        const ves_node *word = value->key[k];
        const ves_entry *entry = ves_schema_find(keys, word->text);
        const ves_curve_op *op = ves_curve_op_find(word->text, false);
        if (entry && (int)entry->key.kind != VES_LATER) continue;
        if (op && !source)
            *at = k, source = op;
        else
            wrong = true;
        if (op && op != source)
            ves_reader_error(reader, VES_SYNTAX, word,
                             "curve \"%s\" is a \"%s\" already; a curve has one kind", name->text,
                             source->name);
        else if (entry)
            ves_reader_error(reader, VES_ABSENT, word, "\"%s\" (%s) is not in this version yet", word->text,
                             entry->key.about);
        else if (!op)
            unknown_operation(reader, word, false);
    }
    if (!source && !wrong)
        ves_reader_error(reader, VES_NAME, value,
                         "curve \"%s\" has no kind: {circle: {...}}, {point: [x, y, z]}, ...", name->text);
    return source;
}

/* The source of a curve, or of the sections of a family. */
static void read_source(ves_reader *reader, const ves_curve_op *source, const ves_node *value, int at,
                        steps *s)
{
    const ves_node *family = ves_node_find(value, "family");
    if (family) reader->parameter = ves_reader_family(reader, family, source);
    if (!family || reader->parameter) add_step(reader, source, value->key[at], value->item[at], s);
    reader->parameter = NULL;
}

static void read_steps(ves_reader *reader, ves_named *name, const ves_node *vary, ves_curve_def *curve)
{
    const ves_node *value = name->value, *apply = ves_node_find(value, "apply"), *moves[3];
    int at = 0, extra = 0, given = apply && apply->kind == VES_NODE_LIST ? apply->count : 0;
    const ves_curve_op *source = find_source(reader, name, &at);
    steps s = {.room = 4 + (given < MOVES ? given : MOVES)};
    s.step = ves_arena_take(reader->arena, (size_t)s.room, sizeof *s.step);
    if (!ves_reader_memory(reader, s.step)) return;
    if (source) read_source(reader, source, value, at, &s);
    if (s.count && reader->status != VES_MEMORY) note_inputs(reader, value->key[at], &s.step[0].args, curve);
    if (apply) read_apply(reader, apply, &s);
    ves_vary_moves(reader, vary, name, moves, &extra);
    for (int k = 0; k < extra; k++) read_move(reader, moves[k], &s);
    curve->step = s.step;
    curve->steps = s.count;
}

/* A family is no curve: only its sections are. */
static int keep(ves_reader *reader, ves_named *name, const ves_curve_def *curve)
{
    const ves_node *family = ves_node_find(name->value, "family");
    if (family) {
        reader->family[name - reader->curves.name] = (ves_family){
            family->kind == VES_NODE_WORD ? family->text : "", curve->step, curve->steps, curve->dim, false};
        return -1;
    }
    name->index = reader->curves_read++;
    reader->curve[name->index] = *curve;
    return name->index;
}

int ves_reader_curve_read(ves_reader *reader, const ves_node *node, ves_named *name)
{
    if (name->index >= 0) return name->index;
    if (name->open) {
        ves_reader_error(reader, VES_NAME, node, "curve \"%s\" is made of itself", name->text);
        return -1;
    }
    const ves_reader outer = *reader;
    ves_dim dim = {.any = true};
    ves_curve_def curve = {.name = name->text, .mark = ves_reader_mark(reader, name->word)};
    name->open = true;
    reader->owner = (int)(name - reader->curves.name);
    reader->free = &dim;
    reader->free_node = NULL;
    reader->lengths = true;
    if (name->value->kind == VES_NODE_MAP)
        read_steps(reader, name, reader->vary, &curve);
    else
        ves_reader_error(reader, VES_SYNTAX, name->value,
                         "a curve must be a mapping {KIND: ..., apply: [...]}");
    reader->owner = outer.owner;
    reader->free = outer.free;
    reader->free_node = outer.free_node;
    reader->free_name = outer.free_name;
    reader->lengths = outer.lengths;
    name->open = false;
    curve.dim = dim;
    return keep(reader, name, &curve);
}

static size_t sections_most(const ves_reader *reader)
{
    size_t count = 0;
    for (int k = 0; k < reader->patches.count; k++)
        count += ves_node_find(reader->patches.name[k].value, "sections") ? VES_CONDITIONS_MAX : 0;
    return count;
}

void ves_reader_curves(ves_reader *reader, const ves_fields *root)
{
    const ves_node *modes = ves_fields_find(root, "modes");
    ves_problem *problem = reader->problem;
    size_t count = (size_t)reader->curves.count, all = count + sections_most(reader);
    reader->curve = ves_arena_take(reader->arena, all, sizeof *reader->curve);
    reader->curve_used = ves_arena_take(reader->arena, all, sizeof *reader->curve_used);
    reader->family = ves_arena_take(reader->arena, count, sizeof *reader->family);
    reader->section = ves_arena_take(reader->arena, all - count, sizeof *reader->section);
    if (!ves_reader_memory(reader, reader->curve) || !ves_reader_memory(reader, reader->curve_used) ||
        !ves_reader_memory(reader, reader->family) || !ves_reader_memory(reader, reader->section))
        return;
    for (size_t k = 0; k < count; k++)
        ves_reader_curve_read(reader, reader->curves.name[k].word, &reader->curves.name[k]);
    problem->curve = reader->curve;
    problem->curves = reader->curves_read;
    problem->curve_limit = VES_CURVE_MODES;
    if (modes)
        problem->curve_limit =
            (int)ves_reader_count(reader, modes, &ves_schema_find(ves_schema_root.table, "modes")->key);
}

/* Joins: two ends that lie on one curve take their derivatives there from the same fields,
 *     X_u = +- scale_i tangent,   X_uu = scale_i^2 bend,
 * so that one surface continues the other: with u scale_i as the parameter both have the same first and second
 * derivative (the tangents and curvatures of [Kubiesa 2004, eqs 29-32], for two patches at once). An end u = 1
 * that meets an end u = 0 goes on in its direction; two ends of one kind run against each other. The conditions
 * belong to the patches; here they are kept until these are read. */
#include "problem/reader.h"

#include <string.h>

#include "formula/dimension.h"

/* What is being read. */
typedef struct joint {
    ves_reader *reader;
    const ves_node *node;
    ves_fields f;
    ves_join *out;
    ves_dim scale[2];
} joint;

static const ves_node *find(const joint *j, const char *name)
{
    return ves_fields_find(&j->f, name);
}

static void read_ends(joint *j, const ves_node *node)
{
    ves_reader *reader = j->reader;
    ves_end *end = j->out->end;
    if (node->kind != VES_NODE_LIST || node->count != 2) {
        ves_reader_error(reader, VES_SYNTAX, node, "\"ends\" must be two ends, [top.u1, side.u0]");
        return;
    }
    bool good = true;
    for (int k = 0; k < 2; k++) good = ves_reader_end(reader, node->item[k], &end[k]) && good;
    for (int k = 0; k < 2 && good; k++) {
        const ves_named *patch = &reader->patches.name[end[k].patch];
        if (!ves_node_find(patch->value, "surface")) continue;
        ves_reader_error(reader, VES_SYNTAX, node->item[k],
                         "\"%s\" is a surface that is given: it has no derivatives to be set", patch->text);
        good = false;
    }
    if (good && end[0].patch == end[1].patch && end[0].end == end[1].end) {
        ves_reader_error(reader, VES_NAME, node, "\"%s\" is joined to itself", node->item[0]->text);
        good = false;
    }
    j->out->good = good;
}

/* The square of a number, as a number of its own. */
static int square(ves_reader *reader, const ves_node *node, int number)
{
    if (number < 0 || !reader->number[number - reader->slots]) return number;
    ves_node word = *node;
    word.exact = (size_t)-1; /* no text of the file */
    word.text = ves_arena_format(reader->arena, "(%s)^2", node->text);
    if (!ves_reader_memory(reader, word.text)) return -1;
    return ves_reader_append(reader, ves_reader_formula(reader, ves_text_whole(&word), NULL, 0));
}

static void read_scale(joint *j, int k, const ves_node *node, const ves_key *key)
{
    ves_reader *reader = j->reader;
    int index = j->out->scale[k] = ves_reader_place(reader, node, key);
    const ves_formula *formula = index < 0 ? NULL : reader->number[index - reader->slots];
    j->scale[k] = formula ? ves_formula_dim(formula) : (ves_dim){.any = true};
    if (find(j, "bend")) j->out->square[k] = square(reader, node, index);
}

static void read_scales(joint *j, const ves_field *scale)
{
    ves_key number = *scale->key;
    const ves_key *key = &number;
    const ves_node *node = scale->node;
    number.kind = VES_NUMBER;
    if (!node) return;
    if (node->kind != VES_NODE_LIST) {
        read_scale(j, 0, node, key);
        j->out->scale[1] = j->out->scale[0], j->out->square[1] = j->out->square[0];
        j->scale[1] = j->scale[0];
    } else if (node->count == 2) {
        for (int k = 0; k < 2; k++) read_scale(j, k, node->item[k], key);
    } else {
        ves_reader_error(j->reader, VES_SYNTAX, node,
                         "\"scale\" must be one number, or two, one for each end, found %d", node->count);
    }
}

/* The field, times its scale to the power of the derivative, is a length on both sides. */
static void check_length(joint *j, const ves_node *node, int curve, int derivative)
{
    const ves_dim length = {.m = 6};
    for (int k = 0; k < 2 && j->reader->dimensions; k++) {
        ves_dim dim = j->reader->curve[curve].dim;
        char found[64];
        for (int d = 0; d < derivative; d++)
            if (!ves_dim_multiply(dim, j->scale[k], 1, &dim)) return;
        if (ves_dim_equal(dim, length)) continue;
        ves_dim_describe(dim, found);
        ves_reader_error(j->reader, VES_UNIT, node, "\"%s\" times %s must be a length (m), found %s",
                         node->text, derivative == 1 ? "the scale" : "the square of the scale", found);
        return;
    }
}

static int read_field(joint *j, const char *name, int derivative)
{
    const ves_node *node = find(j, name);
    int curve = node ? ves_reader_curve(j->reader, node) : -1;
    if (curve < 0) return -1;
    j->reader->curve_used[curve] = true;
    check_length(j, node, curve, derivative);
    return curve;
}

static void read_join(ves_reader *reader, const ves_node *node, ves_join *out)
{
    joint j = {.reader = reader, .node = node, .out = out};
    const ves_entry *table = ves_schema_find(ves_schema_root.table, "joins")->table->table;
    *out = (ves_join){.node = node, .scale = {-1, -1}, .square = {-1, -1}, .field = {-1, -1}};
    if (!ves_fields_read(reader, node, table, "join", &j.f)) return;
    const ves_node *ends = find(&j, "ends");
    if (ends) read_ends(&j, ends);
    read_scales(&j, ves_fields_field(&j.f, "scale"));
    out->field[0] = read_field(&j, "tangent", 1);
    out->field[1] = read_field(&j, "bend", 2);
    out->bends = find(&j, "bend") != NULL;
}

void ves_reader_joins(ves_reader *reader, const ves_fields *root)
{
    const ves_node *list = ves_fields_find(root, "joins");
    if (!list) return;
    if (list->kind != VES_NODE_LIST) {
        ves_reader_error(reader, VES_SYNTAX, list,
                         "\"joins\" must be a list [{ends: [top.u1, side.u0], tangent: FIELD}, ...]");
        return;
    }
    reader->join = ves_arena_take(reader->arena, (size_t)list->count, sizeof *reader->join);
    if (!ves_reader_memory(reader, reader->join)) return;
    for (int k = 0; k < list->count; k++) read_join(reader, list->item[k], &reader->join[k]);
    reader->joins = list->count;
}

/* X_u or X_uu at one end of a join. */
static void condition(ves_reader *reader, const ves_join *join, int side, int derivative, ves_condition *out)
{
    bool against = side == 1 && derivative == 1 && join->end[0].end == join->end[1].end;
    int field = join->field[derivative - 1];
    ves_share *share = ves_arena_take(reader->arena, 1, sizeof *share);
    if (!ves_reader_memory(reader, share)) return;
    *share = (ves_share){field, against ? -1 : 1};
    *out = (ves_condition){.mark = ves_reader_mark(reader, join->node),
                           .u = join->end[side].end,
                           .derivative = derivative,
                           .shares = field >= 0,
                           .share = share,
                           .scale = derivative == 1 ? join->scale[side] : join->square[side]};
}

int ves_reader_joined(ves_reader *reader, int patch, ves_condition *out)
{
    int count = 0;
    for (int k = 0; k < reader->joins; k++)
        if (!reader->join[k].good) return -1;
    for (int k = 0; k < reader->joins; k++)
        for (int side = 0; side < 2; side++) {
            const ves_join *join = &reader->join[k];
            if (join->end[side].patch != patch) continue;
            for (int d = 1; d <= 1 + join->bends; d++, count++)
                if (out) condition(reader, join, side, d, &out[count]);
        }
    return count;
}

/* The curve on which an end of a patch lies; -1: it has no position, -2: that is not known, after an error. */
static int curve_of(const ves_reader *reader, const ves_end *end)
{
    const ves_patch_def *patch = &reader->problem->patch[end->patch];
    for (int k = 0; k < patch->conditions; k++)
        if (patch->condition[k].u == end->end && patch->condition[k].derivative == 0)
            return patch->condition[k].shares ? patch->condition[k].share[0].curve : -2;
    for (int k = 0; k < patch->conditions; k++)
        if (patch->condition[k].u < 0) return -2;
    return patch->conditions ? -1 : -2;
}

static void check_join(ves_reader *reader, const ves_join *join)
{
    const ves_node *ends = ves_node_find(join->node, "ends");
    int curve[2] = {curve_of(reader, &join->end[0]), curve_of(reader, &join->end[1])};
    if (curve[0] == -2 || curve[1] == -2) return;
    for (int k = 0; k < 2; k++)
        if (curve[k] < 0) {
            ves_reader_error(
                reader, VES_SINGULAR, ends->item[k],
                "\"%s\" has no position: it must lie on the curve of the end that it is joined to",
                ends->item[k]->text);
            return;
        }
    if (curve[0] != curve[1])
        ves_reader_error(reader, VES_SINGULAR, ends,
                         "joined ends lie on one curve, but \"%s\" lies on \"%s\" and \"%s\" on \"%s\"",
                         ends->item[0]->text, reader->curve[curve[0]].name, ends->item[1]->text,
                         reader->curve[curve[1]].name);
}

void ves_reader_joins_check(ves_reader *reader, const ves_fields *root)
{
    (void)root;
    for (int k = 0; k < reader->joins; k++)
        if (reader->join[k].good) check_join(reader, &reader->join[k]);
}

/* shell.supports: what holds it. */
#include <math.h>
#include <string.h>

#include "problem/reader.h"

enum { FIX_ALL = 6, FIX_PINNED = 7 }; /* the words behind x, y, z, rx, ry, rz */

static unsigned fix_bits(ves_reader *reader, const ves_node *node, const ves_key *word)
{
    int before = reader->errors, choice = ves_reader_choice(reader, node, word);
    if (reader->errors > before) return 0;
    return choice == FIX_ALL ? 63 : choice == FIX_PINNED ? 7 : 1u << choice;
}

static void read_fix(ves_reader *reader, const ves_field *field, ves_support_def *support)
{
    const ves_node *node = field->node;
    const ves_entry *entry = ves_schema_below(ves_schema_find(ves_schema_shell, "supports"));
    const ves_key *word = &ves_schema_find(entry, "fix")->table->key;
    support->kind = VES_SUPPORT_FIX;
    if (node->kind != VES_NODE_LIST) {
        support->fix = fix_bits(reader, node, word);
        return;
    }
    if (!node->count) ves_reader_error(reader, VES_SYNTAX, node, "\"fix\" is empty: this holds nothing");
    for (int k = 0; k < node->count; k++) support->fix |= fix_bits(reader, node->item[k], word);
}

/* A direction that does not move: which nodes it holds is a matter of the mesh, not of a candidate. */
static void read_direction(ves_reader *reader, const ves_field *field, ves_support_kind kind,
                           ves_support_def *support)
{
    const ves_node *node = field->node;
    const ves_key number = {.name = field->key->name, .kind = VES_NUMBER, .unit = "1"};
    support->kind = kind;
    if (support->at.kind == VES_AT_PLACE)
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" holds a curve or an edge, not a place",
                         field->key->name);
    if (node->kind != VES_NODE_LIST || node->count != 3) {
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" must be a direction [x, y, z]", field->key->name);
        return;
    }
    for (int k = 0; k < 3; k++) support->axis[k] = ves_reader_constant(reader, node->item[k], &number);
    double length = hypot(hypot(support->axis[0], support->axis[1]), support->axis[2]);
    if (length == 0)
        ves_reader_error(reader, VES_RANGE, node, "\"%s\" must not be [0, 0, 0]", field->key->name);
    for (int k = 0; k < 3; k++) support->axis[k] /= length;
}

static void read_spring(ves_reader *reader, const ves_field *field, ves_support_def *support)
{
    ves_key key = *field->key;
    ves_arg arg;
    const ves_field spring = {.key = &key, .node = field->node};
    key.unit = support->at.kind == VES_AT_PLACE ? "N/m" : "N/m^2";
    support->kind = VES_SUPPORT_SPRING;
    ves_reader_arg(reader, &spring, &arg);
    if (arg.count == 3) support->spring = arg.first;
}

static void read_kind(ves_reader *reader, const ves_field *field, ves_support_def *support)
{
    const char *name = field->key->name;
    if (!strcmp(name, "fix"))
        read_fix(reader, field, support);
    else if (!strcmp(name, "symmetry"))
        read_direction(reader, field, VES_SUPPORT_SYMMETRY, support);
    else if (!strcmp(name, "diaphragm"))
        read_direction(reader, field, VES_SUPPORT_DIAPHRAGM, support);
    else
        read_spring(reader, field, support);
}

static void read_support(ves_reader *reader, const ves_node *node, ves_support_def *support)
{
    const ves_entry *table = ves_schema_below(ves_schema_find(ves_schema_shell, "supports"));
    ves_fields f;
    int kinds = 0;
    *support = (ves_support_def){.mark = ves_reader_mark(reader, node), .spring = -1};
    if (!ves_fields_read(reader, node, table, "support", &f)) return;
    const ves_node *at = ves_fields_find(&f, "at");
    if (at) ves_reader_shell_at(reader, at, &support->at);
    bool excused = false;
    for (int k = 0; k < f.count; k++) {
        bool kind = strcmp(f.field[k].key->name, "at") != 0;
        excused = excused || f.field[k].excused;
        if (kind && f.field[k].node && !kinds++) read_kind(reader, &f.field[k], support);
    }
    if (kinds != 1 && !excused)
        ves_reader_error(
            reader, VES_SYNTAX, node,
            "a support has one of \"fix\", \"symmetry\", \"diaphragm\" and \"spring\", this has %s",
            kinds ? "several: give one for each" : "none");
}

void ves_reader_supports(ves_reader *reader, const ves_node *node)
{
    const ves_node *const single[1] = {node};
    bool list = node->kind == VES_NODE_LIST;
    int count = list ? node->count : 1;
    ves_shell_def *shell = reader->shell;
    if (!count)
        ves_reader_error(reader, VES_SYNTAX, node, "the shell is free to move: \"supports\" is empty");
    ves_support_def *support = ves_arena_take(reader->arena, (size_t)count, sizeof *support);
    if (!ves_reader_memory(reader, support)) return;
    for (int k = 0; k < count; k++) read_support(reader, (list ? node->item : single)[k], &support[k]);
    shell->support = support;
    shell->supports = count;
}

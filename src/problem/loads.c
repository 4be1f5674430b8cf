/* shell.cases: what loads it. */
#include <string.h>

#include "problem/reader.h"

static const struct kind {
    const char *name;
    ves_load_kind kind;
    bool at; /* it stands at a curve, an edge or a place; else over parts */
} kinds[] = {{"line", VES_LOAD_LINE, true},
             {"force", VES_LOAD_FORCE, true},
             {"pressure", VES_LOAD_PRESSURE, false},
             {"area", VES_LOAD_AREA, false},
             {"gravity", VES_LOAD_GRAVITY, false}};

enum { KINDS = sizeof kinds / sizeof *kinds };

static void read_fields(ves_reader *reader, const ves_field *field, ves_load_def *load)
{
    const ves_node *node = field->node;
    if (node->kind != VES_NODE_LIST || node->count != 3) {
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" must be three formulas [x, y, z]",
                         field->key->name);
        return;
    }
    for (int k = 0; k < 3; k++) load->formula[k] = ves_reader_shell_field(reader, node->item[k], field->key);
}

static void read_vector(ves_reader *reader, const ves_field *field, ves_load_def *load)
{
    ves_arg arg;
    ves_reader_arg(reader, field, &arg);
    for (int k = 0; k < 3 && arg.count == 3; k++)
        load->formula[k] = reader->number[arg.first - reader->slots + k];
}

/* All parts, or those that are named. */
static void read_over(ves_reader *reader, const ves_node *node, ves_load_def *load)
{
    const ves_shell_def *shell = reader->shell;
    int patches = 0;
    const int *patch = node ? ves_reader_patches(reader, node, &patches) : NULL;
    int count = node ? patches : shell->parts,
        *part = ves_arena_take(reader->arena, (size_t)count, sizeof *part);
    if (!ves_reader_memory(reader, part)) return;
    for (int k = 0; k < count; k++) {
        int index = node ? ves_reader_shell_part(reader, patch[k]) : k;
        if (index >= 0)
            part[load->parts++] = index;
        else if (reader->shell_known)
            ves_reader_error(reader, VES_NAME, node, "\"over\" names \"%s\", which is no part of the shell",
                             reader->patches.name[patch[k]].text);
    }
    load->part = part;
}

static void read_where(ves_reader *reader, const ves_node *node, const ves_fields *f, const struct kind *kind,
                       ves_load_def *load)
{
    const ves_field *at = ves_fields_field(f, "at"), *over = ves_fields_field(f, "over");
    const ves_field *other = kind->at ? over : at;
    if (other->node)
        ves_reader_error(reader, VES_SYNTAX, other->word, "\"%s\" does not go with \"%s\"", other->key->name,
                         kind->name);
    if (!kind->at) {
        read_over(reader, over->node, load);
    } else if (!at->node) {
        if (!at->excused)
            ves_reader_error(reader, VES_NAME, node, "\"%s\" needs \"at\": where it pulls", kind->name);
    } else if (ves_reader_shell_at(reader, at->node, &load->at) && kind->kind == VES_LOAD_LINE &&
               load->at.kind == VES_AT_PLACE) {
        ves_reader_error(reader, VES_SYNTAX, at->node,
                         "\"line\" pulls along a curve or an edge; at a place there is \"force\"");
    }
}

static void read_kind(ves_reader *reader, const ves_node *node, const ves_fields *f, const struct kind *kind,
                      ves_load_def *load)
{
    const ves_field *field = ves_fields_field(f, kind->name);
    load->kind = kind->kind;
    read_where(reader, node, f, kind, load);
    if (kind->kind == VES_LOAD_PRESSURE)
        load->formula[0] = ves_reader_shell_field(reader, field->node, field->key);
    else if (kind->kind == VES_LOAD_LINE || kind->kind == VES_LOAD_AREA)
        read_fields(reader, field, load);
    else
        read_vector(reader, field, load);
    if (kind->kind == VES_LOAD_GRAVITY && reader->shell->E >= 0 && reader->shell->density < 0)
        ves_reader_error(reader, VES_NAME, field->word, "\"gravity\" needs the density of the material");
    for (int k = 0; k < 3; k++) load->varies = load->varies || ves_reader_varies(reader, load->formula[k]);
}

static void read_load(ves_reader *reader, const ves_node *node, ves_load_def *load)
{
    const ves_entry *table = ves_schema_below(ves_schema_find(ves_schema_shell, "cases"));
    ves_fields f;
    int found = 0;
    *load = (ves_load_def){.mark = ves_reader_mark(reader, node)};
    if (!ves_fields_read(reader, node, table, "load", &f)) return;
    bool excused = false;
    for (int k = 0; k < f.count; k++) excused = excused || f.field[k].excused;
    for (int k = 0; k < KINDS; k++)
        if (ves_fields_find(&f, kinds[k].name) && !found++) read_kind(reader, node, &f, &kinds[k], load);
    if (found != 1 && !excused)
        ves_reader_error(
            reader, VES_SYNTAX, node,
            "a load has one of \"line\", \"force\", \"pressure\", \"area\" and \"gravity\", this has %s",
            found ? "several: give one for each" : "none");
}

static void read_case(ves_reader *reader, const ves_named *name, ves_case_def *out)
{
    const ves_node *node = name->value, *const single[1] = {node};
    bool list = node->kind == VES_NODE_LIST;
    int count = list ? node->count : 1;
    *out = (ves_case_def){.name = name->text, .mark = ves_reader_mark(reader, name->word)};
    if (!count) ves_reader_error(reader, VES_SYNTAX, node, "load case \"%s\" has no loads", name->text);
    ves_load_def *load = ves_arena_take(reader->arena, (size_t)count, sizeof *load);
    if (!ves_reader_memory(reader, load)) return;
    for (int k = 0; k < count; k++) read_load(reader, (list ? node->item : single)[k], &load[k]);
    out->load = load;
    out->loads = count;
}

void ves_reader_cases(ves_reader *reader, const ves_node *node)
{
    ves_shell_def *shell = reader->shell;
    int before = reader->errors;
    ves_names_read(reader, node, "load case", false, &reader->cases);
    reader->cases_lost = reader->errors > before;
    ves_case_def *out = ves_arena_take(reader->arena, (size_t)reader->cases.count, sizeof *out);
    if (!ves_reader_memory(reader, out)) return;
    for (int k = 0; k < reader->cases.count; k++) {
        reader->cases.name[k].index = k;
        read_case(reader, &reader->cases.name[k], &out[k]);
    }
    shell->load_case = out;
    shell->cases = reader->cases.count;
}

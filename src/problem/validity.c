/* validity, quadrature. */
#include <math.h>
#include <string.h>

#include "problem/reader.h"

static const ves_field *field(const ves_fields *f, const char *name)
{
    int k = 0;
    while (strcmp(f->field[k].key->name, name)) k++;
    return &f->field[k];
}

/* A vector of the block; unless given, [0, 0, 1]. */
static int read_axis(ves_reader *reader, const ves_field *f)
{
    ves_arg arg;
    if (!f->node) {
        static const double z[3] = {0, 0, 1};
        int first = -1;
        for (int k = 0; k < 3; k++) {
            const ves_formula *formula = ves_formula_constant(z[k], reader->arena);
            if (!ves_reader_memory(reader, formula)) return -1;
            int index = ves_reader_append(reader, formula);
            if (!k) first = index;
        }
        return first;
    }
    ves_reader_arg(reader, f, &arg);
    if (arg.count != 3) return -1;
    double length = 0;
    for (int k = 0; k < 3; k++) {
        double x = ves_reader_value(reader, reader->number[arg.first - reader->slots + k]);
        length += x * x; /* NAN, and no second message, where a number could not be read */
    }
    if (length == 0)
        ves_reader_error(reader, VES_RANGE, f->node, "\"%s\" must not be [0, 0, 0]", f->key->name);
    return arg.first;
}

static void read_radius(ves_reader *reader, const ves_node *node, const ves_entry *table,
                        ves_validity_def *validity)
{
    ves_fields f;
    ves_arg value;
    if (!ves_fields_read(reader, node, table, "least_radius", &f)) return;
    ves_reader_arg(reader, field(&f, "value"), &value);
    validity->least_radius = value.count ? value.first : -1;
    validity->axis = read_axis(reader, field(&f, "axis"));
    const ves_node *over = ves_fields_find(&f, "over");
    if (over) validity->radius_patch = ves_reader_patches(reader, over, &validity->radius_patches);
}

static void read_monotone(ves_reader *reader, const ves_node *node, const ves_entry *table,
                          ves_validity_def *validity)
{
    ves_fields f;
    if (!ves_fields_read(reader, node, table, "monotone", &f)) return;
    validity->monotone = field(&f, "along")->node ? read_axis(reader, field(&f, "along")) : -1;
    const ves_node *over = ves_fields_find(&f, "over");
    if (over) validity->monotone_patch = ves_reader_patches(reader, over, &validity->monotone_patches);
}

void ves_reader_validity(ves_reader *reader, const ves_node *node)
{
    const ves_entry *table = ves_schema_find(ves_schema_root.table, "validity")->table;
    ves_validity_def *validity = &reader->problem->validity;
    ves_fields f;
    *validity = (ves_validity_def){true, true, .least_radius = -1, .axis = -1, .monotone = -1};
    if (!node || !ves_fields_read(reader, node, table, "validity", &f)) return;
    const ves_field *jacobian = field(&f, "jacobian"), *crossing = field(&f, "self_intersection");
    const ves_node *radius = ves_fields_find(&f, "least_radius"), *monotone = ves_fields_find(&f, "monotone");
    if (jacobian->node) validity->jacobian = ves_reader_choice(reader, jacobian->node, jacobian->key) == 0;
    if (crossing->node)
        validity->self_intersection = ves_reader_choice(reader, crossing->node, crossing->key) == 0;
    if (radius) read_radius(reader, radius, ves_schema_find(table, "least_radius")->table, validity);
    if (monotone) read_monotone(reader, monotone, ves_schema_find(table, "monotone")->table, validity);
}

/* Where one number is left to be chosen, with the most that may be. */
static void nodes_check(ves_reader *reader, const ves_node *node)
{
    const int *q = reader->problem->quadrature, patches = reader->problem->patches;
    int u = q[0] ? q[0] : VES_CHOSEN_U, v = q[1] ? q[1] : VES_CHOSEN_V, most = ves_nodes_most(patches);
    if ((!q[0] && !q[1]) || (double)u * v <= most) return;
    ves_reader_error(
        reader, VES_RANGE, node,
        "%d x %d nodes on every patch (%d in all) take too much memory: give at most %d, u times v%s", u, v,
        patches, most,
        q[0] && q[1] ? ""
        : q[0]       ? "; up to 512 along v may be chosen"
                     : "; up to 128 along u may be chosen");
}

void ves_reader_quadrature(ves_reader *reader, const ves_node *node)
{
    const ves_entry *table = ves_schema_find(ves_schema_root.table, "quadrature")->table;
    static const char *const name[2] = {"u", "v"};
    ves_fields f;
    int before = reader->errors;
    if (!node || (node->kind == VES_NODE_WORD && !strcmp(node->text, "auto"))) return;
    if (!ves_fields_read(reader, node, table, "quadrature", &f)) return;
    for (int k = 0; k < 2; k++) {
        const ves_field *x = field(&f, name[k]);
        int count = x->node ? (int)ves_reader_count(reader, x->node, x->key) : 0;
        reader->problem->quadrature[k] = count;
        if (count > 0 && count < VES_NODES_LEAST)
            ves_reader_error(reader, VES_RANGE, x->node,
                             "\"%s\" must be at least %d, got %d; 0, or no \"%s\", has it chosen", name[k],
                             VES_NODES_LEAST, count, name[k]);
    }
    if (reader->errors == before) nodes_check(reader, node);
}

/* Spines that are given: the curve that the means of a patch run along. */
#include "problem/reader.h"

enum { INNER_MOST = 100 }; /* inner control points */

/* Or somewhere that is not known, after an error. */
static bool position_at(const ves_patch_def *patch, double u)
{
    int own = 2 * (patch->lower ? patch->lower : patch->power);
    for (int k = 0; k < own && k < patch->conditions; k++)
        if ((patch->condition[k].u == u && patch->condition[k].derivative == 0) || patch->condition[k].u < 0)
            return true;
    return false;
}

/* {points: [...]}, or the list alone */
static const ves_node *points_of(ves_reader *reader, const ves_field *form)
{
    const ves_entry *patch = ves_schema_find(ves_schema_root.table, "patches")->table->table;
    const ves_entry *spine = ves_schema_find(patch, "spine")->table;
    ves_fields f;
    if (form->node->kind != VES_NODE_MAP) return form->node;
    if (!ves_fields_read(reader, form->node, ves_schema_find(spine, "bspline")->table, "bspline", &f))
        return NULL;
    return ves_fields_find(&f, "points");
}

static void read_vectors(ves_reader *reader, const ves_field *form, const ves_node *list,
                         ves_patch_def *patch)
{
    ves_arg arg;
    int before = reader->errors;
    ves_reader_arg(reader, &(ves_field){.key = form->key, .node = list}, &arg);
    patch->spine_first = arg.first;
    patch->spine_vectors = arg.count / 3;
    if (reader->errors > before) return;
    if (patch->spine == VES_SPINE_BY_HERMITE && patch->spine_vectors != 2)
        ves_reader_error(
            reader, VES_SYNTAX, list,
            "\"hermite\" must be two vectors, the derivatives of the spine at u = 0 and u = 1, found %d",
            patch->spine_vectors);
    else if (patch->spine_vectors < 1 || patch->spine_vectors > INNER_MOST)
        ves_reader_error(reader, VES_RANGE, list,
                         "\"bspline\" must be 1 to %d control points between the ends, found %d", INNER_MOST,
                         patch->spine_vectors);
}

void ves_reader_spine(ves_reader *reader, const ves_field *field, ves_patch_def *patch)
{
    const ves_entry *table = ves_schema_find(ves_schema_root.table, "patches")->table->table;
    ves_fields f;
    if (!ves_fields_read(reader, field->node, ves_schema_find(table, "spine")->table, "spine", &f)) return;
    const ves_field *hermite = ves_fields_field(&f, "hermite"), *bspline = ves_fields_field(&f, "bspline");
    if (hermite->excused || bspline->excused) return;
    if (!hermite->node == !bspline->node) {
        ves_fields_one_of(reader, field->node, &f, "spine", "hermite", "bspline");
        return;
    }
    if (patch->power && (!position_at(patch, 0) || !position_at(patch, 1)))
        ves_reader_error(reader, VES_SYNTAX, field->word,
                         "\"spine\" runs from end to end: the patch needs a position at u = 0 and at u = 1");
    patch->spine = hermite->node ? VES_SPINE_BY_HERMITE : VES_SPINE_BY_BSPLINE;
    const ves_node *list = hermite->node ? hermite->node : points_of(reader, bspline);
    if (list) read_vectors(reader, hermite->node ? hermite : bspline, list, patch);
}

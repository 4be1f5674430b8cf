/* Conditions: what a patch meets at its ends and inside, and by how much it departs from a lower order. */
#include "problem/reader.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PARTS = 80 };

/* What holds for all conditions of one list. */
typedef struct place {
    ves_reader *reader;
    int order;  /* 2N; 0: not known, after an error */
    bool raise; /* they say how far the surface departs */
} place;

/* One condition that is being read. */
typedef struct item {
    const place *at;
    const ves_node *node;
    ves_fields f;
    ves_condition *out;
    bool unclear; /* its derivative could not be read */
    bool nowhere; /* its u could not be read */
} item;

static const ves_entry *item_table(const place *at)
{
    const ves_entry *patch = ves_schema_find(ves_schema_root.table, "patches")->table->table;
    return ves_schema_find(patch, at->raise ? "raise" : "conditions")->table->table;
}

static const ves_node *find(const item *i, const char *name)
{
    return ves_fields_find(&i->f, name);
}

/* The curve of a condition, times its scale, is a length. */
static void check_curve_dim(const item *i, const ves_node *node, ves_dim factor)
{
    ves_reader *reader = i->at->reader;
    ves_dim dim = {0};
    const ves_dim length = {.m = 6};
    const ves_named *curve = node->kind == VES_NODE_WORD ? ves_names_find(&reader->curves, node->text) : NULL;
    if (!reader->dimensions || !curve || curve->index < 0) return;
    if (!ves_dim_multiply(reader->curve[curve->index].dim, factor, 1, &dim) || ves_dim_equal(dim, length))
        return;
    char found[64];
    ves_dim_describe(dim, found);
    ves_reader_error(reader, VES_UNIT, node, "points of \"%s\"%s must be a length (m), found %s", curve->text,
                     find(i, "scale") ? ", times the scale," : "", found);
}

/* --- which keys go together --- */

static bool excused(const item *i)
{
    static const char *const name[] = {"position", "field", "from", "to", "differences", "derivative"};
    for (size_t k = 0; k < sizeof name / sizeof *name; k++)
        if (ves_fields_excused(&i->f, name[k])) return true;
    return false;
}

/* Of those that say what the surface meets. */
static void check_own(const item *i, bool any)
{
    ves_reader *reader = i->at->reader;
    const ves_node *position = find(i, "position");
    int derivative = i->out->derivative;
    if (!any && derivative == 0)
        ves_reader_error(reader, VES_NAME, i->node, "\"condition\" lacks the key \"position\"");
    else if (!any)
        ves_reader_error(reader, VES_NAME, i->node,
                         "\"condition\" lacks \"field\", \"from\" and \"to\", or \"differences\"");
    else if (position && derivative)
        ves_reader_error(reader, VES_SYNTAX, ves_fields_field(&i->f, "position")->word,
                         "a derivative needs \"field\", \"from\" and \"to\", or \"differences\"; "
                         "\"position\" goes without derivative");
    else if (!position && !derivative)
        ves_reader_error(reader, VES_SYNTAX, i->node,
                         "\"field\", \"from\", \"to\" and \"differences\" need \"derivative: 1\" or more");
    else if (position && find(i, "scale"))
        ves_reader_error(reader, VES_SYNTAX, ves_fields_field(&i->f, "scale")->word,
                         "\"scale\" belongs to derivatives, not to a position");
}

/* Of those that say how far it departs: by nothing, unless they say by what. */
static void check_departure(const item *i, bool any)
{
    if (!any && find(i, "scale"))
        ves_reader_error(i->at->reader, VES_NAME, ves_fields_field(&i->f, "scale")->word,
                         "\"scale\" has nothing to scale: \"field\" is missing");
}

static void check_form(const item *i)
{
    ves_reader *reader = i->at->reader;
    const ves_node *from = find(i, "from"), *to = find(i, "to");
    int forms = (find(i, "position") != NULL) + (find(i, "field") != NULL) + (from || to) +
                (find(i, "differences") != NULL);
    if (excused(i)) return;
    if (forms > 1)
        ves_reader_error(reader, VES_SYNTAX, i->node,
                         "a condition is one of position, field, from and to, or differences");
    else if (!from != !to)
        ves_reader_error(reader, VES_NAME, i->node, "\"condition\" lacks the key \"%s\"",
                         from ? "to" : "from");
    else if (i->at->raise)
        check_departure(i, forms > 0);
    else
        check_own(i, forms > 0);
}

/* --- values --- */

static double place_of(item *i)
{
    const ves_field *u = ves_fields_field(&i->f, "u");
    int before = i->at->reader->errors;
    double value = u->node ? ves_reader_constant(i->at->reader, u->node, u->key) : NAN;
    i->nowhere = isnan(value) || i->at->reader->errors > before;
    return value;
}

static int derivative_of(item *i)
{
    const ves_field *d = ves_fields_field(&i->f, "derivative");
    int before = i->at->reader->errors;
    long k = d->node ? ves_reader_count(i->at->reader, d->node, d->key) : 0;
    i->unclear = i->at->reader->errors > before;
    if (i->unclear) return 0;
    if (i->at->order && k >= i->at->order)
        ves_reader_error(i->at->reader, VES_RANGE, d->node,
                         "\"derivative\" must be less than the order of the equation, %d, got %ld",
                         i->at->order, k);
    return (int)k;
}

static ves_dim scale_of(const item *i)
{
    ves_reader *reader = i->at->reader;
    const ves_field *scale = ves_fields_field(&i->f, "scale");
    if (!scale->node) return (ves_dim){0};
    i->out->scale = ves_reader_place(reader, scale->node, scale->key);
    const ves_formula *formula = i->out->scale >= 0 ? reader->number[i->out->scale - reader->slots] : NULL;
    return formula ? ves_formula_dim(formula) : (ves_dim){.any = true};
}

static void share_add(const item *i, ves_share *share, const ves_node *curve, double factor, ves_dim scale)
{
    int index = curve ? ves_reader_curve(i->at->reader, curve) : -1;
    if (index < 0) return;
    i->at->reader->curve_used[index] = true;
    share[i->out->shares++] = (ves_share){index, factor};
    check_curve_dim(i, curve, scale);
}

/* sum_i (-1)^(k-i) C(k, i) p_i, the k-th difference [Ugail 2005, eqs 30-33] */
static void differences(const item *i, const ves_node *list, ves_share *share, ves_dim scale)
{
    double factor = list->count % 2 ? 1 : -1;
    for (int k = 0; k < list->count; k++) {
        share_add(i, share, list->item[k], factor, scale);
        factor *= -(double)(list->count - 1 - k) / (k + 1);
    }
}

static bool check_differences(const item *i, const ves_node *list)
{
    int found = list->kind == VES_NODE_LIST ? list->count : 0, wanted = i->out->derivative + 1;
    if (found && (found == wanted || i->unclear)) return true;
    if (!found)
        ves_reader_error(i->at->reader, VES_SYNTAX, list,
                         "\"differences\" must be a list of curves [p0, p1, ...]");
    else if (i->out->derivative || i->at->raise)
        ves_reader_error(i->at->reader, VES_SYNTAX, list,
                         "\"differences\" for derivative %d needs %d curve%s, found %d", i->out->derivative,
                         wanted, wanted == 1 ? "" : "s", found);
    return false;
}

static void shares_of(const item *i, ves_dim scale)
{
    static const char *const plain[] = {"position", "field", "to"};
    const ves_node *list = find(i, "differences");
    bool differs = list && check_differences(i, list);
    ves_share *share =
        ves_arena_take(i->at->reader->arena, (size_t)(differs ? list->count : 4), sizeof *share);
    if (!ves_reader_memory(i->at->reader, share)) return;
    i->out->share = share;
    if (differs) {
        differences(i, list, share, scale);
        return;
    }
    for (int k = 0; k < 3; k++) share_add(i, share, find(i, plain[k]), 1, scale);
    share_add(i, share, find(i, "from"), -1, scale);
}

static void read_condition(const place *at, const ves_node *node, ves_condition *out)
{
    item i = {.at = at, .node = node, .out = out};
    *out = (ves_condition){.mark = ves_reader_mark(at->reader, node), .scale = -1, .u = -1};
    if (!ves_fields_read(at->reader, node, item_table(at), at->raise ? "raise" : "condition", &i.f)) return;
    out->u = place_of(&i);
    out->derivative = derivative_of(&i);
    if (!i.unclear) check_form(&i);
    shares_of(&i, scale_of(&i));
    if (i.unclear || i.nowhere) out->u = -1; /* nothing more is said of where it stands */
}

/* --- all of a patch --- */

/* Of those from the first on, with all before them; joins have no line in the patch that would name it. */
static void check_twice(ves_reader *reader, const ves_patch_def *patch, int first, bool joined)
{
    const char *by = joined ? ": by \"joins\", patch " : "", *name = joined ? patch->name : "";
    for (int k = first; k < patch->conditions; k++)
        for (int i = 0; i < k; i++) {
            const ves_condition *a = &patch->condition[i], *b = &patch->condition[k];
            if (a->u != b->u || a->derivative != b->derivative || a->u < 0) continue;
            if (b->derivative > 1)
                ves_reader_fail(reader, VES_SINGULAR, b->mark, "derivative %d at u = %g is given twice%s%s",
                                b->derivative, b->u, by, name);
            else
                ves_reader_fail(reader, VES_SINGULAR, b->mark, "the %s at u = %g is given twice%s%s",
                                b->derivative ? "derivative" : "position", b->u, by, name);
            break;
        }
}

static bool is_list(ves_reader *reader, const ves_node *list, const char *name, const char *example)
{
    if (list->kind == VES_NODE_LIST) return true;
    ves_reader_error(reader, VES_SYNTAX, list, "\"%s\" must be a list [%s, ...]", name, example);
    return false;
}

/* Room for more conditions behind those that are there; NULL: no memory. */
static ves_condition *make_room(ves_reader *reader, int more, ves_patch_def *patch)
{
    int before = patch->conditions;
    ves_condition *condition = ves_arena_take(reader->arena, (size_t)(before + more), sizeof *condition);
    if (!ves_reader_memory(reader, condition)) return NULL;
    for (int k = 0; k < before; k++) condition[k] = patch->condition[k];
    patch->condition = condition;
    patch->conditions += more;
    return condition + before;
}

/* Appends the conditions of a list. */
static void read_list(const place *at, const ves_node *list, ves_patch_def *patch)
{
    int before = patch->conditions;
    if (before + list->count > VES_CONDITIONS_MAX) return; /* somebody has complained */
    ves_condition *condition = make_room(at->reader, list->count, patch);
    for (int k = 0; condition && k < list->count; k++) read_condition(at, list->item[k], &condition[k]);
    check_twice(at->reader, patch, before, false);
}

/* Appends those that joins ask for. */
static void add_joined(ves_reader *reader, int index, int joined, ves_patch_def *patch)
{
    int before = patch->conditions;
    if (joined <= 0 || before + joined > VES_CONDITIONS_MAX) return;
    ves_condition *condition = make_room(reader, joined, patch);
    if (condition) ves_reader_joined(reader, index, condition);
    check_twice(reader, patch, before, true);
}

/* ": 4 by sections, 2 by joins", where it is not the list alone that counts. */
static void parts(int sections, int listed, int joined, char text[PARTS])
{
    int at = 0, count[] = {sections, listed, joined};
    static const char *const what[] = {"sections", "conditions", "joins"};
    text[0] = 0;
    for (int k = 0; k < 3 && (sections || joined); k++)
        if (count[k])
            at +=
                snprintf(text + at, (size_t)(PARTS - at), "%s%d by %s", at ? ", " : ": ", count[k], what[k]);
}

static void check_count(ves_reader *reader, const ves_named *name, int listed, int joined,
                        const ves_patch_def *patch)
{
    int wanted = 2 * patch->power, found = patch->conditions + listed + joined;
    char text[PARTS];
    if (!wanted || found == wanted || joined < 0) return;
    parts(patch->conditions, listed, joined, text);
    const ves_node *sections = ves_node_find(name->value, "sections");
    const ves_node *count = !sections                           ? NULL
                            : ves_node_find(sections, "curves") ? ves_node_find(sections, "curves")
                                                                : ves_node_find(sections, "count");
    if (count && found % 2 && found < VES_CONDITIONS_MAX) {
        ves_reader_error(reader, VES_SINGULAR, count,
                         "the conditions of patch \"%s\" must be an even number, found %d%s", name->text,
                         found, text);
        return;
    }
    ves_reader_error(reader, VES_SINGULAR, name->word,
                     "patch \"%s\" of order %d needs %d conditions, found %d%s", name->text, wanted, wanted,
                     found, text);
}

void ves_reader_conditions(ves_reader *reader, const ves_named *name, const ves_node *list,
                           ves_patch_def *patch)
{
    int index = (int)(name - reader->patches.name), joined = ves_reader_joined(reader, index, NULL);
    if (list && !is_list(reader, list, "conditions", "{u: 0, position: CURVE}")) return;
    check_count(reader, name, list ? list->count : 0, joined, patch);
    if (list) read_list(&(place){reader, 2 * patch->power, false}, list, patch);
    add_joined(reader, index, joined, patch);
}

/* From order 2N to 2N' without a change of the surface, then away from it [Kubiesa 2004, 5.2]. */
void ves_reader_raise(ves_reader *reader, const ves_field *field, ves_patch_def *patch)
{
    const ves_node *list = field->node;
    if (!is_list(reader, list, "raise", "{u: 0, derivative: 2, field: CURVE}")) return;
    int power = patch->power + list->count / 2;
    if (patch->general)
        ves_reader_error(
            reader, VES_SYNTAX, field->word,
            "\"raise\" goes with \"power\": the solutions of other operators are not among those of "
            "a higher order");
    else if (list->count % 2 || !list->count)
        ves_reader_error(reader, VES_SINGULAR, list,
                         "\"raise\" needs an even number of conditions, two for each power, found %d",
                         list->count);
    else if (power > VES_POWER_MAX)
        ves_reader_error(reader, VES_RANGE, list, "\"raise\" leads to power %d: %d is the highest", power,
                         VES_POWER_MAX);
    if (patch->general || power > VES_POWER_MAX) return;
    read_list(&(place){reader, patch->power ? 2 * power : 0, true}, list, patch);
    if (patch->power) patch->lower = patch->power, patch->power = power;
}

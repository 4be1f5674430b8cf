/* patches, places, shape. */
#include <string.h>

#include "base/vector.h"
#include "formula/dimension.h"
#include "problem/reader.h"

static const ves_entry *patch_table(void)
{
    return ves_schema_find(ves_schema_root.table, "patches")->table->table;
}

static int number_at(ves_reader *reader, const ves_fields *fields, int index)
{
    ves_arg arg;
    ves_reader_arg(reader, &fields->field[index], &arg);
    return arg.count ? arg.first : -1;
}

/* Position of a key in the fields. */
static int at(const ves_fields *fields, const char *name)
{
    int k = 0;
    while (k < fields->count && strcmp(fields->field[k].key->name, name)) k++;
    return k;
}

/* The curve of a condition, times its scale, is a length. */
static void check_curve_dim(ves_reader *reader, const ves_fields *fields, const char *key, ves_dim factor)
{
    ves_dim dim = {0};
    const ves_dim length = {.m = 6};
    const ves_node *node = ves_fields_find(fields, key);
    const ves_named *curve =
        node && node->kind == VES_NODE_WORD ? ves_names_find(&reader->curves, node->text) : NULL;
    if (!reader->dimensions || !curve || curve->index < 0) return;
    if (!ves_dim_multiply(reader->curve[curve->index].dim, factor, 1, &dim) || ves_dim_equal(dim, length))
        return;
    char found[64];
    bool scaled = ves_fields_find(fields, "scale");
    ves_dim_describe(dim, found);
    ves_reader_error(reader, VES_UNIT, node, "points of \"%s\"%s must be a length (m), found %s", curve->text,
                     scaled ? ", times the scale," : "", found);
}

static int curve_at(ves_reader *reader, const ves_fields *fields, const char *name)
{
    const ves_node *node = ves_fields_find(fields, name);
    int index = node ? ves_reader_curve(reader, node) : -1;
    if (index >= 0) reader->curve_used[index] = true;
    return index;
}

/* The three ways of writing a condition; what does not belong together is an error. */
static void check_form(ves_reader *reader, const ves_node *node, const ves_fields *fields, int derivative)
{
    const ves_node *position = ves_fields_find(fields, "position"), *field = ves_fields_find(fields, "field"),
                   *from = ves_fields_find(fields, "from"), *to = ves_fields_find(fields, "to");
    int forms = (position != NULL) + (field != NULL) + (from || to);
    static const char *const names[] = {"position", "field", "from", "to", "derivative"};
    for (int k = 0; k < 5; k++)
        if (ves_fields_excused(fields, names[k])) return;
    if (forms > 1)
        ves_reader_error(reader, VES_SYNTAX, node, "a condition is one of position, field, or from and to");
    else if (!forms && derivative == 0)
        ves_reader_error(reader, VES_NAME, node, "\"condition\" lacks the key \"position\"");
    else if (!forms)
        ves_reader_error(reader, VES_NAME, node, "\"condition\" lacks \"field\", or \"from\" and \"to\"");
    else if (!position && (!from != !to))
        ves_reader_error(reader, VES_NAME, node, "\"condition\" lacks the key \"%s\"", from ? "to" : "from");
    else if (position && derivative)
        ves_reader_error(
            reader, VES_SYNTAX, fields->field[at(fields, "position")].word,
            "a derivative needs \"field\", or \"from\" and \"to\"; \"position\" goes without derivative");
    else if (!position && !derivative)
        ves_reader_error(reader, VES_SYNTAX, node, "\"field\", \"from\" and \"to\" need \"derivative: 1\"");
    else if (position && ves_fields_find(fields, "scale"))
        ves_reader_error(reader, VES_SYNTAX, fields->field[at(fields, "scale")].word,
                         "\"scale\" belongs to derivatives, not to a position");
}

static double end_of(ves_reader *reader, const ves_field *field)
{
    if (!field->node) return 0;
    double u = ves_reader_constant(reader, field->node, field->key);
    if (u > 0 && u < 1)
        ves_reader_error(reader, VES_ABSENT, field->node,
                         "conditions inside a patch are not in this version yet: u must be 0 or 1");
    else if (u != 0 && u != 1 && u == u)
        ves_reader_error(reader, VES_RANGE, field->node, "\"u\" must be 0 or 1, the ends of the patch");
    return u;
}

static int derivative_of(ves_reader *reader, const ves_field *field)
{
    long k = field->node ? ves_reader_count(reader, field->node, field->key) : 0;
    if (k > 1)
        ves_reader_error(reader, VES_ABSENT, field->node,
                         "second and higher derivatives are not in this version yet");
    return (int)(k > 1 || k < 0 ? 1 : k);
}

/* curve - from */
static void read_shares(ves_reader *reader, int curve, int from, ves_condition *out)
{
    ves_share *share = ves_arena_take(reader->arena, 2, sizeof *share);
    if (!ves_reader_memory(reader, share)) return;
    out->share = share;
    if (curve >= 0) share[out->shares++] = (ves_share){curve, 1};
    if (from >= 0) share[out->shares++] = (ves_share){from, -1};
}

static void read_condition(ves_reader *reader, const ves_node *node, ves_condition *out)
{
    ves_fields f;
    *out = (ves_condition){.mark = ves_reader_mark(reader, node), .scale = -1, .u = -1};
    const ves_entry *table = ves_schema_find(patch_table(), "conditions")->table->table;
    if (!ves_fields_read(reader, node, table, "condition", &f)) return;
    out->u = end_of(reader, &f.field[at(&f, "u")]);
    out->derivative = derivative_of(reader, &f.field[at(&f, "derivative")]);
    check_form(reader, node, &f, out->derivative);
    int position = curve_at(reader, &f, "position"), field = curve_at(reader, &f, "field"),
        to = curve_at(reader, &f, "to");
    int from = curve_at(reader, &f, "from"), curve = position >= 0 ? position : field >= 0 ? field : to;
    read_shares(reader, curve, from, out);
    ves_dim factor = {0};
    if (ves_fields_find(&f, "scale")) {
        out->scale = number_at(reader, &f, at(&f, "scale"));
        const ves_formula *formula = out->scale >= 0 ? reader->number[out->scale - reader->slots] : NULL;
        factor = formula ? ves_formula_dim(formula) : (ves_dim){.any = true};
    }
    static const char *const curves[] = {"position", "field", "from", "to"};
    for (int k = 0; k < 4; k++) check_curve_dim(reader, &f, curves[k], factor);
}

static void check_twice(ves_reader *reader, const ves_patch_def *patch, const ves_node *list)
{
    for (int k = 0; k < patch->conditions; k++)
        for (int i = 0; i < k; i++) {
            const ves_condition *a = &patch->condition[i], *b = &patch->condition[k];
            if (a->u != b->u || a->derivative != b->derivative || a->u < 0) continue;
            ves_reader_error(reader, VES_SINGULAR, list->item[k], "%s at u = %g is given twice",
                             a->derivative ? "the derivative" : "the position", a->u);
            break;
        }
}

static void read_conditions(ves_reader *reader, const ves_named *name, const ves_node *list,
                            ves_patch_def *patch)
{
    int wanted = 2 * patch->power;
    if (list->kind != VES_NODE_LIST) {
        ves_reader_error(reader, VES_SYNTAX, list,
                         "\"conditions\" must be a list [{u: 0, position: CURVE}, ...]");
        return;
    }
    if (patch->power && list->count != wanted)
        ves_reader_error(reader, VES_SINGULAR, name->word,
                         "patch \"%s\" of power %d needs %d conditions, found %d", name->text, patch->power,
                         wanted, list->count);
    if (list->count > 8) return;
    ves_condition *condition = ves_arena_take(reader->arena, (size_t)list->count, sizeof *condition);
    if (!ves_reader_memory(reader, condition)) return;
    for (int k = 0; k < list->count; k++) read_condition(reader, list->item[k], &condition[k]);
    patch->condition = condition;
    patch->conditions = list->count;
    check_twice(reader, patch, list);
}

static void read_operator(ves_reader *reader, const ves_node *node, ves_patch_def *patch)
{
    ves_fields f;
    patch->operators = 1;
    if (!ves_fields_read(reader, node, ves_schema_find(patch_table(), "operator")->table, "operator", &f))
        return;
    ves_field power = f.field[at(&f, "power")];
    ves_key open = *power.key;
    open.min = open.max = 0;
    int before = reader->errors;
    long value = power.node ? ves_reader_count(reader, power.node, &open) : 0;
    if (value > 2)
        ves_reader_error(reader, VES_ABSENT, power.node,
                         "operators of power 3 and more are not in this version yet");
    else if (power.node && value < 1 && reader->errors == before)
        ves_reader_error(reader, VES_RANGE, power.node, "\"power\" must be 1 or 2");
    patch->power = value == 1 || value == 2 ? (int)value : 0;
    patch->parameter[0] = number_at(reader, &f, at(&f, "a"));
}

static void read_pde(ves_reader *reader, const ves_named *name, const ves_fields *f, ves_patch_def *patch)
{
    static const char *const only_surface[] = {"periodic", "domain"};
    const ves_node *pde = ves_fields_find(f, "operator"), *conditions = ves_fields_find(f, "conditions"),
                   *modes = ves_fields_find(f, "modes");
    for (int k = 0; k < 2; k++)
        if (ves_fields_find(f, only_surface[k]))
            ves_reader_error(reader, VES_SYNTAX, f->field[at(f, only_surface[k])].word,
                             "\"%s\" belongs to a patch with \"surface\"", only_surface[k]);
    if (!pde)
        ves_reader_error(reader, VES_NAME, name->word, "patch \"%s\" lacks \"operator\" (or \"surface\")",
                         name->text);
    else
        read_operator(reader, pde, patch);
    if (!conditions)
        ves_reader_error(reader, VES_NAME, name->word, "patch \"%s\" lacks \"conditions\"", name->text);
    else
        read_conditions(reader, name, conditions, patch);
    if (modes) patch->modes = (int)ves_reader_count(reader, modes, f->field[at(f, "modes")].key);
    patch->kind = VES_PATCH_PDE;
    patch->periodic = true;
}

enum { POINTS_MOST = 1000 }; /* of a side: splines through n points take n^2 numbers */

/* All rows equally long, at least two of each. */
static bool check_grid(ves_reader *reader, const ves_node *node, ves_patch_def *patch)
{
    patch->rows = node->kind == VES_NODE_LIST ? node->count : 0;
    patch->columns = patch->rows && node->item[0]->kind == VES_NODE_LIST ? node->item[0]->count : 0;
    if (patch->rows < 2 || patch->columns < 2) {
        ves_reader_error(reader, VES_SYNTAX, node,
                         "\"points\" must be rows of points [[[x, y, z], ...], ...], at least two of each");
        return false;
    }
    if (patch->rows > POINTS_MOST || patch->columns > POINTS_MOST) {
        ves_reader_error(reader, VES_RANGE, node,
                         "\"points\" must be at most %d rows of at most %d, got %d of %d", POINTS_MOST,
                         POINTS_MOST, patch->rows, patch->columns);
        return false;
    }
    for (int k = 1; k < patch->rows; k++) {
        int count = node->item[k]->kind == VES_NODE_LIST ? node->item[k]->count : 0;
        if (count == patch->columns) continue;
        ves_reader_error(reader, VES_SYNTAX, node->item[k], "this row has %d point%s, the first has %d",
                         count, count == 1 ? "" : "s", patch->columns);
        return false;
    }
    return true;
}

static void read_grid(ves_reader *reader, const ves_node *node, ves_patch_def *patch)
{
    const ves_key row = {.name = "points", .kind = VES_POINTS, .unit = "m"};
    patch->kind = VES_PATCH_POINTS;
    if (!check_grid(reader, node, patch)) return;
    for (int k = 0; k < patch->rows; k++) {
        ves_arg arg;
        const ves_field field = {.key = &row, .node = node->item[k]};
        ves_reader_arg(reader, &field, &arg);
        if (!k) patch->points = arg.first;
    }
}

static void read_span(ves_reader *reader, const ves_fields *f, const char *name, double span[2])
{
    const ves_node *node = ves_fields_find(f, name);
    const ves_key key = {.name = name, .kind = VES_NUMBER, .unit = "1"};
    if (!node) return;
    if (node->kind != VES_NODE_LIST || node->count != 2) {
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" must be [from, to]", name);
        return;
    }
    for (int k = 0; k < 2; k++) span[k] = ves_reader_constant(reader, node->item[k], &key);
    if (span[0] >= span[1])
        ves_reader_error(reader, VES_RANGE, node, "\"%s\" must be [from, to] with from < to", name);
}

static void read_surface(ves_reader *reader, const ves_node *node, const ves_fields *outer,
                         ves_patch_def *patch)
{
    ves_fields f;
    for (int k = 0; k < outer->count; k++) {
        const char *name = outer->field[k].key->name;
        bool pde = !strcmp(name, "operator") || !strcmp(name, "conditions") || !strcmp(name, "modes");
        if (pde && outer->field[k].node)
            ves_reader_error(reader, VES_SYNTAX, outer->field[k].word, "\"%s\" does not go with \"surface\"",
                             name);
    }
    if (!ves_fields_read(reader, node, ves_schema_find(patch_table(), "surface")->table, "surface", &f))
        return;
    const ves_node *formula = ves_fields_find(&f, "formula"), *points = ves_fields_find(&f, "points");
    if (!formula == !points)
        ves_reader_error(reader, VES_SYNTAX, node, "\"surface\" needs one of \"formula\" and \"points\"");
    else if (points)
        read_grid(reader, points, patch);
    if (!formula) return;
    ves_arg arg;
    const ves_key key = {.name = "formula", .kind = VES_FORMULAS, .unit = "m"};
    const ves_field field = {.key = &key, .node = formula};
    reader->surface = true;
    ves_reader_arg(reader, &field, &arg);
    reader->surface = false;
    patch->kind = VES_PATCH_FORMULA;
    for (int k = 0; k < 3 && arg.formula; k++) patch->formula[k] = arg.formula[k];
}

static void read_explicit(ves_reader *reader, const ves_node *surface, const ves_fields *f,
                          ves_patch_def *patch)
{
    const ves_node *periodic = ves_fields_find(f, "periodic"), *domain = ves_fields_find(f, "domain");
    read_surface(reader, surface, f, patch);
    patch->periodic = !periodic || ves_reader_flag(reader, periodic, f->field[at(f, "periodic")].key);
    patch->u_range[1] = 1;
    patch->v_range[1] = VES_TWO_PI;
    ves_fields d;
    if (!domain ||
        !ves_fields_read(reader, domain, ves_schema_find(patch_table(), "domain")->table, "domain", &d))
        return;
    if (patch->kind == VES_PATCH_POINTS)
        ves_reader_error(reader, VES_SYNTAX, domain, "\"domain\" belongs to a surface by formula");
    read_span(reader, &d, "u", patch->u_range);
    read_span(reader, &d, "v", patch->v_range);
}

static void read_patch(ves_reader *reader, ves_named *name, ves_patch_def *patch)
{
    ves_fields f;
    *patch = (ves_patch_def){.name = name->text,
                             .mark = ves_reader_mark(reader, name->word),
                             .parameter = {-1, -1, -1},
                             .omega = -1,
                             .points = -1};
    if (!ves_fields_read(reader, name->value, patch_table(), "patch", &f)) return;
    const ves_node *surface = ves_fields_find(&f, "surface");
    if (surface)
        read_explicit(reader, surface, &f, patch);
    else
        read_pde(reader, name, &f, patch);
}

void ves_reader_patches_section(ves_reader *reader, const ves_fields *root)
{
    (void)root;
    ves_problem *problem = reader->problem;
    ves_patch_def *patch = ves_arena_take(reader->arena, (size_t)reader->patches.count, sizeof *patch);
    if (!ves_reader_memory(reader, patch)) return;
    for (int k = 0; k < reader->patches.count; k++) read_patch(reader, &reader->patches.name[k], &patch[k]);
    problem->patch = patch;
    problem->patches = reader->patches.count;
    const ves_node *section = ves_fields_find(root, "patches");
    if (section && section->kind == VES_NODE_MAP && !section->count)
        ves_reader_error(reader, VES_SYNTAX, section, "\"patches\" is empty: a shape needs at least one");
}

static void read_place(ves_reader *reader, const ves_named *name, ves_place *place)
{
    ves_fields f;
    int patches = 0;
    const ves_entry *table = ves_schema_find(ves_schema_root.table, "places")->table->table;
    *place = (ves_place){
        .name = name->text, .mark = ves_reader_mark(reader, name->word), .patch = -1, .u = -1, .v = -1};
    if (!ves_fields_read(reader, name->value, table, "place", &f)) return;
    const ves_node *patch = ves_fields_find(&f, "patch");
    const int *ref = patch ? ves_reader_patches(reader, patch, &patches) : NULL;
    if (patches > 1) ves_reader_error(reader, VES_SYNTAX, patch, "a place lies on one patch");
    if (patches == 1) place->patch = ref[0];
    place->u = number_at(reader, &f, at(&f, "u"));
    place->v = number_at(reader, &f, at(&f, "v"));
}

void ves_reader_places(ves_reader *reader, const ves_fields *root)
{
    (void)root;
    ves_problem *problem = reader->problem;
    ves_place *place = ves_arena_take(reader->arena, (size_t)reader->places.count, sizeof *place);
    if (!ves_reader_memory(reader, place)) return;
    for (int k = 0; k < reader->places.count; k++) {
        const ves_named *name = &reader->places.name[k];
        if (ves_names_find(&reader->curves, name->text))
            ves_reader_error(reader, VES_NAME, name->word,
                             "\"%s\" is a curve already; places and curves are named in the same keys",
                             name->text);
        read_place(reader, name, &place[k]);
    }
    problem->place = place;
    problem->places = reader->places.count;
}

/* wall.u0 */
static bool read_end(ves_reader *reader, const ves_node *node, ves_end *end)
{
    *end = (ves_end){.mark = ves_reader_mark(reader, node), .patch = -1};
    if (!ves_reader_word(reader, node, "end of a patch, as in wall.u0")) return false;
    const char *dot = strrchr(node->text, '.');
    bool first = dot && !strcmp(dot, ".u0"), last = dot && !strcmp(dot, ".u1");
    if (!first && !last) {
        ves_reader_error(reader, VES_SYNTAX, node,
                         "expected an end of a patch, as in wall.u0 or wall.u1, found \"%.80s\"", node->text);
        return false;
    }
    ves_node patch = *node;
    patch.text = ves_arena_text(reader->arena, node->text, (size_t)(dot - node->text));
    if (!ves_reader_memory(reader, patch.text)) return false;
    const ves_named *found = ves_names_ask(reader, &reader->patches, &patch);
    if (!found) return false;
    end->patch = found->index;
    end->end = last;
    return true;
}

static void read_caps(ves_reader *reader, const ves_node *node, ves_shape_def *shape)
{
    const ves_node *const single[1] = {node};
    bool list = node->kind == VES_NODE_LIST;
    const ves_node *const *item = list ? node->item : single;
    int count = list ? node->count : 1;
    ves_end *end = ves_arena_take(reader->arena, (size_t)count, sizeof *end);
    if (!ves_reader_memory(reader, end)) return;
    for (int k = 0; k < count; k++) {
        if (!read_end(reader, item[k], &end[shape->caps])) continue;
        bool twice = false;
        for (int i = 0; i < shape->caps; i++)
            twice = twice || (end[i].patch == end[shape->caps].patch && end[i].end == end[shape->caps].end);
        if (twice)
            ves_reader_error(reader, VES_NAME, item[k], "\"%s\" is named twice", item[k]->text);
        else
            shape->caps++;
    }
    shape->cap = end;
}

void ves_reader_shape(ves_reader *reader, const ves_node *node)
{
    ves_fields f;
    ves_shape_def *shape = &reader->problem->shape;
    shape->mark = ves_reader_mark(reader, node);
    if (!node ||
        !ves_fields_read(reader, node, ves_schema_find(ves_schema_root.table, "shape")->table, "shape", &f))
        return;
    const ves_node *closed = ves_fields_find(&f, "closed"), *caps = ves_fields_find(&f, "caps");
    if (closed) shape->closed = ves_reader_flag(reader, closed, f.field[at(&f, "closed")].key);
    if (caps) read_caps(reader, caps, shape);
}

/* patches, places, shape. */
#include <string.h>

#include "base/text.h"
#include "base/vector.h"
#include "problem/reader.h"

static const ves_entry *patch_table(void)
{
    return ves_schema_find(ves_schema_root.table, "patches")->table->table;
}

static int number_at(ves_reader *reader, const ves_fields *fields, const char *name)
{
    ves_arg arg;
    ves_reader_arg(reader, ves_fields_field(fields, name), &arg);
    return arg.count ? arg.first : -1;
}

/* What a patch may have besides operator and conditions. */
static void read_rest(ves_reader *reader, const ves_fields *f, ves_patch_def *patch)
{
    const ves_field *modes = ves_fields_field(f, "modes"), *remainder = ves_fields_field(f, "remainder"),
                    *raise = ves_fields_field(f, "raise"), *spine = ves_fields_field(f, "spine");
    if (modes->node && remainder->node)
        ves_reader_error(reader, VES_SYNTAX, modes->word,
                         "\"modes\" stands here and \"remainder\" has it too: give it once");
    if (modes->node) patch->modes = (int)ves_reader_count(reader, modes->node, modes->key);
    if (remainder->node) ves_reader_remainder(reader, remainder->node, patch);
    if (raise->node) ves_reader_raise(reader, raise, patch);
    if (spine->node) ves_reader_spine(reader, spine, patch);
}

/* Sections tell the order, together with what else the surface meets, unless the operator does. */
static bool read_sections(ves_reader *reader, const ves_named *name, const ves_node *node,
                          const ves_node *conditions, ves_patch_def *patch)
{
    ves_condition *condition = ves_arena_take(reader->arena, VES_CONDITIONS_MAX, sizeof *condition);
    if (!ves_reader_memory(reader, condition)) return false;
    int joined = ves_reader_joined(reader, (int)(name - reader->patches.name), NULL);
    int all = patch->conditions = ves_reader_sections(reader, node, condition);
    if (conditions && conditions->kind == VES_NODE_LIST) all += conditions->count;
    if (joined > 0) all += joined;
    patch->power = all < VES_CONDITIONS_MAX ? (all + 1) / 2 : VES_POWER_MAX;
    patch->condition = condition;
    return patch->conditions > 0;
}

static void read_pde(ves_reader *reader, const ves_named *name, const ves_fields *f, ves_patch_def *patch)
{
    static const char *const only_surface[] = {"periodic", "domain"};
    const ves_node *pde = ves_fields_find(f, "operator"), *conditions = ves_fields_find(f, "conditions"),
                   *sections = ves_fields_find(f, "sections");
    for (int k = 0; k < 2; k++)
        if (ves_fields_find(f, only_surface[k]))
            ves_reader_error(reader, VES_SYNTAX, ves_fields_field(f, only_surface[k])->word,
                             "\"%s\" belongs to a patch with \"surface\"", only_surface[k]);
    patch->kind = VES_PATCH_PDE;
    patch->periodic = true;
    if (sections && !read_sections(reader, name, sections, conditions, patch)) return;
    if (!pde && !sections)
        ves_reader_error(reader, VES_NAME, name->word, "patch \"%s\" lacks \"operator\" (or \"surface\")",
                         name->text);
    else
        ves_reader_operator(reader, pde, patch);
    if (!conditions && !sections)
        ves_reader_error(reader, VES_NAME, name->word, "patch \"%s\" lacks \"conditions\"", name->text);
    else
        ves_reader_conditions(reader, name, conditions, patch);
    read_rest(reader, f, patch);
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
        bool pde = ves_words_find("operator|conditions|sections|modes|remainder|raise|spine", name) >= 0;
        if (pde && outer->field[k].node)
            ves_reader_error(reader, VES_SYNTAX, outer->field[k].word, "\"%s\" does not go with \"surface\"",
                             name);
    }
    if (!ves_fields_read(reader, node, ves_schema_find(patch_table(), "surface")->table, "surface", &f))
        return;
    const ves_node *formula = ves_fields_find(&f, "formula"), *points = ves_fields_find(&f, "points");
    if (!formula == !points)
        ves_fields_one_of(reader, node, &f, "surface", "formula", "points");
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
    patch->periodic = !periodic || ves_reader_flag(reader, periodic, ves_fields_field(f, "periodic")->key);
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
    place->u = number_at(reader, &f, "u");
    place->v = number_at(reader, &f, "v");
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
bool ves_reader_end(ves_reader *reader, const ves_node *node, ves_end *end)
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
        if (!ves_reader_end(reader, item[k], &end[shape->caps])) continue;
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
    if (closed) shape->closed = ves_reader_flag(reader, closed, ves_fields_field(&f, "closed")->key);
    if (caps) read_caps(reader, caps, shape);
}

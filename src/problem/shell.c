/* shell: its parts, what they are made of, its meshes. */
#include <math.h>
#include <string.h>

#include "problem/material.h"
#include "problem/reader.h"

enum { NODES_MOST = 1 << 17 }; /* of a part: more would not fit into any machine that a search runs on */

const ves_formula *ves_reader_shell_field(ves_reader *reader, const ves_node *node, const ves_key *key)
{
    static const ves_dim length = {.m = 6}, plain = {0};
    const ves_symbol symbol[VES_SHELL_ARGUMENTS] = {
        {"x", length}, {"y", length}, {"z", length}, {"u", plain}, {"v", plain}};
    return ves_reader_pointwise(reader, node, key, symbol, VES_SHELL_ARGUMENTS);
}

/* One number for both directions, or one for each. */
static void read_elements(ves_reader *reader, const ves_field *field, int elements[2])
{
    const ves_node *node = field->node;
    ves_key count = *field->key;
    count.kind = VES_COUNT;
    if (!node) return;
    if (node->kind == VES_NODE_LIST && node->count != 2) {
        ves_reader_error(reader, VES_SYNTAX, node,
                         "\"elements\" must be one number, or two, along u and v, found %d", node->count);
        return;
    }
    for (int k = 0; k < 2; k++) {
        bool list = node->kind == VES_NODE_LIST;
        if (k && !list)
            elements[1] = elements[0];
        else
            elements[k] = (int)ves_reader_count(reader, list ? node->item[k] : node, &count);
    }
}

/* An order that is left to be chosen is taken for 2. */
static void check_size(ves_reader *reader, const ves_node *node, int order, const int elements[2])
{
    int p = order ? order : 2;
    double nodes = (1.0 + p * elements[0]) * (1.0 + p * elements[1]);
    if (node && nodes > NODES_MOST)
        ves_reader_error(reader, VES_RANGE, node,
                         "%d x %d elements of order %d have %.0f nodes: a part may have %d at most",
                         elements[0], elements[1], p, nodes, NODES_MOST);
}

/* --- parts --- */

static bool reads_position(const ves_formula *formula)
{
    for (int k = 0; k < VES_SHELL_ARGUMENTS; k++)
        if (ves_formula_uses_argument(formula, k)) return true;
    return false;
}

static void read_thickness(ves_reader *reader, const ves_field *field, ves_shell_part_def *part)
{
    ves_key everywhere = *field->key;
    ves_key somewhere = *field->key;
    if (!field->node) return;
    somewhere.unit = NULL;
    part->thickness = ves_reader_shell_field(reader, field->node, &somewhere);
    if (!part->thickness) return;
    part->text = field->node->text;
    part->varies = ves_reader_varies(reader, part->thickness);
    everywhere.kind = VES_NUMBER;
    everywhere.min = VES_POSITIVE;
    everywhere.max = HUGE_VAL;
    if (reads_position(part->thickness))
        ves_reader_check_dim(reader, field->node, field->key->name, field->key->unit,
                             ves_formula_dim(part->thickness));
    else
        part->uniform = ves_reader_place(reader, field->node, &everywhere);
}

static void read_part(ves_reader *reader, const ves_node *word, const ves_node *value,
                      ves_shell_part_def *part)
{
    const ves_entry *table = ves_schema_below(ves_schema_find(ves_schema_shell, "parts"));
    const ves_named *patch = ves_names_ask(reader, &reader->patches, word);
    ves_fields f;
    *part = (ves_shell_part_def){
        .patch = patch ? patch->index : -1, .mark = ves_reader_mark(reader, word), .uniform = -1};
    if (!ves_fields_read(reader, value, table, "part", &f)) return;
    read_thickness(reader, ves_fields_field(&f, "thickness"), part);
    read_elements(reader, ves_fields_field(&f, "elements"), part->elements);
}

/* After errors conditions lack their curves. */
static bool ends_known(const ves_patch_def *patch)
{
    bool known = patch->kind != VES_PATCH_PDE || patch->conditions;
    for (int k = 0; k < patch->conditions; k++)
        known = known && patch->condition[k].u >= 0 && patch->condition[k].shares;
    return known;
}

static void read_parts(ves_reader *reader, const ves_node *section)
{
    ves_shell_def *shell = reader->shell;
    if (section->kind != VES_NODE_MAP || !section->count) {
        ves_reader_error(reader, VES_SYNTAX, section,
                         "\"parts\" must be patches, at least one: {PATCH: {thickness: ...}}");
        return;
    }
    ves_shell_part_def *part = ves_arena_take(reader->arena, (size_t)section->count, sizeof *part);
    if (!ves_reader_memory(reader, part)) return;
    reader->shell_known = true;
    for (int k = 0; k < section->count; k++) {
        ves_shell_part_def *next = &part[shell->parts];
        read_part(reader, section->key[k], section->item[k], next);
        bool known = next->patch >= 0;
        reader->shell_known =
            reader->shell_known && known && ends_known(&reader->problem->patch[next->patch]);
        shell->parts += known;
    }
    shell->part = part;
}

/* --- material --- */

static const ves_material *ask_material(ves_reader *reader, const ves_node *node)
{
    const char *candidate[32];
    int count = 0;
    if (!ves_reader_word(reader, node, "material")) return NULL;
    const ves_material *found = ves_material_find(node->text);
    for (const ves_material *m = ves_materials(); m->name; m++) candidate[count++] = m->name;
    if (!found)
        ves_reader_error(reader, VES_NAME, node, "no material \"%.80s\"%s (vesica list materials)",
                         node->text, ves_reader_suggestion(reader, node->text, candidate, count));
    else if (!reader->dimensions)
        ves_reader_error(
            reader, VES_UNIT, node,
            "\"%s\" has its numbers in SI units, but no number of this file has a unit: give lengths "
            "in m or mm, or E, nu and density as numbers",
            node->text);
    return found;
}

static int constant(ves_reader *reader, double value)
{
    const ves_formula *formula = ves_formula_constant(value, reader->arena);
    return ves_reader_memory(reader, formula) ? ves_reader_append(reader, formula) : -1;
}

/* What is not given is that of `like`; E and nu there must be. */
static void read_numbers(ves_reader *reader, const ves_node *node, const ves_fields *f,
                         const ves_material *like)
{
    ves_shell_def *shell = reader->shell;
    const struct {
        const char *name;
        int *index;
        double like;
        bool needed;
    } number[] = {{"E", &shell->E, like ? like->E : NAN, true},
                  {"nu", &shell->nu, like ? like->nu : NAN, true},
                  {"density", &shell->density, like ? like->density : NAN, false},
                  {"yield", &shell->yield, like ? like->yield : NAN, false},
                  {"shear", &shell->shear, 5.0 / 6, false}};
    for (size_t k = 0; k < sizeof number / sizeof *number; k++) {
        const ves_field *field = f ? ves_fields_field(f, number[k].name) : NULL;
        if (field && field->node)
            *number[k].index = ves_reader_place(reader, field->node, field->key);
        else if (!isnan(number[k].like))
            *number[k].index = constant(reader, number[k].like);
        else if (number[k].needed && f && !ves_fields_find(f, "like") && !field->excused)
            ves_reader_error(reader, VES_NAME, node, "\"material\" lacks \"%s\"; or say what it is like",
                             number[k].name);
    }
}

/* "E = 2 GPa, nu = 0.35", for people */
static const char *material_text(ves_reader *reader, const ves_fields *f)
{
    const char *text = "";
    for (int k = 0; text && k < f->count; k++)
        if (f->field[k].node && f->field[k].node->kind == VES_NODE_WORD)
            text = ves_arena_format(reader->arena, "%s%s%s %s", text, *text ? ", " : "",
                                    f->field[k].key->name, f->field[k].node->text);
    return ves_reader_memory(reader, text) ? text : "";
}

void ves_reader_material(ves_reader *reader, const ves_node *node)
{
    ves_fields f;
    ves_shell_def *shell = reader->shell;
    reader->material = node;
    if (node->kind == VES_NODE_WORD && *node->text) {
        const ves_material *found = ask_material(reader, node);
        shell->material = shell->made_of = found ? found->name : NULL;
        if (found) read_numbers(reader, node, NULL, found);
    } else if (ves_fields_read(reader, node, ves_schema_find(ves_schema_shell, "material")->table, "material",
                               &f)) {
        const ves_node *like = ves_fields_find(&f, "like");
        const ves_material *found = like ? ask_material(reader, like) : NULL;
        shell->material = found ? found->name : NULL;
        shell->made_of = material_text(reader, &f);
        read_numbers(reader, node, &f, found);
    }
}

/* --- meshes --- */

static bool is_auto(const ves_node *node)
{
    return node->kind == VES_NODE_WORD && !strcmp(node->text, "auto");
}

static void read_mesh(ves_reader *reader, const ves_node *node, const char *what, int least,
                      ves_shell_mesh_def *mesh)
{
    ves_fields f;
    if (!node || is_auto(node) ||
        !ves_fields_read(reader, node, ves_schema_find(ves_schema_shell, what)->table, what, &f))
        return;
    const ves_field *order = ves_fields_field(&f, "order"), *grading = ves_fields_field(&f, "grading"),
                    *elements = ves_fields_field(&f, "elements");
    mesh->given = true;
    if (order->node) mesh->order = (int)ves_reader_count(reader, order->node, order->key);
    bool locks = mesh->order > 2 && mesh->order < VES_SHELL_FULL;
    if (mesh->order && least > 2 && mesh->order < least)
        ves_reader_error(
            reader, VES_RANGE, order->node,
            "the order of \"verify\" must be %d to %d, got %d: it is what \"mesh\" is held against", least,
            VES_SHELL_MOST, mesh->order);
    else if (locks)
        ves_reader_error(reader, VES_RANGE, order->node,
                         "\"order\" must be 1, 2 or %d to %d, got %d: elements in between lock",
                         VES_SHELL_FULL, VES_SHELL_MOST, mesh->order);
    read_elements(reader, elements, mesh->elements);
    check_size(reader, elements->node, mesh->order, mesh->elements);
    if (grading->node) mesh->grading = ves_reader_constant(reader, grading->node, grading->key);
}

/* Elements of a part are of the order of `mesh`. */
static void check_parts(ves_reader *reader, const ves_node *parts)
{
    const ves_shell_def *shell = reader->shell;
    for (int k = 0; k < shell->parts && reader->shell_known; k++) {
        const ves_node *node = ves_node_find(parts->item[k], "elements");
        check_size(reader, node, shell->mesh.order, shell->part[k].elements);
    }
}

/* --- the section --- */

static void read_shell(ves_reader *reader, const ves_node *node, const ves_fields *f)
{
    ves_shell_def *shell = reader->shell;
    const ves_node *parts = ves_fields_find(f, "parts"), *material = ves_fields_find(f, "material"),
                   *supports = ves_fields_find(f, "supports"), *cases = ves_fields_find(f, "cases");
    const ves_field *symmetry = ves_fields_field(f, "symmetry");
    if (parts) read_parts(reader, parts);
    if (material) ves_reader_material(reader, material);
    read_mesh(reader, ves_fields_find(f, "mesh"), "mesh", 1, &shell->mesh);
    read_mesh(reader, ves_fields_find(f, "verify"), "verify", VES_SHELL_FULL, &shell->verify);
    if (parts) check_parts(reader, parts);
    if (symmetry->node) shell->symmetric = ves_reader_choice(reader, symmetry->node, symmetry->key) == 0;
    if (supports)
        ves_reader_supports(reader, supports);
    else if (!ves_fields_excused(f, "supports"))
        ves_reader_error(reader, VES_NAME, node,
                         "the shell is free to move: give supports: [{at: CURVE, fix: all}]");
    if (cases) ves_reader_cases(reader, cases);
}

void ves_reader_shell(ves_reader *reader, const ves_fields *root)
{
    const ves_node *node = ves_fields_find(root, "shell");
    ves_fields f;
    if (!node) return;
    ves_shell_def *shell = ves_arena_take(reader->arena, 1, sizeof *shell);
    if (!ves_reader_memory(reader, shell)) return;
    *shell = (ves_shell_def){.mark = ves_reader_mark(reader, node),
                             .E = -1,
                             .nu = -1,
                             .density = -1,
                             .yield = -1,
                             .shear = -1,
                             .made_of = "",
                             .symmetric = true};
    reader->problem->shell = reader->shell = shell;
    if (ves_fields_read(reader, node, ves_schema_shell, "shell", &f)) read_shell(reader, node, &f);
}

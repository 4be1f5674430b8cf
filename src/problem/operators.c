/* Operators: the equation that a patch solves; and remainders: what the modes do that it is not solved for. */
#include "problem/reader.h"

#include <string.h>

static const ves_entry *table_of(const char *key)
{
    const ves_entry *patch = ves_schema_find(ves_schema_root.table, "patches")->table->table;
    return ves_schema_find(patch, key)->table;
}

/* [c0, ..., cN]: returns N, or 0 after an error. */
static int read_list(ves_reader *reader, const ves_field *list, int *first)
{
    ves_arg arg;
    int before = reader->errors;
    ves_reader_arg(reader, list, &arg);
    if (reader->errors > before) return 0;
    if (arg.count < 2 || arg.count > VES_PARAMETERS_MAX) {
        ves_reader_error(reader, VES_RANGE, list->node,
                         "\"%s\" must be 2 to %d numbers [c0, ..., cN], N = 1 to %d, found %d",
                         list->key->name, VES_PARAMETERS_MAX, VES_GENERAL_MAX, arg.count);
        return 0;
    }
    *first = arg.first;
    return arg.count - 1;
}

/* One list for each coordinate, or one for all. */
static void read_lists(ves_reader *reader, const ves_fields *f, const char *const name[3], int lists,
                       ves_patch_def *patch)
{
    int power[3] = {0};
    patch->general = true;
    patch->operators = lists;
    for (int k = 0; k < lists; k++)
        power[k] = read_list(reader, ves_fields_field(f, name[k]), &patch->parameter[k]);
    for (int k = 1; k < lists; k++)
        if (power[0] && power[k] && power[k] != power[0]) {
            ves_reader_error(reader, VES_SYNTAX, ves_fields_find(f, name[k]),
                             "\"%s\" has %d numbers, \"%s\" has %d: all coordinates have one order", name[k],
                             power[k] + 1, name[0], power[0] + 1);
            return;
        }
    patch->power = power[0];
}

static void read_power(ves_reader *reader, const ves_fields *f, ves_patch_def *patch)
{
    const ves_field *power = ves_fields_field(f, "power");
    int before = reader->errors;
    long value = power->node ? ves_reader_count(reader, power->node, power->key) : patch->power;
    ves_arg a;
    ves_reader_arg(reader, ves_fields_field(f, "a"), &a);
    patch->operators = 1;
    patch->parameter[0] = a.count ? a.first : -1;
    if (value >= 1 && value <= VES_POWER_MAX && reader->errors == before) patch->power = (int)value;
}

static bool excused(const ves_fields *f)
{
    static const char *const name[] = {"power", "coefficients", "x", "y", "z"};
    for (int k = 0; k < 5; k++)
        if (ves_fields_excused(f, name[k])) return true;
    return false;
}

void ves_reader_operator(ves_reader *reader, const ves_node *node, ves_patch_def *patch)
{
    static const char *const axis[3] = {"x", "y", "z"}, *const all[3] = {"coefficients"};
    ves_fields f;
    const ves_node none = {.kind = VES_NODE_MAP};
    if (!ves_fields_read(reader, node ? node : &none, table_of("operator"), "operator", &f) || excused(&f))
        return;
    const ves_node *power = ves_fields_find(&f, "power"), *list = ves_fields_find(&f, "coefficients");
    int axes = 0;
    for (int k = 0; k < 3; k++) axes += ves_fields_find(&f, axis[k]) != NULL;
    int forms = (power != NULL) + (list != NULL) + (axes > 0);
    if (forms > 1)
        ves_reader_error(reader, VES_SYNTAX, node,
                         "an operator is one of power, coefficients, or x, y and z");
    else if (!forms && !patch->power)
        ves_reader_error(reader, VES_NAME, node,
                         "\"operator\" lacks \"power\", \"coefficients\", or \"x\", \"y\" and \"z\"");
    else if (forms && !power && ves_fields_find(&f, "a"))
        ves_reader_error(reader, VES_SYNTAX, ves_fields_field(&f, "a")->word,
                         "\"a\" belongs to \"power\"; coefficients say it all");
    else if (power || !forms)
        read_power(reader, &f, patch);
    else if (list)
        read_lists(reader, &f, all, 1, patch);
    else if (axes < 3)
        ves_reader_error(reader, VES_NAME, node,
                         "\"operator\" has coefficients for %d of x, y and z: give all three", axes);
    else
        read_lists(reader, &f, axis, 3, patch);
}

/* A number, or the word auto. */
static void read_omega(ves_reader *reader, const ves_field *omega, ves_patch_def *patch)
{
    const ves_node *node = omega->node;
    if (!node || (node->kind == VES_NODE_WORD && !strcmp(node->text, "auto"))) return;
    if (patch->general)
        ves_reader_error(
            reader, VES_SYNTAX, omega->word,
            "\"omega\" goes with \"power\"; with coefficients the remainder goes as the first mode "
            "that is not solved (auto)");
    else
        patch->omega = ves_reader_place(reader, node, omega->key);
}

void ves_reader_remainder(ves_reader *reader, const ves_node *node, ves_patch_def *patch)
{
    ves_fields f;
    if (!ves_fields_read(reader, node, table_of("remainder"), "remainder", &f)) return;
    const ves_field *modes = ves_fields_field(&f, "modes");
    if (modes->node) patch->modes = (int)ves_reader_count(reader, modes->node, modes->key);
    read_omega(reader, ves_fields_field(&f, "omega"), patch);
}

/* What goals may read of the shell: material.E and its like stand for what the file says there, so that variables
 * drive goals through them as if it were written out. */
#include <ctype.h>
#include <string.h>

#include "problem/reader.h"

static const struct {
    const char *name, *unit;
} number[VES_MATERIAL_NAMES] = {
    {"material.E", "Pa"}, {"material.nu", "1"}, {"material.density", "kg/m^3"}, {"material.yield", "Pa"}};

static const char *key_of(int name)
{
    return number[name].name + strlen("material.");
}

void ves_reader_material_symbols(ves_symbol *symbol)
{
    for (int k = 0; k < VES_MATERIAL_NAMES; k++) {
        symbol[k] = (ves_symbol){.name = number[k].name};
        ves_dim_read(number[k].unit, &symbol[k].dim, NULL);
    }
}

/* The length of the name that begins here, as the formulas' lexer has it. */
static size_t name_length(const char *text)
{
    size_t at = 0;
    if (!isalpha((unsigned char)*text) && *text != '_') return 0;
    while (isalnum((unsigned char)text[at]) || text[at] == '_' ||
           (text[at] == '.' && (isalpha((unsigned char)text[at + 1]) || text[at + 1] == '_')))
        at++;
    return at;
}

static int name_at(const char *text, size_t length)
{
    for (int k = 0; k < VES_MATERIAL_NAMES; k++)
        if (strlen(number[k].name) == length && !strncmp(text, number[k].name, length)) return k;
    return -1;
}

/* NULL after an error. In parentheses, a number first: (m) after a unit would be a unit. */
static const char *meaning(ves_reader *reader, const ves_node *node, int name)
{
    const ves_shell_def *shell = reader->shell;
    if (!shell) {
        ves_reader_error(reader, VES_NAME, node,
                         "\"%s\" is of a shell: say under \"shell\" what is one, and of what",
                         number[name].name);
        return NULL;
    }
    const int index[VES_MATERIAL_NAMES] = {shell->E, shell->nu, shell->density, shell->yield};
    const ves_node *given = ves_node_find(reader->material, key_of(name));
    if (index[name] < 0) {
        if (reader->status == VES_OK)
            ves_reader_error(
                reader, VES_NAME, node,
                "the material of this shell has no \"%s\": give it one, shell: {material: {%s: ...}}",
                key_of(name), key_of(name));
        return NULL;
    }
    const ves_formula *formula = reader->number[index[name] - reader->slots];
    if (!formula) return NULL;
    const char *text = given
                           ? ves_arena_format(reader->arena, "(1*(%s))", given->text)
                           : ves_arena_format(reader->arena, "(%.17g %s)", ves_reader_value(reader, formula),
                                              name == 1 ? "" : number[name].unit);
    return ves_reader_memory(reader, text) ? text : NULL;
}

const ves_formula *ves_reader_goal(ves_reader *reader, ves_text_part part, const ves_symbol *argument,
                                   int arguments)
{
    const ves_formula *formula = ves_reader_formula(reader, part, argument, arguments);
    const char *text = "", *from = part.node->text + part.from, *end = part.node->text + part.to;
    bool any = false;
    while (formula && from < end) {
        size_t length = name_length(from);
        const int name = length ? name_at(from, length) : -1;
        const char *put = name >= 0 ? meaning(reader, part.node, name) : NULL;
        if (name >= 0 && !put) return NULL;
        any = any || put;
        if (!length) length = 1;
        text = put ? ves_arena_format(reader->arena, "%s%s", text, put)
                   : ves_arena_format(reader->arena, "%s%.*s", text, (int)length, from);
        if (!ves_reader_memory(reader, text)) return NULL;
        from += length;
    }
    if (!any) return formula;
    ves_node whole = *part.node;
    whole.text = text;
    whole.exact = (size_t)-1;
    return ves_reader_formula(reader, ves_text_whole(&whole), argument, arguments);
}

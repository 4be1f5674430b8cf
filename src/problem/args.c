/* Arguments: what a table of keys says about values, kind by kind. */
#include <string.h>

#include "base/text.h"
#include "problem/reader.h"

/* Has YAML taken a comma inside parentheses for the end of an item? */
static bool torn(const ves_node *list)
{
    for (int k = 0; k < list->count; k++) {
        const ves_node *item = list->item[k];
        if (item->kind == VES_NODE_WORD && item->plain && strchr(item->text, '(') && !strchr(item->text, ')'))
            return true;
    }
    return false;
}

static bool is_list(ves_reader *reader, const ves_node *node, const char *name, int count,
                    const char *example)
{
    if (node->kind == VES_NODE_LIST && (count < 0 || node->count == count)) return true;
    if (node->kind == VES_NODE_LIST)
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" must be %s, found %d %s%s", name, example,
                         node->count, node->count == 1 ? "entry" : "entries",
                         torn(node) ? "; a formula with commas must be quoted: \"max(a, b)\"" : "");
    else
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" must be %s", name, example);
    return false;
}

static void number(ves_reader *reader, const ves_node *node, const ves_key *key, ves_arg *arg)
{
    int index = ves_reader_place(reader, node, key);
    if (!arg->count++) arg->first = index;
}

static void vector(ves_reader *reader, const ves_node *node, const ves_key *key, ves_arg *arg)
{
    if (!is_list(reader, node, key->name, 3, "three numbers [x, y, z]")) return;
    for (int k = 0; k < 3; k++) number(reader, node->item[k], key, arg);
}

static void scales(ves_reader *reader, const ves_node *node, const ves_key *key, ves_arg *arg)
{
    if (node->kind == VES_NODE_LIST) {
        vector(reader, node, key, arg);
        return;
    }
    arg->first = ves_reader_place(reader, node, key);
    const ves_formula *formula = arg->first < 0 ? NULL : reader->number[arg->first - reader->slots];
    ves_reader_append(reader, formula);
    ves_reader_append(reader, formula);
    arg->count = 3;
}

static void numbers(ves_reader *reader, const ves_node *node, const ves_key *key, ves_arg *arg)
{
    if (!is_list(reader, node, key->name, -1, "a list of numbers")) return;
    for (int k = 0; k < node->count; k++) number(reader, node->item[k], key, arg);
}

static void points(ves_reader *reader, const ves_node *node, const ves_key *key, ves_arg *arg)
{
    if (!is_list(reader, node, key->name, -1, "a list of points [[x, y, z], ...]")) return;
    for (int k = 0; k < node->count; k++) vector(reader, node->item[k], key, arg);
}

static void terms(ves_reader *reader, const ves_node *node, const ves_key *key, ves_arg *arg)
{
    if (!is_list(reader, node, key->name, -1, "a list [[number, curve], ...]")) return;
    int *ref = ves_arena_take(reader->arena, (size_t)node->count, sizeof *ref);
    if (!ves_reader_memory(reader, ref)) return;
    arg->ref = ref;
    for (int k = 0; k < node->count; k++) {
        const ves_node *term = node->item[k];
        ref[k] = -1;
        if (is_list(reader, term, key->name, 2, "a list [[number, curve], ...]"))
            ref[k] = ves_reader_curve(reader, term->item[1]);
    }
    for (int k = 0; k < node->count; k++) /* after the curves, whose numbers must not come in between */
        if (ref[k] >= 0) number(reader, node->item[k]->item[0], key, arg);
    if (!node->count) ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" is empty", key->name);
}

static void count(ves_reader *reader, const ves_node *node, const ves_key *key, ves_arg *arg)
{
    int before = reader->errors;
    long value = ves_reader_count(reader, node, key);
    bool small = value <= 2000000000 && value >= -2000000000;
    if (small)
        arg->value = (int)value;
    else if (reader->errors == before)
        ves_reader_error(reader, VES_RANGE, node, "\"%s\" is too large: %ld", key->name, value);
}

bool ves_reader_flag(ves_reader *reader, const ves_node *node, const ves_key *key)
{
    const char *text = node->kind == VES_NODE_WORD ? node->text : "";
    if (!strcmp(text, "true")) return true;
    if (!strcmp(text, "false")) return false;
    static const char yes[] = "yes|Yes|YES|on|On|ON|y|Y|True|TRUE|1",
                      no[] = "no|No|NO|off|Off|OFF|n|N|False|FALSE|0";
    const char *hint = ves_words_find(yes, text) >= 0  ? "true"
                       : ves_words_find(no, text) >= 0 ? "false"
                                                       : NULL;
    if (hint)
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" is read as text here; write %s", text, hint);
    else
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" must be true or false%s%.40s%s", key->name,
                         *text ? ", found \"" : "", text, *text ? "\"" : "");
    return hint && !strcmp(hint, "true");
}

static void known_words(const char *words, char *text, size_t size)
{
    size_t at = 0;
    for (const char *w = words; *w && at + 3 < size; w++) {
        if (*w == '|')
            text[at++] = ',', text[at++] = ' ';
        else
            text[at++] = *w;
    }
    text[at] = 0;
}

int ves_reader_choice(ves_reader *reader, const ves_node *node, const ves_key *key)
{
    int found = node->kind == VES_NODE_WORD ? ves_words_find(key->words, node->text) : -1;
    if (found >= 0) return found;
    char known[400];
    known_words(key->words, known, sizeof known);
    if (node->kind != VES_NODE_WORD) {
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" must be one word of: %s", key->name, known);
        return (int)key->fallback;
    }
    const char *candidate[16];
    int count = 0, length;
    for (const char *w; count < 16 && (w = ves_words_at(key->words, count, &length)); count++) {
        candidate[count] = ves_arena_text(reader->arena, w, (size_t)length);
        if (!ves_reader_memory(reader, candidate[count])) return 0;
    }
    const char *near = ves_reader_suggestion(reader, node->text, candidate, count);
    ves_reader_error(reader, VES_NAME, node, "\"%s\" cannot be \"%.80s\"%s (known: %s)", key->name,
                     node->text, near, known);
    return (int)key->fallback;
}

int ves_reader_curve(ves_reader *reader, const ves_node *node)
{
    const ves_named *curve = ves_names_ask(reader, &reader->curves, node);
    if (!curve) return -1;
    if (ves_node_find(curve->value, "family")) {
        ves_reader_error(
            reader, VES_NAME, node,
            "\"%s\" is a family of curves, not one curve: only \"sections\" of a patch can use it",
            curve->text);
        return -1;
    }
    return ves_reader_curve_read(reader, node, (ves_named *)curve);
}

static void curve(ves_reader *reader, const ves_node *node, ves_arg *arg)
{
    int *ref = ves_arena_take(reader->arena, 1, sizeof *ref);
    if (!ves_reader_memory(reader, ref)) return;
    *ref = ves_reader_curve(reader, node);
    arg->ref = ref;
    arg->count = 1;
}

static void place(ves_reader *reader, const ves_node *node, ves_arg *arg)
{
    int *ref = ves_arena_take(reader->arena, 1, sizeof *ref);
    if (!ves_reader_memory(reader, ref) || !ves_reader_word(reader, node, "place or curve")) return;
    const ves_named *found = ves_names_find(&reader->places, node->text);
    arg->place = found != NULL;
    if (found)
        *ref = found->index;
    else if (ves_names_find(&reader->curves, node->text))
        *ref = ves_reader_curve(reader, node);
    else
        ves_reader_error(reader, VES_NAME, node, "no place and no curve \"%.80s\"", node->text);
    arg->ref = ref;
    arg->count = 1;
}

const int *ves_reader_patches(ves_reader *reader, const ves_node *node, int *count)
{
    const ves_node *const single[1] = {node};
    bool list = node->kind == VES_NODE_LIST;
    const ves_node *const *item = list ? node->item : single;
    int items = list ? node->count : 1;
    *count = 0;
    int *ref = ves_arena_take(reader->arena, (size_t)items, sizeof *ref);
    if (!ves_reader_memory(reader, ref)) return NULL;
    if (!items) ves_reader_error(reader, VES_SYNTAX, node, "this list of patches is empty");
    for (int k = 0; k < items; k++) {
        const ves_named *patch = ves_names_ask(reader, &reader->patches, item[k]);
        if (!patch) continue;
        bool twice = false;
        for (int i = 0; i < *count && !twice; i++) twice = ref[i] == patch->index;
        if (twice)
            ves_reader_error(reader, VES_NAME, item[k], "patch \"%s\" is named twice", patch->text);
        else
            ref[(*count)++] = patch->index;
    }
    return ref;
}

static void formulas(ves_reader *reader, const ves_node *node, const ves_key *key, ves_arg *arg)
{
    const ves_symbol known[] = {{"u", {0}}, {"v", {0}}, {reader->parameter, {0}}},
                     *own = reader->surface ? known : known + 1;
    int count = reader->surface || reader->parameter ? 2 : 1;
    if (!is_list(reader, node, key->name, 3, "three formulas [x, y, z]")) return;
    const ves_formula **formula = ves_arena_take(reader->arena, 3, sizeof *formula);
    if (!ves_reader_memory(reader, formula)) return;
    arg->formula = formula;
    arg->count = 3;
    for (int k = 0; k < 3; k++) {
        const ves_node *item = node->item[k];
        if (!ves_reader_word(reader, item, "formula")) continue;
        formula[k] = ves_reader_formula(reader, ves_text_whole(item), own, count);
        if (formula[k]) ves_reader_check_dim(reader, item, key->name, key->unit, ves_formula_dim(formula[k]));
    }
}

const ves_formula *ves_reader_pointwise(ves_reader *reader, const ves_node *node, const ves_key *key,
                                        const ves_symbol *symbol, int symbols)
{
    if (!ves_reader_word(reader, node, "formula")) return NULL;
    const ves_formula *formula = ves_reader_formula(reader, ves_text_whole(node), symbol, symbols);
    if (!formula) return NULL;
    if (key->unit) ves_reader_check_dim(reader, node, key->name, key->unit, ves_formula_dim(formula));
    for (int k = 0; k < symbols; k++)
        for (int s = 0; s < reader->slots && ves_formula_uses_argument(formula, k); s++)
            if (!strcmp(reader->slot[s].name, symbol[k].name))
                ves_reader_error(
                    reader, VES_NAME, node,
                    "\"%s\" is a property of the surface here, but also a name of this file; rename that",
                    symbol[k].name);
    return formula;
}

static void shellwise(ves_reader *reader, const ves_node *node, const ves_key *key, ves_arg *arg)
{
    static const ves_dim length = {.m = 6}, plain = {0};
    const ves_symbol symbol[] = {{"x", length}, {"y", length}, {"z", length},
                                 {"u", plain},  {"v", plain},  {"thickness", length}};
    const ves_formula **formula = ves_arena_take(reader->arena, 1, sizeof *formula);
    if (!ves_reader_memory(reader, formula)) return;
    arg->formula = formula;
    arg->count = 1;
    *formula = ves_reader_pointwise(reader, node, key, symbol, sizeof symbol / sizeof *symbol);
}

/* x, y, z, H, K, k1, k2, u, v: names that a variable may bear too, but then not here. */
static void pointwise(ves_reader *reader, const ves_node *node, const ves_key *key, ves_arg *arg)
{
    static const ves_dim length = {.m = 6}, bend = {.m = -6}, gauss = {.m = -12}, plain = {0};
    const ves_symbol symbol[] = {{"x", length}, {"y", length}, {"z", length}, {"H", bend}, {"K", gauss},
                                 {"k1", bend},  {"k2", bend},  {"u", plain},  {"v", plain}};
    const ves_formula **formula = ves_arena_take(reader->arena, 1, sizeof *formula);
    if (!ves_reader_memory(reader, formula)) return;
    arg->formula = formula;
    arg->count = 1;
    *formula = ves_reader_pointwise(reader, node, key, symbol, sizeof symbol / sizeof *symbol);
}

static void given(ves_reader *reader, const ves_field *field, ves_arg *arg)
{
    const ves_key *key = field->key;
    const ves_node *node = field->node;
    switch (key->kind) {
    case VES_NUMBER:
        number(reader, node, key, arg);
        break;
    case VES_VECTOR:
        vector(reader, node, key, arg);
        break;
    case VES_SCALES:
        scales(reader, node, key, arg);
        break;
    case VES_NUMBERS:
        numbers(reader, node, key, arg);
        break;
    case VES_POINTS:
        points(reader, node, key, arg);
        break;
    case VES_TERMS:
        terms(reader, node, key, arg);
        break;
    case VES_COUNT:
        count(reader, node, key, arg);
        break;
    case VES_FLAG:
        arg->value = ves_reader_flag(reader, node, key);
        break;
    case VES_CHOICE:
        arg->value = ves_reader_choice(reader, node, key);
        break;
    case VES_TEXT:
        if (ves_reader_word(reader, node, "text")) arg->text = node->text;
        break;
    case VES_CURVE:
        curve(reader, node, arg);
        break;
    case VES_PLACE:
        place(reader, node, arg);
        break;
    case VES_PATCHES:
        arg->ref = ves_reader_patches(reader, node, &arg->count);
        break;
    case VES_FORMULAS:
        formulas(reader, node, key, arg);
        break;
    case VES_POINTWISE:
        pointwise(reader, node, key, arg);
        break;
    case VES_SHELLWISE:
        shellwise(reader, node, key, arg);
        break;
    case VES_CASE:
        arg->value = ves_reader_case(reader, node);
        break;
    case VES_SHELL_AT:
        arg->value = ves_reader_shell_place(reader, node);
        break;
    case VES_SHELL_HELD:
        arg->value = ves_reader_shell_held(reader, node);
        break;
    }
}

/* Number kinds always have their places in the block, so that measures can read them without asking. */
static void absent(ves_reader *reader, const ves_key *key, ves_arg *arg)
{
    bool three = key->kind == VES_VECTOR || key->kind == VES_SCALES;
    bool whole = key->kind == VES_COUNT || key->kind == VES_FLAG || key->kind == VES_CHOICE;
    bool shell = ves_reader_of_shell(key);
    arg->value = shell ? -1 : whole ? (int)key->fallback : 0; /* of others a plugin may say any number */
    if (key->kind != VES_NUMBER && !three) return;
    const ves_formula *formula = ves_formula_constant(key->fallback, reader->arena);
    if (!ves_reader_memory(reader, formula)) return;
    arg->count = three ? 3 : 1;
    arg->first = ves_reader_append(reader, formula);
    for (int k = 1; k < arg->count; k++) ves_reader_append(reader, formula);
}

void ves_reader_arg(ves_reader *reader, const ves_field *field, ves_arg *arg)
{
    *arg = (ves_arg){.given = field->node != NULL, .mark = ves_reader_mark(reader, field->node)};
    if (field->node)
        given(reader, field, arg);
    else
        absent(reader, field->key, arg);
}

void ves_reader_args(ves_reader *reader, const ves_fields *fields, int count, const ves_node *node,
                     ves_args *args)
{
    ves_key *key = ves_arena_take(reader->arena, (size_t)count + 1, sizeof *key);
    ves_arg *arg = ves_arena_take(reader->arena, (size_t)count, sizeof *arg);
    if (!ves_reader_memory(reader, key) || !ves_reader_memory(reader, arg)) return;
    for (int k = 0; k < count; k++) {
        key[k] = *fields->field[k].key;
        ves_reader_arg(reader, &fields->field[k], &arg[k]);
        if (key[k].kind == VES_CASE && !arg[k].given && !fields->field[k].excused)
            arg[k].value = ves_reader_only_case(reader, node, &key[k]);
    }
    *args = (ves_args){key, arg, count, ves_reader_mark(reader, node)};
}

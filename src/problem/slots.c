/* Slots: variables, the unknown of solve, parameters. Parameters may be written in any order; their slots
 * come in an order in which each reads only slots before it, constant ones first, since ranges may be
 * formulas of those. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "measure/registry.h"
#include "problem/reader.h"

typedef struct parameter {
    const char *name;
    const ves_node *word, *value;
    bool *reads; /* [names] variables, unknown, parameters in the order of the file */
    bool varies, open, done;
    const ves_formula *formula;
} parameter;

/* What the parts of this file share. */
typedef struct slots {
    ves_reader *reader;
    ves_declared *variable;
    int variables;
    const ves_node *unknown, *unknown_range; /* words of solve, or NULL */
    parameter *parameter;
    int parameters;
    int *order; /* parameters in the order of their slots */
    int ordered;
    ves_problem *problem;
} slots;

static bool is_identifier(const char *text)
{
    size_t length = 0;
    if (!isalpha((unsigned char)*text) && *text != '_') return false;
    for (; text[length]; length++)
        if (!isalnum((unsigned char)text[length]) && text[length] != '_') return false;
    return length <= 64;
}

bool ves_reader_new_name(ves_reader *reader, const ves_node *word, const char *what, bool formulas)
{
    if (!is_identifier(word->text)) {
        bool blank = word->plain && !*word->text;
        ves_reader_error(reader, VES_NAME, word,
                         "%s%.80s%s cannot be the name of a %s: letters, digits and _, a letter first",
                         blank ? "nothing" : "\"", word->text, blank ? "" : "\"", what);
        return false;
    }
    if (formulas && ves_words_find(ves_names_reserved, word->text) >= 0) {
        ves_reader_error(reader, VES_NAME, word,
                         "\"%s\" has a meaning of its own in formulas and cannot be the name of a %s",
                         word->text, what);
        return false;
    }
    return true;
}

static int section_count(const ves_node *section)
{
    return section && section->kind == VES_NODE_MAP ? section->count : 0;
}

static bool is_section(slots *s, const ves_node *section, const char *name, const char *form)
{
    if (!section) return false;
    if (section->kind == VES_NODE_MAP) return true;
    ves_reader_error(s->reader, VES_SYNTAX, section, "\"%s\" must be a mapping {%s, ...}", name, form);
    return false;
}

/* Who has a name already: its word, or NULL. */
static const ves_node *taken(const slots *s, const char *name)
{
    for (int k = 0; k < s->variables; k++)
        if (!strcmp(s->variable[k].name, name)) return s->variable[k].word;
    if (s->unknown && !strcmp(s->unknown->text, name)) return s->unknown;
    for (int k = 0; k < s->parameters; k++)
        if (!strcmp(s->parameter[k].name, name)) return s->parameter[k].word;
    return NULL;
}

static bool is_free(slots *s, const char *name, const ves_node *word)
{
    const ves_node *other = taken(s, name);
    if (!other) return true;
    ves_mark mark = ves_reader_mark(s->reader, other);
    ves_reader_error(s->reader, VES_NAME, word, "the name \"%s\" is taken: line %d declares it already", name,
                     mark.line);
    return false;
}

static void collect_variables(slots *s, const ves_node *section, const ves_node *vary)
{
    if (is_section(s, section, "variables", "name: [min, start, max]"))
        for (int k = 0; k < section->count; k++) {
            const ves_node *word = section->key[k];
            if (ves_reader_new_name(s->reader, word, "variable", true))
                s->variable[s->variables++] = (ves_declared){word->text, word, section->item[k], NULL};
        }
    int own = s->variables, all = own;
    ves_vary_read(s->reader, vary, s->variable, &all);
    for (int k = own; k < all; k++)
        if (is_free(s, s->variable[k].name, s->variable[k].word))
            s->variable[s->variables++] = s->variable[k];
}

static void collect_unknown(slots *s, const ves_node *solve)
{
    const ves_node *word = ves_node_find(solve, "unknown");
    if (!word || word->kind != VES_NODE_WORD) return;
    if (!ves_reader_new_name(s->reader, word, "unknown", true) || !is_free(s, word->text, word)) return;
    s->unknown = word;
    s->unknown_range = ves_node_find(solve, "in");
}

static void collect_parameters(slots *s, const ves_node *section)
{
    if (!is_section(s, section, "parameters", "name: number")) return;
    for (int k = 0; k < section->count; k++) {
        const ves_node *word = section->key[k];
        if (ves_reader_new_name(s->reader, word, "parameter", true) && is_free(s, word->text, word))
            s->parameter[s->parameters++] =
                (parameter){.name = word->text, .word = word, .value = section->item[k]};
    }
}

static int fixed(const slots *s)
{
    return s->variables + (s->unknown ? 1 : 0);
}

/* Which names a parameter reads: compiled once with every name known and nothing checked. Errors come when it
 * is compiled in earnest. */
static void find_reads(slots *s, const ves_symbol *symbol, int names, ves_arena *arena)
{
    const ves_scope scope = {symbol, names, NULL, 0, false};
    for (int k = 0; k < s->parameters; k++) {
        parameter *p = &s->parameter[k];
        const ves_formula *formula = NULL;
        ves_formula_error error;
        p->reads = ves_arena_take(s->reader->arena, (size_t)names, sizeof *p->reads);
        if (!ves_reader_memory(s->reader, p->reads)) return;
        if (p->value->kind != VES_NODE_WORD) continue;
        ves_status status = ves_formula_compile(p->value->text, &scope, arena, &formula, &error);
        if (status == VES_MEMORY) s->reader->status = VES_MEMORY;
        for (int i = 0; status == VES_OK && i < names; i++) p->reads[i] = ves_formula_uses_slot(formula, i);
    }
}

static void find_all_reads(slots *s)
{
    int names = fixed(s) + s->parameters;
    ves_arena scratch = {0};
    ves_symbol *symbol = ves_arena_take(&scratch, (size_t)names, sizeof *symbol);
    if (ves_reader_memory(s->reader, symbol)) {
        for (int k = 0; k < s->variables; k++) symbol[k].name = s->variable[k].name;
        if (s->unknown) symbol[s->variables].name = s->unknown->text;
        for (int k = 0; k < s->parameters; k++) symbol[fixed(s) + k].name = s->parameter[k].name;
        find_reads(s, symbol, names, &scratch);
    }
    ves_arena_destroy(&scratch);
}

static void visit(slots *s, int index)
{
    parameter *p = &s->parameter[index];
    if (p->done || !p->reads) return;
    if (p->open) {
        ves_reader_error(s->reader, VES_NAME, p->value, "parameter \"%s\" depends on itself", p->name);
        return;
    }
    p->open = true;
    for (int k = 0; k < fixed(s); k++) p->varies = p->varies || p->reads[k];
    for (int k = 0; k < s->parameters; k++) {
        if (!p->reads[fixed(s) + k]) continue;
        visit(s, k);
        p->varies = p->varies || s->parameter[k].varies;
    }
    p->open = false;
    if (!p->done) s->order[s->ordered++] = index;
    p->done = true;
}

/* Depth first gives an order; constant parameters read constant ones alone and may all go first. */
static void sort_parameters(slots *s)
{
    int *all = ves_arena_take(s->reader->arena, (size_t)s->parameters, sizeof *all), count = 0;
    s->order = ves_arena_take(s->reader->arena, (size_t)s->parameters, sizeof *s->order);
    if (!ves_reader_memory(s->reader, all) || !ves_reader_memory(s->reader, s->order)) return;
    for (int k = 0; k < s->parameters; k++) visit(s, k);
    for (int varies = 0; varies < 2; varies++)
        for (int k = 0; k < s->ordered; k++)
            if (s->parameter[s->order[k]].varies == varies) all[count++] = s->order[k];
    s->order = all;
}

static bool make_slots(slots *s)
{
    ves_reader *r = s->reader;
    int count = fixed(s) + s->ordered;
    r->slot = ves_arena_take(r->arena, (size_t)count, sizeof *r->slot);
    r->value = ves_arena_take(r->arena, (size_t)count, sizeof *r->value);
    r->varying = ves_arena_take(r->arena, (size_t)count, sizeof *r->varying);
    if (!ves_reader_memory(r, r->slot) || !ves_reader_memory(r, r->value) ||
        !ves_reader_memory(r, r->varying))
        return false;
    const ves_dim any = {.any = true};
    for (int k = 0; k < count; k++) {
        const char *name = k < s->variables ? s->variable[k].name
                           : k < fixed(s)   ? s->unknown->text
                                            : s->parameter[s->order[k - fixed(s)]].name;
        r->slot[k] = (ves_symbol){name, any};
        r->value[k] = NAN;
        r->varying[k] = k < fixed(s) || s->parameter[s->order[k - fixed(s)]].varies;
    }
    r->slots = count;
    return true;
}

static void compile_parameter(slots *s, int at)
{
    ves_reader *r = s->reader;
    parameter *p = &s->parameter[s->order[at]];
    const ves_key key = {.name = p->name, .kind = VES_NUMBER};
    p->formula = ves_reader_number(r, p->value, &key);
    if (!p->formula) return;
    r->slot[fixed(s) + at].dim = ves_formula_dim(p->formula);
    r->value[fixed(s) + at] = ves_reader_value(r, p->formula);
}

/* [min, start, max] or [from, to]: constants of one dimension. */
static bool read_bounds(slots *s, const ves_node *node, const char *name, int count, double *value,
                        ves_dim *dim)
{
    ves_reader *r = s->reader;
    const char *form = count == 3 ? "[min, start, max]" : "[from, to]";
    if (node->kind != VES_NODE_LIST || node->count != count) {
        if (node->kind == VES_NODE_LIST)
            ves_reader_error(r, VES_SYNTAX, node, "\"%s\" must be %s, found %d %s", name, form, node->count,
                             node->count == 1 ? "entry" : "entries");
        else
            ves_reader_error(r, VES_SYNTAX, node, "\"%s\" must be %s", name, form);
        return false;
    }
    const ves_key key = {.name = name, .kind = VES_NUMBER};
    ves_dim *outer = r->free;
    bool good = true;
    int before = r->errors;
    dim->any = true;
    r->free = dim;
    for (int k = 0; k < count; k++) {
        value[k] = ves_reader_constant(r, node->item[k], &key);
        good = good && !isnan(value[k]);
    }
    r->free = outer;
    return good && r->errors == before; /* numbers of different dimensions cannot be compared */
}

static void empty_range(slots *s, const ves_node *node, double low, double high, ves_dim dim)
{
    char a[VES_QUANTITY], b[VES_QUANTITY];
    ves_quantity_text(low, dim, s->reader->dimensions, a);
    ves_quantity_text(high, dim, s->reader->dimensions, b);
    ves_reader_error(s->reader, VES_RANGE, node, "empty range [%s, %s]; %s", a, b,
                     low > high ? "swap them?" : "a number that stays fixed is a parameter");
}

/* vary without ranges: the book's, which are plain numbers. */
static bool book_range(slots *s, const ves_declared *d, double bound[3], ves_dim *dim)
{
    memcpy(bound, d->fallback, 3 * sizeof *bound);
    size_t length = strlen(d->name);
    bool length_wanted = s->reader->dimensions && d->name[length - 2] == 'T';
    *dim = (ves_dim){.any = length_wanted};
    if (!length_wanted) return true;
    ves_reader_error(
        s->reader, VES_UNIT, d->word,
        "numbers of this file have units: give the range of %s, as in {%s: [-10 mm, 0 mm, 10 mm]}",
        d->word->text, d->word->text);
    return false;
}

static void check_start(slots *s, const ves_node *node, double start, const ves_variable *v)
{
    char text[3][32];
    const char *unit = v->shown.unit, *gap = *unit ? " " : "";
    if (isnan(start) || (start >= v->min && start <= v->max)) return;
    ves_number_text(start / v->shown.factor, text[0]);
    ves_number_text(v->min / v->shown.factor, text[1]);
    ves_number_text(v->max / v->shown.factor, text[2]);
    ves_reader_error(s->reader, VES_RANGE, node, "start %s%s%s is outside [%s, %s]%s%s", text[0], gap, unit,
                     text[1], text[2], gap, unit);
}

static void read_variable(slots *s, int index, const ves_node *starts)
{
    ves_reader *r = s->reader;
    const ves_declared *d = &s->variable[index];
    double bound[3] = {NAN, NAN, NAN};
    ves_dim dim = {.any = true};
    const ves_node *start = ves_node_find(starts, d->name);
    bool good = d->range ? read_bounds(s, d->range, d->name, 3, bound, &dim) : book_range(s, d, bound, &dim);
    bool empty = good && bound[0] >= bound[2];
    if (empty) empty_range(s, d->range ? d->range : d->word, bound[0], bound[2], dim);
    if (start) {
        const ves_key key = {.name = d->name, .kind = VES_NUMBER};
        ves_dim *outer = r->free;
        r->free = &dim;
        bound[1] = ves_reader_constant(r, start, &key);
        r->free = outer;
    }
    r->slot[index].dim = dim;
    r->value[index] = bound[1];
    ves_variable *variable = (ves_variable *)s->problem->variable + index;
    *variable = (ves_variable){.name = d->name,
                               .mark = ves_reader_mark(r, d->word),
                               .min = bound[0],
                               .start = bound[1],
                               .max = bound[2],
                               .dim = dim};
    ves_shown_find(d->range ? d->range->item : NULL, good && d->range ? 3 : 0, dim, &variable->shown);
    if (good && !empty)
        check_start(s, start ? start : d->range ? d->range->item[1] : d->word, bound[1], variable);
}

static void read_variables(slots *s, const ves_node *starts)
{
    ves_reader *r = s->reader;
    ves_variable *variable = ves_arena_take(r->arena, (size_t)s->variables, sizeof *variable);
    if (!ves_reader_memory(r, variable)) return;
    s->problem->variable = variable;
    if (!is_section(s, starts, "start", "variable: number")) starts = NULL;
    for (int k = 0; k < s->variables; k++) read_variable(s, k, starts);
    s->problem->variables = s->variables;
    const char **candidate = ves_arena_take(r->arena, (size_t)s->variables, sizeof *candidate);
    if (!ves_reader_memory(r, candidate)) return;
    for (int k = 0; k < s->variables; k++) candidate[k] = s->variable[k].name;
    for (int k = 0; k < section_count(starts); k++) {
        bool known = false;
        for (int i = 0; i < s->variables && !known; i++) known = !strcmp(candidate[i], starts->key[k]->text);
        if (!known)
            ves_reader_error(r, VES_NAME, starts->key[k], "no variable \"%.80s\"%s", starts->key[k]->text,
                             ves_reader_suggestion(r, starts->key[k]->text, candidate, s->variables));
    }
}

/* The rest of solve is read with the measures. */
static void read_unknown(slots *s, const ves_node *solve)
{
    ves_reader *r = s->reader;
    ves_solve *out = ves_arena_take(r->arena, 1, sizeof *out);
    if (!ves_reader_memory(r, out)) return;
    double bound[2] = {NAN, NAN};
    ves_dim dim = {.any = true};
    if (s->unknown_range && read_bounds(s, s->unknown_range, "in", 2, bound, &dim) && bound[0] >= bound[1])
        empty_range(s, s->unknown_range, bound[0], bound[1], dim);
    r->slot[s->variables].dim = dim;
    r->value[s->variables] = (bound[0] + bound[1]) / 2;
    *out = (ves_solve){.mark = ves_reader_mark(r, solve),
                       .name = s->unknown->text,
                       .lo = bound[0],
                       .hi = bound[1],
                       .dim = dim};
    bool list = s->unknown_range && s->unknown_range->kind == VES_NODE_LIST;
    ves_shown_find(list ? s->unknown_range->item : NULL, list ? s->unknown_range->count : 0, dim,
                   &out->shown);
    s->problem->solve = out;
    s->problem->unknowns = 1;
}

static void compile_all(slots *s, const ves_fields *root)
{
    ves_reader *r = s->reader;
    int at = 0;
    r->owner = -2; /* parameters count as used only where they are read */
    for (; at < s->ordered && !s->parameter[s->order[at]].varies; at++) compile_parameter(s, at);
    read_variables(s, ves_fields_find(root, "start"));
    if (s->unknown) read_unknown(s, ves_fields_find(root, "solve"));
    for (; at < s->ordered; at++) compile_parameter(s, at);
    r->owner = -1;
    ves_parameter *out = ves_arena_take(r->arena, (size_t)s->ordered, sizeof *out);
    if (!ves_reader_memory(r, out)) return;
    for (int k = 0; k < s->ordered; k++) {
        const parameter *p = &s->parameter[s->order[k]];
        out[k] = (ves_parameter){.name = p->name, .mark = ves_reader_mark(r, p->word), .formula = p->formula};
        if (p->formula) ves_shown_find(&p->value, 1, ves_formula_dim(p->formula), &out[k].shown);
    }
    s->problem->parameter = out;
    s->problem->parameters = s->ordered;
    s->problem->slots = r->slots;
}

void ves_reader_slots(ves_reader *reader, const ves_fields *root)
{
    const ves_node *variables = ves_fields_find(root, "variables"), *vary = ves_fields_find(root, "vary"),
                   *parameters = ves_fields_find(root, "parameters");
    slots s = {.reader = reader, .problem = reader->problem};
    int count = section_count(variables) + ves_vary_count(vary);
    if (count + section_count(parameters) + 1 > VES_SLOTS) {
        ves_reader_fail(reader, VES_RANGE, (ves_mark){0}, "more than %d variables and parameters",
                        VES_SLOTS - 1);
        return;
    }
    s.variable = ves_arena_take(reader->arena, (size_t)count, sizeof *s.variable);
    s.parameter = ves_arena_take(reader->arena, (size_t)section_count(parameters), sizeof *s.parameter);
    if (!ves_reader_memory(reader, s.variable) || !ves_reader_memory(reader, s.parameter)) return;
    collect_variables(&s, variables, vary);
    collect_unknown(&s, ves_fields_find(root, "solve"));
    collect_parameters(&s, parameters);
    if (reader->status != VES_MEMORY) find_all_reads(&s);
    if (reader->status != VES_MEMORY) sort_parameters(&s);
    if (reader->status != VES_MEMORY && make_slots(&s)) compile_all(&s, root);
}

/* Numbers and formulas: words of the tree compiled, with errors that point into them. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "formula/dimension.h"
#include "problem/reader.h"

bool ves_reader_word(ves_reader *reader, const ves_node *node, const char *what)
{
    if (node->kind == VES_NODE_WORD && (*node->text || !node->plain)) return true;
    ves_reader_error(reader, VES_SYNTAX, node, "expected a%s %s, found %s", strchr("aeiou", *what) ? "n" : "",
                     what,
                     node->kind == VES_NODE_LIST  ? "a list"
                     : node->kind == VES_NODE_MAP ? "a mapping"
                                                  : "nothing");
    return false;
}

ves_text_part ves_text_whole(const ves_node *node)
{
    return (ves_text_part){node, 0, (int)strlen(node->text)};
}

static bool is_one_of(const char *word, const char *words)
{
    char small[8] = "";
    for (int k = 0; k < 7 && word[k]; k++) small[k] = (char)tolower((unsigned char)word[k]);
    return strlen(word) < 7 && ves_words_find(words, small) >= 0;
}

/* What YAML 1.1 would have made of the word, when that is not what stands there. */
static const char *surprise(const char *word)
{
    if (is_one_of(word, "yes|no|on|off|y|n|true|false")) return "is a word here, not a number";
    if (is_one_of(word, "null|~")) return "is no number; leave the key out instead";
    if (is_one_of(word, ".inf|-.inf|+.inf|.nan|inf|-inf|nan")) return "is not a finite number";
    size_t digits = strspn(word, "0123456789"), more = digits ? strspn(word + digits, "0123456789:") : 0;
    if (more && word[digits + more] == 0 && strchr(word, ':'))
        return "is not read as a time (base 60) here; write one number";
    return NULL;
}

/* The place of a formula's error, as exactly as the way the word is written allows. */
static ves_mark error_mark(const ves_reader *reader, ves_text_part part, const ves_formula_error *error)
{
    if (part.node->exact == (size_t)-1) return ves_reader_mark(reader, part.node);
    return ves_script_mark(reader->script, part.node->exact + (size_t)(part.from + error->offset),
                           (size_t)error->length);
}

/* A formula that the mark cannot point into, on one line. */
static const char *excerpt(ves_reader *reader, const char *text)
{
    size_t length = strlen(text);
    while (length && isspace((unsigned char)text[length - 1])) length--;
    char *copy = ves_arena_text(reader->arena, text, length < 60 ? length : 60);
    for (char *c = copy; c && *c; c++)
        if ((unsigned char)*c < 32) *c = ' ';
    return copy ? copy : "";
}

static void complain(ves_reader *reader, ves_text_part part, const char *text, const ves_formula_error *error)
{
    const char *known = error->status == VES_UNIT ? NULL : surprise(text);
    if (error->status == VES_MEMORY)
        reader->status = VES_MEMORY;
    else if (known)
        ves_reader_error(reader, VES_SYNTAX, part.node, "\"%s\" %s", text, known);
    else if (part.node->exact == (size_t)-1)
        ves_reader_fail(reader, error->status, error_mark(reader, part, error), "in \"%s\": %s",
                        excerpt(reader, text), error->text);
    else
        ves_reader_fail(reader, error->status, error_mark(reader, part, error), "%s", error->text);
}

static bool note_use(ves_reader *reader, const ves_formula *formula)
{
    if (reader->uses == reader->use_room) {
        int room = reader->use_room ? 2 * reader->use_room : 256;
        ves_use *more = ves_memory_grow(reader->use, (size_t)room * sizeof *more);
        if (!ves_reader_memory(reader, more)) return false;
        reader->use = more;
        reader->use_room = room;
    }
    reader->use[reader->uses++] = (ves_use){formula, reader->owner};
    return true;
}

static bool grow_room(ves_reader *reader, const ves_formula *formula)
{
    int need = ves_formula_room(formula);
    if (need <= reader->rooms) return true;
    double *more = ves_memory_grow(reader->room, (size_t)(2 * need) * sizeof *more);
    if (!ves_reader_memory(reader, more)) return false;
    reader->room = more;
    reader->rooms = 2 * need;
    return true;
}

const ves_formula *ves_reader_formula(ves_reader *reader, ves_text_part part, const ves_symbol *argument,
                                      int arguments)
{
    const char *text =
        ves_arena_text(reader->arena, part.node->text + part.from, (size_t)(part.to - part.from));
    if (!ves_reader_memory(reader, text)) return NULL;
    const ves_scope scope = {reader->slot, reader->slots, argument, arguments, reader->dimensions};
    const ves_formula *formula = NULL;
    ves_formula_error error = {.status = VES_OK};
    if (ves_formula_compile(text, &scope, reader->arena, &formula, &error) != VES_OK) {
        complain(reader, part, text, &error);
        return NULL;
    }
    if (ves_formula_has_units(formula)) reader->units = true;
    return grow_room(reader, formula) && note_use(reader, formula) ? formula : NULL;
}

double ves_reader_value(ves_reader *reader, const ves_formula *formula)
{
    if (!formula) return NAN;
    return ves_formula_eval(formula, reader->value, NULL, reader->room);
}

bool ves_reader_varies(const ves_reader *reader, const ves_formula *formula)
{
    if (!formula || ves_formula_is_constant(formula, NULL)) return false;
    for (int k = 0; k < reader->slots; k++)
        if (reader->varying[k] && ves_formula_uses_slot(formula, k)) return true;
    return false;
}

int ves_reader_append(ves_reader *reader, const ves_formula *formula)
{
    if (reader->numbers == reader->number_room) {
        int room = reader->number_room ? 2 * reader->number_room : 256;
        const ves_formula **more = ves_memory_grow(reader->number, (size_t)room * sizeof *more);
        if (!ves_reader_memory(reader, more)) return -1;
        reader->number = more;
        reader->number_room = room;
    }
    reader->number[reader->numbers] = formula;
    return reader->slots + reader->numbers++;
}

static void wrong_dim(ves_reader *reader, const ves_node *node, const char *name, ves_dim want, ves_dim dim)
{
    char wanted[64], found[64];
    ves_dim_describe(want, wanted);
    ves_dim_describe(dim, found);
    ves_reader_error(reader, VES_UNIT, node, "\"%s\" must be %s, found %s%s", name, wanted, found,
                     ves_dim_plain(dim) ? "; numbers of this file have units" : "");
}

/* The first key without a unit of its own says what the points of a curve are of. Where it and a length
 * disagree, it is most likely the one that is wrong. */
static bool free_dim(ves_reader *reader, const ves_node *node, const char *name, ves_dim dim)
{
    const ves_dim length = {.m = 6};
    if (reader->free->any && !dim.any) {
        *reader->free = dim;
        reader->free_node = node;
        reader->free_name = name;
    }
    if (ves_dim_equal(*reader->free, dim)) return true;
    if (!reader->lengths || !reader->free_node || !ves_dim_equal(length, dim)) return false;
    wrong_dim(reader, reader->free_node, reader->free_name, length, *reader->free);
    *reader->free = length;
    return true;
}

void ves_reader_check_dim(ves_reader *reader, const ves_node *node, const char *name, const char *unit,
                          ves_dim dim)
{
    if (!reader->dimensions || (!unit && !reader->free)) return;
    ves_dim want = {0};
    if (!unit && free_dim(reader, node, name, dim)) return;
    if (unit)
        ves_dim_read(unit, &want, NULL);
    else
        want = *reader->free;
    if (!ves_dim_equal(want, dim)) wrong_dim(reader, node, name, want, dim);
}

static bool bounded(const ves_key *key)
{
    return key->min != 0 || key->max != 0;
}

static bool inside(const ves_key *key, double value)
{
    return !bounded(key) || (value >= key->min && value <= key->max);
}

static void check_range(ves_reader *reader, const ves_node *node, const ves_key *key,
                        const ves_formula *formula)
{
    double value = ves_reader_value(reader, formula);
    bool constant = !ves_reader_varies(reader, formula);
    if (!constant && (isnan(value) || !bounded(key))) return;
    char limits[96], got[VES_QUANTITY];
    ves_quantity_text(value, ves_formula_dim(formula), reader->dimensions, got);
    ves_limit_text(key->min, key->max, limits);
    if (isinf(value) && constant) {
        ves_reader_error(reader, VES_RANGE, node,
                         "\"%s\" has no finite value: a division by zero, or beyond 1.8e308", key->name);
    } else if (!isfinite(value) && constant) {
        if (!isnan(value) || ves_formula_is_constant(formula, NULL))
            ves_reader_error(reader, VES_RANGE, node,
                             "\"%s\" has no value: 0/0, or a root or a logarithm of a negative number",
                             key->name);
    } else if (!inside(key, value)) {
        ves_reader_error(reader, VES_RANGE, node, "\"%s\" must be %s, got %s%s", key->name, limits, got,
                         constant ? "" : " at the start");
    }
}

/* The range of a variable that stands there by itself must lie in the range of the key. */
static void check_variable(ves_reader *reader, const ves_node *node, const ves_key *key)
{
    const ves_problem *problem = reader->problem;
    for (int k = 0; bounded(key) && k < problem->variables; k++) {
        const ves_variable *v = &problem->variable[k];
        if (strcmp(v->name, node->text)) continue;
        double worst = inside(key, v->min) ? v->max : v->min;
        if (inside(key, worst) || isnan(worst)) return;
        char limits[96], got[VES_QUANTITY];
        ves_limit_text(key->min, key->max, limits);
        ves_quantity_text(worst, v->dim, reader->dimensions, got);
        ves_reader_error(reader, VES_RANGE, node, "\"%s\" must be %s, but variable \"%s\" may become %s",
                         key->name, limits, v->name, got);
        return;
    }
}

/* Most numbers of a large file are plain. */
static const ves_formula *plain_number(ves_reader *reader, const ves_node *node)
{
    double value;
    if (!ves_text_number(node->text, &value)) return NULL;
    if (reader->dimensions && value != 0)
        return NULL; /* a constant has every dimension, a plain number has not */
    const ves_formula *formula = ves_formula_constant(value, reader->arena);
    return ves_reader_memory(reader, formula) && grow_room(reader, formula) ? formula : NULL;
}

const ves_formula *ves_reader_number(ves_reader *reader, const ves_node *node, const ves_key *key)
{
    if (node->kind != VES_NODE_WORD || (node->plain && !*node->text)) {
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" must be a number or a formula, found %s",
                         key->name,
                         node->kind == VES_NODE_LIST  ? "a list"
                         : node->kind == VES_NODE_MAP ? "a mapping"
                                                      : "nothing");
        return NULL;
    }
    const ves_formula *formula = plain_number(reader, node);
    if (!formula) formula = ves_reader_formula(reader, ves_text_whole(node), NULL, 0);
    if (!formula) return NULL;
    int before = reader->errors;
    ves_reader_check_dim(reader, node, key->name, key->unit, ves_formula_dim(formula));
    check_range(reader, node, key, formula);
    if (reader->errors == before) check_variable(reader, node, key);
    return formula;
}

static void note_limit(ves_reader *reader, const ves_node *node, const ves_key *key, int number, ves_dim dim)
{
    if (reader->limits == reader->limit_room) {
        int room = reader->limit_room ? 2 * reader->limit_room : 16;
        ves_reader_limit *more = ves_memory_grow(reader->limit, (size_t)room * sizeof *more);
        if (!ves_reader_memory(reader, more)) return;
        reader->limit = more;
        reader->limit_room = room;
    }
    const ves_limit limit = {number, key->min, key->max, key->name, dim, ves_reader_mark(reader, node)};
    reader->limit[reader->limits++] = (ves_reader_limit){limit, reader->owner};
}

int ves_reader_place(ves_reader *reader, const ves_node *node, const ves_key *key)
{
    const ves_formula *formula = ves_reader_number(reader, node, key);
    int index = ves_reader_append(reader, formula);
    if (bounded(key) && ves_reader_varies(reader, formula))
        note_limit(reader, node, key, index, ves_formula_dim(formula));
    return index;
}

double ves_reader_constant(ves_reader *reader, const ves_node *node, const ves_key *key)
{
    const ves_formula *formula = ves_reader_number(reader, node, key);
    if (!formula) return NAN;
    if (!ves_reader_varies(reader, formula)) return ves_reader_value(reader, formula);
    ves_reader_error(reader, VES_RANGE, node, "\"%s\" must be constant, but depends on a variable",
                     key->name);
    return NAN;
}

long ves_reader_count(ves_reader *reader, const ves_node *node, const ves_key *key)
{
    ves_key plain = *key;
    plain.unit = "1";
    int before = reader->errors;
    double value = ves_reader_constant(reader, node, &plain);
    if (isnan(value) || reader->errors > before) return 0;
    if (value == floor(value) && fabs(value) <= 9007199254740992.0) return (long)value;
    if (value == floor(value))
        ves_reader_error(reader, VES_RANGE, node,
                         "\"%s\" is beyond what a whole number may be (2^53), found \"%s\"", key->name,
                         node->text);
    else
        ves_reader_error(reader, VES_RANGE, node, "\"%s\" must be a whole number, found \"%s\"", key->name,
                         node->text);
    return 0;
}

/* Sections: families of curves, and patches that pass through curves placed along u. A section of a family is
 * the curve that the family's formula makes of one number; nothing names it but its patch. */
#include "problem/reader.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "formula/dimension.h"

static bool is_slot(const ves_reader *reader, const char *name)
{
    for (int k = 0; k < reader->slots; k++)
        if (!strcmp(reader->slot[k].name, name)) return true;
    return false;
}

const char *ves_reader_family(ves_reader *reader, const ves_node *family, const ves_curve_op *source)
{
    if (!ves_reader_word(reader, family, "name") ||
        !ves_reader_new_name(reader, family, "family's number", true))
        return NULL;
    if (strcmp(source->name, "formula"))
        ves_reader_error(reader, VES_SYNTAX, family, "a family is made by \"formula\", not by \"%s\"",
                         source->name);
    else if (is_slot(reader, family->text))
        ves_reader_error(reader, VES_NAME, family,
                         "\"%s\" is a name of this file already: the number of a family needs one of its own",
                         family->text);
    else
        return family->text;
    return NULL;
}

/* What is being read. */
typedef struct sections {
    ves_reader *reader;
    const ves_node *node;
    ves_fields f;
    int count;
    bool equal;
    ves_condition *out;
    /* of a family */
    int family;
    const ves_node *bound[2];
    double value[2]; /* of those that are constant */
    bool varies[2];
} sections;

/* Chebyshev's nodes, whose Lebesgue number stays small [docs/errata.md, Fig. 4.5]; the last mirror the first. */
static double place(const sections *s, int i)
{
    int last = s->count - 1, near = 2 * i > last ? last - i : i;
    if (s->equal) return (double)i / last;
    double root = sin(VES_TWO_PI / 4 * near / last), u = 2 * i == last ? 0.5 : root * root;
    return near < i ? 1 - u : u;
}

static void check_length(const sections *s, const ves_node *node, ves_dim dim)
{
    const ves_dim length = {.m = 6};
    char found[64];
    if (!s->reader->dimensions || ves_dim_equal(dim, length)) return;
    ves_dim_describe(dim, found);
    ves_reader_error(s->reader, VES_UNIT, node, "points of \"%s\" must be a length (m), found %s", node->text,
                     found);
}

static void pass_through(sections *s, int i, const ves_node *node, int curve)
{
    ves_share *share = ves_arena_take(s->reader->arena, 1, sizeof *share);
    if (!ves_reader_memory(s->reader, share)) return;
    *share = (ves_share){curve, 1};
    s->out[i] = (ves_condition){.mark = ves_reader_mark(s->reader, node),
                                .u = place(s, i),
                                .shares = curve >= 0,
                                .share = share,
                                .scale = -1};
    if (curve >= 0) s->reader->curve_used[curve] = true;
}

/* --- of a family --- */

/* The formula of the family's number at u; at an end, of that bound alone. */
static const ves_formula *number(sections *s, double u)
{
    ves_reader *reader = s->reader;
    bool first = s->varies[0] && u < 1, last = s->varies[1] && u > 0;
    if (!first && !last) return ves_formula_constant((1 - u) * s->value[0] + u * s->value[1], reader->arena);
    ves_node word = *s->bound[0];
    word.kind = VES_NODE_WORD;
    word.plain = true;
    word.exact = (size_t)-1; /* no text of the file */
    word.text = ves_arena_format(reader->arena, "%.17g*(%s) + %.17g*(%s)", 1 - u, s->bound[0]->text, u,
                                 s->bound[1]->text);
    if (!ves_reader_memory(reader, word.text)) return NULL;
    return ves_reader_formula(reader, ves_text_whole(&word), NULL, 0);
}

/* The steps of the family, with the number of one section. */
static const ves_curve_step *steps_at(sections *s, const ves_family *family, double u)
{
    ves_reader *reader = s->reader;
    ves_curve_step *step = ves_arena_take(reader->arena, (size_t)family->steps, sizeof *step);
    ves_key *key = ves_arena_take(reader->arena, 3, sizeof *key);
    ves_arg *arg = ves_arena_take(reader->arena, 2, sizeof *arg);
    const ves_formula *formula = number(s, u);
    if (!formula || !ves_reader_memory(reader, step) || !ves_reader_memory(reader, key) ||
        !ves_reader_memory(reader, arg))
        return NULL;
    memcpy(step, family->step, (size_t)family->steps * sizeof *step);
    key[0] = step->args.key[0], arg[0] = step->args.arg[0];
    key[1] = (ves_key){.name = family->parameter, .kind = VES_NUMBER, .unit = "1"};
    arg[1] = (ves_arg){.given = true,
                       .mark = ves_reader_mark(reader, s->bound[0]),
                       .first = ves_reader_append(reader, formula),
                       .count = 1};
    step->args = (ves_args){key, arg, 2, step->args.mark};
    return step;
}

static int make(sections *s, int i)
{
    ves_reader *reader = s->reader;
    const ves_family *family = &reader->family[s->family];
    const char *name = ves_arena_format(reader->arena, "%s[%d]", reader->curves.name[s->family].text, i + 1);
    const ves_curve_step *step = steps_at(s, family, place(s, i));
    if (!step || !ves_reader_memory(reader, name)) return -1;
    reader->curve[reader->curves_read] = (ves_curve_def){.name = name,
                                                         .mark = ves_reader_mark(reader, s->node),
                                                         .steps = family->steps,
                                                         .step = step,
                                                         .dim = family->dim};
    return reader->curves_read++;
}

/* Patches that end on the same section meet there: it is one curve. Numbers that vary are the same when they
 * are written alike. */
static int end(sections *s, int i)
{
    ves_reader *reader = s->reader;
    int side = i > 0;
    const ves_section own = {.family = s->family,
                             .text = s->varies[side] ? s->bound[side]->text : NULL,
                             .at = s->varies[side] ? 0 : s->value[side]};
    for (int k = 0; k < reader->sections; k++) {
        const ves_section *other = &reader->section[k];
        bool same = own.text && other->text ? !strcmp(own.text, other->text)
                                            : !own.text && !other->text && own.at == other->at;
        if (other->family == own.family && same) return other->curve;
    }
    int curve = make(s, i);
    if (curve < 0) return -1;
    reader->section[reader->sections] = own;
    reader->section[reader->sections++].curve = curve;
    return curve;
}

static bool read_bounds(sections *s, const ves_node *node)
{
    ves_reader *reader = s->reader;
    const ves_key key = {.name = "w", .kind = VES_NUMBER, .unit = "1"};
    int before = reader->errors;
    if (node->kind != VES_NODE_LIST || node->count != 2) {
        ves_reader_error(reader, VES_SYNTAX, node, "\"%s\" must be [from, to]", "w");
        return false;
    }
    for (int k = 0; k < 2; k++) {
        const ves_formula *formula = ves_reader_number(reader, node->item[k], &key);
        s->bound[k] = node->item[k];
        s->value[k] = ves_reader_value(reader, formula);
        s->varies[k] = ves_reader_varies(reader, formula);
    }
    return reader->errors == before;
}

static bool lacks(const sections *s, const char *key)
{
    if (ves_fields_find(&s->f, key)) return false;
    if (!ves_fields_excused(&s->f, key))
        ves_reader_error(s->reader, VES_NAME, s->node, "\"sections\" of a family lack the key \"%s\"", key);
    return true;
}

static void read_family(sections *s, const ves_node *of)
{
    ves_reader *reader = s->reader;
    bool lacking = lacks(s, "w");
    if (lacks(s, "count") || lacking) return;
    const ves_field *count = ves_fields_field(&s->f, "count");
    int before = reader->errors;
    s->count = (int)ves_reader_count(reader, count->node, count->key);
    const ves_named *name = ves_names_ask(reader, &reader->curves, of);
    if (!read_bounds(s, ves_fields_find(&s->f, "w")) || reader->errors > before) {
        s->count = 0;
        return;
    }
    s->family = (int)(name - reader->curves.name);
    ves_family *family = &reader->family[s->family];
    if (!family->parameter) {
        ves_reader_error(reader, VES_NAME, of,
                         "\"%s\" is one curve, not a family: {family: w, formula: [...]}, or give "
                         "\"sections\" a list of \"curves\"",
                         of->text);
        s->count = 0;
        return;
    }
    family->used = true;
    check_length(s, of, family->dim);
    for (int i = 0; i < s->count; i++) {
        bool outer = i == 0 || i == s->count - 1;
        pass_through(s, i, s->node, !family->steps ? -1 : outer ? end(s, i) : make(s, i));
    }
    reader->problem->curves = reader->curves_read;
}

/* --- of curves by name --- */

static void read_curves(sections *s, const ves_node *list)
{
    ves_reader *reader = s->reader;
    static const char *const other[] = {"w", "count"};
    for (int k = 0; k < 2; k++)
        if (ves_fields_find(&s->f, other[k]))
            ves_reader_error(reader, VES_SYNTAX, ves_fields_field(&s->f, other[k])->word,
                             "\"%s\" goes with \"of\", not with \"curves\"", other[k]);
    int count = list->kind == VES_NODE_LIST ? list->count : 0;
    if (count < 2 || count > VES_CONDITIONS_MAX) {
        ves_reader_error(reader, count ? VES_RANGE : VES_SYNTAX, list,
                         "\"curves\" must be a list [p1, p2, ...] of 2 to %d curves", VES_CONDITIONS_MAX);
        return;
    }
    s->count = count;
    for (int i = 0; i < count; i++) {
        int curve = ves_reader_curve(reader, list->item[i]);
        if (curve >= 0) check_length(s, list->item[i], reader->curve[curve].dim);
        pass_through(s, i, list->item[i], curve);
    }
}

int ves_reader_sections(ves_reader *reader, const ves_node *node, ves_condition *out)
{
    sections s = {.reader = reader, .node = node, .out = out};
    const ves_entry *patch = ves_schema_find(ves_schema_root.table, "patches")->table->table;
    if (!ves_fields_read(reader, node, ves_schema_find(patch, "sections")->table, "sections", &s.f)) return 0;
    const ves_node *of = ves_fields_find(&s.f, "of"), *curves = ves_fields_find(&s.f, "curves");
    const ves_field *nodes = ves_fields_field(&s.f, "nodes");
    if (nodes->node) s.equal = ves_reader_choice(reader, nodes->node, nodes->key);
    if (ves_fields_excused(&s.f, "of") || ves_fields_excused(&s.f, "curves")) return 0;
    if (!of == !curves)
        ves_fields_one_of(reader, node, &s.f, "sections", "of", "curves");
    else if (of)
        read_family(&s, of);
    else
        read_curves(&s, curves);
    return s.count;
}

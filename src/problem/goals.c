/* What is asked of the shape: solve, scale, objective, constraints, expect. All are formulas of slots and
 * measures. */
#include <string.h>

#include "formula/dimension.h"
#include "problem/reader.h"

enum { IGNORED = -3 }; /* owner of formulas that drive nothing */

/* The measures as arguments. */
typedef struct scope {
    ves_reader *reader;
    ves_symbol *symbol, *check; /* check: with objective, violation, ... */
    int symbols, checks;
} scope;

typedef struct items {
    const ves_node *single;
    const ves_node *const *item;
    int count;
} items;

/* A list, or one item that stands for a list of one. */
static void items_of(const ves_node *node, items *out)
{
    out->single = node;
    out->item = node && node->kind == VES_NODE_LIST ? node->item : &out->single;
    out->count = !node ? 0 : node->kind == VES_NODE_LIST ? node->count : 1;
}

static const ves_node *relation_word(const ves_node *item)
{
    return item->kind == VES_NODE_MAP ? ves_node_find(item, "require") : item;
}

static void scan_list(ves_reader *reader, const ves_node *list)
{
    items all;
    items_of(list, &all);
    for (int k = 0; k < all.count; k++) ves_reader_plain_measures(reader, relation_word(all.item[k]));
}

static void scan(ves_reader *reader, const ves_fields *root)
{
    ves_reader_plain_measures(reader, ves_node_find(ves_fields_find(root, "solve"), "equation"));
    ves_reader_plain_measures(reader, ves_node_find(ves_fields_find(root, "scale"), "equation"));
    ves_reader_plain_measures(reader, ves_fields_find(root, "minimize"));
    ves_reader_plain_measures(reader, ves_fields_find(root, "maximize"));
    scan_list(reader, ves_fields_find(root, "constraints"));
    scan_list(reader, ves_node_find(ves_fields_find(root, "validity"), "holds"));
    for (int k = 0; k < reader->kinds.count; k++)
        ves_reader_plain_measures(reader, reader->kinds.name[k].value);
    scan_list(reader, ves_fields_find(root, "expect"));
    scan_list(reader, ves_node_find(ves_fields_find(root, "test"), "expect"));
}

/* "left OP right" */
typedef struct relation {
    char op[3];
    const ves_formula *left, *right;
    ves_text_part left_part;
} relation;

static bool split(ves_reader *reader, const ves_node *node, relation *r, int *left_end, int *right_begin)
{
    if (!ves_reader_word(reader, node, "relation, as in area <= 14")) return false;
    if (ves_formula_split(node->text, r->op, left_end, right_begin) == VES_OK) return true;
    const char *equal = strchr(node->text, '=');
    bool single = equal && (equal == node->text || !strchr("<>=!", equal[-1])) && equal[1] != '=';
    bool unequal = strstr(node->text, "!=");
    ves_reader_error(reader, VES_SYNTAX, node, "\"%.80s\" must be one relation of two formulas%s", node->text,
                     single    ? "; equality is written =="
                     : unequal ? "; != is none"
                               : ", as in area <= 14");
    return false;
}

static void check_sides(ves_reader *reader, const ves_node *node, const relation *r)
{
    if (!reader->dimensions || !r->left || !r->right) return;
    ves_dim a = ves_formula_dim(r->left), b = ves_formula_dim(r->right);
    if (ves_dim_equal(a, b)) return;
    char left[64], right[64];
    ves_dim_describe(a, left);
    ves_dim_describe(b, right);
    ves_reader_error(reader, VES_UNIT, node, "the left side is %s, the right side %s", left, right);
}

static bool read_relation(scope *s, const ves_node *node, relation *r)
{
    int left_end, right_begin;
    *r = (relation){.left = NULL};
    if (!split(s->reader, node, r, &left_end, &right_begin)) return false;
    r->left_part = (ves_text_part){node, 0, left_end};
    ves_text_part right = {node, right_begin, (int)strlen(node->text)};
    r->left = ves_reader_goal(s->reader, r->left_part, s->symbol, s->symbols);
    r->right = ves_reader_goal(s->reader, right, s->symbol, s->symbols);
    check_sides(s->reader, node, r);
    return r->left && r->right;
}

static bool read_equation(scope *s, const ves_node *node, relation *r)
{
    if (!read_relation(s, node, r)) return false;
    if (!strcmp(r->op, "==")) return true;
    ves_reader_error(s->reader, VES_SYNTAX, node, "an equation needs ==, found %s", r->op);
    return false;
}

static void read_solve(scope *s, const ves_node *node)
{
    ves_fields f;
    ves_solve *solve = (ves_solve *)s->reader->problem->solve;
    if (!node || !ves_fields_read(s->reader, node, ves_schema_find(ves_schema_root.table, "solve")->table,
                                  "solve", &f))
        return;
    const ves_node *equation = ves_fields_find(&f, "equation"), *unknown = ves_fields_find(&f, "unknown");
    relation r;
    if (unknown) ves_reader_word(s->reader, unknown, "new name");
    if (!equation || !read_equation(s, equation, &r) || !solve) return;
    solve->left = r.left;
    solve->right = r.right;
}

/* The measure that is one side of a relation, text[from .. to), by itself; -1: it is something else. */
static int measure_alone(const ves_reader *reader, const char *text, int from, int to)
{
    while (from < to && text[from] == ' ') from++;
    while (to > from && text[to - 1] == ' ') to--;
    for (int k = 0; k < reader->measures_read; k++) {
        const char *name = reader->measure[k].name;
        if (strlen(name) == (size_t)(to - from) && !strncmp(text + from, name, (size_t)(to - from))) return k;
    }
    return -1;
}

/* MEASURE == formula of slots: similarity turns it into one power. */
static void read_scale(scope *s, const ves_node *node)
{
    ves_reader *reader = s->reader;
    ves_fields f;
    relation r;
    if (!node ||
        !ves_fields_read(reader, node, ves_schema_find(ves_schema_root.table, "scale")->table, "scale", &f))
        return;
    const ves_node *equation = ves_fields_find(&f, "equation");
    if (!equation || !read_equation(s, equation, &r)) return;
    int measure = measure_alone(reader, equation->text, 0, r.left_part.to);
    for (int k = 0; k < reader->measures_read; k++)
        if (ves_formula_uses_argument(r.right, k)) measure = -1;
    if (measure < 0) {
        ves_reader_error(reader, VES_SYNTAX, equation,
                         "scale needs MEASURE == formula of variables and parameters, as in area == 4*pi");
        return;
    }
    if (reader->measure[measure].measure->degree == VES_NO_DEGREE) {
        ves_reader_error(reader, VES_RANGE, equation,
                         "how \"%s\" grows with the shape is not known; scale needs a measure like area",
                         reader->measure[measure].name);
        return;
    }
    if (reader->measure[measure].measure->degree == 0) {
        ves_reader_error(reader, VES_RANGE, equation, "scaling a shape does not change its \"%s\"",
                         reader->measure[measure].name);
        return;
    }
    ves_scale *scale = ves_arena_take(reader->arena, 1, sizeof *scale);
    if (!ves_reader_memory(reader, scale)) return;
    *scale = (ves_scale){ves_reader_mark(reader, node), measure, r.right};
    reader->problem->scale = scale;
}

static bool depends(const scope *s, const ves_formula *formula)
{
    if (ves_reader_varies(s->reader, formula)) return true;
    for (int k = 0; k < s->symbols; k++)
        if (ves_formula_uses_argument(formula, k)) return true;
    return false;
}

static void read_objective(scope *s, const ves_fields *root)
{
    const ves_node *low = ves_fields_find(root, "minimize"), *high = ves_fields_find(root, "maximize");
    const ves_node *node = low ? low : high;
    ves_problem *problem = s->reader->problem;
    if (low && high)
        ves_reader_error(s->reader, VES_SYNTAX, high,
                         "only one of \"minimize\" and \"maximize\" can be asked for");
    if (!node || !ves_reader_word(s->reader, node, "formula of measures")) return;
    problem->objective = ves_reader_goal(s->reader, ves_text_whole(node), s->symbol, s->symbols);
    problem->objective_text = node->text;
    problem->objective_mark = ves_reader_mark(s->reader, node);
    problem->maximize = !low;
    if (problem->objective && !depends(s, problem->objective))
        ves_reader_error(s->reader, VES_RANGE, node, "the objective depends on no measure and no variable");
}

/* A measure alone on the left that must have more than any surface has. */
static void check_possible(scope *s, const ves_node *node, const relation *r)
{
    const int k = measure_alone(s->reader, node->text, 0, r->left_part.to);
    const ves_measure *measure = k < 0 ? NULL : s->reader->measure[k].measure;
    if (!measure || measure->most == 0 || *r->op == '<' || depends(s, r->right)) return;
    const double asked = ves_reader_value(s->reader, r->right);
    if (asked > measure->most)
        ves_reader_error(s->reader, VES_RANGE, node, "\"%s\" cannot exceed %g (%s), and %.9g is asked for",
                         s->reader->measure[k].name, measure->most, measure->most_of, asked);
}

static void read_constraint(scope *s, const ves_node *item, ves_constraint_def *out)
{
    ves_reader *reader = s->reader;
    const ves_entry *table = ves_schema_find(ves_schema_root.table, "constraints")->table->table;
    const ves_node *node = item;
    ves_fields f;
    relation r;
    *out = (ves_constraint_def){.mark = ves_reader_mark(reader, item), .within = 1e-6};
    if (item->kind == VES_NODE_MAP) {
        if (!ves_fields_read(reader, item, table, "constraint", &f)) return;
        const ves_node *within = ves_fields_find(&f, "within");
        node = ves_fields_find(&f, "require");
        if (within) out->within = ves_reader_constant(reader, within, f.field[1].key);
        if (!node) return;
    }
    if (!read_relation(s, node, &r)) return;
    out->text = node->text;
    out->left = r.left;
    out->right = r.right;
    out->relation = *r.op == '<' ? VES_AT_MOST : *r.op == '>' ? VES_AT_LEAST : VES_EQUAL;
    if (!strcmp(r.op, "<") || !strcmp(r.op, ">"))
        ves_reader_error(reader, VES_SYNTAX, node, "a constraint includes its limit: write %s= instead of %s",
                         r.op, r.op);
    else if (!depends(s, r.left) && !depends(s, r.right))
        ves_reader_error(reader, VES_RANGE, node, "this constraint depends on no measure and no variable");
    else
        check_possible(s, node, &r);
}

static void read_constraints(scope *s, const ves_node *list)
{
    items all;
    items_of(list, &all);
    ves_constraint_def *out = ves_arena_take(s->reader->arena, (size_t)all.count, sizeof *out);
    if (!ves_reader_memory(s->reader, out)) return;
    for (int k = 0; k < all.count; k++) read_constraint(s, all.item[k], &out[k]);
    s->reader->problem->constraint = out;
    s->reader->problem->constraints = all.count;
}

/* What every accepted best must meet: looked at when it is proved, so no variable is driven by it. */
static void read_holds(scope *s, const ves_node *list)
{
    ves_reader *reader = s->reader;
    ves_validity_def *validity = &reader->problem->validity;
    items all;
    items_of(list, &all);
    ves_expect_def *out = ves_arena_take(reader->arena, (size_t)all.count, sizeof *out);
    if (!ves_reader_memory(reader, out)) return;
    reader->owner = IGNORED;
    for (int k = 0; k < all.count; k++) {
        const ves_node *node = all.item[k];
        if (!ves_reader_word(reader, node, "check, as in willmore >= 4*pi")) continue;
        const ves_formula *formula = ves_reader_goal(reader, ves_text_whole(node), s->symbol, s->symbols);
        out[k] = (ves_expect_def){ves_reader_mark(reader, node), node->text, formula};
        if (formula && !depends(s, formula))
            ves_reader_error(reader, VES_RANGE, node, "this check depends on no measure and no variable");
    }
    reader->owner = -1;
    validity->check = out;
    validity->checks = all.count;
}

/* Names for designs: they drive nothing. */
static void read_kinds(scope *s)
{
    ves_reader *reader = s->reader;
    const ves_names *names = &reader->kinds;
    ves_kind_def *out = ves_arena_take(reader->arena, (size_t)names->count, sizeof *out);
    if (!ves_reader_memory(reader, out)) return;
    reader->owner = IGNORED;
    for (int k = 0; k < names->count; k++) {
        const ves_node *node = names->name[k].value;
        out[k] = (ves_kind_def){.name = names->name[k].text, .mark = ves_reader_mark(reader, node)};
        if (!ves_reader_word(reader, node, "condition, as in width > 2*depth")) continue;
        out[k].text = node->text;
        out[k].formula = ves_reader_goal(reader, ves_text_whole(node), s->symbol, s->symbols);
        if (out[k].formula && ves_formula_is_constant(out[k].formula, NULL))
            ves_reader_error(reader, VES_RANGE, node,
                             "this condition reads no measure, variable or parameter");
    }
    reader->owner = -1;
    reader->problem->kind = out;
    reader->problem->kinds = names->count;
}

static const ves_expect_def *read_expect(scope *s, const ves_node *list, int *count)
{
    items all;
    items_of(list, &all);
    ves_expect_def *out = ves_arena_take(s->reader->arena, (size_t)all.count, sizeof *out);
    if (!ves_reader_memory(s->reader, out)) return NULL;
    s->reader->owner = IGNORED;
    for (int k = 0; k < all.count; k++) {
        const ves_node *node = all.item[k];
        if (!ves_reader_word(s->reader, node, "check, as in violation < 1e-6")) continue;
        out[k] = (ves_expect_def){ves_reader_mark(s->reader, node), node->text,
                                  ves_reader_goal(s->reader, ves_text_whole(node), s->check, s->checks)};
    }
    s->reader->owner = -1;
    *count = all.count;
    return out;
}

void ves_reader_goals(ves_reader *reader, const ves_fields *root)
{
    ves_problem *problem = reader->problem;
    scan(reader, root);
    scope s = {.reader = reader};
    s.symbol = ves_reader_symbols(reader, false, &s.symbols);
    if (!s.symbol) return;
    read_solve(&s, ves_fields_find(root, "solve"));
    read_scale(&s, ves_fields_find(root, "scale"));
    read_objective(&s, root);
    read_constraints(&s, ves_fields_find(root, "constraints"));
    read_kinds(&s);
    read_holds(&s, ves_node_find(ves_fields_find(root, "validity"), "holds"));
    s.check = ves_reader_symbols(reader, true, &s.checks);
    if (!s.check) return;
    problem->expect = read_expect(&s, ves_fields_find(root, "expect"), &problem->expects);
    problem->test_expect =
        read_expect(&s, ves_node_find(ves_fields_find(root, "test"), "expect"), &problem->test_expects);
    problem->measure = reader->measure;
    problem->measures = reader->measures_read;
}

/* The units in which people are told a number: those in which the file writes it, or what it is compared
 * with, or its lengths. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "problem/reader.h"

enum { SIXTHS = 6, ENDS = 3, SHORT = 8 };

static void show_si(ves_dim dim, ves_shown *shown)
{
    static const char *const named[] = {"N", "Pa", "J", "N/m"};
    char text[48];
    ves_dim of;
    *shown = (ves_shown){.factor = 1};
    if (ves_dim_plain(dim)) return;
    ves_dim_text(dim, text);
    const char *word = text;
    for (size_t k = 0; k < sizeof named / sizeof *named; k++)
        if (ves_dim_read(named[k], &of, &shown->factor) && ves_dim_equal(of, dim)) word = named[k];
    shown->factor = 1;
    if (strlen(word) < VES_UNIT_TEXT) memcpy(shown->unit, word, strlen(word) + 1);
}

/* The ends of a range come before its start, which --set may have written otherwise. */
void ves_shown_find(const ves_node *const *word, int count, ves_dim dim, ves_shown *shown)
{
    static const int order[ENDS] = {0, 2, 1};
    show_si(dim, shown);
    for (int k = 0; k < ENDS; k++) {
        const ves_node *node = order[k] < count ? word[order[k]] : NULL;
        if (node && node->kind == VES_NODE_WORD &&
            ves_unit_find(node->text, dim, shown->unit, &shown->factor))
            return;
    }
}

static bool same(ves_dim a, ves_dim b)
{
    return !a.any && !b.any && ves_dim_equal(a, b);
}

/* A variable, unknown or parameter of this dimension. formula: one that it reads; NULL: any. */
static bool find_slot(const ves_problem *p, const ves_formula *formula, ves_dim dim, ves_shown *shown)
{
    for (int k = 0; k < p->slots; k++) {
        int parameter = k - p->variables - p->unknowns;
        const ves_parameter *q = parameter >= 0 ? &p->parameter[parameter] : NULL;
        ves_dim own = k < p->variables ? p->variable[k].dim : q ? ves_formula_dim(q->formula) : p->solve->dim;
        if (!same(own, dim) || (formula && !ves_formula_uses_slot(formula, k))) continue;
        *shown = k < p->variables ? p->variable[k].shown : q ? q->shown : p->solve->shown;
        return true;
    }
    return false;
}

/* What stands on both sides of a relation, or a formula alone. */
typedef struct source {
    const char *text;
    const ves_formula *formula[2];
} source;

static bool find_source(const ves_problem *p, source s, ves_dim dim, ves_shown *shown)
{
    if (s.text && ves_unit_find(s.text, dim, shown->unit, &shown->factor)) return true;
    for (int k = 0; k < 2; k++)
        if (s.formula[k] && find_slot(p, s.formula[k], dim, shown)) return true;
    return false;
}

static bool reads(source s, int measure)
{
    for (int k = 0; k < 2; k++)
        if (s.formula[k] && ves_formula_uses_argument(s.formula[k], measure)) return true;
    return false;
}

/* mm^2, where the lengths of the file are in mm. */
static bool find_length(const ves_problem *p, ves_dim dim, ves_shown *shown)
{
    int power = dim.m / SIXTHS;
    ves_shown length;
    if (dim.kg || dim.s || dim.m % SIXTHS || !power || !find_slot(p, NULL, (ves_dim){.m = SIXTHS}, &length) ||
        strlen(length.unit) > SHORT)
        return false;
    shown->factor = pow(length.factor, power);
    if (abs(power) == 1)
        snprintf(shown->unit, VES_UNIT_TEXT, "%s%s", power < 0 ? "1/" : "", length.unit);
    else
        snprintf(shown->unit, VES_UNIT_TEXT, "%s%s^%d", power < 0 ? "1/" : "", length.unit, abs(power));
    return true;
}

static void find_anywhere(const ves_problem *p, ves_dim dim, ves_shown *shown)
{
    if (!find_slot(p, NULL, dim, shown) && !find_length(p, dim, shown)) show_si(dim, shown);
}

static source side_of(const ves_constraint_def *c)
{
    return (source){c->text, {c->left, c->right}};
}

static void show_measure(const ves_problem *p, const ves_fields *root, int index)
{
    ves_measure_def *m = (ves_measure_def *)&p->measure[index];
    const ves_node *solve = ves_node_find(ves_fields_find(root, "solve"), "equation"),
                   *scale = ves_node_find(ves_fields_find(root, "scale"), "equation");
    show_si(m->dim, &m->shown);
    if (ves_dim_plain(m->dim)) return;
    for (int k = 0; k < p->constraints; k++) {
        source s = side_of(&p->constraint[k]);
        if (reads(s, index) && find_source(p, s, m->dim, &m->shown)) return;
    }
    if (p->solve) {
        source s = {solve->text, {p->solve->left, p->solve->right}};
        if (reads(s, index) && find_source(p, s, m->dim, &m->shown)) return;
    }
    if (p->scale && p->scale->measure == index &&
        find_source(p, (source){scale->text, {p->scale->target}}, m->dim, &m->shown))
        return;
    for (int k = 0; k < p->validity.checks; k++) {
        source s = {p->validity.check[k].text, {p->validity.check[k].formula}};
        if (reads(s, index) && find_source(p, s, m->dim, &m->shown)) return;
    }
    for (int k = 0; k < p->expects; k++) {
        source s = {p->expect[k].text, {p->expect[k].formula}};
        if (reads(s, index) && find_source(p, s, m->dim, &m->shown)) return;
    }
    find_anywhere(p, m->dim, &m->shown);
}

/* A formula of measures: as it is written, else as the measures in it. */
static void show_goal(const ves_problem *p, source s, ves_dim dim, ves_shown *shown)
{
    show_si(dim, shown);
    if (ves_dim_plain(dim) || find_source(p, s, dim, shown)) return;
    for (int k = 0; k < p->measures; k++)
        if (reads(s, k) && same(p->measure[k].dim, dim)) {
            *shown = p->measure[k].shown;
            return;
        }
    find_anywhere(p, dim, shown);
}

static void show_constraint(const ves_problem *p, ves_constraint_def *c)
{
    char op[3];
    int left_end = 0, right_begin = 0;
    ves_dim dim = ves_formula_dim(c->left);
    if (dim.any) dim = ves_formula_dim(c->right);
    show_goal(p, side_of(c), dim, &c->shown);
    bool split = ves_formula_split(c->text, op, &left_end, &right_begin) == VES_OK;
    if (split && ves_dim_plain(dim))
        ves_unit_find(c->text + right_begin, dim, c->shown.unit, &c->shown.factor);
}

void ves_reader_shown(const ves_reader *reader, const ves_fields *root)
{
    static const ves_shown plain = {.factor = 1};
    ves_problem *p = reader->problem;
    p->objective_shown = plain;
    for (int k = 0; k < p->measures; k++) ((ves_measure_def *)&p->measure[k])->shown = plain;
    for (int k = 0; k < p->constraints; k++) ((ves_constraint_def *)&p->constraint[k])->shown = plain;
    if (!p->units) return; /* whatever measures are of, the file has no units */
    for (int k = 0; k < p->measures; k++) show_measure(p, root, k);
    for (int k = 0; k < p->constraints; k++) show_constraint(p, (ves_constraint_def *)&p->constraint[k]);
    if (p->objective)
        show_goal(p, (source){p->objective_text, {p->objective}}, ves_formula_dim(p->objective),
                  &p->objective_shown);
}

/* Checks: what validity: {holds: ...} asks of every accepted best. A search finds what the nodes do not see; what
 * theory says of all shapes (the Willmore bound, Gauss and Bonnet) tells it on the shape that it made of that. */
#include <math.h>
#include <stdio.h>

#include "plan/inside.h"

enum { TOLD = 6 }; /* numbers that a sentence names */

bool ves_plan_holds(ves_plan *plan, const ves_formula *formula)
{
    double value = ves_plan_formula(plan, formula);
    return !isnan(value) && value != 0;
}

ves_status ves_plan_checks(ves_plan *plan, int level)
{
    const ves_validity_def *v = &plan->problem->validity;
    if (!v->checks) return VES_OK;
    VES_TRY(ves_plan_run(plan, level, PROGRAM_PROOF, false));
    for (int k = 0; k < v->checks; k++) {
        if (ves_plan_holds(plan, v->check[k].formula)) continue;
        plan->broken = k, plan->broken_level = level;
        return VES_BROKEN;
    }
    return VES_OK;
}

typedef struct sentence {
    char *text;
    size_t size, length;
    int told;
    bool units;
} sentence;

static void number_tell(sentence *s, const char *name, double value, ves_dim dim)
{
    char number[VES_QUANTITY];
    if (s->told++ >= TOLD || s->length >= s->size) return;
    ves_quantity_text(value, dim, s->units, number);
    s->length += (size_t)snprintf(s->text + s->length, s->size - s->length, "%s%.60s = %s",
                                  s->told > 1 ? ", " : ", with ", name, number);
}

bool ves_plan_broken(const ves_plan *plan, char *text, size_t size)
{
    const ves_problem *p = plan->problem;
    if (plan->broken < 0) return false;
    const ves_expect_def *c = &p->validity.check[plan->broken];
    sentence s = {.text = text, .size = size, .units = p->units};
    s.length = (size_t)snprintf(text, size, "\"%.200s\"", c->text);
    for (int m = 0; m < p->measures; m++)
        if (ves_formula_uses_argument(c->formula, m))
            number_tell(&s, p->measure[m].name, plan->value[m], p->measure[m].dim);
    for (int k = 0; k < p->variables; k++)
        if (ves_formula_uses_slot(c->formula, k))
            number_tell(&s, p->variable[k].name, plan->block[k], p->variable[k].dim);
    if (s.length < size && plan->broken_level)
        snprintf(text + s.length, size - s.length, " on the finer grid");
    return true;
}

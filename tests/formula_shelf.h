/* What the tests of formulas share: a scope of plain names and a compiler that insists. */
#ifndef FORMULA_SHELF_H
#define FORMULA_SHELF_H

#include "formula/dimension.h"
#include "formula/formula.h"

#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"

#define COUNT(array) ((int)(sizeof(array) / sizeof *(array)))

enum { ROOM = 4096 };

/* One scope for most tests: slots a b c, arguments u v, all plain. */
static const ves_symbol plain_slot[] = {{"a", {0}}, {"b", {0}}, {"c", {0}}};
static const ves_symbol plain_argument[] = {{"u", {0}}, {"v", {0}}};
static const ves_scope plain = {plain_slot, 3, plain_argument, 2, true};
static const double slots[3] = {1.7, -0.6, 2.385}, arguments[2] = {0.37, 2.11};

static inline const ves_formula *compiled(const char *text, const ves_scope *scope, ves_arena *arena)
{
    const ves_formula *formula;
    ves_formula_error error;
    ves_status status = ves_formula_compile(text, scope, arena, &formula, &error);
    cr_assert(status == VES_OK, "\"%s\": %s (at %d)", text, error.text, error.offset);
    cr_assert(ves_formula_room(formula) <= ROOM);
    return formula;
}

static inline double evaluated(const ves_formula *formula)
{
    double room[ROOM];
    return ves_formula_eval(formula, slots, arguments, room);
}

static inline bool near(double got, double want, double relative)
{
    if (isnan(want)) return isnan(got);
    return got == want || fabs(got - want) <= relative * fabs(want);
}

#endif

/* Formulas: text -> a small program with dimensions and exact derivatives.
 *
 * A formula reads two kinds of names: *slots*, which live in one flat array owned by the caller (variables,
 * unknowns, parameters), and *arguments* (u, v at a node; measure values in an objective), handed over at
 * each evaluation.
 *
 * Grammar: + - * / ^ (right-associative, binds tighter than unary minus), parentheses, comparisons (<, <=,
 * >, >=, ==, !=) and `and`, `or`, `not` giving 0 or 1, `if(c, a, b)`; sin cos tan asin acos atan atan2 sinh
 * cosh tanh exp log sqrt abs min max hypot sign floor mod; pi. min and max take two or more, hypot two or
 * three arguments; mod has the sign of the divisor. A name may have points: rim.radius.
 *
 * A unit may follow a number: 2 mm, 15 N/m, 1050 kg/m^3, 10 deg, 30 %; from there on it takes every `*` and
 * `/` that is followed by another unit or by a group of units (2 kg/(m s^2)), and the exponents of units, so
 * 15 N/m is newton per metre even if a variable m exists. `=` alone, `,` as a decimal sign, hexadecimal and
 * 1_000 are errors with a hint; so is a text of more than 65536 bytes, 10000 operations or 200 levels.
 * Thread-safe: a formula is constant after it is compiled; all scratch belongs to the caller. */
#ifndef VES_FORMULA_FORMULA_H
#define VES_FORMULA_FORMULA_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"
#include "vesica/status.h"

/* A physical dimension: exponents of metre, kilogram, second in sixths (so that roots stay exact). any: not
 * known yet, or a literal zero, which has every dimension. */
typedef struct ves_dim {
    signed char m, kg, s;
    bool any;
} ves_dim;

bool ves_dim_equal(ves_dim a, ves_dim b); /* true also when either is `any` */

/* "N/m", "m^2", "kg/(m s^2)", "1"; factor to SI (may be NULL). */
bool ves_dim_read(const char *unit, ves_dim *dim, double *factor);
void ves_dim_text(ves_dim dim, char buffer[48]); /* "kg/s^2", "m^2", "1" */

typedef struct ves_symbol {
    const char *name;
    ves_dim dim;
} ves_symbol;

/* What names mean. dimensions: false for a file without units; then units are still read (and `units` of the
 * formula set) but nothing is checked. */
typedef struct ves_scope {
    const ves_symbol *slot;
    int slots;
    const ves_symbol *argument;
    int arguments;
    bool dimensions;
} ves_scope;

/* What went wrong, and where in the text (byte offset, length). */
typedef struct ves_formula_error {
    ves_status status; /* VES_SYNTAX, VES_NAME, VES_UNIT, VES_MEMORY */
    int offset, length;
    char text[256];
} ves_formula_error;

typedef struct ves_formula ves_formula;

/* Compiles text; the formula lives in the arena. On failure *error says why and *formula is NULL. */
ves_status ves_formula_compile(const char *text, const ves_scope *scope, ves_arena *arena,
                               const ves_formula **formula, ves_formula_error *error);

/* Splits "left OP right" at its one top-level comparison (<=, >=, ==, <, >): writes the operator and the
 * offsets where the left side ends and the right side begins, without the blanks around the operator.
 * VES_SYNTAX when there is none or more than one. */
ves_status ves_formula_split(const char *text, char operator[3], int *left_end, int *right_begin);

/* The formula that always gives `value` (no unit text, for defaults). NULL when out of memory. */
const ves_formula *ves_formula_constant(double value, ves_arena *arena);

/* d formula / d argument, as a formula (whose derivative may be taken again). NULL when out of memory, or
 * beyond a million operations. Where there is a kink (abs, min, max, if) the derivative of the branch that
 * the value takes. */
const ves_formula *ves_formula_derivative(const ves_formula *formula, int argument, ves_arena *arena);

/* Of a condition: a number that is positive where it holds, negative where it does not, and 0 where its border is:
 * comparisons as differences, `and` and `or` as the smaller and the larger. By its derivative the border is followed.
 * NULL when out of memory. */
const ves_formula *ves_formula_margin(const ves_formula *formula, ves_arena *arena);

ves_dim ves_formula_dim(const ves_formula *formula);
bool ves_formula_has_units(const ves_formula *formula); /* of some dimension: deg, rad and % do not count */
bool ves_formula_is_constant(const ves_formula *formula, double *value); /* value may be NULL */
int ves_formula_slots(const ves_formula *formula); /* the highest slot it reads plus one, 0: none */
bool ves_formula_uses_slot(const ves_formula *formula, int slot);
bool ves_formula_uses_argument(const ves_formula *formula, int argument);

/* Scratch (doubles) that eval and gradient need. */
int ves_formula_room(const ves_formula *formula);

double ves_formula_eval(const ves_formula *formula, const double *slot, const double *argument, double *room);

/* Value; adds seed * d/d slot into slot_adjoint[slots] and seed * d/d argument into
 * argument_adjoint[arguments] (either may be NULL). Adjoints of names that the formula does not use are not
 * touched. */
double ves_formula_gradient(const ves_formula *formula, const double *slot, const double *argument,
                            double seed, double *slot_adjoint, double *argument_adjoint, double *room);

#endif

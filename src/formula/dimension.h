/* Dimensions and units, as formulas need them. */
#ifndef VES_FORMULA_DIMENSION_H
#define VES_FORMULA_DIMENSION_H

#include <stdbool.h>

#include "formula/formula.h"
#include "formula/lexer.h"

/* value in the unit * up / down = value in SI. Both are products of exact factors, so that 150 ml is the very
 * number 0.00015. */
typedef struct ves_unit {
    double up, down;
    ves_dim dim;
    bool physical; /* some part of it has a dimension: not only deg, rad, % */
} ves_unit;

double ves_unit_apply(const ves_unit *unit, double value);

/* Whether the token is a unit, alone. */
bool ves_unit_at(const ves_lexer *lexer);

/* Reads a product of units from a token that is one, as far as every * and / is followed by another unit (or
 * by a group of units in parentheses, for kg/(m s^2)). false: the token where the lexer then stands cannot be
 * an exponent. */
bool ves_unit_read(ves_lexer *lexer, ves_unit *unit);

enum { VES_UNIT_TEXT = 32 };

/* How a text writes quantities of a dimension: the unit of its first number that has one, as written
 * ("cm^2"), with factor * value in that unit = value in SI. Of numbers without a dimension only a text that
 * is one number with its unit counts (-5 deg): in a product deg says nothing of the product. false: there is
 * none. */
bool ves_unit_find(const char *text, ves_dim dim, char unit[VES_UNIT_TEXT], double *factor);

const char *const *ves_unit_names(int *count);

/* a * b^sign; false: exponents out of range. `any` on either side makes `any`. */
bool ves_dim_multiply(ves_dim a, ves_dim b, int sign, ves_dim *product);
/* dim^exponent; false: not in sixths, or out of range. */
bool ves_dim_power(ves_dim dim, double exponent, ves_dim *power);
bool ves_dim_plain(ves_dim dim); /* dimensionless, or any */

/* "a length (m)", "a plain number", "a quantity in kg/(m s)" */
void ves_dim_describe(ves_dim dim, char buffer[64]);

#endif

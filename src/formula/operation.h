/* The operations that formulas are made of: value and exact partial derivatives, all from one list. */
#ifndef VES_FORMULA_OPERATION_H
#define VES_FORMULA_OPERATION_H

#include <math.h>

/* x^n by repeated squaring: exact where the products are, and defined for x <= 0. */
static inline double ves_power_whole(double x, int n)
{
    double product = 1;
    for (unsigned k = n < 0 ? 0U - (unsigned)n : (unsigned)n; k; k >>= 1, x *= x)
        if (k & 1) product *= x;
    return n < 0 ? 1 / product : product;
}

/* Remainder with the sign of the divisor: mod(-1, 3) = 2. */
static inline double ves_modulo(double x, double y)
{
    double rest = fmod(x, y);
    return rest != 0 && (rest < 0) != (y < 0) ? rest + y : rest;
}

/* X(name, operands, value v, dv/dx, dv/dy, dv/dz). Kinks take the branch that the value takes; where a power
 * or a norm has no slope at zero (0^y in y, hypot at the origin) it is 0. min and max hand on a nan. */
/* clang-format off */
#define VES_OPERATION_LIST(X)                                                                              \
    X(CONSTANT, 0, 0,                           0,                                 0,                   0) \
    X(SLOT,     0, 0,                           0,                                 0,                   0) \
    X(ARGUMENT, 0, 0,                           0,                                 0,                   0) \
    X(ADD,      2, x + y,                       1,                                 1,                   0) \
    X(SUB,      2, x - y,                       1,                                 -1,                  0) \
    X(MUL,      2, x * y,                       y,                                 x,                   0) \
    X(DIV,      2, x / y,                       1 / y,                             -v / y,              0) \
    X(NEG,      1, -x,                          -1,                                0,                   0) \
    X(SQUARE,   1, x * x,                       2 * x,                             0,                   0) \
    X(POWI,     2, ves_power_whole(x, (int)y),  y * ves_power_whole(x, (int)y - 1),0,                   0) \
    X(POW,      2, pow(x, y),                   y == 0 ? 0 : y * pow(x, y - 1),    x ? v * log(x) : 0, 0)\
    X(SIN,      1, sin(x),                      cos(x),                            0,                   0) \
    X(COS,      1, cos(x),                      -sin(x),                           0,                   0) \
    X(TAN,      1, tan(x),                      1 + v * v,                         0,                   0) \
    X(ASIN,     1, asin(x),                     1 / sqrt((1 - x) * (1 + x)),       0,                   0) \
    X(ACOS,     1, acos(x),                     -1 / sqrt((1 - x) * (1 + x)),      0,                   0) \
    X(ATAN,     1, atan(x),                     1 / (1 + x * x),                   0,                   0) \
    X(ATAN2,    2, atan2(x, y),                 y / (x * x + y * y),               -x / (x * x + y * y), 0)\
    X(SINH,     1, sinh(x),                     cosh(x),                           0,                   0) \
    X(COSH,     1, cosh(x),                     sinh(x),                           0,                   0) \
    X(TANH,     1, tanh(x),                     (1 - v) * (1 + v),                 0,                   0) \
    X(EXP,      1, exp(x),                      v,                                 0,                   0) \
    X(LOG,      1, log(x),                      1 / x,                             0,                   0) \
    X(SQRT,     1, sqrt(x),                     0.5 / v,                           0,                   0) \
    X(ABS,      1, fabs(x),                     x < 0 ? -1 : 1,                    0,                   0) \
    X(MIN,      2, x <= y || x != x ? x : y,    x <= y,                            !(x <= y),           0) \
    X(MAX,      2, y <= x || x != x ? x : y,    y <= x,                            !(y <= x),           0) \
    X(HYPOT,    2, hypot(x, y),                 v == 0 ? 0 : x / v,                v == 0 ? 0 : y / v,  0) \
    X(SIGN,     1, x != x ? x : (x > 0) - (x < 0),0,                                 0,                   0)\
    X(FLOOR,    1, floor(x),                    0,                                 0,                   0) \
    X(MOD,      2, ves_modulo(x, y),            1,                                 -floor(x / y),       0) \
    X(LESS,     2, x < y,                       0,                                 0,                   0) \
    X(ATMOST,   2, x <= y,                      0,                                 0,                   0) \
    X(EQUAL,    2, x == y,                      0,                                 0,                   0) \
    X(UNEQUAL,  2, x != y,                      0,                                 0,                   0) \
    X(AND,      2, x != 0 && y != 0,            0,                                 0,                   0) \
    X(OR,       2, x != 0 || y != 0,            0,                                 0,                   0) \
    X(NOT,      1, x == 0,                      0,                                 0,                   0) \
    X(IF,       3, x != 0 ? y : z,              0,                                 x != 0,             x == 0)
/* clang-format on */

typedef enum ves_operation {
#define VES_OPERATION_ENUM(name, operands, value, dx, dy, dz) VES_OP_##name,
    VES_OPERATION_LIST(VES_OPERATION_ENUM)
#undef VES_OPERATION_ENUM
} ves_operation;

static inline int ves_operation_operands(ves_operation operation)
{
    switch (operation) {
#define VES_OPERATION_CASE(name, operands, value, dx, dy, dz)                                                \
    case VES_OP_##name:                                                                                      \
        return operands;
        VES_OPERATION_LIST(VES_OPERATION_CASE)
#undef VES_OPERATION_CASE
    }
    return 0;
}

/* Value of an operation on numbers. */
static inline double ves_operation_eval(ves_operation operation, double x, double y, double z)
{
    switch (operation) {
#define VES_OPERATION_CASE(name, operands, value, dx, dy, dz)                                                \
    case VES_OP_##name:                                                                                      \
        return value;
        VES_OPERATION_LIST(VES_OPERATION_CASE)
#undef VES_OPERATION_CASE
    }
    return 0;
}

#endif

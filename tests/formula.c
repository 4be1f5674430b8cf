/* Formulas: values, gradients, derivatives. */
#include "formula_shelf.h"

#include <pthread.h>

#define PI 3.14159265358979323846

Test(formula, gives_the_values_of_c)
{
    const double a = slots[0], b = slots[1], c = slots[2], u = arguments[0], v = arguments[1];
    const struct {
        const char *text;
        double want;
    } row[] = {
        {"1", 1},
        {"  2.5e-3\t", 2.5e-3},
        {".5", 0.5},
        {"5.", 5},
        {"1E3", 1000},
        {"a", a},
        {"v", v},
        {"pi", PI},
        {"-a", -a},
        {"+a", a},
        {"- - a", a},
        {"a + b", a + b},
        {"a - b - c", (a - b) - c},
        {"a - (b - c)", a - (b - c)},
        {"a*b*c", a * b * c},
        {"a/b/c", a / b / c},
        {"a/(b/c)", a / (b / c)},
        {"a + b*c", a + b * c},
        {"(a + b)*c", (a + b) * c},
        {"-a*b", -a * b},
        {"a*-b", a * -b},
        {"a - -b", a - -b},
        {"2^3^2", 512},
        {"(2^3)^2", 64},
        {"-2^2", -4},
        {"2^-2", 0.25},
        {"2^-2*8", 2},
        {"-a^2", -(a * a)},
        {"b^2", b * b},
        {"b^3", b * b * b},
        {"b^-1", 1 / b},
        {"b^-3", 1 / (b * b * b)},
        {"b^0", 1},
        {"c^0.5", sqrt(c)},
        {"c^1.7", pow(c, 1.7)},
        {"c^100", pow(c, 100)},
        {"c^b", pow(c, b)},
        {"2^u", pow(2, u)},
        {"b^u", NAN},
        {"a < c", 1},
        {"a > c", 0},
        {"a <= a", 1},
        {"a >= c", 0},
        {"a == 1.7", 1},
        {"a != 1.7", 0},
        {"a < c and b < 0", 1},
        {"a > c or b < 0", 1},
        {"not a > c", 1},
        {"not (a > c) and not (b > 0)", 1},
        {"a > c or b > 0 and a < c", 0},
        {"(a < c) + 1", 2},
        {"if(a < c, u, v)", u},
        {"if(a > c, u, v)", v},
        {"if(a > c, 1/0, v)", v},
        {"sin(v)", sin(v)},
        {"cos(v)", cos(v)},
        {"tan(v)", tan(v)},
        {"asin(u)", asin(u)},
        {"acos(u)", acos(u)},
        {"atan(v)", atan(v)},
        {"atan2(b, a)", atan2(b, a)},
        {"atan2(b, -a)", atan2(b, -a)},
        {"sinh(u)", sinh(u)},
        {"cosh(u)", cosh(u)},
        {"tanh(u)", tanh(u)},
        {"exp(u)", exp(u)},
        {"log(c)", log(c)},
        {"sqrt(c)", sqrt(c)},
        {"abs(b)", fabs(b)},
        {"min(a, b)", b},
        {"max(a, b)", a},
        {"min(a, b, c)", b},
        {"max(a, b, c, u, v)", c},
        {"hypot(a, b)", hypot(a, b)},
        {"hypot(a, b, c)", sqrt(a * a + b * b + c * c)},
        {"sign(b)", -1},
        {"sign(0*b)", 0},
        {"floor(b)", -1},
        {"mod(7, 3)", 1},
        {"mod(-1, 3)", 2},
        {"mod(1, -3)", -2},
        {"mod(c, a)", c - a},
        {"a*cos(v) + 0.1*sin(3*v)", a * cos(v) + 0.1 * sin(3 * v)},
        {"2 mm", 0.002},
        {"2mm", 0.002},
        {"150 ml", 0.00015},
        {"15 N/m", 15},
        {"1050 kg/m^3", 1050},
        {"1.05 g/cm^3", 1050},
        {"2 GPa", 2e9},
        {"10 deg", PI / 18},
        {"30 %", 0.3},
        {"30%*a", 0.3 * a},
        {"2 mm^2", 2e-6},
        {"2 m^-1", 2},
        {"4 km/h", 4 / 3.6},
        {"60 s*min(a, c)", 60 * a},
        {"-187 N/m", -187},
        {"0.2 mm*a/(1 mm)", 0.2 * a},
        {"3 kg/(m s^2)", 3},
        {"1.5 bar", 150000},
    };
    ves_arena arena = {0};
    for (int k = 0; k < COUNT(row); k++) {
        double got = evaluated(compiled(row[k].text, &plain, &arena));
        /* 4 roundings of c's own order of operations against ours */
        cr_expect(near(got, row[k].want, 1e-15), "%s: got %.17g want %.17g", row[k].text, got, row[k].want);
    }
    ves_arena_destroy(&arena);
}

/* Every operation at generic points, away from kinks. */
static const char *const smooth[] = {"u",
                                     "a + u",
                                     "a - v*u",
                                     "u*v",
                                     "u/v",
                                     "-u*3",
                                     "u^2",
                                     "b^2*u^3",
                                     "v^-2",
                                     "b^5*v^-1",
                                     "v^0.5",
                                     "v^1.7*c^2.3",
                                     "v^u",
                                     "c^(a*u)",
                                     "2^v",
                                     "sin(a*u)",
                                     "cos(v - u)",
                                     "tan(u*a)",
                                     "asin(u*v/2)",
                                     "acos(u*b)",
                                     "atan(u/c)",
                                     "atan2(u, v)",
                                     "atan2(-v, b*u)",
                                     "sinh(u*v)",
                                     "cosh(u*b)",
                                     "tanh(u + b)",
                                     "exp(b*v)",
                                     "log(a*u + v)",
                                     "sqrt(u*v*c)",
                                     "abs(b*u)",
                                     "abs(u*v)",
                                     "min(u*c, v)",
                                     "max(u*c, v^2, a)",
                                     "hypot(u, v)",
                                     "hypot(u*b, v, c)",
                                     "sign(u)*v^2",
                                     "floor(c)*u*v",
                                     "mod(v*c, u)",
                                     "if(u < v, u^2*v, v)",
                                     "if(u < v and not b > 0, sin(u)*v, v)*c",
                                     "(u < v)*u*a",
                                     "a*cos(v) + 0.1*sin(3*v)",
                                     "(6 + u)*cos(v)/(1 + a*u^2)",
                                     "exp(-u^2/(2*c^2))*sin(v)*(1 - (1 - u))",
                                     "log(sqrt(1 + hypot(u, sin(v))^2) + tanh(u*v))"};

/* Central difference with one Richardson step: error ~ h^4 f5 / 30 + eps f / h, with h = 1e-3 below 1e-11 for
 * functions of size and scale 1; measured against the size of the derivative plus 1, hence 1e-7 leaves room
 * for v^-2 and tan. */
static double difference(const ves_formula *formula, int which, bool slot)
{
    double room[ROOM], s[3], g[2], d[2];
    for (int level = 0; level < 2; level++) {
        double h = level ? 5e-4 : 1e-3, f[2];
        for (int side = 0; side < 2; side++) {
            memcpy(s, slots, sizeof s);
            memcpy(g, arguments, sizeof g);
            *(slot ? &s[which] : &g[which]) += side ? h : -h;
            f[side] = ves_formula_eval(formula, s, g, room);
        }
        d[level] = (f[1] - f[0]) / (2 * h);
    }
    return (4 * d[1] - d[0]) / 3;
}

Test(formula, gradient_is_the_limit_of_differences)
{
    ves_arena arena = {0};
    for (int k = 0; k < COUNT(smooth); k++) {
        const ves_formula *f = compiled(smooth[k], &plain, &arena);
        double room[ROOM], by_slot[3] = {10, 20, 30}, by_argument[2] = {40, 50};
        double value = ves_formula_gradient(f, slots, arguments, 2, by_slot, by_argument, room);
        cr_expect(value == evaluated(f), "%s: value %.17g", smooth[k], value);
        for (int n = 0; n < 5; n++) {
            double want = difference(f, n < 3 ? n : n - 3, n < 3);
            double got = ((n < 3 ? by_slot[n] : by_argument[n - 3]) - 10 * (n + 1)) / 2;
            bool used = n < 3 ? ves_formula_uses_slot(f, n) : ves_formula_uses_argument(f, n - 3);
            cr_expect(fabs(got - want) <= 1e-7 * (1 + fabs(want)), "%s, name %d: got %.12g want %.12g",
                      smooth[k], n, got, want);
            cr_expect(used || got == 0, "%s: a name that is not used was touched", smooth[k]);
        }
        cr_expect(ves_formula_gradient(f, slots, arguments, 2, NULL, NULL, room) == value);
    }
    ves_arena_destroy(&arena);
}

static double argument_slope(const ves_formula *f, int argument)
{
    double room[ROOM], g[2] = {0};
    ves_formula_gradient(f, slots, arguments, 1, NULL, g, room);
    return g[argument];
}

Test(formula, derivatives_agree_with_reverse_mode_and_differences_twice)
{
    ves_arena arena = {0};
    for (int k = 0; k < COUNT(smooth); k++)
        for (int i = 0; i < 2; i++) {
            const ves_formula *f = compiled(smooth[k], &plain, &arena);
            const ves_formula *first = ves_formula_derivative(f, i, &arena);
            cr_assert(first);
            double got = evaluated(first), want = argument_slope(f, i);
            /* both are products of the same factors: some tens of roundings, cancellation of one digit */
            cr_expect(fabs(got - want) <= 1e-14 * (1 + fabs(want)), "d%d %s: got %.17g want %.17g", i,
                      smooth[k], got, want);
            for (int j = 0; j < 2; j++) {
                const ves_formula *second = ves_formula_derivative(first, j, &arena);
                cr_assert(second);
                double reverse = argument_slope(first, j), limit = difference(first, j, false);
                got = evaluated(second);
                /* as above, with more factors: 9e-16 was seen at a size of 3.6 */
                cr_expect(fabs(got - reverse) <= 1e-13 * (1 + fabs(reverse)),
                          "d%d%d %s: got %.17g want %.17g", i, j, smooth[k], got, reverse);
                cr_expect(fabs(got - limit) <= 1e-7 * (1 + fabs(limit)),
                          "d%d%d %s: got %.12g, differences %.12g", i, j, smooth[k], got, limit);
            }
        }
    ves_arena_destroy(&arena);
}

/* Places a tape needs: constants, names and steps. */
static int places(const ves_formula *formula)
{
    return ves_formula_room(formula) / 2;
}

Test(formula, derivatives_are_clean)
{
    static const struct {
        const char *text;
        int order, most;              /* places of the derivative by v */
    } row[] = {{"cos(v)", 1, 3},      /* v, sin, minus */
               {"cos(v)", 2, 3},      /* v, cos, minus */
               {"a*cos(v)", 1, 5},    /* a, v, sin, times, minus */
               {"sin(3*v)", 1, 5},    /* 3, v, 3 v, cos, times */
               {"sin(3*v)", 2, 6},    /* 3, -9, v, 3 v, sin, times */
               {"(6 + u)*v", 1, 3},   /* 6, u, plus */
               {"v^2", 1, 3},         /* 2, v, times */
               {"v^2", 2, 1},         /* 2 */
               {"exp(2*v)", 2, 5},    /* 2, 4, v, 2 v, exp, times */
               {"a + b*u + 3", 1, 1}, /* 0 */
               {"v/2", 1, 1}};
    ves_arena arena = {0};
    for (int k = 0; k < COUNT(row); k++) {
        const ves_formula *f = compiled(row[k].text, &plain, &arena);
        for (int order = 0; order < row[k].order; order++) f = ves_formula_derivative(f, 1, &arena);
        int most = row[k].most + (k == 8);
        cr_expect(places(f) <= most, "%s, order %d: %d places, want %d", row[k].text, row[k].order, places(f),
                  most);
    }
    double value = 7;
    const ves_formula *zero = ves_formula_derivative(compiled("a*u", &plain, &arena), 1, &arena);
    cr_expect(ves_formula_is_constant(zero, &value) && value == 0);
    ves_arena_destroy(&arena);
}

Test(formula, kinks_take_the_branch_and_poles_give_no_trap)
{
    static const struct {
        const char *text;
        double v, value, slope; /* v stands for argument v */
    } row[] = {
        {"v^2", 0, 0, 0},
        {"v^3", 0, 0, 0},
        {"v^3", -2, -8, 12},
        {"v^1.5", 0, 0, 0},
        {"v^-2", -2, 0.25, 0.25},
        {"v^u", 0, 0, HUGE_VAL},
        {"2^v", 0, 1, 0.69314718055994530942},
        {"sqrt(v)", 0, 0, HUGE_VAL},
        {"sqrt(v)", -1, NAN, NAN},
        {"(v - 3)^0.3", 1, NAN, NAN},
        {"log(v)", 0, -HUGE_VAL, HUGE_VAL},
        {"1/v", 0, HUGE_VAL, -HUGE_VAL},
        {"asin(v)", 1, PI / 2, HUGE_VAL},
        {"abs(v)", 0, 0, 1},
        {"abs(v)", -3, 3, -1},
        {"min(v, 2*v)", 0, 0, 1},
        {"max(v, 2*v)", 0, 0, 1},
        {"min(v, 2*v)", -1, -2, 2},
        {"hypot(v, 0*u)", 0, 0, 0},
        {"if(v > 0, sqrt(v), 0)", 0, 0, 0},
        {"if(v > 0, sqrt(v), 3*v)", -1, -3, 3},
        {"min(sqrt(v), v)", 0, 0, HUGE_VAL},
        {"min(v, sqrt(v))", 0, 0, 1},
        {"floor(v)", 2, 2, 0},
        {"mod(v, 2)", 5, 1, 1},
        {"min(v, 1)", NAN, NAN, 0},
        {"max(1, v)", NAN, NAN, 1},
    };
    ves_arena arena = {0};
    for (int k = 0; k < COUNT(row); k++) {
        const ves_formula *f = compiled(row[k].text, &plain, &arena);
        const ves_formula *d = ves_formula_derivative(f, 1, &arena);
        double g[2] = {0}, room[ROOM], at[2] = {0.37, row[k].v};
        double value = ves_formula_gradient(f, slots, at, 1, NULL, g, room);
        /* one or two operations: some ulp */
        cr_expect(near(value, row[k].value, 1e-15), "%s at %g: got %g want %g", row[k].text, row[k].v, value,
                  row[k].value);
        bool judged = !isnan(row[k].v); /* which branch a nan takes does not matter */
        cr_expect(!judged || near(g[1], row[k].slope, 1e-15), "%s at %g: slope %g want %g", row[k].text,
                  row[k].v, g[1], row[k].slope);
        double formal = ves_formula_eval(d, slots, at, room);
        cr_expect(!judged || near(formal, row[k].slope, 1e-15), "%s at %g: derivative %g want %g",
                  row[k].text, row[k].v, formal, row[k].slope);
    }
    ves_arena_destroy(&arena);
}

/* It changes its sign where the condition does, and there alone. */
Test(formula, margins_follow_the_border_of_a_condition)
{
    static const char *const conditions[] = {"u < v",
                                             "u >= a*v^2 and not v > u^3",
                                             "u > 0.2 or (v <= b*u and u + v > a)",
                                             "if(u < 0, v > c*u, v + u^2 > 1)",
                                             "not (u > v or u < -v) and 1 < 2",
                                             "not (not (u*v > 0.1))",
                                             "u == v or (v != 7 and u + v > c/3)"};
    ves_arena arena = {0};
    double room[ROOM];
    for (int k = 0; k < COUNT(conditions); k++) {
        const ves_formula *f = compiled(conditions[k], &plain, &arena), *m = ves_formula_margin(f, &arena);
        int holds = 0, all = 0;
        for (double u = -1.03; u < 1; u += 0.0471)
            for (double v = -1.01; v < 1; v += 0.0513, all++) {
                const double at[2] = {u, v};
                bool want = ves_formula_eval(f, slots, at, room) != 0;
                double margin = ves_formula_eval(m, slots, at, room);
                cr_assert(want ? margin > 0 : margin < 0, "%s at %g %g: %d, %g", conditions[k], u, v, want,
                          margin);
                holds += want;
            }
        cr_assert(holds > 0 && holds < all, "%s: %d of %d", conditions[k], holds, all);
    }
    cr_assert(evaluated(ves_formula_margin(compiled("a > c", &plain, &arena), &arena)) ==
              slots[0] - slots[2]);
    cr_assert(evaluated(ves_formula_margin(compiled("a*u", &plain, &arena), &arena)) ==
              fabs(slots[0] * arguments[0]));
    ves_arena_destroy(&arena);
}

Test(formula, constants_and_uses_are_known)
{
    ves_arena arena = {0};
    double value = 0;
    const ves_formula *f = ves_formula_constant(2.385, &arena);
    cr_expect(ves_formula_is_constant(f, &value) && value == 2.385 && ves_formula_dim(f).any);
    cr_expect(evaluated(f) == 2.385 && !ves_formula_has_units(f));
    f = compiled("2*3 + sqrt(16)^2 - if(1 < 2, 4, a)", &plain, &arena);
    cr_expect(ves_formula_is_constant(f, &value) && value == 18, "%g", value);
    cr_expect(ves_formula_is_constant(f, NULL) && !ves_formula_uses_slot(f, 0));
    f = compiled("b*v", &plain, &arena);
    cr_expect(!ves_formula_is_constant(f, &value));
    cr_expect(ves_formula_uses_slot(f, 1) && !ves_formula_uses_slot(f, 0) &&
              ves_formula_uses_argument(f, 1) && !ves_formula_uses_argument(f, 0));
    f = compiled("b", &plain, &arena);
    cr_expect(!ves_formula_is_constant(f, NULL) && evaluated(f) == slots[1]);
    ves_arena_destroy(&arena);
}

/* A random tree of operations, written as text and evaluated as a tree. */
typedef struct tree {
    const char *form; /* text with @ for each operand */
    double (*value)(double x, double y, double z);
    int operands;
    bool smooth;
} tree;

/* clang-format off */
#define TREES(X)                                                                                           \
    X(add,     2, 1, "(@ + @)",       x + y)                X(sub,  2, 1, "(@ - @)",      x - y)           \
    X(mul,     2, 1, "@*(@)",         x * y)                X(divi, 2, 0, "@/(@)",        x / y)           \
    X(neg,     1, 1, "(-@)",          -x)                   X(sq,   1, 1, "(@)^2",        x * x)           \
    X(cube,    1, 1, "(@)^3",         x * (x * x))          X(root, 1, 0, "sqrt(@)",      sqrt(x))         \
    X(sine,    1, 1, "sin(@)",        sin(x))               X(cosi, 1, 1, "cos(@)",       cos(x))          \
    X(tanhy,   1, 1, "tanh(@)",       tanh(x))              X(expo, 1, 0, "exp(@)",       exp(x))          \
    X(loga,    1, 0, "log(@)",        log(x))               X(absol,1, 0, "abs(@)",       fabs(x))         \
    X(mini,    2, 0, "min(@, @)",     x <= y || isnan(x) ? x : y)                                          \
    X(maxi,    2, 0, "max(@, @)",     y <= x || isnan(x) ? x : y)                                          \
    X(less,    2, 0, "(@ < @)",       x < y)                X(most, 2, 0, "(@ >= @)",     x >= y)          \
    X(both,    2, 0, "(@ and @)",     x != 0 && y != 0)     X(neit, 1, 0, "(not @)",      x == 0)          \
    X(iff,     3, 0, "if(@, @, @)",   x != 0 ? y : z)       X(flo,  1, 0, "floor(@)",     floor(x))        \
    X(smoothq, 2, 1, "@/(2 + (@)^2)", x / (2 + y * y))      X(at2,  2, 0, "atan2(@, @)",  atan2(x, y))
/* clang-format on */

#define TREE_VALUE(name, operands, smooth, form, expression)                                                 \
    static double name(double x, double y, double z)                                                         \
    {                                                                                                        \
        (void)y, (void)z;                                                                                    \
        return expression;                                                                                   \
    }
TREES(TREE_VALUE)
#define TREE_ROW(name, operands, smooth, form, expression) {form, name, operands, smooth},
static const tree trees[] = {TREES(TREE_ROW)};

typedef struct author {
    ves_random random;
    bool smooth;
    char text[1 << 14];
    int length;
} author;

static void put(author *w, const char *text, int length)
{
    if (w->length + length >= (int)sizeof w->text) return;
    memcpy(w->text + w->length, text, (size_t)length);
    w->length += length;
    w->text[w->length] = 0;
}

static double leaf(author *w)
{
    static const char *const name[] = {"a", "b", "c", "u", "v"};
    int k = ves_random_below(&w->random, 8);
    char number[32];
    if (k < 5) {
        put(w, name[k], 1);
        return k < 3 ? slots[k] : arguments[k - 3];
    }
    double value = floor(1 + 4000 * ves_random_uniform(&w->random)) / 1024; /* exact in 8 decimals */
    int length = snprintf(number, sizeof number, "%.10f", value);
    put(w, number, length);
    return value;
}

static double written(author *w, int depth)
{
    if (depth == 0 || ves_random_below(&w->random, 6) == 0) return leaf(w);
    const tree *t;
    do t = &trees[ves_random_below(&w->random, COUNT(trees))];
    while (w->smooth && !t->smooth);
    double value[3] = {0};
    int operand = 0;
    for (const char *form = t->form; *form; form++) {
        if (*form == '@')
            value[operand++] = written(w, depth - 1);
        else
            put(w, form, 1);
    }
    return t->value(value[0], value[1], value[2]);
}

Test(formula, random_trees_have_the_value_of_the_tree)
{
    ves_arena arena = {0};
    static author w;
    for (int k = 0; k < 3000; k++) {
        w = (author){.random = {.seed = 2011, .step = (uint64_t)k}};
        double want = written(&w, 1 + k % 6), got = evaluated(compiled(w.text, &plain, &arena));
        /* the same operations on the same numbers: equal to the last bit, a nan for a nan */
        cr_expect(near(got, want, 0), "%s: got %.17g want %.17g", w.text, got, want);
        if (k % 100 == 0) ves_arena_destroy(&arena);
    }
    ves_arena_destroy(&arena);
}

Test(formula, random_derivatives_agree_with_reverse_mode)
{
    ves_arena arena = {0};
    static author w;
    for (int k = 0; k < 1000; k++) {
        w = (author){.random = {.seed = 1997, .step = (uint64_t)k}, .smooth = true};
        double room[ROOM], value = written(&w, 1 + k % 5);
        const ves_formula *f = compiled(w.text, &plain, &arena);
        for (int i = 0; i < 2; i++) {
            const ves_formula *d = ves_formula_derivative(f, i, &arena);
            if (ves_formula_room(d) > ROOM || fabs(value) > 1e6) continue;
            double got = ves_formula_eval(d, slots, arguments, room), want = argument_slope(f, i);
            double dd = argument_slope(d, 1);
            /* tens of roundings of terms that may be 1e3 times their sum */
            cr_expect(fabs(got - want) <= 1e-11 * (1 + fabs(want)), "d%d %s: got %.17g want %.17g", i, w.text,
                      got, want);
            const ves_formula *second = ves_formula_derivative(d, 1, &arena);
            if (ves_formula_room(second) > ROOM) continue;
            got = ves_formula_eval(second, slots, arguments, room);
            cr_expect(fabs(got - dd) <= 1e-11 * (1 + fabs(dd)), "d%d1 %s: got %.17g want %.17g", i, w.text,
                      got, dd);
        }
        if (k % 100 == 0) ves_arena_destroy(&arena);
    }
    ves_arena_destroy(&arena);
}

typedef struct job {
    const ves_formula *formula;
    double sum, slope;
    pthread_t thread;
} job;

static void *work(void *data)
{
    job *j = data;
    double room[ROOM], g[2] = {0};
    for (int k = 0; k < 20000; k++) {
        double at[2] = {0.37, 0.001 * k};
        j->sum += ves_formula_eval(j->formula, slots, at, room);
        ves_formula_gradient(j->formula, slots, at, 1, NULL, g, room);
    }
    j->slope = g[1];
    return NULL;
}

Test(formula, two_threads_may_share_a_formula)
{
    ves_arena arena = {0};
    job one = {.formula = compiled("a*cos(v) + 0.1*sin(3*v)*exp(-u)", &plain, &arena)}, two = one,
        alone = one;
    cr_assert(!pthread_create(&one.thread, NULL, work, &one) &&
              !pthread_create(&two.thread, NULL, work, &two));
    pthread_join(one.thread, NULL);
    pthread_join(two.thread, NULL);
    work(&alone);
    cr_expect(one.sum == alone.sum && two.sum == alone.sum, "%.17g %.17g %.17g", one.sum, two.sum, alone.sum);
    cr_expect(one.slope == alone.slope && two.slope == alone.slope, "%.17g %.17g", one.slope, alone.slope);
    ves_arena_destroy(&arena);
}

#include "formula/graph.h"

#include <stddef.h>

enum { NODES = 1 << 20 }; /* refuses what repeated derivatives of a long formula may grow to */

static int make(ves_graph *graph, ves_operation operation, int a, int b)
{
    return ves_graph_make(graph, operation, a, b, 0);
}

static int constant(ves_graph *graph, double value)
{
    return ves_graph_constant(graph, value);
}

static int sum(ves_graph *graph, int a, int b)
{
    return make(graph, VES_OP_ADD, a, b);
}

static int difference(ves_graph *graph, int a, int b)
{
    return make(graph, VES_OP_SUB, a, b);
}

static int product(ves_graph *graph, int a, int b)
{
    return make(graph, VES_OP_MUL, a, b);
}

static int quotient(ves_graph *graph, int a, int b)
{
    return make(graph, VES_OP_DIV, a, b);
}

static int square(ves_graph *graph, int a)
{
    return product(graph, a, a);
}

static int negation(ves_graph *graph, int a)
{
    return make(graph, VES_OP_NEG, a, 0);
}

/* (1 - x)(1 + x), which keeps its digits near |x| = 1 */
static int one_less_square(ves_graph *graph, int x)
{
    int one = constant(graph, 1);
    return product(graph, difference(graph, one, x), sum(graph, one, x));
}

/* dv of v = f(x), f of one operand. */
static int unary(ves_graph *graph, ves_operation operation, int x, int v, int dx)
{
    int one = constant(graph, 1);
    switch (operation) {
    case VES_OP_NEG:
        return negation(graph, dx);
    case VES_OP_SQUARE:
        return product(graph, product(graph, constant(graph, 2), x), dx);
    case VES_OP_SIN:
        return product(graph, make(graph, VES_OP_COS, x, 0), dx);
    case VES_OP_COS:
        return negation(graph, product(graph, make(graph, VES_OP_SIN, x, 0), dx));
    case VES_OP_TAN:
        return product(graph, sum(graph, one, square(graph, v)), dx);
    case VES_OP_ASIN:
        return quotient(graph, dx, make(graph, VES_OP_SQRT, one_less_square(graph, x), 0));
    case VES_OP_ACOS:
        return negation(graph, quotient(graph, dx, make(graph, VES_OP_SQRT, one_less_square(graph, x), 0)));
    case VES_OP_ATAN:
        return quotient(graph, dx, sum(graph, one, square(graph, x)));
    case VES_OP_SINH:
        return product(graph, make(graph, VES_OP_COSH, x, 0), dx);
    case VES_OP_COSH:
        return product(graph, make(graph, VES_OP_SINH, x, 0), dx);
    case VES_OP_TANH:
        return product(graph, one_less_square(graph, v), dx);
    case VES_OP_EXP:
        return product(graph, v, dx);
    case VES_OP_LOG:
        return quotient(graph, dx, x);
    case VES_OP_SQRT:
        return quotient(graph, product(graph, constant(graph, 0.5), dx), v);
    case VES_OP_ABS:
        return ves_graph_make(graph, VES_OP_IF, make(graph, VES_OP_LESS, x, 0), negation(graph, dx), dx);
    default:
        return 0; /* sign, floor, not: flat */
    }
}

/* d(x^y) = y x^(y-1) dx + x^y log(x) dy, the second part 0 at x = 0 */
static int power(ves_graph *graph, int x, int y, int v, int dx, int dy)
{
    int lower = ves_graph_power(graph, x, difference(graph, y, constant(graph, 1)));
    int along = product(graph, product(graph, y, lower), dx);
    if (!dy) return along;
    int slope = product(graph, v, make(graph, VES_OP_LOG, x, 0));
    return sum(graph, along, product(graph, ves_graph_make(graph, VES_OP_IF, x, slope, 0), dy));
}

/* dv of v = f(x, y). Node 0 is the number 0. */
static int binary(ves_graph *graph, ves_operation operation, int x, int y, int v, int dx, int dy)
{
    int along, across;
    switch (operation) {
    case VES_OP_ADD:
        return sum(graph, dx, dy);
    case VES_OP_SUB:
        return difference(graph, dx, dy);
    case VES_OP_MUL:
        return sum(graph, product(graph, dx, y), product(graph, x, dy));
    case VES_OP_DIV:
        return quotient(graph, difference(graph, dx, product(graph, v, dy)), y);
    case VES_OP_POWI:
    case VES_OP_POW:
        return power(graph, x, y, v, dx, dy);
    case VES_OP_ATAN2:
        along = difference(graph, product(graph, y, dx), product(graph, x, dy));
        return quotient(graph, along, sum(graph, square(graph, x), square(graph, y)));
    case VES_OP_MIN:
        return ves_graph_make(graph, VES_OP_IF, make(graph, VES_OP_ATMOST, x, y), dx, dy);
    case VES_OP_MAX:
        return ves_graph_make(graph, VES_OP_IF, make(graph, VES_OP_ATMOST, y, x), dx, dy);
    case VES_OP_HYPOT:
        along = sum(graph, product(graph, x, dx), product(graph, y, dy));
        return ves_graph_make(graph, VES_OP_IF, v, quotient(graph, along, v), 0);
    case VES_OP_MOD:
        across = make(graph, VES_OP_FLOOR, quotient(graph, x, y), 0);
        return difference(graph, dx, product(graph, across, dy));
    default:
        return 0; /* comparisons, and, or: flat */
    }
}

/* Copies the tape into the graph: node[k] is what place k of the room computes, slope[k] its derivative. */
static void differentiate(ves_graph *graph, const ves_formula *formula, int argument, int *node, int *slope)
{
    int at = 0;
    for (int k = 0; k < formula->constants; k++) node[at++] = constant(graph, formula->constant[k]);
    for (int k = 0; k < formula->slots; k++)
        node[at++] = ves_graph_leaf(graph, VES_OP_SLOT, formula->slot[k]);
    for (int k = 0; k < formula->arguments; k++) {
        if (formula->argument[k] == argument) slope[at] = constant(graph, 1);
        node[at++] = ves_graph_leaf(graph, VES_OP_ARGUMENT, formula->argument[k]);
    }
    for (int k = 0; k < formula->steps; k++, at++) {
        ves_step s = formula->step[k];
        int operands = ves_operation_operands(s.operation), a = node[s.a], b = node[s.b], c = node[s.c];
        int v = s.operation == VES_OP_POW || s.operation == VES_OP_POWI
                    ? ves_graph_power(graph, a, b)
                    : ves_graph_make(graph, s.operation, a, b, c);
        int da = slope[s.a], db = operands > 1 ? slope[s.b] : 0, dc = operands > 2 ? slope[s.c] : 0;
        node[at] = v;
        if (!da && !db && !dc) continue;
        if (operands == 1) slope[at] = unary(graph, s.operation, a, v, da);
        if (operands == 2) slope[at] = binary(graph, s.operation, a, b, v, da, db);
        if (operands == 3) slope[at] = ves_graph_make(graph, VES_OP_IF, a, db, dc);
    }
}

static ves_dim divided(const ves_formula *formula, int argument)
{
    ves_dim dim = formula->dim, by = formula->argument_dim[argument];
    int m = dim.m - by.m, kg = dim.kg - by.kg, s = dim.s - by.s;
    bool odd = m < -127 || m > 127 || kg < -127 || kg > 127 || s < -127 || s > 127;
    if (dim.any || by.any || odd) return (ves_dim){.any = true};
    return (ves_dim){.m = (signed char)m, .kg = (signed char)kg, .s = (signed char)s};
}

const ves_formula *ves_formula_derivative(const ves_formula *formula, int argument, ves_arena *arena)
{
    if (!ves_formula_uses_argument(formula, argument)) return ves_formula_constant(0, arena);
    size_t places = (size_t)ves_formula_room(formula) / 2;
    int *node = ves_memory_take(2 * places * sizeof *node);
    ves_graph graph = {0};
    const ves_formula *result = NULL;
    if (node && ves_graph_init(&graph, true, NODES) == VES_OK) {
        differentiate(&graph, formula, argument, node, node + places);
        ves_formula like = *formula;
        like.dim = divided(formula, argument);
        result = ves_graph_finish(&graph, node[2 * places - 1], &like, arena);
    }
    ves_graph_clear(&graph);
    ves_memory_free(node);
    return result;
}

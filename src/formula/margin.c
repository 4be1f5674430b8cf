#include "formula/graph.h"

/* From below: of every place of the tape what it computes, and how far that is from changing its mind. Comparisons
 * change where their sides are equal; what is no condition holds unless it is 0. */

static int make(ves_graph *graph, ves_operation operation, int a, int b)
{
    return ves_graph_make(graph, operation, a, b, 0);
}

static int size(ves_graph *graph, int a)
{
    return make(graph, VES_OP_ABS, a, 0);
}

static int opposite(ves_graph *graph, int a)
{
    return make(graph, VES_OP_NEG, a, 0);
}

static int both(ves_graph *graph, int a, int b)
{
    return make(graph, VES_OP_MIN, a, b);
}

static int either(ves_graph *graph, int a, int b)
{
    return make(graph, VES_OP_MAX, a, b);
}

static int margin_of(ves_graph *graph, ves_step s, const int *node, const int *margin, int value)
{
    switch (s.operation) {
    case VES_OP_LESS:
    case VES_OP_ATMOST:
        return make(graph, VES_OP_SUB, node[s.b], node[s.a]);
    case VES_OP_EQUAL:
        return opposite(graph, size(graph, make(graph, VES_OP_SUB, node[s.a], node[s.b])));
    case VES_OP_UNEQUAL:
        return size(graph, make(graph, VES_OP_SUB, node[s.a], node[s.b]));
    case VES_OP_AND:
        return both(graph, margin[s.a], margin[s.b]);
    case VES_OP_OR:
        return either(graph, margin[s.a], margin[s.b]);
    case VES_OP_NOT:
        return opposite(graph, margin[s.a]);
    case VES_OP_IF:
        return either(graph, both(graph, margin[s.a], margin[s.b]),
                      both(graph, opposite(graph, margin[s.a]), margin[s.c]));
    default:
        return size(graph, value);
    }
}

static void measure(ves_graph *graph, const ves_formula *formula, int *node, int *margin)
{
    int at = 0;
    for (int k = 0; k < formula->constants; k++) node[at++] = ves_graph_constant(graph, formula->constant[k]);
    for (int k = 0; k < formula->slots; k++)
        node[at++] = ves_graph_leaf(graph, VES_OP_SLOT, formula->slot[k]);
    for (int k = 0; k < formula->arguments; k++)
        node[at++] = ves_graph_leaf(graph, VES_OP_ARGUMENT, formula->argument[k]);
    for (int k = 0; k < at; k++) margin[k] = size(graph, node[k]);
    for (int k = 0; k < formula->steps; k++, at++) {
        ves_step s = formula->step[k];
        bool power = s.operation == VES_OP_POW || s.operation == VES_OP_POWI;
        node[at] = power ? ves_graph_power(graph, node[s.a], node[s.b])
                         : ves_graph_make(graph, s.operation, node[s.a], node[s.b], node[s.c]);
        margin[at] = margin_of(graph, s, node, margin, node[at]);
    }
}

const ves_formula *ves_formula_margin(const ves_formula *formula, ves_arena *arena)
{
    enum { NODES = 1 << 20 };
    size_t places = (size_t)ves_formula_room(formula) / 2;
    int *node = ves_memory_take(2 * places * sizeof *node);
    ves_graph graph = {0};
    const ves_formula *result = NULL;
    if (node && ves_graph_init(&graph, false, NODES) == VES_OK) {
        measure(&graph, formula, node, node + places);
        ves_formula like = *formula;
        like.dim = (ves_dim){.any = true};
        result = ves_graph_finish(&graph, node[2 * places - 1], &like, arena);
    }
    ves_graph_clear(&graph);
    ves_memory_free(node);
    return result;
}

/* The graph that a formula is built in before it becomes a tape: every node once (equal nodes are shared),
 * operands before the nodes that use them, constants folded. Failure is sticky: after it every call returns
 * node 0 and changes nothing, so that building needs no checks; ves_graph_finish then returns NULL. */
#ifndef VES_FORMULA_GRAPH_H
#define VES_FORMULA_GRAPH_H

#include <stdbool.h>

#include "base/arena.h"
#include "formula/formula.h"
#include "formula/operation.h"

/* One step of a tape: operands are places in the room. */
typedef struct ves_step {
    int a, b, c;
    ves_operation operation;
} ves_step;

/* The room holds, in this order: constants, slots read, arguments read, one value for each step; the last is
 * the result. */
struct ves_formula {
    int constants, slots, arguments, steps;
    const double *constant;
    const ves_step *step;
    const int *slot, *argument;
    ves_dim dim;
    bool units;
    int dims; /* arguments of the scope, used or not, and their dimensions */
    const ves_dim *argument_dim;
};

typedef struct ves_node {
    double value; /* of a constant */
    int a, b, c;  /* operands; a: index of a slot or an argument */
    ves_operation operation;
} ves_node;

typedef struct ves_graph {
    ves_node *node; /* node 0 is the constant 0 */
    int *bucket;    /* hash table of node numbers; -1: free */
    int count, capacity, buckets, limit;
    /* For derivatives: 0 * x is 0 and constants move freely, even if x may be inf or rounding changes. */
    bool formal;
    ves_status status; /* VES_MEMORY; VES_RANGE: more nodes than the limit */
} ves_graph;

ves_status ves_graph_init(ves_graph *graph, bool formal, int limit);
void ves_graph_clear(ves_graph *graph);

int ves_graph_constant(ves_graph *graph, double value);
int ves_graph_leaf(ves_graph *graph, ves_operation operation, int index); /* VES_OP_SLOT or VES_OP_ARGUMENT */
/* The node of an operation, simplified. Operands that it does not have are ignored. */
int ves_graph_make(ves_graph *graph, ves_operation operation, int a, int b, int c);
/* x^y: whole exponents become products, 1/2 a root. */
int ves_graph_power(ves_graph *graph, int x, int y);
bool ves_graph_is_constant(const ves_graph *graph, int node, double *value);

/* The tape that computes `root`, with dim, units and argument dimensions of `like`. The graph is used up. */
const ves_formula *ves_graph_finish(ves_graph *graph, int root, const ves_formula *like, ves_arena *arena);

#endif

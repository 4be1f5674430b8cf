#include "formula/graph.h"

#include <stdint.h>
#include <string.h>

enum { START = 64, LARGEST_POWER = 64 };

static unsigned mixed(unsigned hash, uint64_t word)
{
    uint64_t product = (hash ^ word) * 0x9E3779B97F4A7C15U;
    return (unsigned)(product >> 32) ^ (unsigned)product;
}

static unsigned hashed(const ves_node *node)
{
    uint64_t bits;
    memcpy(&bits, &node->value, sizeof bits);
    unsigned hash = mixed((unsigned)node->operation, bits);
    hash = mixed(hash, (uint64_t)(unsigned)node->a << 32 | (unsigned)node->b);
    return mixed(hash, (unsigned)node->c);
}

static bool same(const ves_node *p, const ves_node *q)
{
    return p->operation == q->operation && p->a == q->a && p->b == q->b && p->c == q->c &&
           !memcmp(&p->value, &q->value, sizeof p->value); /* -0 is not 0, a nan is itself */
}

/* The bucket that holds the node, or where it belongs. */
static int *place(const ves_graph *graph, const ves_node *node)
{
    unsigned mask = (unsigned)graph->buckets - 1, at = hashed(node) & mask;
    while (graph->bucket[at] >= 0 && !same(&graph->node[graph->bucket[at]], node)) at = (at + 1) & mask;
    return &graph->bucket[at];
}

/* Room for twice as many nodes; four buckets a node keep probes short, and leave room for ves_graph_finish. */
static ves_status grow(ves_graph *graph)
{
    int capacity = graph->capacity ? 2 * graph->capacity : START;
    ves_node *node = ves_memory_grow(graph->node, (size_t)capacity * sizeof *node);
    if (!node) return VES_MEMORY;
    graph->node = node;
    int *bucket = ves_memory_grow(graph->bucket, 4 * (size_t)capacity * sizeof *bucket);
    if (!bucket) return VES_MEMORY;
    graph->bucket = bucket;
    graph->capacity = capacity;
    graph->buckets = 4 * capacity;
    memset(bucket, -1, 4 * (size_t)capacity * sizeof *bucket);
    for (int k = 0; k < graph->count; k++) *place(graph, &node[k]) = k;
    return VES_OK;
}

ves_status ves_graph_init(ves_graph *graph, bool formal, int limit)
{
    *graph = (ves_graph){.formal = formal, .limit = limit};
    graph->status = grow(graph);
    if (graph->status) return graph->status;
    ves_graph_constant(graph, 0);
    return VES_OK;
}

void ves_graph_clear(ves_graph *graph)
{
    ves_memory_free(graph->node);
    ves_memory_free(graph->bucket);
    graph->node = NULL;
    graph->bucket = NULL;
}

/* The number of the node, new or known. */
static int shared(ves_graph *graph, const ves_node *node)
{
    if (graph->status) return 0;
    int *bucket = place(graph, node);
    if (*bucket >= 0) return *bucket;
    if (graph->count == graph->limit) graph->status = VES_RANGE;
    if (!graph->status && graph->count == graph->capacity) {
        graph->status = grow(graph);
        if (!graph->status) bucket = place(graph, node);
    }
    if (graph->status) return 0;
    graph->node[graph->count] = *node;
    return *bucket = graph->count++;
}

int ves_graph_constant(ves_graph *graph, double value)
{
    return shared(graph, &(ves_node){.operation = VES_OP_CONSTANT, .value = value});
}

int ves_graph_leaf(ves_graph *graph, ves_operation operation, int index)
{
    return shared(graph, &(ves_node){.operation = operation, .a = index});
}

bool ves_graph_is_constant(const ves_graph *graph, int node, double *value)
{
    if (graph->node[node].operation != VES_OP_CONSTANT) return false;
    if (value) *value = graph->node[node].value;
    return true;
}

static bool is(const ves_graph *graph, int node, double value)
{
    double found;
    return ves_graph_is_constant(graph, node, &found) && found == value;
}

static bool negated(const ves_graph *graph, int node)
{
    return graph->node[node].operation == VES_OP_NEG;
}

/* constant * something; products hold their constant first. */
static bool scaled(const ves_graph *graph, int node)
{
    const ves_node *p = &graph->node[node];
    return p->operation == VES_OP_MUL && ves_graph_is_constant(graph, p->a, NULL);
}

static int bare(ves_graph *graph, ves_operation operation, int a, int b, int c)
{
    return shared(graph, &(ves_node){.operation = operation, .a = a, .b = b, .c = c});
}

static int make2(ves_graph *graph, ves_operation operation, int a, int b)
{
    return ves_graph_make(graph, operation, a, b, 0);
}

static int negation(ves_graph *graph, int a)
{
    ves_node p = graph->node[a];
    double k;
    if (p.operation == VES_OP_NEG) return p.a;
    if (p.operation == VES_OP_SUB && graph->formal) return make2(graph, VES_OP_SUB, p.b, p.a);
    if (p.operation == VES_OP_MUL && ves_graph_is_constant(graph, p.a, &k))
        return make2(graph, VES_OP_MUL, ves_graph_constant(graph, -k), p.b);
    return bare(graph, VES_OP_NEG, a, 0, 0);
}

static int sum(ves_graph *graph, int a, int b)
{
    if (is(graph, a, 0)) return b;
    if (is(graph, b, 0)) return a;
    if (negated(graph, b)) return make2(graph, VES_OP_SUB, a, graph->node[b].a);
    if (negated(graph, a)) return make2(graph, VES_OP_SUB, b, graph->node[a].a);
    if (a == b) return make2(graph, VES_OP_MUL, ves_graph_constant(graph, 2), a);
    return bare(graph, VES_OP_ADD, a < b ? a : b, a < b ? b : a, 0);
}

static int difference(ves_graph *graph, int a, int b)
{
    if (is(graph, b, 0)) return a;
    if (is(graph, a, 0) && graph->formal) return negation(graph, b);
    if (a == b && graph->formal) return ves_graph_constant(graph, 0);
    if (negated(graph, b)) return make2(graph, VES_OP_ADD, a, graph->node[b].a);
    return bare(graph, VES_OP_SUB, a, b, 0);
}

/* k * b, the constant being node a. */
static int multiple(ves_graph *graph, int a, double k, int b)
{
    if (k == 1) return b;
    if (k == -1) return negation(graph, b);
    if (k == 0 && graph->formal) return ves_graph_constant(graph, 0);
    if (negated(graph, b)) return make2(graph, VES_OP_MUL, ves_graph_constant(graph, -k), graph->node[b].a);
    if (graph->formal && scaled(graph, b)) {
        ves_node p = graph->node[b];
        return make2(graph, VES_OP_MUL, ves_graph_constant(graph, k * graph->node[p.a].value), p.b);
    }
    return bare(graph, VES_OP_MUL, a, b, 0);
}

static int product(ves_graph *graph, int a, int b)
{
    double k;
    if (ves_graph_is_constant(graph, a, &k)) return multiple(graph, a, k, b);
    if (ves_graph_is_constant(graph, b, &k)) return multiple(graph, b, k, a);
    if (a == b) return bare(graph, VES_OP_SQUARE, a, 0, 0);
    if (negated(graph, a)) return negation(graph, make2(graph, VES_OP_MUL, graph->node[a].a, b));
    if (negated(graph, b)) return negation(graph, make2(graph, VES_OP_MUL, a, graph->node[b].a));
    if (graph->formal && (scaled(graph, a) || scaled(graph, b))) {
        int far = scaled(graph, a) ? b : a;
        ves_node p = graph->node[scaled(graph, a) ? a : b];
        return make2(graph, VES_OP_MUL, p.a, make2(graph, VES_OP_MUL, p.b, far));
    }
    return bare(graph, VES_OP_MUL, a < b ? a : b, a < b ? b : a, 0);
}

static int quotient(ves_graph *graph, int a, int b)
{
    if (is(graph, b, 1)) return a;
    if (is(graph, b, -1)) return negation(graph, a);
    if (is(graph, a, 0) && graph->formal) return ves_graph_constant(graph, 0);
    if (negated(graph, a)) return negation(graph, make2(graph, VES_OP_DIV, graph->node[a].a, b));
    if (negated(graph, b)) return negation(graph, make2(graph, VES_OP_DIV, a, graph->node[b].a));
    if (graph->formal && scaled(graph, a)) {
        ves_node p = graph->node[a];
        return make2(graph, VES_OP_MUL, p.a, make2(graph, VES_OP_DIV, p.b, b));
    }
    return bare(graph, VES_OP_DIV, a, b, 0);
}

static int choice(ves_graph *graph, int condition, int yes, int no)
{
    double k;
    if (ves_graph_is_constant(graph, condition, &k)) return k != 0 ? yes : no;
    return yes == no ? yes : bare(graph, VES_OP_IF, condition, yes, no);
}

int ves_graph_make(ves_graph *graph, ves_operation operation, int a, int b, int c)
{
    if (graph->status) return 0;
    int operands = ves_operation_operands(operation);
    if (operands < 3) c = 0;
    if (operands < 2) b = 0;
    const ves_node *p = graph->node;
    if (p[a].operation == VES_OP_CONSTANT && p[b].operation == VES_OP_CONSTANT &&
        p[c].operation == VES_OP_CONSTANT)
        return ves_graph_constant(graph, ves_operation_eval(operation, p[a].value, p[b].value, p[c].value));
    switch (operation) {
    case VES_OP_ADD:
        return sum(graph, a, b);
    case VES_OP_SUB:
        return difference(graph, a, b);
    case VES_OP_MUL:
        return product(graph, a, b);
    case VES_OP_DIV:
        return quotient(graph, a, b);
    case VES_OP_NEG:
        return negation(graph, a);
    case VES_OP_IF:
        return choice(graph, a, b, c);
    default:
        return bare(graph, operation, a, b, c);
    }
}

int ves_graph_power(ves_graph *graph, int x, int y)
{
    double n;
    if (graph->status) return 0;
    if (!ves_graph_is_constant(graph, y, &n)) return make2(graph, VES_OP_POW, x, y);
    if (n == 0) return ves_graph_constant(graph, 1);
    if (n == 1) return x;
    if (n == 2) return make2(graph, VES_OP_MUL, x, x);
    if (n == 0.5) return ves_graph_make(graph, VES_OP_SQRT, x, 0, 0);
    if (n == -1) return make2(graph, VES_OP_DIV, ves_graph_constant(graph, 1), x);
    bool whole = n == floor(n) && fabs(n) <= LARGEST_POWER;
    return make2(graph, whole ? VES_OP_POWI : VES_OP_POW, x, y);
}

/* What is reachable from root: mark[k] = 1. Operands come before their users. */
static void reach(const ves_graph *graph, int root, int *mark)
{
    memset(mark, 0, (size_t)(root + 1) * sizeof *mark);
    mark[root] = 1;
    for (int k = root; k >= 0; k--) {
        const ves_node *p = &graph->node[k];
        int operands = ves_operation_operands(p->operation);
        if (!mark[k]) continue;
        if (operands > 0) mark[p->a] = 1;
        if (operands > 1) mark[p->b] = 1;
        if (operands > 2) mark[p->c] = 1;
    }
}

static int kind(const ves_node *node)
{
    return node->operation <= VES_OP_ARGUMENT ? (int)node->operation : VES_OP_ARGUMENT + 1;
}

/* Writes the marked nodes to the tape; mark becomes each node's place in the room. */
static void write_tape(const ves_graph *graph, int root, int *mark, const ves_formula *formula)
{
    double *constant = (double *)formula->constant;
    ves_step *step = (ves_step *)formula->step;
    int *slot = (int *)formula->slot, *argument = (int *)formula->argument;
    int first[4] = {0, formula->constants, formula->constants + formula->slots, 0}, at[4] = {0};
    first[3] = first[2] + formula->arguments;
    for (int k = 0; k <= root; k++) {
        const ves_node *p = &graph->node[k];
        int group = kind(p), here = at[group];
        if (!mark[k]) continue;
        mark[k] = first[group] + at[group]++;
        if (group == VES_OP_CONSTANT)
            constant[here] = p->value;
        else if (group == VES_OP_SLOT)
            slot[here] = p->a;
        else if (group == VES_OP_ARGUMENT)
            argument[here] = p->a;
        else
            step[here] = (ves_step){p->a, p->b, p->c, p->operation};
    }
    /* Operands that an operation does not have stay 0, a place that exists. */
    for (int k = 0; k < formula->steps; k++) {
        int operands = ves_operation_operands(step[k].operation);
        step[k].a = mark[step[k].a];
        step[k].b = operands > 1 ? mark[step[k].b] : 0;
        step[k].c = operands > 2 ? mark[step[k].c] : 0;
    }
}

/* One block: the struct, then its arrays by falling alignment. */
static ves_formula *laid_out(const ves_formula *sizes, ves_arena *arena)
{
    const ves_formula *s = sizes;
    size_t constants = (size_t)s->constants * sizeof(double), steps = (size_t)s->steps * sizeof(ves_step);
    size_t indices = (size_t)(s->slots + s->arguments) * sizeof(int),
           dims = (size_t)s->dims * sizeof(ves_dim);
    char *block = ves_arena_take(arena, 1, sizeof *s + constants + steps + indices + dims);
    if (!block) return NULL;
    ves_formula *formula = (ves_formula *)(void *)block;
    *formula = *s;
    block += sizeof *s;
    formula->constant = (const double *)(void *)block;
    formula->step = (const ves_step *)(void *)(block + constants);
    formula->slot = (const int *)(void *)(block + constants + steps);
    formula->argument = formula->slot + s->slots;
    formula->argument_dim = (const ves_dim *)(void *)(block + constants + steps + indices);
    if (dims) memcpy(block + constants + steps + indices, s->argument_dim, dims);
    return formula;
}

const ves_formula *ves_graph_finish(ves_graph *graph, int root, const ves_formula *like, ves_arena *arena)
{
    if (graph->status) return NULL;
    int *mark = graph->bucket, count[4] = {0}; /* the hash table is not needed any more */
    reach(graph, root, mark);
    for (int k = 0; k <= root; k++) count[kind(&graph->node[k])] += mark[k];
    ves_formula sizes = {.constants = count[VES_OP_CONSTANT],
                         .slots = count[VES_OP_SLOT],
                         .arguments = count[VES_OP_ARGUMENT],
                         .steps = count[VES_OP_ARGUMENT + 1],
                         .dim = like->dim,
                         .units = like->units,
                         .dims = like->dims,
                         .argument_dim = like->argument_dim};
    ves_formula *formula = laid_out(&sizes, arena);
    if (!formula) {
        graph->status = VES_MEMORY;
        return NULL;
    }
    write_tape(graph, root, mark, formula);
    return formula;
}

/* The matrix of a layout: which entries it has, and in which order its nodes are eliminated. Lower triangle, all columns of
 * a node alike but for the triangle on the diagonal. */
#include "shell/inside.h"

#include <stdlib.h>
#include <string.h>

/* Which elements touch each node: compressed lists. */
typedef struct touch {
    int *from, *element; /* [nodes + 1], [from[nodes]] */
    int *seen, *offset;  /* [nodes] scratch: marks, and where a node's rows begin in the column at hand */
    int *near;           /* [nodes] scratch: ranks of neighbours that are eliminated later, sorted */
} touch;

static int node_of(const ves_shell *shell, const shell_element *e, int k)
{
    return shell->model->weld[e->sheet][e->s[k]];
}

static ves_status touch_make(const ves_shell *shell, ves_arena *arena, touch *t)
{
    size_t nodes = (size_t)shell->model->nodes;
    t->from = ves_arena_take(arena, nodes + 2, sizeof *t->from);
    t->seen = ves_arena_take(arena, nodes, sizeof *t->seen);
    t->offset = ves_arena_take(arena, nodes, sizeof *t->offset);
    t->near = ves_arena_take(arena, nodes, sizeof *t->near);
    if (!t->from || !t->seen || !t->offset || !t->near) return VES_MEMORY;
    for (int k = 0; k < shell->elements; k++)
        for (int n = 0; n < shell->kind[shell->element[k].sheet].nodes; n++)
            t->from[node_of(shell, &shell->element[k], n) + 2]++;
    for (size_t k = 0; k < nodes; k++) t->from[k + 2] += t->from[k + 1];
    t->element = ves_arena_take(arena, (size_t)t->from[nodes + 1], sizeof *t->element);
    if (!t->element) return VES_MEMORY;
    for (int k = 0; k < shell->elements; k++)
        for (int n = 0; n < shell->kind[shell->element[k].sheet].nodes; n++)
            t->element[t->from[node_of(shell, &shell->element[k], n) + 1]++] = k;
    return VES_OK;
}

static int by_number(const void *a, const void *b)
{
    int x = *(const int *)a, y = *(const int *)b;
    return (x > y) - (x < y);
}

/* Neighbours that are eliminated later, in order: their ranks. Marks with node + 1. */
static int neighbours(const ves_shell *shell, int node, touch *t)
{
    int count = 0;
    for (int i = t->from[node]; i < t->from[node + 1]; i++) {
        const shell_element *e = &shell->element[t->element[i]];
        for (int k = 0; k < shell->kind[e->sheet].nodes; k++) {
            int other = node_of(shell, e, k);
            if (shell->rank[other] <= shell->rank[node] || t->seen[other] == node + 1) continue;
            t->seen[other] = node + 1;
            t->near[count++] = shell->rank[other];
        }
    }
    qsort(t->near, (size_t)count, sizeof *t->near, by_number);
    return count;
}

/* --- the order in which nodes are eliminated --- */

/* Which nodes meet in an element, as a pattern: [p] and, once there is a row, what is in it. */
static void graph(const ves_shell *shell, touch *t, int *p, int *row)
{
    int at = 0;
    memset(t->seen, 0, sizeof *t->seen * (size_t)shell->model->nodes);
    for (int node = 0; node < shell->model->nodes; node++) {
        int near = neighbours(shell, node, t);
        if (row) memcpy(row + at, t->near, sizeof *row * (size_t)near);
        p[node] = at, at += near;
    }
    p[shell->model->nodes] = at;
}

/* Minimum degree, which depends on the pattern alone (METIS keeps a state of its own between threads). */
static ves_status eliminate(ves_shell *shell, cholmod_sparse *graph)
{
    cholmod_common *c = &shell->common;
    c->method[0].ordering = CHOLMOD_AMD;
    cholmod_factor *factor = cholmod_analyze(graph, c);
    if (!factor) return VES_MEMORY;
    memcpy(shell->order, factor->Perm, sizeof *shell->order * factor->n);
    for (int k = 0; k < shell->model->nodes; k++) shell->rank[shell->order[k]] = k;
    cholmod_free_factor(&factor, c);
    return VES_OK;
}

ves_status ves_shell_order(ves_shell *shell, ves_arena *arena)
{
    touch t;
    size_t nodes = (size_t)shell->model->nodes;
    shell->order = ves_arena_take(arena, nodes, sizeof *shell->order);
    shell->rank = ves_arena_take(arena, nodes, sizeof *shell->rank);
    int *p = ves_arena_take(arena, nodes + 1, sizeof *p);
    if (!shell->order || !shell->rank || !p) return VES_MEMORY;
    VES_TRY(touch_make(shell, arena, &t));
    for (int k = 0; k < shell->model->nodes; k++) shell->order[k] = shell->rank[k] = k;
    graph(shell, &t, p, NULL);
    cholmod_sparse *all = cholmod_allocate_sparse(nodes, nodes, (size_t)p[nodes], true, true, -1,
                                                  CHOLMOD_PATTERN, &shell->common);
    if (!all) return VES_MEMORY;
    graph(shell, &t, all->p, all->i);
    ves_status status = eliminate(shell, all);
    cholmod_free_sparse(&all, &shell->common);
    return status;
}

/* --- entries --- */

/* Where, in the columns of a node, the rows of its neighbours begin: told to the elements that have both. */
static void places_tell(const ves_shell *shell, shell_layout *layout, int node, const touch *t)
{
    for (int i = t->from[node]; i < t->from[node + 1]; i++) {
        const shell_element *e = &shell->element[t->element[i]];
        int *place = layout->place[t->element[i]];
        int nodes = shell->kind[e->sheet].nodes;
        for (int b = 0; b < nodes; b++) {
            if (node_of(shell, e, b) != node) continue;
            for (int a = 0; a < nodes; a++) {
                int other = node_of(shell, e, a);
                place[a * nodes + b] = other == node                            ? 0
                                       : shell->rank[other] < shell->rank[node] ? -1
                                                                                : t->offset[other];
            }
        }
    }
}

static void column_write(const ves_shell *shell, const shell_layout *layout, int node, const touch *t,
                         int near, int *p, int *row)
{
    const shell_freedom *f = &layout->freedom[node];
    for (int c = 0; c < f->count; c++) {
        int at = p[f->first + c];
        for (int r = c; r < f->count; r++) row[at++] = f->first + r;
        for (int k = 0; k < near; k++) {
            const shell_freedom *other = &layout->freedom[shell->order[t->near[k]]];
            for (int r = 0; r < other->count; r++) row[at++] = other->first + r;
        }
    }
}

/* Twice over the nodes: to count, then to write. */
static void pattern(const ves_shell *shell, shell_layout *layout, touch *t, int *p, int *row)
{
    int at = 0;
    memset(t->seen, 0, sizeof *t->seen * (size_t)shell->model->nodes);
    for (int k = 0; k < shell->model->nodes; k++) {
        int node = shell->order[k];
        const shell_freedom *f = &layout->freedom[node];
        int near = neighbours(shell, node, t), rows = 0;
        for (int i = 0; i < near; i++) {
            int other = shell->order[t->near[i]];
            t->offset[other] = rows, rows += layout->freedom[other].count;
        }
        if (row) places_tell(shell, layout, node, t);
        for (int c = 0; !row && c < f->count; c++) p[f->first + c] = at, at += f->count - c + rows;
        if (row) column_write(shell, layout, node, t, near, p, row);
    }
    if (!row) p[layout->freedoms] = at;
}

ves_status ves_shell_layout(ves_shell *shell, shell_layout *layout, ves_arena *arena)
{
    touch t;
    size_t n = (size_t)layout->freedoms;
    VES_TRY(touch_make(shell, arena, &t));
    int *p = ves_arena_take(arena, n + 1, sizeof *p);
    if (!p) return VES_MEMORY;
    pattern(shell, layout, &t, p, NULL);
    layout->matrix =
        cholmod_allocate_sparse(n, n, (size_t)p[n], true, true, -1, CHOLMOD_REAL, &shell->common);
    if (!layout->matrix) return VES_MEMORY;
    memcpy(layout->matrix->p, p, (n + 1) * sizeof *p);
    pattern(shell, layout, &t, p, layout->matrix->i);
    return VES_OK;
}

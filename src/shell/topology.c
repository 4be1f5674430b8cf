/* What follows from a model alone: elements, degrees of freedom, the pattern of the matrix. */
#include "shell/inside.h"

#include <stdlib.h>
#include <string.h>

int ves_shell_rows(const ves_shell_sheet *s)
{
    return s->order[0] * s->elements[0] + 1;
}

int ves_shell_columns(const ves_shell_sheet *s)
{
    return s->order[1] * s->elements[1] + !s->closed;
}

static void line(const ves_shell_sheet *s, int d, int count, double *at)
{
    double node[VES_SHELL_ORDER + 1];
    ves_rule_nodes(s->order[d], node);
    for (int k = 0; k < count; k++) {
        int e = k / s->order[d], i = k % s->order[d];
        if (e == s->elements[d]) e--, i = s->order[d];
        double a = s->knot[d][e], b = s->knot[d][e + 1];
        at[k] = i == 0 ? a : i == s->order[d] ? b : a + (b - a) * (1 + node[i]) / 2;
    }
}

void ves_shell_grid(const ves_shell_sheet *sheet, double *u, double *v)
{
    line(sheet, 0, ves_shell_rows(sheet), u);
    line(sheet, 1, ves_shell_columns(sheet), v);
}

int ves_shell_edge_count(const ves_shell_sheet *s, int edge)
{
    return edge < 2 ? s->order[1] * s->elements[1] + 1 : ves_shell_rows(s);
}

int ves_shell_edge_node(const ves_shell_sheet *s, int edge, int k)
{
    int rows = ves_shell_rows(s), columns = ves_shell_columns(s);
    if (edge < 2) return k % columns * rows + (edge ? rows - 1 : 0);
    return (edge == 3 ? columns - 1 : 0) * rows + k;
}

/* --- elements --- */

static ves_status elements_make(ves_shell *shell, ves_arena *arena)
{
    const ves_shell_model *m = shell->model;
    for (int k = 0; k < m->sheets; k++) shell->elements += m->sheet[k].elements[0] * m->sheet[k].elements[1];
    shell->element = ves_arena_take(arena, (size_t)shell->elements, sizeof *shell->element);
    if (!shell->element) return VES_MEMORY;
    shell_element *e = shell->element;
    for (int k = 0; k < m->sheets; k++) {
        const ves_shell_sheet *s = &m->sheet[k];
        int rows = ves_shell_rows(s), columns = ves_shell_columns(s), p = s->order[0],
            nodes = shell->kind[k].nodes;
        for (int j = 0; j < s->elements[1]; j++)
            for (int i = 0; i < s->elements[0]; i++, e++) {
                *e = (shell_element){.sheet = k, .u = i, .v = j};
                e->s = ves_arena_take(arena, (size_t)nodes, sizeof *e->s);
                if (!e->s) return VES_MEMORY;
                for (int n = 0; n < nodes; n++)
                    e->s[n] = (j * s->order[1] + n / (p + 1)) % columns * rows + i * p + n % (p + 1);
            }
    }
    return VES_OK;
}

/* --- freedoms --- */

static void lead_find(ves_shell *shell)
{
    const ves_shell_model *m = shell->model;
    for (int k = 0; k < m->nodes; k++) shell->lead[k] = -1;
    for (int far = 0; far < 2; far++) /* near ones first: the axes are those of the near side */
        for (int sheet = 0; sheet < m->sheets; sheet++) {
            int count = ves_shell_rows(&m->sheet[sheet]) * ves_shell_columns(&m->sheet[sheet]);
            for (int s = 0; s < count; s++) {
                int node = m->weld[sheet][s];
                bool is_far = m->far && m->far[sheet] && m->far[sheet][s];
                if (shell->lead[node] < 0 && is_far == far)
                    shell->lead[node] = s, shell->lead_sheet[node] = sheet;
            }
        }
}

static void freedom_make(const ves_shell *shell, shell_layout *layout, int node)
{
    const ves_shell_node *d = &shell->model->node[node];
    shell_freedom *f = &layout->freedom[node];
    unsigned held = ves_shell_mask(shell, layout, node);
    int rank = d->fold ? 0 : ves_shell_rank(shell, layout, node), at = 0;
    *f = (shell_freedom){.first = layout->freedoms};
    for (int k = 0; k < 3; k++) f->moves[k] = held >> k & 1 ? -1 : at++;
    for (int k = 0; k < 3; k++) {
        bool fixed = d->fold ? held >> (3 + k) & 1 : k < rank || k == 2;
        f->turns[k] = fixed ? -1 : at++;
    }
    f->count = at;
    layout->freedoms += at;
}

static ves_status layout_number(ves_shell *shell, int index, ves_arena *arena)
{
    const ves_shell_model *m = shell->model;
    shell_layout *layout = &shell->layout[index];
    size_t nodes = (size_t)m->nodes;
    layout->held = index ? m->held[index - 1] : NULL;
    layout->freedom = ves_arena_take(arena, nodes, sizeof *layout->freedom);
    layout->pivot = ves_arena_take(arena, nodes, sizeof *layout->pivot);
    layout->place = ves_arena_take(arena, (size_t)shell->elements, sizeof *layout->place);
    if (!layout->freedom || !layout->pivot || !layout->place) return VES_MEMORY;
    for (int k = 0; k < m->nodes; k++) freedom_make(shell, layout, k);
    for (int k = 0; k < shell->elements; k++) {
        const shell_element *e = &shell->element[k];
        int columns = 0, count = shell->kind[e->sheet].nodes;
        for (int n = 0; n < count; n++) columns += layout->freedom[m->weld[e->sheet][e->s[n]]].count;
        if (columns > shell->widest) shell->widest = columns;
        layout->place[k] = ves_arena_take(arena, (size_t)(count * count), sizeof **layout->place);
        if (!layout->place[k]) return VES_MEMORY;
    }
    return VES_OK;
}

ves_status ves_shell_number(ves_shell *shell, ves_arena *arena)
{
    const ves_shell_model *m = shell->model;
    size_t nodes = (size_t)m->nodes;
    shell->lead = ves_arena_take(arena, nodes, sizeof *shell->lead);
    shell->lead_sheet = ves_arena_take(arena, nodes, sizeof *shell->lead_sheet);
    shell->layouts = 1 + (m->buckling ? m->classes : 0);
    shell->layout = ves_arena_take(arena, (size_t)shell->layouts, sizeof *shell->layout);
    if (!shell->lead || !shell->lead_sheet || !shell->layout) return VES_MEMORY;
    lead_find(shell);
    VES_TRY(elements_make(shell, arena));
    for (int k = 0; k < shell->layouts; k++) VES_TRY(layout_number(shell, k, arena));
    return VES_OK;
}

/* --- the matrix: lower triangle, all columns of a node alike but for the triangle on the diagonal --- */

/* Which elements touch each node: compressed lists. */
typedef struct touch {
    int *from, *element; /* [nodes + 1], [from[nodes]] */
    int *seen, *offset;  /* [nodes] scratch: marks, and where a node's rows begin in the column at hand */
    int *near;           /* [nodes] scratch: neighbours beyond, sorted */
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

/* Neighbours of a node with a higher number, in order; marks with node + 1. */
static int neighbours(const ves_shell *shell, int node, touch *t)
{
    int count = 0;
    for (int i = t->from[node]; i < t->from[node + 1]; i++) {
        const shell_element *e = &shell->element[t->element[i]];
        for (int k = 0; k < shell->kind[e->sheet].nodes; k++) {
            int other = node_of(shell, e, k);
            if (other <= node || t->seen[other] == node + 1) continue;
            t->seen[other] = node + 1;
            t->near[count++] = other;
        }
    }
    qsort(t->near, (size_t)count, sizeof *t->near, by_number);
    return count;
}

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
                place[a * nodes + b] = other < node ? -1 : other == node ? 0 : t->offset[other];
            }
        }
    }
}

static void column_write(const shell_layout *layout, int node, const touch *t, int near, int *p, int *row)
{
    const shell_freedom *f = &layout->freedom[node];
    for (int c = 0; c < f->count; c++) {
        int at = p[f->first + c];
        for (int r = c; r < f->count; r++) row[at++] = f->first + r;
        for (int k = 0; k < near; k++) {
            const shell_freedom *other = &layout->freedom[t->near[k]];
            for (int r = 0; r < other->count; r++) row[at++] = other->first + r;
        }
    }
}

/* Twice over the nodes: to count, then to write. */
static void pattern(const ves_shell *shell, shell_layout *layout, touch *t, int *p, int *row)
{
    int at = 0;
    memset(t->seen, 0, sizeof *t->seen * (size_t)shell->model->nodes);
    for (int node = 0; node < shell->model->nodes; node++) {
        const shell_freedom *f = &layout->freedom[node];
        int near = neighbours(shell, node, t), rows = 0;
        for (int k = 0; k < near; k++)
            t->offset[t->near[k]] = rows, rows += layout->freedom[t->near[k]].count;
        if (row) places_tell(shell, layout, node, t);
        for (int c = 0; !row && c < f->count; c++) p[f->first + c] = at, at += f->count - c + rows;
        if (row) column_write(layout, node, t, near, p, row);
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

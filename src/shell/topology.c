/* What follows from a model alone: elements, degrees of freedom. */
#include "shell/inside.h"

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

/* Numbered as the nodes are eliminated: CHOLMOD then takes matrices as they are, where it would transpose each twice. */
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
    for (int k = 0; k < m->nodes; k++) freedom_make(shell, layout, shell->order[k]);
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
    VES_TRY(ves_shell_order(shell, arena));
    for (int k = 0; k < shell->layouts; k++) VES_TRY(layout_number(shell, k, arena));
    return VES_OK;
}

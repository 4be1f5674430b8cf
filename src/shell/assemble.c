/* Assembly of the stiffness: blocks of element matrices into the columns of the sparse one. */
#include "shell/inside.h"

#include <string.h>

/* A fold has no stiffness about the common normal of directors that happen to be parallel. This, a share of the
 * bending stiffness, is too little to be felt and enough to be solved. */
static const double DRILLING = 1e-8;

/* Block (a, b) of a symmetric element matrix, of which the lower triangle is there. */
static double entry(const double *K, int columns, int i, int j)
{
    return i >= j ? K[j * columns + i] : K[i * columns + j];
}

/* Values of the columns of one node in the pattern. */
typedef struct block {
    const shell_freedom *row, *column; /* of nodes a and b */
    int from[2];                       /* in the element's matrix */
    bool same;                         /* a is b */
    int place;
} block;

static void block_add(const shell_layout *layout, const double *K, int columns, const block *b, double factor,
                      double *x)
{
    const int *p = layout->matrix->p;
    for (int c = 0; c < b->column->count; c++) {
        double *to = x + p[b->column->first + c] + (b->same ? -c : b->column->count - c + b->place);
        for (int r = b->same ? c : 0; r < b->row->count; r++)
            to[r] += factor * entry(K, columns, b->from[0] + r, b->from[1] + c);
    }
}

/* Between a near row and a far column, exp(i a); the other way round its conjugate. */
void ves_shell_element_add(const ves_shell *shell, const shell_layout *layout, const shell_element *e,
                           int columns, const shell_parts *to)
{
    int nodes = shell->kind[e->sheet].nodes;
    const int *weld = shell->model->weld[e->sheet], *place = layout->place[e - shell->element];
    for (int b = 0, column = 0; b < nodes; column += layout->freedom[weld[e->s[b]]].count, b++)
        for (int a = 0, row = 0; a < nodes; row += layout->freedom[weld[e->s[a]]].count, a++) {
            if (place[a * nodes + b] < 0) continue;
            const block at = {.row = &layout->freedom[weld[e->s[a]]],
                              .column = &layout->freedom[weld[e->s[b]]],
                              .from = {row, column},
                              .same = weld[e->s[a]] == weld[e->s[b]],
                              .place = place[a * nodes + b]};
            int phase = to->x[1] ? ves_shell_is_far(shell, e->sheet, e->s[b]) -
                                       ves_shell_is_far(shell, e->sheet, e->s[a])
                                 : 0;
            block_add(layout, shell->K, columns, &at, 1, to->x[phase != 0]);
            if (phase) block_add(layout, shell->K, columns, &at, phase, to->x[2]);
        }
}

double ves_shell_drilling(const ves_shell *shell, int node)
{
    double t = shell->input->thickness[shell->lead_sheet[node]][shell->lead[node]];
    return shell->model->node[node].fold ? DRILLING * shell->input->material.E * t * t * t : 0;
}

/* Of springs along x, y, z, between the directions in which a node moves. */
static void node_springs_add(const shell_layout *layout, const ves_shell_node *node, const shell_freedom *f,
                             double *x)
{
    const int *diagonal = layout->matrix->p;
    for (int j = 0; j < 3; j++)
        for (int i = j; i < 3 && f->moves[j] >= 0; i++)
            for (int c = 0; c < 3 && f->moves[i] >= 0; c++)
                x[diagonal[f->first + f->moves[j]] + f->moves[i] - f->moves[j]] +=
                    node->spring[c] * node->frame[i][c] * node->frame[j][c];
}

/* Springs at nodes, and what stiffens folds. */
void ves_shell_nodes_add(const ves_shell *shell, const shell_layout *layout, const shell_parts *to)
{
    const int *diagonal = layout->matrix->p;
    const ves_shell_model *m = shell->model;
    for (int k = 0; k < m->nodes; k++) {
        const shell_freedom *f = &layout->freedom[k];
        node_springs_add(layout, &m->node[k], f, to->x[0]);
        for (int i = 0; m->node[k].fold && i < 3; i++)
            if (f->turns[i] >= 0) to->x[0][diagonal[f->first + f->turns[i]]] += ves_shell_drilling(shell, k);
    }
}

void ves_shell_parts_clear(const shell_layout *layout, const shell_parts *parts)
{
    for (int k = 0; k < 3; k++)
        if (parts->x[k]) memset(parts->x[k], 0, sizeof(double) * layout->matrix->nzmax);
}

ves_status ves_shell_assemble(ves_shell *shell, const shell_layout *layout)
{
    const shell_parts whole = {{layout->matrix->x}};
    ves_shell_parts_clear(layout, &whole);
    ves_shell_firm_clear(shell);
    for (int i = 0; i < shell->elements; i++) {
        const shell_element *e = &shell->element[i];
        ves_shell_body body = ves_shell_gather(shell, e);
        int columns = ves_shell_columns_of(shell, layout, e);
        shell->turned = i;
        VES_TRY(ves_shell_stiffness(&body, &shell->input->material, columns, shell->column, &shell->scratch,
                                    shell->K));
        ves_shell_firm_add(shell, e, columns);
        ves_shell_springs(shell, e, &body, columns);
        ves_shell_element_add(shell, layout, e, columns, &whole);
    }
    ves_shell_nodes_add(shell, layout, &whole);
    return VES_OK;
}

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

static void block_add(const ves_shell *shell, int columns, int row, int column, int node_a, int node_b,
                      int place)
{
    const shell_freedom *a = &shell->freedom[node_a], *b = &shell->freedom[node_b];
    const int *p = shell->matrix->p;
    double *x = shell->matrix->x;
    for (int c = 0; c < b->count; c++) {
        double *to = x + p[b->first + c];
        if (node_a == node_b)
            for (int r = c; r < a->count; r++) to[r - c] += entry(shell->K, columns, row + r, column + c);
        else
            for (int r = 0; r < a->count; r++)
                to[b->count - c + place + r] += entry(shell->K, columns, row + r, column + c);
    }
}

static void element_add(const ves_shell *shell, const shell_element *e, int columns)
{
    int nodes = shell->kind[e->sheet].nodes;
    const int *weld = shell->model->weld[e->sheet];
    for (int b = 0, column = 0; b < nodes; column += shell->freedom[weld[e->s[b]]].count, b++)
        for (int a = 0, row = 0; a < nodes; row += shell->freedom[weld[e->s[a]]].count, a++)
            if (e->place[a * nodes + b] >= 0)
                block_add(shell, columns, row, column, weld[e->s[a]], weld[e->s[b]], e->place[a * nodes + b]);
}

static void diagonal_add(ves_shell *shell, int freedom, double stiffness)
{
    ((double *)shell->matrix->x)[((const int *)shell->matrix->p)[freedom]] += stiffness;
}

/* Springs at nodes, along x, y, z; a frame that is turned couples them, which is why frames of sprung nodes are not
 * (checked by who makes the model). */
static void nodes_add(ves_shell *shell)
{
    const ves_shell_model *m = shell->model;
    const ves_shell_input *in = shell->input;
    for (int k = 0; k < m->nodes; k++) {
        const shell_freedom *f = &shell->freedom[k];
        double t = in->thickness[shell->lead_sheet[k]][shell->lead[k]];
        for (int i = 0; i < 3; i++)
            if (f->moves[i] >= 0 && m->node[k].spring[i] > 0)
                diagonal_add(shell, f->first + f->moves[i], m->node[k].spring[i]);
        for (int i = 0; m->node[k].fold && i < 3; i++)
            if (f->turns[i] >= 0)
                diagonal_add(shell, f->first + f->turns[i], DRILLING * in->material.E * t * t * t);
    }
}

ves_status ves_shell_assemble(ves_shell *shell)
{
    memset(shell->matrix->x, 0, sizeof(double) * shell->matrix->nzmax);
    for (int i = 0; i < shell->elements; i++) {
        const shell_element *e = &shell->element[i];
        ves_shell_body body = ves_shell_gather(shell, e);
        int columns = ves_shell_columns_of(shell, e);
        VES_TRY(ves_shell_stiffness(&body, &shell->input->material, columns, shell->column, &shell->scratch,
                                    shell->K));
        ves_shell_springs(shell, e, &body, columns);
        element_add(shell, e, columns);
    }
    nodes_add(shell);
    return VES_OK;
}

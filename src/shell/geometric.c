#include "shell/geometric.h"

#include <string.h>

#include <cblas.h>

#include "base/vector.h"
#include "shell/lamina.h"

static const double Z = VES_LEVEL;

ves_status ves_shell_geometric_make(const ves_shell *shell, ves_arena *arena, shell_geometric *g)
{
    size_t nodes = 0, points = 0;
    for (int k = 0; k < shell->model->sheets; k++) {
        const ves_shell_kind *kind = &shell->kind[k];
        if ((size_t)kind->nodes > nodes) nodes = (size_t)kind->nodes;
        if ((size_t)kind->rule.points > points) points = (size_t)kind->rule.points;
    }
    g->move = ves_arena_doubles(arena, nodes * nodes);
    g->cross = ves_arena_doubles(arena, nodes * nodes);
    for (int c = 0; c < 3; c++) g->follow[c] = ves_arena_doubles(arena, nodes * nodes);
    for (int k = 0; k < 2; k++) g->row[k] = ves_arena_doubles(arena, points * nodes);
    g->force = ves_arena_doubles(arena, points * VES_GENERAL);
    g->on_U = ves_arena_take(arena, nodes, sizeof *g->on_U);
    g->on_V = ves_arena_take(arena, nodes, sizeof *g->on_V);
    return g->move && g->cross && g->follow[0] && g->follow[1] && g->follow[2] && g->row[0] && g->row[1] &&
                   g->force && g->on_U && g->on_V
               ? VES_OK
               : VES_MEMORY;
}

/* out (+)= N_r' row0 + N_s' row1, [nodes][nodes]. */
static void product(const ves_shell_kind *kind, const shell_geometric *g, double *out)
{
    const double *slope[2] = {kind->rule.table.Nr, kind->rule.table.Ns};
    for (int k = 0; k < 2; k++)
        cblas_dgemm(CblasRowMajor, CblasTrans, CblasNoTrans, kind->nodes, kind->nodes, kind->rule.points, 1,
                    slope[k], kind->nodes, g->row[k], kind->nodes, k, out, kind->nodes);
}

/* Rows of what S^ab, of z S^ab and S^a3 multiply. */
static void rows_even(const ves_shell_kind *kind, const shell_geometric *g)
{
    const ves_shell_table *t = &kind->rule.table;
    for (int q = 0; q < kind->rule.points; q++)
        for (int k = q * kind->nodes; k < (q + 1) * kind->nodes; k++) {
            const double *f = g->force + q * VES_GENERAL;
            g->row[0][k] = f[0] * t->Nr[k] + f[2] * t->Ns[k];
            g->row[1][k] = f[2] * t->Nr[k] + f[1] * t->Ns[k];
        }
}

static void rows_odd(const ves_shell_kind *kind, const shell_geometric *g)
{
    const ves_shell_table *t = &kind->rule.table;
    for (int q = 0; q < kind->rule.points; q++)
        for (int k = q * kind->nodes; k < (q + 1) * kind->nodes; k++) {
            const double *f = g->force + q * VES_GENERAL;
            g->row[0][k] = Z * (f[3] * t->Nr[k] + f[5] * t->Ns[k]) + f[6] * t->N[k];
            g->row[1][k] = Z * (f[5] * t->Nr[k] + f[4] * t->Ns[k]) + f[7] * t->N[k];
        }
}

/* Pressure on N_k a does the work a . (p (N_l,r b x X_s + X_r x N_l,s b)) N_k = (a x b) . c_kl with
 * c_kl = p N_k (N_l,r X_s - N_l,s X_r); symmetric in (k a), (l b): (c_kl - c_lk) / 2, which is left in follow. */
static void follow_make(ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                        const double *pressure, const shell_geometric *g)
{
    const ves_shell_points *rule = &body->kind->rule;
    int nodes = body->kind->nodes;
    for (int c = 0; c < 3; c++) memset(g->follow[c], 0, sizeof(double) * (size_t)(nodes * nodes));
    for (int q = 0; pressure && q < rule->points; q++) {
        const double *N = rule->table.N + q * nodes, *Nr = rule->table.Nr + q * nodes,
                     *Ns = rule->table.Ns + q * nodes;
        ves_shell_frame f;
        double p = 0;
        ves_shell_frame_at(body, &rule->table, q, &f);
        for (int k = 0; k < nodes; k++) p += N[k] * pressure[e->s[k]];
        p *= shell->input->side[e->sheet] * rule->weight[q] / 2;
        for (int k = 0; k < nodes; k++)
            for (int l = 0; l < k; l++) {
                double by_s = p * (N[k] * Nr[l] - N[l] * Nr[k]), by_r = p * (N[k] * Ns[l] - N[l] * Ns[k]);
                for (int c = 0; c < 3; c++) g->follow[c][k * nodes + l] += by_s * f.Xs[c] - by_r * f.Xr[c];
            }
    }
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < nodes; k++)
            for (int l = 0; l < k; l++) g->follow[c][l * nodes + k] = -g->follow[c][k * nodes + l];
}

ves_status ves_shell_geometric_take(ves_shell *shell, const shell_element *e, int which,
                                    const shell_geometric *g)
{
    const double *u = ves_shell_state(shell, which);
    const ves_shell_load *load = &shell->input->load[which * shell->model->sheets + e->sheet];
    ves_shell_body body = ves_shell_gather(shell, e);
    const ves_shell_kind *kind = body.kind;
    ves_shell_field(shell, &shell->layout[0], e, u);
    ves_shell_strains(&body, &kind->rule, (const double(*)[3])shell->U, (const double(*)[3])shell->A,
                      &shell->scratch, g->force);
    for (int q = 0; q < kind->rule.points; q++) {
        double strain[VES_GENERAL], *force = g->force + q * VES_GENERAL;
        ves_shell_frame frame;
        memcpy(strain, force, sizeof strain);
        ves_shell_frame_at(&body, &kind->rule.table, q, &frame);
        if (!ves_lamina_forces(&frame, &shell->input->material, kind->rule.weight[q], strain, force))
            return VES_DEGENERATE;
    }
    rows_even(kind, g);
    product(kind, g, g->move);
    rows_odd(kind, g);
    product(kind, g, g->cross);
    memset(g->on_U, 0, sizeof *g->on_U * (size_t)kind->nodes);
    memset(g->on_V, 0, sizeof *g->on_V * (size_t)kind->nodes);
    ves_shell_pull(&body, &kind->rule, g->force, &shell->scratch, g->on_U, g->on_V);
    follow_make(shell, e, &body, load->pressure, g);
    return VES_OK;
}

/* Of two turns of one node: f . (a (b . V) + b (a . V)) / 2 - (f . V) (a . b), twice f . a x (b x V) / 2 made
 * symmetric. */
static double turn_twice(const double f[3], const double V[3], const ves_shell_column *a,
                         const ves_shell_column *b)
{
    return (ves_dot(f, a->axis) * ves_dot(V, b->axis) + ves_dot(f, b->axis) * ves_dot(V, a->axis)) / 2 -
           ves_dot(f, V) * ves_dot(a->axis, b->axis);
}

void ves_shell_geometric(ves_shell *shell, const ves_shell_body *body, int columns, const shell_geometric *g)
{
    int nodes = body->kind->nodes;
    for (int j = 0; j < columns; j++)
        for (int i = j; i < columns; i++) {
            const ves_shell_column *a = &shell->column[i], *b = &shell->column[j];
            int k = a->node, l = b->node, kl = k * nodes + l, lk = l * nodes + k;
            double along = ves_dot(a->vector, b->vector), of = g->move[kl], more = 0;
            if (a->turns && b->turns) {
                of *= Z * Z;
                if (k == l) more = turn_twice(g->on_V[k], body->V[k], a, b);
            } else if (a->turns || b->turns)
                of = a->turns ? g->cross[lk] : g->cross[kl];
            else {
                double n[3];
                ves_cross(a->vector, b->vector, n);
                for (int c = 0; c < 3; c++) more -= n[c] * g->follow[c][kl];
            }
            shell->K[j * columns + i] = along * of + more;
        }
}

/* The element at hand: its nodes, and its degrees of freedom as vectors at them. */
#include "shell/inside.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

static void turned(const double turn[3][3], const double a[3], double out[3])
{
    for (int r = 0; r < 3; r++) out[r] = ves_dot(turn[r], a);
}

bool ves_shell_is_far(const ves_shell *shell, int sheet, int s)
{
    return shell->model->far && shell->model->far[sheet] && shell->model->far[sheet][s];
}

static void normal_of(const ves_shell *shell, int sheet, int s, double n[3])
{
    for (int c = 0; c < 3; c++) n[c] = shell->input->normal[sheet][c][s];
}

ves_shell_body ves_shell_gather(ves_shell *shell, const shell_element *e)
{
    const ves_shell_input *in = shell->input;
    const ves_shell_kind *kind = &shell->kind[e->sheet];
    for (int k = 0; k < kind->nodes; k++) {
        double half = in->side[e->sheet] * in->thickness[e->sheet][e->s[k]] / 2;
        for (int c = 0; c < 3; c++) {
            shell->X[k][c] = in->X[e->sheet][c][e->s[k]];
            shell->V[k][c] = half * in->normal[e->sheet][c][e->s[k]];
        }
    }
    return (ves_shell_body){kind, (const double(*)[3])shell->X, (const double(*)[3])shell->V};
}

/* Some orthonormal t1, t2 across n. */
static void tangents(const double n[3], double t[2][3])
{
    int least = fabs(n[0]) <= fabs(n[1]) ? 0 : 1;
    if (fabs(n[2]) < fabs(n[least])) least = 2;
    double e[3] = {0};
    e[least] = 1;
    ves_cross(n, e, t[0]);
    double length = sqrt(ves_dot(t[0], t[0]));
    for (int c = 0; c < 3; c++) t[0][c] /= length;
    ves_cross(n, t[0], t[1]);
}

/* The two axes of a smooth node, the one that it is held about most first; returns how much it is about the second. */
static double smooth_axes(const ves_shell_node *node, unsigned held, const double n[3], double axis[2][3])
{
    double t[2][3], G[3] = {0};
    tangents(n, t);
    for (int k = 0; k < 3; k++) {
        if (!(held >> (3 + k) & 1)) continue;
        double a = ves_dot(node->frame[k], t[0]), b = ves_dot(node->frame[k], t[1]);
        G[0] += a * a, G[1] += a * b, G[2] += b * b;
    }
    double angle = atan2(2 * G[1], G[0] - G[2]) / 2, co = cos(angle), si = sin(angle);
    for (int c = 0; c < 3; c++) {
        axis[0][c] = co * t[0][c] + si * t[1][c];
        axis[1][c] = co * t[1][c] - si * t[0][c];
    }
    return si * si * G[0] - 2 * si * co * G[1] + co * co * G[2];
}

/* About how many directions of its tangent plane a smooth node may not turn: an axis that is nearly along its normal
 * holds nothing. */
unsigned ves_shell_mask(const ves_shell *shell, const shell_layout *layout, int node)
{
    return layout->held ? layout->held[node] : shell->model->node[node].held;
}

int ves_shell_rank(const ves_shell *shell, const shell_layout *layout, int node)
{
    static const double HOLDS = 1e-6; /* squares of sines */
    const ves_shell_node *d = &shell->model->node[node];
    unsigned held = ves_shell_mask(shell, layout, node);
    double n[3], axis[2][3], largest = 0;
    normal_of(shell, shell->lead_sheet[node], shell->lead[node], n);
    double second = smooth_axes(d, held, n, axis);
    for (int k = 0; k < 3; k++)
        if (held >> (3 + k) & 1) largest += pow(ves_dot(d->frame[k], axis[0]), 2);
    return (largest > HOLDS) + (second > HOLDS);
}

/* The axes are those of G = sum of (a_k . t_i) (a_k . t_j), which stays diagonal; t_i goes along by -n (t_i . dn). */
void ves_shell_drift(const ves_shell *shell, const shell_layout *layout, int node, double drift[3])
{
    const ves_shell_node *d = &shell->model->node[node];
    const double(*t)[3] = (const double(*)[3])layout->pivot[node].axis;
    unsigned held = ves_shell_mask(shell, layout, node);
    double n[3], gap = 0;
    normal_of(shell, shell->lead_sheet[node], shell->lead[node], n);
    memset(drift, 0, 3 * sizeof *drift);
    for (int k = 0; k < 3; k++) {
        if (!(held >> (3 + k) & 1)) continue;
        double a = ves_dot(d->frame[k], t[0]), b = ves_dot(d->frame[k], t[1]), up = ves_dot(d->frame[k], n);
        gap += a * a - b * b;
        for (int c = 0; c < 3; c++) drift[c] -= up * (b * t[0][c] + a * t[1][c]);
    }
    for (int c = 0; c < 3; c++) drift[c] /= gap;
}

void ves_shell_pivots(const ves_shell *shell, shell_layout *layout)
{
    const ves_shell_model *m = shell->model;
    for (int k = 0; k < m->nodes; k++) {
        const ves_shell_node *node = &m->node[k];
        double n[3], axis[2][3];
        if (node->fold) {
            memcpy(layout->pivot[k].axis, node->frame, sizeof node->frame);
            continue;
        }
        normal_of(shell, shell->lead_sheet[k], shell->lead[k], n);
        smooth_axes(node, ves_shell_mask(shell, layout, k), n, axis);
        memcpy(layout->pivot[k].axis, axis, sizeof axis);
    }
}

/* The vector of a rotation about an axis at s: what it does to the half-thickness director there. */
static void director_vector(const ves_shell *shell, int sheet, int s, const double axis[3],
                            ves_shell_column *column)
{
    const ves_shell_input *in = shell->input;
    double n[3], *about = column->axis, *out = column->vector;
    normal_of(shell, sheet, s, n);
    if (ves_shell_is_far(shell, sheet, s))
        turned(shell->model->turn, axis, about);
    else
        memcpy(about, axis, sizeof column->axis);
    ves_cross(about, n, out);
    for (int c = 0; c < 3; c++) out[c] *= in->side[sheet] * in->thickness[sheet][s] / 2;
}

int ves_shell_columns_of(ves_shell *shell, const shell_layout *layout, const shell_element *e)
{
    const ves_shell_model *m = shell->model;
    int count = 0;
    for (int k = 0; k < shell->kind[e->sheet].nodes; k++) {
        int s = e->s[k], node = m->weld[e->sheet][s];
        const shell_freedom *f = &layout->freedom[node];
        for (int i = 0; i < 6; i++) {
            int offset = i < 3 ? f->moves[i] : f->turns[i - 3];
            if (offset < 0) continue;
            ves_shell_column *c = &shell->column[count];
            c->node = k, c->turns = i > 2;
            if (c->turns)
                director_vector(shell, e->sheet, s, layout->pivot[node].axis[i - 3], c);
            else if (ves_shell_is_far(shell, e->sheet, s))
                turned(m->turn, m->node[node].frame[i], c->vector);
            else
                memcpy(c->vector, m->node[node].frame[i], sizeof c->vector);
            shell->freedom_of[count++] = f->first + offset;
        }
    }
    return count;
}

void ves_shell_field(ves_shell *shell, const shell_layout *layout, const shell_element *e,
                     const double *vector)
{
    int count = ves_shell_columns_of(shell, layout, e), nodes = shell->kind[e->sheet].nodes;
    memset(shell->U, 0, sizeof *shell->U * (size_t)nodes);
    memset(shell->A, 0, sizeof *shell->A * (size_t)nodes);
    for (int i = 0; i < count; i++) {
        const ves_shell_column *c = &shell->column[i];
        double *to = c->turns ? shell->A[c->node] : shell->U[c->node], x = vector[shell->freedom_of[i]];
        for (int d = 0; d < 3; d++) to[d] += x * c->vector[d];
    }
}

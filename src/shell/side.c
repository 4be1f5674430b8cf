#include "shell/side.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

static void at_point(int nodes, const double *N, const double (*of)[3], double out[3])
{
    for (int c = 0; c < 3; c++) {
        out[c] = 0;
        for (int k = 0; k < nodes; k++) out[c] += N[k] * of[k][c];
    }
}

/* --- areas and pressure --- */

/* The work w . (force |n| + pressure side n) with n = X_r x X_s. */
static void surface_pull(const ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                         const shell_side *of)
{
    const ves_shell_load *load = &shell->input->load[of->which * shell->model->sheets + e->sheet];
    const ves_shell_points *rule = &body->kind->rule;
    const int nodes = body->kind->nodes;
    if (!load->pressure && !load->area[0]) return;
    for (int q = 0; q < rule->points; q++) {
        const double *N = rule->table.N + q * nodes, weight = rule->weight[q],
                     side = shell->input->side[e->sheet];
        ves_shell_frame f;
        double n[3], w[3], on_n[3], on_r[3], on_s[3], pressure = 0, along = 0;
        ves_shell_frame_at(body, &rule->table, q, &f);
        ves_cross(f.Xr, f.Xs, n);
        at_point(nodes, N, of->work, w);
        double area = sqrt(ves_dot(n, n));
        for (int k = 0; k < nodes; k++) {
            if (load->pressure) pressure += N[k] * load->pressure[e->s[k]];
            for (int c = 0; c < 3 && load->area[0]; c++) along += N[k] * load->area[c][e->s[k]] * w[c];
        }
        for (int c = 0; c < 3; c++) on_n[c] = weight * (along * n[c] / area + pressure * side * w[c]);
        ves_cross(f.Xs, on_n, on_r);
        ves_cross(on_n, f.Xr, on_s);
        for (int k = 0; k < nodes; k++)
            for (int c = 0; c < 3; c++) {
                of->on_X[k][c] +=
                    rule->table.Nr[q * nodes + k] * on_r[c] + rule->table.Ns[q * nodes + k] * on_s[c];
                if (of->load && of->load->area[c]) of->load->area[c][e->s[k]] += weight * area * N[k] * w[c];
            }
        for (int k = 0; k < nodes && of->load && of->load->pressure; k++)
            of->load->pressure[e->s[k]] += weight * N[k] * side * ves_dot(n, w);
    }
}

/* Of p side u . (u_r x X_s + X_r x u_s). */
void ves_shell_follow_pull(const ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                           const shell_side *of, double factor)
{
    const double *plane = shell->input->load[of->which * shell->model->sheets + e->sheet].pressure;
    const ves_shell_points *rule = &body->kind->rule;
    const int nodes = body->kind->nodes;
    for (int q = 0; q < rule->points && plane; q++) {
        const double *N = rule->table.N + q * nodes, *Nr = rule->table.Nr + q * nodes,
                     *Ns = rule->table.Ns + q * nodes;
        ves_shell_frame f;
        double u[3], ur[3], us[3], on_s[3], on_r[3], pressure = 0, scale;
        ves_shell_frame_at(body, &rule->table, q, &f);
        at_point(nodes, N, of->U, u);
        at_point(nodes, Nr, of->U, ur);
        at_point(nodes, Ns, of->U, us);
        ves_cross(u, ur, on_s);
        ves_cross(us, u, on_r);
        scale = factor * shell->input->side[e->sheet] * rule->weight[q];
        for (int k = 0; k < nodes; k++) pressure += N[k] * plane[e->s[k]];
        for (int k = 0; k < nodes; k++) {
            for (int c = 0; c < 3; c++)
                of->on_X[k][c] += scale * pressure * (Nr[k] * on_r[c] + Ns[k] * on_s[c]);
            if (of->load && of->load->pressure)
                of->load->pressure[e->s[k]] += scale * N[k] * (ves_dot(on_s, f.Xs) + ves_dot(on_r, f.Xr));
        }
    }
}

/* --- edges --- */

static void line_field(const shell_line *l, int q, const double (*of)[3], double out[3])
{
    for (int c = 0; c < 3; c++) {
        out[c] = 0;
        for (int k = 0; k < l->count; k++) out[c] += l->N[q][k] * of[l->node[k]][c];
    }
}

/* `density` times the length at a point. */
static void length_pull(const shell_line *l, int q, double density, double (*on_X)[3])
{
    for (int k = 0; k < l->count; k++)
        for (int c = 0; c < 3; c++)
            on_X[l->node[k]][c] += density * l->weight[q] * l->slope[q][k] * l->t[q][c] / l->length[q];
}

static void line_pull(const ves_shell *shell, const shell_element *e, const ves_shell_body *body, int edge,
                      const shell_side *of)
{
    const ves_shell_load *load = &shell->input->load[of->which * shell->model->sheets + e->sheet];
    shell_line l;
    if (!load->line[edge][0] || !ves_shell_on_edge(shell, e, edge)) return;
    ves_shell_line_at(body, edge, &l);
    int first = (edge < 2 ? e->v : e->u) * (l.count - 1);
    for (int q = 0; q < l.count; q++) {
        double w[3], density = 0;
        line_field(&l, q, of->work, w);
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < l.count; k++) {
                density += l.N[q][k] * load->line[edge][c][first + k] * w[c];
                if (of->load && of->load->line[edge][c])
                    of->load->line[edge][c][first + k] += l.weight[q] * l.length[q] * l.N[q][k] * w[c];
            }
        length_pull(&l, q, density, of->on_X);
    }
}

void ves_shell_springs_pull(const ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                            const shell_side *of)
{
    for (int i = 0; i < shell->model->springs; i++) {
        const ves_shell_spring *spring = &shell->model->spring[i];
        shell_line l;
        if (spring->sheet != e->sheet || !ves_shell_on_edge(shell, e, spring->edge)) continue;
        ves_shell_line_at(body, spring->edge, &l);
        for (int q = 0; q < l.count; q++) {
            double u[3], w[3], density = 0;
            line_field(&l, q, of->U, u);
            line_field(&l, q, of->dual, w);
            for (int c = 0; c < 3; c++) {
                density -= spring->stiffness[c] * u[c] * w[c];
                if (of->spring) of->spring[i][c] -= l.weight[q] * l.length[q] * u[c] * w[c];
            }
            length_pull(&l, q, density, of->on_X);
        }
    }
}

void ves_shell_loads_pull(const ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                          const shell_side *of)
{
    surface_pull(shell, e, body, of);
    for (int edge = 0; edge < VES_SHELL_EDGES; edge++) line_pull(shell, e, body, edge, of);
    ves_shell_springs_pull(shell, e, body, of);
}

void ves_shell_length_pull(ves_shell *shell, int sheet, int edge, double by, double *const X[3])
{
    for (int i = 0; i < shell->elements; i++) {
        const shell_element *e = &shell->element[i];
        shell_line l;
        if (e->sheet != sheet || !ves_shell_on_edge(shell, e, edge)) continue;
        ves_shell_body body = ves_shell_gather(shell, e);
        ves_shell_line_at(&body, edge, &l);
        for (int q = 0; q < l.count; q++)
            for (int k = 0; k < l.count; k++)
                for (int c = 0; c < 3 && X[c]; c++)
                    X[c][e->s[l.node[k]]] += by * l.weight[q] * l.slope[q][k] * l.t[q][c] / l.length[q];
    }
}

/* --- means along edges --- */

void ves_shell_means_begin(ves_shell *shell, int which, const ves_shell_seed *seed)
{
    for (int sheet = 0; sheet < shell->model->sheets; sheet++)
        for (int edge = 0; edge < VES_SHELL_EDGES; edge++) {
            shell_mean *m = &shell->adjoint->mean[sheet][edge];
            m->length = 0;
            if (!seed->mean) continue;
            memcpy(m->on, seed->mean[sheet][edge], sizeof m->on);
            if (m->on[0] == 0 && m->on[1] == 0 && m->on[2] == 0) continue;
            m->length = ves_shell_length(shell, shell->input, sheet, edge);
            ves_shell_edge_mean(shell, which, sheet, edge, m->mean);
        }
}

/* The edge of an element's side, or NULL where nothing is read there. */
static const shell_mean *mean_at(const ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                                 int edge, shell_line *l)
{
    const shell_mean *m = &shell->adjoint->mean[e->sheet][edge];
    if (m->length == 0 || !ves_shell_on_edge(shell, e, edge)) return NULL;
    ves_shell_line_at(body, edge, l);
    return m;
}

void ves_shell_means_read(const ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                          double (*on_U)[3])
{
    for (int edge = 0; edge < VES_SHELL_EDGES; edge++) {
        shell_line l;
        const shell_mean *m = mean_at(shell, e, body, edge, &l);
        for (int q = 0; m && q < l.count; q++)
            for (int k = 0; k < l.count; k++)
                for (int c = 0; c < 3; c++)
                    on_U[l.node[k]][c] += l.weight[q] * l.length[q] * l.N[q][k] * m->on[c] / m->length;
    }
}

/* mean = integral of u over the length: a longer piece counts more. */
void ves_shell_means_pull(const ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                          const double (*U)[3], double (*on_X)[3])
{
    for (int edge = 0; edge < VES_SHELL_EDGES; edge++) {
        shell_line l;
        const shell_mean *m = mean_at(shell, e, body, edge, &l);
        for (int q = 0; m && q < l.count; q++) {
            double u[3], more = 0;
            line_field(&l, q, U, u);
            for (int c = 0; c < 3; c++) more += m->on[c] * (u[c] - m->mean[c]) / m->length;
            length_pull(&l, q, more, on_X);
        }
    }
}

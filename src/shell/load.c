/* Consistent nodal forces. */
#include "shell/inside.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

/* The force on a point of the surface per dr ds: of areas as they are, of pressure along the normal. */
static void surface_density(const ves_shell *shell, const shell_element *e, const ves_shell_load *load, int q,
                            const ves_shell_frame *f, double out[3])
{
    const ves_shell_kind *kind = &shell->kind[e->sheet];
    const double *N = kind->rule.table.N + q * kind->nodes;
    double normal[3], pressure = 0;
    ves_cross(f->Xr, f->Xs, normal);
    double area = sqrt(ves_dot(normal, normal));
    for (int k = 0; load->pressure && k < kind->nodes; k++) pressure += N[k] * load->pressure[e->s[k]];
    for (int c = 0; c < 3; c++) {
        double force = 0;
        for (int k = 0; load->area[c] && k < kind->nodes; k++) force += N[k] * load->area[c][e->s[k]];
        out[c] = force * area + pressure * shell->input->side[e->sheet] * normal[c];
    }
}

/* Adds forces [nodes][3] of an element to a right side; the columns are those of the element. */
static void scatter(ves_shell *shell, int columns, const double (*force)[3], double *b)
{
    for (int i = 0; i < columns; i++) {
        const ves_shell_column *c = &shell->column[i];
        if (!c->turns) b[shell->freedom_of[i]] += ves_dot(c->vector, force[c->node]);
    }
}

static void surface_add(ves_shell *shell, const shell_element *e, const ves_shell_body *body, int which,
                        double (*force)[3])
{
    const ves_shell_load *load = &shell->input->load[which * shell->model->sheets + e->sheet];
    const ves_shell_points *rule = &body->kind->rule;
    if (!load->pressure && !load->area[0]) return;
    for (int q = 0; q < rule->points; q++) {
        ves_shell_frame frame;
        double density[3];
        ves_shell_frame_at(body, &rule->table, q, &frame);
        surface_density(shell, e, load, q, &frame, density);
        for (int k = 0; k < body->kind->nodes; k++)
            for (int c = 0; c < 3; c++)
                force[k][c] += rule->weight[q] * rule->table.N[q * body->kind->nodes + k] * density[c];
    }
}

/* The nodes of an element along one of its sides that lies on an edge of the sheet: k-th. */
static int side_node(const ves_shell_kind *kind, int edge, int k)
{
    int across = kind->order[0] + 1;
    if (edge < 2) return k * across + (edge ? kind->order[0] : 0);
    return (edge == 3 ? kind->order[1] * across : 0) + k;
}

bool ves_shell_on_edge(const ves_shell *shell, const shell_element *e, int edge)
{
    const ves_shell_sheet *s = &shell->model->sheet[e->sheet];
    if (edge > 1 && s->closed) return false;
    const int at[4] = {e->u, s->elements[0] - 1 - e->u, e->v, s->elements[1] - 1 - e->v};
    return at[edge] == 0;
}

void ves_shell_line_at(const ves_shell_body *body, int edge, shell_line *l)
{
    double node[VES_SHELL_LINE], at[VES_SHELL_LINE];
    l->count = body->kind->order[edge < 2] + 1;
    ves_rule_nodes(l->count - 1, node);
    ves_rule_gauss(l->count, at, l->weight);
    for (int k = 0; k < l->count; k++) l->node[k] = side_node(body->kind, edge, k);
    for (int q = 0; q < l->count; q++) {
        ves_rule_lagrange(l->count, node, at[q], l->N[q], l->slope[q]);
        for (int c = 0; c < 3; c++) {
            l->t[q][c] = 0;
            for (int k = 0; k < l->count; k++) l->t[q][c] += l->slope[q][k] * body->X[l->node[k]][c];
        }
        l->length[q] = sqrt(ves_dot(l->t[q], l->t[q]));
    }
}

double ves_shell_length(ves_shell *shell, const ves_shell_input *input, int sheet, int edge)
{
    double length = 0;
    shell_line l;
    shell->input = input;
    for (int k = 0; k < shell->elements; k++) {
        const shell_element *e = &shell->element[k];
        if (e->sheet != sheet || !ves_shell_on_edge(shell, e, edge)) continue;
        ves_shell_body body = ves_shell_gather(shell, e);
        ves_shell_line_at(&body, edge, &l);
        for (int q = 0; q < l.count; q++) length += l.weight[q] * l.length[q];
    }
    return length;
}

void ves_shell_edge_mean(ves_shell *shell, int which, int sheet, int edge, double U[3])
{
    double length = 0, director[3];
    shell_line l;
    memset(U, 0, 3 * sizeof *U);
    for (int k = 0; k < shell->elements; k++) {
        const shell_element *e = &shell->element[k];
        if (e->sheet != sheet || !ves_shell_on_edge(shell, e, edge)) continue;
        ves_shell_body body = ves_shell_gather(shell, e);
        ves_shell_line_at(&body, edge, &l);
        for (int i = 0; i < l.count; i++) {
            double share = 0, at[3];
            for (int q = 0; q < l.count; q++) share += l.weight[q] * l.length[q] * l.N[q][i];
            ves_shell_displacement(shell, which, sheet, e->s[l.node[i]], at, director);
            for (int c = 0; c < 3; c++) U[c] += share * at[c];
            length += share;
        }
    }
    for (int c = 0; c < 3; c++) U[c] /= length;
}

static void line_add(ves_shell *shell, const shell_element *e, const ves_shell_body *body, int which,
                     int edge, double (*force)[3])
{
    const ves_shell_load *load = &shell->input->load[which * shell->model->sheets + e->sheet];
    shell_line l;
    if (!load->line[edge][0] || !ves_shell_on_edge(shell, e, edge)) return;
    ves_shell_line_at(body, edge, &l);
    int first = (edge < 2 ? e->v : e->u) * (l.count - 1);
    for (int q = 0; q < l.count; q++)
        for (int c = 0; c < 3; c++) {
            double density = 0;
            for (int k = 0; k < l.count; k++) density += l.N[q][k] * load->line[edge][c][first + k];
            for (int k = 0; k < l.count; k++)
                force[l.node[k]][c] += l.weight[q] * l.length[q] * l.N[q][k] * density;
        }
}

void ves_shell_load_add(ves_shell *shell, const shell_element *e, const ves_shell_body *body, int which,
                        double (*force)[3])
{
    surface_add(shell, e, body, which, force);
    for (int edge = 0; edge < VES_SHELL_EDGES; edge++) line_add(shell, e, body, which, edge, force);
}

static void points_add(ves_shell *shell)
{
    const ves_shell_input *in = shell->input;
    for (int k = 0; k < in->points; k++) {
        const ves_shell_point *p = &in->point[k];
        const shell_freedom *f = &shell->layout[0].freedom[p->node];
        double *b = (double *)shell->force->x + (size_t)p->which * shell->force->d;
        for (int i = 0; i < 3; i++)
            if (f->moves[i] >= 0)
                b[f->first + f->moves[i]] += ves_dot(shell->model->node[p->node].frame[i], p->force);
    }
}

static bool is_loaded(const ves_shell *shell, const shell_element *e)
{
    for (int which = 0; which < shell->model->cases; which++) {
        const ves_shell_load *load = &shell->input->load[which * shell->model->sheets + e->sheet];
        if (load->pressure || load->area[0]) return true;
        for (int edge = 0; edge < VES_SHELL_EDGES; edge++)
            if (load->line[edge][0] && ves_shell_on_edge(shell, e, edge)) return true;
    }
    return false;
}

void ves_shell_loads(ves_shell *shell)
{
    memset(shell->force->x, 0, sizeof(double) * shell->force->nzmax);
    for (int i = 0; i < shell->elements; i++) {
        const shell_element *e = &shell->element[i];
        if (!is_loaded(shell, e)) continue;
        ves_shell_body body = ves_shell_gather(shell, e);
        int columns = ves_shell_columns_of(shell, &shell->layout[0], e);
        for (int which = 0; which < shell->model->cases; which++) {
            memset(shell->U, 0, sizeof *shell->U * (size_t)body.kind->nodes);
            ves_shell_load_add(shell, e, &body, which, shell->U);
            scatter(shell, columns, (const double(*)[3])shell->U,
                    (double *)shell->force->x + (size_t)which * shell->force->d);
        }
    }
    points_add(shell);
}

/* Springs along the edges of an element, into its stiffness. */
void ves_shell_springs(ves_shell *shell, const shell_element *e, const ves_shell_body *body, int columns)
{
    shell_line l;
    for (int k = 0; k < shell->model->springs; k++) {
        const ves_shell_spring *spring = &shell->model->spring[k];
        if (spring->sheet != e->sheet || !ves_shell_on_edge(shell, e, spring->edge)) continue;
        double share[VES_SHELL_LINE][VES_SHELL_LINE] = {{0}};
        ves_shell_line_at(body, spring->edge, &l);
        int place[VES_SHELL_NODES];
        for (int n = 0; n < body->kind->nodes; n++) place[n] = -1;
        for (int i = 0; i < l.count; i++) {
            place[l.node[i]] = i;
            for (int j = 0; j < l.count; j++)
                for (int q = 0; q < l.count; q++)
                    share[i][j] += l.weight[q] * l.length[q] * l.N[q][i] * l.N[q][j];
        }
        for (int j = 0; j < columns; j++)
            for (int i = j; i < columns; i++) {
                const ves_shell_column *a = &shell->column[i], *b = &shell->column[j];
                if (a->turns || b->turns || place[a->node] < 0 || place[b->node] < 0) continue;
                double stiffness = 0;
                for (int c = 0; c < 3; c++) stiffness += spring->stiffness[c] * a->vector[c] * b->vector[c];
                shell->K[j * columns + i] += stiffness * share[place[a->node]][place[b->node]];
            }
    }
}

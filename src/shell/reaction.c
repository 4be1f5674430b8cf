/* Forces of supports: what elements, springs and loads leave over at the nodes that are held. */
#include "shell/inside.h"

#include <string.h>

#include "base/vector.h"
#include "shell/lamina.h"

static bool touches(const ves_shell *shell, const shell_element *e, const bool *node)
{
    for (int k = 0; k < shell->kind[e->sheet].nodes; k++)
        if (node[shell->model->weld[e->sheet][e->s[k]]]) return true;
    return false;
}

/* Adds K u of an element on the displacements of its nodes: the field is in shell->U, shell->A. */
static void inner_add(ves_shell *shell, const ves_shell_body *body, double (*force)[3])
{
    const ves_shell_points *rule = &body->kind->rule;
    double turning[VES_SHELL_NODES][3] = {{0}}; /* on the directors: of no force */
    ves_shell_strains(body, rule, (const double(*)[3])shell->U, (const double(*)[3])shell->A, &shell->scratch,
                      shell->strain);
    for (int q = 0; q < rule->points; q++) {
        ves_shell_frame frame;
        double strain[VES_GENERAL], *at = shell->strain + q * VES_GENERAL;
        memcpy(strain, at, sizeof strain);
        ves_shell_frame_at(body, &rule->table, q, &frame);
        ves_lamina_forces(&frame, &shell->input->material, rule->weight[q], strain, at);
    }
    ves_shell_pull(body, rule, shell->strain, &shell->scratch, force, turning);
}

/* Of springs along the edges of an element: on its nodes; and on the shell what is of the supports asked for. */
static void springs_add(const ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                        const ves_shell_grip *grip, double (*force)[3], double F[3])
{
    shell_line l;
    for (int k = 0; k < shell->model->springs; k++) {
        const ves_shell_spring *spring = &shell->model->spring[k];
        if (spring->sheet != e->sheet || !ves_shell_on_edge(shell, e, spring->edge)) continue;
        ves_shell_line_at(body, spring->edge, &l);
        for (int q = 0; q < l.count; q++)
            for (int c = 0; c < 3; c++) {
                double moved = 0, share = l.weight[q] * l.length[q] * spring->stiffness[c];
                for (int i = 0; i < l.count; i++) moved += l.N[q][i] * shell->U[l.node[i]][c];
                for (int i = 0; i < l.count; i++) force[l.node[i]][c] += share * moved * l.N[q][i];
                if (grip->spring[k]) F[c] -= share * moved;
            }
    }
}

/* Adds to `left` what an element leaves over at the nodes of the supports. */
static void element_add(ves_shell *shell, const shell_element *e, int which, const ves_shell_grip *grip,
                        double left[3], double F[3])
{
    double force[VES_SHELL_NODES][3] = {{0}}, load[VES_SHELL_NODES][3] = {{0}};
    ves_shell_body body = ves_shell_gather(shell, e);
    ves_shell_field(shell, &shell->layout[0], e, ves_shell_state(shell, which));
    springs_add(shell, e, &body, grip, force, F);
    ves_shell_load_add(shell, e, &body, which, load);
    inner_add(shell, &body, force);
    for (int k = 0; k < body.kind->nodes; k++)
        for (int c = 0; c < 3 && grip->node[shell->model->weld[e->sheet][e->s[k]]]; c++)
            left[c] += force[k][c] - load[k][c];
}

/* Springs and loads of the nodes themselves. */
static void nodes_add(const ves_shell *shell, int which, const ves_shell_grip *grip, double left[3],
                      double F[3])
{
    for (int k = 0; k < shell->model->nodes; k++) {
        double U[3], director[3];
        if (!grip->node[k]) continue;
        ves_shell_displacement(shell, which, shell->lead_sheet[k], shell->lead[k], U, director);
        for (int c = 0; c < 3; c++) {
            double pull = shell->model->node[k].spring[c] * U[c];
            left[c] += pull;
            if (grip->sprung) F[c] -= pull;
        }
    }
    for (int k = 0; k < shell->input->points; k++) {
        const ves_shell_point *p = &shell->input->point[k];
        for (int c = 0; c < 3 && p->which == which && grip->node[p->node]; c++) left[c] -= p->force[c];
    }
}

/* Equilibrium of a node, K u = f + R: R is what holds it, along the directions in which it is held; along others
 * what is left over is rounding. That of the far side of a sector counts as it is there: only what turning does not
 * change is asked of a sector (ves_shell_view.share). */
void ves_shell_reaction(ves_shell *shell, int which, const ves_shell_grip *grip, double F[3])
{
    double left[3] = {0};
    memset(F, 0, 3 * sizeof *F);
    for (int k = 0; k < shell->elements; k++)
        if (touches(shell, &shell->element[k], grip->node))
            element_add(shell, &shell->element[k], which, grip, left, F);
    nodes_add(shell, which, grip, left, F);
    for (int c = 0; c < 3; c++) F[c] += ves_dot(grip->held[c], left);
}

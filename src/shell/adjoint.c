#include "shell/adjoint.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "shell/adjoint_inside.h"
#include "shell/lamina.h"
#include "shell/law.h"
#include "shell/side.h"

static ves_status vectors(ves_arena *arena, size_t count, double (**at)[3])
{
    *at = ves_arena_take(arena, count, sizeof **at);
    return *at ? VES_OK : VES_MEMORY;
}

ves_status ves_shell_adjoint_make(ves_shell *shell, ves_arena *arena)
{
    size_t nodes = 0, points = 0;
    shell_adjoint *a = ves_arena_take(arena, 1, sizeof *a);
    if (!a) return VES_MEMORY;
    shell->adjoint = a;
    for (int k = 0; k < shell->model->sheets; k++) {
        const ves_shell_kind *kind = &shell->kind[k];
        if ((size_t)kind->nodes > nodes) nodes = (size_t)kind->nodes;
        if ((size_t)kind->lattice.points > points) points = (size_t)kind->lattice.points;
        if ((size_t)kind->rule.points > points) points = (size_t)kind->rule.points;
    }
    a->right = ves_arena_doubles(arena, (size_t)shell->layout[0].freedoms);
    if (!a->right) return VES_MEMORY;
    for (int k = 0; k < (shell->model->buckling ? FIELDS : REAL); k++) {
        shell_field *f = &a->field[k];
        *f = (shell_field){.layout = &shell->layout[0], .co = 1, .other = f};
        VES_TRY(vectors(arena, (size_t)shell->model->nodes, &f->turn));
        VES_TRY(vectors(arena, nodes, &f->U));
        VES_TRY(vectors(arena, nodes, &f->A));
        VES_TRY(vectors(arena, nodes, &f->theta));
        VES_TRY(vectors(arena, nodes, &f->on_U));
        VES_TRY(vectors(arena, nodes, &f->on_A));
        f->strain = ves_arena_doubles(arena, points * VES_GENERAL);
        f->force = ves_arena_doubles(arena, points * VES_GENERAL);
        if (!f->strain || !f->force) return VES_MEMORY;
    }
    VES_TRY(vectors(arena, nodes, &a->on_X));
    VES_TRY(vectors(arena, nodes, &a->on_V));
    VES_TRY(vectors(arena, nodes, &a->work));
    VES_TRY(vectors(arena, nodes, &a->twice));
    VES_TRY(vectors(arena, nodes, &a->none));
    VES_TRY(vectors(arena, nodes, &a->on_twice));
    a->mean = ves_arena_take(arena, (size_t)shell->model->sheets, sizeof *a->mean);
    if (!a->mean) return VES_MEMORY;
    return shell->model->buckling ? ves_adjoint_mode_make(shell, arena) : VES_OK;
}

void ves_shell_adjoint_free(ves_shell *shell)
{
    shell_adjoint *a = shell->adjoint;
    if (!a) return;
    cholmod_free_dense(&a->solution, &shell->common);
    cholmod_free_dense(&a->Y, &shell->common);
    cholmod_free_dense(&a->E, &shell->common);
}

/* --- fields --- */

/* far: from the near side to the far one, or (back) the other way. */
static void turn(const ves_shell *shell, bool back, const double a[3], double out[3])
{
    for (int r = 0; r < 3; r++) {
        out[r] = 0;
        for (int c = 0; c < 3; c++)
            out[r] += (back ? shell->model->turn[c][r] : shell->model->turn[r][c]) * a[c];
    }
}

/* The rotation of a welded node, as its near side has it. */
static void rotation(const shell_layout *layout, int node, const double *vector, double theta[3])
{
    const shell_freedom *f = &layout->freedom[node];
    memset(theta, 0, 3 * sizeof *theta);
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 3 && f->turns[i] >= 0; c++)
            theta[c] += vector[f->first + f->turns[i]] * layout->pivot[node].axis[i][c];
}

/* And its displacement. */
static void movement(const ves_shell *shell, int node, const shell_field *f, double U[3])
{
    const shell_freedom *freedom = &f->layout->freedom[node];
    memset(U, 0, 3 * sizeof *U);
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 3 && freedom->moves[i] >= 0; c++)
            U[c] += f->vector[freedom->first + freedom->moves[i]] * shell->model->node[node].frame[i][c];
}

static void rotation_at(const ves_shell *shell, const shell_field *f, int sheet, int s, double theta[3])
{
    double near[3], other[3];
    int node = shell->model->weld[sheet][s];
    rotation(f->layout, node, f->vector, near);
    memcpy(theta, near, sizeof near);
    if (!ves_shell_is_far(shell, sheet, s)) return;
    rotation(f->layout, node, f->other->vector, other);
    for (int c = 0; c < 3; c++) near[c] = f->co * near[c] + f->mix * other[c];
    turn(shell, false, near, theta);
}

void ves_adjoint_rotation(const ves_shell *shell, int sheet, int s, const double on[3], const shell_field *f)
{
    int node = shell->model->weld[sheet][s];
    double near[3];
    if (!ves_shell_is_far(shell, sheet, s)) {
        for (int c = 0; c < 3; c++) f->turn[node][c] += on[c];
        return;
    }
    turn(shell, true, on, near);
    for (int c = 0; c < 3; c++)
        f->turn[node][c] += f->co * near[c], f->other->turn[node][c] += f->mix * near[c];
}

void ves_adjoint_field(ves_shell *shell, const shell_element *e, shell_field *f)
{
    size_t nodes = (size_t)shell->kind[e->sheet].nodes;
    ves_shell_field(shell, f->layout, e, f->vector);
    memcpy(f->U, shell->U, nodes * sizeof *f->U);
    memcpy(f->A, shell->A, nodes * sizeof *f->A);
    memset(f->on_U, 0, nodes * sizeof *f->on_U);
    memset(f->on_A, 0, nodes * sizeof *f->on_A);
    for (size_t k = 0; k < nodes; k++) rotation_at(shell, f, e->sheet, e->s[k], f->theta[k]);
    if (f->mix == 0 && f->co == 1) return;
    ves_shell_field(shell, f->layout, e, f->other->vector);
    for (size_t k = 0; k < nodes; k++)
        for (int c = 0; c < 3 && ves_shell_is_far(shell, e->sheet, e->s[k]); c++) {
            f->U[k][c] = f->co * f->U[k][c] + f->mix * shell->U[k][c];
            f->A[k][c] = f->co * f->A[k][c] + f->mix * shell->A[k][c];
        }
}

static void strains_take(const ves_shell *shell, const ves_shell_body *body, const ves_shell_points *at,
                         shell_field *f)
{
    ves_shell_strains(body, at, (const double(*)[3])f->U, (const double(*)[3])f->A, &shell->scratch,
                      f->strain);
}

void ves_adjoint_force(const ves_shell *shell, const ves_shell_body *body, const ves_shell_points *at,
                       const double *force, shell_field *f)
{
    shell_adjoint *a = shell->adjoint;
    const ves_shell_body moved = {body->kind, (const double(*)[3])f->U, (const double(*)[3])f->A};
    ves_shell_pull(body, at, force, &shell->scratch, f->on_U, f->on_A);
    ves_shell_pull(&moved, at, force, &shell->scratch, a->on_X, a->on_V);
}

void ves_adjoint_frame(const ves_shell_table *t, int nodes, int q, const ves_shell_frame *on,
                       shell_adjoint *a)
{
    for (int k = 0; k < nodes; k++) {
        double N = t->N[q * nodes + k], Nr = t->Nr[q * nodes + k], Ns = t->Ns[q * nodes + k];
        for (int c = 0; c < 3; c++) {
            a->on_X[k][c] += Nr * on->Xr[c] + Ns * on->Xs[c];
            a->on_V[k][c] += N * on->V[c] + Nr * on->Vr[c] + Ns * on->Vs[c];
        }
    }
}

/* --- what J reads --- */

/* Does J read a stress at one of so many points? */
static bool is_read(const ves_shell_seed *seed, int at, int points)
{
    const double *of = seed->stress ? seed->stress[at][0] : NULL;
    for (int k = 0; of && k < points * VES_SHELL_LEVELS * VES_STRESSES; k++)
        if (of[k] != 0) return true;
    return false;
}

/* Forces on the strains at the lattice from the seeds of stresses; adjoints of frames and material, when `to` is given.
 * at: the element's first point. */
static void stresses_pull(const ves_shell *shell, const ves_shell_body *body, const ves_shell_seed *seed,
                          int at, ves_law *to)
{
    shell_adjoint *a = shell->adjoint;
    shell_field *f = &a->field[STATE];
    const ves_shell_points *lattice = &body->kind->lattice;
    memset(f->force, 0, sizeof *f->force * (size_t)(lattice->points * VES_GENERAL));
    for (int q = 0; q < lattice->points; q++) {
        ves_shell_frame frame;
        ves_law law = {.E = 0};
        if (!is_read(seed, at + q, 1)) continue;
        ves_shell_frame_at(body, &lattice->table, q, &frame);
        for (int level = 0; level < VES_SHELL_LEVELS; level++) {
            double w[VES_STRESSES];
            memcpy(w, seed->stress[at + q][level], sizeof w);
            w[3] *= ves_shell_across[level], w[4] *= ves_shell_across[level];
            const ves_law_seed of = {level - 1, w};
            ves_law_stress(&frame, &shell->input->material, &of, f->strain + q * VES_GENERAL,
                           f->force + q * VES_GENERAL, &law);
        }
        if (!to) continue;
        ves_adjoint_frame(&lattice->table, body->kind->nodes, q, &law.frame, a);
        ves_law_add(&law, to);
    }
}

/* Of places, thickness and areas at the lattice, which are of the shape alone. */
static void places_pull(const ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                        const ves_shell_seed *seed, int at, const ves_shell_gradient *g)
{
    shell_adjoint *a = shell->adjoint;
    const ves_shell_points *lattice = &body->kind->lattice;
    const int nodes = body->kind->nodes;
    double *thickness = seed->thickness && g->thickness ? g->thickness[e->sheet] : NULL;
    for (int q = 0; q < lattice->points; q++) {
        const double *N = lattice->table.N + q * nodes;
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < nodes && seed->X[c] && seed->X[c][at + q] != 0; k++)
                a->on_X[k][c] += N[k] * seed->X[c][at + q];
        for (int k = 0; k < nodes && thickness && seed->thickness[at + q] != 0; k++)
            thickness[e->s[k]] += N[k] * seed->thickness[at + q];
        if (!seed->area || seed->area[at + q] == 0) continue;
        ves_shell_frame f, on = {.V = {0}};
        double n[3];
        ves_shell_frame_at(body, &lattice->table, q, &f);
        ves_cross(f.Xr, f.Xs, n);
        double area = sqrt(ves_dot(n, n));
        if (!(area > 0)) continue;
        for (int c = 0; c < 3; c++) n[c] *= seed->area[at + q] * lattice->weight[q] / area;
        ves_cross(f.Xs, n, on.Xr);
        ves_cross(n, f.Xr, on.Xs);
        ves_adjoint_frame(&lattice->table, nodes, q, &on, a);
    }
}

/* dJ/du of what is read at nodes. */
static void nodes_read(const ves_shell *shell, const ves_shell_seed *seed, double *right)
{
    const ves_shell_model *m = shell->model;
    const shell_layout *layout = &shell->layout[0];
    for (int sheet = 0; sheet < m->sheets; sheet++)
        for (int s = 0; s < ves_shell_rows(&m->sheet[sheet]) * ves_shell_columns(&m->sheet[sheet]); s++) {
            const shell_freedom *f = &layout->freedom[m->weld[sheet][s]];
            double on[2][3] = {{0}}, near[2][3], n[3], d[3] = {0};
            for (int c = 0; c < 3; c++) {
                if (seed->U && seed->U[sheet][c]) on[0][c] = seed->U[sheet][c][s];
                if (seed->director && seed->director[sheet][c]) d[c] = seed->director[sheet][c][s];
                n[c] = shell->input->normal[sheet][c][s];
            }
            ves_cross(n, d, on[1]);
            for (int k = 0; k < 2; k++)
                if (ves_shell_is_far(shell, sheet, s))
                    turn(shell, true, on[k], near[k]);
                else
                    memcpy(near[k], on[k], sizeof near[k]);
            for (int i = 0; i < 3; i++) {
                if (f->moves[i] >= 0)
                    right[f->first + f->moves[i]] += ves_dot(m->node[m->weld[sheet][s]].frame[i], near[0]);
                if (f->turns[i] >= 0)
                    right[f->first + f->turns[i]] +=
                        ves_dot(layout->pivot[m->weld[sheet][s]].axis[i], near[1]);
            }
        }
}

static void right_fill(ves_shell *shell, int which, const ves_shell_seed *seed)
{
    shell_adjoint *a = shell->adjoint;
    shell_field *f = &a->field[STATE];
    const double *force = (const double *)shell->force->x + (size_t)which * shell->force->d;
    for (int k = 0; k < shell->layout[0].freedoms; k++) a->right[k] = seed->work * force[k];
    nodes_read(shell, seed, a->right);
    for (int i = 0, at = 0; i < shell->elements && (seed->stress || seed->mean || a->fields > REAL); i++) {
        const shell_element *e = &shell->element[i];
        const int points = shell->kind[e->sheet].lattice.points;
        bool stressed = is_read(seed, at, points);
        at += points;
        if (!stressed && !seed->mean && a->fields == REAL) continue;
        ves_shell_body body = ves_shell_gather(shell, e);
        ves_adjoint_field(shell, e, f);
        if (seed->mean) ves_shell_means_read(shell, e, &body, f->on_U);
        if (stressed) {
            strains_take(shell, &body, &body.kind->lattice, f);
            stresses_pull(shell, &body, seed, at - points, NULL);
            ves_shell_pull(&body, &body.kind->lattice, f->force, &shell->scratch, f->on_U, f->on_A);
        }
        if (a->fields > REAL) ves_adjoint_mode_right(shell, e, &body);
        int columns = ves_shell_columns_of(shell, &shell->layout[0], e);
        for (int k = 0; k < columns; k++) {
            const ves_shell_column *c = &shell->column[k];
            a->right[shell->freedom_of[k]] +=
                ves_dot(c->vector, c->turns ? f->on_A[c->node] : f->on_U[c->node]);
        }
    }
}

static ves_status solve(ves_shell *shell)
{
    shell_adjoint *a = shell->adjoint;
    size_t n = (size_t)shell->layout[0].freedoms;
    cholmod_dense right = {.nrow = n, .ncol = 1, .nzmax = n, .d = n, .x = a->right, .xtype = CHOLMOD_REAL};
    right.dtype = shell->layout[0].matrix->dtype;
    return cholmod_solve2(CHOLMOD_A, shell->layout[0].factor, &right, NULL, &a->solution, NULL, &a->Y, &a->E,
                          &shell->common)
               ? VES_OK
               : VES_MEMORY;
}

/* --- the gradient --- */

/* Of - lambda' K u, at fixed rotations. */
static void stiffness_pull(const ves_shell *shell, const ves_shell_body *body, ves_law *to)
{
    shell_adjoint *a = shell->adjoint;
    const ves_shell_points *rule = &body->kind->rule;
    shell_field *u = &a->field[STATE], *dual = &a->field[DUAL];
    strains_take(shell, body, rule, u);
    strains_take(shell, body, rule, dual);
    for (int q = 0; q < rule->points; q++) {
        const int at = q * VES_GENERAL;
        ves_shell_frame frame;
        ves_law law = {.E = 0};
        ves_shell_frame_at(body, &rule->table, q, &frame);
        ves_lamina_forces(&frame, &shell->input->material, -rule->weight[q], u->strain + at,
                          dual->force + at);
        ves_lamina_forces(&frame, &shell->input->material, -rule->weight[q], dual->strain + at,
                          u->force + at);
        ves_law_energy(&frame, &shell->input->material, -rule->weight[q], u->strain + at, dual->strain + at,
                       &law);
        ves_adjoint_frame(&rule->table, body->kind->nodes, q, &law.frame, a);
        ves_law_add(&law, to);
    }
    ves_adjoint_force(shell, body, rule, u->force, u);
    ves_adjoint_force(shell, body, rule, dual->force, dual);
}

static void plane_add(double *const (*planes)[3], int sheet, int s, const double on[3])
{
    for (int c = 0; c < 3 && planes; c++)
        if (planes[sheet][c]) planes[sheet][c][s] += on[c];
}

/* From adjoints at the nodes of an element to the planes: A = theta x V, V = side t n / 2. */
static void nodes_give(const ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                       const ves_shell_gradient *g)
{
    shell_adjoint *a = shell->adjoint;
    for (int k = 0; k < body->kind->nodes; k++) {
        int s = e->s[k];
        double half = shell->input->side[e->sheet] / 2, on_n[3], on_theta[3], more[3], along = 0;
        for (int i = 0; i < a->fields; i++) {
            ves_cross(body->V[k], a->field[i].on_A[k], on_theta);
            ves_adjoint_rotation(shell, e->sheet, s, on_theta, &a->field[i]);
            ves_cross(a->field[i].on_A[k], a->field[i].theta[k], more);
            for (int c = 0; c < 3; c++) a->on_V[k][c] += more[c];
        }
        for (int c = 0; c < 3; c++) {
            on_n[c] = half * shell->input->thickness[e->sheet][s] * a->on_V[k][c];
            along += half * a->on_V[k][c] * shell->input->normal[e->sheet][c][s];
        }
        plane_add(g->X, e->sheet, s, a->on_X[k]);
        plane_add(g->normal, e->sheet, s, on_n);
        if (g->thickness && g->thickness[e->sheet]) g->thickness[e->sheet][s] += along;
    }
}

static void element_give(ves_shell *shell, const shell_element *e, int which, const ves_shell_seed *seed,
                         int at, ves_shell_gradient *g)
{
    shell_adjoint *a = shell->adjoint;
    ves_shell_body body = ves_shell_gather(shell, e);
    const size_t nodes = (size_t)body.kind->nodes;
    ves_law law = {.E = 0};
    memset(a->on_X, 0, nodes * sizeof *a->on_X);
    memset(a->on_V, 0, nodes * sizeof *a->on_V);
    for (int k = 0; k < a->fields; k++) ves_adjoint_field(shell, e, &a->field[k]);
    stiffness_pull(shell, &body, &law);
    if (is_read(seed, at, body.kind->lattice.points)) {
        strains_take(shell, &body, &body.kind->lattice, &a->field[STATE]);
        stresses_pull(shell, &body, seed, at, &law);
        ves_adjoint_force(shell, &body, &body.kind->lattice, a->field[STATE].force, &a->field[STATE]);
    }
    places_pull(shell, e, &body, seed, at, g);
    for (size_t k = 0; k < nodes; k++)
        for (int c = 0; c < 3; c++)
            a->work[k][c] = a->field[DUAL].U[k][c] + seed->work * a->field[STATE].U[k][c];
    const shell_side side = {.which = which,
                             .U = (const double(*)[3])a->field[STATE].U,
                             .dual = (const double(*)[3])a->field[DUAL].U,
                             .work = (const double(*)[3])a->work,
                             .on_X = a->on_X,
                             .spring = a->spring,
                             .load = g->load ? &g->load[e->sheet] : NULL};
    ves_shell_loads_pull(shell, e, &body, &side);
    ves_shell_means_pull(shell, e, &body, side.U, a->on_X);
    if (a->fields > REAL) ves_adjoint_mode_give(shell, which, e, &body, &law, side.load);
    nodes_give(shell, e, &body, g);
    g->E += law.E, g->nu += law.nu, g->shear += law.shear;
}

/* Director increments theta x n that J reads. */
static void directors_give(const ves_shell *shell, const ves_shell_seed *seed, const ves_shell_gradient *g)
{
    const ves_shell_model *m = shell->model;
    for (int sheet = 0; sheet < m->sheets && seed->director; sheet++)
        for (int s = 0; s < ves_shell_rows(&m->sheet[sheet]) * ves_shell_columns(&m->sheet[sheet]); s++) {
            double theta[3], n[3], d[3], on[3];
            for (int c = 0; c < 3; c++) {
                n[c] = shell->input->normal[sheet][c][s];
                d[c] = seed->director[sheet][c] ? seed->director[sheet][c][s] : 0;
            }
            rotation_at(shell, &shell->adjoint->field[STATE], sheet, s, theta);
            ves_cross(d, theta, on);
            plane_add(g->normal, sheet, s, on);
            ves_cross(n, d, on);
            ves_adjoint_rotation(shell, sheet, s, on, &shell->adjoint->field[STATE]);
        }
}

/* Rotations of a smooth node go along with the normal, d theta = (n x dn) x theta; where it is held about a direction of
 * its tangent plane, the axis that is left turns by the drift besides. */
static void rotation_give(const ves_shell *shell, int node, const shell_field *f, double on[3])
{
    const shell_freedom *freedom = &f->layout->freedom[node];
    int sheet = shell->lead_sheet[node], s = shell->lead[node];
    double n[3], theta[3], spin[3], part[3], drift[3];
    if (freedom->turns[1] < 0) return;
    for (int c = 0; c < 3; c++) n[c] = shell->input->normal[sheet][c][s];
    rotation(f->layout, node, f->vector, theta);
    ves_cross(theta, f->turn[node], spin);
    ves_cross(spin, n, part);
    for (int c = 0; c < 3; c++) on[c] += part[c];
    if (freedom->turns[0] >= 0) return;
    ves_shell_drift(shell, f->layout, node, drift);
    double slip = f->vector[freedom->first + freedom->turns[1]] *
                  ves_dot(f->layout->pivot[node].axis[0], f->turn[node]);
    for (int c = 0; c < 3; c++) on[c] -= slip * drift[c];
}

static void rotations_give(const ves_shell *shell, const ves_shell_gradient *g)
{
    const shell_adjoint *a = shell->adjoint;
    for (int node = 0; node < shell->model->nodes; node++) {
        double on[3] = {0};
        if (shell->model->node[node].fold) continue;
        for (int k = 0; k < a->fields; k++) rotation_give(shell, node, &a->field[k], on);
        plane_add(g->normal, shell->lead_sheet[node], shell->lead[node], on);
    }
}

/* What stiffens folds, as E t^3. */
static void drilling_give(const ves_shell *shell, ves_shell_gradient *g)
{
    const shell_adjoint *a = shell->adjoint;
    for (int node = 0; node < shell->model->nodes; node++) {
        int sheet = shell->lead_sheet[node], s = shell->lead[node];
        double u[3], dual[3], stiffness = ves_shell_drilling(shell, node);
        if (!(stiffness > 0)) continue;
        rotation(a->field[STATE].layout, node, a->field[STATE].vector, u);
        rotation(a->field[DUAL].layout, node, a->field[DUAL].vector, dual);
        double energy = -ves_dot(u, dual) * stiffness;
        for (int k = REAL; k < a->fields; k++) {
            rotation(a->field[k].layout, node, a->field[k].vector, u);
            energy += a->weight * a->factor * stiffness * ves_dot(u, u);
        }
        g->E += energy / shell->input->material.E;
        if (g->thickness && g->thickness[sheet])
            g->thickness[sheet][s] += 3 * energy / shell->input->thickness[sheet][s];
    }
}

/* Springs at nodes: of - lambda' K u, and of the mode. */
static void springs_give(const ves_shell *shell, const ves_shell_gradient *g)
{
    const shell_adjoint *a = shell->adjoint;
    for (int node = 0; node < shell->model->nodes && g->node_spring; node++) {
        double u[3], dual[3], *on = g->node_spring[node];
        movement(shell, node, &a->field[STATE], u);
        movement(shell, node, &a->field[DUAL], dual);
        for (int c = 0; c < 3; c++) on[c] -= u[c] * dual[c];
        for (int k = REAL; k < a->fields; k++) {
            movement(shell, node, &a->field[k], u);
            for (int c = 0; c < 3; c++) on[c] += a->weight * a->factor * u[c] * u[c];
        }
    }
}

/* Forces at nodes. */
static void points_give(const ves_shell *shell, int which, const ves_shell_seed *seed,
                        const ves_shell_gradient *g)
{
    const double *u = ves_shell_state(shell, which), *dual = shell->adjoint->solution->x;
    for (int k = 0; k < shell->input->points && g->force; k++) {
        const ves_shell_point *p = &shell->input->point[k];
        const shell_freedom *f = &shell->layout[0].freedom[p->node];
        if (p->which != which) continue;
        for (int i = 0; i < 3; i++)
            for (int c = 0; c < 3 && f->moves[i] >= 0; c++) {
                int at = f->first + f->moves[i];
                g->force[k][c] += (dual[at] + seed->work * u[at]) * shell->model->node[p->node].frame[i][c];
            }
    }
}

ves_status ves_shell_adjoint(ves_shell *shell, int which, const ves_shell_seed *seed, ves_shell_gradient *g)
{
    shell_adjoint *a = shell->adjoint;
    for (int k = 0; k < shell->model->sheets; k++)
        if (shell->kind[k].plus) return VES_ABSENT;
    a->fields = REAL;
    a->spring = g->spring;
    if (seed->factor != 0) VES_TRY(ves_adjoint_mode_begin(shell, which, seed->factor));
    ves_shell_means_begin(shell, which, seed);
    a->field[STATE].vector = ves_shell_state(shell, which);
    right_fill(shell, which, seed);
    VES_TRY(solve(shell));
    a->field[DUAL].vector = a->solution->x;
    for (int k = 0; k < a->fields; k++)
        memset(a->field[k].turn, 0, sizeof *a->field[k].turn * (size_t)shell->model->nodes);
    for (int i = 0, at = 0; i < shell->elements; i++) {
        const shell_element *e = &shell->element[i];
        element_give(shell, e, which, seed, at, g);
        at += shell->kind[e->sheet].lattice.points;
    }
    directors_give(shell, seed, g);
    rotations_give(shell, g);
    drilling_give(shell, g);
    springs_give(shell, g);
    points_give(shell, which, seed, g);
    return VES_OK;
}

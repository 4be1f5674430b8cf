/* The gradient of a factor of buckling that stands alone. With phi' K phi = 1 and (K + factor K_sigma) phi = 0
 *     d factor = factor phi' (dK + factor dK_sigma) phi,
 * and K_sigma goes with the stresses of u too: phi' K_sigma phi = 2 sum of e(u)' G zeta over the points (and pressure that
 * follows), with the strains of second order zeta = e(phi; phi) / 2, not tied, plus those of A2 = theta x (theta x V) / 2,
 * tied (shell/geometric.h). So the same bilinear form of e(u) and zeta is varied as for the stiffness. */
#include "shell/adjoint_inside.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "shell/lamina.h"
#include "shell/side.h"

ves_status ves_adjoint_mode_make(ves_shell *shell, ves_arena *arena)
{
    shell_adjoint *a = shell->adjoint;
    size_t most = 0, points = 0;
    a->free = ves_arena_take(arena, (size_t)shell->model->sheets, sizeof *a->free);
    if (!a->free) return VES_MEMORY;
    for (int k = 0; k < shell->model->sheets; k++) {
        a->free[k] = shell->kind[k];
        a->free[k].plus = false;
        memset(a->free[k].tied, 0, sizeof a->free[k].tied);
        memset(a->free[k].rule.mix, 0, sizeof a->free[k].rule.mix);
        if ((size_t)a->free[k].rule.points > points) points = (size_t)a->free[k].rule.points;
    }
    for (int k = 0; k < shell->layouts; k++)
        if ((size_t)shell->layout[k].freedoms > most) most = (size_t)shell->layout[k].freedoms;
    for (int k = 0; k < 2; k++) a->part[k] = ves_arena_doubles(arena, most);
    a->second = ves_arena_doubles(arena, points * VES_GENERAL);
    return a->part[0] && a->part[1] && a->second ? VES_OK : VES_MEMORY;
}

ves_status ves_adjoint_mode_begin(ves_shell *shell, int which, double weight)
{
    shell_adjoint *a = shell->adjoint;
    shell_mode mode;
    VES_TRY(ves_shell_mode_take(shell, which, &mode));
    a->fields = REAL + mode.parts, a->factor = mode.factor, a->weight = weight;
    for (int part = 0; part < mode.parts; part++) {
        shell_field *f = &a->field[REAL + part];
        f->layout = &shell->layout[mode.layout];
        for (int k = 0; k < f->layout->freedoms; k++)
            a->part[part][k] = mode.scale * mode.vector[mode.parts * k + part];
        f->vector = a->part[part];
        f->other = mode.parts > 1 ? &a->field[REAL + !part] : f;
        f->co = mode.parts > 1 ? cos(mode.phase) : 1;
        f->mix = mode.parts > 1 ? (part ? 1 : -1) * sin(mode.phase) : 0;
    }
    return VES_OK;
}

static ves_shell_body as_body(const ves_shell_kind *kind, double (*X)[3], double (*V)[3])
{
    return (ves_shell_body){kind, (const double(*)[3])X, (const double(*)[3])V};
}

/* A2 of a part of the mode at the nodes. */
static void twice_take(const ves_shell_body *body, const shell_field *f, double (*twice)[3])
{
    for (int k = 0; k < body->kind->nodes; k++) {
        const double *t = f->theta[k], *V = body->V[k];
        double along = ves_dot(t, V), square = ves_dot(t, t);
        for (int c = 0; c < 3; c++) twice[k][c] = (t[c] * along - V[c] * square) / 2;
    }
}

/* zeta of all parts. The fields must be those of the element. */
static void second_take(const ves_shell *shell, const shell_element *e, const ves_shell_body *body)
{
    shell_adjoint *a = shell->adjoint;
    const ves_shell_points *rule = &body->kind->rule;
    const ves_shell_kind *free = &a->free[e->sheet];
    const int count = rule->points * VES_GENERAL;
    memset(a->second, 0, sizeof *a->second * (size_t)count);
    memset(a->none, 0, sizeof *a->none * (size_t)body->kind->nodes);
    for (int part = REAL; part < a->fields; part++) {
        shell_field *f = &a->field[part];
        const ves_shell_body itself = as_body(free, f->U, f->A);
        ves_shell_strains(&itself, &free->rule, itself.X, itself.V, &shell->scratch, f->strain);
        for (int k = 0; k < count; k++) a->second[k] += f->strain[k] / 2;
        twice_take(body, f, a->twice);
        ves_shell_strains(body, rule, (const double(*)[3])a->none, (const double(*)[3])a->twice,
                          &shell->scratch, f->strain);
        for (int k = 0; k < count; k++) a->second[k] += f->strain[k];
    }
}

/* factor * weight of the rule * G strain, at all points. */
static void forces_take(const ves_shell *shell, const ves_shell_body *body, double factor,
                        const double *strain, double *force)
{
    const ves_shell_points *rule = &body->kind->rule;
    for (int q = 0; q < rule->points; q++) {
        ves_shell_frame frame;
        ves_shell_frame_at(body, &rule->table, q, &frame);
        ves_lamina_forces(&frame, &shell->input->material, factor * rule->weight[q], strain + q * VES_GENERAL,
                          force + q * VES_GENERAL);
    }
}

void ves_adjoint_mode_right(ves_shell *shell, const shell_element *e, const ves_shell_body *body)
{
    shell_adjoint *a = shell->adjoint;
    shell_field *u = &a->field[STATE];
    for (int part = REAL; part < a->fields; part++) ves_adjoint_field(shell, e, &a->field[part]);
    second_take(shell, e, body);
    forces_take(shell, body, 2 * a->weight * a->factor * a->factor, a->second, u->force);
    ves_shell_pull(body, &body->kind->rule, u->force, &shell->scratch, u->on_U, u->on_A);
}

/* Adds adjoints of a law between two strains at all points. */
static void law_add(const ves_shell *shell, const ves_shell_body *body, double factor,
                    const double *strain[2], ves_law *to)
{
    const ves_shell_points *rule = &body->kind->rule;
    for (int q = 0; q < rule->points; q++) {
        ves_shell_frame frame;
        ves_law law = {.E = 0};
        ves_shell_frame_at(body, &rule->table, q, &frame);
        ves_law_energy(&frame, &shell->input->material, factor * rule->weight[q], strain[0] + q * VES_GENERAL,
                       strain[1] + q * VES_GENERAL, &law);
        ves_adjoint_frame(&rule->table, body->kind->nodes, q, &law.frame, shell->adjoint);
        ves_law_add(&law, to);
    }
}

/* Adjoints of A2 to those of V, and of the rotation by way of on_A: theta enters as theta x V alone but for what lies along
 * V, so they are handed out on both. */
static void twice_pull(const ves_shell_body *body, const shell_field *f, shell_adjoint *a,
                       double (*on_theta)[3])
{
    for (int k = 0; k < body->kind->nodes; k++) {
        const double *t = f->theta[k], *V = body->V[k], *h = a->on_twice[k];
        double tV = ves_dot(t, V), th = ves_dot(t, h), Vh = ves_dot(V, h), tt = ves_dot(t, t);
        for (int c = 0; c < 3; c++) {
            a->on_V[k][c] += (t[c] * th - h[c] * tt) / 2;
            on_theta[k][c] = (h[c] * tV + V[c] * th) / 2 - t[c] * Vh;
        }
    }
}

/* Of one part: what forces on zeta, and the stiffness, do. */
static void part_give(ves_shell *shell, const shell_element *e, const ves_shell_body *body,
                      const double *force, shell_field *f, ves_law *law)
{
    shell_adjoint *a = shell->adjoint;
    const ves_shell_points *rule = &body->kind->rule;
    const ves_shell_kind *free = &a->free[e->sheet];
    const size_t size = sizeof *a->on_twice * (size_t)body->kind->nodes;
    const ves_shell_body itself = as_body(free, f->U, f->A), twice = as_body(body->kind, a->none, a->twice);
    ves_shell_pull(&itself, &free->rule, force, &shell->scratch, f->on_U, f->on_A);
    twice_take(body, f, a->twice);
    memset(a->on_twice, 0, size);
    ves_shell_pull(body, rule, force, &shell->scratch, a->work, a->on_twice); /* work: not looked at */
    ves_shell_pull(&twice, rule, force, &shell->scratch, a->on_X, a->on_V);
    twice_pull(body, f, a, a->work);
    for (int k = 0; k < body->kind->nodes; k++) ves_adjoint_rotation(shell, e->sheet, e->s[k], a->work[k], f);
    ves_shell_strains(body, rule, itself.X, itself.V, &shell->scratch, f->strain);
    forces_take(shell, body, 2 * a->weight * a->factor, f->strain, f->force);
    ves_adjoint_force(shell, body, rule, f->force, f);
    const double *strain[2] = {f->strain, f->strain};
    law_add(shell, body, a->weight * a->factor, strain, law);
}

void ves_adjoint_mode_give(ves_shell *shell, int which, const shell_element *e, const ves_shell_body *body,
                           ves_law *law, const ves_shell_load_gradient *load)
{
    shell_adjoint *a = shell->adjoint;
    shell_field *u = &a->field[STATE];
    const ves_shell_points *rule = &body->kind->rule;
    const double twice = 2 * a->weight * a->factor * a->factor, *strain[2] = {u->strain, a->second};
    second_take(shell, e, body);
    ves_shell_strains(body, rule, (const double(*)[3])u->U, (const double(*)[3])u->A, &shell->scratch,
                      u->strain);
    law_add(shell, body, twice, strain, law);
    forces_take(shell, body, twice, a->second, u->force);
    ves_adjoint_force(shell, body, rule, u->force, u);
    forces_take(shell, body, twice, u->strain, u->force);
    for (int part = REAL; part < a->fields; part++) {
        shell_field *f = &a->field[part];
        part_give(shell, e, body, u->force, f, law);
        for (int k = 0; k < body->kind->nodes; k++)
            for (int c = 0; c < 3; c++) a->work[k][c] = -a->weight * a->factor * f->U[k][c];
        const shell_side side = {.which = which,
                                 .U = (const double(*)[3])f->U,
                                 .dual = (const double(*)[3])a->work,
                                 .on_X = a->on_X,
                                 .spring = a->spring,
                                 .load = load};
        ves_shell_springs_pull(shell, e, body, &side);
        ves_shell_follow_pull(shell, e, body, &side, -a->weight * a->factor * a->factor);
    }
}

/* A shell from its model to displacements. */
#include "shell/inside.h"

#include <math.h>
#include <omp.h>
#include <string.h>

#include "base/vector.h"

static ves_status kinds_make(ves_shell *shell, ves_arena *arena)
{
    const ves_shell_model *m = shell->model;
    shell->kind = ves_arena_take(arena, (size_t)m->sheets, sizeof *shell->kind);
    if (!shell->kind) return VES_MEMORY;
    for (int k = 0; k < m->sheets; k++)
        VES_TRY(ves_shell_kind_make(m->sheet[k].order, m->sheet[k].ring, arena, &shell->kind[k]));
    return VES_OK;
}

/* What is needed at one element at a time, sized for the largest. */
static ves_status scratch_make(ves_shell *shell, ves_arena *arena)
{
    int nodes = 0;
    size_t columns = (size_t)shell->widest, points = 0;
    for (int k = 0; k < shell->model->sheets; k++) {
        const ves_shell_kind *kind = &shell->kind[k];
        if (kind->nodes > nodes) nodes = kind->nodes;
        if ((size_t)kind->lattice.points > points) points = (size_t)kind->lattice.points;
    }
    VES_TRY(ves_shell_scratch_make(shell->kind, shell->model->sheets, shell->widest, arena, &shell->scratch));
    shell->X = ves_arena_take(arena, (size_t)nodes, sizeof *shell->X);
    shell->V = ves_arena_take(arena, (size_t)nodes, sizeof *shell->V);
    shell->U = ves_arena_take(arena, (size_t)nodes, sizeof *shell->U);
    shell->A = ves_arena_take(arena, (size_t)nodes, sizeof *shell->A);
    shell->column = ves_arena_take(arena, columns, sizeof *shell->column);
    shell->freedom_of = ves_arena_take(arena, columns, sizeof *shell->freedom_of);
    shell->K = ves_arena_doubles(arena, columns * columns);
    shell->strain = ves_arena_doubles(arena, points * VES_GENERAL);
    return shell->X && shell->V && shell->U && shell->A && shell->column && shell->freedom_of && shell->K &&
                   shell->strain
               ? VES_OK
               : VES_MEMORY;
}

/* Of matrices that are numbered as they are to be eliminated. */
static ves_status factor_make(ves_shell *shell)
{
    cholmod_common *c = &shell->common;
    size_t n = (size_t)shell->layout[0].freedoms, cases = (size_t)shell->model->cases;
    c->method[0].ordering = CHOLMOD_NATURAL;
    c->postorder = false;
    for (int k = 0; k < shell->layouts; k++) {
        shell_layout *layout = &shell->layout[k];
        layout->factor = cholmod_analyze(layout->matrix, c);
        if (!layout->factor) return VES_MEMORY;
    }
    shell->force = cholmod_zeros(n, cases, CHOLMOD_REAL, c);
    return shell->force ? VES_OK : VES_MEMORY;
}

static void common_start(cholmod_common *c)
{
    cholmod_start(c);
    c->nmethods = 1;
    c->print = 0;
    c->try_catch = true;
    c->quick_return_if_not_posdef = true;
    c->final_ll = true; /* L D L' of a small matrix would not tell that it is not positive */
}

static ves_status build(ves_shell *shell, ves_arena *arena)
{
    VES_TRY(kinds_make(shell, arena));
    VES_TRY(ves_shell_number(shell, arena));
    VES_TRY(ves_shell_rigid_make(shell, arena));
    VES_TRY(scratch_make(shell, arena));
    for (int k = 0; k < shell->layouts; k++) VES_TRY(ves_shell_layout(shell, &shell->layout[k], arena));
    VES_TRY(factor_make(shell));
    if (shell->model->buckling) VES_TRY(ves_shell_buckling_make(shell, arena));
    if (shell->model->gradients) VES_TRY(ves_shell_adjoint_make(shell, arena));
    return ves_shell_stresses_make(shell, arena);
}

ves_status ves_shell_create(const ves_shell_model *model, const ves_shell_input *input, ves_arena *arena,
                            ves_shell **out)
{
    ves_shell *shell = ves_arena_take(arena, 1, sizeof *shell);
    *out = NULL;
    if (!shell) return VES_MEMORY;
    shell->model = model, shell->input = input;
    shell->stressed = -1;
    common_start(&shell->common);
    ves_status status = build(shell, arena);
    if (status == VES_OK)
        *out = shell;
    else
        ves_shell_destroy(shell);
    return status;
}

void ves_shell_destroy(ves_shell *shell)
{
    if (!shell) return;
    cholmod_common *c = &shell->common;
    ves_shell_buckling_free(shell);
    ves_shell_adjoint_free(shell);
    for (int k = 0; shell->layout && k < shell->layouts; k++) {
        cholmod_free_sparse(&shell->layout[k].matrix, c);
        cholmod_free_factor(&shell->layout[k].factor, c);
    }
    cholmod_free_dense(&shell->force, c);
    cholmod_free_dense(&shell->solution, c);
    cholmod_free_dense(&shell->Y, c);
    cholmod_free_dense(&shell->E, c);
    cholmod_finish(c);
}

int ves_shell_freedoms(const ves_shell *shell)
{
    return shell->layout[0].freedoms;
}

ves_status ves_shell_solve(ves_shell *shell, const ves_shell_input *input)
{
    cholmod_common *c = &shell->common;
    shell_layout *layout = &shell->layout[0];
    shell->input = input;
    shell->stressed = -1;
    ves_shell_buckling_stale(shell);
    omp_set_max_active_levels(0); /* CHOLMOD would start four threads for each of ours */
    for (int k = 0; k < shell->layouts; k++) ves_shell_pivots(shell, &shell->layout[k]);
    VES_TRY(ves_shell_assemble(shell, layout));
    VES_TRY(ves_shell_held(shell, layout, 0));
    ves_shell_loads(shell);
    if (!cholmod_factorize(layout->matrix, layout->factor, c) && c->status < 0) return VES_MEMORY;
    if (c->status == CHOLMOD_NOT_POSDEF) return VES_LOOSE;
    if (!cholmod_solve2(CHOLMOD_A, layout->factor, shell->force, NULL, &shell->solution, NULL, &shell->Y,
                        &shell->E, c))
        return VES_MEMORY;
    return VES_OK;
}

const double *ves_shell_state(const ves_shell *shell, int which)
{
    return (const double *)shell->solution->x + (size_t)which * shell->solution->d;
}

void ves_shell_turned(const ves_shell *shell, int *sheet, int *s)
{
    const shell_element *e = &shell->element[shell->turned];
    *sheet = e->sheet, *s = e->s[shell->kind[e->sheet].nodes / 2];
}

double ves_shell_work(const ves_shell *shell, int which)
{
    const double *u = ves_shell_state(shell, which),
                 *f = (const double *)shell->force->x + (size_t)which * shell->force->d;
    double sum = 0;
    for (int k = 0; k < shell->layout[0].freedoms; k++) sum += u[k] * f[k];
    return sum;
}

void ves_shell_displacement(const ves_shell *shell, int which, int sheet, int s, double U[3],
                            double director[3])
{
    const ves_shell_model *m = shell->model;
    const double *u = ves_shell_state(shell, which);
    double turn[3] = {0}, move[3] = {0}, n[3];
    int node = m->weld[sheet][s];
    const shell_freedom *f = &shell->layout[0].freedom[node];
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 3; c++) {
            if (f->moves[i] >= 0) move[c] += u[f->first + f->moves[i]] * m->node[node].frame[i][c];
            if (f->turns[i] >= 0)
                turn[c] += u[f->first + f->turns[i]] * shell->layout[0].pivot[node].axis[i][c];
        }
    bool far = ves_shell_is_far(shell, sheet, s);
    for (int r = 0; r < 3; r++) U[r] = far ? ves_dot(m->turn[r], move) : move[r];
    double about[3];
    for (int r = 0; r < 3; r++) about[r] = far ? ves_dot(m->turn[r], turn) : turn[r];
    for (int c = 0; c < 3; c++) n[c] = shell->input->normal[sheet][c][s];
    ves_cross(about, n, director);
}

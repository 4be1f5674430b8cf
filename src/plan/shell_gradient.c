/* From what measures read of a shell to what it is made of: one solution more for each load case that is read
 * (shell/adjoint.h), then the formulas of loads, springs and thicknesses the way back. */
#include "plan/shell.h"

#include <string.h>

struct plan_shell_slopes {
    double *(*X)[3], *(*normal)[3]; /* [parts] of the sites */
    plan_shell_pull pull;
    ves_shell_reading *reading; /* [cases] */
    int points;                 /* of the stresses */
};

/* --- making --- */

static ves_status planes_take(ves_arena *arena, int count, size_t size, double **plane)
{
    for (int c = 0; c < count && !plane[c]; c++) {
        plane[c] = ves_arena_take(arena, size, sizeof **plane);
        if (!plane[c]) return VES_MEMORY;
    }
    return VES_OK;
}

static ves_status reading_make(const plan_shell *shell, int points, ves_arena *arena, ves_shell_reading *r)
{
    size_t parts = (size_t)shell->def->parts;
    r->U = ves_arena_take(arena, parts, sizeof *r->U);
    r->mean = ves_arena_take(arena, parts, sizeof *r->mean);
    r->stress = ves_arena_take(arena, (size_t)points, sizeof *r->stress);
    if (!r->U || !r->mean || !r->stress) return VES_MEMORY;
    for (size_t k = 0; k < parts; k++) VES_TRY(planes_take(arena, 3, (size_t)shell->part[k].count, r->U[k]));
    VES_TRY(planes_take(arena, 3, (size_t)points, r->X));
    VES_TRY(planes_take(arena, 1, (size_t)points, &r->thickness));
    return planes_take(arena, 1, (size_t)points, &r->area);
}

/* Planes where any case has some. */
static ves_status loads_make(const plan_shell *shell, int part, ves_arena *arena, ves_shell_load_gradient *to)
{
    size_t count = (size_t)shell->part[part].count;
    for (int which = 0; which < shell->def->cases; which++) {
        const ves_shell_load *load = &shell->load[which * shell->def->parts + part];
        if (load->pressure) VES_TRY(planes_take(arena, 1, count, &to->pressure));
        if (load->area[0]) VES_TRY(planes_take(arena, 3, count, to->area));
        for (int e = 0; e < VES_SHELL_EDGES; e++)
            if (load->line[e][0])
                VES_TRY(
                    planes_take(arena, 3, (size_t)ves_shell_edge_count(&shell->sheet[part], e), to->line[e]));
    }
    return VES_OK;
}

static ves_status pull_make(const plan_shell *shell, ves_arena *arena, plan_shell_pull *p)
{
    size_t parts = (size_t)shell->def->parts;
    p->thickness = ves_arena_take(arena, parts, sizeof *p->thickness);
    p->load = ves_arena_take(arena, parts, sizeof *p->load);
    p->force = ves_arena_take(arena, (size_t)shell->input.points, sizeof *p->force);
    p->spring = ves_arena_take(arena, (size_t)shell->model.springs, sizeof *p->spring);
    p->node_spring = ves_arena_take(arena, (size_t)shell->nodes, sizeof *p->node_spring);
    if (!p->thickness || !p->load || !p->force || !p->spring || !p->node_spring) return VES_MEMORY;
    for (size_t k = 0; k < parts; k++) {
        VES_TRY(planes_take(arena, 1, (size_t)shell->part[k].count, &p->thickness[k]));
        VES_TRY(loads_make(shell, (int)k, arena, &p->load[k]));
    }
    return VES_OK;
}

ves_status ves_shell_slopes_make(ves_plan *plan, plan_shell *shell)
{
    ves_arena *arena = &plan->arena;
    size_t parts = (size_t)shell->def->parts, cases = (size_t)shell->def->cases;
    plan_shell_slopes *s = ves_arena_take(arena, 1, sizeof *s);
    if (!s) return VES_MEMORY;
    s->X = ves_arena_take(arena, parts, sizeof *s->X);
    s->normal = ves_arena_take(arena, parts, sizeof *s->normal);
    s->reading = ves_arena_take(arena, cases, sizeof *s->reading);
    if (!s->X || !s->normal || !s->reading) return VES_MEMORY;
    for (size_t k = 0; k < parts; k++) {
        const ves_adjoint *on = &plan->level[shell->level].site[shell->part[k].site].adjoint;
        for (int c = 0; c < 3; c++) s->X[k][c] = on->X[c], s->normal[k][c] = on->normal[c];
    }
    s->points = ves_shell_places(shell->shell);
    for (size_t k = 0; k < cases; k++) VES_TRY(reading_make(shell, s->points, arena, &s->reading[k]));
    VES_TRY(pull_make(shell, arena, &s->pull));
    shell->slopes = s, shell->view.reading = s->reading;
    return VES_OK;
}

/* --- sweeping --- */

static bool is_read(const ves_shell_reading *r)
{
    return r->moved || r->meant || r->stressed || r->work != 0 || r->factor != 0;
}

static ves_shell_seed seed_of(const ves_shell_reading *r)
{
    ves_shell_seed seed = {.factor = r->factor, .work = r->work};
    if (r->moved) seed.U = (const double *const(*)[3])r->U;
    if (r->meant) seed.mean = (const double(*)[VES_SHELL_EDGES][3])r->mean;
    if (!r->stressed) return seed;
    seed.stress = (const double(*)[VES_SHELL_LEVELS][VES_STRESSES])r->stress;
    for (int c = 0; c < 3; c++) seed.X[c] = r->X[c];
    seed.thickness = r->thickness, seed.area = r->area;
    return seed;
}

static void plane_clear(double *plane, size_t count)
{
    if (plane) memset(plane, 0, sizeof *plane * count);
}

static void reading_clear(const plan_shell *shell, ves_shell_reading *r)
{
    size_t parts = (size_t)shell->def->parts, points = (size_t)shell->slopes->points;
    for (size_t k = 0; k < parts && r->moved; k++)
        for (int c = 0; c < 3; c++) plane_clear(r->U[k][c], (size_t)shell->part[k].count);
    if (r->meant) memset(r->mean, 0, sizeof *r->mean * parts);
    if (r->stressed) {
        memset(r->stress, 0, sizeof *r->stress * points);
        for (int c = 0; c < 3; c++) plane_clear(r->X[c], points);
        plane_clear(r->thickness, points), plane_clear(r->area, points);
    }
    r->factor = r->work = 0;
    r->moved = r->meant = r->stressed = false;
}

static void loads_clear(const plan_shell *shell)
{
    const plan_shell_pull *p = &shell->slopes->pull;
    memset(p->force, 0, sizeof *p->force * (size_t)shell->input.points);
    for (int k = 0; k < shell->def->parts; k++) {
        size_t count = (size_t)shell->part[k].count;
        plane_clear(p->load[k].pressure, count);
        for (int c = 0; c < 3; c++) {
            plane_clear(p->load[k].area[c], count);
            for (int e = 0; e < VES_SHELL_EDGES; e++)
                if (p->load[k].line[e][c])
                    plane_clear(p->load[k].line[e][c], (size_t)ves_shell_edge_count(&shell->sheet[k], e));
        }
    }
}

static void begin(const plan_shell *shell)
{
    const plan_shell_pull *p = &shell->slopes->pull;
    for (int k = 0; k < shell->def->parts; k++) plane_clear(p->thickness[k], (size_t)shell->part[k].count);
    memset(p->spring, 0, sizeof *p->spring * (size_t)shell->model.springs);
    memset(p->node_spring, 0, sizeof *p->node_spring * (size_t)shell->nodes);
}

static ves_status case_sweep(ves_plan *plan, plan_shell *shell, int which, ves_shell_gradient *g)
{
    plan_shell_slopes *s = shell->slopes;
    const ves_shell_seed seed = seed_of(&s->reading[which]);
    loads_clear(shell);
    ves_status status = ves_shell_adjoint(shell->shell, which, &seed, g);
    reading_clear(shell, &s->reading[which]);
    if (status == VES_OK) ves_shell_loads_pull_back(plan, shell, which, &s->pull);
    return status;
}

static void thickness_pull(ves_plan *plan, const plan_shell *shell, int part)
{
    const ves_shell_part_def *def = &shell->def->part[part];
    const double *on = shell->slopes->pull.thickness[part];
    for (int s = 0; s < shell->part[part].count; s++)
        if (def->uniform >= 0)
            plan->block_adjoint[def->uniform] += on[s];
        else if (on[s] != 0)
            ves_shell_formula_pull(plan, shell, part, s, def->thickness, on[s]);
}

ves_status ves_shell_sweep(ves_plan *plan, int index)
{
    plan_level *l = &plan->level[index];
    plan_shell *shell = l->shell;
    ves_status worst = VES_OK;
    bool any = false;
    if (!shell || !shell->slopes) return VES_OK;
    const plan_shell_pull *p = &shell->slopes->pull;
    ves_shell_gradient g = {.X = (double *const(*)[3])shell->slopes->X,
                            .normal = (double *const(*)[3])shell->slopes->normal,
                            .thickness = p->thickness,
                            .load = p->load,
                            .force = p->force,
                            .spring = p->spring,
                            .node_spring = p->node_spring};
    for (int k = 0; k < shell->def->cases; k++) {
        if (!is_read(&shell->slopes->reading[k])) continue;
        if (!any) begin(shell);
        any = true;
        ves_status status = case_sweep(plan, shell, k, &g);
        if (status != VES_OK) worst = status;
    }
    if (!any) return VES_OK;
    for (int k = 0; k < shell->def->parts; k++) {
        thickness_pull(plan, shell, k);
        l->site[shell->part[k].site].slopes |= VES_X | VES_NORMAL;
    }
    ves_shell_springs_pull_back(plan, shell, p);
    plan->block_adjoint[shell->def->E] += g.E;
    plan->block_adjoint[shell->def->nu] += g.nu;
    plan->block_adjoint[shell->def->shear] += g.shear;
    return worst;
}

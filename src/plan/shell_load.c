/* Loads, thicknesses and springs: formulas at the nodes of the shell. */
#include "plan/shell.h"

#include <math.h>
#include <string.h>

#include "base/domain.h"

/* Does any load of a case act so on this part? Gravity and forces per area share their planes. */
static bool acts(const ves_load_def *load, int part, bool pressure)
{
    bool it = pressure ? load->kind == VES_LOAD_PRESSURE
                       : load->kind == VES_LOAD_AREA || load->kind == VES_LOAD_GRAVITY;
    for (int k = 0; it && k < load->parts; k++)
        if (load->part[k] == part) return true;
    return false;
}

/* Along a curve that several parts end on, a load is that of the first. */
static const ves_shell_edge *pulled(const ves_load_def *load)
{
    bool edge = load->kind == VES_LOAD_LINE || load->kind == VES_LOAD_FORCE;
    return edge && load->at.kind != VES_AT_PLACE ? &load->at.on[0] : NULL;
}

static ves_status planes(ves_plan *plan, int count, int nodes, const double **plane)
{
    for (int c = 0; c < count && !plane[c]; c++) {
        plane[c] = ves_arena_doubles(&plan->arena, (size_t)nodes);
        if (!plane[c]) return VES_MEMORY;
    }
    return VES_OK;
}

static ves_status case_make(ves_plan *plan, plan_shell *shell, int which)
{
    const ves_case_def *c = &shell->def->load_case[which];
    for (int k = 0; k < c->loads; k++) {
        const ves_load_def *load = &c->load[k];
        ves_shell_load *to = shell->load + which * shell->def->parts;
        for (int p = 0; p < shell->def->parts; p++) {
            if (acts(load, p, true)) VES_TRY(planes(plan, 1, shell->part[p].count, &to[p].pressure));
            if (acts(load, p, false)) VES_TRY(planes(plan, 3, shell->part[p].count, to[p].area));
        }
        const ves_shell_edge *on = pulled(load);
        if (on)
            VES_TRY(planes(plan, 3, ves_shell_edge_count(&shell->sheet[on->part], on->edge),
                           to[on->part].line[on->edge]));
        else if (load->kind == VES_LOAD_FORCE)
            shell->input.points++;
    }
    return VES_OK;
}

ves_status ves_shell_loads_make(ves_plan *plan, plan_shell *shell)
{
    const ves_shell_def *def = shell->def;
    shell->load = ves_arena_take(&plan->arena, (size_t)(def->cases * def->parts), sizeof *shell->load);
    if (!shell->load) return VES_MEMORY;
    for (int k = 0; k < def->cases; k++) VES_TRY(case_make(plan, shell, k));
    shell->point = ves_arena_take(&plan->arena, (size_t)shell->input.points, sizeof *shell->point);
    int springs = 0;
    for (int k = 0; k < def->supports; k++)
        if (def->support[k].kind == VES_SUPPORT_SPRING) springs += def->support[k].at.edges > 0;
    shell->spring = ves_arena_take(&plan->arena, (size_t)springs, sizeof *shell->spring);
    shell->model.springs = springs, shell->model.spring = shell->spring;
    return shell->point && shell->spring ? VES_OK : VES_MEMORY;
}

static void arguments(const plan_site *site, int s, double at[VES_SHELL_ARGUMENTS])
{
    const ves_samples *m = &site->samples;
    for (int c = 0; c < 3; c++) at[VES_SHELL_X + c] = m->X[c][s];
    ves_domain_at(m->u_range, m->v_range, m->u[s % m->nu], m->v[s / m->nu], &at[VES_SHELL_U]);
}

double ves_shell_formula(ves_plan *plan, const plan_shell *shell, int part, int s, const ves_formula *formula)
{
    double at[VES_SHELL_ARGUMENTS];
    arguments(&plan->level[shell->level].site[shell->part[part].site], s, at);
    return ves_formula_eval(formula, plan->block, at, plan->formula_room);
}

/* Component c of a load, or stiffness, at a node; the first that is no number is kept for telling. */
static double noted(plan_shell *shell, double value, ves_mark mark, int part, int s)
{
    if (!isfinite(value) && !shell->odd.found) shell->odd = (plan_shell_odd){true, mark, value, part, s};
    return value;
}

static double load_at(ves_plan *plan, plan_shell *shell, const ves_load_def *load, int c, const int at[2])
{
    double value = ves_shell_formula(plan, shell, at[0], at[1], load->formula[c]);
    return noted(shell, value, load->mark, at[0], at[1]);
}

static void surface_fill(ves_plan *plan, plan_shell *shell, const ves_load_def *load, int part,
                         ves_shell_load *to)
{
    const ves_shell_def *def = shell->def;
    double density = load->kind == VES_LOAD_GRAVITY ? plan->block[def->density] : 1;
    bool pressure = load->kind == VES_LOAD_PRESSURE;
    for (int s = 0; s < shell->part[part].count; s++) {
        double factor = load->kind == VES_LOAD_GRAVITY ? density * shell->part[part].thickness[s] : 1;
        for (int c = 0; c < (pressure ? 1 : 3); c++) {
            double *plane = (double *)(pressure ? to->pressure : to->area[c]);
            plane[s] += factor * load_at(plan, shell, load, c, (int[]){part, s});
        }
    }
}

/* A force along a whole edge is spread over the length of what the nodes draw. */
static void edge_fill(ves_plan *plan, plan_shell *shell, const ves_load_def *load, const ves_shell_edge *on,
                      ves_shell_load *to)
{
    const ves_shell_sheet *sheet = &shell->sheet[on->part];
    double share =
        load->kind == VES_LOAD_LINE
            ? 1
            : 1 / (shell->sector.copies * ves_shell_length(shell->shell, &shell->input, on->part, on->edge));
    for (int k = 0; k < ves_shell_edge_count(sheet, on->edge); k++) {
        const int at[2] = {on->part, ves_shell_edge_node(sheet, on->edge, k)};
        for (int c = 0; c < 3; c++)
            ((double *)to->line[on->edge][c])[k] += share * load_at(plan, shell, load, c, at);
    }
}

static void case_clear(plan_shell *shell, int which)
{
    for (int p = 0; p < shell->def->parts; p++) {
        ves_shell_load *to = &shell->load[which * shell->def->parts + p];
        size_t nodes = (size_t)shell->part[p].count * sizeof(double);
        if (to->pressure) memset((double *)to->pressure, 0, nodes);
        for (int c = 0; c < 3; c++) {
            if (to->area[c]) memset((double *)to->area[c], 0, nodes);
            for (int e = 0; e < VES_SHELL_EDGES; e++)
                for (int k = 0; to->line[e][c] && k < ves_shell_edge_count(&shell->sheet[p], e); k++)
                    ((double *)to->line[e][c])[k] = 0;
        }
    }
}

static void case_fill(ves_plan *plan, plan_shell *shell, int which, int *points)
{
    const ves_case_def *def = &shell->def->load_case[which];
    case_clear(shell, which);
    for (int k = 0; k < def->loads; k++) {
        const ves_load_def *load = &def->load[k];
        ves_shell_load *to = shell->load + which * shell->def->parts;
        const ves_shell_edge *on = pulled(load);
        for (int i = 0; i < load->parts; i++)
            surface_fill(plan, shell, load, load->part[i], &to[load->part[i]]);
        if (on) edge_fill(plan, shell, load, on, &to[on->part]);
        if (on || load->kind != VES_LOAD_FORCE) continue;
        int s = ves_shell_place(plan, shell, &load->at);
        ves_shell_point *point = &shell->point[(*points)++];
        *point = (ves_shell_point){.which = which, .node = shell->part[load->at.part].weld[s]};
        for (int c = 0; c < 3; c++)
            point->force[c] = load_at(plan, shell, load, c, (int[]){load->at.part, s});
    }
}

static void springs_fill(ves_plan *plan, plan_shell *shell)
{
    ves_shell_spring *spring = shell->spring;
    for (int k = 0; k < shell->nodes; k++)
        for (int c = 0; c < 3; c++) shell->node[k].spring[c] = 0;
    for (int k = 0; k < shell->def->supports; k++) {
        const ves_support_def *s = &shell->def->support[k];
        if (s->kind != VES_SUPPORT_SPRING) continue;
        for (int c = 0; c < 3; c++) noted(shell, plan->block[s->spring + c], s->mark, -1, 0);
        if (s->at.kind == VES_AT_PLACE) {
            int node = shell->part[s->at.part].weld[ves_shell_place(plan, shell, &s->at)];
            for (int c = 0; c < 3; c++) shell->node[node].spring[c] += plan->block[s->spring + c];
            continue;
        }
        *spring = (ves_shell_spring){.sheet = s->at.on[0].part, .edge = s->at.on[0].edge};
        for (int c = 0; c < 3; c++) spring->stiffness[c] = plan->block[s->spring + c];
        spring++;
    }
}

void ves_shell_loads_fill(ves_plan *plan, plan_shell *shell)
{
    int points = 0;
    shell->odd.found = false;
    for (int p = 0; p < shell->def->parts; p++)
        for (int s = 0; s < shell->part[p].count; s++)
            shell->part[p].thickness[s] = ves_shell_formula(plan, shell, p, s, shell->def->part[p].thickness);
    for (int k = 0; k < shell->def->cases; k++) case_fill(plan, shell, k, &points);
    springs_fill(plan, shell);
}

/* --- the way back --- */

double ves_shell_formula_pull(ves_plan *plan, const plan_shell *shell, int part, int s,
                              const ves_formula *formula, double seed)
{
    plan_site *site = &plan->level[shell->level].site[shell->part[part].site];
    double at[VES_SHELL_ARGUMENTS], back[VES_SHELL_ARGUMENTS] = {0};
    arguments(site, s, at);
    double value =
        ves_formula_gradient(formula, plan->block, at, seed, plan->block_adjoint, back, plan->formula_room);
    for (int c = 0; c < 3; c++)
        if (site->adjoint.X[c]) site->adjoint.X[c][s] += back[VES_SHELL_X + c];
    return value;
}

static void surface_pull(ves_plan *plan, const plan_shell *shell, const ves_load_def *load, int part,
                         const plan_shell_pull *from)
{
    bool pressure = load->kind == VES_LOAD_PRESSURE, weight = load->kind == VES_LOAD_GRAVITY;
    const int at = shell->def->density;
    double density = weight ? plan->block[at] : 1;
    for (int s = 0; s < shell->part[part].count; s++)
        for (int c = 0; c < (pressure ? 1 : 3); c++) {
            double on = (pressure ? from->load[part].pressure : from->load[part].area[c])[s],
                   thickness = weight ? shell->part[part].thickness[s] : 1;
            if (on == 0) continue;
            double f =
                ves_shell_formula_pull(plan, shell, part, s, load->formula[c], on * density * thickness);
            if (!weight) continue;
            plan->block_adjoint[at] += on * thickness * f;
            from->thickness[part][s] += on * density * f;
        }
}

/* Of a force that is spread, what is of its length too. */
static void edge_pull(ves_plan *plan, const plan_shell *shell, const ves_load_def *load,
                      const ves_shell_edge *on, const plan_shell_pull *from)
{
    const ves_shell_sheet *sheet = &shell->sheet[on->part];
    const bool spread = load->kind == VES_LOAD_FORCE;
    plan_site *site = &plan->level[shell->level].site[shell->part[on->part].site];
    double length = spread ? ves_shell_length(shell->shell, &shell->input, on->part, on->edge) : 1,
           share = spread ? 1 / (shell->sector.copies * length) : 1, by_share = 0;
    for (int k = 0; k < ves_shell_edge_count(sheet, on->edge); k++)
        for (int c = 0; c < 3; c++) {
            double seed = from->load[on->part].line[on->edge][c][k];
            by_share +=
                seed * ves_shell_formula_pull(plan, shell, on->part, ves_shell_edge_node(sheet, on->edge, k),
                                              load->formula[c], seed * share);
        }
    if (spread)
        ves_shell_length_pull(shell->shell, on->part, on->edge, -by_share * share / length, site->adjoint.X);
}

void ves_shell_loads_pull_back(ves_plan *plan, const plan_shell *shell, int which,
                               const plan_shell_pull *from)
{
    const ves_case_def *def = &shell->def->load_case[which];
    int point = 0;
    while (point < shell->input.points && shell->point[point].which < which) point++;
    for (int k = 0; k < def->loads; k++) {
        const ves_load_def *load = &def->load[k];
        const ves_shell_edge *on = pulled(load);
        for (int i = 0; i < load->parts; i++) surface_pull(plan, shell, load, load->part[i], from);
        if (on) edge_pull(plan, shell, load, on, from);
        if (on || load->kind != VES_LOAD_FORCE) continue;
        int s = ves_shell_place(plan, shell, &load->at);
        for (int c = 0; c < 3; c++)
            ves_shell_formula_pull(plan, shell, load->at.part, s, load->formula[c], from->force[point][c]);
        point++;
    }
}

void ves_shell_springs_pull_back(ves_plan *plan, const plan_shell *shell, const plan_shell_pull *from)
{
    const double(*spring)[3] = (const double(*)[3])from->spring;
    for (int k = 0; k < shell->def->supports; k++) {
        const ves_support_def *s = &shell->def->support[k];
        if (s->kind != VES_SUPPORT_SPRING) continue;
        const double *on =
            s->at.kind == VES_AT_PLACE
                ? from->node_spring[shell->part[s->at.part].weld[ves_shell_place(plan, shell, &s->at)]]
                : *spring++;
        for (int c = 0; c < 3; c++) plan->block_adjoint[s->spring + c] += on[c];
    }
}

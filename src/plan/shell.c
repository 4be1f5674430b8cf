/* The shell of a plan at one level: built once, solved when the first measure asks. */
#include "plan/shell.h"

#include <math.h>
#include <string.h>

#include "base/random.h"
#include "base/vector.h"

void ves_shell_design(ves_plan *plan, int k)
{
    const ves_problem *p = plan->problem;
    ves_random random = {.seed = 2, .step = (uint64_t)k};
    double *x = plan->reference;
    for (int i = 0; i < p->variables; i++) {
        const ves_variable *v = &p->variable[i];
        x[i] = k == 0 ? v->start : v->min + (v->max - v->min) * ves_random_uniform(&random);
    }
    double share = k == 0 ? 0.5 : ves_random_uniform(&random);
    ves_plan_bind(plan, x, p->solve ? p->solve->lo + (p->solve->hi - p->solve->lo) * share : 0);
}

/* --- building --- */

/* light: also by a measure that only reads what the shell is made of. */
static bool wanted(const ves_plan *plan, bool light)
{
    const ves_problem *p = plan->problem;
    for (int m = 0; m < p->measures; m++) {
        const ves_measure *measure = p->measure[m].measure;
        if (measure->shell && (light || (measure->cost > 0 && plan->runs[PROGRAM_ALL][m]))) return true;
    }
    return false;
}

static bool buckles(const ves_plan *plan)
{
    for (int m = 0; m < plan->problem->measures; m++)
        if (plan->problem->measure[m].measure->buckles && plan->runs[PROGRAM_ALL][m]) return true;
    return false;
}

ves_status ves_shell_begin(ves_plan *plan, int index, ves_diag *diag)
{
    plan_level *l = &plan->level[index];
    if (!plan->problem->shell || !wanted(plan, true)) return VES_OK;
    plan_shell *shell = ves_arena_take(&plan->arena, 1, sizeof *shell);
    if (!shell) return VES_MEMORY;
    l->shell = shell;
    shell->def = plan->problem->shell, shell->level = index;
    shell->solid = wanted(plan, false);
    shell->buckles = buckles(plan);
    if (!shell->solid) return VES_OK;
    if (index > 0) {
        shell->sector = plan->level[0].shell->sector, shell->waves = plan->level[0].shell->waves;
    } else {
        VES_TRY(ves_shell_rings(plan, shell));
        VES_TRY(ves_shell_sector_find(plan, shell));
    }
    return ves_shell_mesh(plan, shell, diag);
}

/* The sites of the nodes; their programs are those of the measures that read the shell. */
ves_status ves_shell_sites(ves_plan *plan, int index)
{
    plan_level *l = &plan->level[index];
    plan_shell *shell = l->shell;
    for (int k = 0; shell && shell->solid && k < shell->def->parts; k++) {
        plan_shell_part *part = &shell->part[k];
        plan_site *s = &l->site[l->sites];
        *s = (plan_site){.patch = part->patch, .curve = -1, .samples.site = VES_SITE_SURFACE, .mesh = true};
        int rows = ves_shell_rows(&shell->sheet[k]);
        VES_TRY(ves_grid_given(rows, part->u, part->count / rows, part->v,
                               ves_patch_periodic(plan->patch[part->patch]), &plan->arena, &s->grid));
        s->wants = VES_X | VES_NORMAL;
        for (int m = 0; m < plan->problem->measures; m++)
            for (int p = 0; p < PROGRAMS && plan->problem->measure[m].measure->shell; p++)
                if (plan->runs[p][m]) s->needs[p] |= s->wants;
        part->site = l->sites++;
    }
    return VES_OK;
}

static ves_status pointers_make(ves_plan *plan, plan_shell *shell)
{
    size_t parts = (size_t)shell->def->parts;
    ves_arena *a = &plan->arena;
    shell->X = ves_arena_take(a, parts, sizeof *shell->X);
    shell->normal = ves_arena_take(a, parts, sizeof *shell->normal);
    shell->thickness = ves_arena_take(a, parts, sizeof *shell->thickness);
    shell->side = ves_arena_take(a, parts, sizeof *shell->side);
    shell->u_range = ves_arena_take(a, parts, sizeof *shell->u_range);
    shell->v_range = ves_arena_take(a, parts, sizeof *shell->v_range);
    shell->weld = ves_arena_take(a, parts, sizeof *shell->weld);
    shell->far = ves_arena_take(a, parts, sizeof *shell->far);
    shell->spot = ves_arena_take(a, (size_t)shell->def->ats, sizeof *shell->spot);
    if (!shell->X || !shell->normal || !shell->thickness || !shell->side || !shell->u_range ||
        !shell->v_range || !shell->weld || !shell->far || !shell->spot)
        return VES_MEMORY;
    for (size_t k = 0; k < parts; k++) {
        const ves_samples *m = &plan->level[shell->level].site[shell->part[k].site].samples;
        for (int c = 0; c < 3; c++) shell->X[k][c] = m->X[c], shell->normal[k][c] = m->normal[c];
        memcpy(shell->u_range[k], m->u_range, sizeof m->u_range);
        memcpy(shell->v_range[k], m->v_range, sizeof m->v_range);
        shell->thickness[k] = shell->part[k].thickness;
        shell->weld[k] = shell->part[k].weld, shell->far[k] = shell->part[k].far;
    }
    return VES_OK;
}

static void model_fill(plan_shell *shell)
{
    ves_shell_model *m = &shell->model;
    m->sheets = shell->def->parts, m->sheet = shell->sheet;
    m->nodes = shell->nodes, m->node = shell->node;
    m->weld = shell->weld;
    m->far = shell->sector.whole || shell->sector.mirrored ? NULL : shell->far;
    memcpy(m->turn, shell->sector.turn, sizeof m->turn);
    m->cases = shell->def->cases;
    m->buckling = shell->buckles;
    m->held = shell->held;
    ves_shell_input *in = &shell->input;
    in->X = (const double *const(*)[3])shell->X, in->normal = (const double *const(*)[3])shell->normal;
    in->thickness = shell->thickness, in->side = shell->side;
    in->load = shell->load, in->point = shell->point;
}

/* What measures read that ask for no solution. */
static ves_status view_begin(ves_plan *plan, plan_shell *shell)
{
    shell->formula = ves_arena_take(&plan->arena, (size_t)plan->problem->patches, sizeof *shell->formula);
    if (!shell->formula) return VES_MEMORY;
    for (int k = 0; k < shell->def->parts; k++)
        shell->formula[shell->def->part[k].patch] = shell->def->part[k].thickness;
    shell->view = (ves_shell_view){.density = shell->def->density, .thickness = shell->formula};
    return VES_OK;
}

static void view_fill(ves_plan *plan, plan_shell *shell)
{
    ves_shell_view *v = &shell->view;
    v->shell = shell->shell, v->model = &shell->model, v->input = &shell->input;
    v->copies = shell->sector.copies;
    v->spot = shell->spot, v->grip = shell->grip;
    v->u_range = (const double(*)[2])shell->u_range, v->v_range = (const double(*)[2])shell->v_range;
    memcpy(v->share, shell->sector.share, sizeof v->share);
    for (int k = 0; k < shell->def->ats; k++) {
        const ves_shell_at *at = &shell->def->at[k];
        ves_shell_spot *spot = &shell->spot[k];
        if (at->kind == VES_AT_PLACE)
            ves_shell_spot_find(plan, shell, at, spot);
        else
            *spot = (ves_shell_spot){at->on[0].part, at->on[0].edge, 0, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    }
}

/* The candidate's part of the input. */
static void input_fill(ves_plan *plan, plan_shell *shell)
{
    const ves_shell_def *def = shell->def;
    shell->input.material =
        (ves_shell_material){plan->block[def->E], plan->block[def->nu], plan->block[def->shear]};
    for (int k = 0; k < def->parts; k++)
        shell->side[k] = plan->level[shell->level].site[shell->part[k].site].side;
    ves_shell_loads_fill(plan, shell);
}

bool ves_shell_differentiable(const ves_plan *plan)
{
    const plan_shell *shell = plan->level[0].shell;
    for (int k = 0; k < shell->def->parts; k++)
        if (shell->sheet[k].order[0] < 2) return false;
    return true;
}

/* Once the sites have their planes. */
ves_status ves_shell_finish(ves_plan *plan, int index, ves_diag *diag)
{
    plan_shell *shell = plan->level[index].shell;
    if (!shell) return VES_OK;
    VES_TRY(view_begin(plan, shell));
    if (!shell->solid) return VES_OK;
    VES_TRY(pointers_make(plan, shell));
    VES_TRY(ves_shell_weld(plan, shell));
    VES_TRY(ves_shell_hold(plan, shell, diag));
    VES_TRY(ves_shell_loads_make(plan, shell));
    VES_TRY(ves_shell_grips_make(plan, shell));
    model_fill(shell);
    shell->model.gradients = !plan->trial && ves_plan_differentiable(plan);
    VES_TRY(ves_shell_create(&shell->model, &shell->input, &plan->arena, &shell->shell));
    view_fill(plan, shell);
    return shell->model.gradients ? ves_shell_slopes_make(plan, shell) : VES_OK;
}

void ves_shell_end(ves_plan *plan)
{
    for (int k = 0; k < LEVELS; k++)
        if (plan->level[k].shell) ves_shell_destroy(plan->level[k].shell->shell);
}

ves_shell_facts ves_plan_shell(const ves_plan *plan, int level)
{
    const plan_shell *shell = plan->level[level].shell;
    ves_shell_facts facts = {0};
    if (!shell || !shell->solid) return facts;
    for (int k = 0; k < shell->def->parts; k++) {
        const ves_shell_sheet *sheet = &shell->sheet[k];
        facts.elements += sheet->elements[0] * sheet->elements[1];
        if (sheet->order[0] > facts.order) facts.order = sheet->order[0];
    }
    facts.freedoms = ves_shell_freedoms(shell->shell);
    facts.copies = shell->sector.ring ? 0 : (int)lround(shell->sector.copies);
    facts.mirrored = shell->sector.mirrored;
    return facts;
}

/* --- solving --- */

static bool has_walls(const plan_shell *shell)
{
    for (int k = 0; k < shell->def->parts; k++)
        for (int s = 0; s < shell->part[k].count; s++)
            if (!(shell->part[k].thickness[s] > 0)) return false;
    return true;
}

ves_status ves_shell_run(ves_plan *plan, int index)
{
    plan_shell *shell = plan->level[index].shell;
    if (shell->solved) return shell->outcome;
    input_fill(plan, shell);
    shell->outcome = !has_walls(shell)  ? VES_NO_WALL
                     : shell->odd.found ? VES_NO_NUMBER
                                        : ves_shell_solve(shell->shell, &shell->input);
    shell->solved = true;
    return shell->outcome;
}

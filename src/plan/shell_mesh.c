/* Meshes of shells. */
#include "plan/shell.h"

#include <math.h>

#include "base/vector.h"

enum { NODES_A_WAVE = 8, NODES_LEAST = 48 };

/* What is chosen where the file says nothing. The annealer's elements are of order 6, graded towards both ends, where shells
 * have layers of length sqrt(R t): on a smooth surface five of them along u err five times less than MITC9's twelve, in the
 * same time. The verifier's: order 8. Where buckling is asked for
 * the middle matters as much as the ends. Along u so many elements, along v so many times eight nodes for each
 * wave that the shape has around. */
typedef struct choice {
    int order, along;
    double around, grading;
} choice;

static choice choose(const plan_shell *shell)
{
    static const choice usual = {6, 5, 1, 2.2}, sector = {6, 6, 1.5, 1.8}, verifier = {8, 6, 1, 2.2};
    static const choice waving = {6, 8, 1, 1.6}, waving_verifier = {8, 8, 1, 1.6};
    bool small = shell->sector.ring || shell->sector.folds >= 6;
    if (shell->buckles) return shell->level ? waving_verifier : waving;
    return shell->level ? verifier : small ? sector : usual;
}

static const ves_shell_mesh_def *said(const plan_shell *shell)
{
    return shell->level ? &shell->def->verify : &shell->def->mesh;
}

/* Sizes grow from both ends like x^g. */
static double graded(double t, double g)
{
    return t < 0.5 ? 0.5 * pow(2 * t, g) : 1 - 0.5 * pow(2 - 2 * t, g);
}

/* Elements of a whole patch along u (0) or v (1). */
static int elements(const ves_plan *plan, const plan_shell *shell, int part, int d, int order)
{
    const choice c = choose(shell);
    int own = shell->level ? 0 : shell->def->part[part].elements[d], all = said(shell)->elements[d];
    if (own || all) return own ? own : all;
    bool round = ves_patch_periodic(plan->patch[shell->def->part[part].patch]);
    if (d == 0 || !round) return order == c.order ? c.along : (c.along * c.order + order - 1) / order;
    double nodes = c.around * fmax(NODES_LEAST, NODES_A_WAVE * shell->waves);
    return (int)ceil(nodes / order);
}

static double *knots(ves_plan *plan, int count, double from, double to, double grading)
{
    double *knot = ves_arena_doubles(&plan->arena, (size_t)count + 1);
    for (int k = 0; knot && k <= count; k++)
        knot[k] = from + (to - from) * graded((double)k / count, grading);
    return knot;
}

static ves_status sheet_make(ves_plan *plan, plan_shell *shell, int part)
{
    const plan_sector *sector = &shell->sector;
    const ves_shell_mesh_def *m = said(shell);
    ves_shell_sheet *sheet = &shell->sheet[part];
    int patch = shell->def->part[part].patch, order = m->order ? m->order : choose(shell).order;
    bool round = ves_patch_periodic(plan->patch[patch]);
    double from = 0, to = VES_TWO_PI, grading = m->grading > 0 ? m->grading : choose(shell).grading;
    *sheet = (ves_shell_sheet){.order = {order, order}};
    for (int d = 0; d < 2; d++) sheet->elements[d] = elements(plan, shell, part, d, order);
    if (round && !sector->whole) {
        from = sector->from, to = sector->to;
        sheet->elements[1] = (int)ceil(sheet->elements[1] * (to - from) / VES_TWO_PI - 1e-9);
    }
    if (round && sector->ring) sheet->ring = true, sheet->order[1] = sheet->elements[1] = 1;
    sheet->closed = round && sector->whole;
    sheet->knot[0] = knots(plan, sheet->elements[0], 0, 1, round ? grading : m->grading > 0 ? m->grading : 1);
    sheet->knot[1] = knots(plan, sheet->elements[1], from, to, round ? 1 : m->grading > 0 ? m->grading : 1);
    return sheet->knot[0] && sheet->knot[1] ? VES_OK : VES_MEMORY;
}

/* A place that is asked for, or held, must be a node: the nearest mesh line inside goes there. */
static bool place_fit(const ves_plan *plan, plan_shell *shell, const ves_shell_at *at)
{
    ves_shell_sheet *sheet = &shell->sheet[at->part];
    const ves_place *place = &plan->problem->place[at->index];
    double map[3][3];
    const double want[2] = {plan->block[place->u],
                            ves_sector_place(&shell->sector, plan->block[place->v], map)};
    for (int d = 0; d < 2; d++) {
        double *knot = (double *)sheet->knot[d];
        int n = sheet->elements[d], near = 0;
        for (int k = 1; k <= n; k++)
            if (fabs(knot[k] - want[d]) < fabs(knot[near] - want[d])) near = k;
        if (fabs(knot[near] - want[d]) < 1e-12) continue;
        if (d == 1 && sheet->closed && VES_TWO_PI - want[d] < 1e-12) continue;
        if (near == 0) near = 1;
        if (near == n) near = n - 1;
        if (n < 2 || want[d] <= knot[near - 1] || want[d] >= knot[near + 1]) return false;
        knot[near] = want[d];
    }
    return true;
}

static ves_status places_fit(const ves_plan *plan, plan_shell *shell, ves_diag *diag)
{
    const ves_shell_def *def = shell->def;
    for (int pass = 0; pass < 2; pass++) { /* a second one may have moved what the first had set */
        const ves_shell_at *at = NULL;
        bool fits = true;
#define FIT(place)                                                                                           \
    if (fits && (place)->kind == VES_AT_PLACE) at = (place), fits = place_fit(plan, shell, at)
        for (int k = 0; k < def->supports; k++) FIT(&def->support[k].at);
        for (int c = 0; c < def->cases; c++)
            for (int k = 0; k < def->load_case[c].loads; k++)
                if (def->load_case[c].load[k].kind <= VES_LOAD_FORCE) FIT(&def->load_case[c].load[k].at);
        for (int k = 0; k < def->ats; k++) FIT(&def->at[k]);
#undef FIT
        if (!fits)
            return ves_diag_add(
                diag, VES_ERROR, VES_RANGE, at->mark,
                "the mesh of the shell is too coarse for \"%s\" to be a node of its own: give the part "
                "more \"elements\"",
                at->text);
    }
    return VES_OK;
}

static ves_status part_make(ves_plan *plan, plan_shell *shell, int k)
{
    plan_shell_part *part = &shell->part[k];
    const ves_shell_sheet *sheet = &shell->sheet[k];
    int rows = ves_shell_rows(sheet), columns = ves_shell_columns(sheet);
    part->patch = shell->def->part[k].patch;
    part->count = rows * columns;
    part->u = ves_arena_doubles(&plan->arena, (size_t)rows);
    part->v = ves_arena_doubles(&plan->arena, (size_t)columns);
    part->weld = ves_arena_take(&plan->arena, (size_t)part->count, sizeof *part->weld);
    part->far = ves_arena_take(&plan->arena, (size_t)part->count, sizeof *part->far);
    part->thickness = ves_arena_doubles(&plan->arena, (size_t)part->count);
    if (!part->u || !part->v || !part->weld || !part->far || !part->thickness) return VES_MEMORY;
    ves_shell_grid(sheet, part->u, part->v);
    return VES_OK;
}

ves_status ves_shell_mesh(ves_plan *plan, plan_shell *shell, ves_diag *diag)
{
    size_t parts = (size_t)shell->def->parts;
    shell->sheet = ves_arena_take(&plan->arena, parts, sizeof *shell->sheet);
    shell->part = ves_arena_take(&plan->arena, parts, sizeof *shell->part);
    if (!shell->sheet || !shell->part) return VES_MEMORY;
    for (int k = 0; k < shell->def->parts; k++) VES_TRY(sheet_make(plan, shell, k));
    VES_TRY(places_fit(plan, shell, diag));
    for (int k = 0; k < shell->def->parts; k++) VES_TRY(part_make(plan, shell, k));
    return VES_OK;
}

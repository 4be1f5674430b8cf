#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "base/vector.h"
#include "plan/inside.h"

/* --- what each program runs --- */

static void runs_add(ves_plan *plan, plan_program which, const ves_formula *formula)
{
    for (int m = 0; formula && m < plan->problem->measures; m++)
        if (ves_formula_uses_argument(formula, m)) plan->runs[which][m] = true;
}

static ves_status runs_make(ves_plan *plan)
{
    const ves_problem *p = plan->problem;
    for (int w = 0; w < PROGRAMS; w++) {
        plan->runs[w] = ves_arena_take(&plan->arena, (size_t)p->measures, sizeof(bool));
        if (!plan->runs[w]) return VES_MEMORY;
    }
    if (p->scale) plan->runs[PROGRAM_SCALE][p->scale->measure] = true;
    if (p->solve) {
        runs_add(plan, PROGRAM_SOLVE, p->solve->left);
        runs_add(plan, PROGRAM_SOLVE, p->solve->right);
    }
    runs_add(plan, PROGRAM_JUDGE, p->objective);
    if (p->scale && plan->displaced) plan->runs[PROGRAM_JUDGE][p->scale->measure] = true;
    for (int k = 0; k < p->constraints; k++) {
        runs_add(plan, PROGRAM_JUDGE, p->constraint[k].left);
        runs_add(plan, PROGRAM_JUDGE, p->constraint[k].right);
    }
    for (int k = 0; k < p->validity.checks; k++) runs_add(plan, PROGRAM_PROOF, p->validity.check[k].formula);
    for (int k = 0; k < p->constraints; k++) {
        plan->cheap[k] = true;
        for (int m = 0; m < p->measures; m++) {
            bool reads = ves_formula_uses_argument(p->constraint[k].left, m) ||
                         ves_formula_uses_argument(p->constraint[k].right, m);
            if (reads && p->measure[m].measure->cost > 0) plan->cheap[k] = false;
        }
    }
    for (int m = 0; m < p->measures; m++) {
        plan->any_dear |= plan->runs[PROGRAM_JUDGE][m] && p->measure[m].measure->cost > 0;
        plan->runs[PROGRAM_JUDGE][m] |=
            plan->runs[PROGRAM_SOLVE][m]; /* the gradient of the root needs them too */
        plan->runs[PROGRAM_ALL][m] = true;
    }
    for (int m = 0; m < p->measures && plan->trial;
         m++) { /* to choose a grid, which meshes of shells are not on */
        const ves_measure *measure = p->measure[m].measure;
        bool spared = measure->shell && measure->cost > 0 && !plan->runs[PROGRAM_SOLVE][m];
        for (int w = 0; w < PROGRAMS && spared; w++) plan->runs[w][m] = false;
    }
    return VES_OK;
}

/* --- memory --- */

static int formula_room(const ves_problem *p)
{
    int most = 0;
#define ROOM(formula)                                                                                        \
    do {                                                                                                     \
        int room_ = (formula) ? ves_formula_room(formula) : 0;                                               \
        if (room_ > most) most = room_;                                                                      \
    } while (0)
    for (int k = 0; k < p->parameters; k++) ROOM(p->parameter[k].formula);
    for (int k = 0; k < p->numbers; k++) ROOM(p->number[k]);
    for (int k = 0; k < p->constraints; k++) {
        ROOM(p->constraint[k].left);
        ROOM(p->constraint[k].right);
    }
    ROOM(p->objective);
    for (int k = 0; k < p->kinds; k++) ROOM(p->kind[k].formula);
    for (int k = 0; k < p->validity.checks; k++) ROOM(p->validity.check[k].formula);
    if (p->solve) {
        ROOM(p->solve->left);
        ROOM(p->solve->right);
    }
    if (p->scale) ROOM(p->scale->target);
    const ves_shell_def *shell = p->shell;
    for (int k = 0; shell && k < shell->parts; k++) ROOM(shell->part[k].thickness);
    for (int k = 0; shell && k < shell->cases; k++)
        for (int n = 0; n < shell->load_case[k].loads; n++)
            for (int c = 0; c < 3; c++) ROOM(shell->load_case[k].load[n].formula[c]);
#undef ROOM
    return most;
}

static ves_status memory_take(ves_plan *plan)
{
    const ves_problem *p = plan->problem;
    ves_arena *a = &plan->arena;
    size_t outputs = (size_t)p->constraints + 2;
    plan->block = ves_arena_take(a, (size_t)p->block, sizeof(double));
    plan->block_adjoint = ves_arena_take(a, (size_t)p->block, sizeof(double));
    plan->value = ves_arena_doubles(a, (size_t)p->measures);
    plan->fine = ves_arena_doubles(a, (size_t)p->measures);
    plan->measure_adjoint = ves_arena_doubles(a, (size_t)p->measures);
    plan->natural = ves_arena_doubles(a, (size_t)p->measures);
    plan->fine_violation = ves_arena_doubles(a, (size_t)p->constraints);
    plan->size = ves_arena_doubles(a, (size_t)p->constraints);
    plan->cheap = ves_arena_take(a, (size_t)p->constraints, sizeof *plan->cheap);
    plan->cutoff = HUGE_VAL;
    plan->formula_room = ves_arena_doubles(a, (size_t)formula_room(p));
    plan->rows = ves_arena_doubles(a, outputs * (size_t)p->slots);
    plan->row_similarity = ves_arena_doubles(a, outputs);
    plan->unit_row = ves_arena_doubles(a, (size_t)p->slots);
    plan->field = ves_arena_take(a, 1, sizeof *plan->field);
    plan->field_adjoint = ves_arena_take(a, 1, sizeof *plan->field_adjoint);
    plan->unfolded = ves_arena_take(a, 1, sizeof *plan->unfolded);
    plan->form = ves_arena_take(a, 1, sizeof *plan->form);
    plan->patch = ves_arena_take(a, (size_t)p->patches, sizeof *plan->patch);
    plan->sheet = ves_arena_take(a, (size_t)p->patches, sizeof *plan->sheet);
    plan->side = ves_arena_take(a, (size_t)p->patches, sizeof *plan->side);
    plan->part = ves_arena_take(a, (size_t)p->patches, sizeof *plan->part);
    plan->sense = ves_arena_take(a, (size_t)p->patches, sizeof *plan->sense);
    plan->enclosed = ves_arena_take(a, (size_t)p->patches, sizeof *plan->enclosed);
    plan->reference = ves_arena_take(a, (size_t)p->variables, sizeof *plan->reference);
    plan->told = ves_arena_doubles(a, (size_t)p->measures);
    plan->sides = ves_arena_take(a, (size_t)p->constraints, sizeof *plan->sides);
    plan->checked = ves_arena_take(a, (size_t)p->validity.checks, sizeof *plan->checked);
    plan->broken = -1;
    return plan->block && plan->block_adjoint && plan->value && plan->fine && plan->fine_violation &&
                   plan->measure_adjoint && plan->natural && plan->size && plan->cheap &&
                   plan->formula_room && plan->rows && plan->row_similarity && plan->unit_row &&
                   plan->field && plan->field_adjoint && plan->unfolded && plan->form && plan->patch &&
                   plan->sheet && plan->side && plan->part && plan->sense && plan->enclosed &&
                   plan->reference && plan->told && plan->sides && plan->checked
               ? VES_OK
               : VES_MEMORY;
}

/* --- the start design --- */

/* Fills a whole block, also what never varies: at the start, or with every variable in the middle of its
 * range. */
static void block_fill(ves_plan *plan, bool middle, double *block)
{
    const ves_problem *p = plan->problem;
    for (int k = 0; k < p->variables; k++) {
        const ves_variable *v = &p->variable[k];
        block[k] = middle ? v->min + (v->max - v->min) / 2 : v->start;
    }
    if (p->solve) block[p->variables] = (p->solve->lo + p->solve->hi) / 2;
    for (int k = 0; k < p->parameters; k++)
        block[p->variables + p->unknowns + k] =
            ves_formula_eval(p->parameter[k].formula, block, NULL, plan->formula_room);
    for (int k = 0; k < p->numbers; k++)
        block[p->slots + k] = ves_formula_eval(p->number[k], block, NULL, plan->formula_room);
}

/* The patch of a file, as the surface room wants it. */
static ves_status pde_define(const ves_patch_def *d, ves_arena *arena, ves_pde *pde)
{
    static const ves_spine_kind SPINE[] = {VES_SPINE_SOLVED, VES_SPINE_HERMITE, VES_SPINE_BSPLINE};
    ves_datum *datum = ves_arena_take(arena, (size_t)d->conditions, sizeof *datum);
    if (!datum) return VES_MEMORY;
    *pde = (ves_pde){.layout = {.power = d->power, .lower = d->lower},
                     .datum = datum,
                     .general = d->general,
                     .operators = d->operators,
                     .modes = d->modes,
                     .omega = d->omega,
                     .spine = {SPINE[d->spine], d->spine_vectors, d->spine_first}};
    memcpy(pde->parameter, d->parameter, sizeof pde->parameter);
    for (int j = 0; j < d->conditions; j++) {
        const ves_condition *c = &d->condition[j];
        ves_term *term = ves_arena_take(arena, (size_t)c->shares, sizeof *term);
        if (!term) return VES_MEMORY;
        for (int i = 0; i < c->shares; i++) term[i] = (ves_term){c->share[i].curve, c->share[i].factor};
        pde->layout.knot[j] = (ves_knot){.u = c->u, .derivative = c->derivative};
        datum[j] = (ves_datum){.terms = c->shares, .term = term, .scale = c->scale};
    }
    return VES_OK;
}

static ves_status patch_make(ves_plan *plan, int k, ves_diag *diag)
{
    const ves_patch_def *d = &plan->problem->patch[k];
    ves_arena *arena = &plan->arena;
    if (d->kind == VES_PATCH_FORMULA) {
        ves_sheet_formula sheet = {.formula = {d->formula[0], d->formula[1], d->formula[2]},
                                   .u_range = {d->u_range[0], d->u_range[1]},
                                   .v_range = {d->v_range[0], d->v_range[1]},
                                   .periodic = d->periodic};
        return ves_patch_formula(&sheet, &plan->bound, arena, &plan->patch[k]);
    }
    if (d->kind == VES_PATCH_POINTS)
        return ves_patch_points(d->rows, d->columns, d->points, d->periodic, &plan->bound, arena,
                                &plan->patch[k]);
    ves_pde *pde = ves_arena_take(arena, 1, sizeof *pde);
    if (!pde) return VES_MEMORY;
    VES_TRY(pde_define(d, arena, pde));
    VES_TRY(ves_patch_pde(pde, &plan->bound, arena, &plan->patch[k]));
    VES_TRY(ves_plan_elliptic(plan, k, diag));
    return plan->trial ? VES_OK : ves_plan_conditions(plan, k, diag);
}

/* Does the value change from one candidate to another? */
static bool changes(const ves_problem *p, const ves_formula *formula)
{
    for (int k = 0; k < p->slots; k++)
        if (p->varying[k] && ves_formula_uses_slot(formula, k)) return true;
    for (int m = 0; m < p->measures; m++)
        if (ves_formula_uses_argument(formula, m)) return true;
    return false;
}

bool ves_plan_turned(const ves_problem *p, const ves_constraint_def *c)
{
    return changes(p, c->right) && !changes(p, c->left);
}

/* The scale of each violation: |limit| at the start, the limit being the side that is the same for every
 * candidate, or the right one. What is held against it may begin anywhere, a million times beyond: its size
 * counts only where the limit is 0 and says none. */
static void sizes_fix(ves_plan *plan)
{
    const ves_problem *p = plan->problem;
    for (int k = 0; k < p->constraints; k++) {
        const ves_constraint_def *c = &p->constraint[k];
        bool turned = ves_plan_turned(p, c);
        double limit = fabs(ves_plan_formula(plan, turned ? c->left : c->right));
        double other = fabs(ves_plan_formula(plan, turned ? c->right : c->left));
        double size = limit == 0 ? other : limit;
        plan->size[k] = size > 0 && isfinite(size) ? size : 1;
    }
}

static ves_status places_check(const ves_problem *p, ves_diag *diag)
{
    for (int k = 0; k < p->places; k++)
        if (p->varying[p->place[k].u] || p->varying[p->place[k].v])
            return ves_diag_add(
                diag, VES_ERROR, VES_RANGE, p->place[k].mark,
                "place \"%s\" would wander over its patch: its u and v cannot depend on a variable",
                p->place[k].name);
    return VES_OK;
}

static ves_status build(ves_plan *plan, const int quadrature[2], ves_diag *diag)
{
    const ves_problem *p = plan->problem;
    VES_TRY(places_check(p, diag));
    VES_TRY(memory_take(plan));
    ves_plan_unscale(plan);
    double *middle = ves_arena_take(&plan->arena, (size_t)p->block, sizeof *middle);
    if (!middle) return VES_MEMORY;
    block_fill(plan, false, plan->block);
    block_fill(plan, true, middle);
    ves_curve_set set = {p->curve, p->curves, p->curve_limit, plan->block, p->varying, middle};
    VES_TRY(ves_curves_create(&set, &plan->arena, &plan->curves, diag));
    plan->bound = (ves_bound){.number = plan->block, .varying = p->varying, .curves = plan->curves};
    for (int k = 0; k < p->patches; k++) VES_TRY(patch_make(plan, k, diag));
    ves_plan_bind_patches(plan);
    VES_TRY(ves_plan_orient(plan, diag));
    VES_TRY(runs_make(plan));
    VES_TRY(ves_plan_pose(plan));
    for (int k = 0; k < LEVELS; k++) {
        for (int d = 0; d < 2; d++) plan->level[k].quadrature[d] = quadrature[d] << k;
        VES_TRY(ves_plan_level_build(plan, k, diag));
    }
    plan->gradients = ves_plan_differentiable(plan);
    VES_TRY(ves_plan_refer(plan, diag));
    VES_TRY(ves_plan_sizes(plan));
    for (int m = 0; m < p->measures; m++) plan->value[m] = 0;
    ves_status status = ves_plan_forward(plan, plan->start, 0, PROGRAM_JUDGE, false);
    if (status < 0) return status;
    sizes_fix(plan);
    return VES_OK;
}

typedef enum plan_manner { USUAL, TRIAL, LOOSE } plan_manner;

static ves_status make(const ves_problem *problem, const int quadrature[2], plan_manner manner,
                       ves_plan **out, ves_diag *diag)
{
    int before = ves_diag_errors(diag);
    ves_plan *plan = ves_memory_take(sizeof *plan);
    ves_status status = plan ? VES_OK : VES_MEMORY;
    *out = NULL;
    if (plan) plan->problem = problem, plan->change = NAN;
    if (plan) plan->trial = manner == TRIAL, plan->displaced = manner == LOOSE;
    if (status == VES_OK) status = build(plan, quadrature, diag);
    if (status == VES_OK) {
        *out = plan;
        return VES_OK;
    }
    if (ves_diag_errors(diag) == before) ves_diag_fail(diag, status);
    ves_plan_destroy(plan);
    return status;
}

ves_status ves_plan_make(const ves_problem *problem, const int quadrature[2], ves_plan **plan, ves_diag *diag)
{
    return make(problem, quadrature, USUAL, plan, diag);
}

ves_status ves_plan_loose(const ves_problem *problem, const int quadrature[2], ves_plan **plan,
                          ves_diag *diag)
{
    return make(problem, quadrature, LOOSE, plan, diag);
}

ves_status ves_plan_try(const ves_problem *problem, const int quadrature[2], ves_plan **plan)
{
    return make(problem, quadrature, TRIAL, plan, NULL);
}

static bool in_range(int count, int most)
{
    return count == 0 || (count >= VES_NODES_LEAST && count <= most);
}

/* A number that is left to be chosen counts with the most that may be. */
static bool is_grid(const ves_problem *problem, const int q[2])
{
    int u = q[0] ? q[0] : VES_CHOSEN_U, v = q[1] ? q[1] : VES_CHOSEN_V;
    return in_range(q[0], VES_NODES_U) && in_range(q[1], VES_NODES_V) &&
           (double)u * v <= ves_nodes_most(problem->patches);
}

static ves_status refuse(const ves_problem *problem, const int q[2], ves_diag *diag)
{
    return ves_diag_add(
        diag, VES_ERROR, VES_RANGE, (ves_mark){0},
        "a plan has %d to %d nodes along u, %d to %d along v, 0: chosen, and u times v at most %d on "
        "every patch (%d in all): %d x %d are not possible",
        VES_NODES_LEAST, VES_NODES_U, VES_NODES_LEAST, VES_NODES_V, ves_nodes_most(problem->patches),
        problem->patches, q[0], q[1]);
}

/* The grid: what the options say, else the problem, else what is chosen. */
ves_status ves_plan_create(const ves_problem *problem, const ves_plan_options *options, ves_plan **out,
                           ves_diag *diag)
{
    int q[2] = {0, 0}, chosen[2];
    double change = NAN;
    *out = NULL;
    if (options) memcpy(q, options->quadrature, sizeof q);
    for (int d = 0; d < 2; d++)
        if (q[d] == 0) q[d] = problem->quadrature[d];
    if (!is_grid(problem, q)) return refuse(problem, q, diag);
    if (q[0] == 0 || q[1] == 0) {
        /* it makes many plans; of what fails, but for memory, the one that is used will speak */
        if (ves_plan_choose(problem, NULL, chosen, &change) == VES_MEMORY)
            return ves_diag_fail(diag, VES_MEMORY);
        if (chosen[0] > VES_CHOSEN_U && (double)chosen[0] * q[1] > VES_CHOSEN_U * VES_CHOSEN_V)
            chosen[0] = VES_CHOSEN_U; /* beside so many around, which were given */
        for (int d = 0; d < 2; d++)
            if (q[d] == 0) q[d] = chosen[d];
    }
    VES_TRY(ves_plan_make(problem, q, out, diag));
    (*out)->change = change;
    return VES_OK;
}

void ves_plan_destroy(ves_plan *plan)
{
    if (!plan) return;
    for (int k = 0; k < LEVELS; k++)
        for (int m = 0; plan->level[k].instance && m < plan->problem->measures; m++) {
            void *state = plan->level[k].instance[m].input.state;
            if (state && plan->problem->measure[m].measure->release)
                plan->problem->measure[m].measure->release(state);
        }
    ves_shell_end(plan);
    ves_arena_destroy(&plan->arena);
    ves_memory_free(plan);
}

double ves_plan_grid(const ves_plan *plan, int quadrature[2])
{
    memcpy(quadrature, plan->level[0].quadrature, sizeof plan->level[0].quadrature);
    return plan->change;
}

static bool there(const ves_plan *plan, int patch)
{
    return patch >= 0 && patch < plan->problem->patches;
}

static bool stands_inside(const ves_patch_def *d)
{
    for (int k = 0; k < d->conditions; k++)
        if (d->condition[k].u > 0 && d->condition[k].u < 1) return true;
    return false;
}

ves_patch_facts ves_plan_patch(const ves_plan *plan, int patch)
{
    if (!there(plan, patch) || plan->problem->patch[patch].kind != VES_PATCH_PDE) return (ves_patch_facts){0};
    const ves_patch *p = plan->patch[patch];
    const ves_patch_def *d = &plan->problem->patch[patch];
    ves_patch_facts facts = {.order = 2 * d->power,
                             .band = ves_patch_band(p),
                             .modes = ves_patch_modes(p),
                             .tail = ves_patch_tail(p),
                             .omega = ves_plan_omega(plan, patch),
                             .rest = ves_plan_rest(plan, patch),
                             .inside = stands_inside(d)};
    if (facts.inside) facts.worst = ves_plan_worst(plan, patch);
    const int mode[3] = {0, facts.modes, facts.worst};
    for (int k = 0; k < 3 && facts.inside; k++) {
        ves_amplification found;
        ves_patch_amplification(p, mode[k], &found);
        facts.amplification[k] = found.amplified;
        facts.condition[k] = found.condition;
    }
    return facts;
}

void ves_plan_lattice(int along, int around, double *u, double *v)
{
    for (int k = 0; k < along * around; k++) {
        u[k] = (double)(k / around) / (along - 1);
        v[k] = VES_TWO_PI * (k % around) / around;
    }
}

ves_status ves_plan_points(ves_plan *plan, int patch, int count, const double *u, const double *v,
                           double *out)
{
    if (!there(plan, patch)) return VES_RANGE;
    ves_arena arena = {0};
    double *room = ves_arena_doubles(&arena, (size_t)ves_patch_point_room(plan->patch[patch]));
    if (!room) return VES_MEMORY;
    ves_patch_point(plan->patch[patch], &plan->bound, count, u, v, out, room);
    for (long k = 0; k < 3L * VES_FIELDS * count; k++) out[k] *= plan->similarity;
    ves_arena_destroy(&arena);
    return VES_OK;
}

ves_status ves_plan_spine(ves_plan *plan, int patch, int count, const double *u, double *out)
{
    if (!there(plan, patch)) return VES_RANGE;
    ves_arena arena = {0};
    double *room = ves_arena_doubles(&arena, (size_t)ves_patch_point_room(plan->patch[patch]));
    if (!room) return VES_MEMORY;
    bool has = ves_patch_spine(plan->patch[patch], &plan->bound, count, u, out, room);
    for (long k = 0; has && k < 9L * count; k++) out[k] *= plan->similarity;
    ves_arena_destroy(&arena);
    return has ? VES_OK : VES_ABSENT;
}

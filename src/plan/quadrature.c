/* The quadrature that `auto` chooses. */
#include "plan/inside.h"

#include <math.h>
#include <string.h>

enum { U_LEAST = 16, V_LEAST = 16, V_MOST = VES_CHOSEN_V, NODES_MOST = VES_CHOSEN_U * VES_CHOSEN_V };

static const double ENOUGH = 1e-9;

static int rounded(int n)
{
    return (n + VES_LANES - 1) / VES_LANES * VES_LANES;
}

/* The most nodes along u: a surface through many sections may turn at each, and wants ten nodes for it. */
static int u_most(const ves_problem *problem)
{
    int most = VES_CHOSEN_U;
    for (int k = 0; k < problem->patches; k++)
        if (10 * problem->patch[k].conditions > most) most = 10 * problem->patch[k].conditions;
    return most;
}

/* And so many less along v. */
static int v_most(int u)
{
    return u > VES_CHOSEN_U ? NODES_MOST / u : V_MOST;
}

/* Measures of one design on one grid. */
static ves_status measures_on(const ves_problem *problem, const double *x, const int grid[2], double *value)
{
    ves_plan *plan;
    VES_TRY(ves_plan_try(problem, grid, &plan));
    ves_status status = ves_plan_measure_all(plan, x, 0);
    for (int m = 0; m < problem->measures; m++) value[m] = plan->value[m];
    ves_plan_destroy(plan);
    return status;
}

static double change_between(const ves_plan *plan, const double *a, const double *b)
{
    double worst = 0;
    for (int k = 0; k < plan->problem->measures; k++)
        if (!plan->problem->measure[k].measure->extreme)
            worst = fmax(worst, ves_plan_measure_change(plan, k, a[k], b[k]));
    return worst;
}

/* Fewer nodes than this cannot see the modes that are solved: their products would be taken for slower
 * ones. */
static int resolving(const ves_plan *plan)
{
    int modes = 0;
    for (int k = 0; k < plan->problem->patches; k++)
        if (ves_patch_modes(plan->patch[k]) > modes) modes = ves_patch_modes(plan->patch[k]);
    int n = rounded(2 * modes + 2);
    return n < V_LEAST ? V_LEAST : n > V_MOST ? V_MOST : n;
}

/* Refines one direction until two refinements in a row change nothing: one alone may be fooled by symmetry.
 * Where something still changes beyond the last grid that may be chosen, that one is. left: the largest
 * change seen last, from the grid chosen or, where nothing was calm, from the one before it. */
static ves_status refine(const ves_plan *plan, const double *x, int d, int grid[2], double *left,
                         double *value)
{
    const ves_problem *problem = plan->problem;
    int count = problem->measures, most = d ? v_most(grid[0]) : u_most(problem),
        trial[2] = {grid[0], grid[1]}, calm = 0, largest = grid[d];
    double *next = value + count;
    *left = 0;
    VES_TRY(measures_on(problem, x, trial, value));
    while (calm < 2) {
        int finer = rounded(trial[d] + trial[d] / 2);
        trial[d] = finer;
        VES_TRY(measures_on(problem, x, trial, next));
        double change = change_between(plan, value, next);
        *left = calm ? fmax(*left, change) : change;
        calm = change <= ENOUGH ? calm + 1 : 0;
        if (finer <= most) largest = finer;
        if (calm) continue;
        grid[d] = largest;
        if (finer > most) return VES_OK;
        for (int k = 0; k < count; k++) value[k] = next[k];
    }
    return VES_OK;
}

/* The plan of the first grid, which sees the modes. Round noses and thin edges may look folded on it: then it is
 * made finer, around and across in turn, until they do not. What is folded on the finest that may be chosen is
 * so, and no reason for many nodes. */
static ves_status begin(const ves_problem *problem, int grid[2], ves_plan **plan)
{
    int most = u_most(problem);
    VES_TRY(ves_plan_try(problem, grid, plan));
    grid[1] = resolving(*plan);
    int trial[2] = {grid[0], grid[1]};
    for (int turn = 1; trial[0] <= most && trial[1] <= v_most(trial[0]); turn = !turn) {
        ves_plan_destroy(*plan);
        VES_TRY(ves_plan_try(problem, trial, plan));
        if ((*plan)->measured == VES_FOLDED) {
            trial[turn] *= 2;
            continue;
        }
        memcpy(grid, trial, sizeof trial);
        return VES_OK;
    }
    return VES_OK;
}

ves_status ves_plan_choose(const ves_problem *problem, const double *at, int quadrature[2], double *change)
{
    ves_arena arena = {0};
    double *value = ves_arena_doubles(&arena, (size_t)(2 * problem->measures)), left[2] = {0, 0};
    double *x = ves_arena_doubles(&arena, (size_t)problem->variables);
    ves_plan *plan = NULL;
    int grid[2] = {U_LEAST, 2 * V_LEAST};
    ves_status status = value && x ? VES_OK : VES_MEMORY;
    if (status == VES_OK) status = begin(problem, grid, &plan);
    bool there = status == VES_OK && at && ves_plan_measure_all(plan, at, 0) == VES_OK;
    if (status == VES_OK && !there) status = plan->measured;
    if (status == VES_OK && problem->variables)
        memcpy(x, there ? at : plan->reference, sizeof *x * (size_t)problem->variables);
    for (int d = 0; d < 2 && status == VES_OK; d++) status = refine(plan, x, d, grid, &left[d], value);
    ves_plan_destroy(plan);
    ves_arena_destroy(&arena);
    quadrature[0] = grid[0], quadrature[1] = grid[1];
    *change = status == VES_OK ? fmax(left[0], left[1]) : NAN;
    return status < 0 ? status : VES_OK;
}

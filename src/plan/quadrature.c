/* The quadrature that `auto` chooses. */
#include "plan/inside.h"

#include <math.h>

enum { U_LEAST = 16, U_MOST = 64, V_LEAST = 16, V_MOST = 256 };

static const double ENOUGH = 1e-9;

static int rounded(int n)
{
    return (n + VES_LANES - 1) / VES_LANES * VES_LANES;
}

/* Measures of the start design on one grid. */
static ves_status measures_on(const ves_problem *problem, int nu, int nv, double *value, ves_diag *diag)
{
    ves_plan *plan;
    VES_TRY(ves_plan_create(problem, &(ves_plan_options){.quadrature = {nu, nv}}, &plan, diag));
    ves_status status = plan_forward(plan, plan->block, 0, PROGRAM_ALL, false);
    for (int m = 0; m < problem->measures; m++) value[m] = status == VES_OK ? plan->value[m] : NAN;
    ves_plan_destroy(plan);
    return status;
}

static double change_between(int count, const double *a, const double *b)
{
    double worst = 0;
    for (int k = 0; k < count; k++) {
        double size = fmax(fabs(a[k]), fabs(b[k])), change = size > 1e-9 ? fabs(a[k] - b[k]) / size : 0;
        worst = fmax(worst, change);
    }
    return worst;
}

ves_status ves_plan_quadrature(const ves_problem *problem, int quadrature[2], double *change, ves_diag *diag)
{
    int count = problem->measures, grid[2] = {U_LEAST, V_LEAST};
    const int most[2] = {U_MOST, V_MOST};
    double *value = ves_memory_take(sizeof *value * (size_t)(2 * count + 1)), left[2] = {0, 0};
    if (!value) return VES_MEMORY;
    ves_status status = measures_on(problem, grid[0], grid[1], value, diag);
    for (int d = 0; d < 2 && status == VES_OK; d++)
        while (status == VES_OK) {
            int finer[2] = {grid[0], grid[1]};
            finer[d] = rounded(grid[d] + grid[d] / 2);
            status = measures_on(problem, finer[0], finer[1], value + count, diag);
            if (status != VES_OK) break;
            left[d] = change_between(count, value, value + count);
            if (left[d] <= ENOUGH || finer[d] > most[d]) break;
            grid[d] = finer[d];
            for (int k = 0; k < count; k++) value[k] = value[count + k];
        }
    ves_memory_free(value);
    quadrature[0] = grid[0], quadrature[1] = grid[1];
    *change = fmax(left[0], left[1]);
    return status < 0 ? status : VES_OK;
}

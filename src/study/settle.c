#include "study/settle.h"

#include <math.h>

#include "problem/problem.h"

enum { POLISH_LEAST = 10 }; /* evaluations for each variable, as a polish itself counts */

ves_status ves_settle_grid(const ves_run *run, int grid[2], double *change)
{
    VES_TRY(ves_plan_choose(run->problem, run->best.x, grid, change));
    for (int d = 0; d < 2; d++)
        if (grid[d] < run->quadrature[d]) grid[d] = run->quadrature[d];
    return VES_OK;
}

bool ves_settle_search(const ves_search_options *search, const ves_run *run, ves_search_options *again)
{
    int k = search->stages - 1;
    while (k >= 0 && search->stage[k].kind != VES_STAGE_POLISH) k--;
    if (search->stages && k < 0) return false;
    long left = search->evaluations ? search->evaluations - run->evaluations : 0;
    if (search->evaluations && left < POLISH_LEAST * (2L + run->problem->variables)) return false;
    *again = (ves_search_options){.stages = 1, .seed = search->seed, .evaluations = left};
    again->stage[0].kind = VES_STAGE_POLISH;
    if (search->stages) again->stage[0] = search->stage[k];
    return true;
}

/* Better ones first, but none before the run's own. */
static void insert(ves_optimum *list, int *count, int first, ves_optimum optimum, bool maximize)
{
    double sign = maximize ? -1 : 1;
    int j = (*count)++;
    for (; j > first; j--) {
        ves_verdict a = {.value = sign * optimum.value, .violation = optimum.violation};
        ves_verdict b = {.value = sign * list[j - 1].value, .violation = list[j - 1].violation};
        if (!ves_verdict_better(&a, &b, VES_FEASIBLE)) break;
        list[j] = list[j - 1];
    }
    list[j] = optimum;
}

ves_status ves_settle_optima(ves_plan *plan, const ves_optimum *old, int count, ves_arena *arena,
                             ves_run *run)
{
    const int first = run->optima;
    if (!first || count < 1) return VES_OK;
    ves_optimum *list = ves_arena_take(arena, (size_t)(first + count), sizeof *list);
    if (!list) return VES_MEMORY;
    for (int k = 0; k < first; k++) list[k] = run->optimum[k];
    list[0].hits = old[0].hits;
    int total = first;
    for (int k = 1; k < count; k++) {
        ves_verdict verdict = {0};
        ves_ask ask = {.x = old[k].x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
        VES_TRY(ves_plan_evaluate(plan, &ask, &verdict));
        if (verdict.status != VES_OK) continue;
        ves_optimum moved = old[k];
        moved.value = run->problem->maximize ? -verdict.value : verdict.value;
        moved.violation = verdict.violation;
        insert(list, &total, first, moved, run->problem->maximize);
    }
    run->optimum = list;
    run->optima = total;
    return VES_OK;
}

#include "study/settle.h"

#include <math.h>

#include "problem/problem.h"

enum { POLISH_LEAST = 10 }; /* evaluations for each variable, as a polish itself counts */

static const double SAME = 1e-3; /* of the ranges, as a search tells optima apart */

ves_status ves_settle_grid(const ves_run *run, int grid[2], double *change)
{
    VES_TRY(ves_plan_choose(run->problem, run->best.x, grid, change));
    for (int d = 0; d < 2; d++)
        if (grid[d] < run->quadrature[d]) grid[d] = run->quadrature[d];
    return VES_OK;
}

bool ves_settle_search(const ves_search_options *search, const ves_run *run, long left,
                       ves_search_options *again)
{
    int k = search->stages - 1;
    while (k >= 0 && search->stage[k].kind != VES_STAGE_POLISH) k--;
    if (search->stages && k < 0) return false;
    if (left < POLISH_LEAST * (2L + run->problem->variables)) return false;
    *again = (ves_search_options){.stages = 1, .seed = search->seed, .evaluations = left};
    again->stage[0].kind = VES_STAGE_POLISH;
    if (search->stages) again->stage[0] = search->stage[k];
    again->stage[0].polish.starts = 0;
    return true;
}

/* The optimum that lies nearest in the ranges, if near enough to be the same; -1: none. */
static int nearest(const ves_run *run, const double *x)
{
    int found = -1;
    double least = SAME;
    for (int k = 0; k < run->optima; k++) {
        double apart = 0;
        for (int i = 0; i < run->problem->variables; i++) {
            const ves_variable *v = &run->problem->variable[i];
            apart = fmax(apart, fabs(run->optimum[k].x[i] - x[i]) / (v->max - v->min));
        }
        if (apart < least) least = apart, found = k;
    }
    return found;
}

ves_status ves_settle_hits(const ves_optimum *old, int count, ves_arena *arena, ves_run *run)
{
    ves_optimum *optimum = ves_arena_take(arena, (size_t)run->optima, sizeof *optimum);
    if (!optimum) return VES_MEMORY;
    for (int k = 0; k < run->optima; k++) {
        optimum[k] = run->optimum[k];
        optimum[k].hits = 0;
    }
    for (int k = 0; k < count; k++) {
        int at = nearest(run, old[k].x);
        if (at >= 0) optimum[at].hits += old[k].hits;
    }
    for (int k = 0; k < run->optima; k++)
        if (!optimum[k].hits) optimum[k].hits = run->optimum[k].hits;
    run->optimum = optimum;
    return VES_OK;
}

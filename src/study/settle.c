#include "study/settle.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/diag.h"

enum { POLISH_LEAST = 10 }; /* evaluations for each variable, as a polish itself counts */

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
    double least = VES_ONE_OPTIMUM;
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

/* The polish on the finer grid has counted no descents: those on the coarser one tell of the same optimum, or of
 * another. How the polish ended is what is new; but what was refused or frozen stays so. */
static ves_status evidence_keep(ves_study *s, const ves_evidence *before, const double *best)
{
    ves_evidence *e = &s->run->evidence;
    const ves_evidence now = *e;
    if (!before->descents) return VES_OK;
    const bool same = nearest(s->run, best) == 0, ends = now.trust == VES_TRUST_CONVERGED;
    const bool stays = before->trust == VES_TRUST_REFUSED || before->trust == VES_TRUST_FROZEN;
    if (same) *e = *before;
    if (same && ends && stays) return VES_OK;
    if (same) e->trust = ends && before->hits > 1 ? VES_TRUST_REPEATED : now.trust;
    e->verdict = now.verdict;
    e->sentence =
        ves_arena_format(s->arena, "%.*s%s", now.verdict, now.sentence,
                         same ? before->sentence + before->verdict
                              : "; on the finer grid this is another optimum than the best of the coarser");
    return e->sentence ? VES_OK : ves_diag_fail(s->diag, VES_MEMORY);
}

/* The optima, the best first, polished once more on the finer grid; what is reported is measured there. */
static ves_status polish_again(ves_study *s, const ves_search_options *again)
{
    ves_run *run = s->run;
    const ves_optimum *old = run->optimum;
    const int count = run->optima;
    const ves_evidence before = run->evidence;
    const double **from = ves_arena_take(s->arena, (size_t)count + 1, sizeof *from);
    if (!from) return ves_diag_fail(s->diag, VES_MEMORY);
    from[0] = run->best.x;
    for (int k = 1; k < count; k++) from[k] = old[k].x;
    VES_TRY(ves_study_search(s, again, from, count > 1 ? count : 1));
    if (ves_settle_hits(old, count, s->arena, run) != VES_OK) return ves_diag_fail(s->diag, VES_MEMORY);
    if (count) VES_TRY(evidence_keep(s, &before, old[0].x));
    if (run->optima >= count) return VES_OK;
    char text[VES_SENTENCE];
    snprintf(text, sizeof text, "of the %d optima on the coarser grid %d were%s found again on the finer one",
             count, run->optima, run->ending == VES_ENDED_STOPPED ? ", before the stop," : "");
    return ves_study_note(s, text);
}

static ves_status search_finer(ves_study *s, const ves_search_options *again, const int grid[2],
                               double change)
{
    ves_run *run = s->run;
    const ves_plan_options finer = {{grid[0], grid[1]}};
    ves_plan **coarse = s->plan, **plan = ves_arena_take(s->arena, (size_t)run->jobs, sizeof *plan);
    if (!plan) return ves_diag_fail(s->diag, VES_MEMORY);
    s->plan = plan;
    ves_status status = ves_study_plans(s, &finer, plan, NULL);
    ves_study_plans_destroy(coarse, run->jobs);
    if (status != VES_OK) return ves_diag_fail(s->diag, status);
    run->quadrature[0] = grid[0], run->quadrature[1] = grid[1];
    run->change = change;
    VES_TRY(ves_study_measure(s, NULL, 0, &run->start));
    return polish_again(s, again);
}

/* When the grid does not settle the best: another one, or the advice to give one. */
ves_status ves_settle_best(ves_study *s)
{
    ves_run *run = s->run;
    const int *q = run->quadrature;
    const double off = ves_plan_change(s->plan[0], &run->best, &run->finer);
    if (!(off > VES_UNSETTLED)) return VES_OK;
    int grid[2];
    double change;
    char text[VES_SENTENCE];
    ves_search_options again;
    ves_status status = ves_settle_grid(run, grid, &change);
    if (status != VES_OK) return ves_diag_fail(s->diag, status);
    if (grid[0] == q[0] && grid[1] == q[1]) return VES_OK;
    bool chosen = s->problem->quadrature[0] == 0 && s->problem->quadrature[1] == 0;
    if (ves_study_stopped(s)) run->ending = VES_ENDED_STOPPED; /* the choice of a grid takes its time */
    if (chosen && run->ending != VES_ENDED_STOPPED && ves_settle_search(&s->search, run, s->left, &again)) {
        snprintf(text, sizeof text,
                 "%d x %d nodes a patch, chosen at the start design, left the best unsettled by %.1e: "
                 "polished once more on %d x %d, chosen at the best",
                 q[0], q[1], off, grid[0], grid[1]);
        VES_TRY(ves_study_note(s, text));
        return search_finer(s, &again, grid, change);
    }
    snprintf(text, sizeof text,
             "%d x %d nodes a patch leave the result unsettled by %.1e: give quadrature: {u: %d, v: %d}",
             q[0], q[1], off, grid[0], grid[1]);
    return ves_study_note(s, text);
}

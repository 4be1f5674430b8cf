#include <math.h>
#include <string.h>

#include "search/anneal.h"

/* Legs: where one begins, and what is done with its ends. */

static void restart(void *data, int worker, int index)
{
    ves_annealing *a = data;
    a->chain[index].asker.worker = worker;
    ves_chain_restart(&a->chain[index]);
}

/* New places may cost some draws. */
ves_status ves_annealing_leg_begin(ves_annealing *a, bool *begun)
{
    ves_cooling *cooling = &a->cooling;
    cooling->left = ves_annealing_left(a) - (cooling->leg ? VES_CHAIN_DRAWS : 0);
    if (!cooling->leg) cooling->whole = cooling->left;
    *begun = cooling->left > 0 && a->schedule->begin(cooling);
    if (!*begun) return VES_OK;
    a->held = 0;
    a->most = (int)((cooling->temperatures + VES_TEMPERATURES - 1) / VES_TEMPERATURES);
    a->report.legs++;
    a->proved = cooling->c;
    a->made = 0;
    a->quiet = 0;
    a->frozen = false;
    return cooling->fresh ? ves_annealing_round(a, restart) : VES_OK;
}

static ves_status offer(ves_annealing *a, long most)
{
    ves_session *session = a->session;
    long before = session->evaluations;
    if (most > VES_PROOFS_ROUND) most = VES_PROOFS_ROUND;
    VES_TRY(ves_session_offer(session, a->best, a->chains, most, a->refused));
    a->proofs -= session->evaluations - before;
    a->spent += session->evaluations - before;
    return VES_OK;
}

/* The chains offer their bests; who is refused goes back, who passes has a new home. One proof is kept for
 * the last round. */
ves_status ves_annealing_offer(ves_annealing *a)
{
    const ves_session *session = a->session;
    for (int k = 0; k < a->chains; k++) a->best[k] = &a->chain[k].best;
    VES_TRY(offer(a, a->proofs - 1));
    for (int k = 0; k < a->chains; k++) {
        ves_chain *chain = &a->chain[k];
        if (a->refused[k])
            ves_chain_return(chain);
        else if (chain->best.proved)
            ves_point_copy(&chain->home, &chain->best, session->n, session->m);
    }
    a->proved = a->cooling.c;
    return VES_OK;
}

/* In the place of a champion that is refused stands the home of its chain. */
ves_status ves_annealing_offer_last(ves_annealing *a)
{
    const ves_session *session = a->session;
    for (int k = 0; k < a->chains; k++) a->best[k] = &a->champion[k].point;
    VES_TRY(offer(a, a->proofs));
    for (int k = 0; k < a->chains; k++)
        if (a->refused[k]) ves_point_copy(a->best[k], &a->chain[k].home, session->n, session->m);
    return VES_OK;
}

/* Where descents ended, best first. */
static void crown_polished(ves_annealing *a, const ves_end *end, int count)
{
    const ves_session *session = a->session;
    for (int k = 0; k < a->chains && k < count; k++) {
        ves_end *champion = &a->champion[k];
        if (!ves_session_better(session, &end[k].point.verdict, &champion->point.verdict)) continue;
        ves_point_copy(&champion->point, &end[k].point, session->n, session->m);
        champion->saddle = end[k].saddle;
        champion->halt = end[k].halt;
    }
}

void ves_annealing_crown(ves_annealing *a)
{
    const ves_session *session = a->session;
    for (int k = 0; k < a->chains; k++) {
        ves_end *champion = &a->champion[k];
        const ves_point *end = ves_chain_end(&a->chain[k]);
        bool first = champion->point.verdict.status != VES_OK;
        if (!first && !ves_session_better(session, &end->verdict, &champion->point.verdict)) continue;
        ves_point_copy(&champion->point, end, session->n, session->m);
        champion->saddle = false;
        champion->halt = VES_HALT_UNKNOWN;
    }
}

/* Descents from ends, which are sorted. What the next ones may cost is kept aside: half as much again as these did;
 * so what they do not need goes back to the annealing. */
ves_status ves_annealing_polish(ves_annealing *a, ves_end *end)
{
    ves_session *session = a->session;
    ves_end *outer = session->end;
    int outer_ends = session->ends;
    const char *name = session->stage_name;
    ves_polish options = ves_polish_default();
    long before = session->evaluations, left = a->budget - a->spent - a->proofs;
    ves_search_complete_polish(session->problem, &options, a->chains);
    long budget = options.evaluations < left ? options.evaluations : left;
    if (budget < 1) return VES_OK;
    session->end = end;
    session->ends = a->chains;
    ves_session_sort(session, end, a->chains);
    ves_status status = ves_polish_run(session, &options, budget);
    if (status == VES_OK) crown_polished(a, session->end, session->ends);
    session->end = outer;
    session->ends = outer_ends;
    session->stage_name = name;
    long cost = session->evaluations - before;
    a->spent += cost;
    if (a->aside > cost + cost / 2) a->aside = cost + cost / 2;
    return status;
}

/* With `stages` the ends of each leg are polished; with `end` the best of all legs, when they are over. */
ves_status ves_annealing_leg_end(ves_annealing *a)
{
    ves_session *session = a->session;
    VES_TRY(ves_annealing_offer(a));
    ves_annealing_crown(a);
    VES_TRY(ves_annealing_peak(a, &a->cooling.peak));
    if (strcmp(a->options.polish, "stages") || ves_session_over(session)) return VES_OK;
    ves_end *end = ves_session_ends(session, a->chains);
    if (!end) return VES_MEMORY;
    for (int k = 0; k < a->chains; k++)
        ves_point_copy(&end[k].point, ves_chain_end(&a->chain[k]), session->n, session->m);
    return ves_annealing_polish(a, end);
}

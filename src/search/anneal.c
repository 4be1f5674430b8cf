#include "search/anneal.h"

#include <math.h>
#include <string.h>

/* One annealing: a population of chains that meet at the end of each round. All that is asked for is asked in rounds
 * and by proofs and descents between them; which chain does what depends on counters alone. */

enum { LEAST_DRAWS = 32, QUIET = 5, LONGEST = 1000 /* trials of a round */ };

static bool arrays_take(ves_annealing *a)
{
    ves_arena *arena = &a->session->arena;
    size_t chains = (size_t)a->chains, draws = chains * (size_t)a->draws, m = (size_t)a->session->m;
    a->chain = ves_arena_take(arena, chains, sizeof *a->chain);
    a->asker = ves_arena_take(arena, chains, sizeof *a->asker);
    a->c = ves_arena_take(arena, chains, sizeof *a->c);
    a->swaps = ves_arena_take(arena, chains, sizeof *a->swaps);
    a->best = ves_arena_take(arena, chains, sizeof *a->best);
    a->refused = ves_arena_take(arena, chains, sizeof *a->refused);
    a->ends = ves_arena_take(arena, chains, sizeof *a->ends);
    a->line = ves_arena_take(arena, chains, sizeof *a->line);
    a->value = ves_arena_take(arena, draws, sizeof(double));
    a->violation = ves_arena_take(arena, draws, sizeof(double));
    a->constraint = ves_arena_take(arena, draws * m, sizeof(double));
    a->champion = ves_session_ends(a->session, a->chains);
    return a->chain && a->asker && a->c && a->swaps && a->best && a->refused && a->ends && a->line &&
           a->value && a->violation && a->constraint && a->champion;
}

static bool chains_create(ves_annealing *a, uint32_t stream)
{
    const ves_chain_make make = {.proposal = ves_slots_proposal(a->options.proposal),
                                 .constraint = ves_slots_constraint(a->options.constraints),
                                 .step = a->options.step,
                                 .stream = stream,
                                 .cut = !a->options.fixed && !a->options.as};
    for (int k = 0; k < a->chains; k++) {
        if (!ves_chain_init(&a->chain[k], a->session, k, &make)) return false;
        a->asker[k] = &a->chain[k].asker;
    }
    a->random = (ves_random){.seed = a->session->seed, .chain = make.stream | 0xffff};
    return true;
}

/* Fewer chains only when the budget would not even move each of them once at each temperature. */
static int population(const ves_anneal *options, long budget)
{
    long most = budget / LEAST_DRAWS;
    return most < 1 ? 1 : options->chains < most ? options->chains : (int)most;
}

/* A descent may cost a fifth of the budget, until one has shown what it costs. */
static long keep_aside(const ves_annealing *a)
{
    ves_polish polish = ves_polish_default();
    if (!strcmp(a->options.polish, "none")) return 0;
    ves_search_complete_polish(a->session->problem, &polish, a->chains);
    return polish.evaluations < a->budget / 5 ? polish.evaluations : a->budget / 5;
}

bool ves_annealing_create(ves_annealing *a, ves_session *session, const ves_anneal *options, long budget,
                          uint32_t stream)
{
    *a = (ves_annealing){.session = session, .options = *options, .budget = budget, .start = session->end};
    a->starts = session->ends;
    a->schedule = ves_slots_schedule(options->schedule);
    a->population = ves_slots_population(options->population);
    a->proofs = budget / 10 < VES_PROOFS ? budget / 10 : VES_PROOFS;
    a->chains = population(options, budget);
    a->aside = keep_aside(a);
    a->cooling = (ves_cooling){.options = &a->options, .n = session->n, .chains = a->chains};
    int draws = LEAST_DRAWS + session->n;
    long affordable = budget / 5;
    if (draws > affordable) draws = (int)affordable;
    a->draws = (draws + a->chains - 1) / a->chains;
    a->step = a->population->meet && 10 * session->n < LONGEST ? 10 * session->n : LONGEST;
    a->index = session->annealings;
    return arrays_take(a) && chains_create(a, stream) && ves_annealing_enlist(a);
}

long ves_annealing_left(const ves_annealing *a)
{
    long left = a->budget - a->spent - a->proofs - a->aside;
    return left > 0 ? left / a->chains : 0;
}

bool ves_annealing_done(const ves_annealing *a)
{
    return a->phase == VES_ANNEALING_OVER;
}

ves_status ves_annealing_round(ves_annealing *a, void (*task)(void *data, int worker, int index))
{
    long before = a->session->evaluations;
    ves_status status = ves_session_round(a->session, a->asker, a->chains, task, a);
    a->spent += a->session->evaluations - before;
    return status;
}

/* --- a temperature --- */

static void cool(void *data, int worker, int index)
{
    ves_annealing *a = data;
    ves_chain *chain = &a->chain[index];
    double heat = a->c[index] / a->cooling.c0;
    long left = a->cooling.trials - a->made, trials = left < a->step ? left : a->step;
    chain->asker.worker = worker;
    chain->adapt = !a->options.fixed && !a->cooling.settled;
    for (long k = 0; k < trials; k++)
        if (ves_chain_step(chain, a->c[index], heat < 1 ? heat : 1) != VES_OK) return;
}

static ves_status one_round(ves_annealing *a)
{
    ves_session *session = a->session;
    const ves_population *population = a->population;
    ves_cooling *cooling = &a->cooling;
    double most = a->schedule->samples ? HUGE_VAL : cooling->c0;
    session->temperature = cooling->c;
    for (int k = 0; k < a->chains; k++)
        a->c[k] =
            population->temperature ? population->temperature(k, session->n, cooling->c, most) : cooling->c;
    VES_TRY(ves_annealing_round(a, cool));
    if (population->meet) population->meet(a->chain, a->chains, a->c, &a->random, a->swaps);
    a->made += a->step;
    return VES_OK;
}

/* Replicas are of one energy: that of the coldest. */
static void settle(ves_annealing *a)
{
    double heat = fmin(a->cooling.c / a->cooling.c0, 1), tolerance = a->session->tolerance;
    bool shared = a->population->meet, any = false;
    for (int k = 0; k < a->chains; k++) any = any || a->chain[k].best.verdict.violation <= tolerance;
    for (int k = 0; k < a->chains; k++) {
        ves_chain *chain = &a->chain[k];
        ves_chain_settle(chain, shared ? any : chain->best.verdict.violation <= tolerance, heat);
        if (shared && k) ves_chain_share(chain, &a->chain[0]);
    }
}

static ves_status leg_next(ves_annealing *a)
{
    bool begun;
    VES_TRY(ves_annealing_leg_end(a));
    if (ves_session_over(a->session)) return VES_OK;
    a->cooling.leg++;
    VES_TRY(ves_annealing_leg_begin(a, &begun));
    if (!begun) a->phase = VES_ANNEALING_OVER;
    return VES_OK;
}

/* Bests are proved when the temperature has halved since the last time: a proof may cost as much as a thousand
 * candidates, and at high temperatures the next best is soon there. */
static ves_status temperature_end(ves_annealing *a)
{
    ves_session *session = a->session;
    ves_temperature seen;
    VES_TRY(ves_annealing_log(a, &seen));
    a->quiet = seen.accepted ? 0 : a->quiet + 1;
    a->frozen = a->quiet >= QUIET && !a->schedule->samples && !a->schedule->steers;
    a->report.c = a->cooling.c;
    a->made = 0;
    bool on = a->schedule->next(&a->cooling, &seen) && !a->frozen;
    settle(a);
    if (seen.c <= 0.5 * a->proved) VES_TRY(ves_annealing_offer(a));
    ves_session_progress(session);
    return on || ves_session_over(session) ? VES_OK : leg_next(a);
}

/* --- the whole --- */

static ves_status warm(ves_annealing *a)
{
    bool begun;
    VES_TRY(ves_annealing_warm(a));
    a->phase = VES_ANNEALING_COOL;
    if (ves_session_over(a->session)) return VES_OK;
    VES_TRY(ves_annealing_leg_begin(a, &begun));
    if (!begun) a->phase = VES_ANNEALING_OVER;
    return VES_OK;
}

static ves_status unit(ves_annealing *a)
{
    if (a->phase == VES_ANNEALING_WARM) return warm(a);
    VES_TRY(one_round(a));
    return a->made >= a->cooling.trials ? temperature_end(a) : VES_OK;
}

ves_status ves_annealing_advance(ves_annealing *a, long evaluations)
{
    long until = a->spent + evaluations;
    while (a->phase != VES_ANNEALING_OVER && a->spent < until && !ves_session_over(a->session))
        VES_TRY(unit(a));
    return a->session->fault;
}

static void tell_stop(ves_annealing *a)
{
    ves_session *session = a->session;
    const ves_cooling *cooling = &a->cooling;
    bool cools = !a->schedule->samples && cooling->c_end < cooling->c0;
    if (a->frozen)
        ves_session_stop(session, VES_ENDED_DONE,
                         "anneal: frozen, nothing was accepted at the last %d temperatures", QUIET);
    else if (cooling->cold && cools)
        ves_session_stop(session, VES_ENDED_DONE, "anneal: frozen, the temperature fell to %.3g of the first",
                         a->report.c / cooling->c0);
    else
        ves_session_stop(session, VES_ENDED_BUDGET, "anneal: its budget of %ld evaluation%s is spent",
                         a->budget, a->budget == 1 ? "" : "s");
    if (cools && !cooling->cold && !a->frozen)
        ves_session_note(
            session,
            "the annealing budget was too short: the temperature fell to %.3g of the first only, not to %.3g",
            a->report.c / cooling->c0, cooling->c_end / cooling->c0);
}

/* What was stopped on its way ends where it is. */
ves_status ves_annealing_close(ves_annealing *a)
{
    ves_session *session = a->session;
    if (a->phase == VES_ANNEALING_WARM) return VES_OK;
    if (!ves_annealing_done(a)) ves_annealing_crown(a);
    VES_TRY(ves_annealing_offer_last(a));
    if (!strcmp(a->options.polish, "end") && !ves_session_over(session))
        VES_TRY(ves_annealing_polish(a, a->champion));
    if (ves_annealing_done(a)) tell_stop(a);
    session->temperature = session->acceptance = NAN;
    return ves_annealing_tell(a);
}

void ves_annealing_destroy(ves_annealing *a)
{
    for (int k = 0; a->asker && k < a->chains; k++)
        if (a->asker[k]) ves_asker_destroy(a->asker[k]);
}

ves_status ves_anneal_run(ves_session *session, const ves_anneal *options, long budget)
{
    ves_annealing a;
    uint32_t stream = ves_session_stream(session->stage_index, 0);
    session->stage_name = "anneal";
    ves_status status = ves_annealing_create(&a, session, options, budget, stream) ? VES_OK : VES_MEMORY;
    if (status == VES_OK) status = ves_annealing_advance(&a, budget);
    if (status == VES_OK) status = ves_annealing_close(&a);
    ves_annealing_destroy(&a);
    if (status != VES_OK || a.phase == VES_ANNEALING_WARM) return status;
    ves_session_sort(session, a.champion, a.chains);
    session->end = a.champion;
    session->ends = a.chains;
    return VES_OK;
}

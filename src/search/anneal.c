#include <math.h>
#include <string.h>

#include "search/chain.h"
#include "search/schedule/schedule.h"

/* One annealing stage: a population of independent chains that meet at the end of each temperature. */

enum { LEAST_DRAWS = 32, QUIET = 5 };

typedef struct anneal {
    ves_session *session;
    const ves_anneal *options;
    const ves_schedule *schedule;
    ves_cooling cooling;
    long budget, before; /* session->evaluations when the stage began */
    int chains;
    ves_chain *chain;
    int draws;                 /* of each chain in the warm-up */
    double *value, *violation; /* [chains][draws]; NAN: not measured */
    double c;
    int quiet;         /* temperatures without an acceptance */
    double proved;     /* temperature of the last round of proofs */
    long proofs;       /* that may still be asked for */
    ves_asker **asker; /* [chains] theirs */
    ves_point **best;
    bool *refused;
} anneal;

static bool create(anneal *a)
{
    ves_arena *arena = &a->session->arena;
    size_t chains = (size_t)a->chains, draws = (size_t)a->draws;
    a->chain = ves_arena_take(arena, chains, sizeof *a->chain);
    a->value = ves_arena_take(arena, chains * draws, sizeof(double));
    a->violation = ves_arena_take(arena, chains * draws, sizeof(double));
    a->asker = ves_arena_take(arena, chains, sizeof *a->asker);
    a->best = ves_arena_take(arena, chains, sizeof *a->best);
    a->refused = ves_arena_take(arena, chains, sizeof *a->refused);
    if (!a->chain || !a->value || !a->violation || !a->asker || !a->best || !a->refused) return false;
    for (int k = 0; k < a->chains; k++) {
        if (!ves_chain_init(&a->chain[k], a->session, k, a->options)) return false;
        a->asker[k] = &a->chain[k].asker;
    }
    return true;
}

static void explore(void *data, int worker, int index)
{
    anneal *a = data;
    ves_chain *chain = &a->chain[index];
    chain->asker.worker = worker;
    for (int d = 0; d < a->draws; d++) {
        ves_status status = ves_chain_explore(chain, &a->session->end[0].point);
        const ves_verdict *verdict = &chain->candidate.verdict;
        bool measured = status == VES_OK && verdict->status == VES_OK;
        a->value[index * a->draws + d] = measured ? verdict->value : NAN;
        a->violation[index * a->draws + d] = measured ? verdict->violation : NAN;
    }
}

/* Sorts, leaving out what is not a number; returns how many are left. */
static int sorted(double *value, int count)
{
    int kept = 0;
    for (int k = 0; k < count; k++) {
        double v = value[k];
        if (isnan(v)) continue;
        int j = kept++;
        for (; j && value[j - 1] > v; j--) value[j] = value[j - 1];
        value[j] = v;
    }
    return kept;
}

/* The spread below the median, as a standard deviation of a normal: the half that a minimiser will live in,
 * and deaf to the long upper tail of extreme shapes. */
static double spread(double *value, int count)
{
    int kept = sorted(value, count);
    if (!kept) return 0;
    double width = (value[kept / 2] - value[kept / 4]) / 0.6745;
    return width > 0 ? width : (value[kept - 1] - value[0]) / 4;
}

static double median_violation(double *violation, int count, double tolerance)
{
    int kept = sorted(violation, count), first = 0;
    while (first < kept && violation[first] <= tolerance) first++;
    return first < kept ? violation[first + (kept - first) / 2] : 0;
}

static void place(anneal *a, double weight, double margin)
{
    const ves_session *session = a->session;
    for (int k = 0; k < a->chains; k++) {
        ves_chain *chain = &a->chain[k];
        chain->weight = weight;
        chain->margin = margin;
        chain->heaviest = a->options->weight == 0 ? 1e8 * weight : weight;
        bool taken = session->ends > 1 || k == 0 || chain->best.verdict.status != VES_OK;
        ves_chain_place(chain, taken ? &session->end[k % session->ends].point : NULL);
    }
}

/* First temperature and penalty from the data. A step of a tenth of the box changes f by some tenths of its
 * spread over the box: at a first temperature of 0.3 spreads most uphill steps are accepted. A violation as
 * large as the middle one costs two spreads. */
static ves_status warm(anneal *a)
{
    ves_session *session = a->session;
    const ves_anneal *options = a->options;
    bool needed = options->c0 == 0 || (session->m && options->weight == 0);
    int count = needed ? a->chains * a->draws : 0;
    if (needed) VES_TRY(ves_session_round(session, a->asker, a->chains, explore, a));
    double width = spread(a->value, count);
    double typical = median_violation(a->violation, count, session->tolerance);
    if (!(width > 0)) width = fmax(1e-3 * fabs(session->end[0].point.verdict.value), 1e-12);
    double weight =
        options->weight > 0 ? options->weight : 2 * width / (typical > 0 ? typical : session->usual);
    double c0 = options->c0 > 0 ? options->c0 : 0.3 * width;
    session->spread = width;
    for (int j = 0; j < session->m; j++) session->price[j] = fmax(session->price[j], weight);
    place(a, weight, width);
    long left = a->budget - (session->evaluations - a->before) - a->proofs;
    a->schedule->init(options, c0, session->n, left / a->chains, &a->cooling);
    return VES_OK;
}

static void cool(void *data, int worker, int index)
{
    anneal *a = data;
    ves_chain *chain = &a->chain[index];
    chain->asker.worker = worker;
    for (long k = 0; k < a->cooling.trials; k++)
        if (ves_chain_step(chain, a->c) != VES_OK) return;
}

static bool log_grow(ves_session *session)
{
    if (session->temperatures < session->temperature_room) return true;
    int room = session->temperature_room ? 2 * session->temperature_room : 64;
    ves_temperature *grown = ves_memory_grow(session->temperature_log, (size_t)room * sizeof *grown);
    if (!grown) return false;
    session->temperature_log = grown;
    session->temperature_room = room;
    return true;
}

/* Pools the chains' statistics of one temperature. */
static ves_status log_temperature(anneal *a)
{
    ves_session *session = a->session;
    if (!log_grow(session)) return VES_MEMORY;
    ves_temperature t = {.stage = session->stage_index, .c = a->c};
    for (int k = 0; k < a->chains; k++) {
        const ves_chain *chain = &a->chain[k];
        if (!chain->trials) continue;
        double trials = (double)chain->trials, delta = chain->mean - t.mean;
        double all = (double)t.trials + trials;
        t.variance += chain->square + delta * delta * (double)t.trials * trials / all;
        t.mean += delta * trials / all;
        t.trials += chain->trials;
        t.accepted += chain->accepted;
    }
    if (t.trials) t.variance /= (double)t.trials;
    session->acceptance = t.trials ? (double)t.accepted / (double)t.trials : NAN;
    a->quiet = t.accepted ? 0 : a->quiet + 1;
    session->temperature_log[session->temperatures++] = t;
    return VES_OK;
}

/* The chains offer their bests; who is refused goes back, who passes has a new home. One proof is kept for
 * the last round. */
static ves_status offer(anneal *a, bool last)
{
    ves_session *session = a->session;
    long before = session->evaluations, most = last ? a->proofs : a->proofs - 1;
    for (int k = 0; k < a->chains; k++) a->best[k] = &a->chain[k].best;
    if (most > VES_PROOFS_ROUND) most = VES_PROOFS_ROUND;
    VES_TRY(ves_session_offer(session, a->best, a->chains, most, a->refused));
    a->proofs -= session->evaluations - before;
    for (int k = 0; k < a->chains; k++) {
        ves_chain *chain = &a->chain[k];
        if (a->refused[k])
            ves_chain_return(chain);
        else if (chain->best.proved)
            ves_point_copy(&chain->home, &chain->best, session->n, session->m);
    }
    a->proved = a->c;
    return VES_OK;
}

/* One temperature. Bests are proved when the temperature has halved since the last time: a proof may cost as
 * much as a thousand candidates, and at high temperatures the next best is soon there. */
static ves_status temperature(anneal *a, int m)
{
    ves_session *session = a->session;
    a->c = session->temperature = a->schedule->temperature(&a->cooling, m);
    VES_TRY(ves_session_round(session, a->asker, a->chains, cool, a));
    VES_TRY(log_temperature(a));
    for (int k = 0; k < a->chains; k++) ves_chain_settle(&a->chain[k]);
    if (a->c <= 0.5 * a->proved) VES_TRY(offer(a, false));
    ves_session_progress(session);
    return VES_OK;
}

static ves_status lower(anneal *a)
{
    ves_session *session = a->session;
    const ves_cooling *cooling = &a->cooling;
    double frozen = cooling->c_end * (1 + 1e-9);
    a->proved = cooling->c0;
    for (int m = 0; m < cooling->temperatures; m++) {
        VES_TRY(temperature(a, m));
        if (ves_session_over(session)) return VES_OK;
        if (a->c <= frozen && cooling->s < 1 && a->options->c_end < 1) {
            ves_session_stop(session, VES_ENDED_DONE, "anneal: frozen, the temperature fell to %.3g", a->c);
            return VES_OK;
        }
        if (a->quiet >= QUIET) {
            ves_session_stop(session, VES_ENDED_DONE,
                             "anneal: frozen, nothing was accepted at the last %d temperatures", QUIET);
            return VES_OK;
        }
    }
    ves_session_stop(session, VES_ENDED_BUDGET, "anneal: its budget of %ld evaluation%s is spent", a->budget,
                     a->budget == 1 ? "" : "s");
    if (a->options->c_end < 1)
        ves_session_note(
            session,
            "the annealing budget was too short: the temperature fell from %.3g to %.3g only, not to %.3g",
            cooling->c0, a->c, cooling->c_end);
    return VES_OK;
}

static ves_status finish(anneal *a)
{
    ves_session *session = a->session;
    VES_TRY(offer(a, true));
    ves_end *end = ves_session_ends(session, a->chains);
    if (!end) return VES_MEMORY;
    for (int k = 0; k < a->chains; k++)
        ves_point_copy(&end[k].point, ves_chain_end(&a->chain[k]), session->n, session->m);
    ves_session_sort(session, end, a->chains);
    session->end = end;
    session->ends = a->chains;
    return VES_OK;
}

/* Fewer chains only when the budget would not even move each of them once at each temperature. */
static int population(const ves_anneal *options, long budget)
{
    long most = budget / LEAST_DRAWS;
    return most < 1 ? 1 : options->chains < most ? options->chains : (int)most;
}

ves_status ves_anneal_run(ves_session *session, const ves_anneal *options, long budget)
{
    anneal a = {
        .session = session, .options = options, .schedule = &ves_schedule_exponential, .budget = budget};
    a.before = session->evaluations;
    a.proofs = budget / 10 < VES_PROOFS ? budget / 10 : VES_PROOFS;
    a.chains = population(options, budget);
    int draws = LEAST_DRAWS + session->n;
    long affordable = budget / 5;
    if (draws > affordable) draws = (int)affordable;
    a.draws = (draws + a.chains - 1) / a.chains;
    session->stage_name = "anneal";
    if (!create(&a)) return VES_MEMORY;
    ves_status status = warm(&a);
    if (status == VES_OK && !ves_session_over(session)) status = lower(&a);
    if (status == VES_OK) status = finish(&a);
    for (int k = 0; k < a.chains; k++) ves_asker_destroy(&a.chain[k].asker);
    session->temperature = session->acceptance = NAN;
    return status;
}

#include <math.h>

#include "search/anneal.h"

/* What an annealing says of itself. */

/* Chains that end further apart than this part of the fall of the mean energy froze in different places; the mean
 * energy is frozen when this part of its fall is left. */
static const double little = 0.01;

bool ves_annealing_enlist(ves_annealing *a)
{
    ves_session *session = a->session;
    const ves_anneal *options = &a->options;
    if (session->annealings == session->annealing_room) {
        int room = session->annealing_room ? 2 * session->annealing_room : 8;
        ves_annealing_report *grown = ves_memory_grow(session->annealing_log, (size_t)room * sizeof *grown);
        if (!grown) return false;
        session->annealing_log = grown;
        session->annealing_room = room;
    }
    a->report = (ves_annealing_report){.stage = session->stage_index,
                                       .proposal = options->proposal,
                                       .schedule = options->schedule,
                                       .population = options->population,
                                       .constraints = options->constraints,
                                       .polish = options->polish,
                                       .chains = a->chains,
                                       .moves = a->chain[0].moves,
                                       .freezing = NAN,
                                       .peak = NAN,
                                       .least_swap = NAN,
                                       .apart = NAN,
                                       .health = VES_HEALTH_STOPPED,
                                       .sentence = "stopped on its way"};
    for (int k = 0; k < a->report.moves; k++) a->report.move[k] = a->chain[0].move[k].proposal->name;
    session->annealing_log[session->annealings++] = a->report;
    return true;
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

/* Means and squared deviations of two samples are those of both together (Chan, Golub and LeVeque 1983). */
static void pool(const ves_annealing *a, const ves_chain *chain, ves_temperature *t)
{
    int n = a->session->n;
    if (!chain->trials) return;
    double trials = (double)chain->trials, delta = chain->mean - t->mean, all = (double)t->trials + trials;
    t->variance += chain->square + delta * delta * (double)t->trials * trials / all;
    t->mean += delta * trials / all;
    t->trials += chain->trials;
    t->accepted += chain->accepted;
    for (int k = 0; k < chain->moves; k++) {
        const ves_move *move = &chain->move[k];
        ves_move_count *count = &t->move[k];
        count->trials += move->trials;
        count->accepted += move->accepted;
        if (move->proposal->width) count->width += move->proposal->width(n, move->state);
    }
}

ves_status ves_annealing_log(ves_annealing *a)
{
    ves_session *session = a->session;
    if (!log_grow(session)) return VES_MEMORY;
    ves_temperature t = {
        .stage = session->stage_index, .annealing = a->index, .leg = a->cooling.leg, .c = a->cooling.c};
    int counted = a->population->meet ? 1 : a->chains;
    for (int k = 0; k < a->chains; k++) a->ends[k] = a->chain[k].mean;
    for (int k = 0; k < counted; k++) pool(a, &a->chain[k], &t);
    if (t.trials) t.variance /= (double)t.trials;
    for (int k = 0; k < VES_MOVES; k++) {
        t.move[k].width /= counted;
        a->report.count[k].trials += t.move[k].trials;
        a->report.count[k].accepted += t.move[k].accepted;
        a->report.count[k].width = t.move[k].width;
    }
    session->acceptance = t.trials ? (double)t.accepted / (double)t.trials : NAN;
    session->temperature_log[session->temperatures++] = t;
    return VES_OK;
}

/* Freezing and the peak of the heat capacity, from the temperatures of the last leg; returns the fall of the mean
 * energy in it. */
static double look_back(ves_annealing *a)
{
    const ves_session *session = a->session;
    const ves_temperature *last = NULL, *first = NULL;
    double most = 0;
    for (int k = session->temperatures - 1; k >= 0; k--) {
        const ves_temperature *t = &session->temperature_log[k];
        if (t->annealing != a->index || !t->trials) continue;
        if (last && t->leg != last->leg) break;
        first = t;
        if (!last) last = t;
        double capacity = t->variance / (t->c * t->c);
        if (capacity > most) most = capacity, a->report.peak = t->c;
    }
    double fall = last ? first->mean - last->mean : 0;
    for (int k = session->temperatures - 1; k >= 0 && fall > 0; k--) {
        const ves_temperature *t = &session->temperature_log[k];
        if (t->annealing != a->index || t->leg != last->leg) continue;
        if (t->mean - last->mean > little * fall) break;
        a->report.freezing = t->c;
    }
    return fall;
}

static void look_at_swaps(ves_annealing *a)
{
    ves_annealing_report *r = &a->report;
    for (int k = 0; k + 1 < a->chains; k++) {
        const ves_swaps *s = &a->swaps[k];
        if (!s->tried) continue;
        r->swaps += s->tried;
        r->swapped += s->done;
        double part = (double)s->done / (double)s->tried;
        if (!(part >= r->least_swap)) r->least_swap = part;
    }
}

static void look_at_ends(ves_annealing *a, double fall)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    if (a->chains < 2 || a->population->meet || !(fall > 0)) return;
    for (int k = 0; k < a->chains; k++) {
        low = fmin(low, a->ends[k]);
        high = fmax(high, a->ends[k]);
    }
    a->report.apart = (high - low) / fall;
}

static ves_health judge(const ves_annealing *a)
{
    if (!ves_annealing_done(a)) return VES_HEALTH_STOPPED;
    if (a->schedule->samples || a->cooling.c_end >= a->cooling.c0) return VES_HEALTH_SAMPLED;
    if (!a->cooling.cold && !a->frozen) return VES_HEALTH_SHORT;
    return a->report.apart > little ? VES_HEALTH_UNEVEN : VES_HEALTH_FROZEN;
}

static const char *sentence(const ves_annealing *a)
{
    const ves_annealing_report *r = &a->report;
    ves_arena *arena = &a->session->kept;
    switch (r->health) {
    case VES_HEALTH_FROZEN:
        if (isnan(r->apart)) return "frozen";
        return ves_arena_format(arena, "frozen: the chains end within %.2g %% of the fall of the mean energy",
                                100 * r->apart);
    case VES_HEALTH_UNEVEN:
        return ves_arena_format(arena,
                                "not equilibrated: the chains froze %.2g %% of the fall of the mean energy "
                                "apart; more evaluations, tempering or a polish would help",
                                100 * r->apart);
    case VES_HEALTH_SHORT:
        return ves_arena_format(arena, "budget too short: the temperature fell to %.3g of %.3g only", r->c,
                                a->cooling.c_end);
    case VES_HEALTH_SAMPLED:
        return "sampled: the temperature was not lowered";
    default:
        return r->sentence;
    }
}

ves_status ves_annealing_tell(ves_annealing *a)
{
    look_at_ends(a, look_back(a));
    look_at_swaps(a);
    a->report.health = judge(a);
    a->report.sentence = sentence(a);
    if (!a->report.sentence) return VES_MEMORY;
    a->session->annealing_log[a->index] = a->report;
    return VES_OK;
}

#include <math.h>

#include "search/anneal.h"
#include "search/spread.h"

/* What an annealing says of itself. */

/* Chains that end further apart than this part of the fall of the mean energy froze in different places; the mean
 * energy is frozen when this part of its fall is left. */
static const double little = 0.01;

/* Of heat capacities a line counts as so many times the median at most; and a peak is so many times as high as where
 * all is frozen. */
static const double stray = 2, outstanding = 1.5;

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
static void join(ves_sample *all, const ves_chain *chain)
{
    double trials = (double)chain->trials, before = (double)all->trials, delta = chain->mean - all->mean;
    if (!chain->trials) return;
    all->square += chain->square + delta * delta * before * trials / (before + trials);
    all->mean += delta * trials / (before + trials);
    all->trials += chain->trials;
}

/* Temperatures that stand together are one. */
static void add(const ves_annealing *a, const ves_chain *chain, ves_temperature *t)
{
    double heat = fmin(a->cooling.c / a->cooling.c0, 1);
    t->trials += chain->trials;
    t->accepted += chain->accepted;
    for (int k = 0; k < chain->moves; k++) {
        const ves_move *move = &chain->move[k];
        ves_move_count *count = &t->move[k];
        count->trials += move->trials;
        count->accepted += move->accepted;
        if (move->proposal->width) count->width += move->proposal->width(a->session->n, heat, move->state);
    }
}

static void count(ves_annealing *a, const ves_temperature *seen, ves_temperature *t)
{
    t->c = seen->c;
    t->steps = ++a->held;
    t->trials += seen->trials;
    t->accepted += seen->accepted;
    for (int k = 0; k < VES_MOVES; k++) {
        ves_move_count *const both[] = {&t->move[k], &a->report.count[k]};
        for (int b = 0; b < 2; b++) {
            both[b]->trials += seen->move[k].trials;
            both[b]->accepted += seen->move[k].accepted;
            both[b]->width = seen->move[k].width;
        }
    }
}

/* Chains that sit in different places differ by their means for ever: heat capacities are of what each does. */
static void look_at_line(const ves_annealing *a, int counted, ves_temperature *t)
{
    double sum = 0, square = 0;
    for (int k = 0; k < counted; k++) {
        sum += a->line[k].mean * (double)a->line[k].trials;
        square += a->line[k].square;
    }
    if (!t->trials) return;
    t->mean = sum / (double)t->trials;
    t->variance = square / (double)t->trials;
}

ves_status ves_annealing_log(ves_annealing *a, ves_temperature *seen)
{
    ves_session *session = a->session;
    int counted = a->population->meet ? 1 : a->chains;
    *seen = (ves_temperature){
        .stage = session->stage_index, .annealing = a->index, .leg = a->cooling.leg, .c = a->cooling.c};
    if (a->held == a->most) a->held = 0;
    if (!a->held) {
        if (!log_grow(session)) return VES_MEMORY;
        a->row = session->temperatures++;
        session->temperature_log[a->row] = *seen;
        for (int k = 0; k < counted; k++) a->line[k] = (ves_sample){0};
    }
    for (int k = 0; k < a->chains; k++) a->ends[k] = a->chain[k].mean;
    for (int k = 0; k < counted; k++) {
        add(a, &a->chain[k], seen);
        join(&a->line[k], &a->chain[k]);
    }
    for (int k = 0; k < VES_MOVES; k++) seen->move[k].width /= counted;
    ves_temperature *t = &session->temperature_log[a->row];
    count(a, seen, t);
    look_at_line(a, counted, t);
    session->acceptance = seen->trials ? (double)seen->accepted / (double)seen->trials : NAN;
    return VES_OK;
}

/* The lines of one leg, those of other annealings left out: the next one after k. */
static const ves_temperature *line_after(const ves_annealing *a, int leg, int *k)
{
    const ves_session *session = a->session;
    for (++*k; *k < session->temperatures; ++*k) {
        const ves_temperature *t = &session->temperature_log[*k];
        if (t->annealing == a->index && t->leg == leg && t->trials) return t;
    }
    return NULL;
}

/* Where the mean energy of a leg is frozen, and how far it fell in all. */
static double freezing_of(const ves_annealing *a, int leg, double *fall)
{
    const ves_temperature *first = NULL, *last = NULL, *t;
    double c = NAN;
    for (int k = -1; (t = line_after(a, leg, &k)); last = t)
        if (!first) first = t;
    *fall = first ? first->mean - last->mean : 0;
    if (!(*fall > 0)) return NAN;
    for (int k = -1; (t = line_after(a, leg, &k));) {
        bool above = t->mean - last->mean > little * *fall;
        if (above || isnan(c)) c = above ? NAN : t->c;
    }
    return c;
}

double ves_heat_capacity(const ves_temperature *line, int lines, int annealing, double low, double high,
                         double *scratch)
{
    double most = HUGE_VAL, sum = 0, trials = 0;
    for (int pass = 0; pass < 2; pass++) {
        int count = 0;
        for (int k = 0; k < lines; k++) {
            const ves_temperature *t = &line[k];
            if (t->annealing != annealing || !t->trials || t->c < low || t->c > high) continue;
            scratch[count] = t->variance / (t->c * t->c);
            if (pass) sum += (double)t->trials * fmin(scratch[count], most), trials += (double)t->trials;
            count++;
        }
        if (!pass) most = stray * ves_median_above(scratch, count, 0);
    }
    return trials > 0 ? sum / trials : 0;
}

static double capacity(const ves_annealing *a, double low, double high, double *scratch)
{
    const ves_session *session = a->session;
    return ves_heat_capacity(session->temperature_log, session->temperatures, a->index, low, high, scratch);
}

/* The first leg goes through all temperatures. Where chains have frozen, heat capacities are those of the bottoms of
 * their basins, n / 2 at any temperature: a peak stands out above that. Where they are largest within reach of the hottest
 * temperature they may still rise beyond it, and nobody has seen them fall: that is an edge. */
ves_status ves_annealing_peak(const ves_annealing *a, double *peak)
{
    ves_session *session = a->session;
    const ves_temperature *t;
    double fall, frozen = freezing_of(a, 0, &fall);
    double *scratch = ves_arena_take(&session->arena, (size_t)session->temperatures, sizeof *scratch);
    if (!scratch) return VES_MEMORY;
    double most = outstanding * capacity(a, 0, frozen, scratch);
    double hottest = 0;
    *peak = 0;
    for (int k = -1; (t = line_after(a, 0, &k)) && t->c > frozen;) {
        double here = capacity(a, t->c / VES_HEAT_REACH, t->c * VES_HEAT_REACH, scratch);
        if (here > most) most = here, *peak = t->c;
        hottest = fmax(hottest, t->c);
    }
    if (*peak * VES_HEAT_REACH > hottest) *peak = 0;
    return VES_OK;
}

/* A last leg that was stopped before it had a temperature tells nothing. */
static ves_status look_back(ves_annealing *a, double *fall)
{
    int none = -1, leg = a->cooling.leg;
    double peak = 0;
    if (!a->schedule->samples) VES_TRY(ves_annealing_peak(a, &peak));
    while (leg && !line_after(a, leg, &none)) leg--, none = -1;
    a->report.peak = peak > 0 ? peak : NAN;
    a->report.freezing = freezing_of(a, leg, fall);
    return VES_OK;
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
        return ves_arena_format(
            arena, "budget too short: the temperature fell to %.3g of the first only, not to %.3g",
            r->c / a->cooling.c0, a->cooling.c_end / a->cooling.c0);
    case VES_HEALTH_SAMPLED:
        return "sampled: the temperature was not lowered";
    default:
        return r->sentence;
    }
}

ves_status ves_annealing_tell(ves_annealing *a)
{
    double fall;
    VES_TRY(look_back(a, &fall));
    look_at_ends(a, fall);
    look_at_swaps(a);
    a->report.health = judge(a);
    a->report.sentence = sentence(a);
    if (!a->report.sentence) return VES_MEMORY;
    a->session->annealing_log[a->index] = a->report;
    return VES_OK;
}

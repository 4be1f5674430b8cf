#include <math.h>
#include <string.h>

#include "search/descent.h"
#include "search/strategy/strategy.h"

/* Lines: a search of the whole range along each coordinate from one point, all coordinates at once, and the best
 * of them put together. Where the coordinates do not feel each other one sweep finds the best of all basins in n
 * times what one coordinate costs; where they do, the sweeps end soon. A line is sampled evenly from a random
 * offset, then its lowest brackets are narrowed by golden sections. In the spirit of STEP [Swarzberg, Seront and
 * Bersini 1994], which the strongest portfolios for black boxes hold beside CMA-ES [Loshchilov, Schoenauer and
 * Sebag 2013].
 * test  tests/search_strategy.c */

enum { SAMPLES = 24, SAMPLES_MOST = 384, BRACKETS = 4, SECTIONS = 8 };

static const double golden = 0.6180339887498949;
static const double settled = 1e-3; /* of what the sweeps have gained since the start */

typedef struct line {
    ves_asker asker;
    ves_point trial, best;
    double energy;               /* of best */
    double sample[SAMPLES_MOST]; /* energies */
    double at[SAMPLES_MOST];
} line;

typedef struct lines {
    ves_team *team;
    ves_session *session;
    uint32_t stream;
    ves_polish options;
    line *line; /* [n] */
    ves_asker **asker;
    ves_descent descent;
    ves_asker *descent_asker;
    ves_point base, joint, end;
    double energy, first; /* of base; of the first one since the last start */
    int samples, *order;
    long sweeps, starts;
    bool begun, swept;
} lines;

static void *create(ves_team *team, uint32_t stream)
{
    ves_session *session = team->session;
    ves_arena *arena = &session->arena;
    size_t n = (size_t)session->n;
    lines *l = ves_arena_take(arena, 1, sizeof *l);
    if (!l) return NULL;
    *l = (lines){.team = team, .session = session, .stream = stream, .samples = SAMPLES};
    l->options = ves_descent_quick(session, session->problem->gradients);
    l->line = ves_arena_take(arena, n, sizeof *l->line);
    l->asker = ves_arena_take(arena, n, sizeof *l->asker);
    l->order = ves_arena_take(arena, n, sizeof *l->order);
    if (!l->line || !l->asker || !l->order) return NULL;
    for (int i = 0; i < session->n; i++) {
        ves_asker_init(&l->line[i].asker, session, i);
        l->asker[i] = &l->line[i].asker;
        if (!ves_point_create(arena, session->n, session->m, &l->line[i].trial)) return NULL;
        if (!ves_point_create(arena, session->n, session->m, &l->line[i].best)) return NULL;
    }
    ves_point *all[] = {&l->base, &l->joint, &l->end};
    for (int k = 0; k < 3; k++)
        if (!ves_point_create(arena, session->n, session->m, all[k])) return NULL;
    if (!ves_descent_create(&l->descent, session, 0, &l->options, 0)) return NULL;
    l->descent.runs = 1;
    l->descent_asker = &l->descent.asker;
    return l;
}

static void destroy(void *state)
{
    lines *l = state;
    for (int i = 0; i < l->session->n; i++) ves_asker_destroy(&l->line[i].asker);
    ves_descent_destroy(&l->descent);
}

static double energy(const lines *l, const ves_point *point)
{
    return ves_verdict_energy(&point->verdict, l->team->weight, l->session->tolerance);
}

static ves_status judge(const lines *l, ves_asker *asker, ves_point *point, double *e)
{
    ves_ask ask = {.x = point->x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    point->proved = false;
    VES_TRY(ves_asker_judge(asker, &ask, &point->verdict));
    *e = energy(l, point);
    return VES_OK;
}

/* --- one line --- */

/* The energy at u_i = t; keeps the best. */
static ves_status look(lines *l, int i, double t, double *e)
{
    line *it = &l->line[i];
    it->trial.u[i] = t < 0 ? 0 : t > 1 ? 1 : t;
    it->trial.x[i] = ves_point_scale(l->session->problem, i, it->trial.u[i]);
    VES_TRY(judge(l, &it->asker, &it->trial, e));
    bool better = *e < it->energy;
    ves_asker_record(&it->asker, false, NAN, better);
    if (!better) return VES_OK;
    it->energy = *e;
    ves_point_copy(&it->best, &it->trial, l->session->n, l->session->m);
    return VES_OK;
}

static ves_status narrow(lines *l, int i, double a, double b)
{
    double p = b - golden * (b - a), q = a + golden * (b - a), fp, fq;
    VES_TRY(look(l, i, p, &fp));
    VES_TRY(look(l, i, q, &fq));
    for (int k = 2; k < SECTIONS; k++) {
        if (fp < fq) {
            b = q, q = p, fq = fp, p = b - golden * (b - a);
            VES_TRY(look(l, i, p, &fp));
        } else {
            a = p, p = q, fp = fq, q = a + golden * (b - a);
            VES_TRY(look(l, i, q, &fq));
        }
    }
    return VES_OK;
}

/* The lowest sample that no neighbour undercuts, among those above `floor`; -1: none. */
static int lowest(const lines *l, const line *it, const bool *used)
{
    int best = -1;
    for (int k = 0; k < l->samples; k++) {
        double e = it->sample[k];
        if (used[k] || !(e < HUGE_VAL) || (k && it->sample[k - 1] < e) ||
            (k + 1 < l->samples && it->sample[k + 1] < e))
            continue;
        if (best < 0 || e < it->sample[best]) best = k;
    }
    return best;
}

static ves_status search_line(lines *l, int i)
{
    line *it = &l->line[i];
    bool used[SAMPLES_MOST] = {false};
    ves_random random = {.seed = l->session->seed,
                         .chain = l->stream + (uint32_t)i % 255,
                         .step = (uint64_t)l->sweeps << 20 | (uint64_t)i};
    double offset = ves_random_uniform(&random), width = 1.0 / l->samples;
    ves_point_copy(&it->trial, &l->base, l->session->n, l->session->m);
    ves_point_copy(&it->best, &l->base, l->session->n, l->session->m);
    it->energy = l->energy;
    for (int k = 0; k < l->samples; k++) {
        it->at[k] = (k + offset) * width;
        VES_TRY(look(l, i, it->at[k], &it->sample[k]));
    }
    for (int k, b = 0; b < BRACKETS && (k = lowest(l, it, used)) >= 0; b++) {
        used[k] = true;
        VES_TRY(narrow(l, i, it->at[k] - width, it->at[k] + width));
    }
    return VES_OK;
}

static void run(void *data, int worker, int index)
{
    lines *l = data;
    l->line[index].asker.worker = worker;
    (void)search_line(l, index); /* a fault stands in the asker */
}

/* --- all together --- */

static void by_gain(lines *l)
{
    for (int i = 0; i < l->session->n; i++) {
        int j = i;
        for (; j && l->line[i].energy < l->line[l->order[j - 1]].energy; j--) l->order[j] = l->order[j - 1];
        l->order[j] = i;
    }
}

static void step(const lines *l, ves_point *point, int i)
{
    point->u[i] = l->line[i].best.u[i];
    point->x[i] = l->line[i].best.x[i];
}

/* All steps at once; where that is no better than the best of them, one after the other, the best first, those
 * that help. */
static ves_status join(lines *l)
{
    const int n = l->session->n, m = l->session->m;
    double e;
    ves_asker asker;
    ves_asker_init(&asker, l->session, 0);
    by_gain(l);
    const line *first = &l->line[l->order[0]];
    ves_point_copy(&l->joint, &l->base, n, m);
    for (int i = 0; i < n; i++) step(l, &l->joint, i);
    ves_status status = judge(l, &asker, &l->joint, &e);
    if (status == VES_OK) ves_asker_record(&asker, false, NAN, e < first->energy);
    if (status == VES_OK && !(e < first->energy)) {
        ves_point_copy(&l->base, &first->best, n, m);
        l->energy = first->energy;
        for (int k = 1; k < n && status == VES_OK; k++) {
            int i = l->order[k];
            if (!(l->line[i].best.u[i] != l->base.u[i])) continue;
            ves_point_copy(&l->joint, &l->base, n, m);
            step(l, &l->joint, i);
            status = judge(l, &asker, &l->joint, &e);
            if (status != VES_OK) break;
            ves_asker_record(&asker, false, NAN, e < l->energy);
            if (!(e < l->energy)) continue;
            ves_point_copy(&l->base, &l->joint, n, m);
            l->energy = e;
        }
    } else if (status == VES_OK) {
        ves_point_copy(&l->base, &l->joint, n, m);
        l->energy = e;
    }
    ves_asker_flush(&asker);
    ves_asker_destroy(&asker);
    return status == VES_INTERRUPTED ? VES_OK : status;
}

static void descend(void *data, int worker, int index)
{
    lines *l = data;
    (void)index;
    l->descent.asker.worker = worker;
    (void)ves_descent_run(&l->descent, &l->base, &l->end);
}

static long descent_cost(const lines *l)
{
    return ves_descent_usual(l->session->n, l->session->problem->gradients);
}

static ves_status finish(lines *l, long left)
{
    l->descent.used = 0;
    l->descent.budget = left < descent_cost(l) ? left : descent_cost(l);
    VES_TRY(ves_session_round(l->session, &l->descent_asker, 1, descend, l));
    ves_archive_add(&l->team->archive, &l->end);
    ves_team_take(l->team, &l->end);
    return VES_OK;
}

/* From the best of all at first and whenever there is a new one, else from random points with finer samples. */
static ves_status begin(lines *l)
{
    const int n = l->session->n, m = l->session->m;
    const ves_point *best = &l->team->best;
    l->begun = true;
    l->swept = false;
    if (best->verdict.status == VES_OK &&
        (!l->starts++ || !ves_archive_near(&l->team->archive, best, &l->end))) {
        ves_point_copy(&l->base, best, n, m);
        l->first = l->energy = energy(l, &l->base);
        return VES_OK;
    }
    if (2 * l->samples <= SAMPLES_MOST) l->samples *= 2;
    ves_random random = {.seed = l->session->seed, .chain = l->stream + 255, .step = (uint64_t)l->starts};
    for (int i = 0; i < n; i++) l->base.u[i] = ves_random_uniform(&random);
    ves_point_place(l->session->problem, l->base.u, l->base.x);
    ves_asker asker;
    ves_asker_init(&asker, l->session, 0);
    ves_status status = judge(l, &asker, &l->base, &l->energy);
    l->first = l->energy;
    ves_asker_flush(&asker);
    ves_asker_destroy(&asker);
    return status == VES_INTERRUPTED ? VES_OK : status;
}

static long sweep_cost(const lines *l)
{
    return l->session->n * (long)(l->samples + BRACKETS * SECTIONS + 1) + 2;
}

static long least(const void *state)
{
    const lines *l = state;
    return l->swept ? descent_cost(l) : sweep_cost(l);
}

static ves_status sweep(lines *l)
{
    const double before = l->energy;
    l->sweeps++;
    VES_TRY(ves_session_round(l->session, l->asker, l->session->n, run, l));
    VES_TRY(join(l));
    ves_team_take(l->team, &l->base);
    l->swept = !(before - l->energy > settled * (l->first - l->energy));
    return VES_OK;
}

static ves_status advance(void *state, long some, long most)
{
    lines *l = state;
    ves_session *session = l->session;
    const long before = session->evaluations;
    for (long used = 0; used < some && most - used >= least(l) && !ves_session_over(session);
         used = session->evaluations - before) {
        if (l->swept) {
            VES_TRY(finish(l, most - used));
            l->begun = l->swept = false;
            continue;
        }
        if (!l->begun) VES_TRY(begin(l)); /* where samples may have become finer */
        if (most - (session->evaluations - before) < sweep_cost(l)) break;
        VES_TRY(sweep(l));
    }
    return VES_OK;
}

const ves_strategy ves_strategy_lines = {
    .name = "lines",
    .about = "whole ranges along all coordinates, and the best of them put together",
    .share = {0.15, 0.15, 0.1, 0.04},
    .create = create,
    .least = least,
    .advance = advance,
    .destroy = destroy,
};

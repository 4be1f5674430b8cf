#include <math.h>
#include <string.h>

#include "search/cma.h"
#include "search/ipop.h"
#include "search/strategy/strategy.h"

/* CMA-ES with restarts of growing populations (search/cma.h, search/ipop.h): what the rest of a portfolio lacks where
 * the variables depend on one another and there are no descents to follow. A round is one generation. Failed
 * candidates rank last; a violation is paid for by weight.
 * test  tests/search_cma.c; tests/search_strategy.c */

enum { LARGEST = 4096, STRANDS = 16 };

/* Candidates k, k + STRANDS ... of a generation: one task, whatever the number of workers. */
typedef struct strand {
    ves_asker asker;
    ves_point trial, best;
} strand;

typedef struct cma {
    ves_team *team;
    ves_session *session;
    ves_cma run;
    ves_ipop ipop;
    strand strand[STRANDS];
    ves_asker *asker[STRANDS];
    double *value; /* [LARGEST] */
    double *mean;  /* [n] */
    long spent, limit;
    bool runs;
} cma;

static int largest(const ves_session *session)
{
    int most = 64;
    while (most < LARGEST && most < session->budget / 20) most *= 2;
    return most;
}

static void *create(ves_team *team, uint32_t stream)
{
    ves_session *session = team->session;
    ves_arena *arena = &session->arena;
    int most = largest(session);
    cma *c = ves_arena_take(arena, 1, sizeof *c);
    if (!c) return NULL;
    c->team = team;
    c->session = session;
    ves_cma_options options = ves_cma_default();
    options.seed = session->seed;
    options.stream = stream;
    ves_ipop_options restarts = ves_ipop_default(session->n);
    restarts.seed = session->seed;
    restarts.stream = stream + 1;
    restarts.most = most;
    ves_ipop_init(&c->ipop, session->n, &restarts);
    c->value = ves_arena_take(arena, (size_t)most, sizeof(double));
    c->mean = ves_arena_take(arena, (size_t)session->n, sizeof(double));
    if (!c->value || !c->mean || !ves_cma_create(arena, session->n, most, &options, &c->run)) return NULL;
    for (int k = 0; k < STRANDS; k++) {
        ves_asker_init(&c->strand[k].asker, session, k);
        c->asker[k] = &c->strand[k].asker;
        if (!ves_point_create(arena, session->n, session->m, &c->strand[k].trial)) return NULL;
        if (!ves_point_create(arena, session->n, session->m, &c->strand[k].best)) return NULL;
    }
    return c;
}

static void destroy(void *state)
{
    cma *c = state;
    for (int k = 0; k < STRANDS; k++) ves_asker_destroy(&c->strand[k].asker);
}

static void ask(void *data, int worker, int index)
{
    cma *c = data;
    ves_session *session = c->session;
    strand *s = &c->strand[index];
    s->asker.worker = worker;
    for (int k = index; k < c->run.lambda; k += STRANDS) {
        ves_cma_ask(&c->run, k, NULL, s->trial.u);
        ves_point_place(session->problem, s->trial.u, s->trial.x);
        ves_ask question = {.x = s->trial.x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
        s->trial.proved = false;
        if (ves_asker_judge(&s->asker, &question, &s->trial.verdict) != VES_OK) return;
        bool better = ves_session_better(session, &s->trial.verdict, &s->best.verdict);
        ves_asker_record(&s->asker, false, NAN, better);
        if (better) ves_point_copy(&s->best, &s->trial, session->n, session->m);
        c->value[k] = ves_verdict_energy(&s->trial.verdict, c->team->weight, session->tolerance);
    }
}

static ves_status generation(cma *c)
{
    ves_session *session = c->session;
    long before = session->evaluations;
    VES_TRY(ves_session_round(session, c->asker, c->run.lambda < STRANDS ? c->run.lambda : STRANDS, ask, c));
    if (ves_session_over(session)) return VES_OK; /* not all may have been asked */
    c->spent += session->evaluations - before;
    ves_cma_tell(&c->run, c->value);
    for (int k = 0; k < STRANDS; k++) ves_team_take(c->team, &c->strand[k].best);
    return VES_OK;
}

static void begin(cma *c)
{
    ves_ipop_run next;
    ves_ipop_next(&c->ipop, c->spent, &next, c->mean);
    double rival = c->run.rival < c->run.least ? c->run.rival : c->run.least;
    ves_cma_restart(&c->run, c->mean, next.sigma, next.lambda);
    if (c->runs) c->run.rival = rival;
    c->limit = next.limit;
    c->spent = 0;
    c->runs = true;
    for (int k = 0; k < STRANDS; k++) ves_point_fail(&c->strand[k].best);
}

/* The best point of a run that is over is an end like any other. */
static void end(cma *c)
{
    const strand *best = &c->strand[0];
    for (int k = 1; k < STRANDS; k++)
        if (ves_session_better(c->session, &c->strand[k].best.verdict, &best->best.verdict))
            best = &c->strand[k];
    ves_archive_add(&c->team->archive, &best->best);
}

static bool over(const cma *c)
{
    return ves_cma_stopped(&c->run) != VES_CMA_RUNNING || (c->limit && c->spent >= c->limit);
}

static long least(const void *state)
{
    const cma *c = state;
    return c->runs ? c->run.lambda : c->ipop.options.first;
}

static ves_status advance(void *state, long some, long most)
{
    cma *c = state;
    ves_session *session = c->session;
    const long before = session->evaluations;
    for (long used = 0; used < some && !ves_session_over(session); used = session->evaluations - before) {
        if (!c->runs || over(c)) {
            if (c->runs) end(c);
            begin(c);
        }
        if (most - used < c->run.lambda) break;
        VES_TRY(generation(c));
    }
    return VES_OK;
}

const ves_strategy ves_strategy_cma = {
    .name = "cma",
    .about = "CMA-ES, restarted with growing populations",
    .share = {0.5, 0.3, 0.2, 0.08},
    .create = create,
    .least = least,
    .advance = advance,
    .destroy = destroy,
};

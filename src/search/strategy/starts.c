#include <math.h>
#include <string.h>

#include "search/descent.h"
#include "search/strategy/strategy.h"

/* Starts: descents from points drawn uniformly from the box, and nothing else (multistart). They know nothing of each
 * other, which makes their ends evidence: how often the best is among them, and how much of the box leads to minima that
 * none has seen (search/evidence.h). A round is `WIDTH` descents, whatever the number of workers.
 * test  tests/search_honest.c */

enum { WIDTH = 4 };

typedef struct task {
    ves_descent descent;
    ves_point from, end;
    ves_random random;
} task;

typedef struct starts {
    ves_team *team;
    ves_session *session;
    uint32_t stream;
    ves_polish options;
    task task[WIDTH];
    ves_asker *asker[WIDTH];
    long rounds;
} starts;

static long cap(const ves_session *session)
{
    return 2 * ves_descent_usual(session->n, session->problem->gradients);
}

static void *create(ves_team *team, uint32_t stream)
{
    ves_session *session = team->session;
    starts *s = ves_arena_take(&session->arena, 1, sizeof *s);
    if (!s) return NULL;
    *s = (starts){.team = team, .session = session, .stream = stream};
    s->options = ves_descent_quick(session, session->problem->gradients);
    s->options.x_tolerance = session->problem->gradients ? 1e-8 : 1e-5;
    for (int k = 0; k < WIDTH; k++) {
        task *t = &s->task[k];
        if (!ves_descent_create(&t->descent, session, k, &s->options, 0)) return NULL;
        t->descent.runs = 1;
        s->asker[k] = &t->descent.asker;
        if (!ves_point_create(&session->arena, session->n, session->m, &t->from)) return NULL;
        if (!ves_point_create(&session->arena, session->n, session->m, &t->end)) return NULL;
    }
    return s;
}

static void destroy(void *state)
{
    starts *s = state;
    for (int k = 0; k < WIDTH; k++) ves_descent_destroy(&s->task[k].descent);
}

static void run(void *data, int worker, int index)
{
    starts *s = data;
    task *t = &s->task[index];
    t->descent.asker.worker = worker;
    for (int i = 0; i < s->session->n; i++) t->from.u[i] = ves_random_uniform(&t->random);
    ves_point_place(s->session->problem, t->from.u, t->from.x);
    ves_point_fail(&t->from);
    (void)ves_descent_run(&t->descent, &t->from, &t->end); /* a fault stands in the asker */
}

static ves_status start_round(starts *s, long each)
{
    ves_session *session = s->session;
    for (int k = 0; k < WIDTH; k++) {
        s->task[k].random = (ves_random){
            .seed = session->seed, .chain = s->stream + (uint32_t)k, .step = (uint64_t)s->rounds};
        s->task[k].descent.used = 0;
        s->task[k].descent.budget = each;
    }
    s->rounds++;
    VES_TRY(ves_session_round(session, s->asker, WIDTH, run, s));
    for (int k = 0; k < WIDTH; k++) {
        ves_archive_add(&s->team->archive, &s->task[k].end);
        ves_archive_add(&s->team->blind, &s->task[k].end);
        ves_team_take(s->team, &s->task[k].end);
    }
    return VES_OK;
}

static long least(const void *state)
{
    const starts *s = state;
    return WIDTH * 4 * (2 + (long)s->session->n);
}

static ves_status advance(void *state, long some, long most)
{
    starts *s = state;
    ves_session *session = s->session;
    const long before = session->evaluations;
    for (long used = 0; used < some && most - used >= least(s) && !ves_session_over(session);
         used = session->evaluations - before) {
        long each = (most - used) / WIDTH;
        VES_TRY(start_round(s, each < cap(session) ? each : cap(session)));
    }
    return VES_OK;
}

const ves_strategy ves_strategy_starts = {
    .name = "starts",
    .about =
        "descents from points drawn at random; unless a budget is given, enough of them to the best end auto",
    .share = {0.3, 0.3, 0.3, 0.3},
    .saves = true,
    .create = create,
    .least = least,
    .advance = advance,
    .destroy = destroy,
};

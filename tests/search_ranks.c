#include <criterion/criterion.h>
#include <criterion/new/assert.h>
#include <pthread.h>
#include <stdlib.h>

#include "search_problems.h"

/* Ranks that share out a search end with what one alone finds: the same result, records and journal. Here they are
 * threads, and a message is a pointer. */

enum { RANKS = 4, ROOM = 1 << 24 };

typedef struct world {
    pthread_barrier_t barrier;
    int ranks;
    const void *message[RANKS];
    size_t size[RANKS];
} world;

typedef struct one {
    world *world;
    int rank, workers;
    long asked, stop, fail; /* after so many questions to this rank; 0: never */
    const char *stages;
    unsigned char *all, *journal;
    size_t used;
    double sum; /* of what the hook was told, in its order */
    long told;
    ves_status status;
    ves_search_result *result;
} one;

static ves_status exchange(void *data, const void *mine, size_t size, const void **all, size_t *total)
{
    one *o = data;
    world *w = o->world;
    w->message[o->rank] = mine;
    w->size[o->rank] = size;
    pthread_barrier_wait(&w->barrier);
    *total = 0;
    for (int k = 0; k < w->ranks; k++) {
        cr_assert(ROOM >= *total + w->size[k]);
        memcpy(o->all + *total, w->message[k], w->size[k]);
        *total += w->size[k];
    }
    *all = o->all;
    pthread_barrier_wait(&w->barrier);
    return VES_OK;
}

static void keep(void *data, const void *block, size_t size, bool whole)
{
    one *o = data;
    if (!whole) return;
    cr_assert(o->used + size <= ROOM);
    memcpy(o->journal + o->used, block, size);
    o->used += size;
}

static void record(void *data, const ves_record *r)
{
    one *o = data;
    o->told++;
    o->sum = 0.999 * o->sum + r->x[0] + (r->status == VES_OK ? r->value : 0) + r->accepted;
}

static bool stopped(void *data)
{
    one *o = data;
    return o->stop && __atomic_load_n(&o->asked, __ATOMIC_SEQ_CST) >= o->stop;
}

/* Valleys under waves, and one constraint. */
static ves_status waves(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    one *o = data;
    long asked = __atomic_add_fetch(&o->asked, 1, __ATOMIC_SEQ_CST);
    if (o->fail && asked >= o->fail) return VES_MEMORY;
    double *g = gradient_of(ask, v), sum = 0, c = -3;
    for (int i = 0; i < 4; i++) {
        double x = ask->x[i];
        sum += x * x + 1 - cos(5 * x + i);
        c += x;
        if (g) g[i] = 2 * x + 5 * sin(5 * x + i), v->jacobian[i] = 1;
    }
    v->value = sum;
    v->constraint[0] = c;
    return VES_OK;
}

static void *run_one(void *data)
{
    one *o = data;
    given g = {.evaluate = waves, .n = 4, .m = 1, .gradients = true, .workers = o->workers, .data = o};
    for (int i = 0; i < 4; i++) g.lower[i] = -2, g.upper[i] = 2, g.start[i] = 1 - 0.4 * i;
    ves_search_options options = ves_search_options_default();
    options.evaluations = 3000;
    if (o->stages) {
        options.stages = 2;
        options.stage[0].kind = VES_STAGE_ANNEAL;
        options.stage[0].anneal.evaluations = 2000;
        options.stage[1].kind = VES_STAGE_POLISH;
    }
    ves_search_hooks hooks = {.record = record, .stopped = stopped, .keep = keep, .data = o};
    if (o->world->ranks > 1) hooks.rank = o->rank, hooks.ranks = o->world->ranks, hooks.exchange = exchange;
    o->status = run(&g, &options, &hooks, &o->result);
    return NULL;
}

static void run_all(world *w, one *rank, int ranks, const one *like)
{
    pthread_t thread[RANKS];
    w->ranks = ranks;
    cr_assert(pthread_barrier_init(&w->barrier, NULL, (unsigned)ranks) == 0);
    for (int k = 0; k < ranks; k++) {
        rank[k] = *like;
        rank[k].world = w, rank[k].rank = k;
        rank[k].stop = k == ranks - 1 ? like->stop : 0;
        rank[k].fail = k == ranks - 1 ? like->fail : 0;
        rank[k].all = malloc(ROOM);
        rank[k].journal = malloc(ROOM);
        cr_assert(pthread_create(&thread[k], NULL, run_one, &rank[k]) == 0);
    }
    for (int k = 0; k < ranks; k++) pthread_join(thread[k], NULL);
    pthread_barrier_destroy(&w->barrier);
}

static void done(one *rank, int ranks)
{
    for (int k = 0; k < ranks; k++) {
        ves_search_result_destroy(rank[k].result);
        free(rank[k].all);
        free(rank[k].journal);
    }
}

static void same(const one *a, const one *b)
{
    cr_assert(a->result && b->result, "%d %d", a->status, b->status);
    cr_expect(a->result->value == b->result->value && a->result->optima == b->result->optima);
    cr_expect(eq(long, a->result->evaluations, b->result->evaluations));
    cr_expect(eq(int, a->result->feasible, b->result->feasible));
    cr_expect(strcmp(a->result->evidence.sentence, b->result->evidence.sentence) == 0, "%s | %s",
              a->result->evidence.sentence, b->result->evidence.sentence);
    cr_expect(memcmp(a->result->x, b->result->x, 4 * sizeof(double)) == 0);
    cr_expect(eq(long, a->told, b->told));
    cr_expect(a->sum == b->sum, "the records, or their order");
    cr_expect(a->used == b->used && memcmp(a->journal, b->journal, a->used) == 0, "the journal");
}

Test(search_ranks, any_number_ends_as_one_alone, .timeout = 120)
{
    for (int k = 0; k < 2; k++) {
        world w;
        one alone[1], rank[RANKS];
        run_all(&w, alone, 1, &(one){.workers = 1, .stages = k ? "two" : NULL});
        for (int ranks = 2; ranks <= RANKS; ranks++) {
            long most = 0;
            run_all(&w, rank, ranks, &(one){.workers = 1 + ranks % 2, .stages = k ? "two" : NULL});
            for (int r = 0; r < ranks; r++) {
                same(alone, &rank[r]);
                most = rank[r].asked > most ? rank[r].asked : most;
            }
            cr_expect(most < alone->asked * 9 / 10, "%d ranks: %ld of %ld asked by one", ranks, most,
                      alone->asked);
            done(rank, ranks);
        }
        done(alone, 1);
    }
}

Test(search_ranks, a_stop_of_one_ends_all, .timeout = 120)
{
    for (long stop = 1; stop < 600; stop += 1 + stop / 3) {
        world w;
        one rank[RANKS];
        run_all(&w, rank, 3, &(one){.workers = 1, .stop = stop, .stages = stop % 2 ? NULL : "two"});
        for (int r = 0; r < 3; r++)
            cr_expect(rank[r].status == VES_INTERRUPTED && rank[r].result, "stop %ld, rank %d: %d", stop, r,
                      rank[r].status);
        for (int r = 1; r < 3; r++) same(&rank[0], &rank[r]);
        done(rank, 3);
    }
}

Test(search_ranks, a_fault_of_one_ends_all, .timeout = 120)
{
    world w;
    one rank[RANKS];
    run_all(&w, rank, 3, &(one){.workers = 2, .fail = 300, .stages = "two"});
    for (int r = 0; r < 3; r++)
        cr_expect(rank[r].status == VES_MEMORY && rank[r].result == NULL, "rank %d", r);
    done(rank, 3);
}

#include <string.h>

#include "search/session.h"

/* Ranks: processes that share out the tasks of a round. Each asks for its own, hands the others what it was
 * answered, and runs their tasks on what they were answered: so all have the same state again, whatever it is.
 *
 *     message   u32 stopped, i32 fault, then for each task of the rank  u64 bytes, then their events
 *
 * test  the same result, records and journal on 1, 2 and 3 ranks (tests/search_ranks.c, tests/slow/ranks.sh) */

typedef struct head {
    uint32_t stopped;
    int32_t fault;
} head;

typedef struct shared {
    const ves_round *round;
    int rank, ranks;
} shared;

static void own_task(void *data, int worker, int index)
{
    const shared *s = data;
    s->round->task(s->round->data, worker, index * s->ranks + s->rank);
}

static void other_task(void *data, int worker, int index)
{
    const shared *s = data;
    if (index % s->ranks != s->rank) s->round->task(s->round->data, worker, index);
}

static bool say(ves_session *session, const shared *s)
{
    ves_bytes *message = &session->message;
    head h = {.stopped = atomic_load(&session->stopped), .fault = session->fault};
    message->size = 0;
    for (int k = s->rank; k < s->round->count; k += s->ranks)
        if (s->round->asker[k]->fault && !h.fault) h.fault = s->round->asker[k]->fault;
    unsigned char *to = ves_bytes_grow(message, sizeof h);
    if (!to) return false;
    memcpy(to, &h, sizeof h);
    message->size += sizeof h;
    for (int k = s->rank; k < s->round->count; k += s->ranks) {
        const ves_bytes *said = &s->round->asker[k]->said;
        const uint64_t size = said->size;
        if (!(to = ves_bytes_grow(message, sizeof size + said->size))) return false;
        memcpy(to, &size, sizeof size);
        if (said->size) memcpy(to + sizeof size, said->at, said->size);
        message->size += sizeof size + said->size;
    }
    return true;
}

static bool copy(ves_bytes *bytes, const unsigned char *from, size_t size)
{
    bytes->size = 0;
    unsigned char *to = ves_bytes_grow(bytes, size + 1);
    if (!to) return false;
    memcpy(to, from, size);
    bytes->size = size;
    return true;
}

/* What a stop broke off goes as far here as it went there: to the answer that it was not given. */
static bool take(const ves_session *session, ves_asker *asker, const unsigned char *from, size_t size)
{
    asker->heard = 0;
    asker->whole = true;
    asker->broken = atomic_load(&session->stopped);
    return copy(&asker->known, from, size);
}

static ves_status heads(ves_session *session, const shared *s, const unsigned char *at,
                        const unsigned char *end)
{
    for (int rank = 0; rank < s->ranks; rank++) {
        head h;
        if ((size_t)(end - at) < sizeof h) return VES_FAULT;
        memcpy(&h, at, sizeof h);
        at += sizeof h;
        if (h.stopped) atomic_store(&session->stopped, true);
        if (h.fault && !session->fault) session->fault = (ves_status)h.fault;
        for (int k = rank; k < s->round->count; k += s->ranks) {
            uint64_t size;
            if ((size_t)(end - at) < sizeof size) return VES_FAULT;
            memcpy(&size, at, sizeof size);
            at += sizeof size;
            if ((size_t)(end - at) < size) return VES_FAULT;
            at += size;
        }
    }
    return VES_OK;
}

/* A message that is not whole comes from a rank that runs another round. */
static void hear(ves_session *session, const shared *s, const unsigned char *at, const unsigned char *end)
{
    if (heads(session, s, at, end) != VES_OK) session->fault = VES_FAULT;
    for (int rank = 0; rank < s->ranks && !session->fault; rank++) {
        at += sizeof(head);
        for (int k = rank; k < s->round->count && !session->fault; k += s->ranks) {
            uint64_t size;
            memcpy(&size, at, sizeof size);
            at += sizeof size;
            if (rank != s->rank && !take(session, s->round->asker[k], at, size)) session->fault = VES_MEMORY;
            at += size;
        }
    }
}

void ves_round_share(ves_session *session, const ves_round *round)
{
    shared s = {round, session->hooks.rank, session->hooks.ranks};
    const void *all = NULL;
    size_t total = 0;
    session->rounding = true;
    ves_pool_run(session->pool, (round->count - s.rank + s.ranks - 1) / s.ranks, own_task, &s);
    session->rounding = false;
    if (!say(session, &s)) {
        session->fault = VES_MEMORY;
        return;
    }
    ves_status status = session->hooks.exchange(session->hooks.data, session->message.at,
                                                session->message.size, &all, &total);
    if (status != VES_OK) {
        session->fault = status;
        return;
    }
    hear(session, &s, all, (const unsigned char *)all + total);
    session->rounding = true;
    if (!session->fault) ves_pool_run(session->pool, round->count, other_task, &s);
    session->rounding = false;
}

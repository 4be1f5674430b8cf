#include <string.h>

#include "search/session.h"

/* Rounds: the steps in which a search goes on, is kept, and is gone through again.
 * test  the same bytes for any number of workers; broken off after any number of answers and resumed, the
 *       same result (tests/search_resume.c) */

/* --- recalling --- */

/* Gives each asker of the round what a block knows of it. A block that does not fit says that the journal is
 * of another run. */
static ves_status take_whole(ves_session *session, ves_asker *const *asker, int count,
                             const unsigned char *bytes, size_t size)
{
    ves_block head;
    if (size < sizeof head) return VES_STALE;
    memcpy(&head, bytes, sizeof head);
    size_t at = sizeof head + head.parts * sizeof(ves_part);
    if ((int)head.parts != count || (int)head.stage != session->stage_index || size < at) return VES_STALE;
    for (int k = 0; k < count; k++) {
        ves_part part;
        memcpy(&part, bytes + sizeof head + (size_t)k * sizeof part, sizeof part);
        if (part.member != asker[k]->member || part.bytes > size - at) return VES_STALE;
        ves_bytes *known = &asker[k]->known;
        unsigned char *to = ves_bytes_grow(known, part.bytes);
        if (!to) return VES_MEMORY;
        memcpy(to, bytes + at, part.bytes);
        known->size += part.bytes;
        asker[k]->whole = true;
        at += part.bytes;
    }
    return at == size ? VES_OK : VES_STALE;
}

static ves_status take_part(ves_session *session, ves_asker *const *asker, int count,
                            const unsigned char *bytes, size_t size)
{
    ves_block head;
    ves_part part;
    if (size < sizeof head + sizeof part) return VES_STALE;
    memcpy(&head, bytes, sizeof head);
    memcpy(&part, bytes + sizeof head, sizeof part);
    if (head.parts != 1 || (int)head.stage != session->stage_index) return VES_STALE;
    if (part.place < 0 || part.place >= count || part.member != asker[part.place]->member) return VES_STALE;
    if (part.bytes != size - sizeof head - sizeof part) return VES_STALE;
    ves_bytes *known = &asker[part.place]->known;
    unsigned char *to = ves_bytes_grow(known, part.bytes);
    if (!to) return VES_MEMORY;
    memcpy(to, bytes + sizeof head + sizeof part, part.bytes);
    known->size += part.bytes;
    return VES_OK;
}

/* After the last whole block come the parts of the round that was broken off. */
static ves_status recall(ves_session *session, ves_asker *const *asker, int count)
{
    const void *block;
    size_t size;
    bool whole = false;
    while (!whole && session->recalls) {
        session->recalls = session->hooks.recall(session->hooks.data, &block, &size, &whole);
        if (!session->recalls) break;
        VES_TRY(whole ? take_whole(session, asker, count, block, size)
                      : take_part(session, asker, count, block, size));
    }
    for (int k = 0; k < count; k++)
        if (asker[k]->known.size) asker[k]->saved = asker[k]->known.size;
    return VES_OK;
}

/* --- keeping --- */

static ves_status keep(ves_session *session, ves_asker *const *asker, int count)
{
    ves_bytes *block = &session->block;
    size_t size = sizeof(ves_block) + (size_t)count * sizeof(ves_part);
    for (int k = 0; k < count; k++) size += asker[k]->said.size;
    block->size = 0;
    unsigned char *to = ves_bytes_grow(block, size);
    if (!to) return VES_MEMORY;
    const ves_block head = {.stage = (uint32_t)session->stage_index, .parts = (uint32_t)count};
    memcpy(to, &head, sizeof head);
    to += sizeof head;
    for (int k = 0; k < count; k++, to += sizeof(ves_part)) {
        const ves_part part = {.member = asker[k]->member, .place = k, .bytes = asker[k]->said.size};
        memcpy(to, &part, sizeof part);
    }
    for (int k = 0; k < count; k++) {
        if (asker[k]->said.size) memcpy(to, asker[k]->said.at, asker[k]->said.size);
        to += asker[k]->said.size;
    }
    session->hooks.keep(session->hooks.data, block->at, size, true);
    return VES_OK;
}

/* What was said since it was kept last, of a round that is not over. Called from any worker. */
void ves_asker_save(ves_asker *asker)
{
    ves_session *session = asker->session;
    if (session->hooks.clock) asker->kept = session->hooks.clock(session->hooks.data);
    if (!session->hooks.keep || asker->said.size <= asker->saved) return;
    const ves_block head = {.stage = (uint32_t)session->stage_index, .parts = 1};
    const ves_part part = {
        .member = asker->member, .place = asker->place, .bytes = asker->said.size - asker->saved};
    ves_pool_lock(session->pool);
    ves_bytes *block = &session->block;
    block->size = 0;
    unsigned char *to = ves_bytes_grow(block, sizeof head + sizeof part + part.bytes);
    if (to) {
        memcpy(to, &head, sizeof head);
        memcpy(to + sizeof head, &part, sizeof part);
        memcpy(to + sizeof head + sizeof part, asker->said.at + asker->saved, part.bytes);
        session->hooks.keep(session->hooks.data, to, sizeof head + sizeof part + part.bytes, false);
    }
    ves_pool_unlock(session->pool);
    asker->saved = asker->said.size;
}

/* --- the round --- */

ves_status ves_round_join(ves_session *session, ves_asker *const *asker, int count)
{
    for (int k = 0; k < count; k++) {
        asker[k]->place = k;
        asker[k]->joined = true;
    }
    session->closed = session->closed || atomic_load(&session->stopped);
    if (!session->recalls) return VES_OK;
    ves_status status = recall(session, asker, count);
    if (status != VES_OK) session->fault = status;
    return status;
}

/* A round that a stop broke off is kept in parts; what an interrupted search does after that, such as to prove
 * its best, is not: a resumed run goes through the same rounds as one that was never stopped. One in which nothing
 * was asked is kept too, or the block of the next would be taken for its own. */
void ves_round_leave(ves_session *session, ves_asker *const *asker, int count)
{
    bool stale = false; /* the journal is of another run: nothing may be added to it */
    for (int k = 0; k < count; k++) stale = stale || asker[k]->fault == VES_STALE;
    if (session->hooks.keep && !session->closed && !session->fault && !stale) {
        session->closed = atomic_load(&session->stopped);
        if (session->closed)
            for (int k = 0; k < count; k++) ves_asker_save(asker[k]);
        else if (keep(session, asker, count) != VES_OK)
            session->fault = VES_MEMORY;
    }
    for (int k = 0; k < count; k++) ves_asker_merge(asker[k]);
}

ves_status ves_session_round(ves_session *session, ves_asker *const *asker, int count,
                             void (*task)(void *data, int worker, int index), void *data)
{
    VES_TRY(ves_round_join(session, asker, count));
    bool whole = count == 0 || asker[0]->whole; /* the journal answers it all, on every rank */
    if (session->shares && !whole && !atomic_load(&session->stopped))
        ves_round_share(session, &(ves_round){asker, count, task, data});
    else
        ves_pool_run(session->pool, count, task, data);
    ves_round_leave(session, asker, count);
    return session->fault;
}

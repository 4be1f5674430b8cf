#include "search/block.h"

#include <string.h>

#include "base/arena.h"

enum { FIRST_ROOM = 4096 };

unsigned char *ves_bytes_grow(ves_bytes *bytes, size_t more)
{
    if (bytes->size + more > bytes->room) {
        size_t room = bytes->room ? 2 * bytes->room : FIRST_ROOM;
        if (room < bytes->size + more) room = bytes->size + more;
        unsigned char *at = ves_memory_grow(bytes->at, room);
        if (!at) return NULL;
        bytes->at = at;
        bytes->room = room;
    }
    return bytes->at + bytes->size;
}

void ves_bytes_free(ves_bytes *bytes)
{
    ves_memory_free(bytes->at);
    *bytes = (ves_bytes){0};
}

size_t ves_event_row(int32_t status, unsigned want, int n, int m)
{
    size_t row = (size_t)n;
    if (status != VES_OK) return row;
    row += (size_t)m;
    return want & VES_WANT_GRADIENT ? row + (size_t)n * (size_t)(m + 1) : row;
}

bool ves_event_read(const unsigned char *bytes, size_t size, int n, int m, size_t *at, ves_record *record)
{
    ves_event event;
    if (size - *at < sizeof event) return false;
    memcpy(&event, bytes + *at, sizeof event);
    size_t row = ves_event_row(event.status, event.want, n, m) * sizeof(double);
    if (size - *at - sizeof event < row) return false;
    const double *x = (const double *)(const void *)(bytes + *at + sizeof event);
    bool exact = event.status == VES_OK && (event.want & VES_WANT_GRADIENT);
    *record = (ves_record){.x = x,
                           .constraint = event.status == VES_OK ? x + n : NULL,
                           .slope = exact ? x + n + m : NULL,
                           .value = event.value,
                           .violation = event.violation,
                           .temperature = event.temperature,
                           .status = (ves_status)event.status,
                           .accepted = event.accepted,
                           .gradient = event.gradient,
                           .proof = event.want & VES_WANT_PROOF};
    *at += sizeof event + row;
    return true;
}

bool ves_search_block_read(const void *block, size_t size, int n, int m, ves_search_cursor *cursor,
                           ves_record *record)
{
    const unsigned char *bytes = block;
    ves_block head;
    if (size < sizeof head) return false;
    memcpy(&head, bytes, sizeof head);
    size_t table = sizeof head + head.parts * sizeof(ves_part);
    if (size < table) return false;
    if (!cursor->at) cursor->at = cursor->end = table;
    while (cursor->at == cursor->end) {
        ves_part part;
        if (cursor->part >= head.parts) return false;
        memcpy(&part, bytes + sizeof head + cursor->part++ * sizeof part, sizeof part);
        if (part.bytes > size - cursor->at) return false;
        cursor->end = cursor->at + part.bytes;
        cursor->member = part.member;
    }
    if (!ves_event_read(bytes, cursor->end, n, m, &cursor->at, record)) return false;
    record->stage = (int)head.stage;
    record->chain = cursor->member;
    record->evaluation = ++cursor->evaluation;
    return true;
}

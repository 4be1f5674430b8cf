/* Block: what the members of one round were answered, as bytes. A journal is a row of blocks; whoever has
 * them all can go through the search again without asking anything.
 *
 *     block   u32 stage, u32 parts, then for each part  i32 member, i32 place, u64 bytes, then their events
 *     event   as ves_event, x [n], constraint [m] when the status is 0, and then, when the gradient was
 *             wanted, gradient [n] and jacobian [m][n]
 *
 * All of it in units of eight bytes, in the byte order of the machine. A block whose round was broken off has
 * one part, the events that one member had been answered since the last such block. */
#ifndef VES_SEARCH_BLOCK_H
#define VES_SEARCH_BLOCK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "vesica/search.h"

typedef struct ves_bytes {
    unsigned char *at;
    size_t size, room;
} ves_bytes;

typedef struct ves_event {
    double value, violation, temperature;
    int32_t status;
    uint8_t accepted, gradient, want, spare;
} ves_event;

typedef struct ves_part {
    int32_t member, place;
    uint64_t bytes;
} ves_part;

typedef struct ves_block {
    uint32_t stage, parts;
} ves_block;

/* Room for `more` bytes behind what is there; NULL when out of memory. */
unsigned char *ves_bytes_grow(ves_bytes *bytes, size_t more);
void ves_bytes_free(ves_bytes *bytes);

/* One event at `*at`, which then stands behind it; false: there is none, or none whole. */
bool ves_event_read(const unsigned char *bytes, size_t size, int n, int m, size_t *at, ves_record *record);

/* Doubles behind the head of an event. */
size_t ves_event_row(int32_t status, unsigned want, int n, int m);

#endif

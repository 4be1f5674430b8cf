#include "base/arena.h"

#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ALIGNMENT = 64, BLOCK = 64 * 1024 };

struct ves_arena_block {
    ves_arena_block *next;
    size_t size, used; /* bytes after the header, all multiples of ALIGNMENT */
    char *base;
};

static size_t rounded(size_t bytes)
{
    return (bytes + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT;
}

void *ves_memory_take(size_t size)
{
    return calloc(1, size ? size : 1);
}

void *ves_memory_grow(void *block, size_t size)
{
    return realloc(block, size);
}

void ves_memory_free(void *block)
{
    free(block);
}

static ves_arena_block *block_create(size_t size)
{
    ves_arena_block *block = ves_memory_take(sizeof *block + size + ALIGNMENT);
    if (!block) return NULL;
    uintptr_t first = (uintptr_t)(block + 1);
    block->base = (char *)(block + 1) + (rounded(first) - first);
    block->size = size;
    return block;
}

void ves_arena_destroy(ves_arena *arena)
{
    for (ves_arena_block *block = arena->block, *next; block; block = next) {
        next = block->next;
        ves_memory_free(block);
    }
    arena->block = NULL;
}

void *ves_arena_take(ves_arena *arena, size_t count, size_t size)
{
    if (size && count > (SIZE_MAX - 2 * BLOCK) / size) return NULL;
    size_t bytes = rounded(count * size > 0 ? count * size : 1);
    ves_arena_block *block = arena->block;
    if (!block || block->size - block->used < bytes) {
        block = block_create(bytes > BLOCK ? bytes : BLOCK);
        if (!block) return NULL;
        block->next = arena->block;
        arena->block = block;
    }
    void *place = block->base + block->used;
    block->used += bytes;
    return place;
}

double *ves_arena_doubles(ves_arena *arena, size_t count)
{
    double *plane = ves_arena_take(arena, count, sizeof *plane);
#ifndef NDEBUG
    for (size_t k = 0; plane && k < count; k++) plane[k] = NAN;
#endif
    return plane;
}

char *ves_arena_text(ves_arena *arena, const char *text, size_t length)
{
    char *copy = ves_arena_take(arena, length + 1, 1);
    if (copy && length) memcpy(copy, text, length);
    return copy;
}

char *ves_arena_format(ves_arena *arena, const char *format, ...)
{
    va_list list, again;
    va_start(list, format);
    va_copy(again, list);
    int length = vsnprintf(NULL, 0, format, list);
    char *text = length < 0 ? NULL : ves_arena_take(arena, (size_t)length + 1, 1);
    if (text) vsnprintf(text, (size_t)length + 1, format, again);
    va_end(again);
    va_end(list);
    return text;
}

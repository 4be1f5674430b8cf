/* Arena: memory that lives and dies together. A Problem, a Plan, a Run own one each; nothing in them is freed
 * alone. malloc and free are called here and nowhere else. */
#ifndef VES_BASE_ARENA_H
#define VES_BASE_ARENA_H

#include <stddef.h>

typedef struct ves_arena_block ves_arena_block;

typedef struct ves_arena {
    ves_arena_block *block; /* newest first */
} ves_arena;

/* An arena starts as {0}. */
void ves_arena_destroy(ves_arena *arena);

/* `count` things of `size` bytes, zeroed and aligned to 64 bytes (one cache line, one AVX-512 register).
 * NULL when out of memory or when the product overflows. */
void *ves_arena_take(ves_arena *arena, size_t count, size_t size);

/* Like ves_arena_take for hot numeric planes, but debug builds fill with NaN so that reading before writing
 * shows. */
double *ves_arena_doubles(ves_arena *arena, size_t count);

/* A copy of the first `length` bytes of text, terminated. */
char *ves_arena_text(ves_arena *arena, const char *text, size_t length);
char *ves_arena_format(ves_arena *arena, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Plain blocks for what must be freed on its own (whole objects, growing buffers). */
void *ves_memory_take(size_t size);              /* zeroed */
void *ves_memory_grow(void *block, size_t size); /* as realloc */
void ves_memory_free(void *block);

#endif

/* Writer: a text that grows, for help and documents. */
#ifndef VES_PROBLEM_WRITER_H
#define VES_PROBLEM_WRITER_H

#include <stdbool.h>
#include <stddef.h>

#include "base/arena.h"

typedef struct ves_writer { /* starts as {0} */
    char *text;
    size_t length, room;
    bool failed; /* out of memory */
} ves_writer;

void ves_write(ves_writer *writer, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* The text, moved into the arena; NULL when memory did not suffice. The writer is empty afterwards. */
char *ves_writer_finish(ves_writer *writer, ves_arena *arena);

#endif

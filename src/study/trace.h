/* Trace: one line of JSON for a candidate of a search, written as they come. */
#ifndef VES_STUDY_TRACE_H
#define VES_STUDY_TRACE_H

#include <stdio.h>

#include "problem/problem.h"
#include "study/run.h"

typedef struct ves_tracer {
    const ves_problem *problem;
    const char *path;
    FILE *out; /* NULL: nothing is written */
    ves_trace which;
    int stage;           /* of the last line */
    ves_verdict best;    /* so far; of the search, not of what is kept */
    long accepted, kept; /* accepted candidates seen; those of them that stand in a short trace */
    ves_diag *diag;
    char *line; /* one line's room */
    size_t room;
    ves_status status;
} ves_tracer;

/* again: over the one that is there, line by line the same. The arena keeps the room of a line. On failure nothing
 * is open. */
ves_status ves_tracer_begin(ves_tracer *tracer, const char *path, bool again, ves_arena *arena);
void ves_tracer_write(ves_tracer *tracer, const ves_record *record);
ves_status ves_tracer_end(ves_tracer *tracer);

#endif

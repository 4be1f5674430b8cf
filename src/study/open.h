/* Opening what a user names: a problem file (-: stdin), or a run folder, which is its problem at the best
 * design; RUN:K is optimum K of it, SWEEP:N point N of a sweep, with its parameters. */
#ifndef VES_STUDY_OPEN_H
#define VES_STUDY_OPEN_H

#include "problem/problem.h"
#include "problem/tree.h"

typedef struct ves_open_options {
    ves_read_options read; /* overrides come after those of a run */
    const char *start;     /* what is the start, as ves_best_find names it; or NULL */
} ves_open_options;

typedef struct ves_opened {
    ves_arena arena;
    ves_problem *problem;
    const char *name; /* for files made from it: that of the problem file, or of the run folder */
} ves_opened;

/* On failure there is nothing to close. */
ves_status ves_study_open(const char *path, const ves_open_options *options, ves_opened *opened,
                          ves_diag *diag);
void ves_study_close(ves_opened *opened);

/* A number in SI units as --set needs it: with its dimension, 0.0345 m; an angle that the file gives in degrees
 * too. NULL: out of memory. */
const char *ves_study_quantity(const char *number, ves_dim dim, const ves_shown *shown, ves_arena *arena);

/* What makes x [variables], SI, the start of a problem, moved into the ranges: set [variables]. VES_MEMORY. */
ves_status ves_study_starts(const ves_problem *problem, const double *x, ves_arena *arena, ves_override *set);

/* A file of up to 64 MB, terminated, in the arena. VES_IO: errno says why; 0: it is none, or larger. */
ves_status ves_study_load(const char *path, ves_arena *arena, char **text, size_t *length);

/* A JSON object as a tree (JSON is YAML). NULL: it is not whole, or no object. */
const ves_node *ves_study_json(const char *text, size_t length, ves_arena *arena);

#endif

/* A design that a folder keeps: names and numbers as they are written there. */
#ifndef VES_STUDY_BEST_H
#define VES_STUDY_BEST_H

#include "problem/tree.h"
#include "vesica/diag.h"

typedef struct ves_best {
    const char *run;            /* as the user names it */
    const ves_node *variables;  /* a mapping */
    const ves_node *parameters; /* a mapping: those that a sweep has set at this point; or NULL */
    const char *branch;         /* the branch of the sweep that this is of; or NULL */
    const ves_node *plugins;    /* the files of the measures that it needs, or NULL */
    bool other;                 /* of another problem, perhaps: it may lack variables */
} ves_best;

/* The best design of a run folder. */
ves_status ves_best_read(const char *run, ves_arena *arena, ves_best *best, ves_diag *diag);

/* FOLDER:NUMBER in parts; false: it is no such thing, or a folder. */
bool ves_best_split(const char *start, ves_arena *arena, char **folder, long *number);

/* What --start names: a run, or RUN:K, optimum K of it, from 1, the best; or SWEEP:N, point N of a sweep, from 0. */
ves_status ves_best_find(const char *start, ves_arena *arena, ves_best *best, ves_diag *diag);

#endif

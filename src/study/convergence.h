/* Convergence: how a run came to its best, as a chart of its journal: the best feasible value over the evaluations,
 * and the values of feasible candidates that were accepted. */
#ifndef VES_STUDY_CONVERGENCE_H
#define VES_STUDY_CONVERGENCE_H

#include "study/entries.h"

/* Reads the entries to their end. path: PNG, SVG or PDF, by the ending. VES_RANGE: there is nothing to draw. */
ves_status ves_convergence_write(ves_entries *entries, const char *path, ves_arena *arena, ves_diag *diag);

#endif

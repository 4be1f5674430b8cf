/* A grid that is chosen at the start design may be too coarse where the search ends: what it takes to go on
 * there on a finer one. */
#ifndef VES_STUDY_SETTLE_H
#define VES_STUDY_SETTLE_H

#include "study/inside.h"

/* The grid that the best of a run asks for, nowhere coarser than its own. change: what the choice left.
 * Returns VES_OK or a fault. */
ves_status ves_settle_grid(const ves_run *run, int grid[2], double *change);

/* The last polish of a search, alone, with what is left of its budget. false: it has none, or there is not
 * enough left for one. */
bool ves_settle_search(const ves_search_options *search, const ves_run *run, long left,
                       ves_search_options *again);

/* The optima of a run that were polished once more were found as often as the old ones, of the coarser grid,
 * from which they come. */
ves_status ves_settle_hits(const ves_optimum *old, int count, ves_arena *arena, ves_run *run);

/* After a search: when the grid does not settle the best, another one and a last polish there, or the advice
 * to give one. */
ves_status ves_settle_best(ves_study *study);

#endif

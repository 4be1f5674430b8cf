/* The picture of an annealing: how much was accepted, and the heat capacity, over the temperature. */
#ifndef VES_STUDY_ANNEALING_H
#define VES_STUDY_ANNEALING_H

#include "base/arena.h"
#include "vesica/run.h"

/* Is there one: an annealing that went through two temperatures at least? */
bool ves_annealing_seen(const ves_run *run);

/* Of all annealings of a run, below each other. path: PNG, SVG or PDF, by the ending. */
ves_status ves_annealing_draw(const ves_run *run, const char *path, ves_arena *arena, ves_diag *diag);

#endif

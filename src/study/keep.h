/* What a run leaves in its folder. */
#ifndef VES_STUDY_KEEP_H
#define VES_STUDY_KEEP_H

#include "study/run.h"

/* problem.yaml, at the beginning. */
ves_status ves_keep_problem(const ves_run *run, ves_arena *arena, ves_diag *diag);

/* start.vtp, best.vtp, best.png, optima.png, annealing.png, result.json, times.json, log.txt, at the end. Goes on after a file that
 * cannot be written; returns the first failure. */
ves_status ves_keep_result(const ves_run *run, ves_plan *plan, ves_arena *arena, ves_diag *diag);

#endif

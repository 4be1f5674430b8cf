/* Designs that are kept. */
#ifndef VES_STUDY_DESIGN_H
#define VES_STUDY_DESIGN_H

#include "base/arena.h"
#include "problem/problem.h"
#include "vesica/plan.h"

/* Measures the design at x, or at the start when x is NULL, and keeps it in the arena. Negative only for
 * faults. */
ves_status ves_design_measure(ves_plan *plan, const ves_problem *problem, const double *x, int level,
                              ves_arena *arena, ves_design *design);

#endif

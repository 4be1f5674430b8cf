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

/* The name of a kind, as people are told it; -1: "none of these". */
const char *ves_design_kind(const ves_problem *problem, int kind);

/* The violation of what a search tells, as in a design: a verdict has those of the constraints in units of
 * their `within`. NAN when the candidate failed. */
double ves_design_violation(const ves_problem *problem, const ves_record *record);

/* By how much a constraint is missed, relative to its size, from what a verdict says of it. */
double ves_design_excess(double constraint, double within);

#endif

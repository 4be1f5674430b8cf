/* Design: one candidate with everything that is measured on it, in the signs and units of the problem file.
 */
#ifndef VES_STUDY_DESIGN_H
#define VES_STUDY_DESIGN_H

#include "problem/problem.h"
#include "surface/figure.h"
#include "vesica/plan.h"

/* One constraint: its two sides in SI units, and how far it is violated, relative to its size. */
typedef struct ves_sides {
    double value, limit, violation;
} ves_sides;

typedef struct ves_design {
    ves_status status; /* positive: it cannot be measured; numbers are NAN */
    const double *x;   /* [variables] */
    double *slot;      /* [slots] variables, unknown, parameters */
    double *measure;   /* [measures] */
    ves_sides *side;   /* [constraints] */
    double objective;  /* as the file means it; NAN: the file has none */
    double violation;  /* the largest of the constraints, 0 without any */
    double similarity; /* factor of scale: */
    bool feasible;     /* every violation is within its tolerance */
} ves_design;

/* Takes the arrays of a design from the arena. */
ves_status ves_design_init(const ves_problem *problem, ves_arena *arena, ves_design *design);

/* Measures it at x (copied). Negative only for faults. */
ves_status ves_design_measure(ves_plan *plan, const ves_problem *problem, const double *x, int level,
                              ves_arena *arena, ves_design *design);

/* The largest relative difference of the measures and the objective of two designs; NAN when one cannot be
 * measured. Measures smaller than 1e-9 count as nothing. */
double ves_design_change(const ves_problem *problem, const ves_design *a, const ves_design *b);

#endif

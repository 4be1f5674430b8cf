/* A displacement of a surface of revolution as a change of the variables of its problem. */
#ifndef VES_PLAN_FOLLOW_H
#define VES_PLAN_FOLLOW_H

#include "plan/variation.h"

/* Of `wave`, as it was bound last, along the normal of the surface that `even` makes. Least squares over the surface:
 * change [variables], SI; made: the part of its square that they can make, 0 .. 1. A variable is not moved that cannot be
 * moved alone. VES_MEMORY. */
ves_status ves_follow_fit(const plan_variation *v, double *change, double *made);

#endif

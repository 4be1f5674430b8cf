/* The second variation in the variables of the file. */
#ifndef VES_PLAN_OWN_H
#define VES_PLAN_OWN_H

#include "vesica/stability.h"

/* Fills what ves_stability says of the variables; nothing, where no variable is free, or a gradient is missing. */
ves_status ves_own_find(const ves_problem *problem, ves_stability *out, ves_diag *diag);

#endif

/* Equations of a problem that could be met exactly, by every candidate, instead of by the search: one constraint
 * and one variable fewer, and no thin feasible set. Only proposed: to scale a shape, or to give a variable away,
 * is for the person who knows what it means. */
#ifndef VES_STUDY_PROPOSE_H
#define VES_STUDY_PROPOSE_H

#include "base/arena.h"
#include "problem/problem.h"
#include "vesica/plan.h"

typedef struct ves_elimination {
    int constraint; /* by index */
    int variable;   /* that solve: would find; -1: scale: */
} ves_elimination;

/* At most one of each kind, maybe for the same equation: by scale, and by the variable that, from the start
 * design, runs through an equation's root and moves it most. list [2]. Negative only for faults. */
ves_status ves_study_propose(ves_plan *plan, const ves_problem *problem, ves_arena *arena,
                             ves_elimination *list, int *count);

#endif

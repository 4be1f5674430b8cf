/* Idle variables: those that nothing judged was seen to depend on, such as the dilation of a circle along its
 * own axis. A search spends evaluations on them and a reader takes their values for a result: both should
 * know. */
#ifndef VES_STUDY_IDLE_H
#define VES_STUDY_IDLE_H

#include "problem/problem.h"
#include "vesica/plan.h"

/* idle: [variables], filled. false: it cannot be told, because too few designs can be measured or a
 * measure has no gradient. Takes from the arena.
 * test  a circle's own axis; a saddle is not idle */
bool ves_study_idle(ves_plan *plan, const ves_problem *problem, ves_arena *arena, bool *idle);

/* Puts idle variables of a proved design back to their start, where a search has left random values that mean
 * nothing: if value, violation and proof stay what they are; else x is left alone. */
void ves_study_rest(ves_plan *plan, const ves_problem *problem, const bool *idle, ves_arena *arena,
                    double *x);

#endif

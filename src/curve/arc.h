/* Arc length: the closed cubic spline through given points, sampled at equal distances along it. */
#ifndef VES_CURVE_ARC_H
#define VES_CURVE_ARC_H

#include <stdbool.h>

#include "base/arena.h"

/* sample[c * count + j], j = 0 .. count-1, starting at point 0, for `points` points point[3 i + c], no two
 * neighbours equal. Scratch comes from the arena. False: no memory. */
bool ves_arc_sample(const double *point, int points, int count, ves_arena *arena, double *sample);

#endif

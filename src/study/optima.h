/* The distinct ends of the runs of a benchmark, converged or not, on problems whose optima are not known. */
#ifndef VES_STUDY_OPTIMA_H
#define VES_STUDY_OPTIMA_H

#include "study/testbed.h"

/* Adds those of one problem to the bench. Two ends are one when their values differ by less than the last
 * target's gap; or by less than the second's, and the points by less than 0.05 of the ranges, or the problem
 * says that they are one design. Ends that are worse than the best by more than the first target's gap are on
 * their way, and left out. */
ves_status ves_optima_find(ves_testbed *testbed, int problem, ves_bench *bench, ves_arena *arena);

#endif

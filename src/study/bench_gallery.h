/* The shapes of what the runs of a benchmark ended at. */
#ifndef VES_STUDY_BENCH_GALLERY_H
#define VES_STUDY_BENCH_GALLERY_H

#include "study/testbed.h"

/* Into the folder: optima/PROBLEM.png, of each problem file, the best distinct ends with how many runs of each method
 * ended there. testbed: [problems] */
ves_status ves_bench_gallery_write(const ves_bench *bench, ves_testbed *testbed, ves_diag *diag);

#endif

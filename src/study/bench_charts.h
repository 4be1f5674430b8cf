/* The pictures of a benchmark. */
#ifndef VES_STUDY_BENCH_CHARTS_H
#define VES_STUDY_BENCH_CHARTS_H

#include "study/bench.h"

/* Into the folder: ecdf.png, profile-1e-1.png, -1e-3, -1e-5, and convergence/PROBLEM.png. */
ves_status ves_bench_charts_write(const ves_bench *bench, const ves_tally_input *input, ves_diag *diag);

#endif

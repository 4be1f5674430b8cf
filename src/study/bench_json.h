/* The result of a benchmark as JSON. */
#ifndef VES_STUDY_BENCH_JSON_H
#define VES_STUDY_BENCH_JSON_H

#include "output/output.h"
#include "study/bench.h"

/* The members of one object, whose braces are the caller's. clocks: also what clocks say, which differs from
 * run to run. */
void ves_bench_json(const ves_bench *bench, bool clocks, ves_json *json);

#endif

/* The result of a benchmark, for people. */
#ifndef VES_APP_SCREEN_BENCH_H
#define VES_APP_SCREEN_BENCH_H

#include "app/app.h"
#include "study/bench.h"

void app_screen_bench(const ves_bench *bench, FILE *out);

#endif

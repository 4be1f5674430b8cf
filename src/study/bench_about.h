/* bench.json: what the runs of a benchmark rest on. Whoever goes on with it must find the same, or its runs would
 * not compare: the suite, the problem files as they were read (copies of both are in the folder), the plugins
 * and programs, and the version. */
#ifndef VES_STUDY_BENCH_ABOUT_H
#define VES_STUDY_BENCH_ABOUT_H

#include "suite/suite.h"
#include "vesica/diag.h"

/* Writes suite.yaml, problems/NUMBER.yaml (problem[problems]: the text as read, NULL: it is no file) and bench.json.
 * Again when a method is added. */
ves_status ves_bench_about_write(const char *folder, const ves_suite *suite, const char *const *problem,
                                 ves_diag *diag);

typedef struct ves_bench_about {
    const char *path; /* of the suite, absolute */
    char *text;       /* as it was run */
    size_t length;
    int methods;
    const char **method; /* in the order of the runs */
} ves_bench_about;

/* VES_STALE: something is not as it was. */
ves_status ves_bench_about_read(const char *folder, ves_arena *arena, ves_bench_about *about, ves_diag *diag);

/* The copy of the file of problem `problem`. NULL: out of memory. */
char *ves_bench_about_problem(const char *folder, int problem, ves_arena *arena);

#endif

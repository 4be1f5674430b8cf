/* Testbed: a problem of a suite made ready for several threads, seen from the unit box. */
#ifndef VES_STUDY_TESTBED_H
#define VES_STUDY_TESTBED_H

#include "study/bench.h"
#include "suite/instance.h"
#include "vesica/plan.h"

typedef struct ves_testbed {
    const ves_suite_problem *problem;
    const ves_bench_hooks *hooks;
    int jobs;
    uint64_t seed; /* of the suite */
    ves_bench_problem facts;
    ves_problem *source; /* FILE */
    int grid[2];
    ves_plan **plan;                /* [jobs], made when first asked for */
    const ves_objective *objective; /* PLUGIN */
    void **state;                   /* [jobs] as plan */
} ves_testbed;

/* Reads what the problem names and tells its facts. The first four fields are the caller's. */
ves_status ves_testbed_open(ves_testbed *testbed, ves_arena *arena, ves_diag *diag);
void ves_testbed_close(ves_testbed *testbed);

/* Run `seed` of it, for one thread: lives as long as the arena. */
typedef struct ves_pose {
    ves_search_problem problem; /* in the unit box; without a start */
    double optimum;             /* NAN: not known */
    /* behind it */
    ves_instance instance;
    double *room;            /* [2 n] */
    ves_search_problem file; /* in its own units */
    void *state;             /* PLUGIN */
    const ves_objective *objective;
    double *x; /* [n] */
} ves_pose;
ves_status ves_testbed_pose(ves_testbed *testbed, int worker, int seed, ves_arena *arena, ves_pose *pose);

/* FILE, PLUGIN: a point of the unit box in the units of the problem. */
void ves_testbed_place(const ves_pose *pose, const double *u, double *x);

#endif

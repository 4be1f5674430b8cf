/* Ring: a problem of a suite made ready to be fought over by several threads: seen from the unit box. */
#ifndef VES_STUDY_RING_H
#define VES_STUDY_RING_H

#include "study/bench.h"
#include "suite/instance.h"
#include "vesica/plan.h"

typedef struct ves_ring {
    const ves_bout *bout;
    const ves_bench_hooks *hooks;
    int jobs;
    uint64_t seed; /* of the suite */
    ves_bench_bout facts;
    ves_problem *problem; /* FILE */
    int grid[2];
    ves_plan **plan;                /* [jobs], made when first asked for */
    const ves_objective *objective; /* PLUGIN */
    void **state;                   /* [jobs] as plan */
} ves_ring;

/* Reads what the bout names and tells its facts. The first four fields are the caller's. */
ves_status ves_ring_open(ves_ring *ring, ves_arena *arena, ves_diag *diag);
void ves_ring_close(ves_ring *ring);

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
ves_status ves_ring_pose(ves_ring *ring, int worker, int seed, ves_arena *arena, ves_pose *pose);

/* FILE, PLUGIN: a point of the unit box in the units of the problem. */
void ves_ring_place(const ves_pose *pose, const double *u, double *x);

#endif

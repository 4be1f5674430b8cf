/* Restarts of CMA-ES: which population, step and start come next. A pure state machine: no run, no values.
 *
 * IPOP: each run has twice the population of the last (Auger and Hansen 2005).
 * BIPOP: two regimes that take turns by what they have spent: runs of doubling populations, and short runs of
 * small populations with small first steps (Hansen 2009).
 * No search asks for BIPOP or for another growth than 2: bench/restarts.c does, and so measures why (ipop.c).
 * Starts are uniform in the unit box; run r depends on (seed, stream, r) and on what the runs before it spent. */
#ifndef VES_SEARCH_IPOP_H
#define VES_SEARCH_IPOP_H

#include <stdbool.h>
#include <stdint.h>

typedef struct ves_ipop_options {
    uint64_t seed;
    uint32_t stream;
    bool two;      /* BIPOP */
    int first;     /* population of the first run */
    int most;      /* no population is larger */
    double growth; /* factor from one population to the next */
    double sigma;  /* first step, in parts of the box */
} ves_ipop_options;

/* As the literature for n variables, BIPOP's two regimes off. */
ves_ipop_options ves_ipop_default(int n);

typedef struct ves_ipop {
    ves_ipop_options options;
    int n, runs, doubled; /* runs begun; of these with a population grown beyond the first */
    bool small;           /* the last one was of the second regime */
    long spent[2];        /* evaluations by regime; the first run counts for neither */
    long last;            /* of the last large run */
} ves_ipop;

typedef struct ves_ipop_run {
    int lambda;
    double sigma;
    long limit; /* evaluations it may take; 0: no limit of its own */
} ves_ipop_run;

void ves_ipop_init(ves_ipop *ipop, int n, const ves_ipop_options *options);

/* The next run, after the last one has taken `spent` evaluations (0 at first). mean [n] in the unit box. */
void ves_ipop_next(ves_ipop *ipop, long spent, ves_ipop_run *run, double *mean);

#endif

/* Schedules: the temperatures of an annealing, and how long to stay at each. One file each. */
#ifndef VES_SEARCH_SCHEDULE_H
#define VES_SEARCH_SCHEDULE_H

#include "vesica/search.h"

typedef struct ves_cooling {
    double c0, c_end; /* first and last temperature */
    double s;
    long trials; /* at each temperature, of each chain */
    int temperatures;
} ves_cooling;

typedef struct ves_schedule {
    const char *name, *about;
    /* options: completed, c0 known. per_chain: trials that one chain may make. */
    void (*init)(const ves_anneal *options, double c0, int n, long per_chain, ves_cooling *cooling);
    double (*temperature)(const ves_cooling *cooling, int m);
} ves_schedule;

extern const ves_schedule ves_schedule_exponential;

#endif

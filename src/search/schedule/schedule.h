/* Schedules: the temperatures of an annealing, and how long to stay at each. One file each; the file's name is the
 * descriptor's, and the word in problem files. An annealing goes in legs: from hot to cold, once or several times;
 * at the end of a leg the chains may be polished and placed anew. */
#ifndef VES_SEARCH_SCHEDULE_H
#define VES_SEARCH_SCHEDULE_H

#include "vesica/search.h"

enum { VES_TEMPERATURES = 200 }; /* of a leg: no more unless the schedule is given, and no more are told */

typedef struct ves_cooling {
    /* given */
    const ves_anneal *options; /* completed */
    int n, chains;
    double c0, c_end; /* first and last temperature */
    long whole, left; /* trials that each chain may make: at first, when the leg begins */
    /* the leg, set by the schedule */
    int leg;    /* index */
    bool fresh; /* it begins at new points, with what was adapted forgotten */
    double from, s;
    long m, temperatures;
    /* now */
    double c;
    long trials;  /* of each chain at this temperature */
    bool settled; /* nothing is adapted: the chains sample */
    bool cold;    /* the leg has reached its last temperature */
    /* of schedules that go by what they see */
    double rate; /* lam: acceptance, averaged */
    double peak; /* reheat: where the heat capacity of the legs before was largest; 0: it has no peak */
} ves_cooling;

typedef struct ves_schedule {
    const char *name, *about;
    bool samples; /* it does not cool */
    bool steers;  /* by the acceptance: that nothing is accepted for a while does not end it */
    /* A leg begins: its first temperature. False: there is none any more. cooling->leg counts by itself. */
    bool (*begin)(ves_cooling *cooling);
    /* The next temperature of the leg, after what was seen at the last. False: it is over. */
    bool (*next)(ves_cooling *cooling, const ves_temperature *seen);
} ves_schedule;

/* cooling.c: the exponential schedule  c_m = from * e^{(s-1) m}  [Ugail 2011, eq 7.3] down to c_end within the
 * trials. */
void ves_cooling_begin(ves_cooling *cooling, double from, long trials);
bool ves_cooling_next(ves_cooling *cooling);

#endif

/* Profiles: the curves that runs are compared by. Each fills x and y, ascending in x. */
#ifndef VES_SUITE_PROFILE_H
#define VES_SUITE_PROFILE_H

#include "suite/tally.h"

enum { VES_PROFILE_TARGETS = 13, VES_PROFILE_POINTS = 80 };

/* Share of all (problem, target, run) that a method has solved within x cost units for each variable, over
 * targets evenly spaced in their logarithm between the first and the last (COCO: Hansen et al. 2021). x, y
 * [room] with room = problems * seeds * VES_PROFILE_TARGETS + 2. Returns how many points. */
int ves_profile_ecdf(const ves_tally_input *input, const ves_tally *tally, int method, double *x, double *y);

/* Share of (problem, run) where a method has found f <= f_L + tau (f_0 - f_L) within x (n + 1) cost units:
 * data profile [More and Wild 2009], f_L the best that any method found in that run (not below the reference), f_0 the
 * worst value that any began with. [room] = problems * seeds + 2. */
int ves_profile_data(const ves_tally_input *input, const ves_tally *tally, int method, double tau, double *x,
                     double *y);

/* Median and quartiles over the runs of how far the best feasible value is above the reference, at costs
 * evenly spaced in their logarithm from 1 to the budget; not below `least`. low, high [VES_PROFILE_POINTS]
 * too; INFINITY: nothing feasible yet. */
typedef struct ves_profile_band {
    double x[VES_PROFILE_POINTS], y[VES_PROFILE_POINTS], low[VES_PROFILE_POINTS], high[VES_PROFILE_POINTS];
} ves_profile_band;
/* False: out of memory. */
bool ves_profile_convergence(const ves_tally_input *input, const ves_tally *tally, int method, int problem,
                             double least, ves_profile_band *band);

#endif

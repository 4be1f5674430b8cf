#include "search/schedule/schedule.h"

/* One temperature, c0: the chains sample the Boltzmann distribution (7.2). In the first tenth widths and
 * covariances are adapted; after it they stay, or what is sampled would not be that distribution. The statistics
 * of the two parts are told apart. */

static bool begin(ves_cooling *cooling)
{
    if (cooling->leg) return false;
    cooling->from = cooling->c = cooling->c0;
    cooling->temperatures = 2;
    cooling->trials = cooling->left / 10;
    if (cooling->trials < 1) cooling->trials = 1;
    return true;
}

static bool next(ves_cooling *cooling, const ves_temperature *seen)
{
    (void)seen;
    if (++cooling->m >= cooling->temperatures || cooling->left <= cooling->trials) return false;
    cooling->settled = true;
    cooling->trials = cooling->left - cooling->trials;
    return true;
}

const ves_schedule ves_schedule_fixed = {
    .name = "fixed",
    .about = "one temperature, c0: samples; nothing is adapted after the first tenth",
    .samples = true,
    .begin = begin,
    .next = next,
};

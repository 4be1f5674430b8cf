#include "search/schedule/schedule.h"

/* Exponential to c_end in legs of equal length, the first from c0; each further one goes on from where the chains
 * are, at the temperature where the heat capacity, variance of f / c^2, was largest in the legs before: there the
 * large choices are made (Abramson, Krishnamoorthy and Dang 1999), and above it nothing is learnt. */

enum { LEGS = 6, LEAST = 100 };

static bool begin(ves_cooling *cooling)
{
    long least = LEAST * (long)cooling->n, legs = cooling->whole / least;
    legs = legs < 1 ? 1 : legs > LEGS ? LEGS : legs;
    if (cooling->leg && cooling->left < (cooling->leg < legs ? 1 : least)) return false;
    long share = cooling->leg < legs ? cooling->left / (legs - cooling->leg) : cooling->left;
    double from = cooling->leg && cooling->peak > 0 ? cooling->peak : cooling->c0;
    ves_cooling_begin(cooling, from, share);
    return true;
}

static bool next(ves_cooling *cooling, const ves_temperature *seen)
{
    (void)seen;
    return ves_cooling_next(cooling);
}

const ves_schedule ves_schedule_reheat = {
    .name = "reheat",
    .about = "exponential, again and again from where the heat capacity was largest",
    .begin = begin,
    .next = next,
};

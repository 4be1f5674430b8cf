#include "search/schedule/schedule.h"

/* Exponential to c_end, several times, each from new points and twice as long as the one before. Nobody knows
 * beforehand how long an annealing must be: so the longest one is half of what there is, and the shorter ones cost no
 * more than it does. The shortest makes some fifty trials for each variable: 1/15, 2/15, 4/15, 8/15 of a middling budget,
 * up to eight legs of a large one (four legs whatever the budget cost easy functions two to four times as much, and
 * solved no more), one leg of a small one. What a leg leaves over, frozen early, or a polish gives back, is for
 * further legs. */

enum { LEGS = 8, LEAST = 50 }; /* trials of the shortest leg for each variable */

static long length(const ves_cooling *cooling)
{
    long least = LEAST * (long)cooling->n;
    int legs = LEGS;
    while (legs > 1 && cooling->whole / ((1L << legs) - 1) < least) legs--;
    if (cooling->leg >= legs)
        return cooling->left >= least && cooling->left > cooling->whole / 30 ? cooling->left : 0;
    long share = cooling->whole / ((1L << legs) - 1) << cooling->leg;
    bool last = cooling->leg == legs - 1;
    return last || share > cooling->left ? cooling->left : share;
}

static bool begin(ves_cooling *cooling)
{
    long trials = length(cooling);
    if (trials <= 0 && cooling->leg) return false;
    cooling->fresh = cooling->leg > 0;
    ves_cooling_begin(cooling, cooling->c0, trials);
    return true;
}

static bool next(ves_cooling *cooling, const ves_temperature *seen)
{
    (void)seen;
    return ves_cooling_next(cooling);
}

const ves_schedule ves_schedule_budget = {
    .name = "budget",
    .about = "exponential, within the budget; again from new points, each time twice as long",
    .begin = begin,
    .next = next,
};

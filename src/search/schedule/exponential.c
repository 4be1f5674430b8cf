#include <math.h>

#include "search/schedule/schedule.h"

/* The book's schedule  c_m = c_0 e^{(s-1) m},  0 < s < 1  [Ugail 2011, eq 7.3]. Equilibrium is a fixed number
 * of trials at each temperature. When s is free: min(10 n, budget / 50), so that there are some fifty
 * temperatures or, with a large budget, more, and s such that the last one is c_end. When s is given: what the
 * budget allows each of the temperatures down to c_end, but at least min(n, budget / 50); c_end is then missed
 * where the budget is too short. */

enum { LEAST_TEMPERATURES = 50, TRIALS_PER_VARIABLE = 10 };

static long clamped(double value, long low, long high)
{
    return value < (double)low ? low : value > (double)high ? high : (long)value;
}

static void init(const ves_anneal *options, double c0, int n, long per_chain, ves_cooling *cooling)
{
    long budget = per_chain > 0 ? per_chain : 1;
    long trials = clamped((double)budget / LEAST_TEMPERATURES, 1, TRIALS_PER_VARIABLE * (long)n);
    double fall = log(options->c_end); /* <= 0 */
    double s = options->s;
    if (s == 0) {
        double steps = (double)(budget / trials) - 1;
        s = steps > 0 ? 1 + fall / steps : 0;
        s = s < 1e-3 ? 1e-3 : s > 1 - 1e-12 ? 1 - 1e-12 : s;
    } else {
        double temperatures = ceil(fall / (s - 1)) + 1;
        trials = clamped((double)budget / temperatures, trials < n ? trials : n, budget);
    }
    long temperatures = budget / trials;
    *cooling = (ves_cooling){.c0 = c0, .c_end = options->c_end * c0, .s = s, .trials = trials};
    cooling->temperatures = (int)(temperatures < 1000000000 ? temperatures : 1000000000);
}

static double temperature(const ves_cooling *cooling, int m)
{
    return cooling->c0 * exp((cooling->s - 1) * m);
}

const ves_schedule ves_schedule_exponential = {
    .name = "exponential",
    .about = "c_m = c_0 e^{(s-1) m}",
    .init = init,
    .temperature = temperature,
};

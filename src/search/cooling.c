#include <math.h>

#include "search/schedule/schedule.h"

/* Equilibrium is a fixed number of trials at each temperature. When s is free: min(10 n, trials / 50), so that
 * there are some fifty temperatures or, with a large budget, more, but no more than two hundred: from there on the
 * trials grow, but for `as: book`; and s such that the last one is c_end. When s is given: what the budget allows each
 * of the temperatures down to c_end, but at least min(n, trials / 50); c_end is then missed where the budget is too
 * short.
 * test  (7.3) to the last bit but rounding; never more trials than given */

enum { LEAST_TEMPERATURES = 50, TRIALS_PER_VARIABLE = 10 };

static long clamped(double value, long low, long high)
{
    return value < (double)low ? low : value > (double)high ? high : (long)value;
}

/* So that fewer than two hundred trials are left over. */
static long least_of(long budget)
{
    long least = budget / VES_TEMPERATURES;
    return least >= VES_TEMPERATURES || budget % VES_TEMPERATURES == 0 ? least : least + 1;
}

void ves_cooling_begin(ves_cooling *cooling, double from, long trials)
{
    long budget = trials > 0 ? trials : 1;
    long each = clamped((double)budget / LEAST_TEMPERATURES, 1, TRIALS_PER_VARIABLE * (long)cooling->n);
    double fall = log(cooling->c_end / from); /* <= 0 */
    double s = cooling->options->s;
    if (s == 0) {
        long least = cooling->options->as ? 1 : least_of(budget);
        if (each < least) each = least;
        double steps = (double)(budget / each) - 1;
        s = steps > 0 ? 1 + fall / steps : 0;
        s = s < 1e-3 ? 1e-3 : s > 1 - 1e-12 ? 1 - 1e-12 : s;
    } else {
        double temperatures = ceil(fall / (s - 1)) + 1;
        each = clamped((double)budget / temperatures, each < cooling->n ? each : cooling->n, budget);
    }
    cooling->from = cooling->c = from;
    cooling->s = s;
    cooling->m = 0;
    cooling->trials = each;
    cooling->temperatures = budget / each;
    cooling->cold = false;
}

bool ves_cooling_next(ves_cooling *cooling)
{
    cooling->cold = cooling->c_end < cooling->from && cooling->c <= cooling->c_end * (1 + 1e-9);
    if (cooling->cold || ++cooling->m >= cooling->temperatures) return false;
    cooling->c = cooling->from * exp((cooling->s - 1) * (double)cooling->m);
    return true;
}

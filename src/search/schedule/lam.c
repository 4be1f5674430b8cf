#include <math.h>

#include "search/schedule/schedule.h"

/* Lam and Delosme (1988) showed that cooling is fastest where 0.44 of the trials are accepted. Their schedule
 * estimates mean and variance of f along the way and needs moves whose size can be steered; here sizes follow the
 * acceptance by themselves, or have no scale. So it is taken in the form of Swartz (1993) and Boyan (1998), which
 * steers the temperature alone and needs no estimates, no s and no c_end: the acceptance is to be
 *     0.44 + 0.56 * 560^(-p/0.15)  up to p = 0.15;   0.44 up to 0.65;   0.44 * 440^(-(p-0.65)/0.35) to the end,
 * p the part of the budget that is spent; each trial raises or lowers the temperature by a thousandth (more when
 * the budget is small) when the average over some five hundred trials is below or above.
 * test  the acceptance between p = 0.2 and 0.65 */

enum { TEMPERATURES = 400, WINDOW = 500 };

static const double thousandth = 1e-3, way = 40; /* as many powers of e as the budget must be able to fall */

static bool begin(ves_cooling *cooling)
{
    if (cooling->leg) return false;
    long trials = cooling->left / TEMPERATURES, most = 2 * (long)cooling->n;
    cooling->trials = trials < 1 ? 1 : trials > most ? most : trials;
    cooling->temperatures = cooling->left / cooling->trials;
    cooling->from = cooling->c = cooling->c0;
    cooling->rate = 0.5;
    return true;
}

static double target(double p)
{
    if (p < 0.15) return 0.44 + 0.56 * pow(560, -p / 0.15);
    if (p < 0.65) return 0.44;
    return 0.44 * pow(440, -(p - 0.65) / 0.35);
}

static bool next(ves_cooling *cooling, const ves_temperature *seen)
{
    double trials = (double)seen->trials, all = (double)cooling->temperatures * trials;
    double window = fmin(WINDOW, all / 10), step = fmax(thousandth, way / all);
    double keep = exp(-trials / window);
    if (trials > 0) cooling->rate = keep * cooling->rate + (1 - keep) * ((double)seen->accepted / trials);
    if (++cooling->m >= cooling->temperatures) {
        cooling->cold = true;
        return false;
    }
    bool over = cooling->rate > target((double)cooling->m / (double)cooling->temperatures);
    double c = cooling->c * exp(over ? -step * trials : step * trials);
    cooling->c = fmin(fmax(c, 1e-14 * cooling->c0), 1e4 * cooling->c0);
    return true;
}

const ves_schedule ves_schedule_lam = {
    .name = "lam",
    .about = "as cold as leaves 0.44 of the trials accepted",
    .steers = true,
    .begin = begin,
    .next = next,
};

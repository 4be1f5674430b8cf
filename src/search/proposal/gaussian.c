#include "search/proposal/proposal.h"

#include <math.h>

#include "search/point.h"

/* Normal steps: half of them along one coordinate, half along all. Each coordinate has its own width, which
 * follows the acceptance (Corana, Marchesi, Martini and Ridella 1987, with the gain of a stochastic
 * approximation instead of their table), and the steps along all share one more factor. Targets: 0.44 along
 * one coordinate, 0.234 along many (Roberts, Gelman and Gilks 1997). Without `adapt` the widths stay: the
 * generation mechanism of [Ugail 2011, 7.4.1].
 * state  factor of the steps along all, coordinate of the last trial (-1: all), width of each coordinate
 * test   mean energy n T / 2 in a quadratic well; populations of a double well; acceptance settles near the
 *        target */

enum { FACTOR, LAST, WIDTH };

static const double gain = 0.5, narrowest = 1e-10, widest = 1, target_one = 0.44, target_all = 0.234;

static int room(int n)
{
    return n + WIDTH;
}

static void init(int n, double step, double *state)
{
    state[FACTOR] = 1 / sqrt(n);
    state[LAST] = -1;
    for (int i = 0; i < n; i++) state[WIDTH + i] = step;
}

static void propose(int n, double *state, ves_random *random, double *u)
{
    bool one = n == 1 || ves_random_uniform(random) < 0.5;
    if (one) {
        int i = ves_random_below(random, n);
        state[LAST] = i;
        u[i] = ves_point_reflect(u[i] + state[WIDTH + i] * ves_random_normal(random));
        return;
    }
    state[LAST] = -1;
    for (int i = 0; i < n; i++)
        u[i] = ves_point_reflect(u[i] + state[FACTOR] * state[WIDTH + i] * ves_random_normal(random));
}

static double follow(double width, bool accepted, double target)
{
    double next = width * exp(gain * ((accepted ? 1 : 0) - target));
    return next < narrowest ? narrowest : next > widest ? widest : next;
}

static void adapt(int n, double *state, bool accepted)
{
    (void)n;
    if (state[LAST] < 0) {
        state[FACTOR] = follow(state[FACTOR], accepted, target_all);
        return;
    }
    double *width = &state[WIDTH + (int)state[LAST]];
    *width = follow(*width, accepted, target_one);
}

const ves_proposal ves_proposal_gaussian = {
    .name = "gaussian",
    .about = "normal steps along one coordinate or all; widths follow the acceptance",
    .room = room,
    .init = init,
    .propose = propose,
    .adapt = adapt,
};

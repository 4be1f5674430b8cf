#include <math.h>

#include "search/point.h"
#include "search/proposal/proposal.h"

/* One coordinate at a time, uniformly within its own width, which follows the acceptance (Corana, Marchesi,
 * Martini and Ridella 1987): after ten trials along a coordinate, of which the part r was accepted,
 *     r > 0.6: width *= 1 + 2 (r - 0.6) / 0.4;    r < 0.4: width /= 1 + 2 (0.4 - r) / 0.4.
 * The coordinate is drawn, not taken in turn: so each step is reversible.
 * state  coordinate of the last trial, then of each coordinate: width, trials, how many of them were accepted
 * test   mean energy n T / 2 in a quadratic well; populations of a double well; the acceptance settles between
 *        0.4 and 0.6 */

enum { LAST, WIDTH, TRIALS = 10 };

static const double narrowest = 1e-12, widest = 1, high = 0.6, low = 0.4, gain = 2;

static int room(int n)
{
    return WIDTH + 3 * n;
}

static void init(int n, double step, double *state)
{
    state[LAST] = 0;
    for (int i = 0; i < n; i++) {
        state[WIDTH + i] = step;
        state[WIDTH + n + i] = state[WIDTH + 2 * n + i] = 0;
    }
}

static void propose(int n, double *state, double heat, ves_random *random, double *u)
{
    double r[2];
    (void)heat;
    ves_random_pair(random, r);
    int i = (int)(r[0] * n);
    if (i == n) i = n - 1;
    state[LAST] = i;
    u[i] = ves_point_reflect(u[i] + state[WIDTH + i] * (2 * r[1] - 1));
}

static void adapt(int n, double *state, bool accepted)
{
    double *width = &state[WIDTH + (int)state[LAST]], *trials = width + n, *yes = trials + n;
    *yes += accepted;
    if (++*trials < TRIALS) return;
    double part = *yes / *trials;
    if (part > high) *width *= 1 + gain * (part - high) / (1 - high);
    if (part < low) *width /= 1 + gain * (low - part) / low;
    *width = *width < narrowest ? narrowest : *width > widest ? widest : *width;
    *trials = *yes = 0;
}

static double width(int n, double heat, const double *state)
{
    (void)heat;
    double sum = 0;
    for (int i = 0; i < n; i++) sum += log(state[WIDTH + i]);
    return exp(sum / n);
}

const ves_proposal ves_proposal_corana = {
    .name = "corana",
    .about = "one coordinate, within a width that follows the acceptance",
    .room = room,
    .init = init,
    .propose = propose,
    .adapt = adapt,
    .width = width,
};

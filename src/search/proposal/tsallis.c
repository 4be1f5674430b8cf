#include <math.h>

#include "search/point.h"
#include "search/proposal/proposal.h"

/* The visiting distribution of generalised annealing (Tsallis and Stariolo 1996) at q = 2.62, the value of Xiang,
 * Sun, Fan and Gong (1997): steps  w x / |y|^((q - 1) / (3 - q)),  x and y normal, whose density falls as
 * |step|^(-2 / (q - 1)); the width falls with the temperature, w = step * heat^(1 / (3 - q)). Every other step
 * goes along one coordinate, the others along all, with one y. A step of more than a thousand ranges, folded
 * into the box, is uniform there.
 * state  first width, room for the numbers
 * test   mean energy n T / 2 in a quadratic well; populations of a double well */

static const double q = 2.62, narrowest = 1e-9, farthest = 1e3;

static int room(int n)
{
    return 1 + n;
}

static void init(int n, double step, double *state)
{
    (void)n;
    state[0] = step;
}

static void move(double *u, double by, double uniform)
{
    *u = fabs(by) < farthest ? ves_point_reflect(*u + by) : uniform;
}

/* w of the formula. */
static double width(int n, double heat, const double *state)
{
    (void)n;
    return fmax(state[0] * pow(heat, 1 / (3 - q)), narrowest);
}

static void propose(int n, double *state, double heat, ves_random *random, double *u)
{
    double r[4], y[2], *z = state + 1;
    ves_random_four(random, r);
    ves_random_pair(random, y);
    double uniform = r[3];
    ves_random_turn(&y[0], &y[1]);
    double scale = width(n, heat, state) * pow(fabs(y[1]), -(q - 1) / (3 - q));
    if (n == 1 || r[0] < 0.5) {
        int i = (int)(r[1] * n);
        move(&u[i], scale * y[0], uniform);
        return;
    }
    ves_random_normals(random, n, z);
    for (int i = 0; i < n; i++) {
        if (fabs(scale * z[i]) >= farthest) uniform = ves_random_uniform(random);
        move(&u[i], scale * z[i], uniform);
    }
}

const ves_proposal ves_proposal_tsallis = {
    .name = "tsallis",
    .about = "one coordinate or all, by the visiting distribution of generalised annealing",
    .room = room,
    .init = init,
    .propose = propose,
    .width = width,
};

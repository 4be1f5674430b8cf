#include "search/proposal/proposal.h"

#include <math.h>

#include "search/point.h"

/* Steps without a scale: one to three coordinates, each by a normal step whose width is drawn
 * log-uniformly over three decades below the whole range. Nothing to adapt: at any temperature some of the
 * widths fit. Heavy tails as in the visiting distribution of generalised annealing (Tsallis and Stariolo
 * 1996).
 * test  as gaussian */

static const double decades = 3;

static int room(int n)
{
    (void)n;
    return 0;
}

static void init(int n, double step, double *state)
{
    (void)n, (void)step, (void)state;
}

static void propose(int n, double *state, ves_random *random, double *u)
{
    (void)state;
    double many = ves_random_uniform(random);
    int count = many < 0.5 ? 1 : many < 0.75 ? 2 : 3;
    for (int k = 0; k < count && k < n; k++) {
        int i = ves_random_below(random, n);
        double width = pow(10, -decades * ves_random_uniform(random));
        u[i] = ves_point_reflect(u[i] + width * ves_random_normal(random));
    }
}

const ves_proposal ves_proposal_heavy = {
    .name = "heavy",
    .about = "one to three coordinates by widths over three decades",
    .room = room,
    .init = init,
    .propose = propose,
};

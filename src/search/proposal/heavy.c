#include <math.h>

#include "search/point.h"
#include "search/proposal/proposal.h"

/* Steps without a scale: one to three coordinates, each by a normal step whose width is drawn log-uniformly
 * over DECADES below the whole range. Nothing to adapt: at any temperature some of the widths fit. Heavy tails
 * as in the visiting distribution of generalised annealing (Tsallis and Stariolo 1996), with a density of
 * steps that falls as 1 / |step|, which is 2 / (q - 1) = 1 there: q = 3, the limit.
 * test  mean energy n T / 2 in a quadratic well; populations of a double well */

static const double decades = 3;

static void propose(int n, double *state, double heat, ves_random *random, double *u)
{
    double r[4];
    int count = 1;
    (void)state, (void)heat;
    for (int k = 0; k < count && k < n; k++) {
        ves_random_four(random, r);
        if (!k) count = r[0] < 0.5 ? 1 : r[0] < 0.75 ? 2 : 3;
        if (!k) r[0] = r[0] < 0.5 ? 2 * r[0] : r[0] < 0.75 ? 4 * r[0] - 2 : 4 * r[0] - 3; /* uniform again */
        int i = (int)(r[0] * n);
        double width = exp2(-decades * 3.3219280948873623 * r[1]); /* log2(10) */
        ves_random_turn(&r[2], &r[3]);
        u[i] = ves_point_reflect(u[i] + width * r[2]);
    }
}

const ves_proposal ves_proposal_heavy = {
    .name = "heavy",
    .about = "one to three coordinates, by widths of any size",
    .propose = propose,
};

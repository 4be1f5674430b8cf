#include "search/point.h"
#include "search/proposal/proposal.h"

/* The generation mechanism of [Ugail 2011, 7.4.1]: an element of the neighbourhood, at random. The neighbourhood
 * is the box that reaches one step each way along every coordinate.
 * state  width
 * test   mean energy n T / 2 in a quadratic well; populations of a double well */

static int room(int n)
{
    return 1 + n; /* and room for the numbers */
}

static void init(int n, double step, double *state)
{
    (void)n;
    state[0] = step;
}

static void propose(int n, double *state, double heat, ves_random *random, double *u)
{
    double *r = state + 1;
    (void)heat;
    ves_random_uniforms(random, n, r);
    for (int i = 0; i < n; i++) u[i] = ves_point_reflect(u[i] + state[0] * (2 * r[i] - 1));
}

static double width(int n, double heat, const double *state)
{
    (void)n, (void)heat;
    return state[0];
}

const ves_proposal ves_proposal_fixed = {
    .name = "fixed",
    .about = "anywhere in a box of fixed size around the point: the book's",
    .room = room,
    .init = init,
    .propose = propose,
    .width = width,
};

#include "search/slots.h"

/* The default: steps of any size find the basin, the two that adapt its bottom; covariance knows valleys that run
 * across the axes. Learning from the steps of the others costs nothing. Shares, of eight classic functions in 10 and 20
 * variables, polished at stage ends, values only: three quarters heavy reach Rastrigin's and Schwefel's optima in half
 * the evaluations that one half needs (13k against 22k, 67k against 152k; 16k against 33k, 57k against 105k), and the
 * others in as many; without a polish one half would be the better share (Ackley 43k against 94k). */

static const ves_share shares[] = {
    {&ves_proposal_heavy, 0.75}, {&ves_proposal_covariance, 0.125}, {&ves_proposal_corana, 0.125}, {0}};

const ves_proposal ves_proposal_mixture = {
    .name = "mixture",
    .about = "three quarters heavy, an eighth covariance, an eighth corana",
    .share = shares,
};

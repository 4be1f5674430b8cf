#include "search/slots.h"

/* The default: steps of any size find the basin and, with the two that adapt, the bottom of it; covariance knows
 * valleys that run across the axes. Learning from the steps of the others costs nothing. */

static const ves_share shares[] = {
    {&ves_proposal_heavy, 0.5}, {&ves_proposal_covariance, 0.25}, {&ves_proposal_corana, 0.25}, {0}};

const ves_proposal ves_proposal_mixture = {
    .name = "mixture",
    .about = "half heavy, a quarter covariance, a quarter corana",
    .share = shares,
};

#include "search/hop.h"

/* Descents by gradients where there are any. */

static void *create(ves_team *team, uint32_t stream)
{
    return ves_hop_create(team, stream, team->session->problem->gradients);
}

const ves_strategy ves_strategy_hop = {
    .name = "hop",
    .about = "basin hopping: descents from beside the best minimum, also by differences of known minima",
    .share = {0.35, 0.5, 0.7, 0.9},
    .create = create,
    .least = ves_hop_least,
    .advance = ves_hop_advance,
    .refused = ves_hop_refused,
    .destroy = ves_hop_destroy,
};

#include "search/hop.h"

/* Descents from values though there are gradients: a model of wide steps does not see the ripples that a
 * gradient follows, and a value is cheaper. */

static void *create(ves_team *team, uint32_t stream)
{
    return ves_hop_create(team, stream, false);
}

const ves_strategy ves_strategy_leap = {
    .name = "leap",
    .about = "basin hopping by values alone, also where there are gradients",
    .share = {0, 0.2, 0.05, 0},
    .create = create,
    .least = ves_hop_least,
    .advance = ves_hop_advance,
    .refused = ves_hop_refused,
    .destroy = ves_hop_destroy,
};

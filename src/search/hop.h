/* Basin hopping, for strategies that differ in how they descend. */
#ifndef VES_SEARCH_HOP_H
#define VES_SEARCH_HOP_H

#include "search/strategy/strategy.h"

/* slopes: by exact gradients, which the problem has; else from values. The others as in a ves_strategy. */
void *ves_hop_create(ves_team *team, uint32_t stream, bool slopes);
long ves_hop_least(const void *state);
ves_status ves_hop_advance(void *state, long some, long most);
void ves_hop_refused(void *state);
void ves_hop_destroy(void *state);

#endif

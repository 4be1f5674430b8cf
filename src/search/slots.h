/* The choices of each slot of an annealing, by name. The build collects the folders. */
#ifndef VES_SEARCH_SLOTS_H
#define VES_SEARCH_SLOTS_H

#include "search/constraint/constraint.h"
#include "search/population/population.h"
#include "search/proposal/proposal.h"
#include "search/schedule/schedule.h"
#include "search/strategy/strategy.h"

#define VES_ENTRY(symbol) extern const ves_proposal symbol;
#include "proposals.inc"
#undef VES_ENTRY
#define VES_ENTRY(symbol) extern const ves_schedule symbol;
#include "schedules.inc"
#undef VES_ENTRY
#define VES_ENTRY(symbol) extern const ves_population symbol;
#include "populations.inc"
#undef VES_ENTRY
#define VES_ENTRY(symbol) extern const ves_constraint symbol;
#include "constraints.inc"
#undef VES_ENTRY

#define VES_ENTRY(symbol) extern const ves_strategy symbol;
#include "strategies.inc"
#undef VES_ENTRY

/* NULL: no such name. */
const ves_proposal *ves_slots_proposal(const char *name);
const ves_schedule *ves_slots_schedule(const char *name);
const ves_population *ves_slots_population(const char *name);
const ves_constraint *ves_slots_constraint(const char *name);

/* All of them, by name; NULL-terminated. */
const ves_strategy *const *ves_slots_strategies(void);

/* Is it a word of this slot? NULL always is. */
bool ves_slots_known(ves_slot slot, const char *name);

/* Fills in the words of `as`, and the defaults for what is still open. followed: a polish is the next stage. */
void ves_slots_complete(ves_anneal *options, bool followed);

/* Are all words known, and do they go together? */
bool ves_slots_check(const ves_anneal *options);

#endif

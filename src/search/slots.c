#include "search/slots.h"

#include <string.h>

static const ves_proposal *const PROPOSALS[] = {
#define VES_ENTRY(symbol) &symbol,
#include "proposals.inc"
#undef VES_ENTRY
    NULL};

static const ves_schedule *const SCHEDULES[] = {
#define VES_ENTRY(symbol) &symbol,
#include "schedules.inc"
#undef VES_ENTRY
    NULL};

static const ves_population *const POPULATIONS[] = {
#define VES_ENTRY(symbol) &symbol,
#include "populations.inc"
#undef VES_ENTRY
    NULL};

static const ves_constraint *const CONSTRAINTS[] = {
#define VES_ENTRY(symbol) &symbol,
#include "constraints.inc"
#undef VES_ENTRY
    NULL};

static const ves_strategy *const STRATEGIES[] = {
#define VES_ENTRY(symbol) &symbol,
#include "strategies.inc"
#undef VES_ENTRY
    NULL};

/* Not one file each: these say when descents are called, not how. */
static const ves_choice *const POLISHES[] = {
    &(const ves_choice){"none", "the ends are where the chains end"},
    &(const ves_choice){"end", "a descent from the best end of each chain"},
    &(const ves_choice){"stages",
                        "a descent from each chain at the end of each leg; what they leave goes back"},
    NULL};

/* Whole annealings by one word. */
static const ves_choice *const PRESETS[] = {
    &(const ves_choice){"book",
                        "the loop of Ugail 2011, section 7.4: fixed steps, one chain, a crude penalty"},
    NULL};

/* Every list ends with NULL, every descriptor begins with name and about. */
#define FIND(list, wanted)                                                                                   \
    for (int k = 0; list[k]; k++)                                                                            \
        if (!strcmp(list[k]->name, wanted)) return list[k];                                                  \
    return NULL

const ves_proposal *ves_slots_proposal(const char *name)
{
    FIND(PROPOSALS, name);
}

const ves_schedule *ves_slots_schedule(const char *name)
{
    FIND(SCHEDULES, name);
}

const ves_population *ves_slots_population(const char *name)
{
    FIND(POPULATIONS, name);
}

const ves_constraint *ves_slots_constraint(const char *name)
{
    FIND(CONSTRAINTS, name);
}

const ves_strategy *const *ves_slots_strategies(void)
{
    return STRATEGIES;
}

/* The one at index of a list whose end is NULL; what lies behind the end is not looked at. */
#define TELL(list)                                                                                           \
    for (int k = 0; list[k] && k <= index; k++)                                                              \
        if (k == index) found = (ves_choice){list[k]->name, list[k]->about};                                 \
    break

bool ves_search_choice(ves_slot slot, int index, ves_choice *choice)
{
    ves_choice found = {0};
    switch (slot) {
    case VES_SLOT_PROPOSAL:
        TELL(PROPOSALS);
    case VES_SLOT_SCHEDULE:
        TELL(SCHEDULES);
    case VES_SLOT_POPULATION:
        TELL(POPULATIONS);
    case VES_SLOT_CONSTRAINTS:
        TELL(CONSTRAINTS);
    case VES_SLOT_POLISH:
        TELL(POLISHES);
    case VES_SLOT_PRESET:
        TELL(PRESETS);
    case VES_SLOT_STRATEGY:
        TELL(STRATEGIES);
    }
    *choice = found;
    return found.name;
}

bool ves_slots_known(ves_slot slot, const char *name)
{
    ves_choice choice;
    if (!name) return true;
    for (int k = 0; ves_search_choice(slot, k, &choice); k++)
        if (!strcmp(choice.name, name)) return true;
    return false;
}

bool ves_slots_check(const ves_anneal *a)
{
    bool words = ves_slots_known(VES_SLOT_PRESET, a->as) && ves_slots_known(VES_SLOT_PROPOSAL, a->proposal) &&
                 ves_slots_known(VES_SLOT_SCHEDULE, a->schedule) &&
                 ves_slots_known(VES_SLOT_POPULATION, a->population) &&
                 ves_slots_known(VES_SLOT_CONSTRAINTS, a->constraints) &&
                 ves_slots_known(VES_SLOT_POLISH, a->polish);
    if (!words) return false;
    ves_anneal whole = *a;
    ves_slots_complete(&whole, false);
    int most = ves_slots_population(whole.population)->most;
    return !most || whole.chains <= most;
}

static void set(const char **word, const char *name)
{
    if (!*word) *word = name;
}

/* The same word, of our own: a caller's need not live as long as the result. */
static void keep(ves_slot slot, const char **word)
{
    ves_choice choice;
    for (int k = 0; ves_search_choice(slot, k, &choice); k++)
        if (!strcmp(choice.name, *word)) *word = choice.name;
}

/* Where something is to polish the ends, cooling to 1e-4 of c0 is enough for it to find the bottom; an annealing that
 * must find it itself goes on to 1e-10. The book's steps have one width, which lower temperatures cannot use. */
void ves_slots_complete(ves_anneal *a, bool followed)
{
    if (a->as) {
        set(&a->proposal, "fixed");
        set(&a->schedule, "book");
        set(&a->population, a->chains > 1 ? "chains" : "chain");
        set(&a->constraints, "crude");
        set(&a->polish, "none");
    }
    set(&a->proposal, a->fixed ? "fixed" : "mixture");
    set(&a->schedule, a->s > 0 ? "book" : "budget");
    set(&a->population, "chains");
    set(&a->constraints, "lagrangian");
    set(&a->polish, followed ? "none" : "stages");
    bool alone = !followed && !a->as && !strcmp(a->polish, "none");
    if (a->c_end == 0) a->c_end = alone ? 1e-10 : 1e-4;
    keep(VES_SLOT_PROPOSAL, &a->proposal);
    keep(VES_SLOT_SCHEDULE, &a->schedule);
    keep(VES_SLOT_POPULATION, &a->population);
    keep(VES_SLOT_CONSTRAINTS, &a->constraints);
    keep(VES_SLOT_POLISH, &a->polish);
    if (!a->chains) a->chains = ves_slots_population(a->population)->size;
}

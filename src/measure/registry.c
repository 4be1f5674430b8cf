#include "measure/registry.h"

#include <stddef.h>
#include <string.h>

#define VES_ENTRY(symbol) extern const ves_measure symbol;
#include "measures.inc"
#undef VES_ENTRY

static const ves_measure *const MEASURES[] = {
#define VES_ENTRY(symbol) &symbol,
#include "measures.inc"
#undef VES_ENTRY
    NULL};

const ves_measure *const *ves_measures(void)
{
    return MEASURES;
}

static const ves_measure *find(const char *name, const ves_measure *const *list)
{
    for (; list && *list; list++)
        if (!strcmp((*list)->name, name)) return *list;
    return NULL;
}

const ves_measure *ves_measure_find(const char *name, const ves_measure *const *plugin)
{
    const ves_measure *measure = find(name, MEASURES);
    return measure ? measure : find(name, plugin);
}

#include "suite/landscape.h"

#include <stddef.h>
#include <string.h>

#define VES_ENTRY(symbol) extern const ves_landscape symbol;
#include "landscapes.inc"
#undef VES_ENTRY

static const ves_landscape *const LANDSCAPES[] = {
#define VES_ENTRY(symbol) &symbol,
#include "landscapes.inc"
#undef VES_ENTRY
    NULL};

const ves_landscape *const *ves_landscapes(void)
{
    return LANDSCAPES;
}

const ves_landscape *ves_landscape_find(const char *name)
{
    for (const ves_landscape *const *l = LANDSCAPES; *l; l++)
        if (!strcmp((*l)->name, name)) return *l;
    return NULL;
}

bool ves_landscape_takes(const ves_landscape *landscape, int n)
{
    int most = landscape->most ? landscape->most : VES_LANDSCAPE_MOST;
    return n >= landscape->least && n <= most && n % (landscape->step ? landscape->step : 1) == 0;
}

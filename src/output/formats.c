#include <string.h>

#include "output/output.h"

#define VES_ENTRY(format) extern const ves_format format;
#include "formats.inc"
#undef VES_ENTRY

#define VES_ENTRY(format) &format,
static const ves_format *const formats[] = {
#include "formats.inc"
    NULL};
#undef VES_ENTRY

const ves_format *const *ves_formats(void)
{
    return formats;
}

const ves_format *ves_format_find(const char *name)
{
    for (const ves_format *const *format = formats; *format; format++)
        if (!strcmp((*format)->name, name)) return *format;
    return NULL;
}

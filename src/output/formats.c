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

ves_status ves_figure_write(ves_figure *figure, const char *path, ves_diag *diag)
{
    const char *dot = strrchr(path, '.');
    const ves_format *format = dot ? ves_format_find(dot + 1) : NULL;
    if (format) return format->write(figure, path, diag);
    return ves_diag_add(diag, VES_ERROR, VES_USAGE, (ves_mark){0},
                        "\"%s\" has no ending that names a format (vesica list formats)", path);
}

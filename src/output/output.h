/* Output: what leaves vesica as a file or a picture. Reads figures and plain values; the only room besides
 * app that prints. */
#ifndef VES_OUTPUT_OUTPUT_H
#define VES_OUTPUT_OUTPUT_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "surface/figure.h"
#include "vesica/figure.h"

/* One file under src/output/format/ is one format: file name = ending = word after --to = symbol
 * ves_format_NAME. */
typedef struct ves_format {
    const char *name, *about;
    ves_status (*write)(ves_figure *figure, const char *path, ves_diag *diag);
    /* The spines of the figure, a line for each patch that has one; NULL: a format without lines. */
    ves_status (*spines)(ves_figure *figure, const char *path, ves_diag *diag);
    bool shell; /* needs the figure's shell, and grids of elements */
} ves_format;

const ves_format *const *ves_formats(void); /* NULL-terminated, sorted by name */
const ves_format *ves_format_find(const char *name);

/* A JSON writer: keeps commas, indents, escapes; numbers in the shortest form that reads back exactly;
 * not-a-number and the infinities are written as null. key is NULL inside arrays. */
typedef struct ves_json {
    FILE *out;
    int depth;       /* <= 31 */
    unsigned filled; /* bit d: something was written at depth d */
    bool line;       /* one line, no indentation (JSON Lines) */
    unsigned broken; /* bit d: depth d has gone to lines of its own (arrays of numbers stay on one) */
} ves_json;
void ves_json_object(ves_json *json, const char *key);
void ves_json_array(ves_json *json, const char *key);
void ves_json_end(ves_json *json, char bracket); /* '}' or ']' */
void ves_json_number(ves_json *json, const char *key, double value);
void ves_json_integer(ves_json *json, const char *key, long value);
void ves_json_count(ves_json *json, const char *key, uint64_t value);
void ves_json_text(ves_json *json, const char *key, const char *value); /* NULL: null */
void ves_json_flag(ves_json *json, const char *key, bool value);

/* Progress on a stream: a bar that rewrites its line on a terminal, a plain line every 10 s otherwise. */
typedef struct ves_progress_bar ves_progress_bar;
typedef enum ves_progress_style {
    VES_PROGRESS_AUTO,
    VES_PROGRESS_PLAIN,
    VES_PROGRESS_NONE
} ves_progress_style;
struct ves_progress;
ves_progress_bar *ves_progress_create(FILE *stream, ves_progress_style style);
void ves_progress_show(ves_progress_bar *bar, const struct ves_progress *progress);
void ves_progress_break(ves_progress_bar *bar);   /* something else is to be said on the stream */
void ves_progress_destroy(ves_progress_bar *bar); /* ends the line */

/* ves_progress_show with the clock given, in seconds. */
void ves_progress_show_at(ves_progress_bar *bar, const struct ves_progress *progress, double now);

#endif

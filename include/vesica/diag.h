/* Diagnostics: the messages of one command, kept in order, each with the place it points at.
 *
 * A ves_diag collects; it prints nothing. `ves_diag_text` renders one message as
 *     file:line:column: error: what happened
 *         3 |   circle: {raduis: 0.5}
 *           |            ^~~~~~
 * Ownership: the caller creates and destroys; every string handed in is copied. The first VES_DIAG_ERRORS
 * errors are kept, and beside them the first VES_DIAG_REMARKS warnings and notes; further errors are only
 * counted. Every function takes NULL, and then does nothing, and any index: beyond those kept there is a note
 * without a text. */
#ifndef VESICA_DIAG_H
#define VESICA_DIAG_H

#include <stdbool.h>
#include <stddef.h>

#include "vesica/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { VES_DIAG_ERRORS = 100, VES_DIAG_REMARKS = 200 };

/* A place in a source text: 1-based line and column (bytes), length of the caret; source counts the texts
 * that were given (0 the problem file, then one for each --set). line 0: no place. */
typedef struct ves_mark {
    int source, line, column, length;
} ves_mark;

typedef enum ves_severity { VES_NOTE, VES_WARNING, VES_ERROR } ves_severity;

typedef struct ves_diag ves_diag;

/* NULL when out of memory. */
ves_diag *ves_diag_create(void);
void ves_diag_destroy(ves_diag *diag);

/* Registers a source text (copied), so that messages can quote its lines. Returns its number for
 * ves_mark.source, or 0 when out of memory (messages then quote no line). */
int ves_diag_source(ves_diag *diag, const char *name, const char *text, size_t length);

/* Adds one message (printf format) and hands `status` back, so that failing is one line:
 *     return ves_diag_add(diag, VES_ERROR, VES_RANGE, mark, "...", ...); */
ves_status ves_diag_add(ves_diag *diag, ves_severity severity, ves_status status, ves_mark mark,
                        const char *format, ...)
#ifdef __GNUC__
    __attribute__((format(printf, 5, 6)))
#endif
    ;

int ves_diag_count(const ves_diag *diag);  /* messages kept */
int ves_diag_errors(const ves_diag *diag); /* errors met, kept or not */
ves_severity ves_diag_severity(const ves_diag *diag, int index);
ves_status ves_diag_status(const ves_diag *diag, int index);

/* Renders message `index` into buffer (always terminated when size > 0); returns the full length, like
 * snprintf. */
size_t ves_diag_text(const ves_diag *diag, int index, char *buffer, size_t size);

#ifdef __cplusplus
}
#endif
#endif

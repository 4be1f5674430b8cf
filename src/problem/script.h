/* Script: the text of a problem file as it is run, with every --set written into it. A place in the text as
 * run is told as a place in what the user wrote: the file, or one --set. */
#ifndef VES_PROBLEM_SCRIPT_H
#define VES_PROBLEM_SCRIPT_H

#include "base/arena.h"
#include "vesica/diag.h"

/* One replacement, in ascending order of place. */
typedef struct ves_edit {
    size_t begin, end; /* what was written, in the text as run */
    size_t from, to;   /* what stood there, in the text as given */
    size_t value;      /* where the value begins, quote included; what is before it is the name */
    int source;        /* ves_mark.source of the --set */
    int name_column, value_column;
    struct ves_edit *next;
} ves_edit;

typedef struct ves_script {
    ves_arena *arena;
    const char *given, *text; /* terminated; text may contain any byte */
    size_t given_length, length;
    size_t *line; /* where each line of `given` begins */
    int lines;
    ves_edit *edit;
} ves_script;

/* The text must outlive the script. */
ves_status ves_script_init(ves_script *script, const char *text, size_t length, ves_arena *arena);

/* The mark of `length` bytes from `at` on. */
ves_mark ves_script_mark(const ves_script *script, size_t at, size_t length);

/* Replaces what edit->begin .. edit->end is in the text as run now by `text`; edit->value is relative to the
 * new text. The other fields of edit but source and the columns are set here. */
ves_status ves_script_replace(ves_script *script, const ves_edit *edit, const char *text);

#endif

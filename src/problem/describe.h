/* Describe: words for entries and keys, shared by help, manual and JSON Schema. */
#ifndef VES_PROBLEM_DESCRIBE_H
#define VES_PROBLEM_DESCRIBE_H

#include "problem/schema.h"
#include "problem/writer.h"

/* "number", "[x, y, z]", "true or false" ... */
void ves_describe_kind(ves_writer *writer, const ves_key *key);
/* "required" or "default 1"; nothing when the one-liner must say it. */
void ves_describe_default(ves_writer *writer, const ves_key *key);
/* ">= 0", "0 .. 1", "in m"; nothing when there is no limit and no unit. */
void ves_describe_limits(ves_writer *writer, const ves_key *key);

/* An example of an operation made of its required keys: {circle: {radius: 1}}. */
void ves_describe_example(ves_writer *writer, const char *name, const ves_key *keys);

/* What a status comes from and what helps; "" where the sentence says all. */
const char *ves_describe_status(ves_status status);

/* A name that stands in formulas by itself. Ends with a NULL word. */
typedef struct ves_term {
    const char *word, *what, *about, *example;
} ves_term;
extern const ves_term ves_describe_terms[];

extern const char ves_describe_units[];    /* what results and files are in, Markdown */
extern const char ves_describe_formulas[]; /* how formulas are written, Markdown */
extern const char ves_describe_names[];    /* what may be a name */

#endif

/* Keys and arguments: how a curve kind, a move, a measure or a search stage says what may be written for it
 * in a problem file, and how it gets what was written. One table of ves_key is parser, range check, `vesica
 * list`, `vesica explain`, JSON schema and manual at once. */
#ifndef VESICA_FIELD_H
#define VESICA_FIELD_H

#include <stdbool.h>

#include "vesica/diag.h"

#ifdef __cplusplus
extern "C" {
#endif

struct ves_formula;

/* The kinds marked internal hold compiled formulas, which nothing in these headers evaluates: they are for
 * what is built in, and measures from outside that have such keys are refused. */
typedef enum ves_kind {
    VES_NUMBER = 1, /* one number: a formula of variables, parameters and earlier names */
    VES_VECTOR,     /* [x, y, z], three numbers */
    VES_SCALES,     /* one number for all three, or [x, y, z]; always three numbers in the block */
    VES_NUMBERS,    /* list of numbers */
    VES_POINTS,     /* list of [x, y, z] */
    VES_TERMS,      /* list of [number, curve]: count numbers and count references */
    VES_COUNT,      /* whole number, known before a plan is made */
    VES_FLAG,       /* true or false */
    VES_CHOICE,     /* one word of `words` */
    VES_TEXT,       /* free text */
    VES_CURVE,      /* name of a curve */
    VES_PLACE,      /* name of a place, or of a curve */
    VES_PATCHES,    /* list of names of patches */
    VES_FORMULAS,   /* internal: three formulas of the surface coordinates */
    VES_POINTWISE,  /* internal: one formula of x, y, z, H, K, k1, k2, u, v at a point of the surface */
    VES_CASE, /* a load case of the shell; may be left out when there is but one, and is answered then too */
    VES_SHELL_AT, /* a curve that parts of the shell end on, an edge of a part (wall.u0), or a place on one */
    VES_SHELLWISE, /* internal: one formula of x, y, z, u, v, thickness at a point of the shell */
    VES_SHELL_HELD /* as SHELL_AT, where a support of the shell is */
} ves_kind;

/* As the least value of a key: greater than 0. The smallest normal number, so that ranges stay closed. */
#define VES_POSITIVE 2.2250738585072014e-308

/* One key. A table ends with an entry of zeros: {0}. */
typedef struct ves_key {
    const char *name;
    ves_kind kind;
    bool required;
    const char *unit; /* dimension of number kinds: "m", "1", "m^-1" ...; NULL: any, fixed by the first number
                         given */
    double min,
        max; /* closed range of number kinds and counts; both 0: unbounded; min VES_POSITIVE: more than 0 */
    double fallback;   /* when not given: number kinds, COUNT, FLAG (0, 1), CHOICE (index of the word) */
    const char *words; /* CHOICE: "one|two|three" */
    const char *about; /* one line for people */
} ves_key;

/* What was written for one key. Number kinds occupy `count` consecutive places of the number block, from
 * `first`. */
typedef struct ves_arg {
    bool given; /* false: the fallback stands */
    ves_mark mark;
    int first, count; /* number kinds; formula kinds and references use count alone */
    int value;        /* COUNT, FLAG, CHOICE; CASE, SHELL_AT, SHELL_HELD: which one, -1: not given */
    const char *text; /* TEXT */
    const struct ves_formula *const *formula; /* FORMULAS (three), POINTWISE (one) */
    const int *ref;                           /* CURVE, TERMS: curves; PATCHES: patches; PLACE: see place */
    bool place;                               /* PLACE: ref[0] is a place (true) or a curve (false) */
} ves_arg;

/* Arguments of one instance: arg[i] answers key[i]. */
typedef struct ves_args {
    const ves_key *key;
    const ves_arg *arg;
    int count;
    ves_mark mark; /* where the instance stands in the file */
} ves_args;

#ifdef __cplusplus
}
#endif
#endif

/* Schema: what a problem file may hold, as one tree of tables. The reader, the help and the manual's
 * reference all follow it, so that they cannot disagree. Curve kinds, moves and measures bring their own
 * tables of keys. */
#ifndef VES_PROBLEM_SCHEMA_H
#define VES_PROBLEM_SCHEMA_H

#include "base/arena.h"
#include "curve/curve.h"
#include "vesica/measure.h"

/* Kinds of entries besides those of vesica/field.h. */
enum {
    VES_MAP = 64, /* the keys of `table` */
    VES_NAMED,    /* any names, each like table[0] */
    VES_LIST, /* each item like table[0]: min .. max of them; both 0: any number of them, and a single item
                      may stand without its list */
    VES_INTERVAL,  /* [min, start, max] */
    VES_SPAN,      /* [from, to] */
    VES_GRID,      /* rows of points */
    VES_NEW,       /* a name of its own */
    VES_VARIED,    /* the list or map of one entry of vary */
    VES_SOURCE,    /* a curve: one source, and the keys of `table` */
    VES_MOVE,      /* one move */
    VES_INSTANCE,  /* one measure with its keys */
    VES_STAGE,     /* one stage of a search: one key of `table` */
    VES_ALGORITHM, /* a word of ves_search_algorithms */
    VES_SLOT_WORD, /* a choice of ves_search_choice; max: of which slot */
    VES_SEED,      /* a whole number up to 2^53 */
    VES_GOAL,      /* a formula of slots and measures */
    VES_EQUATION,  /* a == b of such formulas */
    VES_RELATION,  /* a <= b, a >= b, a == b of such formulas; or the keys of `table` */
    VES_CHECK,     /* such a formula that must hold */
    VES_END,       /* an end of a patch: wall.u0 */
    VES_PAIR,      /* one number, or a list of two */
    VES_SWEPT,     /* values of a parameter: one, a list, or the keys of `table`, if it has one */
    VES_FIELD,     /* a formula of u, v, x, y, z on a shell */
    VES_FIELDS,    /* [x, y, z] of them */
    VES_MATERIAL,  /* a word of ves_materials, or the keys of `table`, if it has one */
    VES_LATER      /* a word that a later version will understand; `about` says as what */
};

/* One entry; a table ends with an entry without a name. The name of an item is for people: "curve",
 * "condition". words of a MAP or LIST: a word that may stand for the whole (auto). */
typedef struct ves_entry {
    ves_key key;
    const char *example; /* YAML */
    const struct ves_entry *table;
} ves_entry;

extern const ves_entry ves_schema_root;  /* VES_MAP: the whole file */
extern const ves_entry ves_schema_suite; /* the same of a suite file (vesica bench) */
extern const ves_entry ves_schema_stage[];
extern const ves_entry ves_schema_shell[]; /* the keys of `shell` */
extern const ves_key ves_schema_over; /* what every measure of surfaces understands besides its own keys */

/* The keys that stand below an entry, those of its items where it is a list or a mapping of names; or NULL. */
const ves_entry *ves_schema_below(const ves_entry *entry);
const ves_entry *ves_schema_find(const ves_entry *table, const char *name);

/* Texts made from the tables, in the arena; NULL when out of memory. plugin: NULL-terminated extra measures,
 * or NULL. */
char *ves_schema_json(ves_arena *arena, const ves_measure *const *plugin); /* JSON Schema, draft 07 */
char *ves_schema_suite_json(ves_arena *arena);                             /* of suite files */
char *ves_schema_reference(ves_arena *arena,
                           const ves_measure *const *plugin); /* the manual's reference chapter, Markdown */

/* A word that the problem room does not know of: a format, a command. */
typedef struct ves_topic {
    const char *word, *text;
} ves_topic;

/* Help on a key (minimize, conditions.scale, patches.wall.operator.a), a curve kind, a move, a measure, a
 * stage, an algorithm, a unit, a function, a status, or one of `more`, which ends with a NULL word (NULL:
 * none). *found tells whether the word is known; otherwise the text suggests another. */
char *ves_schema_explain(ves_arena *arena, const char *word, const ves_measure *const *plugin,
                         const ves_topic *more, bool *found);

#endif

/* Reader: what all parts of the reading of one problem file share. Parts report what is wrong and go on, so
 * that every error of a file comes in one go; only lack of memory ends the reading early. After an error the
 * problem is never handed out, so parts may leave holes (NULL formulas, index -1) behind them, and must bear
 * those of others. */
#ifndef VES_PROBLEM_READER_H
#define VES_PROBLEM_READER_H

#include "base/order.h"
#include "problem/problem.h"
#include "problem/schema.h"
#include "problem/tree.h"

enum { VES_NAMES = 1000, VES_SLOTS = 1000, VES_KEYS = 32, VES_MATERIAL_NAMES = 4 }; /* VES_KEYS: of one thing */

/* The names of one section, in the order of the file. */
typedef struct ves_named {
    const char *text;
    const ves_node *word, *value;
    int index; /* in the problem; -1: not read yet */
    bool open; /* being read: meeting it again is a circle */
} ves_named;

typedef struct ves_names {
    const char *what; /* "curve" */
    int count;
    ves_named *name;
} ves_names;

/* A message, kept until all are there: they are handed out in the order of the file. */
typedef struct ves_message {
    ves_severity severity;
    ves_status status;
    ves_mark mark;
    const char *text;
    int order;
} ves_message;

/* Every formula, and what it is for: numbers and formulas of curve k have owner k, the others -1. */
typedef struct ves_use {
    const ves_formula *formula;
    int owner;
} ves_use;

/* A limit, and whose it is, as in ves_use. */
typedef struct ves_reader_limit {
    ves_limit limit;
    int owner;
} ves_reader_limit;

/* What the sections of a family of curves are made of. */
typedef struct ves_family {
    const char *parameter; /* NULL: the name is that of an ordinary curve */
    const ves_curve_step *step;
    int steps;
    ves_dim dim;
    bool used; /* some patch has sections of it */
} ves_family;

/* A section that is an end of a patch: another patch that ends there has the same curve. */
typedef struct ves_section {
    int family;       /* index in the names of curves */
    const char *text; /* of the parameter's number, where it varies, or NULL */
    double at;        /* where it does not */
    int curve;
} ves_section;

/* A join: what it asks of the two ends. */
typedef struct ves_join {
    const ves_node *node;
    bool good; /* the ends are known */
    bool bends;
    ves_end end[2];
    int field[2];            /* curves: tangent and bend; -1 after an error */
    int scale[2], square[2]; /* number block indices of the ends' scales and of their squares; -1: 1 */
} ves_join;

typedef struct ves_reader {
    ves_arena *arena;
    const ves_script *script;
    ves_status status;    /* of the first failure */
    ves_message *message; /* growing */
    int messages, message_room, errors;
    int lost;        /* errors that found no room */
    bool dimensions; /* check them */
    bool units;      /* some number has a unit */
    ves_problem *problem;
    const ves_measure *const *plugin;

    int slots;        /* variables, unknown, parameters */
    ves_symbol *slot; /* [slots] */
    double *value;    /* [slots] at the start design; NAN: not known */
    bool *varying;    /* [slots] */
    double *room;     /* scratch of formulas */
    int rooms;

    const ves_formula **number; /* growing */
    int numbers, number_room;
    ves_use *use;
    int uses, use_room;
    ves_reader_limit *limit; /* growing */
    int limits, limit_room;
    int owner;                 /* of the numbers that are being read */
    ves_dim *free;             /* dimension of keys without a unit; NULL: none is asked */
    const ves_node *free_node; /* of a curve: what fixed it, and as which key */
    const char *free_name;
    bool lengths;          /* those keys are most likely lengths: a curve is being read */
    bool surface;          /* FORMULAS are of u and v, not of v alone */
    const char *parameter; /* of a family, whose FORMULAS are of v and it; or NULL */

    ves_names curves, patches, places, measures, kinds;
    const ves_node *vary; /* the section, or NULL */
    bool *curve_used;     /* [curves] */
    ves_curve_def *curve; /* [curves and sections] in the order of the problem */
    int curves_read;
    ves_family *family;   /* [curves] */
    ves_section *section; /* ends, two of a patch at most */
    int sections;
    ves_join *join;
    int joins;
    ves_measure_def *measure; /* configured, then plain ones as formulas name them */
    int measures_read;

    ves_shell_def *shell; /* being read, then read; NULL: the file has none */
    const ves_node *material; /* its section, or NULL */
    ves_names cases;      /* its load cases */
    bool shell_known;     /* its parts, and the ends of these, are */
    bool cases_lost;      /* some of its cases could not be read */
    ves_shell_at *at;     /* places that measures name: growing */
    int at_room;
} ves_reader;

/* One key of a table and what the file has for it. */
typedef struct ves_field {
    const ves_key *key;
    const ves_node *node; /* NULL: not given */
    const ves_node *word; /* the key as it stands in the file, or NULL */
    bool excused;         /* not given, but an unknown key was probably meant to be it */
} ves_field;

typedef struct ves_fields {
    int count;
    ves_field field[VES_KEYS];
} ves_fields;

/* fail.c */
void ves_reader_fail(ves_reader *reader, ves_status status, ves_mark mark, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
void ves_reader_error(ves_reader *reader, ves_status status, const ves_node *node, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
void ves_reader_warn(ves_reader *reader, ves_mark mark, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
/* Nobody will read a further message: no need to look for suggestions. */
bool ves_reader_full(const ves_reader *reader);
/* Hands the messages to the diagnostics. */
void ves_reader_tell(ves_reader *reader, ves_diag *diag);
bool ves_reader_memory(ves_reader *reader,
                       const void *block); /* false, and the failure noted, when block is NULL */
ves_mark ves_reader_mark(const ves_reader *reader, const ves_node *node);
/* ", did you mean "x"?" or "". */
const char *ves_reader_suggestion(ves_reader *reader, const char *word, const char *const *candidate,
                                  int count);

/* fields.c: matches a mapping with a table. what: for messages. entries: the table is of ves_entry, else of
 * ves_key. extra: one more key, or NULL. Returns whether the node is a mapping. */
bool ves_fields_read(ves_reader *reader, const ves_node *node, const ves_entry *table, const char *what,
                     ves_fields *fields);
bool ves_fields_read_keys(ves_reader *reader, const ves_node *node, const ves_key *keys, const ves_key *extra,
                          const char *what, ves_fields *fields);
const ves_field *ves_fields_field(const ves_fields *fields, const char *name); /* NULL: not in the table */
const ves_node *ves_fields_find(const ves_fields *fields, const char *name);   /* NULL: not given */
bool ves_fields_excused(const ves_fields *fields, const char *name);
/* complains of both or neither of two keys that stand for each other */
void ves_fields_one_of(ves_reader *reader, const ves_node *node, const ves_fields *fields, const char *what,
                       const char *a, const char *b);

/* names.c; formulas: the names stand in formulas */
void ves_names_read(ves_reader *reader, const ves_node *section, const char *what, bool formulas,
                    ves_names *names);
ves_named *ves_names_find(const ves_names *names, const char *text);
/* As find; reports a name that is not there. */
ves_named *ves_names_ask(ves_reader *reader, const ves_names *names, const ves_node *node);

/* number.c: formulas */
typedef struct ves_text_part { /* a part of a word: text[from .. to) */
    const ves_node *node;
    int from, to;
} ves_text_part;
const ves_formula *ves_reader_formula(ves_reader *reader, ves_text_part part, const ves_symbol *argument,
                                      int arguments);
ves_text_part ves_text_whole(const ves_node *node);
/* Value at the start design; NAN when it is not known. */
double ves_reader_value(ves_reader *reader, const ves_formula *formula);
bool ves_reader_varies(const ves_reader *reader, const ves_formula *formula);
/* Appends a number to the block; returns its index there. */
int ves_reader_append(ves_reader *reader, const ves_formula *formula);
/* One number as key says; NULL when it is not one. */
const ves_formula *ves_reader_number(ves_reader *reader, const ves_node *node, const ves_key *key);
/* Appends one number as key says, with its range, if the key has one; a hole when it is not a number, so that
 * places stay consecutive. Returns its index. */
int ves_reader_place(ves_reader *reader, const ves_node *node, const ves_key *key);
/* A number that is known before any variable is; NAN after an error. */
double ves_reader_constant(ves_reader *reader, const ves_node *node, const ves_key *key);
long ves_reader_count(ves_reader *reader, const ves_node *node, const ves_key *key);
/* Checks a dimension against a unit ("m"); NULL unit: the reader's free dimension. */
void ves_reader_check_dim(ves_reader *reader, const ves_node *node, const char *name, const char *unit,
                          ves_dim dim);
bool ves_reader_word(ves_reader *reader, const ves_node *node, const char *what);

/* args.c: arguments by a table of keys */
void ves_reader_arg(ves_reader *reader, const ves_field *field, ves_arg *arg);
void ves_reader_args(ves_reader *reader, const ves_fields *fields, int count, const ves_node *node,
                     ves_args *args);
/* A formula that reads these symbols, none of which may also be a name of the file; NULL after an error. */
const ves_formula *ves_reader_pointwise(ves_reader *reader, const ves_node *node, const ves_key *key,
                                        const ves_symbol *symbol, int symbols);
int ves_reader_choice(ves_reader *reader, const ves_node *node, const ves_key *key);
bool ves_reader_flag(ves_reader *reader, const ves_node *node, const ves_key *key);
const int *ves_reader_patches(ves_reader *reader, const ves_node *node, int *count);
int ves_reader_curve(ves_reader *reader, const ves_node *node); /* index, or -1 */

/* curves.c: the index of a curve, which is read first when it has not been; -1: it is a family, or made of
 * itself. node: who asks */
int ves_reader_curve_read(ves_reader *reader, const ves_node *node, ves_named *curve);

/* sections.c: the parameter of a family that is being read, or NULL after an error; and the position
 * conditions that the sections of a patch are, at most VES_CONDITIONS_MAX. Returns how many. */
const char *ves_reader_family(ves_reader *reader, const ves_node *family, const ves_curve_op *source);
int ves_reader_sections(ves_reader *reader, const ves_node *node, ves_condition *out);

/* slots.c: names and values of variables, unknown, parameters */
void ves_reader_slots(ves_reader *reader, const ves_fields *root);
/* Can the word be a name? formulas: in formulas too, where some words have a meaning. A slot may bear the
 * name of a measure: it hides it, so that a measure that is added later does not break a file. */
bool ves_reader_new_name(ves_reader *reader, const ves_node *word, const char *what, bool formulas);

/* vary.c */
typedef struct ves_declared { /* one variable, by the file or by vary */
    const char *name;
    const ves_node *word;
    const ves_node *range;  /* NULL: by the letter */
    const double *fallback; /* then its [min, start, max] */
} ves_declared;
int ves_vary_count(const ves_node *vary);
void ves_vary_read(ves_reader *reader, const ves_node *vary, ves_declared *variable, int *count);
/* The moves that vary adds to a curve: synthetic items for its apply list. */
void ves_vary_moves(ves_reader *reader, const ves_node *vary, const ves_named *curve,
                    const ves_node *moves[3], int *count);

/* sections */
void ves_reader_curves(ves_reader *reader, const ves_fields *root);
void ves_reader_patches_section(ves_reader *reader, const ves_fields *root);
/* operators.c, conditions.c, spine.c: parts of a PDE patch. The operator, whose order the conditions follow,
 * first (NULL: there is none, and sections have told patch->power); what raises the order after them; the spine,
 * which needs to know the ends, last. conditions: adds those of the list, which may be NULL, and of joins to what
 * sections have put into patch->condition. */
void ves_reader_operator(ves_reader *reader, const ves_node *node, ves_patch_def *patch);
void ves_reader_remainder(ves_reader *reader, const ves_node *node, ves_patch_def *patch);
void ves_reader_conditions(ves_reader *reader, const ves_named *name, const ves_node *list,
                           ves_patch_def *patch);
void ves_reader_raise(ves_reader *reader, const ves_field *field, ves_patch_def *patch);
void ves_reader_spine(ves_reader *reader, const ves_field *field, ves_patch_def *patch);
/* joins.c: read before the patches, and checked after them. joined: the conditions that they add to a patch;
 * out: takes them, or NULL; returns how many there are; -1: the ends of some join are not known. */
void ves_reader_joins(ves_reader *reader, const ves_fields *root);
int ves_reader_joined(ves_reader *reader, int patch, ves_condition *out);
void ves_reader_joins_check(ves_reader *reader, const ves_fields *root);
void ves_reader_places(ves_reader *reader, const ves_fields *root);
void ves_reader_settings(ves_reader *reader, const ves_fields *root);        /* shape, validity, quadrature */
bool ves_reader_end(ves_reader *reader, const ves_node *node, ves_end *end); /* wall.u0 */
void ves_reader_shape(ves_reader *reader, const ves_node *node);
void ves_reader_validity(ves_reader *reader, const ves_node *node);
void ves_reader_quadrature(ves_reader *reader, const ves_node *node);
void ves_reader_measures(ves_reader *reader, const ves_fields *root);
/* Instantiates the plain measures that a formula names. */
void ves_reader_plain_measures(ves_reader *reader, const ves_node *node);
/* What formulas of measures read: the instances, for checks VES_EXPECT_NAMES more, then measures that nobody
 * has named yet, so that a misspelt one is suggested. */
ves_symbol *ves_reader_symbols(ves_reader *reader, bool expect, int *count);
void ves_reader_goals(ves_reader *reader, const ves_fields *root);
void ves_reader_search(ves_reader *reader, const ves_fields *root);
void ves_reader_stages(ves_reader *reader, const ves_node *node, ves_search_options *options);
/* shell.c, and its parts: supports.c, loads.c, shell_at.c */
void ves_reader_shell(ves_reader *reader, const ves_fields *root);
void ves_reader_material(ves_reader *reader, const ves_node *node);
void ves_reader_supports(ves_reader *reader, const ves_node *node);
void ves_reader_cases(ves_reader *reader, const ves_node *node);
/* A formula of u, v, x, y, z; NULL after an error. */
const ves_formula *ves_reader_shell_field(ves_reader *reader, const ves_node *node, const ves_key *key);
/* The part of the shell that a patch is, -1: none. */
int ves_reader_shell_part(const ves_reader *reader, int patch);
/* Where something is; false after an error. */
bool ves_reader_shell_at(ves_reader *reader, const ves_node *node, ves_shell_at *at);
/* For measures: the index of such a place, of a load case, and of the only load case there is, for a key that
 * was left out; -1 after an error. */
int ves_reader_shell_place(ves_reader *reader, const ves_node *node);
int ves_reader_shell_held(ves_reader *reader, const ves_node *node); /* where a support is */
bool ves_reader_of_shell(const ves_key *key);                        /* of a kind that only shells have */
int ves_reader_case(ves_reader *reader, const ves_node *node);
int ves_reader_only_case(ves_reader *reader, const ves_node *node, const ves_key *key);
void ves_reader_shell_finish(ves_reader *reader); /* hands the places over */

/* borrow.c: the names material.E, ... as symbols, VES_MATERIAL_NAMES of them; and a formula whose arguments end with
 * these, which are replaced by what they stand for. NULL after an error. */
void ves_reader_material_symbols(ves_symbol *symbol);
const ves_formula *ves_reader_goal(ves_reader *reader, ves_text_part part, const ves_symbol *argument,
                                   int arguments);

/* sweep.c; and the changes of a file under a key `set` */
void ves_reader_sweep(ves_reader *reader, const ves_fields *root);
const ves_override *ves_reader_overrides(ves_reader *reader, const ves_node *node, int *count);
void ves_reader_seed(ves_reader *reader, const ves_node *node, uint64_t *seed);
/* problem.c: is it a file of this format (its word `vesica`); complains of keys given twice */
bool ves_reader_format(ves_reader *reader, const ves_node *root);
void ves_reader_repeats(ves_reader *reader, const ves_node *node);

/* shown.c: units for people. That of a word that has one, else SI. */
void ves_shown_find(const ves_node *const *word, int count, ves_dim dim, ves_shown *shown);
/* Of measures and goals, after everything is read. */
void ves_reader_shown(const ves_reader *reader, const ves_fields *root);

/* finish.c: the number block, what varies, and variables that drive nothing. */
void ves_reader_finish(ves_reader *reader, const ves_fields *root);

#endif

/* Problem: a problem file, read, checked and resolved. Constant after reading and shared by all threads; owns
 * all that its functions hand out, as long as it lives. Numbers are in SI units (in a file without units: in
 * its own), angles in radians.
 *
 * Everything is named by its index, from 0: x[variables], slot[slots], measure[measures], side[constraints]
 * and the patches of a mesh are arrays in the order of the functions here. They return NULL for an index that
 * is not there. */
#ifndef VESICA_PROBLEM_H
#define VESICA_PROBLEM_H

#include "vesica/diag.h"
#include "vesica/measure.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ves_problem ves_problem;

/* One --set name=value. Name: a variable (then its start), a parameter, or a dotted path of keys
 * (patches.wall.operator.a). */
typedef struct ves_override {
    const char *name, *value;
} ves_override;

typedef struct ves_read_options {
    int overrides;
    const ves_override *override;
    const ves_measure *const *plugin; /* NULL-terminated extra measures, or NULL; must outlive the problem */
    const char *const *plugin_file;   /* NULL-terminated: the files they come from, or NULL; a run keeps the
                                         names for who opens its folder again */
    bool inner; /* the overrides stand in a file (set: {name: value}), and messages quote them so */
} ves_read_options;

/* Reads a file, or a text under a name (for messages). options NULL: none. Every error of the file is in
 * diag, not only the first; diag may be NULL. On failure the status is that of an error and *problem is
 * NULL. */
ves_status ves_problem_read(const char *path, const ves_read_options *options, ves_problem **problem,
                            ves_diag *diag);
ves_status ves_problem_read_text(const char *name, const char *text, size_t length,
                                 const ves_read_options *options, ves_problem **problem, ves_diag *diag);
void ves_problem_destroy(ves_problem *problem); /* NULL: nothing */

const char *ves_problem_title(const ves_problem *problem);

/* The objective as written; NULL: the file has none. */
const char *ves_problem_objective(const ves_problem *problem, bool *maximize);

/* The name of a variable; its range and start where the pointers are not NULL. */
int ves_problem_variables(const ves_problem *problem);
const char *ves_problem_variable(const ves_problem *problem, int index, double *min, double *start,
                                 double *max);

/* All numbers that have a name: the variables, then the unknown of solve: if there is one, then the
 * parameters, each after those that it reads. */
int ves_problem_slots(const ves_problem *problem);
const char *ves_problem_slot(const ves_problem *problem, int index);

int ves_problem_measures(const ves_problem *problem);
const char *ves_problem_measure(const ves_problem *problem, int index);

/* A constraint as written, and what its left side must be to its right side. */
typedef enum ves_relation { VES_AT_MOST, VES_AT_LEAST, VES_EQUAL } ves_relation;
int ves_problem_constraints(const ves_problem *problem);
const char *ves_problem_constraint(const ves_problem *problem, int index, ves_relation *relation);

/* A check of validity: {holds: ...} as written. */
int ves_problem_checks(const ves_problem *problem);
const char *ves_problem_check(const ves_problem *problem, int index);

/* A name for designs, of kinds. */
int ves_problem_kinds(const ves_problem *problem);
const char *ves_problem_kind(const ves_problem *problem, int index);

int ves_problem_patches(const ves_problem *problem);
const char *ves_problem_patch(const ves_problem *problem, int index);

#ifdef __cplusplus
}
#endif
#endif

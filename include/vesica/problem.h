/* Problem: a problem file, read, checked and resolved. Constant after reading and shared by all threads; owns
 * all that its functions hand out. Numbers are in SI units, angles in radians. */
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
    const ves_measure *const *plugin; /* NULL-terminated extra measures, or NULL */
} ves_read_options;

/* Reads a file, or a text under a name. Every error of the file is in diag, not only the first. On failure
 * *problem is NULL. */
ves_status ves_problem_read(const char *path, const ves_read_options *options, ves_problem **problem,
                            ves_diag *diag);
ves_status ves_problem_read_text(const char *name, const char *text, size_t length,
                                 const ves_read_options *options, ves_problem **problem, ves_diag *diag);
void ves_problem_destroy(ves_problem *problem);

const char *ves_problem_title(const ves_problem *problem);

/* What the arrays of plans and runs mean, by index: x[variables], value[measures], constraints, patches. */
int ves_problem_variables(const ves_problem *problem);
const char *ves_problem_variable(const ves_problem *problem, int index, double *min, double *start,
                                 double *max);
int ves_problem_measures(const ves_problem *problem);
const char *ves_problem_measure(const ves_problem *problem, int index);
int ves_problem_constraints(const ves_problem *problem);
const char *ves_problem_constraint(const ves_problem *problem, int index); /* as written */
int ves_problem_patches(const ves_problem *problem);
const char *ves_problem_patch(const ves_problem *problem, int index);

#ifdef __cplusplus
}
#endif
#endif

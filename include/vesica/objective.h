/* Objectives: functions of plain numbers, with constraints, for `vesica bench` to compare searches on. A
 * shared object that exports
 *     const ves_objectives ves_objectives_entry = {VES_OBJECTIVES, "my objectives", list};
 * is named in a suite: {plugin: ./mine.so, objective: tower}. examples/objective is a whole one. */
#ifndef VESICA_OBJECTIVE_H
#define VESICA_OBJECTIVE_H

#include <stddef.h>

#include "vesica/verdict.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { VES_OBJECTIVE_ABI = 1 };

typedef struct ves_objective {
    const char *name, *about;
    int n, m;             /* variables, >= 1; constraints */
    const double *lower;  /* [n] finite, lower < upper */
    const double *upper;  /* [n] */
    const bool *equality; /* [m] true: constraint == 0; false: constraint <= 0. NULL: all inequalities */
    double optimum;       /* the least value; NAN: not known */
    bool gradients;       /* eval tells them exactly */

    /* What eval needs to write to, one for each thread that asks; NULL: nothing. create answers NULL when out
     * of memory. */
    void *(*create)(void);
    void (*destroy)(void *state);

    /* out->value and out->constraint [m], each divided by its size, and, when slopes, out->gradient [n] and
     * out->jacobian [m][n], by x. Positive: there is no value at x. Negative: the run cannot go on. The same
     * x must always have the same answer. */
    ves_status (*eval)(void *state, const double *x, bool slopes, ves_verdict *out);
} ves_objective;

/* Members are only ever appended; the size tells which of them a plugin was built with. */
typedef struct ves_objectives {
    int abi;     /* VES_OBJECTIVE_ABI */
    size_t size; /* sizeof(ves_objective) */
    const char *name;
    const ves_objective *const *objective; /* NULL-terminated */
} ves_objectives;

/* The first two members, as these headers have them. */
#define VES_OBJECTIVES VES_OBJECTIVE_ABI, sizeof(ves_objective)

#ifdef __cplusplus
}
#endif
#endif

/* Constraint handlings: the energy of a candidate that violates its constraints. One file each; the file's name is
 * the descriptor's, and the word in problem files. Failed candidates have an infinite energy with all of them. */
#ifndef VES_SEARCH_CONSTRAINT_H
#define VES_SEARCH_CONSTRAINT_H

#include <stdbool.h>

#include "vesica/verdict.h"

/* What one chain weighs its violations with. Nothing changes within a temperature. */
typedef struct ves_burden {
    int m;
    const bool *equality; /* [m]; NULL: none */
    double tolerance;
    double weight, most; /* of f for a unit of violation; it grows no further than this */
    double heat;         /* temperature over c0 when it was settled last */
    double worst;        /* feasible: the largest value that was met */
    double *multiplier;  /* [m] lagrangian */
    double *stiffness;   /* [m] lagrangian: of f for the square of a unit, twice */
} ves_burden;

typedef struct ves_constraint {
    const char *name, *about;
    double (*energy)(const ves_burden *burden, const ves_verdict *verdict); /* of one that did not fail */
    /* The violation beyond which the energy is more than `most` for any value from `lowest` on. */
    double (*cutoff)(const ves_burden *burden, double most, double lowest);
    /* A temperature is over: where the chain stands; whether its best is feasible; temperature over c0, of the
     * next one. NULL: nothing. */
    void (*settle)(ves_burden *burden, const ves_verdict *current, bool feasible, double heat);
} ves_constraint;

#endif

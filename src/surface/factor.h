/* The factor of an elliptic operator that decays from u = 0: P(r) = c_0 Q(r) Q(-r) (-1)^N for n = 1, Q monic
 * with all its roots on the left. Lengths are scaled so that these are of order 1: Q belongs to x = rate u.
 * The roots themselves are not needed, and q depends smoothly on the coefficients, also where roots meet.
 * test  against products of known roots, repeated and complex; differences */
#ifndef VES_SURFACE_FACTOR_H
#define VES_SURFACE_FACTOR_H

#include "surface/operator.h"
#include "surface/twofold.h"

typedef struct ves_factor {
    const ves_operator *op;
    int power;
    double
        rate; /* the largest |r| is 1 / (2 sqrt N) to sqrt 2 of it; of a power operator a, and nothing follows */
    ves_two q[VES_GENERAL_MAX]; /* Q(r) = r^N + sum_k q_k r^k, r in units of rate */
    ves_two slope[VES_PARAMETERS_MAX]
                 [VES_GENERAL_MAX]; /* dq_k / dc_i, rate held; 0 for those that are fixed */
} ves_factor;

/* By Newton's iteration on P = Q(r) Q(-r) from a polynomial with its roots on the left, where all iterates
 * stay [Wilson 1969]. The operator is elliptic; the factor points to it. */
void ves_factor_make(const ves_operator *op, bool slopes, ves_factor *factor);

/* The largest |Re r| for n = 1: a mode grows like e^(n u) of it, and waves beside that. Of a root of multiplicity m
 * to 1e-16^(1/m). */
double ves_factor_growth(const ves_factor *factor);

/* Solves a x = b for n <= VES_GENERAL_MAX unknowns and `columns` right sides, in place; false: singular. */
bool ves_two_solve(int n, ves_two a[][VES_GENERAL_MAX], int columns, ves_two b[][VES_PARAMETERS_MAX]);

#endif

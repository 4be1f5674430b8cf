/* Operators: the elliptic equation that a patch solves, with constant coefficients, of order 2N:
 *     (d_uu + a^2 d_vv)^N X = 0                                                        [Ugail 2011, eq 4.35]
 *     sum_k c_k d_u^(2N-2k) d_v^(2k) X = 0,  k = 0 .. N             [Ugail 2011, eq 4.54; Huang 2012, eq 5]
 * Mode n of X satisfies P(D) y = 0 with the even polynomial P(r) = sum_k c_k (-n^2)^k r^(2N-2k), elliptic
 * when sum_k c_k t^(N-k) > 0 for all t >= 0: then no root is imaginary, N roots decay from u = 0 and their
 * negatives from u = 1. */
#ifndef VES_SURFACE_OPERATOR_H
#define VES_SURFACE_OPERATOR_H

#include <stdbool.h>

#include "base/order.h"
#include "vesica/status.h"

typedef struct ves_operator {
    int power; /* N: 1 .. VES_POWER_MAX; general: 1 .. VES_GENERAL_MAX */
    bool general;
    double parameter[VES_PARAMETERS_MAX]; /* a; general: c_0 .. c_N */
    unsigned
        fixed; /* bit k: nobody asks for slopes by parameter k, and what a table has for them means nothing */
} ves_operator;

/* How many numbers an operator has: 1 (a), or N + 1. */
int ves_operator_parameters(const ves_operator *op);

/* The largest |r| of mode 1: a; of a general operator max_k |c_k / c_0|^(1/2k), of which it is 1 / sqrt N to
 * sqrt 2. */
double ves_operator_rate(const ves_operator *op);

/* Is it elliptic? If not, *t is a place t >= 0 where sum_k c_k t^(N-k) <= 0: in the direction in which
 * d_uu X = -t n^2 X waves run instead of dying out. A power operator always is, for a >= 0. */
bool ves_operator_elliptic(const ves_operator *op, double *t);

/* Of what size the numbers of an operator are. The rates are those of the waves that die out first and last, to a
 * factor of order 1, in units of n: the largest (|c_k| / c_0)^(1/2k), the smallest (c_N / |c_(N-k)|)^(1/2k). */
typedef struct ves_operator_size {
    int odd;           /* a coefficient that is not 0 and beyond 10^+-VES_COEFFICIENT_DECADES, or -1 */
    double fast, slow; /* where all coefficients are of a good size, c_0 and c_N positive; else 1 */
    bool solvable;     /* fast is at most VES_RATE_MOST, and VES_RATE_SPREAD times slow */
} ves_operator_size;

enum {
    VES_COEFFICIENT_DECADES = 100,
    VES_RATE_MOST = 10000000,
    /* Conditions at the ends, roots apart by this much: 1e-9 of the largest weight at order 12, 1e-16 up to order
     * 8 [measured against MPFR]. */
    VES_RATE_SPREAD = 1000000
};

ves_operator_size ves_operator_measure(const ves_operator *op);

#endif

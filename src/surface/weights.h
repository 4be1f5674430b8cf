/* Weight tables: everything linear about a patch, paid once.
 *
 * Mode n of an operator of order 2N satisfies an ordinary equation P(D) y = 0 on [0, 1] (surface/operator.h),
 * (D^2 - lam^2)^N y = 0 with lam = a n for (d_uu + a^2 d_vv)^N [Ugail 2011, eqs 4.35-4.39]. With K = 2N
 * conditions D^k y(u_j) = f_j the solution is y(u) = sum_j l_j(u) f_j; the table holds the derivatives of the
 * cardinal functions l_j at the wanted u:
 *     weight[((n * 3 + d) * K + j) * nu + i] = d^d l_j / du^d (u_i),  d = 0, 1, 2
 * and, when asked, the derivative of each entry with respect to each parameter of the operator (same shape).
 *
 * Half of the conditions at each end, up to order 8, are solved in double precision (fast.c), all others in
 * double-double (exact.c): textbook bases lose every digit from order 14 on, these none.
 * test  MPFR oracle, every order: tests/weights_oracle.c states the bars */
#ifndef VES_SURFACE_WEIGHTS_H
#define VES_SURFACE_WEIGHTS_H

#include "surface/operator.h"

/* Where a condition stands: the d-th derivative at u. */
typedef struct ves_knot {
    double u;
    int derivative;
} ves_knot;

typedef struct ves_layout {
    int power;                         /* N */
    ves_knot knot[VES_CONDITIONS_MAX]; /* 2N of them */
    /* 0, or the N of a lower order whose conditions are the first 2N' knots: the first 2N' cardinal functions
     * are those of that order; the others, of the full one, say how far X departs from the lower solution at
     * their knots [Kubiesa 2004, 5.2]. A power operator only: each solution of a lower power is one of a
     * higher. */
    int lower;
} ves_layout;

/* Doubles in a table of `modes` modes (0 .. modes) at nu places. */
long ves_weights_size(const ves_layout *layout, int modes, int nu);

/* Doubles of scratch, aligned to 64 bytes, for ves_weights_bind and ves_weights_mode. */
long ves_weights_room(const ves_layout *layout, int nu);

/* A table and what goes with it. */
typedef struct ves_table {
    double *weight; /* ves_weights_size doubles */
    double *slope; /* [parameters][ves_weights_size]: derivatives with respect to each, or NULL: not wanted */
    double *room;  /* ves_weights_room doubles */
    bool has_zero; /* mode 0, which does not depend on the operator, is there already */
} ves_table;

/* Fills the table for modes 0 .. modes. Allocates nothing. VES_UNDETERMINED: the conditions do not determine
 * some mode (or only with numbers that no double holds), whose weights are then 0. The operator is
 * elliptic. */
ves_status ves_weights_bind(const ves_layout *layout, const ves_operator *op, int modes, int nu,
                            const double *u, const ves_table *table);

/* One row of a table, weight[(d * K + j) * nu + i], for a given n >= 0, whole or not: the remainder's table
 * is this at n = M + 1. slope: [parameters][3 * K * nu], or NULL. */
ves_status ves_weights_mode(const ves_layout *layout, const ves_operator *op, double n, int nu,
                            const double *u, const ves_table *row);

/* What the conditions make of mode n. */
typedef struct ves_amplification {
    double
        lebesgue; /* max over u of the sum of |l_j(u)| over the function conditions: the size of the surface
                        that curves of size 1 may make, and the digits lost */
    double
        amplified; /* that, or max |l_j(u)| lam^k of a condition on the k-th derivative, if it is more (lam at
                         least 1): what is natural is 1 */
    double condition; /* of the condition matrix */
    double lam; /* of the mode: n times the largest real part of a root; e^(lam u_N) is what to expect */
    /* The conditions do not determine the mode: what is found is beyond what e^(lam u_N) explains. Never said of
     * positions, each with all derivatives up to some order, and a power operator, nor of half of them at each
     * end: sums of real exponentials have too few zeros for that. */
    bool free;
    bool
        solvable; /* determined, by numbers of which something is left in 32 digits, and that a double holds */
} ves_amplification;

/* VES_MEMORY; else VES_OK. Numbers that are not known are HUGE_VAL. */
ves_status ves_weights_amplification(const ves_layout *layout, const ves_operator *op, double n,
                                     ves_amplification *found);

/* The largest u_N: the distance of the N-th condition from its nearer end, of the lower order too. Mode n is
 * amplified about e^(lam u_N) times: 0 when half of the conditions stand at each end. */
double ves_layout_depth(const ves_layout *layout);

/* Half of the conditions at each end, each with all lower derivatives, those of the lower order by themselves too:
 * a power operator amplifies nothing, and every mode can be solved. */
bool ves_layout_regular(const ves_layout *layout);

#endif

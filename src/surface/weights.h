/* Weight tables: everything linear about a patch, paid once.
 *
 * Mode n of (d_uu + a^2 d_vv)^N X = 0 satisfies (D^2 - lam^2)^N y = 0 on [0, 1], lam = a n [Ugail 2011,
 * eqs 4.35-4.39]. With K = 2N conditions D^k y(u_j) = f_j the solution is y(u) = sum_j l_j(u) f_j; the table
 * holds the derivatives of the cardinal functions l_j at the wanted u:
 *     table[((n * 3 + d) * K + j) * nu + i] = d^d l_j / du^d (u_i),  d = 0, 1, 2
 * and, when asked, the derivative of each entry with respect to a (same shape).
 * test  manufactured solutions, MPFR oracle: relative error <= 1e-12 for lam in [0, 1000], of the derivatives
 *       2e-12 */
#ifndef VES_SURFACE_WEIGHTS_H
#define VES_SURFACE_WEIGHTS_H

#include <stdbool.h>

#include "vesica/status.h"

enum { VES_POWER_MAX = 2, VES_CONDITIONS_MAX = 2 * VES_POWER_MAX };

/* Where a condition stands. */
typedef struct ves_knot {
    double u;
    int derivative;
} ves_knot;

typedef struct ves_layout {
    int power;                         /* N */
    ves_knot knot[VES_CONDITIONS_MAX]; /* 2N of them */
} ves_layout;

/* VES_SINGULAR when the conditions do not determine mode 0 or some other mode. */
ves_status ves_layout_check(const ves_layout *layout);

/* Doubles in a table of `modes` modes (0 .. modes) at nu places. */
long ves_weights_size(const ves_layout *layout, int modes, int nu);

/* Doubles of scratch, aligned to 64 bytes, for ves_weights_bind and ves_weights_mode. */
long ves_weights_room(int nu);

/* A table and what goes with it. */
typedef struct ves_table {
    double *weight;   /* ves_weights_size doubles */
    double *weight_a; /* their derivatives with respect to a, or NULL: not wanted */
    double *room;     /* ves_weights_room doubles */
    bool has_zero;    /* mode 0, which does not depend on a, is there already */
} ves_table;

/* Fills the table for modes 0 .. modes at lam = a n (a >= 0; 0 is legal). Allocates nothing. */
void ves_weights_bind(const ves_layout *layout, double a, int modes, int nu, const double *u,
                      const ves_table *table);

/* One row of a table for a given lam: weight[(d * K + j) * nu + i]; weight_lam (or NULL) its derivative. The
 * remainder's table is this at lam = a (M + 1). */
void ves_weights_mode(const ves_layout *layout, double lam, int nu, const double *u, double *weight,
                      double *weight_lam, double *room);

#endif

/* Bases of the solutions of P(D) y = 0 in double-double, eight places at a time: 2N members and their
 * derivatives along u, and the derivatives of these with respect to the parameters of the operator.
 *
 * centred.c: while all roots are small. With t = u - 1/2, and h_m the complete symmetric polynomials of the N
 * roots in r^2 (1 / prod (1 - s_i z) = sum h_m z^m), the members are
 *     e_k(t) = sum_m h_m t^(2m+k) / (2m+k)!,   k = 0 .. 2N-1,   e_k' = e_(k-1)
 * series without cancellation where the roots are real, whatever their multiplicity, lam = 0 included; no
 * root is ever computed. (For N equal roots they span the functions d^k/dmu^k cosh(sqrt(mu) t).)
 * decaying.c: when they are large, and the operator is a power: u^k e^(-lam u) / k! and the mirror images.
 * split.c: when they are large, and the operator is general: P(r) = Q(r) Q(-r) with Q's roots on the left;
 * the members are g, g', g'' ... of the solution of Q(D) g = 0 that vanishes N - 1 times at u = 0, and their
 * mirror images. */
#ifndef VES_SURFACE_BASIS_H
#define VES_SURFACE_BASIS_H

#include "surface/factor.h"
#include "surface/twofold.h"
#include "surface/weights.h"

enum { VES_SERIES = 260 };

/* The symmetric polynomials h_m of the roots in units of kappa^2, and their derivatives by each parameter. */
typedef struct ves_series {
    int terms;
    double kappa; /* a power of 2 */
    ves_two h[VES_SERIES / 2], slope[VES_PARAMETERS_MAX][VES_SERIES / 2];
} ves_series;

/* The mode of an operator that is being solved. */
typedef struct ves_mode {
    const ves_operator *op;
    double n;
    int orders; /* derivatives 0 .. orders - 1 will be wanted */
    bool slopes;
    const ves_factor *factor;
    bool centred;
    ves_series series; /* of the centred basis only */
} ves_mode;

/* value[member * orders + d], slope[(parameter * members + member) * orders + d] (NULL: not wanted); members =
 * 2 N. */
typedef struct ves_basis {
    int orders;
    ves_twos *value, *slope;
    ves_twos *power; /* [VES_SERIES] scratch */
} ves_basis;

double ves_mode_size(const ves_mode *mode); /* the rate: about the largest |r| */
void ves_mode_center(ves_mode *mode);       /* makes it centred */

void ves_basis_centred(const ves_mode *mode, ves_lanes u, const ves_basis *basis);
void ves_basis_decaying(const ves_mode *mode, ves_lanes u, const ves_basis *basis);
void ves_basis_split(const ves_mode *mode, ves_lanes u, const ves_basis *basis);

#endif

/* Kinds of elements: what all elements of one order share. Tensor-product quadrilaterals in (r, s) on [-1, 1]^2; node
 * k = j * (order[0] + 1) + i, i along r.
 *
 * The strains of a degenerated shell, covariant, with position X + z V (V half the thickness times the director,
 * -1 <= z <= 1) and displacement U + z A, are
 *     e_ab(z) = M_ab + z B_ab + z^2 Q_ab,     gamma_a3 = X_a . A + V . U_a
 *     M_ab = (X_a . U_b + X_b . U_a) / 2,  B_ab = (X_a . A_b + V_a . U_b + ...) / 2,  Q_ab = (V_a . A_b + V_b . A_a) / 2
 * where the part of gamma_a3 linear in z, the derivative of V . A, is left out: V . A = 0 at every node. Each strain is
 * taken where it is good, at its tying points, and interpolated from there (mixed interpolation of tensorial
 * components, MITC): order 1 has the shear of [Dvorkin, Bathe 1984] and the membrane of [Ko, Lee, Bathe 2017]
 * (MITC4+), order 2 is MITC9 [Bucalem, Bathe 1993]; orders from 3 on are not tied. */
#ifndef VES_SHELL_KIND_H
#define VES_SHELL_KIND_H

#include <stdbool.h>

#include "base/arena.h"
#include "shell/rule.h"
#include "vesica/status.h"

typedef enum ves_strain { VES_RR, VES_SS, VES_RS, VES_RT, VES_ST, VES_STRAINS } ves_strain;

/* Shape functions and their derivatives at some points: [points][nodes]. */
typedef struct ves_shell_table {
    int points;
    double *N, *Nr, *Ns;
} ves_shell_table;

/* Points at which strains are wanted: where, and how they come from the tying points of each strain
 * ([points][tied points]; NULL: taken at the points themselves). */
typedef struct ves_shell_points {
    int points;
    double (*at)[2];
    int along[2];   /* of a tensor product: points along r and s, r fastest */
    double *weight; /* of a quadrature on [-1, 1]^2 */
    ves_shell_table table;
    double *mix[VES_STRAINS];
} ves_shell_points;

typedef struct ves_shell_kind {
    int order[2], nodes;
    bool plus; /* the membrane of MITC4+, whose interpolation depends on the element's shape */
    ves_shell_table tied[VES_STRAINS];
    ves_shell_points rule; /* quadrature */
    double *twice[2];      /* of products of two functions along r and s: shell/tensor.c; NULL: it is tied */
    ves_shell_points lattice; /* where stresses are reported: evenly spread, ends included */
} ves_shell_kind;

/* flat: one Gauss point and one column of reported points along s (the strip of a ring). */
ves_status ves_shell_kind_make(const int order[2], bool flat, ves_arena *arena, ves_shell_kind *kind);

#endif

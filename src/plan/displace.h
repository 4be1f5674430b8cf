/* Displacing surfaces of revolution: the planes of a site become those of
 *     X + (even(u) + wave(u) cos n v) D(u, v),   D = Dr (cos v e1 + sin v e2) + Dz e3,
 * moved as a whole afterwards; and the transpose, from the adjoints of the planes to those of the amplitude. Every
 * measure with a gradient so tells its first variation under any displacement. */
#ifndef VES_PLAN_DISPLACE_H
#define VES_PLAN_DISPLACE_H

#include "surface/tile.h"

/* X -> turn X + shift; its derivatives -> turn them. */
typedef struct plan_motion {
    double turn[3][3], shift[3];
} plan_motion;

/* One surface. Arrays [nu] at its nodes; index 0 .. 2: the derivative along u. */
typedef struct plan_displacement {
    double frame[3][3]; /* e1, e2, e3: orthonormal */
    int nu, n;
    const double *v;           /* [nv] */
    double *radial[3];         /* Dr */
    double *axial[3];          /* Dz */
    double *even[3], *wave[3]; /* amplitude, m */
    double *by[3];             /* dJ / d wave (of n = 0: of even too); ves_displace_gradient adds to it */
    const plan_motion *motion; /* NULL: none; has no transpose */
} plan_displacement;

/* The fields that the tile names. */
void ves_displace(const plan_displacement *d, const ves_tile *tile, ves_tile_planes *field);
void ves_displace_gradient(const plan_displacement *d, const ves_tile *tile, const ves_tile_planes *adjoint);

#endif

/* The two directions in which a ring turns: C(v) = centre + r0 e0 cos v + r1 e1 sin v.
 *
 * For an axis along z they are x, y; along y they are x, z; along x they are y, z: the two other coordinate
 * axes, in order. For any other axis n take the coordinate axis m nearest to it (on a tie the later of x, y,
 * z) and turn the frame of m by the smallest rotation that brings m onto n: e = e_m - (n . e_m) / (1 + n . m)
 * (m + n) An axis and its opposite give the same frame. It is smooth in n except where the nearest coordinate
 * axis changes: there it must jump, since no frame that is smooth everywhere contains all three of the above.
 */
#ifndef VES_CURVE_FRAME_H
#define VES_CURVE_FRAME_H

#include "curve/curve.h"

/* axis: any length but 0. */
void ves_frame_bind(const double axis[3], double e[2][3]);

/* Adds (d J / d e) d e / d axis to axis_adjoint. */
void ves_frame_scatter(const double axis[3], const double e_adjoint[2][3], double axis_adjoint[3]);

/* A ring as an operation: keys number `axis` and `centre` of the table (defaults z and the origin). */
typedef struct ves_ring {
    int axis, centre;
} ves_ring;

ves_status ves_ring_check(const ves_curve_input *input, ves_ring ring, ves_diag *diag);
void ves_ring_eval(const ves_curve_input *input, ves_ring ring, const double radius[2], double *out);
void ves_ring_gradient(const ves_curve_input *input, ves_ring ring, const double radius[2],
                       const double *adjoint, double radius_adjoint[2], double *number_adjoint);

#endif

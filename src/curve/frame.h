/* The two directions in which a ring turns: C(v) = centre + r0 e0 cos v + r1 e1 sin v.
 *
 * For an axis along z they are x, y; along y they are x, z; along x they are y, z: the two other coordinate
 * axes, in order. For any other axis n take the coordinate axis m nearest to it (on a tie the later of x, y,
 * z) and turn the frame of m by the smallest rotation that brings m onto n: e = e_m - (n . e_m) / (1 + n . m)
 * (m + n). An axis and its opposite give the same frame.
 *
 * No frame that is smooth everywhere contains all three of the above. So for an axis that varies m, and the
 * sign that puts n on its side, are chosen once and kept: m is the coordinate axis of the largest component
 * that is constant and not 0 ([tx, 1, tz]: y), and the frame is then smooth wherever the others go. Where
 * there is none, it is the nearest one to the axis with all variables in the middle of their ranges (z where
 * that has no direction): the same axis gives the same frame wherever a search starts, and a run that goes on
 * from its best goes on with the same surface. The frame is then smooth but at n = -m, at least 125 degrees
 * from that middle; there it jumps, and is that of m. */
#ifndef VES_CURVE_FRAME_H
#define VES_CURVE_FRAME_H

#include "curve/curve.h"

typedef struct ves_frame {
    int m, other[2]; /* the coordinate axis, and the other two in order */
    double sign;     /* of the axis along m */
} ves_frame;

/* axis: with all variables in the middle of their ranges; varies: each of its components, or NULL. */
ves_frame ves_frame_init(const double axis[3], const bool varies[3]);

/* axis: any length but 0. */
void ves_frame_bind(const ves_frame *frame, const double axis[3], double e[2][3]);

/* Adds (d J / d e) d e / d axis to axis_adjoint. */
void ves_frame_scatter(const ves_frame *frame, const double axis[3], const double e_adjoint[2][3],
                       double axis_adjoint[3]);

/* A ring as an operation: keys number `axis` and `centre` of the table (defaults z and the origin). */
typedef struct ves_ring {
    int axis, centre;
} ves_ring;

/* Refuses an axis without a direction; *state becomes the frame, which eval and gradient then find in
 * input->state. */
ves_status ves_ring_prepare(const ves_curve_input *input, ves_ring ring, ves_arena *arena, void **state,
                            ves_diag *diag);
void ves_ring_eval(const ves_curve_input *input, ves_ring ring, const double radius[2], double *out);
void ves_ring_gradient(const ves_curve_input *input, ves_ring ring, const double radius[2],
                       const double *adjoint, double radius_adjoint[2], double *number_adjoint);

#endif

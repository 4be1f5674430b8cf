#include "curve/frame.h"

#include <math.h>

#include "base/vector.h"
#include "curve/modes.h"

static const double origin[3] = {0, 0, 0}, upward[3] = {0, 0, 1};

/* The unit vector n along the axis, on the side of m, and 1 + n . m. */
typedef struct tilt {
    double n[3], length; /* length: of the axis, negative when n points against it */
    double sum;
} tilt;

/* The largest component, on a tie the later one. */
static int largest(const double axis[3])
{
    int m = 2;
    if (fabs(axis[1]) > fabs(axis[m])) m = 1;
    if (fabs(axis[0]) > fabs(axis[m])) m = 0;
    return m;
}

ves_frame ves_frame_init(const double axis[3], const bool varies[3])
{
    double fixed[3], known[3];
    for (int c = 0; c < 3; c++) {
        known[c] = isfinite(axis[c]) ? axis[c] : 0;
        fixed[c] = varies && varies[c] ? 0 : known[c];
    }
    ves_frame frame = {.m = largest(fixed)};
    if (fixed[frame.m] == 0) frame.m = largest(known);
    frame.other[0] = frame.m == 0 ? 1 : 0;
    frame.other[1] = frame.m == 2 ? 1 : 2;
    frame.sign = known[frame.m] < 0 ? -1 : 1;
    return frame;
}

static tilt tilt_of(const ves_frame *frame, const double axis[3])
{
    tilt t = {.length = frame->sign * sqrt(ves_dot(axis, axis))};
    for (int c = 0; c < 3; c++) t.n[c] = axis[c] / t.length;
    double along = t.n[frame->m], p = t.n[frame->other[0]], q = t.n[frame->other[1]];
    t.sum = along < 0 ? (p * p + q * q) / (1 - along) : 1 + along; /* near -m the sum would cancel */
    return t;
}

/* (n . e_m) / (1 + n . m) of the other axis i. */
static double lean(const ves_frame *frame, const tilt *t, int i)
{
    return t->sum > 0 ? t->n[frame->other[i]] / t->sum : 0;
}

void ves_frame_bind(const ves_frame *frame, const double axis[3], double e[2][3])
{
    tilt t = tilt_of(frame, axis);
    for (int i = 0; i < 2; i++) {
        double q = lean(frame, &t, i);
        for (int c = 0; c < 3; c++) e[i][c] = (c == frame->other[i]) - q * (c == frame->m ? t.sum : t.n[c]);
    }
}

void ves_frame_scatter(const ves_frame *frame, const double axis[3], const double e_adjoint[2][3],
                       double axis_adjoint[3])
{
    tilt t = tilt_of(frame, axis);
    double n_adjoint[3] = {0, 0, 0}, inverse = t.sum > 0 ? 1 / t.sum : 0;
    for (int i = 0; i < 2; i++) {
        double q = lean(frame, &t, i), q_adjoint = 0;
        for (int c = 0; c < 3; c++) {
            n_adjoint[c] -= q * e_adjoint[i][c];
            q_adjoint -= e_adjoint[i][c] * (c == frame->m ? t.sum : t.n[c]);
        }
        n_adjoint[frame->other[i]] += q_adjoint * inverse;
        n_adjoint[frame->m] -= q_adjoint * q * inverse;
    }
    double along = ves_dot(n_adjoint, t.n);
    for (int c = 0; c < 3; c++) axis_adjoint[c] += (n_adjoint[c] - along * t.n[c]) / t.length;
}

ves_status ves_ring_prepare(const ves_curve_input *input, ves_ring ring, ves_arena *arena, void **state,
                            ves_diag *diag)
{
    const double *axis = ves_input_vector(input, ring.axis, upward);
    if (!(ves_dot(axis, axis) > 0))
        return ves_diag_add(diag, VES_ERROR, VES_RANGE, ves_input_mark(input, ring.axis),
                            "\"axis\" must not be [0, 0, 0]: it says which way the curve's plane faces");
    ves_frame *frame = ves_arena_take(arena, 1, sizeof *frame);
    if (!frame) return ves_input_memory(input, diag);
    const ves_arg *arg = &input->args->arg[ring.axis];
    *frame = arg->given ? ves_frame_init(input->middle + arg->first, input->varying + arg->first)
                        : ves_frame_init(upward, NULL);
    *state = frame;
    return VES_OK;
}

void ves_ring_eval(const ves_curve_input *input, ves_ring ring, const double radius[2], double *out)
{
    const double *centre = ves_input_vector(input, ring.centre, origin);
    double e[2][3];
    ves_frame_bind(input->state, ves_input_vector(input, ring.axis, upward), e);
    for (int c = 0; c < 3; c++) {
        out[3 * c] = centre[c];
        for (int i = 0; i < 2; i++) out[3 * c + 1 + i] = radius[i] * e[i][c];
    }
}

void ves_ring_gradient(const ves_curve_input *input, ves_ring ring, const double radius[2],
                       const double *adjoint, double radius_adjoint[2], double *number_adjoint)
{
    const double *axis = ves_input_vector(input, ring.axis, upward);
    double e[2][3], e_adjoint[2][3], axis_adjoint[3] = {0, 0, 0};
    ves_frame_bind(input->state, axis, e);
    for (int i = 0; i < 2; i++) {
        radius_adjoint[i] = 0;
        for (int c = 0; c < 3; c++) {
            e_adjoint[i][c] = radius[i] * adjoint[3 * c + 1 + i];
            radius_adjoint[i] += e[i][c] * adjoint[3 * c + 1 + i];
        }
    }
    ves_frame_scatter(input->state, axis, e_adjoint, axis_adjoint);
    for (int c = 0; c < 3; c++) {
        ves_input_scatter(input, ring.centre, c, adjoint[3 * c], number_adjoint);
        ves_input_scatter(input, ring.axis, c, axis_adjoint[c], number_adjoint);
    }
}

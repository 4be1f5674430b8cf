#include "curve/frame.h"

#include <math.h>

#include "curve/modes.h"

static const double origin[3] = {0, 0, 0}, upward[3] = {0, 0, 1};

/* The nearest coordinate axis m, the other two in order, and the unit vector n along the axis, on the side of
 * m. */
typedef struct tilt {
    int m, other[2];
    double n[3], length; /* length: of the axis, negative when n points against it */
} tilt;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static tilt tilt_of(const double axis[3])
{
    tilt t = {.m = 2};
    if (fabs(axis[1]) > fabs(axis[t.m])) t.m = 1;
    if (fabs(axis[0]) > fabs(axis[t.m])) t.m = 0;
    t.other[0] = t.m == 0 ? 1 : 0;
    t.other[1] = t.m == 2 ? 1 : 2;
    t.length = copysign(sqrt(dot(axis, axis)), axis[t.m]);
    for (int c = 0; c < 3; c++) t.n[c] = axis[c] / t.length;
    return t;
}

void ves_frame_bind(const double axis[3], double e[2][3])
{
    tilt t = tilt_of(axis);
    for (int i = 0; i < 2; i++) {
        double q = t.n[t.other[i]] / (1 + t.n[t.m]);
        for (int c = 0; c < 3; c++) e[i][c] = (c == t.other[i]) - q * ((c == t.m) + t.n[c]);
    }
}

void ves_frame_scatter(const double axis[3], const double e_adjoint[2][3], double axis_adjoint[3])
{
    tilt t = tilt_of(axis);
    double n_adjoint[3] = {0, 0, 0}, divisor = 1 + t.n[t.m];
    for (int i = 0; i < 2; i++) {
        double q = t.n[t.other[i]] / divisor, q_adjoint = 0;
        for (int c = 0; c < 3; c++) {
            n_adjoint[c] -= q * e_adjoint[i][c];
            q_adjoint -= e_adjoint[i][c] * ((c == t.m) + t.n[c]);
        }
        n_adjoint[t.other[i]] += q_adjoint / divisor;
        n_adjoint[t.m] -= q_adjoint * q / divisor;
    }
    double along = dot(n_adjoint, t.n);
    for (int c = 0; c < 3; c++) axis_adjoint[c] += (n_adjoint[c] - along * t.n[c]) / t.length;
}

ves_status ves_ring_check(const ves_curve_input *input, ves_ring ring, ves_diag *diag)
{
    const double *axis = ves_input_vector(input, ring.axis, upward);
    if (dot(axis, axis) > 0) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_RANGE, ves_input_mark(input, ring.axis),
                        "\"axis\" must not be [0, 0, 0]: it says which way the curve's plane faces");
}

void ves_ring_eval(const ves_curve_input *input, ves_ring ring, const double radius[2], double *out)
{
    const double *centre = ves_input_vector(input, ring.centre, origin);
    double e[2][3];
    ves_frame_bind(ves_input_vector(input, ring.axis, upward), e);
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
    ves_frame_bind(axis, e);
    for (int i = 0; i < 2; i++) {
        radius_adjoint[i] = 0;
        for (int c = 0; c < 3; c++) {
            e_adjoint[i][c] = radius[i] * adjoint[3 * c + 1 + i];
            radius_adjoint[i] += e[i][c] * adjoint[3 * c + 1 + i];
        }
    }
    ves_frame_scatter(axis, e_adjoint, axis_adjoint);
    for (int c = 0; c < 3; c++) {
        ves_input_scatter(input, ring.centre, c, adjoint[3 * c], number_adjoint);
        ves_input_scatter(input, ring.axis, c, axis_adjoint[c], number_adjoint);
    }
}

/* Rotation by three angles about the fixed axes, first x, then y, then z: R = R_z R_y R_x, each turning
 * counterclockwise as seen from the tip of its axis. */
#include <math.h>

#include "curve/modes.h"

enum { BY, ABOUT };

static const double nothing[3] = {0, 0, 0};

static const ves_key keys[] = {
    {.name = "by",
     .kind = VES_VECTOR,
     .required = true,
     .unit = "1",
     .about = "[Rx, Ry, Rz]: angles about the fixed axes, applied in this order"},
    {.name = "about",
     .kind = VES_CHOICE,
     .words = "origin|centre",
     .about = "the point that stays: the origin, or the curve's own mean point"},
    {.name = NULL},
};

static int first(const ves_curve_input *input)
{
    return input->args->arg[ABOUT].value; /* 1: the mean, coefficient 0, stays */
}

static void rotation(const double angle[3], double r[3][3])
{
    double cx = cos(angle[0]), cy = cos(angle[1]), cz = cos(angle[2]);
    double sx = sin(angle[0]), sy = sin(angle[1]), sz = sin(angle[2]);
    r[0][0] = cz * cy, r[0][1] = cz * sy * sx - sz * cx, r[0][2] = cz * sy * cx + sz * sx;
    r[1][0] = sz * cy, r[1][1] = sz * sy * sx + cz * cx, r[1][2] = sz * sy * cx - cz * sx;
    r[2][0] = -sy, r[2][1] = cy * sx, r[2][2] = cy * cx;
}

static void eval(const ves_curve_input *input, double *out)
{
    const double *in = input->input[0];
    int stride = ves_curve_stride(input->modes);
    double r[3][3];
    rotation(ves_input_vector(input, BY, nothing), r);
    for (int c = 0; c < 3; c++) {
        out[c * stride] = in[c * stride];
        for (int k = first(input); k < stride; k++)
            out[c * stride + k] = r[c][0] * in[k] + r[c][1] * in[stride + k] + r[c][2] * in[2 * stride + k];
    }
}

/* An angle about the unit vector w changes R in by w x (R in); so d J / d angle = w . sum_k (R in_k) x
 * adjoint_k, the torque of the adjoint. In the frame before the rotation it is t = sum_k in_k x g_k with g =
 * R^T adjoint, which is the input's adjoint too. The axes w: x after both later turns, R e_x; y after the
 * last one, R_z e_y; z itself. */
static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    const double *angle = ves_input_vector(input, BY, nothing), *in = input->input[0];
    double *to = input_adjoint[0], r[3][3], t[3] = {0, 0, 0}, g[3], torque[3];
    int stride = ves_curve_stride(input->modes);
    rotation(angle, r);
    for (int c = 0; to && first(input) && c < 3; c++) to[c * stride] += adjoint[c * stride];
    for (int k = first(input); k < stride; k++) {
        for (int c = 0; c < 3; c++) {
            g[c] = r[0][c] * adjoint[k] + r[1][c] * adjoint[stride + k] + r[2][c] * adjoint[2 * stride + k];
            if (to) to[c * stride + k] += g[c];
        }
        t[0] += in[stride + k] * g[2] - in[2 * stride + k] * g[1];
        t[1] += in[2 * stride + k] * g[0] - in[k] * g[2];
        t[2] += in[k] * g[1] - in[stride + k] * g[0];
    }
    for (int c = 0; c < 3; c++) torque[c] = r[c][0] * t[0] + r[c][1] * t[1] + r[c][2] * t[2];
    ves_input_scatter(input, BY, 0, t[0], number_adjoint);
    ves_input_scatter(input, BY, 1, cos(angle[2]) * torque[1] - sin(angle[2]) * torque[0], number_adjoint);
    ves_input_scatter(input, BY, 2, torque[2], number_adjoint);
}

const ves_curve_op ves_curve_rotate_op = {
    .name = "rotate",
    .about = "turns a curve about x, then y, then z",
    .move = true,
    .keys = keys,
    .modes = ves_input_modes,
    .eval = eval,
    .gradient = gradient,
};

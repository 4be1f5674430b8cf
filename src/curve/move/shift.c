/* Shifts the parameter: C_new(v) = C(v + by), so that v = 0 comes to lie where v = by was. The curve stays
 * the same set of points. Mode n turns by n times the angle:  a' = a cos + b sin,  b' = b cos - a sin. */
#include <math.h>

#include "curve/modes.h"

enum { BY };

static const ves_key keys[] = {
    {.name = "by",
     .kind = VES_NUMBER,
     .required = true,
     .unit = "1",
     .about = "angle: the new curve at v is the old one at v + by"},
    {.name = NULL},
};

static void eval(const ves_curve_input *input, double *out)
{
    const double *in = input->input[0];
    double by = ves_input_number(input, BY), step[2] = {cos(by), sin(by)}, z[2] = {1, 0};
    int stride = ves_curve_stride(input->modes);
    for (int c = 0; c < 3; c++) out[c * stride] = in[c * stride];
    for (int n = 1; n <= input->modes; n++) {
        ves_turn(z, step);
        for (int c = 0; c < 3; c++) {
            double a = in[c * stride + 2 * n - 1], b = in[c * stride + 2 * n];
            out[c * stride + 2 * n - 1] = a * z[0] + b * z[1];
            out[c * stride + 2 * n] = b * z[0] - a * z[1];
        }
    }
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    const double *in = input->input[0];
    double *to = input_adjoint[0], angle_adjoint = 0;
    double by = ves_input_number(input, BY), step[2] = {cos(by), sin(by)}, z[2] = {1, 0};
    int stride = ves_curve_stride(input->modes);
    for (int c = 0; to && c < 3; c++) to[c * stride] += adjoint[c * stride];
    for (int n = 1; n <= input->modes; n++) {
        ves_turn(z, step);
        for (int c = 0; c < 3; c++) {
            int k = c * stride + 2 * n - 1;
            double a = in[k], b = in[k + 1], p = adjoint[k], q = adjoint[k + 1];
            angle_adjoint += n * (p * (b * z[0] - a * z[1]) - q * (a * z[0] + b * z[1]));
            if (!to) continue;
            to[k] += p * z[0] - q * z[1];
            to[k + 1] += p * z[1] + q * z[0];
        }
    }
    ves_input_scatter(input, BY, 0, angle_adjoint, number_adjoint);
}

const ves_curve_op ves_curve_shift_op = {
    .name = "shift",
    .about = "moves the start of the parameter along a curve",
    .move = true,
    .keys = keys,
    .modes = ves_input_modes,
    .eval = eval,
    .gradient = gradient,
};

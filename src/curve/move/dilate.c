/* Scales each coordinate, about the origin or about the curve's own mean point a_0. */
#include "curve/modes.h"

enum { BY, ABOUT };

static const double ones[3] = {1, 1, 1};

static const ves_key keys[] = {
    {.name = "by", .kind = VES_SCALES, .required = true, .unit = "1", .about = "one factor, or [x, y, z]"},
    {.name = "about",
     .kind = VES_CHOICE,
     .words = "origin|centre",
     .about = "the point that stays: the origin, or the curve's own mean point"},
    {.name = NULL},
};

/* First coefficient that is scaled: the mean stays when the curve's own centre does. */
static int first(const ves_curve_input *input)
{
    return input->args->arg[ABOUT].value;
}

static void eval(const ves_curve_input *input, double *out)
{
    const double *by = ves_input_vector(input, BY, ones);
    int stride = ves_curve_stride(input->modes);
    ves_modes_copy(input->input[0], input->modes, input->modes, out);
    for (int c = 0; c < 3; c++)
        for (int k = first(input); k < stride; k++) out[c * stride + k] *= by[c];
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    const double *by = ves_input_vector(input, BY, ones), *in = input->input[0];
    int stride = ves_curve_stride(input->modes);
    for (int c = 0; c < 3; c++) {
        double sum = 0;
        for (int k = 0; k < stride; k++) {
            bool scaled = k >= first(input);
            double a = adjoint[c * stride + k];
            if (scaled) sum += a * in[c * stride + k];
            if (input_adjoint[0]) input_adjoint[0][c * stride + k] += scaled ? by[c] * a : a;
        }
        ves_input_scatter(input, BY, c, sum, number_adjoint);
    }
}

const ves_curve_op ves_curve_dilate_op = {
    .name = "dilate",
    .about = "scales a curve along x, y and z",
    .move = true,
    .keys = keys,
    .modes = ves_input_modes,
    .eval = eval,
    .gradient = gradient,
};

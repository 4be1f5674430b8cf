/* C(v) + by. */
#include "curve/modes.h"

enum { BY };

static const double nothing[3] = {0, 0, 0};

static const ves_key keys[] = {
    {.name = "by", .kind = VES_VECTOR, .required = true, .about = "[x, y, z] to add to every point"},
    {.name = NULL},
};

static void eval(const ves_curve_input *input, double *out)
{
    const double *by = ves_input_vector(input, BY, nothing);
    ves_modes_copy(input->input[0], input->modes, input->modes, out);
    for (int c = 0; c < 3; c++) out[c * ves_curve_stride(input->modes)] += by[c];
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    ves_modes_scatter(adjoint, input->modes, 1, input->modes, input_adjoint[0]);
    for (int c = 0; c < 3; c++)
        ves_input_scatter(input, BY, c, adjoint[c * ves_curve_stride(input->modes)], number_adjoint);
}

const ves_curve_op ves_curve_translate_op = {
    .name = "translate",
    .about = "moves a curve",
    .move = true,
    .keys = keys,
    .modes = ves_input_modes,
    .eval = eval,
    .gradient = gradient,
};

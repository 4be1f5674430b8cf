/* Another curve as it is, to be moved by what follows. */
#include "curve/modes.h"

static const ves_key keys[] = {
    {.name = "curve",
     .kind = VES_CURVE,
     .required = true,
     .about = "the curve to start from, with all its moves"},
    {.name = NULL},
};

static void eval(const ves_curve_input *input, double *out)
{
    ves_modes_copy(input->input[0], input->input_modes[0], input->modes, out);
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    ves_modes_scatter(adjoint, input->modes, 1, input->input_modes[0], input_adjoint[0]);
}

const ves_curve_op ves_curve_like_op = {
    .name = "like",
    .about = "another curve, to be moved",
    .keys = keys,
    .modes = ves_input_modes,
    .eval = eval,
    .gradient = gradient,
};

/* A single point: the pole of a patch, or a constant vector field. */
#include "curve/modes.h"

enum { AT };

static const double origin[3] = {0, 0, 0};

static const ves_key keys[] = {
    {.name = "at", .kind = VES_VECTOR, .required = true, .about = "the point [x, y, z]"},
    {.name = NULL},
};

static void eval(const ves_curve_input *input, double *out)
{
    const double *at = ves_input_vector(input, AT, origin);
    for (int c = 0; c < 3; c++) out[c] = at[c];
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    (void)input_adjoint;
    for (int c = 0; c < 3; c++) ves_input_scatter(input, AT, c, adjoint[c], number_adjoint);
}

const ves_curve_op ves_curve_point_op = {
    .name = "point",
    .about = "a single point, or a constant vector",
    .keys = keys,
    .modes = ves_input_modes,
    .eval = eval,
    .gradient = gradient,
};

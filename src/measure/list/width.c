#include "measure/extreme.h"

/* The extent along x; see extent. */
static const double UNIT[3] = {1, 0, 0};

static ves_status eval(const ves_measure_input *input, double *value)
{
    return ves_extent_eval(input, UNIT, value);
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    ves_extent_gradient(input, UNIT, seed, adjoint, NULL);
}

const ves_measure ves_measure_width = {
    .name = "width",
    .about = "how far the surface reaches along x, from the least to the largest x",
    .unit = "m",
    .degree = 1,
    .extreme = true,
    .looks = VES_EXTREME_LOOKS,
    .surface = VES_EXTREME_SURFACE,
    .room = ves_extent_room,
    .eval = eval,
    .gradient = gradient};

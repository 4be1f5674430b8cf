#include "measure/extreme.h"

/* The extent along z; see extent. */
static const double UNIT[3] = {0, 0, 1};

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

const ves_measure ves_measure_depth = {
    .name = "depth",
    .about = "how far the surface reaches along z, from the least to the largest z",
    .unit = "m",
    .degree = 1,
    .extreme = true,
    .looks = VES_EXTREME_LOOKS,
    .surface = VES_EXTREME_SURFACE,
    .room = ves_extent_room,
    .eval = eval,
    .gradient = gradient};

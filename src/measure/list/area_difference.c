#include "measure/membrane.h"

/* test  sphere 1 at any radius; cylinder (h / 8 R0), R0 = sqrt(r h / 2) */
static ves_status eval(const ves_measure_input *input, double *value)
{
    *value = ves_membrane_difference(input);
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    ves_membrane_difference_gradient(input, seed, adjoint);
}

const ves_measure ves_measure_area_difference = {
    .name = "area_difference",
    .about = "the integral of H over the surface, relative to a sphere of the same area: between the "
             "leaflets of a bilayer",
    .unit = "1",
    .degree = 0,
    .surface = VES_AREA | VES_CURVATURE,
    .eval = eval,
    .gradient = gradient};

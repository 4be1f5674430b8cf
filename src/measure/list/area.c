#include "measure/sum.h"

/* Area of the surface (caps are not part of it).
 * test  sphere, cone, cylinder; scales with s^2 */
static ves_status eval(const ves_measure_input *input, double *value)
{
    *value = ves_sum_area(input);
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    ves_sum_area_gradient(input, seed, adjoint);
}

const ves_measure ves_measure_area = {.name = "area",
                                      .about = "area of the surface; caps do not count",
                                      .unit = "m^2",
                                      .degree = 2,
                                      .surface = VES_AREA,
                                      .eval = eval,
                                      .gradient = gradient};

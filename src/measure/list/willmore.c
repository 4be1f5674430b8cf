#include "measure/sum.h"

/* The Willmore energy.
 * test  sphere 4 pi at any radius; Clifford torus 2 pi^2; catenoid 0 */
static const ves_quadratic INTEGRAND = {.h = 1, .k = 0, .m = 0};

static ves_status eval(const ves_measure_input *input, double *value)
{
    return ves_sum_eval(input, INTEGRAND, value);
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    ves_sum_gradient(input, INTEGRAND, seed, adjoint);
}

const ves_measure ves_measure_willmore = {.name = "willmore",
                                          .about = "integral of H^2 over the surface",
                                          .unit = "1",
                                          .degree = 0,
                                          .surface = VES_AREA | VES_CURVATURE,
                                          .eval = eval,
                                          .gradient = gradient};

#include "measure/sum.h"

/* k1^2 + k2^2 = 4 H^2 - 2 K, the integrand of [Ugail 2011, 7.5]; with respect to area (docs/errata.md).
 * test  sphere 8 pi at any radius, catenoid, cylinder 2 pi h / r */
static const ves_quadratic INTEGRAND = {.h = 4, .k = -2, .m = 0};

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

const ves_measure ves_measure_bending = {.name = "bending",
                                         .about = "integral of k1^2 + k2^2 over the surface",
                                         .unit = "1",
                                         .degree = 0,
                                         .surface = VES_AREA | VES_CURVATURE,
                                         .eval = eval,
                                         .gradient = gradient};

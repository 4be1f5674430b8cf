#include "measure/sum.h"

/* test  sphere 4 pi R; cylinder pi h */
static const ves_quadratic INTEGRAND = {.h = 0, .k = 0, .m = 1};

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

const ves_measure ves_measure_mean_curvature = {.name = "mean_curvature",
                                                .about = "integral of the mean curvature H over the surface",
                                                .unit = "m",
                                                .degree = 1,
                                                .surface = VES_AREA | VES_CURVATURE,
                                                .eval = eval,
                                                .gradient = gradient};

#include "measure/sum.h"

/* Gauss-Bonnet: 4 pi on a closed smooth surface of genus 0, 0 on a torus. */
static const ves_quadratic INTEGRAND = {.h = 0, .k = 1, .m = 0};

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

const ves_measure ves_measure_gauss_curvature = {.name = "gauss_curvature",
                                                 .about =
                                                     "integral of the Gaussian curvature K over the surface",
                                                 .unit = "1",
                                                 .degree = 0,
                                                 .surface = VES_AREA | VES_CURVATURE,
                                                 .eval = eval,
                                                 .gradient = gradient};

#include "measure/membrane.h"

/* The bending energy of a membrane.
 * test  sphere 8 pi kappa (1 - C0 R / 2)^2 + 4 pi kappa_g; cylinder pi kappa h / r (1 - C0 r)^2; with reduced_c0 alone it
 *       does not depend on the size */
static const ves_key KEYS[] = {
    VES_KEY_KAPPA, VES_KEY_C0, VES_KEY_REDUCED_C0, VES_KEY_KAPPA_G, {.name = NULL}};

static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_membrane m = ves_membrane_init(input);
    *value = ves_membrane_energy(input, &m);
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    ves_membrane m = ves_membrane_init(input);
    ves_membrane_energy_gradient(input, &m, seed, adjoint, number_adjoint);
}

const ves_measure ves_measure_canham = {.name = "canham",
                                        .about = "bending energy of a membrane: kappa/2 times the integral "
                                                 "of (2 H - C0)^2, and kappa_g times that of K",
                                        .unit = "kg m^2/s^2",
                                        .degree = VES_NO_DEGREE,
                                        .surface = VES_AREA | VES_CURVATURE,
                                        .keys = KEYS,
                                        .eval = eval,
                                        .gradient = gradient};

#include "base/vector.h"
#include "measure/argument.h"
#include "measure/membrane.h"

/* Area-difference elasticity [Miao, Seifert, Wortis, Doebereiner 1994]: the bending energy, and what it costs that the
 * leaflets have not the areas they would like. With k_n = alpha kappa and dA = 8 pi D R0 M,
 *     k_n pi / (2 A D^2) (dA - dA0)^2 = 8 pi^2 alpha kappa (M - M0)^2.
 * test  sphere; alpha 0 is canham; differences in every number */
enum { ALPHA = VES_MEMBRANE_KEYS, M0 };

static const ves_key KEYS[] = {VES_KEY_KAPPA,
                               VES_KEY_C0,
                               VES_KEY_REDUCED_C0,
                               VES_KEY_KAPPA_G,
                               {.name = "alpha",
                                .kind = VES_NUMBER,
                                .unit = "1",
                                .required = true,
                                .min = 0,
                                .max = HUGE_VAL,
                                .about = "rigidity against a difference of the areas, over kappa"},
                               {.name = "m0",
                                .kind = VES_NUMBER,
                                .unit = "1",
                                .required = true,
                                .about = "the area_difference that costs nothing"},
                               {.name = NULL}};

static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_membrane m = ves_membrane_init(input);
    double alpha = ves_argument_number(input, ALPHA);
    double apart = ves_membrane_difference(input) - ves_argument_number(input, M0);
    *value = ves_membrane_energy(input, &m) + 8 * VES_PI * VES_PI * alpha * m.kappa * apart * apart;
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    ves_membrane m = ves_membrane_init(input);
    double alpha = ves_argument_number(input, ALPHA);
    double apart = ves_membrane_difference(input) - ves_argument_number(input, M0);
    double unit = seed * 8 * VES_PI * VES_PI;
    ves_membrane_energy_gradient(input, &m, seed, adjoint, number_adjoint);
    ves_membrane_difference_gradient(input, unit * 2 * alpha * m.kappa * apart, adjoint);
    ves_argument_scatter(input, VES_MEMBRANE_KAPPA, 0, unit * alpha * apart * apart, number_adjoint);
    ves_argument_scatter(input, ALPHA, 0, unit * m.kappa * apart * apart, number_adjoint);
    ves_argument_scatter(input, M0, 0, -unit * 2 * alpha * m.kappa * apart, number_adjoint);
}

const ves_measure ves_measure_ade = {
    .name = "ade",
    .about =
        "canham, and 8 pi^2 alpha kappa (area_difference - m0)^2: area-difference elasticity of a bilayer",
    .unit = "kg m^2/s^2",
    .degree = VES_NO_DEGREE,
    .surface = VES_AREA | VES_CURVATURE,
    .keys = KEYS,
    .eval = eval,
    .gradient = gradient};

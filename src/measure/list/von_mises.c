#include "measure/stress.h"

/* The equivalent stress of the five stresses of a shell [von Mises].
 * test  plates and pressed spheres in closed form; the pots of the container study against another program */
static ves_status eval(const ves_measure_input *input, double *value)
{
    return ves_stress_largest(input, ves_stress_mises, value);
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    static const ves_stress_kind kind = {ves_stress_mises, ves_stress_mises_slope};
    (void)adjoint;
    ves_stress_gradient(input, &kind, seed, number_adjoint);
}

const ves_measure ves_measure_von_mises = {.name = "von_mises",
                                           .about = "largest equivalent stress of the shell (von Mises)",
                                           .unit = "Pa",
                                           .degree = VES_NO_DEGREE,
                                           .cost = 1,
                                           .extreme = true,
                                           .shell = true,
                                           .keys = ves_stress_keys,
                                           .room = ves_stress_room,
                                           .prepare = ves_stress_prepare,
                                           .release = ves_stress_release,
                                           .eval = eval,
                                           .gradient = gradient};

#include "measure/stress.h"

/* Half the largest difference of principal stresses, the zero one across the surface counted [Tresca].
 * test  plates and pressed spheres in closed form; the pots of the container study against another program */
static ves_status eval(const ves_measure_input *input, double *value)
{
    return ves_stress_largest(input, ves_stress_shear, value);
}

const ves_measure ves_measure_max_shear = {.name = "max_shear",
                                           .about = "largest shear stress of the shell (Tresca)",
                                           .unit = "Pa",
                                           .degree = VES_NO_DEGREE,
                                           .cost = 1,
                                           .extreme = true,
                                           .shell = true,
                                           .keys = ves_stress_keys,
                                           .room = ves_stress_room,
                                           .eval = eval};

#include "measure/flux.h"

/* Volume inside the closed shape (ves_flux_volume).
 * test  sphere, cylinder with caps, translation; one of two capped cylinders */
static ves_status eval(const ves_measure_input *input, double *value)
{
    *value = ves_flux_volume(input);
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    ves_flux_volume_gradient(input, seed, adjoint);
}

const ves_measure ves_measure_volume = {
    .name = "volume",
    .about = "volume inside the closed shape, caps included; over less than all of a closed part: of the "
             "cones from the origin to that, which depends on where it stands",
    .unit = "m^3",
    .degree = 3,
    .surface = VES_X | VES_NORMAL | VES_AREA,
    .cap = VES_X | VES_XV,
    .closed = true,
    .eval = eval,
    .gradient = gradient};

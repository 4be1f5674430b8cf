#include <math.h>

#include "measure/argument.h"
#include "measure/nest.h"

enum { AXIS, THICKNESS };

static const ves_key KEYS[] = {{.name = "axis",
                                .kind = VES_VECTOR,
                                .unit = "1",
                                .about = "the way a copy comes off, [0, 1, 0] unless given; any length"},
                               {.name = "thickness",
                                .kind = VES_NUMBER,
                                .required = true,
                                .unit = "m",
                                .min = VES_POSITIVE,
                                .max = HUGE_VAL,
                                .about = "of the wall; half of it lies on either side of the surface"},
                               {.name = NULL}};

/* How much higher the next one stands in a stack of copies (measure/nest.h). A wall without thickness would nest
 * without a pitch wherever it has draft: nothing to optimise, hence the key must be given. */
static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_direction d;
    VES_TRY(ves_direction_init(input, AXIS, &d));
    double thickness = ves_argument_number(input, THICKNESS);
    return thickness > 0 ? ves_nest_eval(input, d.unit, thickness, value) : VES_NO_NUMBER;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    ves_direction d;
    double back[3] = {0};
    if (ves_direction_init(input, AXIS, &d) != VES_OK) return;
    ves_argument_scatter(input, THICKNESS, 0, ves_nest_gradient(input, seed, adjoint, back), number_adjoint);
    ves_direction_gradient(input, AXIS, &d, back, number_adjoint);
}

const ves_measure ves_measure_nesting_pitch = {
    .name = "nesting_pitch",
    .about = "how much higher the next one stands in a stack of copies that nest in each other",
    .unit = "m",
    .degree = VES_NO_DEGREE,
    .cost = 1,
    .extreme = true,
    .looks = VES_NEST_LOOKS,
    .surface = VES_NEST_SURFACE,
    .cap = VES_NEST_CAP,
    .keys = KEYS,
    .room = ves_nest_room,
    .eval = eval,
    .gradient = gradient};

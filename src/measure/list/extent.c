#include "measure/argument.h"
#include "measure/extreme.h"

enum { ALONG };

static const ves_key KEYS[] = {{.name = "along",
                                .kind = VES_VECTOR,
                                .unit = "1",
                                .about = "direction, [0, 1, 0] unless given; any length"},
                               {.name = NULL}};

/* max d . X - min d . X over the surface, d = along / |along| (measure/extreme.h). VES_NO_NUMBER: along is
 * zero.
 * test  ellipsoid turned any way: 2 |M^T d|; tilted cylinder and cone: the rims; without looks order 3;
 *       differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_direction d;
    VES_TRY(ves_direction_init(input, ALONG, &d));
    return ves_extent_eval(input, d.unit, value);
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    ves_direction d;
    double back[3] = {0};
    if (ves_direction_init(input, ALONG, &d) != VES_OK) return;
    ves_extent_gradient(input, d.unit, seed, adjoint, back);
    ves_direction_gradient(input, ALONG, &d, back, number_adjoint);
}

const ves_measure ves_measure_extent = {
    .name = "extent",
    .about = "how far the surface reaches along a direction, y unless it is given",
    .unit = "m",
    .degree = 1,
    .extreme = true,
    .looks = VES_EXTREME_LOOKS,
    .surface = VES_EXTREME_SURFACE,
    .keys = KEYS,
    .room = ves_extent_room,
    .eval = eval,
    .gradient = gradient};

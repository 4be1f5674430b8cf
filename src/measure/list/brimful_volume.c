#include "measure/argument.h"
#include "measure/fill.h"

enum { AXIS, RIM };

static const ves_key KEYS[] = {
    {.name = "axis", .kind = VES_VECTOR, .unit = "1", .about = "upward, [0, 1, 0] unless given; any length"},
    {.name = "rim", .kind = VES_CURVE, .about = "the rim; unless given that of the uppermost cap"},
    {.name = NULL}};

static size_t room(const ves_measure_input *input)
{
    return ves_fill_room(input);
}

/* The volume of the closed shape below the lowest point of its rim (measure/fill.h). VES_NO_NUMBER: the axis is zero,
 * or there is no rim. */
static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_direction d;
    double level;
    VES_TRY(ves_direction_init(input, AXIS, &d));
    VES_TRY(ves_fill_rim(input, RIM, d.unit, &level));
    return ves_fill_eval(input, d.unit, level, value);
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    ves_direction d;
    double level, back[3] = {0};
    if (ves_direction_init(input, AXIS, &d) != VES_OK) return;
    if (ves_fill_rim(input, RIM, d.unit, &level) != VES_OK) return;
    double by_level = ves_fill_gradient(input, d.unit, level, seed, adjoint, back);
    ves_fill_rim_gradient(input, d.unit, by_level, adjoint, back);
    ves_direction_gradient(input, AXIS, &d, back, number_adjoint);
}

const ves_measure ves_measure_brimful_volume = {
    .name = "brimful_volume",
    .about = "what the upright container holds: the volume below the lowest point of its rim",
    .unit = "m^3",
    .degree = 3,
    .surface = VES_FILL_SURFACE,
    .cap = VES_FILL_CAP,
    .curve = VES_X,
    .closed = true,
    .keys = KEYS,
    .room = room,
    .eval = eval,
    .gradient = gradient};

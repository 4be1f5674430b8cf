#include <math.h>

#include "measure/argument.h"
#include "measure/fill.h"

enum { AXIS, HEIGHT, BELOW, RIM };

static const ves_key KEYS[] = {
    {.name = "axis", .kind = VES_VECTOR, .unit = "1", .about = "upward, [0, 1, 0] unless given; any length"},
    {.name = "height",
     .kind = VES_NUMBER,
     .unit = "m",
     .about = "where the level stands: its distance from the origin along the axis; at the rim unless given"},
    {.name = "below", .kind = VES_NUMBER, .unit = "m", .about = "so much lower than that (headspace)"},
    {.name = "rim", .kind = VES_CURVE, .about = "the rim; unless given that of the uppermost cap"},
    {.name = NULL}};

static size_t room(const ves_measure_input *input)
{
    return ves_fill_room(input);
}

static ves_status level_find(const ves_measure_input *input, const double axis[3], double *level)
{
    if (input->args->arg[HEIGHT].given)
        *level = ves_argument_number(input, HEIGHT);
    else
        VES_TRY(ves_fill_rim(input, RIM, axis, level));
    *level -= ves_argument_number(input, BELOW);
    return VES_OK;
}

/* The volume of the closed shape below a level (measure/fill.h): of all that lies there, chambers that communicate or
 * not. At or over the top it is the volume, at or under the bottom 0. VES_NO_NUMBER: the axis is zero, or a level is
 * counted from a rim that is not there. */
static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_direction d;
    double level;
    VES_TRY(ves_direction_init(input, AXIS, &d));
    VES_TRY(level_find(input, d.unit, &level));
    return ves_fill_eval(input, d.unit, level, value);
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    ves_direction d;
    double level, back[3] = {0};
    if (ves_direction_init(input, AXIS, &d) != VES_OK || level_find(input, d.unit, &level) != VES_OK) return;
    double by_level = ves_fill_gradient(input, d.unit, level, seed, adjoint, back);
    if (!input->args->arg[HEIGHT].given) ves_fill_rim_gradient(input, d.unit, by_level, adjoint, back);
    ves_argument_scatter(input, HEIGHT, 0, by_level, number_adjoint);
    ves_argument_scatter(input, BELOW, 0, -by_level, number_adjoint);
    ves_direction_gradient(input, AXIS, &d, back, number_adjoint);
}

const ves_measure ves_measure_fill_volume = {
    .name = "fill_volume",
    .about = "what the upright container holds up to a level: the volume of the closed shape below it",
    .unit = "m^3",
    .degree = VES_NO_DEGREE,
    .surface = VES_FILL_SURFACE,
    .cap = VES_FILL_CAP,
    .curve = VES_X,
    .closed = true,
    .keys = KEYS,
    .room = room,
    .eval = eval,
    .gradient = gradient};

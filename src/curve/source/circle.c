/* Circle: centre + radius (e0 cos v + e1 sin v), e0 and e1 as curve/frame.h says. */
#include <math.h>

#include "curve/frame.h"
#include "curve/modes.h"

enum { RADIUS, AXIS, CENTRE };

static const ves_ring ring = {AXIS, CENTRE};

static const ves_key keys[] = {
    {.name = "radius", .kind = VES_NUMBER, .required = true, .min = 0, .max = HUGE_VAL, .about = "radius"},
    {.name = "axis",
     .kind = VES_VECTOR,
     .unit = "1",
     .about = "normal of its plane, [0, 0, 1] unless given; v = 0 lies on the first of x, y, z that the "
              "plane contains (of a varying axis: with only its largest constant component, or in the middle "
              "of the ranges)"},
    {.name = "centre", .kind = VES_VECTOR, .about = "centre, the origin unless given"},
    {.name = NULL},
};

static ves_status prepare(const ves_curve_input *input, ves_arena *arena, void **state, ves_diag *diag)
{
    return ves_ring_prepare(input, ring, arena, state, diag);
}

static int modes(const ves_curve_input *input)
{
    (void)input;
    return 1;
}

static void eval(const ves_curve_input *input, double *out)
{
    double r = ves_input_number(input, RADIUS), radius[2] = {r, r};
    ves_ring_eval(input, ring, radius, out);
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    (void)input_adjoint;
    double r = ves_input_number(input, RADIUS), radius[2] = {r, r}, radius_adjoint[2];
    ves_ring_gradient(input, ring, radius, adjoint, radius_adjoint, number_adjoint);
    ves_input_scatter(input, RADIUS, 0, radius_adjoint[0] + radius_adjoint[1], number_adjoint);
}

const ves_curve_op ves_curve_circle_op = {
    .name = "circle",
    .about = "a circle about an axis",
    .keys = keys,
    .prepare = prepare,
    .modes = modes,
    .eval = eval,
    .gradient = gradient,
};

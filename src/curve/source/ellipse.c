/* Ellipse: centre + r0 e0 cos v + r1 e1 sin v, e0 and e1 as curve/frame.h says. */
#include <math.h>

#include "curve/frame.h"
#include "curve/modes.h"

enum { RADII, AXIS, CENTRE };

static const ves_ring ring = {AXIS, CENTRE};

static const ves_key keys[] = {
    {.name = "radii",
     .kind = VES_NUMBERS,
     .required = true,
     .min = 0,
     .max = HUGE_VAL,
     .about = "[r0, r1]: the half axes at v = 0 and at v = pi/2"},
    {.name = "axis",
     .kind = VES_VECTOR,
     .unit = "1",
     .about = "normal of its plane, [0, 0, 1] unless given; r0 lies on the first of x, y, z that the plane "
              "contains (of a varying axis: with only its largest constant component, or in the middle of "
              "the ranges)"},
    {.name = "centre", .kind = VES_VECTOR, .about = "centre, the origin unless given"},
    {.name = NULL},
};

static ves_status prepare(const ves_curve_input *input, ves_arena *arena, void **state, ves_diag *diag)
{
    int count;
    ves_input_list(input, RADII, &count);
    if (count != 2)
        return ves_diag_add(diag, VES_ERROR, VES_RANGE, ves_input_mark(input, RADII),
                            "\"radii\" of an ellipse are two numbers, found %d", count);
    return ves_ring_prepare(input, ring, arena, state, diag);
}

static int modes(const ves_curve_input *input)
{
    (void)input;
    return 1;
}

static void eval(const ves_curve_input *input, double *out)
{
    int count;
    ves_ring_eval(input, ring, ves_input_list(input, RADII, &count), out);
}

static void gradient(const ves_curve_input *input, const double *adjoint, double *const *input_adjoint,
                     double *number_adjoint)
{
    (void)input_adjoint;
    int count;
    double radius_adjoint[2];
    ves_ring_gradient(input, ring, ves_input_list(input, RADII, &count), adjoint, radius_adjoint,
                      number_adjoint);
    for (int i = 0; i < 2; i++) ves_input_scatter(input, RADII, i, radius_adjoint[i], number_adjoint);
}

const ves_curve_op ves_curve_ellipse_op = {
    .name = "ellipse",
    .about = "an ellipse about an axis",
    .keys = keys,
    .prepare = prepare,
    .modes = modes,
    .eval = eval,
    .gradient = gradient,
};

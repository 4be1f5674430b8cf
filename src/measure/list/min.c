#include "measure/pointwise.h"
#include "measure/summit.h"

static const ves_key KEYS[] = {{.name = "of",
                                .kind = VES_POINTWISE,
                                .required = true,
                                .about = "formula of x, y, z, H, K, k1, k2, u, v"},
                               {.name = NULL}};

/* room: the formula's scratch, then that of the summit of -f. */
static size_t room(const ves_measure_input *input)
{
    return ves_pointwise_scratch(input) + ves_summit_room(input);
}

/* The least value of a formula over the surface. VES_NO_NUMBER where the formula is no number.
 * test  torus in closed form; differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    double top;
    VES_TRY(ves_pointwise_largest(input, -1, input->room + ves_pointwise_scratch(input), &top));
    *value = -top;
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    const double *place = input->room + ves_pointwise_scratch(input);
    ves_pointwise p = ves_pointwise_init(input);
    int i = (int)place[0];
    ves_pointwise_gradient(&p, input->sample[i], (int)place[1], seed, adjoint[i], number_adjoint);
}

const ves_measure ves_measure_min = {.name = "min",
                                     .about = "least value of a formula over the surface",
                                     .unit = NULL,
                                     .degree = VES_NO_DEGREE,
                                     .extreme = true,
                                     .looks = 1,
                                     .surface = VES_X | VES_CURVATURE,
                                     .keys = KEYS,
                                     .needs = ves_pointwise_needs,
                                     .room = room,
                                     .eval = eval,
                                     .gradient = gradient};

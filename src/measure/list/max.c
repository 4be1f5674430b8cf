#include <math.h>

#include "measure/argument.h"
#include "measure/pointwise.h"
#include "measure/power.h"

enum { OF, SMOOTH };

static const ves_key KEYS[] = {
    {.name = "of",
     .kind = VES_POINTWISE,
     .required = true,
     .about = "formula of x, y, z, H, K, k1, k2, u, v"},
    {.name = "smooth",
     .kind = VES_NUMBER,
     .unit = "1",
     .min = 0,
     .max = HUGE_VAL,
     .about = "0: the largest; p > 0: the mean of max(of, 0)^p over the area, to the power 1/p, "
              "which is smooth for p >= 2"},
    {.name = NULL}};

/* The area weighs power means alone. */
static unsigned needs(const ves_args *args)
{
    return ves_pointwise_needs(args) | (args->arg[SMOOTH].given ? VES_AREA : 0);
}

/* room: the formula's scratch, then sample and node of the largest, then all values. */
static size_t room(const ves_measure_input *input)
{
    return ves_pointwise_scratch(input) + 2 + ves_pointwise_nodes(input);
}

static double *place_of(const ves_measure_input *input)
{
    return input->room + ves_pointwise_scratch(input);
}

/* Power mean of the positive part, from the values in room. */
static ves_power gather(const ves_measure_input *input, double p)
{
    const double *value = place_of(input) + 2;
    ves_power power = {.p = p};
    for (size_t k = 0; k < ves_pointwise_nodes(input); k++) power.largest = fmax(power.largest, value[k]);
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++) ves_power_add(&power, fmax(*value++, 0), s->dA[n]);
    }
    ves_power_close(&power);
    return power;
}

/* The largest value of a formula over the surface, or its power mean ( integral max(f, 0)^p dA / A
 * )^(1/p), which is less, and 0 where f is nowhere positive. VES_NO_NUMBER where the formula is no number.
 * test  torus and cone in closed form; power means on a cylinder; differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    double p = ves_argument_number(input, SMOOTH), *place = place_of(input), *all = place + 2;
    if (!(p > 0)) return ves_pointwise_largest(input, 1, place, value);
    ves_pointwise f = ves_pointwise_init(input);
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++) {
            *all = ves_pointwise_eval(&f, s, n);
            if (!isfinite(*all++)) return VES_NO_NUMBER;
        }
    }
    *value = gather(input, p).mean;
    return VES_OK;
}

static void smooth_gradient(const ves_measure_input *input, double p, double seed,
                            const ves_adjoint *const *adjoint, double *number_adjoint)
{
    ves_power power = gather(input, p);
    ves_pointwise f = ves_pointwise_init(input);
    const double *value = place_of(input) + 2;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++) {
            ves_power_slope g = ves_power_gradient(&power, *value++, s->dA[n]);
            if (g.x > 0) ves_pointwise_gradient(&f, s, n, seed * g.x, adjoint[i], number_adjoint);
            if (adjoint[i]->dA) adjoint[i]->dA[n] += seed * g.w;
        }
    }
    ves_argument_scatter(input, SMOOTH, 0, seed * ves_power_by_exponent(&power), number_adjoint);
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    double p = ves_argument_number(input, SMOOTH);
    if (p > 0) {
        smooth_gradient(input, p, seed, adjoint, number_adjoint);
        return;
    }
    const double *place = place_of(input);
    ves_pointwise f = ves_pointwise_init(input);
    int i = (int)place[0];
    ves_pointwise_gradient(&f, input->sample[i], (int)place[1], seed, adjoint[i], number_adjoint);
}

const ves_measure ves_measure_max = {.name = "max",
                                     .about = "largest value of a formula over the surface",
                                     .unit = NULL,
                                     .degree = VES_NO_DEGREE,
                                     .extreme = true,
                                     .looks = 1,
                                     .surface = VES_POINTWISE_SURFACE,
                                     .keys = KEYS,
                                     .needs = needs,
                                     .room = room,
                                     .eval = eval,
                                     .gradient = gradient};

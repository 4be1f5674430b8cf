#include "measure/pointwise.h"

static const ves_key KEYS[] = {{.name = "of",
                                .kind = VES_POINTWISE,
                                .required = true,
                                .about = "formula of x, y, z, H, K, k1, k2, u, v"},
                               {.name = NULL}};

static unsigned needs(const ves_args *args)
{
    return ves_pointwise_needs(args) | VES_AREA;
}

/* integral of f(x, y, z, H, K, k1, k2, u, v) dA, by the quadrature of the patches.
 * test  1: area; 4 H^2 - 2 K and k1^2 + k2^2: bending; moments of a sphere; differences */
static ves_status eval(const ves_measure_input *input, double *value)
{
    ves_pointwise p = ves_pointwise_init(input);
    double sum = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++) sum += ves_pointwise_eval(&p, s, n) * s->dA[n];
    }
    *value = sum;
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    ves_pointwise p = ves_pointwise_init(input);
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++) {
            double f = ves_pointwise_gradient(&p, s, n, seed * s->dA[n], adjoint[i], number_adjoint);
            if (adjoint[i]->dA) adjoint[i]->dA[n] += seed * f;
        }
    }
}

const ves_measure ves_measure_integral = {.name = "integral",
                                          .about = "integral of a formula over the surface",
                                          .unit = "*m^2",
                                          .degree = VES_NO_DEGREE,
                                          .surface = VES_POINTWISE_SURFACE,
                                          .keys = KEYS,
                                          .needs = needs,
                                          .room = ves_pointwise_scratch,
                                          .eval = eval,
                                          .gradient = gradient};

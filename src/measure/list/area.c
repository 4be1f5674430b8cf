#include "vesica/measure.h"

/* Area of the surface (caps are not part of it).
 * test  sphere, cone, cylinder; scales with s^2 */
static ves_status eval(const ves_measure_input *input, double *value)
{
    double sum = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        const double *restrict dA = s->dA;
#pragma omp simd reduction(+ : sum)
        for (int n = 0; n < s->count; n++) sum += dA[n];
    }
    *value = sum;
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE || !adjoint[i]->dA) continue;
        for (int n = 0; n < s->count; n++) adjoint[i]->dA[n] += seed;
    }
}

const ves_measure ves_measure_area = {.name = "area",
                                      .about = "area of the surface; caps do not count",
                                      .unit = "m^2",
                                      .degree = 2,
                                      .surface = VES_AREA,
                                      .eval = eval,
                                      .gradient = gradient};

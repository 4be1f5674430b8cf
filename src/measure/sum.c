#include "measure/sum.h"

ves_status ves_sum_eval(const ves_measure_input *input, ves_quadratic f, double *value)
{
    double sum = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        const double *restrict H = s->H, *restrict K = s->K, *restrict dA = s->dA;
#pragma omp simd reduction(+ : sum)
        for (int n = 0; n < s->count; n++) sum += (f.h * H[n] * H[n] + f.k * K[n] + f.m * H[n] + f.a) * dA[n];
    }
    *value = sum;
    return VES_OK;
}

void ves_sum_gradient(const ves_measure_input *input, ves_quadratic f, double seed,
                      const ves_adjoint *const *adjoint)
{
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE || !adjoint[i]->dA) continue;
        const double *restrict H = s->H, *restrict K = s->K, *restrict dA = s->dA;
        double *restrict gH = adjoint[i]->H, *restrict gK = adjoint[i]->K, *restrict gA = adjoint[i]->dA;
#pragma omp simd
        for (int n = 0; n < s->count; n++) {
            gA[n] += seed * (f.h * H[n] * H[n] + f.k * K[n] + f.m * H[n] + f.a);
            gH[n] += seed * (2 * f.h * H[n] + f.m) * dA[n];
            gK[n] += seed * f.k * dA[n];
        }
    }
}

double ves_sum_area(const ves_measure_input *input)
{
    double sum = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        const double *restrict dA = s->dA;
#pragma omp simd reduction(+ : sum)
        for (int n = 0; n < s->count; n++) sum += dA[n];
    }
    return sum;
}

void ves_sum_area_gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint)
{
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE || !adjoint[i]->dA) continue;
        for (int n = 0; n < s->count; n++) adjoint[i]->dA[n] += seed;
    }
}

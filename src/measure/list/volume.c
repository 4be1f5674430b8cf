#include "measure/flux.h"

/* Volume inside the closed shape: the flux of X / 3 through patches and caps. A cubic polynomial in the
 * modes: the trapezoid rule is exact for it once there are more than three times as many nodes as modes. test
 * sphere, cylinder with caps, translation */
static ves_status eval(const ves_measure_input *input, double *value)
{
    double sum = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site == VES_SITE_CAP) {
            ves_cap cap = ves_cap_init(s);
            for (int c = 0; c < 3; c++) sum += s->side / 6 * cap.mean[c] * cap.twice_area[c];
            continue;
        }
        const double *restrict x = s->X[0], *restrict y = s->X[1], *restrict z = s->X[2],
                               *restrict dA = s->dA;
        const double *restrict p = s->normal[0], *restrict q = s->normal[1], *restrict r = s->normal[2];
#pragma omp simd reduction(+ : sum)
        for (int n = 0; n < s->count; n++) sum += (x[n] * p[n] + y[n] * q[n] + z[n] * r[n]) * dA[n] / 3;
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
        const ves_adjoint *g = adjoint[i];
        if (!g->X[0]) continue;
        if (s->site == VES_SITE_CAP) {
            ves_cap cap = ves_cap_init(s), back = {0};
            for (int c = 0; c < 3; c++) {
                back.mean[c] = seed * s->side / 6 * cap.twice_area[c];
                back.twice_area[c] = seed * s->side / 6 * cap.mean[c];
            }
            ves_cap_gradient(s, &back, g);
            continue;
        }
        for (int c = 0; c < 3; c++) {
            const double *restrict x = s->X[c], *restrict p = s->normal[c], *restrict dA = s->dA;
            double *restrict gx = g->X[c], *restrict gp = g->normal[c], *restrict gA = g->dA;
#pragma omp simd
            for (int n = 0; n < s->count; n++) {
                gx[n] += seed / 3 * p[n] * dA[n];
                gp[n] += seed / 3 * x[n] * dA[n];
                gA[n] += seed / 3 * x[n] * p[n];
            }
        }
    }
}

const ves_measure ves_measure_volume = {.name = "volume",
                                        .about = "volume inside the closed shape, caps included",
                                        .unit = "m^3",
                                        .degree = 3,
                                        .surface = VES_X | VES_NORMAL | VES_AREA,
                                        .cap = VES_X | VES_XV,
                                        .closed = true,
                                        .eval = eval,
                                        .gradient = gradient};

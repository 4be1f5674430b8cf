#include "measure/flux.h"

/* Volume inside the closed shape: the flux of X / 3 through patches and caps. Through some patches of a closed
 * part alone it is the volume of the cones from the origin to them, which depends on where the part stands;
 * through all of one part with its caps it does not. A cubic polynomial in the modes: the trapezoid rule is exact
 * for it once there are more than three times as many nodes as modes.
 * test  sphere, cylinder with caps, translation; one of two capped cylinders */
static ves_status eval(const ves_measure_input *input, double *value)
{
    double caps = 0, sum = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site == VES_SITE_CAP) {
            ves_cap cap = ves_cap_init(s);
            for (int c = 0; c < 3; c++) caps += s->side / 6 * cap.mean[c] * cap.twice_area[c];
            continue;
        }
        const double *restrict x = s->X[0], *restrict y = s->X[1], *restrict z = s->X[2],
                               *restrict dA = s->dA;
        const double *restrict p = s->normal[0], *restrict q = s->normal[1], *restrict r = s->normal[2];
#pragma omp simd reduction(+ : sum)
        for (int n = 0; n < s->count; n++) sum += (x[n] * p[n] + y[n] * q[n] + z[n] * r[n]) * dA[n];
    }
    *value = sum / 3 + caps;
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    const double third = seed / 3;
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
        const double *restrict x = s->X[0], *restrict y = s->X[1], *restrict z = s->X[2],
                               *restrict dA = s->dA;
        const double *restrict p = s->normal[0], *restrict q = s->normal[1], *restrict r = s->normal[2];
        double *restrict gx = g->X[0], *restrict gy = g->X[1], *restrict gz = g->X[2], *restrict gA = g->dA;
        double *restrict gp = g->normal[0], *restrict gq = g->normal[1], *restrict gr = g->normal[2];
#pragma omp simd
        for (int n = 0; n < s->count; n++) {
            double w = third * dA[n];
            gx[n] += w * p[n], gy[n] += w * q[n], gz[n] += w * r[n];
            gp[n] += w * x[n], gq[n] += w * y[n], gr[n] += w * z[n];
            gA[n] += third * (x[n] * p[n] + y[n] * q[n] + z[n] * r[n]);
        }
    }
}

const ves_measure ves_measure_volume = {
    .name = "volume",
    .about = "volume inside the closed shape, caps included; over less than all of a closed part: of the "
             "cones from the origin to that, which depends on where it stands",
    .unit = "m^3",
    .degree = 3,
    .surface = VES_X | VES_NORMAL | VES_AREA,
    .cap = VES_X | VES_XV,
    .closed = true,
    .eval = eval,
    .gradient = gradient};

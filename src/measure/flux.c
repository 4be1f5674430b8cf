#include "measure/flux.h"

#include "base/vector.h"

ves_cap ves_cap_init(const ves_samples *s)
{
    ves_cap cap = {{0}, {0}};
    for (int n = 0; n < s->count; n++)
        for (int c = 0; c < 3; c++) {
            int a = (c + 1) % 3, b = (c + 2) % 3;
            cap.mean[c] += s->X[c][n] * s->weight[n] / VES_TWO_PI;
            cap.twice_area[c] += (s->X[a][n] * s->Xv[b][n] - s->X[b][n] * s->Xv[a][n]) * s->weight[n];
        }
    return cap;
}

void ves_cap_gradient(const ves_samples *s, const ves_cap *back, const ves_adjoint *adjoint)
{
    for (int n = 0; n < s->count; n++)
        for (int c = 0; c < 3; c++) {
            int a = (c + 1) % 3, b = (c + 2) % 3;
            double w = s->weight[n], g = back->twice_area[c] * w;
            adjoint->X[c][n] += back->mean[c] * w / VES_TWO_PI;
            adjoint->X[a][n] += g * s->Xv[b][n], adjoint->Xv[b][n] += g * s->X[a][n];
            adjoint->X[b][n] -= g * s->Xv[a][n], adjoint->Xv[a][n] -= g * s->X[b][n];
        }
}

/* One spoke of a fan, the triangle (c, X, X + Xv dv): its area seen along d and, t being linear on it, the
 * means of t and of t^2 / 2 from their values at the corners. */
typedef struct spoke {
    double arm[3];                  /* X - c */
    double t0, t1;                  /* t at c and at X */
    double area, mean, half_square; /* flux of 1, and of t d and t^2/2 d for unit area */
} spoke;

static spoke spoke_init(const ves_samples *s, int n, const double c[3], const double d[3])
{
    spoke k;
    for (int i = 0; i < 3; i++) k.arm[i] = s->X[i][n] - c[i];
    double vector[3];
    for (int i = 0; i < 3; i++) {
        int a = (i + 1) % 3, b = (i + 2) % 3;
        vector[i] = k.arm[a] * s->Xv[b][n] - k.arm[b] * s->Xv[a][n];
    }
    k.area = s->side / 2 * s->weight[n] * (d[0] * vector[0] + d[1] * vector[1] + d[2] * vector[2]);
    k.t0 = d[0] * c[0] + d[1] * c[1] + d[2] * c[2];
    k.t1 = d[0] * s->X[0][n] + d[1] * s->X[1][n] + d[2] * s->X[2][n];
    k.mean = (k.t0 + 2 * k.t1) / 3;
    k.half_square = (k.t0 * k.t0 + 2 * k.t0 * k.t1 + 3 * k.t1 * k.t1) / 12;
    return k;
}

static void patch_add(const ves_samples *s, const double d[3], ves_flux *flux)
{
    const double *restrict x = s->X[0], *restrict y = s->X[1], *restrict z = s->X[2], *restrict dA = s->dA;
    const double *restrict p = s->normal[0], *restrict q = s->normal[1], *restrict r = s->normal[2];
    double d0 = d[0], d1 = d[1], d2 = d[2], volume = 0, moment = 0;
#pragma omp simd reduction(+ : volume, moment)
    for (int n = 0; n < s->count; n++) {
        double t = d0 * x[n] + d1 * y[n] + d2 * z[n], area = (d0 * p[n] + d1 * q[n] + d2 * r[n]) * dA[n];
        volume += area * t, moment += area * t * t / 2;
    }
    flux->volume += volume, flux->moment += moment;
}

void ves_flux_add(const ves_samples *s, const double d[3], ves_flux *flux)
{
    if (s->site != VES_SITE_CAP) {
        patch_add(s, d, flux);
        return;
    }
    ves_cap cap = ves_cap_init(s);
    for (int n = 0; n < s->count; n++) {
        spoke k = spoke_init(s, n, cap.mean, d);
        flux->volume += k.area * k.mean, flux->moment += k.area * k.half_square;
    }
}

/* f and g are d flux / d (d . N dA) and d flux / d t, t = d . X. */
static void by_direction(const ves_samples *s, const double d[3], ves_flux back, double d_back[3])
{
    const double *restrict x = s->X[0], *restrict y = s->X[1], *restrict z = s->X[2], *restrict dA = s->dA;
    const double *restrict p = s->normal[0], *restrict q = s->normal[1], *restrict r = s->normal[2];
    double d0 = d[0], d1 = d[1], d2 = d[2], sx = 0, sy = 0, sz = 0;
#pragma omp simd reduction(+ : sx, sy, sz)
    for (int n = 0; n < s->count; n++) {
        double t = d0 * x[n] + d1 * y[n] + d2 * z[n], area = (d0 * p[n] + d1 * q[n] + d2 * r[n]) * dA[n];
        double f = (back.volume + back.moment * t / 2) * t * dA[n],
               g = (back.volume + back.moment * t) * area;
        sx += g * x[n] + f * p[n], sy += g * y[n] + f * q[n], sz += g * z[n] + f * r[n];
    }
    d_back[0] += sx, d_back[1] += sy, d_back[2] += sz;
}

static void by_planes(const ves_samples *s, const double d[3], ves_flux back, const ves_adjoint *adjoint)
{
    const double *restrict x = s->X[0], *restrict y = s->X[1], *restrict z = s->X[2], *restrict dA = s->dA;
    const double *restrict p = s->normal[0], *restrict q = s->normal[1], *restrict r = s->normal[2];
    double *restrict gx = adjoint->X[0], *restrict gy = adjoint->X[1], *restrict gz = adjoint->X[2];
    double *restrict gp = adjoint->normal[0], *restrict gq = adjoint->normal[1],
                     *restrict gr = adjoint->normal[2];
    double *restrict gA = adjoint->dA, d0 = d[0], d1 = d[1], d2 = d[2];
#pragma omp simd
    for (int n = 0; n < s->count; n++) {
        double t = d0 * x[n] + d1 * y[n] + d2 * z[n], normal = d0 * p[n] + d1 * q[n] + d2 * r[n];
        double f = (back.volume + back.moment * t / 2) * t,
               g = (back.volume + back.moment * t) * normal * dA[n];
        gA[n] += f * normal;
        gx[n] += g * d0, gy[n] += g * d1, gz[n] += g * d2;
        gp[n] += f * dA[n] * d0, gq[n] += f * dA[n] * d1, gr[n] += f * dA[n] * d2;
    }
}

static void cap_gradient(const ves_samples *s, const double d[3], ves_flux back, const ves_adjoint *adjoint,
                         double d_back[3])
{
    ves_cap cap = ves_cap_init(s), cap_back = {{0}, {0}};
    for (int n = 0; n < s->count; n++) {
        spoke k = spoke_init(s, n, cap.mean, d);
        double half = s->side / 2 * s->weight[n];
        double g = (back.volume * k.mean + back.moment * k.half_square) * half;
        double g0 = k.area * (back.volume / 3 + back.moment * (k.t0 + k.t1) / 6);
        double g1 = k.area * (back.volume * 2 / 3 + back.moment * (k.t0 + 3 * k.t1) / 6);
        for (int i = 0; i < 3; i++) {
            int a = (i + 1) % 3, b = (i + 2) % 3;
            double tangent[3] = {s->Xv[0][n], s->Xv[1][n], s->Xv[2][n]};
            double arm_back = g * (tangent[a] * d[b] - tangent[b] * d[a]); /* Xv x d */
            d_back[i] +=
                g * (k.arm[a] * tangent[b] - k.arm[b] * tangent[a]) + g0 * cap.mean[i] + g1 * s->X[i][n];
            cap_back.mean[i] += g0 * d[i] - arm_back;
            if (!adjoint->X[0]) continue;
            adjoint->X[i][n] += g1 * d[i] + arm_back;
            adjoint->Xv[i][n] += g * (d[a] * k.arm[b] - d[b] * k.arm[a]); /* d x arm */
        }
    }
    if (adjoint->X[0]) ves_cap_gradient(s, &cap_back, adjoint);
}

void ves_flux_gradient(const ves_samples *s, const double d[3], ves_flux back, const ves_adjoint *adjoint,
                       double d_back[3])
{
    if (s->site == VES_SITE_CAP) {
        cap_gradient(s, d, back, adjoint, d_back);
        return;
    }
    by_direction(s, d, back, d_back);
    if (adjoint->X[0]) by_planes(s, d, back, adjoint);
}

double ves_flux_volume(const ves_measure_input *input)
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
    return sum / 3 + caps;
}

void ves_flux_volume_gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint)
{
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

#include "surface/forms.h"

#include <math.h>

#define HOT static inline __attribute__((always_inline))

enum { SECOND = 1u << VES_FIELD_UU | 1u << VES_FIELD_UV | 1u << VES_FIELD_VV };

double ves_forms_eval(const ves_tile *tile, const ves_tile_planes *field, double side, ves_form_planes *form)
{
    const double *restrict xu = field->at[3], *restrict yu = field->at[4], *restrict zu = field->at[5];
    const double *restrict xv = field->at[6], *restrict yv = field->at[7], *restrict zv = field->at[8];
    double *restrict nx = form->at[VES_FORM_NX], *restrict ny = form->at[VES_FORM_NY];
    double *restrict nz = form->at[VES_FORM_NZ], *restrict area = form->at[VES_FORM_J];
    int count = tile->rows * VES_LANES;
    double least = HUGE_VAL, largest = 0;
    if ((tile->fields & SECOND) != SECOND) {
#pragma omp simd reduction(min : least) reduction(max : largest)
        for (int s = 0; s < count; s++) {
            double a = yu[s] * zv[s] - zu[s] * yv[s], b = zu[s] * xv[s] - xu[s] * zv[s];
            double c = xu[s] * yv[s] - yu[s] * xv[s], j2 = a * a + b * b + c * c, j = sqrt(j2), r = side / j;
            double g =
                xu[s] * xu[s] + yu[s] * yu[s] + zu[s] * zu[s] + xv[s] * xv[s] + yv[s] * yv[s] + zv[s] * zv[s];
            nx[s] = r * a, ny[s] = r * b, nz[s] = r * c, area[s] = j;
            least = j2 < least ? j2 : least;
            largest = g > largest ? g : largest;
        }
        return least / (largest * largest);
    }
    const double *restrict xuu = field->at[9], *restrict yuu = field->at[10], *restrict zuu = field->at[11];
    const double *restrict xuv = field->at[12], *restrict yuv = field->at[13], *restrict zuv = field->at[14];
    const double *restrict xvv = field->at[15], *restrict yvv = field->at[16], *restrict zvv = field->at[17];
    double *restrict mean = form->at[VES_FORM_H], *restrict gauss = form->at[VES_FORM_K];
#pragma omp simd reduction(min : least) reduction(max : largest)
    for (int s = 0; s < count; s++) {
        double a = yu[s] * zv[s] - zu[s] * yv[s], b = zu[s] * xv[s] - xu[s] * zv[s];
        double c = xu[s] * yv[s] - yu[s] * xv[s], j2 = a * a + b * b + c * c, j = sqrt(j2), r = 1 / j;
        double e = xu[s] * xu[s] + yu[s] * yu[s] + zu[s] * zu[s],
               g = xv[s] * xv[s] + yv[s] * yv[s] + zv[s] * zv[s];
        double f = xu[s] * xv[s] + yu[s] * yv[s] + zu[s] * zv[s];
        double l = a * xuu[s] + b * yuu[s] + c * zuu[s], m = a * xuv[s] + b * yuv[s] + c * zuv[s];
        double n = a * xvv[s] + b * yvv[s] + c * zvv[s], r2 = r * r, t = side * r;
        nx[s] = t * a, ny[s] = t * b, nz[s] = t * c, area[s] = j;
        mean[s] = -0.5 * (e * n - 2 * f * m + g * l) * r2 * t;
        gauss[s] = (l * n - m * m) * r2 * r2;
        least = j2 < least ? j2 : least;
        largest = e + g > largest ? e + g : largest;
    }
    return least / (largest * largest);
}

/* p = E n.Xvv - 2 F n.Xuv + G n.Xuu and q = n.Xuu n.Xvv - (n.Xuv)^2 carry H and K; everything flows back
 * through n, E, F, G. */
HOT void gradient(const ves_tile *tile, const ves_tile_planes *field, double side, bool second,
                  bool no_normal, const ves_form_planes *form_adjoint, ves_tile_planes *field_adjoint)
{
    const double *restrict f = field->at[0], *restrict g = form_adjoint->at[0];
    double *restrict to = field_adjoint->at[0];
    int count = tile->rows * VES_LANES;
    enum { S = VES_TILE_STRIDE };
#pragma omp simd
    for (int s = 0; s < count; s++) {
        double xu = f[3 * S + s], yu = f[4 * S + s], zu = f[5 * S + s], xv = f[6 * S + s], yv = f[7 * S + s],
               zv = f[8 * S + s];
        double a = yu * zv - zu * yv, b = zu * xv - xu * zv, c = xu * yv - yu * xv;
        double r = 1 / sqrt(a * a + b * b + c * c), r2 = r * r, t = side * r, ga = 0, gb = 0, gc = 0,
               scale = g[VES_FORM_J * S + s] * r;
        if (!no_normal) {
            double nx = g[VES_FORM_NX * S + s], ny = g[VES_FORM_NY * S + s], nz = g[VES_FORM_NZ * S + s];
            ga = t * nx, gb = t * ny, gc = t * nz;
            scale -= t * r2 * (nx * a + ny * b + nz * c); /* -dN/dJ . gN / J */
        }
        double ge = 0, gf = 0, gg = 0;
        if (second) {
            double xuu = f[9 * S + s], yuu = f[10 * S + s], zuu = f[11 * S + s], xuv = f[12 * S + s],
                   yuv = f[13 * S + s];
            double zuv = f[14 * S + s], xvv = f[15 * S + s], yvv = f[16 * S + s], zvv = f[17 * S + s];
            double e = xu * xu + yu * yu + zu * zu, gm1 = xv * xv + yv * yv + zv * zv,
                   fm = xu * xv + yu * yv + zu * zv;
            double l = a * xuu + b * yuu + c * zuu, m = a * xuv + b * yuv + c * zuv,
                   n = a * xvv + b * yvv + c * zvv;
            double gp = -0.5 * t * r2 * g[VES_FORM_H * S + s], gq = r2 * r2 * g[VES_FORM_K * S + s];
            double p = e * n - 2 * fm * m + gm1 * l, q = l * n - m * m;
            double gl = gp * gm1 + gq * n, gm = -2 * (gp * fm + gq * m), gn = gp * e + gq * l;
            scale -= (3 * gp * p + 4 * gq * q) *
                     r2; /* J in the denominators of H and K, over J for dJ = n.dn / J */
            ge = gp * n, gf = -2 * gp * m, gg = gp * l;
            ga += gl * xuu + gm * xuv + gn * xvv;
            gb += gl * yuu + gm * yuv + gn * yvv;
            gc += gl * zuu + gm * zuv + gn * zvv;
            to[9 * S + s] = gl * a, to[10 * S + s] = gl * b, to[11 * S + s] = gl * c;
            to[12 * S + s] = gm * a, to[13 * S + s] = gm * b, to[14 * S + s] = gm * c;
            to[15 * S + s] = gn * a, to[16 * S + s] = gn * b, to[17 * S + s] = gn * c;
        }
        ga += scale * a, gb += scale * b, gc += scale * c;
        to[3 * S + s] = yv * gc - zv * gb + 2 * ge * xu + gf * xv;
        to[4 * S + s] = zv * ga - xv * gc + 2 * ge * yu + gf * yv;
        to[5 * S + s] = xv * gb - yv * ga + 2 * ge * zu + gf * zv;
        to[6 * S + s] = gb * zu - gc * yu + 2 * gg * xv + gf * xu;
        to[7 * S + s] = gc * xu - ga * zu + 2 * gg * yv + gf * yu;
        to[8 * S + s] = ga * yu - gb * xu + 2 * gg * zv + gf * zu;
    }
}

void ves_forms_gradient(const ves_tile *tile, const ves_tile_planes *field, double side, bool no_normal,
                        const ves_form_planes *form_adjoint, ves_tile_planes *field_adjoint)
{
    /* Four kernels from one text: with constant flags each is one loop without branches. */
    bool second = (tile->fields & SECOND) == SECOND;
    if (second && no_normal)
        gradient(tile, field, side, true, true, form_adjoint, field_adjoint);
    else if (second)
        gradient(tile, field, side, true, false, form_adjoint, field_adjoint);
    else if (no_normal)
        gradient(tile, field, side, false, true, form_adjoint, field_adjoint);
    else
        gradient(tile, field, side, false, false, form_adjoint, field_adjoint);
}

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
void ves_forms_gradient(const ves_tile *tile, const ves_tile_planes *field, double side,
                        const ves_form_planes *form_adjoint, ves_tile_planes *field_adjoint)
{
    const double *restrict xu = field->at[3], *restrict yu = field->at[4], *restrict zu = field->at[5];
    const double *restrict xv = field->at[6], *restrict yv = field->at[7], *restrict zv = field->at[8];
    const double *restrict gnx = form_adjoint->at[VES_FORM_NX], *restrict gny = form_adjoint->at[VES_FORM_NY];
    const double *restrict gnz = form_adjoint->at[VES_FORM_NZ], *restrict gja = form_adjoint->at[VES_FORM_J];
    const double *restrict gh = form_adjoint->at[VES_FORM_H], *restrict gk = form_adjoint->at[VES_FORM_K];
    const double *restrict xuu = field->at[9], *restrict yuu = field->at[10], *restrict zuu = field->at[11];
    const double *restrict xuv = field->at[12], *restrict yuv = field->at[13], *restrict zuv = field->at[14];
    const double *restrict xvv = field->at[15], *restrict yvv = field->at[16], *restrict zvv = field->at[17];
    double *restrict axu = field_adjoint->at[3], *restrict ayu = field_adjoint->at[4],
                     *restrict azu = field_adjoint->at[5];
    double *restrict axv = field_adjoint->at[6], *restrict ayv = field_adjoint->at[7],
                     *restrict azv = field_adjoint->at[8];
    double *restrict axuu = field_adjoint->at[9], *restrict ayuu = field_adjoint->at[10],
                     *restrict azuu = field_adjoint->at[11];
    double *restrict axuv = field_adjoint->at[12], *restrict ayuv = field_adjoint->at[13],
                     *restrict azuv = field_adjoint->at[14];
    double *restrict axvv = field_adjoint->at[15], *restrict ayvv = field_adjoint->at[16],
                     *restrict azvv = field_adjoint->at[17];
    int count = tile->rows * VES_LANES;
    bool second = (tile->fields & SECOND) == SECOND;
#pragma omp simd
    for (int s = 0; s < count; s++) {
        double a = yu[s] * zv[s] - zu[s] * yv[s], b = zu[s] * xv[s] - xu[s] * zv[s];
        double c = xu[s] * yv[s] - yu[s] * xv[s], r = 1 / sqrt(a * a + b * b + c * c), r2 = r * r;
        double t = side * r, along = t * r2 * (gnx[s] * a + gny[s] * b + gnz[s] * c); /* -dN/dJ . gN / J */
        double ga = t * gnx[s] + (gja[s] * r - along) * a, gb = t * gny[s] + (gja[s] * r - along) * b;
        double gc = t * gnz[s] + (gja[s] * r - along) * c, ge = 0, gf = 0, gg = 0;
        if (second) {
            double e = xu[s] * xu[s] + yu[s] * yu[s] + zu[s] * zu[s],
                   g = xv[s] * xv[s] + yv[s] * yv[s] + zv[s] * zv[s];
            double f = xu[s] * xv[s] + yu[s] * yv[s] + zu[s] * zv[s];
            double l = a * xuu[s] + b * yuu[s] + c * zuu[s], m = a * xuv[s] + b * yuv[s] + c * zuv[s];
            double n = a * xvv[s] + b * yvv[s] + c * zvv[s];
            double gp = -0.5 * t * r2 * gh[s], gq = r2 * r2 * gk[s], p = e * n - 2 * f * m + g * l,
                   q = l * n - m * m;
            double back = (-3 * gp * p - 4 * gq * q) *
                          r2; /* J in the denominators of H and K, over J for dJ = n.dn / J */
            double gl = gp * g + gq * n, gm = -2 * (gp * f + gq * m), gn = gp * e + gq * l;
            ge = gp * n, gf = -2 * gp * m, gg = gp * l;
            ga += back * a + gl * xuu[s] + gm * xuv[s] + gn * xvv[s];
            gb += back * b + gl * yuu[s] + gm * yuv[s] + gn * yvv[s];
            gc += back * c + gl * zuu[s] + gm * zuv[s] + gn * zvv[s];
            axuu[s] += gl * a, ayuu[s] += gl * b, azuu[s] += gl * c;
            axuv[s] += gm * a, ayuv[s] += gm * b, azuv[s] += gm * c;
            axvv[s] += gn * a, ayvv[s] += gn * b, azvv[s] += gn * c;
        }
        axu[s] += yv[s] * gc - zv[s] * gb + 2 * ge * xu[s] + gf * xv[s];
        ayu[s] += zv[s] * ga - xv[s] * gc + 2 * ge * yu[s] + gf * yv[s];
        azu[s] += xv[s] * gb - yv[s] * ga + 2 * ge * zu[s] + gf * zv[s];
        axv[s] += gb * zu[s] - gc * yu[s] + 2 * gg * xv[s] + gf * xu[s];
        ayv[s] += gc * xu[s] - ga * zu[s] + 2 * gg * yv[s] + gf * yu[s];
        azv[s] += ga * yu[s] - gb * xu[s] + 2 * gg * zv[s] + gf * zu[s];
    }
}

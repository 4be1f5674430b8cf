/* Caps: the flat fan from the mean point of an end curve to the curve. Its integrals are those of the curve.
 */
#ifndef VES_MEASURE_FLUX_H
#define VES_MEASURE_FLUX_H

#include "vesica/measure.h"

typedef struct ves_cap {
    double mean[3];       /* c, the mean of X over v */
    double twice_area[3]; /* integral of X x Xv dv: twice the vector area */
} ves_cap;

ves_cap ves_cap_init(const ves_samples *cap);

/* Adds to the adjoint of X and Xv, given d J / d (each number of ves_cap). */
void ves_cap_gradient(const ves_samples *cap, const ves_cap *back, const ves_adjoint *adjoint);

/* The flux of X / 3 through patches and caps: the volume inside the closed shape. Through some patches of a closed part
 * alone it is the volume of the cones from the origin to them, which depends on where the part stands; through all of
 * one part with its caps it does not. A cubic polynomial in the modes: the trapezoid rule is exact for it once there
 * are more than three times as many nodes as modes. */
double ves_flux_volume(const ves_measure_input *input);
void ves_flux_volume_gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint);

/* For volume centroids. With t = d . X, div(t d) = 1 and div(t^2/2 d) = t: the fluxes of these fields through
 * the closed shape are its volume and its first moment along the unit vector d. */
typedef struct ves_flux {
    double volume, moment;
} ves_flux;

/* Adds the fluxes through one patch, or through one cap. */
void ves_flux_add(const ves_samples *s, const double d[3], ves_flux *flux);

/* Given d J / d (volume, moment): adds to the planes (adjoint's, where it has them) and to d J / d d. */
void ves_flux_gradient(const ves_samples *s, const double d[3], ves_flux back, const ves_adjoint *adjoint,
                       double d_back[3]);

#endif

/* What a container holds below a level: the volume of the closed shape under a plane across an axis.
 *
 * With h the height over the plane, div(h axis) = 1, and h vanishes on the plane itself, so that
 *     V = integral over what lies below of h axis . n dA,
 * over patches and caps, with no lid at the plane. The patches are cut along their rows (measure/cut.h), the spokes
 * of caps in closed form. Derivative: by the level, the area of the level section; the line where the level cuts the
 * wall counts as constant, h being 0 there.
 *
 * The rim is the curve that a key names, else the uppermost cap; its level is that of its lowest point, found along
 * the curve itself, between nodes too (measure/ring.h).
 * test  frustum, ball, leaning tube in closed form; all of it is the volume; order; differences */
#ifndef VES_MEASURE_FILL_H
#define VES_MEASURE_FILL_H

#include "vesica/measure.h"

enum { VES_FILL_SURFACE = VES_X | VES_NORMAL | VES_AREA, VES_FILL_CAP = VES_X | VES_XV };

/* Doubles of room. */
size_t ves_fill_room(const ves_measure_input *input);

/* rim: the key that names it. VES_NO_NUMBER: there is none, neither a key nor a cap. */
ves_status ves_fill_rim(const ves_measure_input *input, int rim, const double axis[3], double *level);
void ves_fill_rim_gradient(const ves_measure_input *input, const double axis[3], double seed,
                           const ves_adjoint *const *adjoint, double axis_back[3]);

ves_status ves_fill_eval(const ves_measure_input *input, const double axis[3], double level, double *value);

/* Returns seed * d volume / d level. */
double ves_fill_gradient(const ves_measure_input *input, const double axis[3], double level, double seed,
                         const ves_adjoint *const *adjoint, double axis_back[3]);

#endif

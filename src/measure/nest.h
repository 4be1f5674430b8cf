/* How far up the axis an identical copy of a container stands in it.
 *
 * The wall is everywhere as thick as the ball of diameter t that runs along the surface S (half of it on either side).
 * The copy comes down along the axis without turning, until the two walls touch: until a point q of the upper surface
 * S + d axis is t away from a point p of the lower one. So the pitch is
 *     d = max over p, q in S of  F = (p - q) . axis + sqrt(t^2 - s^2),   s = |(p - q) across the axis| <= t,
 * which is t / sin(draft) along a straight wall that is long enough; h + t of an upright tube of height h, which does
 * not nest; with an undercut the height at which the walls lock. It is at least t. Ends that lie below the middle of
 * the wall and are capped are closed, their caps walls as well; a cap above is a mouth.
 *
 * Pairs are sought on lines of one v, of all patches together, as polygons through their nodes. From the best of the
 * rows that stand out both points go on over the surfaces, by looks, to where
 *     L = g . (p - q) + t |g|,   g = axis + l,   l across the axis,
 * is largest in p and q and least in l: F is the least of it over l. g is the normal of both walls where they touch.
 * Derivative: dF = g . (dp - dq) + |g| dt (envelope theorem).
 * test  cones long and short, tube, bells on their caps, two cones, a barrel, ridges; differences */
#ifndef VES_MEASURE_NEST_H
#define VES_MEASURE_NEST_H

#include "vesica/measure.h"

enum {
    VES_NEST_SURFACE = VES_X | VES_XU | VES_XV | VES_XUU | VES_XUV | VES_XVV,
    VES_NEST_CAP = VES_X,
    VES_NEST_LOOKS = 2
};

size_t ves_nest_room(const ves_measure_input *input);

/* VES_NO_NUMBER: some node is no number. */
ves_status ves_nest_eval(const ves_measure_input *input, const double axis[3], double thickness,
                         double *pitch);

/* After eval, on the same input. Returns seed * d pitch / d thickness. */
double ves_nest_gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                         double axis_back[3]);

#endif

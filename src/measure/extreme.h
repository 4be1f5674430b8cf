/* The farthest point of the surface along a direction d.
 *
 * In the cell of every node X is its Taylor polynomial of degree 2 about the node: that tells which cells
 * may hold the farthest point, and where, up to third order in the spacing. From there Newton's steps go
 * on, by looks at the surface itself (measure/hill.h), on the ends of patches too. The value is one that
 * was seen, at a look or a node, and no node lies beyond it; where the grid resolves the surface it is the
 * largest, to rounding. (Without looks it is what the polynomial promises.) Caps need no look: they lie
 * within the hull of their curves. Derivative: the maximiser is stationary, or held by an end of the
 * patch, so its u and v count as constants (envelope theorem).
 * test  closed forms; what no grid resolves; differences */
#ifndef VES_MEASURE_EXTREME_H
#define VES_MEASURE_EXTREME_H

#include "vesica/measure.h"

enum {
    VES_EXTREME_SURFACE = VES_X | VES_XU | VES_XV | VES_XUU | VES_XUV | VES_XVV,
    VES_EXTREME_ROOM = 4, /* doubles that hold one */
    VES_EXTREME_LOOKS = 2 /* of an extent */
};

typedef struct ves_extreme {
    int surface;      /* sample of its surface */
    double at[2];     /* u, v of the node */
    int sample, node; /* of the surface or of a look */
    double du, dv;    /* from the node; with looks 0 */
    double value;     /* d . X */
} ves_extreme;

/* number: of the look that it may use. room: a double for each node. VES_NO_NUMBER: d . X is nowhere a
 * number.
 */
ves_status ves_extreme_find(const ves_measure_input *input, int number, const double d[3], double *room,
                            ves_extreme *extreme);

void ves_extreme_point(const ves_measure_input *input, const ves_extreme *extreme, double point[3]);

/* Adds to the planes, given d J / d point. */
void ves_extreme_gradient(const ves_extreme *extreme, const double back[3],
                          const ves_adjoint *const *adjoint);

/* --- what extent, width, height and depth share --- */

size_t ves_extent_room(const ves_measure_input *input);
ves_status ves_extent_eval(const ves_measure_input *input, const double unit[3], double *value);
/* unit_back: adds d J / d unit; or NULL. */
void ves_extent_gradient(const ves_measure_input *input, const double unit[3], double seed,
                         const ves_adjoint *const *adjoint, double *unit_back);

#endif

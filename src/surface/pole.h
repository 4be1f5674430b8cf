/* Poles: an end of a patch that is one point P. There Xv vanishes and X(u, v) has no tangent plane, while the
 * surface mostly has. With t the distance in u from the end, s = +1 at u = 0 and -1 at u = 1, and
 *     X = P + s t A(v) + t^2 / 2 B(v) + ...,   A = Xu, B = Xuu at the end,   A'' = p A + q A'
 * normal, H and K tend, along v, to those that the forms make of
 *     Xu = A,  Xv = s A',  Xuu = B,  Xuv = s B' / 2,  Xvv = B'' / 2 - p B - q B' / 2
 * (expand n = Xu x Xv and n.Xuu, n.Xuv, n.Xvv by powers of t, and divide n by t, the others by t, t^2, t^3).
 * So a tile that holds a pole is unfolded: these fields take the place of its own, and the forms and their
 * gradient are those of any other node. A limit that depends on v is one of each line towards the pole.
 * Where A, A', A'' do not lie in one plane the surface is pointed: n.Xvv is of order t^2, curvature grows
 * like 1 / t, and there is no limit. Where A x A' = 0 the line has no direction, and nothing is known.
 * test  ellipsoids, paraboloids and a biharmonic dome in closed form; against nodes nearby; differences */
#ifndef VES_SURFACE_POLE_H
#define VES_SURFACE_POLE_H

#include "surface/tile.h"

/* s of each lane of a tile: +1, -1, or 0: it is not at an end that is a pole. False: none is. */
bool ves_pole_lanes(const ves_grid *grid, const ves_tile *tile, const bool pole[2], int s[VES_LANES]);

/* Unfolds these lanes; the tile has all fields. Xv = 0, which has no forms (VES_DEGENERATE): no limit. */
void ves_pole_unfold(const ves_tile *tile, const int s[VES_LANES], ves_tile_planes *field);

/* The transpose. field: as sampled. adjoint: on entry d J / d the unfolded fields, those beyond VES_FIELDS of
 * any value; then d J / d all fields as sampled, in all lanes. */
void ves_pole_gradient(const ves_tile *tile, const int s[VES_LANES], const ves_tile_planes *field,
                       ves_tile_planes *adjoint);

#endif

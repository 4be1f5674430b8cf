/* Grids: where a patch is sampled. Nodes run u-fastest, s = j * nu + i. */
#ifndef VES_SURFACE_GRID_H
#define VES_SURFACE_GRID_H

#include <stdbool.h>

#include "base/arena.h"
#include "vesica/status.h"

enum {
    VES_LANES = 8
}; /* doubles in the widest register; grids with nu a multiple of it take the fast kernels */

typedef struct ves_grid {
    int nu, nv, count;
    bool periodic;  /* in v */
    bool symmetric; /* v nodes come in fours (v, pi - v, pi + v, 2 pi - v): v_j = 2 pi (j + 1/2) / nv, nv a
                       multiple of 4 */
    double *u, *v;  /* [nu], [nv] */
    double *weight; /* [count] in du dv; zero when the grid is no quadrature */
} ves_grid;

/* Gauss-Legendre nodes and weights on [0, 1]. Newton on the Legendre recurrence.
 * test  exact for polynomials of degree 2 n - 1 */
void ves_gauss_nodes(int n, double *node, double *weight);

/* Gauss in u times, in v, the trapezoid rule with half-step offset (periodic) or Gauss on [0, 2 pi]. */
ves_status ves_grid_quadrature(int nu, int nv, bool periodic, ves_arena *arena, ves_grid *grid);

/* nv nodes around one u; weights are those of dv. */
ves_status ves_grid_ring(double u, int nv, bool periodic, ves_arena *arena, ves_grid *grid);

/* Given nodes, no weights. */
ves_status ves_grid_given(int nu, const double *u, int nv, const double *v, bool periodic, ves_arena *arena,
                          ves_grid *grid);

#endif

/* The cell of a node: what is nearer to it than to its neighbours, and inside the patch. Seen from the node,
 * u from lo[0] to hi[0], v from lo[1] to hi[1]. The cells of all nodes cover the patch from edge to edge, so
 * an extreme over the patch is the most extreme of the extremes over its cells. */
#ifndef VES_MEASURE_CELL_H
#define VES_MEASURE_CELL_H

#include "vesica/measure.h"

#include "base/vector.h"

typedef struct ves_cell {
    double lo[2], hi[2];
} ves_cell;

static inline void ves_cell_u(const ves_samples *s, int i, double *lo, double *hi)
{
    *lo = i > 0 ? (s->u[i - 1] - s->u[i]) / 2 : 0 - s->u[i];
    *hi = i + 1 < s->nu ? (s->u[i + 1] - s->u[i]) / 2 : 1 - s->u[i];
}

static inline void ves_cell_v(const ves_samples *s, int j, double *lo, double *hi)
{
    int last = s->nv - 1;
    if (j > 0)
        *lo = (s->v[j - 1] - s->v[j]) / 2;
    else
        *lo = s->periodic ? (s->v[last] - VES_TWO_PI - s->v[0]) / 2 : 0 - s->v[0];
    if (j < last)
        *hi = (s->v[j + 1] - s->v[j]) / 2;
    else
        *hi = s->periodic ? (s->v[0] + VES_TWO_PI - s->v[last]) / 2 : VES_TWO_PI - s->v[last];
}

static inline ves_cell ves_cell_init(const ves_samples *s, int node)
{
    ves_cell cell;
    ves_cell_u(s, node % s->nu, &cell.lo[0], &cell.hi[0]);
    ves_cell_v(s, node / s->nu, &cell.lo[1], &cell.hi[1]);
    return cell;
}

/* The longer half of the span lo .. hi. */
static inline double ves_cell_reach(double lo, double hi)
{
    return -lo > hi ? -lo : hi;
}

#endif

/* A closed curve between its nodes. Evenly spread nodes, more than two for each Fourier mode, say all of a
 * curve: at any v it is a sum of weights times its nodes. (Trigonometric interpolation: of an even number
 * n weight j is sin(n x / 2) / (n tan(x / 2)), x = v - v_j, of an odd one with sin for tan.) A place is a
 * curve of one node.
 * test  waves of every mode that fits, anywhere */
#ifndef VES_MEASURE_RING_H
#define VES_MEASURE_RING_H

#include "vesica/measure.h"

/* A point of the curve: v[node] + t. */
typedef struct ves_ring_point {
    int node;
    double t;
} ves_ring_point;

/* The same point seen from the node next to it. */
ves_ring_point ves_ring_near(const ves_samples *s, ves_ring_point p);

/* weight: [3][s->count], those of X and of its first two derivatives, these good enough to find an extreme by
 * (1e-6). p: as ves_ring_near gives it. */
void ves_ring_weights(const ves_samples *s, ves_ring_point p, double *weight);

#endif

/* Hills: where an extreme over the surface may lie, and what all climbs up to it share.
 *
 * A hill is a node that its neighbours do not exceed. Of several hills of almost one height all are climbed,
 * so that a result changes without a jump when one overtakes another; of more than VES_HILLS the lowest are
 * left out. What lies between nodes without a trace in them is not found: it takes a grid that resolves the
 * surface. */
#ifndef VES_MEASURE_HILL_H
#define VES_MEASURE_HILL_H

#include "measure/cell.h"

enum { VES_HILLS = 8 };

/* Of sums of a hundred terms, relative to the largest: heights that differ by less are level. */
#define VES_HILL_ROUNDING 1e-13

/* value + p x + q y + (a x^2 + 2 b x y + c y^2) / 2 */
typedef struct ves_quadric {
    double value, p, q, a, b, c;
} ves_quadric;

double ves_quadric_at(const ves_quadric *f, double x, double y);

/* Its largest value over a box about the origin, and where that is. */
double ves_quadric_top(const ves_quadric *f, const ves_cell *box, double top[2]);

/* Where slope * t + bend * t^2 / 2 is largest on [lo, hi]. */
double ves_crest(double slope, double bend, double lo, double hi);

typedef struct ves_hill {
    int sample, node;
    int end; /* 0: at the node; -1, 1: beside it, at u = 0, u = 1 */
    double height;
} ves_hill;

/* height: of all nodes of all surfaces, one surface after the other; -inf: of no interest. Finds the hills,
 * highest first, and returns how many. rounding: see above; of level nodes the first one is the hill. */
int ves_hills_find(const ves_measure_input *input, const double *height, double rounding,
                   ves_hill hill[VES_HILLS]);

/* Into a list of `count`, highest first; the lowest makes room. */
void ves_hill_insert(ves_hill hill[VES_HILLS], int *count, ves_hill made);

/* The parabola through the three nodes of a row next to an end (-1: u = 0, 1: u = 1) is there the sum of
 * share[k] times node first + k; returns first. Needs nu > 2. */
int ves_hill_end(const ves_samples *s, int end, double share[3]);

/* Where a climb may go, seen from (u, v): not beyond the patch, nor farther than `reach`. */
ves_cell ves_hill_box(const ves_samples *s, const double at[2], const double reach[2]);

/* v of a periodic surface back into 0 .. 2 pi. */
double ves_hill_wrap(const ves_samples *s, double v);

#endif

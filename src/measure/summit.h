/* The highest point over the surface of a function that is known by its values alone: not of its nodes,
 * but found by looks, which are exact, between them and on the ends u = 0 and u = 1. The value is one that
 * the surface has; at a pole a limit of it. Where there is none (the tip of a cone, a formula without a slope
 * at its end), what needs a tangent plane is looked at beside the end.
 * Derivative: the summit is stationary, or held by an end, so its u and v count as constants (envelope
 * theorem).
 * test  cones, catenoids, ellipsoids, domes in closed form; hills that overtake each other; differences */
#ifndef VES_MEASURE_SUMMIT_H
#define VES_MEASURE_SUMMIT_H

#include "vesica/measure.h"

/* The function at one node of a surface or a look. */
typedef double ves_height(const void *of, const ves_samples *s, int node);

/* Doubles of room for ves_summit_find. */
size_t ves_summit_room(const ves_measure_input *input);

/* The highest value. room[0] and room[1] then hold the sample and the node that have it: those of a look or,
 * where no look can be had, of a surface. VES_NO_NUMBER: the function is no number at some node. */
ves_status ves_summit_find(const ves_measure_input *input, ves_height *height, const void *of, double *room,
                           double *value);

#endif

/* Arguments as measures read them. `key` counts the keys of the measure's table. */
#ifndef VES_MEASURE_ARGUMENT_H
#define VES_MEASURE_ARGUMENT_H

#include "vesica/measure.h"

#include "base/vector.h"

/* The value of a number key, or its fallback. */
double ves_argument_number(const ves_measure_input *input, int key);

/* Adds to the adjoint of number `i` of a key; nothing where the fallback stands. */
void ves_argument_scatter(const ves_measure_input *input, int key, int i, double value,
                          double *number_adjoint);

/* A vector key made a unit vector. */
typedef struct ves_direction {
    double unit[3], length; /* of what was written */
} ves_direction;

/* [0, 1, 0] where the key was not given. VES_NO_NUMBER: the vector has no direction. */
ves_status ves_direction_init(const ves_measure_input *input, int key, ves_direction *direction);

/* Adds d J / d vector, given d J / d unit: the part across it, over its length. */
void ves_direction_gradient(const ves_measure_input *input, int key, const ves_direction *direction,
                            const double back[3], double *number_adjoint);

#endif

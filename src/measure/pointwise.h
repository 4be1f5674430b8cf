/* Formulas of x, y, z, H, K, k1, k2, u, v at the nodes of the surface, for the measures whose first key is
 * the POINTWISE `of`. The first doubles of their room are the formula's scratch. */
#ifndef VES_MEASURE_POINTWISE_H
#define VES_MEASURE_POINTWISE_H

#include "vesica/measure.h"

enum { VES_POINTWISE_SURFACE = VES_X | VES_AREA | VES_CURVATURE };

/* Which of X and CURVATURE the formula reads; X when it reads neither, since something must be sampled. */
unsigned ves_pointwise_needs(const ves_args *args);

/* Doubles of scratch of the formula, and nodes of all surfaces. */
size_t ves_pointwise_scratch(const ves_measure_input *input);
size_t ves_pointwise_nodes(const ves_measure_input *input);

/* The formula of one instance; made anew for each evaluation. */
typedef struct ves_pointwise {
    const ves_measure_input *input;
    unsigned needs;
} ves_pointwise;

ves_pointwise ves_pointwise_init(const ves_measure_input *input);
double ves_pointwise_eval(const ves_pointwise *pointwise, const ves_samples *s, int node);

/* Adds weight * df / d (X, H, K at the node) to the planes, where the adjoint has them, and weight * df / d
 * slot. Returns the value of the formula. */
double ves_pointwise_gradient(const ves_pointwise *pointwise, const ves_samples *s, int node, double weight,
                              const ves_adjoint *adjoint, double *number_adjoint);

/* The largest value of sign * formula over the surface (measure/summit.h); room as ves_summit_find has it.
 * VES_NO_NUMBER: at some node it is no number. */
ves_status ves_pointwise_largest(const ves_measure_input *input, double sign, double *room, double *value);

#endif

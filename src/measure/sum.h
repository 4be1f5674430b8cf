/* What most measures are: the integral over the surface of a function of H and K, sum of f(H, K) dA. Caps are not part
 * of it. */
#ifndef VES_MEASURE_SUM_H
#define VES_MEASURE_SUM_H

#include "vesica/measure.h"

/* integral of (h * H^2 + k * K + m * H + a) dA */
typedef struct ves_quadratic {
    double h, k, m, a;
} ves_quadratic;

ves_status ves_sum_eval(const ves_measure_input *input, ves_quadratic f, double *value);
void ves_sum_gradient(const ves_measure_input *input, ves_quadratic f, double seed,
                      const ves_adjoint *const *adjoint);

/* The area alone, which needs no curvature. */
double ves_sum_area(const ves_measure_input *input);
void ves_sum_area_gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint);

#endif

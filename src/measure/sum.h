/* What most measures are: the integral over the surface of a function of H and K, sum of f(H, K) dA. */
#ifndef VES_MEASURE_SUM_H
#define VES_MEASURE_SUM_H

#include "vesica/measure.h"

/* integral of (h * H^2 + k * K + m * H) dA */
typedef struct ves_quadratic {
    double h, k, m;
} ves_quadratic;

ves_status ves_sum_eval(const ves_measure_input *input, ves_quadratic f, double *value);
void ves_sum_gradient(const ves_measure_input *input, ves_quadratic f, double seed,
                      const ves_adjoint *const *adjoint);

#endif

/* Extremes of stresses over a shell: what max_shear and von_mises share. */
#ifndef VES_MEASURE_STRESS_H
#define VES_MEASURE_STRESS_H

#include "shell/view.h"
#include "vesica/measure.h"

enum { VES_STRESS_CASE, VES_STRESS_WHERE, VES_STRESS_THROUGH, VES_STRESS_SMOOTH, VES_STRESS_KEYS };
extern const ves_key ves_stress_keys[VES_STRESS_KEYS + 1];

/* The largest value of `of` at the points that are reported (shell/shell.h: 2 p + 1 along each side of an element of order
 * p, edges included) where `where` holds, and where it ends between two of them, over both surfaces, the mid-surface or all three; smooth p > 0: the power mean
 * over the area of the largest of the three at each point. VES_NO_NUMBER: no point is there. */
ves_status ves_stress_largest(const ves_measure_input *input, double (*of)(const double *stress),
                              double *value);
size_t ves_stress_room(const ves_measure_input *input);

#endif

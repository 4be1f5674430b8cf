/* Extremes of stresses over a shell: what max_shear and von_mises share. */
#ifndef VES_MEASURE_STRESS_H
#define VES_MEASURE_STRESS_H

#include "shell/view.h"
#include "vesica/measure.h"

enum { VES_STRESS_CASE, VES_STRESS_WHERE, VES_STRESS_THROUGH, VES_STRESS_SMOOTH, VES_STRESS_KEYS };
extern const ves_key ves_stress_keys[VES_STRESS_KEYS + 1];

typedef double ves_stress_of(const double *stress);
typedef struct ves_stress_kind {
    ves_stress_of *of;
    void (*slope)(const double *stress, double *slope);
} ves_stress_kind;

/* The largest value of `of` at the points that are reported (shell/shell.h: 2 p + 1 along each side of an element of order
 * p, edges included) where `where` holds, and where it ends between two of them, over both surfaces, the mid-surface or
 * all three; smooth p > 0: the power mean over the area of the largest of the three at each point. VES_NO_NUMBER: no
 * point is there.
 *
 * The gradient of the largest is that of the place where eval found it, which moves with the border of `where` if it is
 * there. Of a mean it is exact while no point begins or ceases to count: the mean jumps when one does. */
ves_status ves_stress_largest(const ves_measure_input *input, ves_stress_of *of, double *value);
void ves_stress_gradient(const ves_measure_input *input, const ves_stress_kind *kind, double seed,
                         double *number_adjoint);
size_t ves_stress_room(const ves_measure_input *input);
ves_status ves_stress_prepare(const ves_measure_input *input, void **state);
void ves_stress_release(void *state);

#endif

/* Weights in double-double. Textbook bases lose every digit from order 14 on; the condition numbers of these
 * (basis.h) stay below 1e20, and 32 digits are there for that: 1e-14 of each cardinal function at every order to
 * 40, as far as the conditions themselves allow. General operators keep the bars while n |r| is at most 80 for
 * the quickest root, or the slowest is not small; beyond, or with curves inside at order 12 and roots from 1 to
 * 20, less than 12 digits may be left, and such modes are refused (tests/weights_general.c). Called by
 * weights.c. */
#ifndef VES_SURFACE_EXACT_H
#define VES_SURFACE_EXACT_H

#include <stddef.h>

#include "surface/factor.h"
#include "surface/weights.h"

/* What is wanted: of the cardinal functions first .. first + count - 1 the derivatives 0 .. orders - 1, at
 * weight[(d * columns + j) * nu + i]; slope (or NULL): the same for each parameter, `stride` doubles apart. */
typedef struct ves_exact_out {
    int first, count, columns, orders;
    double *weight, *slope;
    size_t stride;
} ves_exact_out;

long ves_exact_room(const ves_layout *layout, int orders); /* doubles */
/* factor: of the operator, with slopes where those are wanted; it serves all modes. layout->lower is not looked
 * at. VES_UNDETERMINED: what is wanted is 0 then. */
ves_status ves_exact_mode(const ves_layout *layout, const ves_factor *factor, double n, int nu,
                          const double *u, const ves_exact_out *out, double *room);

/* The condition number of the condition matrix in the best scaling of its rows and columns [Bauer 1963]. */
ves_status ves_exact_condition(const ves_layout *layout, const ves_factor *factor, double n,
                               double *condition, double *room);

#endif

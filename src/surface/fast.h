/* Weights in double precision: what the annealer pays for each new a. Power operators of order 2, 4, 6 and
 * 8 with half of the conditions at each end and derivatives up to the second (order 8: third); see weights.h for the
 * shapes. Errors seen, in the scale of tests/weights_oracle.c: 2e-15 (orders 2, 4), 6e-15 (6), 5e-14 (8). */
#ifndef VES_SURFACE_FAST_H
#define VES_SURFACE_FAST_H

#include "surface/weights.h"

bool ves_fast_fits(const ves_layout *layout, const ves_operator *op);
long ves_fast_room(int nu);
ves_status ves_fast_bind(const ves_layout *layout, double a, int modes, int nu, const double *u,
                         const ves_table *table);
ves_status ves_fast_mode(const ves_layout *layout, double lam, int nu, const double *u, double *weight,
                         double *weight_lam, double *room);

#endif

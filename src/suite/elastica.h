/* A closed plane curve of few Fourier amplitudes and what a ring that bends feels: one problem in three
 * formulations, which differ in how much of its two equations is eliminated (landscape/elastica*.c).
 *
 *     x = sum a_k cos kt, y = sum b_k sin kt, k = 1 ... 4; p = a_1 ... a_4, b_1 ... b_4
 *
 * Of given length 2 pi and area 0.7 pi the one with the least integral of curvature squared is asked. */
#ifndef VES_SUITE_ELASTICA_H
#define VES_SUITE_ELASTICA_H

#include <stdbool.h>

enum { VES_ELASTICA = 8, VES_ELASTICA_HALF = VES_ELASTICA / 2 };

extern const double ves_elastica_bounds[VES_ELASTICA][2];
extern const double ves_elastica_place[VES_ELASTICA]; /* the best, of length 2 pi */
extern const double ves_elastica_least;               /* its integral of curvature squared */
extern const double ves_elastica_reduced;             /* 4 pi area / length^2 */

/* The optimum of a landscape in all these amplitudes. */
double ves_elastica_optimum(int n, double *x);

/* Trapezoidal sums over equal steps of t. */
typedef struct ves_elastica {
    bool resolved; /* it turns by no more than 0.5 between two nodes: else the bending is no integral */
    double bending, length, area;
    double bending_slope[VES_ELASTICA], length_slope[VES_ELASTICA], area_slope[VES_ELASTICA];
} ves_elastica;

/* False when the curve stands still somewhere. slopes false: those hold nothing. */
bool ves_elastica_measure(const double *p, bool slopes, ves_elastica *out);

/* 4 pi area / length^2, and bending * length/(2 pi): what a change of size leaves alone. slope [8] or
 * NULL. */
double ves_elastica_shape(const ves_elastica *e, double *slope);
double ves_elastica_energy(const ves_elastica *e, double *slope);

#endif

/* Integrals over the part of a surface where a function is negative: of min(f, 0) g along a row of Gauss nodes in u.
 *
 * min(f, 0) has a kink where f = 0, which a rule on the nodes sees to second order in their spacing. But the nodes
 * say f and g along the whole row, as the polynomials through them: their zeros cut the row, and each piece is
 * integrated by as many Gauss points as make it exact for the polynomials. So the error falls geometrically with the
 * nodes, as that of any integral, while f crosses zero along u; where it touches zero along v, a row enters or leaves
 * as a power 3/2 and the trapezoid rule over the rows is of order 5/2; where f is constant along u (a level line that
 * is a row), of order 2. Derivative: min(f, 0) vanishes at the cuts, so that they count as constants.
 * test  polynomials; the part of a ball under a plane; observed orders; differences */
#ifndef VES_MEASURE_CUT_H
#define VES_MEASURE_CUT_H

#include "vesica/measure.h"

/* One row, j, of a surface: f and g at its nodes. */
typedef struct ves_cut_row {
    const ves_samples *s;
    int j;
    const double *f, *g;
    double *room; /* ves_cut_room(nu) doubles */
} ves_cut_row;

size_t ves_cut_room(int nu);

/* The weight in dv of row j. */
double ves_cut_weight(const ves_samples *s, int j);

/* Integral of min(f, 0) g du. NAN: f is somewhere no number. */
double ves_cut_eval(const ves_cut_row *row);

/* Adds seed * d integral / d f and, unless it is NULL, d g to planes of nu nodes. */
void ves_cut_gradient(const ves_cut_row *row, double seed, double *f_back, double *g_back);

#endif

/* The least distance between two pieces of curves: X + X' t + X'' t^2 / 2 for lo <= t <= hi, about one
 * node of each. A place is a piece with lo = hi = 0. Projected Newton steps, shortened until the distance
 * does not grow; about three of them.
 * test  parallel, skew and crossing lines; a parabola's point of closest approach */
#ifndef VES_MEASURE_APPROACH_H
#define VES_MEASURE_APPROACH_H

typedef struct ves_piece {
    double X[3], Xv[3], Xvv[3];
    double lo, hi;
} ves_piece;

/* Returns the distance, and where it is: t[0] on a, t[1] on b. */
double ves_approach_solve(const ves_piece *a, const ves_piece *b, double t[2]);

/* From a to b at t. */
void ves_approach_vector(const ves_piece *a, const ves_piece *b, const double t[2], double vector[3]);

#endif

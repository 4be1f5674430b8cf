/* A point of the search: where, and what it is worth there. Searches work in the unit box u; callers see x. */
#ifndef VES_SEARCH_POINT_H
#define VES_SEARCH_POINT_H

#include <stdbool.h>

#include "base/arena.h"
#include "vesica/search.h"

typedef struct ves_point {
    ves_verdict verdict; /* constraint is the point's own; gradient and jacobian are NULL */
    double *u;           /* [n] in the unit box */
    double *x;           /* [n] the same in the caller's units */
    bool proved;
} ves_point;

/* False when out of memory. The new point is a failed one: worse than any other. */
bool ves_point_create(ves_arena *arena, int n, int m, ves_point *point);
void ves_point_fail(ves_point *point); /* makes it one again */
void ves_point_copy(ves_point *to, const ves_point *from, int n, int m);

/* One coordinate from the unit box to the caller's units, never outside the bounds. */
double ves_point_scale(const ves_search_problem *problem, int i, double u);
void ves_point_place(const ves_search_problem *problem, const double *u, double *x);

/* Folds a step that leaves [0, 1] back at the walls. Symmetric: u -> v is as likely as v -> u. */
double ves_point_reflect(double u);

#endif

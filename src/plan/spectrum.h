/* The symmetric eigenproblem H c = value M c, on the space where all rows vanish: row c = 0.
 * test  two by two by hand; a sphere's second variation */
#ifndef VES_PLAN_SPECTRUM_H
#define VES_PLAN_SPECTRUM_H

#include "base/arena.h"
#include "vesica/status.h"

typedef struct plan_spectrum {
    int n, rows;    /* most of both */
    int kept;       /* rows that are independent of those before: unit[kept] */
    int count;      /* eigenvalues: n - kept */
    double *root;   /* [n][n], lower: M = root root' */
    double *form;   /* [n][n], root^-1 H root^-T */
    double *unit;   /* [rows][n] orthonormal: what root^-1 row span */
    double *part;   /* [rows][rows] row i = sum of part[i][j] unit[j] */
    int *from;      /* [rows] which row unit[j] came from */
    double *value;  /* [n] ascending */
    double *vector; /* [n][n] a row each, unit, = root' c */
    double *work;   /* [3 n n] */
} plan_spectrum;

ves_status ves_spectrum_create(int n, int rows, ves_arena *arena, plan_spectrum *s);

/* First the metric: M [n][n] (its lower triangle) and row [rows][...], rows `stride` apart. VES_NO_NUMBER: M is not
 * positive. Then the values of H, of which half the sum with its transpose is taken. */
ves_status ves_spectrum_metric(plan_spectrum *s, int n, int stride, const double *M, int rows,
                               const double *row);
void ves_spectrum_find(plan_spectrum *s, int stride, const double *H);

/* root^-1 x and root^-T y, in place. */
void ves_spectrum_whiten(const plan_spectrum *s, double *x);
void ves_spectrum_colour(const plan_spectrum *s, double *y);

#endif

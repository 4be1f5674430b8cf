/* The largest eigenvalue of K^-1 B, K symmetric and positive, B symmetric: Lanczos's method in the inner product of K,
 * every vector made orthogonal to all before. ARPACK would do, but keeps its state in SAVE variables
 * and so serves one thread of a process. */
#ifndef VES_SHELL_LANCZOS_H
#define VES_SHELL_LANCZOS_H

#include "base/arena.h"
#include "vesica/status.h"

enum { VES_LANCZOS_STEPS = 160 };

typedef struct ves_lanczos {
    double *basis, *image; /* [STEPS + 1][n] v, K v */
    double *small;         /* eigenproblems of the tridiagonal matrix */
} ves_lanczos;
ves_status ves_lanczos_make(size_t n, ves_arena *arena, ves_lanczos *work);

typedef struct ves_lanczos_pencil {
    int n;
    double close; /* relative, of a residual: no eigenvalue is further away; a lone one errs by its square */
    void *of;
    ves_status (*apply)(void *of, const double *v, double *Bv);
    ves_status (*solve)(void *of, const double *r, double *w); /* w = K^-1 r */
} ves_lanczos_pencil;

typedef struct ves_lanczos_found {
    double value; /* 0: none is above 1e-3 of the largest magnitude */
    int solves;
} ves_lanczos_found;

/* vector [n]: of norm 1 in K. VES_NO_CONVERGENCE: not in so many steps. The start is always the same. */
ves_status ves_lanczos_largest(const ves_lanczos_pencil *pencil, const ves_lanczos *work,
                               ves_lanczos_found *found, double *vector);

#endif

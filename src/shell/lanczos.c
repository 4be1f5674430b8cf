#include "shell/lanczos.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include <cblas.h>

#include "base/eigen.h"
#include "base/random.h"

enum { STEPS = VES_LANCZOS_STEPS };

/* Of the largest magnitude: less is no eigenvalue that counts. K^-1 B has eigenvalues close to 0, those of modes that are
 * stiff, so where none is positive the largest of the tridiagonal matrix comes up to 0 from below. */
static const double NONE = 1e-3;

ves_status ves_lanczos_make(size_t n, ves_arena *arena, ves_lanczos *work)
{
    work->basis = ves_arena_doubles(arena, (STEPS + 1) * n);
    work->image = ves_arena_doubles(arena, (STEPS + 1) * n);
    work->small = ves_arena_doubles(arena, (size_t)(2 * STEPS * STEPS + 5 * STEPS));
    return work->basis && work->image && work->small ? VES_OK : VES_MEMORY;
}

typedef struct tridiagonal {
    double *diagonal, *beside; /* [STEPS]; beside[k]: between k and k + 1 */
    double *along;             /* [STEPS] scratch */
    double *a, *vector, *value;
} tridiagonal;

/* Takes from w and its image r what lies along the first `count` vectors of the basis; twice is enough.
 * Returns how much of it was along the last. */
static double strip(int n, int count, const ves_lanczos *work, double *along, double *w, double *r)
{
    double last = 0;
    for (int pass = 0; pass < 2; pass++) {
        cblas_dgemv(CblasRowMajor, CblasNoTrans, count, n, 1, work->basis, n, r, 1, 0, along, 1);
        cblas_dgemv(CblasRowMajor, CblasTrans, count, n, -1, work->basis, n, along, 1, 1, w, 1);
        cblas_dgemv(CblasRowMajor, CblasTrans, count, n, -1, work->image, n, along, 1, 1, r, 1);
        last += along[count - 1];
    }
    return last;
}

/* w and its image r become of norm 1; returns the norm that they had. */
static double scale(int n, double *w, double *r)
{
    double square = cblas_ddot(n, w, 1, r, 1), norm = square > 0 ? sqrt(square) : 0;
    if (norm > 0) cblas_dscal(n, 1 / norm, w, 1), cblas_dscal(n, 1 / norm, r, 1);
    return norm;
}

/* The first vector: one step from random forces, so that it is smooth. */
static ves_status begin(const ves_lanczos_pencil *of, double *w, double *r)
{
    ves_random random = {.seed = 1};
    ves_random_normals(&random, of->n, r);
    VES_TRY(of->solve(of->of, r, w));
    VES_TRY(of->apply(of->of, w, r));
    VES_TRY(of->solve(of->of, r, w));
    return VES_OK;
}

/* The largest eigenvalue of the tridiagonal matrix of so many rows; its vector is t->along on return. */
static double ritz(const tridiagonal *t, int count, double *magnitude)
{
    int best = 0;
    memset(t->a, 0, sizeof(double) * (size_t)(count * count));
    for (int k = 0; k < count; k++) {
        t->a[k * count + k] = t->diagonal[k];
        if (k + 1 < count) t->a[k * count + k + 1] = t->a[(k + 1) * count + k] = t->beside[k];
    }
    ves_eigen_symmetric(count, t->a, t->value, t->vector);
    *magnitude = 0;
    for (int k = 0; k < count; k++) {
        if (t->value[k] > t->value[best]) best = k;
        *magnitude = fmax(*magnitude, fabs(t->value[k]));
    }
    for (int k = 0; k < count; k++) t->along[k] = t->vector[k * count + best];
    return t->value[best];
}

ves_status ves_lanczos_largest(const ves_lanczos_pencil *of, const ves_lanczos *work,
                               ves_lanczos_found *found, double *vector)
{
    const size_t n = (size_t)of->n;
    double *s = work->small;
    const tridiagonal t = {.diagonal = s,
                           .beside = s + STEPS,
                           .along = s + 2 * STEPS,
                           .value = s + 3 * STEPS,
                           .a = s + 5 * STEPS,
                           .vector = s + 5 * STEPS + STEPS * STEPS};
    *found = (ves_lanczos_found){.solves = 2};
    if (of->n == 0) return VES_OK;
    VES_TRY(begin(of, work->basis, work->image));
    if (scale(of->n, work->basis, work->image) == 0) return VES_OK; /* nothing is stressed */
    for (int count = 1; count <= STEPS; count++) {
        double *v = work->basis + (size_t)(count - 1) * n, *w = v + n, *r = work->image + (size_t)count * n;
        VES_TRY(of->apply(of->of, v, r));
        VES_TRY(of->solve(of->of, r, w));
        found->solves++;
        double before = cblas_ddot(of->n, w, 1, r, 1);
        t.diagonal[count - 1] = strip(of->n, count, work, t.along, w, r);
        t.beside[count - 1] = scale(of->n, w, r);
        bool ends = count == of->n || count == STEPS || pow(t.beside[count - 1], 2) < 1e-24 * before;
        if (!ends && count % (count < 24 ? 4 : 8)) continue;
        double magnitude, top = ritz(&t, count, &magnitude),
                          far = t.beside[count - 1] * fabs(t.along[count - 1]);
        if (top + far <= NONE * magnitude && top > -NONE * magnitude) return VES_OK;
        if (far <= of->close * top || (ends && count < STEPS)) {
            if (top <= NONE * magnitude) return VES_OK;
            found->value = top;
            cblas_dgemv(CblasRowMajor, CblasTrans, count, of->n, 1, work->basis, of->n, t.along, 1, 0, vector,
                        1);
            return VES_OK;
        }
    }
    return VES_NO_CONVERGENCE;
}

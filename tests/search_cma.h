/* Functions to minimize by CMA-ES in the unit box, moved and turned, and one generation of it. */
#ifndef SEARCH_CMA_H
#define SEARCH_CMA_H

#include <criterion/criterion.h>
#include <criterion/new/assert.h>
#include <math.h>
#include <string.h>

#include "base/random.h"
#include "search/cma.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#define PI 3.14159265358979323846

enum { MOST = 24, LARGEST = 600, SEEDS = 15 };

typedef struct world {
    int n;
    double center[MOST], turn[MOST][MOST]; /* f is of turn' (x - center); turned if turn[0][0] != 0 */
    double (*f)(const struct world *, const double *);
} world;

static inline double sphere(const world *w, const double *x)
{
    double sum = 0;
    for (int i = 0; i < w->n; i++) sum += x[i] * x[i];
    return sum;
}

static inline double scale_of(const world *w, int i)
{
    return pow(1e6, (double)i / (w->n - 1));
}

static inline double ellipsoid(const world *w, const double *x)
{
    double sum = 0;
    for (int i = 0; i < w->n; i++) sum += scale_of(w, i) * x[i] * x[i];
    return sum;
}

/* 10 x wide, so that the valley from (-1, ..) to (1, ..) fits into the box */
static inline double rosenbrock(const world *w, const double *x)
{
    double sum = 0;
    for (int i = 0; i < w->n - 1; i++) {
        double a = 1 + 4 * x[i], b = 1 + 4 * x[i + 1] - a * a;
        sum += 100 * b * b + (a - 1) * (a - 1);
    }
    return sum;
}

static inline double at(const world *w, const double *x)
{
    double d[MOST], y[MOST];
    for (int i = 0; i < w->n; i++) d[i] = x[i] - w->center[i];
    if (w->turn[0][0] == 0) return w->f(w, d);
    for (int j = 0; j < w->n; j++) {
        y[j] = 0;
        for (int i = 0; i < w->n; i++) y[j] += w->turn[i][j] * d[i];
    }
    return w->f(w, y);
}

static inline world world_of(int n, double (*f)(const world *, const double *), double center)
{
    world w = {.n = n, .f = f};
    for (int i = 0; i < n; i++) w.center[i] = center;
    return w;
}

/* An orthonormal matrix without a zero. */
static inline void turn(world *w, int seed)
{
    ves_random random = {.seed = (uint64_t)seed, .chain = 9};
    for (int j = 0; j < w->n; j++) {
        double length = 0;
        for (int i = 0; i < w->n; i++) w->turn[i][j] = ves_random_normal(&random);
        for (int k = 0; k < j; k++) {
            double dot = 0;
            for (int i = 0; i < w->n; i++) dot += w->turn[i][j] * w->turn[i][k];
            for (int i = 0; i < w->n; i++) w->turn[i][j] -= dot * w->turn[i][k];
        }
        for (int i = 0; i < w->n; i++) length += w->turn[i][j] * w->turn[i][j];
        for (int i = 0; i < w->n; i++) w->turn[i][j] /= sqrt(length);
    }
}

static ves_arena arena;
static const double middle[MOST] = {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5,
                                    0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5};

static inline ves_cma made(int n, int seed)
{
    ves_cma cma;
    ves_cma_options options = ves_cma_default();
    options.seed = (uint64_t)seed;
    cr_assert(ves_cma_create(&arena, n, LARGEST, &options, &cma));
    return cma;
}

/* One generation of values of f; returns the least. raw [lambda][n] may be NULL. */
static inline double generation(ves_cma *cma, const world *w, double *raw)
{
    double value[LARGEST], u[MOST], least = HUGE_VAL;
    for (int k = 0; k < cma->lambda; k++) {
        ves_cma_ask(cma, k, raw ? &raw[k * cma->n] : NULL, u);
        value[k] = at(w, u);
        least = fmin(least, value[k]);
    }
    ves_cma_tell(cma, value);
    return least;
}

#endif

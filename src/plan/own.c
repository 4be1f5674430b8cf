#include "plan/own.h"

#include <math.h>
#include <string.h>

#include "base/basis.h"
#include "base/diag.h"
#include "plan/inside.h"
#include "plan/spectrum.h"

static const double NOTHING = 1e-12; /* of the largest: rounding */
static const double STEP = 1e-6;     /* of the range */
static const double WALL = 1e-9;     /* of the range: at a bound */
static const double TOUCHING = 1e-5; /* as variation.c */

enum { SIDES = 4 }; /* one step and two, both ways */

typedef struct own {
    ves_plan *plan;
    int n, m, frees, rows;
    int *free, *held; /* variables, constraints */
    double *x, *range;
    ves_verdict verdict;
    double *multiplier; /* [m] */
    double *row;        /* [m][frees] */
    double *slope;      /* [SIDES][frees] of the Lagrangian */
    double *H[2], *M;   /* [frees][frees], by one step and by two */
    plan_spectrum spectrum;
} own;

static ves_status take(own *w, ves_arena *arena)
{
    const size_t n = (size_t)w->n, m = (size_t)w->m;
    double **const plane[] = {&w->x,
                              &w->range,
                              &w->verdict.gradient,
                              &w->multiplier,
                              &w->verdict.constraint,
                              &w->verdict.jacobian,
                              &w->row,
                              &w->slope,
                              &w->H[0],
                              &w->H[1],
                              &w->M};
    const size_t size[] = {n, n, n, m, m, m * n, m * n, SIDES * n, n * n, n * n, n * n};
    w->free = ves_arena_take(arena, n, sizeof *w->free);
    w->held = ves_arena_take(arena, m, sizeof *w->held);
    if (!w->free || !w->held) return VES_MEMORY;
    for (size_t k = 0; k < sizeof plane / sizeof *plane; k++) {
        *plane[k] = ves_arena_take(arena, size[k], sizeof(double));
        if (!*plane[k]) return VES_MEMORY;
    }
    return ves_spectrum_create(w->n, w->m, arena, &w->spectrum);
}

static ves_status ask(own *w)
{
    const ves_ask question = {.x = w->x, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
    VES_TRY(ves_plan_evaluate(w->plan, &question, &w->verdict));
    return w->verdict.status;
}

/* What is free, and what it must keep. */
static ves_status stand(own *w)
{
    const ves_plan *p = w->plan;
    for (int k = 0; k < w->n; k++) {
        w->x[k] = p->start[k], w->range[k] = p->upper[k] - p->lower[k];
        const double wall = WALL * w->range[k];
        if (w->x[k] - p->lower[k] > wall && p->upper[k] - w->x[k] > wall) w->free[w->frees++] = k;
    }
    VES_TRY(ask(w));
    for (int k = 0; k < w->m; k++) {
        if (!p->equality[k] && w->verdict.constraint[k] < -TOUCHING) continue;
        for (int i = 0; i < w->frees; i++)
            w->row[w->rows * w->frees + i] =
                w->verdict.jacobian[k * w->n + w->free[i]] * w->range[w->free[i]];
        w->held[w->rows++] = k;
    }
    for (int i = 0; i < w->frees; i++) w->M[i * w->frees + i] = 1;
    return w->frees ? ves_spectrum_metric(&w->spectrum, w->frees, w->frees, w->M, w->rows, w->row) : VES_OK;
}

/* Least squares, of the slopes where it stands. */
static void multiply(own *w)
{
    const plan_spectrum *s = &w->spectrum;
    double *rest = w->slope;
    for (int i = 0; i < w->frees; i++) rest[i] = w->verdict.gradient[w->free[i]] * w->range[w->free[i]];
    for (int j = s->kept - 1; j >= 0; j--) {
        double along = ves_basis_strip(w->frees, w->frees, s->unit + j * w->frees, rest);
        for (int k = s->from[j] + 1; k < w->rows; k++)
            along -= w->multiplier[w->held[k]] * s->part[k * s->rows + j];
        w->multiplier[w->held[s->from[j]]] = along / s->part[s->from[j] * s->rows + j];
    }
}

static ves_status slope_at(own *w, int variable, double by, double *slope)
{
    const double x = w->x[variable];
    w->x[variable] = x + by * w->range[variable];
    ves_status status = ask(w);
    w->x[variable] = x;
    for (int i = 0; status == VES_OK && i < w->frees; i++) {
        const int k = w->free[i];
        double sum = w->verdict.gradient[k];
        for (int c = 0; c < w->m; c++) sum -= w->multiplier[c] * w->verdict.jacobian[c * w->n + k];
        slope[i] = sum * w->range[k];
    }
    return status;
}

static ves_status hessian(own *w)
{
    static const double by[SIDES] = {STEP, -STEP, 2 * STEP, -2 * STEP};
    const int n = w->frees;
    for (int i = 0; i < n; i++) {
        for (int e = 0; e < SIDES; e++) VES_TRY(slope_at(w, w->free[i], by[e], w->slope + e * n));
        for (int k = 0; k < n; k++)
            for (int d = 0; d < 2; d++)
                w->H[d][i * n + k] =
                    (w->slope[2 * d * n + k] - w->slope[(2 * d + 1) * n + k]) / (2 * by[2 * d]);
    }
    return VES_OK;
}

/* What the two steps, and the two triangles, say differently of a vector. */
static double doubt(const own *w, const double *vector)
{
    const int n = w->frees;
    double sum = 0;
    for (int i = 0; i < n; i++) {
        double t = 0, skew = 0;
        for (int j = 0; j < n; j++) {
            t += (w->H[0][i * n + j] - w->H[1][i * n + j]) * vector[j];
            skew += (w->H[0][i * n + j] - w->H[0][j * n + i]) / 2 * vector[j];
        }
        sum += t * t + skew * skew;
    }
    return sqrt(sum);
}

static int largest(int n, const double *vector)
{
    int at = 0;
    for (int k = 1; k < n; k++)
        if (fabs(vector[k]) > fabs(vector[at])) at = k;
    return at;
}

/* Directions that change nothing (of a shape that is scaled: the size of its curves) are told apart. */
static void tell(const own *w, ves_stability *out)
{
    const plan_spectrum *s = &w->spectrum;
    const double most = s->count ? fmax(fabs(s->value[0]), fabs(s->value[s->count - 1])) : 0;
    for (int k = 0; k < s->count && out->values < VES_STABILITY_VALUES; k++) {
        const double *vector = s->vector + k * w->frees, error = doubt(w, vector) + NOTHING * most;
        if (fabs(s->value[k]) <= error) {
            out->flat++;
            continue;
        }
        out->own[out->values] = s->value[k];
        out->own_error[out->values] = error;
        out->own_along[out->values++] = w->free[largest(w->frees, vector)];
    }
}

ves_status ves_own_find(const ves_problem *problem, ves_stability *out, ves_diag *diag)
{
    own w = {.n = problem->variables, .m = problem->constraints};
    ves_arena arena = {0};
    VES_TRY(ves_plan_create(problem, NULL, &w.plan, diag));
    ves_status status = take(&w, &arena);
    if (status == VES_OK) status = stand(&w);
    if (status == VES_OK && w.frees) {
        multiply(&w);
        status = hessian(&w);
    }
    if (status == VES_OK && w.frees) {
        ves_spectrum_find(&w.spectrum, w.frees, w.H[0]);
        tell(&w, out);
    }
    ves_plan_destroy(w.plan);
    ves_arena_destroy(&arena);
    if (status == VES_MEMORY) return ves_diag_fail(diag, status);
    return VES_OK; /* a neighbour that cannot be measured, or a missing gradient: nothing is told */
}

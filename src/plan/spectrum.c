#include "plan/spectrum.h"

#include <math.h>
#include <string.h>

#include "base/basis.h"
#include "base/eigen.h"

static const double INDEPENDENT = 1e-8; /* what is left of a row beside the others */

ves_status ves_spectrum_create(int n, int rows, ves_arena *arena, plan_spectrum *s)
{
    const size_t nn = (size_t)n * (size_t)n;
    *s = (plan_spectrum){.n = n,
                         .rows = rows,
                         .root = ves_arena_take(arena, nn, sizeof(double)),
                         .form = ves_arena_take(arena, nn, sizeof(double)),
                         .unit = ves_arena_take(arena, (size_t)rows * (size_t)n, sizeof(double)),
                         .part = ves_arena_take(arena, (size_t)rows * (size_t)rows, sizeof(double)),
                         .from = ves_arena_take(arena, (size_t)rows, sizeof(int)),
                         .value = ves_arena_take(arena, (size_t)n, sizeof(double)),
                         .vector = ves_arena_take(arena, nn, sizeof(double)),
                         .work = ves_arena_take(arena, 3 * nn, sizeof(double))};
    return s->root && s->form && s->unit && s->part && s->from && s->value && s->vector && s->work
               ? VES_OK
               : VES_MEMORY;
}

static ves_status cholesky(plan_spectrum *s, int stride, const double *M)
{
    const int n = s->n;
    for (int i = 0; i < n; i++)
        for (int j = 0; j <= i; j++) {
            double sum = M[i * stride + j];
            for (int k = 0; k < j; k++) sum -= s->root[i * n + k] * s->root[j * n + k];
            if (i == j && !(sum > 0)) return VES_NO_NUMBER;
            s->root[i * n + j] = i == j ? sqrt(sum) : sum / s->root[j * n + j];
        }
    return VES_OK;
}

void ves_spectrum_whiten(const plan_spectrum *s, double *x)
{
    for (int i = 0; i < s->n; i++) {
        for (int k = 0; k < i; k++) x[i] -= s->root[i * s->n + k] * x[k];
        x[i] /= s->root[i * s->n + i];
    }
}

void ves_spectrum_colour(const plan_spectrum *s, double *y)
{
    for (int i = s->n - 1; i >= 0; i--) {
        for (int k = i + 1; k < s->n; k++) y[i] -= s->root[k * s->n + i] * y[k];
        y[i] /= s->root[i * s->n + i];
    }
}

static void transpose(int n, double *a)
{
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            double x = a[i * n + j];
            a[i * n + j] = a[j * n + i], a[j * n + i] = x;
        }
}

/* root^-1 H root^-T */
static void form_make(plan_spectrum *s, int stride, const double *H)
{
    const int n = s->n;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) s->form[i * n + j] = (H[i * stride + j] + H[j * stride + i]) / 2;
    for (int turn = 0; turn < 2; turn++) {
        for (int i = 0; i < n; i++) ves_spectrum_whiten(s, s->form + i * n);
        transpose(n, s->form);
    }
}

static void rows_make(plan_spectrum *s, int stride, int rows, const double *row)
{
    const int n = s->n;
    s->kept = 0;
    memset(s->part, 0, sizeof(double) * (size_t)(s->rows * s->rows));
    for (int i = 0; i < rows; i++) {
        double *q = s->unit + s->kept * n;
        memcpy(q, row + i * stride, sizeof(double) * (size_t)n);
        ves_spectrum_whiten(s, q);
        const double size = ves_basis_size(n, q);
        double left = size > 0 ? ves_basis_strip_all(n, s->unit, s->kept, q, s->part + i * s->rows) : 0;
        if (!(left > INDEPENDENT * size)) continue;
        for (int k = 0; k < n; k++) q[k] /= left;
        s->part[i * s->rows + s->kept] = left;
        s->from[s->kept++] = i;
    }
}

/* a = P form P + far (1 - P): what lies in the rows is moved beyond everything. */
static void project(const plan_spectrum *s, double far, double *a)
{
    const int n = s->n;
    memcpy(a, s->form, sizeof(double) * (size_t)(n * n));
    for (int turn = 0; turn < 2; turn++) {
        for (int i = 0; i < n; i++)
            for (int j = 0; j < s->kept; j++) ves_basis_strip(n, n, s->unit + j * n, a + i * n);
        transpose(n, a);
    }
    for (int k = 0; k < s->kept; k++)
        for (int i = 0; i < n; i++)
            for (int j = 0; j < n; j++) a[i * n + j] += far * s->unit[k * n + i] * s->unit[k * n + j];
}

ves_status ves_spectrum_metric(plan_spectrum *s, int n, int stride, const double *M, int rows,
                               const double *row)
{
    s->n = n, s->count = 0;
    VES_TRY(cholesky(s, stride, M));
    rows_make(s, stride, rows, row);
    s->count = n - s->kept;
    return VES_OK;
}

void ves_spectrum_find(plan_spectrum *s, int stride, const double *H)
{
    const int n = s->n;
    double *a = s->work, *vector = a + n * n, *value = vector + n * n, far = 0;
    form_make(s, stride, H);
    for (int k = 0; k < n * n; k++) far += s->form[k] * s->form[k];
    far = 2 * sqrt(far) + 1;
    project(s, far, a);
    ves_eigen_symmetric(n, a, value, vector);
    for (int k = 0; k < n; k++) {
        int least = 0;
        for (int j = 1; j < n; j++)
            if (value[j] < value[least]) least = j;
        s->value[k] = value[least], value[least] = HUGE_VAL;
        for (int i = 0; i < n; i++) s->vector[k * n + i] = vector[i * n + least];
    }
}

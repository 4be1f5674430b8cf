#include "measure/extreme.h"

#include <float.h>
#include <math.h>

#include "measure/argument.h"
#include "measure/cell.h"

enum { CHUNK = 64 };

/* value + p x + q y + (a x^2 + 2 b x y + c y^2) / 2 */
typedef struct quadric {
    double value, p, q, a, b, c;
} quadric;

static double along(const double *const plane[3], int n, const double d[3])
{
    return d[0] * plane[0][n] + d[1] * plane[1][n] + d[2] * plane[2][n];
}

static quadric quadric_init(const ves_samples *s, int n, const double d[3])
{
    return (quadric){along(s->X, n, d),   along(s->Xu, n, d),  along(s->Xv, n, d),
                     along(s->Xuu, n, d), along(s->Xuv, n, d), along(s->Xvv, n, d)};
}

static double quadric_at(const quadric *f, double x, double y)
{
    return f->value + (f->p + f->a * x / 2 + f->b * y) * x + (f->q + f->c * y / 2) * y;
}

static void keep(const quadric *f, double x, double y, ves_extreme *best)
{
    double value = quadric_at(f, x, y);
    if (value > best->value) best->value = value, best->du = x, best->dv = y;
}

/* Where slope * t + bend * t^2 / 2 is largest on [lo, hi]. */
static double crest(double slope, double bend, double lo, double hi)
{
    if (bend < 0) return fmin(fmax(-slope / bend, lo), hi);
    return slope * (hi - lo) + bend * (hi * hi - lo * lo) / 2 > 0 ? hi : lo;
}

/* The largest value on the cell: inside, where the quadric is a hill with its top there, or on an edge. */
static void climb(const quadric *f, const ves_cell *cell, ves_extreme *best)
{
    double det = f->a * f->c - f->b * f->b;
    best->value = f->value, best->du = 0, best->dv = 0;
    if (f->a < 0 && det > 0) {
        double x = (f->b * f->q - f->c * f->p) / det, y = (f->b * f->p - f->a * f->q) / det;
        if (x >= cell->lo[0] && x <= cell->hi[0] && y >= cell->lo[1] && y <= cell->hi[1]) {
            keep(f, x, y, best);
            return;
        }
    }
    for (int end = 0; end < 2; end++) {
        double x = end ? cell->hi[0] : cell->lo[0], y = end ? cell->hi[1] : cell->lo[1];
        keep(f, x, crest(f->q + f->b * x, f->c, cell->lo[1], cell->hi[1]), best);
        keep(f, crest(f->p + f->b * y, f->a, cell->lo[0], cell->hi[0]), y, best);
    }
}

static double nodal(const ves_samples *s, const double d[3])
{
    const double *restrict x = s->X[0], *restrict y = s->X[1], *restrict z = s->X[2];
    double most = -HUGE_VAL;
#pragma omp simd reduction(max : most)
    for (int n = 0; n < s->count; n++) {
        double value = d[0] * x[n] + d[1] * y[n] + d[2] * z[n];
        most = value > most ? value : most;
    }
    return most;
}

/* Upper bounds of d . X in the cells of `count` nodes from `first` in one row, whose cells reach ru[k], rv.
 */
static void bounds(const ves_samples *s, int first, int count, const double d[3], const double *ru, double rv,
                   double *bound)
{
    double d0 = d[0], d1 = d[1], d2 = d[2];
#define ALONG(X) (d0 * s->X[0][n] + d1 * s->X[1][n] + d2 * s->X[2][n])
#pragma omp simd
    for (int k = 0; k < count; k++) {
        int n = first + k;
        double u = ru[k], a = ALONG(Xuu) / 2, b = ALONG(Xuv), c = ALONG(Xvv) / 2;
        double slope = fabs(ALONG(Xu)) * u + fabs(ALONG(Xv)) * rv + fabs(b) * u * rv;
        bound[k] = ALONG(X) + slope + (a > 0 ? a * u * u : 0) + (c > 0 ? c * rv * rv : 0);
    }
#undef ALONG
}

/* Looks into every cell of one column of chunks that could hold more than the best so far. */
static void search(const ves_samples *s, int sample, int column, const double d[3], ves_extreme *best)
{
    double ru[CHUNK], bound[CHUNK], lo, hi;
    int count = s->nu - column < CHUNK ? s->nu - column : CHUNK;
    for (int k = 0; k < count; k++) {
        ves_cell_u(s, column + k, &lo, &hi);
        ru[k] = ves_cell_reach(lo, hi);
    }
    for (int j = 0; j < s->nv; j++) {
        ves_cell_v(s, j, &lo, &hi);
        bounds(s, j * s->nu + column, count, d, ru, ves_cell_reach(lo, hi), bound);
        for (int k = 0; k < count; k++) {
            if (!(bound[k] >= best->value)) continue;
            ves_extreme top = {.sample = sample, .node = j * s->nu + column + k};
            quadric f = quadric_init(s, top.node, d);
            ves_cell cell = ves_cell_init(s, top.node);
            climb(&f, &cell, &top);
            if (top.value > best->value) *best = top;
        }
    }
}

ves_status ves_extreme_find(const ves_measure_input *input, const double d[3], ves_extreme *extreme)
{
    double most = -HUGE_VAL;
    for (int i = 0; i < input->samples; i++)
        if (input->sample[i]->site == VES_SITE_SURFACE) most = fmax(most, nodal(input->sample[i], d));
    /* a little less, so that rounding does not hide the very node that has it */
    *extreme = (ves_extreme){.sample = -1, .value = most - 1e-12 * fabs(most) - DBL_MIN};
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int column = 0; column < s->nu; column += CHUNK) search(s, i, column, d, extreme);
    }
    return extreme->sample >= 0 && isfinite(extreme->value) ? VES_OK : VES_NO_NUMBER;
}

/* Weights of X, Xu, Xv, Xuu, Xuv, Xvv in the Taylor polynomial. */
static void taylor(const ves_extreme *e, double weight[6])
{
    double x = e->du, y = e->dv;
    weight[0] = 1, weight[1] = x, weight[2] = y;
    weight[3] = x * x / 2, weight[4] = x * y, weight[5] = y * y / 2;
}

void ves_extreme_point(const ves_measure_input *input, const ves_extreme *extreme, double point[3])
{
    const ves_samples *s = input->sample[extreme->sample];
    double w[6];
    int n = extreme->node;
    taylor(extreme, w);
    for (int c = 0; c < 3; c++)
        point[c] = w[0] * s->X[c][n] + w[1] * s->Xu[c][n] + w[2] * s->Xv[c][n] + w[3] * s->Xuu[c][n] +
                   w[4] * s->Xuv[c][n] + w[5] * s->Xvv[c][n];
}

void ves_extreme_gradient(const ves_extreme *extreme, const double back[3], const ves_adjoint *const *adjoint)
{
    const ves_adjoint *g = adjoint[extreme->sample];
    double w[6];
    int n = extreme->node;
    taylor(extreme, w);
    for (int c = 0; g->X[0] && c < 3; c++) {
        g->X[c][n] += w[0] * back[c], g->Xu[c][n] += w[1] * back[c], g->Xv[c][n] += w[2] * back[c];
        g->Xuu[c][n] += w[3] * back[c], g->Xuv[c][n] += w[4] * back[c], g->Xvv[c][n] += w[5] * back[c];
    }
}

size_t ves_extent_room(const ves_measure_input *input)
{
    (void)input;
    return 2 * VES_EXTREME_ROOM;
}

ves_status ves_extent_eval(const ves_measure_input *input, const double unit[3], double *value)
{
    double sum = 0;
    for (int end = 0; end < 2; end++) {
        double sign = end ? -1 : 1, d[3] = {sign * unit[0], sign * unit[1], sign * unit[2]};
        double *room = input->room + end * VES_EXTREME_ROOM;
        ves_extreme e;
        VES_TRY(ves_extreme_find(input, d, &e));
        room[0] = e.sample, room[1] = e.node, room[2] = e.du, room[3] = e.dv;
        sum += e.value;
    }
    *value = sum;
    return VES_OK;
}

void ves_extent_gradient(const ves_measure_input *input, const double unit[3], double seed,
                         const ves_adjoint *const *adjoint, double *unit_back)
{
    for (int end = 0; end < 2; end++) {
        double s = end ? -seed : seed, back[3] = {s * unit[0], s * unit[1], s * unit[2]}, point[3];
        const double *room = input->room + end * VES_EXTREME_ROOM;
        ves_extreme e = {(int)room[0], (int)room[1], room[2], room[3], 0};
        ves_extreme_gradient(&e, back, adjoint);
        ves_extreme_point(input, &e, point);
        for (int c = 0; unit_back && c < 3; c++) unit_back[c] += s * point[c];
    }
}

#include "measure/extreme.h"

#include <float.h>
#include <math.h>

#include "measure/argument.h"
#include "measure/hill.h"
#include "measure/summit.h"

enum { CHUNK = 64, STEPS = 12 };

static const double AROUND = 6.283185307179586;

static double along(const double *const plane[3], int n, const double d[3])
{
    return d[0] * plane[0][n] + d[1] * plane[1][n] + d[2] * plane[2][n];
}

static ves_quadric quadric_init(const ves_samples *s, int n, const double d[3])
{
    return (ves_quadric){along(s->X, n, d),   along(s->Xu, n, d),  along(s->Xv, n, d),
                         along(s->Xuu, n, d), along(s->Xuv, n, d), along(s->Xvv, n, d)};
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

/* The tops of the cells in one column of chunks that could hold more than `most`, the bounds being a tenth
 * too low; of the others -inf. */
static void tops(const ves_samples *s, int column, const double d[3], double most, double *top)
{
    double ru[CHUNK], bound[CHUNK], lo, hi, where[2];
    int count = s->nu - column < CHUNK ? s->nu - column : CHUNK;
    for (int k = 0; k < count; k++) {
        ves_cell_u(s, column + k, &lo, &hi);
        ru[k] = ves_cell_reach(lo, hi);
    }
    for (int j = 0; j < s->nv; j++) {
        ves_cell_v(s, j, &lo, &hi);
        bounds(s, j * s->nu + column, count, d, ru, ves_cell_reach(lo, hi), bound);
        for (int k = 0; k < count; k++) {
            int n = j * s->nu + column + k;
            top[n] = -HUGE_VAL;
            if (!(bound[k] + 0.1 * (bound[k] - along(s->X, n, d)) >= most)) continue;
            ves_quadric f = quadric_init(s, n, d);
            ves_cell cell = ves_cell_init(s, n);
            top[n] = ves_quadric_top(&f, &cell, where);
        }
    }
}

/* The top of a cell. */
static ves_extreme cell_top(const ves_measure_input *input, int sample, int node, const double d[3])
{
    const ves_samples *s = input->sample[sample];
    ves_quadric f = quadric_init(s, node, d);
    ves_cell cell = ves_cell_init(s, node);
    double top[2], value = ves_quadric_top(&f, &cell, top);
    return (ves_extreme){.surface = sample,
                         .at = {s->u[node % s->nu], s->v[node / s->nu]},
                         .sample = sample,
                         .node = node,
                         .du = top[0],
                         .dv = top[1],
                         .value = value};
}

static int look(const ves_measure_input *input, int number, const ves_extreme *e)
{
    double x = e->at[0], y = ves_hill_wrap(input->sample[e->surface], e->at[1]);
    const double u[3] = {x, x, x}, v[3] = {y, y, y};
    return input->look(input, e->surface, number, u, v);
}

/* Newton's steps, kept within the size of a cell. Where they are short the Taylor polynomial is exact. */
static ves_extreme go_up(const ves_measure_input *input, int number, const double d[3], double rounding,
                         ves_extreme e)
{
    static const double SHORT = 1e-4; /* its third power is the error */
    const ves_samples *s = input->sample[e.surface];
    ves_cell cell = ves_cell_init(s, e.node);
    double reach[2], best = -HUGE_VAL;
    for (int k = 0; k < 2; k++) reach[k] = ves_cell_reach(cell.lo[k], cell.hi[k]);
    for (int k = 0; k < STEPS; k++) {
        ves_extreme next = {.surface = e.surface, .node = 4, .at = {e.at[0] + e.du, e.at[1] + e.dv}};
        next.at[0] = fmin(fmax(next.at[0], 0), 1);
        if (!s->periodic) next.at[1] = fmin(fmax(next.at[1], 0), AROUND);
        next.sample = look(input, number, &next);
        if (next.sample < 0) return e;
        ves_quadric f = quadric_init(input->sample[next.sample], next.node, d);
        if (!(f.value >= best - rounding)) { /* back */
            look(input, number, &e);
            return e;
        }
        ves_cell box = ves_hill_box(s, next.at, reach);
        double top[2];
        best = f.value;
        next.value = ves_quadric_top(&f, &box, top);
        bool near = fabs(top[0]) < SHORT && fabs(top[1]) < SHORT, level = next.value <= f.value + rounding;
        if (near || !level)
            next.du = top[0], next.dv = top[1]; /* a far top of what is level is but rounding */
        e = next;
        if (near || level) return e;
    }
    return e;
}

/* From the highest hills up; the last look is at the summit. */
static void summit(const ves_measure_input *input, int number, const double d[3], const double *top,
                   double rounding, ves_extreme *best)
{
    ves_hill hill[VES_HILLS];
    int count = ves_hills_find(input, top, rounding, hill);
    bool fresh = false;
    ves_extreme found = {.value = -HUGE_VAL};
    for (int k = 0; k < count; k++) {
        ves_extreme e = cell_top(input, hill[k].sample, hill[k].node, d);
        double gain = e.value - along(input->sample[e.sample]->X, e.node, d);
        if (e.value + gain < found.value) continue;
        e = go_up(input, number, d, rounding, e);
        fresh = e.value > found.value;
        if (fresh) found = e;
    }
    if (!(found.value > -HUGE_VAL)) return;
    if (!fresh && found.sample != found.surface) found.sample = look(input, number, &found);
    if (found.sample >= 0) *best = found;
}

ves_status ves_extreme_find(const ves_measure_input *input, int number, const double d[3], double *room,
                            ves_extreme *extreme)
{
    const double back[3] = {-d[0], -d[1], -d[2]};
    double most = -HUGE_VAL, least = HUGE_VAL, *top = room;
    for (int i = 0; i < input->samples; i++)
        if (input->sample[i]->site == VES_SITE_SURFACE) {
            most = fmax(most, nodal(input->sample[i], d));
            least = fmin(least, -nodal(input->sample[i], back));
        }
    double rounding = VES_HILL_ROUNDING * fmax(fabs(most), fabs(least));
    most -= rounding + DBL_MIN; /* or rounding might hide the very node that has it */
    *extreme = (ves_extreme){.sample = -1, .value = -HUGE_VAL};
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int column = 0; column < s->nu; column += CHUNK) tops(s, column, d, most, top);
        for (int n = 0; n < s->count; n++)
            if (top[n] > extreme->value) *extreme = (ves_extreme){.sample = i, .node = n, .value = top[n]};
        top += s->count;
    }
    if (extreme->sample < 0 || !isfinite(extreme->value)) return VES_NO_NUMBER;
    *extreme = cell_top(input, extreme->sample, extreme->node, d);
    if (input->look) summit(input, number, d, room, rounding, extreme);
    return VES_OK;
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
    return 2 * VES_EXTREME_ROOM + ves_summit_room(input);
}

ves_status ves_extent_eval(const ves_measure_input *input, const double unit[3], double *value)
{
    double sum = 0;
    for (int end = 0; end < 2; end++) {
        double sign = end ? -1 : 1, d[3] = {sign * unit[0], sign * unit[1], sign * unit[2]};
        double *room = input->room + end * VES_EXTREME_ROOM;
        ves_extreme e;
        VES_TRY(ves_extreme_find(input, end, d, input->room + 2 * VES_EXTREME_ROOM, &e));
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
        ves_extreme e = {
            .sample = (int)room[0], .node = (int)room[1], .du = room[2], .dv = room[3], .value = 0};
        ves_extreme_gradient(&e, back, adjoint);
        ves_extreme_point(input, &e, point);
        for (int c = 0; unit_back && c < 3; c++) unit_back[c] += s * point[c];
    }
}

#include "measure/extreme.h"

#include <float.h>
#include <math.h>

#include "base/vector.h"
#include "measure/argument.h"
#include "measure/hill.h"
#include "measure/summit.h"

enum { CHUNK = 64, STEPS = 30 };

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

/* The node itself, without what its polynomial promises. */
static ves_extreme only_node(const ves_measure_input *input, ves_extreme e, const double d[3])
{
    e.du = e.dv = 0;
    e.value = along(input->sample[e.sample]->X, e.node, d);
    return e;
}

/* Where a step from `e` leads. */
static ves_extreme next_init(const ves_measure_input *input, const ves_extreme *e, const double step[2])
{
    bool periodic = input->sample[e->surface]->periodic;
    ves_extreme next = {.surface = e->surface, .node = 4, .at = {e->at[0] + step[0], e->at[1] + step[1]}};
    next.at[0] = fmin(fmax(next.at[0], 0), 1);
    if (!periodic) next.at[1] = fmin(fmax(next.at[1], 0), VES_TWO_PI);
    return next;
}

static bool within(const double step[2], double length)
{
    return fabs(step[0]) < length && fabs(step[1]) < length;
}

/* From a node up, first to where `e` promises: steps to the top of the Taylor polynomial, no farther than
 * `reach`. Where the surface is lower than before, the reach is halved: the result was seen, never promised.
 * One step more than its height asks for, since a slope feels the way that is left, not its square. here: the
 * look rests on the result. */
static ves_extreme go_up(const ves_measure_input *input, int number, const double d[3], double rounding,
                         ves_extreme e, bool *here)
{
    static const double SHORT = 1e-4, NOTHING = 1e-9; /* what is level has a far top by rounding alone */
    const ves_samples *s = input->sample[e.surface];
    ves_cell cell = ves_cell_init(s, e.node);
    ves_quadric f = quadric_init(s, e.node, d);
    double cell_reach[2], reach[2], step[2] = {e.du, e.dv}, highest = f.value;
    for (int k = 0; k < 2; k++) reach[k] = cell_reach[k] = ves_cell_reach(cell.lo[k], cell.hi[k]);
    bool last = false;
    e = only_node(input, e, d);
    *here = true;
    for (int k = 0; k < STEPS; k++) {
        ves_extreme next = next_init(input, &e, step);
        next.sample = look(input, number, &next);
        next.value = next.sample < 0 ? NAN : along(input->sample[next.sample]->X, next.node, d);
        *here = next.value >= highest - rounding;
        if (*here) {
            e = next;
            f = quadric_init(input->sample[e.sample], e.node, d);
            highest = fmax(highest, e.value);
        }
        for (int c = 0; c < 2; c++)
            reach[c] = *here ? fmin(2 * reach[c], cell_reach[c]) : fmin(reach[c], fabs(step[c])) / 2;
        ves_cell box = ves_hill_box(s, e.at, reach);
        bool level = ves_quadric_top(&f, &box, step) <= f.value + rounding;
        if (level && (last || !within(step, SHORT) || within(step, NOTHING))) break;
        last = level;
    }
    return e;
}

/* --- where to begin --- */

/* The node that has the highest value. */
static ves_extreme highest_node(const ves_measure_input *input, const double d[3])
{
    ves_extreme best = {.sample = -1, .value = -HUGE_VAL};
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        for (int n = 0; s->site == VES_SITE_SURFACE && n < s->count; n++) {
            double value = along(s->X, n, d);
            if (value > best.value) best = (ves_extreme){.sample = i, .node = n, .value = value};
        }
    }
    return best;
}

/* The row that promises most at an end: by the Taylor polynomial of its outer node, by the parabola through
 * its three outer nodes, and by as much more as these differ. */
static ves_extreme end_top(const ves_measure_input *input, int sample, int end, const double d[3])
{
    const ves_samples *s = input->sample[sample];
    double share[3], du, dv[2], promised = -HUGE_VAL;
    int i = end < 0 ? 0 : s->nu - 1, first = ves_hill_end(s, end, share), row = 0;
    ves_cell_u(s, i, end < 0 ? &du : &dv[0], end < 0 ? &dv[0] : &du);
    for (int j = 0; j < s->nv; j++) {
        ves_quadric f = quadric_init(s, j * s->nu + i, d);
        double taylor = ves_quadric_at(&f, du, 0), parabola = 0;
        for (int k = 0; k < 3; k++) parabola += share[k] * along(s->X, j * s->nu + first + k, d);
        double most = fmax(f.value, fmax(taylor, parabola)), least = fmin(f.value, fmin(taylor, parabola));
        if (2 * most - least > promised) promised = 2 * most - least, row = j;
    }
    return (ves_extreme){.surface = sample,
                         .at = {s->u[i], s->v[row]},
                         .sample = sample,
                         .node = row * s->nu + i,
                         .du = du,
                         .value = promised};
}

typedef struct climb {
    const ves_measure_input *input;
    int number;
    const double *d;
    double rounding;
    ves_extreme best;
    bool here; /* the look rests on it */
} climb;

static void climb_from(climb *c, const ves_extreme *e)
{
    bool here, same = c->best.sample >= 0 && c->best.surface == e->surface;
    ves_extreme up = go_up(c->input, c->number, c->d, c->rounding, *e, &here);
    if (up.value > c->best.value)
        c->best = up, c->here = here;
    else if (same)
        c->here = false;
}

/* From the highest hills up, and from what nodes do not show of the ends; no lower than any node. */
static void summit(climb *c, const double *top, double most)
{
    const ves_measure_input *input = c->input;
    ves_hill hill[VES_HILLS];
    int count = ves_hills_find(input, top, c->rounding, hill);
    for (int k = 0; k < count; k++) {
        ves_extreme e = cell_top(input, hill[k].sample, hill[k].node, c->d);
        double gain = e.value - along(input->sample[e.sample]->X, e.node, c->d);
        if (e.value + gain >= c->best.value) climb_from(c, &e);
    }
    for (int i = 0; i < input->samples; i++)
        for (int end = -1; end <= 1 && input->sample[i]->site == VES_SITE_SURFACE; end += 2) {
            if (input->sample[i]->nu < 3) continue;
            ves_extreme e = end_top(input, i, end, c->d);
            bool seen = c->best.surface == i && fabs(c->best.at[0] - (end > 0)) < DBL_EPSILON;
            if (!seen && e.value > c->best.value) climb_from(c, &e);
        }
    if (!(c->best.value >= most)) {
        ves_extreme node = highest_node(input, c->d), e = cell_top(input, node.sample, node.node, c->d);
        climb_from(c, &e);
    }
    if (!c->here && c->best.sample != c->best.surface) look(input, c->number, &c->best);
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
    if (!input->look) return VES_OK;
    climb c = {.input = input, .number = number, .d = d, .rounding = rounding};
    c.best = (ves_extreme){.sample = -1, .value = -HUGE_VAL};
    summit(&c, room, most);
    *extreme = c.best;
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

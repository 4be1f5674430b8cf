#include "measure/summit.h"

#include <math.h>

#include "base/vector.h"
#include "measure/hill.h"

/* Where a surface has no tangent plane at its end, nor the limit of one, one stays this far inside: on the
 * finer grid half as far, so that what grows without bound towards a tip differs there, and fails its
 * proof. */
static const double INSIDE[2] = {1e-3, 0.5e-3};

/* A stencil of 3 x 3 points shrinks from step to step, from a cell to the 512th part of one. What then is
 * left of the way to the summit is of the square of that size, and what is left of the height of its fourth
 * power. Smaller ones would see nothing but rounding. */
enum { MOST = 30, SHRINK = 8, FINEST = 512 };

typedef struct climb {
    const ves_measure_input *input;
    const ves_samples *surface;
    int sample;
    ves_height *height;
    const void *of;
    double inside[2];             /* u stays this far from either end */
    double at[2], h[2], least[2]; /* the stencil: its middle, spacing, and least spacing */
    double best, where[2];        /* the highest value so far */
    int found;                    /* the sample of a look whose node 4 has it, or -1 */
    double rounding;
} climb;

static int look(const climb *c, const double u[3], const double v[3])
{
    double wrapped[3];
    for (int k = 0; k < 3; k++) wrapped[k] = ves_hill_wrap(c->surface, v[k]);
    return c->input->look(c->input, c->sample, 0, u, wrapped);
}

/* The stencil about `at`, moved so that it lies on the patch. */
static void stencil(climb *c, double node[2][3])
{
    for (int d = 0; d < 2; d++) {
        double lo = d ? 0 : c->inside[0], hi = d ? VES_TWO_PI : 1 - c->inside[1];
        c->h[d] = fmin(c->h[d], (hi - lo) / 2);
        double mid = c->at[d];
        if (!d || !c->surface->periodic) mid = fmin(fmax(mid, lo + c->h[d]), hi - c->h[d]);
        c->at[d] = mid;
        for (int k = 0; k < 3; k++) node[d][k] = mid + (k - 1) * c->h[d];
        if (d && c->surface->periodic) continue;
        node[d][0] = fmax(node[d][0], lo), node[d][2] = fmin(node[d][2], hi);
    }
}

/* Values at the stencil; false: there are none. */
static bool values(climb *c, const double node[2][3], double f[9])
{
    int index = look(c, node[0], node[1]);
    if (index < 0) return false;
    for (int k = 0; k < 9; k++) {
        f[k] = c->height(c->of, c->input->sample[index], k);
        if (!isfinite(f[k])) return false;
        if (f[k] > c->best) c->best = f[k], c->where[0] = node[0][k % 3], c->where[1] = node[1][k / 3];
    }
    return true;
}

static ves_quadric model(const double f[9], const double h[2])
{
    return (ves_quadric){f[4],
                         (f[5] - f[3]) / (2 * h[0]),
                         (f[7] - f[1]) / (2 * h[1]),
                         (f[5] - 2 * f[4] + f[3]) / (h[0] * h[0]),
                         (f[8] - f[6] - f[2] + f[0]) / (4 * h[0] * h[1]),
                         (f[7] - 2 * f[4] + f[1]) / (h[1] * h[1])};
}

/* Keeps away from the ends that the stencil touches; false: it touches none. */
static bool retreat(climb *c, const double node[2][3])
{
    bool touched = false;
    for (int end = 0; end < 2; end++)
        if (c->inside[end] == 0 && (end ? node[0][2] >= 1 : node[0][0] <= 0))
            c->inside[end] = INSIDE[c->input->level], touched = true;
    return touched;
}

/* The top of the model, at most two stencils away, and farther next time if it lies beyond this one. Where
 * the model promises nothing, the best so far; where all is level, no such step. */
static bool step(climb *c)
{
    double node[2][3], f[9], top[2], reach[2] = {2 * c->h[0], 2 * c->h[1]};
    stencil(c, node);
    if (!values(c, (const double(*)[3])node, f)) return retreat(c, (const double(*)[3])node);
    ves_quadric q = model(f, c->h);
    ves_cell box = ves_hill_box(c->surface, c->at, reach);
    box.lo[0] = fmax(box.lo[0], c->inside[0] - c->at[0]);
    box.hi[0] = fmin(box.hi[0], 1 - c->inside[1] - c->at[0]);
    double promised = ves_quadric_top(&q, &box, top);
    bool better = promised >= c->best - c->rounding, level = promised <= f[4] + c->rounding;
    for (int d = 0; d < 2; d++) {
        double way = better ? top[d] : c->where[d] - c->at[d];
        bool beyond = fabs(way) > 1.01 * c->h[d];
        if (beyond && better && level) way = 0, beyond = false;
        c->at[d] += way;
        c->h[d] = fmax(c->least[d], c->h[d] * (beyond ? 2 : better ? 1. / SHRINK : 0.5));
    }
    return true;
}

/* One point; the sample that has it, or -1. */
static int look_once(const climb *c, const double at[2], double *value)
{
    const double u[3] = {at[0], at[0], at[0]}, v[3] = {at[1], at[1], at[1]};
    int index = look(c, u, v);
    if (index >= 0) *value = c->height(c->of, c->input->sample[index], 4);
    return index >= 0 && isfinite(*value) ? index : -1;
}

static climb climb_init(const ves_measure_input *input, ves_height *height, const void *of, ves_hill hill,
                        double rounding)
{
    const ves_samples *s = input->sample[hill.sample];
    ves_cell cell = ves_cell_init(s, hill.node);
    climb c = {.input = input,
               .surface = s,
               .sample = hill.sample,
               .height = height,
               .of = of,
               .found = -1,
               .rounding = rounding};
    c.best = height(of, s, hill.node);
    c.where[0] = s->u[hill.node % s->nu];
    c.at[0] = hill.end ? hill.end > 0 : c.where[0];
    c.at[1] = c.where[1] = s->v[hill.node / s->nu];
    for (int d = 0; d < 2; d++) {
        c.h[d] = ves_cell_reach(cell.lo[d], cell.hi[d]);
        c.least[d] = c.h[d] / FINEST;
    }
    return c;
}

static bool finest(const climb *c)
{
    return c->h[0] <= c->least[0] && c->h[1] <= c->least[1];
}

static void go_up(climb *c)
{
    double value;
    bool done = false;
    for (int k = 0; k < MOST && !done; k++) {
        bool fine = finest(c);
        if (!step(c)) return;
        done = fine && finest(c);
    }
    int index = look_once(c, c->at, &value);
    if (index < 0 || value < c->best - c->rounding) return;
    c->best = value, c->where[0] = c->at[0], c->where[1] = c->at[1];
    c->found = index;
}

/* --- all of it --- */

static size_t nodes(const ves_measure_input *input)
{
    size_t count = 0;
    for (int i = 0; i < input->samples; i++)
        if (input->sample[i]->site == VES_SITE_SURFACE) count += (size_t)input->sample[i]->count;
    return count;
}

size_t ves_summit_room(const ves_measure_input *input)
{
    return 2 + nodes(input);
}

static ves_status heights(const ves_measure_input *input, ves_height *height, const void *of, double *to,
                          double *most, double *size)
{
    *most = -HUGE_VAL;
    *size = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++, to++) {
            *to = height(of, s, n);
            if (!isfinite(*to)) return VES_NO_NUMBER;
            *most = fmax(*most, *to);
            *size = fmax(*size, fabs(*to));
        }
    }
    return *most > -HUGE_VAL ? VES_OK : VES_NO_NUMBER;
}

/* How much the parabola through three neighbours rises above the k-th of them, from lo to hi as seen from it.
 */
static double rise(const double *x, const double *f, int k, double lo, double hi)
{
    double left = x[0] - x[1], right = x[2] - x[1], from = x[k] - x[1];
    double s0 = (f[0] - f[1]) / left, s1 = (f[2] - f[1]) / right, bend = 2 * (s1 - s0) / (right - left);
    double slope = s0 - bend / 2 * left + bend * from;
    double t = ves_crest(slope, bend, lo, hi);
    return fmax(0, slope * t + bend * t * t / 2);
}

/* Along u through node (i, j); nothing where there are too few nodes to tell. */
static double rise_u(const ves_samples *s, const double *height, int i, int j)
{
    if (s->nu < 3) return 0;
    int first = i < 1 ? 0 : i > s->nu - 2 ? s->nu - 3 : i - 1;
    double lo, hi;
    ves_cell_u(s, i, &lo, &hi);
    return rise(s->u + first, height + j * s->nu + first, i - first, lo, hi);
}

/* The first of the three rows about j; on a periodic surface it may be -1. */
static int first_row(const ves_samples *s, int j)
{
    return s->periodic ? j - 1 : j < 1 ? 0 : j > s->nv - 2 ? s->nv - 3 : j - 1;
}

/* Along v, of f[0..2] at the rows about j. */
static double rise_v(const ves_samples *s, int j, const double f[3])
{
    double lo, hi, x[3];
    int first = first_row(s, j);
    ves_cell_v(s, j, &lo, &hi);
    for (int k = 0; k < 3; k++) {
        int row = first + k;
        x[k] = row < 0 ? s->v[s->nv - 1] - VES_TWO_PI : row >= s->nv ? s->v[0] + VES_TWO_PI : s->v[row];
    }
    return rise(x, f, j - first, lo, hi);
}

/* The three rows about j. */
static void rows_about(const ves_samples *s, int j, int row[3])
{
    int first = first_row(s, j);
    for (int k = 0; k < 3; k++) row[k] = (first + k + s->nv) % s->nv;
}

/* At the end of row j, by the parabola through the three nodes next to it. */
static double at_end(const ves_samples *s, const double *height, int j, int end)
{
    double share[3], value = 0;
    const double *f = height + j * s->nu + ves_hill_end(s, end, share);
    for (int k = 0; k < 3; k++) value += share[k] * f[k];
    return value;
}

/* Hills of the end curves: there the landscape may rise where no node shows it. */
static void ends(const ves_measure_input *input, const double *height, double rounding,
                 ves_hill hill[VES_HILLS], int *count)
{
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int end = -1; end <= 1 && s->nu > 2; end += 2)
            for (int j = 0; j < s->nv; j++) {
                double here = at_end(s, height, j, end);
                bool top = true;
                for (int side = -1; side <= 1 && top; side += 2) {
                    int row = s->periodic ? (j + side + s->nv) % s->nv : j + side;
                    if (row < 0 || row >= s->nv) continue;
                    top = here >= at_end(s, height, row, end) + (row < j ? rounding : -rounding);
                }
                int node = j * s->nu + (end > 0 ? s->nu - 1 : 0);
                if (top) ves_hill_insert(hill, count, (ves_hill){i, node, end, here});
            }
        height += s->count;
    }
}

/* The height that a hill may have, by the nodes about it: what they say, and once more by how much that
 * differs from its node. height: of its surface. */
static double promise(const ves_samples *s, const double *height, ves_hill hill)
{
    int i = hill.node % s->nu, j = hill.node / s->nu, row[3];
    double f[3], node = height[hill.node], told = hill.height;
    rows_about(s, j, row);
    for (int k = 0; k < 3 && s->nv > 2; k++)
        f[k] = hill.end ? at_end(s, height, row[k], hill.end) : height[row[k] * s->nu + i];
    if (s->nv > 2) told += rise_v(s, j, f);
    if (!hill.end) told += rise_u(s, height, i, j);
    return told + fabs(told - node);
}

/* A hill in the outer row that goes on rising is one of the end. */
static bool goes_on(const ves_samples *s, const double *height, ves_hill hill)
{
    int i = hill.node % s->nu, end = i == 0 ? -1 : i == s->nu - 1 ? 1 : 0;
    if (hill.end || !end || s->nu < 3) return false;
    return at_end(s, height, hill.node / s->nu, end) >= hill.height;
}

/* The part of `height` that belongs to a sample. */
static const double *height_of(const ves_measure_input *input, const double *height, int sample)
{
    for (int i = 0; i < sample; i++)
        if (input->sample[i]->site == VES_SITE_SURFACE) height += input->sample[i]->count;
    return height;
}

/* The node with the highest value, which stands where no look can be had. */
static void settle(const ves_measure_input *input, const double *height, double most, double *room)
{
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++)
            if (height[n] == most) {
                room[0] = i, room[1] = n;
                return;
            }
        height += s->count;
    }
}

ves_status ves_summit_find(const ves_measure_input *input, ves_height *height, const void *of, double *room,
                           double *value)
{
    double *all = room + 2, most, size;
    ves_hill hill[VES_HILLS];
    climb best = {.best = -HUGE_VAL, .found = -1};
    VES_TRY(heights(input, height, of, all, &most, &size));
    settle(input, all, most, room);
    *value = most;
    if (!input->look) return VES_OK;
    double rounding = VES_HILL_ROUNDING * size;
    int count = ves_hills_find(input, all, rounding, hill);
    ends(input, all, rounding, hill, &count);
    for (int k = 0; k < count; k++) {
        climb c = climb_init(input, height, of, hill[k], rounding);
        const double *own = height_of(input, all, c.sample);
        if (goes_on(c.surface, own, hill[k]) || promise(c.surface, own, hill[k]) < fmax(most, best.best))
            continue;
        go_up(&c);
        if (c.best > best.best)
            best = c;
        else if (c.sample == best.sample)
            best.found = -1; /* its look has moved on */
    }
    if (best.found < 0 && best.best > -HUGE_VAL) best.found = look_once(&best, best.where, &best.best);
    if (best.found < 0 || best.best < most - rounding) return VES_OK;
    room[0] = best.found, room[1] = 4;
    *value = best.best;
    return VES_OK;
}

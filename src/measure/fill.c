#include "measure/fill.h"

#include <float.h>
#include <math.h>

#include "base/vector.h"
#include "measure/cut.h"
#include "measure/flux.h"
#include "measure/ring.h"

enum { STEPS = 20 };

/* Of sums of a hundred terms, relative to the largest: a rim whose heights differ by less is level. */
static const double ROUNDING = 1e-13;

/* room: sample of the rim, 3 weights for each of its nodes; then f, g, their adjoints and a cut of one row. */
static size_t rim_room(const ves_measure_input *input)
{
    int most = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if ((s->site == VES_SITE_CAP || s->site == VES_SITE_CURVE) && s->count > most) most = s->count;
    }
    return 1 + 3 * (size_t)most;
}

size_t ves_fill_room(const ves_measure_input *input)
{
    int most = 0;
    for (int i = 0; i < input->samples; i++)
        if (input->sample[i]->site == VES_SITE_SURFACE && input->sample[i]->nu > most)
            most = input->sample[i]->nu;
    return rim_room(input) + 4 * (size_t)most + ves_cut_room(most);
}

static double along(const double *const plane[3], int n, const double d[3])
{
    return d[0] * plane[0][n] + d[1] * plane[1][n] + d[2] * plane[2][n];
}

/* --- the rim --- */

static double mean_height(const ves_samples *s, const double axis[3])
{
    double sum = 0;
    for (int n = 0; n < s->count; n++) sum += along(s->X, n, axis);
    return sum / s->count;
}

/* The sample of the rim, -1: there is none. */
static int rim_sample(const ves_measure_input *input, int rim, const double axis[3])
{
    double highest = -HUGE_VAL;
    int found = -1;
    if (input->args->arg[rim].given) return ves_sample_index(input, rim);
    for (int i = 0; i < input->samples; i++) {
        if (input->sample[i]->site != VES_SITE_CAP) continue;
        double height = mean_height(input->sample[i], axis);
        if (height > highest) highest = height, found = i;
    }
    return found;
}

/* Height, slope and bend of the rim at a point, and the weights of its nodes there. */
static void rim_at(const ves_samples *s, const double axis[3], ves_ring_point p, double *weight, double f[3])
{
    ves_ring_weights(s, p, weight);
    f[0] = f[1] = f[2] = 0;
    for (int k = 0; k < s->count; k++) {
        double height = along(s->X, k, axis);
        for (int d = 0; d < 3; d++) f[d] += weight[d * s->count + k] * height;
    }
}

/* From a node that is lower than its neighbours down, no farther than to them: Newton's steps, halved where it goes
 * up. */
static double rim_down(const ves_samples *s, const double axis[3], int node, double rounding, double *weight,
                       ves_ring_point *lowest)
{
    double spacing = VES_TWO_PI / s->count, t = 0, f[3], next[3];
    rim_at(s, axis, (ves_ring_point){node, 0}, weight, f);
    for (int k = 0; k < STEPS; k++) {
        double step = f[2] > 0 ? -f[1] / f[2] : f[1] > 0 ? -spacing / 2 : spacing / 2;
        step = fmin(fmax(step, -spacing - t), spacing - t);
        for (int half = 0; half < STEPS; half++, step /= 2) {
            rim_at(s, axis, ves_ring_near(s, (ves_ring_point){node, t + step}), weight, next);
            if (next[0] <= f[0] + rounding) break;
        }
        if (!(next[0] <= f[0] + rounding)) break;
        bool last = fabs(step) < 1e-9 * spacing || next[0] >= f[0] - rounding;
        t += step;
        for (int d = 0; d < 3; d++) f[d] = next[d];
        if (last) break;
    }
    *lowest = ves_ring_near(s, (ves_ring_point){node, t});
    return f[0];
}

/* How much lower than a node the parabola through it and its neighbours lies. */
static double dip(double before, double here, double after)
{
    double bend = before - 2 * here + after, slope = (after - before) / 2;
    return bend > 0 ? slope * slope / (2 * bend) : 0;
}

ves_status ves_fill_rim(const ves_measure_input *input, int rim, const double axis[3], double *level)
{
    int index = rim_sample(input, rim, axis);
    if (index < 0) return VES_NO_NUMBER;
    const ves_samples *s = input->sample[index];
    double *weight = input->room + 1, least = HUGE_VAL, most = -HUGE_VAL, size = 0, f[3];
    ves_ring_point best = {0, 0}, p;
    input->room[0] = index;
    for (int n = 0; n < s->count; n++) {
        double height = along(s->X, n, axis);
        if (!isfinite(height)) return VES_NO_NUMBER;
        if (height < least) least = height, best.node = n;
        most = fmax(most, height), size = fmax(size, fabs(height));
    }
    bool flat = most - least <= ROUNDING * size;
    for (int n = 0; n < s->count && !flat; n++) {
        double before = along(s->X, (n + s->count - 1) % s->count, axis), here = along(s->X, n, axis);
        double after = along(s->X, (n + 1) % s->count, axis);
        if (here >= before || here > after || here - 2 * dip(before, here, after) >= least) continue;
        double low = rim_down(s, axis, n, ROUNDING * size, weight, &p);
        if (low < least) least = low, best = p;
    }
    rim_at(s, axis, best, weight, f);
    *level = f[0];
    return VES_OK;
}

void ves_fill_rim_gradient(const ves_measure_input *input, const double axis[3], double seed,
                           const ves_adjoint *const *adjoint, double axis_back[3])
{
    int index = (int)input->room[0];
    const ves_samples *s = input->sample[index];
    const double *weight = input->room + 1;
    for (int k = 0; k < s->count; k++)
        for (int c = 0; c < 3; c++) {
            axis_back[c] += seed * weight[k] * s->X[c][k];
            if (adjoint[index]->X[0]) adjoint[index]->X[c][k] += seed * weight[k] * axis[c];
        }
}

/* --- what lies below a level: patches --- */

/* f is the height over the level, g the axis . n of each du dv. */
static ves_cut_row row_init(const ves_measure_input *input, const ves_samples *s, int j, const double axis[3],
                            double level)
{
    double *f = input->room + rim_room(input), *g = f + s->nu;
    for (int i = 0; i < s->nu; i++) {
        int n = j * s->nu + i;
        f[i] = along(s->X, n, axis) - level;
        g[i] = along(s->normal, n, axis) * s->dA[n] / s->weight[n];
    }
    return (ves_cut_row){.s = s, .j = j, .f = f, .g = g, .room = f + 4 * s->nu};
}

/* Returns d / d level. */
static double row_scatter(const ves_cut_row *row, const double axis[3], const double *back,
                          const ves_adjoint *adjoint, double axis_back[3])
{
    const ves_samples *s = row->s;
    const double *f_back = back, *g_back = back + s->nu;
    double by_level = 0;
    for (int i = 0; i < s->nu; i++) {
        int n = row->j * s->nu + i;
        double g = g_back[i] / s->weight[n];
        by_level -= f_back[i];
        for (int c = 0; c < 3; c++) axis_back[c] += f_back[i] * s->X[c][n] + g * s->dA[n] * s->normal[c][n];
        if (!adjoint->X[0]) continue;
        adjoint->dA[n] += g * along(s->normal, n, axis);
        for (int c = 0; c < 3; c++) {
            adjoint->X[c][n] += f_back[i] * axis[c];
            adjoint->normal[c][n] += g * s->dA[n] * axis[c];
        }
    }
    return by_level;
}

/* --- caps --- */

/* The mean over a triangle of min(h, 0), h being a at one corner and b at the two others, which are as good as one:
 * integral of min(a + (b - a) s, 0) 2 s ds; and its derivatives by a and b. */
typedef struct mean {
    double value, a, b;
} mean;

static mean mean_init(double a, double b)
{
    const mean all = {(a + 2 * b) / 3, 1. / 3, 2. / 3};
    if (a < 0 && b < 0) return all;
    if (a >= 0 && b >= 0) return (mean){0, 0, 0};
    double s = a / (a - b); /* where h is 0 */
    mean inner = {a * s * s / 3, s * s - 2 * s * s * s / 3, 2 * s * s * s / 3};
    return a < 0 ? inner : (mean){all.value - inner.value, all.a - inner.a, all.b - inner.b};
}

/* One spoke of a fan: the triangle (c, X, X + Xv dv). */
typedef struct spoke {
    double arm[3], vector[3]; /* X - c; its cross product with Xv */
    double factor;            /* of vector: half of what dv counts */
    mean below;
} spoke;

static spoke spoke_init(const ves_samples *s, int n, const double c[3], const double axis[3], double level)
{
    double tangent[3] = {s->Xv[0][n], s->Xv[1][n], s->Xv[2][n]};
    spoke k = {.factor = s->side / 2 * s->weight[n]};
    for (int i = 0; i < 3; i++) k.arm[i] = s->X[i][n] - c[i];
    ves_cross(k.arm, tangent, k.vector);
    k.below = mean_init(ves_dot(c, axis) - level, along(s->X, n, axis) - level);
    return k;
}

static double cap_sum(const ves_samples *s, const double axis[3], double level)
{
    ves_cap cap = ves_cap_init(s);
    double sum = 0;
    for (int n = 0; n < s->count; n++) {
        spoke k = spoke_init(s, n, cap.mean, axis, level);
        sum += k.factor * ves_dot(k.vector, axis) * k.below.value;
    }
    return sum;
}

static double cap_gradient(const ves_samples *s, const double axis[3], double level, double seed,
                           const ves_adjoint *adjoint, double axis_back[3])
{
    ves_cap cap = ves_cap_init(s), back = {{0}, {0}};
    double by_level = 0;
    for (int n = 0; n < s->count; n++) {
        spoke k = spoke_init(s, n, cap.mean, axis, level);
        double area = k.factor * ves_dot(k.vector, axis), g = seed * k.factor * k.below.value;
        double a = seed * area * k.below.a, b = seed * area * k.below.b;
        double tangent[3] = {s->Xv[0][n], s->Xv[1][n], s->Xv[2][n]}, by_arm[3], by_tangent[3];
        ves_cross(tangent, axis, by_arm);
        ves_cross(axis, k.arm, by_tangent);
        by_level -= a + b;
        for (int i = 0; i < 3; i++) {
            axis_back[i] += g * k.vector[i] + a * cap.mean[i] + b * s->X[i][n];
            back.mean[i] += a * axis[i] - g * by_arm[i];
            if (!adjoint->X[0]) continue;
            adjoint->X[i][n] += b * axis[i] + g * by_arm[i];
            adjoint->Xv[i][n] += g * by_tangent[i];
        }
    }
    if (adjoint->X[0]) ves_cap_gradient(s, &back, adjoint);
    return by_level;
}

/* --- all of it --- */

ves_status ves_fill_eval(const ves_measure_input *input, const double axis[3], double level, double *value)
{
    double sum = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site == VES_SITE_CAP) sum += cap_sum(s, axis, level);
        for (int j = 0; s->site == VES_SITE_SURFACE && j < s->nv; j++) {
            ves_cut_row row = row_init(input, s, j, axis, level);
            sum += ves_cut_weight(s, j) * ves_cut_eval(&row);
        }
    }
    if (!isfinite(sum)) return VES_NO_NUMBER;
    *value = sum;
    return VES_OK;
}

double ves_fill_gradient(const ves_measure_input *input, const double axis[3], double level, double seed,
                         const ves_adjoint *const *adjoint, double axis_back[3])
{
    double by_level = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site == VES_SITE_CAP) by_level += cap_gradient(s, axis, level, seed, adjoint[i], axis_back);
        for (int j = 0; s->site == VES_SITE_SURFACE && j < s->nv; j++) {
            ves_cut_row row = row_init(input, s, j, axis, level);
            double *back = input->room + rim_room(input) + 2 * s->nu;
            for (int k = 0; k < 2 * s->nu; k++) back[k] = 0;
            ves_cut_gradient(&row, seed * ves_cut_weight(s, j), back, back + s->nu);
            by_level += row_scatter(&row, axis, back, adjoint[i], axis_back);
        }
    }
    return by_level;
}

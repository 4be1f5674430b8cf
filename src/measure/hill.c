#include "measure/hill.h"

#include <math.h>

#include "base/vector.h"

/* --- quadrics --- */

double ves_quadric_at(const ves_quadric *f, double x, double y)
{
    return f->value + (f->p + f->a * x / 2 + f->b * y) * x + (f->q + f->c * y / 2) * y;
}

static void keep(const ves_quadric *f, double x, double y, double *best, double top[2])
{
    double value = ves_quadric_at(f, x, y);
    if (value > *best) *best = value, top[0] = x, top[1] = y;
}

double ves_crest(double slope, double bend, double lo, double hi)
{
    if (bend < 0) return fmin(fmax(-slope / bend, lo), hi);
    return slope * (hi - lo) + bend * (hi * hi - lo * lo) / 2 > 0 ? hi : lo;
}

/* Inside, where the quadric is a hill with its top there, or on an edge. */
double ves_quadric_top(const ves_quadric *f, const ves_cell *box, double top[2])
{
    double det = f->a * f->c - f->b * f->b, best = f->value;
    top[0] = top[1] = 0;
    if (f->a < 0 && det > 0) {
        double x = (f->b * f->q - f->c * f->p) / det, y = (f->b * f->p - f->a * f->q) / det;
        if (x >= box->lo[0] && x <= box->hi[0] && y >= box->lo[1] && y <= box->hi[1]) {
            keep(f, x, y, &best, top);
            return best;
        }
    }
    for (int end = 0; end < 2; end++) {
        double x = end ? box->hi[0] : box->lo[0], y = end ? box->hi[1] : box->lo[1];
        keep(f, x, ves_crest(f->q + f->b * x, f->c, box->lo[1], box->hi[1]), &best, top);
        keep(f, ves_crest(f->p + f->b * y, f->a, box->lo[0], box->hi[0]), y, &best, top);
    }
    return best;
}

/* --- hills --- */

/* Of nodes that are level, within rounding, the first one is the hill. */
static bool is_hill(const ves_samples *s, const double *height, int node, double rounding)
{
    int i = node % s->nu, j = node / s->nu;
    for (int dj = -1; dj <= 1; dj++)
        for (int di = -1; di <= 1; di++) {
            int x = i + di, y = s->periodic ? (j + dj + s->nv) % s->nv : j + dj, other = y * s->nu + x;
            if (x < 0 || x >= s->nu || y < 0 || y >= s->nv || other == node) continue;
            if (!(height[node] >= height[other] + (other < node ? rounding : -rounding))) return false;
        }
    return true;
}

void ves_hill_insert(ves_hill hill[VES_HILLS], int *count, ves_hill made)
{
    if (*count == VES_HILLS && hill[VES_HILLS - 1].height >= made.height) return;
    int at = *count < VES_HILLS ? (*count)++ : VES_HILLS - 1;
    for (; at > 0 && hill[at - 1].height < made.height; at--) hill[at] = hill[at - 1];
    hill[at] = made;
}

int ves_hills_find(const ves_measure_input *input, const double *height, double rounding,
                   ves_hill hill[VES_HILLS])
{
    int count = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE) continue;
        for (int n = 0; n < s->count; n++)
            if (height[n] > -HUGE_VAL && is_hill(s, height, n, rounding))
                ves_hill_insert(hill, &count, (ves_hill){i, n, 0, height[n]});
        height += s->count;
    }
    return count;
}

int ves_hill_end(const ves_samples *s, int end, double share[3])
{
    int first = end < 0 ? 0 : s->nu - 3;
    const double *x = s->u + first;
    double u = end > 0;
    for (int k = 0; k < 3; k++) {
        share[k] = 1;
        for (int m = 0; m < 3; m++) share[k] *= m == k ? 1 : (u - x[m]) / (x[k] - x[m]);
    }
    return first;
}

ves_cell ves_hill_box(const ves_samples *s, const double at[2], const double reach[2])
{
    ves_cell box;
    for (int d = 0; d < 2; d++) {
        double end = d ? VES_TWO_PI : 1;
        bool open = d && s->periodic;
        box.lo[d] = open ? -reach[d] : fmax(-reach[d], -at[d]);
        box.hi[d] = open ? reach[d] : fmin(reach[d], end - at[d]);
    }
    return box;
}

double ves_hill_wrap(const ves_samples *s, double v)
{
    return s->periodic ? v - VES_TWO_PI * floor(v / VES_TWO_PI) : v;
}

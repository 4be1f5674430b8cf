/* The cheap checks of the loop: a normal that turns over between neighbours, a shape inside out, too near its
 * axis, a height that does not grow. Each is a verdict, not an error. */
#include "measure/flux.h"
#include "plan/inside.h"

#include <math.h>
#include <string.h>

/* Neighbouring normals more than 120 degrees apart: between them the Jacobian has changed its sign. */
static const double TURNED = -0.5;

static double dot_between(const ves_samples *s, int a, int b)
{
    return s->normal[0][a] * s->normal[0][b] + s->normal[1][a] * s->normal[1][b] +
           s->normal[2][a] * s->normal[2][b];
}

/* Dot products of the normals of eight nodes along u with those of eight others. */
static inline ves_lanes dots(const ves_samples *s, int at, int other)
{
    ves_lanes sum = {0};
    for (int c = 0; c < 3; c++) sum += ves_lanes_at(s->normal[c] + at) * ves_lanes_at(s->normal[c] + other);
    return sum;
}

static bool folded_any(const ves_samples *s)
{
    for (int j = 0; j < s->nv; j++)
        for (int i = 0; i < s->nu; i++) {
            int at = j * s->nu + i, next = (j + 1) % s->nv * s->nu + i;
            if (i + 1 < s->nu && dot_between(s, at, at + 1) < TURNED) return true;
            if ((s->periodic || j + 1 < s->nv) && dot_between(s, at, next) < TURNED) return true;
        }
    return false;
}

static bool folded(const ves_samples *s)
{
    if (s->nu % VES_LANES) return folded_any(s);
    ves_lanes least = {1, 1, 1, 1, 1, 1, 1, 1};
    for (int j = 0; j < s->nv; j++) {
        int next = j + 1 < s->nv ? j + 1 : s->periodic ? 0 : j;
        for (int i = 0; i < s->nu; i += VES_LANES) {
            int at = j * s->nu + i;
            ves_lanes right = dots(s, at, at + 1); /* planes are longer than their count by one register */
            if (i + VES_LANES == s->nu)
                right[VES_LANES - 1] = 1; /* the rightmost node has no right neighbour */
            least = ves_lanes_min(least, ves_lanes_min(right, dots(s, at, next * s->nu + i)));
        }
    }
    for (int k = 0; k < VES_LANES; k++)
        if (least[k] < TURNED) return true;
    return false;
}

static double flux(const ves_samples *s)
{
    double sum = 0;
    for (int c = 0; c < 3; c++) {
        const double *restrict x = s->X[c], *restrict n = s->normal[c], *restrict a = s->dA;
#pragma omp simd reduction(+ : sum)
        for (int k = 0; k < s->count; k++) sum += x[k] * n[k] * a[k];
    }
    return sum / 3;
}

static bool among(int patch, int count, const int *list)
{
    for (int k = 0; k < count; k++)
        if (list[k] == patch) return true;
    return count == 0;
}

static double unit(const double *block, int first, double axis[3])
{
    double length = 0;
    for (int c = 0; c < 3; c++) axis[c] = block[first + c], length += axis[c] * axis[c];
    length = sqrt(length);
    for (int c = 0; c < 3; c++) axis[c] /= length;
    return length;
}

static bool narrow(const ves_plan *plan, const ves_samples *s)
{
    const ves_validity_def *v = &plan->problem->validity;
    double axis[3], limit = plan->block[v->least_radius];
    unit(plan->block, v->axis, axis);
    for (int k = 0; k < s->count; k++) {
        double along = 0, square = 0;
        for (int c = 0; c < 3; c++) along += axis[c] * s->X[c][k], square += s->X[c][k] * s->X[c][k];
        if (square - along * along < limit * limit) return true;
    }
    return false;
}

static bool turns_back(const ves_plan *plan, const ves_samples *s)
{
    double along[3];
    unit(plan->block, plan->problem->validity.monotone, along);
    bool up = false, down = false;
    for (int k = 0; k < s->count; k++) {
        double slope = along[0] * s->Xu[0][k] + along[1] * s->Xu[1][k] + along[2] * s->Xu[2][k];
        if (slope > 0)
            up = true;
        else
            down = true;
    }
    return up && down;
}

/* Every part must enclose what it enclosed where it was turned outward: one that is inside out would be taken
 * off the others. */
static bool inverted(const ves_plan *plan, const plan_level *l)
{
    int patches = plan->problem->patches;
    for (int k = 0; k < patches; k++) plan->enclosed[k] = 0;
    for (int k = 0; k < patches; k++) plan->enclosed[plan->part[k]] += flux(&l->site[k].samples);
    for (int k = patches; k < l->sites; k++) {
        const ves_samples *s = &l->site[k].samples;
        if (s->site != VES_SITE_CAP) continue;
        ves_cap cap = ves_cap_init(s);
        for (int c = 0; c < 3; c++)
            plan->enclosed[plan->part[s->patch]] += s->side / 6 * cap.mean[c] * cap.twice_area[c];
    }
    for (int k = 0; k < patches; k++)
        if (plan->sense[k] * plan->enclosed[k] < 0) return true; /* 0 but at the first patch of a part */
    return false;
}

ves_status ves_plan_validity(const ves_plan *plan, int index)
{
    const ves_problem *p = plan->problem;
    const ves_validity_def *v = &p->validity;
    const plan_level *l = &plan->level[index];
    for (int k = 0; k < p->patches; k++) {
        const ves_samples *s = &l->site[k].samples;
        if (v->jacobian && folded(s)) return VES_FOLDED;
        if (v->least_radius >= 0 && among(k, v->radius_patches, v->radius_patch) && narrow(plan, s))
            return VES_NARROW;
        if (v->monotone >= 0 && among(k, v->monotone_patches, v->monotone_patch) && turns_back(plan, s))
            return VES_NOT_MONOTONE;
    }
    return p->shape.closed && inverted(plan, l) ? VES_INVERTED : VES_OK;
}

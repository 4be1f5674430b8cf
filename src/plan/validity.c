/* The cheap checks of the loop: a normal that turns over between neighbours, a shape inside out, too near its
 * axis, a height that does not grow. Each is a verdict, not an error. What a search presses against, the axis
 * and the height, is asked of the edges too, on every level; whether the last node and the edge lie on two
 * sides of a fold, of proofs alone. */
#include "base/vector.h"
#include "measure/flux.h"
#include "plan/inside.h"

#include <math.h>
#include <string.h>

/* Neighbouring normals more than 120 degrees apart: between them the Jacobian has changed its sign. */
static const double TURNED = -0.5;

/* An end may lie on the limit: rounding must not decide. Of the limit, and of |Xu|. */
static const double ROUNDING = 1e-9;

/* |Xu x Xv| on an edge, as a part of that at the next node: below it there is no tangent plane (a pole). */
static const double PLANELESS = 1e-6;

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

static bool keeps_away(const ves_plan *plan, int patch)
{
    const ves_validity_def *v = &plan->problem->validity;
    return v->least_radius >= 0 && among(patch, v->radius_patches, v->radius_patch);
}

static bool is_monotone(const ves_plan *plan, int patch)
{
    const ves_validity_def *v = &plan->problem->validity;
    return v->monotone >= 0 && among(patch, v->monotone_patches, v->monotone_patch);
}

static bool edges_fold(const ves_plan *plan, int level)
{
    return plan->problem->validity.jacobian && level > 0;
}

static bool has_formulas(const ves_plan *plan, int patch)
{
    return plan->problem->patch[patch].kind == VES_PATCH_FORMULA;
}

unsigned ves_validity_nodes(const ves_plan *plan, int patch, int level)
{
    unsigned edges = ves_validity_edges(plan, patch, level) & (VES_X | VES_XU);
    return edges | (plan->problem->validity.jacobian ? VES_NORMAL : 0) |
           (edges_fold(plan, level) ? VES_AREA : 0) |
           (plan->problem->shape.closed ? VES_X | VES_NORMAL | VES_AREA : 0);
}

/* A formula may have no value on an edge alone: log(u). */
unsigned ves_validity_edges(const ves_plan *plan, int patch, int level)
{
    return (has_formulas(plan, patch) || keeps_away(plan, patch) ? VES_X : 0) |
           (is_monotone(plan, patch) ? VES_XU : 0) | (edges_fold(plan, level) ? VES_XU | VES_XV : 0);
}

int ves_edge_parts(const ves_grid *nodes)
{
    return nodes->symmetric ? 4 : 1;
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
    double axis[3], across[3], limit = plan->block[v->least_radius] * (1 - ROUNDING);
    unit(plan->block, v->axis, axis);
    for (int k = 0; k < s->count; k++) {
        ves_cross((double[3]){s->X[0][k], s->X[1][k], s->X[2][k]}, axis, across);
        if (ves_dot(across, across) < limit * limit) return true;
    }
    return false;
}

/* Slopes along a direction. flat: no more than that on an edge is a level one (a smooth pole, a rim met at a
 * right angle). */
typedef struct rise {
    double along[3], flat;
    bool up, down;
} rise;

static double slope_at(const rise *r, const ves_samples *s, int k)
{
    return r->along[0] * s->Xu[0][k] + r->along[1] * s->Xu[1][k] + r->along[2] * s->Xu[2][k];
}

static void nodes_rise(const ves_samples *s, rise *r)
{
    double steepest = 0;
    for (int k = 0; k < s->count; k++) {
        double slope = slope_at(r, s, k);
        if (slope > 0)
            r->up = true;
        else
            r->down = true;
        for (int c = 0; c < 3; c++) steepest = fmax(steepest, fabs(s->Xu[c][k]));
    }
    r->flat = ROUNDING * steepest;
}

static void edge_rises(const ves_samples *s, rise *r)
{
    for (int k = 0; k < s->count; k++) {
        double slope = slope_at(r, s, k); /* may be no number, where a formula has no slope */
        r->up |= slope > r->flat;
        r->down |= slope < -r->flat;
    }
}

static bool turns_back(const ves_plan *plan, const plan_level *l, int patch)
{
    rise r = {.up = false};
    unit(plan->block, plan->problem->validity.monotone, r.along);
    nodes_rise(&l->site[patch].samples, &r);
    for (int e = 0; e < 2; e++)
        if (l->edge[patch][e] >= 0) edge_rises(&l->site[l->edge[patch][e]].samples, &r);
    return r.up && r.down;
}

/* Is there a tangent plane at sample k of an edge, and does it face away from that of the next node? */
static bool turned_over(const plan_site *edge, int k, const plan_site *nodes, int node)
{
    const ves_samples *e = &edge->samples, *s = &nodes->samples;
    double n[3], J = s->dA[node] / s->weight[node];
    ves_cross((double[3]){e->Xu[0][k], e->Xu[1][k], e->Xu[2][k]},
              (double[3]){e->Xv[0][k], e->Xv[1][k], e->Xv[2][k]}, n);
    double length = sqrt(ves_dot(n, n));
    double dot = n[0] * s->normal[0][node] + n[1] * s->normal[1][node] + n[2] * s->normal[2][node];
    return length > PLANELESS * J && isfinite(length) && nodes->side * dot < TURNED * length;
}

static bool folded_at_edges(const plan_level *l, int patch)
{
    const plan_site *nodes = &l->site[patch], *ends = &l->site[l->edge[patch][0]];
    int nu = nodes->grid.nu, nv = nodes->grid.nv, run = nv / ves_edge_parts(&nodes->grid);
    for (int j = 0; j < nv; j++) {
        int at = 2 * (j + 1 + j / run * 2);
        if (turned_over(ends, at, nodes, j * nu) || turned_over(ends, at + 1, nodes, j * nu + nu - 1))
            return true;
    }
    if (l->edge[patch][1] < 0) return false;
    const plan_site *sides = &l->site[l->edge[patch][1]];
    for (int i = 0; i < nu; i++)
        if (turned_over(sides, i, nodes, i) || turned_over(sides, nu + i, nodes, (nv - 1) * nu + i))
            return true;
    return false;
}

static bool too_near(const ves_plan *plan, const plan_level *l, int patch)
{
    bool found = narrow(plan, &l->site[patch].samples);
    for (int e = 0; e < 2; e++)
        if (l->edge[patch][e] >= 0) found = found || narrow(plan, &l->site[l->edge[patch][e]].samples);
    return found;
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
    const plan_level *l = &plan->level[index];
    for (int k = 0; k < p->patches; k++) {
        if (p->validity.jacobian && folded(&l->site[k].samples)) return VES_FOLDED;
        if (edges_fold(plan, index) && folded_at_edges(l, k)) return VES_FOLDED;
        if (keeps_away(plan, k) && too_near(plan, l, k)) return VES_NARROW;
        if (is_monotone(plan, k) && turns_back(plan, l, k)) return VES_NOT_MONOTONE;
    }
    return p->shape.closed && inverted(plan, l) ? VES_INVERTED : VES_OK;
}

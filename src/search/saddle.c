#include "search/saddle.h"

#include <math.h>
#include <string.h>

#include "base/basis.h"
#include "base/eigen.h"

/* Hessian of the Lagrangian  L = f + sum_j lambda_j c_j  on what the active walls and constraints leave
 * free (Nocedal and Wright, 12.5). With P the projection along the active gradients, the eigenvalues of P
 * H P are those of the reduced Hessian and zeros. H from central differences of exact gradients: 2
 * gradients for each free variable. Zero eigenvalues are flat directions (a shape's own symmetries, idle
 * variables), not saddles.
 * test  x^4/4 - x^2/2 + y^2 from (0, 1); a flat valley; saddles on constraints */

enum { ROOM_TO_LEAVE = 20 }; /* evaluations: without them a saddle is not looked for, only the slope at */

static const double step = 2e-5;       /* in u: truncation ~ 1e-10, noise of a gradient / 2e-5 */
static const double near_wall = 1e-9;  /* in u */
static const double near_limit = 1e-6; /* in u: an active constraint is so near, or within the tolerance */
static const double clear = 1e-5;      /* a negative eigenvalue counts beyond this part of the largest */
static const double speck = 1e-10;     /* and of the objective: 10 roundings of its slope over the step */
static const double sideways =
    1e-6;                         /* of a unit direction, across a wall or a constraint: it runs along it */
static const double steep = 1e-3; /* of the slope at the start: no descent stops there of itself */
static const double rise = 1e-4;  /* nor with a slope that makes this part of the objective across the box */

bool ves_saddle_create(ves_saddle *s, ves_session *session, bool second)
{
    size_t n = (size_t)session->n, m = (size_t)session->m;
    ves_arena *arena = &session->arena;
    *s = (ves_saddle){0};
    double **planes[] = {&s->hessian, &s->vector};
    for (int k = 0; second && k < 2; k++)
        if (!(*planes[k] = ves_arena_take(arena, n * n, sizeof(double)))) return false;
    const size_t rank = m < n ? m : n;
    s->basis = ves_arena_take(arena, rank * n, sizeof(double));
    s->factor = ves_arena_take(arena, rank * n, sizeof(double));
    if (!s->basis || !s->factor) return false;
    double **rows[] = {&s->base, &s->slope, &s->plus, &s->minus, &s->value, &s->direction, &s->trial};
    for (int k = 0; k < 7; k++)
        if (!(*rows[k] = ves_arena_take(arena, n, sizeof(double)))) return false;
    s->multiplier = ves_arena_take(arena, m, sizeof(double));
    s->row = ves_arena_take(arena, m, sizeof(int));
    s->touched = ves_arena_take(arena, m, sizeof(int));
    s->touching = ves_arena_take(arena, m * n, sizeof(double));
    s->free = ves_arena_take(arena, n, sizeof(int));
    return s->multiplier && s->row && s->touched && s->touching && s->free;
}

static double dot(int n, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += a[i] * b[i];
    return sum;
}

/* Gradient of the Lagrangian where the descent has just looked, scaled to the unit box. */
static void lagrangian_slope(const ves_saddle *s, const ves_descent *d, double *slope)
{
    int n = d->session->n;
    for (int i = 0; i < n; i++) {
        double sum = d->last.gradient[i];
        for (int j = 0; j < d->session->m; j++) sum += s->multiplier[j] * d->last.jacobian[j * n + i];
        slope[i] = sum * d->range[i];
    }
}

static double lagrangian(const ves_saddle *s, const ves_descent *d)
{
    return d->last.value + dot(d->session->m, s->multiplier, d->last.constraint);
}

/* Gram-Schmidt on the active gradients restricted to the free variables: row r of the Jacobian is sum_k factor[k][r]
 * basis[k]. A row that depends on the others is dropped from the active ones. */
static void span(ves_saddle *s, const ves_descent *d)
{
    int n = d->session->n, nf = s->frees, rank = 0;
    for (int r = 0; r < s->active && rank < nf; r++) {
        double *q = s->basis + rank * nf;
        for (int i = 0; i < nf; i++)
            q[i] = d->last.jacobian[s->row[r] * n + s->free[i]] * d->range[s->free[i]];
        double size = ves_basis_size(nf, q), left = ves_basis_strip_all(nf, s->basis, rank, q, s->trial);
        for (int k = 0; k < rank; k++) s->factor[k * n + rank] = s->trial[k];
        if (!(left > 1e-9 * size)) continue;
        for (int i = 0; i < nf; i++) q[i] /= left;
        s->factor[rank * n + rank] = left;
        s->row[rank++] = s->row[r];
    }
    s->active = rank;
}

/* Least-squares multipliers: factor lambda = - basis g. */
static void solve(ves_saddle *s, const ves_descent *d)
{
    int n = d->session->n, nf = s->frees;
    memset(s->multiplier, 0, (size_t)d->session->m * sizeof(double));
    for (int i = 0; i < nf; i++) s->trial[i] = d->last.gradient[s->free[i]] * d->range[s->free[i]];
    for (int k = s->active - 1; k >= 0; k--) {
        double sum = -dot(nf, s->basis + k * nf, s->trial);
        for (int r = k + 1; r < s->active; r++) sum -= s->factor[k * n + r] * s->multiplier[s->row[r]];
        s->multiplier[s->row[k]] = sum / s->factor[k * n + k];
    }
}

static void swap(int *a, int *b)
{
    int kept = *a;
    *a = *b;
    *b = kept;
}

/* The inequality that pulls hardest the wrong way is not active; returns its place among the active ones, or
 * -1. */
static int wrong(const ves_saddle *s, const ves_descent *d)
{
    int worst = -1;
    for (int k = 0; k < s->active; k++) {
        int j = s->row[k];
        if (ves_session_equality(d->session, j) || s->multiplier[j] >= 0) continue;
        if (worst < 0 || s->multiplier[j] < s->multiplier[s->row[worst]]) worst = k;
    }
    return worst;
}

/* Of the inequalities that went, the one that the way down, against the slope, would violate most; its place
 * in touched, or -1. */
static int missed(ves_saddle *s, const ves_descent *d, int rows)
{
    int n = d->session->n, worst = -1;
    double most = sideways;
    lagrangian_slope(s, d, s->slope);
    for (int t = rows; t < s->near; t++) {
        double along = 0, size = 0, steepness = 0;
        for (int k = 0; k < s->frees; k++) {
            int i = s->free[k];
            double g = d->last.jacobian[s->touched[t] * n + i] * d->range[i];
            along -= g * s->slope[i];
            size += g * g;
            steepness += s->slope[i] * s->slope[i];
        }
        double part = size * steepness > 0 ? along / sqrt(size * steepness) : 0;
        if (part > most) worst = t, most = part;
    }
    return worst;
}

/* Multipliers that are not negative, as of non-negative least squares (Lawson and Hanson 1974, ch. 23). A row
 * that depended on one that pulls the wrong way comes back when that one goes: of two opposite inequalities,
 * an equation in two words, one always stays. */
static void multipliers(ves_saddle *s, const ves_descent *d)
{
    int rows = 0;
    for (int j = 0; j < d->session->m; j++) {
        double limit = fmax(near_limit * ves_descent_slope(d, j), d->session->tolerance);
        if (ves_session_equality(d->session, j) || d->last.constraint[j] >= -limit) s->touched[rows++] = j;
    }
    s->near = rows;
    for (int turns = 4 * rows;; turns--) {
        memcpy(s->row, s->touched, (size_t)rows * sizeof(int));
        s->active = rows;
        span(s, d);
        solve(s, d);
        int k = wrong(s, d), at = 0;
        if (k < 0) { /* none, or one comes back; in a corner of many they may take turns without end */
            at = turns > 0 ? missed(s, d, rows) : -1;
            if (at < 0) return;
            swap(&s->touched[at], &s->touched[rows++]);
            continue;
        }
        while (s->touched[at] != s->row[k]) at++;
        swap(&s->touched[at], &s->touched[--rows]); /* those that went are kept behind the others */
    }
}

/* Free: off the walls, or at one that the slope does not press against. */
static void release(ves_saddle *s, const ves_descent *d, bool pressed)
{
    double most = 0;
    for (int i = 0; pressed && i < d->session->n; i++)
        most = fmax(most, fabs(d->last.gradient[i]) * d->range[i]);
    s->frees = 0;
    for (int i = 0; i < d->session->n; i++) {
        bool low = d->u[i] <= near_wall, high = d->u[i] >= 1 - near_wall;
        double noise = 1e-7 * (most + d->first_scale);
        bool held =
            (low && !(pressed && s->slope[i] <= noise)) || (high && !(pressed && s->slope[i] >= -noise));
        if (!held) s->free[s->frees++] = i;
    }
}

/* Slope of the Lagrangian at base + h e_i, where h is cut at the wall; h = 0 when there is no room. */
static ves_status slope_at(ves_saddle *s, ves_descent *d, int i, double *h, double *slope)
{
    double u = s->base[i] + *h;
    u = u < 0 ? 0 : u > 1 ? 1 : u;
    *h = u - s->base[i];
    if (fabs(*h) < 0.1 * step) *h = 0;
    memcpy(slope, s->slope, (size_t)d->session->n * sizeof *slope);
    if (*h == 0) return VES_OK;
    memcpy(s->trial, s->base, (size_t)d->session->n * sizeof(double));
    s->trial[i] = u;
    VES_TRY(ves_descent_look(d, s->trial, true));
    if (d->last.status == VES_OK)
        lagrangian_slope(s, d, slope);
    else
        s->edge = i, s->beyond = d->last.status;
    return VES_OK;
}

/* Next to an edge of what can be measured they tell nothing: f may end there as a root or a logarithm does,
 * and the other side alone would not show it. Returns false when some row cannot be had. */
static ves_status differences(ves_saddle *s, ves_descent *d, bool *ok)
{
    int nf = s->frees;
    for (int k = 0; k < nf; k++) {
        double up = step, down = -step;
        VES_TRY(slope_at(s, d, s->free[k], &up, s->plus));
        VES_TRY(slope_at(s, d, s->free[k], &down, s->minus));
        *ok = up != down && s->edge < 0;
        if (!*ok) return VES_OK;
        for (int l = 0; l < nf; l++)
            s->hessian[k * nf + l] = (s->plus[s->free[l]] - s->minus[s->free[l]]) / (up - down);
    }
    return VES_OK;
}

/* Symmetrises; returns the largest asymmetry, which measures the noise. */
static double symmetrise(int n, double *h)
{
    double noise = 0;
    for (int i = 0; i < n; i++)
        for (int j = 0; j < i; j++) {
            noise = fmax(noise, fabs(h[i * n + j] - h[j * n + i]));
            h[i * n + j] = h[j * n + i] = 0.5 * (h[i * n + j] + h[j * n + i]);
        }
    return noise;
}

/* H <- P H P, P = 1 - sum_k q_k q_k'. */
static void project(ves_saddle *s)
{
    int nf = s->frees;
    for (int k = 0; k < s->active; k++) {
        const double *q = s->basis + k * nf;
        for (int i = 0; i < nf; i++) {
            double *row = s->hessian + i * nf, along = dot(nf, row, q);
            for (int j = 0; j < nf; j++) row[j] -= along * q[j];
        }
        for (int j = 0; j < nf; j++) {
            double along = 0;
            for (int i = 0; i < nf; i++) along += q[i] * s->hessian[i * nf + j];
            for (int i = 0; i < nf; i++) s->hessian[i * nf + j] -= along * q[i];
        }
    }
    symmetrise(nf, s->hessian);
}

static bool judge(ves_saddle *s, const ves_descent *d, double noise)
{
    int n = d->session->n, nf = s->frees, low = 0;
    s->largest = 0;
    for (int k = 0; k < nf; k++) {
        s->largest = fmax(s->largest, fabs(s->value[k]));
        if (s->value[k] < s->value[low]) low = k;
    }
    s->lowest = s->value[low];
    memset(s->direction, 0, (size_t)n * sizeof(double));
    for (int i = 0; i < nf; i++) s->direction[s->free[i]] = s->vector[i * nf + low];
    s->mostly = 0;
    for (int i = 1; i < n; i++)
        if (fabs(s->direction[i]) > fabs(s->direction[s->mostly])) s->mostly = i;
    /* one sign for every machine and order of rotations */
    if (s->direction[s->mostly] < 0)
        for (int i = 0; i < n; i++) s->direction[i] = -s->direction[i];
    double least = speck * fmax(fabs(s->lagrangian), d->first_scale);
    return s->lowest < -fmax(fmax(clear * s->largest, 10 * noise), least);
}

/* Which sides of the direction are open, to first order. */
static void open_ways(ves_saddle *s, const ves_descent *d)
{
    int n = d->session->n;
    s->way[0] = s->way[1] = true;
    for (int i = 0; i < n; i++) {
        if (s->base[i] <= near_wall && fabs(s->direction[i]) > sideways) s->way[s->direction[i] > 0] = false;
        if (s->base[i] >= 1 - near_wall && fabs(s->direction[i]) > sideways)
            s->way[s->direction[i] < 0] = false;
    }
    for (int k = 0; k < s->near; k++) {
        double along = 0, size = 0;
        for (int i = 0; i < n; i++) {
            double slope = s->touching[s->touched[k] * n + i] * d->range[i];
            along += slope * s->direction[i];
            size += slope * slope;
        }
        bool equality = ves_session_equality(d->session, s->touched[k]);
        if (!equality && fabs(along) > sideways * sqrt(size)) s->way[along < 0] = false;
    }
}

/* Whether the value runs past a point beside an edge: steeper, in some free variable, than a descent leaves
 * it. */
static bool runs(const ves_saddle *s, const ves_descent *d)
{
    double most = 0;
    for (int k = 0; k < s->frees; k++) most = fmax(most, fabs(s->slope[s->free[k]]));
    return most > steep * d->first_scale;
}

/* Three scales of a slope, as each may be small of itself: a descent may start at its end, an objective may
 * be 0, a step may be shorter than the descent cares for. Descents of smooth objectives ended below a
 * thirtieth of the first and a fiftieth of the second; at kinks the slope was 400 and 200 times these. */
static bool stalls(const ves_saddle *s, const ves_descent *d)
{
    double most = 0;
    for (int k = 0; k < s->frees; k++) {
        int i = s->free[k];
        double room = s->slope[i] > 0 ? s->base[i] : 1 - s->base[i];
        if (room > near_limit) most = fmax(most, fabs(s->slope[i]));
    }
    double size = fmax(fabs(s->lagrangian), d->session->spread);
    return most > steep * d->first_scale && most > rise * size && most > d->options->x_tolerance * s->largest;
}

ves_status ves_saddle_slopes(ves_saddle *s, ves_descent *d, const double *u)
{
    memcpy(s->base, u, (size_t)d->session->n * sizeof(double));
    VES_TRY(ves_descent_look(d, s->base, true));
    if (d->last.status != VES_OK) return VES_OK;
    for (int pass = 0; pass < 2; pass++) {
        release(s, d, pass);
        multipliers(s, d);
        lagrangian_slope(s, d, s->slope);
    }
    return VES_OK;
}

ves_status ves_saddle_check(ves_saddle *s, ves_descent *d, const ves_point *point, bool *negative)
{
    int n = d->session->n;
    long mended = d->mended;
    *negative = s->running = s->stalled = false;
    s->edge = -1;
    VES_TRY(ves_saddle_slopes(s, d, point->u));
    if (d->last.status != VES_OK) return VES_OK;
    s->lagrangian = lagrangian(s, d);
    if (d->session->m) memcpy(s->touching, d->last.jacobian, (size_t)(d->session->m * n) * sizeof(double));
    if (!s->frees) return VES_OK;
    s->largest = 0;
    if (d->budget - d->used < 2L * n + ROOM_TO_LEAVE) {
        s->stalled = stalls(s, d);
        return VES_OK;
    }
    bool ok = true;
    VES_TRY(differences(s, d, &ok));
    s->running = s->edge >= 0 && runs(s, d);
    if (!ok || d->mended > mended) return VES_OK; /* differences of differences tell nothing */
    double noise = symmetrise(s->frees, s->hessian);
    project(s);
    ves_eigen_symmetric(s->frees, s->hessian, s->value, s->vector);
    bool bent = judge(s, d, noise);
    s->stalled = stalls(s, d);
    if (!bent || s->stalled) return VES_OK;
    open_ways(s, d);
    *negative = s->way[0] || s->way[1];
    return VES_OK;
}

static double row_size(const ves_saddle *s, const ves_descent *d, int j)
{
    const int n = d->session->n;
    double size = 0;
    for (int i = 0; i < n; i++) {
        double g = s->touching[j * n + i] * d->range[i];
        size += g * g;
    }
    return sqrt(size);
}

/* What a step violates of the inequalities that touch the base without a multiplier, as dear as the dearest that has
 * one: where their slopes depend on each other the multipliers could as well be theirs. */
static double trespass(const ves_saddle *s, const ves_descent *d)
{
    double dearest = 0, sum = 0;
    for (int k = 0; k < s->active; k++)
        dearest = fmax(dearest, fabs(s->multiplier[s->row[k]]) * row_size(s, d, s->row[k]));
    for (int k = 0; k < s->near; k++) {
        int j = s->touched[k];
        double excess = d->last.constraint[j], size = row_size(s, d, j);
        bool free_of_it = s->multiplier[j] == 0 && !ves_session_equality(d->session, j);
        if (free_of_it && excess > 0 && size > 0) sum += dearest / size * excess;
    }
    return sum;
}

/* The lowest of some steps, if it goes down at least a tenth of what the curvature promises: L + lowest t^2
 * / 2. */
static ves_status walk(ves_saddle *s, ves_descent *d, double sign, ves_point *side, bool *found)
{
    static const double length[] = {0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3};
    double best = HUGE_VAL;
    for (int k = 0; k < 6; k++) {
        for (int i = 0; i < d->session->n; i++) {
            double u = s->base[i] + sign * length[k] * s->direction[i];
            s->trial[i] = u < 0 ? 0 : u > 1 ? 1 : u;
        }
        VES_TRY(ves_descent_look(d, s->trial, false));
        if (d->last.status != VES_OK) continue;
        double fall = s->lagrangian - lagrangian(s, d) - trespass(s, d),
               promised = -0.5 * s->lowest * length[k] * length[k];
        if (fall < 0.1 * promised || -fall >= best) continue;
        best = -fall;
        ves_descent_keep(d, side);
        *found = true;
    }
    return VES_OK;
}

ves_status ves_saddle_leave(ves_saddle *s, ves_descent *d, ves_point *const side[2], bool found[2])
{
    found[0] = found[1] = false;
    if (s->way[0]) VES_TRY(walk(s, d, 1, side[0], &found[0]));
    return s->way[1] ? walk(s, d, -1, side[1], &found[1]) : VES_OK;
}

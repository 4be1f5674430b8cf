#include "measure/nest.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "measure/hill.h"
#include "measure/ring.h"

enum { STEPS = 40, TRIES = 14, STARTS = 4, UNKNOWNS = 6 };

/* The axis and two directions across it. */
typedef struct frame {
    double a[3], e[2][3];
} frame;

/* One of the two points: of a surface, or of the fan of a cap (u from its middle, 0, to its curve, 1). What eval found
 * is, without a look, `share` of the way from a node to the next. */
typedef struct foot {
    int sample, node, next;
    double u, v, share;
} foot;

typedef struct pair {
    foot p, q;
    double value;
} pair;

/* A corner of the polygon of one row: its height and its place across the axis. */
typedef struct knot {
    double h, x[2];
    foot foot;
} knot;

/* What eval leaves for gradient. */
typedef struct found {
    pair best;
    double g[3], across[3]; /* across: d F / d axis */
    double stretch;         /* |g| */
} found;

enum {
    KNOT = (sizeof(knot) + sizeof(double) - 1) / sizeof(double),
    FOUND = sizeof(found) / sizeof(double) + 1
};

static bool is_cap(const ves_measure_input *input, int sample)
{
    return input->sample[sample]->site == VES_SITE_CAP;
}

static void counts(const ves_measure_input *input, size_t *knots, size_t *ring, size_t *rows)
{
    *knots = *ring = *rows = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != VES_SITE_SURFACE && s->site != VES_SITE_CAP) continue;
        *knots += s->site == VES_SITE_CAP ? 2 : (size_t)s->nu;
        if (s->site == VES_SITE_CAP && (size_t)s->count > *ring) *ring = (size_t)s->count;
        if (s->site == VES_SITE_SURFACE && (size_t)s->nv > *rows) *rows = (size_t)s->nv;
    }
}

/* room: what was found, the weights of a ring, the knots of a row, the best of each row. */
size_t ves_nest_room(const ves_measure_input *input)
{
    size_t knots, ring, rows;
    counts(input, &knots, &ring, &rows);
    return FOUND + 3 * ring + KNOT * knots + (sizeof(pair) / sizeof(double) + 1) * rows;
}

static frame frame_init(const double axis[3])
{
    frame f;
    int least = 0;
    double other[3] = {0};
    for (int c = 0; c < 3; c++) {
        f.a[c] = axis[c];
        if (fabs(axis[c]) < fabs(axis[least])) least = c;
    }
    other[least] = 1;
    ves_cross(axis, other, f.e[0]);
    double length = sqrt(ves_dot(f.e[0], f.e[0]));
    for (int c = 0; c < 3; c++) f.e[0][c] /= length;
    ves_cross(axis, f.e[0], f.e[1]);
    return f;
}

/* --- rows --- */

static double mean_height(const ves_measure_input *input, ves_site site, int only, const double axis[3])
{
    double sum = 0, count = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        if (s->site != site || (only >= 0 && i != only)) continue;
        for (int n = 0; n < s->count; n++, count++)
            sum += axis[0] * s->X[0][n] + axis[1] * s->X[1][n] + axis[2] * s->X[2][n];
    }
    return sum / count;
}

static void cap_middle(const ves_samples *s, double middle[3])
{
    for (int c = 0; c < 3; c++) {
        middle[c] = 0;
        for (int n = 0; n < s->count; n++) middle[c] += s->X[c][n] / s->count;
    }
}

static knot knot_init(const frame *f, const double X[3], foot at)
{
    return (knot){ves_dot(X, f->a), {ves_dot(X, f->e[0]), ves_dot(X, f->e[1])}, at};
}

/* Row j of every surface, and the spokes of closed ends that go to it. */
static int row_knots(const ves_measure_input *input, const frame *f, int j, double middle, knot *k)
{
    int count = 0;
    for (int i = 0; i < input->samples; i++) {
        const ves_samples *s = input->sample[i];
        bool cap = s->site == VES_SITE_CAP;
        if ((s->site != VES_SITE_SURFACE && !cap) || j >= s->nv) continue;
        if (cap && mean_height(input, VES_SITE_CAP, i, f->a) >= middle) continue;
        if (cap) {
            double X[3];
            cap_middle(s, X);
            k[count++] = knot_init(f, X, (foot){i, -1, j, 0, s->v[j], 0});
        }
        for (int n = j * s->nu; n < (j + 1) * s->nu; n++) {
            double X[3] = {s->X[0][n], s->X[1][n], s->X[2][n]};
            k[count++] = knot_init(f, X, (foot){i, n, n, cap ? 1 : s->u[n % s->nu], s->v[j], 0});
        }
    }
    return count;
}

/* The largest F of a knot with a segment; share: where on that. sign: 1, the segment has p; -1, q. -inf: they are
 * nowhere t apart. */
static double segment_top(const knot *k, const knot *from, const knot *to, double sign, double t,
                          double *share)
{
    double m = sign * (to->h - from->h), y = sign * (from->h - k->h), A = 0, b = 0, c = 0;
    for (int d = 0; d < 2; d++) {
        double way = to->x[d] - from->x[d], off = from->x[d] - k->x[d];
        A += way * way, b += way * off, c += off * off;
    }
    double lo = 0, hi = 1, best, root;
    if (A > 1e-24 * (m * m + t * t)) {
        double square = t * t - c + b * b / A;
        if (!(square >= 0)) return -HUGE_VAL;
        double reach = sqrt(square / A), mid = -b / A;
        best = mid + m * sqrt(square / (A * (A + m * m)));
        lo = fmax(lo, mid - reach), hi = fmin(hi, mid + reach);
        if (lo > hi) return -HUGE_VAL;
    } else {
        if (c > t * t) return -HUGE_VAL;
        best = m > 0;
    }
    *share = fmin(fmax(best, lo), hi);
    root = t * t - c - *share * (2 * b + *share * A);
    return y + *share * m + sqrt(fmax(root, 0));
}

static foot between(const knot *from, const knot *to, double share)
{
    foot f = from->foot;
    f.next = to->foot.node, f.share = share;
    f.u += share * (to->foot.u - f.u);
    return f;
}

static pair row_best(const knot *k, int count, double t)
{
    pair best = {.value = -HUGE_VAL};
    for (int n = 0; n + 1 < count; n++) {
        if (k[n].foot.sample != k[n + 1].foot.sample) continue;
        double top = fmax(k[n].h, k[n + 1].h), bottom = fmin(k[n].h, k[n + 1].h), share;
        for (int i = 0; i < count; i++) {
            if (top - k[i].h + t > best.value) {
                double value = segment_top(&k[i], &k[n], &k[n + 1], 1, t, &share);
                if (value > best.value) best = (pair){between(&k[n], &k[n + 1], share), k[i].foot, value};
            }
            if (k[i].h - bottom + t > best.value) {
                double value = segment_top(&k[i], &k[n], &k[n + 1], -1, t, &share);
                if (value > best.value) best = (pair){k[i].foot, between(&k[n], &k[n + 1], share), value};
            }
        }
    }
    return best;
}

/* --- the points go on --- */

/* X, Xu, Xv, Xuu, Xuv, Xvv. */
typedef double jet[6][3];

/* c + u (X(v) - c) */
static void cap_jet(const ves_measure_input *input, const foot *at, jet J)
{
    const ves_samples *s = input->sample[at->sample];
    double *weight = input->room + FOUND, c[3], X[3][3] = {{0}};
    cap_middle(s, c);
    ves_ring_weights(s, ves_ring_near(s, (ves_ring_point){0, at->v - s->v[0]}), weight);
    for (int d = 0; d < 3; d++)
        for (int k = 0; k < s->count; k++)
            for (int i = 0; i < 3; i++) X[d][i] += weight[d * s->count + k] * s->X[i][k];
    for (int i = 0; i < 3; i++) {
        J[0][i] = c[i] + at->u * (X[0][i] - c[i]);
        J[1][i] = X[0][i] - c[i], J[2][i] = at->u * X[1][i];
        J[3][i] = 0, J[4][i] = X[1][i], J[5][i] = at->u * X[2][i];
    }
}

/* Looks at a foot, which then is the middle of the look; false: there is no number. */
static bool foot_jet(const ves_measure_input *input, int number, foot *at, int *look, jet J)
{
    *look = at->sample;
    if (is_cap(input, at->sample)) {
        cap_jet(input, at, J);
        return true;
    }
    double v = ves_hill_wrap(input->sample[at->sample], at->v);
    const double x[3] = {at->u, at->u, at->u}, y[3] = {v, v, v};
    *look = input->look(input, at->sample, number, x, y);
    if (*look < 0) return false;
    const ves_samples *s = input->sample[*look];
    const double *const *plane[6] = {s->X, s->Xu, s->Xv, s->Xuu, s->Xuv, s->Xvv};
    for (int d = 0; d < 6; d++)
        for (int c = 0; c < 3; c++) J[d][c] = plane[d][c][4];
    return true;
}

/* Where the two points are, and l. z: u and v of p, u and v of q, l. */
typedef struct state {
    pair at;
    double l[2], t;
    int look[2];
    jet P, Q;
    double residual[UNKNOWNS], norm;
    bool held[UNKNOWNS]; /* at an end that it would leave */
} state;

static void normal_of(const frame *f, const double l[2], double g[3])
{
    for (int c = 0; c < 3; c++) g[c] = f->a[c] + l[0] * f->e[0][c] + l[1] * f->e[1][c];
}

/* d L / d z; false: it cannot be looked at. */
static bool state_look(const ves_measure_input *input, const frame *f, state *z)
{
    double g[3], *r = z->residual;
    if (!foot_jet(input, 0, &z->at.p, &z->look[0], z->P)) return false;
    if (!foot_jet(input, 1, &z->at.q, &z->look[1], z->Q)) return false;
    normal_of(f, z->l, g);
    double stretch = sqrt(ves_dot(g, g)), *at[4] = {&z->at.p.u, &z->at.p.v, &z->at.q.u, &z->at.q.v};
    for (int d = 0; d < 2; d++) {
        r[d] = ves_dot(g, z->P[1 + d]), r[2 + d] = -ves_dot(g, z->Q[1 + d]);
        r[4 + d] = z->t * z->l[d] / stretch;
        for (int c = 0; c < 3; c++) r[4 + d] += f->e[d][c] * (z->P[0][c] - z->Q[0][c]);
    }
    z->norm = 0;
    for (int k = 0; k < UNKNOWNS; k++) {
        bool around = k % 2 && input->sample[k < 2 ? z->at.p.sample : z->at.q.sample]->periodic;
        double end = k % 2 ? VES_TWO_PI : 1;
        z->held[k] = k < 4 && !around && ((*at[k] <= 0 && r[k] < 0) || (*at[k] >= end && r[k] > 0));
        if (!z->held[k]) z->norm += r[k] * r[k];
    }
    z->norm = sqrt(z->norm);
    return isfinite(z->norm);
}

/* Second derivatives of L, those of what is held left out; mu makes it steeper in the points. */
static void hessian(const frame *f, const state *z, double mu, double H[UNKNOWNS][UNKNOWNS])
{
    double g[3];
    normal_of(f, z->l, g);
    double stretch = sqrt(ves_dot(g, g));
    memset(H, 0, sizeof(double[UNKNOWNS][UNKNOWNS]));
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            H[i][j] = ves_dot(g, z->P[3 + i + j]), H[2 + i][2 + j] = -ves_dot(g, z->Q[3 + i + j]);
            H[i][4 + j] = H[4 + j][i] = ves_dot(f->e[j], z->P[1 + i]);
            H[2 + i][4 + j] = H[4 + j][2 + i] = -ves_dot(f->e[j], z->Q[1 + i]);
            H[4 + i][4 + j] = z->t / stretch * ((i == j) - z->l[i] * z->l[j] / (stretch * stretch));
        }
    for (int k = 0; k < 4; k++) {
        H[k][k] -= mu;
        for (int j = 0; j < UNKNOWNS && z->held[k]; j++) H[k][j] = H[j][k] = j == k ? -1 : 0;
    }
}

/* Gauss, with pivots; false: singular. x: the right side, then the solution. */
static bool solve(double A[UNKNOWNS][UNKNOWNS], double x[UNKNOWNS])
{
    for (int k = 0; k < UNKNOWNS; k++) {
        int pivot = k;
        for (int i = k + 1; i < UNKNOWNS; i++)
            if (fabs(A[i][k]) > fabs(A[pivot][k])) pivot = i;
        if (!(fabs(A[pivot][k]) > 0)) return false;
        for (int j = 0; j < UNKNOWNS; j++) {
            double keep = A[k][j];
            A[k][j] = A[pivot][j], A[pivot][j] = keep;
        }
        double keep = x[k];
        x[k] = x[pivot], x[pivot] = keep;
        for (int i = k + 1; i < UNKNOWNS; i++) {
            double share = A[i][k] / A[k][k];
            for (int j = k; j < UNKNOWNS; j++) A[i][j] -= share * A[k][j];
            x[i] -= share * x[k];
        }
    }
    for (int k = UNKNOWNS - 1; k >= 0; k--) {
        for (int j = k + 1; j < UNKNOWNS; j++) x[k] -= A[k][j] * x[j];
        x[k] /= A[k][k];
    }
    return true;
}

static void foot_move(const ves_measure_input *input, foot *at, double u, double v)
{
    at->u = fmin(fmax(at->u + u, 0), 1), at->v += v;
    if (!input->sample[at->sample]->periodic) at->v = fmin(fmax(at->v, 0), VES_TWO_PI);
}

/* One step of Newton's, no farther than a tenth of a patch, on steeper ground until what is left of the slopes falls;
 * false: it does not. */
static bool step(const ves_measure_input *input, const frame *f, double least, double *mu, state *z)
{
    for (int k = 0; k < TRIES; k++, *mu *= 10) {
        double H[UNKNOWNS][UNKNOWNS], x[UNKNOWNS], longest = 0;
        hessian(f, z, *mu, H);
        for (int i = 0; i < UNKNOWNS; i++) x[i] = z->held[i] ? 0 : -z->residual[i];
        if (!solve(H, x)) continue;
        for (int i = 0; i < 4; i++) longest = fmax(longest, fabs(x[i]) / (i % 2 ? VES_TWO_PI : 1));
        double scale = longest > 0.1 ? 0.1 / longest : 1;
        state next = *z;
        foot_move(input, &next.at.p, scale * x[0], scale * x[1]);
        foot_move(input, &next.at.q, scale * x[2], scale * x[3]);
        for (int d = 0; d < 2; d++) next.l[d] += scale * x[4 + d];
        if (!state_look(input, f, &next)) continue;
        bool changed = memcmp(next.held, z->held, sizeof z->held) != 0;
        if (!(next.norm < z->norm) && !changed) continue;
        *z = next;
        *mu = fmax(*mu / 100, least);
        return true;
    }
    return false;
}

/* F at two points: l is what makes L least. Farther apart than t, L as it is. */
static double height(const frame *f, state *z)
{
    double d[3], s[2], g[3];
    for (int c = 0; c < 3; c++) d[c] = z->P[0][c] - z->Q[0][c];
    for (int k = 0; k < 2; k++) s[k] = ves_dot(d, f->e[k]);
    double square = z->t * z->t - s[0] * s[0] - s[1] * s[1];
    if (square > 1e-12 * z->t * z->t)
        for (int k = 0; k < 2; k++) z->l[k] = -s[k] / sqrt(square);
    normal_of(f, z->l, g);
    return ves_dot(g, d) + z->t * sqrt(ves_dot(g, g));
}

/* Of what a foot of the polygons promises; the look rests on it when it returns. */
static bool climb(const ves_measure_input *input, const frame *f, pair from, double t, state *z)
{
    *z = (state){.at = from, .t = t};
    if (!state_look(input, f, z)) return false;
    height(f, z);
    if (!state_look(input, f, z)) return false;
    double size = 0;
    for (int d = 1; d < 3; d++) size += sqrt(ves_dot(z->P[d], z->P[d])) + sqrt(ves_dot(z->Q[d], z->Q[d]));
    double least = 1e-9 * size, mu = least;
    for (int k = 0; k < STEPS && z->norm > 1e-13 * size; k++)
        if (!step(input, f, least, &mu, z)) break;
    if (!state_look(input, f, z)) return false;
    z->at.value = height(f, z);
    return isfinite(z->at.value);
}

/* --- all of it --- */

/* Where p and q are one point. */
static void touch(const frame *f, double t, found *to)
{
    *to = (found){.stretch = 1};
    to->best.p.sample = to->best.q.sample = -1;
    to->best.value = t;
    memcpy(to->g, f->a, sizeof to->g);
}

/* g, and d F / d axis = d (1 + d . axis / root), root = t / |g|. */
static void settle(const frame *f, const pair *at, const double d[3], const double l[2], double t, found *to)
{
    to->best = *at;
    normal_of(f, l, to->g);
    to->stretch = sqrt(ves_dot(to->g, to->g));
    for (int c = 0; c < 3; c++) to->across[c] = d[c] * (1 + ves_dot(d, f->a) * to->stretch / t);
}

static void place_of(const ves_measure_input *input, const foot *at, double X[3])
{
    const ves_samples *s = input->sample[at->sample];
    double middle[3];
    if (is_cap(input, at->sample)) cap_middle(s, middle);
    for (int c = 0; c < 3; c++) {
        double from = at->node < 0 ? middle[c] : s->X[c][at->node],
               to = at->next < 0 ? from : s->X[c][at->next];
        X[c] = from + at->share * (to - from);
    }
}

/* Without looks: what the polygons promise. */
static void promise(const ves_measure_input *input, const frame *f, const pair *best, double t, found *to)
{
    double P[3], Q[3], d[3], l[2], square = t * t;
    place_of(input, &best->p, P), place_of(input, &best->q, Q);
    for (int c = 0; c < 3; c++) d[c] = P[c] - Q[c];
    for (int k = 0; k < 2; k++) l[k] = -ves_dot(d, f->e[k]), square -= l[k] * l[k];
    for (int k = 0; k < 2; k++) l[k] /= sqrt(fmax(square, 1e-12 * t * t));
    settle(f, best, d, l, t, to);
}

/* The rows that are best among their neighbours, best first. */
static int starts(const pair *row, int rows, int start[STARTS])
{
    int count = 0;
    for (int j = 0; j < rows; j++) {
        double before = row[(j + rows - 1) % rows].value, after = row[(j + 1) % rows].value;
        double level = 1e-13 * fabs(row[j].value);
        if (!(row[j].value > -HUGE_VAL) || row[j].value < after - level) continue;
        if (row[j].value <= before + level && j > 0) continue;
        int at = count < STARTS ? count++ : STARTS - 1;
        if (at == STARTS - 1 && count == STARTS && start[at] >= 0 && row[start[at]].value >= row[j].value)
            continue;
        start[at] = j;
        for (; at > 0 && row[start[at]].value > row[start[at - 1]].value; at--) {
            int keep = start[at];
            start[at] = start[at - 1], start[at - 1] = keep;
        }
    }
    return count;
}

static ves_status search(const ves_measure_input *input, const frame *f, double t, found *to)
{
    size_t knots, ring, rows;
    counts(input, &knots, &ring, &rows);
    knot *k = (knot *)(void *)(input->room + FOUND + 3 * ring);
    pair *row = (pair *)(void *)(input->room + FOUND + 3 * ring + KNOT * knots);
    double middle = mean_height(input, VES_SITE_SURFACE, -1, f->a);
    int start[STARTS] = {-1, -1, -1, -1};
    if (!isfinite(middle)) return VES_NO_NUMBER;
    for (int j = 0; j < (int)rows; j++) row[j] = row_best(k, row_knots(input, f, j, middle, k), t);
    int count = starts(row, (int)rows, start);
    touch(f, t, to);
    state best = {.at.value = -HUGE_VAL}, z;
    for (int n = 0; n < count; n++) {
        if (!input->look && row[start[n]].value > to->best.value) promise(input, f, &row[start[n]], t, to);
        if (input->look && climb(input, f, row[start[n]], t, &z) && z.at.value > best.at.value) best = z;
    }
    if (!(best.at.value > to->best.value) || !state_look(input, f, &best)) return VES_OK;
    double d[3];
    for (int c = 0; c < 3; c++) d[c] = best.P[0][c] - best.Q[0][c];
    foot *at[2] = {&best.at.p, &best.at.q};
    for (int n = 0; n < 2; n++)
        if (!is_cap(input, at[n]->sample)) *at[n] = (foot){best.look[n], 4, 4, 0, 0, 0};
    settle(f, &best.at, d, best.l, t, to);
    return VES_OK;
}

ves_status ves_nest_eval(const ves_measure_input *input, const double axis[3], double thickness,
                         double *pitch)
{
    found to;
    frame f = frame_init(axis);
    VES_TRY(search(input, &f, thickness, &to));
    memcpy(input->room, &to, sizeof to);
    *pitch = to.best.value;
    return VES_OK;
}

static void scatter(const ves_measure_input *input, const foot *at, const double back[3],
                    const ves_adjoint *const *adjoint)
{
    if (at->sample < 0 || !adjoint[at->sample]->X[0]) return;
    const ves_samples *s = input->sample[at->sample];
    double *const *X = adjoint[at->sample]->X;
    if (!is_cap(input, at->sample)) {
        for (int c = 0; c < 3; c++) {
            X[c][at->node] += (1 - at->share) * back[c];
            X[c][at->next] += at->share * back[c];
        }
        return;
    }
    double *weight = input->room + FOUND;
    ves_ring_weights(s, ves_ring_near(s, (ves_ring_point){0, at->v - s->v[0]}), weight);
    for (int k = 0; k < s->count; k++)
        for (int c = 0; c < 3; c++) X[c][k] += (at->u * weight[k] + (1 - at->u) / s->count) * back[c];
}

double ves_nest_gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                         double axis_back[3])
{
    found to;
    double back[2][3];
    memcpy(&to, input->room, sizeof to);
    for (int c = 0; c < 3; c++) {
        back[0][c] = seed * to.g[c], back[1][c] = -seed * to.g[c];
        axis_back[c] += seed * to.across[c];
    }
    scatter(input, &to.best.p, back[0], adjoint);
    scatter(input, &to.best.q, back[1], adjoint);
    return seed * to.stretch;
}

#include "surface/exact.h"

#include <string.h>

#include "surface/basis.h"

enum { K = VES_CONDITIONS_MAX, BLOCKS = K / VES_LANES, LANES = VES_LANES, STEPS = 30 };

_Static_assert(K % VES_LANES == 0, "rows are whole registers");

/* --- bases --- */

/* Times N: centred below, decaying above. Between NEAR and FAR that depends on the conditions where N > CLEAR
 * (Navier's want the decaying basis, functions inside the centred one): the better conditioned is taken. Up to
 * CLEAR either is good for 1e-15 here [measured: tests/weights_oracle.c]. */
static const double SWITCH = 1.15, NEAR = 0.3, FAR = 2;
enum { CLEAR = 16 };

/* Roots of a general operator may be of different sizes. Those near 0 want the centred basis, which bears large
 * ones up to SPREAD; where that is not enough either, fewer than 12 digits are left when a pivot of the
 * equilibrated matrix is below WEAK. */
static const double SPREAD = 80, WEAK = 1e-20;

double ves_mode_size(const ves_mode *mode)
{
    return mode->n * mode->factor->rate;
}

static void mode_init(const ves_factor *factor, double n, int orders, bool slopes, ves_mode *mode)
{
    const ves_operator *op = factor->op;
    mode->op = op, mode->factor = factor, mode->n = n, mode->orders = orders, mode->slopes = slopes;
    mode->centred = ves_mode_size(mode) <= SWITCH * op->power + (op->general ? 4 : 0);
    if (mode->centred) ves_mode_center(mode);
}

static void basis_eval(const ves_mode *mode, ves_lanes u, const ves_basis *basis)
{
    if (mode->centred)
        ves_basis_centred(mode, u, basis);
    else if (mode->op->general)
        ves_basis_split(mode, u, basis);
    else
        ves_basis_decaying(mode, u, basis);
}

/* --- the condition matrix --- */

/* a x = f: conditions j, members m. Scaled by powers of 2, then factored as L U with rows exchanged. */
typedef struct conditions {
    int n, parameters;
    ves_twos (*a)[BLOCKS];
    ves_two (*slope)[K][K]; /* [parameters]: the derivative of the scaled matrix */
    double row[K], column[K], size[K];
    ves_two inverse[K]; /* of the pivots */
    int origin[K];      /* which condition stands in this row now */
} conditions;

typedef struct work {
    conditions s;
    ves_basis basis;
    ves_twos *x, *y; /* [K] eight right sides */
} work;

static int highest(const ves_layout *layout)
{
    int most = 0;
    for (int j = 0; j < 2 * layout->power; j++)
        if (layout->knot[j].derivative > most) most = layout->knot[j].derivative;
    return most;
}

static int orders_of(const ves_layout *layout, int orders)
{
    int most = highest(layout) + 1;
    return most > orders ? most : orders;
}

static int parameters_most(const ves_layout *layout)
{
    return layout->power <= VES_GENERAL_MAX ? layout->power + 1 : 1;
}

enum { REGISTER = sizeof(ves_twos) / sizeof(double) };

long ves_exact_room(const ves_layout *layout, int orders)
{
    int n = 2 * layout->power, parameters = parameters_most(layout);
    long basis = (long)(1 + parameters) * n * orders_of(layout, orders);
    return (K * BLOCKS + basis + VES_SERIES + 2L * K) * REGISTER + 2L * parameters * K * K;
}

static double *take(double **room, long count)
{
    double *here = *room;
    *room += count;
    return here;
}

static void work_init(const ves_layout *layout, const ves_operator *op, int orders, bool slopes, double *room,
                      work *w)
{
    int n = 2 * layout->power, parameters = ves_operator_parameters(op);
    long basis = (long)n * orders_of(layout, orders) * REGISTER;
    w->s.n = n;
    w->s.parameters = slopes ? parameters : 0;
    w->s.a = (ves_twos(*)[BLOCKS])take(&room, K * BLOCKS * REGISTER);
    w->basis.value = (ves_twos *)take(&room, basis);
    w->basis.slope = slopes ? (ves_twos *)take(&room, basis * parameters) : NULL;
    w->basis.power = (ves_twos *)take(&room, VES_SERIES * REGISTER);
    w->x = (ves_twos *)take(&room, K * REGISTER);
    w->y = (ves_twos *)take(&room, K * REGISTER);
    w->s.slope = (ves_two(*)[K][K])room;
}

static ves_two entry(const conditions *s, int j, int m)
{
    return ves_twos_lane(&s->a[j][m / LANES], m % LANES);
}

/* 2^-k with x 2^-k in [1/2, 1); 0 where x is 0 or no number. */
static double unit_of(double x)
{
    int k;
    if (!(x > 0 && isfinite(x))) return 0;
    frexp(x, &k);
    return ldexp(1, -k);
}

/* Of what size member m is on [0, 1]: as large as its values at the knots; those of a decaying basis, whose
 * members are largest between, as its derivatives there in units of the rate. */
static void member_size(const ves_mode *mode, const ves_basis *basis, int m, double *size)
{
    double rate = ves_mode_size(mode), unit = 1;
    for (int d = 0; d < (mode->centred ? 1 : basis->orders); d++, unit /= rate)
        for (int i = 0; i < LANES; i++)
            *size = fmax(*size, unit * fabs(basis->value[m * basis->orders + d].hi[i]));
}

/* Condition j applied to each member. */
static void matrix_fill(const ves_layout *layout, const ves_mode *mode, work *w)
{
    conditions *s = &w->s;
    int n = s->n, orders = w->basis.orders = highest(layout) + 1;
    memset(s->a, 0, sizeof *s->a * (size_t)n);
    for (int m = 0; m < K; m++) s->size[m] = 0;
    for (int first = 0; first < n; first += LANES) {
        ves_lanes u;
        for (int i = 0; i < LANES; i++) u[i] = layout->knot[first + i < n ? first + i : n - 1].u;
        basis_eval(mode, u, &w->basis);
        for (int m = 0; m < n; m++) {
            member_size(mode, &w->basis, m, &s->size[m]);
            for (int j = first; j < n && j < first + LANES; j++) {
                int at = m * orders + layout->knot[j].derivative;
                ves_twos_put(&s->a[j][m / LANES], m % LANES, ves_twos_lane(&w->basis.value[at], j - first));
                for (int p = 0; p < s->parameters; p++)
                    s->slope[p][j][m] = ves_twos_lane(&w->basis.slope[p * n * orders + at], j - first);
            }
        }
    }
}

/* Columns times by[]. */
static void scale_columns(conditions *s, const double by[K])
{
    for (int m = 0; m < s->n; m++) s->column[m] *= by[m];
    for (int j = 0; j < s->n; j++)
        for (int b = 0; b < BLOCKS; b++) {
            ves_lanes unit = ves_lanes_at(by + b * LANES);
            s->a[j][b].hi *= unit, s->a[j][b].lo *= unit;
        }
}

static bool scale_rows(conditions *s)
{
    for (int j = 0; j < s->n; j++) {
        double largest = 0;
        for (int m = 0; m < s->n; m++) largest = fmax(largest, fabs(entry(s, j, m).hi));
        if ((s->row[j] = unit_of(largest)) == 0) return false;
        for (int b = 0; b < BLOCKS; b++) s->a[j][b] = ves_twos_shift(s->a[j][b], s->row[j]);
    }
    return true;
}

/* First every member is made one of size 1, then every condition: the cardinal function of a high derivative
 * is tiny (at order 40 that of the 19th 1e-29), and its digits are lost beside those of the positions unless
 * the unknowns are of one size. Then each column gets an entry near 1. false: a row or a column is zero. */
static bool equilibrate(conditions *s)
{
    double by[K] = {0};
    int n = s->n;
    for (int m = 0; m < n; m++) s->column[m] = 1, by[m] = s->size[m] > 0 ? unit_of(s->size[m]) : 1;
    scale_columns(s, by);
    if (!scale_rows(s)) return false;
    for (int m = 0; m < n; m++) {
        double largest = 0;
        for (int j = 0; j < n; j++) largest = fmax(largest, fabs(entry(s, j, m).hi));
        if ((by[m] = unit_of(largest)) == 0) return false;
    }
    scale_columns(s, by);
    for (int p = 0; p < s->parameters; p++)
        for (int j = 0; j < n; j++)
            for (int m = 0; m < n; m++) {
                ves_two *d = &s->slope[p][j][m];
                *d = (ves_two){d->hi * s->row[j] * s->column[m], d->lo * s->row[j] * s->column[m]};
            }
    return true;
}

/* Gaussian elimination with partial pivoting; the factors of L stay below the diagonal. */
static bool eliminate(conditions *s)
{
    int n = s->n;
    for (int j = 0; j < n; j++) s->origin[j] = j;
    for (int p = 0; p < n; p++) {
        int best = p;
        for (int r = p + 1; r < n; r++)
            if (fabs(entry(s, r, p).hi) > fabs(entry(s, best, p).hi)) best = r;
        ves_two pivot = entry(s, best, p);
        if (!(fabs(pivot.hi) > 0) || !isfinite(pivot.hi)) return false;
        for (int b = 0; b < BLOCKS; b++) {
            ves_twos x = s->a[p][b];
            s->a[p][b] = s->a[best][b], s->a[best][b] = x;
        }
        s->inverse[p] = ves_two_divide(ves_two_of(1), pivot);
        int origin = s->origin[p];
        s->origin[p] = s->origin[best], s->origin[best] = origin;
        for (int r = p + 1; r < n; r++) {
            ves_two f = ves_two_multiply(entry(s, r, p), s->inverse[p]);
            ves_twos kept = s->a[r][p / LANES]; /* factors of L left of the pivot are not to be changed */
            for (int b = p / LANES; b < (n + LANES - 1) / LANES; b++)
                s->a[r][b] = ves_twos_subtract(s->a[r][b], ves_twos_times(s->a[p][b], f));
            for (int c = 0; c < p % LANES; c++) ves_twos_put(&s->a[r][p / LANES], c, ves_twos_lane(&kept, c));
            ves_twos_put(&s->a[r][p / LANES], p % LANES, f);
        }
    }
    return true;
}

/* x - sum over i in [from, to) of x_i a_im */
static ves_twos eliminated(const conditions *s, const ves_twos *x, int m, int from, int to)
{
    ves_twos sum = ves_twos_negative(x[m]);
    for (int i = from; i < to; i++) sum = ves_twos_gather(sum, x[i], ves_twos_of(entry(s, i, m)));
    return ves_twos_sum(-sum.hi, -sum.lo);
}

/* w a = x for eight rows x, which are overwritten; w[condition]. */
static void solve(const conditions *s, ves_twos *x, ves_twos *w)
{
    int n = s->n;
    for (int m = 0; m < n; m++) /* y U = x */
        x[m] = ves_twos_times(eliminated(s, x, m, 0, m), s->inverse[m]);
    for (int m = n - 2; m >= 0; m--) x[m] = eliminated(s, x, m, m + 1, n); /* z L = y */
    for (int m = 0; m < n; m++) w[s->origin[m]] = x[m];
}

/* --- which basis --- */

/* The condition number of the matrix in the best scaling of rows and columns that there is: the spectral radius
 * of |a| |a^-1| [Bauer 1963], by the power method. inverse: [member][condition]. */
static double condition_of(int n, double (*a)[K], double (*inverse)[K])
{
    double x[K], y[K], radius = 0;
    for (int j = 0; j < n; j++) x[j] = 1;
    for (int step = 0; step < STEPS; step++) {
        for (int m = 0; m < n; m++) {
            y[m] = 0;
            for (int j = 0; j < n; j++) y[m] += inverse[m][j] * x[j];
        }
        radius = 0;
        for (int j = 0; j < n; j++) {
            x[j] = 0;
            for (int m = 0; m < n; m++) x[j] += a[j][m] * y[m];
            radius = fmax(radius, x[j]);
        }
        for (int j = 0; j < n; j++) x[j] /= radius;
    }
    return radius;
}

/* Of the matrix that is filled; factors it. */
static ves_status condition_find(work *w, double *condition)
{
    double a[K][K], inverse[K][K];
    int n = w->s.n;
    *condition = HUGE_VAL;
    if (!equilibrate(&w->s)) return VES_UNDETERMINED;
    for (int j = 0; j < n; j++)
        for (int m = 0; m < n; m++) a[j][m] = fabs(entry(&w->s, j, m).hi);
    if (!eliminate(&w->s)) return VES_UNDETERMINED;
    for (int first = 0; first < n; first += LANES) {
        for (int m = 0; m < n; m++) {
            w->x[m] = (ves_twos){{0}, {0}};
            if (m >= first && m < first + LANES) w->x[m].hi[m - first] = 1;
        }
        solve(&w->s, w->x, w->y);
        for (int j = 0; j < n; j++)
            for (int i = 0; i < LANES && first + i < n; i++) inverse[first + i][j] = fabs(w->y[j].hi[i]);
    }
    *condition = condition_of(n, a, inverse);
    return isfinite(*condition) ? VES_OK : VES_UNDETERMINED;
}

/* About the slowest root of mode n: 1 / sum of 1 / |r|. */
static double slowest(const ves_mode *mode)
{
    const ves_factor *f = mode->factor;
    double sum = f->power > 1 ? f->q[1].hi : 1;
    return fabs(f->q[0].hi / sum) * ves_mode_size(mode);
}

/* May either basis be the better one? */
static bool open(const ves_mode *mode)
{
    double size = ves_mode_size(mode), N = mode->op->power;
    if (mode->op->general) return !mode->centred && size <= SPREAD && slowest(mode) < 1;
    return mode->op->power > CLEAR && size >= NEAR * N && size <= FAR * N;
}

/* Where both are possible, the basis with the smaller condition. */
static void choose(const ves_layout *layout, ves_mode *mode, const work *w)
{
    double condition[2];
    if (!open(mode)) return;
    work trial = *w;
    trial.s.parameters = 0, trial.basis.slope = NULL;
    for (int centred = 0; centred < 2; centred++) {
        mode->centred = centred;
        if (centred) ves_mode_center(mode);
        matrix_fill(layout, mode, &trial);
        condition_find(&trial, &condition[centred]);
    }
    mode->centred = condition[1] <= condition[0];
}

/* --- weights --- */

/* Eight places of one table row; false: some number is not finite. */
static bool put(const conditions *s, const ves_twos *w, const ves_exact_out *out, int d, int nu, int block,
                double *to)
{
    bool good = true;
    for (int j = out->first; j < out->first + out->count; j++)
        for (int i = 0; i < LANES && block + i < nu; i++) {
            double x = w[j].hi[i] * s->row[j];
            good = good && isfinite(x);
            to[(d * out->columns + j) * nu + block + i] = x;
        }
    return good;
}

/* dw a = dx - w da */
static void slope_side(const work *w, int p, int d, ves_twos *x)
{
    const conditions *s = &w->s;
    int n = s->n, orders = w->basis.orders;
    for (int m = 0; m < n; m++) {
        x[m] = ves_twos_shift(w->basis.slope[(p * n + m) * orders + d], s->column[m]);
        ves_twos sum = ves_twos_negative(x[m]);
        for (int j = 0; j < n; j++) sum = ves_twos_gather(sum, w->y[j], ves_twos_of(s->slope[p][j][m]));
        x[m] = ves_twos_sum(-sum.hi, -sum.lo);
    }
}

static bool block_make(const ves_mode *mode, work *w, int nu, const double *u, int block,
                       const ves_exact_out *out)
{
    const conditions *s = &w->s;
    bool good = true;
    ves_lanes place;
    for (int i = 0; i < LANES; i++) place[i] = u[block + i < nu ? block + i : nu - 1];
    w->basis.orders = out->orders;
    basis_eval(mode, place, &w->basis);
    for (int d = 0; d < out->orders; d++) {
        for (int m = 0; m < s->n; m++)
            w->x[m] = ves_twos_shift(w->basis.value[m * out->orders + d], s->column[m]);
        solve(s, w->x, w->y);
        good = put(s, w->y, out, d, nu, block, out->weight) && good;
        for (int p = 0; p < s->parameters; p++) {
            ves_twos other[K];
            slope_side(w, p, d, w->x);
            solve(s, w->x, other);
            good = put(s, other, out, d, nu, block, out->slope + (size_t)p * out->stride) && good;
        }
    }
    return good;
}

static bool weak(const conditions *s)
{
    for (int p = 0; p < s->n; p++)
        if (fabs(entry(s, p, p).hi) < WEAK) return true;
    return false;
}

static void clear(const ves_operator *op, int nu, const ves_exact_out *out)
{
    int parameters = out->slope ? ves_operator_parameters(op) : 0;
    for (int d = 0; d < out->orders; d++)
        for (int j = out->first; j < out->first + out->count; j++) {
            size_t at = (size_t)((d * out->columns + j) * nu);
            memset(out->weight + at, 0, sizeof(double) * (size_t)nu);
            for (int p = 0; p < parameters; p++)
                memset(out->slope + (size_t)p * out->stride + at, 0, sizeof(double) * (size_t)nu);
        }
}

ves_status ves_exact_mode(const ves_layout *layout, const ves_factor *factor, double n, int nu,
                          const double *u, const ves_exact_out *out, double *room)
{
    const ves_operator *op = factor->op;
    ves_mode mode;
    work w;
    bool slopes = out->slope;
    mode_init(factor, n, orders_of(layout, out->orders), slopes, &mode);
    work_init(layout, op, out->orders, slopes, room, &w);
    choose(layout, &mode, &w);
    matrix_fill(layout, &mode, &w);
    bool good = equilibrate(&w.s) && eliminate(&w.s) && !(op->general && weak(&w.s));
    for (int block = 0; block < nu && good; block += LANES) good = block_make(&mode, &w, nu, u, block, out);
    if (!good) clear(op, nu, out);
    return good ? VES_OK : VES_UNDETERMINED;
}

ves_status ves_exact_condition(const ves_layout *layout, const ves_factor *factor, double n,
                               double *condition, double *room)
{
    ves_mode mode;
    work w;
    mode_init(factor, n, orders_of(layout, 1), false, &mode);
    work_init(layout, factor->op, 1, false, room, &w);
    choose(layout, &mode, &w);
    matrix_fill(layout, &mode, &w);
    return condition_find(&w, condition);
}

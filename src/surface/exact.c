#include "surface/exact.h"

#include <string.h>

#include "surface/basis.h"

enum { K = VES_CONDITIONS_MAX, BLOCKS = K / VES_LANES, LANES = VES_LANES };

_Static_assert(K % VES_LANES == 0, "rows are whole registers");

/* --- bases --- */

static const double SWITCH = 1.15; /* times N: below, centred; measured for N = 20, where both lose most */

void ves_mode_init(const ves_operator *op, double n, bool slopes, ves_mode *mode)
{
    *mode = (ves_mode){.op = op, .n = n};
    if (op->general) ves_factor_make(op, slopes, &mode->factor);
    /* roots of a general operator may be of different sizes: those near 0 want the centred one too */
    double size = n * (op->general ? mode->factor.rate : op->parameter[0]);
    mode->centred = size <= SWITCH * op->power + (op->general ? 4 : 0);
}

void ves_basis_eval(const ves_mode *mode, ves_lanes u, const ves_basis *basis)
{
    if (mode->centred)
        ves_basis_centred(mode, u, basis);
    else if (mode->op->general)
        ves_basis_split(mode, u, basis);
    else
        ves_basis_decaying(mode, u, basis);
}

/* --- the condition matrix --- */

/* a x = f: conditions j, members m. Scaled by powers of 2 so that each row and each column has an entry near
 * 1; then factored as L U with rows exchanged. */
typedef struct conditions {
    int n, parameters;
    ves_twos (*a)[BLOCKS];
    ves_two (*slope)[K][K]; /* [parameters]: the derivative of the scaled matrix */
    double row[K], column[K];
    int origin[K]; /* which condition stands in this row now */
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

/* Condition j applied to each member. */
static void matrix_fill(const ves_layout *layout, const ves_mode *mode, work *w)
{
    conditions *s = &w->s;
    int n = s->n, orders = w->basis.orders = highest(layout) + 1;
    for (int j = 0; j < n; j++)
        for (int b = 0; b < BLOCKS; b++) s->a[j][b] = (ves_twos){{0}, {0}};
    for (int first = 0; first < n; first += LANES) {
        ves_lanes u;
        for (int i = 0; i < LANES; i++) u[i] = layout->knot[first + i < n ? first + i : n - 1].u;
        ves_basis_eval(mode, u, &w->basis);
        for (int j = first; j < n && j < first + LANES; j++)
            for (int m = 0; m < n; m++) {
                int at = m * orders + layout->knot[j].derivative;
                ves_twos_put(&s->a[j][m / LANES], m % LANES, ves_twos_lane(&w->basis.value[at], j - first));
                for (int p = 0; p < s->parameters; p++)
                    s->slope[p][j][m] = ves_twos_lane(&w->basis.slope[p * n * orders + at], j - first);
            }
    }
}

/* 2^-k with x 2^-k in [1/2, 1); 0 where x is 0 or no number. */
static double unit_of(double x)
{
    int k;
    if (!(x > 0 && isfinite(x))) return 0;
    frexp(x, &k);
    return ldexp(1, -k);
}

/* false: a row or a column is zero. */
static bool equilibrate(conditions *s)
{
    int n = s->n;
    for (int j = 0; j < n; j++) {
        double largest = 0;
        for (int m = 0; m < n; m++) largest = fmax(largest, fabs(entry(s, j, m).hi));
        if ((s->row[j] = unit_of(largest)) == 0) return false;
        for (int b = 0; b < BLOCKS; b++) s->a[j][b] = ves_twos_shift(s->a[j][b], s->row[j]);
    }
    for (int m = 0; m < n; m++) {
        double largest = 0;
        for (int j = 0; j < n; j++) largest = fmax(largest, fabs(entry(s, j, m).hi));
        if ((s->column[m] = unit_of(largest)) == 0) return false;
    }
    for (int j = 0; j < n; j++)
        for (int m = 0; m < n; m++) {
            ves_two x = entry(s, j, m);
            double by = s->column[m];
            ves_twos_put(&s->a[j][m / LANES], m % LANES, (ves_two){x.hi * by, x.lo * by});
            for (int p = 0; p < s->parameters; p++) {
                ves_two *d = &s->slope[p][j][m];
                *d = (ves_two){d->hi * s->row[j] * by, d->lo * s->row[j] * by};
            }
        }
    return true;
}

/* Gaussian elimination with partial pivoting; the factors of L stay below the diagonal. */
static bool factor(conditions *s)
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
        int origin = s->origin[p];
        s->origin[p] = s->origin[best], s->origin[best] = origin;
        for (int r = p + 1; r < n; r++) {
            ves_two f = ves_two_divide(entry(s, r, p), pivot);
            ves_twos kept = s->a[r][p / LANES]; /* factors of L left of the pivot are not to be changed */
            for (int b = p / LANES; b < (n + LANES - 1) / LANES; b++)
                s->a[r][b] = ves_twos_subtract(s->a[r][b], ves_twos_times(s->a[p][b], f));
            for (int c = 0; c < p % LANES; c++) ves_twos_put(&s->a[r][p / LANES], c, ves_twos_lane(&kept, c));
            ves_twos_put(&s->a[r][p / LANES], p % LANES, f);
        }
    }
    return true;
}

/* w a = x for eight rows x, which are overwritten; w[condition]. */
static void solve(const conditions *s, ves_twos *x, ves_twos *w)
{
    int n = s->n;
    for (int m = 0; m < n; m++) { /* y U = x */
        for (int i = 0; i < m; i++) x[m] = ves_twos_subtract(x[m], ves_twos_times(x[i], entry(s, i, m)));
        x[m] = ves_twos_times(x[m], ves_two_divide(ves_two_of(1), entry(s, m, m)));
    }
    for (int m = n - 2; m >= 0; m--) /* z L = y */
        for (int i = m + 1; i < n; i++) x[m] = ves_twos_subtract(x[m], ves_twos_times(x[i], entry(s, i, m)));
    for (int m = 0; m < n; m++) w[s->origin[m]] = x[m];
}

static ves_status prepare(const ves_layout *layout, const ves_mode *mode, work *w)
{
    matrix_fill(layout, mode, w);
    return equilibrate(&w->s) && factor(&w->s) ? VES_OK : VES_UNDETERMINED;
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
        for (int j = 0; j < n; j++)
            x[m] = ves_twos_subtract(x[m], ves_twos_times(w->y[j], s->slope[p][j][m]));
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
    ves_basis_eval(mode, place, &w->basis);
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

ves_status ves_exact_mode(const ves_layout *layout, const ves_operator *op, double n, int nu, const double *u,
                          const ves_exact_out *out, double *room)
{
    ves_mode mode;
    work w;
    bool slopes = out->slope;
    ves_mode_init(op, n, slopes, &mode);
    work_init(layout, op, out->orders, slopes, room, &w);
    bool good = prepare(layout, &mode, &w) == VES_OK;
    for (int block = 0; block < nu && good; block += LANES) good = block_make(&mode, &w, nu, u, block, out);
    if (!good) clear(op, nu, out);
    return good ? VES_OK : VES_UNDETERMINED;
}

ves_status ves_exact_condition(const ves_layout *layout, const ves_operator *op, double n, double *condition,
                               double *room)
{
    ves_mode mode;
    work w;
    double norm = 0, inverse = 0;
    ves_mode_init(op, n, false, &mode);
    work_init(layout, op, 1, false, room, &w);
    matrix_fill(layout, &mode, &w);
    *condition = HUGE_VAL;
    if (!equilibrate(&w.s)) return VES_UNDETERMINED;
    for (int j = 0; j < w.s.n; j++) {
        double sum = 0;
        for (int m = 0; m < w.s.n; m++) sum += fabs(entry(&w.s, j, m).hi);
        norm = fmax(norm, sum);
    }
    if (!factor(&w.s)) return VES_UNDETERMINED;
    for (int first = 0; first < w.s.n; first += LANES) {
        for (int m = 0; m < w.s.n; m++) {
            w.x[m] = (ves_twos){{0}, {0}};
            if (m >= first && m < first + LANES) w.x[m].hi[m - first] = 1;
        }
        solve(&w.s, w.x, w.y);
        for (int i = 0; i < LANES; i++) {
            double sum = 0;
            for (int j = 0; j < w.s.n; j++) sum += fabs(w.y[j].hi[i]);
            inverse = fmax(inverse, sum);
        }
    }
    *condition = norm * inverse;
    return VES_OK;
}

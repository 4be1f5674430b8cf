#include "surface/basis.h"

/* E = e^(x A), A the companion matrix of Q, by Taylor's series at x / 2^s and s squarings [Moler, Van Loan 2003];
 * with the derivatives by each parameter. Its last column is g, g', ... , g^(N-1). */
enum { G = VES_GENERAL_MAX, TERMS = 18, DERIVATIVES = G + 2 * VES_CONDITIONS_MAX };

typedef struct square {
    ves_twos e[G][G];
} square;

static void multiply(int N, const square *a, const square *b, square *out)
{
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            ves_twos sum = ves_twos_multiply(a->e[i][0], b->e[0][j]);
            for (int k = 1; k < N; k++) sum = ves_twos_add(sum, ves_twos_multiply(a->e[i][k], b->e[k][j]));
            out->e[i][j] = sum;
        }
}

static void add(int N, const square *a, const square *b, square *out)
{
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) out->e[i][j] = ves_twos_add(a->e[i][j], b->e[i][j]);
}

/* out = -sum_k q_k row_k, added to out */
static void last_row(int N, const ves_two *q, const square *r, ves_twos *out)
{
    for (int j = 0; j < N; j++)
        for (int k = 0; k < N; k++) out[j] = ves_twos_subtract(out[j], ves_twos_times(r->e[k][j], q[k]));
}

/* out = A r */
static void companion(int N, const ves_two *q, const square *r, square *out)
{
    for (int i = 0; i + 1 < N; i++)
        for (int j = 0; j < N; j++) out->e[i][j] = r->e[i + 1][j];
    for (int j = 0; j < N; j++) out->e[N - 1][j] = (ves_twos){{0}, {0}};
    last_row(N, q, r, out->e[N - 1]);
}

static void scale(int N, ves_twos by, square *a)
{
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) a->e[i][j] = ves_twos_multiply(a->e[i][j], by);
}

/* Where q does not move with a parameter, nothing does: most of the time goes into slopes. */
static bool still(const ves_factor *f, int p)
{
    for (int k = 0; k < f->power; k++)
        if (f->slope[p][k].hi != 0) return false;
    return true;
}

/* Horner: R = I + h A / j R, and dR = h / j (dA R + A dR). */
static void taylor(const ves_factor *f, int parameters, ves_twos h, square *e, square *slope)
{
    int N = f->power;
    square next;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            e->e[i][j] = ves_twos_of(ves_two_of(i == j));
            for (int p = 0; p < parameters; p++) slope[p].e[i][j] = (ves_twos){{0}, {0}};
        }
    for (int j = TERMS; j >= 1; j--) {
        ves_twos by = ves_twos_times(h, ves_two_inverse(j));
        for (int p = 0; p < parameters; p++) {
            if (still(f, p)) continue;
            companion(N, f->q, &slope[p], &next);
            last_row(N, f->slope[p], e, next.e[N - 1]);
            scale(N, by, &next);
            slope[p] = next;
        }
        companion(N, f->q, e, &next);
        scale(N, by, &next);
        for (int i = 0; i < N; i++) next.e[i][i] = ves_twos_add(next.e[i][i], ves_twos_of(ves_two_of(1)));
        *e = next;
    }
}

static void exponential(const ves_mode *mode, int parameters, ves_twos u, square *e, square *slope)
{
    const ves_factor *f = mode->factor;
    int N = f->power, halvings = 4;
    double norm = 1, length = f->rate * mode->n;
    for (int k = 0; k < N; k++) norm += fabs(f->q[k].hi);
    while (ldexp(length * norm, -halvings) > 1. / 16) halvings++;
    ves_twos h = ves_twos_shift(ves_twos_times(u, ves_two_product(f->rate, mode->n)), ldexp(1, -halvings));
    taylor(f, parameters, h, e, slope);
    for (int i = 0; i < halvings; i++) {
        square a, b;
        for (int p = 0; p < parameters; p++) {
            if (still(f, p)) continue;
            multiply(N, e, &slope[p], &a);
            multiply(N, &slope[p], e, &b);
            add(N, &a, &b, &slope[p]);
        }
        multiply(N, e, e, &a);
        *e = a;
    }
}

/* g^(N+i) = -sum_k q_k g^(k+i), in units of the rate. */
static void extend(const ves_factor *f, int count, int parameters, ves_twos *g, ves_twos slope[][DERIVATIVES])
{
    int N = f->power;
    for (int i = N; i < count; i++) {
        g[i] = (ves_twos){{0}, {0}};
        for (int p = 0; p < parameters; p++) slope[p][i] = (ves_twos){{0}, {0}};
        for (int k = 0; k < N; k++) {
            g[i] = ves_twos_subtract(g[i], ves_twos_times(g[i - N + k], f->q[k]));
            for (int p = 0; p < parameters; p++) {
                slope[p][i] = ves_twos_subtract(slope[p][i], ves_twos_times(slope[p][i - N + k], f->q[k]));
                slope[p][i] = ves_twos_subtract(slope[p][i], ves_twos_times(g[i - N + k], f->slope[p][k]));
            }
        }
    }
}

static void family(const ves_mode *mode, ves_twos u, double sign, int first, const ves_basis *basis)
{
    const ves_factor *f = mode->factor;
    int N = f->power, orders = basis->orders, members = 2 * N, count = N + orders - 1;
    int parameters = basis->slope ? ves_operator_parameters(mode->op) : 0;
    square e, slope[VES_PARAMETERS_MAX];
    ves_twos g[DERIVATIVES], by[VES_PARAMETERS_MAX][DERIVATIVES];
    exponential(mode, parameters, u, &e, slope);
    for (int k = 0; k < N; k++) {
        g[k] = e.e[k][N - 1];
        for (int p = 0; p < parameters; p++) by[p][k] = slope[p].e[k][N - 1];
    }
    extend(f, count, parameters, g, by);
    ves_two unit = ves_two_of(1), rate = ves_two_times(ves_two_product(f->rate, mode->n), sign);
    for (int d = 0; d < orders; d++, unit = ves_two_multiply(unit, rate))
        for (int m = 0; m < N; m++) {
            int at = (first + m) * orders + d;
            basis->value[at] = ves_twos_times(g[m + d], unit);
            for (int p = 0; p < parameters; p++)
                basis->slope[p * members * orders + at] = ves_twos_times(by[p][m + d], unit);
        }
}

void ves_basis_split(const ves_mode *mode, ves_lanes u, const ves_basis *basis)
{
    ves_twos left = {u, {0}}, right = ves_twos_sum(1 + (ves_lanes){0}, -u);
    family(mode, left, 1, 0, basis);
    family(mode, right, -1, mode->op->power, basis);
}

#include "surface/factor.h"

#include <complex.h>

enum { STEPS = 200 };

bool ves_two_solve(int n, ves_two a[][VES_GENERAL_MAX], int columns, ves_two b[][VES_PARAMETERS_MAX])
{
    for (int p = 0; p < n; p++) {
        int best = p;
        for (int r = p + 1; r < n; r++)
            if (fabs(a[r][p].hi) > fabs(a[best][p].hi)) best = r;
        if (a[best][p].hi == 0) return false;
        for (int c = 0; c < n; c++) {
            ves_two x = a[p][c];
            a[p][c] = a[best][c], a[best][c] = x;
        }
        for (int c = 0; c < columns; c++) {
            ves_two x = b[p][c];
            b[p][c] = b[best][c], b[best][c] = x;
        }
        for (int r = 0; r < n; r++) {
            if (r == p) continue;
            ves_two f = ves_two_divide(a[r][p], a[p][p]);
            for (int c = p; c < n; c++) a[r][c] = ves_two_subtract(a[r][c], ves_two_multiply(f, a[p][c]));
            for (int c = 0; c < columns; c++)
                b[r][c] = ves_two_subtract(b[r][c], ves_two_multiply(f, b[p][c]));
        }
    }
    for (int r = 0; r < n; r++)
        for (int c = 0; c < columns; c++) b[r][c] = ves_two_divide(b[r][c], a[r][r]);
    return true;
}

static ves_two signed_by(int k, ves_two x)
{
    return k % 2 ? ves_two_negative(x) : x;
}

static ves_two q_of(const ves_factor *f, int k)
{
    return k < 0 || k > f->power ? ves_two_of(0) : k == f->power ? ves_two_of(1) : f->q[k];
}

/* b_k = c_k / c_0 in units of rate^2k. */
static void scaled_make(const ves_operator *op, ves_factor *f, ves_two b[])
{
    double largest = 0;
    for (int k = 1; k <= op->power; k++)
        largest = fmax(largest, pow(fabs(op->parameter[k] / op->parameter[0]), 0.5 / k));
    f->rate = ldexp(1, (int)ceil(log2(largest))); /* a power of 2: scaling is exact */
    for (int k = 0; k <= op->power; k++) {
        b[k] = ves_two_divide(ves_two_of(op->parameter[k]), ves_two_of(op->parameter[0]));
        b[k].hi *= pow(f->rate, -2 * k), b[k].lo *= pow(f->rate, -2 * k);
    }
}

/* Coefficient r^2j of Q(r) Q(-r) is sum over i + l = 2j of (-1)^l q_i q_l; its derivative by q_i is
 * 2 (-1)^i q_(2j-i). */
static void jacobian(const ves_factor *f, ves_two a[][VES_GENERAL_MAX])
{
    for (int j = 0; j < f->power; j++)
        for (int i = 0; i < f->power; i++) a[j][i] = signed_by(i, ves_two_times(q_of(f, 2 * j - i), 2));
}

/* One step of Newton; how far q moved. */
static double step(ves_factor *f, const ves_two b[])
{
    ves_two a[VES_GENERAL_MAX][VES_GENERAL_MAX], r[VES_GENERAL_MAX][VES_PARAMETERS_MAX];
    int N = f->power;
    double moved = 0;
    for (int j = 0; j < N; j++) {
        ves_two sum = signed_by(j, b[N - j]);
        for (int i = 0; i <= 2 * j; i++) {
            ves_two term = ves_two_multiply(q_of(f, i), q_of(f, 2 * j - i));
            sum = ves_two_subtract(sum, signed_by(i, term));
        }
        r[j][0] = sum;
    }
    jacobian(f, a);
    if (!ves_two_solve(N, a, 1, r)) return 0;
    for (int k = 0; k < N; k++) {
        f->q[k] = ves_two_add(f->q[k], r[k][0]);
        moved = fmax(moved, fabs(r[k][0].hi));
    }
    return moved;
}

/* J dq = d((-1)^j b_(N-j)): by c_k it is 1 / (c_0 rate^2k) there, by c_0 -b_k / c_0 everywhere. */
static void slopes_make(const ves_operator *op, const ves_two b[], ves_factor *f)
{
    ves_two a[VES_GENERAL_MAX][VES_GENERAL_MAX], r[VES_GENERAL_MAX][VES_PARAMETERS_MAX] = {{{0, 0}}};
    int N = f->power;
    ves_two c0 = ves_two_of(op->parameter[0]);
    for (int j = 0; j < N; j++) {
        int k = N - j;
        ves_two unit = ves_two_divide(ves_two_of(pow(f->rate, -2 * k)), c0);
        r[j][0] = ves_two_negative(signed_by(j, ves_two_divide(b[k], c0)));
        r[j][k] = signed_by(j, unit);
    }
    jacobian(f, a);
    ves_two_solve(N, a, N + 1, r);
    for (int i = 0; i <= N; i++)
        for (int k = 0; k < N; k++) f->slope[i][k] = op->fixed >> i & 1 ? ves_two_of(0) : r[k][i];
}

void ves_factor_make(const ves_operator *op, bool slopes, ves_factor *f)
{
    ves_two b[VES_PARAMETERS_MAX];
    int N = f->power = op->power;
    f->op = op;
    f->rate = op->parameter[0];
    if (!op->general) return;
    scaled_make(op, f, b);
    double binomial = 1; /* (r + 3/2)^N: |s| <= 2 max |b_k|^(1/k), so all |r| < 3/2 */
    for (int k = N; k-- > 0;) {
        binomial *= (double)(k + 1) / (N - k);
        f->q[k] = ves_two_of(binomial * pow(1.5, N - k));
    }
    double before = HUGE_VAL;
    for (int i = 0; i < STEPS; i++) {
        double moved = step(f, b);
        if (moved == 0 || (moved < 1e-20 && moved >= before / 2)) break;
        before = moved;
    }
    if (slopes) slopes_make(op, b, f);
}

/* Q(z) in units of rate. */
static double complex value(const ves_factor *f, double complex z)
{
    double complex sum = 1;
    for (int k = f->power; k-- > 0;) sum = sum * z + f->q[k].hi;
    return sum;
}

/* By Durand and Kerner's iteration. */
double ves_factor_growth(const ves_factor *f)
{
    double complex z[VES_GENERAL_MAX];
    double most = 0;
    if (!f->op->general) return f->rate;
    for (int i = 0; i < f->power; i++) z[i] = 1.2 * cexp(I * (2.4 * i + 2.6));
    for (int s = 0; s < STEPS; s++)
        for (int i = 0; i < f->power; i++) {
            double complex product = 1;
            for (int k = 0; k < f->power; k++)
                if (k != i) product *= z[i] - z[k];
            if (product != 0) z[i] -= value(f, z[i]) / product;
        }
    for (int i = 0; i < f->power; i++) most = fmax(most, -creal(z[i]));
    return most * f->rate;
}

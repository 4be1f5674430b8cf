#include "surface/basis.h"

static const double NEGLIGIBLE = 1e-35;

/* N equal roots lam^2: h_m = C(N-1+m, m) lam^2m; dh_m/da = 2 m n C lam^(2m-1). */
static void series_power(const ves_mode *mode, ves_series *s)
{
    int N = mode->op->power;
    double n = mode->n / s->kappa;
    ves_two lam = ves_two_product(mode->op->parameter[0], n), square = ves_two_multiply(lam, lam);
    ves_two odd = ves_two_times(lam, 2 * n); /* 2 m n lam^(2m-1) without the m */
    s->h[0] = ves_two_of(1), s->slope[0][0] = ves_two_of(0);
    ves_two binomial = ves_two_of(1), power = ves_two_of(1);
    for (int m = 1; m < s->terms; m++) {
        binomial = ves_two_multiply(ves_two_times(binomial, N - 1 + m), ves_two_inverse(m));
        if (mode->slopes)
            s->slope[0][m] = ves_two_times(ves_two_multiply(binomial, ves_two_multiply(odd, power)), m);
        power = ves_two_multiply(power, square);
        s->h[m] = ves_two_multiply(binomial, power);
    }
}

/* x_m = input_m - sum_k g_k x_(m-k): the coefficients of input(z) / (1 + sum g_k z^k). */
static void divide_series(int N, const ves_two g[], int terms, const ves_two *input, ves_two *x)
{
    for (int m = 0; m < terms; m++) {
        x[m] = input[m];
        for (int k = 1; k <= N && k <= m; k++)
            x[m] = ves_two_subtract(x[m], ves_two_multiply(g[k], x[m - k]));
    }
}

/* sum h_m z^m = 1 / G(z), G = 1 + sum_k g_k z^k, g_k = (-1)^k c_k/c_0 (n / kappa)^2k; d(1/G) = -dG / G^2. */
static void series_general(const ves_mode *mode, ves_series *s)
{
    const ves_operator *op = mode->op;
    int N = op->power;
    ves_two g[VES_PARAMETERS_MAX], unit[VES_PARAMETERS_MAX], one[VES_SERIES / 2] = {{1, 0}};
    ves_two c0 = ves_two_of(op->parameter[0]);
    double n = mode->n / s->kappa;
    ves_two square = ves_two_product(n, n), power = ves_two_of(1);
    for (int k = 1; k <= N; k++) {
        power = ves_two_negative(ves_two_multiply(power, square));
        unit[k] = ves_two_divide(power, c0);
        g[k] = ves_two_times(unit[k], op->parameter[k]);
    }
    divide_series(N, g, s->terms, one, s->h);
    if (!mode->slopes) return;
    divide_series(N, g, s->terms, s->h, one); /* 1 / G^2 */
    for (int m = 0; m < s->terms; m++) {
        s->slope[0][m] = ves_two_of(0);
        for (int k = 1; k <= N; k++) {
            ves_two before = m >= k ? one[m - k] : ves_two_of(0);
            s->slope[k][m] = ves_two_negative(ves_two_multiply(unit[k], before));
            s->slope[0][m] = ves_two_add(s->slope[0][m], ves_two_divide(ves_two_multiply(g[k], before), c0));
        }
    }
}

/* So many that what is left out does not count, in the highest derivative either. The sizes are those of N
 * equal roots, at the end of the interval. */
static int enough(const ves_mode *mode, double size)
{
    int N = mode->op->power, orders = mode->orders, most = (VES_SERIES - 2 * N) / 2, m = 0;
    double term = 1, largest = 1;
    for (; m < most && (m < orders || term > NEGLIGIBLE * largest); m++) {
        int i = 2 * m - orders; /* terms (size/2)^i / i! h_m */
        term *= (double)(N + m) / (m + 1) * (size / 2) * (size / 2);
        if (i + 1 > 0) term /= i + 1;
        if (i + 2 > 0) term /= i + 2;
        largest = fmax(largest, term);
    }
    return m < 2 ? 2 : m;
}

void ves_mode_center(ves_mode *mode)
{
    double size = ves_mode_size(mode);
    mode->centred = true;
    mode->series.kappa = size > 1 ? ldexp(1, (int)ceil(log2(size))) : 1; /* so that nothing overflows */
    mode->series.terms = enough(mode, size);
    if (mode->op->general)
        series_general(mode, &mode->series);
    else
        series_power(mode, &mode->series);
}

/* e_j = sum_m h_m x^(2m+j) / (2m+j)! for j = first .. last: a member for j >= 0, and a derivative of member 0
 * for j < 0. */
static void series_at(const ves_two *h, int terms, int first, int last, const ves_twos *power, ves_twos *e)
{
    for (int j = first; j <= last; j++) {
        ves_twos sum = {{0}, {0}};
        for (int m = terms - 1; m >= 0 && 2 * m + j >= 0; m--)
            sum = ves_twos_gather(sum, power[2 * m + j], ves_twos_of(h[m]));
        e[j - first] = ves_twos_sum(sum.hi, sum.lo);
    }
}

/* Member k is kappa^k e_k, in the variable x = kappa t, and e_k' = e_(k-1). */
void ves_basis_centred(const ves_mode *mode, ves_lanes u, const ves_basis *basis)
{
    const ves_series *s = &mode->series;
    int members = 2 * mode->op->power, orders = basis->orders;
    int parameters = basis->slope ? ves_operator_parameters(mode->op) : 0;
    ves_twos x = ves_twos_shift(ves_twos_sum(u, -0.5 + (ves_lanes){0}), s->kappa);
    ves_twos e[2 * VES_CONDITIONS_MAX];
    basis->power[0] = ves_twos_of(ves_two_of(1));
    for (int i = 1; i < 2 * s->terms + members - 2; i++)
        basis->power[i] = ves_twos_times(ves_twos_multiply(basis->power[i - 1], x), ves_two_inverse(i));
    for (int p = -1; p < parameters; p++) {
        ves_twos *to = p < 0 ? basis->value : basis->slope + p * members * orders;
        series_at(p < 0 ? s->h : s->slope[p], s->terms, 1 - orders, members - 1, basis->power, e);
        for (int k = 0; k < members; k++) {
            double unit = 1;
            for (int d = 0; d < orders; d++, unit *= s->kappa)
                to[k * orders + d] = ves_twos_shift(e[k - d + orders - 1], unit);
        }
    }
}

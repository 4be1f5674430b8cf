#include "surface/operator.h"

#include <float.h>
#include <math.h>

int ves_operator_parameters(const ves_operator *op)
{
    return op->general ? op->power + 1 : 1;
}

double ves_operator_rate(const ves_operator *op)
{
    double rate = 0;
    if (!op->general) return op->parameter[0];
    for (int k = 1; k <= op->power; k++)
        rate = fmax(rate, pow(fabs(op->parameter[k] / op->parameter[0]), 0.5 / k));
    return rate;
}

/* A polynomial on [0, 1] by its Bernstein coefficients lies between the smallest and the largest of them. */
typedef struct piece {
    double b[VES_PARAMETERS_MAX];
    double from, to;
} piece;

enum { DEPTH = 60 };

/* Halves by de Casteljau's rule. */
static void halve(const piece *p, int N, piece *left, piece *right)
{
    *left = *right = *p;
    left->to = right->from = (p->from + p->to) / 2;
    for (int k = 1; k <= N; k++) {
        for (int i = 0; i <= N - k; i++) right->b[i] = (right->b[i] + right->b[i + 1]) / 2;
        left->b[k] = right->b[0];
    }
}

/* Where it is not positive; false: nowhere. Roots closer together than 2^-DEPTH count as touching 0. */
static bool find(const piece *p, int N, int depth, double *at)
{
    bool positive = true;
    for (int k = 0; k <= N; k++) positive = positive && p->b[k] > 0;
    if (positive) return false;
    *at = p->b[0] <= 0 ? p->from : p->b[N] <= 0 ? p->to : (p->from + p->to) / 2;
    if (p->b[0] <= 0 || p->b[N] <= 0 || depth == DEPTH) return true;
    piece left, right;
    halve(p, N, &left, &right);
    return find(&left, N, depth + 1, at) || find(&right, N, depth + 1, at);
}

/* log2 of the largest (|c_k| / |first|)^(1/k), counted from c_0 or, in reverse, from c_N; -HUGE_VAL: all are 0. */
static double bound(const ves_operator *op, bool reverse)
{
    int N = op->power;
    double most = -HUGE_VAL, first = log2(fabs(op->parameter[reverse ? N : 0]));
    for (int k = 1; k <= N; k++)
        most = fmax(most, (log2(fabs(op->parameter[reverse ? N - k : k])) - first) / k);
    return most;
}

/* sum_k c_k t^(N-k), t = scale x / (1 - x), times (1-x)^N, has on [0, 1] the Bernstein coefficients
 * c_(N-j) scale^j / C(N, j). No quotient c_k / c_0 need be a number. */
bool ves_operator_elliptic(const ves_operator *op, double *t)
{
    int N = op->power;
    double binomial = 1, at = 0, c0 = op->parameter[0];
    *t = 0;
    if (!op->general) return c0 >= 0 && isfinite(c0);
    for (int k = 0; k <= N; k++)
        if (!isfinite(op->parameter[k])) return false;
    *t = HUGE_VAL;
    if (c0 <= 0) return false;
    *t = 0;
    if (op->parameter[N] <= 0) return false;
    int scale = (int)ceil(bound(op, false)), own, first; /* a power of 2: nothing is rounded, or overflows */
    double unit = frexp(c0, &first);
    piece whole = {.from = 0, .to = 1};
    for (int j = 0; j <= N; j++) {
        double part = frexp(op->parameter[N - j], &own) / unit;
        whole.b[j] = ldexp(part, own - first + (j - N) * scale) / binomial;
        binomial *= (double)(N - j) / (j + 1);
    }
    whole.b[0] = fmax(whole.b[0], DBL_MIN); /* c_N > 0, however small */
    if (!find(&whole, N, 0, &at)) return true;
    *t = at < 1 ? ldexp(at / (1 - at), scale) : HUGE_VAL;
    return false;
}

ves_operator_size ves_operator_measure(const ves_operator *op)
{
    ves_operator_size s = {.odd = -1, .fast = 1, .slow = 1, .solvable = true};
    if (!op->general) return s;
    for (int k = 0; k <= op->power; k++) {
        double decades = fabs(log10(fabs(op->parameter[k])));
        if (op->parameter[k] == 0 || !(decades > VES_COEFFICIENT_DECADES) || !isfinite(op->parameter[k]))
            continue;
        s.odd = k, s.solvable = false;
        return s;
    }
    if (!(op->parameter[0] > 0 && op->parameter[op->power] > 0)) return s;
    s.fast = ves_operator_rate(op), s.slow = exp2(-bound(op, true) / 2);
    s.solvable = s.fast <= VES_RATE_MOST && s.fast <= VES_RATE_SPREAD * s.slow;
    return s;
}

#include "surface/operator.h"

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

/* sum_k c_k t^(N-k), t = scale x / (1 - x), times (1-x)^N, has on [0, 1] the Bernstein coefficients
 * c_(N-j) scale^j / C(N, j). */
bool ves_operator_elliptic(const ves_operator *op, double *t)
{
    int N = op->power;
    double scale = 0, binomial = 1, at = 0, c0 = op->parameter[0];
    *t = 0;
    if (!op->general) return c0 >= 0 && isfinite(c0);
    for (int k = 0; k <= N; k++)
        if (!isfinite(op->parameter[k])) return false;
    *t = HUGE_VAL;
    if (c0 <= 0) return false;
    for (int k = 1; k <= N; k++) scale = fmax(scale, pow(fabs(op->parameter[k]) / c0, 1. / k));
    *t = 0;
    if (!(scale > 0 && isfinite(scale))) return false;
    piece whole = {.from = 0, .to = 1};
    for (int j = 0; j <= N; j++) {
        whole.b[j] = op->parameter[N - j] / c0 * pow(scale, j - N) / binomial;
        binomial *= (double)(N - j) / (j + 1);
    }
    if (!find(&whole, N, 0, &at)) return true;
    *t = at < 1 ? scale * at / (1 - at) : HUGE_VAL;
    return false;
}

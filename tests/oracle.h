/* The cardinal functions of a mode equation with MPFR, from the textbook basis: u^k e^(ru) for each root r of
 * P(r) of multiplicity above k, real and imaginary part (u^m where all roots are 0), and Gaussian
 * elimination. Written apart from src/surface: nothing of it is used but the layout. That basis loses
 * hundreds of bits where roots are close together or close to 0; `bits` are chosen so that hundreds are
 * left. */
#ifndef TESTS_ORACLE_H
#define TESTS_ORACLE_H

#include <math.h>
#include <mpfr.h>
#include <stdlib.h>

#include "surface/weights.h"

enum { ORACLE_MOST = VES_CONDITIONS_MAX, ORACLE_DERIVATIVES = ORACLE_MOST };

/* P(r) = prod (r^2 - (p + iq)^2)^multiplicity; q != 0 stands for the conjugate too. p = 0: all roots are. */
typedef struct oracle_root {
    mpfr_t p, q;
    int multiplicity;
} oracle_root;

typedef struct oracle {
    long bits;
    int roots;
    oracle_root root[ORACLE_MOST / 2];
} oracle;

static mpfr_t *oracle_numbers(const oracle *o, int count)
{
    mpfr_t *x = malloc(sizeof *x * (size_t)count);
    for (int k = 0; k < count; k++) {
        mpfr_init2(x[k], o->bits);
        mpfr_set_ui(x[k], 0, MPFR_RNDN);
    }
    return x;
}

static void oracle_free(int count, mpfr_t *x)
{
    for (int k = 0; k < count; k++) mpfr_clear(x[k]);
    free(x);
}

static void oracle_init(oracle *o, long bits)
{
    o->bits = bits, o->roots = 0;
}

static void oracle_clear(oracle *o)
{
    for (int k = 0; k < o->roots; k++) mpfr_clears(o->root[k].p, o->root[k].q, (mpfr_ptr)0);
    mpfr_free_cache();
}

static oracle_root *oracle_add(oracle *o, double p, double q, int multiplicity)
{
    oracle_root *r = &o->root[o->roots++];
    mpfr_inits2(o->bits, r->p, r->q, (mpfr_ptr)0);
    mpfr_set_d(r->p, p, MPFR_RNDN);
    mpfr_set_d(r->q, q, MPFR_RNDN);
    r->multiplicity = multiplicity;
    return r;
}

/* r^0 .. r^d, real and imaginary parts */
static void oracle_powers(const oracle_root *r, int d, mpfr_t *re, mpfr_t *im)
{
    mpfr_set_ui(re[0], 1, MPFR_RNDN);
    mpfr_set_ui(im[0], 0, MPFR_RNDN);
    for (int k = 1; k <= d; k++) {
        mpfr_fmms(re[k], re[k - 1], r->p, im[k - 1], r->q, MPFR_RNDN);
        mpfr_fmma(im[k], re[k - 1], r->q, im[k - 1], r->p, MPFR_RNDN);
    }
}

/* Leibniz: D^d (u^k e^(ru)) e^(-ru) = sum_j C(d,j) k!/(k-j)! u^(k-j) r^(d-j), here times sign^(d-j). */
static void oracle_leibniz(int k, int d, double sign, mpfr_t *u, mpfr_t *power, mpfr_t term, mpfr_t sum)
{
    mpfr_t factor;
    mpfr_init2(factor, mpfr_get_prec(sum));
    mpfr_set_ui(factor, 1, MPFR_RNDN);
    mpfr_set_ui(sum, 0, MPFR_RNDN);
    for (int j = 0; j <= d && j <= k; j++) {
        mpfr_mul(term, u[k - j], power[d - j], MPFR_RNDN);
        mpfr_mul(term, term, factor, MPFR_RNDN);
        if (sign < 0 && (d - j) % 2)
            mpfr_sub(sum, sum, term, MPFR_RNDN);
        else
            mpfr_add(sum, sum, term, MPFR_RNDN);
        mpfr_mul_ui(factor, factor, (unsigned long)((d - j) * (k - j)), MPFR_RNDN);
        mpfr_div_ui(factor, factor, (unsigned long)(j + 1), MPFR_RNDN);
    }
    mpfr_clear(factor);
}

/* e^(pu), cos(qu), sin(qu); with sign -1: of -r. e^(p(u-1)) for +r, so that no member is huge at one end. */
static void oracle_wave(const oracle_root *r, double sign, mpfr_t *u, mpfr_t e, mpfr_t c, mpfr_t s)
{
    if (sign > 0)
        mpfr_sub_ui(e, u[1], 1, MPFR_RNDN);
    else
        mpfr_neg(e, u[1], MPFR_RNDN);
    mpfr_mul(e, e, r->p, MPFR_RNDN);
    mpfr_exp(e, e, MPFR_RNDN);
    mpfr_mul(c, u[1], r->q, MPFR_RNDN);
    mpfr_sin_cos(s, c, c, MPFR_RNDN);
    if (sign < 0) mpfr_neg(s, s, MPFR_RNDN);
}

/* The members of one root from member m on, D^d of each at u: row[member * stride]. Returns how many. */
static int oracle_family(const oracle *o, const oracle_root *r, mpfr_t *u, int d, int stride, mpfr_t *row)
{
    mpfr_t *re = oracle_numbers(o, 2 * (d + 1)), *im = re + d + 1, *x = oracle_numbers(o, 6);
    int m = 0;
    oracle_powers(r, d, re, im);
    for (double sign = 1; sign >= -1; sign -= 2) {
        oracle_wave(r, sign, u, x[0], x[1], x[2]);
        for (int k = 0; k < r->multiplicity; k++) {
            oracle_leibniz(k, d, sign, u, re, x[3], x[4]);
            if (mpfr_zero_p(r->q)) {
                mpfr_mul(row[m++ * stride], x[0], x[4], MPFR_RNDN);
                continue;
            }
            oracle_leibniz(k, d, sign, u, im, x[3], x[5]);
            mpfr_fmms(row[m * stride], x[4], x[1], x[5], x[2], MPFR_RNDN);
            mpfr_fmma(row[(m + 1) * stride], x[4], x[2], x[5], x[1], MPFR_RNDN);
            for (int i = 0; i < 2; i++, m++) mpfr_mul(row[m * stride], row[m * stride], x[0], MPFR_RNDN);
        }
    }
    oracle_free(2 * (d + 1), re);
    oracle_free(6, x);
    return m;
}

/* D^d of all n members at u. */
static void oracle_members(const oracle *o, int n, double at, int d, int stride, mpfr_t *row)
{
    mpfr_t *u = oracle_numbers(o, n + 1);
    mpfr_set_ui(u[0], 1, MPFR_RNDN);
    mpfr_set_d(u[1], at, MPFR_RNDN);
    for (int k = 2; k <= n; k++) mpfr_mul(u[k], u[k - 1], u[1], MPFR_RNDN);
    if (mpfr_zero_p(o->root[0].p)) {
        for (int m = 0; m < n; m++) {
            mpfr_set_ui(row[m * stride], 0, MPFR_RNDN);
            if (m < d) continue;
            mpfr_set(row[m * stride], u[m - d], MPFR_RNDN);
            for (int f = 0; f < d; f++)
                mpfr_mul_ui(row[m * stride], row[m * stride], (unsigned long)(m - f), MPFR_RNDN);
        }
    } else {
        int m = 0;
        for (int k = 0; k < o->roots; k++) m += oracle_family(o, &o->root[k], u, d, stride, row + m * stride);
    }
    oracle_free(n + 1, u);
}

/* t x = b for the columns n .. width - 1 of t, n rows: left in their place. */
static void oracle_eliminate(int n, int width, mpfr_t *t)
{
    mpfr_t f;
    mpfr_init2(f, mpfr_get_prec(t[0]));
    for (int p = 0; p < n; p++) {
        int best = p;
        for (int r = p + 1; r < n; r++)
            if (mpfr_cmpabs(t[r * width + p], t[best * width + p]) > 0) best = r;
        for (int c = 0; c < width; c++) mpfr_swap(t[p * width + c], t[best * width + c]);
        for (int r = p + 1; r < n; r++) {
            mpfr_div(f, t[r * width + p], t[p * width + p], MPFR_RNDN);
            mpfr_neg(f, f, MPFR_RNDN);
            for (int c = p + 1; c < width; c++)
                mpfr_fma(t[r * width + c], f, t[p * width + c], t[r * width + c], MPFR_RNDN);
        }
    }
    for (int p = n - 1; p >= 0; p--)
        for (int c = n; c < width; c++) {
            mpfr_div(t[p * width + c], t[p * width + c], t[p * width + p], MPFR_RNDN);
            mpfr_neg(f, t[p * width + c], MPFR_RNDN);
            for (int r = 0; r < p; r++)
                mpfr_fma(t[r * width + c], f, t[r * width + p], t[r * width + c], MPFR_RNDN);
        }
    mpfr_clear(f);
}

/* weight[(d * n + j) * nu + i], d < orders: D^d of cardinal function j at u[i]. */
static void oracle_weights(const oracle *o, const ves_layout *layout, int orders, int nu, const double *u,
                           mpfr_t *weight)
{
    int n = 2 * layout->power, width = n + orders * nu;
    mpfr_t *t = oracle_numbers(o, n * width);
    for (int j = 0; j < n; j++)
        oracle_members(o, n, layout->knot[j].u, layout->knot[j].derivative, width, t + j);
    for (int d = 0; d < orders; d++)
        for (int i = 0; i < nu; i++) oracle_members(o, n, u[i], d, width, t + n + d * nu + i);
    oracle_eliminate(n, width, t);
    for (int d = 0; d < orders; d++)
        for (int j = 0; j < n; j++)
            for (int i = 0; i < nu; i++)
                mpfr_set(weight[(d * n + j) * nu + i], t[j * width + n + d * nu + i], MPFR_RNDN);
    oracle_free(n * width, t);
}

/* The same as doubles. */
static void oracle_doubles(const oracle *o, const ves_layout *layout, int orders, int nu, const double *u,
                           double *weight)
{
    int size = orders * 2 * layout->power * nu;
    mpfr_t *w = oracle_numbers(o, size);
    oracle_weights(o, layout, orders, nu, u, w);
    for (int k = 0; k < size; k++) weight[k] = mpfr_get_d(w[k], MPFR_RNDN);
    oracle_free(size, w);
}

/* (D^2 - lam^2)^N. */
static void oracle_power(oracle *o, int N, double lam, long bits)
{
    oracle_init(o, bits);
    oracle_add(o, lam, 0, N);
}

#endif

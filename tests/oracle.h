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

static inline mpfr_t *oracle_numbers(const oracle *o, int count)
{
    mpfr_t *x = malloc(sizeof *x * (size_t)count);
    for (int k = 0; k < count; k++) {
        mpfr_init2(x[k], o->bits);
        mpfr_set_ui(x[k], 0, MPFR_RNDN);
    }
    return x;
}

static inline void oracle_free(int count, mpfr_t *x)
{
    for (int k = 0; k < count; k++) mpfr_clear(x[k]);
    free(x);
}

static inline void oracle_init(oracle *o, long bits)
{
    o->bits = bits, o->roots = 0;
}

static inline void oracle_clear(oracle *o)
{
    for (int k = 0; k < o->roots; k++) mpfr_clears(o->root[k].p, o->root[k].q, (mpfr_ptr)0);
    mpfr_free_cache();
}

static inline oracle_root *oracle_add(oracle *o, double p, double q, int multiplicity)
{
    oracle_root *r = &o->root[o->roots++];
    mpfr_inits2(o->bits, r->p, r->q, (mpfr_ptr)0);
    mpfr_set_d(r->p, p, MPFR_RNDN);
    mpfr_set_d(r->q, q, MPFR_RNDN);
    r->multiplicity = multiplicity;
    return r;
}

/* r^0 .. r^d, real and imaginary parts */
static inline void oracle_powers(const oracle_root *r, int d, mpfr_t *re, mpfr_t *im)
{
    mpfr_set_ui(re[0], 1, MPFR_RNDN);
    mpfr_set_ui(im[0], 0, MPFR_RNDN);
    for (int k = 1; k <= d; k++) {
        mpfr_fmms(re[k], re[k - 1], r->p, im[k - 1], r->q, MPFR_RNDN);
        mpfr_fmma(im[k], re[k - 1], r->q, im[k - 1], r->p, MPFR_RNDN);
    }
}

/* Leibniz: D^d (u^k e^(ru)) e^(-ru) = sum_j C(d,j) k!/(k-j)! u^(k-j) r^(d-j), here times sign^(d-j). */
static inline void oracle_leibniz(int k, int d, double sign, mpfr_t *u, mpfr_t *power, mpfr_t term,
                                  mpfr_t sum)
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
static inline void oracle_wave(const oracle_root *r, double sign, mpfr_t *u, mpfr_t e, mpfr_t c, mpfr_t s)
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
static inline int oracle_family(const oracle *o, const oracle_root *r, mpfr_t *u, int d, int stride,
                                mpfr_t *row)
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
static inline void oracle_members(const oracle *o, int n, double at, int d, int stride, mpfr_t *row)
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
static inline void oracle_eliminate(int n, int width, mpfr_t *t)
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
static inline void oracle_weights(const oracle *o, const ves_layout *layout, int orders, int nu,
                                  const double *u, mpfr_t *weight)
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
static inline void oracle_doubles(const oracle *o, const ves_layout *layout, int orders, int nu,
                                  const double *u, double *weight)
{
    int size = orders * 2 * layout->power * nu;
    mpfr_t *w = oracle_numbers(o, size);
    oracle_weights(o, layout, orders, nu, u, w);
    for (int k = 0; k < size; k++) weight[k] = mpfr_get_d(w[k], MPFR_RNDN);
    oracle_free(size, w);
}

/* (D^2 - lam^2)^N. */
static inline void oracle_power(oracle *o, int N, double lam, long bits)
{
    oracle_init(o, bits);
    oracle_add(o, lam, 0, N);
}

/* d/da of mode n of (d_uu + a^2 d_vv)^N: (l(lam + h) - l(lam - h)) n / 2h, h = 2^-130. */
static inline void oracle_slopes(const ves_layout *layout, double a, int n, int orders, int nu,
                                 const double *u, double *want)
{
    int size = orders * 2 * layout->power * nu;
    long bits = 700 + 40 * layout->power;
    oracle o;
    oracle_init(&o, bits);
    mpfr_t *w = oracle_numbers(&o, 2 * size + 1), *h = w + 2 * size;
    mpfr_set_ui_2exp(*h, 1, -130, MPFR_RNDN);
    for (int side = 0; side < 2; side++) {
        oracle_power(&o, layout->power, 1, bits);
        mpfr_set_d(o.root[0].p, a, MPFR_RNDN);
        mpfr_mul_si(o.root[0].p, o.root[0].p, n, MPFR_RNDN);
        mpfr_add(o.root[0].p, o.root[0].p, *h, MPFR_RNDN);
        mpfr_neg(*h, *h, MPFR_RNDN);
        oracle_weights(&o, layout, orders, nu, u, w + side * size);
        oracle_clear(&o);
    }
    for (int k = 0; k < size; k++) {
        mpfr_sub(w[k], w[k], w[size + k], MPFR_RNDN);
        mpfr_mul_2ui(w[k], w[k], 129, MPFR_RNDN);
        mpfr_mul_si(w[k], w[k], n, MPFR_RNDN);
        want[k] = a > 0 ? mpfr_get_d(w[k], MPFR_RNDN) : 0; /* an even function of a */
    }
    oracle_free(2 * size + 1, w);
}

/* --- roots of a general operator: by Durand and Kerner's iteration, in MPFR --- */

typedef struct oracle_complex {
    mpfr_t re, im;
} oracle_complex;

static inline void oracle_multiply(const oracle_complex *a, const oracle_complex *b, oracle_complex *out,
                                   mpfr_t t)
{
    mpfr_fmms(t, a->re, b->re, a->im, b->im, MPFR_RNDN);
    mpfr_fmma(out->im, a->re, b->im, a->im, b->re, MPFR_RNDN);
    mpfr_set(out->re, t, MPFR_RNDN);
}

/* a / b, left in a */
static inline void oracle_divide(oracle_complex *a, const oracle_complex *b, mpfr_t t, mpfr_t size)
{
    mpfr_fmma(size, b->re, b->re, b->im, b->im, MPFR_RNDN);
    mpfr_fmma(t, a->re, b->re, a->im, b->im, MPFR_RNDN);
    mpfr_fmms(a->im, a->im, b->re, a->re, b->im, MPFR_RNDN);
    mpfr_div(a->re, t, size, MPFR_RNDN);
    mpfr_div(a->im, a->im, size, MPFR_RNDN);
}

/* One step for root i of s^N + sum_k b_k s^(N-k): z_i -= p(z_i) / prod (z_i - z_j). */
static inline void oracle_step(int N, mpfr_t *b, oracle_complex *z, int i, oracle_complex *x, mpfr_t *t)
{
    mpfr_set_ui(x[0].re, 1, MPFR_RNDN), mpfr_set_ui(x[0].im, 0, MPFR_RNDN);
    mpfr_set_ui(x[1].re, 1, MPFR_RNDN), mpfr_set_ui(x[1].im, 0, MPFR_RNDN);
    for (int k = 1; k <= N; k++) {
        oracle_multiply(&x[0], &z[i], &x[0], t[0]);
        mpfr_add(x[0].re, x[0].re, b[k], MPFR_RNDN);
    }
    for (int j = 0; j < N; j++) {
        if (j == i) continue;
        mpfr_sub(x[2].re, z[i].re, z[j].re, MPFR_RNDN), mpfr_sub(x[2].im, z[i].im, z[j].im, MPFR_RNDN);
        oracle_multiply(&x[1], &x[2], &x[1], t[0]);
    }
    oracle_divide(&x[0], &x[1], t[0], t[1]);
    mpfr_sub(z[i].re, z[i].re, x[0].re, MPFR_RNDN), mpfr_sub(z[i].im, z[i].im, x[0].im, MPFR_RNDN);
}

/* r = sqrt(s), Re r > 0; conjugates are one root. */
static inline void oracle_add_square(oracle *o, const oracle_complex *s, mpfr_t t)
{
    mpfr_hypot(t, s->re, s->im, MPFR_RNDN);
    mpfr_mul_2si(t, t, -o->bits / 2, MPFR_RNDN);
    bool real = mpfr_cmpabs(s->im, t) < 0;
    if (!real && mpfr_sgn(s->im) < 0) return;
    oracle_root *r = oracle_add(o, 0, 0, 1);
    mpfr_hypot(t, s->re, s->im, MPFR_RNDN);
    mpfr_add(t, t, s->re, MPFR_RNDN);
    mpfr_div_2ui(t, t, 1, MPFR_RNDN);
    mpfr_sqrt(r->p, t, MPFR_RNDN);
    if (real) return;
    mpfr_div(r->q, s->im, r->p, MPFR_RNDN);
    mpfr_div_2ui(r->q, r->q, 1, MPFR_RNDN);
}

/* The operator sum_k c_k d_u^(2N-2k) d_v^(2k) in mode n > 0, with c_which changed by a part `by` of c_0 (which
 * < 0: not). All roots must differ; those of an operator with repeated ones do, once it is changed. */
static inline void oracle_operator(oracle *o, const ves_operator *op, double n, int which, mpfr_t by,
                                   long bits)
{
    int N = op->power;
    oracle_init(o, bits);
    mpfr_t *b = oracle_numbers(o, N + 1 + 2 * N + 6 + 2), *w = b + N + 1, *t = w + 2 * N + 6;
    oracle_complex *z = (oracle_complex *)w, *x = z + N; /* pairs of numbers */
    for (int k = 0; k <= N; k++) {
        mpfr_set_d(b[k], op->parameter[k], MPFR_RNDN);
        if (k == which) mpfr_fma(b[k], by, b[0], b[k], MPFR_RNDN);
        for (int f = 0; f < 2 * k; f++) mpfr_mul_d(b[k], b[k], n, MPFR_RNDN);
        if (k % 2) mpfr_neg(b[k], b[k], MPFR_RNDN);
    }
    for (int k = N; k >= 0; k--) mpfr_div(b[k], b[k], b[0], MPFR_RNDN);
    for (int i = 0; i < N; i++) {
        mpfr_set_d(z[i].re, n * n * pow(1.3, i) * cos(2.4 * i + 0.7), MPFR_RNDN);
        mpfr_set_d(z[i].im, n * n * pow(1.3, i) * sin(2.4 * i + 0.7), MPFR_RNDN);
    }
    for (int step = 0; step < 250; step++)
        for (int i = 0; i < N; i++) oracle_step(N, b, z, i, x, t);
    for (int i = 0; i < N; i++) oracle_add_square(o, &z[i], t[0]);
    oracle_free(N + 1 + 2 * N + 6 + 2, b);
}

#endif

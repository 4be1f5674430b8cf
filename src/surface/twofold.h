/* Double-double arithmetic: a number is the unevaluated sum of two doubles, about 32 digits [Dekker 1971; Hida,
 * Li, Bailey 2001]. In registers of VES_LANES numbers, and alone. Files that include this are compiled without
 * contraction (a product merged into a sum is no longer the product whose error is taken).
 * test  against MPFR */
#ifndef VES_SURFACE_TWOFOLD_H
#define VES_SURFACE_TWOFOLD_H

#include <math.h>

#include "surface/tile.h"

typedef struct ves_two {
    double hi, lo;
} ves_two;

typedef struct ves_twos {
    ves_lanes hi, lo;
} ves_twos;

#define VES_TWO_INLINE static inline __attribute__((always_inline))

/* --- alone --- */

VES_TWO_INLINE ves_two ves_two_of(double x)
{
    return (ves_two){x, 0};
}

/* Exact, where |a| >= |b|. */
VES_TWO_INLINE ves_two ves_two_quick(double a, double b)
{
    double s = a + b;
    return (ves_two){s, b - (s - a)};
}

VES_TWO_INLINE ves_two ves_two_sum(double a, double b)
{
    double s = a + b, c = s - a;
    return (ves_two){s, (a - (s - c)) + (b - c)};
}

VES_TWO_INLINE ves_two ves_two_product(double a, double b)
{
    double p = a * b;
    return (ves_two){p, __builtin_fma(a, b, -p)};
}

VES_TWO_INLINE ves_two ves_two_add(ves_two a, ves_two b)
{
    ves_two s = ves_two_sum(a.hi, b.hi), t = ves_two_sum(a.lo, b.lo);
    s = ves_two_quick(s.hi, s.lo + t.hi);
    return ves_two_quick(s.hi, s.lo + t.lo);
}

VES_TWO_INLINE ves_two ves_two_negative(ves_two a)
{
    return (ves_two){-a.hi, -a.lo};
}

VES_TWO_INLINE ves_two ves_two_subtract(ves_two a, ves_two b)
{
    return ves_two_add(a, ves_two_negative(b));
}

VES_TWO_INLINE ves_two ves_two_multiply(ves_two a, ves_two b)
{
    ves_two p = ves_two_product(a.hi, b.hi);
    return ves_two_quick(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

VES_TWO_INLINE ves_two ves_two_times(ves_two a, double b)
{
    ves_two p = ves_two_product(a.hi, b);
    return ves_two_quick(p.hi, p.lo + a.lo * b);
}

/* Two steps of long division. */
VES_TWO_INLINE ves_two ves_two_divide(ves_two a, ves_two b)
{
    double q = a.hi / b.hi;
    ves_two r = ves_two_subtract(a, ves_two_times(b, q));
    double q2 = r.hi / b.hi;
    r = ves_two_subtract(r, ves_two_times(b, q2));
    return ves_two_add(ves_two_quick(q, q2), ves_two_of(r.hi / b.hi));
}

/* 1 / i of a whole number. */
VES_TWO_INLINE ves_two ves_two_inverse(int i)
{
    double q = 1. / i;
    return (ves_two){q, __builtin_fma(-q, i, 1) / i};
}

/* --- in registers --- */

VES_TWO_INLINE ves_lanes ves_lanes_fma(ves_lanes a, ves_lanes b, ves_lanes c)
{
#ifdef __AVX512F__
    return (ves_lanes)_mm512_fmadd_pd((__m512d)a, (__m512d)b, (__m512d)c);
#else
    ves_lanes r;
    for (int k = 0; k < VES_LANES; k++) r[k] = __builtin_fma(a[k], b[k], c[k]);
    return r;
#endif
}

VES_TWO_INLINE ves_lanes ves_lanes_fms(ves_lanes a, ves_lanes b, ves_lanes c)
{
#ifdef __AVX512F__
    return (ves_lanes)_mm512_fmsub_pd((__m512d)a, (__m512d)b, (__m512d)c);
#else
    ves_lanes r;
    for (int k = 0; k < VES_LANES; k++) r[k] = __builtin_fma(a[k], b[k], -c[k]);
    return r;
#endif
}

VES_TWO_INLINE ves_twos ves_twos_of(ves_two x)
{
    return (ves_twos){x.hi + (ves_lanes){0}, x.lo + (ves_lanes){0}};
}

VES_TWO_INLINE ves_twos ves_twos_quick(ves_lanes a, ves_lanes b)
{
    ves_lanes s = a + b;
    return (ves_twos){s, b - (s - a)};
}

VES_TWO_INLINE ves_twos ves_twos_sum(ves_lanes a, ves_lanes b)
{
    ves_lanes s = a + b, c = s - a;
    return (ves_twos){s, (a - (s - c)) + (b - c)};
}

VES_TWO_INLINE ves_twos ves_twos_product(ves_lanes a, ves_lanes b)
{
    ves_lanes p = a * b;
    return (ves_twos){p, ves_lanes_fms(a, b, p)};
}

VES_TWO_INLINE ves_twos ves_twos_add(ves_twos a, ves_twos b)
{
    ves_twos s = ves_twos_sum(a.hi, b.hi), t = ves_twos_sum(a.lo, b.lo);
    s = ves_twos_quick(s.hi, s.lo + t.hi);
    return ves_twos_quick(s.hi, s.lo + t.lo);
}

VES_TWO_INLINE ves_twos ves_twos_negative(ves_twos a)
{
    return (ves_twos){-a.hi, -a.lo};
}

VES_TWO_INLINE ves_twos ves_twos_subtract(ves_twos a, ves_twos b)
{
    return ves_twos_add(a, ves_twos_negative(b));
}

VES_TWO_INLINE ves_twos ves_twos_multiply(ves_twos a, ves_twos b)
{
    ves_twos p = ves_twos_product(a.hi, b.hi);
    return ves_twos_quick(p.hi, p.lo + (a.hi * b.lo + a.lo * b.hi));
}

/* Times one number in all lanes. */
VES_TWO_INLINE ves_twos ves_twos_times(ves_twos a, ves_two b)
{
    return ves_twos_multiply(a, ves_twos_of(b));
}

/* sum + a b, for sums of many products: the low parts are added up as they come, half the work of add and
 * multiply; ves_twos_sum(sum.hi, sum.lo) at the end. Off by 1e-32 of the sum of |a b| or so [Ogita, Rump,
 * Oishi 2005]. */
VES_TWO_INLINE ves_twos ves_twos_gather(ves_twos sum, ves_twos a, ves_twos b)
{
    ves_twos p = ves_twos_product(a.hi, b.hi), s = ves_twos_sum(sum.hi, p.hi);
    ves_lanes low = ves_lanes_fma(a.hi, b.lo, ves_lanes_fma(a.lo, b.hi, p.lo));
    return (ves_twos){s.hi, sum.lo + (s.lo + low)};
}

/* Exact: by a power of 2. */
VES_TWO_INLINE ves_twos ves_twos_shift(ves_twos a, double power)
{
    return (ves_twos){a.hi * power, a.lo * power};
}

VES_TWO_INLINE ves_two ves_twos_lane(const ves_twos *a, int k)
{
    return (ves_two){a->hi[k], a->lo[k]};
}

VES_TWO_INLINE void ves_twos_put(ves_twos *a, int k, ves_two x)
{
    a->hi[k] = x.hi, a->lo[k] = x.lo;
}

/* twofold.c: e^x; 0 where it would be below 1e-300. For x <= 0. */
ves_twos ves_twos_exp(ves_twos x);

#endif

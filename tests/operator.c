/* Operators: which are elliptic, and the factors of those that are. */
#include "surface/operator.h"

#include <criterion/criterion.h>
#include <math.h>
#include <mpfr.h>

#include "base/random.h"
#include "surface/factor.h"

/* c_0 prod (t + s_i) of real s_i. */
static ves_operator product(int N, const double *s, double c0)
{
    ves_operator op = {.power = N, .general = true, .parameter = {c0}};
    for (int i = 0; i < N; i++)
        for (int k = i + 1; k > 0; k--) op.parameter[k] += s[i] * op.parameter[k - 1];
    return op;
}

static double value(const ves_operator *op, double t)
{
    double sum = 0;
    for (int k = 0; k <= op->power; k++) sum = sum * t + op->parameter[k];
    return sum;
}

Test(operator, positive_polynomials_are_elliptic)
{
    double t, s[6] = {1e-3, 0.2, 1, 3, 40, 900};
    for (int N = 1; N <= 6; N++) {
        ves_operator op = product(N, s, 1);
        cr_expect(ves_operator_elliptic(&op, &t), "%d", N);
    }
    /* negative coefficients too, as long as no root lies at t >= 0 [Huang 2012: b > -2 sqrt(ac)] */
    ves_operator fourth = {.power = 2, .general = true, .parameter = {1, -1.999, 1}};
    cr_expect(ves_operator_elliptic(&fourth, &t));
    fourth.parameter[1] = -2.001;
    cr_expect(ves_operator_elliptic(&fourth, &t) == false && value(&fourth, t) <= 0);
    ves_operator sixth = {.power = 3, .general = true, .parameter = {1, -1.5, 0.6, 0.1}};
    cr_expect(ves_operator_elliptic(&sixth, &t));
    ves_operator power = {.power = 3, .parameter = {0}};
    cr_expect(ves_operator_elliptic(&power, &t));
    power.parameter[0] = -1;
    cr_expect(ves_operator_elliptic(&power, &t) == false);
}

/* A place where it is not positive is told. */
Test(operator, waves_are_found)
{
    double s[6] = {0.5, 2, -3, 4, 1, 7}, t;
    for (int N = 3; N <= 6; N++) {
        ves_operator op = product(N, s, 2.5);
        cr_expect(ves_operator_elliptic(&op, &t) == false && t >= 0 && value(&op, t) <= 0, "%d: t = %g", N,
                  t);
    }
}

Test(operator, touching_zero_is_not_elliptic)
{
    double twice[2] = {-1.25, -1.25}, at_zero[2] = {0, 1}, t;
    ves_operator op = product(2, twice, 1);
    cr_expect(ves_operator_elliptic(&op, &t) == false && fabs(t - 1.25) < 1e-6, "t = %.17g", t);
    op = product(2, at_zero, 1);
    cr_expect(ves_operator_elliptic(&op, &t) == false && t == 0);
    op.parameter[0] = 0; /* at infinity */
    cr_expect(ves_operator_elliptic(&op, &t) == false && t == HUGE_VAL);
}

Test(operator, scales_do_not_matter)
{
    for (double unit = 1e-300; unit < 1e300; unit *= 1e30)
        for (double scale = 1e-40; scale < 1e45; scale *= 1e10) {
            double good[3] = {scale, 2 * scale, 3 * scale}, bad[3] = {scale, 2 * scale, -3 * scale}, t;
            double last = unit * 6 * scale * scale * scale;
            if (!(last < 1e300 && last > 1e-300)) continue;
            ves_operator op = product(3, good, unit);
            cr_expect(ves_operator_elliptic(&op, &t), "%g %g", unit, scale);
            op = product(3, bad, unit);
            cr_expect(ves_operator_elliptic(&op, &t) == false && t >= 0 && t <= 3.01 * scale &&
                          value(&op, t) <= 0,
                      "%g %g: t %g", unit, scale, t);
        }
    double t;
    ves_operator op = {.power = 1, .general = true, .parameter = {1, HUGE_VAL}};
    cr_expect(ves_operator_elliptic(&op, &t) == false);
    op.parameter[1] = NAN;
    cr_expect(ves_operator_elliptic(&op, &t) == false);
}

/* What is positive is elliptic, whatever overflows on the way; what cannot be solved for its size is told apart. */
Test(operator, sizes_are_told_apart_from_signs)
{
    static const struct {
        double c[3];
        bool solvable;
        int odd;
    } row[] = {{{1e-300, 2, 1e300}, false, 0}, {{1, 1e200, 1}, false, 1},
               {{1e-200, 2, 1e200}, false, 0}, {{1e-310, 2e-310, 1e-310}, false, 0},
               {{1, 2e15, 1}, false, -1},      {{1, 1e13, 2}, false, -1},
               {{1, 20000, 1e8}, true, -1},    {{1e-90, 2e-90, 1e-90}, true, -1},
               {{1, 0, 1}, true, -1},          {{1, 2e12, 1e24}, true, -1},
               {{2, -1e-3, 3}, true, -1}};
    double t;
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        ves_operator op = {.power = 2, .general = true};
        for (int i = 0; i < 3; i++) op.parameter[i] = row[k].c[i];
        ves_operator_size s = ves_operator_measure(&op);
        cr_expect(ves_operator_elliptic(&op, &t), "row %zu: t = %g", k, t);
        cr_expect(s.solvable == row[k].solvable && s.odd == row[k].odd, "row %zu: %g %g %d", k, s.fast,
                  s.slow, s.odd);
    }
    ves_operator op = {.power = 2, .general = true, .parameter = {1e-300, -1, 1e300}};
    cr_expect(ves_operator_elliptic(&op, &t) && ves_operator_measure(&op).solvable == false);
    op.parameter[0] = 1e-200, op.parameter[1] = -3, op.parameter[2] = 1e200;
    cr_expect(ves_operator_elliptic(&op, &t) == false && t > 1e199 && t < 1e201, "t = %g", t);
    double s[2] = {16, 81};
    ves_operator_size size = ves_operator_measure(
        &(ves_operator){.power = 2, .general = true, .parameter = {3, 3 * (s[0] + s[1]), 3 * s[0] * s[1]}});
    cr_expect(size.fast > 9 && size.fast < 18 && size.slow < 4 && size.slow > 2, "%g %g", size.fast,
              size.slow);
}

/* Random polynomials: elliptic or not, as 200000 places say. */
Test(operator, agrees_with_looking)
{
    ves_random random = {.seed = 3};
    int found[2] = {0, 0};
    for (int k = 0; k < 400; k++) {
        ves_operator op = {.power = 1 + k % 6, .general = true, .parameter = {1}};
        double least = HUGE_VAL, t;
        for (int i = 1; i <= op.power; i++) op.parameter[i] = 3 * ves_random_uniform(&random) - 0.7;
        for (int i = 0; i <= 200000 && least > 0; i += 7) least = fmin(least, value(&op, i * 5e-5));
        bool elliptic = ves_operator_elliptic(&op, &t);
        found[elliptic]++;
        if (fabs(least) > 1e-6) cr_expect(elliptic == (least > 0), "%d: least %g", k, least);
        if (elliptic == false) cr_expect(value(&op, t) <= 1e-12, "%d: t %g", k, t);
    }
    cr_expect(found[0] > 50 && found[1] > 50, "%d %d", found[0], found[1]);
}

/* --- factors: prod (r + r_i) of known r_i > 0, in MPFR --- */

enum { BITS = 300 };

static void check_factor(int N, const double *r, double bar)
{
    mpfr_t q[VES_GENERAL_MAX + 1], x;
    mpfr_init2(x, BITS);
    double s[VES_GENERAL_MAX];
    for (int i = 0; i < N; i++) s[i] = -r[i] * r[i];
    ves_operator op = product(N, s, 1.5); /* prod (r^2 - r_i^2), c_k (-1)^k */
    for (int k = 1; k <= N; k += 2) op.parameter[k] = -op.parameter[k];
    ves_factor f;
    ves_factor_make(&op, false, &f);
    for (int k = 0; k <= N; k++) mpfr_init2(q[k], BITS), mpfr_set_ui(q[k], k == 0, MPFR_RNDN);
    for (int i = 0; i < N; i++) /* times (r + r_i): q[k] of r^k */
        for (int k = i + 1; k >= 0; k--) {
            mpfr_mul_d(q[k], q[k], r[i], MPFR_RNDN);
            if (k > 0) mpfr_add(q[k], q[k], q[k - 1], MPFR_RNDN);
        }
    for (int k = 0; k < N; k++) {
        mpfr_set_d(x, f.q[k].hi, MPFR_RNDN);
        mpfr_add_d(x, x, f.q[k].lo, MPFR_RNDN);
        for (int i = k; i < N; i++) mpfr_mul_d(x, x, f.rate, MPFR_RNDN);
        mpfr_sub(x, x, q[k], MPFR_RNDN);
        mpfr_div(x, x, q[k], MPFR_RNDN);
        double miss = fabs(mpfr_get_d(x, MPFR_RNDN));
        cr_expect(miss <= bar, "N %d, r_0 %g: q_%d misses by %.2g", N, r[0], k, miss);
    }
    double most = 0;
    for (int i = 0; i < N; i++) most = fmax(most, r[i]);
    cr_expect(f.rate >= most * 0.999 / 2 && f.rate <= 2 * N * most, "rate %g of %g", f.rate, most);
    for (int k = 0; k <= N; k++) mpfr_clear(q[k]);
    mpfr_clear(x);
}

/* Digits are lost where a root is far below the largest: its part of P is small beside the others. */
Test(operator, factors_are_those_of_the_roots)
{
    static const double distinct[] = {0.5, 1, 1.5, 2, 2.5, 3}, equal[] = {1, 1, 1, 1, 1, 1},
                        near[] = {1, 1 + 0x1p-7, 1 - 0x1p-7, 1 + 0x1p-6, 1, 1},
                        spread[] = {20, 1, 16, 2, 8, 4}, large[] = {3e5, 2e5, 1e5, 2e5, 3e5, 4e5};
    for (int N = 1; N <= VES_GENERAL_MAX; N++) {
        check_factor(N, distinct, 1e-27);
        check_factor(N, equal, 1e-27);
        check_factor(N < 5 ? N : 4, near, 1e-27);
        check_factor(N, spread, 1e-25);
        check_factor(N < 2 ? N : 2, large, 1e-27);
    }
}

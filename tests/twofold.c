/* Double-double arithmetic against MPFR, alone and in registers. */
#include "surface/twofold.h"

#include <criterion/criterion.h>
#include <mpfr.h>

#include "base/random.h"

enum { BITS = 400, CASES = 20000 };

static ves_two two_of(ves_random *random, int spread)
{
    double hi =
        ldexp(ves_random_uniform(random) - 0.5, (int)(ves_random_uniform(random) * 2 * spread) - spread);
    return ves_two_quick(hi, hi * 0x1p-53 * (ves_random_uniform(random) - 0.5));
}

static void set(mpfr_t out, ves_two x)
{
    mpfr_set_d(out, x.hi, MPFR_RNDN);
    mpfr_add_d(out, out, x.lo, MPFR_RNDN);
}

/* |got - want| / |want| */
static double error(ves_two got, mpfr_t want)
{
    mpfr_t x;
    mpfr_init2(x, BITS);
    set(x, got);
    mpfr_sub(x, x, want, MPFR_RNDN);
    if (mpfr_zero_p(want) == 0) mpfr_div(x, x, want, MPFR_RNDN);
    double e = fabs(mpfr_get_d(x, MPFR_RNDN));
    mpfr_clear(x);
    return e;
}

static ves_two in_registers(int operation, ves_two a, ves_two b)
{
    ves_twos x = ves_twos_of(a), y = ves_twos_of(b), z;
    z = operation == 0   ? ves_twos_add(x, y)
        : operation == 1 ? ves_twos_subtract(x, y)
                         : ves_twos_multiply(x, y);
    for (int k = 1; k < VES_LANES; k++) cr_assert(z.hi[k] == z.hi[0] && z.lo[k] == z.lo[0]);
    return ves_twos_lane(&z, VES_LANES - 1);
}

/* The published bounds: 3 u^2 for sums, 7 u^2 for products, 15 u^2 for quotients, u = 2^-53 (1.2e-32). */
Test(twofold, arithmetic_agrees)
{
    ves_random random = {.seed = 7};
    mpfr_t x, y, z;
    mpfr_inits2(BITS, x, y, z, (mpfr_ptr)0);
    for (int k = 0; k < CASES; k++) {
        ves_two a = two_of(&random, k % 60 + 1), b = two_of(&random, k % 40 + 1);
        set(x, a), set(y, b);
        mpfr_add(z, x, y, MPFR_RNDN);
        cr_assert(error(ves_two_add(a, b), z) <= 4e-32 && error(in_registers(0, a, b), z) <= 4e-32);
        mpfr_sub(z, x, y, MPFR_RNDN);
        cr_assert(error(ves_two_subtract(a, b), z) <= 4e-32 && error(in_registers(1, a, b), z) <= 4e-32);
        mpfr_mul(z, x, y, MPFR_RNDN);
        cr_assert(error(ves_two_multiply(a, b), z) <= 9e-32 && error(in_registers(2, a, b), z) <= 9e-32);
        mpfr_mul_d(z, x, b.hi, MPFR_RNDN);
        cr_assert(error(ves_two_times(a, b.hi), z) <= 5e-32);
        mpfr_div(z, x, y, MPFR_RNDN);
        cr_assert(error(ves_two_divide(a, b), z) <= 2e-31);
    }
    mpfr_clears(x, y, z, (mpfr_ptr)0);
}

/* Differences of nearly equal numbers lose nothing that was there. */
Test(twofold, subtraction_of_neighbours_is_as_good_as_they_are)
{
    ves_two a = {1, 0x1p-54}, b = {1, -0x1p-60};
    ves_two d = ves_two_subtract(a, b);
    cr_expect(d.hi == 0x1p-54 + 0x1p-60 && d.lo == 0);
}

Test(twofold, inverses_of_whole_numbers)
{
    mpfr_t z;
    mpfr_init2(z, BITS);
    for (int i = 1; i < 400; i++) {
        mpfr_set_ui(z, 1, MPFR_RNDN);
        mpfr_div_ui(z, z, (unsigned long)i, MPFR_RNDN);
        cr_assert(error(ves_two_inverse(i), z) <= 1.3e-32, "%d: %g", i, error(ves_two_inverse(i), z));
    }
    mpfr_clear(z);
}

/* Sums of forty products, which cancel to 1e-6 or so: off by 3e-31 of the sum of their sizes. */
Test(twofold, sums_of_products_agree)
{
    enum { TERMS = 40 };
    ves_random random = {.seed = 8};
    mpfr_t x, y, want, size;
    mpfr_inits2(BITS, x, y, want, size, (mpfr_ptr)0);
    for (int k = 0; k < CASES / 20; k++) {
        ves_twos sum = {{0}, {0}};
        mpfr_set_ui(want, 0, MPFR_RNDN), mpfr_set_ui(size, 0, MPFR_RNDN);
        for (int i = 0; i < TERMS; i++) {
            ves_two a = two_of(&random, 10), b = two_of(&random, 10);
            sum = ves_twos_gather(sum, ves_twos_of(a), ves_twos_of(b));
            set(x, a), set(y, b);
            mpfr_mul(x, x, y, MPFR_RNDN);
            mpfr_add(want, want, x, MPFR_RNDN);
            mpfr_abs(x, x, MPFR_RNDN);
            mpfr_add(size, size, x, MPFR_RNDN);
        }
        sum = ves_twos_sum(sum.hi, sum.lo);
        double relative = mpfr_get_d(size, MPFR_RNDN) / fabs(mpfr_get_d(want, MPFR_RNDN));
        double miss = error(ves_twos_lane(&sum, 3), want) / relative;
        cr_assert(miss <= 3e-31, "%.3g", miss);
    }
    mpfr_clears(x, y, want, size, (mpfr_ptr)0);
}

/* e^x, x <= 0: the error grows with |x|, whose own digits and those of ln 2 end. Low parts underflow below 1e-290,
 * all below e^-690. */
Test(twofold, exponentials_agree)
{
    ves_random random = {.seed = 9};
    mpfr_t z;
    mpfr_init2(z, BITS);
    for (int k = 0; k < CASES; k++) {
        double most = k % 4 == 0 ? 1 : k % 4 == 1 ? 30 : 660;
        ves_two x = two_of(&random, 1);
        x = ves_two_times((ves_two){-fabs(x.hi), x.hi < 0 ? x.lo : -x.lo}, most);
        if (x.hi < -660) continue;
        ves_twos e = ves_twos_exp(ves_twos_of(x));
        set(z, x);
        mpfr_exp(z, z, MPFR_RNDN);
        double miss = error(ves_twos_lane(&e, k % VES_LANES), z);
        cr_assert(miss <= 1e-31 * fmax(1, -x.hi / 5), "%.17g: %.3g", x.hi, miss);
    }
    mpfr_clear(z);
    ves_twos e = ves_twos_exp((ves_twos){{0, -700, -1e300, -689, -1e-300, 0, -1, -2}, {0}});
    cr_expect(e.hi[0] == 1 && e.lo[0] == 0 && e.hi[1] == 0 && e.hi[2] == 0 && e.hi[3] > 0 && e.hi[4] == 1);
}

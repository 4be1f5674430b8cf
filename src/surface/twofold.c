#include "surface/twofold.h"

/* x = k ln 2 + 2^HALVINGS r, |r| <= 1.4e-3: ten terms leave 1e-34 of e^r - 1, which squaring keeps. */
enum { HALVINGS = 8, TERMS = 10 };

static const ves_two LN2 = {0x1.62e42fefa39efp-1, 0x1.abc9e3b39803fp-56};
static const double LEAST = -690;

/* 1 / k!, k = 1 .. TERMS. */
static const ves_two INVERSE[TERMS] = {
    {0x1.0000000000000p+0, 0x0.0p+0},
    {0x1.0000000000000p-1, 0x0.0p+0},
    {0x1.5555555555555p-3, 0x1.5555555555555p-57},
    {0x1.5555555555555p-5, 0x1.5555555555555p-59},
    {0x1.1111111111111p-7, 0x1.1111111111111p-63},
    {0x1.6c16c16c16c17p-10, -0x1.f49f49f49f49fp-65},
    {0x1.a01a01a01a01ap-13, 0x1.a01a01a01a01ap-73},
    {0x1.a01a01a01a01ap-16, 0x1.a01a01a01a01ap-76},
    {0x1.71de3a556c734p-19, -0x1.c154f8ddc6c00p-73},
    {0x1.27e4fb7789f5cp-22, 0x1.cbbc05b4fa99ap-76},
};

ves_twos ves_twos_exp(ves_twos x)
{
    ves_lanes k, power;
    for (int i = 0; i < VES_LANES; i++) {
        bool none = x.hi[i] < LEAST;
        if (none) x.hi[i] = x.lo[i] = 0;
        k[i] = nearbyint(x.hi[i] / LN2.hi);
        power[i] = none ? 0 : ldexp(1, (int)k[i]);
    }
    ves_twos whole = {k, (ves_lanes){0}};
    ves_twos r = ves_twos_subtract(x, ves_twos_times(whole, LN2));
    r = ves_twos_shift(r, 0x1p-8);
    _Static_assert(HALVINGS == 8, "the shift above");
    ves_twos sum = ves_twos_of(INVERSE[TERMS - 1]);
    for (int i = TERMS - 1; i >= 1; i--)
        sum = ves_twos_add(ves_twos_multiply(sum, r), ves_twos_of(INVERSE[i - 1]));
    sum = ves_twos_multiply(sum, r);   /* e^r - 1 */
    for (int i = 0; i < HALVINGS; i++) /* e^2r - 1 = (e^r - 1)^2 + 2 (e^r - 1) */
        sum = ves_twos_add(ves_twos_multiply(sum, sum), ves_twos_shift(sum, 2));
    sum = ves_twos_add(sum, ves_twos_of(ves_two_of(1)));
    return (ves_twos){sum.hi * power, sum.lo * power};
}

/* Each statistic against a closed form, an enumeration or a printed table. */
#include <criterion/criterion.h>
#include <math.h>

#include "suite/statistics.h"

#define NEAR(got, want, tolerance, what)                                                                     \
    cr_expect(fabs((got) - (want)) <= (tolerance), "%s: got %.12g, want %.12g", what, (double)(got),         \
              (double)(want))

/* [Newcombe 1998, Statistics in Medicine 17, table I, method 3]: 81/263, 15/148, 0/20, 1/29, to the four
 * digits printed; and the roots of (p - s)^2 = z^2 s (1 - s)/n. */
Test(suite_statistics, wilson)
{
    static const struct {
        int hits, n;
        double low, high;
    } list[] = {
        {81, 263, 0.2553, 0.3662}, {15, 148, 0.0624, 0.1605}, {0, 20, 0, 0.1611}, {1, 29, 0.0061, 0.1718}};
    for (int k = 0; k < 4; k++) {
        ves_interval s = ves_statistics_share(list[k].hits, list[k].n);
        NEAR(s.low, list[k].low, 5e-5, "low");
        NEAR(s.high, list[k].high, 5e-5, "high");
    }
    for (int n = 1; n < 30; n += 4)
        for (int hits = 0; hits <= n; hits++) {
            ves_interval s = ves_statistics_share(hits, n);
            double z2 = 1.959963984540054 * 1.959963984540054;
            NEAR((s.value - s.low) * (s.value - s.low), z2 * s.low * (1 - s.low) / n, 1e-14, "root");
            NEAR((s.value - s.high) * (s.value - s.high), z2 * s.high * (1 - s.high) / n, 1e-14, "root");
        }
    cr_expect(isnan(ves_statistics_share(0, 0).value));
}

Test(suite_statistics, expected_running_time)
{
    const double spent[] = {10, 20, 100, 100};
    const bool hit[] = {true, true, false, false}, none[4] = {false};
    ves_interval e = ves_statistics_ert(spent, hit, 4, 1);
    NEAR(e.value, 115, 0, "ert");
    cr_expect(e.low >= 10 && e.low < 115 && e.high > 115);
    cr_expect(isinf(ves_statistics_ert(spent, none, 4, 1).low));
    ves_interval again = ves_statistics_ert(spent, hit, 4, 1);
    cr_expect(again.low == e.low && again.high == e.high);
    /* All runs hit: the bootstrap of a mean, whose standard error is s sqrt((n-1)/n)/sqrt(n): for 0 ... 99
     * that is sqrt((100^2 - 1)/12)/10 = 2.887. A 2.5 % quantile of 1000 samples has a standard error of
     * sqrt(0.025 * 0.975/1000)/0.0584 = 0.085 of that, the mean of 40 such 0.04; three of these, and 0.03 for
     * what the bootstrap of 100 runs is off the normal distribution. */
    double x[100];
    bool all[100];
    for (int k = 0; k < 100; k++) x[k] = k, all[k] = true;
    double low = 0, high = 0;
    for (uint64_t seed = 0; seed < 40; seed++) {
        e = ves_statistics_ert(x, all, 100, seed);
        NEAR(e.value, 49.5, 1e-12, "mean");
        low += e.low / 40, high += e.high / 40;
    }
    NEAR(low, 49.5 - 1.96 * 2.887, 0.15, "low");
    NEAR(high, 49.5 + 1.96 * 2.887, 0.15, "high");
}

Test(suite_statistics, quantiles)
{
    double x[] = {3, INFINITY, 1, 2, 5};
    ves_statistics_sort(x, 5);
    NEAR(ves_statistics_quantile(x, 5, 0.5), 3, 0, "median");
    NEAR(ves_statistics_quantile(x, 5, 0.25), 2, 0, "quartile");
    NEAR(ves_statistics_quantile(x, 5, 0.625), 4, 0, "between");
    cr_expect(isinf(ves_statistics_quantile(x, 5, 0.9)) && isinf(ves_statistics_quantile(x, 5, 1)));
}

Test(suite_statistics, effect)
{
    const double a[] = {1, 2, 3}, b[] = {4, 5, 6}, c[] = {2, 2, INFINITY};
    NEAR(ves_statistics_effect(a, 3, b, 3), 1, 0, "all less");
    NEAR(ves_statistics_effect(b, 3, a, 3), 0, 0, "none less");
    NEAR(ves_statistics_effect(a, 3, a, 3), 0.5, 1e-15, "the same");
    /* 1 < 2, 2, inf: 3; 2 = 2, 2 and < inf: 2; 3 < inf: 1. Of 9. */
    NEAR(ves_statistics_effect(a, 3, c, 3), 6.0 / 9, 1e-15, "ties");
}

/* The table of [Wilcoxon 1945]: n = 8, smaller sum 3, p = 0.039 (10/256); all of one sign: 2/2^n. */
Test(suite_statistics, wilcoxon)
{
    const double zero[8] = {0}, up[] = {1, 2, 3, 4, 5, 6, 7, 8}, mixed[] = {1, 2, -3, 4, 5, 6, 7, 8};
    NEAR(ves_statistics_paired(up, zero, 8).p, 2.0 / 256, 1e-15, "all greater");
    NEAR(ves_statistics_paired(zero, up, 8).p, 2.0 / 256, 1e-15, "all less");
    NEAR(ves_statistics_paired(mixed, zero, 8).p, 10.0 / 256, 1e-15, "sum 3");
    NEAR(ves_statistics_paired(zero, zero, 8).p, 1, 0, "no difference");
    const double lost[] = {INFINITY, INFINITY, 5, 5}, won[] = {INFINITY, 3, 3, 3};
    NEAR(ves_statistics_paired(lost, won, 4).p, 2.0 / 8, 1e-15, "three of one sign, two tied");
    /* [Hollander and Wolfe, Nonparametric Statistical Methods, example 3.1]: depression factors of nine
     * patients; the sum is 5, two-sided p = 0.0390625 */
    const double x[] = {1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
    const double y[] = {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
    NEAR(ves_statistics_paired(x, y, 9).p, 0.0390625, 1e-12, "Hollander and Wolfe");
    NEAR(ves_statistics_paired(up, zero, 8).lead, -1, 0, "x is greater throughout");
    NEAR(ves_statistics_paired(mixed, zero, 8).lead, (3.0 - 33) / 36, 1e-15, "rank 3 against all others");
    NEAR(ves_statistics_paired(zero, zero, 8).lead, 0, 0, "nobody leads");
    NEAR(ves_statistics_least(5), 0.0625, 0, "five runs");
    NEAR(ves_statistics_least(0), 1, 0, "no run");
}

/* By hand: 0.01 * 4, 0.02 * 3, 0.03 * 2 -> 0.06, 0.5. */
Test(suite_statistics, holm)
{
    double p[] = {0.03, 0.01, NAN, 0.5, 0.02};
    const double want[] = {0.06, 0.04, NAN, 0.5, 0.06};
    ves_statistics_holm(p, 5);
    for (int k = 0; k < 5; k++)
        cr_expect(k == 2 ? isnan(p[k]) : fabs(p[k] - want[k]) < 1e-15, "%d: got %g, want %g", k, p[k],
                  want[k]);
    double same[] = {0.04, 0.04, 0.9}, none[] = {NAN};
    ves_statistics_holm(same, 3);
    cr_expect(fabs(same[0] - 0.12) < 1e-15 && same[1] == same[0] && same[2] == 0.9, "%g %g %g", same[0],
              same[1], same[2]);
    ves_statistics_holm(none, 1);
}

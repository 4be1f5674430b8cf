/* Weight tables against an oracle: the same cardinal functions from the textbook basis u^k e^{+-lam u} (u^k
 * for lam = 0), solved with MPFR by Gaussian elimination. That basis loses about 3 lam bits (and 20 powers of
 * small lam): `bits` leaves hundreds. */
#include <criterion/criterion.h>
#include <math.h>
#include <mpfr.h>
#include <stdlib.h>

#include "surface/weights.h"

enum { PLACES = 11, MOST = 4, ROOM = 20000 };

static ves_operator power_of(const ves_layout *layout, double a)
{
    return (ves_operator){.power = layout->power, .parameter = {a}};
}

/* At lam: mode 1 of a = lam. */
static void row_at(const ves_layout *layout, double lam, const double *u, double *weight, double *slope,
                   double *room)
{
    ves_operator op = power_of(layout, lam);
    cr_assert(ves_weights_room(layout, PLACES) <= ROOM, "%ld", ves_weights_room(layout, PLACES));
    cr_assert_eq(ves_weights_mode(layout, &op, 1, PLACES, u,
                                  &(ves_table){.weight = weight, .slope = slope, .room = room}),
                 VES_OK);
}

static long bits(double lam)
{
    return 800 + (long)(5 * lam);
}

static const ves_layout LAYOUT[] = {
    {.power = 1, .knot = {{0, 0}, {1, 0}}},
    {.power = 1, .knot = {{0, 0}, {1, 1}}},
    {.power = 1, .knot = {{0, 1}, {1, 0}}},
    {.power = 2, .knot = {{0, 0}, {0, 1}, {1, 0}, {1, 1}}},
    {.power = 2, .knot = {{1, 1}, {0, 0}, {1, 0}, {0, 1}}}, /* the order of the conditions is the caller's */
};
enum { LAYOUTS = sizeof LAYOUT / sizeof *LAYOUT };

/* d-th derivative of member m of the textbook basis at u: u^k e^{s lam u}, k = m / 2, s = +-1 (lam > 0); u^m
 * (lam = 0). */
static void member(int m, int d, double lam, double u, mpfr_t out)
{
    mpfr_t x, term;
    mpfr_inits2(bits(lam), x, term, (mpfr_ptr)0);
    int k = lam > 0 ? m / 2 : m;
    double rate = lam > 0 ? (m % 2 ? -lam : lam) : 0;
    mpfr_set_ui(out, 0, MPFR_RNDN);
    for (int j = 0; j <= d; j++) { /* Leibniz: C(d,j) (u^k)^(j) rate^(d-j) */
        if (j > k || (d > j && rate == 0)) continue;
        double c = j == 0 || j == d ? 1 : d == 2 ? 2 : 3; /* C(d, j) for d <= 3 */
        for (int f = 0; f < j; f++) c *= k - f;
        mpfr_set_d(x, u, MPFR_RNDN);
        mpfr_pow_ui(term, x, (unsigned long)(k - j), MPFR_RNDN);
        for (int f = 0; f < d - j; f++) mpfr_mul_d(term, term, rate, MPFR_RNDN);
        mpfr_mul_d(term, term, c, MPFR_RNDN);
        mpfr_add(out, out, term, MPFR_RNDN);
    }
    mpfr_set_d(x, rate, MPFR_RNDN);
    mpfr_mul_d(x, x, u, MPFR_RNDN);
    mpfr_exp(x, x, MPFR_RNDN);
    mpfr_mul(out, out, x, MPFR_RNDN);
    mpfr_clears(x, term, (mpfr_ptr)0);
}

typedef struct oracle {
    int n;
    mpfr_t a[MOST][2 * MOST]; /* the condition matrix and, after solving, its inverse in the right half */
    mpfr_t slope[MOST][MOST]; /* the derivative of that inverse with respect to lam */
} oracle;

/* d/dlam of member m: u^k e^{s lam u} becomes s u^(k+1) e^{s lam u}, s times the member after next. The
 * cardinal functions are even in lam (the operator holds lam^2): at 0 nothing changes. */
static void member_slope(int m, int d, double lam, double u, mpfr_t out)
{
    member(m + 2, d, lam, u, out);
    if (m % 2) mpfr_neg(out, out, MPFR_RNDN);
    if (lam == 0) mpfr_set_ui(out, 0, MPFR_RNDN);
}

/* d A^-1 = -A^-1 dA A^-1 */
static void oracle_slopes(oracle *o, const ves_layout *layout, double lam)
{
    int n = o->n;
    mpfr_t change[MOST][MOST], f; /* dA A^-1 */
    mpfr_init2(f, bits(lam));
    for (int r = 0; r < n; r++)
        for (int j = 0; j < n; j++) {
            mpfr_init2(change[r][j], bits(lam));
            mpfr_set_ui(change[r][j], 0, MPFR_RNDN);
            for (int m = 0; m < n; m++) {
                member_slope(m, layout->knot[r].derivative, lam, layout->knot[r].u, f);
                mpfr_mul(f, f, o->a[m][n + j], MPFR_RNDN);
                mpfr_add(change[r][j], change[r][j], f, MPFR_RNDN);
            }
        }
    for (int m = 0; m < n; m++)
        for (int j = 0; j < n; j++) {
            mpfr_init2(o->slope[m][j], bits(lam));
            mpfr_set_ui(o->slope[m][j], 0, MPFR_RNDN);
            for (int r = 0; r < n; r++) {
                mpfr_mul(f, o->a[m][n + r], change[r][j], MPFR_RNDN);
                mpfr_sub(o->slope[m][j], o->slope[m][j], f, MPFR_RNDN);
            }
        }
    for (int r = 0; r < n; r++)
        for (int j = 0; j < n; j++) mpfr_clear(change[r][j]);
    mpfr_clear(f);
}

static void oracle_solve(oracle *o, const ves_layout *layout, double lam)
{
    int n = o->n = 2 * layout->power;
    mpfr_t f;
    mpfr_init2(f, bits(lam));
    for (int r = 0; r < n; r++)
        for (int c = 0; c < 2 * n; c++) {
            mpfr_init2(o->a[r][c], bits(lam));
            if (c < n)
                member(c, layout->knot[r].derivative, lam, layout->knot[r].u, o->a[r][c]);
            else
                mpfr_set_ui(o->a[r][c], c - n == r, MPFR_RNDN);
        }
    for (int p = 0; p < n; p++) {
        int best = p;
        for (int r = p + 1; r < n; r++)
            if (mpfr_cmpabs(o->a[r][p], o->a[best][p]) > 0) best = r;
        for (int c = 0; c < 2 * n; c++) mpfr_swap(o->a[p][c], o->a[best][c]);
        for (int c = 2 * n - 1; c >= p; c--) mpfr_div(o->a[p][c], o->a[p][c], o->a[p][p], MPFR_RNDN);
        for (int r = 0; r < n; r++)
            for (int c = 2 * n - 1; r != p && c >= p; c--) {
                mpfr_mul(f, o->a[r][p], o->a[p][c], MPFR_RNDN);
                mpfr_sub(o->a[r][c], o->a[r][c], f, MPFR_RNDN);
            }
    }
    mpfr_clear(f);
    oracle_slopes(o, layout, lam);
}

static double oracle_value(const oracle *o, int j, int d, double lam, double u)
{
    mpfr_t sum, term;
    mpfr_inits2(bits(lam), sum, term, (mpfr_ptr)0);
    mpfr_set_ui(sum, 0, MPFR_RNDN);
    for (int m = 0; m < o->n; m++) {
        member(m, d, lam, u, term);
        mpfr_mul(term, term, o->a[m][o->n + j], MPFR_RNDN);
        mpfr_add(sum, sum, term, MPFR_RNDN);
    }
    double value = mpfr_get_d(sum, MPFR_RNDN);
    mpfr_clears(sum, term, (mpfr_ptr)0);
    return value;
}

/* d/dlam of oracle_value */
static double oracle_slope(const oracle *o, int j, int d, double lam, double u)
{
    mpfr_t sum, term;
    mpfr_inits2(bits(lam), sum, term, (mpfr_ptr)0);
    mpfr_set_ui(sum, 0, MPFR_RNDN);
    for (int m = 0; m < o->n; m++) {
        member_slope(m, d, lam, u, term);
        mpfr_mul(term, term, o->a[m][o->n + j], MPFR_RNDN);
        mpfr_add(sum, sum, term, MPFR_RNDN);
        member(m, d, lam, u, term);
        mpfr_mul(term, term, o->slope[m][j], MPFR_RNDN);
        mpfr_add(sum, sum, term, MPFR_RNDN);
    }
    double value = mpfr_get_d(sum, MPFR_RNDN);
    mpfr_clears(sum, term, (mpfr_ptr)0);
    return value;
}

static void oracle_clear(oracle *o)
{
    for (int r = 0; r < o->n; r++)
        for (int c = 0; c < 2 * o->n; c++) {
            mpfr_clear(o->a[r][c]);
            if (c < o->n) mpfr_clear(o->slope[r][c]);
        }
}

static void places(double *u)
{
    static const double place[PLACES] = {0, 0.003, 0.0371, 0.1, 0.25, 0.5, 0.7183, 0.85, 0.9629, 0.999, 1};
    for (int i = 0; i < PLACES; i++) u[i] = place[i];
}

/* The bar: 1e-12 of the largest value of the cardinal function, times max(1, lam)^d for derivatives. */
static void check(const ves_layout *layout, double lam)
{
    int n = 2 * layout->power;
    double u[PLACES], weight[3 * MOST * PLACES], room[ROOM] __attribute__((aligned(64)));
    places(u);
    row_at(layout, lam, u, weight, NULL, room);
    oracle o;
    oracle_solve(&o, layout, lam);
    for (int j = 0; j < n; j++) {
        double largest = 0;
        for (int i = 0; i < PLACES; i++) largest = fmax(largest, fabs(oracle_value(&o, j, 0, lam, u[i])));
        for (int d = 0; d < 3; d++)
            for (int i = 0; i < PLACES; i++) {
                double got = weight[(d * n + j) * PLACES + i], want = oracle_value(&o, j, d, lam, u[i]);
                double unit = largest * pow(fmax(1, lam), d);
                cr_assert(fabs(got - want) <= 1e-12 * unit,
                          "power %d lam %g condition %d derivative %d u %g: got %.17g want %.17g (%.2g)",
                          layout->power, lam, j, d, u[i], got, want, fabs(got - want) / unit);
            }
    }
    oracle_clear(&o);
}

Test(weights, agree_with_the_oracle_for_every_lam_up_to_1000)
{
    static const double lam[] = {0,      1e-6, 1e-3, 0.01,   0.1, 0.3,  0.7, 1,   1.4999, 1.5,
                                 1.5001, 2,    2.5,  2.9999, 3.0, 3.01, 4,   6,   8,      12,
                                 20,     30,   50,   80,     150, 300,  500, 800, 1000};
    for (int l = 0; l < LAYOUTS; l++)
        for (size_t k = 0; k < sizeof lam / sizeof *lam; k++) check(&LAYOUT[l], lam[k]);
}

/* The table of all modes uses powers of e^{-a u}: the same numbers as mode by mode, to the rounding of those
 * powers. */
Test(weights, table_agrees_with_single_modes)
{
    enum { MODES = 40 };
    for (int l = 0; l < LAYOUTS; l++)
        for (double a = 0.01; a < 30; a *= 3.7) {
            const ves_layout *layout = &LAYOUT[l];
            int row = 3 * 2 * layout->power * PLACES;
            ves_operator op = power_of(layout, a);
            double u[PLACES], one[3 * MOST * PLACES], room[ROOM] __attribute__((aligned(64))),
                *table = malloc(sizeof *table * (size_t)((MODES + 1) * row));
            places(u);
            ves_weights_bind(layout, &op, MODES, PLACES, u, &(ves_table){table, NULL, room, false});
            ves_weights_bind(layout, &op, MODES, PLACES, u,
                             &(ves_table){table, NULL, room, true}); /* mode 0 stays */
            for (int n = 0; n <= MODES; n++) {
                row_at(layout, a * n, u, one, NULL, room);
                for (int k = 0; k < row; k++) {
                    double d = k / (2 * layout->power * PLACES), unit = pow(fmax(1, a * n), d);
                    cr_assert(fabs(one[k] - table[n * row + k]) <= 1e-13 * unit,
                              "a %g mode %d entry %d: %.17g %.17g", a, n, k, one[k], table[n * row + k]);
                }
            }
            free(table);
        }
}

/* The bar: 2e-12 of the largest derivative of the cardinal function, times max(1, lam)^d for derivatives by
 * u. Seen are 6e-13 where e^{-a u} is taken to the power 40, and at the switch between the two bases, and
 * 1e-13 elsewhere. scale: what got is multiplied with, so that it is a derivative with respect to a. */
static void slopes_compare(const oracle *o, const ves_layout *layout, double lam, int mode, const double *got,
                           double scale)
{
    int n = o->n;
    double u[PLACES], want[3][PLACES];
    places(u);
    for (int j = 0; j < n; j++) {
        double largest = 0;
        for (int d = 0; d < 3; d++)
            for (int i = 0; i < PLACES; i++) {
                want[d][i] = mode * oracle_slope(o, j, d, lam, u[i]);
                if (d == 0) largest = fmax(largest, fabs(want[d][i]));
            }
        for (int d = 0; d < 3; d++)
            for (int i = 0; i < PLACES; i++) {
                double is = scale * got[(d * n + j) * PLACES + i], unit = largest * pow(fmax(1, lam), d);
                cr_assert(
                    fabs(is - want[d][i]) <= 2e-12 * unit,
                    "power %d lam %g mode %d condition %d derivative %d u %g: got %.17g want %.17g (%.2g)",
                    layout->power, lam, mode, j, d, u[i], is, want[d][i], fabs(is - want[d][i]) / unit);
            }
    }
}

/* Modes 0 and `mode` of the table for a = lam / mode, and the row that the remainder would use. */
static void slopes_check(const ves_layout *layout, double lam, int mode)
{
    int row = 3 * 2 * layout->power * PLACES;
    double u[PLACES], one[2][3 * MOST * PLACES], room[ROOM] __attribute__((aligned(64))),
        a = lam / mode, *table = malloc(sizeof *table * (size_t)(2 * (mode + 1) * row)),
        *slope = table + (mode + 1) * row;
    oracle o;
    ves_operator op = power_of(layout, a);
    places(u);
    ves_weights_bind(layout, &op, mode, PLACES, u, &(ves_table){table, slope, room, false});
    row_at(layout, a * mode, u, one[0], one[1], room);
    oracle_solve(&o, layout, a * mode);
    slopes_compare(&o, layout, a * mode, mode, slope + mode * row, 1);
    slopes_compare(&o, layout, a * mode, mode, one[1], mode);
    for (int k = 0; k < row; k++) cr_assert(slope[k] == 0, "mode 0 does not depend on a: got %g", slope[k]);
    oracle_clear(&o);
    free(table);
}

/* a = 0 and tiny ones too, where the derivative goes to 0 like a: the bar is relative to it all the same. */
Test(weights, derivatives_with_respect_to_a_agree_with_the_oracle)
{
    static const double lam[] = {0,   1e-30,  1e-12, 1e-6, 1e-3,   0.01, 0.1,  0.3, 0.7, 1, 1.4999,
                                 1.5, 1.5001, 2,     2.5,  2.9999, 3,    3.01, 4,   6,   8, 12,
                                 20,  30,     50,    80,   150,    300,  500,  800, 1000};
    static const int mode[] = {1, 7, 40};
    for (int l = 0; l < LAYOUTS; l++)
        for (int k = 0; k < (int)(sizeof lam / sizeof *lam); k++)
            slopes_check(&LAYOUT[l], lam[k], mode[(k + l) % 3]);
}

Test(weights, layouts_that_determine_nothing_are_refused)
{
    ves_layout slopes = {.power = 1, .knot = {{0, 1}, {1, 1}}},
               twice = {.power = 2, .knot = {{0, 0}, {0, 0}, {1, 0}, {1, 1}}};
    double u[PLACES], w[3 * MOST * PLACES], room[ROOM] __attribute__((aligned(64)));
    places(u);
    const ves_layout *layout[] = {&slopes, &twice};
    for (int l = 0; l < 2; l++) {
        ves_operator op = power_of(layout[l], 1);
        for (double n = 0; n < 2; n++) {
            if (l == 0 && n > 0) continue; /* slopes at both ends leave the mean alone free */
            cr_assert_eq(
                ves_weights_mode(layout[l], &op, n, PLACES, u, &(ves_table){.weight = w, .room = room}),
                VES_UNDETERMINED);
            for (int k = 0; k < 3 * 2 * layout[l]->power * PLACES; k++) cr_assert_eq(w[k], 0);
        }
    }
}

/* A straight line (power 1) and a cubic (power 2) at lam = 0: a = 0 is legal. */
Test(weights, mode_zero_is_polynomial)
{
    double u[PLACES], w[3 * MOST * PLACES], room[ROOM] __attribute__((aligned(64)));
    places(u);
    row_at(&LAYOUT[0], 0, u, w, NULL, room);
    for (int i = 0; i < PLACES; i++) {
        /* two ulp of 1 here, some operations below */
        cr_assert(fabs(w[i] - (1 - u[i])) < 4e-16 && fabs(w[PLACES + i] - u[i]) < 4e-16);
    }
    row_at(&LAYOUT[3], 0, u, w, NULL, room);
    for (int i = 0; i < PLACES; i++) {
        double t = u[i], h = 1 - 3 * t * t + 2 * t * t * t; /* Hermite's cubic of a unit value at u = 0 */
        cr_assert(fabs(w[i] - h) < 2e-15, "u %g: %.17g %.17g", t, w[i], h);
    }
}

/* Weight tables in double precision against MPFR (tests/oracle.h). */
#include <criterion/criterion.h>

#include "oracle.h"

enum { PLACES = 11, MOST = 4, ROW = 3 * MOST * PLACES, ROOM = 20000 };

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

static const ves_layout LAYOUT[] = {
    {.power = 1, .knot = {{0, 0}, {1, 0}}},
    {.power = 1, .knot = {{0, 0}, {1, 1}}},
    {.power = 1, .knot = {{0, 1}, {1, 0}}},
    {.power = 2, .knot = {{0, 0}, {0, 1}, {1, 0}, {1, 1}}},
    {.power = 2, .knot = {{1, 1}, {0, 0}, {1, 0}, {0, 1}}}, /* the order of the conditions is the caller's */
};
enum { LAYOUTS = sizeof LAYOUT / sizeof *LAYOUT };

static void places(double *u)
{
    static const double place[PLACES] = {0, 0.003, 0.0371, 0.1, 0.25, 0.5, 0.7183, 0.85, 0.9629, 0.999, 1};
    for (int i = 0; i < PLACES; i++) u[i] = place[i];
}

/* The bar: 1e-12 of the largest value of the cardinal function, times max(1, lam)^d for derivatives. */
static void check(const ves_layout *layout, double lam)
{
    int n = 2 * layout->power;
    double u[PLACES], weight[ROW], exact[ROW], room[ROOM] __attribute__((aligned(64)));
    oracle o;
    places(u);
    row_at(layout, lam, u, weight, NULL, room);
    oracle_power(&o, layout->power, lam, 800);
    oracle_doubles(&o, layout, 3, PLACES, u, exact);
    for (int j = 0; j < n; j++) {
        double largest = 0;
        for (int i = 0; i < PLACES; i++) largest = fmax(largest, fabs(exact[j * PLACES + i]));
        for (int d = 0; d < 3; d++)
            for (int i = 0; i < PLACES; i++) {
                double got = weight[(d * n + j) * PLACES + i], want = exact[(d * n + j) * PLACES + i];
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
            double u[PLACES], one[ROW], room[ROOM] __attribute__((aligned(64))),
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
static void slopes_compare(const ves_layout *layout, double lam, int mode, const double *want,
                           const double *got, double scale)
{
    int n = 2 * layout->power;
    for (int j = 0; j < n; j++) {
        double largest = 0;
        for (int i = 0; i < PLACES; i++) largest = fmax(largest, fabs(want[j * PLACES + i]));
        for (int d = 0; d < 3; d++)
            for (int i = 0; i < PLACES; i++) {
                int at = (d * n + j) * PLACES + i;
                double is = scale * got[at], unit = largest * pow(fmax(1, lam), d);
                cr_assert(fabs(is - want[at]) <= 2e-12 * unit,
                          "power %d lam %g mode %d condition %d derivative %d place %d: got %.17g want %.17g "
                          "(%.2g)",
                          layout->power, lam, mode, j, d, i, is, want[at], fabs(is - want[at]) / unit);
            }
    }
}

/* Modes 0 and `mode` of the table for a = lam / mode, and the row that the remainder would use. */
static void slopes_check(const ves_layout *layout, double lam, int mode)
{
    int row = 3 * 2 * layout->power * PLACES;
    double u[PLACES], want[ROW], one[2][ROW], room[ROOM] __attribute__((aligned(64))),
        a = lam / mode, *table = malloc(sizeof *table * (size_t)(2 * (mode + 1) * row)),
        *slope = table + (mode + 1) * row;
    ves_operator op = power_of(layout, a);
    places(u);
    ves_weights_bind(layout, &op, mode, PLACES, u, &(ves_table){table, slope, room, false});
    row_at(layout, a * mode, u, one[0], one[1], room);
    oracle_slopes(layout, a, mode, 3, PLACES, u, want);
    slopes_compare(layout, lam, mode, want, slope + mode * row, 1);
    slopes_compare(layout, lam, mode, want, one[1], mode);
    for (int k = 0; k < row; k++) cr_assert(slope[k] == 0, "mode 0 does not depend on a: got %g", slope[k]);
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
    double u[PLACES], w[ROW], room[ROOM] __attribute__((aligned(64)));
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
    double u[PLACES], w[ROW], room[ROOM] __attribute__((aligned(64)));
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

/* What layouts of conditions do: derivatives by a against MPFR differences, raised orders, how much is amplified,
 * and which layouts determine nothing. */
#include <criterion/criterion.h>
#include <string.h>

#include "oracle.h"
#include "surface/fast.h"

enum { PLACES = 13, ORDERS = 3, MOST = ORDERS * ORACLE_MOST * PLACES };

static void places(int N, double lam, double *u)
{
    static const double fixed[] = {0, 0.003, 0.0371, 0.25, 0.5, 0.7183, 0.9629, 0.999, 1};
    double l = 1 / fmax(lam, 2 * N), layer[] = {l, N * l / 2, 1 - l, 1 - N * l / 2};
    memcpy(u, fixed, sizeof fixed);
    memcpy(u + sizeof fixed / sizeof *fixed, layer, sizeof layer);
}

typedef enum kind { HERMITE, NAVIER, CHEBYSHEV, EQUISPACED, KINDS } kind;

static ves_layout layout_of(int N, kind k)
{
    ves_layout layout = {.power = N};
    for (int j = 0; j < 2 * N; j++) {
        ves_knot at[KINDS] = {{j / N, j % N},
                              {j / N, 2 * (j % N)},
                              {(1 - cos(acos(-1) * j / (2 * N - 1))) / 2, 0},
                              {(double)j / (2 * N - 1), 0}};
        layout.knot[j] = at[k];
    }
    return layout;
}

static double *room_for(const ves_layout *layout)
{
    return aligned_alloc(64, (size_t)(8 * ves_weights_room(layout, PLACES) + 63) / 64 * 64);
}

/* --- derivatives by a --- */

/* The bar of weights_oracle.c, of the size of the derivative by a, or of the cardinal function's times a n^2 (in
 * the double-double path 1e-10 of that): of what depends on a^4 or a^6 only, at small a, the rounding of the rest
 * is left. */
static void check_slope(int N, kind place, double lam, int n)
{
    ves_layout layout = layout_of(N, place);
    int columns = 2 * N, size = ORDERS * columns * PLACES;
    double u[PLACES], *want = calloc(3 * MOST, sizeof *want), *got = want + MOST, *slope = got + MOST,
                      *room = room_for(&layout);
    ves_operator op = {.power = N, .parameter = {lam / n}};
    bool fast = ves_fast_fits(&layout, &op);
    places(N, lam, u);
    oracle_slopes(&layout, lam / n, n, ORDERS, PLACES, u, want);
    ves_weights_mode(&layout, &op, n, PLACES, u, &(ves_table){.weight = got, .slope = slope, .room = room});
    for (int k = 0; k < size; k++) {
        int d = k / PLACES / columns, j = k / PLACES % columns;
        double s[2] = {0, 0};
        for (int i = 0; i < PLACES; i++) {
            s[0] = fmax(s[0], fabs(want[j * PLACES + i]));
            s[1] = fmax(s[1], fabs(want[(d * columns + j) * PLACES + i]));
        }
        double floor = 0;
        for (int i = 0; i < PLACES; i++)
            floor = fmax(floor, (fast ? 1 : 1e-10) * n * fmin(lam, 1) * fabs(got[j * PLACES + i]));
        double unit = (1e-12 + 4e-16 * lam) * fmax(s[1], fmax(floor, s[0]) * pow(fmax(1, lam), d));
        cr_assert(
            fabs(slope[k] - want[k]) <= unit,
            "order %d kind %d a n %g condition %d derivative %d at %g: got %.17g want %.17g, %.2g of the bar",
            columns, place, lam, j, d, u[k % PLACES], slope[k], want[k], fabs(slope[k] - want[k]) / unit);
    }
    free(room);
    free(want);
}

/* a = 0 and tiny ones too, where the derivative goes to 0 like a. */
Test(weights_layout, derivatives_by_a_agree_for_every_order)
{
    static const double lam[] = {0, 1e-6, 0.01, 0.5, 1, 3, 10, 24, 100, 1280};
    static const int mode[] = {1, 3, 16};
    int turn = 0;
    for (int N = 1; N <= 20; N += N < 8 ? 1 : 3)
        for (kind k = 0; k < KINDS; k++)
            for (int l = 0; l < 10; l++)
                if (N < 8 || (l + (int)k) % 3 == 0) check_slope(N, k, lam[l], mode[turn++ % 3]);
}

/* A table of all modes takes powers of e^(-a u) in the double path: as good as mode by mode. */
Test(weights_layout, tables_agree_with_single_modes)
{
    enum { MODES = 40 };
    for (int N = 1; N <= 5; N++)
        for (double a = 0.01; a < 40; a *= 3.1) {
            ves_layout layout = layout_of(N, HERMITE);
            int columns = 2 * N, size = ORDERS * columns * PLACES;
            double u[PLACES], *table = calloc((size_t)(2 * (MODES + 2) * size), sizeof *table),
                              *slope = table + (MODES + 2) * size, *room = room_for(&layout);
            double *one = table + (MODES + 1) * size, *by = slope + (MODES + 1) * size;
            ves_operator op = {.power = N, .parameter = {a}};
            places(N, 10 * a, u);
            ves_weights_bind(&layout, &op, MODES, PLACES, u, &(ves_table){table, slope, room, false});
            for (int n = 0; n <= MODES; n++) {
                double lam = a * n, unit[ORDERS] = {1, fmax(1, lam), fmax(1, lam * lam)};
                ves_weights_mode(&layout, &op, n, PLACES, u, &(ves_table){one, by, room, false});
                for (int k = 0; k < size; k++) {
                    double s = (1e-12 + 4e-16 * lam) * unit[k / PLACES / columns];
                    double miss[] = {fabs(one[k] - table[n * size + k]),
                                     fabs(by[k] - slope[n * size + k]) / (1 + n)};
                    cr_assert(miss[0] <= s && miss[1] <= s, "order %d a %g mode %d entry %d: %.3g %.3g",
                              columns, a, n, k, miss[0] / s, miss[1] / s);
                }
            }
            free(room);
            free(table);
        }
}

/* --- raised orders --- */

/* The first 2N' cardinal functions are those of the lower order; the others vanish with its conditions. */
static void check_raised(int lower, int N, kind place, double lam)
{
    ves_layout low = layout_of(lower, place), full = {.power = N, .lower = lower};
    memcpy(full.knot, low.knot, sizeof full.knot);
    for (int j = 2 * lower; j < 2 * N; j++) {
        bool ends = place == HERMITE;
        full.knot[j] = ends ? (ves_knot){j % 2, j / 2} : (ves_knot){0.27 + 0.01 * (j - 2 * lower), 0};
    }
    double u[2 * PLACES], *lone = calloc(6 * MOST, sizeof *lone), *raised = lone + 2 * MOST,
                          *slope = raised + 2 * MOST;
    double *room = room_for(&full);
    ves_operator op = {.power = N, .parameter = {lam}}, of = {.power = lower, .parameter = {lam}};
    places(N, lam, u);
    for (int j = 0; j < 2 * lower && j < PLACES; j++) u[PLACES + j] = full.knot[j].u;
    for (int part = 0; part < 2; part++) {
        int columns = 2 * N, count = part ? (int)fmin(PLACES, 2 * lower) : PLACES;
        cr_assert_eq(ves_weights_mode(&full, &op, 1, count, u + part * PLACES,
                                      &(ves_table){.weight = raised, .slope = slope, .room = room}),
                     VES_OK);
        cr_assert_eq(ves_weights_mode(&low, &of, 1, count, u + part * PLACES,
                                      &(ves_table){.weight = lone, .room = room}),
                     VES_OK);
        for (int d = 0; d < ORDERS; d++)
            for (int j = 0; j < columns; j++)
                for (int i = 0; i < count; i++) {
                    double got = raised[(d * columns + j) * count + i];
                    cr_assert(isfinite(got) && isfinite(slope[(d * columns + j) * count + i]));
                    double want = j < 2 * lower ? lone[(d * 2 * lower + j) * count + i] : 0;
                    bool here = j < 2 * lower || (part && i < 2 * lower && d == full.knot[i].derivative);
                    double unit = fmax(1, pow(lam, d));
                    if (here)
                        cr_assert(fabs(got - want) <= 2e-13 * unit,
                                  "order %d of %d, lam %g, function %d, derivative %d at %g: %.17g %.17g",
                                  2 * lower, columns, lam, j, d, u[part * PLACES + i], got, want);
                }
    }
    free(room);
    free(lone);
}

Test(weights_layout, raised_orders_keep_the_lower_solution)
{
    static const double lam[] = {0, 0.3, 2, 7, 15, 60};
    for (int l = 0; l < 6; l++) {
        check_raised(2, 3, HERMITE, lam[l]);
        check_raised(1, 4, HERMITE, lam[l]);
        check_raised(2, 5, HERMITE, lam[l]);
        check_raised(3, 4, HERMITE, lam[l]);
        if (lam[l] < 10) check_raised(2, 3, CHEBYSHEV, lam[l]);
    }
}

/* --- amplification --- */

static ves_amplification amplification(const ves_layout *layout, double lam)
{
    ves_operator op = {.power = layout->power, .parameter = {lam}};
    ves_amplification found;
    cr_assert_eq(ves_weights_amplification(layout, &op, 1, &found), VES_OK);
    return found;
}

/* The largest sum of |l_j| at so many places, Chebyshev's. */
static double oracle_lebesgue(const ves_layout *layout, double lam)
{
    enum { LOOKS = 256 };
    int n = 2 * layout->power;
    double u[LOOKS], *weight = calloc((size_t)(n * LOOKS), sizeof *weight), largest = 0;
    for (int i = 0; i < LOOKS; i++) u[i] = (1 - cos(acos(-1) * i / (LOOKS - 1))) / 2;
    oracle o;
    oracle_power(&o, layout->power, lam, 300 + 40 * layout->power);
    oracle_doubles(&o, layout, 1, LOOKS, u, weight);
    for (int i = 0; i < LOOKS; i++) {
        double sum = 0;
        for (int j = 0; j < n; j++)
            if (layout->knot[j].derivative == 0) sum += fabs(weight[j * LOOKS + i]);
        largest = fmax(largest, sum);
    }
    oracle_clear(&o);
    free(weight);
    return largest;
}

/* What an earlier study printed, in one or two digits, is at most this and not much less: it looked at fewer
 * places. */
Test(weights_layout, lebesgue_numbers_agree)
{
    static const double lam[] = {0, 10, 20, 30, 50, 100, 300};
    static const struct {
        int N;
        kind place;
        double printed[7];
    } row[] = {{2, EQUISPACED, {1.6, 3.6, 42, 8e2, 4e5, 3e12, 1e41}},
               {4, EQUISPACED, {6.7, 16, 230, 9e3, 3e7, 3e16, 2e53}},
               {7, EQUISPACED, {150, 310, 2e3, 5e4, 1e8, 6e17, 3e57}},
               {20, EQUISPACED, {2.3e9, 3.1e9, 7.4e9, 3e10, 2e12, 9e19, 4e60}},
               {2, CHEBYSHEV, {1.7, 2.1, 11, 88, 8e3, 9e8, 2e30}},
               {4, CHEBYSHEV, {2.2, 2.1, 9, 260, 4e5, 7e13, 2e47}},
               {7, CHEBYSHEV, {2.6, 2.1, 4.2, 44, 1e5, 3e14, 2e52}},
               {20, CHEBYSHEV, {3.3, 3.1, 3.2, 4.2, 53, 5e9, 4e50}}};
    for (size_t r = 0; r < sizeof row / sizeof *row; r++)
        for (int l = 0; l<7; l += row[r].N> 7 ? 2 : 1) {
            ves_layout layout = layout_of(row[r].N, row[r].place);
            double got = amplification(&layout, lam[l]).lebesgue, want = oracle_lebesgue(&layout, lam[l]);
            cr_expect(fabs(got - want) <= 1e-11 * want, "order %d kind %d lam %g: got %.17g want %.17g",
                      2 * row[r].N, row[r].place, lam[l], got, want);
            cr_expect(got > 0.85 * row[r].printed[l] && got < 1.6 * row[r].printed[l],
                      "order %d kind %d lam %g: got %.3g, printed %.2g", 2 * row[r].N, row[r].place, lam[l],
                      got, row[r].printed[l]);
        }
    for (int N = 1; N <= 20; N += 3)
        for (int l = 0; l < 7; l++) {
            ves_layout layout = layout_of(N, HERMITE);
            double got = amplification(&layout, lam[l]).lebesgue;
            cr_expect(fabs(got - 1) < 1e-12, "order %d lam %g: %.17g", 2 * N, lam[l], got);
        }
}

/* Conditions that are harmless look so, whatever units their derivatives have. */
Test(weights_layout, good_layouts_have_small_condition_numbers)
{
    static const double lam[] = {0, 0.01, 1, 6, 12, 20, 26, 30, 100, 1000};
    for (int N = 1; N <= 20; N++)
        for (int l = N % 3; l < 10; l += 3)
            for (kind k = 0; k < CHEBYSHEV; k++) {
                ves_layout layout = layout_of(N, k);
                double got = amplification(&layout, lam[l]).condition;
                cr_expect(got >= 1 - 1e-9 && got < 1e20, "order %d kind %d lam %g: %.3g", 2 * N, k, lam[l],
                          got);
            }
}

/* X(0), X(1) and X_u at 1/2 +- d leave an odd solution free where lam d tanh(lam d) = lam/2 coth(lam/2) - 1: at
 * d = 1 / (2 sqrt 3) for lam = 0, near 0.2903 for 1. */
static double free_distance(double lam)
{
    double want = lam > 0 ? lam / 2 / tanh(lam / 2) - 1 : 0, low = 0, high = 0.5;
    if (lam == 0) return 0.5 / sqrt(3);
    for (int k = 0; k < 60; k++) {
        double d = (low + high) / 2;
        *(lam * d * tanh(lam * d) < want ? &low : &high) = d;
    }
    return low;
}

Test(weights_layout, slopes_inside_without_positions_can_leave_something_free)
{
    for (double lam = 0; lam < 10; lam += lam < 1 ? 1 : 2) {
        double d = free_distance(lam);
        ves_layout layout = {.power = 2, .knot = {{0, 0}, {1, 0}, {0.5 - d, 1}, {0.5 + d, 1}}};
        ves_amplification at_it = amplification(&layout, lam);
        layout.knot[2].u -= 0.01, layout.knot[3].u += 0.01;
        ves_amplification beside = amplification(&layout, lam);
        cr_expect(at_it.lebesgue > 1e11 && at_it.condition > 1e11 && beside.lebesgue < 1e4 &&
                      beside.condition < 1e4,
                  "lam %g: %.3g %.3g, beside %.3g %.3g", lam, at_it.lebesgue, at_it.condition,
                  beside.lebesgue, beside.condition);
    }
}

/* Depth: the distance of the N-th condition from its nearer end. */
Test(weights_layout, depth_counts_the_conditions_from_the_nearer_end)
{
    ves_layout ends = layout_of(4, HERMITE), equal = layout_of(4, EQUISPACED);
    cr_expect_eq(ves_layout_depth(&ends), 0);
    cr_expect(fabs(ves_layout_depth(&equal) - 3. / 7) < 1e-15);
}

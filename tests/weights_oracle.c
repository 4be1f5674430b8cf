/* Every order to 40 against MPFR (tests/oracle.h), each cardinal function by itself: f = e_j, lam = a n,
 *     |error in the d-th derivative| <= (1e-12 + 4e-16 lam) max(S_d, S_0 max(1, lam)^d),  S_d = max_u |l_j^(d)|
 * for d = 0, 1, 2. What is left of the conditions when
 * they are applied to the solution, up to the highest derivative: 1e-13 in the same scale. */
#include <criterion/criterion.h>
#include <string.h>

#include "oracle.h"
#include "surface/exact.h"
#include "surface/fast.h"

enum { PLACES = 16, ORDERS = 3 };

/* The double path (to order 8, conditions at the ends) may use all of it, the other a hundredth. */
static double bar(const ves_layout *layout, double lam)
{
    ves_operator op = {.power = layout->power, .parameter = {lam}};
    return (1e-12 + 4e-16 * lam) * (ves_fast_fits(layout, &op) ? 1 : 0.01);
}

/* --- layouts --- */

typedef ves_knot (*rule)(int j, int N);

static ves_layout layout_of(rule place, int N)
{
    ves_layout layout = {.power = N};
    for (int j = 0; j < 2 * N; j++) layout.knot[j] = place(j, N);
    return layout;
}

static ves_knot hermite(int j, int N)
{
    return (ves_knot){j / N, j % N};
}

static ves_knot navier(int j, int N)
{
    return (ves_knot){j / N, 2 * (j % N)};
}

static ves_knot chebyshev(int j, int N)
{
    return (ves_knot){(1 - cos(acos(-1) * j / (2 * N - 1))) / 2, 0};
}

static ves_knot equispaced(int j, int N)
{
    return (ves_knot){(double)j / (2 * N - 1), 0};
}

/* A third of the conditions at each end and in the middle. */
static ves_knot inner_node(int j, int N)
{
    static const double place[] = {0, 0.5, 1};
    (void)N;
    return (ves_knot){place[j % 3], j / 3};
}

/* Curves with derivative fields, at N places from end to end. */
static ves_knot curves_with_slopes(int j, int N)
{
    return (ves_knot){(double)(j / 2) / (N - 1), j % 2};
}

/* Derivatives at the ends, curves between. */
static ves_knot ends_and_curves(int j, int N)
{
    int end = (N + 1) / 2;
    if (j < 2 * end) return (ves_knot){j % 2, j / 2};
    return (ves_knot){(j - 2 * end + 1.) / (2 * (N - end) + 1), 0};
}

/* --- places: the whole patch, and the layers at its ends --- */

static void places(int N, double lam, double *u)
{
    static const double fixed[] = {0, 0.003, 0.0371, 0.25, 0.4142, 0.5, 0.7183, 0.9, 0.9629, 0.999, 1};
    double l = 1 / fmax(lam, 2 * N);
    double layer[] = {l, N * l / 2, 1 - l, 1 - N * l / 2, 2 * l};
    memcpy(u, fixed, sizeof fixed);
    memcpy(u + sizeof fixed / sizeof *fixed, layer, sizeof layer);
}

static double *room_for(const ves_layout *layout, int orders)
{
    long room = ves_weights_room(layout, ORACLE_MOST + PLACES), exact = ves_exact_room(layout, orders);
    size_t bytes = sizeof(double) * (size_t)(room > exact ? room : exact);
    return aligned_alloc(64, (bytes + 63) / 64 * 64);
}

/* 40 bits for each order and 300 more: at lam = 0.01 the textbook basis loses all but 80 digits. */
static long bits_for(int N)
{
    return 300 + 40 * N;
}

/* max(S_d, S_0 max(1, lam)^d) of cardinal function j; weights of `places` places. */
static double scale_of(const double *weight, int n, int nu, int j, int d, double lam)
{
    double s[2] = {0, 0};
    for (int i = 0; i < nu; i++) {
        s[0] = fmax(s[0], fabs(weight[j * nu + i]));
        s[1] = fmax(s[1], fabs(weight[(d * n + j) * nu + i]));
    }
    return fmax(s[1], s[0] * pow(fmax(1, lam), d));
}

static void check_values(const ves_layout *layout, double lam)
{
    int n = 2 * layout->power, size = ORDERS * n * PLACES;
    double u[PLACES], *want = calloc(2 * (size_t)size, sizeof *want), *got = want + size,
                      *room = room_for(layout, 0);
    oracle o;
    ves_operator op = {.power = layout->power, .parameter = {lam}};
    places(layout->power, lam, u);
    oracle_power(&o, layout->power, lam, bits_for(layout->power));
    oracle_doubles(&o, layout, ORDERS, PLACES, u, want);
    ves_status status =
        ves_weights_mode(layout, &op, 1, PLACES, u, &(ves_table){.weight = got, .room = room});
    cr_assert_eq(status, VES_OK, "order %d lam %g", n, lam);
    for (int k = 0; k < size; k++) {
        int d = k / PLACES / n, j = k / PLACES % n;
        double unit = bar(layout, lam) * scale_of(want, n, PLACES, j, d, lam);
        cr_assert(
            fabs(got[k] - want[k]) <= unit,
            "order %d lam %g condition %d (derivative %d at %g), derivative %d at %g: got %.17g want %.17g, "
            "%.2g of the bar",
            n, lam, j, layout->knot[j].derivative, layout->knot[j].u, d, u[k % PLACES], got[k], want[k],
            fabs(got[k] - want[k]) / unit);
    }
    oracle_clear(&o);
    free(room);
    free(want);
}

/* Every condition applied to every cardinal function: 1 or 0. Where no derivative beyond the second is asked for,
 * by the tables that patches use; else they do not have it, and exact.c is asked. */
static void check_residual(const ves_layout *layout, double lam)
{
    int n = 2 * layout->power, nu = n + PLACES, orders = 3;
    for (int j = 0; j < n; j++) orders = (int)fmax(orders, layout->knot[j].derivative + 1);
    double u[ORACLE_MOST + PLACES], *weight = calloc((size_t)(orders * n * nu), sizeof *weight),
                                    *room = room_for(layout, orders);
    for (int j = 0; j < n; j++) u[j] = layout->knot[j].u;
    places(layout->power, lam, u + n);
    ves_operator op = {.power = layout->power, .parameter = {lam}};
    ves_exact_out out = {.count = n, .columns = n, .orders = orders, .weight = weight};
    const ves_table table = {.weight = weight, .room = room};
    ves_factor factor;
    ves_factor_make(&op, false, &factor);
    cr_assert_eq(orders == 3 ? ves_weights_mode(layout, &op, 1, nu, u, &table)
                             : ves_exact_mode(layout, &factor, 1, nu, u, &out, room),
                 VES_OK);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            int d = layout->knot[i].derivative;
            double miss = fabs(weight[(d * n + j) * nu + i] - (i == j)),
                   unit = scale_of(weight, n, nu, j, d, lam);
            cr_assert(miss <= 1e-13 * unit, "order %d lam %g: condition %d of cardinal function %d: %.2g", n,
                      lam, i, j, miss / unit);
        }
    free(room);
    free(weight);
}

static void check(rule place, int from, int to, int step)
{
    static const double lam[] = {0, 0.01, 0.1, 0.5, 1, 3, 10, 23, 24, 30, 100, 300, 1000, 1280};
    /* in units of N: both sides of where the basis changes, or may */
    static const double change[] = {0.2999, 0.3001, 0.6,    0.9,    1.1499, 1.1501,
                                    1.3,    1.4999, 1.5001, 1.9999, 2.0001};
    for (int N = from; N <= to; N += step) {
        ves_layout layout = layout_of(place, N);
        for (size_t k = 0; k < sizeof lam / sizeof *lam; k++) {
            check_values(&layout, lam[k]);
            check_residual(&layout, lam[k]);
        }
        for (size_t k = N % 4; k < sizeof change / sizeof *change; k += N < 17 ? 4 : 1) {
            check_values(&layout, change[k] * N);
            check_residual(&layout, change[k] * N);
        }
    }
}

Test(weights_oracle, hermite_ends_to_order_28)
{
    check(hermite, 1, 14, 1);
}

Test(weights_oracle, hermite_ends_to_order_40)
{
    check(hermite, 15, 20, 1);
}

Test(weights_oracle, navier_ends_to_order_28)
{
    check(navier, 1, 14, 1);
}

Test(weights_oracle, navier_ends_to_order_40)
{
    check(navier, 15, 20, 1);
}

Test(weights_oracle, chebyshev_nodes_to_order_28)
{
    check(chebyshev, 1, 14, 1);
}

Test(weights_oracle, chebyshev_nodes_to_order_40)
{
    check(chebyshev, 15, 20, 1);
}

Test(weights_oracle, equispaced_nodes)
{
    check(equispaced, 1, 20, 3);
    check(equispaced, 20, 20, 1);
}

Test(weights_oracle, a_node_inside_with_derivatives)
{
    check(inner_node, 2, 20, 6);
}

Test(weights_oracle, curves_and_derivatives_inside)
{
    check(curves_with_slopes, 2, 20, 6);
    check(ends_and_curves, 5, 20, 5);
}

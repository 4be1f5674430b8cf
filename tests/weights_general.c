/* General operators against MPFR: values from the roots that they were made of (tests/oracle.h), derivatives by
 * each coefficient from differences of the MPFR solution, whose roots are found anew. lam is n times the largest
 * |r|; the bars are those of weights_oracle.c. */
#include <criterion/criterion.h>
#include <stdio.h>
#include <string.h>

#include "oracle.h"

enum { PLACES = 13, ORDERS = 3, ROOTS = VES_GENERAL_MAX };

/* r = +-p +- iq, as dyadic numbers, so that the coefficients are whole doubles. */
typedef struct family {
    const char *name;
    int roots;
    struct {
        double p, q;
        int multiplicity;
    } root[ROOTS];
} family;

static const family FAMILY[] = {
    {"one", 1, {{3, 0, 1}}},
    {"two", 2, {{1, 0, 1}, {2, 0, 1}}},
    {"double", 1, {{1.25, 0, 2}}},
    {"nearly double", 2, {{1, 0, 1}, {1 + 0x1p-10, 0, 1}}},
    {"a pair", 1, {{1, 0.5, 1}}},
    {"a pair that waves", 1, {{0.25, 2, 1}}},
    {"1 to 20", 2, {{1, 0, 1}, {20, 0, 1}}},
    {"three", 3, {{0.5, 0, 1}, {1, 0, 1}, {3, 0, 1}}},
    {"triple", 1, {{0.75, 0, 3}}},
    {"double and one", 2, {{1, 0, 2}, {2, 0, 1}}},
    {"nearly triple", 3, {{1, 0, 1}, {1 + 0x1p-8, 0, 1}, {1 - 0x1p-8, 0, 1}}},
    {"one and a pair", 2, {{1, 0, 1}, {0.5, 2, 1}}},
    {"1 to 20 by three", 3, {{1, 0, 1}, {5, 0, 1}, {20, 0, 1}}},
    {"four", 4, {{1, 0, 1}, {2, 0, 1}, {3, 0, 1}, {4, 0, 1}}},
    {"a double pair", 1, {{1, 1, 2}}},
    {"quadruple", 1, {{1, 0, 4}}},
    {"five", 4, {{0.5, 0, 2}, {2, 0, 1}, {8, 0, 1}, {1, 0, 1}}},
    {"six", 6, {{0.5, 0, 1}, {1, 0, 1}, {1.5, 0, 1}, {2, 0, 1}, {2.5, 0, 1}, {3, 0, 1}}},
    {"six equal", 1, {{1, 0, 6}}},
    {"three pairs", 3, {{1, 0.5, 1}, {0.5, 1, 1}, {1, 2, 1}}},
    {"1 to 20 by six", 6, {{1, 0, 1}, {2, 0, 1}, {4, 0, 1}, {8, 0, 1}, {16, 0, 1}, {20, 0, 1}}},
};
enum { FAMILIES = sizeof FAMILY / sizeof *FAMILY };

/* Slow roots beside a quick one: solutions that decay from the one end and from the other are then the same
 * polynomials, but for 1e-12 or less of them. */
static const family WIDE[] = {{"three slow, one quick", 2, {{0x1p-10, 0, 3}, {30, 0, 1}}},
                              {"five slow, one quick", 2, {{0x1p-7, 0, 5}, {12, 0, 1}}},
                              {"one slow, one quick", 2, {{0x1p-10, 0, 1}, {30, 0, 1}}}};
enum { WIDES = sizeof WIDE / sizeof *WIDE };

/* c_0 times prod (r^2 - s): c_k = (-1)^k times the coefficient, for n = 1. */
static ves_operator operator_of(const family *f, double c0)
{
    ves_operator op = {.general = true, .parameter = {1}};
    for (int i = 0; i < f->roots; i++)
        for (int m = 0; m < f->root[i].multiplicity; m++) {
            double p = f->root[i].p, q = f->root[i].q, b[3] = {1, -(p * p), 0};
            int degree = q == 0 ? 1 : 2;
            if (q != 0) b[1] = -2 * (p * p - q * q), b[2] = (p * p + q * q) * (p * p + q * q);
            op.power += degree;
            for (int k = op.power; k >= 0; k--) {
                double sum = 0;
                for (int d = 0; d <= degree && d <= k; d++) sum += b[d] * op.parameter[k - d];
                op.parameter[k] = sum;
            }
        }
    for (int k = 0; k <= op.power; k++) op.parameter[k] *= k % 2 ? -c0 : c0;
    return op;
}

static double largest_root(const family *f)
{
    double most = 0;
    for (int i = 0; i < f->roots; i++) most = fmax(most, hypot(f->root[i].p, f->root[i].q));
    return most;
}

static bool real_roots(const family *f)
{
    for (int i = 0; i < f->roots; i++)
        if (f->root[i].q != 0) return false;
    return true;
}

/* inside: curves at Chebyshev's places; else half of the conditions at each end. */
static ves_layout layout_of(int N, bool inside)
{
    ves_layout layout = {.power = N};
    for (int j = 0; j < 2 * N; j++) {
        ves_knot node = {(1 - cos(acos(-1) * j / (2 * N - 1))) / 2, 0}, end = {j / N, j % N};
        layout.knot[j] = inside ? node : end;
    }
    return layout;
}

static void places(int N, double lam, double *u)
{
    static const double fixed[] = {0, 0.003, 0.0371, 0.25, 0.5, 0.7183, 0.9629, 0.999, 1};
    double l = 1 / fmax(lam, 2 * N), layer[] = {l, N * l / 2, 1 - l, 1 - N * l / 2};
    memcpy(u, fixed, sizeof fixed);
    memcpy(u + sizeof fixed / sizeof *fixed, layer, sizeof layer);
}

typedef struct bed {
    ves_layout layout;
    ves_operator op;
    double u[PLACES], lam, *want, *got, *slope, *room;
    int n, size;
} bed;

static bed bed_of(const family *f, bool inside, double mode, double c0)
{
    bed b = {.op = operator_of(f, c0), .lam = fmax(1, mode * largest_root(f))};
    b.layout = layout_of(b.op.power, inside);
    b.n = 2 * b.op.power, b.size = ORDERS * b.n * PLACES;
    b.want = calloc((size_t)((3 + ROOTS) * b.size), sizeof *b.want);
    b.got = b.want + b.size, b.slope = b.got + b.size;
    long bytes = 8 * ves_weights_room(&b.layout, PLACES);
    b.room = aligned_alloc(64, (size_t)(bytes + 63) / 64 * 64);
    places(b.op.power, b.lam, b.u);
    return b;
}

static void bed_free(bed *b)
{
    free(b->want);
    free(b->room);
}

/* max(S_d, S_0 lam^d) */
static double scale_of(const bed *b, const double *weight, int j, int d)
{
    double s[2] = {0, 0};
    for (int i = 0; i < PLACES; i++) {
        s[0] = fmax(s[0], fabs(weight[j * PLACES + i]));
        s[1] = fmax(s[1], fabs(weight[(d * b->n + j) * PLACES + i]));
    }
    return fmax(s[1], s[0] * pow(b->lam, d));
}

static void compare(const bed *b, const char *name, double mode, const char *what, const double *want,
                    const double *got, double share)
{
    for (int k = 0; k < b->size; k++) {
        int d = k / PLACES / b->n, j = k / PLACES % b->n;
        double unit = share * (1e-12 + 4e-16 * b->lam) * scale_of(b, want, j, d);
        cr_assert(
            fabs(got[k] - want[k]) <= unit,
            "%s, mode %g, %s: condition %d (derivative %d at %g), derivative %d at %g: got %.17g want %.17g, "
            "%.2g of the bar",
            name, mode, what, j, b->layout.knot[j].derivative, b->layout.knot[j].u, d, b->u[k % PLACES],
            got[k], want[k], fabs(got[k] - want[k]) / unit);
    }
}

static void check_values(const family *f, bool inside, double mode, double share)
{
    bed b = bed_of(f, inside, mode, 1);
    oracle o;
    oracle_init(&o, 900);
    for (int i = 0; i < f->roots; i++)
        oracle_add(&o, mode * f->root[i].p, mode * f->root[i].q, f->root[i].multiplicity);
    oracle_doubles(&o, &b.layout, ORDERS, PLACES, b.u, b.want);
    ves_status status =
        ves_weights_mode(&b.layout, &b.op, mode, PLACES, b.u, &(ves_table){.weight = b.got, .room = b.room});
    cr_assert_eq(status, VES_OK, "%s mode %g", f->name, mode);
    compare(&b, f->name, mode, inside ? "inside" : "ends", b.want, b.got, share);
    oracle_clear(&o);
    bed_free(&b);
}

static const double MODES[] = {0, 1, 2, 3, 5, 8, 13, 21, 34, 50};
enum { MODES_COUNT = sizeof MODES / sizeof *MODES };

Test(weights_general, values_agree_for_every_kind_of_roots)
{
    for (int k = 0; k < FAMILIES; k++)
        for (int m = 0; m < MODES_COUNT; m++) check_values(&FAMILY[k], false, MODES[m], 0.1);
}

/* Waves need not be determined by curves inside; sums of real exponentials always are. */
Test(weights_general, curves_inside_agree_where_the_roots_are_real)
{
    for (int k = 0; k < FAMILIES - 1; k++)
        for (int m = 0; m < MODES_COUNT && real_roots(&FAMILY[k]); m++)
            check_values(&FAMILY[k], true, MODES[m], 0.1);
}

/* Up to n |r| = 80 of the quick root the centred basis serves them all; beyond, what is left of 32 digits is
 * enough for values within the bar, and where it is not, the mode is refused. */
Test(weights_general, slow_roots_beside_a_quick_one)
{
    for (int k = 0; k < WIDES; k++)
        for (int m = 0; m < MODES_COUNT; m++)
            if (k != 1 || MODES[m] * 12 <= 40)
                check_values(&WIDE[k], false, MODES[m], MODES[m] * 30 <= 80 ? 0.1 : 1);
    bed b = bed_of(&WIDE[1], false, 21, 1);
    cr_expect_eq(
        ves_weights_mode(&b.layout, &b.op, 21, PLACES, b.u, &(ves_table){.weight = b.got, .room = b.room}),
        VES_UNDETERMINED);
    bed_free(&b);
}

/* What 32 digits cannot do: order 12, roots from 1 to 20, curves inside. There the quick members are e^(-950 u)
 * of the slow ones. Up to n |r| = 680 all is well; at 1000 five digits would be left, and it is refused. */
Test(weights_general, curves_inside_agree_or_are_refused_where_the_quick_roots_do_not_count)
{
    const family *f = &FAMILY[FAMILIES - 1];
    for (int m = 0; m < MODES_COUNT; m++) {
        if (MODES[m] <= 34) {
            check_values(f, true, MODES[m], 0.1);
            continue;
        }
        bed b = bed_of(f, true, MODES[m], 1);
        cr_expect_eq(ves_weights_mode(&b.layout, &b.op, MODES[m], PLACES, b.u,
                                      &(ves_table){.weight = b.got, .room = b.room}),
                     VES_UNDETERMINED);
        for (int k = 0; k < b.size; k++) cr_assert_eq(b.got[k], 0);
        bed_free(&b);
    }
}

/* Central differences of the MPFR solution with steps of 2^-130 c_0. */
static void check_slopes(const family *f, bool inside, double mode)
{
    bed b = bed_of(f, inside, mode, 1.7);
    oracle o;
    mpfr_t by;
    oracle_init(&o, 1200);
    mpfr_init2(by, o.bits);
    mpfr_t *w = oracle_numbers(&o, 2 * b.size);
    ves_status status = ves_weights_mode(&b.layout, &b.op, mode, PLACES, b.u,
                                         &(ves_table){.weight = b.got, .slope = b.slope, .room = b.room});
    cr_assert_eq(status, VES_OK);
    for (int k = 0; k <= b.op.power; k++) {
        for (int side = 0; side < 2; side++) {
            mpfr_set_ui_2exp(by, 1, -130, MPFR_RNDN);
            if (side) mpfr_neg(by, by, MPFR_RNDN);
            oracle_operator(&o, &b.op, mode, k, by, 1200);
            oracle_weights(&o, &b.layout, ORDERS, PLACES, b.u, w + side * b.size);
            oracle_clear(&o);
        }
        for (int i = 0; i < b.size; i++) {
            mpfr_sub(w[i], w[i], w[b.size + i], MPFR_RNDN);
            mpfr_mul_2ui(w[i], w[i], 129, MPFR_RNDN);
            b.want[i] = mpfr_get_d(w[i], MPFR_RNDN) / b.op.parameter[0];
        }
        char what[40];
        snprintf(what, sizeof what, "%s, by c_%d", inside ? "inside" : "ends", k);
        compare(&b, f->name, mode, what, b.want, b.slope + k * b.size, 1);
    }
    oracle_free(2 * b.size, w);
    mpfr_clear(by);
    bed_free(&b);
}

Test(weights_general, derivatives_by_each_coefficient_agree_beside_slow_roots)
{
    for (int k = 0; k < WIDES; k++)
        for (double mode = 1; mode < 3; mode++) check_slopes(&WIDE[k], false, mode);
}

Test(weights_general, derivatives_by_each_coefficient_agree_up_to_order_8)
{
    static const double mode[] = {1, 3, 13, 50};
    for (int k = 0; k < FAMILIES; k++)
        if (operator_of(&FAMILY[k], 1).power <= 4)
            for (int m = k % 2; m < 4; m += 2)
                check_slopes(&FAMILY[k], real_roots(&FAMILY[k]) && m == 0, mode[m]);
}

Test(weights_general, derivatives_by_each_coefficient_agree_to_order_12)
{
    static const double mode[] = {1, 3, 13, 50};
    for (int k = 0; k < FAMILIES; k++)
        if (operator_of(&FAMILY[k], 1).power > 4) check_slopes(&FAMILY[k], false, mode[k % 4]);
}

/* What is fixed costs nothing and leaves the slopes by the others as they were, to the last bit. */
Test(weights_general, slopes_do_not_feel_what_is_fixed)
{
    for (int k = 0; k < FAMILIES; k++) {
        bed b = bed_of(&FAMILY[k], false, 13, 1);
        int N = b.op.power, moving = N / 2;
        double *all = calloc((size_t)((N + 1) * b.size), sizeof *all);
        ves_weights_mode(&b.layout, &b.op, 13, PLACES, b.u,
                         &(ves_table){.weight = b.got, .slope = all, .room = b.room});
        b.op.fixed = ~(1U << moving);
        ves_weights_mode(&b.layout, &b.op, 13, PLACES, b.u,
                         &(ves_table){.weight = b.got, .slope = b.slope, .room = b.room});
        cr_expect(memcmp(all + moving * b.size, b.slope + moving * b.size, sizeof *all * (size_t)b.size) == 0,
                  "%s", FAMILY[k].name);
        free(all);
        bed_free(&b);
    }
}

/* Mode 0 does not know the operator: a polynomial, and no slopes. */
Test(weights_general, mode_zero_is_polynomial)
{
    bed b = bed_of(&FAMILY[10], false, 0, 1);
    ves_weights_mode(&b.layout, &b.op, 0, PLACES, b.u,
                     &(ves_table){.weight = b.got, .slope = b.slope, .room = b.room});
    for (int k = 0; k <= b.op.power; k++)
        for (int i = 0; i < b.size; i++) cr_assert_eq(b.slope[k * b.size + i], 0);
    bed_free(&b);
}

/* (1, 3 a^2, 3 a^4, a^6) is the third power; by a it changes as the chain rule says. */
Test(weights_general, the_triharmonic_operator_is_a_power)
{
    for (int m = 0; m < MODES_COUNT; m++) {
        bed b = bed_of(&FAMILY[8], false, MODES[m], 1);
        double a = 0.75, chain[] = {0, 6 * a, 12 * a * a * a, 6 * pow(a, 5)}, *power = calloc(3 * b.size, 8);
        ves_operator op = {.power = 3, .parameter = {a}};
        ves_weights_mode(&b.layout, &b.op, MODES[m], PLACES, b.u,
                         &(ves_table){.weight = b.got, .slope = b.slope, .room = b.room});
        ves_weights_mode(&b.layout, &op, MODES[m], PLACES, b.u,
                         &(ves_table){.weight = power, .slope = power + b.size, .room = b.room});
        for (int i = 0; i < b.size; i++)
            for (int k = 1; k <= 3; k++) power[2 * b.size + i] += chain[k] * b.slope[k * b.size + i];
        compare(&b, "triharmonic", MODES[m], "values", power, b.got, 0.1);
        compare(&b, "triharmonic", MODES[m], "by a", power + b.size, power + 2 * b.size, 1);
        free(power);
        bed_free(&b);
    }
}

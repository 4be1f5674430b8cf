#include "surface/fast.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "surface/tile.h"

/* Below the switch the solutions are spanned by the centred fundamental solutions, t = u - 1/2, mu = lam^2,
 *     c_k = (1/k!) d^k/dmu^k cosh(sqrt(mu) t),      s_k = (1/k!) d^k/dmu^k sinh(sqrt(mu) t) / sqrt(mu),
 * series of positive terms, so nothing cancels and lam = 0 is not special:
 *     c_k' = mu s_k + s_{k-1},   s_k' = c_k,   dc_k/dmu = (k+1) c_{k+1}.
 * Above it by the decaying ones f_k = u^k e^{-lam u} and their mirror images g_k(u) = f_k(1-u):
 *     f_k' = k f_{k-1} - lam f_k,   df_k/dlam = -f_{k+1};
 * never e^{+lam u}, which [Ugail 2011, eqs 4.12-4.14] use and which overflows from lam = 709 on.
 * In both, the derivative with respect to lam of member k is a multiple of member k + 1: one more member
 * gives it.
 *
 * The basis is evaluated at the wanted places and, behind them, at the knots of the conditions: one pass
 * serves both. */
enum { POWER = 4, FAMILY = POWER + 1, TERMS = 16, K = 2 * POWER, ORDERS = 4, LANES = VES_LANES };

_Static_assert((int)K == (int)VES_LANES, "a row of the condition matrix is at most one register");

#define HOT static inline __attribute__((always_inline))

/* Up to which lam the centred basis is taken, and with how many terms. */
HOT double switch_of(int N)
{
    return N <= 2 ? 1.5 * N : 1.25 * N;
}

HOT int terms_of(int N)
{
    return N <= 2 ? 12 : TERMS;
}

/* Derivatives 0 .. of each member: Hermite data of order 8 need the third. */
HOT int orders_of(int N)
{
    return N <= 3 ? 3 : ORDERS;
}

/* SERIES[k][i] = C(i+k, k) / (2 (i+k) + 1)!, the coefficients of s_k, and 1 / (2i)!, those of c_0; the other c_k
 * are t s_{k-1} / (2k). Orders 2 and 4 use 12 of them, which leave < 1e-18 for lam |t| <= 1.5; orders 6 and 8 all,
 * < 1e-19 for lam |t| <= 2.5. */
static const double COSH[TERMS] = {1.0,
                                   0.5,
                                   0.041666666666666664,
                                   0.001388888888888889,
                                   2.48015873015873e-05,
                                   2.755731922398589e-07,
                                   2.08767569878681e-09,
                                   1.1470745597729725e-11,
                                   4.779477332387385e-14,
                                   1.5619206968586225e-16,
                                   4.110317623312165e-19,
                                   8.896791392450574e-22,
                                   1.6117375710961184e-24,
                                   2.4795962632247976e-27,
                                   3.279889237069838e-30,
                                   3.7699876288159054e-33};
static const double SERIES[FAMILY][TERMS] = {
    {1.0, 0.16666666666666666, 0.008333333333333333, 0.0001984126984126984, 2.7557319223985893e-06,
     2.505210838544172e-08, 1.6059043836821613e-10, 7.647163731819816e-13, 2.8114572543455206e-15,
     8.22063524662433e-18, 1.9572941063391263e-20, 3.868170170630684e-23, 6.446950284384474e-26,
     9.183689863795546e-29, 1.1309962886447716e-31, 1.216125041553518e-34},
    {0.16666666666666666, 0.016666666666666666, 0.0005952380952380953, 1.1022927689594357e-05,
     1.252605419272086e-07, 9.635426302092969e-10, 5.353014612273871e-12, 2.2491658034764165e-14,
     7.398571721961897e-17, 1.9572941063391261e-19, 4.254987187693753e-22, 7.736340341261368e-25,
     1.193879682293421e-27, 1.5833948041026804e-30, 1.8241875623302768e-33, 1.842613699323512e-36},
    {0.008333333333333333, 0.0005952380952380953, 1.6534391534391536e-05, 2.505210838544172e-07,
     2.4088565755232422e-09, 1.6059043836821613e-11, 7.872080312167458e-14, 2.9594286887847587e-16,
     8.807823478526068e-19, 2.127493593846876e-21, 4.254987187693752e-24, 7.163278093760525e-27,
     1.0292066226667423e-29, 1.2769312936311937e-32, 1.3819602744926341e-35, 1.3161526423739371e-38},
    {0.0001984126984126984, 1.1022927689594357e-05, 2.505210838544172e-07, 3.211808767364323e-09,
     2.6765073061369358e-11, 1.5744160624334916e-13, 6.905333607164437e-16, 2.348752927606951e-18,
     6.3824807815406284e-21, 1.418329062564584e-23, 2.626535301045526e-26, 4.116826490666969e-29,
     5.533368939068507e-32, 6.449147947632292e-35, 6.580763211869685e-38, 5.928615506188906e-41},
    {2.7557319223985893e-06, 1.252605419272086e-07, 2.4088565755232422e-09, 2.6765073061369358e-11,
     1.9680200780418644e-13, 1.0358000410746656e-15, 4.110317623312165e-18, 1.2764961563081257e-20,
     3.1912403907703145e-23, 6.566338252613815e-26, 1.1321272849334166e-28, 1.660010681720552e-31,
     2.095973082980495e-34, 2.30326712415439e-37, 2.22323081482084e-40, 1.9001972776246493e-43}};

/* Everything along u has `width` places: nu wanted ones, 2N knots, padding to whole registers. */
typedef struct places {
    int nu, width;
    double *u, *mirrored;     /* u and 1 - u */
    double *left, *right;     /* e^{-lam u}, e^{-lam (1-u)} of the mode at hand */
    double *left_1, *right_1; /* of mode 1: their powers are all the others */
    double *basis;            /* [2][FAMILY][ORDERS][width]: family, member, derivative */
} places;

HOT double *plane(const places *p, int family, int k, int d)
{
    return p->basis + (size_t)(((family * FAMILY + k) * ORDERS + d) * p->width);
}

static int width(int nu, int N)
{
    return (nu + 2 * N + LANES - 1) / LANES * LANES;
}

long ves_fast_room(int nu)
{
    return (2L * FAMILY * ORDERS + 6) * width(nu, POWER);
}

static places places_init(const ves_layout *layout, int nu, const double *u, double *room)
{
    int w = width(nu, layout->power);
    places p = {.nu = nu, .width = w, .basis = room + 6 * w};
    double **array[] = {&p.u, &p.mirrored, &p.left, &p.right, &p.left_1, &p.right_1};
    for (int k = 0; k < 6; k++) *array[k] = room + k * w;
    for (int i = 0; i < w; i++) {
        int j = i - nu;
        p.u[i] = i < nu ? u[i] : j < 2 * layout->power ? layout->knot[j].u : 0.5;
        p.mirrored[i] = 1 - p.u[i];
    }
    return p;
}

HOT ves_lanes *register_at(double *plane, int block)
{
    return (ves_lanes *)(plane + block);
}

/* e^x, x <= 0, to two units in the last place; 0 below -700. x = k ln 2 + r, and 14 terms of the series of e^r,
 * |r| <= 0.35, leave 4e-18. */
HOT ves_lanes exponential(ves_lanes x)
{
    typedef long long whole __attribute__((vector_size(sizeof(ves_lanes))));
    static const double LEAST = -700, ROUND = 0x1.8p52;
    whole none = x < LEAST;
    x = (ves_lanes)(~none & (whole)x);
    ves_lanes shifted = x * 0x1.71547652b82fep+0 + ROUND, k = shifted - ROUND;
    ves_lanes r = x - k * 0x1.62e42feep-1 - k * 0x1.a39ef35793c76p-33; /* the first product is exact */
    ves_lanes sum = 1 / 6227020800. + (ves_lanes){0};
    static const double next[] = {
        1 / 479001600., 1 / 39916800., 1 / 3628800., 1 / 362880., 1 / 40320., 1 / 5040., 1 / 720.,
        1 / 120.,       1 / 24.,       1 / 6.,       1 / 2.,      1,          1};
    for (int i = 0; i < 13; i++) sum = sum * r + next[i];
    whole power = ((whole)shifted - (whole)(ROUND + (ves_lanes){0}) + 1023) << 52;
    return (ves_lanes)(~none & (whole)(sum * (ves_lanes)power));
}

/* e^{-lam u} and e^{-lam (1-u)}. */
HOT void exponentials(const places *p, double lam, double *left, double *right)
{
    for (int b = 0; b < p->width; b += LANES) {
        *register_at(left, b) = exponential(-lam * *register_at(p->u, b));
        *register_at(right, b) = exponential(-lam * *register_at(p->mirrored, b));
    }
}

/* sum_i c[i] z^i by two Horner chains in z^2: half the latency. */
HOT ves_lanes horner(const double *c, int terms, ves_lanes z)
{
    ves_lanes z2 = z * z, even = c[terms - 2] + (ves_lanes){0}, rest = c[terms - 1] + (ves_lanes){0};
    for (int m = terms - 4; m >= 0; m -= 2) even = even * z2 + c[m], rest = rest * z2 + c[m + 1];
    return even + z * rest;
}

/* family 0: c_k, family 1: s_k, with their derivatives; the third from y_k'' = mu y_k + y_{k-1}. */
HOT void centred(const places *p, int N, double lam, int members)
{
    double mu = lam * lam;
    for (int b = 0; b < p->width; b += LANES) {
        ves_lanes t = *register_at(p->u, b) - 0.5, tt = t * t, z = mu * tt, power = 1 + (ves_lanes){0};
        ves_lanes c1 = {0}, s1 = {0}, cu1 = {0}; /* members k - 1; c'_{k-1} */
        for (int k = 0; k < members; k++) {
            ves_lanes s = power * t * horner(SERIES[k], terms_of(N), z);
            ves_lanes c = k ? t * s1 / (2. * k) : horner(COSH, terms_of(N), z), cu = mu * s + s1;
            *register_at(plane(p, 0, k, 0), b) = *register_at(plane(p, 1, k, 1), b) = c;
            *register_at(plane(p, 1, k, 0), b) = s;
            *register_at(plane(p, 0, k, 1), b) = *register_at(plane(p, 1, k, 2), b) = cu;
            *register_at(plane(p, 0, k, 2), b) = mu * c + c1;
            if (orders_of(N) > 3) {
                *register_at(plane(p, 0, k, 3), b) = mu * cu + cu1;
                *register_at(plane(p, 1, k, 3), b) = mu * c + c1;
            }
            c1 = c, s1 = s, cu1 = cu, power *= tt;
        }
    }
}

/* One family of decaying solutions; sign -1: the mirror image. */
HOT void decaying(const places *p, int family, int N, double lam, int members)
{
    double sign = family ? -1 : 1;
    for (int b = 0; b < p->width; b += LANES) {
        ves_lanes u = *register_at(family ? p->mirrored : p->u, b),
                  f = *register_at(family ? p->right : p->left, b);
        ves_lanes before[ORDERS] = {{0}}; /* member k - 1 and its derivatives */
        for (int k = 0; k < members; k++) {
            if (k) f *= u;
            ves_lanes here[ORDERS] = {f};
            *register_at(plane(p, family, k, 0), b) = f;
            for (int d = 1; d < orders_of(N); d++) {
                here[d] = sign * k * before[d - 1] - sign * lam * here[d - 1];
                *register_at(plane(p, family, k, d), b) = here[d];
            }
            for (int d = 0; d < orders_of(N); d++) before[d] = here[d];
        }
    }
}

HOT bool small_lam(int N, double lam)
{
    return lam <= switch_of(N);
}

HOT void basis(const places *p, int N, double lam, int members)
{
    if (small_lam(N, lam)) {
        centred(p, N, lam, members);
    } else {
        decaying(p, 0, N, lam, members);
        decaying(p, 1, N, lam, members);
    }
}

/* d/dlam of member k is this times member k + 1. */
HOT double lam_factor(int N, double lam, int k)
{
    return small_lam(N, lam) ? 2 * lam * (k + 1) : -1;
}

/* One row of [matrix | inverse]: 4 N numbers, one register up to order 4, two beyond. */
typedef ves_lanes row_of[K][2];

/* Entry (r, j) of the inverse. */
HOT double inverse(row_of a, int N, int r, int j)
{
    return N <= 2 ? a[r][0][2 * N + j] : a[r][1][j];
}

/* Gauss-Jordan with partial pivoting on an equilibrated matrix; false when a pivot vanishes. */
HOT bool invert(int N, row_of a)
{
    int n = 2 * N, registers = N <= 2 ? 1 : 2;
    for (int r = 0; r < n; r++) {
        double largest = 0;
        for (int c = 0; c < n; c++) largest = fabs(a[r][0][c]) > largest ? fabs(a[r][0][c]) : largest;
        if (N <= 2)
            a[r][0][n + r] = 1;
        else
            a[r][1] = (ves_lanes){0}, a[r][1][r] = 1;
        for (int h = 0; h < registers; h++) a[r][h] *= 1 / largest;
    }
    for (int p = 0; p < n; p++) {
        int best = p;
        for (int r = p + 1; r < n; r++)
            if (fabs(a[r][0][p]) > fabs(a[best][0][p])) best = r;
        if (!(fabs(a[best][0][p]) > 1e-13)) return false;
        double by = 1 / a[best][0][p];
        for (int h = 0; h < registers; h++) {
            ves_lanes pivot = a[best][h] * by;
            a[best][h] = a[p][h];
            a[p][h] = pivot;
        }
        for (int r = 0; r < n; r++) {
            double f = a[r][0][p];
            for (int h = 0; h < registers && r != p; h++) a[r][h] -= f * a[p][h];
        }
    }
    return true;
}

/* The condition matrix: row j is condition j applied to each member; its inverse in the right half.
 * derivative: the matrix differentiated with respect to lam. */
HOT bool conditions(const ves_layout *layout, const places *p, int N, double lam, row_of matrix,
                    double derivative[K][K])
{
    for (int j = 0; j < 2 * N; j++) {
        int d = layout->knot[j].derivative, at = p->nu + j;
        ves_lanes row = {0};
        for (int m = 0; m < 2 * N; m++) {
            row[m] = plane(p, m / N, m % N, d)[at];
            if (derivative) derivative[j][m] = lam_factor(N, lam, m % N) * plane(p, m / N, m % N + 1, d)[at];
        }
        matrix[j][0] = row;
    }
    return invert(N, matrix);
}

/* Registers of places; rows of a table need not be whole registers. */
HOT ves_lanes lanes_part(const double *from, int count)
{
    ves_lanes x = {0};
    if (count >= LANES) return ves_lanes_at(from);
    for (int i = 0; i < count; i++) x[i] = from[i];
    return x;
}

HOT void lanes_store(double *to, int count, ves_lanes x)
{
    if (count >= LANES) memcpy(to, &x, sizeof x);
    for (int i = 0; i < count && count < LANES; i++) to[i] = x[i];
}

/* weight_lam = (basis' - weight matrix') matrix^-1. */
HOT void combine_lam(const places *p, int N, double lam, row_of matrix, double derivative[K][K],
                     const double *weight, double *weight_lam)
{
    int n = 2 * N, nu = p->nu;
    double product[K][K]; /* matrix' matrix^-1 */
    for (int r = 0; r < n; r++)
        for (int j = 0; j < n; j++) {
            product[r][j] = 0;
            for (int m = 0; m < n; m++) product[r][j] += derivative[r][m] * inverse(matrix, N, m, j);
        }
    for (int d = 0; d < 3; d++)
        for (int block = 0; block < nu; block += LANES) {
            ves_lanes next[K], w[K];
            for (int m = 0; m < n; m++) {
                next[m] = lam_factor(N, lam, m % N) * ves_lanes_at(plane(p, m / N, m % N + 1, d) + block);
                w[m] = lanes_part(weight + (d * n + m) * nu + block, nu - block);
            }
            for (int j = 0; j < n; j++) {
                ves_lanes sum = {0};
                for (int m = 0; m < n; m++) sum += next[m] * inverse(matrix, N, m, j) - w[m] * product[m][j];
                lanes_store(weight_lam + (d * n + j) * nu + block, nu - block, sum);
            }
        }
}

/* weight = basis matrix^-1; false, and zeros, where there is none. */
HOT bool combine(const ves_layout *layout, const places *p, int N, double lam, double *weight,
                 double *weight_lam)
{
    int n = 2 * N, nu = p->nu;
    row_of matrix;
    double derivative[K][K];
    if (!conditions(layout, p, N, lam, matrix, weight_lam ? derivative : NULL)) {
        memset(weight, 0, sizeof(double) * (size_t)(3 * n * nu));
        if (weight_lam) memset(weight_lam, 0, sizeof(double) * (size_t)(3 * n * nu));
        return false;
    }
    for (int d = 0; d < 3; d++)
        for (int block = 0; block < nu; block += LANES) {
            ves_lanes member[K];
            for (int m = 0; m < n; m++) member[m] = ves_lanes_at(plane(p, m / N, m % N, d) + block);
            for (int j = 0; j < n; j++) {
                ves_lanes sum = member[0] * inverse(matrix, N, 0, j);
                for (int m = 1; m < n; m++) sum += member[m] * inverse(matrix, N, m, j);
                lanes_store(weight + (d * n + j) * nu + block, nu - block, sum);
            }
        }
    if (weight_lam) combine_lam(p, N, lam, matrix, derivative, weight, weight_lam);
    return true;
}

HOT bool mode(const ves_layout *layout, int N, double lam, const places *p, double *weight,
              double *weight_lam)
{
    basis(p, N, lam, N + (weight_lam != NULL));
    return combine(layout, p, N, lam, weight, weight_lam);
}

/* Each order is compiled by itself. */
static bool mode_of(const ves_layout *layout, double lam, const places *p, double *weight, double *weight_lam)
{
    switch (layout->power) {
    case 1:
        return mode(layout, 1, lam, p, weight, weight_lam);
    case 2:
        return mode(layout, 2, lam, p, weight, weight_lam);
    case 3:
        return mode(layout, 3, lam, p, weight, weight_lam);
    default:
        return mode(layout, 4, lam, p, weight, weight_lam);
    }
}

ves_status ves_fast_mode(const ves_layout *layout, double lam, int nu, const double *u, double *weight,
                         double *weight_lam, double *room)
{
    places p = places_init(layout, nu, u, room);
    exponentials(&p, lam, p.left, p.right);
    return mode_of(layout, lam, &p, weight, weight_lam) ? VES_OK : VES_UNDETERMINED;
}

ves_status ves_fast_bind(const ves_layout *layout, double a, int modes, int nu, const double *u,
                         const ves_table *table)
{
    places p = places_init(layout, nu, u, table->room);
    int row = 3 * 2 * layout->power * nu, first = table->has_zero ? 1 : 0;
    bool good = true;
    exponentials(&p, a, p.left_1, p.right_1);
    for (int i = 0; i < p.width; i++)
        p.left[i] = first ? p.left_1[i] : 1, p.right[i] = first ? p.right_1[i] : 1;
    for (int n = first; n <= modes; n++) {
        double *slope = table->slope ? table->slope + (size_t)row * (size_t)n : NULL;
        good = mode_of(layout, a * n, &p, table->weight + (size_t)row * (size_t)n, slope) && good;
        for (int k = 0; slope && k < row; k++) slope[k] *= n; /* d/da = n d/dlam */
        for (int i = 0; i < p.width; i++)
            p.left[i] *= p.left_1[i], p.right[i] *= p.right_1[i]; /* e^{-a n u} */
    }
    return good ? VES_OK : VES_UNDETERMINED;
}

bool ves_fast_fits(const ves_layout *layout, const ves_operator *op)
{
    if (op->general || layout->power > POWER || layout->lower) return false;
    int left = 0, right = 0;
    for (int j = 0; j < 2 * layout->power; j++) {
        if (layout->knot[j].derivative >= orders_of(layout->power)) return false;
        left += layout->knot[j].u == 0, right += layout->knot[j].u == 1;
    }
    return left == layout->power && right == layout->power;
}

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
enum { POWER = 2, FAMILY = POWER + 1, TERMS = 12, K = 2 * POWER, LANES = VES_LANES };

_Static_assert(2 * K == VES_LANES, "a row of the condition matrix and its inverse is one register");

static const double SWITCH = 1.5; /* times N */

#define HOT static inline __attribute__((always_inline))

/* SERIES[k][i] = C(i+k, k) / (2 (i+k) + 1)!, the coefficients of s_k, and those of c_0; the other c_k =
 * t s_{k-1} / (2k). Terms up to 12 leave < 1e-18 for lam |t| <= 1.5. */
#define F2  2.
#define F3  6.
#define F4  24.
#define F5  120.
#define F6  720.
#define F7  5040.
#define F8  40320.
#define F9  362880.
#define F10 3628800.
#define F11 39916800.
#define F12 479001600.
#define F13 6227020800.
#define F14 87178291200.
#define F15 1307674368e3
#define F16 20922789888e3
#define F17 355687428096e3
#define F18 6402373705728e3
#define F19 121645100408832e3
#define F20 2432902008176640e3
#define F21 51090942171709440e3
#define F22 1124000727777607680e3
#define F23 25852016738884976640e3
#define F25 15511210043330985984e6
#define F27 10888869450418352160768e6
static const double COSH[TERMS] = {1,       1 / F2,  1 / F4,  1 / F6,  1 / F8,  1 / F10,
                                   1 / F12, 1 / F14, 1 / F16, 1 / F18, 1 / F20, 1 / F22};
static const double SERIES[FAMILY][TERMS] = {
    {1, 1 / F3, 1 / F5, 1 / F7, 1 / F9, 1 / F11, 1 / F13, 1 / F15, 1 / F17, 1 / F19, 1 / F21, 1 / F23},
    {1 / F3, 2 / F5, 3 / F7, 4 / F9, 5 / F11, 6 / F13, 7 / F15, 8 / F17, 9 / F19, 10 / F21, 11 / F23,
     12 / F25},
    {1 / F5, 3 / F7, 6 / F9, 10 / F11, 15 / F13, 21 / F15, 28 / F17, 36 / F19, 45 / F21, 55 / F23, 66 / F25,
     78 / F27}};

/* Everything along u has `width` places: nu wanted ones, 2N knots, padding to whole registers. */
typedef struct places {
    int nu, width;
    double *u, *mirrored;     /* u and 1 - u */
    double *left, *right;     /* e^{-lam u}, e^{-lam (1-u)} of the mode at hand */
    double *left_1, *right_1; /* of mode 1: their powers are all the others */
    double *basis;            /* [2][FAMILY][3][width]: family, member, derivative */
} places;

HOT double *plane(const places *p, int family, int k, int d)
{
    return p->basis + (size_t)(((family * FAMILY + k) * 3 + d) * p->width);
}

static int width(int nu)
{
    return (nu + K + LANES - 1) / LANES * LANES;
}

long ves_fast_room(int nu)
{
    return (2L * FAMILY * 3 + 6) * width(nu);
}

static places places_init(const ves_layout *layout, int nu, const double *u, double *room)
{
    int w = width(nu);
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

/* e^{-lam u} and e^{-lam (1-u)}: the second from the first while lam is small (a relative error of lam units
 * in the last place), by itself when it is not. */
static void exponentials(const places *p, double lam, double *left, double *right)
{
    static const double SMALL = 4;
    for (int i = 0; i < p->width; i++) left[i] = exp(-lam * p->u[i]);
    if (lam <= SMALL) {
        double last = exp(-lam);
        for (int i = 0; i < p->width; i++) right[i] = last / left[i];
    } else {
        for (int i = 0; i < p->width; i++) right[i] = exp(-lam * p->mirrored[i]);
    }
}

/* sum_i c[i] z^i by two Horner chains in z^2: half the latency. */
HOT ves_lanes horner(const double *c, ves_lanes z)
{
    ves_lanes z2 = z * z, even = c[TERMS - 2] + (ves_lanes){0}, rest = c[TERMS - 1] + (ves_lanes){0};
    for (int m = TERMS - 4; m >= 0; m -= 2) even = even * z2 + c[m], rest = rest * z2 + c[m + 1];
    return even + z * rest;
}

HOT ves_lanes *register_at(double *plane, int block)
{
    return (ves_lanes *)(plane + block);
}

/* family 0: c_k, family 1: s_k, with first and second derivatives. */
HOT void centred(const places *p, double lam, int members)
{
    double mu = lam * lam;
    for (int b = 0; b < p->width; b += LANES) {
        ves_lanes t = *register_at(p->u, b) - 0.5, tt = t * t, z = mu * tt, power = 1 + (ves_lanes){0};
        ves_lanes c1 = {0}, s1 = {0}; /* members k - 1 */
        for (int k = 0; k < members; k++) {
            ves_lanes s = power * t * horner(SERIES[k], z);
            ves_lanes c = k ? t * s1 / (2. * k) : horner(COSH, z);
            *register_at(plane(p, 0, k, 0), b) = *register_at(plane(p, 1, k, 1), b) = c;
            *register_at(plane(p, 1, k, 0), b) = s;
            *register_at(plane(p, 0, k, 1), b) = *register_at(plane(p, 1, k, 2), b) = mu * s + s1;
            *register_at(plane(p, 0, k, 2), b) = mu * c + c1;
            c1 = c, s1 = s, power *= tt;
        }
    }
}

/* One family of decaying solutions; sign -1: the mirror image. */
HOT void decaying(const places *p, int family, double lam, int members)
{
    double sign = family ? -1 : 1;
    for (int b = 0; b < p->width; b += LANES) {
        ves_lanes u = *register_at(family ? p->mirrored : p->u, b),
                  f = *register_at(family ? p->right : p->left, b);
        ves_lanes g = {0}, gu = {0}; /* member k - 1 and its derivative */
        for (int k = 0; k < members; k++) {
            if (k) f *= u;
            ves_lanes fu = sign * k * g - sign * lam * f;
            *register_at(plane(p, family, k, 0), b) = f;
            *register_at(plane(p, family, k, 1), b) = fu;
            *register_at(plane(p, family, k, 2), b) = sign * k * gu - sign * lam * fu;
            g = f, gu = fu;
        }
    }
}

HOT bool small_lam(int N, double lam)
{
    return lam <= SWITCH * N;
}

HOT void basis(const places *p, int N, double lam, int members)
{
    if (small_lam(N, lam)) {
        centred(p, lam, members);
    } else {
        decaying(p, 0, lam, members);
        decaying(p, 1, lam, members);
    }
}

/* d/dlam of member k is this times member k + 1. */
HOT double lam_factor(int N, double lam, int k)
{
    return small_lam(N, lam) ? 2 * lam * (k + 1) : -1;
}

/* One row of [matrix | inverse]: 2 K = 8 numbers, one register. */
typedef ves_lanes row_of[K];

/* Gauss-Jordan with partial pivoting on an equilibrated matrix; false when a pivot vanishes. */
HOT bool invert(int n, row_of a)
{
    for (int r = 0; r < n; r++) {
        ves_lanes row = a[r];
        double largest = 0;
        for (int c = 0; c < n; c++) largest = fabs(row[c]) > largest ? fabs(row[c]) : largest;
        row[n + r] = 1;
        a[r] = row * (1 / largest);
    }
    for (int p = 0; p < n; p++) {
        int best = p;
        for (int r = p + 1; r < n; r++)
            if (fabs(a[r][p]) > fabs(a[best][p])) best = r;
        if (!(fabs(a[best][p]) > 1e-13)) return false;
        ves_lanes pivot = a[best] / a[best][p];
        a[best] = a[p];
        a[p] = pivot;
        for (int r = 0; r < n; r++)
            if (r != p) a[r] -= a[r][p] * pivot;
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
        matrix[j] = row;
    }
    return invert(2 * N, matrix);
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
            for (int m = 0; m < n; m++) product[r][j] += derivative[r][m] * matrix[m][n + j];
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
                for (int m = 0; m < n; m++) sum += next[m] * matrix[m][n + j] - w[m] * product[m][j];
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
                ves_lanes sum = member[0] * matrix[0][n + j];
                for (int m = 1; m < n; m++) sum += member[m] * matrix[m][n + j];
                lanes_store(weight + (d * n + j) * nu + block, nu - block, sum);
            }
        }
    if (weight_lam) combine_lam(p, N, lam, matrix, derivative, weight, weight_lam);
    return true;
}

ves_status ves_fast_mode(const ves_layout *layout, double lam, int nu, const double *u, double *weight,
                         double *weight_lam, double *room)
{
    int N = layout->power;
    places p = places_init(layout, nu, u, room);
    exponentials(&p, lam, p.left, p.right);
    basis(&p, N, lam, N + (weight_lam != NULL));
    return combine(layout, &p, N, lam, weight, weight_lam) ? VES_OK : VES_UNDETERMINED;
}

HOT bool bind(const ves_layout *layout, int N, double a, int modes, const places *p, const ves_table *table)
{
    int row = 3 * 2 * N * p->nu;
    int first = table->has_zero ? 1 : 0;
    bool good = true;
    exponentials(p, a, p->left_1, p->right_1);
    for (int i = 0; i < p->width; i++) {
        p->left[i] = first ? p->left_1[i] : 1, p->right[i] = first ? p->right_1[i] : 1;
    }
    for (int n = first; n <= modes; n++) {
        double *slope = table->slope ? table->slope + (size_t)row * (size_t)n : NULL;
        basis(p, N, a * n, N + (table->slope != NULL));
        good = combine(layout, p, N, a * n, table->weight + (size_t)row * (size_t)n, slope) && good;
        for (int k = 0; slope && k < row; k++) slope[k] *= n; /* d/da = n d/dlam */
        for (int i = 0; i < p->width; i++)
            p->left[i] *= p->left_1[i], p->right[i] *= p->right_1[i]; /* e^{-a n u} */
    }
    return good;
}

ves_status ves_fast_bind(const ves_layout *layout, double a, int modes, int nu, const double *u,
                         const ves_table *table)
{
    places p = places_init(layout, nu, u, table->room);
    bool good =
        layout->power == 1 ? bind(layout, 1, a, modes, &p, table) : bind(layout, 2, a, modes, &p, table);
    return good ? VES_OK : VES_UNDETERMINED;
}

bool ves_fast_fits(const ves_layout *layout, const ves_operator *op)
{
    if (op->general || layout->power > POWER || layout->lower) return false;
    int left = 0, right = 0;
    for (int j = 0; j < 2 * layout->power; j++) {
        if (layout->knot[j].derivative > 2) return false;
        left += layout->knot[j].u == 0, right += layout->knot[j].u == 1;
    }
    return left == layout->power && right == layout->power;
}

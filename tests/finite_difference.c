/* Surfaces against the finite differences of [Ugail 2011, section 4.2.1]: the equation itself on a mesh of the
 * (u, v) plane, solved without a word of modes. k = 2 pi / q: the printed step would repeat the seam
 * (docs/errata.md). The differences are of second order: that is what must be seen. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdlib.h>

#include "bed.h"

static const double TWO_PI = 6.28318530717958647693, A = 1.3;

/* Boundary data, also as the problem files below have them; each component has other modes. */
static void ring(int end, double v, double out[3])
{
    if (end == 0) {
        out[0] = cos(v) + 0.2 * sin(3 * v), out[1] = sin(v), out[2] = 0.1 * cos(2 * v);
    } else {
        out[0] = 1.5 * cos(v), out[1] = 0.8 * sin(v) - 0.1 * cos(3 * v), out[2] = 2 + 0.3 * sin(2 * v);
    }
}

static void slope(int end, double v, double out[3])
{
    if (end == 0) {
        out[0] = 0.5 * cos(v), out[1] = 0.4, out[2] = 1 + 0.2 * sin(v);
    } else {
        out[0] = 0, out[1] = 0.3 * cos(2 * v), out[2] = 0.7;
    }
}

#define RINGS                                                                                                \
    "vesica: 1\ncurves:\n"                                                                                   \
    "  p0: {formula: [\"cos(v) + 0.2*sin(3*v)\", \"sin(v)\", \"0.1*cos(2*v)\"]}\n"                           \
    "  p1: {formula: [\"1.5*cos(v)\", \"0.8*sin(v) - 0.1*cos(3*v)\", \"2 + 0.3*sin(2*v)\"]}\n"
static const char *const LAPLACE = RINGS "patches:\n  w:\n    operator: {power: 1, a: 1.3}\n"
                                         "    conditions: [{u: 0, position: p0}, {u: 1, position: p1}]\n";
static const char *const BIHARMONIC =
    RINGS "  s0: {formula: [\"0.5*cos(v)\", \"0.4\", \"1 + 0.2*sin(v)\"]}\n"
          "  s1: {formula: [\"0\", \"0.3*cos(2*v)\", \"0.7\"]}\n"
          "patches:\n  w:\n    operator: {power: 2, a: 1.3}\n"
          "    conditions: [{u: 0, position: p0}, {u: 0, derivative: 1, field: s0}, {u: 1, position: p1}, "
          "{u: 1, derivative: 1, field: s1}]\n";

/* (p - 2) q unknowns, row i = 1 .. p - 2 along u and j = 0 .. q - 1 around; band: how far one is coupled. */
typedef struct mesh {
    int power, p, q, band, count;
    double h, k;
    double *row;  /* [count][2 band + 1] */
    double *side; /* [count][3] */
} mesh;

static void add(mesh *m, int at, int i, int j, double coefficient)
{
    int q = m->q;
    double v = m->k * j, known[3], g[3];
    j = (j % q + q) % q;
    if (i == -1 || i == m->p) { /* a node beyond the end, from the slope there: X(-h) = X(h) - 2 h X_u */
        int end = i > 0;
        slope(end, v, g);
        for (int c = 0; c < 3; c++) m->side[3 * at + c] -= coefficient * (end ? 2 : -2) * m->h * g[c];
        i = end ? m->p - 2 : 1;
    }
    if (i == 0 || i == m->p - 1) {
        ring(i > 0, v, known);
        for (int c = 0; c < 3; c++) m->side[3 * at + c] -= coefficient * known[c];
        return;
    }
    int to = (i - 1) * q + j;
    m->row[at * (2 * m->band + 1) + m->band + to - at] += coefficient;
}

/* Eqs 4.7-4.9, applied `power` times. */
static void stencil(mesh *m, int at, int i, int j, int power, double factor)
{
    if (power == 0) {
        add(m, at, i, j, factor);
        return;
    }
    double along = factor / (m->h * m->h), around = factor * A * A / (m->k * m->k);
    stencil(m, at, i + 1, j, power - 1, along);
    stencil(m, at, i - 1, j, power - 1, along);
    stencil(m, at, i, j + 1, power - 1, around);
    stencil(m, at, i, j - 1, power - 1, around);
    stencil(m, at, i, j, power - 1, -2 * (along + around));
}

/* Gaussian elimination within the band; the matrix is definite. The solution takes the place of the sides. */
static void solve(mesh *m)
{
    int n = m->count, b = m->band, w = 2 * b + 1;
    for (int p = 0; p < n; p++)
        for (int r = p + 1; r < n && r <= p + b; r++) {
            double f = m->row[r * w + b + p - r] / m->row[p * w + b];
            if (f == 0) continue;
            for (int c = p; c < n && c <= p + b; c++)
                m->row[r * w + b + c - r] -= f * m->row[p * w + b + c - p];
            for (int c = 0; c < 3; c++) m->side[3 * r + c] -= f * m->side[3 * p + c];
        }
    for (int p = n - 1; p >= 0; p--)
        for (int c = 0; c < 3; c++) {
            double sum = m->side[3 * p + c];
            for (int r = p + 1; r < n && r <= p + b; r++)
                sum -= m->row[p * w + b + r - p] * m->side[3 * r + c];
            m->side[3 * p + c] = sum / m->row[p * w + b];
        }
}

/* The largest distance between the mesh of p x q nodes and the surface. */
static double error(const char *text, int power, int p, int q)
{
    mesh m = {.power = power, .p = p, .q = q, .band = power * q, .count = (p - 2) * q};
    m.h = 1. / (p - 1), m.k = TWO_PI / q;
    m.row = calloc((size_t)(m.count * (2 * m.band + 1)), sizeof *m.row);
    m.side = calloc((size_t)(3 * m.count), sizeof *m.side);
    double *u = malloc(sizeof *u * (size_t)m.count), *v = malloc(sizeof *v * (size_t)m.count);
    double *out = malloc(sizeof *out * 18 * (size_t)m.count), worst = 0;
    for (int at = 0; at < m.count; at++) {
        stencil(&m, at, 1 + at / q, at % q, power, 1);
        u[at] = (1 + at / q) * m.h, v[at] = (at % q) * m.k;
    }
    solve(&m);
    bed b = bed_with(text, NULL, 8, 8);
    cr_assert_eq(ves_plan_points(b.plan, 0, m.count, u, v, out), VES_OK);
    for (int at = 0; at < m.count; at++)
        for (int c = 0; c < 3; c++) worst = fmax(worst, fabs(m.side[3 * at + c] - out[c * m.count + at]));
    bed_clear(&b);
    free(m.row), free(m.side), free(u), free(v), free(out);
    return worst;
}

/* Halving both steps divides the error by 4. */
static void check(const char *text, int power)
{
    double last = error(text, power, 13, 24);
    for (int k = 1; k <= 2; k++) {
        double next = error(text, power, (12 << k) + 1, 24 << k), order = log2(last / next);
        cr_expect(order > 1.9 && order < 2.1, "power %d, %d nodes: %g after %g, order %.3f", power,
                  (12 << k) + 1, next, last, order);
        last = next;
    }
    cr_expect(last < 1. / (48 * 48), "power %d: %g", power, last); /* h^2, on a surface of size 2 */
}

Test(finite_difference, laplace_surfaces_agree_to_second_order)
{
    check(LAPLACE, 1);
}

Test(finite_difference, biharmonic_surfaces_agree_to_second_order)
{
    check(BIHARMONIC, 2);
}

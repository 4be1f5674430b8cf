/* Poles: what a surface has where an end of its patch is one point, against closed forms, against what stands
 * nearby, and its gradient against differences. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bed.h"
#include "vesica/measure.h"

static const double TWO_PI = 6.28318530717958647693;

/* --- a measure that looks where it is told --- */

/* Weights of H, K and the normal, the same for all nodes. */
static const double BY_H = 1, BY_K = 0.3, BY_NORMAL[3] = {0.4, -0.7, 0.2};

typedef struct probe {
    double u[3], v[3];
    bool told; /* the look was answered */
    double H[9], K[9], normal[3][9];
} probe;
static probe asked; /* each test is a process of its own */

static ves_status eval(const ves_measure_input *input, double *value)
{
    int index = input->look(input, 0, 0, asked.u, asked.v);
    asked.told = index >= 0;
    *value = 0;
    for (int n = 0; n < 9 && asked.told; n++) {
        const ves_samples *s = input->sample[index];
        asked.H[n] = s->H[n], asked.K[n] = s->K[n];
        *value += BY_H * s->H[n] + BY_K * s->K[n];
        for (int c = 0; c < 3; c++)
            asked.normal[c][n] = s->normal[c][n], *value += BY_NORMAL[c] * s->normal[c][n];
    }
    return VES_OK;
}

static void gradient(const ves_measure_input *input, double seed, const ves_adjoint *const *adjoint,
                     double *number_adjoint)
{
    (void)number_adjoint;
    const ves_adjoint *g = adjoint[input->first_look];
    for (int n = 0; n < 9; n++) {
        g->H[n] += seed * BY_H, g->K[n] += seed * BY_K;
        for (int c = 0; c < 3; c++) g->normal[c][n] += seed * BY_NORMAL[c];
    }
}

static const ves_measure PROBE = {.name = "probe",
                                  .about = "what it is told",
                                  .unit = "1",
                                  .degree = VES_NO_DEGREE,
                                  .looks = 1,
                                  .surface = VES_NORMAL | VES_CURVATURE,
                                  .eval = eval,
                                  .gradient = gradient};
static const ves_measure *const PLUGIN[] = {&PROBE, NULL};

/* Differences of fourth order, h = 1e-3: truncation h^4 times fifth derivatives up to 1e4. */
static void check_gradient(const bed *b, const double *x, int n, double tolerance)
{
    double slope[8], constraint[4], h = 1e-3;
    ves_verdict verdict = {.constraint = constraint, .gradient = slope};
    ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE | VES_WANT_GRADIENT};
    cr_assert_eq(ves_plan_evaluate(b->plan, &ask, &verdict), VES_OK);
    cr_assert_eq(verdict.status, VES_OK, "%s", ves_status_text(verdict.status));
    for (int k = 0; k < n; k++) {
        double at[8], side[4];
        memcpy(at, x, sizeof *x * (size_t)n);
        for (int i = 0; i < 4; i++) {
            at[k] = x[k] + (i < 2 ? i - 2 : i - 1) * h;
            side[i] = value_at(b, at);
        }
        double want = (side[0] - 8 * side[1] + 8 * side[2] - side[3]) / (12 * h);
        cr_expect(fabs(slope[k] - want) < tolerance * fmax(1, fabs(want)),
                  "by %s: got %.12g, differences %.12g", b->problem->variable[k].name, slope[k], want);
    }
}

static void near(double got, double want, double tolerance, const char *what)
{
    cr_expect(fabs(got - want) <= tolerance * fmax(1, fabs(want)), "%s: got %.16g, want %.16g (off by %.2e)",
              what, got, want, got - want);
}

/* --- closed forms --- */

/* A patch of order 4 grown from a point: z = 1 + (m - 3) u^2 + (2 - m) u^3 and, beside it, a radius that
 * begins as s u. So k1 = k2 = 2 (3 - m) / s^2 at the pole; what is beside it differs by a term linear in u. */
#define DOME                                                                                                 \
    "vesica: 1\nvariables: {s: [0.2, 1, 4], m: [0.2, 1.5, 4]}\n"                                             \
    "curves: {n: {point: [0, 0, 1]}, e: {circle: 1}, out: {formula: [cos(v), sin(v), \"0\"]},\n"             \
    "         dn: {formula: [\"0\", \"0\", \"-1\"]}}\n"                                                      \
    "patches:\n  top: {operator: {power: 2, a: 1}, conditions: [{u: 0, position: n}, {u: 0, derivative: "    \
    "1,\n    field: out, scale: s}, {u: 1, position: e}, {u: 1, derivative: 1, field: dn, scale: m}]}\n"

Test(pole, of_a_dome_in_closed_form)
{
    static const int grid[] = {8, 16, 32, 64};
    for (size_t g = 0; g < sizeof grid / sizeof *grid; g++)
        for (int k = 0; k < 10; k++) {
            double x[2] = {0.7 + 0.05 * k, 1.3 + 0.03 * k}, want = 2 * (3 - x[1]) / (x[0] * x[0]);
            asked = (probe){.u = {0, 0, 0}, .v = {0.3, 2, 5}};
            bed b = bed_with(DOME "measures: {K: {max: {of: K}}, H: {max: {of: H}}}\n"
                                  "minimize: K + H + max_curvature + 0*probe\n",
                             PLUGIN, grid[g], 16);
            near(value_at(&b, x), want * want + 2 * want, 1e-12, "K + H + k");
            for (int n = 0; n < 9; n++) {
                near(asked.H[n], want, 1e-12, "H");
                near(asked.K[n], want * want, 1e-12, "K");
                near(asked.normal[2][n], 1, 1e-12, "normal");
            }
            check_gradient(&b, x, 2, 1e-7);
            bed_clear(&b);
        }
}

/* Any linear image M s of a sphere, x^T G x = 1 with G = (M M^T)^-1: with g = G x
 * H = (tr G g.g - g.G g) / (2 |g|^3),  K = det G / |g|^4. Its poles lie anywhere on it, and u and v run as
 * they like. */
#define T "(pi*u*(1.2 - 0.2*u))"
#define W "(v + 0.3*sin(v))"
#define PEBBLE                                                                                               \
    "vesica: 1\nvariables: {a: [0.1, 1.3, 5], b: [-5, 0.2, 5], c: [0.1, 0.8, 5], d: [-5, 0.3, 5]}\n"         \
    "patches:\n  p: {surface: {formula: [\n"                                                                 \
    "    a*sin(" T ")*cos(" W ") + b*sin(" T ")*sin(" W ") + d*cos(" T "),\n"                                \
    "    0.9*sin(" T ")*sin(" W ") + 0.1*cos(" T ") + 7,\n"                                                  \
    "    b*sin(" T ")*cos(" W ") + c*cos(" T ")]}}\n"

static void invert(const double m[3][3], double out[3][3], double *det)
{
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            out[c][r] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
        }
    *det = m[0][0] * out[0][0] + m[0][1] * out[1][0] + m[0][2] * out[2][0];
    for (int k = 0; k < 9; k++) out[k / 3][k % 3] /= *det;
}

/* At M (0, 0, 1), or opposite, where it is the same. */
static void pebble(const double x[4], double *H, double *K)
{
    const double M[3][3] = {{x[0], x[1], x[3]}, {0, 0.9, 0.1}, {x[1], 0, x[2]}};
    double I[3][3], G[3][3], g[3] = {0}, det, square = 0, gGg = 0, trace = 0;
    invert(M, I, &det);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) {
            G[r][c] = 0;
            for (int k = 0; k < 3; k++) G[r][c] += I[k][r] * I[k][c];
        }
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) g[r] += G[r][c] * M[c][2];
    for (int r = 0; r < 3; r++) {
        square += g[r] * g[r], trace += G[r][r];
        for (int c = 0; c < 3; c++) gGg += g[r] * G[r][c] * g[c];
    }
    *H = (trace * square - gGg) / (2 * pow(square, 1.5));
    *K = 1 / (det * det) / (square * square);
}

Test(pole, of_ellipsoids_that_lean)
{
    for (int k = 0; k < 10; k++) {
        double x[4] = {1 + 0.1 * k, 0.3 - 0.05 * k, 0.8 + 0.07 * k, 0.1 * k - 0.4}, H, K;
        asked = (probe){.u = {0, 0.4, 1}, .v = {0.3, 2, 5}};
        bed b = bed_with(PEBBLE "shape: {closed: true}\nminimize: probe\n", PLUGIN, 16, 16);
        value_at(&b, x);
        pebble(x, &H, &K);
        for (int n = 0; n < 9; n++) {
            if (n % 3 == 1) continue;
            near(asked.H[n], H, 1e-12, "H");
            near(asked.K[n], K, 1e-12, "K");
        }
        check_gradient(&b, x, 4, 1e-7);
        bed_clear(&b);
    }
}

/* --- against what is nearby --- */

/* Grown from a point, with a plane of tangents that leans, and rims of several modes: the limit is one of
 * each line. Curvature is not that of a smooth surface. */
#define BUD                                                                                                  \
    "vesica: 1\n"                                                                                            \
    "variables: {s: [0.2, 1.1, 4], t: [-2, 0.3, 2], g: [0.1, 0.8, 3], a: [0.1, 1.3, 5], h: [0.1, 1.5, 5]}\n" \
    "curves:\n"                                                                                              \
    "  o: {point: [0.1, 0.2, h]}\n"                                                                          \
    "  p: {ellipse: {radii: [1.1, s]}, apply: [{shift: 0.1}, {rotate: [t, 0.1, 0]}, {translate: [0, 0.2*t, " \
    "0.1]}]}\n"                                                                                              \
    "  out: {ellipse: {radii: [1, g]}, apply: [{rotate: [0.3*t, 0.2, 0.1]}]}\n"                              \
    "  q: {formula: [\"cos(v) + 0.1*cos(3*v)\", \"sin(v)*g\", \"0.2*sin(3*v) - s\"]}\n"
#define BUD_LOW                                                                                              \
    "patches:\n  w: {operator: {power: 2, a: a}, conditions: [{u: 0, position: o}, {u: 0, derivative: 1, "   \
    "field: out, scale: 2*g}, {u: 1, position: p}, {u: 1, derivative: 1, from: p, to: q, scale: 0.6}]}\n"
#define BUD_HIGH                                                                                             \
    "patches:\n  w: {operator: {power: 2, a: a}, conditions: [{u: 1, position: o}, {u: 1, derivative: 1, "   \
    "field: out, scale: -2*g}, {u: 0, position: p}, {u: 0, derivative: 1, from: p, to: q, scale: -0.6}]}\n"

static void cross(const double *a, const double *b, double *out)
{
    for (int c = 0; c < 3; c++) {
        int d = (c + 1) % 3, e = (c + 2) % 3;
        out[c] = a[d] * b[e] - a[e] * b[d];
    }
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* H, K and the normal of Xu x Xv [Ugail 2011, eqs 7.4-7.5], node by node. */
static void forms(const bed *b, double u, double v, double out[5])
{
    double f[6][3], n[3];
    cr_assert_eq(ves_plan_points(b->plan, 0, 1, &u, &v, &f[0][0]), VES_OK);
    cross(f[1], f[2], n);
    double E = dot(f[1], f[1]), F = dot(f[1], f[2]), G = dot(f[2], f[2]), J = sqrt(dot(n, n));
    double L = dot(n, f[3]) / J, M = dot(n, f[4]) / J, N = dot(n, f[5]) / J;
    out[0] = -(E * N - 2 * F * M + G * L) / (2 * J * J);
    out[1] = (L * N - M * M) / (J * J);
    for (int c = 0; c < 3; c++) out[2 + c] = n[c] / J;
}

/* Along u they are a power series: six places at h, 2 h, ... 6 h tell its first term but for 720 h^6 times the
 * seventh, and 63 times their rounding, 1e-16 / h^2. */
static void check_nearby(const char *text, int end)
{
    static const double share[6] = {6, -15, 20, -15, 6, -1}, h = 4e-4;
    double x[5] = {1.1, 0.3, 0.8, 1.3, 1.5}, lines[3] = {0.3, 2, 5}, least = HUGE_VAL, most = -HUGE_VAL;
    asked = (probe){.u = {0, 0.5, 1}, .v = {0.3, 2, 5}};
    bed b = bed_with(text, PLUGIN, 16, 32);
    value_at(&b, x);
    for (int j = 0; j < 3; j++) {
        double limit[5] = {0}, beside[5], side = 0;
        int n = 3 * j + (end ? 2 : 0);
        for (int k = 0; k < 6; k++) {
            double t = h * (k + 1);
            forms(&b, end ? 1 - t : t, lines[j], beside);
            for (int c = 0; c < 5; c++) limit[c] += share[k] * beside[c];
        }
        for (int c = 0; c < 3; c++) side += limit[2 + c] * asked.normal[c][n];
        near(fabs(side), 1, 1e-8, "normal");
        near(asked.H[n] * side, limit[0], 1e-8, "H");
        near(asked.K[n], limit[1], 1e-8, "K");
        least = fmin(least, asked.H[n]), most = fmax(most, asked.H[n]);
    }
    cr_expect(most - least > 0.01, "the limits differ: %g to %g", least, most);
    check_gradient(&b, x, 5, 1e-7);
    bed_clear(&b);
}

Test(pole, is_the_limit_of_what_is_nearby)
{
    check_nearby(BUD BUD_LOW "minimize: probe\n", 0);
    check_nearby(BUD BUD_HIGH "minimize: probe\n", 1);
    check_nearby(BUD BUD_LOW "scale: {equation: area == 5}\nminimize: probe\n", 0);
}

/* A bowl through points: its splines have z = h u^2 exactly, and a plane of tangents. */
Test(pole, of_a_sheet_of_points)
{
    static const double x[8] = {1, 0.8, 0, -0.8, -1, -0.7, 0, 0.7},
                        y[8] = {0, 0.7, 1, 0.6, 0, -0.8, -1, -0.7};
    char text[4000] = BUD "patches: {w: {surface: {points: [";
    for (int r = 0; r < 4; r++)
        for (int k = 0; k < 8; k++) {
            size_t at = strlen(text);
            snprintf(text + at, sizeof text - at, "%s[%.17g*g, %.17g*s, %.17g*h]%s", k ? ", " : "[",
                     r / 3. * x[k], r / 3. * y[k], r * r / 9.,
                     k < 7   ? ""
                     : r < 3 ? "], "
                             : "]");
        }
    strcat(text, "]}}}\nminimize: probe + a + t\n");
    check_nearby(text, 0);
}

/* The extremes too are those of the lines, and no higher than what is nearby. */
Test(pole, measures_see_it)
{
    double x[5] = {1.1, 0.3, 0.8, 1.3, 1.5}, most = -HUGE_VAL, form[5];
    for (int end = 0; end < 2; end++) {
        char text[3000];
        snprintf(text, sizeof text, "%s%smeasures: {M: {max: {of: abs(H) - 1000*%s}}}\nminimize: M\n", BUD,
                 end ? BUD_HIGH : BUD_LOW, end ? "(1 - u)" : "u");
        bed b = bed_with(text, NULL, 16, 32);
        double got = value_at(&b, x);
        for (int j = 0; j < 720; j++) {
            forms(&b, end ? 1 - 1e-6 : 1e-6, TWO_PI / 720 * j, form);
            most = fmax(most, fabs(form[0]));
        }
        near(got, most, 1e-4, "the highest"); /* of 720 lines, 1e-6 beside the pole */
        check_gradient(&b, x, 5, 1e-6);
        bed_clear(&b);
    }
}

/* --- where there is none --- */

/* A cone; what has no slope at its end; a sheet whose lines begin without a direction. */
Test(pole, without_a_limit_is_told)
{
    static const char *const sheet[] = {"[s*u*cos(v), s*u*sin(v), 0.7*u]",
                                        "[s*sqrt(u)*cos(v), s*sqrt(u)*sin(v), u]",
                                        "[s*u^2*cos(v), s*u^2*sin(v), u^4]",
                                        "[s*(1 - cos(2*pi + u))*cos(v), s*(1 - cos(2*pi + u))*sin(v), u^4]"};
    for (size_t k = 0; k < sizeof sheet / sizeof *sheet; k++) {
        char text[1000];
        double x = 1.37;
        snprintf(text, sizeof text,
                 "vesica: 1\nvariables: {s: [0.1, 1, 5]}\npatches: {p: {surface: {formula: %s}}}\n"
                 "minimize: probe + s\n",
                 sheet[k]);
        asked = (probe){.u = {0, 0.3, 0.6}, .v = {0.3, 2, 5}, .told = true};
        bed b = bed_with(text, PLUGIN, 16, 16);
        value_at(&b, &x);
        cr_expect(!asked.told, "%s: H = %g", sheet[k], asked.H[0]);
        bed_clear(&b);
    }
}

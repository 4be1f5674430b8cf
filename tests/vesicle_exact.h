/* The least of all axisymmetric membranes of a family, independent of patches, measures and searches of the house: the
 * meridian by its angle psi(t) = pi t + sum b_k sin(k pi t), 0 <= t <= 1, a series that converges faster than any
 * power on smooth shapes; the arc length s(t) is t, or graded towards a neck; r and z by integrating cos psi and sin psi between Gauss nodes; the least energy by
 * sequential quadratic programming in the b_k. */
#ifndef TESTS_VESICLE_EXACT_H
#define TESTS_VESICLE_EXACT_H

#include <criterion/criterion.h>
#include <math.h>
#include <nlopt.h>
#include <stdlib.h>
#include <string.h>

enum { EX_PANELS = 40, EX_GAUSS = 16, EX_NODES = EX_PANELS * EX_GAUSS, EX_MODES = 130 };

static const double EX_PI = 3.14159265358979323846;

typedef struct exact {
    int modes;
    double c0, nu;    /* reduced */
    double m;         /* the area difference that is asked for; NAN: any */
    double alpha, m0; /* or what another one than m0 costs: pi alpha (M - m0)^2 of 8 pi kappa */
    double t[EX_NODES], stretch[EX_NODES], weight[EX_NODES],
        inner[EX_GAUSS][EX_GAUSS];                               /* of integrals from the begin of a panel */
    double sine[EX_MODES][EX_NODES], cosine[EX_MODES][EX_NODES]; /* sin(k pi t), k pi cos(k pi t) */
    /* at b */
    double bound[EX_MODES];
    double psi[EX_NODES], u[EX_NODES], r[EX_NODES], rk[EX_MODES][EX_NODES];
    double energy, gap, reduced; /* E/(8 pi kappa), r(1), reduced volume */
    double dE[EX_MODES], dgap[EX_MODES], dreduced[EX_MODES], dM[EX_MODES];
    double tail; /* the last amplitudes: how well it is resolved */
    double M, R0, thickness,
        neck; /* of lengths over R0: pole to pole, the least r between two bulges; 0: there is none */
} exact;

/* Nodes and weights of -1 .. 1, by Newton's method on the Legendre polynomial. */
static inline void exact_gauss(double x[EX_GAUSS], double w[EX_GAUSS])
{
    for (int i = 0; i < EX_GAUSS; i++) {
        double t = -cos(EX_PI * (i + 0.75) / (EX_GAUSS + 0.5)), slope = 1;
        for (int k = 0; k < 60; k++) {
            double p = 1, q = 0;
            for (int n = 1; n <= EX_GAUSS; n++) {
                double next = ((2 * n - 1) * t * p - (n - 1) * q) / n;
                q = p, p = next;
            }
            slope = EX_GAUSS * (t * p - q) / (t * t - 1);
            t -= p / slope;
        }
        x[i] = t, w[i] = 2 / ((1 - t * t) * slope * slope);
    }
}

/* inner[i][j]: the integral of Lagrange's polynomial j from -1 to x_i. */
static inline void exact_inner(const double x[EX_GAUSS], const double w[EX_GAUSS], exact *e)
{
    for (int i = 0; i < EX_GAUSS; i++)
        for (int j = 0; j < EX_GAUSS; j++) {
            double half = (x[i] + 1) / 2, sum = 0;
            for (int k = 0; k < EX_GAUSS; k++) {
                double at = -1 + half * (x[k] + 1), l = 1;
                for (int m = 0; m < EX_GAUSS; m++) l *= m == j ? 1 : (at - x[m]) / (x[j] - x[m]);
                sum += half * w[k] * l;
            }
            e->inner[i][j] = sum / 2 / EX_PANELS;
        }
}

/* ds/dt = 1 + a cos pi t + b cos 2 pi t, which is even about both poles, as sines ask for; it is least at t = at. */
static inline void exact_grade(exact *e, double at, double least)
{
    const double c = cos(EX_PI * at), b = (1 - least) / (1 + 2 * c * c), a = -4 * c * b;
    for (int n = 0; n < EX_NODES; n++)
        e->stretch[n] = 1 + a * cos(EX_PI * e->t[n]) + b * cos(2 * EX_PI * e->t[n]);
}

static inline exact *exact_create(int modes, double c0, double nu)
{
    double x[EX_GAUSS], w[EX_GAUSS];
    exact *e = calloc(1, sizeof *e);
    cr_assert(e != NULL);
    e->bound[0] = e->m = NAN;
    e->modes = modes, e->c0 = c0, e->nu = nu;
    exact_gauss(x, w);
    exact_inner(x, w, e);
    for (int n = 0; n < EX_NODES; n++) {
        e->t[n] = (n / EX_GAUSS + (x[n % EX_GAUSS] + 1) / 2) / EX_PANELS;
        e->weight[n] = w[n % EX_GAUSS] / 2 / EX_PANELS;
        e->stretch[n] = 1;
        for (int k = 0; k < e->modes; k++) {
            e->sine[k][n] = sin((k + 1) * EX_PI * e->t[n]);
            e->cosine[k][n] = (k + 1) * EX_PI * cos((k + 1) * EX_PI * e->t[n]);
        }
    }
    return e;
}

/* F(s) = integral of f from 0; returns F(1). */
static inline double exact_integrate(const exact *e, const double *f, double *F)
{
    double before = 0;
    for (int p = 0; p < EX_PANELS; p++) {
        const double *g = f + p * EX_GAUSS;
        for (int i = 0; i < EX_GAUSS; i++) {
            double sum = before;
            for (int j = 0; j < EX_GAUSS; j++) sum += e->inner[i][j] * g[j];
            F[p * EX_GAUSS + i] = sum;
        }
        for (int j = 0; j < EX_GAUSS; j++) before += e->weight[j] * g[j];
    }
    return before;
}

/* Of unit length: A = 2 pi int r, V = pi int r^2 sin psi, and with h = u + sin psi / r, u = dpsi/ds,
 * E = (1/16 pi) (2 pi int r h^2 - 2 c0 / R0 2 pi int r h + c0^2 4 pi). */
static inline void exact_bind(exact *e, const double *b)
{
    double f[EX_NODES], A = 0, V = 0, I1 = 0, I2 = 0;
    for (int n = 0; n < EX_NODES; n++) {
        e->psi[n] = EX_PI * e->t[n], e->u[n] = EX_PI;
        for (int k = 0; k < e->modes; k++)
            e->psi[n] += b[k] * e->sine[k][n], e->u[n] += b[k] * e->cosine[k][n];
        e->u[n] /= e->stretch[n];
        f[n] = cos(e->psi[n]) * e->stretch[n];
    }
    e->gap = exact_integrate(e, f, e->r);
    for (int k = 0; k < e->modes; k++) {
        for (int n = 0; n < EX_NODES; n++) f[n] = -sin(e->psi[n]) * e->sine[k][n] * e->stretch[n];
        e->dgap[k] = exact_integrate(e, f, e->rk[k]);
    }
    for (int n = 0; n < EX_NODES; n++) {
        double w = e->weight[n] * e->stretch[n], r = e->r[n], h = e->u[n] + sin(e->psi[n]) / r;
        A += w * r, V += w * r * r * sin(e->psi[n]), I1 += w * r * h, I2 += w * r * h * h;
    }
    A *= 2 * EX_PI, V *= EX_PI, I1 *= 2 * EX_PI, I2 *= 2 * EX_PI;
    const double R0 = e->R0 = sqrt(A / (4 * EX_PI)), ball = 4 * EX_PI / 3 * R0 * R0 * R0;
    e->energy = (I2 - 2 * e->c0 * I1 / R0 + e->c0 * e->c0 * 4 * EX_PI) / (16 * EX_PI);
    e->reduced = V / ball;
    e->M = I1 / (8 * EX_PI * R0);
    e->energy += EX_PI * e->alpha * (e->M - e->m0) * (e->M - e->m0);
    e->thickness = e->neck = 0;
    for (int n = 0; n < EX_NODES; n++) {
        e->thickness += e->weight[n] * e->stretch[n] * sin(e->psi[n]) / R0;
        if (n && n + 1 < EX_NODES && e->r[n] < e->r[n - 1] && e->r[n] < e->r[n + 1]) e->neck = e->r[n] / R0;
    }
    for (int k = 0; k < e->modes; k++) {
        double dA = 0, dV = 0, d1 = 0, d2 = 0;
        for (int n = 0; n < EX_NODES; n++) {
            double w = e->weight[n] * e->stretch[n], r = e->r[n], rk = e->rk[k][n], sn = sin(e->psi[n]),
                   cs = cos(e->psi[n]);
            double h = e->u[n] + sn / r,
                   hk = e->cosine[k][n] / e->stretch[n] + cs * e->sine[k][n] / r - sn * rk / (r * r);
            dA += w * rk, dV += w * (2 * r * sn * rk + r * r * cs * e->sine[k][n]);
            d1 += w * (rk * h + r * hk), d2 += w * (rk * h * h + 2 * r * h * hk);
        }
        dA *= 2 * EX_PI, dV *= EX_PI, d1 *= 2 * EX_PI, d2 *= 2 * EX_PI;
        double dR0 = dA / (8 * EX_PI * R0);
        e->dE[k] = (d2 - 2 * e->c0 * (d1 / R0 - I1 / (R0 * R0) * dR0)) / (16 * EX_PI);
        e->dM[k] = d1 / (8 * EX_PI * R0) - e->M / R0 * dR0;
        e->dE[k] += 2 * EX_PI * e->alpha * (e->M - e->m0) * e->dM[k];
        e->dreduced[k] = dV / ball - 3 * e->reduced / R0 * dR0;
    }
}

/* Amplitudes fall at least like k^(-3/2): in units of that the problem is well scaled. */
static inline double exact_unit(int k)
{
    return pow(k + 1, -1.5);
}

static inline void exact_at(exact *e, const double *y)
{
    double b[EX_MODES] = {0};
    const size_t size = (size_t)e->modes * sizeof *y;
    if (!memcmp(y, e->bound, size)) return; /* energy and equations are asked for in turn */
    memcpy(e->bound, y, size);
    for (int k = 0; k < e->modes; k++) b[k] = y[k] * exact_unit(k);
    exact_bind(e, b);
}

static double exact_energy(unsigned n, const double *y, double *gradient, void *data)
{
    exact *e = data;
    exact_at(e, y);
    for (unsigned k = 0; gradient && k < n; k++) gradient[k] = e->dE[k] * exact_unit((int)k);
    return e->energy;
}

enum { EX_WEIGHT = 30 }; /* of the equations: closed, of that volume */

static void exact_equations(unsigned m, double *value, unsigned n, const double *y, double *slope, void *data)
{
    exact *e = data;
    exact_at(e, y);
    value[0] = EX_WEIGHT * e->gap, value[1] = EX_WEIGHT * (e->reduced - e->nu);
    if (m > 2) value[2] = EX_WEIGHT * (e->M - e->m);
    for (unsigned k = 0; slope && k < n; k++) {
        slope[k] = EX_WEIGHT * e->dgap[k] * exact_unit((int)k);
        slope[n + k] = EX_WEIGHT * e->dreduced[k] * exact_unit((int)k);
        if (m > 2) slope[2 * n + k] = EX_WEIGHT * e->dM[k] * exact_unit((int)k);
    }
}

/* From the shape b[modes], which becomes the best. */
static inline void exact_solve(exact *e, double *b)
{
    double y[EX_MODES], value, tolerance[3] = {1e-12, 1e-12, 1e-12};
    for (int k = 0; k < e->modes; k++) y[k] = b[k] / exact_unit(k);
    nlopt_opt opt = nlopt_create(NLOPT_LD_SLSQP, (unsigned)e->modes);
    nlopt_set_min_objective(opt, exact_energy, e);
    nlopt_add_equality_mconstraint(opt, isnan(e->m) ? 2 : 3, exact_equations, e, tolerance);
    nlopt_set_ftol_rel(opt, 1e-15);
    nlopt_set_maxeval(opt, 2000);
    nlopt_result result = nlopt_optimize(opt, y, &value);
    nlopt_destroy(opt);
    cr_assert(result > 0 || result == NLOPT_ROUNDOFF_LIMITED, "%s", nlopt_result_to_string(result));
    exact_at(e, y);
    for (int k = 0; k < e->modes; k++) b[k] = y[k] * exact_unit(k);
    e->tail = fmax(fabs(b[e->modes - 1]), fabs(b[e->modes - 2]));
    cr_assert(fabs(e->gap) < 1e-9 && fabs(e->reduced - e->nu) < 1e-9, "%g %g", e->gap, e->reduced - e->nu);
}

#endif

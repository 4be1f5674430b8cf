/* Samples of bodies in closed form, and a measure on them as the plan would call it. */
#ifndef VES_TEST_SAMPLES_H
#define VES_TEST_SAMPLES_H

#include <criterion/criterion.h>
#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "base/random.h"
#include "formula/formula.h"
#include "measure/registry.h"
#include "surface/grid.h"

enum { RIG_SAMPLES = 6, RIG_NUMBERS = 16, RIG_SLOTS = 2, RIG_KEYS = 8, RIG_PLANES = 24 };

#define PI 3.14159265358979323846

/* X, Xu, Xv, Xuu, Xuv, Xvv at (u, v) of a body with the numbers p. */
typedef void body_function(const double *p, double u, double v, double X[6][3]);

/* X -> scale * turn * X + shift; side +1 where Xu x Xv points outward. */
typedef struct body {
    body_function *at;
    double p[4], side;
    double scale, turn[3][3], shift[3];
} body;

static inline body body_init(body_function *at, double side, double p0, double p1, double p2)
{
    return (body){at, {p0, p1, p2, 0}, side, 1, {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0}};
}

/* A rotation about a random axis, and a shift. */
static inline body body_moved(body b, uint64_t seed)
{
    ves_random random = {.seed = seed};
    double q[4], n = 0;
    for (int k = 0; k < 4; k++) q[k] = ves_random_normal(&random), n += q[k] * q[k];
    for (int k = 0; k < 4; k++) q[k] /= sqrt(n);
    double w = q[0], x = q[1], y = q[2], z = q[3];
    double turn[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                         {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                         {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}};
    memcpy(b.turn, turn, sizeof turn);
    for (int c = 0; c < 3; c++) b.shift[c] = ves_random_normal(&random);
    return b;
}

static inline void body_at(const body *b, double u, double v, double X[6][3])
{
    double raw[6][3];
    b->at(b->p, u, v, raw);
    for (int f = 0; f < 6; f++)
        for (int c = 0; c < 3; c++) {
            X[f][c] = f ? 0 : b->shift[c];
            for (int k = 0; k < 3; k++) X[f][c] += b->scale * b->turn[c][k] * raw[f][k];
        }
}

/* rho(u) (cos v, sin v), z(u): the derivatives from those of rho and z. */
static inline void revolve(const double rho[3], const double z[3], double v, double X[6][3])
{
    double c = cos(v), s = sin(v);
    double all[6][3] = {{rho[0] * c, rho[0] * s, z[0]}, {rho[1] * c, rho[1] * s, z[1]},
                        {-rho[0] * s, rho[0] * c, 0},   {rho[2] * c, rho[2] * s, z[2]},
                        {-rho[1] * s, rho[1] * c, 0},   {-rho[0] * c, -rho[0] * s, 0}};
    memcpy(X, all, sizeof all);
}

/* Half axes p[0], p[1], p[2] along x, y, z; side +1. */
static inline void ellipsoid(const double *p, double u, double v, double X[6][3])
{
    double t = PI * u, rho[3] = {sin(t), PI * cos(t), -PI * PI * sin(t)},
           z[3] = {cos(t), -PI * sin(t), -PI * PI * cos(t)};
    revolve(rho, z, v, X);
    for (int f = 0; f < 6; f++)
        for (int c = 0; c < 3; c++) X[f][c] *= p[c];
}

/* The upper half of a ball of radius p[0], u from the pole to the rim; side +1. */
static inline void half_ball(const double *p, double u, double v, double X[6][3])
{
    double t = PI / 2 * u, q = PI / 2, r = p[0];
    double rho[3] = {r * sin(t), r * q * cos(t), -r * q * q * sin(t)},
           z[3] = {r * cos(t), -r * q * sin(t), -r * q * q * cos(t)};
    revolve(rho, z, v, X);
}

/* Radii p[0] (of the middle line) and p[1] (of the tube); side -1. */
static inline void torus(const double *p, double u, double v, double X[6][3])
{
    double q = 2 * PI, t = q * u, r = p[1];
    double rho[3] = {p[0] + r * cos(t), -r * q * sin(t), -r * q * q * cos(t)},
           z[3] = {r * sin(t), r * q * cos(t), -r * q * q * sin(t)};
    revolve(rho, z, v, X);
}

/* Radius from p[0] at u = 0 to p[1] at u = 1, height p[2]; side -1. */
static inline void frustum(const double *p, double u, double v, double X[6][3])
{
    double rho[3] = {p[0] + (p[1] - p[0]) * u, p[1] - p[0], 0}, z[3] = {p[2] * u, p[2], 0};
    revolve(rho, z, v, X);
}

/* Neck p[0], height from -p[0] p[1] to p[0] p[1]; side -1. */
static inline void catenoid(const double *p, double u, double v, double X[6][3])
{
    double q = 2 * p[1], t = p[1] * (2 * u - 1), r = p[0];
    double rho[3] = {r * cosh(t), r * q * sinh(t), r * q * q * cosh(t)}, z[3] = {r * t, r * q, 0};
    revolve(rho, z, v, X);
}

/* A tube whose ends are no plane curves: radius p[0] + p[1] u cos 3v, height p[2] u + p[1] cos 2v; side -1.
 */
static inline void wavy_tube(const double *p, double u, double v, double X[6][3])
{
    double w = p[1], r = p[0] + w * u * cos(3 * v), ru = w * cos(3 * v), rv = -3 * w * u * sin(3 * v);
    double ruv = -3 * w * sin(3 * v), rvv = -9 * w * u * cos(3 * v), c = cos(v), s = sin(v);
    double all[6][3] = {{r * c, r * s, p[2] * u + w * cos(2 * v)},
                        {ru * c, ru * s, p[2]},
                        {rv * c - r * s, rv * s + r * c, -2 * w * sin(2 * v)},
                        {0, 0, 0},
                        {ruv * c - ru * s, ruv * s + ru * c, 0},
                        {rvv * c - 2 * rv * s - r * c, rvv * s + 2 * rv * c - r * s, -4 * w * cos(2 * v)}};
    memcpy(X, all, sizeof all);
}

/* All planes of a site, in the order of ves_samples: X ... Xvv, normal, dA, H, K. */
typedef struct planes {
    double *at[RIG_PLANES];
} planes;

typedef struct rig {
    ves_arena arena;
    int samples;
    planes plane[RIG_SAMPLES], back[RIG_SAMPLES];
    ves_samples site[RIG_SAMPLES], masked[RIG_SAMPLES];
    ves_adjoint adjoint[RIG_SAMPLES];
    const ves_samples *sample[RIG_SAMPLES];
    const ves_adjoint *adjoints[RIG_SAMPLES];
    const ves_measure *measure;
    ves_arg arg[RIG_KEYS];
    ves_args args;
    const ves_formula *formula;
    double number[RIG_NUMBERS], number_back[RIG_NUMBERS]; /* two slots p, q first */
    int numbers;
    double *room;
    void *state; /* what `prepare` made */
} rig;

static inline void rig_open(rig *r)
{
    memset(r, 0, sizeof *r);
    r->numbers = RIG_SLOTS;
    r->number[0] = 1.37, r->number[1] = 0.83;
}

static inline void rig_close(rig *r)
{
    if (r->measure && r->measure->release) r->measure->release(r->state);
    ves_arena_destroy(&r->arena);
}

static inline void rig_cross(const double a[3], const double b[3], double out[3])
{
    for (int c = 0; c < 3; c++) {
        int i = (c + 1) % 3, j = (c + 2) % 3;
        out[c] = a[i] * b[j] - a[j] * b[i];
    }
}

static inline double inner(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Normal, dA, H and K by the textbook: L = N.Xuu and so on, H = -(E N - 2 F M + G L) / 2 (E G - F^2). */
static inline void rig_forms(double X[6][3], double side, double weight, double out[6])
{
    double n[3], J;
    rig_cross(X[1], X[2], n);
    J = sqrt(inner(n, n));
    for (int c = 0; c < 3; c++) out[c] = n[c] = side * n[c] / J;
    double E = inner(X[1], X[1]), F = inner(X[1], X[2]), G = inner(X[2], X[2]);
    double L = inner(n, X[3]), M = inner(n, X[4]), N = inner(n, X[5]);
    out[3] = J * weight;
    out[4] = -(E * N - 2 * F * M + G * L) / (2 * J * J);
    out[5] = (L * N - M * M) / (J * J);
}

/* Points the planes of a site, where mask asks for them, at the arrays. */
static inline void rig_point(const planes *p, unsigned mask, ves_samples *s, ves_adjoint *g)
{
    double **to[6] = {g->X, g->Xu, g->Xv, g->Xuu, g->Xuv, g->Xvv};
    const double **from[6] = {s->X, s->Xu, s->Xv, s->Xuu, s->Xuv, s->Xvv};
    for (int f = 0; f < 6; f++)
        for (int c = 0; c < 3; c++) {
            double *plane = mask & (1u << f) ? p->at[3 * f + c] : NULL;
            to[f][c] = plane, from[f][c] = plane;
        }
    for (int c = 0; c < 3; c++)
        g->normal[c] = mask & VES_NORMAL ? p->at[18 + c] : NULL, s->normal[c] = g->normal[c];
    s->dA = g->dA = mask & VES_AREA ? p->at[21] : NULL;
    s->H = g->H = mask & VES_CURVATURE ? p->at[22] : NULL;
    s->K = g->K = mask & VES_CURVATURE ? p->at[23] : NULL;
}

static inline void rig_add(rig *r, ves_site site, const body *b, const ves_grid *grid, double side)
{
    cr_assert(r->samples < RIG_SAMPLES);
    int i = r->samples++, count = grid->count;
    for (int k = 0; k < RIG_PLANES; k++) {
        r->plane[i].at[k] = ves_arena_take(&r->arena, (size_t)count, sizeof(double));
        r->back[i].at[k] = ves_arena_take(&r->arena, (size_t)count, sizeof(double));
        cr_assert(r->plane[i].at[k] && r->back[i].at[k]);
    }
    for (int n = 0; n < count; n++) {
        double X[6][3], form[6];
        body_at(b, grid->u[n % grid->nu], grid->v[n / grid->nu], X);
        rig_forms(X, b->side, grid->weight[n], form);
        for (int k = 0; k < 18; k++) r->plane[i].at[k][n] = X[k / 3][k % 3];
        for (int k = 0; k < 6; k++) r->plane[i].at[18 + k][n] = form[k];
    }
    r->site[i] = (ves_samples){.site = site,
                               .patch = site == VES_SITE_CURVE ? -1 : 0,
                               .nu = grid->nu,
                               .nv = grid->nv,
                               .count = count,
                               .side = side,
                               .periodic = grid->periodic,
                               .u = grid->u,
                               .v = grid->v,
                               .u_range = {0, 1},
                               .v_range = {0, 6.283185307179586},
                               .weight = grid->weight};
}

static inline void rig_surface(rig *r, const body *b, int nu, int nv)
{
    ves_grid grid;
    cr_assert(ves_grid_quadrature(nu, nv, true, &r->arena, &grid) == VES_OK);
    rig_add(r, VES_SITE_SURFACE, b, &grid, 0);
}

/* The ring u = const of a body, as a cap (side: see ves_samples) or as a curve (side 0). */
static inline void rig_ring(rig *r, const body *b, double u, int nv, double side)
{
    ves_grid grid;
    cr_assert(ves_grid_ring(u, nv, true, &r->arena, &grid) == VES_OK);
    rig_add(r, side != 0 ? VES_SITE_CAP : VES_SITE_CURVE, b, &grid, side);
}

static inline void rig_place(rig *r, const body *b, double u, double v)
{
    ves_grid grid;
    cr_assert(ves_grid_given(1, &u, 1, &v, true, &r->arena, &grid) == VES_OK);
    rig_add(r, VES_SITE_PLACE, b, &grid, 0);
}

static inline ves_arg *rig_key(rig *r, const char *name)
{
    for (int k = 0; k < r->args.count; k++)
        if (!strcmp(r->args.key[k].name, name)) return &r->arg[k];
    cr_assert_fail("no key %s", name);
    return NULL;
}

/* Answers the keys as the reader would: fallbacks of number keys stand in the block. */
static inline void rig_measure_with(rig *r, const ves_measure *measure)
{
    int keys = 0;
    r->measure = measure;
    r->numbers = RIG_SLOTS;
    memset(r->arg, 0, sizeof r->arg);
    for (const ves_key *key = measure->keys; key && key->name; key++, keys++) {
        int count = key->kind == VES_NUMBER ? 1 : key->kind == VES_VECTOR ? 3 : 0;
        r->arg[keys] = (ves_arg){.first = r->numbers, .count = count, .value = (int)key->fallback};
        for (int k = 0; k < count; k++) r->number[r->numbers++] = key->fallback;
    }
    r->args = (ves_args){.key = measure->keys, .arg = r->arg, .count = keys};
}

static inline void rig_measure(rig *r, const char *name)
{
    const ves_measure *measure = ves_measure_find(name, NULL);
    cr_assert(measure != NULL, "no measure %s", name);
    rig_measure_with(r, measure);
}

static inline void rig_number(rig *r, const char *key, double value)
{
    ves_arg *arg = rig_key(r, key);
    arg->given = true;
    r->number[arg->first] = value;
}

static inline void rig_vector(rig *r, const char *key, double x, double y, double z)
{
    ves_arg *arg = rig_key(r, key);
    arg->given = true;
    r->number[arg->first] = x, r->number[arg->first + 1] = y, r->number[arg->first + 2] = z;
}

static inline void rig_choice(rig *r, const char *key, int value)
{
    ves_arg *arg = rig_key(r, key);
    arg->given = true;
    arg->value = value;
}

static inline void rig_formula(rig *r, const char *key, const char *text)
{
    static const ves_symbol slot[RIG_SLOTS] = {{"p", {0}}, {"q", {0}}};
    static const ves_symbol argument[9] = {{"x", {0}},  {"y", {0}},  {"z", {0}}, {"H", {0}}, {"K", {0}},
                                           {"k1", {0}}, {"k2", {0}}, {"u", {0}}, {"v", {0}}};
    const ves_scope scope = {slot, RIG_SLOTS, argument, 9, false};
    ves_formula_error error;
    cr_assert(ves_formula_compile(text, &scope, &r->arena, &r->formula, &error) == VES_OK, "%s: %s", text,
              error.text);
    ves_arg *arg = rig_key(r, key);
    arg->given = true, arg->count = 0;
    arg->formula = &r->formula;
}

/* Shows the measure only what this instance asks for. */
static inline ves_measure_input rig_input(rig *r)
{
    for (int i = 0; i < r->samples; i++) {
        ves_site site = r->site[i].site;
        unsigned wanted = r->measure->needs ? r->measure->needs(&r->args) : r->measure->surface;
        unsigned mask = site == VES_SITE_SURFACE ? wanted
                        : site == VES_SITE_CAP   ? r->measure->cap
                                                 : r->measure->curve;
        ves_adjoint unused;
        ves_samples ignored;
        r->masked[i] = r->site[i];
        rig_point(&r->plane[i], mask, &r->masked[i], &unused);
        rig_point(&r->back[i], mask, &ignored, &r->adjoint[i]);
        r->sample[i] = &r->masked[i];
        r->adjoints[i] = &r->adjoint[i];
    }
    return (ves_measure_input){.samples = r->samples,
                               .sample = r->sample,
                               .args = &r->args,
                               .number = r->number,
                               .room = r->room,
                               .state = r->state};
}

static inline ves_status rig_try(rig *r, double *value)
{
    ves_measure_input input = rig_input(r);
    if (r->measure->prepare && !r->state) cr_assert(r->measure->prepare(&input, &r->state) == VES_OK);
    input.state = r->state;
    size_t room = r->measure->room ? r->measure->room(&input) : 0;
    r->room = ves_arena_take(&r->arena, room + 1, sizeof(double));
    cr_assert(r->room != NULL);
    for (size_t k = 0; k <= room; k++) r->room[k] = NAN;
    input.room = r->room;
    ves_status status = r->measure->eval(&input, value);
    cr_assert(isnan(r->room[room]), "%s writes beyond its room", r->measure->name);
    return status;
}

static inline double rig_eval(rig *r)
{
    double value = NAN;
    ves_status status = rig_try(r, &value);
    cr_assert(status == VES_OK, "%s: %s", r->measure->name, ves_status_text(status));
    return value;
}

/* Adjoints of everything, from 0. After rig_eval. */
static inline void rig_gradient(rig *r, double seed)
{
    ves_measure_input input = rig_input(r);
    for (int i = 0; i < r->samples; i++)
        for (int k = 0; k < RIG_PLANES; k++)
            memset(r->back[i].at[k], 0, (size_t)r->site[i].count * sizeof(double));
    memset(r->number_back, 0, sizeof r->number_back);
    r->measure->gradient(&input, seed, r->adjoints, r->number_back);
}

/* |got - want| <= tolerance * max(1, |want|) */
static inline void near(double got, double want, double tolerance, const char *what)
{
    cr_assert(fabs(got - want) <= tolerance * fmax(1, fabs(want)), "%s: got %.16g, want %.16g (off by %.2e)",
              what, got, want, got - want);
}

#endif

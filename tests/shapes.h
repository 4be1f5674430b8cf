/* Figures of surfaces in closed form, for tests that need a finished shape and no engine. */
#ifndef TESTS_SHAPES_H
#define TESTS_SHAPES_H

#include <math.h>
#include <string.h>

#include "surface/figure.h"

#define PI 3.14159265358979323846

typedef struct shape_point {
    double X[3], normal[3], k1, k2; /* normal outward */
} shape_point;

typedef void shape_surface(const double *p, double u, double v, shape_point *out);

static inline void shape_begin(ves_figure *figure, int patches, const char *title, bool closed)
{
    *figure = (ves_figure){.title = title, .closed = closed, .patches = patches};
    figure->patch = ves_arena_take(&figure->arena, (size_t)patches, sizeof *figure->patch);
}

static inline void shape_end(ves_figure *figure)
{
    ves_arena_destroy(&figure->arena);
}

/* Samples patch k; ends free, no poles, no caps: the caller sets what it wants. */
static inline ves_figure_patch *shape_patch(ves_figure *figure, int k, const char *name, int nu, int nv,
                                            shape_surface *at, const double *param)
{
    ves_figure_patch *p = &figure->patch[k];
    ves_arena *arena = &figure->arena;
    *p = (ves_figure_patch){.name = name,
                            .nu = nu,
                            .nv = nv,
                            .rows = nu + 1,
                            .columns = nv,
                            .periodic = true,
                            .side = 1,
                            .edge = {-1, -1}};
    size_t n = (size_t)p->rows * p->columns;
    for (int c = 0; c < 3; c++)
        p->X[c] = ves_arena_doubles(arena, n), p->normal[c] = ves_arena_doubles(arena, n);
    p->H = ves_arena_doubles(arena, n), p->K = ves_arena_doubles(arena, n);
    p->k1 = ves_arena_doubles(arena, n), p->k2 = ves_arena_doubles(arena, n);
    for (int s = 0; s < (int)n; s++) {
        shape_point x;
        at(param, ves_figure_u(p, s), ves_figure_v(p, s), &x);
        for (int c = 0; c < 3; c++) p->X[c][s] = x.X[c], p->normal[c][s] = x.normal[c];
        p->k1[s] = fmax(x.k1, x.k2), p->k2[s] = fmin(x.k1, x.k2);
        p->H[s] = (x.k1 + x.k2) / 2, p->K[s] = x.k1 * x.k2;
    }
    return p;
}

/* p = {R, polar angle at u = 0, at u = 1, z of the centre}. Xu x Xv is outward when the angle grows. */
static inline void shape_ball(const double *p, double u, double v, shape_point *out)
{
    double t = p[1] + (p[2] - p[1]) * u;
    double n[3] = {sin(t) * cos(v), sin(t) * sin(v), cos(t)};
    for (int c = 0; c < 3; c++) out->normal[c] = n[c], out->X[c] = p[0] * n[c] + (c == 2 ? p[3] : 0);
    out->k1 = out->k2 = 1 / p[0];
}

/* p = {R, r}: u once round the axis z, v once round the tube. */
static inline void shape_torus(const double *p, double u, double v, shape_point *out)
{
    double a = 2 * PI * u, q = p[0] + p[1] * cos(v);
    double n[3] = {cos(v) * cos(a), cos(v) * sin(a), sin(v)};
    double x[3] = {q * cos(a), q * sin(a), p[1] * sin(v)};
    for (int c = 0; c < 3; c++) out->normal[c] = n[c], out->X[c] = x[c];
    out->k1 = 1 / p[1], out->k2 = cos(v) / q;
}

/* p = {r, bottom, top}: a cylinder along z; Xu x Xv points to the axis. */
static inline void shape_tube(const double *p, double u, double v, shape_point *out)
{
    double n[3] = {cos(v), sin(v), 0};
    for (int c = 0; c < 3; c++) out->normal[c] = n[c], out->X[c] = p[0] * n[c];
    out->X[2] = p[1] + (p[2] - p[1]) * u;
    out->k1 = 1 / p[0], out->k2 = 0;
}

/* p = {r}: a tube along the lemniscate (sin t, sin t cos t, 0), which crosses itself at the origin. */
static inline void shape_eight(const double *p, double u, double v, shape_point *out)
{
    double t = 2 * PI * u, tx = cos(t), ty = cos(2 * t), size = hypot(tx, ty);
    double n[3] = {cos(v) * ty / size, -cos(v) * tx / size, sin(v)};
    double centre[3] = {sin(t), sin(t) * cos(t), 0};
    for (int c = 0; c < 3; c++) out->normal[c] = n[c], out->X[c] = centre[c] + p[0] * n[c];
    out->k1 = 1 / p[0], out->k2 = 0;
}

/* A sphere of two patches that share the equator; the poles too lie on curves (seams 0 and 2). The lower
 * patch runs from its pole upward, so that its Xu x Xv points inward. */
static inline void shape_sphere(ves_figure *figure, double R, int nu, int nv)
{
    const double top[] = {R, 0, PI / 2, 0.3}, bottom[] = {R, PI, PI / 2, 0.3};
    shape_begin(figure, 2, "Sphere of two patches", true);
    ves_figure_patch *p = shape_patch(figure, 0, "top", nu, nv, shape_ball, top);
    p->edge[0] = 0, p->edge[1] = 1, p->pole[0] = true;
    p = shape_patch(figure, 1, "bottom", nu, nv, shape_ball, bottom);
    p->edge[0] = 2, p->edge[1] = 1, p->pole[0] = true, p->side = -1;
}

static inline void shape_ring(ves_figure *figure, shape_surface *at, const double *param, int nu, int nv)
{
    shape_begin(figure, 1, "Ring", true);
    ves_figure_patch *p = shape_patch(figure, 0, "ring", nu, nv, at, param);
    p->edge[0] = p->edge[1] = 0;
}

/* A tube; caps as asked. */
static inline void shape_pipe(ves_figure *figure, double r, double length, bool caps, int nu, int nv)
{
    const double param[] = {r, -0.2, length - 0.2};
    shape_begin(figure, 1, "Pipe", caps);
    ves_figure_patch *p = shape_patch(figure, 0, "pipe", nu, nv, shape_tube, param);
    p->side = -1, p->cap[0] = p->cap[1] = caps;
}

#endif

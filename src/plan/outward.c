/* Outward: which way the start design faces. */
#include "plan/inside.h"

#include <math.h>

enum { ALONG = 16, AROUND = 32 };

/* Below this share of its area times its size, what a part encloses is rounding: it has no outside (a flat
 * sheet, a saddle), and keeps Xu x Xv. */
static const double NOTHING = 1e-9;

/* Sums over the triangles of one part. Six times the volume between it and a point c is flux - c . vector. */
typedef struct facing {
    double flux, vector[3]; /* about the origin; twice the vector area */
    double area, moment[3]; /* twice the area, and twice the first moment */
} facing;

static void triangle_add(facing *f, const double *a, const double *b, const double *c, double skin)
{
    double n[3], square = 0;
    for (int k = 0; k < 3; k++) {
        int p = (k + 1) % 3, q = (k + 2) % 3;
        n[k] = (b[p] - a[p]) * (c[q] - a[q]) - (b[q] - a[q]) * (c[p] - a[p]);
        square += n[k] * n[k];
    }
    double area = skin * sqrt(square);
    f->area += area;
    for (int k = 0; k < 3; k++) {
        f->flux += a[k] * n[k];
        f->vector[k] += n[k];
        f->moment[k] += area * (a[k] + b[k] + c[k]) / 3;
    }
}

/* Triangles of a patch or of a cap (corner -1: the middle), about `origin`. */
static void triangles_add(facing *f, const ves_figure_patch *p, const int *corner, int count,
                          const double middle[3], const double origin[3], double skin)
{
    for (int t = 0; t < count; t++) {
        double x[3][3];
        for (int k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++) {
                int node = corner[3 * t + k];
                x[k][c] = (node < 0 ? middle[c] : p->X[c][node]) - origin[c];
            }
        triangle_add(f, x[0], x[1], x[2], skin);
    }
}

/* The patch itself weighs in where its part stands; caps only close it. */
static void patch_add(facing *f, const ves_figure_patch *p, int *corner, const double origin[3])
{
    double middle[3] = {0};
    triangles_add(f, p, corner, ves_figure_triangles(p, corner), middle, origin, 1);
    for (int end = 0; end < 2; end++) {
        if (!p->cap[end] || p->pole[end]) continue;
        ves_figure_middle(p, end, middle);
        triangles_add(f, p, corner, ves_figure_cap(p, end, corner), middle, origin, 0);
    }
}

/* Six times the volume between the part and its own centre of gravity: for a closed part six times its
 * volume, for an open one the side that its hollow is not on. Moves and turns with the part, changes its sign
 * with a mirror. */
static double facing_volume(const facing *f)
{
    double volume = f->flux, size = sqrt(f->area);
    for (int c = 0; c < 3 && f->area > 0; c++) volume -= f->moment[c] / f->area * f->vector[c];
    return fabs(volume) > NOTHING * f->area * size ? volume : 0;
}

ves_status ves_plan_face_outward(ves_plan *plan)
{
    ves_figure *figure;
    int patches = plan->problem->patches;
    VES_TRY(ves_plan_figure_make(plan, ALONG, AROUND, &figure));
    facing *part = ves_arena_take(&figure->arena, (size_t)patches, sizeof *part);
    int *corner = ves_arena_take(&figure->arena, 6 * ALONG * AROUND, sizeof *corner);
    if (!part || !corner) {
        ves_figure_destroy(figure);
        return VES_MEMORY;
    }
    /* About the shape's own middle: far from the origin the sums would cancel. */
    double origin[3];
    ves_figure_middle(&figure->patch[0], 0, origin);
    for (int k = 0; k < patches; k++) patch_add(&part[plan->part[k]], &figure->patch[k], corner, origin);
    for (int k = 0; k < patches; k++)
        if (facing_volume(&part[plan->part[k]]) < 0) plan->side[k] = -plan->side[k];
    ves_figure_destroy(figure);
    return VES_OK;
}

/* Outward: which way a design faces. */
#include "base/vector.h"
#include "plan/inside.h"

#include <math.h>

enum { ALONG = 16, AROUND = 32, LOOKS = 100 };

/* Below this share of its area times its size, what a part encloses is rounding: it has no outside (a flat
 * sheet, a saddle), and keeps Xu x Xv of its first patch. */
static const double NOTHING = 1e-9;

/* Sums over the triangles of one part. Six times the volume between it and a point c is flux - c . vector. */
typedef struct facing {
    double flux, vector[3]; /* about the origin; twice the vector area */
    double area, moment[3]; /* twice the area, and twice the first moment */
} facing;

/* The patch itself weighs in where its part stands; caps only close it. */
static void facing_add(double (*const x)[3], bool cap, void *sum)
{
    facing *f = sum;
    double n[3];
    ves_twice_area(x[0], x[1], x[2], n);
    double area = cap ? 0 : sqrt(ves_dot(n, n));
    f->area += area, f->flux += ves_dot(x[0], n);
    for (int k = 0; k < 3; k++) {
        f->vector[k] += n[k];
        f->moment[k] += area * (x[0][k] + x[1][k] + x[2][k]) / 3;
    }
}

/* The solid angle of a triangle seen from the origin (van Oosterom and Strackee 1983). */
static void angle_add(double (*const x)[3], bool cap, void *sum)
{
    (void)cap;
    double n[3], r[3];
    ves_twice_area(x[0], x[1], x[2], n);
    for (int k = 0; k < 3; k++) r[k] = sqrt(ves_dot(x[k], x[k]));
    double around = r[0] * r[1] * r[2] + ves_dot(x[0], x[1]) * r[2] + ves_dot(x[1], x[2]) * r[0] +
                    ves_dot(x[2], x[0]) * r[1];
    *(double *)sum += 2 * atan2(ves_dot(x[0], n), around);
}

typedef void triangle_take(double (*const x)[3], bool cap, void *sum);

/* Every triangle of a patch and its caps, seen from `origin`. corner: scratch. */
static void triangles_visit(const ves_figure_patch *p, const double origin[3], int *corner,
                            triangle_take *take, void *sum)
{
    for (int piece = -1; piece < 2; piece++) { /* the patch, then the caps of its ends */
        double middle[3] = {0}, x[3][3];
        bool cap = piece >= 0;
        if (cap && (!p->cap[piece] || p->pole[piece])) continue;
        if (cap) ves_figure_middle(p, piece, middle);
        int count = cap ? ves_figure_cap(p, piece, corner) : ves_figure_triangles(p, corner);
        for (int t = 0; t < count; t++) {
            for (int k = 0; k < 3; k++)
                for (int c = 0; c < 3; c++) {
                    int node = corner[3 * t + k];
                    x[k][c] = (node < 0 ? middle[c] : p->X[c][node]) - origin[c];
                }
            take(x, cap, sum);
        }
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

/* Does a node of a patch lie inside a closed part? */
static bool is_inside(const ves_plan *plan, const ves_figure *figure, const ves_figure_patch *own, int node,
                      int part, int *corner)
{
    const double at[3] = {own->X[0][node], own->X[1][node], own->X[2][node]};
    double angle = 0;
    for (int k = 0; k < figure->patches; k++)
        if (plan->part[k] == part) triangles_visit(&figure->patch[k], at, corner, angle_add, &angle);
    return fabs(angle) > VES_TWO_PI; /* half of all directions */
}

/* Does a part lie in another as a whole? Nodes all over it tell, an odd number apart so that rows are met at
 * many places; and the middle one first, which mostly will do. */
static bool lies_in(const ves_plan *plan, const ves_figure *figure, int part, int other, int *corner)
{
    const ves_figure_patch *first = &figure->patch[part];
    if (!is_inside(plan, figure, first, first->nu / 2 * first->columns, other, corner)) return false;
    for (int k = 0; k < figure->patches; k++) {
        const ves_figure_patch *own = &figure->patch[k];
        int count = own->rows * own->columns, step = (count / LOOKS) | 1;
        for (int node = 0; node < count && plan->part[k] == part; node += step)
            if (!is_inside(plan, figure, own, node, other, corner)) return false;
    }
    return true;
}

/* A closed part inside another bounds a hollow: its outside is within. Parts that overlap are both solid. */
static bool is_hollow(const ves_plan *plan, const ves_figure *figure, int part, int *corner)
{
    int within = 0;
    for (int other = 0; other < figure->patches; other++)
        if (plan->part[other] == other && other != part) within += lies_in(plan, figure, part, other, corner);
    return within % 2;
}

/* What a closed part must hold, seen from its own outside: less than nothing, when it is a hollow. */
static int sense_of(const ves_plan *plan, const ves_figure *figure, int part, double volume, int *corner)
{
    if (!(fabs(volume) > 0)) return 0;
    return plan->problem->shape.closed && is_hollow(plan, figure, part, corner) ? -1 : 1;
}

ves_status ves_plan_face(ves_plan *plan)
{
    ves_figure *figure;
    int patches = plan->problem->patches;
    VES_TRY(ves_plan_figure_make(plan, ALONG, AROUND, &figure));
    facing *part = ves_arena_take(&figure->arena, (size_t)patches, sizeof *part);
    double *turn = ves_arena_take(&figure->arena, (size_t)patches, sizeof *turn);
    int *corner = ves_arena_take(&figure->arena, 6 * ALONG * AROUND, sizeof *corner);
    bool good = part && turn && corner;
    /* About the shape's own middle: far from the origin the sums would cancel. */
    double origin[3];
    ves_figure_middle(&figure->patch[0], 0, origin);
    for (int k = 0; k < patches && good; k++)
        triangles_visit(&figure->patch[k], origin, corner, facing_add, &part[plan->part[k]]);
    for (int k = 0; k < patches && good; k++) {
        int first = plan->part[k];
        if (first == k) {
            double volume = facing_volume(&part[k]);
            plan->sense[k] = sense_of(plan, figure, k, volume, corner);
            turn[k] = plan->sense[k] ? copysign(1, volume * plan->sense[k]) : plan->side[k];
        }
        plan->sense[k] = plan->sense[first];
        plan->side[k] *= turn[first];
    }
    ves_figure_destroy(figure);
    for (int k = 0; k < LEVELS && good; k++) ves_plan_level_face(plan, k);
    return good ? VES_OK : VES_MEMORY;
}

bool ves_plan_nested(const ves_plan *plan, const ves_figure *figure, int *corner)
{
    for (int k = 0; k < figure->patches && figure->closed; k++)
        if (plan->part[k] == k && plan->sense[k] &&
            is_hollow(plan, figure, k, corner) != (plan->sense[k] < 0))
            return false;
    return true;
}

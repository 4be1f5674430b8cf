/* Lids: how a cap is drawn when the fan to its middle would overlap itself. A rim that lies in a plane bounds
 * the same piece of it, and the same volume under it, however the piece is cut into triangles. */
#include "base/vector.h"
#include "bridge/bridge.h"
#include "plan/inside.h"

#include <math.h>

/* Of the rim's size: what counts as lying in a plane. The fan that is measured and the lid that is drawn then
 * hold less than a millionth of the rim's cube between them. */
static const double FLAT = 1e-6;

/* Arms from the middle to the nodes, closed; returns the length of the longest. */
static double arms_make(const ves_figure_patch *f, int end, double (*arm)[3])
{
    double middle[3], longest = 0;
    int row = end ? f->nu * f->columns : 0;
    ves_figure_middle(f, end, middle);
    for (int j = 0; j <= f->nv; j++) {
        for (int c = 0; c < 3; c++) arm[j][c] = f->X[c][row + j % f->nv] - middle[c];
        longest = fmax(longest, sqrt(ves_dot(arm[j], arm[j])));
    }
    return longest;
}

/* Seen along the rim's vector area, some triangle of the fan runs the wrong way. */
static bool fan_overlaps(int count, double (*arm)[3], double normal[3])
{
    double spoke[3];
    for (int c = 0; c < 3; c++) normal[c] = 0;
    for (int j = 0; j < count; j++) {
        ves_cross(arm[j], arm[j + 1], spoke);
        for (int c = 0; c < 3; c++) normal[c] += spoke[c];
    }
    for (int j = 0; j < count; j++) {
        ves_cross(arm[j], arm[j + 1], spoke);
        if (!(ves_dot(spoke, normal) > 0)) return true;
    }
    return false;
}

/* The rim in its plane, counter-clockwise about the normal; false: it leaves the plane. */
static bool flatten(int count, double (*arm)[3], const double normal[3], double size, double *xy)
{
    double n[3], length = sqrt(ves_dot(normal, normal)), e[2][3], first = sqrt(ves_dot(arm[0], arm[0]));
    for (int c = 0; c < 3; c++) n[c] = normal[c] / length, e[0][c] = arm[0][c] / first;
    ves_cross(n, e[0], e[1]);
    for (int j = 0; j < count; j++) {
        if (!(fabs(ves_dot(arm[j], n)) <= FLAT * size)) return false;
        for (int k = 0; k < 2; k++) xy[2 * j + k] = ves_dot(arm[j], e[k]);
    }
    return true;
}

ves_status ves_lid_make(ves_figure_patch *f, int end, ves_arena *arena)
{
    double(*arm)[3] = ves_arena_take(arena, (size_t)f->nv + 1, sizeof *arm), normal[3];
    double *xy = ves_arena_take(arena, 2 * (size_t)f->nv, sizeof *xy);
    int *corner = ves_arena_take(arena, 3 * (size_t)f->nv, sizeof *corner);
    char message[VES_BRIDGE_TEXT];
    if (!arm || !xy || !corner) return VES_MEMORY;
    double size = arms_make(f, end, arm);
    if (!fan_overlaps(f->nv, arm, normal) || !flatten(f->nv, arm, normal, size, xy)) return VES_OK;
    ves_status status = ves_bridge_polygon(f->nv, xy, corner, message);
    if (status == VES_OK) f->lid[end] = corner;
    return status == VES_FAULT ? VES_OK
                               : status; /* a rim that crosses itself keeps its fan, and is found out */
}

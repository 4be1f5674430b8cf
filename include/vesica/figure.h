/* Figure: a finished shape, sampled edge to edge, for files and pictures. Made by ves_plan_figure. */
#ifndef VESICA_FIGURE_H
#define VESICA_FIGURE_H

#include "vesica/diag.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ves_figure ves_figure;

void ves_figure_destroy(ves_figure *figure);

/* Writes one file; the format is the ending of path: vtp, stl, obj, ply, off, csv. A file of that name is
 * replaced whole or not at all. VES_USAGE: no such format; VES_IO. */
ves_status ves_figure_write(ves_figure *figure, const char *path, ves_diag *diag);

/* A shaded picture of the figure, depth-sorted, with the end curves drawn; by the ending of path (png, svg,
 * pdf). */
typedef struct ves_view {
    int width, height;            /* pixels; 0: 960 x 720 */
    double azimuth, height_angle; /* radians: where the viewer stands; up is `up` (0 x, 1 y, 2 z) */
    int up;                       /* -1: the axis that the end curves are strung along */
    const char *colour;           /* "patch", "H" (the default), "K", "k1", "k2" */
    bool orthographic;            /* parallel projection instead of a mild perspective */
} ves_view;
ves_view ves_view_default(void);
ves_status ves_picture_write(ves_figure *figure, const ves_view *view, const char *path, ves_diag *diag);

#ifdef __cplusplus
}
#endif
#endif

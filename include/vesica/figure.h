/* Figure: the shape of one design, sampled from edge to edge, for files, pictures and meshes. Made by
 * ves_plan_figure.
 *
 * A figure is self-contained: it outlives its plan and its problem. It belongs to one thread at a time.
 * Lengths are in metres (in a file without units: in its own), curvatures in 1/m and 1/m^2, angles in
 * radians. Every function writes what went wrong into diag, which may be NULL. */
#ifndef VESICA_FIGURE_H
#define VESICA_FIGURE_H

#include "vesica/diag.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ves_figure ves_figure;

void ves_figure_destroy(ves_figure *figure); /* and its meshes; NULL: nothing */

/* Triangles, their corners counter-clockwise seen from outside (of an open shape: from the side that the
 * normals of the first patch point to), and what is known at each vertex. H = (k1 + k2) / 2 is +1/R on a
 * sphere seen from outside, K = k1 k2, k1 >= k2. */
typedef struct ves_mesh {
    int vertices, triangles;
    const double *point;   /* [vertices][3] */
    const int *corner;     /* [triangles][3] */
    const int *patch;      /* [vertices] as in ves_problem_patch; -1: of a cap */
    const double *u, *v;   /* [vertices] where on the patch: 0 .. 1, 0 .. 2 pi; of a cap: of its end */
    const double *normal;  /* [vertices][3] unit, outward; 0 where the surface has none */
    const double *H, *K;   /* [vertices] */
    const double *k1, *k2; /* [vertices] */
} ves_mesh;

/* The figure as one mesh, whose arrays belong to the figure.
 *
 * Not welded: every patch, and every cap, has vertices of its own. Along a curve that they
 * share these coincide to the bit, but normals and curvatures may jump there.
 * Welded: one vertex for each place, closed where the shape is; normal, H, K, k1 and k2 are NULL, and patch,
 * u, v are those of the first patch there.
 *
 * Made once. VES_MEMORY, and VES_FAULT of a figure that is none: *mesh is then zero. */
ves_status ves_figure_mesh(ves_figure *figure, bool welded, ves_mesh *mesh);

/* Writes one file; the format is the ending of path: vtp, stl, obj, ply, off, csv, inp. A file of that name is
 * replaced whole or not at all. VES_USAGE: no such format, or inp of a figure without
 * a shell or on a grid that cannot carry one; VES_IO. */
ves_status ves_figure_write(ves_figure *figure, const char *path, ves_diag *diag);

/* A shaded picture of the figure, depth-sorted, with the end curves drawn; by the ending of path (png, svg,
 * pdf). Begin with ves_view_default(). */
typedef struct ves_view {
    int width, height;            /* pixels, 64 to 16384; 0: 960 x 720 */
    double azimuth, height_angle; /* radians: where the viewer stands; up is `up` (0 x, 1 y, 2 z) */
    int up;                       /* -1: the axis that the end curves are strung along */
    const char *
        colour; /* "patch", "H" (the default), "K", "k1", "k2"; of a shell "thickness", "max_shear:CASE" ... */
    bool orthographic; /* parallel projection instead of a mild perspective */
    bool cut;          /* of a closed shape the half towards the viewer is cut away: what is inside is seen */
    bool spines;       /* the centre line of each PDE patch, the mean over v, drawn over the shape */
} ves_view;
ves_view ves_view_default(void);

/* view NULL: the default. VES_USAGE: no such format; VES_NAME, VES_RANGE: not such a view; VES_IO. */
ves_status ves_picture_write(ves_figure *figure, const ves_view *view, const char *path, ves_diag *diag);

#ifdef __cplusplus
}
#endif
#endif

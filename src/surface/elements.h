/* Finite elements over the grid of a figure: quadratic ones, each over two by two cells, whose corners are
 * nodes (i, j) with even i and j, whose sides have nodes in the middle and whose middle has none; beside a
 * pole triangles. For decks of other programs, and for loads as forces at their nodes. */
#ifndef VES_SURFACE_ELEMENTS_H
#define VES_SURFACE_ELEMENTS_H

#include "surface/figure.h"

enum { VES_ELEMENT_NODES = 8, VES_TRIANGLE_NODES = 6 };

/* The nodes of the element whose first corner is (i, j): corners, counter-clockwise seen from outside, then
 * the middles of the sides that follow them. Returns how many: 8, beside a pole 6. */
int ves_element_nodes(const ves_figure_patch *patch, int i, int j, int node[VES_ELEMENT_NODES]);

/* Values at r, s of the functions that are 1 at one and 0 at the others, and their
 * derivatives; r, s in -1 .. 1, of a triangle in the one of the corners (0, 0), (1, 0), (0, 1). */
void ves_element_shape(int nodes, double r, double s, double N[], double by_r[], double by_s[]);

/* Adds to the planes `force` (N) what is equivalent to a force per area q and a pressure along the outward
 * normal (Pa, planes of nodes; NULL: none): integrals of them times N. */
void ves_element_area(const ves_figure_patch *patch, int count, const int *node, double *const q[3],
                      const double *pressure, double *const force[3]);

/* The same of a force per length along three nodes in a row; q NULL: 1 along each axis, whose forces are
 * the lengths that each node stands for. */
void ves_element_line(const ves_figure_patch *patch, const int node[3], double *const q[3],
                      double *const force[3]);

/* The nodes in a row along an edge (0, 1: the ends; 2, 3: the sides v_min, v_max of a sheet): how many, the
 * first again at the end of a ring; node may be NULL. */
int ves_figure_edge(const ves_figure_patch *patch, int edge, int *node);

/* The whole shell of a figure, welded by index as ves_figure_mesh does. Where a support is a plane of
 * symmetry there is the mirror image too, and nothing is held: programs that make bricks of shells
 * (CalculiX) are far too stiff where one or two of a node's three rotations are held. */
typedef struct ves_elements {
    const char *refused; /* why there are none; NULL: there are */
    int nodes, elements; /* of all images */
    int images;          /* 1, 2, 4 or 8 */
    int grid;            /* nodes of all patches, not welded: those of patch k begin at first[k] */
    const int *first;
    const int *number;                 /* [images][grid] its node; -1: of no element */
    double (*point)[3];                /* [nodes] */
    double sign[VES_ELEMENT_NODES][3]; /* [images] what becomes of a vector */
    bool turned[VES_ELEMENT_NODES];    /* [images] elements run the other way round */
} ves_elements;

/* What it returns lies in the arena. The figure has a shell that is not refused. */
ves_status ves_elements_make(const ves_figure *figure, ves_arena *arena, ves_elements *elements);

/* The nodes of one element of an image. */
int ves_elements_nodes(const ves_elements *elements, const ves_figure *figure,
                       const int at[4], /* image, patch, i, j */
                       int node[VES_ELEMENT_NODES]);

#endif

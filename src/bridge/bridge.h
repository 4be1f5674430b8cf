/* The bridge to CGAL: triangle meshes as plain arrays, behind extern "C". The only C++ of the project; no
 * exception leaves it. Messages go into the buffer of the caller. Every function is thread-safe. */
#ifndef VES_BRIDGE_BRIDGE_H
#define VES_BRIDGE_BRIDGE_H

#include <stdbool.h>
#include <stddef.h>

#include "vesica/figure.h"

#ifdef __cplusplus
extern "C" {
#endif

enum { VES_BRIDGE_TEXT = 256 };

/* What CGAL says of a mesh, as an independent check of our quadrature and topology. */
typedef struct ves_mesh_facts {
    bool closed;    /* no border edge */
    bool outward;   /* closed and oriented outward */
    int components; /* connected parts */
    int border_edges;
    int crossings;       /* pairs of triangles that intersect; counted only when asked, else -1 */
    double area, volume; /* volume: 0 when not closed */
} ves_mesh_facts;

/* Judges a mesh: what tests hold quadrature and welding against. pairs: look for self-intersections too (dearer). VES_FAULT with a message when the arrays
 * are no manifold. VES_OK leaves the message empty, or a remark in it: triangles without an area. */
ves_status ves_bridge_facts(const ves_mesh *mesh, bool pairs, ves_mesh_facts *facts,
                            char message[VES_BRIDGE_TEXT]);

/* Only whether the surface crosses itself. */
ves_status ves_bridge_crosses(const ves_mesh *mesh, bool *crosses, char message[VES_BRIDGE_TEXT]);

/* Writes STL (binary), OBJ, PLY (binary) or OFF by the ending of path. VES_IO with a message on failure. */
ves_status ves_bridge_write(const ves_mesh *mesh, const char *path, char message[VES_BRIDGE_TEXT]);

/* Cuts a polygon in the plane, given by its corners xy[count][2], counter-clockwise, into count - 2 triangles
 * that do not overlap: corner[count - 2][3], counter-clockwise. VES_FAULT with a message when it crosses
 * itself. */
ves_status ves_bridge_polygon(int count, const double *xy, int *corner, char message[VES_BRIDGE_TEXT]);

/* "5.5.1" */
const char *ves_bridge_version(void);

#ifdef __cplusplus
}
#endif
#endif

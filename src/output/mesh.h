/* Meshes through CGAL: what the formats stl, obj, ply and off have in common. */
#ifndef VES_OUTPUT_MESH_H
#define VES_OUTPUT_MESH_H

#include "output/output.h"

/* Welds the figure and writes it as `ending` says ("stl"). */
ves_status ves_mesh_write(ves_figure *figure, const char *path, const char *ending, ves_diag *diag);

#endif

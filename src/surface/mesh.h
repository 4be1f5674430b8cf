/* A triangle mesh as plain arrays. */
#ifndef VES_SURFACE_MESH_H
#define VES_SURFACE_MESH_H

#ifdef __cplusplus
extern "C" {
#endif

/* Corners run counter-clockwise seen from outside. Owned by whoever made it. */
typedef struct ves_mesh {
    int vertices, triangles;
    double *point; /* [vertices][3], m */
    int *corner;   /* [triangles][3] */
} ves_mesh;

#ifdef __cplusplus
}
#endif
#endif

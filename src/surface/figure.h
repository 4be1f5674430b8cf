/* Figure: a finished shape, sampled on regular grids from edge to edge, for files, pictures and meshes. Made
 * once per export or proof, never in the loop. */
#ifndef VES_SURFACE_FIGURE_H
#define VES_SURFACE_FIGURE_H

#include <stdbool.h>

#include "base/arena.h"
#include "vesica/figure.h"

/* One patch on (nu + 1) x nv nodes when periodic in v, else (nu + 1) x (nv + 1): node (i, j) at i * columns +
 * j, u = i / nu, v = v_min + j * (v_max - v_min) / nv (the last row: + slide). */
typedef struct ves_figure_patch {
    const char *name;
    int nu, nv, rows, columns;
    bool periodic;
    double v_min, v_max; /* both 0: 0 .. 2 pi */
    double slide; /* by how much the last row is moved along v, so that its nodes meet those of the first */
    double *X[3]; /* m */
    double
        *normal[3]; /* unit, outward; zero where the surface has none (poles are filled with their limit) */
    double *H, *K, *k1, *k2; /* 1/m, 1/m^2; k1 >= k2; H = +1/R on a sphere */
    double *spine[3];        /* [rows] m: the mean over v of each row, of a PDE patch; NULL: of no other */
    double side;             /* +1: Xu x Xv points outward, -1: inward */
    int edge[2];  /* which seam the ends u = 0 and u = 1 lie on; ends with the same number share a curve; -1:
                     free */
    bool pole[2]; /* the end is a single point */
    bool ends_meet, sides_meet; /* the sheet meets itself: u = 0 and u = 1, v = 0 and v = 2 pi are one line */
    bool one_sided;             /* it does so the other way round: its mesh is left open there */
    const int *same;            /* [nodes] the first node that lies where this one lies; NULL: each its own */
    bool cap[2];                /* the end is to be closed */
    const int *lid[2]; /* [nv - 2][3] triangles of a cap over the nodes 0 .. nv - 1 of the end, running as v
                          does; NULL: a fan to the end's middle */
} ves_figure_patch;

/* A support of a shell, at nodes of the figure (of patches: those of its parts, not welded). */
typedef struct ves_figure_support {
    const char *text; /* as written: "base" */
    int nodes;
    const int (*node)[2]; /* patch, node */
    unsigned fix;         /* bits 0 .. 5: displacements along x, y, z, rotations about them */
    bool mirror, across;  /* a plane of symmetry with this normal; held across this axis */
    double axis[3];       /* unit */
    double (*spring)[3];  /* [nodes] N/m; NULL: none */
} ves_figure_support;

typedef struct ves_figure_case {
    const char *name;
    double *(*force)[3]; /* [patches] planes of forces at nodes, N; NULL of patches that are no parts */
} ves_figure_case;

/* A quantity of a shell at the nodes of its parts. */
typedef struct ves_figure_field {
    const char *name, *of; /* "max_shear"; the load case, NULL: it is of none */
    const char *about;     /* "largest shear" */
    const char *unit;      /* "Pa", "m" */
    int power;             /* of lengths: by which it is scaled; 0: with its owner */
    double **value;        /* [patches] planes; NULL: no part of the shell */
    double *(*vector)[3];  /* [patches] of a vector, whose length `value` is; NULL: it is none */
} ves_figure_field;

/* A shaped shell as what finite elements (surface/elements.h) over the grids of its figure need. */
typedef struct ves_figure_shell {
    const char *refused;      /* why these grids cannot carry it; NULL: they can */
    double E, nu;             /* Pa, 1 */
    double density;           /* kg/m^3; NAN: not given */
    double *const *thickness; /* [patches] planes, m; NULL: no part of the shell */
    const bool *uniform;      /* [patches] it is the same everywhere */
    int supports, cases;
    const ves_figure_support *support;
    const ves_figure_case *load_case;
    int factors; /* buckling factors that are asked for in each case */
    int fields;
    const ves_figure_field *field;
} ves_figure_shell;

/* The fields called "name" or "name:case": how many, and the first. */
int ves_figure_fields(const ves_figure *figure, const char *word, const ves_figure_field **field);

/* mesh.c: ves_figure_mesh welds by index (ends on the same seam, which must have the same nv), never by
 * distance. */
struct ves_figure {
    ves_arena arena;
    const char *title;
    const char *unit; /* "m", or NULL when the problem has no units: what pictures write beside lengths */
    bool closed;      /* with caps, the patches enclose a volume */
    int patches;
    ves_figure_patch *patch;
    ves_mesh mesh[2];        /* as made: [welded]; without vertices: not yet */
    ves_figure_shell *shell; /* NULL: none */
};

/* Other units: lengths times factor, curvatures accordingly; of a shell all but forces, so that with metres
 * made millimetres E is in N/mm^2 and densities in t/mm^3. Before any mesh is made of it. */
void ves_figure_scale(ves_figure *figure, double factor, const char *unit);

/* The corners of the box around all nodes; false: it has none that is finite. */
bool ves_figure_box(const ves_figure *figure, double low[3], double high[3]);

/* Triangles of one patch alone, corners as nodes of the patch: columns close, all of a pole is its first
 * node. Outward; quads are cut along the shorter diagonal. corner has room for 2 nu nv triangles; returns how
 * many were made. */
int ves_figure_triangles(const ves_figure_patch *patch, int *corner);

/* The middle of an end, the mean of its nodes, and the triangles of its cap, outward, corners as nodes of the
 * patch
 * (-1: the middle). The mean over v is the apex of the cap whose volume measures count; where the end is flat
 * the volume is that of any triangles over it, and those of `lid` do not overlap when the fan's would. corner
 * has room for nv triangles; returns how many were made. */
void ves_figure_middle(const ves_figure_patch *patch, int end, double middle[3]);
int ves_figure_cap(const ves_figure_patch *patch, int end, int *corner);

/* The node whose position welding gives to a node: on a seam, that of the first that lies on it (*owner: its
 * patch). The two differ by rounding. */
int ves_figure_owner(const ves_figure *figure, int patch, int node, int *owner);

/* u and v of a node. */
double ves_figure_u(const ves_figure_patch *patch, int node);
double ves_figure_v(const ves_figure_patch *patch, int node);

#endif

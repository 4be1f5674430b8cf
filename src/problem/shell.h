/* Shell: what the section `shell` of a problem file says, read and resolved. Part of ves_problem; meshes are
 * the plan's. */
#ifndef VES_PROBLEM_SHELL_H
#define VES_PROBLEM_SHELL_H

#include <stdbool.h>

#include "formula/formula.h"
#include "vesica/diag.h"

/* What formulas of the section read at a point of the mid-surface, their arguments in this order. u and v
 * mean what they mean in formulas over the surface (ves_samples.u_range): of a patch with a `domain`, they
 * are in that. Along a curve or an edge they are those of the part that ends there. */
enum { VES_SHELL_X, VES_SHELL_Y, VES_SHELL_Z, VES_SHELL_U, VES_SHELL_V, VES_SHELL_ARGUMENTS };

/* Orders of elements: 1 is MITC4+, 2 is MITC9, VES_SHELL_FULL and more are integrated fully, which from there
 * on does not lock; those in between would. */
enum { VES_SHELL_FULL = 6, VES_SHELL_MOST = 10, VES_SHELL_ELEMENTS = 4096 };

enum { VES_EDGE_U0, VES_EDGE_U1, VES_EDGE_V0, VES_EDGE_V1, VES_EDGES };

typedef struct ves_shell_edge {
    int part, edge; /* VES_EDGE_... */
} ves_shell_edge;

typedef enum ves_shell_place_kind { VES_AT_CURVE, VES_AT_EDGE, VES_AT_PLACE } ves_shell_place_kind;

/* Where something holds or pulls. */
typedef struct ves_shell_at {
    ves_shell_place_kind kind;
    ves_mark mark;
    const char *text; /* as written */
    int index;        /* curve, patch or place */
    int edge;         /* AT_EDGE */
    /* AT_CURVE: the ends of parts that lie on the curve, one at least; AT_EDGE: that edge; AT_PLACE: none */
    int edges;
    const ves_shell_edge *on;
    int part; /* AT_PLACE: the part that it lies on; else that of on[0] */
} ves_shell_at;

/* Do they have an edge in common, or are they one place? */
bool ves_shell_at_meets(const ves_shell_at *a, const ves_shell_at *b);

typedef struct ves_shell_part_def {
    int patch;
    ves_mark mark;
    const ves_formula *thickness; /* m; arguments VES_SHELL_... */
    int uniform;      /* number block index of the thickness when it is the same everywhere; -1: it is not */
    const char *text; /* the thickness as written */
    bool varies;      /* the thickness depends on a variable: gradients want d/d slot of the formula */
    int elements[2];  /* of level 0, along u and v; 0: chosen */
} ves_shell_part_def;

typedef enum ves_support_kind {
    VES_SUPPORT_FIX,
    VES_SUPPORT_SYMMETRY,
    VES_SUPPORT_DIAPHRAGM,
    VES_SUPPORT_SPRING
} ves_support_kind;

typedef struct ves_support_def {
    ves_support_kind kind;
    ves_mark mark;
    ves_shell_at at;
    unsigned fix;   /* FIX: bits 0 .. 5: displacements along x, y, z, rotations about x, y, z */
    double axis[3]; /* SYMMETRY: the plane's normal; DIAPHRAGM: its axis; unit vectors, constant */
    int spring;     /* SPRING: number block index of the first of three stiffnesses, each >= 0: N/m^2 along a
                       curve or an edge, N/m at a place; else -1 */
} ves_support_def;

typedef enum ves_load_kind {
    VES_LOAD_LINE,     /* N/m, a vector of formulas along a curve or an edge */
    VES_LOAD_FORCE,    /* N, a vector without arguments: at a place, or spread along a curve or an edge */
    VES_LOAD_PRESSURE, /* Pa, one formula, along the outward normal */
    VES_LOAD_AREA,     /* Pa, a vector of formulas, per area of the mid-surface */
    VES_LOAD_GRAVITY   /* m/s^2, a vector without arguments, times density and thickness */
} ves_load_kind;

typedef struct ves_load_def {
    ves_load_kind kind;
    ves_mark mark;
    ves_shell_at at;               /* LINE, FORCE */
    int parts;                     /* PRESSURE, AREA, GRAVITY: how many parts of the shell */
    const int *part;               /* which */
    const ves_formula *formula[3]; /* PRESSURE: the first alone, the others NULL */
    bool varies;                   /* one of them depends on a variable */
} ves_load_def;

typedef struct ves_case_def {
    const char *name;
    ves_mark mark;
    int loads;
    const ves_load_def *load;
} ves_case_def;

typedef struct ves_shell_mesh_def {
    bool given;
    int order;       /* 1, 2, VES_SHELL_FULL .. VES_SHELL_MOST; 0: chosen */
    int elements[2]; /* along u and v of every part that has none of its own; 0: chosen */
    double grading;  /* exponent of the element sizes towards the edges, 1: even; 0: chosen */
} ves_shell_mesh_def;

typedef struct ves_shell_def {
    ves_mark mark;
    int parts;
    const ves_shell_part_def *part;
    const char *material; /* the word of the table that numbers come from, or NULL */
    const char *made_of;  /* for people: "hips", "E 2 GPa, nu 0.35" */
    int E, nu, shear;     /* number block indices */
    int density, yield;   /* the same, or -1: not given */
    int supports;         /* one at least */
    const ves_support_def *support;
    int cases;
    const ves_case_def *load_case;
    ves_shell_mesh_def mesh, verify; /* of level 0 and of level 1 */
    bool symmetric;                  /* sectors and mirror planes of the design are found and used */
    int ats; /* places that measures name: the value of their keys of kind VES_SHELL_AT is an index here */
    const ves_shell_at *at;
} ves_shell_def;

#endif

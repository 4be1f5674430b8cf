/* Thin shells: Reissner-Mindlin elements of the degenerated kind on tensor-product quadrilaterals of any order, over
 * grids of nodes whose positions, normals and thicknesses are given (shell/kind.h has the theory). SI units.
 *
 * A *sheet* is the elements over one patch, or over a sector of it; its node (i, j), i along u, is s = j * rows + i.
 * What does not change from candidate to candidate is the *model*; planes of nodes, [sheet] of what is over s, come
 * with each candidate. Loads act on the mid-surface.
 *
 * Nothing allocates after create but CHOLMOD, in its numeric factor. One thread at a time. */
#ifndef VES_SHELL_SHELL_H
#define VES_SHELL_SHELL_H

#include <stdbool.h>

#include "base/arena.h"
#include "shell/element.h"
#include "vesica/status.h"

/* order: 1 is MITC4+, 2 MITC9, more is integrated fully and locks below 6. ring: a strip of a surface of revolution: order[1] = 1,
 * one element along v with one Gauss point there; what lies on its far side is its near side, turned. */
typedef struct ves_shell_sheet {
    int order[2], elements[2]; /* along u and v */
    const double *knot[2];     /* [elements + 1] of u, of v: rising */
    bool closed;               /* along v: the last column of nodes is the first */
    bool ring;
} ves_shell_sheet;

int ves_shell_rows(const ves_shell_sheet *sheet);
int ves_shell_columns(const ves_shell_sheet *sheet);                     /* without the last, when closed */
void ves_shell_grid(const ves_shell_sheet *sheet, double *u, double *v); /* [rows], [columns] */

enum { VES_SHELL_EDGES = 4 }; /* edges u0, u1, v0, v1 */

/* The nodes along an edge: how many, and s of the k-th; a closed sheet's u0 and u1 come back to their first. */
int ves_shell_edge_count(const ves_shell_sheet *sheet, int edge);
int ves_shell_edge_node(const ves_shell_sheet *sheet, int edge, int k);

/* A node of the welded shell. Where all that is welded goes on smoothly it has one director and turns about the two
 * axes in the tangent plane; at a fold each sheet has its own director there and all turn alike about three. */
typedef struct ves_shell_node {
    double frame[3][3]; /* frame[k]: axis k in which it is held, orthonormal */
    unsigned held;      /* bits 0..2: does not move along axis k; 3..5: does not turn about it */
    bool fold;
    double spring[3]; /* N/m along x, y, z */
} ves_shell_node;

/* stiffness along x, y, z per length of an edge, N/m^2 */
typedef struct ves_shell_spring {
    int sheet, edge;
    double stiffness[3];
} ves_shell_spring;

typedef struct ves_shell_model {
    int sheets;
    const ves_shell_sheet *sheet;
    int nodes; /* welded */
    const ves_shell_node *node;
    const int *const *weld; /* [sheets][s] -> node */
    /* [sheets][s], or NULL: on the far side of a sector, where what is welded is the node turned by `turn`. */
    const bool *const *far;
    double turn[3][3];
    int springs;
    const ves_shell_spring *spring;
    int cases;
    bool gradients; /* are wanted (shell/adjoint.h) */
    /* Factors of buckling are wanted (shell/buckling.h). Of a model that mirror planes cut from the whole, modes need
     * not be as symmetric as the loads: [classes][nodes] what each node is held in, in place of `held`, for each
     * further way in which a mode can go on behind the planes (antisymmetric: along the plane, about its normal). */
    bool buckling;
    int classes;
    const unsigned *const *held;
} ves_shell_model;

/* Of one case on one sheet; every plane may be NULL. */
typedef struct ves_shell_load {
    const double *area[3];                  /* [s] N/m^2 of the mid-surface */
    const double *pressure;                 /* [s] Pa along the normal */
    const double *line[VES_SHELL_EDGES][3]; /* [k] N/m at the nodes of an edge */
} ves_shell_load;

typedef struct ves_shell_point {
    int which, node; /* case, welded node */
    double force[3];
} ves_shell_point;

typedef struct ves_shell_input {
    ves_shell_material material;
    const double *const (*X)[3];      /* [sheets] m */
    const double *const (*normal)[3]; /* [sheets] unit */
    const double *const *thickness;   /* [sheets] m */
    const double *side;               /* [sheets] +1: the normal is that of X_u x X_v, -1: the opposite */
    const ves_shell_load *load;       /* [cases][sheets] */
    int points;
    const ves_shell_point *point;
} ves_shell_input;

typedef struct ves_shell ves_shell;

/* The model must outlive it. input: of the start design, from which nodes that are held in some direction know whether
 * that leaves them free to turn. */
ves_status ves_shell_create(const ves_shell_model *model, const ves_shell_input *input, ves_arena *arena,
                            ves_shell **shell);
void ves_shell_destroy(ves_shell *shell); /* NULL: nothing */

int ves_shell_freedoms(const ves_shell *shell);

/* Displacements of all cases. The input must live while results are asked for. VES_DEGENERATE: an element is turned
 * over or has no thickness. VES_LOOSE: the supports let it move without strain. */
ves_status ves_shell_solve(ves_shell *shell, const ves_shell_input *input);

/* Where the element is that was found turned over: the middle of its nodes. */
void ves_shell_turned(const ves_shell *shell, int *sheet, int *s);

/* How it moves that is loose: along a way, or about it through a point; of the whole, or of what is connected with a sheet. */
typedef struct ves_shell_motion {
    bool turns, whole;
    int sheet;
    double way[3], at[3];
    double firmness,
        least; /* of springs against it, over that of the wall, and of those that are enough; 0: none */
} ves_shell_motion;
const ves_shell_motion *ves_shell_loose(const ves_shell *shell); /* NULL: it is not, or not as a rigid body */

/* Of node s: displacement (m) and increment of the unit director (rad). */
void ves_shell_displacement(const ves_shell *shell, int which, int sheet, int s, double U[3],
                            double director[3]);

/* F . u of a case: twice the strain energy, J. */
double ves_shell_work(const ves_shell *shell, int which);

/* Of an edge as the elements draw it, m. Before solve: of the input that it will be given. */
double ves_shell_length(ves_shell *shell, const ves_shell_input *input, int sheet, int edge);

/* The mean displacement along an edge. */
void ves_shell_edge_mean(ves_shell *shell, int which, int sheet, int edge, double U[3]);

/* Some of the supports: where they are and what they hold there. */
typedef struct ves_shell_grip {
    const bool *node;   /* [nodes] */
    double held[3][3];  /* projector on the directions along which nodes are held there */
    const bool *spring; /* [springs] which are among them */
    bool sprung;        /* the springs of these nodes are */
} ves_shell_grip;

/* The force with which they hold it, N; of a sector what is along its axis or in its mirror plane. */
void ves_shell_reaction(ves_shell *shell, int which, const ves_shell_grip *grip, double F[3]);

/* Stresses at the lattice of all elements. [points], point by point of element by element. */
enum { VES_SHELL_LEVELS = 3 }; /* z = -1, 0, +1 */
typedef struct ves_shell_stresses {
    int points;
    int (*lattice)[2]; /* [sheets] points of an element along r and s, r fastest */
    int *sheet;
    double *u, *v, *X[3], *thickness;
    double *area; /* m^2 of the mid-surface that a point stands for (Simpson) */
    double (*stress)[VES_SHELL_LEVELS]
                    [VES_STRESSES]; /* Pa, ves_shell_stress_at; the shear across is 3/2 of its mean at
                                                         z = 0 and 0 at the surfaces */
} ves_shell_stresses;
const ves_shell_stresses *ves_shell_stress(ves_shell *shell, int which);
int ves_shell_places(const ves_shell *shell); /* how many they are */

/* Of one such tensor, s33 = 0: half the largest difference of principal stresses; von Mises. */
double ves_stress_shear(const double stress[VES_STRESSES]);
double ves_stress_mises(const double stress[VES_STRESSES]);
/* By the stresses; where two principal stresses are the same, of one choice of their directions. */
void ves_stress_shear_slope(const double stress[VES_STRESSES], double slope[VES_STRESSES]);
void ves_stress_mises_slope(const double stress[VES_STRESSES], double slope[VES_STRESSES]);

#endif

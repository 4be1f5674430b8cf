/* One element: its stiffness, its loads and its stresses. Everything here is of one sheet's kind (shell/kind.h). */
#ifndef VES_SHELL_ELEMENT_H
#define VES_SHELL_ELEMENT_H

#include "shell/kind.h"

/* Two levels of Gauss across the thickness, at z = -LEVEL and +LEVEL. At each the strains in the surface are P -+ B,
 * where P = M + z^2 Q and B = z B_ab (shell/kind.h), so that eight numbers a point say all: P, B (11, 22 and twice 12),
 * gamma_13, gamma_23. */
enum { VES_STRESSES = 5, VES_GENERAL = 8 };

/* Isotropic, plane stress: Pa. shear: the share of the transverse shear stiffness (5/6 [Reissner]). */
typedef struct ves_shell_material {
    double E, nu, shear;
} ves_shell_material;

/* A degree of freedom as an element sees it: it moves one of its nodes along `vector` (m, or 1), or turns the
 * half-thickness director of that node by it. */
typedef struct ves_shell_column {
    int node;
    bool turns;
    double vector[3];
    double axis[3]; /* of a turn: vector = axis x V */
} ves_shell_column;

/* [nodes] of the element: positions and half-thickness directors (m). */
typedef struct ves_shell_body {
    const ves_shell_kind *kind;
    const double (*X)[3], (*V)[3];
} ves_shell_body;

/* X_r, V_r, X_s, V_s, V at a point; or of a motion U_r, A_r, U_s, A_s, A. */
typedef struct ves_shell_frame {
    double Xr[3], Vr[3], Xs[3], Vs[3], V[3];
} ves_shell_frame;
void ves_shell_frame_at(const ves_shell_body *body, const ves_shell_table *table, int point,
                        ves_shell_frame *frame);

/* Scratch of the functions below, for elements of these kinds with at most so many columns; made once. Columns are in the order of their nodes. */
typedef struct ves_shell_scratch {
    double *row;          /* [points of the rule][VES_GENERAL][columns], or what shell/tensor.c sums */
    double *tied;         /* [tying points of all strains][VES_GENERAL][columns] */
    double *line, *block; /* of sums along r, and along s */
    int *begin;           /* [nodes + 1] */
    double (*both)[6];    /* [nodes] */
    ves_shell_frame *frame, *motion; /* [points] of any table */
} ves_shell_scratch;
ves_status ves_shell_scratch_make(const ves_shell_kind *kind, int kinds, int columns, ves_arena *arena,
                                  ves_shell_scratch *scratch);

/* At all points of a table: in scratch->frame. */
const ves_shell_frame *ves_shell_frames(const ves_shell_body *body, const ves_shell_table *table,
                                        const ves_shell_scratch *scratch);

/* K [columns][columns], the lower triangle by columns (K[j * columns + i], i >= j). VES_DEGENERATE: the element is
 * turned over, or has no area or thickness, somewhere. */
ves_status ves_shell_stiffness(const ves_shell_body *body, const ves_shell_material *material, int columns,
                               const ves_shell_column *column, const ves_shell_scratch *scratch, double *K);

/* The eight strains [points][VES_GENERAL] at the rule's or the lattice's points, of nodal displacements U and
 * increments of the half-thickness director A [nodes][3]. */
void ves_shell_strains(const ves_shell_body *body, const ves_shell_points *at, const double (*U)[3],
                       const double (*A)[3], const ves_shell_scratch *scratch, double *strain);

/* The transpose: adds to forces [nodes][3] on displacements and on directors what such forces on the eight strains
 * [points][VES_GENERAL] do. */
void ves_shell_pull(const ves_shell_body *body, const ves_shell_points *at, const double *force,
                    const ves_shell_scratch *scratch, double (*U)[3], double (*A)[3]);

/* Cauchy stresses s11, s22, s12, s13, s23 in the local orthonormal frame (e1 along X_r, e3 normal to the lamina) at
 * level z = -1 .. 1, from the strains of a point. False: there is no such frame. */
bool ves_shell_stress_at(const ves_shell_frame *frame, const ves_shell_material *material,
                         const double strain[VES_GENERAL], double z, double stress[VES_STRESSES]);

#endif

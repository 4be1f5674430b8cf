/* The geometric stiffness of an element: what stresses that are there do on a further, small displacement.
 *
 * With e_ij = (g_i . u_j + g_j . u_i + u_i . u_j) / 2 the stresses S^ij do on u the work of second order
 *     phi' K_sigma phi = integral of S^ab u_a . u_b + 2 S^a3 U_a . A + 2 S^ij g_i . u2_j,     u = U + z A,
 * where as in the strains (shell/kind.h) the part of u_a . A linear in z is left out. The last term is what a director
 * does that keeps its length: turned by theta it moves by theta x V + theta x (theta x V) / 2, and the forces on
 * directors that stresses make (ves_shell_pull) work on that. With it a rigid rotation gets exactly the work of
 * second order of the loads. Stresses are those of the mixed interpolation.
 *
 * Pressure stays normal to what it acts on and grows with its area. Its own stiffness, p x_u x x_v varied, is taken
 * symmetric: all of it where the pressure is one and its surface is closed or held at its edges; in other cases no
 * potential of it exists, and a factor is then that of the symmetric part. Other loads keep their direction. */
#ifndef VES_SHELL_GEOMETRIC_H
#define VES_SHELL_GEOMETRIC_H

#include "shell/inside.h"

/* Scratch for elements of so many nodes and points. */
typedef struct shell_geometric {
    double *move, *cross;          /* [nodes][nodes] of U, U; of U (row), A */
    double *follow[3];             /* [nodes][nodes] of pressure: antisymmetric */
    double *row[2];                /* [points][nodes] */
    double *force;                 /* [points][VES_GENERAL] */
    double (*on_U)[3], (*on_V)[3]; /* [nodes] */
} shell_geometric;
ves_status ves_shell_geometric_make(const ves_shell *shell, ves_arena *arena, shell_geometric *g);

/* Of a case that is solved: takes the stresses of an element, then its matrix, lower triangle, in shell->K, for the
 * columns at hand. */
ves_status ves_shell_geometric_take(ves_shell *shell, const shell_element *element, int which,
                                    const shell_geometric *g);
void ves_shell_geometric(ves_shell *shell, const ves_shell_body *body, int columns, const shell_geometric *g);

#endif

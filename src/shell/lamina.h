/* Laminae: the surfaces z = constant of a shell, -1 <= z <= 1, in which its stresses are plane. */
#ifndef VES_SHELL_LAMINA_H
#define VES_SHELL_LAMINA_H

#include "shell/element.h"

/* From covariant strains (11, 22, 2 x 12, 2 x 13, 2 x 23) at a level to strains in its orthonormal frame, e1 along g_1
 * and e3 normal to the lamina, in the same order: T[out][in], and the determinant of (g_1, g_2, g_3). False: that
 * is not positive. */
typedef struct ves_lamina {
    double T[VES_STRESSES][VES_STRESSES];
    double volume;  /* of g_1, g_2, g_3 */
    double e[3][3]; /* e[0..2]: the frame */
} ves_lamina;
bool ves_lamina_at(const ves_shell_frame *frame, double z, ves_lamina *lamina);

/* Stresses of local strains. */
void ves_lamina_stress(const ves_shell_material *material, const double strain[VES_STRESSES],
                       double stress[VES_STRESSES]);

/* Level of the two Gauss points across the thickness. */
#define VES_LEVEL 0.57735026918962576451

/* The energy of the eight strains at a point, integrated over the thickness: half of strain' G strain, times weight;
 * and F with G = F' F. False: as ves_lamina_at. */
bool ves_lamina_law(const ves_shell_frame *frame, const ves_shell_material *material, double weight,
                    double G[VES_GENERAL][VES_GENERAL]);
bool ves_lamina_factor(const ves_shell_frame *frame, const ves_shell_material *material, double weight,
                       double F[VES_GENERAL][VES_GENERAL]);

/* The same as forces: weight times G strain, what does work on the eight strains. */
bool ves_lamina_forces(const ves_shell_frame *frame, const ves_shell_material *material, double weight,
                       const double strain[VES_GENERAL], double force[VES_GENERAL]);

#endif

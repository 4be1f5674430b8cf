/* How the law of a lamina changes with its frame: what the gradient of a shape needs of the material.
 *
 * Let g_j vary as L g_j. A tensor e = e_ij g^i g^j of given covariant components varies by -(L' e + e L), and the frame, e_1
 * along g_1 and e_3 along g^3, by the spin that has below the diagonal what L has there, in components of the frame. So
 * with W = sigma_a : e_b of an isotropic law
 *     dW = tr(L H),   H = -2 (sigma_a e_b + sigma_b e_a) + 2 upper([sigma_a, e_b] + [sigma_b, e_a]),
 * [,] the commutator, upper what is above the diagonal; and d volume = volume tr(L). Here e has e_33, of covariant strains
 * that have none, where V is not along the normal of the lamina. */
#ifndef VES_SHELL_LAW_H
#define VES_SHELL_LAW_H

#include "shell/element.h"

/* Adjoints of what the law is made of. */
typedef struct ves_law {
    ves_shell_frame frame;
    double E, nu, shear;
} ves_law;

/* Adds those of the material alone. */
static inline void ves_law_add(const ves_law *from, ves_law *to)
{
    to->E += from->E, to->nu += from->nu, to->shear += from->shear;
}

/* Adds those of factor * a' G b, the strains held (ves_lamina_forces has G). */
void ves_law_energy(const ves_shell_frame *frame, const ves_shell_material *material, double factor,
                    const double a[VES_GENERAL], const double b[VES_GENERAL], ves_law *to);

/* Adds those of seed . stress (ves_shell_stress_at), at level z of strains a, and to `on` those of the strains. Nothing
 * where there is no stress. */
typedef struct ves_law_seed {
    double z;
    const double *seed; /* [VES_STRESSES] */
} ves_law_seed;
void ves_law_stress(const ves_shell_frame *frame, const ves_shell_material *material,
                    const ves_law_seed *seed, const double a[VES_GENERAL], double on[VES_GENERAL],
                    ves_law *to);

#endif

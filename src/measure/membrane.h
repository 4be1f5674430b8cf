/* Membranes: the spontaneous-curvature model [Canham 1970; Helfrich 1973; Ugail 2011, 7.5.2 with docs/errata.md],
 *     E = kappa/2 integral (2 H - C0)^2 dA + kappa_g integral K dA,   C0 = c0 + reduced_c0 / R0,   R0 = sqrt(A / 4 pi),
 * H = +1/R on a sphere, so that C0 > 0 favours buds that point outwards. Energies are told over 8 pi kappa, where a
 * sphere has (1 - C0 R / 2)^2, and reduced numbers over a sphere of the same area. */
#ifndef VES_MEASURE_MEMBRANE_H
#define VES_MEASURE_MEMBRANE_H

#include <math.h>

#include "measure/sum.h"

/* The keys that measures of this model begin with. */
enum {
    VES_MEMBRANE_KAPPA,
    VES_MEMBRANE_C0,
    VES_MEMBRANE_REDUCED_C0,
    VES_MEMBRANE_KAPPA_G,
    VES_MEMBRANE_KEYS
};

#define VES_KEY_KAPPA                                                                                        \
    {                                                                                                        \
        .name = "kappa", .kind = VES_NUMBER, .unit = "kg m^2/s^2", .min = VES_POSITIVE, .max = HUGE_VAL,     \
        .fallback = 1, .about = "bending rigidity"                                                           \
    }
#define VES_KEY_C0                                                                                           \
    {                                                                                                        \
        .name = "c0", .kind = VES_NUMBER, .unit = "m^-1", .about = "spontaneous curvature C0"                \
    }
#define VES_KEY_REDUCED_C0                                                                                   \
    {                                                                                                        \
        .name = "reduced_c0", .kind = VES_NUMBER, .unit = "1",                                               \
        .about = "C0 times the radius of a sphere of the same area; added to c0"                             \
    }
#define VES_KEY_KAPPA_G                                                                                      \
    {                                                                                                        \
        .name = "kappa_g", .kind = VES_NUMBER, .unit = "kg m^2/s^2",                                         \
        .about = "rigidity of Gaussian curvature"                                                            \
    }

/* Its numbers on a surface; made anew for each evaluation. */
typedef struct ves_membrane {
    double kappa, c0, reduced_c0, kappa_g;
    double area, mean; /* A, integral of H dA */
    double R0, C0;
} ves_membrane;

ves_membrane ves_membrane_init(const ves_measure_input *input);
double ves_membrane_energy(const ves_measure_input *input, const ves_membrane *m);
void ves_membrane_energy_gradient(const ves_measure_input *input, const ves_membrane *m, double seed,
                                  const ves_adjoint *const *adjoint, double *number_adjoint);

/* M = integral of H dA / (4 pi R0), 1 for a sphere: the difference between the areas of two leaflets that lie D apart,
 * over that of the sphere, 8 pi D R0. */
double ves_membrane_difference(const ves_measure_input *input);
void ves_membrane_difference_gradient(const ves_measure_input *input, double seed,
                                      const ves_adjoint *const *adjoint);

#endif

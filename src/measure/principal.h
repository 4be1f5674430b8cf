/* Principal curvatures k1 = H + s, k2 = H - s, s = sqrt(H^2 - K), and the transpose.
 *
 * At an umbilic s = 0 and its derivative has no limit. But there every change of the surface keeps
 * d(H^2 - K) = 0 to first order (H^2 - K is (k1 - k2)^2 / 4), so that leaving the part through s out is exact
 * for functions that treat k1 and k2 alike, and one subgradient of the others. s below 1e-7 |H| is rounding
 * of H^2 - K, which may then be slightly negative as well. */
#ifndef VES_MEASURE_PRINCIPAL_H
#define VES_MEASURE_PRINCIPAL_H

#include <math.h>

typedef struct ves_principal {
    double k1, k2, s; /* s = 0 at what cannot be told from an umbilic */
} ves_principal;

static inline ves_principal ves_principal_init(double H, double K)
{
    double q = H * H - K, s = q <= 1e-14 * H * H ? 0 : sqrt(q);
    return (ves_principal){H + s, H - s, s};
}

/* Adds to d J / d H and d J / d K, given d J / d k1 and d J / d k2. */
static inline void ves_principal_gradient(const ves_principal *k, double g1, double g2, double *gH,
                                          double *gK)
{
    double H = (k->k1 + k->k2) / 2, q = k->s > 0 ? (g1 - g2) / (2 * k->s) : 0;
    *gH += g1 + g2 + 2 * H * q;
    *gK -= q;
}

#endif

/* What formulas of u and v mean by them: a patch has 0 <= u <= 1 and 0 <= v <= 2 pi, its formulas a domain of their
 * own. */
#ifndef VES_BASE_DOMAIN_H
#define VES_BASE_DOMAIN_H

#include "base/vector.h"

/* at: u and v of the formulas. */
static inline void ves_domain_at(const double u_range[2], const double v_range[2], double u, double v,
                                 double at[2])
{
    at[0] = u_range[0] + (u_range[1] - u_range[0]) * u;
    at[1] = v_range[0] + (v_range[1] - v_range[0]) / VES_TWO_PI * v;
}

#endif

/* The ring of least bending, its size eliminated, the reduced area as an equation: suite/elastica.h. */
#include <stddef.h>

#include "suite/elastica.h"
#include "suite/landscape.h"

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    ves_elastica e;
    if (!ves_elastica_measure(x, slopes, &e) || !e.resolved) return VES_DEGENERATE;
    out->value = ves_elastica_energy(&e, slopes ? out->gradient : NULL);
    out->constraint[0] = ves_elastica_shape(&e, slopes ? out->jacobian : NULL) / ves_elastica_reduced - 1;
    for (int i = 0; slopes && i < n; i++) out->jacobian[i] /= ves_elastica_reduced;
    return VES_OK;
}

const ves_landscape ves_landscape_elastica_scaled = {
    .name = "elastica_scaled",
    .about = "the plane ring that bends least, its reduced area as an equation",
    .least = VES_ELASTICA,
    .most = VES_ELASTICA,
    .bounds = ves_elastica_bounds,
    .equalities = 1,
    .optimum = ves_elastica_optimum,
    .eval = eval,
};

/* The ring of least bending, length and area as equations: suite/elastica.h. */
#include "suite/elastica.h"

#include "base/vector.h"
#include "suite/landscape.h"

static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    ves_elastica e;
    if (!ves_elastica_measure(x, slopes, &e) || !e.resolved) return VES_DEGENERATE;
    double area = ves_elastica_reduced * VES_PI;
    out->value = e.bending;
    out->constraint[0] = e.length / VES_TWO_PI - 1;
    out->constraint[1] = e.area / area - 1;
    for (int i = 0; slopes && i < n; i++) {
        out->gradient[i] = e.bending_slope[i];
        out->jacobian[i] = e.length_slope[i] / VES_TWO_PI;
        out->jacobian[n + i] = e.area_slope[i] / area;
    }
    return VES_OK;
}

const ves_landscape ves_landscape_elastica = {
    .name = "elastica",
    .about = "the plane ring that bends least, its length and area as equations",
    .least = VES_ELASTICA,
    .most = VES_ELASTICA,
    .bounds = ves_elastica_bounds,
    .equalities = 2,
    .optimum = ves_elastica_optimum,
    .eval = eval,
};

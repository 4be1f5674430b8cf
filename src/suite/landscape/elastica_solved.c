/* The ring of least bending, both equations eliminated: its size, and b_1 as the root of the equation of the
 * reduced area: suite/elastica.h. One evaluation measures the curve about eight times. */
#include <math.h>
#include <stddef.h>

#include "suite/elastica.h"
#include "suite/landscape.h"

enum { B1 = VES_ELASTICA_HALF, STEPS = 60 };

static const double bounds[VES_ELASTICA - 1][2] = {{0.2, 2},
                                                   {-1.0 / 4, 1.0 / 4},
                                                   {-1.0 / 6, 1.0 / 6},
                                                   {-1.0 / 8, 1.0 / 8},
                                                   {-1.0 / 4, 1.0 / 4},
                                                   {-1.0 / 6, 1.0 / 6},
                                                   {-1.0 / 8, 1.0 / 8}};

/* The ring that bends least is longer along y, b_1 > a_1, where no root is looked for; of those in reach it is the
 * best. */
static double optimum(int n, double *x)
{
    static const double place[VES_ELASTICA] = {1.28885214922476,    -0.126519550678168, 0.0371524656561372,
                                               -0.0214433982674778, 0.526521150071294,  -0.0361352713563027,
                                               0.0812857281950754,  -0.0371740501665956};
    for (int i = 0; i < n; i++) x[i] = place[i < B1 ? i : i + 1];
    return 12.48658906959368;
}

static bool excess(double *p, double b, double *value)
{
    ves_elastica e;
    p[B1] = b;
    if (!ves_elastica_measure(p, false, &e)) return false;
    *value = ves_elastica_shape(&e, NULL) - ves_elastica_reduced;
    return true;
}

/* Between b_1 = 0.05 a_1, a needle, and a_1, nearly a circle: regula falsi of the Illinois kind. */
static ves_status solve(double *p)
{
    double a = 0.05 * p[0], b = p[0], fa, fb, f;
    if (!excess(p, a, &fa) || !excess(p, b, &fb) || !(fa < 0 && fb > 0)) return VES_NO_ROOT;
    for (int k = 0; k < STEPS && fabs(b - a) > 1e-15 * p[0]; k++) {
        double c = (a * fb - b * fa) / (fb - fa);
        if (!excess(p, c, &f)) return VES_NO_ROOT;
        if (fabs(f) < 1e-15) break;
        if ((f < 0) == (fb < 0))
            fa /= 2;
        else
            a = b, fa = fb;
        b = c, fb = f;
    }
    return VES_OK;
}

/* Along the root, db_1 = -(shape's slope)/(that by b_1). */
static ves_status eval(int n, const double *x, bool slopes, ves_verdict *out)
{
    double p[VES_ELASTICA], energy[VES_ELASTICA], shape[VES_ELASTICA];
    for (int i = 0; i < n; i++) p[i < B1 ? i : i + 1] = x[i];
    ves_status status = solve(p);
    ves_elastica e;
    if (status != VES_OK) return status;
    if (!ves_elastica_measure(p, slopes, &e) || !e.resolved) return VES_DEGENERATE;
    out->value = ves_elastica_energy(&e, energy);
    if (!slopes) return VES_OK;
    ves_elastica_shape(&e, shape);
    for (int i = 0; i < n; i++) {
        int k = i < B1 ? i : i + 1;
        out->gradient[i] = energy[k] - energy[B1] * shape[k] / shape[B1];
    }
    return VES_OK;
}

const ves_landscape ves_landscape_elastica_solved = {
    .name = "elastica_solved",
    .about = "the plane ring that bends least, both equations eliminated",
    .least = VES_ELASTICA - 1,
    .most = VES_ELASTICA - 1,
    .bounds = bounds,
    .optimum = optimum,
    .eval = eval,
};

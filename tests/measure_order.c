/* How fast every integral converges on a patch that is neither exact nor symmetric for any of them. Gauss
 * nodes along u and evenly spread ones along v see an analytic integrand: each node more divides the error by
 * a factor, so the order is asserted as that factor and not as a power. (Extremes over nodes:
 * tests/measure.c.) */
#include "samples.h"

typedef struct use {
    const char *measure, *formula;
    double smooth;
    int choice; /* centroid: of */
    bool along;
} use;

static const use USES[] = {
    {.measure = "area"},
    {.measure = "volume"},
    {.measure = "bending"},
    {.measure = "willmore"},
    {.measure = "mean_curvature"},
    {.measure = "gauss_curvature"},
    {.measure = "max_curvature", .smooth = 4}, /* even: an odd power of |k| has a kink where k = 0 */
    {.measure = "centroid", .along = true, .choice = 0},
    {.measure = "centroid", .along = true, .choice = 1},
    {.measure = "integral", .formula = "x*y + sin(q*z)*H^2 + K*u"},
    {.measure = "max", .formula = "20 + x - z*y + H", .smooth = 4},
};
enum { COUNT = sizeof USES / sizeof *USES };

static double measured(const use *how, const body *b, int nu, int nv)
{
    rig r;
    rig_open(&r);
    const ves_measure *measure = ves_measure_find(how->measure, NULL);
    rig_surface(&r, b, nu, nv);
    if (measure->cap) rig_ring(&r, b, 0, nv, -1), rig_ring(&r, b, 1, nv, 1);
    rig_measure_with(&r, measure);
    if (how->formula) rig_formula(&r, "of", how->formula);
    if (how->smooth > 0) rig_number(&r, "smooth", how->smooth);
    if (how->along) rig_vector(&r, "along", 0.4, -1.3, 0.7);
    if (!strcmp(how->measure, "centroid")) rig_choice(&r, "of", how->choice);
    double value = rig_eval(&r);
    rig_close(&r);
    return value;
}

/* From node count to node count the error falls by `factor` at least, until rounding (1e-12 of the size) is
 * left. Measured: 2 nodes more along u divide it by 500 and more, 16 more along v by 17 and more (most by
 * 100), from where the waves of the tube are seen at all. */
static void falls(const use *how, const double *error, int count, double size, double factor)
{
    for (int k = 0; k + 1 < count; k++)
        cr_expect(error[k + 1] <= fmax(error[k] / factor, 1e-12 * size),
                  "%s (%s): error %.2e after %.2e, want / %g", how->measure, how->formula ? how->formula : "",
                  error[k + 1], error[k], factor);
}

Test(measure_order, integrals_converge_geometrically_along_u_and_v)
{
    enum { U = 5, V = 5 };
    body b = body_moved(body_init(wavy_tube, -1, 1.129, 0.217, 1.713), 3);
    for (int k = 0; k < COUNT; k++) {
        const use *how = &USES[k];
        double want = measured(how, &b, 40, 160), u[U], v[V];
        for (int n = 0; n < U; n++) u[n] = fabs(measured(how, &b, 2 + 2 * n, 160) - want);
        for (int n = 0; n < V; n++) v[n] = fabs(measured(how, &b, 40, 24 + 16 * n) - want);
        falls(how, u, U, fabs(want), 300);
        falls(how, v, V, fabs(want), 15);
    }
}

/* The obstacle course of shell elements: classical problems with reference values, elements of all orders. */
#include <criterion/criterion.h>

#include "shell_case.h"

#define DEG (VES_PI / 180)

/* --- Scordelis-Lo roof: a quarter, u along the arc from the crown, v from the middle to the diaphragm --- */

static void roof_surface(const shell_case *c, double u, double v, double X[3])
{
    (void)c;
    X[0] = 25 * sin(u), X[1] = v, X[2] = 25 * cos(u);
}

static double roof(int order, int n)
{
    shell_case c = {.surface = roof_surface,
                    .u = {0, 40 * DEG},
                    .v = {0, 25},
                    .order = order,
                    .elements = {n, n},
                    .thickness = 0.25,
                    .material = {4.32e8, 0, 5. / 6}};
    case_mesh(&c);
    case_hold(&c, 0, MIRROR_X);
    case_hold(&c, 2, MIRROR_Y);
    case_hold(&c, 3, HELD_X | HELD_Z);
    c.load.area[0] = c.load.area[1] = case_constant(&c, 0), c.load.area[2] = case_constant(&c, -90);
    cr_assert(case_solve(&c) == VES_OK);
    double w = -case_moved(&c, c.rows - 1, 0, 0, 1);
    case_end(&c);
    return w;
}

/* --- pinched cylinder with diaphragms, an eighth --- */

static void cylinder_surface(const shell_case *c, double u, double v, double X[3])
{
    (void)c;
    X[0] = 300 * sin(u), X[1] = v, X[2] = 300 * cos(u);
}

static double cylinder(int order, int n)
{
    shell_case c = {.surface = cylinder_surface,
                    .u = {0, VES_PI / 2},
                    .v = {0, 300},
                    .order = order,
                    .elements = {n, n},
                    .thickness = 3,
                    .material = {3e6, 0.3, 5. / 6}};
    case_mesh(&c);
    case_hold(&c, 0, MIRROR_X);
    case_hold(&c, 1, MIRROR_Z);
    case_hold(&c, 2, MIRROR_Y);
    case_hold(&c, 3, HELD_X | HELD_Z);
    case_push(&c, 0, 0, 0, -0.25);
    cr_assert(case_solve(&c) == VES_OK);
    double w = -case_moved(&c, 0, 0, 0, 1);
    case_end(&c);
    return w;
}

/* --- pinched hemisphere with a hole of 18 degrees, a quarter; skew: distorts the grid by so much --- */

static void hemisphere_surface(const shell_case *c, double u, double v, double X[3])
{
    double skew = c->number[0], a = u / 72 / DEG, b = v / 90 / DEG;
    double p = u + skew * 72 * DEG * sin(VES_PI * a) * sin(VES_PI * b),
           q = v + skew * 90 * DEG * sin(VES_PI * a) * sin(VES_PI * b);
    X[0] = 10 * cos(p) * cos(q), X[1] = 10 * cos(p) * sin(q), X[2] = 10 * sin(p);
}

static double hemisphere(int order, int n, double skew)
{
    shell_case c = {.surface = hemisphere_surface,
                    .number = &skew,
                    .u = {0, 72 * DEG},
                    .v = {0, 90 * DEG},
                    .order = order,
                    .elements = {n, n},
                    .thickness = 0.04,
                    .material = {6.825e7, 0.3, 5. / 6}};
    case_mesh(&c);
    case_hold(&c, 2, MIRROR_Y);
    case_hold(&c, 3, MIRROR_X);
    c.node[0].held |= HELD_Z; /* rigid motion along z */
    case_push(&c, 0, 1, 0, 0);
    case_push(&c, (c.columns - 1) * c.rows, 0, -1, 0);
    cr_assert(case_solve(&c) == VES_OK);
    double w = case_moved(&c, 0, 1, 0, 0);
    case_end(&c);
    return w;
}

/* --- Chapelle-Bathe hyperboloid, an eighth: u along the axis from the waist, v around --- */

static void hyperboloid_surface(const shell_case *c, double u, double v, double X[3])
{
    (void)c;
    double r = sqrt(1 + u * u);
    X[0] = r * cos(v), X[1] = u, X[2] = r * sin(v);
}

static double hyperboloid(int order, int n, double t, bool clamped, double grading)
{
    shell_case c = {.surface = hyperboloid_surface,
                    .u = {0, 1},
                    .v = {0, VES_PI / 2},
                    .order = order,
                    .elements = {n, n},
                    .grading = {grading, 0},
                    .thickness = t,
                    .material = {2e11, 1. / 3, 5. / 6}};
    case_mesh(&c);
    case_hold(&c, 0, MIRROR_Y);
    case_hold(&c, 2, MIRROR_Z);
    case_hold(&c, 3, MIRROR_X);
    if (clamped) case_hold(&c, 1, HELD_ALL);
    double *p = case_plane(&c);
    for (int s = 0; s < c.rows * c.columns; s++) p[s] = 1e6 * cos(2 * c.at_v[s / c.rows]);
    c.load.pressure = p;
    cr_assert(case_solve(&c) == VES_OK);
    double energy = ves_shell_work(c.shell, 0) / 2;
    case_end(&c);
    return energy;
}

/* Bars of low-order elements on the course: what independent programs of the same elements reach, and the references that
 * the literature normalises by (0.3024 MacNeal and Harder 1985; 1.8248e-5 Lindberg et al. 1969; 0.0940 MacNeal and Harder). */
typedef struct bar {
    const char *what;
    double got, low, high;
} bar;

static void hold(const bar *list, int count)
{
    for (int k = 0; k < count; k++)
        cr_assert(list[k].got >= list[k].low && list[k].got <= list[k].high, "%s: %.5f, not %.4f ... %.4f",
                  list[k].what, list[k].got, list[k].low, list[k].high);
}

#define HOLD(...)                                                                                            \
    do {                                                                                                     \
        const bar list_[] = {__VA_ARGS__};                                                                   \
        hold(list_, sizeof list_ / sizeof *list_);                                                           \
    } while (0)

Test(course, mitc4_plus)
{
    HOLD({"roof 16", roof(1, 16) / 0.3024, 0.985, 1}, {"cylinder 16", cylinder(1, 16) / 1.8248e-5, 0.925, 1},
         {"hemisphere 16", hemisphere(1, 16, 0) / 0.094, 0.985, 1.005},
         {"roof 32", roof(1, 32) / 0.3024, 0.99, 1}, {"cylinder 32", cylinder(1, 32) / 1.8248e-5, 0.985, 1},
         {"hemisphere 32", hemisphere(1, 32, 0) / 0.094, 0.99, 1},
         {"skewed hemisphere 8", hemisphere(1, 8, 0.15) / 0.094, 0.95, 1.05});
}

Test(course, mitc9)
{
    HOLD({"roof 8", roof(2, 4) / 0.3024, 0.99, 1}, {"cylinder 8", cylinder(2, 4) / 1.8248e-5, 0.96, 1},
         {"hemisphere 8", hemisphere(2, 4, 0) / 0.094, 0.98, 1},
         {"cylinder 16", cylinder(2, 8) / 1.8248e-5, 0.995, 1.015});
}

/* 0.3020: the roof on soft diaphragms of this theory, 0.09359 the hemisphere; a point load has no limit. */
Test(course, full)
{
    HOLD({"roof", roof(8, 2) / 0.3020, 0.998, 1.002},
         {"hemisphere", hemisphere(8, 2, 0) / 0.09359, 0.998, 1.001},
         {"cylinder", cylinder(8, 2) / 1.8248e-5, 0.99, 1.015},
         {"skewed hemisphere", hemisphere(8, 2, 0.15) / 0.09359, 0.985, 1.001});
}

/* Strain energies of the hyperboloid: values of an independent program of order 8 against order 6. */
Test(course, hyperboloid)
{
    HOLD({"clamped 0.01", hyperboloid(8, 4, 0.01, true, 1.8) / 539.2507, 1 - 1e-5, 1 + 1e-5},
         {"clamped 0.001", hyperboloid(8, 4, 0.001, true, 1.8) / 6001.16, 1 - 1e-5, 1 + 1e-5},
         {"free 0.01", hyperboloid(8, 4, 0.01, false, 3) / 4.52898e5, 1 - 1e-4, 1 + 1e-4},
         {"free 0.001", hyperboloid(8, 8, 0.001, false, 3) / 4.4861e8, 1 - 1e-4, 1 + 1e-4});
}

/* Locking: on one mesh the error does not grow as the shell gets thin. The reference is order 8 on twice the mesh. */
Test(course, thin)
{
    for (int clamped = 0; clamped < 2; clamped++) {
        double grading = 1.8, before = 0;
        for (double t = 1e-2; t > 5e-5; t /= 10) {
            double exact = hyperboloid(8, 6, t, clamped, 3),
                   error = fabs(hyperboloid(1, 16, t, clamped, grading) / exact - 1);
            cr_assert(before == 0 || error < 1.5 * before + 0.002, "t %g clamped %d: %g after %g", t, clamped,
                      error, before);
            before = error;
        }
    }
}

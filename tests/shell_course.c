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

/* --- a beam twisted by 90 degrees, clamped at one end, pushed at the other along its width or its thickness
 * there --- */

static void twisted_surface(const shell_case *c, double u, double v, double X[3])
{
    (void)c;
    X[0] = u, X[1] = v * cos(VES_PI * u / 24), X[2] = v * sin(VES_PI * u / 24);
}

static double twisted(int order, int n, double t, double force, bool across)
{
    shell_case c = {.surface = twisted_surface,
                    .u = {0, 12},
                    .v = {-0.55, 0.55},
                    .order = order,
                    .elements = {3 * n, n / 2},
                    .thickness = t,
                    .material = {29e6, 0.22, 5. / 6}};
    case_mesh(&c);
    case_hold(&c, 0, HELD_ALL);
    for (int i = 0; i < 3; i++) c.load.line[1][i] = case_constant(&c, (i == (across ? 1 : 2)) * force / 1.1);
    cr_assert(case_solve(&c) == VES_OK);
    double U[3];
    ves_shell_edge_mean(c.shell, 0, 0, 1, U);
    case_end(&c);
    return across ? U[1] : U[2];
}

/* --- Raasch's hook: u in elements of order 1, number[0] of number[1] over the first arc --- */

static double hook_angle(const shell_case *c, double u)
{
    double first = c->number[0], all = c->number[1];
    return u <= first ? 60 * DEG * u / first : 60 * DEG - 150 * DEG * (u - first) / (all - first);
}

static void hook_surface(const shell_case *c, double u, double v, double X[3])
{
    double a = hook_angle(c, u), s = sin(60 * DEG), co = cos(60 * DEG);
    X[0] = u <= c->number[0] ? 14 * sin(a) : 60 * s - 46 * sin(a);
    X[1] = u <= c->number[0] ? 14 * cos(a) : 60 * co - 46 * cos(a);
    X[2] = v;
}

static void hook_across(const shell_case *c, double u, double v, double n[3])
{
    (void)v;
    double a = hook_angle(c, u);
    n[0] = -sin(a), n[1] = -cos(a), n[2] = 0;
}

/* along, first: elements along it, and of these over the first arc */
static double hook(int order, int along, int first, int wide)
{
    const double number[2] = {first, along};
    shell_case c = {.surface = hook_surface,
                    .across = hook_across,
                    .number = number,
                    .u = {0, along},
                    .v = {0, 20},
                    .order = order,
                    .elements = {along, wide},
                    .thickness = 2,
                    .material = {3300, 0.35, 5. / 6}};
    case_mesh(&c);
    case_hold(&c, 0, HELD_ALL);
    for (int i = 0; i < 3; i++) c.load.line[1][i] = case_constant(&c, i == 2 ? 0.05 : 0);
    cr_assert(case_solve(&c) == VES_OK);
    double w = case_moved(&c, c.columns / 2 * c.rows + c.rows - 1, 0, 0, 1);
    case_end(&c);
    return w;
}

/* --- the straight beam 6 x 0.2 x 0.1 of MacNeal and Harder: pulled, pushed in its plane, across it --- */

static void beam_surface(const shell_case *c, double u, double v, double X[3])
{
    (void)c;
    X[0] = u, X[1] = v, X[2] = 0;
}

static double beam(int order, int n, int way)
{
    shell_case c = {.surface = beam_surface,
                    .u = {0, 6},
                    .v = {-0.1, 0.1},
                    .order = order,
                    .elements = {n, 1},
                    .thickness = 0.1,
                    .material = {1e7, 0.3, 5. / 6}};
    case_mesh(&c);
    case_hold(&c, 0, HELD_ALL);
    for (int i = 0; i < 3; i++) c.load.line[1][i] = case_constant(&c, i == way ? 5 : 0);
    cr_assert(case_solve(&c) == VES_OK);
    double U[3];
    ves_shell_edge_mean(c.shell, 0, 0, 1, U);
    case_end(&c);
    return U[way];
}

/* --- a container of revolution with twelve ripples near its base, from crest to trough (mm, MPa): clamped
 * there, pushed down at its rim; number[0]: how high the ripples are --- */

static void bowl_surface(const shell_case *c, double u, double v, double X[3])
{
    double r = (22 + 12 * (1.6 * u - 0.6 * u * u)) *
               (1 + c->number[0] * cos(12 * v) * (u / 0.12) * exp(1 - u / 0.12));
    X[0] = r * cos(v), X[1] = 65 * u, X[2] = r * sin(v);
}

typedef struct bowled {
    double down, most, shear, work;
    int freedoms;
} bowled;

static void bowl_look(shell_case *c, bowled *b)
{
    for (int s = 0; s < c->rows * c->columns; s++) {
        double U[3];
        for (int i = 0; i < 3; i++) U[i] = case_moved(c, s, i == 0, i == 1, i == 2);
        b->most = fmax(b->most, sqrt(ves_dot(U, U)));
    }
    b->down = case_moved(c, c->rows - 1, 0, 1, 0);
    b->work = ves_shell_work(c->shell, 0);
    b->freedoms = ves_shell_freedoms(c->shell);
    const ves_shell_stresses *of = ves_shell_stress(c->shell, 0);
    for (int k = 0; k < of->points; k++)
        for (int z = 0; z < VES_SHELL_LEVELS; z++)
            b->shear = fmax(b->shear, ves_stress_shear(of->stress[k][z]));
}

static bowled bowl(int order, int n, double t, double ripple, double grading)
{
    const double far[3] = {-sin(VES_PI / 12), 0, cos(VES_PI / 12)};
    bowled b = {0};
    shell_case c = {.surface = bowl_surface,
                    .number = &ripple,
                    .u = {0, 1},
                    .v = {0, VES_PI / 12},
                    .order = order,
                    .elements = {n, 1},
                    .grading = {grading, 0},
                    .thickness = t,
                    .material = {3000, 0.35, 5. / 6}};
    case_mesh(&c);
    case_hold(&c, 2, MIRROR_Z);
    case_mirror(&c, 3, far);
    case_hold(&c, 0, HELD_ALL);
    for (int i = 0; i < 3; i++) c.load.line[1][i] = case_constant(&c, i == 1 ? -0.015 : 0);
    cr_assert(case_solve(&c) == VES_OK);
    bowl_look(&c, &b);
    case_end(&c);
    return b;
}

/* Bars of low-order elements on the course: what independent programs of the same elements reach, and the
 * references that the literature normalises by (0.3024 MacNeal and Harder 1985; 1.8248e-5 Lindberg et al.
 * 1969; 0.0940 MacNeal and Harder). */
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

/* Locking: on one mesh the error does not grow as the shell gets thin; that of order 6 stays small. The reference is
 * order 8 on twice the mesh. (MITC9 is not among them: 8 x 8 of it lose 5 % of the free one's energy, even, and 36 %
 * graded like this, when t = 1e-4.) */
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
            double six = fabs(hyperboloid(6, 6, t, clamped, grading) / exact - 1);
            cr_assert(six < 1e-3, "order 6, t %g clamped %d: %g", t, clamped, six);
        }
    }
}

/* The beam by twisted elements: what warps is what MITC4+ is for. Knight (1997) has 5.02 for the hook, this
 * theory 5.027. Of a bilinear membrane that bends in its plane there is little: 0.093. */
Test(course, strips)
{
    HOLD({"twisted, width", twisted(1, 16, 0.32, 1, false) / 0.005424, 0.99, 1.01},
         {"twisted, thickness", twisted(1, 16, 0.32, 1, true) / 0.001754, 0.99, 1.01},
         {"thin, width", twisted(1, 16, 0.0032, 1e-6, false) / 0.005256, 0.99, 1.01},
         {"thin, thickness", twisted(1, 16, 0.0032, 1e-6, true) / 0.001294, 0.99, 1.01},
         {"twisted 2, width", twisted(2, 4, 0.32, 1, false) / 0.005416, 0.997, 1.001},
         {"twisted 2, thickness", twisted(2, 4, 0.32, 1, true) / 0.0017506, 0.997, 1.001},
         {"hook", hook(1, 48, 5, 8) / 5.027, 0.975, 1.005},
         {"hook 2", hook(2, 24, 3, 4) / 5.027, 0.98, 1.005},
         {"hook 8", hook(8, 6, 1, 2) / 5.027, 0.998, 1.002});
    HOLD({"pull", beam(1, 6, 0) / 3e-5, 0.994, 0.996}, {"inside", beam(1, 6, 1) / 0.1081, 0.09, 0.1},
         {"across", beam(1, 6, 2) / 0.4321, 0.979, 0.981}, {"pull 2", beam(2, 3, 0) / 3e-5, 0.995, 0.997},
         {"inside 2", beam(2, 3, 1) / 0.1081, 0.988, 0.99},
         {"across 2", beam(2, 3, 2) / 0.4321, 0.988, 0.99});
}

/* A wall of 0.4 mm, in mm: an independent program of orders 8 and 12 has -1.18141e-3, 1.54929e-3, and 76.64
 * kPa at the clamp. With at most 2000 degrees of freedom in the sector. */
Test(course, container)
{
    for (int order = 6; order < 9; order += 2) {
        bowled b = bowl(order, 6, 0.4, 0.03, 1.8);
        HOLD({"freedoms", b.freedoms, 0, 2000}, {"down", b.down / -1.18141e-3, 0.999, 1.001},
             {"most", b.most / 1.54929e-3, 0.999, 1.001}, {"shear", b.shear / 0.07664, 0.995, 1.005});
    }
}

/* One mesh for walls of a hundredth to a ten thousandth of the radius. At its ends the wall bends within
 * sqrt(R t), so the mesh must be fine there for the thinnest; then orders from 2 on do not lock. (MITC4+
 * does: its sides are chords, and where their height is more than the thickness, 0.2 % of the radius for 6
 * of them in 15 degrees, a slope along the other sides shears it.) */
Test(course, thin_container)
{
    static const struct {
        int order, elements;
        double error;
    } OF[] = {{2, 20, 5e-3}, {6, 8, 2e-3}, {8, 8, 1e-4}};
    for (double t = 0.34; t > 0.003; t /= 10) {
        double exact = bowl(10, 14, t, 0, 4).work;
        for (int k = 0; k < 3; k++) {
            double error = fabs(bowl(OF[k].order, OF[k].elements, t, 0, 4).work / exact - 1);
            cr_assert(error < OF[k].error, "order %d, t %g: %g", OF[k].order, t, error);
        }
    }
}

static double clamped_error(int order, int n, double grading, double exact)
{
    return fabs(hyperboloid(order, n, 0.01, true, grading) / exact - 1);
}

/* Orders that are observed: of energy, twice that of strains. MITC9 has order 4 where the mesh is graded
 * towards the layers, order p loses more than a digit with each two. */
Test(course, orders)
{
    double exact = hyperboloid(10, 6, 0.01, true, 1.8);
    double one = log2(clamped_error(1, 16, 0, exact) / clamped_error(1, 32, 0, exact)),
           two = log2(clamped_error(2, 8, 1.8, exact) / clamped_error(2, 16, 1.8, exact));
    HOLD({"exact", exact / 539.2507, 1 - 1e-7, 1 + 1e-7}, {"MITC4+", one, 1.8, 2.2},
         {"MITC9", two, 3.5, 4.5});
    for (int p = 4; p < 10; p += 2) {
        double before = clamped_error(p, 2, 1.8, exact), after = clamped_error(p + 2, 2, 1.8, exact);
        cr_assert(after < before / 10, "order %d: %g after %g", p + 2, after, before);
    }
}

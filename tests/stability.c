/* Second variations: of spheres in closed form, for the energies and the constraints of membranes; of vesicles against
 * what the literature says of where they lose stability; first variations against differences. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plan/variation.h"
#include "vesica/run.h"
#include "vesica/stability.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

TestSuite(stability, .timeout = 200);

static const double PI = 3.14159265358979323846;

static ves_problem *read(const char *text)
{
    char message[1000] = "";
    ves_problem *problem = NULL;
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_problem_read_text("text.yaml", text, strlen(text), NULL, &problem, diag);
    if (status != VES_OK) ves_diag_text(diag, 0, message, sizeof message);
    cr_assert(status == VES_OK, "%s", message);
    ves_diag_destroy(diag);
    return problem;
}

static ves_stability find(const ves_problem *problem, const ves_stability_options *options)
{
    ves_stability found;
    char message[1000] = "";
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_stability_find(problem, options, &found, diag);
    if (status != VES_OK) ves_diag_text(diag, 0, message, sizeof message);
    cr_assert(status == VES_OK, "%d %s", status, message);
    ves_diag_destroy(diag);
    return found;
}

/* --- spheres --- */

#define SPHERE(x, y, z)                                                                                      \
    "vesica: 1\npatches:\n  ball: {surface: {formula: [\"" x "\", \"" y "\", \"" z                           \
    "\"]}, domain: {u: [0, pi]}}\n"                                                                          \
    "shape: {closed: true}\nquadrature: {u: 16, v: 8}\n"
#define UNIT_SPHERE SPHERE("sin(u)*cos(v)", "sin(u)*sin(v)", "cos(u)")

/* Displaced by w = a Y_l, a unit sphere has, beyond the first order, the following times a^2:
 *     area 1 + l(l+1)/2,  volume 1,  integral of H: l(l+1)/2,  1/2 integral of 4 H^2: (l-1) l (l+1) (l+2) / 2,
 * and at the first, in integrals of w: 2, 1, 1, 0. They vanish together for l = 1 where w only moves it, but for what
 * moving it by a second order does at the first. */
static double willmore_of(int l)
{
    return (l - 1) * l * (l + 1) * (l + 2) / 2.;
}

static double free_sphere(int l, double c)
{
    (void)c;
    return willmore_of(l);
}

/* canham {c0: c}, area held: tension. -2 c integral H + c^2 A / 2 has the slope -2 c + c^2 = 2 lambda. */
static double tense_sphere(int l, double c)
{
    const double L = l * (l + 1) / 2., lambda = (-2 * c + c * c) / 2;
    return willmore_of(l) - 2 * c * L + (c * c / 2 - lambda) * (1 + L);
}

/* canham {c0: c}, volume held: pressure. The same slope is lambda. */
static double pressed_sphere(int l, double c)
{
    const double L = l * (l + 1) / 2., lambda = -2 * c + c * c;
    return willmore_of(l) - 2 * c * L + c * c / 2 * (1 + L) - lambda;
}

/* ade {alpha: 1, m0: c}, area held: 8 pi^2 (M - c)^2, M = integral H / (4 pi) while the area is that of the sphere. */
static double bilayer_sphere(int l, double c)
{
    const double L = l * (l + 1) / 2., slope = 4 * PI * (1 - c), lambda = slope / 2;
    return willmore_of(l) + slope * L - lambda * (1 + L);
}

/* (E + trap integral x^2) with the area held, the trap's centre in the middle: where it stands is no longer free. Displaced,
 * integral x^2 has 4 and 6 + l(l+1)/2; lambda is 2. */
static double trapped_sphere(int l, double c)
{
    const double L = l * (l + 1) / 2.;
    return willmore_of(l) + c * (6 + L - 2 * (1 + L));
}

static const struct sphere {
    const char *text;
    double (*second)(int l, double c);
    double c;
} SPHERES[] = {
    {UNIT_SPHERE "measures: {E: {canham: {}}}\nminimize: E/(8*pi)\n", free_sphere, 0},
    {UNIT_SPHERE "measures: {E: {willmore: {}}}\nminimize: 2*E/(8*pi)\n", free_sphere, 0},
    {UNIT_SPHERE "measures: {E: {willmore: {}}}\nmaximize: -E/(4*pi)\n", free_sphere, 0},
    {UNIT_SPHERE "measures: {E: {canham: {c0: 2.3}}}\nminimize: E/(8*pi)\nscale: {equation: area == 4*pi}\n",
     tense_sphere, 2.3},
    {UNIT_SPHERE "measures: {E: {canham: {c0: 7}}}\nminimize: E/(8*pi)\nconstraints: [area == 4*pi]\n",
     tense_sphere, 7},
    {UNIT_SPHERE "measures: {E: {canham: {reduced_c0: 1.7}}}\nminimize: E/(8*pi)\n", tense_sphere, 1.7},
    {UNIT_SPHERE "measures: {E: {canham: {c0: -1.4}}}\nminimize: E/(8*pi)\nconstraints: [volume == 4*pi/3]\n",
     pressed_sphere, -1.4},
    {UNIT_SPHERE
     "measures: {E: {ade: {alpha: 1, m0: 1.8}}}\nminimize: E/(8*pi)\nscale: {equation: area == 4*pi}\n",
     bilayer_sphere, 1.8},
    {UNIT_SPHERE
     "measures: {E: {canham: {}}, T: {integral: \"x^2 + y^2 + z^2\"}}\nminimize: (E + 0.4*T)/(8*pi)\n"
     "scale: {equation: area == 4*pi}\n",
     trapped_sphere, 0.4},
};

/* Eigenvalues of n: l = n, n + 1, ..., but for the size (l = 0) and where it stands (l = 1). */
static void sphere_check(const struct sphere *s, const ves_stability *found)
{
    for (int n = 0; n < found->modes; n++)
        for (int k = 0; k < found->mode[n].values; k++) {
            const int first = s->second == trapped_sphere ? 1 : 2, l = (n < first ? first : n) + k;
            const double want = 2 * s->second(l, s->c) / (8 * PI), got = found->mode[n].value[k];
            cr_expect(fabs(got - want) < 1e-7 * fmax(1, fabs(want)), "%s\nn = %d, l = %d: %.10f, want %.10f",
                      s->text, n, l, got, want);
            cr_expect(found->mode[n].error[k] < 1e-5 * fmax(1, fabs(want)), "%s\nn = %d: an error of %g",
                      s->text, n, found->mode[n].error[k]);
        }
}

Test(stability, spheres_in_closed_form)
{
    for (size_t k = 0; k < sizeof SPHERES / sizeof *SPHERES; k++) {
        const struct sphere *s = &SPHERES[k];
        ves_problem *problem = read(s->text);
        ves_stability found = find(problem, NULL);
        cr_expect(found.modes == 5 && found.relaxed && fabs(found.radius - 1) < 1e-12 && found.moved < 1e-8,
                  "%s", s->text);
        sphere_check(s, &found);
        const bool unstable = s->second(2, s->c) < 0;
        cr_expect(found.firmness == (unstable ? VES_UNSTABLE : VES_FIRM), "%s\nis %s", s->text,
                  ves_firmness_text(found.firmness));
        ves_problem_destroy(problem);
    }
}

/* From a spheroid about another axis Newton's method finds the sphere. */
Test(stability, the_stationary_shape_is_found_about_any_axis)
{
    static const char *const text[] = {
        SPHERE("1.12*cos(u)", "0.95*sin(u)*cos(v)", "0.95*sin(u)*sin(v)"),
        SPHERE("3 + (0.95*cos(u) + 1.1*sin(u)*cos(v))/sqrt(2)", "(0.95*cos(u) - 1.1*sin(u)*cos(v))/sqrt(2)",
               "1.1*sin(u)*sin(v)"),
    };
    for (size_t k = 0; k < 2; k++) {
        char whole[1000];
        const struct sphere s = {whole, free_sphere, 0};
        snprintf(whole, sizeof whole,
                 "%smeasures: {E: {canham: {}}}\nminimize: E/(8*pi)\nscale: {equation: area == 4*pi}\n",
                 text[k]);
        ves_problem *problem = read(whole);
        ves_stability found = find(problem, NULL);
        cr_expect(found.relaxed && fabs(found.stationary - 1) < 1e-9, "%.12f", found.stationary);
        cr_expect(found.objective > 1.001 && found.moved > 0.02, "%.12f, %g away", found.objective,
                  found.moved);
        sphere_check(&s, &found);
        ves_problem_destroy(problem);
    }
}

/* --- vesicles --- */

static ves_stability vesicle(const char *file, double nu, int modes)
{
    char path[300], value[32];
    ves_problem *problem = NULL;
    ves_run *run = NULL;
    snprintf(path, sizeof path, "%s/problems/vesicle/%s.yaml", VESICA_SOURCE, file);
    snprintf(value, sizeof value, "%g", nu);
    const ves_override set = {"nu", value};
    const ves_read_options options = {.overrides = 1, .override = &set};
    cr_assert(ves_problem_read(path, &options, &problem, NULL) == VES_OK, "%s", path);
    cr_assert(ves_run_create(problem, NULL, NULL, &run, NULL) == VES_OK);
    cr_assert(run->feasible, "%s at %g", file, nu);
    for (int k = 0; k < problem->variables; k++)
        ((ves_variable *)problem->variable)[k].start = run->best.x[k];
    ves_stability found = find(problem, &(ves_stability_options){.counted = true, .modes = modes});
    cr_expect(found.relaxed, "%s at %g: no stationary shape", file, nu);
    ves_run_destroy(run);
    ves_problem_destroy(problem);
    return found;
}

/* The least energies of tests/vesicle.c, which come from elsewhere. */
Test(stability, the_stationary_shape_of_a_vesicle_is_the_exact_one)
{
    static const struct {
        const char *file;
        double nu, energy, part;
    } list[] = {{"discocyte", 0.6, 1.95568027, 1e-7},
                {"prolate", 0.8, 1.38744043, 2e-8},
                {"dumbbell", 0.762, 0.22325963, 2e-7}};
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        ves_stability found = vesicle(list[k].file, list[k].nu, 2);
        cr_expect(fabs(found.stationary / list[k].energy - 1) < list[k].part, "%s: %.9f, exactly %.8f",
                  list[k].file, found.stationary, list[k].energy);
        cr_expect(found.firmness == VES_FIRM, "%s is %s", list[k].file, ves_firmness_text(found.firmness));
    }
}

/* Where a straight line through two values is 0. */
static double root(double a, double fa, double b, double fb)
{
    return a - fa * (b - a) / (fb - fa);
}

/* [Seifert, Berndl, Lipowsky 1991]: oblates are metastable from v = 0.51, where they turn into stomatocytes by a mode
 * that is not symmetric up and down, to 0.75, where a mode n = 2 leads to triaxial shapes and prolates. */
Test(stability, oblates_lose_it_at_both_ends)
{
    ves_stability a = vesicle("discocyte", 0.53, 2), b = vesicle("discocyte", 0.52, 2);
    const double low = root(0.53, a.mode[0].value[0], 0.52, b.mode[0].value[0]);
    cr_expect(fabs(low - 0.51) < 0.005, "%f", low);
    cr_expect(a.mode[0].parity[0] < -0.99 && a.firmness == VES_FIRM && b.firmness == VES_FIRM);
    a = vesicle("discocyte", 0.745, 2), b = vesicle("discocyte", 0.755, 2);
    const double high = root(0.745, a.mode[2].value[0], 0.755, b.mode[2].value[0]);
    cr_expect(fabs(high - 0.75) < 0.005, "%f", high);
    cr_expect(a.firmness == VES_FIRM && b.firmness == VES_UNSTABLE && b.softest == 2);
}

/* --- first variations --- */

static const char LOPSIDED[] =
    "vesica: 1\nvariables: {a: [0, 1.1, 3]}\nparameters: {c: 0.7}\ncurves:\n"
    "  north: {point: [0, 0, 0.9]}\n  south: {point: [0, 0, -0.8]}\n  rim: {circle: {radius: 1}}\n"
    "  out: {formula: [\"cos(v)\", \"sin(v)\", \"0\"]}\n  back: {like: out, apply: [{dilate: -1}]}\n"
    "  down: {formula: [\"0.3*cos(v)\", \"0.3*sin(v)\", \"-1.2\"]}\n"
    "patches:\n"
    "  top: {operator: {power: 2, a: a}, conditions: [{u: 0, position: north}, {u: 0, derivative: 1, field: "
    "out, "
    "scale: 1.3}, {u: 1, position: rim}, {u: 1, derivative: 1, field: down}]}\n"
    "  bottom: {operator: {power: 2, a: 1}, conditions: [{u: 0, position: rim}, {u: 0, derivative: 1, field: "
    "down}, "
    "{u: 1, position: south}, {u: 1, derivative: 1, field: back}]}\n"
    "shape: {closed: true}\nquadrature: {u: 16, v: 24}\nvalidity: {self_intersection: never}\n"
    "measures:\n  E: {canham: {reduced_c0: c}}\n  D: {ade: {alpha: 1.4, m0: 1.1}}\n  W: {adhesion: {at: "
    "[0.1, 0.2, "
    "-1.1], normal: [0.3, 0.1, 1], w: 0.8, range: 0.4}}\n  M: {area_difference: {}}\n"
    "minimize: E + 0.3*D*M + W\nconstraints: [reduced_volume == 0.8, area <= 99, volume*area == 30]\n";

/* In the variables of the file: x^2 + 2 y^2 + z with z == 3 x^2 - y^2 is 4 x^2 + y^2 where the equation holds. Units are the
 * ranges, 20. */
Test(stability, the_variables_have_a_hessian_of_their_own)
{
    static const char text[] =
        "vesica: 1\nvariables: {x: [-10, 0, 10], y: [-10, 0, 10], z: [-10, 0, 10]}\n"
        "patches:\n  ball: {surface: {formula: [\"sin(u)*cos(v)\", \"sin(u)*sin(v)\", \"cos(u)\"]}, domain: "
        "{u: [0, "
        "pi]}}\nshape: {closed: true}\nquadrature: {u: 16, v: 8}\nminimize: x^2 + 2*y^2 + z + willmore\n"
        "constraints: [\"z == 3*x^2 - y^2\"]\n";
    ves_problem *problem = NULL;
    ves_stability found;
    const ves_stability_options options = {.counted = true, .modes = 0, .functions = 12};
    cr_assert(ves_problem_read_text("v.yaml", text, strlen(text), NULL, &problem, NULL) == VES_OK);
    cr_assert(ves_stability_find(problem, &options, &found, NULL) == VES_OK);
    cr_expect(found.values == 2 && fabs(found.own[0] / (2 * 400.) - 1) < 1e-6 &&
                  fabs(found.own[1] / (8 * 400.) - 1) < 1e-6,
              "%d: %g %g", found.values, found.own[0], found.own[1]);
    cr_expect(found.own_along[0] == 1 && found.own_along[1] == 0 && found.flat == 0);
    ves_problem_destroy(problem);
}

/* A sphere that can be drawn out, by e P_2(cos u): its mode n = 0, l = 2, by e = 1 is sqrt(5 / (4 pi)) of that. Of n = 2 it
 * can make nothing. */
Test(stability, a_mode_is_a_change_of_the_variables)
{
    static const char text[] =
        "vesica: 1\nvariables: {e: [-0.5, 0, 0.5], idle: [-1, 0, 1]}\npatches:\n  ball: {surface: {formula: "
        "[\"(1+e*(1.5*cos(u)^2-0.5))*sin(u)*cos(v)\", \"(1+e*(1.5*cos(u)^2-0.5))*sin(u)*sin(v)\", "
        "\"(1+e*(1.5*cos(u)^2-0.5))*cos(u)\"]}, domain: {u: [0, pi]}}\nshape: {closed: true}\n"
        "quadrature: {u: 16, v: 8}\nscale: {equation: area == 4*pi}\nmeasures: {E: {canham: {reduced_c0: "
        "7}}}\n"
        "minimize: E/(8*pi) + idle^2\n";
    const double pi = 3.14159265358979323846, amplitude = sqrt(5 / (4 * pi));
    ves_problem *problem = NULL;
    ves_stability found;
    double change[2];
    ves_stability_options options = {
        .counted = true, .modes = 2, .functions = 18, .change = change, .along = 0};
    cr_assert(ves_problem_read_text("p.yaml", text, strlen(text), NULL, &problem, NULL) == VES_OK);
    cr_assert(ves_stability_find(problem, &options, &found, NULL) == VES_OK);
    cr_expect(found.followed == 0 && fabs(found.made - 1) < 1e-6, "%d %.9f", found.followed, found.made);
    cr_expect(fabs(fabs(change[0]) / amplitude - 1) < 1e-6 && change[1] == 0, "%g %g, want %g", change[0],
              change[1], amplitude);
    options.along = 2;
    cr_assert(ves_stability_find(problem, &options, &found, NULL) == VES_OK);
    cr_expect(found.followed == 2 && found.made < 1e-9, "%d %g", found.followed, found.made);
    ves_problem_destroy(problem);
}

Test(stability, first_variations_of_every_measure_are_exact)
{
    ves_problem *problem = read(LOPSIDED);
    ves_plan *plan = NULL;
    ves_arena arena = {0};
    plan_variation v;
    cr_assert(ves_plan_loose(problem, (int[]){24, 28}, &plan, NULL) == VES_OK);
    cr_assert(ves_plan_forward(plan, plan->start, 0, PROGRAM_JUDGE, true) == VES_OK);
    cr_assert(ves_variation_create(plan, 9, &arena, &v, NULL) == VES_OK);
    cr_assert(v.conditions == 2 && v.functions == 10);
    for (int n = 0; n <= 3; n++) {
        const double by[2] = {0.7, -1.3}, h = 1e-4;
        double slope[10], value[4], missed[4][2];
        ves_variation_mode(&v, n);
        for (int k = 0; k < 10; k++)
            v.even[k] = 0.01 * sin(3 * k + n) / (1 + k * k), v.wave[k] = 0.01 * cos(k) / (1 + k * k);
        cr_assert(ves_variation_value(&v, &value[0], missed[0]) == VES_OK);
        cr_assert(ves_variation_slope(&v, 0.9, by, slope) == VES_OK);
        for (int k = 0; k < 10; k++) {
            const double at = v.wave[k];
            double sum = 0;
            for (int e = 0; e < 4; e++) {
                static const double place[] = {1, -1, 2, -2}, weight[] = {8, -8, -1, 1};
                v.wave[k] = at + place[e] * h;
                cr_assert(ves_variation_value(&v, &value[e], missed[e]) == VES_OK);
                sum += weight[e] * (0.9 * value[e] + by[0] * missed[e][0] + by[1] * missed[e][1]);
            }
            v.wave[k] = at;
            /* the fourth difference of functions that bend k^2 times as much, and the rounding of sums near 30 */
            cr_expect(fabs(sum / (12 * h) - slope[k]) < 1e-7 * (1 + fabs(slope[k])),
                      "n = %d, %d: %.10f, %.10f", n, k, slope[k], sum / (12 * h));
        }
    }
    ves_plan_destroy(plan);
    ves_arena_destroy(&arena);
    ves_problem_destroy(problem);
}

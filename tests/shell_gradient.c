/* Gradients of the measures of shells in the variables of a problem, against differences of fourth order. */
#include <criterion/criterion.h>

#include <math.h>
#include <stdio.h>

#include "bed.h"

enum { MOST = 12, TEXT = 6000 };

/* Of the range. What is left of fourth order is 1e-11 times a fifth derivative; a solution's rounding, 1e-13 and more
 * where walls are thin, over the step 1e-10: 1e-7 for what is read of one, or the sum of one. A power mean has a kink
 * where the two surfaces change places (1e-6), and factors of buckling are found to 1e-8 (1e-5). */
static const double STEP = 2e-3;

typedef struct trial {
    const char *name, *text; /* up to `minimize:` */
    struct {
        const char *measure;
        double close; /* of the largest entry times its range */
    } use[MOST];
} trial;

/* A pot between two rings, of revolution or ridged or oval: one text, with what varies. */
#define POT(variables, ridge, oval, parts, rest)                                                             \
    "vesica: 1\n"                                                                                            \
    "variables: {a: [0.5, 1.2, 2], w1: [0.6, 0.9, 1.3], w2: [0.6, 1, 1.3], up: [0.2, 0.5, 0.8]" variables    \
    "}\n"                                                                                                    \
    "curves:\n"                                                                                              \
    "  base: {circle: {radius: 0.8, axis: [0, 1, 0]}}\n"                                                     \
    "  rim: {circle: {radius: 1, axis: [0, 1, 0], centre: [0, 1.2, 0]}}\n"                                   \
    "  d1: {circle: {radius: 1, axis: [0, 1, 0]}, apply: [{dilate: [w1, 1, w1" oval "]}" ridge               \
    ", {translate: [0, -up, 0]}]}\n"                                                                         \
    "  d2: {circle: {radius: 1, axis: [0, 1, 0]}, apply: [{dilate: [w2, 1, w2]}, {translate: [0, 1.7, "      \
    "0]}]}\n"                                                                                                \
    "  lip: {circle: {radius: 1.2, axis: [0, 1, 0], centre: [0, 1.1 + 0.2*up, 0]}}\n"                        \
    "patches:\n"                                                                                             \
    "  bowl:\n"                                                                                              \
    "    operator: {power: 2, a: a}\n"                                                                       \
    "    conditions:\n"                                                                                      \
    "      - {u: 0, position: base}\n"                                                                       \
    "      - {u: 1, position: rim}\n"                                                                        \
    "      - {u: 0, derivative: 1, from: d1, to: base, scale: 1}\n"                                          \
    "      - {u: 1, derivative: 1, from: rim, to: d2, scale: 1}\n"                                           \
    "  flange:\n"                                                                                            \
    "    operator: {power: 1, a: 0}\n"                                                                       \
    "    conditions: [{u: 0, position: rim}, {u: 1, position: lip}]\n"                                       \
    "shell:\n"                                                                                               \
    "  parts: {" parts "}\n"                                                                                 \
    "  supports: [{at: base, fix: all}]\n" rest "quadrature: {u: 8, v: 16}\n"

#define PUSHED                                                                                               \
    "  material: {E: 1e6*(1 + 0.1*up), nu: 0.3}\n"                                                           \
    "  cases: {push: [{at: rim, line: [0.1*x, -3*(1 + 0.2*w2), 0.1*z]}]}\n"
#define SEVERAL                                                                                              \
    "  material: {E: 1e6, nu: 0.25 + 0.1*up, density: 2 + w1, shear: 0.7 + 0.1*w2}\n"                        \
    "  cases:\n"                                                                                             \
    "    one: [{at: lip, force: [0, -9*w1, 0]}, {gravity: [0, -2*w2, 0]}]\n"                                 \
    "    two: [{over: [bowl], pressure: 3 + y*w1}, {over: [flange], area: [0.2*x, -w2*u, 0.2*z]}]\n"

static const trial TRIALS[] = {
    {"a strip of revolution",
     POT(", t: [0.01, 0.02, 0.03]", "", "", "bowl: {thickness: t}", PUSHED),
     {{"displacement: {}", 1e-7},
      {"displacement: {at: rim}", 1e-7},
      {"displacement: {at: rim, along: [0.3*w1, 1, 0.3*w1]}", 1e-7},
      {"compliance: {}", 1e-7},
      {"max_shear: {}", 1e-7},
      {"max_shear: {where: y > 4*thickness and y < 1.2 - thickness*w1}", 1e-7},
      {"max_shear: {smooth: 8}", 1e-6},
      {"von_mises: {}", 1e-7},
      {"von_mises: {through: middle, smooth: 6 + w1}", 1e-6},
      {"buckling: {}", 1e-5}}},
    {"a ridged sector",
     POT(", c: [-0.1, 0.05, 0.1]", ", {ridge: {points: 16, by: c, along: radial}}", "",
         "bowl: {thickness: 0.02}", "  mesh: {order: 6, elements: [2, 24]}\n" PUSHED),
     {{"displacement: {}", 1e-7},
      {"compliance: {}", 1e-7},
      {"max_shear: {where: u > 0.1*w1 and u < 0.9}", 1e-7},
      {"von_mises: {smooth: 10}", 1e-6}}},
    {"a quarter",
     POT(", o: [0, 0.2, 0.4]", "", " + o", "bowl: {thickness: 0.02}",
         "  mesh: {order: 6, elements: [2, 8]}\n" PUSHED),
     {{"displacement: {at: rim, along: [0, 1, 0]}", 1e-7},
      {"compliance: {}", 1e-7},
      {"max_shear: {}", 1e-7},
      {"von_mises: {smooth: 8}", 1e-6}}},
    {"two parts with a fold, two cases",
     POT(", t: [0.01, 0.02, 0.03]", "", " + 0.1*t",
         "bowl: {thickness: t*(1 + 0.2*u*w1 + 0.1*y)}, flange: {thickness: 0.02*w2, elements: [1, 8]}",
         "  mesh: {order: 6, elements: [2, 8]}\n" SEVERAL),
     {{"displacement: {case: one}", 1e-7},
      {"displacement: {case: two, at: lip}", 1e-7},
      {"compliance: {case: one}", 1e-7},
      {"compliance: {case: two}", 1e-7},
      {"max_shear: {case: two, where: y > 0.2}", 1e-7},
      {"von_mises: {case: one, through: surfaces}", 1e-7}}},
    {"a sheet of MITC9, whole, in the shell's own size",
     "vesica: 1\n"
     "variables: {p: [0.5, 1, 1.5], q: [0.5, 0.8, 1], k: [1, 2, 3]}\n"
     "patches:\n"
     "  roof:\n"
     "    surface: {formula: [\"2*u - 0.3*v*q\", \"p*(1 - u)*u + 0.2*q*v^2\", \"v*(1 + 0.2*u)\"]}\n"
     "    periodic: false\n"
     "    domain: {u: [0, 1], v: [0, 1]}\n"
     "places: {mid: {patch: roof, u: 0.5, v: pi}, end: {patch: roof, u: 1, v: pi}}\n"
     "scale: {equation: area == 2 + q}\n"
     "shell:\n"
     "  parts: {roof: {thickness: 0.05*(1 + 0.3*x*k)}}\n"
     "  material: {E: 1e5, nu: 0.3, density: 1}\n"
     "  mesh: {order: 2, elements: [6, 4]}\n"
     "  supports: [{at: roof.u0, fix: pinned}, {at: roof.v0, spring: [300*k, 200*p, 100]}, {at: end, fix: "
     "y}, "
     "{at: end, spring: [20*q, 30, 40*k]}]\n"
     "  cases: {all: [{at: mid, force: [1, -5*p, k]}, {at: roof.v1, force: [0, q, -k]}, {at: roof.u1, line: "
     "[x, 0.1*k, z*y]}]}\n"
     "quadrature: {u: 8, v: 8}\n",
     {{"displacement: {at: mid, along: [1, p, 0]}", 1e-7},
      {"displacement: {}", 1e-7},
      {"displacement: {at: roof.v1, along: [0, 1, q]}", 1e-7},
      {"compliance: {}", 1e-7},
      {"max_shear: {where: \"x > 0.3*p or z > 0.7*k\"}", 1e-7},
      {"von_mises: {smooth: 7}", 1e-6},
      {"buckling: {}", 1e-5}}},
    {"buckling of a ridged sector",
     POT(", c: [0.02, 0.06, 0.1]", ", {ridge: {points: 16, by: c, along: radial}}", "",
         "bowl: {thickness: 0.02*w2}", "  mesh: {order: 6, elements: [2, 24]}\n" PUSHED),
     {{"buckling: {}", 1e-5}}},
    {"buckling of a quarter with a fold",
     POT(", o: [0.1, 0.2, 0.4]", "", " + o",
         "bowl: {thickness: 0.02*w2}, flange: {thickness: 0.01, elements: [1, 8]}",
         "  mesh: {order: 6, elements: [2, 8]}\n" PUSHED),
     {{"buckling: {}", 1e-5}}},
};

static bed bed_of(const trial *t, const char *measure)
{
    static char text[TEXT];
    int length = snprintf(text, sizeof text, "%smeasures: {m: {%s}}\nminimize: m\n", t->text, measure);
    cr_assert(length < TEXT);
    return bed_with(text, NULL, 0, 0);
}

static double along(const bed *b, double *x, int k, double h)
{
    double keep = x[k], up, down, up2, down2;
    x[k] = keep + h, up = value_at(b, x), x[k] = keep - h, down = value_at(b, x);
    x[k] = keep + 2 * h, up2 = value_at(b, x), x[k] = keep - 2 * h, down2 = value_at(b, x);
    x[k] = keep;
    return (8 * (up - down) - (up2 - down2)) / (12 * h);
}

static void compare(const trial *t, const char *measure, double close)
{
    bed b = bed_of(t, measure);
    double x[MOST], g[MOST], error[MOST], size = 0, worst = 0;
    int n = b.problem->variables;
    for (int k = 0; k < n; k++) x[k] = b.problem->variable[k].start;
    ves_verdict verdict = {.gradient = g};
    const ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
    cr_assert(ves_plan_evaluate(b.plan, &ask, &verdict) == VES_OK && verdict.status == VES_OK, "%s",
              ves_status_text(verdict.status));
    for (int k = 0; k < n; k++) {
        double range = b.problem->variable[k].max - b.problem->variable[k].min;
        size = fmax(size, fabs(g[k] * range));
        error[k] = fabs(along(&b, x, k, STEP * range) - g[k]) * range;
    }
    for (int k = 0; k < n; k++) worst = fmax(worst, error[k] / size);
    cr_log_info("%s, %s: %.9g, gradient %.3g, off by %.1e", t->name, measure, verdict.value, size, worst);
    for (int k = 0; k < n; k++)
        cr_expect(error[k] <= close * size, "%s, %s: by %s %.12g, off by %.2e of %.3g", t->name, measure,
                  b.problem->variable[k].name, g[k], error[k], size);
    bed_clear(&b);
}

Test(shell_gradient, agrees_with_differences)
{
    for (size_t k = 0; k < sizeof TRIALS / sizeof *TRIALS; k++)
        for (int m = 0; TRIALS[k].use[m].measure; m++)
            compare(&TRIALS[k], TRIALS[k].use[m].measure, TRIALS[k].use[m].close);
}

/* Elements of order 1 have none, whatever reads them, and say so; what reads no solution has its own. */
Test(shell_gradient, absent_of_order_1)
{
    static const char *const measure[] = {"compliance: {}", "mass: {}"};
    for (int k = 0; k < 2; k++) {
        const trial t = {.text = POT("", "", "", "bowl: {thickness: 0.02}",
                                     "  mesh: {order: 1, elements: [4, 8]}\n"
                                     "  material: {E: 1e6, nu: 0.3, density: 1}\n"
                                     "  cases: {push: [{at: rim, line: [0, -3, 0]}]}\n")};
        bed b = bed_of(&t, measure[k]);
        double g[MOST];
        ves_verdict verdict = {.gradient = g};
        const ves_ask ask = {
            .x = ves_plan_search(&b.plan, 1).start, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
        cr_assert(ves_plan_search(&b.plan, 1).gradients == (k == 1));
        cr_assert(ves_plan_evaluate(b.plan, &ask, &verdict) == (k ? VES_OK : VES_ABSENT));
        bed_clear(&b);
    }
}

/* The way back leaves nothing behind: asked again, after another question, all is the same to the last bit. */
Test(shell_gradient, repeats_itself)
{
    const trial t = {.text = POT("", "", " + 0.01", "bowl: {thickness: 0.02}",
                                 "  mesh: {order: 6, elements: [2, 8]}\n" PUSHED
                                 "constraints: [c <= 1, d <= 1, e <= 1e3]\n")};
    bed b =
        bed_of(&t, "von_mises: {where: y > 0.1}}, c: {compliance: {}}, d: {displacement: {}}, e: {max_shear: "
                   "{smooth: 6}");
    const ves_search_problem pose = ves_plan_search(&b.plan, 1);
    double x[MOST], g[3][MOST], c[3][3], jacobian[3][3 * MOST];
    const int n = pose.n;
    for (int k = 0; k < 3; k++) {
        ves_verdict verdict = {.gradient = g[k], .constraint = c[k], .jacobian = jacobian[k]};
        for (int i = 0; i < n; i++) x[i] = pose.start[i] * (k == 1 ? 1.01 : 1);
        const ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
        cr_assert(ves_plan_evaluate(b.plan, &ask, &verdict) == VES_OK && verdict.status == VES_OK);
    }
    cr_assert(memcmp(g[0], g[2], sizeof *x * (size_t)n) == 0 &&
              memcmp(g[0], g[1], sizeof *x * (size_t)n) != 0);
    cr_assert(memcmp(jacobian[0], jacobian[2], sizeof *x * (size_t)(3 * n)) == 0);
    bed_clear(&b);
}

/* A constraint that reads the material is the one with the material's formula written out, to the last bit, and the
 * variable of which the material is made drives it. */
Test(shell_gradient, goes_through_the_material)
{
#define BOUND(limit)                                                                                         \
    POT("", "", "", "bowl: {thickness: 0.02}",                                                               \
        "  mesh: {order: 6, elements: [2, 8]}\n" PUSHED "constraints: [a <= " limit "]\n")
    const trial t[2] = {{.text = BOUND("material.E*w1 + material.nu")},
                        {.text = BOUND("1e6*(1 + 0.1*up)*w1 + 0.3")}};
    double g[MOST], c[2], jacobian[2][MOST];
    int n = 0;
    for (int k = 0; k < 2; k++) {
        bed b = bed_of(&t[k], "compliance: {}");
        const ves_search_problem pose = ves_plan_search(&b.plan, 1);
        ves_verdict verdict = {.gradient = g, .constraint = &c[k], .jacobian = jacobian[k]};
        const ves_ask ask = {.x = pose.start, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
        cr_assert(ves_plan_evaluate(b.plan, &ask, &verdict) == VES_OK && verdict.status == VES_OK);
        n = pose.n;
        bed_clear(&b);
    }
    cr_assert(memcmp(jacobian[0], jacobian[1], sizeof *g * (size_t)n) == 0 && c[0] == c[1]);
    cr_assert(jacobian[0][3] != 0, "up drives the limit");
}

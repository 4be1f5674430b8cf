/* Figures of whole problems: sheets that meet themselves, caps, poles, and which way a shape faces. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "bridge/bridge.h"
#include "problem/problem.h"
#include "surface/figure.h"
#include "vesica/plan.h"

static const double pi = 3.14159265358979323846;

/* Rounding of sums over a grid, relative. */
static const double rounding = 1e-11;

typedef struct bed {
    ves_problem *problem;
    ves_plan *plan;
    ves_diag *diag;
    ves_figure *figure;
} bed;

static bed bed_make(const char *text)
{
    bed b = {.diag = ves_diag_create()};
    ves_read_options options = {0};
    ves_status status = ves_problem_read_text("test.yaml", text, strlen(text), &options, &b.problem, b.diag);
    if (status == VES_OK) status = ves_plan_create(b.problem, &(ves_plan_options){{0, 0}}, &b.plan, b.diag);
    for (int k = 0; status != VES_OK && k < ves_diag_count(b.diag); k++) {
        char line[1000];
        ves_diag_text(b.diag, k, line, sizeof line);
        cr_log_error("%s", line);
    }
    cr_assert_eq(status, VES_OK, "%s\n%s", ves_status_text(status), text);
    return b;
}

static void bed_clear(bed *b)
{
    ves_figure_destroy(b->figure);
    ves_plan_destroy(b->plan);
    ves_problem_destroy(b->problem);
    ves_diag_destroy(b->diag);
}

static bool told(const bed *b, const char *words)
{
    char line[1000];
    for (int k = 0; k < ves_diag_count(b->diag); k++) {
        ves_diag_text(b->diag, k, line, sizeof line);
        if (strstr(line, words)) return true;
    }
    return false;
}

static double measured(const bed *b, const double *x, const char *name)
{
    ves_design design;
    ves_status status = ves_plan_measure(b->plan, x, 0, &design);
    cr_assert_eq(status, VES_OK, "%s", ves_status_text(status));
    for (int k = 0; k < b->problem->measures; k++)
        if (!strcmp(b->problem->measure[k].name, name)) return design.measure[k];
    cr_assert_fail("no measure %s", name);
    return NAN;
}

static ves_mesh_facts drawn(bed *b, const double *x, int nu, int nv)
{
    ves_mesh mesh;
    ves_mesh_facts facts;
    char message[VES_BRIDGE_TEXT];
    ves_figure_destroy(b->figure);
    cr_assert_eq(ves_plan_figure(b->plan, x, nu, nv, &b->figure, b->diag), VES_OK);
    cr_assert_eq(ves_figure_mesh(b->figure, true, &mesh), VES_OK);
    cr_assert_eq(ves_bridge_facts(&mesh, true, &facts, message), VES_OK, "%s", message);
    return facts;
}

static double distance(const ves_figure_patch *p, double *const plane[3], int a, int b)
{
    (void)p;
    return hypot(hypot(plane[0][a] - plane[0][b], plane[1][a] - plane[1][b]), plane[2][a] - plane[2][b]);
}

/* --- sheets that meet themselves --- */

#define RING(turn, more)                                                                                     \
    "vesica: 1\nvariables: {R: [1.5, 2, 3], t: [-3, 1.234, 3]}\npatches: {ring: {surface: {formula: "        \
    "[\"(R + 0.7*cos(v + " turn "))*cos(2*pi*u)\", \"(R + 0.7*cos(v + " turn ") + 0*t)*sin(2*pi*u)\", "      \
    "\"0.7*sin(v + " turn ")\"]}" more "}}\nshape: {closed: true}\nminimize: volume + mean_curvature\n"

static const char *const TORUS[] = {RING("0", ""),
                                    RING("t*u", ""), /* the ends are turned by t against each other */
                                    RING("0", ", periodic: false"), RING("2*pi*u", ", periodic: false")};

/* The mesh misses the volume by O(h^2), about (2 pi / nv)^2 / 6. */
Test(figure, a_torus_by_formula_is_closed)
{
    for (int k = 0; k < 4; k++) {
        bed b = bed_make(TORUS[k]);
        for (double turn = -2.3; turn < 2.5; turn += 1.57) {
            double x[2] = {2.2, turn}, want = 2 * pi * pi * 2.2 * 0.49;
            double got = measured(&b, x, "volume"), H = measured(&b, x, "mean_curvature");
            cr_expect(fabs(got - want) < rounding * want, "torus %d: volume %.15g want %.15g", k, got, want);
            cr_expect(fabs(H - 4 * pi * pi * 2.2 / 2) < 1e-9, "torus %d: mean curvature %.15g", k, H);
            ves_mesh_facts f = drawn(&b, x, 36, 48);
            cr_expect(f.closed && f.outward && f.components == 1 && f.crossings == 0,
                      "torus %d, turn %g: closed %d outward %d components %d crossings %d", k, turn, f.closed,
                      f.outward, f.components, f.crossings);
            cr_expect(fabs(f.volume - want) < 0.012 * want, "torus %d: mesh holds %g of %g", k, f.volume,
                      want);
            const ves_figure_patch *p = b.figure->patch;
            for (int s = 0; s < p->rows * p->columns; s++) {
                cr_assert(distance(p, p->X, s, p->same[s]) < 1e-12, "torus %d: node %d", k, s);
                cr_assert(distance(p, p->normal, s, p->same[s]) < 1e-12, "torus %d: normal %d", k, s);
                double du = ves_figure_u(p, s), v = ves_figure_v(p, s), c = p->X[2][s] / 0.7;
                double phase = v + (k == 1 ? turn * du : k == 3 ? 2 * pi * du : 0);
                cr_assert(fabs(c - sin(phase)) < 1e-12, "torus %d: node %d lies at its u, v", k, s);
            }
        }
        bed_clear(&b);
    }
}

/* Poles and a seam that the file does not call periodic. */
Test(figure, a_ball_by_formula_is_closed)
{
    bed b =
        bed_make("vesica: 1\npatches: {ball: {surface: {formula: [\"2*sin(pi*u)*cos(v)\", "
                 "\"2*sin(pi*u)*sin(v)\", \"2*cos(pi*u)\"]}, periodic: false}}\n"
                 "shape: {closed: true}\nmeasures: {h: {centroid: {of: volume}}}\nminimize: volume + h\n");
    cr_expect(fabs(measured(&b, NULL, "volume") - 32 * pi / 3) < 1e-9);
    ves_mesh_facts f = drawn(&b, NULL, 24, 32);
    cr_expect(f.closed && f.outward && f.components == 1 && f.crossings == 0);
    bed_clear(&b);
}

static const char KLEIN[] =
    "vesica: 1\npatches: {bottle: {surface: {formula: [\"(3 + cos(pi*u)*sin(v) - "
    "sin(pi*u)*sin(2*v))*cos(2*pi*u)\", \"(3 + cos(pi*u)*sin(v) - sin(pi*u)*sin(2*v))*sin(2*pi*u)\", "
    "\"sin(pi*u)*sin(v) + cos(pi*u)*sin(2*v)\"]}}}\nminimize: area\n";
static const char MOEBIUS[] =
    "vesica: 1\npatches: {band: {surface: {formula: [\"(1 + 0.3*(2*u - 1)*cos(v/2))*cos(v)\", \"(1 + "
    "0.3*(2*u "
    "- 1)*cos(v/2))*sin(v)\", \"0.3*(2*u - 1)*sin(v/2)\"]}, periodic: false}}\nminimize: area\n";
static const char MOEBIUS_ALONG[] =
    "vesica: 1\npatches: {band: {surface: {formula: [\"(1 + 0.3*w*cos(pi*u))*cos(2*pi*u)\", \"(1 + "
    "0.3*w*cos(pi*u))*sin(2*pi*u)\", \"0.3*w*sin(pi*u)\"]}, periodic: false}}\nminimize: area\n";

/* Such a surface has no outside: it is measured and written, open along the seam, and its points meet there.
 */
Test(figure, a_surface_with_one_side_is_left_open_and_told)
{
    char along[600], *w;
    strcpy(along, MOEBIUS_ALONG);
    for (w = along; (w = strstr(w, "*w*"));) { /* the width runs with v: w = v/pi - 1 */
        memmove(w + 10, w + 3, strlen(w + 3) + 1);
        memcpy(w, "*(v/pi-1)*", 10);
    }
    const char *const text[] = {KLEIN, MOEBIUS, along};
    for (int k = 0; k < 3; k++) {
        bed b = bed_make(text[k]);
        cr_expect(told(&b, "has one side only"));
        ves_mesh_facts f = drawn(&b, NULL, 24, 32);
        const ves_figure_patch *p = b.figure->patch;
        int meet = 0;
        cr_expect(p->one_sided && !f.closed && f.border_edges > 0);
        for (int s = 0; s < p->rows * p->columns; s++) {
            meet += p->same[s] != s;
            cr_assert(distance(p, p->X, s, p->same[s]) < 1e-12, "%d: node %d", k, s);
        }
        cr_expect_eq(meet, k == 1 ? p->rows : p->columns, "%d: %d nodes meet others", k, meet);
        bed_clear(&b);
    }
}

/* A gap that happens to be 0 at the start is no seam. */
Test(figure, what_meets_by_chance_is_not_joined)
{
    bed b = bed_make("vesica: 1\nvariables: {gap: [0, 0, 1], tip: [0, 0, 1]}\npatches:\n"
                     "  ring: {surface: {formula: [\"(2 + 0.7*cos(v))*cos((2*pi - gap)*u)\", \"(2 + "
                     "0.7*cos(v))*sin((2*pi - gap)*u)\", \"0.7*sin(v)\"]}}\n"
                     "  cone: {surface: {formula: [\"(u + tip)*cos(v)\", \"(u + tip)*sin(v)\", \"4 + u\"]}}\n"
                     "minimize: area + gap + tip\n");
    double x[2] = {0.3, 0.2};
    for (int k = 0; k < 2; k++) {
        ves_mesh_facts f = drawn(&b, x, 12, 16);
        cr_expect_eq(f.border_edges, 64, "got %d", f.border_edges);
        cr_expect(!b.figure->patch[0].ends_meet && !b.figure->patch[1].pole[0]);
        x[0] = x[1] = 1;
    }
    bed_clear(&b);
}

/* --- caps --- */

/* Rims that their middle does not see whole: a banana lying flat, and a bent one. */
#define BANANA(z, end)                                                                                       \
    "vesica: 1\nquadrature: {u: 16, v: 96}\ncurves:\n  low: {formula: [\"2*cos(v)\", \"0.4*sin(v) + "        \
    "1.2*cos(v)^2\", \"" z "\"]}\n"                                                                          \
    "  high: {like: low, apply: [{translate: [0, 0, 1.5]}, {rotate: {by: [0.3, 0.2, 0], about: centre}}]}\n" \
    "patches: {wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: " end "}]}}\n"               \
    "shape: {closed: true, caps: [wall.u0, wall.u1]}\nminimize: volume\n"

/* The volume that is measured and that of the mesh differ by what chords cut off, O(h^2): four times less on
 * a mesh twice as fine; 0.4 forgives the next order. */
Test(figure, caps_close_what_their_middle_does_not_see)
{
    for (int up = 0; up < 2; up++) {
        bed b = bed_make(up ? BANANA("0", "low}, {u: 1, position: high")
                            : BANANA("0", "high}, {u: 1, position: low"));
        double want = measured(&b, NULL, "volume"), miss[2];
        for (int k = 0; k < 2; k++) {
            ves_mesh_facts f = drawn(&b, NULL, 12 << k, 48 << k);
            cr_expect(f.closed && f.outward && f.crossings == 0, "closed %d outward %d crossings %d",
                      f.closed, f.outward, f.crossings);
            cr_expect(b.figure->patch->lid[0] && b.figure->patch->lid[1]);
            miss[k] = want - f.volume;
        }
        cr_expect(fabs(miss[0] / miss[1] - 4) < 0.4, "%g, then %g of %g", miss[0], miss[1], want);
        bed_clear(&b);
    }
}

/* A rim that lies in no plane keeps the fan, which is what the volume counts. */
Test(figure, bent_caps_are_the_fans_that_are_measured)
{
    bed b = bed_make(BANANA("0.2*cos(2*v)", "low}, {u: 1, position: high"));
    double want = measured(&b, NULL, "volume"), miss[2];
    for (int k = 0; k < 2; k++) {
        ves_mesh_facts f = drawn(&b, NULL, 12 << k, 48 << k);
        cr_expect(f.closed && !b.figure->patch->lid[0] && !b.figure->patch->lid[1]);
        miss[k] = want - f.volume;
    }
    cr_expect(fabs(miss[0] / miss[1] - 4) < 0.4, "%g, then %g of %g", miss[0], miss[1], want);
    bed_clear(&b);
}

/* --- poles --- */

static void check_near(const char *what, double got, double want, double tolerance)
{
    cr_expect(fabs(got - want) <= tolerance, "%s: got %.10g want %.10g", what, got, want);
}

/* z = -(a x^2 + b y^2) and a ball: H = a + b, K = 4 a b at the top, to rounding; at an umbilic k1 - k2 is the
 * root of that. */
Test(figure, poles_have_the_curvature_of_the_surface_there)
{
    static const double ab[3][2] = {{0.7, 0.2}, {0.5, -0.3}, {0.6, 0.6}};
    for (int k = 0; k < 3; k++) {
        char text[500];
        double a = ab[k][0], c = ab[k][1];
        snprintf(text, sizeof text,
                 "vesica: 1\npatches: {top: {surface: {formula: [\"u*cos(v)\", \"u*sin(v)\", "
                 "\"-u^2*(%g*cos(v)^2 + %g*sin(v)^2)\"]}}}\nminimize: area\n",
                 a, c);
        bed b = bed_make(text);
        drawn(&b, NULL, 12, 16);
        const ves_figure_patch *p = b.figure->patch;
        double side = p->normal[2][0], root = k == 2 ? 1e-6 : 1e-12;
        check_near("normal", fabs(side), 1, 1e-12);
        check_near("H", p->H[3] * side, a + c, 1e-12);
        check_near("K", p->K[3], 4 * a * c, 1e-12);
        check_near("k1", fmax(p->k1[3] * side, p->k2[3] * side), 2 * fmax(a, c), root);
        check_near("k2", fmin(p->k1[3] * side, p->k2[3] * side), 2 * fmin(a, c), root);
        bed_clear(&b);
    }
}

/* A dome whose formula has no slope at its rim, and a cone, which has no curvature at its tip: all that is
 * written is finite, and right where there is something to be right. */
Test(figure, blunt_rims_and_sharp_tips_are_finite)
{
    bed b =
        bed_make("vesica: 1\npatches:\n  dome: {surface: {formula: [\"u*cos(v)\", \"u*sin(v)\", \"sqrt(1 - "
                 "u^2)\"]}}\n  cone: {surface: {formula: [\"u*cos(v)\", \"u*sin(v)\", \"3 - u\"]}}\n"
                 "minimize: area\n");
    drawn(&b, NULL, 12, 16);
    for (int k = 0; k < 2; k++) {
        const ves_figure_patch *p = &b.figure->patch[k];
        for (int s = 0; s < p->rows * p->columns; s++) {
            double n = hypot(hypot(p->normal[0][s], p->normal[1][s]), p->normal[2][s]);
            cr_assert(fabs(n - 1) < 1e-12, "patch %d node %d: normal %g", k, s, n);
            cr_assert(isfinite(p->H[s] + p->K[s] + p->k1[s] + p->k2[s]), "patch %d node %d", k, s);
            if (k == 0) check_near("ball", p->H[s], 1, 1e-6);
            if (k == 1) cr_assert(p->H[s] < 9 && p->normal[2][s] > 0.7, "node %d: H %g", s, p->H[s]);
        }
    }
    bed_clear(&b);
}

/* --- rings whose axis varies --- */

/* A tube between an ellipse that stays and one whose whole axis varies: what it is at x does not depend on
 * where the search began, be it on the other side of a change of nearest coordinate axis, or opposite to it.
 */
Test(figure, the_same_numbers_give_the_same_shape_whatever_the_start)
{
    static const double start[4][3] = {{0.1, 0.2, 0.9}, {1, 0.1, 0.2}, {0, -1, 0.1}, {0, 0, -0.5}};
    static const double x[3] = {0.5, -0.3, 0.8};
    double want = 0;
    for (int k = 0; k < 4; k++) {
        char text[600];
        snprintf(text, sizeof text,
                 "vesica: 1\nquadrature: {u: 16, v: 32}\nvariables: {a: [-1, %g, 1], b: [-1, %g, 1], c: "
                 "[-0.5, %g, "
                 "1]}\ncurves: {low: {ellipse: {radii: [1, 0.6]}}, high: {ellipse: {radii: [0.7, 1.1], "
                 "centre: [0, 0, "
                 "3], axis: [a, b, c]}}}\npatches: {wall: {operator: {power: 1}, conditions: [{u: 0, "
                 "position: low}, "
                 "{u: 1, position: high}]}}\nvalidity: {jacobian: any}\nminimize: area + bending\n",
                 start[k][0], start[k][1], start[k][2]);
        bed b = bed_make(text);
        double got = measured(&b, x, "bending");
        if (!k) want = got;
        cr_expect(fabs(got - want) <= rounding * want, "start %d: %.15g, another %.15g", k, got, want);
        bed_clear(&b);
    }
}

/* --- which way a shape faces --- */

/* Three formulas of a point, each moved by  m X + t. */
static void move(char *out, size_t room, const char *const f[3], const double m[3][3], const double t[3])
{
    size_t at = 0;
    for (int r = 0; r < 3; r++)
        at += (size_t)snprintf(out + at, room - at, "%s\"%.17g*(%s) + %.17g*(%s) + %.17g*(%s) + %.17g\"",
                               r ? ", " : "", m[r][0], f[0], m[r][1], f[1], m[r][2], f[2], t[r]);
}

static const char *const BODY[][3] = {
    {"(1 + 0.3*u)*cos(v)", "(1 + 0.3*u)*sin(v)", "2*u"},              /* a tube */
    {"u*cos(v)", "u*sin(v)", "0.2*u^2"},                              /* a shallow bowl */
    {"sin(1 + u)*cos(v)", "sin(1 + u)*sin(v)", "cos(1 + u) + 0.1*u"}, /* a zone of a ball */
};

static const double MOTION[][3][3] = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},          {{0, -0.8, 0.6}, {1, 0, 0}, {0, 0.6, 0.8}}, /* a mirror */
    {{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}},                                                     /* another */
    {{0.6, 0, 0.8}, {0, 1, 0}, {-0.8, 0, 0.6}}, {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
};

/* Open shapes: the sign of H does not depend on where they stand, how they are turned, or which hand they
 * have; nor on what else stands there. */
Test(figure, an_open_shape_faces_the_same_way_wherever_it_stands)
{
    static const double shift[][3] = {{0, 0, 0}, {0, 0, -30}, {7, 50, 3}};
    for (int k = 0; k < 3; k++) {
        double want = 0;
        for (int m = 0; m < 5; m++)
            for (int t = 0; t < 3; t++) {
                char moved[700], text[2000];
                move(moved, sizeof moved, BODY[k], MOTION[m], shift[t]);
                snprintf(text, sizeof text,
                         "vesica: 1\npatches:\n  other: {surface: {formula: [\"90 + sin(u)*sin(v)\", "
                         "\"sin(u)*cos(v)\", \"cos(u)\"]}, domain: {u: [0.3, 2]}}\n"
                         "  body: {surface: {formula: [%s]}}\n"
                         "measures: {H: {mean_curvature: {over: [body]}}, O: {mean_curvature: {over: "
                         "[other]}}}\nminimize: H + O\n",
                         moved);
                bed b = bed_make(text);
                double got = measured(&b, NULL, "H");
                if (!m && !t) want = got;
                cr_expect(fabs(got - want) < 1e-9 * fabs(want), "body %d motion %d shift %d: got %g want %g",
                          k, m, t, got, want);
                cr_expect(measured(&b, NULL, "O") > 0);
                bed_clear(&b);
            }
        cr_expect(want > 0, "body %d: hollow inside, H %g", k, want);
    }
}

/* Closed shapes: all measures but places stay, through mirrors too. */
Test(figure, a_closed_shape_is_measured_alike_wherever_it_stands)
{
    static const char *const NAME[] = {"area", "volume", "bending", "mean_curvature"};
    static const char *const LOW[3] = {"cos(v)", "0.7*sin(v)", "0.1*cos(2*v)"};
    static const char *const HIGH[3] = {"1.3*cos(v) + 0.2", "sin(v)", "2 + 0.2*sin(v)"};
    double want[4];
    for (int m = 0; m < 5; m++) {
        static const double shift[3] = {3, -40, 11};
        char low[700], high[700], text[3000];
        move(low, sizeof low, LOW, MOTION[m], m ? shift : (double[3]){0});
        move(high, sizeof high, HIGH, MOTION[m], m ? shift : (double[3]){0});
        snprintf(
            text, sizeof text,
            "vesica: 1\ncurves: {low: {formula: [%s]}, high: {formula: [%s]}}\n"
            "patches: {wall: {operator: {power: 1}, conditions: [{u: 0, position: low}, {u: 1, position: "
            "high}]}}\nshape: {closed: true, caps: [wall.u0, wall.u1]}\n"
            "minimize: area + volume + bending + mean_curvature\n",
            low, high);
        bed b = bed_make(text);
        for (int k = 0; k < 4; k++) {
            double got = measured(&b, NULL, NAME[k]);
            if (!m) want[k] = got;
            cr_expect(got > 0 && fabs(got - want[k]) < 1e-9 * want[k], "motion %d: %s got %.15g want %.15g",
                      m, NAME[k], got, want[k]);
        }
        bed_clear(&b);
    }
}

/* Two balls beside each other hold both; one in the other leaves a hollow; a third within that is solid
 * again. Each runs from its north or its south pole. */
Test(figure, bodies_add_up_and_hollows_do_not)
{
    for (int k = 0; k < 16; k++) {
        char text[1500];
        const char *way[2] = {"", "-"};
        snprintf(
            text, sizeof text,
            "vesica: 1\npatches:\n"
            "  small: {surface: {formula: [\"sin(pi*u)*cos(v)\", \"sin(pi*u)*sin(v)\", \"%scos(pi*u) + "
            "9\"]}}\n"
            "  big: {surface: {formula: [\"3*sin(pi*u)*cos(v)\", \"3*sin(pi*u)*sin(v)\", \"%s3*cos(pi*u) + "
            "9.5\"]}}\n"
            "  tiny: {surface: {formula: [\"sin(pi*u)*cos(v)/2\", \"sin(pi*u)*sin(v)/2\", \"%scos(pi*u)/2 + "
            "9.2\"]}}\n"
            "  aside: {surface: {formula: [\"sin(pi*u)*cos(v) - 5\", \"sin(pi*u)*sin(v)\", \"%scos(pi*u) + "
            "9\"]}}\nshape: {closed: true}\nminimize: volume\n",
            way[k & 1], way[k >> 1 & 1], way[k >> 2 & 1], way[k >> 3]);
        bed b = bed_make(text);
        double got = measured(&b, NULL, "volume"), want = 4 * pi / 3 * (27 - 1 + 0.125 + 1);
        cr_expect(fabs(got - want) < rounding * want, "%d: %.15g want %.15g", k, got, want);
        bed_clear(&b);
    }
}

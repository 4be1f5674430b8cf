/* PDE patches of every make, at the surface room's own level: gradients against differences, derivative fields
 * against differences, spines against means, and the three ways of sampling against each other. Lengths are of
 * order 1. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vector.h"
#include "bed.h"
#include "plan/inside.h"

enum { FIELDS = VES_POLE_FIELDS, NU = 11, NV = 12, VECTORS = 3, NUMBERS = 21 };

/* Variables, which are the first numbers of the block. */
enum { R, H, Q, OMEGA, OPERATOR, SPINE = OPERATOR + NUMBERS, VARIABLES = SPINE + 3 * VECTORS };

/* Curves, in the order of the text below. */
enum { LOW, HIGH, UP, BEND, CURVES };

static const char CURVE_TEXT[] =
    "curves:\n"
    "  low: {formula: [\"cos(v) + 0.1*cos(5*v)\", \"1.2*sin(v) + 0.07*sin(3*v)\", \"0.1*sin(2*v) + 0.2\"], "
    "apply: [{dilate: r}]}\n"
    "  high: {formula: [\"0.8*cos(v) - 0.05*sin(6*v)\", \"0.9*sin(v)\", \"0.2*cos(4*v)\"], apply: "
    "[{translate: [0.1, 0, h]}]}\n"
    "  up: {formula: [\"0.4*cos(v)\", \"0.3*sin(2*v)\", \"1 + 0.2*cos(5*v)\"]}\n"
    "  bend: {formula: [\"-0.5*cos(v)\", \"0.4 - 0.6*sin(v)\", \"0.3*sin(6*v)\"]}\n"
    "patches: {wall: {operator: {power: 1, a: 1}, conditions: [{u: 0, position: low}, {u: 1, position: "
    "high}]}}\n";

static bed bench(void)
{
    char text[6000];
    size_t at =
        (size_t)snprintf(text, sizeof text,
                         "vesica: 1\nvariables:\n  r: [0.1, 1, 2]\n  h: [0.1, 1, 3]\n  q: [-9, 1, 9]\n"
                         "  omega: [0, 4, 99]\n");
    for (int k = OPERATOR; k < VARIABLES; k++)
        at += (size_t)snprintf(text + at, sizeof text - at, "  n%d: [-9, 1, 9]\n", k);
    at += (size_t)snprintf(text + at, sizeof text - at, "%sminimize: area + q + omega", CURVE_TEXT);
    for (int k = OPERATOR; k < VARIABLES; k++) /* a file may not have variables that nothing uses */
        at += (size_t)snprintf(text + at, sizeof text - at, " + n%d", k);
    cr_assert(at < sizeof text);
    return bed_with(text, NULL, 8, 8);
}

/* Where conditions stand. */
typedef enum where { ENDS, INSIDE, RAISED } where;

typedef struct sort {
    const char *name;
    int power;
    where where;
    bool general;
    int operators, modes;
    bool omega;
    ves_spine_kind spine;
    int vectors, lower;
} sort;

static const sort SORT[] = {
    {"order 2", 1, ENDS, false, 1, 0, false, VES_SPINE_SOLVED, 0, 0},
    {"order 4", 2, ENDS, false, 1, 0, false, VES_SPINE_SOLVED, 0, 0},
    {"order 4, remainder", 2, ENDS, false, 1, 2, false, VES_SPINE_SOLVED, 0, 0},
    {"order 4, omega", 2, ENDS, false, 1, 2, true, VES_SPINE_SOLVED, 0, 0},
    {"order 6", 3, ENDS, false, 1, 0, false, VES_SPINE_SOLVED, 0, 0},
    {"order 14", 7, ENDS, false, 1, 0, false, VES_SPINE_SOLVED, 0, 0},
    {"order 14, remainder", 7, ENDS, false, 1, 3, false, VES_SPINE_SOLVED, 0, 0},
    {"order 8 inside", 4, INSIDE, false, 1, 0, false, VES_SPINE_SOLVED, 0, 0},
    {"order 8 inside, remainder", 4, INSIDE, false, 1, 2, false, VES_SPINE_SOLVED, 0, 0},
    {"order 8 inside, omega", 4, INSIDE, false, 1, 2, true, VES_SPINE_SOLVED, 0, 0},
    {"order 14 inside, omega", 7, INSIDE, false, 1, 1, true, VES_SPINE_SOLVED, 0, 0},
    {"order 30 inside", 15, INSIDE, false, 1, 0, false, VES_SPINE_SOLVED, 0, 0},
    {"general 4", 2, ENDS, true, 1, 0, false, VES_SPINE_SOLVED, 0, 0},
    {"general 6", 3, ENDS, true, 1, 0, false, VES_SPINE_SOLVED, 0, 0},
    {"general 6, remainder", 3, ENDS, true, 1, 2, false, VES_SPINE_SOLVED, 0, 0},
    {"general 6, omega", 3, ENDS, true, 1, 2, true, VES_SPINE_SOLVED, 0, 0},
    {"general 6 inside, remainder", 3, INSIDE, true, 1, 2, false, VES_SPINE_SOLVED, 0, 0},
    {"three operators", 2, ENDS, false, 3, 0, false, VES_SPINE_SOLVED, 0, 0},
    {"three general 4", 2, ENDS, true, 3, 0, false, VES_SPINE_SOLVED, 0, 0},
    {"three general 12", 6, ENDS, true, 3, 0, false, VES_SPINE_SOLVED, 0, 0},
    {"three general 6, remainder", 3, ENDS, true, 3, 2, false, VES_SPINE_SOLVED, 0, 0},
    {"three inside, omega", 3, INSIDE, false, 3, 2, true, VES_SPINE_SOLVED, 0, 0},
    {"hermite", 2, ENDS, false, 1, 0, false, VES_SPINE_HERMITE, 2, 0},
    {"hermite, inside, remainder", 4, INSIDE, false, 1, 2, false, VES_SPINE_HERMITE, 2, 0},
    {"bspline", 3, ENDS, false, 1, 0, false, VES_SPINE_BSPLINE, 3, 0},
    {"bspline of 1", 2, ENDS, true, 3, 0, false, VES_SPINE_BSPLINE, 1, 0},
    {"bspline of 2, omega", 2, ENDS, false, 1, 2, true, VES_SPINE_BSPLINE, 2, 0},
    {"raised from 4 to 6", 3, RAISED, false, 1, 0, false, VES_SPINE_SOLVED, 0, 2},
    {"raised from 4 to 10, remainder", 5, RAISED, false, 1, 3, false, VES_SPINE_SOLVED, 0, 2},
    {"raised, three, spine", 4, RAISED, false, 3, 2, true, VES_SPINE_HERMITE, 2, 3},
};
enum { SORTS = sizeof SORT / sizeof *SORT };

/* Hermite data at the ends; or positions at both ends and the rest inside, derivatives among them. A raised
 * order: the lower one's Hermite data, then what the surface departs from it, inside. */
static ves_knot knot(const sort *s, int j)
{
    int half = s->lower ? s->lower : s->power, more = j - 2 * half;
    if (s->where == INSIDE) {
        int last = 2 * s->power - 1;
        if (j == 0 || j == last) return (ves_knot){j ? 1 : 0, 0};
        return (ves_knot){(double)((j + 1) / 2) / (s->power), (j + 1) % 2};
    }
    if (more >= 0 && more % 2 == 0) return (ves_knot){0.37 + 0.1 * more, 0};
    if (more >= 0) return (ves_knot){more / 2 % 2, half + more / 4};
    return (ves_knot){j >= half, j % half};
}

/* Positions at the ends are one curve, as in a file; all others sums of two, times a number that varies. */
typedef struct made {
    ves_pde def;
    ves_datum datum[VES_CONDITIONS_MAX];
    ves_term term[VES_CONDITIONS_MAX][2];
} made;

static void make(const sort *s, made *m)
{
    static const int curve[][2] = {{LOW, BEND}, {UP, HIGH}, {BEND, UP}};
    m->def = (ves_pde){.layout = {.power = s->power, .lower = s->lower},
                       .datum = m->datum,
                       .general = s->general,
                       .operators = s->operators,
                       .modes = s->modes,
                       .omega = s->omega ? OMEGA : -1,
                       .spine = {s->spine, s->vectors, SPINE}};
    for (int k = 0; k < s->operators; k++)
        m->def.parameter[k] = OPERATOR + k * (s->general ? s->power + 1 : 1);
    for (int j = 0; j < 2 * s->power; j++) {
        ves_knot at = m->def.layout.knot[j] = knot(s, j);
        bool end = at.derivative == 0 && (at.u == 0 || at.u == 1);
        m->term[j][0] = (ves_term){end ? (at.u == 0 ? LOW : HIGH) : curve[j % 3][0], end ? 1 : 0.7};
        m->term[j][1] = (ves_term){curve[j % 3][1], -0.3};
        m->datum[j] = (ves_datum){end ? 1 : 2, m->term[j], end ? -1 : Q};
    }
}

/* Elliptic: coefficients of prod (t + s_i) with all s_i > 0, a little off. */
static void numbers_fill(const sort *s, double *x)
{
    for (int k = 0; k < VARIABLES; k++) x[k] = 0.3 + 0.17 * (k % 5) - 0.2 * (k % 3);
    x[R] = 1.1, x[H] = 1.7, x[Q] = 0.6, x[OMEGA] = 3.1;
    for (int k = 0; k < s->operators; k++) {
        double *c = x + OPERATOR + k * (s->general ? s->power + 1 : 1);
        c[0] = 0.9 + 0.2 * k;
        for (int i = 0; s->general && i < s->power; i++) {
            double root = 0.6 + 0.35 * i + 0.1 * k;
            c[i + 1] = 0;
            for (int q = i + 1; q > 0; q--) c[q] += root * c[q - 1];
        }
    }
}

typedef struct rig {
    bed b;
    made made;
    ves_arena arena;
    ves_patch *patch;
    ves_chart *chart;
    ves_grid grid;
    double x[VARIABLES], u[NU], v[NV];
    ves_tile_planes field;
} rig;

static void rig_make(const sort *s, rig *r)
{
    memset(r, 0, sizeof *r);
    r->b = bench();
    cr_assert_eq(r->b.problem->variables, VARIABLES);
    cr_assert_str_eq(r->b.problem->curve[BEND].name, "bend");
    make(s, &r->made);
    numbers_fill(s, r->x);
    for (int i = 0; i < NU; i++) r->u[i] = i == NU - 1 ? 1 : fmod(0.618033988 * i, 1);
    for (int j = 0; j < NV; j++) r->v[j] = fmod(2.399963 * j, VES_TWO_PI);
    ves_plan_bind(r->b.plan, r->x, 0);
    const ves_bound *bound = &r->b.plan->bound;
    cr_assert_eq(ves_patch_pde(&r->made.def, bound, &r->arena, &r->patch), VES_OK);
    cr_assert_eq(ves_patch_band(r->patch), 6);
    int modes = ves_patch_modes(r->patch);
    cr_assert(s->modes ? modes == s->modes : modes == 6 || s->where != ENDS, "%s: %d modes", s->name, modes);
    cr_assert_eq(ves_grid_given(NU, r->u, NV, r->v, true, &r->arena, &r->grid), VES_OK);
    cr_assert_eq(ves_chart_create(r->patch, &r->grid, (1u << FIELDS) - 1, &r->arena, &r->chart), VES_OK);
}

static void rig_clear(rig *r)
{
    ves_arena_destroy(&r->arena);
    bed_clear(&r->b);
}

static void bind(rig *r, const double *x, bool gradient)
{
    const ves_bound *bound = &r->b.plan->bound;
    ves_plan_bind(r->b.plan, x, 0);
    ves_patch_bind(r->patch, bound);
    cr_assert_eq(ves_patch_status(r->patch), VES_OK);
    cr_assert_eq(ves_chart_prepare(r->chart, bound, gradient), VES_OK);
}

/* J = the sum over all nodes and fields of weight times field. */
static double weight_of(int f, int c, int i, int j)
{
    return sin(1 + f + 2.3 * c + 0.7 * i + 1.1 * j) / (1 + f);
}

/* Visits all nodes: adds to J; or, with `adjoint`, fills d J / d field. */
static double visit(rig *r, ves_tile_planes *adjoint)
{
    double J = 0;
    for (int t = 0; t < ves_tile_count(&r->grid); t++) {
        ves_tile tile;
        ves_tile_at(&r->grid, t, (1u << FIELDS) - 1, &tile);
        if (adjoint) memset(adjoint, 0, sizeof *adjoint);
        if (!adjoint) ves_chart_sample(r->chart, &tile, &r->field);
        for (int p = 0; p < 3 * FIELDS; p++)
            for (int row = 0; row < tile.rows; row++)
                for (int i = 0; i < tile.lanes; i++) {
                    double w = weight_of(p / 3, p % 3, tile.block + i, tile.row[row]);
                    if (adjoint)
                        adjoint->at[p][row * VES_LANES + i] = w;
                    else
                        J += w * r->field.at[p][row * VES_LANES + i];
                }
        if (adjoint) ves_chart_scatter(r->chart, &tile, adjoint);
    }
    return J;
}

static double value(rig *r, const double *x)
{
    bind(r, x, false);
    return visit(r, NULL);
}

static void gradient(rig *r, double *out)
{
    ves_plan *plan = r->b.plan;
    ves_tile_planes *adjoint = ves_arena_take(&r->arena, 1, sizeof *adjoint);
    double *number = ves_arena_doubles(&r->arena, (size_t)r->b.problem->block);
    memset(out, 0, sizeof *out * VARIABLES);
    memset(number, 0, sizeof *number * (size_t)r->b.problem->block);
    bind(r, r->x, true);
    ves_patch_clear(r->patch);
    ves_curves_clear(plan->curves);
    ves_chart_clear(r->chart);
    visit(r, adjoint);
    ves_chart_gather(r->chart, &plan->bound, number);
    ves_patch_unbind(r->patch, &plan->bound, number);
    ves_curves_scatter(plan->curves, plan->block, number);
    ves_plan_pull(plan, number, out);
}

/* Which variables this patch is made of. */
static bool used(const sort *s, int k)
{
    int each = s->general ? s->power + 1 : 1;
    bool many = s->power > 1;
    if (k == OMEGA) return s->omega;
    if (k < OPERATOR) return k != Q || many;
    if (k < SPINE) return k - OPERATOR < s->operators * each;
    return k - SPINE < 3 * s->vectors;
}

/* Differences of fourth order with steps of 2e-3: h^4 / 30 of a fifth derivative is 5e-13 of it,
 * and rounding 1e-13 over h: 4e-11 was seen. Both ways of asking, gradients first or values first, must give the same tables. */
Test(surface_pde, gradients_are_those_of_differences)
{
    static rig r;
    for (int k = 0; k < SORTS; k++) {
        const sort *s = &SORT[k];
        double got[VARIABLES], again[VARIABLES], size = 0;
        rig_make(s, &r);
        gradient(&r, got);
        for (int i = 0; i < VARIABLES; i++) size = fmax(size, fabs(got[i]));
        for (int i = 0; i < VARIABLES; i++) {
            double x[VARIABLES], f[4], h = 2e-3;
            static const double step[] = {-2, -1, 1, 2};
            for (int q = 0; q < 4; q++) {
                memcpy(x, r.x, sizeof x);
                x[i] += step[q] * h;
                f[q] = value(&r, x);
            }
            double want = (f[0] - 8 * f[1] + 8 * f[2] - f[3]) / (12 * h);
            cr_expect(fabs(got[i] - want) < 1e-9 * size, "%s, variable %d: got %.12g want %.12g (%.2g)",
                      s->name, i, got[i], want, (got[i] - want) / size);
            cr_expect((got[i] != 0) == used(s, i), "%s, variable %d: %.3g", s->name, i, got[i]);
        }
        gradient(&r, again);
        for (int i = 0; i < VARIABLES; i++)
            cr_expect(again[i] == got[i], "%s, variable %d after values: %.17g %.17g", s->name, i, again[i],
                      got[i]);
        rig_clear(&r);
    }
}

/* Scattered points at the nodes against tiles. */
static void points_compare(rig *r, const char *what)
{
    double *room = ves_arena_doubles(&r->arena, (size_t)ves_patch_point_room(r->patch));
    double size[VES_FIELDS] = {0}, at[VES_FIELDS][3][NU * NV], u[NU * NV], v[NU * NV];
    for (int q = 0; q < NU * NV; q++) u[q] = r->grid.u[q % NU], v[q] = r->grid.v[q / NU];
    ves_patch_point(r->patch, &r->b.plan->bound, NU * NV, u, v, &at[0][0][0], room);
    for (int p = 0; p < 3 * VES_FIELDS; p++)
        for (int q = 0; q < NU * NV; q++) size[p / 3] = fmax(size[p / 3], fabs(at[p / 3][p % 3][q]));
    for (int t = 0; t < ves_tile_count(&r->grid); t++) {
        ves_tile tile;
        ves_tile_at(&r->grid, t, (1u << FIELDS) - 1, &tile);
        ves_chart_sample(r->chart, &tile, &r->field);
        for (int p = 0; p < 3 * VES_FIELDS; p++)
            for (int n = 0; n < tile.rows * tile.lanes; n++) {
                int row = n / tile.lanes, i = n % tile.lanes;
                double got = r->field.at[p][row * VES_LANES + i],
                       want = at[p / 3][p % 3][tile.row[row] * NU + tile.block + i];
                cr_expect(fabs(got - want) < 1e-13 * size[p / 3], "%s field %d: %.17g %.17g (of %.3g)", what,
                          p / 3, got, want, size[p / 3]);
            }
    }
}

/* Tiles and scattered points are two ways to the same surface, also after the nodes have moved: rounding of the
 * same sums in another order. */
Test(surface_pde, tiles_and_points_agree)
{
    static rig r;
    for (int k = 0; k < SORTS; k++) {
        rig_make(&SORT[k], &r);
        bind(&r, r.x, false);
        points_compare(&r, SORT[k].name);
        for (int i = 0; i < NU; i++) r.grid.u[i] = 1 - 0.7 * r.u[i];
        for (int j = 0; j < NV; j++) r.grid.v[j] = 0.9 * r.v[j] + 0.1;
        ves_chart_move(r.chart);
        bind(&r, r.x, false);
        points_compare(&r, SORT[k].name);
        rig_clear(&r);
    }
}

/* Fields are derivatives of each other, along u by differences, inside and near the ends: the higher the order,
 * the faster they may change. */
Test(surface_pde, fields_are_derivatives_of_each_other)
{
    static rig r;
    static const double place[] = {0.01, 0.25, 0.47, 0.77, 0.99}; /* no knot of a spline */
    static const int pair[][2] = {
        {VES_FIELD_X, VES_FIELD_U}, {VES_FIELD_U, VES_FIELD_UU}, {VES_FIELD_V, VES_FIELD_UV}};
    for (int k = 0; k < SORTS; k++) {
        double worst[3] = {0}, size[3] = {0}, h = 2e-3 / SORT[k].power;
        rig_make(&SORT[k], &r);
        double *room = ves_arena_doubles(&r.arena, (size_t)ves_patch_point_room(r.patch));
        for (int q = 0; q < 5; q++) {
            double u[5], v[5], at[VES_FIELDS][3][5];
            for (int i = 0; i < 5; i++) u[i] = place[q] + (i - 2) * h, v[i] = 1.3 + q;
            ves_patch_point(r.patch, &r.b.plan->bound, 5, u, v, &at[0][0][0], room);
            for (int p = 0; p < 3; p++)
                for (int c = 0; c < 3; c++) {
                    const double *f = at[pair[p][0]][c], got = at[pair[p][1]][c][2];
                    double want = (f[0] - 8 * f[1] + 8 * f[3] - f[4]) / (12 * h);
                    worst[p] = fmax(worst[p], fabs(got - want));
                    size[p] = fmax(size[p], fabs(got));
                }
        }
        for (int p = 0; p < 3; p++) /* h^4 / 30 of a fifth derivative */
            cr_expect(worst[p] < 1e-6 * size[p], "%s: %.3g of %.3g", SORT[k].name, worst[p], size[p]);
        rig_clear(&r);
    }
}

/* The spine is the mean over v: the trapezoid of more than 6 nodes is exact for 6 modes. It runs from the mean of
 * the one end to that of the other, also where it is given; there it does not depend on what is solved. */
Test(surface_pde, the_spine_is_the_mean)
{
    static rig r;
    enum { AROUND = 16 };
    for (int k = 0; k < SORTS; k++) {
        rig_make(&SORT[k], &r);
        double *room = ves_arena_doubles(&r.arena, (size_t)ves_patch_point_room(r.patch));
        double spine[3][3][NU], at[VES_FIELDS][3][AROUND], u[AROUND], v[AROUND];
        static const int field[] = {VES_FIELD_X, VES_FIELD_U, VES_FIELD_UU};
        cr_assert(ves_patch_spine(r.patch, &r.b.plan->bound, NU, r.u, &spine[0][0][0], room));
        for (int i = 0; i < NU; i++) {
            for (int j = 0; j < AROUND; j++) u[j] = r.u[i], v[j] = VES_TWO_PI * j / AROUND;
            ves_patch_point(r.patch, &r.b.plan->bound, AROUND, u, v, &at[0][0][0], room);
            for (int p = 0; p < 9; p++) {
                double mean = 0, size = 1;
                for (int j = 0; j < AROUND; j++) {
                    mean += at[field[p / 3]][p % 3][j] / AROUND;
                    size = fmax(size, fabs(at[field[p / 3]][p % 3][j]));
                }
                cr_expect(fabs(spine[p / 3][p % 3][i] - mean) < 1e-13 * size, "%s u %.3f: %.17g %.17g",
                          SORT[k].name, r.u[i], spine[p / 3][p % 3][i], mean);
            }
            for (int c = 0; c < 3 && (r.u[i] == 0 || r.u[i] == 1); c++) {
                int curve = r.u[i] == 0 ? LOW : HIGH, modes = ves_curves_modes(r.b.plan->curves, curve);
                double want = ves_curves_coef(r.b.plan->curves, curve)[c * (1 + 2 * modes)];
                cr_expect(fabs(spine[0][c][i] - want) < 1e-14, "%s end: %.17g %.17g", SORT[k].name,
                          spine[0][c][i], want);
            }
        }
        rig_clear(&r);
    }
}

/* sum_q p[q] C(n, q) u^q (1 - u)^(n - q) */
static double bezier(int n, const double *p, double u)
{
    double sum = 0, c = 1;
    for (int q = 0; q <= n; q++) {
        sum += p[q] * c * pow(u, q) * pow(1 - u, n - q);
        c = c * (n - q) / (q + 1);
    }
    return sum;
}

/* Control points p[0 .. 4] of the clamped cubic with one knot, at 1/2: two Bezier curves, by inserting it. */
static double two_pieces(const double *p, double u)
{
    double a = (p[1] + p[2]) / 2, b = (p[2] + p[3]) / 2;
    const double left[] = {p[0], p[1], a, (a + b) / 2}, right[] = {(a + b) / 2, b, p[3], p[4]};
    return u < 0.5 ? bezier(3, left, 2 * u) : bezier(3, right, 2 * u - 1);
}

/* A given spine by other means: Hermite's cubic, and B-splines with one, two and three inner points, all as
 * Bezier curves. */
Test(surface_pde, given_spines_are_the_curves_they_say)
{
    static rig r;
    for (int k = 0; k < SORTS; k++) {
        const sort *s = &SORT[k];
        if (s->spine == VES_SPINE_SOLVED) continue;
        rig_make(s, &r);
        double *room = ves_arena_doubles(&r.arena, (size_t)ves_patch_point_room(r.patch)), spine[3][3][NU];
        ves_patch_spine(r.patch, &r.b.plan->bound, NU, r.u, &spine[0][0][0], room);
        for (int i = 0; i < NU; i++)
            for (int c = 0; c < 3; c++) {
                double p[5], u = r.u[i];
                const double *n = r.x + SPINE;
                int degree = s->spine == VES_SPINE_HERMITE ? 3 : s->vectors + 1;
                for (int e = 0; e < 2; e++) {
                    int curve = e ? HIGH : LOW, width = 1 + 2 * ves_curves_modes(r.b.plan->curves, curve);
                    p[e ? degree : 0] = ves_curves_coef(r.b.plan->curves, curve)[c * width];
                }
                for (int q = 1; q < degree; q++) p[q] = n[3 * (q - 1) + c];
                if (s->spine == VES_SPINE_HERMITE) p[1] = p[0] + n[c] / 3, p[2] = p[3] - n[3 + c] / 3;
                double want = degree < 4 ? bezier(degree, p, u) : two_pieces(p, u), got = spine[0][c][i];
                cr_expect(fabs(got - want) < 1e-14, "%s: %.17g %.17g", s->name, got, want);
            }
        rig_clear(&r);
    }
}

/* Raising the order leaves the surface as it is: with all departures 0 it is the lower one's, to rounding. */
Test(surface_pde, a_raised_order_begins_with_the_lower_surface)
{
    static rig high, low;
    static const sort lower = {"lower", 2, ENDS, false, 1, 0, false, VES_SPINE_SOLVED, 0, 0},
                      raised = {"raised", 5, RAISED, false, 1, 0, false, VES_SPINE_SOLVED, 0, 2};
    rig_make(&lower, &low);
    rig_make(&raised, &high);
    for (int j = 4; j < 10; j++) high.made.datum[j].terms = 0;
    for (int j = 0; j < 4; j++) {
        cr_assert_eq(high.made.def.layout.knot[j].u, low.made.def.layout.knot[j].u);
        cr_assert_eq(high.made.term[j][0].curve, low.made.term[j][0].curve);
    }
    bind(&low, low.x, false);
    bind(&high, high.x, false);
    for (int t = 0; t < ves_tile_count(&low.grid); t++) {
        ves_tile tile;
        ves_tile_at(&low.grid, t, (1u << FIELDS) - 1, &tile);
        ves_chart_sample(low.chart, &tile, &low.field);
        ves_chart_sample(high.chart, &tile, &high.field);
        for (int p = 0; p < 3 * VES_FIELDS; p++)
            for (int q = 0; q < tile.rows * VES_LANES; q++) {
                double got = high.field.at[p][q], want = low.field.at[p][q];
                cr_expect(fabs(got - want) < 1e-13 * (1 + fabs(want)), "field %d: %.17g %.17g", p / 3, got,
                          want);
            }
    }
    rig_clear(&low);
    rig_clear(&high);
}

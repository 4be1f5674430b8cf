/* Reading problem files: what comes out is what was written. Broken files are in tests/broken.c. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "problem/problem.h"

#define CURVES "curves: {p1: {circle: {radius: 1}}, p2: {circle: {radius: 2}}}\n"
#define PATCHES                                                                                              \
    "patches: {wall: {operator: {power: 1}, conditions: [{u: 0, position: p1}, {u: 1, position: p2}]}}\n"
#define BASE "vesica: 1\n" CURVES PATCHES

static ves_problem *read_with(const char *text, const ves_read_options *options)
{
    ves_problem *problem = NULL;
    ves_diag *diag = ves_diag_create();
    ves_status status = ves_problem_read_text("test.yaml", text, strlen(text), options, &problem, diag);
    char message[2000] = "";
    if (ves_diag_count(diag)) ves_diag_text(diag, 0, message, sizeof message);
    cr_assert(status == VES_OK && problem, "status %d, %s", status, message);
    ves_diag_destroy(diag);
    return problem;
}

static ves_problem *read_text(const char *text)
{
    return read_with(text, NULL);
}

/* The number block at the start design. The unknown of solve is in the middle of its interval. */
static double *block_of(const ves_problem *p)
{
    double *block = calloc((size_t)p->block + 1, sizeof *block), room[4096];
    for (int k = 0; k < p->variables; k++) block[k] = p->variable[k].start;
    if (p->unknowns) block[p->variables] = (p->solve->lo + p->solve->hi) / 2;
    for (int k = 0; k < p->parameters; k++)
        block[p->variables + p->unknowns + k] = ves_formula_eval(p->parameter[k].formula, block, NULL, room);
    for (int k = 0; k < p->numbers; k++)
        block[p->slots + k] = ves_formula_eval(p->number[k], block, NULL, room);
    return block;
}

static int curve_index(const ves_problem *p, const char *name)
{
    for (int k = 0; k < p->curves; k++)
        if (!strcmp(p->curve[k].name, name)) return k;
    cr_assert_fail("no curve %s", name);
    return -1;
}

static const ves_arg *arg_of(const ves_args *args, const char *name)
{
    for (int k = 0; k < args->count; k++)
        if (!strcmp(args->key[k].name, name)) return &args->arg[k];
    cr_assert_fail("no key %s", name);
    return NULL;
}

static double parameter_value(const ves_problem *p, const double *block, const char *name)
{
    for (int k = 0; k < p->parameters; k++)
        if (!strcmp(p->parameter[k].name, name)) return block[p->variables + p->unknowns + k];
    cr_assert_fail("no parameter %s", name);
    return NAN;
}

static void expect_number(double got, double want, const char *what)
{
    cr_expect(got == want, "%s: got %.17g, want %.17g", what, got, want);
}

Test(problem, the_book_example_is_read_as_it_stands)
{
    ves_problem *p =
        read_text("vesica: 1\n"
                  "title: Least-curvature surface between two rings\n"
                  "parameters: {gap: 2, off: 1.29}\n"
                  "variables:\n"
                  "  d1Ty: [-1.2, 0, 0]\n"
                  "  d1D:  [0.01, 1, 3]\n"
                  "  a:    [0.01, 0.5, 9]\n"
                  "curves:\n"
                  "  p1: {circle: {radius: 1, axis: [0, 1, 0]}}\n"
                  "  p2: {like: p1, apply: [{translate: [0, gap, 0]}]}\n"
                  "  d1: {circle: {radius: 1.33, axis: [0, 1, 0]}, apply: [{dilate: d1D}, {translate: [0, "
                  "off + d1Ty, 0]}]}\n"
                  "  d2: {circle: {radius: 1.18, axis: [0, 1, 0]}, apply: [{translate: [0, gap - off, 0]}]}\n"
                  "patches:\n"
                  "  wall:\n"
                  "    operator: {power: 2, a: a}\n"
                  "    conditions:\n"
                  "      - {u: 0, position: p1}\n"
                  "      - {u: 1, position: p2}\n"
                  "      - {u: 0, derivative: 1, from: p1, to: d1, scale: 2}\n"
                  "      - {u: 1, derivative: 1, from: d2, to: p2, scale: 2}\n"
                  "minimize: bending\n"
                  "constraints: [area <= 14]\n"
                  "search: [{anneal: {evaluations: 20000}}, {polish: {algorithm: slsqp}}]   # or auto\n"
                  "expect: [violation < 1e-6]\n");
    cr_expect(!strcmp(p->title, "Least-curvature surface between two rings") && !strcmp(p->name, "test") &&
              !p->units);
    cr_expect(p->variables == 3 && p->parameters == 2 && p->slots == 5 && p->curves == 4 && p->patches == 1);
    double *block = block_of(p);
    const ves_curve_def *d1 = &p->curve[curve_index(p, "d1")];
    cr_expect(d1->steps == 3 && !strcmp(d1->step[1].op->name, "dilate") &&
              !strcmp(d1->step[2].op->name, "translate"));
    const ves_arg *by = arg_of(&d1->step[2].args, "by");
    expect_number(block[by->first + 1], 1.29, "off + d1Ty");
    expect_number(block[arg_of(&d1->step[0].args, "radius")->first], 1.33, "radius");
    cr_expect(p->varying[by->first + 1] && !p->varying[by->first], "only the middle one varies");
    const ves_patch_def *wall = &p->patch[0];
    const ves_condition *last = &wall->condition[3];
    cr_expect(wall->power == 2 && wall->conditions == 4 && last->derivative == 1 && last->u == 1);
    cr_expect(last->shares == 2 && last->share[1].curve == curve_index(p, "d2") &&
              last->share[0].curve == curve_index(p, "p2"));
    expect_number(block[last->scale], 2, "scale");
    expect_number(block[wall->parameter[0]], 0.5, "a");
    cr_expect(wall->condition[0].scale == -1 && wall->condition[0].shares == 1);
    cr_expect(p->measures == 2 && p->constraints == 1 && p->constraint[0].relation == VES_AT_MOST);
    cr_expect(!strcmp(p->constraint[0].text, "area <= 14") && p->constraint[0].within == 1e-6);
    cr_expect(p->search.stages == 2 && p->search.stage[0].anneal.evaluations == 20000);
    cr_expect(!strcmp(p->search.stage[1].polish.algorithm, "slsqp"));
    cr_expect(p->curve_limit == VES_CURVE_MODES && p->validity.jacobian && p->validity.self_intersection);
    free(block);
    ves_problem_destroy(p);
}

Test(problem, parameters_come_in_any_order_and_their_slots_after_what_they_read)
{
    ves_problem *p = read_text("vesica: 1\n"
                               "parameters: {e: 2*d, d: c*x, c: b + 1, b: 4/2, top: e + h}\n"
                               "variables: {x: [b - 2, c/2, 10*b]}\n" CURVES
                               "patches: {wall: {operator: {power: 1, a: top + e*0}, conditions: [{u: 0, "
                               "position: p1}, {u: 1, position: p2}]}}\n"
                               "solve: {unknown: h, in: [b, 4*b], equation: area == 30}\n");
    double *block = block_of(p);
    expect_number(p->variable[0].min, 0, "min");
    expect_number(p->variable[0].start, 1.5, "start");
    expect_number(p->variable[0].max, 20, "max");
    expect_number(parameter_value(p, block, "e"), 9, "e");
    expect_number(parameter_value(p, block, "top"), 14, "top");
    expect_number(block[p->patch[0].parameter[0]], 14, "a");
    int first = p->variables + p->unknowns;
    for (int k = 0; k < p->parameters; k++) {
        for (int i = first + k; i < p->slots; i++)
            cr_expect(!ves_formula_uses_slot(p->parameter[k].formula, i), "%s reads a later slot",
                      p->parameter[k].name);
        bool constant = !strcmp(p->parameter[k].name, "b") || !strcmp(p->parameter[k].name, "c");
        cr_expect(p->varying[first + k] == !constant, "%s", p->parameter[k].name);
    }
    cr_expect(p->varying[0] && p->varying[1] && !strcmp(p->solve->name, "h"));
    free(block);
    ves_problem_destroy(p);
}

Test(problem, curves_come_after_those_they_are_made_of)
{
    ves_problem *p = read_text("vesica: 1\n"
                               "curves:\n"
                               "  mix: {combine: [[1, late], [-2, base], [1, mid], [0.5, base]]}\n"
                               "  late: {like: mid, apply: [{shift: 10 deg}]}\n"
                               "  mid: {like: base, apply: [{dilate: [1, 2, 3]}, {rotate: [0, 0, pi/2]}]}\n"
                               "  base: {circle: 1.5}\n"
                               "patches: {wall: {operator: {power: 1}, conditions: [{u: 0, position: mix}, "
                               "{u: 1, position: base}]}}\n");
    double *block = block_of(p);
    for (int k = 0; k < p->curves; k++)
        for (int i = 0; i < p->curve[k].inputs; i++)
            cr_expect(p->curve[k].input[i] < k, "%s comes too early", p->curve[k].name);
    const ves_curve_def *mix = &p->curve[curve_index(p, "mix")], *mid = &p->curve[curve_index(p, "mid")];
    static const char *const input[] = {"late", "base", "mid", "base"};
    static const double weight[] = {1, -2, 1, 0.5}, scale[] = {1, 2, 3};
    const ves_arg *terms = arg_of(&mix->step[0].args, "terms"), *by = arg_of(&mid->step[1].args, "by");
    cr_assert(mix->inputs == 4 && terms->count == 4);
    for (int k = 0; k < 4; k++) {
        cr_expect(mix->input[k] == curve_index(p, input[k]) && terms->ref[k] == mix->input[k], "input %d", k);
        expect_number(block[terms->first + k], weight[k], "weight");
    }
    for (int k = 0; k < 3; k++) expect_number(block[by->first + k], scale[k], "dilate");
    cr_expect(!p->units, "deg has no dimension");
    free(block);
    ves_problem_destroy(p);
}

/* Two ways of writing the same give the same numbers in the same places. */
static void same(const char *a, const char *b)
{
    char text[2][4000];
    for (int k = 0; k < 2; k++)
        snprintf(
            text[k], sizeof text[k],
            "vesica: 1\ncurves:\n  p1: {circle: {radius: 1}}\n  p2: {circle: {radius: 2}}\n  d: %s\n" PATCHES,
            k ? b : a);
    ves_problem *p = read_text(text[0]), *q = read_text(text[1]);
    double *x = block_of(p), *y = block_of(q);
    const ves_curve_def *c = &p->curve[2], *d = &q->curve[2];
    bool equal = p->block == q->block && c->steps == d->steps && c->inputs == d->inputs;
    for (int k = 0; k < p->block && equal; k++) equal = x[k] == y[k] || (isnan(x[k]) && isnan(y[k]));
    for (int k = 0; k < c->steps && equal; k++)
        for (int i = 0; i < c->step[k].args.count; i++)
            equal = equal && c->step[k].op == d->step[k].op &&
                    c->step[k].args.arg[i].first == d->step[k].args.arg[i].first &&
                    c->step[k].args.arg[i].value == d->step[k].args.arg[i].value;
    cr_expect(equal, "%s\nis not %s", a, b);
    free(x);
    free(y);
    ves_problem_destroy(p);
    ves_problem_destroy(q);
}

Test(problem, short_forms_mean_the_first_key)
{
    static const char *const row[][2] = {
        {"{point: [0, 0, 1]}", "{point: {at: [0, 0, 1]}}"},
        {"{circle: 3}", "{circle: {radius: 3}}"},
        {"{like: p1}", "{like: {curve: p1}}"},
        {"{combine: [[1, p1], [-2, p2]]}", "{combine: {terms: [[1, p1], [-2, p2]]}}"},
        {"{formula: [\"cos(v)\", \"sin(v)\", 0]}", "{formula: {of: [\"cos(v)\", \"sin(v)\", \"0\"]}}"},
        {"{like: p1, apply: [{dilate: 2}]}", "{like: p1, apply: [{dilate: {by: [2, 2, 2]}}]}"},
        {"{like: p1, apply: [{translate: [1, 2, 3]}, {shift: 10 deg}]}",
         "{like: p1, apply: [{translate: {by: [1, 2, 3]}}, {shift: {by: pi/18}}]}"},
        {"{fourier: }", "{fourier: {}}"},
    };
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) same(row[k][0], row[k][1]);
}

static const ves_variable *variable(const ves_problem *p, const char *name)
{
    for (int k = 0; k < p->variables; k++)
        if (!strcmp(p->variable[k].name, name)) return &p->variable[k];
    cr_assert_fail("no variable %s", name);
    return NULL;
}

static void expect_range(const ves_problem *p, const char *name, double min, double start, double max)
{
    const ves_variable *v = variable(p, name);
    cr_expect(v->min == min && v->start == start && v->max == max, "%s: got [%g, %g, %g], want [%g, %g, %g]",
              name, v->min, v->start, v->max, min, start, max);
}

Test(problem, vary_declares_the_ranges_of_table_7_2_and_moves_the_curve)
{
    ves_problem *p =
        read_text("vesica: 1\n"
                  "vary:\n"
                  "  p1: [T, R, D]\n"
                  "  p2: {T: {x: [-1, 0.5, 1]}, Ry: [-0.1, 0, 0.1], D: [0.5, 1, 2]}\n"
                  "  p3: Tz\n"
                  "start: {p1Tx: 0.25}\n"
                  "curves:\n"
                  "  p1: {circle: 1}\n"
                  "  p2: {circle: 2, apply: [{translate: [0, 0, 1]}]}\n"
                  "  p3: {circle: 2, apply: [{translate: [0, 0, 2*p3Tz]}]}\n"
                  "patches:\n"
                  "  a: {operator: {power: 1}, conditions: [{u: 0, position: p1}, {u: 1, position: p2}]}\n"
                  "  b: {operator: {power: 1}, conditions: [{u: 0, position: p3}, {u: 1, position: p2}]}\n");
    cr_expect(p->variables == 9 + 5 + 1, "%d variables", p->variables);
    expect_range(p, "p1Tx", -1.2, 0.25, 1.2);
    expect_range(p, "p1Rz", -0.8, 0, 0.8);
    expect_range(p, "p1Dy", 0.01, 1, 3);
    expect_range(p, "p2Tx", -1, 0.5, 1);
    expect_range(p, "p2Ry", -0.1, 0, 0.1);
    expect_range(p, "p2Dz", 0.5, 1, 2);
    static const char *const order[] = {"translate", "dilate", "rotate", "translate"};
    const ves_curve_def *p2 = &p->curve[curve_index(p, "p2")], *p3 = &p->curve[curve_index(p, "p3")];
    cr_assert(p2->steps == 5 && p3->steps == 2, "the own use of p3Tz replaces the move");
    for (int k = 0; k < 4; k++)
        cr_expect(!strcmp(p2->step[k + 1].op->name, order[k]), "move %d is %s", k, p2->step[k + 1].op->name);
    double *block = block_of(p);
    const double want[3][3] = {{1, 1, 1}, {0, 0, 0}, {0.5, 0, 0}};
    for (int m = 0; m < 3; m++) {
        const ves_args *args = &p2->step[m + 2].args;
        for (int c = 0; c < 3; c++)
            expect_number(block[arg_of(args, "by")->first + c], want[m][c], order[m + 1]);
        if (m < 2) cr_expect(arg_of(args, "about")->value == 1, "about its own centre");
    }
    free(block);
    ves_problem_destroy(p);
}

Test(problem, units_become_si_and_are_checked_only_where_there_are_some)
{
    ves_problem *p =
        read_text("vesica: 1\n"
                  "parameters: {L: 0.1 m, load: 15 N/m, n: 3}\n"
                  "variables: {r: [1 mm, 20 mm, 3 cm], q: [0, 1, 2]}\n"
                  "curves: {p1: {circle: {radius: r}}, p2: {circle: {radius: 2*L*n, axis: [0, q, 1]}}}\n"
                  "patches: {wall: {operator: {power: 1, a: n}, conditions: [{u: 0, position: p1}, {u: 1, "
                  "position: p2}]}}\n"
                  "minimize: area/(1 cm^2) + load/(1 N/m)\n"
                  "constraints: [area <= 300 cm^2, bending >= 0]\n");
    cr_expect(p->units);
    expect_range(p, "r", 0.001, 0.02, 0.03);
    const ves_dim length = {.m = 6}, line_load = {.kg = 6, .s = -12};
    cr_expect(ves_dim_equal(variable(p, "r")->dim, length) && ves_dim_equal(p->curve[0].dim, length));
    cr_expect(!ves_dim_equal(variable(p, "q")->dim, length), "q is a plain number");
    cr_expect(ves_dim_equal(ves_formula_dim(p->parameter[1].formula), line_load));
    double limit = ves_formula_eval(p->constraint[0].right, NULL, NULL, (double[64]){0});
    expect_number(limit, 0.03, "300 cm^2");
    ves_problem_destroy(p);
    p = read_text(BASE "minimize: area + bending\nconstraints: [area <= 2*bending]\n");
    cr_expect(!p->units, "without units area and bending may be added");
    ves_problem_destroy(p);
}

Test(problem, plain_measures_are_instances_with_defaults_and_configured_ones_keep_their_settings)
{
    ves_problem *p =
        read_text("vesica: 1\n" CURVES "patches:\n"
                  "  a: {operator: {power: 1}, conditions: [{u: 0, position: p1}, {u: 1, position: p2}]}\n"
                  "  b: {operator: {power: 1}, conditions: [{u: 0, position: p2}, {u: 1, position: p1}]}\n"
                  "places: {tip: {patch: b, u: 0.5, v: pi}}\n"
                  "measures:\n"
                  "  lid: {area: {over: [b]}}\n"
                  "  bare: area\n"
                  "  sum: {integral: {of: \"x^2 + H\", over: b}}\n"
                  "  far: {distance: {from: tip, to: p1}}\n"
                  "minimize: lid + 2*sum + far\n"
                  "constraints: [area <= 3*bending, bare >= 0]\n"
                  "expect: [objective > 0, willmore < 5, violation <= 1e-6 and feasible, evaluations + "
                  "gradients + optima > 0]\n");
    static const char *const name[] = {"lid", "bare", "sum", "far", "area", "bending", "willmore"};
    static const char *const kind[] = {"area", "area", "integral", "distance", "area", "bending", "willmore"};
    cr_assert(p->measures == 7, "%d measures", p->measures);
    for (int k = 0; k < 7; k++)
        cr_expect(!strcmp(p->measure[k].name, name[k]) && !strcmp(p->measure[k].measure->name, kind[k]), "%s",
                  p->measure[k].name);
    cr_expect(p->measure[0].over == 1 && p->measure[0].patch[0] == 1 && p->measure[1].over == 0 &&
              p->measure[2].patch[0] == 1);
    const ves_arg *from = arg_of(&p->measure[3].args, "from"), *to = arg_of(&p->measure[3].args, "to");
    cr_expect(from->place && from->ref[0] == 0 && !to->place && to->ref[0] == curve_index(p, "p1"));
    double value[7] = {10, 11, 12, 13, 14, 15, 16}, room[64];
    expect_number(ves_formula_eval(p->objective, NULL, value, room), 10 + 24 + 13, "objective");
    expect_number(ves_formula_eval(p->constraint[0].left, NULL, value, room), 14, "left");
    expect_number(ves_formula_eval(p->constraint[0].right, NULL, value, room), 45, "right");
    const ves_formula *of = arg_of(&p->measure[2].args, "of")->formula[0];
    const double point[9] = {3, 0, 0, 0.5, 0, 0, 0, 0, 0}; /* x, y, z, H, K, k1, k2, u, v */
    expect_number(ves_formula_eval(of, NULL, point, room), 9.5, "x^2 + H");
    double check[7 + VES_EXPECT_NAMES] = {10, 11, 12, 13, 14, 15, 4};
    check[7 + VES_EXPECT_OBJECTIVE] = 1;
    check[7 + VES_EXPECT_FEASIBLE] = 1;
    check[7 + VES_EXPECT_OPTIMA] = 1;
    for (int k = 0; k < p->expects; k++)
        expect_number(ves_formula_eval(p->expect[k].formula, NULL, check, room), 1, p->expect[k].text);
    ves_problem_destroy(p);
}

Test(problem, a_variable_hides_a_measure_of_its_name)
{
    ves_problem *p =
        read_text("vesica: 1\nvariables: {height: [1, 2, 3]}\n"
                  "curves: {p1: {circle: 1}, p2: {circle: 2, apply: [{translate: [0, 0, height]}]}}\n" PATCHES
                  "minimize: height + area\n");
    cr_expect(p->measures == 1 && ves_formula_uses_slot(p->objective, 0));
    ves_problem_destroy(p);
}

Test(problem, every_setting_arrives)
{
    ves_problem *p = read_text(
        "vesica: 1\n"
        "variables: {w: [1, 2, 3]}\n" CURVES "modes: 64\n"
        "patches:\n"
        "  a: {operator: {power: 1}, conditions: [{u: 0, position: p1}, {u: 1, position: p2}], modes: 8}\n"
        "  f: {surface: {formula: [u, v, \"w*u*v\"]}, periodic: false, domain: {u: [0, 2], v: [1, 4]}}\n"
        "  g: {surface: {points: [[[0, 0, 0], [0, 1, 0], [0, 2, 0]], [[1, 0, 0], [1, 1, 0], [1, 2, 7]]]}, "
        "periodic: false}\n"
        "shape: {closed: true, caps: [a.u0, f.u1]}\n"
        "scale: {equation: area == 4*pi}\n"
        "maximize: volume\n"
        "constraints: [{require: bending >= 2, within: 1e-3}, bending == 3, 1 <= area]\n"
        "validity: {jacobian: any, self_intersection: never, least_radius: {value: 0.1, axis: [0, 1, 0], "
        "over: [a]}, monotone: {along: [0, 0, 1]}}\n"
        "quadrature: {u: 16, v: 32}\n"
        "seed: 9007199254740991\n"
        "search: [anneal, {polish: mma}, {anneal: {chains: 3, c0: 2*pi, s: 0.9, c_end: 1e-3, step: 0.2, "
        "adapt: false, weight: 7}},\n"
        "         {polish: {evaluations: 5, x_tolerance: 1e-4, f_tolerance: 1e-5, starts: 2, escape: "
        "false}}]\n"
        "test: {evaluations: 77, search: [{polish: cobyla}], expect: [feasible]}\n");
    double *block = block_of(p);
    cr_expect(p->curve_limit == 64 && p->patch[0].modes == 8 && p->patch[0].periodic);
    const ves_patch_def *f = &p->patch[1], *g = &p->patch[2];
    cr_expect(f->kind == VES_PATCH_FORMULA && !f->periodic && f->u_range[1] == 2 && f->v_range[0] == 1 &&
              f->v_range[1] == 4);
    expect_number(ves_formula_eval(f->formula[2], block, (double[]){3, 5}, (double[64]){0}), 30, "w*u*v");
    cr_expect(g->kind == VES_PATCH_POINTS && g->rows == 2 && g->columns == 3);
    expect_number(block[g->points + 3 * (1 * 3 + 2) + 2], 7, "last point");
    cr_expect(p->shape.closed && p->shape.caps == 2 && p->shape.cap[1].patch == 1 &&
              p->shape.cap[1].end == 1);
    cr_expect(p->scale && !strcmp(p->measure[p->scale->measure].name, "area") && p->maximize);
    cr_expect(p->constraint[0].relation == VES_AT_LEAST && p->constraint[0].within == 1e-3 &&
              p->constraint[1].relation == VES_EQUAL);
    cr_expect(!p->validity.jacobian && !p->validity.self_intersection && p->validity.radius_patches == 1);
    expect_number(block[p->validity.least_radius], 0.1, "least radius");
    expect_number(block[p->validity.axis + 1], 1, "axis");
    expect_number(block[p->validity.monotone + 2], 1, "along");
    cr_expect(p->quadrature[0] == 16 && p->quadrature[1] == 32 && p->search.seed == 9007199254740991u);
    const ves_stage *s = p->search.stage;
    cr_assert(p->search.stages == 4);
    cr_expect(s[0].kind == VES_STAGE_ANNEAL && s[0].anneal.c0 == 0 && s[1].kind == VES_STAGE_POLISH);
    cr_expect(!strcmp(s[1].polish.algorithm, "mma") && s[2].anneal.chains == 3 && s[2].anneal.s == 0.9 &&
              s[2].anneal.fixed);
    cr_expect(fabs(s[2].anneal.c0 - 6.283185307179586) < 1e-15 && s[2].anneal.weight == 7 &&
              s[2].anneal.step == 0.2);
    cr_expect(s[3].polish.evaluations == 5 && s[3].polish.starts == 2 && s[3].polish.stay &&
              s[3].polish.x_tolerance == 1e-4);
    cr_expect(p->test.evaluations == 77 && p->test.stages == 1 && p->test.seed == p->search.seed &&
              p->test_expects == 1);
    free(block);
    ves_problem_destroy(p);
}

Test(problem, marks_point_into_the_file)
{
    ves_problem *p = read_text(BASE "minimize: area\nconstraints:\n  - area <= 14\n");
    cr_expect(p->constraint[0].mark.line == 6 && p->constraint[0].mark.column == 5 &&
              p->constraint[0].mark.length == 10);
    cr_expect(p->curve[1].mark.line == 2 && p->curve[1].mark.column == 37 && p->patch[0].mark.line == 3);
    ves_problem_destroy(p);
}

Test(problem, anchors_and_merged_mappings_stand_for_what_they_name)
{
    ves_problem *p = read_text("vesica: 1\n"
                               "curves:\n"
                               "  p1: &ring {circle: &size {radius: 2, axis: [0, 1, 0]}}\n"
                               "  p2: *ring\n"
                               "  p3: {circle: {<<: *size, radius: 5}}\n"
                               "patches: {wall: {operator: {power: 1}, conditions: [{u: 0, position: p2}, "
                               "{u: 1, position: p3}]}}\n");
    double *block = block_of(p);
    const double radius[] = {2, 2, 5};
    for (int k = 0; k < 3; k++) {
        expect_number(block[arg_of(&p->curve[k].step[0].args, "radius")->first], radius[k], p->curve[k].name);
        expect_number(block[arg_of(&p->curve[k].step[0].args, "axis")->first + 1], 1, "axis");
    }
    free(block);
    ves_problem_destroy(p);
}

/* ---- a measure from outside ---- */

static const ves_key own_keys[] = {
    {.name = "c0", .kind = VES_NUMBER, .unit = "m^-1", .fallback = 0.5, .about = "spontaneous"},
    {.name = "about", .kind = VES_VECTOR, .fallback = 2, .about = "three"},
    {.name = "many", .kind = VES_COUNT, .fallback = 3, .about = "how many"},
    {.name = NULL}};
static ves_status own_eval(const ves_measure_input *input, double *value)
{
    *value = input->number[input->args->arg[0].first];
    return VES_OK;
}
static const ves_measure own = {.name = "helfrich",
                                .about = "a measure from outside",
                                .unit = "1",
                                .surface = VES_AREA,
                                .keys = own_keys,
                                .eval = own_eval};
static const ves_measure *const plugin[] = {&own, NULL};

Test(problem, a_plugin_is_used_like_a_measure_of_the_house)
{
    const ves_read_options options = {.plugin = plugin};
    ves_problem *p = read_with(
        BASE
        "measures: {E: {helfrich: 3/2}, F: {helfrich: {c0: 1, over: wall}}}\nminimize: E + F + helfrich\n",
        &options);
    double *block = block_of(p);
    const double c0[] = {1.5, 1, 0.5};
    cr_assert(p->measures == 3);
    for (int k = 0; k < 3; k++) {
        const ves_args *args = &p->measure[k].args;
        expect_number(block[args->arg[0].first], c0[k], p->measure[k].name);
        expect_number(block[args->arg[1].first + 2], 2, "fallback of a vector");
        cr_expect(args->count == 3 && args->arg[0].given == (k < 2) && args->arg[2].value == 3);
    }
    free(block);
    ves_problem_destroy(p);
    ves_diag *diag = ves_diag_create();
    static const char text[] = BASE "measures: {E: {helfrich: {many: 1e12}}}\n";
    char message[2000];
    cr_expect(ves_problem_read_text("x", text, strlen(text), &options, &p, diag) == VES_RANGE);
    ves_diag_text(diag, 0, message, sizeof message);
    cr_expect(strstr(message, "\"many\" is too large: 1000000000000") != NULL, "%s", message);
    ves_diag_destroy(diag);
}

Test(problem, a_plugin_that_is_not_sound_is_refused_before_the_file_is_read)
{
    static const ves_measure dumb = {.name = "dumb", .about = "no eval", .unit = "1", .surface = VES_AREA};
    const ves_measure *const faulty[] = {&own, &dumb, NULL}, *const twice[] = {&own, &own, NULL};
    const ves_read_options options[] = {{.plugin = faulty}, {.plugin = twice}};
    const char *const want[] = {"the measure \"dumb\" from outside has no eval",
                                "the measure \"helfrich\" from outside is there twice"};
    for (int k = 0; k < 2; k++) {
        ves_problem *p = NULL;
        ves_diag *diag = ves_diag_create();
        char message[2000] = "";
        cr_expect(ves_problem_read_text("x", BASE, strlen(BASE), &options[k], &p, diag) == VES_RANGE && !p);
        ves_diag_text(diag, 0, message, sizeof message);
        cr_expect(strstr(message, want[k]) != NULL && ves_diag_count(diag) == 1, "got %s, want %s", message,
                  want[k]);
        ves_diag_destroy(diag);
    }
}

Test(problem, a_variable_on_an_unused_curve_is_only_a_warning)
{
    ves_problem *p = NULL;
    ves_diag *diag = ves_diag_create();
    static const char text[] =
        "vesica: 1\nvariables: {r: [1, 2, 3]}\n"
        "curves: {p1: {circle: 1}, p2: {circle: 2}, d: {circle: r}, e: {like: d}}\n" PATCHES;
    char message[2000];
    cr_expect(ves_problem_read_text("x", text, strlen(text), NULL, &p, diag) == VES_OK &&
              ves_diag_count(diag) == 1);
    cr_expect(ves_diag_severity(diag, 0) == VES_WARNING);
    ves_diag_text(diag, 0, message, sizeof message);
    cr_expect(
        !strncmp(message, "x:2:13: warning: variable \"r\" moves only a curve that no patch uses\n", 67),
        "%s", message);
    ves_problem_destroy(p);
    ves_diag_destroy(diag);
}

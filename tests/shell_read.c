/* What the reader makes of the section `shell`: indices, masks, formulas, numbers. What it refuses stands in
 * tests/broken/shell-*.yaml. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "problem/material.h"
#include "problem/problem.h"
#include "shell_probe.h"

#define GEOMETRY                                                                                             \
    "curves: {base: {circle: {radius: 30 mm}}, rim: {circle: {radius: 40 mm}}, lip: {circle: {radius: 50 "   \
    "mm}}}\n"                                                                                                \
    "patches:\n"                                                                                             \
    "  bowl: {operator: {power: 1}, conditions: [{u: 0, position: base}, {u: 1, position: rim}]}\n"          \
    "  lid: {operator: {power: 1}, conditions: [{u: 0, position: base}, {u: 1, position: rim}]}\n"           \
    "  flange: {operator: {power: 1}, conditions: [{u: 1, position: rim}, {u: 0, position: lip}]}\n"         \
    "  roof: {surface: {formula: [\"u*1 m\", \"v*1 m\", \"0\"]}, periodic: false, domain: {u: [0, 5], v: "   \
    "[0, 2]}}\n"                                                                                             \
    "places: {tip: {patch: flange, u: 0.5, v: pi}, top: {patch: roof, u: 1, v: 0}}\n"

static const char full[] =
    "vesica: 1\n"
    "parameters: {thick: 0.2 mm}\n"
    "variables: {t: [0.1 mm, 0.3 mm, 0.5 mm], p: [1 kPa, 2 kPa, 3 kPa]}\n" GEOMETRY "shell:\n"
    "  parts:\n"
    "    flange: {thickness: \"t*(1 - 0.5*u)\", elements: [8, 16]}\n"
    "    bowl: {thickness: thick, elements: 4}\n"
    "    roof: {thickness: \"if(x < 2 m, 1 mm, 2 mm)\"}\n"
    "  material: {like: hips, E: 1 GPa, shear: 0.9}\n"
    "  supports:\n"
    "    - {at: rim, fix: [x, rz]}\n"
    "    - {at: roof.v1, symmetry: [0, 3, 4]}\n"
    "    - {at: flange.u0, diaphragm: [0, 0, -2]}\n"
    "    - {at: tip, spring: [1 N/m, 2 kN/m, 0]}\n"
    "    - {at: base, fix: pinned}\n"
    "    - {at: top, fix: all}\n"
    "  cases:\n"
    "    stack: [{at: rim, line: [0, \"-187 N/m*cos(v)\", 0]}, {at: tip, force: [1 N, 2 N, 3 N]}]\n"
    "    press: {over: [roof, bowl], pressure: \"p*u\"}\n"
    "    weigh: [{gravity: [0, -9.81 m/s^2, 0]}, {over: flange, area: [0, 0, 90 Pa]}]\n"
    "  mesh: {order: 2, elements: [12, 24], grading: 1.8}\n"
    "  verify: {order: 8}\n"
    "  symmetry: none\n"
    "measures: {a: {probe: {case: weigh, at: top}}, b: {probe: {case: press, at: flange.u0}}, c: {probe: "
    "{case: stack}}}\n"
    "minimize: a + b + c + area/(1 m^2)\n";

static ves_problem *read_problem(const char *text)
{
    ves_problem *problem = NULL;
    ves_diag *diag = ves_diag_create();
    char message[2000] = "";
    const ves_read_options options = {.plugin = shell_probes};
    ves_status status = ves_problem_read_text("shell", text, strlen(text), &options, &problem, diag);
    if (ves_diag_count(diag)) ves_diag_text(diag, 0, message, sizeof message);
    cr_assert(status == VES_OK, "%s", message);
    ves_diag_destroy(diag);
    return problem;
}

/* The slots at the start: [t, p, thick]. */
static const double START[3] = {0.3e-3, 2e3, 0.2e-3};

static double at(const ves_formula *formula, double x, double u, double v)
{
    double room[64];
    const double argument[VES_SHELL_ARGUMENTS] = {x, 0, 0, u, v};
    cr_assert(formula != NULL);
    cr_assert(ves_formula_room(formula) <= 64);
    return ves_formula_eval(formula, START, argument, room);
}

static double number(const ves_problem *p, int index)
{
    double room[64];
    cr_assert(index >= p->slots && index < p->block, "no number: %d", index);
    return ves_formula_eval(p->number[index - p->slots], START, NULL, room);
}

Test(shell_read, parts_stand_as_the_file_orders_them)
{
    ves_problem *p = read_problem(full);
    const ves_shell_def *s = p->shell;
    cr_assert(s != NULL);
    cr_assert(s->parts == 3);
    cr_expect(s->part[0].patch == 2 && s->part[1].patch == 0 && s->part[2].patch == 3);
    cr_expect(at(s->part[0].thickness, 0, 1, 0) == 0.15e-3, "varies with u: %g",
              at(s->part[0].thickness, 0, 1, 0));
    cr_expect(s->part[0].varies && s->part[0].uniform == -1);
    cr_expect(s->part[0].elements[0] == 8 && s->part[0].elements[1] == 16);
    cr_expect(number(p, s->part[1].uniform) == 0.2e-3, "the same everywhere is a number too");
    cr_expect(at(s->part[1].thickness, 0, 0, 0) == 0.2e-3);
    cr_expect(s->part[1].elements[0] == 4 && s->part[1].elements[1] == 4 && s->part[1].varies == false);
    cr_expect(s->part[2].uniform == -1 && s->part[2].elements[0] == 0);
    cr_expect(at(s->part[2].thickness, 1, 0, 0) == 1e-3 && at(s->part[2].thickness, 3, 0, 0) == 2e-3);
    cr_expect(s->mesh.given && s->mesh.order == 2 && s->mesh.elements[1] == 24 && s->mesh.grading == 1.8);
    cr_expect(s->verify.given && s->verify.order == 8 && s->verify.elements[0] == 0 &&
              s->verify.grading == 0);
    cr_expect(s->symmetric == false);
    ves_problem_destroy(p);
}

Test(shell_read, a_material_is_like_another_but_for_what_is_given)
{
    ves_problem *p = read_problem(full);
    const ves_shell_def *s = p->shell;
    const ves_material *hips = ves_material_find("hips");
    cr_expect(s->material != NULL);
    cr_expect(strcmp(s->material, "hips") == 0 && strcmp(s->made_of, "E 1 GPa, shear 0.9, like hips") == 0,
              "%s", s->made_of);
    cr_expect(number(p, s->E) == 1e9 && number(p, s->nu) == hips->nu &&
              number(p, s->density) == hips->density && number(p, s->yield) == hips->yield &&
              number(p, s->shear) == 0.9);
    ves_problem_destroy(p);
}

Test(shell_read, materials_of_the_table_are_in_the_ranges_of_the_keys)
{
    int count = 0;
    for (const ves_material *m = ves_materials(); m->name; m++, count++) {
        cr_expect(m->about && m->source && *m->source, "%s: who says so?", m->name);
        cr_expect(m->E > 1e8 && m->E < 1e12 && m->nu > 0 && m->nu < 0.4999 && m->density > 500 &&
                      m->density < 2e4 && m->yield > 1e6 && m->yield < m->E / 30,
                  "%s is in other units", m->name);
        cr_expect(ves_material_find(m->name) == m, "%s is not the first of its name", m->name);
    }
    cr_expect(count >= 6 && ves_material_find("unobtainium") == NULL);
}

Test(shell_read, supports_know_the_ends_that_lie_on_a_curve)
{
    ves_problem *p = read_problem(full);
    const ves_shell_def *s = p->shell;
    const ves_support_def *k = s->support;
    cr_assert(s->supports == 6);
    /* the lid ends on the rim too, but is no part; of the flange it is the end u = 1, of the bowl as well */
    cr_expect(k[0].at.kind == VES_AT_CURVE && k[0].at.edges == 2 && k[0].at.on[0].part == 0 &&
              k[0].at.on[0].edge == VES_EDGE_U1 && k[0].at.on[1].part == 1 &&
              k[0].at.on[1].edge == VES_EDGE_U1);
    cr_expect(strcmp(p->curve[k[0].at.index].name, "rim") == 0 && k[0].kind == VES_SUPPORT_FIX &&
              k[0].fix == (1u | 1u << 5));
    cr_expect(k[1].at.kind == VES_AT_EDGE && k[1].at.index == 3 && k[1].at.part == 2 &&
              k[1].at.edge == VES_EDGE_V1 && k[1].at.edges == 1 && k[1].at.on[0].edge == VES_EDGE_V1);
    cr_expect(k[1].kind == VES_SUPPORT_SYMMETRY && fabs(k[1].axis[1] - 0.6) < 1e-15 &&
                  fabs(k[1].axis[2] - 0.8) < 1e-15,
              "a unit vector, to rounding");
    cr_expect(k[2].kind == VES_SUPPORT_DIAPHRAGM && k[2].axis[2] == -1 && k[2].at.part == 0);
    cr_expect(k[3].kind == VES_SUPPORT_SPRING && k[3].at.kind == VES_AT_PLACE && k[3].at.index == 0 &&
              k[3].at.part == 0 && k[3].at.edges == 0);
    cr_expect(number(p, k[3].spring) == 1 && number(p, k[3].spring + 1) == 2000 &&
              number(p, k[3].spring + 2) == 0);
    cr_expect(k[4].fix == 7 && k[4].at.edges == 1 && k[4].at.on[0].part == 1);
    cr_expect(k[5].fix == 63 && k[5].at.part == 2);
    ves_problem_destroy(p);
}

Test(shell_read, loads_are_formulas_of_the_place_and_of_the_variables)
{
    ves_problem *p = read_problem(full);
    const ves_shell_def *s = p->shell;
    cr_assert(s->cases == 3);
    const ves_case_def *c = s->load_case;
    cr_expect(strcmp(c[0].name, "stack") == 0 && c[0].loads == 2 && c[1].loads == 1 && c[2].loads == 2);
    const ves_load_def *line = &c[0].load[0], *force = &c[0].load[1], *pressure = &c[1].load[0],
                       *gravity = &c[2].load[0], *area = &c[2].load[1];
    cr_expect(line->kind == VES_LOAD_LINE && line->at.edges == 2 && at(line->formula[1], 0, 0, 0) == -187 &&
              at(line->formula[0], 0, 0, 0) == 0 && line->varies == false);
    cr_expect(force->kind == VES_LOAD_FORCE && force->at.kind == VES_AT_PLACE &&
              at(force->formula[2], 0, 0, 0) == 3);
    cr_expect(pressure->kind == VES_LOAD_PRESSURE && pressure->parts == 2 && pressure->part[0] == 2 &&
              pressure->part[1] == 1 && pressure->varies && at(pressure->formula[0], 0, 0.5, 0) == 1000 &&
              pressure->formula[1] == NULL);
    cr_expect(gravity->kind == VES_LOAD_GRAVITY && gravity->parts == 3 && gravity->part[2] == 2 &&
              at(gravity->formula[1], 0, 0, 0) == -9.81);
    cr_expect(area->kind == VES_LOAD_AREA && area->parts == 1 && area->part[0] == 0 &&
              at(area->formula[2], 0, 0, 0) == 90);
    ves_problem_destroy(p);
}

Test(shell_read, measures_get_indices_of_cases_and_places)
{
    ves_problem *p = read_problem(full);
    const ves_shell_def *s = p->shell;
    cr_assert(p->measures >= 3 && s->ats == 2);
    const ves_arg *a = p->measure[0].args.arg, *b = p->measure[1].args.arg, *c = p->measure[2].args.arg;
    cr_expect(a[0].value == 2 && b[0].value == 1 && c[0].value == 0);
    cr_expect(a[1].value == 0 && b[1].value == 1 && c[1].value == -1 && c[1].given == false);
    cr_expect(s->at[0].kind == VES_AT_PLACE && s->at[0].index == 1 && s->at[1].kind == VES_AT_EDGE &&
              s->at[1].part == 0);
    ves_problem_destroy(p);
}

/* A file without units; one case, which needs no name; the only mesh is the one that is chosen. */
Test(shell_read, the_least_that_is_needed)
{
    ves_problem *p = read_problem(
        "vesica: 1\ncurves: {p1: {circle: {radius: 1}}, p2: {circle: {radius: 2}}}\n"
        "patches: {wall: {operator: {power: 1}, conditions: [{u: 0, position: p1}, {u: 1, position: p2}]}}\n"
        "shell: {parts: {wall: {thickness: 0.1}}, material: {E: 7, nu: 0}, supports: {at: p1, fix: all},\n"
        "        cases: {only: {pressure: 1}}, mesh: auto}\n"
        "minimize: probe\n");
    const ves_shell_def *s = p->shell;
    cr_assert(s != NULL);
    cr_expect(s->density == -1 && s->yield == -1 && s->material == NULL && number(p, s->shear) == 5.0 / 6);
    cr_expect(s->symmetric && s->mesh.given == false && s->verify.given == false && s->ats == 0);
    cr_expect(p->measure[0].args.arg[0].value == 0 && p->measure[0].args.arg[0].given == false);
    cr_expect(strcmp(s->made_of, "E 7, nu 0") == 0, "%s", s->made_of);
    ves_problem_destroy(p);
}

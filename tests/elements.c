/* Finite elements over figures, and the decks that are made of them: read back as a program would. What
 * CalculiX says to them is in tests/slow/calculix.sh. */
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bed.h"
#include "files.h"
#include "output/output.h"
#include "surface/elements.h"

static const double pi = 3.14159265358979323846;

/* Sums of some thousand numbers, each rounded to 13 digits; relative. */
static const double rounding = 1e-10;

enum { NODES = 8000, CASES = 2 };

/* A deck as read: every line understood, or the test fails. */
typedef struct deck {
    bool axis;
    int nodes, elements, triangles, springs, held, mirrors, steps, buckles, equations, thick;
    double point[NODES][3], total[CASES][3], stiffness, E, density, thickness, most;
    char set[1000], section[1000];
} deck;

static void keyword(deck *d, const char *line, char word[64])
{
    int k = 0;
    for (; line[k] && line[k] != ','; k++) word[k] = line[k];
    word[k] = 0;
    if (!strcmp(word, "*STATIC")) d->steps++;
    if (!strcmp(word, "*BUCKLE")) d->buckles++;
    if (!strcmp(word, "*EQUATION")) d->equations++;
    if (!strcmp(word, "*SPRING")) d->axis = false;
    if (strstr(line, "TYPE=S6")) strcpy(word, "S6");
    if (strstr(line, "TYPE=SPRING1")) strcpy(word, "SPRING1");
    const char *set = strstr(line, "ELSET=");
    if (set && !strcmp(word, "*ELEMENT")) strcat(strcat(d->set, set + 6), " ");
    if (!strcmp(word, "*SHELL SECTION")) strcat(strcat(d->section, line), "|");
}

static void data(deck *d, const char *word, const char *line)
{
    double value[9] = {0};
    int count = 0;
    char *end = NULL;
    for (const char *at = line; at && *at && !isalpha((unsigned char)*at) && count < 9; count++) {
        value[count] = strtod(at, &end);
        cr_assert(end != at, "%s", line);
        cr_assert(end - at <= 20, "CalculiX reads 20 characters of a number: %s", line);
        at = *end == ',' ? end + 1 : NULL;
    }
    int node = fabs(value[0]) < 1e9 ? (int)value[0] - 1 : -1; /* else it is no number of a node */
    if (!strcmp(word, "*NODE")) {
        cr_assert(node == d->nodes && node < NODES, "%s", line);
        memcpy(d->point[d->nodes++], value + 1, sizeof *d->point);
    } else if (!strcmp(word, "*ELEMENT") || !strcmp(word, "S6")) {
        d->triangles += !strcmp(word, "S6");
        cr_assert(++d->elements == (int)value[0] && count == (*word == 'S' ? 7 : 9), "%s", line);
        for (int k = 1; k < count; k++) cr_assert(value[k] >= 1 && value[k] <= d->nodes, "%s", line);
    } else if (!strcmp(word, "SPRING1"))
        d->springs++;
    else if (!strcmp(word, "*SPRING"))
        d->stiffness += d->axis ? value[0] : 0, d->axis = !d->axis; /* the first line says along which axis */
    else if (!strcmp(word, "*NSET"))
        d->held++;
    else if (!strcmp(word, "*ELASTIC"))
        d->E = value[0];
    else if (!strcmp(word, "*DENSITY"))
        d->density = value[0];
    else if (!strcmp(word, "*SHELL SECTION"))
        d->thickness = value[0];
    else if (!strcmp(word, "*NODAL THICKNESS"))
        d->thick++, d->most = fmax(d->most, value[1]);
    else if (!strcmp(word, "*CLOAD") && !d->buckles)
        d->total[d->steps - 1][(int)value[1] - 1] += value[2];
}

static deck read_deck(const char *path)
{
    static deck d;
    char line[256], word[64] = "";
    FILE *in = fopen(path, "r");
    cr_assert(in != NULL, "%s", path);
    memset(&d, 0, sizeof d);
    while (fgets(line, sizeof line, in)) {
        line[strcspn(line, "\n")] = 0;
        if (strstr(line, "in a plane of symmetry")) d.mirrors++;
        if (*line == '*' && line[1] != '*') keyword(&d, line, word);
        if (*line != '*') data(&d, word, line);
    }
    fclose(in);
    return d;
}

static ves_figure *figure_of(const bed *b, int nu, int nv)
{
    ves_figure *figure;
    double none = 0;
    cr_assert_eq(ves_plan_figure(b->plan, &none, nu, nv, &figure, b->diag), VES_OK);
    cr_assert(figure->shell != NULL);
    return figure;
}

static deck deck_of(const char *text, int nu, int nv, double scale, int factors)
{
    bed b = bed_with(text, NULL, 8, 16);
    ves_figure *figure = figure_of(&b, nu, nv);
    if (scale != 1) ves_figure_scale(figure, scale, "mm");
    figure->shell->factors = factors;
    ves_status status = ves_figure_write(figure, path_of("a.inp"), b.diag);
    char line[1000] = "";
    if (status != VES_OK) ves_diag_text(b.diag, 0, line, sizeof line);
    cr_assert_eq(status, VES_OK, "%s", line);
    deck d = read_deck(path_of("a.inp"));
    clean();
    ves_figure_destroy(figure);
    bed_clear(&b);
    return d;
}

/* Functions that are 1 at one node and 0 at the others, with derivatives as differences have them. */
Test(elements, shapes_are_those_of_their_nodes)
{
    static const double at[2][8][2] = {{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {0, -1}, {1, 0}, {0, 1}, {-1, 0}},
                                       {{0, 0}, {1, 0}, {0, 1}, {.5, 0}, {.5, .5}, {0, .5}}};
    double N[8], r[8], s[8], far[8], none[8], h = 1e-6;
    for (int kind = 0; kind < 2; kind++) {
        int nodes = kind ? VES_TRIANGLE_NODES : VES_ELEMENT_NODES;
        for (int n = 0; n < nodes; n++) {
            ves_element_shape(nodes, at[kind][n][0], at[kind][n][1], N, r, s);
            for (int k = 0; k < nodes; k++) cr_expect(fabs(N[k] - (k == n)) < 1e-15, "%d %d %g", n, k, N[k]);
        }
        ves_element_shape(nodes, .137, .291, N, r, s);
        for (int axis = 0; axis < 2; axis++) {
            ves_element_shape(nodes, .137 + (axis ? 0 : h), .291 + (axis ? h : 0), far, none, none);
            for (int k = 0; k < nodes; k++)
                cr_expect(fabs((far[k] - N[k]) / h - (axis ? s : r)[k]) < 5 * h, "%d: %g %g", k, r[k], s[k]);
        }
    }
}

static const char POT[] =
    "vesica: 1\ncurves:\n"
    "  base: {circle: {radius: 30 mm, axis: [0, 1, 0]}}\n"
    "  rim: {circle: {radius: 37.5 mm, axis: [0, 1, 0], centre: [0 mm, 48 mm, 0 mm]}}\n"
    "  brim: {circle: {radius: 40.5 mm, axis: [0, 1, 0], centre: [0 mm, 48 mm, 0 mm]}}\n"
    "  middle: {point: [0 mm, 0 mm, 0 mm]}\n"
    "patches:\n"
    "  bowl: {operator: {power: 1, a: 0.1}, conditions: [{u: 0, position: base}, {u: 1, position: rim}]}\n"
    "  lid: {operator: {power: 1, a: 0.1}, conditions: [{u: 0, position: base}, {u: 1, position: middle}]}\n"
    "  Bowl: {operator: {power: 1, a: 0.1}, conditions: [{u: 0, position: rim}, {u: 1, position: brim}]}\n"
    "shell:\n"
    "  parts: {bowl: {thickness: 0.2 mm}, Bowl: {thickness: \"0.2 mm*(1 - 0.25*u)\"}}\n"
    "  material: {E: 3 GPa, nu: 0.35, density: 1050 kg/m^3}\n"
    "  supports: [{at: base, fix: all}, {at: brim, spring: [0 Pa, 1 kPa, 0 Pa]}]\n"
    "  cases:\n"
    "    stack: [{at: rim, line: [0 N/m, -187 N/m, 0 N/m]}]\n"
    "    shove: [{at: rim, force: [3 N, 0 N, 0 N]}, {gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]}]\n"
    "measures:\n"
    "  bowls: {integral: {of: \"0.2 mm\", over: [bowl]}}\n"
    "  brims: {integral: {of: \"0.2 mm*(1 - 0.25*u)\", over: [Bowl]}}\n"
    "expect: [bowls + brims > 0 m^3]\n";

/* A ring of n parabolas through its nodes is as long as the circle within (pi/n)^4 / 45, n = 12: 1e-4. So
 * is its area within twice that. A total force is what was asked for, to rounding. */
Test(elements, a_pot_with_a_brim_comes_out_whole)
{
    double none = 0, circle = 2 * pi * .0375;
    deck d = deck_of(POT, 8, 24, 1, 2);
    cr_expect_eq(d.nodes, 24 * 17 - 12 * 8, "%d", d.nodes);
    cr_expect_eq(d.elements, 2 * 4 * 12);
    cr_expect_eq(d.triangles, 0);
    cr_expect_str_eq(d.set, "BOWL BOWL_PART_3 ");
    cr_expect_str_eq(d.section, "*SHELL SECTION, ELSET=BOWL, MATERIAL=MATERIAL|"
                                "*SHELL SECTION, ELSET=BOWL_PART_3, MATERIAL=MATERIAL, NODAL THICKNESS|");
    cr_expect_eq(d.held, 48, "24 nodes each, %d", d.held);
    cr_expect_eq(d.springs, 24, "%d", d.springs);
    cr_expect_eq(d.thick, 24 * 9 - 12 * 4, "%d", d.thick);
    cr_expect(d.most == 2e-4 && d.E == 3e9 && d.density == 1050, "%g", d.most);
    cr_expect(d.steps == 2 && d.buckles == 2 && d.equations == 0);
    cr_expect(fabs(d.total[0][1] / (-187 * circle) - 1) < 1e-4, "%.9g", d.total[0][1]);
    cr_expect(fabs(d.stiffness / (1000 * 2 * pi * .0405) - 1) < 1e-4, "%.9g", d.stiffness);
    cr_expect(d.total[0][0] == 0 && d.total[0][2] == 0);
    cr_expect(fabs(d.total[1][0] / 3 - 1) < rounding, "%.15g", d.total[1][0]);

    bed b = bed_with(POT, NULL, 16, 32);
    ves_design design;
    cr_assert_eq(ves_plan_measure(b.plan, &none, 0, &design), VES_OK);
    double weight = -9.81 * 1050 * (design.measure[0] + design.measure[1]);
    cr_expect(fabs(d.total[1][2] / weight - 1) < 2e-4, "%.9g %.9g", d.total[1][2], weight);
    bed_clear(&b);

    deck mm = deck_of(POT, 8, 24, 1000, 0);
    cr_expect(fabs(mm.E / 3000 - 1) < rounding && fabs(mm.density / 1.05e-9 - 1) < rounding,
              "N, mm, t: %g %g", mm.E, mm.density);
    cr_expect(fabs(mm.most - .2) < 1e-13 && mm.buckles == 0);
    cr_expect(fabs(mm.point[0][0] - 30) < 1e-12);
    for (int c = 0; c < 3; c++) cr_expect(fabs(mm.total[1][c] - d.total[1][c]) < 1e-11, "forces stay");
    check_nothing_left();
}

/* A quarter of a roof becomes a whole one, with nothing held in its planes of symmetry. */
Test(elements, planes_of_symmetry_mirror)
{
    static const char roof[] =
        "vesica: 1\npatches:\n"
        "  roof:\n    surface: {formula: [\"25*sin(v)\", \"25*cos(v)\", \"u - 3\"]}\n"
        "    domain: {u: [0, 25], v: [0, 40 deg]}\n    periodic: false\n"
        "shell:\n  parts: {roof: {thickness: 0.25}}\n  material: {E: 4.32e8, nu: 0}\n"
        "  supports:\n    - {at: roof.u0, symmetry: [0, 0, 1]}\n    - {at: roof.v0, symmetry: [-1, 0, 0]}\n"
        "    - {at: roof.u1, diaphragm: [0, 0, 1]}\n"
        "  cases: {weight: [{over: [roof], area: [0, -90, 0]}], push: [{at: roof.u0, line: [1, 0, 7]}]}\n"
        "expect: [area > 0]\n";
    deck d = deck_of(roof, 8, 8, 1, 0);
    double whole = 50 * 25 * 80 * pi / 180, low = HUGE_VAL, high = -HUGE_VAL;
    cr_expect_eq(d.nodes, 17 * 17 - 8 * 8, "%d", d.nodes);
    cr_expect_eq(d.elements, 64);
    cr_expect_eq(d.mirrors, 2);
    cr_expect_eq(d.held, 3 * 17 + 17, "%d", d.held);
    cr_expect(fabs(d.total[0][1] / (-90 * whole) - 1) < 1e-6, "%.12g", d.total[0][1]);
    cr_expect(fabs(d.total[0][0]) < 1e-9 && fabs(d.total[0][2]) < 1e-9);
    cr_expect(fabs(d.total[1][0]) < 1e-12 && fabs(d.total[1][2]) < 1e-12, "pushes that are mirrored cancel");
    for (int k = 0; k < d.nodes; k++) low = fmin(low, d.point[k][2]), high = fmax(high, d.point[k][2]);
    cr_expect(fabs(low + 28) < 1e-12 && fabs(high - 22) < 1e-12, "about z = -3: %g %g", low, high);
}

/* A ball with triangles about its poles is closed: V - E + F = 2, and a pressure has no resultant. A
 * diaphragm that is askew holds two sums of displacements. */
Test(elements, poles_and_oblique_diaphragms)
{
    static const char ball[] =
        "vesica: 1\npatches:\n"
        "  ball:\n    surface: {formula: [\"sin(u)*cos(v)\", \"cos(u)\", \"sin(u)*sin(v)\"]}\n"
        "    domain: {u: [0, pi], v: [0, 2*pi]}\n"
        "curves: {tip: {point: [0, 1, 0]}}\n"
        "places: {left: {patch: ball, u: 0.5, v: 0}, off: {patch: ball, u: 0.26, v: 1}}\n"
        "shell:\n  parts: {ball: {thickness: 0.01}}\n  material: {E: 1e9, nu: 0.3}\n"
        "  supports: [{at: left, fix: [x, y, z]}, {at: ball.u0, diaphragm: [0.6, 0.8, 0]}]\n"
        "  cases: {blow: [{over: [ball], pressure: 1}], poke: [{at: off, force: [0.1, 0.2, -0.3]}]}\n"
        "expect: [area > 0]\n";
    deck d = deck_of(ball, 8, 12, 1, 0);
    int faces = 4 * 6, edges = 6 * 4 + 6 * 3; /* meridians, parallels */
    cr_expect_eq(d.elements, faces);
    cr_expect_eq(d.triangles, 12);
    cr_expect_eq(d.nodes - edges, 2 - faces + edges, "%d nodes, one on each edge", d.nodes);
    cr_expect_eq(d.equations, 1, "across z it is held outright: %d", d.equations);
    for (int c = 0; c < 3; c++) {
        cr_expect(fabs(d.total[0][c]) < 1e-11, "%g", d.total[0][c]);
        cr_expect(fabs(d.total[1][c] - (c < 2 ? .1 * (c + 1) : -.3)) < 1e-12, "%g", d.total[1][c]);
    }
}

Test(elements, what_cannot_be_carried_is_refused)
{
    static const char strip[] = "vesica: 1\npatches:\n  strip:\n    surface: {formula: [\"u\", \"v\", "
                                "\"0\"]}\n    domain: {u: [0, 3], v: [0, 1]}\n"
                                "    periodic: false\n"
                                "places: {here: {patch: strip, u: 0.3, v: 0.3}}\n"
                                "shell:\n  parts: {strip: {thickness: 0.01}}\n  material: {E: 1e9, nu: 0.3}\n"
                                "  supports: [{at: strip.u0, %s}%s]\n"
                                "  cases: {blow: [{over: [strip], pressure: 1}]}\n"
                                "expect: [area > 0]\n";
    static const struct {
        const char *support, *more;
        int nu, nv;
        const char *says;
    } row[] = {
        {"fix: all", "", 7, 8, "has 7 x 8: give a --grid of even numbers"},
        {"fix: all", ", {at: here, fix: [x]}", 8, 8,
         "no node of its elements lies at \"here\" on 8 x 8 cells"},
        {"symmetry: [0.6, 0.8, 0]", "", 8, 8, "across none of x, y and z"},
        {"symmetry: [0, 1, 0]", "", 8, 8, "does not lie in one plane of symmetry across y"},
        {"fix: [x, y, z, rx]", "", 8, 8, "some, not all, rotations of a node are held"},
    };
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        char text[1000], line[1000] = "";
        snprintf(text, sizeof text, strip, row[k].support, row[k].more);
        bed b = bed_with(text, NULL, 8, 8);
        ves_figure *figure = figure_of(&b, row[k].nu, row[k].nv);
        ves_status status = ves_figure_write(figure, path_of("a.inp"), b.diag);
        cr_expect(status == (k == 4 ? VES_OK : VES_USAGE), "%zu: %d", k, status);
        if (ves_diag_count(b.diag)) ves_diag_text(b.diag, 0, line, sizeof line);
        cr_expect(strstr(line, row[k].says) != NULL, "%zu: %s", k, line);
        cr_expect_eq(ves_figure_write(figure, path_of("a.stl"), b.diag), VES_OK, "meshes need no elements");
        clean();
        ves_figure_destroy(figure);
        bed_clear(&b);
    }
    bed b = bed_with("vesica: 1\npatches: {s: {surface: {formula: [\"cos(v)\", \"sin(v)\", "
                     "\"u\"]}}}\nexpect: [area > 0]\n",
                     NULL, 8, 8);
    ves_figure *figure;
    double none = 0;
    cr_assert_eq(ves_plan_figure(b.plan, &none, VES_FIGURE_ELEMENTS, VES_FIGURE_ELEMENTS, &figure, b.diag),
                 VES_OK);
    cr_expect(figure->shell == NULL);
    cr_expect_eq(ves_figure_write(figure, path_of("a.inp"), b.diag), VES_USAGE, "no shell");
    ves_figure_destroy(figure);
    bed_clear(&b);
    check_nothing_left();
}

/* Chosen grids: four cells to a layer sqrt(R t) of the bowl, and none longer than four times its width in a
 * narrow brim. */
Test(elements, grids_are_chosen_by_layers)
{
    bed b = bed_with(POT, NULL, 16, 32);
    ves_figure *figure = figure_of(&b, VES_FIGURE_ELEMENTS, VES_FIGURE_ELEMENTS);
    const ves_figure_patch *bowl = &figure->patch[0], *brim = &figure->patch[2];
    double layer = sqrt(.034 * 2e-4), wide = 2 * pi * .0375 / bowl->nv;
    cr_expect(.05 / bowl->nu < layer / 3 && .05 / bowl->nu > layer / 6, "%d", bowl->nu);
    cr_expect(bowl->nu % 2 == 0 && bowl->nv % 2 == 0 && brim->nu % 2 == 0 && brim->nv == bowl->nv);
    cr_expect(.003 / brim->nu > wide / 6 && .003 / brim->nu < wide, "%d x %d", brim->nu, brim->nv);
    cr_expect(figure->shell->refused == NULL);
    ves_figure_destroy(figure);
    bed_clear(&b);
}

/* What supports hold a shell with: against its loads, whatever part of it is analysed. (A propped cantilever in closed
 * form: problems/shell/propped.yaml.) */
#include <criterion/criterion.h>

#include <math.h>
#include <stdio.h>

#include "bed.h"

enum { TEXT = 4000 };

/* Of the weight by the area of the surface, where elements have their own: what order 6 leaves out of it. */
static const double AREA = 1e-6;

/* Of what is held: rounding of a solution, of stiffnesses across a wall 1e4 times those that hold it. */
static const double ROUNDING = 1e-8;

static double asked(const char *shell, const char *measures, const char *objective)
{
    char text[TEXT];
    int length = snprintf(text, sizeof text,
                          "vesica: 1\nvariables: {w: [0.5, 1, 2]}\n%smeasures: {%s}\nminimize: %s\n", shell,
                          measures, objective);
    cr_assert(length < TEXT);
    bed b = bed_with(text, NULL, 0, 0);
    double value = value_at(&b, &b.problem->variable[0].start);
    bed_clear(&b);
    return value;
}

static void zero(double got, double scale, const char *what)
{
    cr_assert(fabs(got) <= ROUNDING * scale, "%s: got %.3e of %.3g", what, got, scale);
}

/* A tube of radius 1 and length 2 with a weight, a line and a pressure; oval and wavy tubes are sectors too. */
#define TUBE(radius, more, supports)                                                                         \
    "patches:\n  wall:\n    surface: {formula: [\"" radius "*cos(v)*w\", \"2*u\", \"" radius "*sin(v)" more  \
    "\"]}\n"                                                                                                 \
    "shell:\n  parts: {wall: {thickness: 0.02}}\n"                                                           \
    "  material: {E: 1e6, nu: 0.3, density: 3}\n  supports: [" supports "]\n"                                \
    "  cases:\n    line: [{at: wall.u1, force: [0, -7, 0]}]\n    weight: [{gravity: [0, -2, 0]}]\n"          \
    "    both: [{at: wall.u1, line: [0, -3, 0]}, {area: [0, 0.4, 0]}]\n"
#define FOOT "{at: wall.u0, fix: all}"

static const char *const TUBES[][2] = {
    {"strip", TUBE("1", "", FOOT)},
    {"sector", TUBE("(1 + 0.02*cos(8*v))", "", FOOT)},
    {"turned sector", TUBE("(1 + 0.02*cos(8*v) + 0.01*sin(16*v))", "", FOOT)},
    {"quarter", TUBE("1", "*1.2", FOOT)},
    {"whole", TUBE("1", "", FOOT) "  symmetry: none\n"},
    {"on springs", TUBE("1", "", "{at: wall.u0, fix: [x, z]}, {at: wall.u0, spring: [0, 50, 0]}")}};

Test(shell_reaction, is_against_the_loads)
{
    for (size_t k = 0; k < sizeof TUBES / sizeof *TUBES; k++) {
        const char *of = TUBES[k][1], *what = TUBES[k][0];
        zero(asked(of, "R: {reaction: {case: line, at: wall.u0, along: [0, 1, 0]}}", "R") - 7, 7, what);
        zero(asked(of, "R: {reaction: {case: weight, at: wall.u0, along: [0, 2, 0]}}, m: {mass: {}}", "R/m") -
                 2,
             2 * AREA / ROUNDING, what);
        zero(asked(of, "R: {reaction: {case: line, at: wall.u0, along: [1, 0, 0]}}", "R"), 7, what);
        zero(asked(of, "R: {reaction: {case: line, at: wall.u0, along: [0, 0, 1]}}", "R"), 7, what);
    }
}

/* A sheet that is held in several ways, in all directions: what is held where adds up. */
#define SHEET(order)                                                                                         \
    "patches:\n  roof:\n    surface: {formula: [\"2*u\", \"0.3*u*(1 - u)\", \"w*v\"]}\n    periodic: "       \
    "false\n"                                                                                                \
    "    domain: {u: [0, 1], v: [0, 1]}\n"                                                                   \
    "places: {mid: {patch: roof, u: 0.5, v: pi}, end: {patch: roof, u: 1, v: 2*pi}}\n"                       \
    "shell:\n  parts: {roof: {thickness: 0.05}}\n  material: {E: 1e5, nu: 0.3}\n"                            \
    "  mesh: {order: " order ", elements: [4, 4]}\n"                                                         \
    "  supports: [{at: roof.u0, fix: pinned}, {at: end, fix: y}, {at: end, spring: [3, 0, 40]}, {at: "       \
    "roof.v0, "                                                                                              \
    "spring: [20, 300, 10]}]\n"                                                                              \
    "  cases: {all: [{at: mid, force: [1, -5, 2]}, {at: roof.u1, force: [0.5, 1, -3]}, {at: end, force: "    \
    "[2, 3, 4]}]}\n"

Test(shell_reaction, of_all_supports_adds_up)
{
    static const char *const order[] = {SHEET("1"), SHEET("2"), SHEET("6")}, *const way[] = {"1, 0, 0",
                                                                                             "0, 1, 0",
                                                                                             "0, 0, 1"};
    static const double load[] = {3.5, -1, 3};
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 3; c++) {
            char measures[400];
            snprintf(measures, sizeof measures,
                     "a: {reaction: {at: roof.u0, along: [%s]}}, b: {reaction: {at: end, along: [%s]}}, c: "
                     "{reaction: "
                     "{at: roof.v0, along: [%s]}}",
                     way[c], way[c], way[c]);
            zero(asked(order[k], measures, "a + b + c") + load[c], 10, way[c]);
        }
}

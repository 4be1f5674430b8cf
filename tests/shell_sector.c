/* Which part of a tube is solved, and that it gives the numbers of the whole: what is local, or asked in one direction, must be seen. */
#include <criterion/criterion.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "problem/problem.h"
#include "vesica/plan.h"

enum { TEXT = 2000, STRIP = 0, WHOLE = 1, HALF = 2, QUARTER = 4 };

/* radius, thickness, loads, measure */
static const char TUBE[] =
    "vesica: 1\nvariables: {p: [0.5, 1, 2]}\n"
    "patches:\n  wall: {surface: {formula: [\"cos(v)*(%s)\", \"u\", \"sin(v)*(%s)\"]}}\n"
    "shell:\n  parts: {wall: {thickness: \"%s\"}}\n  material: {E: 1e6, nu: 0.3}\n"
    "  supports: [{at: wall.u0, fix: all}]\n  cases: {a: [%s]}\n"
    "  mesh: {order: 6, elements: [2, 12]}\n  symmetry: %s\n"
    "measures: {m: {%s}}\nminimize: m\nquadrature: {u: 8, v: 16}\n";

typedef struct tube {
    const char *radius, *thickness, *loads, *measure;
    int copies; /* 0: a strip */
} tube;

static const char INSIDE[] = "{pressure: p}", LARGEST[] = "displacement: {}";

static double measured(const tube *t, bool whole, int *copies)
{
    char text[TEXT];
    const double x = 1;
    ves_problem *problem = NULL;
    ves_plan *plan = NULL;
    ves_design design;
    snprintf(text, sizeof text, TUBE, t->radius, t->radius, t->thickness, t->loads, whole ? "none" : "auto",
             t->measure);
    cr_assert_eq(ves_problem_read_text("tube.yaml", text, strlen(text), NULL, &problem, NULL), VES_OK, "%s",
                 text);
    cr_assert_eq(ves_plan_create(problem, NULL, &plan, NULL), VES_OK);
    cr_assert_eq(ves_plan_measure(plan, &x, 0, &design), VES_OK);
    cr_assert_eq(design.status, VES_OK, "%s", text);
    double value = design.objective;
    *copies = ves_plan_shell(plan, 0).copies;
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    return value;
}

/* Twelve elements of order 6 have the waves of a round or an oval tube to 1e-6; a strip has them exactly. */
Test(shell_sector, is_of_all_that_is_asked)
{
    static const char OVAL[] = "1 + 0.1*cos(2*v)";
    static const tube list[] = {
        {"1", "0.02", INSIDE, LARGEST, STRIP},
        {"1", "0.02", INSIDE, "displacement: {along: [0, 1, 0]}", STRIP},
        {"1", "0.02", INSIDE, "displacement: {along: [0, 0, 1]}", HALF},
        {"1", "0.02", INSIDE, "displacement: {along: [1, 0, 2]}", WHOLE},
        {"1", "0.02", INSIDE, "max_shear: {where: \"y > 0.4 and y < 0.9\"}", STRIP},
        {"1", "0.02", INSIDE, "max_shear: {where: \"z > 0.5\"}", WHOLE},
        {"1", "0.02", INSIDE, "von_mises: {where: \"v > 1 and v < 2\"}", WHOLE},
        {"1", "0.02", "{pressure: \"p*max(0, 1 - ((v - 3)^2 + (u - 0.6)^2)/0.02)\"}", LARGEST, WHOLE},
        {"1", "0.02", "{at: wall.u1, line: [0, \"if(v > 2.75 and v < 3.15, -p, 0)\", 0]}", LARGEST, WHOLE},
        {"1", "0.02", "{at: wall.u1, line: [\"if(y > 0.95, z*p, 0)\", 0, 0]}", LARGEST, WHOLE},
        {"1", "0.02 - if(v > 2.75 and v < 3.15, 0.01, 0)", INSIDE, LARGEST, WHOLE},
        {"1 - 0.05*exp(-((v - 2.85)/0.1)^2)", "0.02", INSIDE, LARGEST, WHOLE},
        {OVAL, "0.02", INSIDE, LARGEST, QUARTER},
        {OVAL, "0.02", INSIDE, "displacement: {along: [1, 0, 0]}", QUARTER},
    };
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        int copies, one;
        double got = measured(&list[k], false, &copies), all = measured(&list[k], true, &one);
        cr_expect_eq(copies, list[k].copies, "%zu: %d copies", k, copies);
        cr_expect_eq(one, WHOLE);
        cr_expect(fabs(got / all - 1) < 1e-5, "%zu: %.9g, whole %.9g", k, got, all);
    }
}

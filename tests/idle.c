/* Variables that do nothing are found, and only they. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "problem/problem.h"
#include "study/idle.h"
#include "study/run.h"

static const char RINGS[] =
    "vesica: 1\n"
    "variables: {Dx: [0.1, 1, 3], Dy: [0.1, 1, 3], lean: [-1, 0, 1], side: [-1, 0, 1], spare: [0.5, 1, 2]}\n"
    "curves:\n"
    "  p: {circle: {radius: 1, axis: [0, 1, 0]}}\n"
    "  q: {circle: {radius: 1, axis: [0, 1, 0]}, apply: [{dilate: [Dx, Dy, 1]}, {rotate: [lean, 0, 0]}, "
    "{translate: [side, 2, 0]}]}\n"
    "  unused: {circle: {radius: spare}}\n"
    "patches: {wall: {operator: {power: 1, a: 1}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n";

/* Names of what was found, in the order of the file; NULL: it could not be told. */
static void expect_text(const char *text, const char *judged, const char *names)
{
    char found[200] = "";
    ves_diag *diag = ves_diag_create();
    ves_problem *p;
    ves_plan *plan;
    ves_arena arena = {0};
    const ves_plan_options options = {{32, 64}};
    bool idle[8];
    cr_assert_eq(ves_problem_read_text("rings", text, strlen(text), NULL, &p, diag), VES_OK, "%s", judged);
    cr_assert_eq(ves_plan_create(p, &options, &plan, diag), VES_OK);
    bool told = ves_study_idle(plan, p, &arena, idle);
    for (int k = 0; told && k < p->variables; k++)
        if (idle[k]) strcat(strcat(found, p->variable[k].name), " ");
    cr_expect(told == (names != NULL), "%s", judged);
    cr_expect_str_eq(found, names ? names : "", "%s", judged);
    ves_arena_destroy(&arena);
    ves_plan_destroy(plan);
    ves_problem_destroy(p);
    ves_diag_destroy(diag);
}

static void expect_idle(const char *judged, const char *names)
{
    char text[2000];
    snprintf(text, sizeof text, "%s%s", RINGS, judged);
    expect_text(text, judged, names);
}

/* The dilation of a ring along its own axis, and the radius of a ring that no patch ends on. At this start
 * the slopes along lean and side are 0 too, by symmetry: they are not idle. */
Test(idle, a_ring_along_its_own_axis)
{
    expect_idle("minimize: area\n", "Dy spare ");
}

Test(idle, what_a_constraint_reads_is_not_idle)
{
    expect_idle("minimize: area\nconstraints: [spare <= 1]\n", "Dy ");
    expect_idle("minimize: (Dx - 2)^2 + Dy^2\n", "lean side spare ");
}

/* What is read only far from the start, by a formula or through a parameter, is not idle. */
Test(idle, what_matters_elsewhere_is_not_idle)
{
    expect_idle("minimize: area + max(0, spare - 1.9)\n", "Dy ");
    expect_idle("parameters: {far: \"max(0, spare - 1.5)\"}\nminimize: area + far\n", "Dy ");
}

/* A shape that nothing can measure tells nothing. */
Test(idle, it_is_not_told_where_nothing_can_be_measured)
{
    expect_idle("minimize: log(0 - area)\n", NULL);
}

/* At the bound k = 0 the slope along k is 0 whatever k does, k being squared; and from k = 5 on this surface
 * folds: what can be measured lies in between. */
Test(idle, what_starts_near_a_bound_is_not_idle)
{
    char text[4000];
    int at = snprintf(text, sizeof text, "vesica: 1\nvariables: {k: [0, 0.2, 50]}\ncurves:\n");
    for (int i = 0; i < 8; i++) {
        at += snprintf(text + at, sizeof text - (size_t)at, "  s%d: {bspline: [", i);
        for (int j = 0; j < 8; j++) {
            double r = 1 + 0.3 * sin(1.3 * i), v = 0.785398163 * j;
            at += snprintf(text + at, sizeof text - (size_t)at, "%s[%.3f, %.3f, %.3f]", j ? ", " : "",
                           r * cos(v), r * sin(v), 0.4 * i);
        }
        at += snprintf(text + at, sizeof text - (size_t)at, "]}\n");
    }
    snprintf(text + at, sizeof text - (size_t)at,
             "patches: {a: {operator: {a: k}, sections: {curves: [s0, s1, s2, s3, s4, s5, s6, s7]}}}\n"
             "minimize: area\n");
    expect_text(text, "minimize: area", "");
}

Test(idle, the_result_says_so)
{
    char text[2000];
    snprintf(text, sizeof text, "%sminimize: area\n", RINGS);
    ves_diag *diag = ves_diag_create();
    ves_problem *p;
    ves_run *run;
    cr_assert_eq(ves_problem_read_text("rings", text, strlen(text), NULL, &p, diag), VES_OK);
    cr_assert_eq(ves_run_create(p, &(ves_run_options){.evaluations = 200, .jobs = 1}, NULL, &run, diag),
                 VES_OK);
    bool said = false;
    for (int k = 0; k < run->notes; k++)
        said =
            said || !strcmp(run->note[k], "Dy, spare: no effect on what is judged, in the designs looked at");
    cr_assert(run->best.x[1] == 1 && run->best.x[4] == 1 && run->best.x[0] != 1,
              "what does nothing stays at its start");
    cr_assert(said && run->idle[1] && run->idle[4] && !run->idle[0]);
    ves_run_destroy(run);
    ves_problem_destroy(p);
    ves_diag_destroy(diag);
}

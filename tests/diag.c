/* Diagnostics that a host has kept for long. */
#include <criterion/criterion.h>
#include <string.h>

#include "vesica/problem.h"

static const char text_of_a_tube[] =
    "vesica: 1\nvariables: {r: [1, 2, 3]}\ncurves: {p: {circle: {radius: r}}, q: {like: p, apply: "
    "[{translate: [0, 0, 1]}]}}\n"
    "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"
    "minimize: area\n";

/* Neither drowns the other: a host may keep one diag for all it does. */
Test(diag, a_full_diag_keeps_errors_and_remarks_apart)
{
    ves_diag *diag = ves_diag_create();
    for (int k = 0; k < VES_DIAG_REMARKS + 1; k++)
        ves_diag_add(diag, VES_WARNING, VES_RANGE, (ves_mark){0}, "w%d", k);
    for (int k = 0; k < VES_DIAG_ERRORS + 1; k++)
        ves_diag_add(diag, VES_ERROR, VES_RANGE, (ves_mark){0}, "e%d", k);
    int last = VES_DIAG_REMARKS + VES_DIAG_ERRORS - 1;
    char text[40];
    cr_expect(ves_diag_count(diag) == last + 1 && ves_diag_errors(diag) == VES_DIAG_ERRORS + 1);
    ves_diag_text(diag, last, text, sizeof text);
    cr_expect_str_eq(text, "error: e99");
    ves_problem *problem;
    cr_expect_eq(
        ves_problem_read_text("g.yaml", text_of_a_tube, strlen(text_of_a_tube), NULL, &problem, diag),
        VES_OK);
    ves_problem_destroy(problem);
    ves_diag_destroy(diag);
}

/* The quadrature that is chosen is good for 1e-9 of area, bending and volume of every surface that comes with the
 * program: its own word for it, and a grid that is twice as fine. Most of these files measure other things: the
 * three are added to their text. */
#include <criterion/criterion.h>
#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bed.h"
#include "source.h"

enum { MEASURES = 3 };
static const char *const NAME[MEASURES] = {"whole_area", "whole_bending", "whole_volume"};

static char *with_measures(const char *text)
{
    static const char three[] =
        "\n  whole_area: {area: {}}\n  whole_bending: {bending: {}}\n  whole_volume: {volume: {}}\n";
    const char *measures = strstr(text, "\nmeasures:\n");
    size_t lines =
        strstr(text, "closed: true") ? strlen(three) : (size_t)(strstr(three, "  whole_volume") - three);
    size_t at = measures ? (size_t)(measures - text) + strlen("\nmeasures:") : strlen(text);
    char *out = malloc(strlen(text) + sizeof three + 20);
    sprintf(out, "%.*s%s%.*s%s", (int)at, text, measures ? "" : "measures:", (int)lines, three, text + at);
    return out;
}

static void measures_at(const bed *b, const char *path, int level, double value[MEASURES])
{
    ves_design design;
    cr_assert_eq(ves_plan_measure(b->plan, NULL, level, &design), VES_OK, "%s", path);
    for (int m = 0; m < MEASURES; m++) value[m] = 0;
    for (int k = 0; k < ves_problem_measures(b->problem); k++)
        for (int m = 0; m < MEASURES; m++)
            if (!strcmp(ves_problem_measure(b->problem, k), NAME[m])) value[m] = design.measure[k];
}

static void check(const char *path)
{
    char *raw = read_text(path), *text = with_measures(raw);
    bed b = bed_with(text, NULL, 0, 0);
    int grid[2];
    double left = ves_plan_grid(b.plan, grid), coarse[MEASURES], fine[MEASURES];
    cr_assert_eq(ves_problem_variables(b.problem), 0, "%s: these are surfaces, not searches", path);
    cr_expect(left <= 1e-9, "%s: %d x %d nodes leave %g", path, grid[0], grid[1], left);
    measures_at(&b, path, 0, coarse);
    measures_at(&b, path, 1, fine);
    cr_expect(fine[0] > 0 && fine[1] > 0, "%s: area %g, bending %g", path, fine[0], fine[1]);
    for (int m = 0; m < MEASURES; m++)
        cr_expect(fabs(fine[m] - coarse[m]) <= 1e-9 * fabs(fine[m]),
                  "%s, %d x %d: %s %.15g, twice as fine %.15g", path, grid[0], grid[1], NAME[m], coarse[m],
                  fine[m]);
    bed_clear(&b);
    free(text), free(raw);
}

Test(quadrature, that_is_chosen_is_good_for_a_billionth_on_every_surface)
{
    glob_t found;
    cr_assert_eq(glob(VESICA_SOURCE "/problems/surfaces/*.yaml", 0, NULL, &found), 0);
    for (size_t k = 0; k < found.gl_pathc; k++) check(found.gl_pathv[k]);
    cr_assert(found.gl_pathc >= 5);
    globfree(&found);
}

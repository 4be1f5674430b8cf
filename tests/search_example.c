/* The program of examples/search, as its source stands there. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#define main example_main
#include "../examples/search/main.c"
#undef main

#include <stdlib.h>
#include <string.h>

#include "files.h"

static char *said(const char *name)
{
    cr_assert(freopen(path_of(name), "w", stdout) != NULL);
    cr_expect(example_main() == 0);
    cr_assert(fflush(stdout) == 0);
    char *text = slurp(path_of(name));
    remove(path_of(name));
    return text;
}

static int times(const char *text, const char *words)
{
    int count = 0;
    for (const char *at = strstr(text, words); at; at = strstr(at + 1, words)) count++;
    return count;
}

/* Its energy on the stop, and the push of the stop, by the formulas of its first comment. The other optimum is where
 * the springs alone carry the load: 2000 (rest / length - 1) y = 20. */
Test(search_example, tells_what_can_be_found_by_hand)
{
    const double rest = hypot(1, 0.5), length = hypot(1, 0.4), stretch = length - rest;
    const double energy = 1000 * stretch * stretch - 8, push = 20 + 2000 * (rest / length - 1) * 0.4;
    double low = 0.4, high = 0.5;
    while (high - low > 1e-12) {
        double y = 0.5 * (low + high);
        *(2000 * (rest / hypot(1, y) - 1) * y > 20 ? &low : &high) = y;
    }
    const double above = hypot(1, low) - rest;
    char best[100], pushes[100], other[100], *text = said("a.csv");
    snprintf(best, sizeof best, "  best       %.6f J at x = 0.000000, y = -0.400000\n", energy);
    snprintf(pushes, sizeof pushes, "  stop       pushes with %.3f N\n", push);
    snprintf(other, sizeof other, "  optimum 2  %.6f J at x = 0.000000, y = %.6f",
             1000 * above * above + 20 * low, low);
    cr_expect(times(text, best) == 3, "not 3 times %s in\n%s", best, text);
    cr_expect(times(text, pushes) == 1, "not once %s in\n%s", pushes, text);
    cr_expect(times(text, other) == 2, "not twice %s in\n%s", other, text);
    cr_expect(times(text, "independent descents ended there") == 2, "%s", text);
    cr_expect(times(text, "optimum 3") == 0 && times(text, "note") == 0, "%s", text);
    free(text);
    check_nothing_left();
}

Test(search_example, says_the_same_again)
{
    char *first = said("a.csv"), *again = said("a.csv");
    cr_expect(eq(str, first, again));
    free(first);
    free(again);
    check_nothing_left();
}

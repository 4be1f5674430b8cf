/* What a violation is measured by: the limit, and not what a bad start says. */
#include <math.h>

#include "bed.h"

#define BEGUN(constraint)                                                                                    \
    "vesica: 1\nvariables: {r: [0.2, 1.1, 1.2]}\nquadrature: {u: 8, v: 16}\nparameters: {q: 1.5, s: 2*r}\n"  \
    "curves: {p: {circle: {radius: r}}, q1: {like: p, apply: [{translate: [0, 0, 1]}]}}\n"                   \
    "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, position: q1}]}}\n"  \
    "minimize: width\nconstraints: [" constraint "]\n"

Test(plan_size, the_size_of_a_violation_is_that_of_the_limit)
{
    const double r = 0.4, big = exp(20 * (r - 0.2)), start = 1.1;
    const struct {
        const char *text;
        double want;
    } table[] = {/* a start that exceeds its limit by seven powers of ten loosens nothing */
                 {BEGUN("exp(20*(r-0.2)) <= 1.5"), (big - 1.5) / 1.5},
                 {BEGUN("1.5 >= exp(20*(r-0.2))"), (big - 1.5) / 1.5},
                 {BEGUN("exp(20*(r-0.2)) == 1.5"), (big - 1.5) / 1.5},
                 {BEGUN("exp(20*(r-0.2)) <= q"), (big - 1.5) / 1.5},
                 {BEGUN("exp(20*(r-0.2))*width <= -2*q"), (2 * r * big + 3) / 3},
                 {BEGUN("1.5 <= width"), (1.5 - 2 * r) / 1.5},
                 {BEGUN("width >= 1.5"), (1.5 - 2 * r) / 1.5},
                 /* a limit that changes is taken at the start */
                 {BEGUN("exp(20*(r-0.2)) <= s"), (big - 2 * r) / (2 * start)},
                 {BEGUN("exp(20*(r-0.2)) <= width"), (big - 2 * r) / (2 * start)},
                 {BEGUN("exp(20*(r-0.2)) <= r"), (big - r) / start},
                 /* a limit that says nothing */
                 {BEGUN("width - 2 == 0"), (2 - 2 * r) / (2 * start - 2)},
                 {BEGUN("0 == width - 2"), (2 - 2 * r) / (2 * start - 2)},
                 {BEGUN("0*r <= width - 1"), 0.2 / (2 * start - 1)},
                 {BEGUN("r - 1.1 == 0"), start - r},
                 {BEGUN("1/(r - 1.1) == 0"), 1 / (start - r)}};
    for (size_t k = 0; k < sizeof table / sizeof *table; k++) {
        bed b = bed_with(table[k].text, NULL, 0, 0);
        ves_design design;
        cr_assert_eq(ves_plan_measure(b.plan, &r, 0, &design), VES_OK);
        /* widths are climbed to, to 1e-13 of their size, and divided by 0.2 of it */
        cr_expect(fabs(design.violation / table[k].want - 1) < 1e-11, "%s: got %.15g, want %.15g",
                  strstr(table[k].text, "constraints"), design.violation, table[k].want);
        bed_clear(&b);
    }
}

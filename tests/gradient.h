/* Exact gradients of whole problem texts against differences. */
#ifndef TESTS_GRADIENT_H
#define TESTS_GRADIENT_H

#include <math.h>

#include "bed.h"

enum { GRADIENT_N = 8, GRADIENT_M = 8 };

static inline void judge(const bed *b, const double *x, unsigned want, ves_verdict *verdict)
{
    ves_ask ask = {.x = x, .level = 0, .cutoff = HUGE_VAL, .want = want};
    cr_assert_eq(ves_plan_evaluate(b->plan, &ask, verdict), VES_OK);
    cr_assert_eq(verdict->status, VES_OK, "%s", ves_status_text(verdict->status));
}

/* Fourth-order central differences: truncation about h^4 = 1e-12 times a fifth derivative, rounding 1e-13 / h
 * of the value: 1e-7 of the largest entry covers both with a margin; the bar of the project is 1e-6. */
static inline void gradient_check(const char *text)
{
    bed b = bed_with(text, NULL, 0, 0);
    int n = b.problem->variables, m = b.problem->constraints;
    double x[GRADIENT_N], g[GRADIENT_N], jacobian[GRADIENT_M * GRADIENT_N], c[GRADIENT_M], side[4],
        sides[GRADIENT_M][4], scratch[GRADIENT_M];
    for (int k = 0; k < n; k++) x[k] = b.problem->variable[k].start;
    ves_verdict verdict = {.constraint = c, .gradient = g, .jacobian = jacobian},
                other = {.constraint = scratch};
    judge(&b, x, VES_WANT_GRADIENT, &verdict);
    double value = verdict.value;
    for (int k = 0; k < n; k++) {
        static const double at[4] = {-2, -1, 1, 2}, w[4] = {1, -8, 8, -1};
        double h = 1e-3 * (b.problem->variable[k].max - b.problem->variable[k].min) / 4, keep = x[k],
               want = 0, wants[GRADIENT_M] = {0};
        for (int s = 0; s < 4; s++) {
            x[k] = keep + at[s] * h;
            judge(&b, x, VES_WANT_VALUE, &other);
            side[s] = other.value;
            want += w[s] * side[s] / (12 * h);
            for (int i = 0; i < m; i++) sides[i][s] = scratch[i], wants[i] += w[s] * sides[i][s] / (12 * h);
        }
        x[k] = keep;
        double unit = 1 + fabs(want) + fabs(value);
        cr_expect(fabs(g[k] - want) <= 1e-7 * unit, "%s: d/d%s: got %.12g, differences %.12g\n%s",
                  "objective", b.problem->variable[k].name, g[k], want, text);
        for (int i = 0; i < m; i++)
            cr_expect(fabs(jacobian[i * n + k] - wants[i]) <= 1e-7 * (1 + fabs(wants[i])),
                      "constraint %d: d/d%s: got %.12g, differences %.12g\n%s", i,
                      b.problem->variable[k].name, jacobian[i * n + k], wants[i], text);
    }
    bed_clear(&b);
}

#endif

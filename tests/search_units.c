/* A constraint is the same one in any units: what the search makes of its size and of its tolerance. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "search_problems.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

/* Constraints in other units. */
typedef struct measured {
    const given *problem;
    double unit[3];
} measured;

static ves_status in_units(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const measured *s = data;
    const given *g = s->problem;
    ves_status status = g->evaluate(g->data, worker, ask, v);
    for (int j = 0; j < g->m; j++) {
        v->constraint[j] *= s->unit[j];
        for (int i = 0; i < g->n && gradient_of(ask, v); i++) v->jacobian[j * g->n + i] *= s->unit[j];
    }
    return status;
}

/* By every algorithm and by auto; told in other units together with its tolerance, by powers of 2: then not even
 * a rounding may differ. */
enum { WAYS = 9 };

static ves_search_result *searched(const given *problem, int way, bool gradients, double unit)
{
    static const char *const by[WAYS] = {NULL,     "slsqp",  "mma",   "ccsa",  "lbfgs",
                                         "cobyla", "bobyqa", "sbplx", "auglag"};
    measured s = {problem, {unit, unit, unit}};
    given g = *problem;
    g.evaluate = in_units;
    g.data = &s;
    g.gradients = gradients;
    g.tolerance = unit / 1048576;
    ves_search_options o = by[way] ? only_polish(by[way]) : ves_search_options_default();
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    return r;
}

Test(units, of_constraints_do_not_matter)
{
    const given *const table[] = {&problem_g06, &problem_can, &problem_disk, &problem_low_can};
    const int power[] = {-30, -10, 10, 30};
    for (int p = 0; p < 4; p++)
        for (int way = 0; way < WAYS; way++)
            for (int gradients = 0; gradients < 2; gradients++) {
                ves_search_result *one = searched(table[p], way, gradients, 1);
                for (int k = 0; k < 4; k++) {
                    double unit = ldexp(1, power[k]);
                    ves_search_result *r = searched(table[p], way, gradients, unit);
                    cr_expect(r->feasible && r->value == one->value && r->violation == unit * one->violation,
                              "problem %d, way %d, unit 2^%d: %.17g, in one %.17g", p, way, power[k],
                              r->value, one->value);
                    cr_expect(r->optima == one->optima && r->evaluations == one->evaluations,
                              "problem %d, way %d, unit 2^%d: %d optima, in one %d", p, way, power[k],
                              r->optima, one->optima);
                    ves_search_result_destroy(r);
                }
                ves_search_result_destroy(one);
            }
}

/* The least x + y for x y >= 1 - t, where t is the tolerance in the constraint's own unit: 2, but for the 1e-4
 * of t that is rounding. Every chain is polished, none keeps what the tolerance buys. */
static ves_status product(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    v->value = x + y;
    v->constraint[0] = 1 - x * y;
    if (!g) return VES_OK;
    g[0] = g[1] = 1;
    v->jacobian[0] = -y;
    v->jacobian[1] = -x;
    return VES_OK;
}

Test(units, a_wide_tolerance_is_not_used_up)
{
    const given two = {.evaluate = product, .n = 2, .m = 1};
    const double wide[] = {1e-6, 1e-3, 0.01, 0.1, 0.5};
    for (int gradients = 0; gradients < 2; gradients++)
        for (int k = 0; k < 5; k++) {
            ves_search_options o = chains_and_polish(gradients ? 16 : 8);
            measured s = {&two, {1e-6 / wide[k]}};
            given g = {.evaluate = in_units,
                       .n = 2,
                       .m = 1,
                       .lower = {0.1, 0.1},
                       .upper = {4, 5},
                       .start = {2.5, 3},
                       .gradients = gradients,
                       .data = &s};
            ves_search_result *r;
            cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
            /* d(x + y) / dt = 1; and what steps of 1e-9 of the box leave */
            cr_expect(r->feasible && fabs(r->value - 2) <= 1e-4 * wide[k] + 1e-8, "%g: %.9g", wide[k],
                      r->value);
            cr_expect(r->optima == 1 && r->optimum[0].hits == (gradients ? 16 : 8), "%g: %d optima, %d hits",
                      wide[k], r->optima, r->optimum[0].hits);
            ves_search_result_destroy(r);
        }
}

/* Ends in corners of many inequalities, and searches whose start fails. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "base/random.h"
#include "search_problems.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

/* A linear objective over planes that all pass through 0, which is a minimum: the objective's slope is a sum of
 * theirs with weights >= 0 (Farkas). Smooth, though more planes meet there than there are variables. */
enum { SIDES = 5, PLANES = 12 };

typedef struct corner {
    double plane[PLANES][SIDES], slope[SIDES];
} corner;

static ves_status cone(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const corner *c = data;
    double *g = gradient_of(ask, v);
    (void)worker;
    v->value = 10;
    for (int i = 0; i < SIDES; i++) v->value += c->slope[i] * ask->x[i];
    for (int k = 0; k < PLANES; k++) {
        v->constraint[k] = 0;
        for (int i = 0; i < SIDES; i++) v->constraint[k] += c->plane[k][i] * ask->x[i];
    }
    if (!g) return VES_OK;
    memcpy(g, c->slope, sizeof c->slope);
    memcpy(v->jacobian, c->plane, sizeof c->plane);
    return VES_OK;
}

static corner corner_draw(uint64_t seed)
{
    corner c = {0};
    ves_random random = {.seed = seed};
    for (int k = 0; k < PLANES; k++) {
        for (int i = 0; i < SIDES; i++) c.plane[k][i] = 2 * ves_random_uniform(&random) - 1;
        c.plane[k][SIDES - 1] = -0.1 - 0.9 * ves_random_uniform(&random);
    }
    for (int k = PLANES / 2; k < PLANES; k++) {
        double weight = k % 3 ? ves_random_uniform(&random) * ves_random_uniform(&random) : 0;
        for (int i = 0; i < SIDES; i++) c.slope[i] -= weight * c.plane[k][i];
    }
    return c;
}

Test(corner, of_more_planes_than_variables_is_no_kink)
{
    for (uint64_t seed = 1; seed <= 100; seed++) {
        corner c = corner_draw(seed);
        given g = {.evaluate = cone,
                   .n = SIDES,
                   .m = PLANES,
                   .lower = {-1, -1.1, -1.2, -1, -1.3},
                   .upper = {1.3, 1.2, 1.1, 1.4, 1},
                   .start = {0.01, 0.02, 0.03, 0.01, 0.9},
                   .gradients = true,
                   .data = &c};
        ves_search_options o = only_polish("slsqp");
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        cr_expect(r->feasible && fabs(r->value - 10) < 1e-8, "%llu: %.12g", (unsigned long long)seed,
                  r->value);
        cr_expect(noted(r, "slope has not vanished") == NULL, "%llu: %s", (unsigned long long)seed, r->stop);
        ves_search_result_destroy(r);
    }
}

/* Two small islands that can be measured, values 1 and 6; refuse: neither passes its proof. */
static ves_status islands(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    bool first = fmax(fabs(x - 0.2), fabs(y - 0.2)) < 1e-3,
         second = fmax(fabs(x - 0.9), fabs(y - 0.8)) < 1e-3;
    double dx = x - (first ? 0.2 : 0.9), dy = y - (first ? 0.2 : 0.8);
    (void)worker;
    if (*(bool *)data && (ask->want & VES_WANT_PROOF)) return VES_SELF_INTERSECTS;
    if (!first && !second) return VES_DEGENERATE;
    v->value = (first ? 1 : 6) + dx * dx + dy * dy;
    if (g) g[0] = 2 * dx, g[1] = 2 * dy;
    return VES_OK;
}

Test(corner, a_start_that_fails_hides_no_other)
{
    static const double lower[] = {0, 0}, upper[] = {1, 1}, start[] = {0.55, 0.45};
    static const double first[] = {0.2005, 0.2003}, second[] = {0.9004, 0.8003};
    const double *other[] = {second, first};
    for (int k = 0; k < 2; k++) {
        bool refuse = k;
        ves_search_problem p = {.n = 2,
                                .lower = lower,
                                .upper = upper,
                                .start = start,
                                .others = 2,
                                .other = other,
                                .gradients = true,
                                .evaluate = islands,
                                .data = &refuse};
        ves_search_options o = only_polish("slsqp");
        ves_search_result *r;
        cr_assert(eq(int, ves_search_run(&p, &o, NULL, &r), VES_OK));
        cr_expect(r->any && fabs(r->value - 1) < 1e-9 && r->feasible == !refuse, "%g", r->value);
        cr_expect(r->optima == (refuse ? 0 : 2) && !noted(r, "random point"), "%d optima", r->optima);
        cr_expect(noted(r, "unproved") || refuse == false);
        ves_search_result_destroy(r);
    }
}

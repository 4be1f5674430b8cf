/* mma and ccsa find each candidate by a dual problem that NLopt solves by itself: it must not hang there. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "search_problems.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

/* The point of the sphere of radius sqrt 2 that is nearest to (1, ..., 1), weighted, between two planes that
 * leave little room: x_i = w_i / (w_i + l), l from the radius. */
enum { SLAB = 8 };

static ves_status slab(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double *g = gradient_of(ask, v), squares = 0, sum = 0;
    v->value = 0;
    for (int i = 0; i < SLAB; i++) {
        double d = ask->x[i] - 1;
        v->value += (i + 1) * d * d;
        squares += ask->x[i] * ask->x[i];
        sum += ask->x[i];
    }
    v->constraint[0] = (squares - 2) / 2;
    v->constraint[1] = (2 - squares) / 2;
    v->constraint[2] = sum - 3.9;
    v->constraint[3] = 3.8 - sum;
    for (int i = 0; g && i < SLAB; i++) {
        g[i] = 2 * (i + 1) * (ask->x[i] - 1);
        v->jacobian[i] = ask->x[i];
        v->jacobian[SLAB + i] = -ask->x[i];
        v->jacobian[2 * SLAB + i] = 1;
        v->jacobian[3 * SLAB + i] = -1;
    }
    return VES_OK;
}

static double slab_least(void)
{
    double low = 0, high = 50, value = 0;
    for (int k = 0; k < 100; k++) {
        double l = 0.5 * (low + high), squares = 0;
        value = 0;
        for (int i = 0; i < SLAB; i++) {
            double x = (i + 1) / (i + 1 + l);
            squares += x * x;
            value += (i + 1) * (x - 1) * (x - 1);
        }
        if (squares > 2)
            low = l;
        else
            high = l;
    }
    return value;
}

Test(search_dual, opposite_inequalities_leave_first_order_methods_a_way)
{
    const char *const by[] = {"mma", "ccsa"};
    for (int k = 0; k < 2; k++) {
        given g = {.evaluate = slab, .n = SLAB, .m = 4, .gradients = true};
        for (int i = 0; i < SLAB; i++) g.lower[i] = -2, g.upper[i] = 3, g.start[i] = 0.5;
        ves_search_options o = only_polish(by[k]);
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        /* first order, within the budget of its own: 2e-10 was seen */
        cr_expect(r->feasible && fabs(r->value - slab_least()) < 1e-8, "%s: %.12g, violation %g (%s)", by[k],
                  r->value, r->violation, r->stop);
        ves_search_result_destroy(r);
    }
}

/* NLopt solves dual problems between its questions, and asks for one point several times: each is heard. */
static bool counting(void *data)
{
    long *calls = data;
    ++*calls;
    return false;
}

Test(search_dual, every_question_of_an_algorithm_hears_an_interrupt)
{
    for (int k = 0; k < 2; k++) {
        long calls = 0;
        given g = problem_g06;
        g.gradients = true;
        ves_search_options o = only_polish(k ? "ccsa" : "mma");
        ves_search_hooks hooks = {.stopped = counting, .data = &calls};
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, &hooks, &r), VES_OK));
        /* for the value and for the constraints; but proofs and second-order checks ask once */
        cr_expect(2 * calls > 3 * r->evaluations, "%ld calls for %ld evaluations", calls, r->evaluations);
        ves_search_result_destroy(r);
    }
}

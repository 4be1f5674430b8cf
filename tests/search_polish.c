/* The polish: NLopt on scaled quantities, saddles, distinct optima. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>
#include <stdio.h>

#include "base/eigen.h"
#include "base/random.h"
#include "search_problems.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

static const char *const algorithm[] = {"slsqp",  "mma",    "ccsa",  "lbfgs",
                                        "cobyla", "bobyqa", "sbplx", "auglag"};

enum { ALGORITHMS = sizeof algorithm / sizeof algorithm[0] };

static const ves_algorithm *described(const char *name)
{
    const ves_algorithm *a = ves_search_algorithms();
    while (a->name && strcmp(a->name, name)) a++;
    return a->name ? a : NULL;
}

Test(polish, every_algorithm_is_described_once)
{
    int count = 0;
    for (const ves_algorithm *a = ves_search_algorithms(); a->name; a++, count++)
        cr_assert(a->about && *a->about);
    cr_assert(eq(int, count, ALGORITHMS));
    for (int k = 0; k < ALGORITHMS; k++) cr_assert(described(algorithm[k]) != NULL, "no %s", algorithm[k]);
}

/* 1e-8 relative. Where an algorithm has values only and constraints go into an augmented Lagrangian, it finds
 * x to the root of rounding, 1e-8 of the box, and multipliers make 1e-7 of the value of that. */
static void reaches(const given *problem, double want, const char *what)
{
    for (int gradients = 0; gradients < 2; gradients++)
        for (int k = 0; k < ALGORITHMS; k++) {
            given g = *problem;
            g.gradients = gradients;
            if (!g.m) g.data = &g;
            ves_search_options o = only_polish(algorithm[k]);
            o.stage[0].polish.evaluations = 100000; /* enough for first-order methods in a curved valley */
            ves_search_result *r;
            cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
            bool blunt = g.m && (!strcmp(algorithm[k], "bobyqa") || !strcmp(algorithm[k], "sbplx") ||
                                 !strcmp(algorithm[k], "auglag"));
            double limit = blunt ? 2e-7 : 1e-8, error = fabs(r->value - want) / fmax(1, fabs(want));
            cr_expect(r->feasible && error <= limit, "%s by %s, gradients %d: got %.12g, want %.12g (%s)",
                      what, algorithm[k], gradients, r->value, want, r->stop);
            cr_expect(r->violation <= 1e-8, "%s by %s: violation %g", what, algorithm[k], r->violation);
            cr_expect(gradients || !r->gradients, "%s asked for gradients that are not there", algorithm[k]);
            ves_search_result_destroy(r);
        }
}

Test(polish, all_algorithms_solve_g06)
{
    reaches(&problem_g06, -6961.81387558015, "g06");
}

Test(polish, all_algorithms_meet_an_equality)
{
    reaches(&problem_can, -PI / sqrt(2), "can");
}

Test(polish, all_algorithms_find_the_rim_of_a_disk)
{
    reaches(&problem_disk, disk_least(), "disk");
}

Test(polish, all_algorithms_follow_a_valley)
{
    given g = problem_rosenbrock(2);
    reaches(&g, 0, "Rosenbrock");
}

Test(polish, default_algorithm_follows_from_the_problem)
{
    const struct {
        given problem;
        bool gradients;
        const char *want;
    } table[] = {{problem_can, true, "slsqp"},
                 {problem_can, false, "cobyla"},
                 {problem_rosenbrock(3), false, "bobyqa"},
                 {problem_rosenbrock(3), true, "slsqp"}};
    for (int k = 0; k < 4; k++) {
        given g = table[k].problem;
        g.gradients = table[k].gradients;
        g.data = &g;
        ves_search_options o = only_polish(NULL);
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        cr_expect(strncmp(r->stop, table[k].want, strlen(table[k].want)) == 0, "case %d: %s", k, r->stop);
        ves_search_result_destroy(r);
    }
}

/* f scaled by 1e-9 and by 1e9, and boxes of 1e-6 and 1e6: SLSQP on unscaled quantities fails on half of
 * these. */
typedef struct scaled {
    double f, x;
} scaled;

static ves_status scaled_rosenbrock(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const scaled *s = data;
    static const given two = {.n = 2};
    double x[2] = {ask->x[0] / s->x, ask->x[1] / s->x};
    ves_ask inner = *ask;
    inner.x = x;
    rosenbrock((void *)&two, worker, &inner, v);
    v->value = s->f * (v->value + 1);
    for (int i = 0; i < 2 && (ask->want & VES_WANT_GRADIENT); i++) v->gradient[i] *= s->f / s->x;
    return VES_OK;
}

Test(polish, scale_of_value_and_box_does_not_matter)
{
    const double f[] = {1e-9, 1, 1e9}, x[] = {1e-6, 1, 1e6};
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
            scaled s = {f[a], x[b]};
            given g = problem_rosenbrock(2);
            g.evaluate = scaled_rosenbrock;
            g.data = &s;
            g.gradients = true;
            for (int i = 0; i < 2; i++) g.lower[i] *= s.x, g.upper[i] *= s.x, g.start[i] *= s.x;
            ves_search_options o = only_polish("slsqp");
            ves_search_result *r;
            cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
            double error = r->value / s.f - 1; /* f_tolerance 1e-12 and restarts: 1e-10 */
            cr_expect(fabs(error) < 1e-10, "f * %g, x * %g: error %g after %ld", s.f, s.x, error,
                      r->evaluations);
            ves_search_result_destroy(r);
        }
}

/* x0 + x1 matters only as a sum, x3 not at all, and curvatures differ by 1e6: the value still converges to
 * 1e-10. */
static ves_status valley(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    const double *x = ask->x;
    double t = x[0] + x[1] - 0.3, s = x[2] - 0.41, *g = gradient_of(ask, v);
    v->value = 2 + t * t + t * t * t * t + 1e-6 * s * s;
    if (!g) return VES_OK;
    g[0] = g[1] = 2 * t + 4 * t * t * t;
    g[2] = 2e-6 * s;
    g[3] = 0;
    return VES_OK;
}

static const given problem_valley = {.evaluate = valley,
                                     .n = 4,
                                     .lower = {-1, -1, -1, -1},
                                     .upper = {1, 1, 1, 1},
                                     .start = {-0.7, 0.2, 0.9, 0.11},
                                     .gradients = true};

Test(polish, flat_directions_are_no_saddles_and_no_other_optima)
{
    ves_search_options o = ves_search_options_default();
    for (uint64_t seed = 1; seed <= 5; seed++) {
        o.seed = seed;
        ves_search_result *r;
        cr_assert(eq(int, run(&problem_valley, &o, NULL, &r), VES_OK));
        cr_expect(fabs(r->value - 2) < 2e-10, "seed %d: %.13g", (int)seed, r->value);
        cr_expect(eq(int, r->optima, 1));
        cr_expect(r->evidence.minima == 1 && r->evidence.hits == r->evidence.descents &&
                      r->optimum[0].hits > 16,
                  "every descent of auto ended there: %d hits, %s", r->optimum[0].hits, r->evidence.sentence);
        for (int k = 0; k < r->notes; k++)
            cr_expect(strstr(r->note[k], "met a saddle") == NULL, "%s", r->note[k]);
        ves_search_result_destroy(r);
    }
}

/* f = x^4/4 - x^2/2 + y^2: a saddle at 0, minima at (+-1, 0) with -1/4 */
static ves_status saddle(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    v->value = x * x * x * x / 4 - x * x / 2 + y * y;
    if (!g) return VES_OK;
    g[0] = x * x * x - x;
    g[1] = 2 * y;
    return VES_OK;
}

Test(polish, a_saddle_is_left_both_ways)
{
    given g = {
        .evaluate = saddle, .n = 2, .lower = {-2, -3}, .upper = {2, 2}, .start = {0, 1}, .gradients = true};
    ves_search_options o = only_polish("slsqp");
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    cr_expect(fabs(r->value + 0.25) < 1e-12, "value %.15g", r->value);
    cr_expect(eq(int, r->optima, 2));
    cr_expect(r->optimum[0].x[0] * r->optimum[1].x[0] < -0.99, "%g and %g", r->optimum[0].x[0],
              r->optimum[1].x[0]);
    cr_expect(noted(r, "met a saddle") && noted(r, "x[0]"));
    cr_expect(r->optimum[0].saddle == false && r->optimum[1].saddle == false);
    ves_search_result_destroy(r);

    o.stage[0].polish.stay = true; /* then it stays, and does not know */
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    cr_expect(fabs(r->value) < 1e-12 && r->optima == 1 && r->notes == 0);
    ves_search_result_destroy(r);
}

/* The saddle on a wall: there is only one side. (1e-12 here and above: the f_tolerance of the polish.) */
Test(polish, a_saddle_left_to_one_side_is_told_so)
{
    given g = {
        .evaluate = saddle, .n = 2, .lower = {0, -3}, .upper = {2, 2}, .start = {0, 1}, .gradients = true};
    ves_search_options o = only_polish("slsqp");
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    cr_expect(fabs(r->value + 0.25) < 1e-12 && r->optima == 1, "value %.15g", r->value);
    cr_expect(noted(r, "left it one way") && !noted(r, "both"), "%s", r->notes ? r->note[0] : "no note");
    ves_search_result_destroy(r);
}

/* f = -x^2 on the circle x^2 + y^2 = 1 from its top: the curvature is the Lagrangian's, 2 (lambda - 1) = -2
 * along the circle. */
static ves_status circle(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    v->value = -x * x;
    v->constraint[0] = x * x + y * y - 1;
    if (!g) return VES_OK;
    g[0] = -2 * x;
    g[1] = 0;
    v->jacobian[0] = 2 * x;
    v->jacobian[1] = 2 * y;
    return VES_OK;
}

/* f = (x - 1)^2 + (y - 1)^2 with x y <= 1/16: from the diagonal SQP ends at (1/4, 1/4), the best of the
 * diagonal. Along the hyperbola f goes down to both sides: there L = f + 6 c has curvature 2 - 6. */
static ves_status hyperbola(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    v->value = (x - 1) * (x - 1) + (y - 1) * (y - 1);
    v->constraint[0] = x * y - 0.0625;
    if (!g) return VES_OK;
    g[0] = 2 * (x - 1);
    g[1] = 2 * (y - 1);
    v->jacobian[0] = y;
    v->jacobian[1] = x;
    return VES_OK;
}

Test(polish, a_saddle_on_a_constraint_is_left)
{
    given top = {.evaluate = circle,
                 .n = 2,
                 .m = 1,
                 .lower = {-2, -2},
                 .upper = {2, 2},
                 .start = {0, 1},
                 .equality = {true},
                 .gradients = true};
    given diagonal = {.evaluate = hyperbola,
                      .n = 2,
                      .m = 1,
                      .lower = {-3, -3},
                      .upper = {3, 3},
                      .start = {0.1, 0.1},
                      .gradients = true};
    ves_search_options o = only_polish("slsqp");
    ves_search_result *r;
    cr_assert(eq(int, run(&top, &o, NULL, &r), VES_OK));
    /* steps end at 1e-9 of the box, and the value follows the violation to first order; 2e-13 was seen */
    cr_expect(fabs(r->value + 1) < 1e-9 && r->violation < 1e-9, "value %.12g, violation %g", r->value,
              r->violation);
    cr_expect(r->optima == 2 && noted(r, "met a saddle"), "%d optima", r->optima);
    ves_search_result_destroy(r);
    cr_assert(eq(int, run(&diagonal, &o, NULL, &r), VES_OK));
    /* the oracle: along x y = 1/16 the value is s^2 - 2 s + 2 - 1/8, s = x + y >= 1/2, least at s = 1: 7/8 */
    cr_expect(fabs(r->value - 0.875) < 1e-9, "value %.12g at %g %g", r->value, r->x[0], r->x[1]);
    cr_expect(r->optima == 2, "%d optima", r->optima);
    ves_search_result_destroy(r);
}

/* A minimum on a wall, where f has negative curvature across the wall, is a minimum all the same. */
static ves_status slope_down(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    v->value = -x * x + (y - 0.3) * (y - 0.3);
    if (!g) return VES_OK;
    g[0] = -2 * x;
    g[1] = 2 * (y - 0.3);
    return VES_OK;
}

Test(polish, a_minimum_on_a_wall_is_no_saddle)
{
    given g = {.evaluate = slope_down,
               .n = 2,
               .lower = {0.2, -1},
               .upper = {1.7, 1},
               .start = {0.5, 0.9},
               .gradients = true};
    ves_search_options o = only_polish("slsqp");
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    /* on the wall itself; in y of second order in steps of 1e-9 */
    cr_expect(fabs(r->value + 1.7 * 1.7) < 1e-10, "value %.12g", r->value);
    cr_expect(eq(int, r->notes, 0));
    ves_search_result_destroy(r);
}

/* Candidates that fail, by status, by a value or by a slope that is no number, do not stop any algorithm
 * short of the optimum. */
static ves_status islands(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    double r2 = x * x + y * y;
    v->value = r2;
    if (g) g[0] = 2 * x, g[1] = 2 * y;
    if (x > 1.2) return VES_FOLDED;
    if (y < -0.4) v->value = NAN;
    if (x < -1.4 && g) g[0] = NAN;
    return VES_OK;
}

Test(polish, failed_candidates_do_not_end_a_descent)
{
    for (int k = 0; k < ALGORITHMS; k++) {
        given g = {.evaluate = islands,
                   .n = 2,
                   .lower = {-3, -2.5},
                   .upper = {2.5, 3},
                   .start = {1.15, 1.9},
                   .gradients = true};
        ves_search_options o = only_polish(algorithm[k]);
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        /* of second order in x: 1e-5 of the box at least for any of them; 5e-18 was seen */
        cr_expect(r->value < 1e-10 && isfinite(r->value), "%s: value %g, %ld failed (%s)", algorithm[k],
                  r->value, r->failed, r->stop);
        ves_search_result_destroy(r);
    }
}

/* A value everywhere, a gradient nowhere, or not right of x = 0.5: said by NAN in it, or as a plan does. The
 * minimum of (x - 0.3)^2 + (y - 0.6)^2 under x + y <= 0.8 is 0.005 at x = 0.25, y = 0.55. */
typedef struct blunt {
    double from;
    bool fails;
} blunt;

static ves_status blunted(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    const blunt *b = data;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    v->value = (x - 0.3) * (x - 0.3) + (y - 0.6) * (y - 0.6);
    v->constraint[0] = x + y - 0.8;
    if (!g) return VES_OK;
    g[0] = 2 * (x - 0.3), g[1] = 2 * (y - 0.6);
    v->jacobian[0] = v->jacobian[1] = 1;
    if (x < b->from) return VES_OK;
    g[0] = v->jacobian[1] = NAN;
    return b->fails ? VES_NO_NUMBER : VES_OK;
}

Test(polish, a_gradient_that_is_no_number_is_told_and_made_by_differences)
{
    const char *const by[] = {"slsqp", "mma", "auglag"};
    for (int k = 0; k < 3; k++)
        for (int c = 0; c < 4; c++) {
            blunt b = {.from = c / 2 ? 0.5 : -1, .fails = c % 2};
            given g = {.evaluate = blunted,
                       .n = 2,
                       .m = 1,
                       .lower = {0, 0},
                       .upper = {1, 1},
                       .start = {0.9, 0.8},
                       .gradients = true,
                       .data = &b};
            ves_search_options o = only_polish(by[k]);
            ves_search_result *r;
            cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
            /* slopes by differences are exact to 1e-8, and the value is flat along the constraint */
            cr_expect(r->feasible && fabs(r->value - 0.005) < 1e-8, "%s, case %d: %.12g (%s)", by[k], c,
                      r->value, r->stop);
            bool found = false;
            for (int i = 0; i < r->notes; i++)
                found |= strstr(r->note[i], "the gradient is no number at") &&
                         strstr(r->note[i], "first at x[0] = 0.9, x[1] = 0.8: differences stood in for it");
            cr_expect(found, "%s, case %d: no note", by[k], c);
            ves_search_result_destroy(r);
        }
}

/* Linear down to a wall where nothing can be measured any more. */
static ves_status cliff(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    double x = ask->x[0], y = ask->x[1], *g = gradient_of(ask, v);
    if (x < *(double *)data) return VES_FOLDED;
    v->value = x + y * y;
    if (g) g[0] = 1, g[1] = 2 * y;
    return VES_OK;
}

Test(polish, a_descent_that_ends_beside_a_failure_has_not_converged)
{
    const char *const by[] = {"slsqp", "mma", "auglag"};
    const double edge[] = {0.1, 0.23, 0.529, 1.217};
    for (int k = 0; k < 3; k++)
        for (int e = 0; e < 4; e++) {
            double wall = edge[e];
            given g = {.evaluate = cliff,
                       .n = 2,
                       .lower = {-2, -2},
                       .upper = {4, 4},
                       .start = {3.1, 2.3},
                       .gradients = true,
                       .data = &wall};
            ves_search_options o = only_polish(by[k]);
            ves_search_result *r;
            cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
            /* not the minimum, but beside the wall: 1e-9 was seen */
            cr_expect(r->any && r->x[0] >= wall && r->x[0] < wall + 1e-6, "%s: x %g, wall %g", by[k], r->x[0],
                      wall);
            cr_expect(strstr(r->stop, "cannot be measured") && !strstr(r->stop, "converged"), "%s at %g: %s",
                      by[k], wall, r->stop);
            ves_search_result_destroy(r);
        }
}

/* Nothing but the best can be measured for a while: a run then ends on a plateau of failures. */
typedef struct eclipse {
    long calls, from, to;
    double best[3];
} eclipse;

static ves_status eclipsed(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    static const given two = {.n = 2};
    eclipse *e = data;
    double *best = e->best, x = ask->x[0], y = ask->x[1];
    bool dark = ++e->calls >= e->from && e->calls < e->to;
    if (dark && (x != best[0] || y != best[1])) return VES_DEGENERATE;
    rosenbrock((void *)&two, worker, ask, v);
    if (e->calls == 1 || v->value < best[2]) best[0] = x, best[1] = y, best[2] = v->value;
    return VES_OK;
}

Test(polish, a_descent_that_fails_begins_again_at_its_own_best)
{
    const long length[] = {5, 20, 35, 45};
    for (int k = 0; k < 4; k++) {
        eclipse e = {.from = 15, .to = 15 + length[k]};
        given g = problem_rosenbrock(2);
        g.evaluate = eclipsed;
        g.data = &e;
        g.gradients = true;
        ves_search_options o = only_polish("slsqp");
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        /* far below the plateau; 1e-22 was seen */
        cr_expect(r->value < 1e-10, "%ld failures: value %g after %ld (%s)", r->failed, r->value,
                  r->evaluations, r->stop);
        ves_search_result_destroy(r);
    }
}

/* Finite, but beyond the start so steep that the algorithms' own arithmetic overflows: they ask for points that
 * are no numbers. */
static ves_status overflowing(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    double x = ask->x[0], y = ask->x[1], steep = x < 3.1 ? 4e307 : 1, *g = gradient_of(ask, v);
    v->value = x * x + y;
    v->constraint[0] = x * y - 1;
    if (!g) return VES_OK;
    g[0] = 2 * x;
    g[1] = 1;
    v->jacobian[0] = steep * y;
    v->jacobian[1] = steep * x;
    return VES_OK;
}

Test(polish, an_algorithm_that_loses_its_way_is_stopped_and_told)
{
    const char *const by[] = {"slsqp", "mma", "ccsa", "lbfgs"};
    for (int k = 0; k < 3; k++) {
        given g = {.evaluate = overflowing,
                   .n = 2,
                   .m = 1,
                   .lower = {-2, -2},
                   .upper = {4, 4},
                   .start = {3.1, 2.3},
                   .gradients = true};
        ves_search_options o = only_polish(by[k]);
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        cr_expect(r->status == VES_OK && r->any && r->evaluations < 200, "%s: %ld", by[k], r->evaluations);
        cr_expect(strstr(r->stop, "lost its way") && strstr(r->stop, "no number"), "%s", r->stop);
        ves_search_result_destroy(r);
    }
}

Test(polish, an_equation_may_be_written_as_two_inequalities)
{
    double r = sqrt(0.36 + 1.5) - 0.6;
    reaches(&problem_low_can, -PI * 1.2 * r * r, "low can");
}

Test(polish, budget_is_kept_to)
{
    const long budget[] = {1, 2, 5, 17, 100, 1000};
    for (int k = 0; k < ALGORITHMS; k++)
        for (int b = 0; b < 6; b++) {
            given g = problem_can;
            ves_search_options o = only_polish(algorithm[k]);
            o.evaluations = budget[b];
            ves_search_result *r;
            cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
            cr_expect(r->evaluations <= budget[b], "%s: %ld of %ld", algorithm[k], r->evaluations, budget[b]);
            ves_search_result_destroy(r);
        }
}

/* A V e = lambda e and V'V = 1, for random matrices and for equal eigenvalues */
Test(polish, eigenvalues_of_small_matrices)
{
    enum { N = 12 };
    double a[N * N], b[N * N], value[N], vector[N * N];
    for (int size = 1; size <= N; size++)
        for (int kind = 0; kind < 3; kind++) {
            ves_random random = {.seed = 7, .chain = (uint32_t)kind, .step = (uint64_t)size};
            for (int i = 0; i < size; i++)
                for (int j = 0; j <= i; j++) {
                    double x = kind == 0 ? ves_random_normal(&random) : kind == 1 ? 2.5 : i == j;
                    a[i * size + j] = a[j * size + i] = x;
                }
            memcpy(b, a, sizeof a);
            ves_eigen_symmetric(size, b, value, vector);
            double worst = 0;
            for (int k = 0; k < size; k++)
                for (int i = 0; i < size; i++) {
                    double left = -value[k] * vector[i * size + k], product = k == i ? -1 : 0;
                    for (int j = 0; j < size; j++) {
                        left += a[i * size + j] * vector[j * size + k];
                        product += vector[j * size + k] * vector[j * size + i];
                    }
                    worst = fmax(worst, fmax(fabs(left), fabs(product)));
                }
            cr_expect(worst < 1e-13 * size * 3, "size %d kind %d: residual %g", size, kind,
                      worst); /* rounding */
        }
}

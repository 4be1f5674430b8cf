/* The honest end: what independent descents tell of minima that were not seen, first-order conditions at the best, and
 * what each strategy of a portfolio has done. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include <math.h>
#include <string.h>

#include "vesica/search.h"

/* ---- the estimate ---- */

/* The sums of search/evidence.c, term by term: k minima, of which n descents have seen w. */
static void sums(int n, int w, double *expected, double *unseen)
{
    double p = 1, all = 0, count = 0, part = 0;
    for (long k = w; k < 4000000; k++) {
        all += p, count += p * (double)k, part += p * (double)(k - w) / (double)(n + k);
        p *= (double)(k + 1) / (double)(k + 1 - w) * ((double)k / (double)(n + k));
    }
    *expected = count / all, *unseen = part / all;
}

Test(honest, the_estimates_are_the_sums_that_they_stand_for)
{
    static const int pair[][2] = {{7, 1}, {15, 1}, {20, 3}, {24, 9}, {40, 30}, {200, 11}};
    for (size_t k = 0; k < sizeof pair / sizeof *pair; k++) {
        const int n = pair[k][0], w = pair[k][1];
        double expected, unseen;
        sums(n, w, &expected, &unseen);
        /* what is left of the sums behind 4e6 terms: (w / 4e6)^(n - w - 2) of them at most */
        cr_expect(fabs(ves_evidence_expected(n, w) / expected - 1) < 1e-8, "%d %d: %g, %g", n, w,
                  ves_evidence_expected(n, w), expected);
        cr_expect(fabs(ves_evidence_unseen(n, w) / unseen - 1) < 1e-8, "%d %d: %g, %g", n, w,
                  ves_evidence_unseen(n, w), unseen);
    }
}

Test(honest, too_few_descents_tell_nothing)
{
    for (long n = 0; n < 30; n++)
        for (long w = 0; w <= n; w++) {
            bool tells = w > 0 && n > w + 2;
            double expected = ves_evidence_expected(n, w), unseen = ves_evidence_unseen(n, w);
            cr_expect(isnan(expected) != tells && isnan(unseen) != tells, "%ld %ld", n, w);
            if (tells) cr_expect(expected > (double)w && unseen > 0 && unseen < 1, "%ld %ld", n, w);
        }
}

/* ---- problems ---- */

enum { N = 6, M = 4 };

typedef struct task {
    int n, m, way;
    double limit, factor, shut;
    long asked, most;    /* most > 0: stopped after so many */
    double above, below; /* the proof refuses what has x[0] above, or below; 0: does not */
} task;

enum { BOWL, WELLS, LAGRANGE, BOUND, CURVED, TWICE, NOWHERE, CORNER };

static void bowl(const task *t, const double *x, ves_verdict *v, double *g)
{
    v->value = 0;
    for (int i = 0; i < t->n; i++) {
        double z = x[i] - 0.3 - 0.1 * i;
        v->value += (i + 1) * z * z;
        g[i] = 2 * (i + 1) * z;
    }
}

/* In each coordinate a minimum near -1 and a higher one near 1, with basins of about one half. */
static void wells(const task *t, const double *x, ves_verdict *v, double *g)
{
    v->value = 0;
    for (int i = 0; i < t->n; i++) {
        double z = x[i] * x[i] - 1;
        v->value += z * z + 0.1 * (i + 1) * x[i];
        g[i] = 4 * z * x[i] + 0.1 * (i + 1);
    }
}

static void constrain(const task *t, const double *x, double *c, double *J)
{
    const double f = t->factor;
    switch (t->way) {
    case LAGRANGE: /* x + y >= limit */
        c[0] = f * (t->limit - x[0] - x[1]), J[0] = J[1] = -f;
        break;
    case CURVED: /* x^2 y == limit */
        c[0] = f * (x[0] * x[0] * x[1] - t->limit), J[0] = f * 2 * x[0] * x[1], J[1] = f * x[0] * x[0];
        break;
    case TWICE: /* x + y >= limit, said twice */
        c[0] = f * (t->limit - x[0] - x[1]), J[0] = J[1] = -f;
        c[1] = 3 * c[0], J[2] = J[3] = -3 * f;
        break;
    case CORNER: /* x >= limit, y >= limit, x + y >= 2 limit: three through one point of the plane */
        c[0] = t->limit - x[0], J[0] = -1, J[1] = 0;
        c[1] = t->limit - x[1], J[2] = 0, J[3] = -1;
        c[2] = 2 * t->limit - x[0] - x[1], J[4] = J[5] = -1;
        break;
    case NOWHERE:
        c[0] = 1 + x[0] * x[0], J[0] = 2 * x[0], J[1] = 0;
        break;
    default:
        break;
    }
}

static ves_status evaluate(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    task *t = data;
    double g[N], c[M] = {0}, J[M * N] = {0};
    const double *x = ask->x;
    __atomic_fetch_add(&t->asked, 1, __ATOMIC_RELAXED);
    if (t->way == BOWL || t->way == NOWHERE)
        bowl(t, x, v, g);
    else if (t->way == WELLS)
        wells(t, x, v, g);
    else if (t->way == BOUND) {
        v->value = (x[0] - 3) * (x[0] - 3) + x[1] * x[1];
        g[0] = 2 * (x[0] - 3), g[1] = 2 * x[1];
    } else {
        v->value = x[0] * x[0] + 2 * x[1] * x[1] + (t->way == CURVED ? x[0] * x[1] : 0);
        g[0] = 2 * x[0] + (t->way == CURVED ? x[1] : 0), g[1] = 4 * x[1] + (t->way == CURVED ? x[0] : 0);
    }
    constrain(t, x, c, J);
    v->violation = 0;
    for (int j = 0; j < t->m; j++) {
        v->constraint[j] = c[j];
        v->violation = fmax(v->violation, t->way == CURVED ? fabs(c[j]) : c[j]);
    }
    if (ask->want & VES_WANT_GRADIENT) {
        memcpy(v->gradient, g, sizeof(double) * (size_t)t->n);
        if (t->m) memcpy(v->jacobian, J, sizeof(double) * (size_t)(t->n * t->m));
    }
    const bool refused = (t->above > 0 && x[0] > t->above) || (t->below > 0 && x[0] < t->below);
    if ((ask->want & VES_WANT_PROOF) && refused) v->status = VES_COARSE;
    return VES_OK;
}

static bool stopped(void *data)
{
    const task *t = data;
    return t->most && __atomic_load_n(&t->asked, __ATOMIC_RELAXED) >= t->most;
}

static ves_search_result *run(task *t, const ves_search_options *o, bool gradients, int workers)
{
    static const bool equality[M] = {true};
    double lower[N], upper[N], start[N];
    for (int i = 0; i < t->n; i++) lower[i] = -2, upper[i] = 2, start[i] = 0.7;
    const ves_search_problem problem = {.n = t->n,
                                        .m = t->m,
                                        .lower = lower,
                                        .upper = upper,
                                        .start = start,
                                        .equality = t->way == CURVED ? equality : NULL,
                                        .gradients = gradients,
                                        .workers = workers,
                                        .evaluate = evaluate,
                                        .data = t};
    const ves_search_hooks hooks = {.stopped = stopped, .data = t};
    ves_search_result *r;
    t->asked = 0;
    ves_status status = ves_search_run(&problem, o, &hooks, &r);
    cr_assert(status == VES_OK || status == VES_INTERRUPTED, "%d", status);
    cr_expect(r->evaluations == t->asked && r->evaluations <= r->budget, "%ld of %ld", r->evaluations,
              r->budget);
    cr_expect(r->evidence.sentence != NULL && strlen(r->evidence.sentence) > 0);
    return r;
}

static ves_search_result *polished(task *t)
{
    ves_search_options o = ves_search_options_default();
    o.stages = 1;
    o.stage[0] = (ves_stage){.kind = VES_STAGE_POLISH};
    return run(t, &o, true, 1);
}

/* ---- the end ---- */

Test(honest, a_budget_that_nobody_gave_goes_back_when_nothing_is_left_to_find)
{
    for (int gradients = 0; gradients < 2; gradients++) {
        task t = {.n = 2, .way = BOWL};
        ves_search_options o = ves_search_options_default();
        ves_search_result *r = run(&t, &o, gradients, 1);
        const ves_evidence *e = &r->evidence;
        cr_expect(r->feasible && r->value < 1e-12 && r->evaluations < r->budget / 2, "%ld of %ld",
                  r->evaluations, r->budget);
        cr_expect(e->trust == VES_TRUST_REPEATED && e->minima == 1 && e->hits == e->descents && e->hits >= 10,
                  "%s", e->sentence);
        cr_expect(e->unseen < 0.01 && e->unseen == ves_evidence_unseen(e->descents, 1), "%g", e->unseen);
        cr_expect(r->optimum[0].hits >= e->hits, "%d hits", r->optimum[0].hits);
        long spare = r->budget - r->evaluations;
        o.evaluations = r->budget;
        ves_search_result *given = run(&t, &o, gradients, 1);
        cr_expect(given->evaluations > r->evaluations && given->budget - given->evaluations < spare / 2,
                  "given: %ld of %ld", given->evaluations, given->budget);
        ves_search_result_destroy(given);
        ves_search_result_destroy(r);
    }
}

Test(honest, all_minima_are_counted_and_the_unseen_ones_estimated)
{
    for (uint64_t seed = 1; seed < 6; seed++) {
        task t = {.n = 3, .way = WELLS};
        ves_search_options o = ves_search_options_default();
        o.seed = seed;
        ves_search_result *r = run(&t, &o, true, 1);
        const ves_evidence *e = &r->evidence;
        cr_expect(e->minima > 4 && e->minima <= 8 && e->descents > 2 * e->minima, "%s", e->sentence);
        cr_expect(e->expected >= e->minima && e->expected < 12, "%g", e->expected);
        cr_expect(e->hits > 1 && e->hits < e->descents, "%s", e->sentence);
        cr_expect(r->x[0] < -0.9 && r->x[1] < -0.9 && r->x[2] < -0.9);
        long hits = 0;
        for (int k = 0; k < r->optima; k++) hits += r->optimum[k].hits;
        cr_expect(hits >= e->descents, "%ld hits of %ld descents and more", hits, e->descents);
        ves_search_result_destroy(r);
    }
}

Test(honest, the_best_of_a_small_basin_is_not_given_up_by_an_early_end)
{
    /* 64 minima, the best's basin about a hundredth of the box or less */
    task t = {.n = 6, .way = WELLS};
    ves_search_options o = ves_search_options_default();
    o.stages = 1;
    o.stage[0] = (ves_stage){.kind = VES_STAGE_AUTO};
    ves_search_result *r = run(&t, &o, true, 1);
    for (int i = 0; i < 6; i++) cr_expect(r->x[i] < -0.9, "%g", r->x[i]);
    cr_expect(r->evidence.hits < 10 && r->evidence.unseen > 0.01, "%s", r->evidence.sentence);
    cr_expect(r->ending == VES_ENDED_BUDGET && strstr(r->stop, "is spent"), "%s", r->stop);
    ves_search_result_destroy(r);
}

static ves_trust trust_of(task *t, const ves_search_options *o)
{
    ves_search_result *r = run(t, o, true, 1);
    ves_trust trust = r->evidence.trust;
    ves_search_result_destroy(r);
    return trust;
}

Test(honest, each_verdict_has_a_search_that_ends_in_it)
{
    ves_search_options o = ves_search_options_default(), one = o, cold = o;
    one.stages = cold.stages = 1;
    one.stage[0] = (ves_stage){.kind = VES_STAGE_POLISH};
    cold.stage[0] = (ves_stage){.kind = VES_STAGE_ANNEAL};
    task easy = {.n = 2, .way = BOWL}, nowhere = {.n = 2, .m = 1, .way = NOWHERE},
         shut = {.n = 2, .way = BOWL, .above = 0.1}, half = {.n = 2, .way = BOWL, .below = 0.5},
         cut = {.n = 2, .way = BOWL, .most = 500};
    cr_expect(eq(int, trust_of(&easy, &o), VES_TRUST_REPEATED));
    cr_expect(eq(int, trust_of(&easy, &one), VES_TRUST_CONVERGED));
    cr_expect(eq(int, trust_of(&nowhere, &o), VES_TRUST_NONE));
    cr_expect(eq(int, trust_of(&cut, &o), VES_TRUST_STOPPED));
    cr_expect(eq(int, trust_of(&easy, &cold), VES_TRUST_FROZEN));
    cold.stage[0].anneal.schedule = "fixed";
    cold.stage[0].anneal.c0 = 1;
    cr_expect(eq(int, trust_of(&easy, &cold), VES_TRUST_NONE));
    one.evaluations = 6;
    cr_expect(eq(int, trust_of(&easy, &one), VES_TRUST_SHORT));
    /* the start at 0.7 passes, the minimum at 0.3 does not */
    one.evaluations = 0;
    cr_expect(eq(int, trust_of(&half, &one), VES_TRUST_REFUSED));
    cr_expect(eq(int, trust_of(&half, &o), VES_TRUST_REFUSED));
    /* the start at 0.7 does not pass either: nothing is proved where x > 0.1 */
    cr_expect(eq(int, trust_of(&shut, &one), VES_TRUST_NONE));
}

/* ---- limits and what they cost ---- */

Test(honest, multipliers_are_those_that_a_hand_finds)
{
    static const double factor[] = {1, 1000, 1e-3};
    for (int k = 0; k < 3; k++) {
        /* x^2 + 2 y^2 where x + y >= 1: x = 2/3, y = 1/3, f = 2 L^2 / 3, df/dL = 4/3 */
        task t = {.n = 2, .m = 1, .way = LAGRANGE, .limit = 1, .factor = factor[k]};
        ves_search_result *r = polished(&t);
        cr_assert(r->kkt.known && r->kkt.unique);
        /* the polish is exact to 1e-9 of the box, and the slope of f is 2 there */
        cr_expect(fabs(r->kkt.multiplier[0] * factor[k] - 4. / 3) < 1e-6, "%.12g",
                  r->kkt.multiplier[0] * factor[k]);
        cr_expect(r->kkt.residual < 1e-7 && r->kkt.bound[0] == 0 && r->kkt.bound[1] == 0, "%g",
                  r->kkt.residual);
        ves_search_result_destroy(r);
    }
    task t = {.n = 2, .m = 1, .way = LAGRANGE, .limit = -1, .factor = 1}; /* far from the best */
    ves_search_result *r = polished(&t);
    cr_expect(r->kkt.known && r->kkt.unique && r->kkt.multiplier[0] == 0 && r->kkt.slope < 1e-6);
    ves_search_result_destroy(r);
}

Test(honest, a_bound_that_holds_the_best_is_told_with_its_price)
{
    task t = {.n = 2, .way = BOUND};
    ves_search_result *r = polished(&t);
    cr_expect(r->x[0] == 2 && r->kkt.known && fabs(r->kkt.bound[0] + 2) < 1e-12 && r->kkt.bound[1] == 0, "%g",
              r->kkt.bound[0]); /* d/dx (x - 3)^2 at 2 */
    cr_expect(r->kkt.residual < 1e-7 && r->kkt.unique, "%g", r->kkt.residual);
    ves_search_result_destroy(r);
}

Test(honest, a_multiplier_is_the_derivative_of_the_best_value)
{
    double value[3], multiplier = 0;
    const double step = 1e-4;
    for (int k = 0; k < 3; k++) {
        task t = {.n = 2, .m = 1, .way = CURVED, .limit = 1 + step * (k - 1), .factor = 7};
        ves_search_result *r = polished(&t);
        cr_assert(r->feasible && r->kkt.known && r->kkt.unique && r->kkt.residual < 1e-6);
        value[k] = r->value;
        if (k == 1) multiplier = r->kkt.multiplier[0];
        ves_search_result_destroy(r);
    }
    /* outwards is c <= eps: the limit rises by eps / 7; differences: step^2, and values exact to 1e-12 / step */
    double slope = (value[2] - value[0]) / (2 * step);
    cr_expect(fabs(-7 * multiplier - slope) < 1e-6, "%.10g, by differences %.10g", -7 * multiplier, slope);
}

Test(honest, limits_that_depend_on_each_other_have_no_prices_of_their_own)
{
    static const int way[] = {TWICE, CORNER}, m[] = {2, 3};
    for (int k = 0; k < 2; k++) {
        task t = {.n = 2, .m = m[k], .way = way[k], .limit = 1, .factor = 1};
        ves_search_result *r = polished(&t);
        cr_assert(r->feasible && r->kkt.known);
        cr_expect(r->kkt.unique == false && r->kkt.residual < 1e-6, "%g", r->kkt.residual);
        for (int j = 0; j < m[k]; j++) cr_expect(r->kkt.multiplier[j] >= 0);
        ves_search_result_destroy(r);
    }
}

Test(honest, without_slopes_nothing_is_said_of_them)
{
    task t = {.n = 2, .way = BOWL};
    ves_search_options o = ves_search_options_default();
    ves_search_result *r = run(&t, &o, false, 1);
    cr_expect(r->kkt.known == false && isnan(r->kkt.residual) && r->kkt.multiplier == NULL);
    ves_search_result_destroy(r);
}

/* ---- who did what ---- */

Test(honest, strategies_tell_what_they_have_asked_for_and_found)
{
    task t = {.n = 3, .way = WELLS};
    for (int given = 0; given < 2; given++) {
        ves_search_options o = ves_search_options_default();
        o.evaluations = given ? 4000 : 0;
        ves_search_result *r = run(&t, &o, true, 1);
        long evaluations = 0, gradients = 0, bests = 0;
        int best = 0, starts = 0;
        for (int k = 0; k < r->strategies; k++) {
            const ves_strategy_report *s = &r->strategy[k];
            evaluations += s->evaluations, gradients += s->gradients, bests += s->bests, best += s->best;
            starts += !strcmp(s->name, "starts");
            cr_expect(s->stage == 0 && s->gradients <= s->evaluations && s->bests >= s->best);
        }
        cr_expect(r->strategies > 3 && starts == 1 - given && best == 1 && bests >= 1, "%d", r->strategies);
        cr_expect(evaluations <= r->evaluations && evaluations > r->evaluations / 2 &&
                      gradients <= r->gradients,
                  "%ld of %ld", evaluations, r->evaluations);
        ves_search_result_destroy(r);
    }
}

Test(honest, threads_change_nothing)
{
    ves_search_result *r[2];
    for (int k = 0; k < 2; k++) {
        task t = {.n = 3, .way = WELLS};
        ves_search_options o = ves_search_options_default();
        r[k] = run(&t, &o, true, 1 + k);
    }
    const ves_evidence *a = &r[0]->evidence, *b = &r[1]->evidence;
    cr_expect(r[0]->evaluations == r[1]->evaluations && r[0]->value == r[1]->value);
    cr_expect(a->descents == b->descents && a->hits == b->hits && !strcmp(a->sentence, b->sentence),
              "%s | %s", a->sentence, b->sentence);
    cr_expect(r[0]->kkt.residual == r[1]->kkt.residual && r[0]->kkt.slope == r[1]->kkt.slope);
    for (int k = 0; k < 2; k++) ves_search_result_destroy(r[k]);
}

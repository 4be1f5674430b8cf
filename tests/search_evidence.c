/* What the verdict says of the best must be what the rest of the result says: optima that lie evenly, ends that are
 * none, evidence that outlives its stage, places that are without number. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include "search/archive.h"
#include "search/descent.h"
#include "search/evidence.h"
#include "search_problems.h"

static ves_search_result *searched(const given *g, const ves_search_options *o)
{
    ves_search_result *r;
    cr_assert(eq(int, run(g, o, NULL, &r), VES_OK));
    cr_assert(r->feasible && strlen(r->evidence.sentence) > (size_t)r->evidence.verdict);
    return r;
}

static void says(const ves_search_result *r, ves_trust trust, const char *word)
{
    cr_expect(r->evidence.trust == trust && strstr(r->evidence.sentence, word), "%d: %s", r->evidence.trust,
              r->evidence.sentence);
}

/* ---- optima that lie evenly ---- */

static ves_status comb(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const given *p = data;
    (void)worker;
    double *g = gradient_of(ask, v);
    v->value = 1;
    for (int i = 0; i < p->n; i++) {
        double s = sin(PI * ask->x[i]);
        v->value += s * s;
        if (g) g[i] = PI * sin(2 * PI * ask->x[i]);
    }
    return VES_OK;
}

Test(evidence, optima_that_lie_evenly_are_told_apart)
{
    for (int n = 1; n < 3; n++)
        for (uint64_t seed = 1; seed < 4; seed++) {
            given g = {.evaluate = comb, .n = n, .gradients = true, .data = &g};
            g.lower[0] = g.lower[1] = -0.4, g.upper[0] = 8.6, g.upper[1] = 0.4;
            g.start[0] = 0.3, g.start[1] = 0.1;
            ves_search_options o = ves_search_options_default();
            o.seed = seed;
            o.evaluations = 20000;
            ves_search_result *r = searched(&g, &o);
            int found = 0; /* in one variable the upper bound is an optimum too, of 1.9 */
            for (int k = 0; k < r->optima; k++) found += fabs(r->optimum[k].value - 1) < 1e-9;
            cr_expect(found == 9, "n %d, seed %d: %d of 9 minima", n, (int)seed, found);
            /* 28 draws of nine equal basins see fewer than seven of them once in 2000 times */
            cr_expect(r->evidence.minima >= 7 && r->evidence.expected >= 9, "%s", r->evidence.sentence);
            ves_search_result_destroy(r);
        }
}

/* ---- ends that are none ---- */

enum { KINK, ROOT, WALL, WRONG };

typedef struct bad {
    int n, way;
} bad;

/* |x - 0.3|; a root whose slope grows without limit towards what is no number; a slope that ends at a wall of failures;
 * a bowl whose gradient leads uphill. */
static ves_status bad_end(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const bad *b = data;
    (void)worker;
    double *g = gradient_of(ask, v), sum = 0;
    v->value = 0;
    for (int i = 0; i < b->n; i++) {
        double z = ask->x[i] - 0.3;
        sum += ask->x[i];
        v->value += b->way == KINK ? fabs(z) : b->way == WALL ? ask->x[i] : z * z;
        if (g)
            g[i] = b->way == KINK ? (z > 0) - (z < 0) : b->way == WALL ? 1 : b->way == WRONG ? -2 * z : 2 * z;
    }
    if (b->way == ROOT) {
        v->value += sqrt(ask->x[0] - 0.5);
        if (g) g[0] += 0.5 / sqrt(ask->x[0] - 0.5);
    }
    if (b->way == WALL && sum < 0.2) v->status = VES_DEGENERATE;
    return VES_OK;
}

static ves_search_result *badly(int way, bool gradients, const ves_search_options *o)
{
    bad b = {.n = 3, .way = way};
    given g = {.evaluate = bad_end, .n = 3, .gradients = gradients, .data = &b};
    for (int i = 0; i < 3; i++) g.lower[i] = -1, g.upper[i] = 1, g.start[i] = 0.9;
    return searched(&g, o);
}

Test(evidence, a_kink_is_no_convergence)
{
    const ves_search_options o = only_polish(NULL);
    ves_search_result *r = badly(KINK, true, &o);
    cr_expect(strstr(r->stop, "kink") && r->kkt.residual > 0.9, "%s", r->stop);
    says(r, VES_TRUST_KINK, "sbplx or cobyla");
    ves_search_result_destroy(r);
    ves_search_options alone = o; /* no polish looks at the slope */
    alone.stage[0] = (ves_stage){.kind = VES_STAGE_AUTO};
    r = badly(KINK, true, &alone);
    says(r, VES_TRUST_KINK, "independent descents ended there");
    ves_search_result_destroy(r);
    const ves_search_options plain = only_polish("cobyla"); /* needs no slopes: it is there */
    r = badly(KINK, true, &plain);
    says(r, VES_TRUST_CONVERGED, "converged");
    ves_search_result_destroy(r);
}

Test(evidence, an_edge_of_what_can_be_measured_is_no_convergence)
{
    const ves_search_options o = ves_search_options_default(), polish = only_polish(NULL);
    for (int gradients = 0; gradients < 2; gradients++) {
        ves_search_result *r = badly(ROOT, gradients, &o);
        cr_expect(strstr(r->stop, "beside a candidate") != NULL, "%s", r->stop);
        says(r, VES_TRUST_EDGE, "may lie beyond");
        ves_search_result_destroy(r);
    }
    ves_search_result *r = badly(WALL, true, &polish);
    says(r, VES_TRUST_EDGE, "by a constraint");
    ves_search_result_destroy(r);
    r = badly(WALL, true, &o); /* where several descents end beside it, too */
    says(r, VES_TRUST_EDGE, "independent descents ended there");
    ves_search_result_destroy(r);
}

Test(evidence, what_an_algorithm_says_counts_less_than_the_slope)
{
    static const struct {
        ves_halt halt;
        double residual;
        long hits;
        ves_trust trust;
    } row[] = {
        {VES_HALT_REST, NAN, 0, VES_TRUST_CONVERGED},    {VES_HALT_REST, NAN, 2, VES_TRUST_REPEATED},
        {VES_HALT_LOST, NAN, 0, VES_TRUST_LOST},         {VES_HALT_LOST, 0.3, 2, VES_TRUST_LOST},
        {VES_HALT_LOST, 1e-9, 2, VES_TRUST_REPEATED},    {VES_HALT_EDGE, NAN, 0, VES_TRUST_EDGE},
        {VES_HALT_EDGE, 1e-9, 0, VES_TRUST_CONVERGED},   {VES_HALT_KINK, 0.3, 2, VES_TRUST_KINK},
        {VES_HALT_UNKNOWN, NAN, 0, VES_TRUST_CONVERGED}, {VES_HALT_UNKNOWN, 0.3, 2, VES_TRUST_KINK},
        {VES_HALT_UNKNOWN, 1e-4, 2, VES_TRUST_REPEATED},
    };
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        ves_session session = {.ending = VES_ENDED_DONE};
        const ves_witness w = {
            .feasible = true, .halt = row[k].halt, .residual = row[k].residual, .hits = row[k].hits};
        const ves_evidence e = ves_evidence_judge(&session, &w);
        cr_expect(e.trust == row[k].trust, "row %zu: %d, %s", k, e.trust, e.sentence);
        cr_expect(e.trust != VES_TRUST_LOST || strstr(e.sentence, "another algorithm"), "%s", e.sentence);
        ves_arena_destroy(&session.kept);
    }
}

Test(evidence, an_algorithm_that_failed_is_told_from_one_that_rounding_ends)
{
    ves_descent d = {.budget = 10, .code = NLOPT_XTOL_REACHED};
    cr_expect(eq(int, ves_descent_halt(&d), VES_HALT_REST));
    d.code = NLOPT_ROUNDOFF_LIMITED;
    cr_expect(eq(int, ves_descent_halt(&d), VES_HALT_REST));
    d.code = NLOPT_FAILURE;
    cr_expect(eq(int, ves_descent_halt(&d), VES_HALT_LOST));
    d.beside = true;
    cr_expect(eq(int, ves_descent_halt(&d), VES_HALT_EDGE));
    d.used = 10;
    cr_expect(eq(int, ves_descent_halt(&d), VES_HALT_UNKNOWN));
}

/* ---- evidence outlives its stage ---- */

Test(evidence, stages_behind_a_portfolio_lose_none_of_it)
{
    static const ves_stage_kind then[][2] = {{VES_STAGE_POLISH, VES_STAGE_POLISH},
                                             {VES_STAGE_ANNEAL, VES_STAGE_POLISH},
                                             {VES_STAGE_POLISH, VES_STAGE_ANNEAL},
                                             {VES_STAGE_AUTO, VES_STAGE_POLISH}};
    given g = {.evaluate = quadratic, .n = 2, .gradients = true, .data = &g};
    for (int i = 0; i < 2; i++) g.lower[i] = -1, g.upper[i] = 1, g.start[i] = 0.9;
    for (int k = 0; k < 8; k++) {
        ves_search_options o = ves_search_options_default();
        o.stages = 2 + k % 2;
        o.stage[0].kind = VES_STAGE_AUTO;
        for (int j = 0; j < 2; j++) o.stage[1 + j].kind = then[k / 2][j];
        if (then[k / 2][0] == VES_STAGE_AUTO)
            o.stage[1].automatic = (ves_auto){.only = "cma", .evaluations = 500};
        ves_search_result *r = searched(&g, &o);
        const ves_evidence *e = &r->evidence;
        cr_expect(e->descents >= 10 && e->hits == e->descents && e->minima == 1, "%d: %s", k, e->sentence);
        cr_expect(r->optimum[0].hits >= e->hits, "%d: %d hits, %s", k, r->optimum[0].hits, e->sentence);
        ves_search_result_destroy(r);
    }
}

/* ---- more places than can be kept ---- */

static ves_status level(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const given *p = data;
    (void)worker;
    v->value = 3;
    if (ask->want & VES_WANT_GRADIENT) memset(v->gradient, 0, sizeof(double) * (size_t)p->n);
    return VES_OK;
}

Test(evidence, a_flat_objective_has_one_optimum_however_many_ends)
{
    given g = {.evaluate = level, .n = 3, .gradients = true, .data = &g};
    for (int i = 0; i < 3; i++) g.lower[i] = -1, g.upper[i] = 1, g.start[i] = 0.9;
    const ves_search_options o = ves_search_options_default();
    ves_search_result *r = searched(&g, &o);
    const ves_evidence *e = &r->evidence;
    cr_expect(e->descents >= 512 && e->minima == 1 && e->hits == e->descents, "%s", e->sentence);
    ves_search_result_destroy(r);
}

Test(evidence, a_full_archive_that_closes_counts_no_more)
{
    const ves_search_problem problem = {.n = 1, .tolerance = 1e-6};
    ves_session session = {.problem = &problem, .n = 1, .tolerance = 1e-6};
    ves_archive archive;
    ves_point point;
    cr_assert(ves_archive_create(&archive, &session, 4) && ves_point_create(&session.arena, 1, 0, &point));
    archive.closes = true;
    ves_archive_add(&archive, &point);
    cr_expect(archive.failed == 1 && archive.met == 0);
    for (int turn = 0; turn < 3; turn++)
        for (int k = 0; k < 6; k++) { /* the last ones are the best */
            point.verdict.status = VES_OK;
            point.verdict.value = -k, point.verdict.violation = 0;
            point.u[0] = 0.1 * k;
            int at = ves_archive_add(&archive, &point);
            cr_expect(k < 4 ? at >= 0 : at == -1, "%d: %d", k, at);
        }
    cr_expect(archive.met == 4 && archive.kinds == 4 && archive.count == 4, "%ld, %ld", archive.met,
              archive.kinds);
    ves_arena_destroy(&session.arena);
}

/* ---- random numbers ---- */

Test(evidence, no_two_members_draw_the_same_random_numbers)
{
    for (int a = 0; a < VES_STAGES * VES_STREAM_MEMBERS; a++) {
        const uint64_t first = ves_session_stream(a / VES_STREAM_MEMBERS, a % VES_STREAM_MEMBERS);
        cr_expect(first + 0xffff < VES_STREAM_BEGIN);
        for (int b = 0; b < a; b++) {
            const uint64_t other = ves_session_stream(b / VES_STREAM_MEMBERS, b % VES_STREAM_MEMBERS);
            cr_expect(first > other + 0xffff || other > first + 0xffff, "%d and %d", a, b);
        }
    }
}

enum { DRAWN = 4000 };
typedef struct drawn {
    double x[DRAWN][2];
    int count, same, looked;
} drawn;

static void draw_kept(void *data, const ves_record *r)
{
    drawn *d = data;
    if (r->stage == 0 && d->count < DRAWN) memcpy(d->x[d->count++], r->x, sizeof d->x[0]);
    if (r->stage != 1 || !isnan(r->temperature) || d->looked >= 40) return;
    int known = 0;
    for (int k = 0; k < d->count; k++) known = known || !memcmp(d->x[k], r->x, sizeof d->x[0]);
    d->same += known;
    d->looked++;
}

Test(evidence, an_annealing_draws_other_points_than_the_portfolio_before_it)
{
    static drawn d;
    given g = {.evaluate = comb, .n = 2, .gradients = true, .data = &g};
    g.lower[0] = g.lower[1] = -0.4, g.upper[0] = g.upper[1] = 8.6, g.start[0] = g.start[1] = 0.3;
    ves_search_options o = ves_search_options_default();
    o.stages = 2;
    o.stage[0] = (ves_stage){.kind = VES_STAGE_AUTO, .automatic = {.only = "starts", .evaluations = 3000}};
    o.stage[1].kind = VES_STAGE_ANNEAL;
    o.stage[1].anneal.evaluations = 3000;
    const ves_search_hooks hooks = {.record = draw_kept, .data = &d};
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, &hooks, &r), VES_OK));
    /* four chains begin where descents have ended */
    cr_expect(d.looked == 40 && d.same <= 4, "%d of %d points of the warm-up are those of starts", d.same,
              d.looked);
    ves_search_result_destroy(r);
}

/* ---- what cannot be measured ---- */

static ves_status half(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    return ask->x[0] < -0.1 ? VES_FOLDED : quadratic(data, worker, ask, v);
}

Test(evidence, random_starts_that_cannot_be_measured_are_told)
{
    given g = {.evaluate = half, .n = 2, .gradients = true, .data = &g};
    for (int i = 0; i < 2; i++) g.lower[i] = -1, g.upper[i] = 1, g.start[i] = 0.9;
    ves_search_options o = ves_search_options_default();
    ves_search_result *r = searched(&g, &o);
    const ves_evidence *e = &r->evidence;
    /* of 24 to 100 random points 45 % +- 10 % */
    double part = (double)e->unmeasured / (double)(e->unmeasured + e->descents);
    cr_expect(part > 0.15 && part < 0.75, "%ld and %ld", e->unmeasured, e->descents);
    says(r, VES_TRUST_REPEATED, "where it can be measured");
    ves_search_result_destroy(r);
}

/* It says that all is well, though a constraint is no number. */
static ves_status unruly(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    quadratic(data, worker, ask, v);
    v->violation = 0;
    v->constraint[0] = ask->x[0] > 0 ? NAN : -1;
    if (ask->want & VES_WANT_GRADIENT) v->jacobian[0] = v->jacobian[1] = 0;
    return VES_OK;
}

Test(evidence, a_constraint_that_is_no_number_is_never_met)
{
    given g = {.evaluate = unruly, .n = 2, .m = 1, .data = &g};
    for (int i = 0; i < 2; i++) g.lower[i] = -2, g.upper[i] = 2, g.start[i] = -1;
    for (int gradients = 0; gradients < 2; gradients++) {
        ves_search_options o = ves_search_options_default();
        o.evaluations = 2000;
        ves_search_result *r;
        g.gradients = gradients;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        cr_expect(r->feasible && r->constraint[0] == -1 && r->x[0] <= 0 && r->failed > 0, "%g at %g",
                  r->constraint[0], r->x[0]);
        ves_search_result_destroy(r);
    }
}

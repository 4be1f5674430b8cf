/* The annealer samples what it says: the Boltzmann distribution (7.2) at any temperature that stays, with every
 * proposal, every population, with adaptation before and none meanwhile. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "search/slots.h"
#include "search_problems.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

enum { BATCHES = 64, STATE = 400, PROPOSALS = 6 };

static const ves_proposal *proposal_at(int k)
{
    ves_choice choice;
    return ves_search_choice(VES_SLOT_PROPOSAL, k, &choice) ? ves_slots_proposal(choice.name) : NULL;
}

/* ---- each proposal by itself, in a plain Metropolis loop that knows nothing of chains ---- */

typedef struct walk {
    const ves_proposal *proposal;
    int n;
    double T, step;
    double (*energy)(int n, const double *u);
    double (*feature)(int n, const double *u);
    bool adapt;
} walk;

/* Mean of the feature, its standard error from batch means, and the acceptance. */
static void metropolis(const walk *w, long trials, double *mean, double *error, double *acceptance)
{
    double state[3][STATE], u[MOST], v[MOST], batch[BATCHES] = {0};
    const ves_share single[] = {{w->proposal, 1}, {0}},
                    *share = w->proposal->share ? w->proposal->share : single;
    for (int k = 0; share[k].proposal; k++)
        if (share[k].proposal->init) share[k].proposal->init(w->n, w->step, state[k]);
    for (int i = 0; i < w->n; i++) u[i] = 0.5;
    double e = w->energy(w->n, u);
    long accepted = 0, warm = trials / 10, each = trials / BATCHES;
    for (long k = -warm; k < each * BATCHES; k++) {
        ves_random random = {.seed = 5, .chain = 1, .step = (uint64_t)(k + warm)};
        int which = 0;
        for (double r = ves_random_uniform(&random); r >= share[which].share && share[which + 1].proposal;
             which++)
            r -= share[which].share;
        const ves_proposal *p = share[which].proposal;
        memcpy(v, u, sizeof u);
        p->propose(w->n, state[which], 1, &random, v);
        double next = w->energy(w->n, v);
        bool yes = next - e < -w->T * log(ves_random_uniform(&random));
        if (yes) memcpy(u, v, sizeof u), e = next;
        if (w->adapt && p->adapt) p->adapt(w->n, state[which], yes);
        if (k < 0) continue;
        accepted += yes;
        batch[k / each] += w->feature(w->n, u) / (double)each;
    }
    *mean = *error = 0;
    for (int b = 0; b < BATCHES; b++) *mean += batch[b] / BATCHES;
    for (int b = 0; b < BATCHES; b++) *error += (batch[b] - *mean) * (batch[b] - *mean);
    *error = sqrt(*error / (BATCHES * (BATCHES - 1.0)));
    *acceptance = (double)accepted / (double)(each * BATCHES);
}

static double well(int n, const double *u)
{
    double sum = 0;
    for (int i = 0; i < n; i++) sum += (1 + i) * (u[i] - 0.5) * (u[i] - 0.5);
    return sum;
}

/* Mean energy n T / 2 in a quadratic well. T = 1e-3: a wall is 7 standard deviations away. Four standard errors:
 * one false alarm in 16000. These are 5 % of the mean at most, or the test would say little. */
Test(search_sampling, every_proposal_samples_a_quadratic_well)
{
    const int size[] = {1, 3, 6};
    for (int p = 0; p < PROPOSALS; p++)
        for (int k = 0; k < 3; k++) {
            walk w = {proposal_at(p), size[k], 1e-3, 0.04, well, well, false};
            double mean, error, acceptance, want = 0.5 * size[k] * w.T;
            metropolis(&w, 600000, &mean, &error, &acceptance);
            cr_expect(error < 0.05 * want, "%s n %d: standard error %g of %g", w.proposal->name, size[k],
                      error, want);
            cr_expect(fabs(mean - want) < 4 * error, "%s n %d: got %g, want %g +- %g", w.proposal->name,
                      size[k], mean, want, error);
        }
    cr_expect(proposal_at(PROPOSALS) == NULL);
}

static double wells(const double *u, double tilt)
{
    double x = 4 * u[0] - 2; /* [-2, 2] */
    return (x * x - 1) * (x * x - 1) + tilt * x;
}

static double two_wells(int n, const double *u)
{
    (void)n;
    return wells(u, 0.2);
}

static double is_left(int n, const double *u)
{
    (void)n;
    return u[0] < 0.5;
}

/* The share of the left well at temperature T, by Simpson's rule. */
static double left_share(double T, double tilt)
{
    double left = 0, all = 0;
    enum { N = 4000 };
    for (int k = 0; k <= N; k++) {
        double u = (double)k / N, weight = k == 0 || k == N ? 1 : k % 2 ? 4 : 2;
        double p = weight * exp(-wells(&u, tilt) / T);
        all += p;
        left += k < N / 2 ? p : k == N / 2 ? p / 2 : 0;
    }
    return left / all;
}

/* Populations of a double well, walls included. */
Test(search_sampling, every_proposal_fills_a_double_well_as_boltzmann_says)
{
    const double T = 0.4;
    for (int p = 0; p < PROPOSALS; p++) {
        walk w = {proposal_at(p), 1, T, 0.3, two_wells, is_left, false};
        double mean, error, acceptance, want = left_share(T, 0.2);
        metropolis(&w, 400000, &mean, &error, &acceptance);
        /* as above: a sharper bound than the share itself, which is of the size of 1 */
        cr_expect(error < 0.01, "%s: standard error %g", w.proposal->name, error);
        cr_expect(fabs(mean - want) < 4 * error, "%s: got %g, want %g +- %g", w.proposal->name, mean, want,
                  error);
    }
}

/* Widths that begin far too small or too large end where the acceptance is what they follow: between 0.4 and 0.6 by
 * Corana's rule, 0.234 along the covariance. */
Test(search_sampling, adapted_widths_meet_their_acceptance)
{
    const double step[] = {1e-4, 1};
    for (int k = 0; k < 2; k++) {
        double mean, error, acceptance;
        walk corana = {&ves_proposal_corana, 2, 1e-3, step[k], well, well, true};
        metropolis(&corana, 200000, &mean, &error, &acceptance);
        cr_expect(acceptance > 0.4 && acceptance < 0.6, "corana from %g: %g", step[k], acceptance);
        walk covariance = {&ves_proposal_covariance, 2, 1e-3, step[k], well, well, true};
        metropolis(&covariance, 200000, &mean, &error, &acceptance);
        cr_expect(fabs(acceptance - 0.234) < 0.02, "covariance from %g: %g", step[k], acceptance);
    }
}

/* Points from an oblique normal distribution: what is learnt is its covariance, within the error of a window of 5 n
 * points, and the steps are spread alike. */
Test(search_sampling, covariance_is_learnt)
{
    enum { N = 4, POINTS = 4000 };
    double state[STATE], u[N], z[N], sum[N][N] = {{0}};
    const ves_proposal *p = &ves_proposal_covariance;
    p->init(N, 0.1, state);
    ves_random random = {.seed = 8};
    long steps = 0;
    for (int k = 0; k < POINTS; k++) {
        random.step++, random.draw = 0;
        ves_random_normals(&random, N, z);
        for (int i = 0; i < N; i++) u[i] = 0.5 + 0.01 * (z[i] * (1 + i) + 3 * z[0]);
        p->learn(N, state, u);
        if (k < POINTS / 2) continue;
        double from[N] = {0.5, 0.5, 0.5, 0.5}, to[N] = {0.5, 0.5, 0.5, 0.5};
        p->propose(N, state, 1, &random, to);
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++) sum[i][j] += (to[i] - from[i]) * (to[j] - from[j]);
        steps++;
    }
    double scale = 2.38 * 2.38 / N * 1e-4;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++) {
            double bi = i ? 1 + i : 4, bj = j ? 1 + j : 4; /* along z[i] itself; z[0] counts 3 everywhere */
            double want = scale * (i == 0 && j == 0 ? 16 : i == 0 || j == 0 ? 12 : i == j ? bi * bj + 9 : 9);
            double got = sum[i][j] / (double)steps;
            cr_expect(fabs(got / want - 1) < 0.15, "%d %d: got %g, want %g", i, j, got, want);
        }
}

/* ---- the whole search at one temperature ---- */

/* quadratic in n variables around 0.3, in the caller's units */
static ves_status bowl(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const given *problem = data;
    (void)worker;
    v->value = 7;
    for (int i = 0; i < problem->n; i++) {
        double d = ask->x[i] - 0.3;
        v->value += (1 + i) * d * d;
    }
    return VES_OK;
}

static given problem_bowl(int n)
{
    given g = {.evaluate = bowl, .n = n};
    for (int i = 0; i < n; i++) g.lower[i] = -8, g.upper[i] = 9, g.start[i] = 0.3;
    return g;
}

/* Mean energy above the bottom over seeds, and its standard error. */
static void sample(given *g, const ves_anneal *anneal, int seeds, double *mean, double *error,
                   double *variance)
{
    double square = 0;
    *mean = *variance = 0;
    g->data = g;
    for (int k = 0; k < seeds; k++) {
        ves_search_options o = only_anneal(60000);
        o.stage[0].anneal = *anneal;
        o.stage[0].anneal.evaluations = 60000;
        o.seed = (uint64_t)k + 1;
        ves_search_result *r;
        cr_assert(eq(int, run(g, &o, NULL, &r), VES_OK));
        cr_assert(r->temperatures == 2 && r->annealings == 1 && r->annealing[0].health == VES_HEALTH_SAMPLED);
        const ves_temperature *t = &r->temperature[1];
        cr_expect(t->c == anneal->c0 && r->temperature[0].c == anneal->c0);
        for (int j = 0; j < r->annealing[0].moves; j++) /* nothing was adapted any more */
            cr_expect(r->temperature[0].move[j].width == t->move[j].width, "%s: width %g then %g",
                      r->annealing[0].move[j], r->temperature[0].move[j].width, t->move[j].width);
        *mean += (t->mean - 7) / seeds;
        square += (t->mean - 7) * (t->mean - 7) / seeds;
        *variance += t->variance / seeds;
        ves_search_result_destroy(r);
    }
    *error = sqrt((square - *mean * *mean) / (seeds - 1));
}

/* n T / 2 above the bottom and the variance n T^2 / 2 (7.2), with all proposals, all populations; widths adapted in
 * the first tenth. The standard error comes from 16 seeds: four of them, and a bound on what they are. */
Test(search_sampling, a_search_at_one_temperature_is_in_equilibrium, .timeout = 120)
{
    enum { N = 3, SEEDS = 16 };
    static const char *const population[] = {"chain", "chains", "tempering"};
    const double T = 0.1;
    for (int p = 0; p < PROPOSALS; p++)
        for (int q = 0; q < 3; q++) {
            given g = problem_bowl(N);
            ves_anneal a = {.proposal = proposal_at(p)->name, .schedule = "fixed", .c0 = T, .step = 0.02};
            a.population = population[q];
            double mean, error, variance, want = N * T / 2;
            sample(&g, &a, SEEDS, &mean, &error, &variance);
            cr_expect(fabs(mean - want) < 4 * error, "%s %s: got %g, want %g +- %g", a.proposal, a.population,
                      mean, want, error);
            cr_expect(error < 0.03 * want, "%s %s: standard error %g", a.proposal, a.population, error);
            cr_expect(fabs(variance / (N * T * T / 2) - 1) < 0.15, "%s %s: variance %g", a.proposal,
                      a.population, variance);
        }
}

/* ---- exchanges ---- */

/* Two replicas of two states each, energies 0 and 1, drawn from the joint distribution: exchanges leave it as it is,
 * and flow as often one way as the other. */
Test(search_sampling, exchanges_satisfy_detailed_balance)
{
    const double c[3] = {0.7, 1.3, 2.9};
    enum { TURNS = 400000 };
    long flow[2][2] = {{0}}, state[8] = {0};
    ves_random random = {.seed = 3, .chain = 1}, draws = {.seed = 4};
    ves_swaps swaps[2] = {{0}};
    for (int k = 0; k < TURNS; k++) {
        ves_chain chain[3] = {{.energy = 0}};
        double before[3];
        draws.step++, draws.draw = 0;
        for (int i = 0; i < 3; i++) {
            double p = exp(-1 / c[i]) / (1 + exp(-1 / c[i]));
            before[i] = chain[i].energy = ves_random_uniform(&draws) < p;
        }
        int pair = (int)(random.step % 2);
        ves_population_tempering.meet(chain, 3, c, &random, swaps);
        if (before[pair] != chain[pair].energy) flow[pair][before[pair] > chain[pair].energy]++;
        state[4 * (int)chain[0].energy + 2 * (int)chain[1].energy + (int)chain[2].energy]++;
    }
    for (int k = 0; k < 2; k++) {
        double up = (double)flow[k][0], down = (double)flow[k][1];
        cr_expect(fabs(up - down) < 4 * sqrt(up + down), "pair %d: %g up, %g down", k, up, down);
        cr_expect(up > 1000 && swaps[k].tried == TURNS / 2 && swaps[k].done > swaps[k].tried / 4);
    }
    for (int s = 0; s < 8; s++) {
        double p = 1;
        for (int i = 0; i < 3; i++) {
            double w = exp(-1 / c[i]);
            p *= (s >> (2 - i) & 1 ? w : 1) / (1 + w);
        }
        double error = sqrt(p * (1 - p) / TURNS), got = (double)state[s] / TURNS;
        cr_expect(fabs(got - p) < 4 * error, "state %d: got %g, want %g +- %g", s, got, p, error);
    }
}

static const double slight = 0.05; /* tilt */

static ves_status double_well(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    v->value = wells(ask->x, slight);
    return VES_OK;
}

typedef struct listener {
    double c;
    long trials, left;
    bool in;
} listener;

enum { HEARD = 2000 }; /* trials of the coldest chain before it is listened to */

/* Where the coldest chain is after each of its trials. */
static void hear(void *data, const ves_record *record)
{
    listener *l = data;
    if (record->chain != 0 || record->temperature != l->c) return;
    if (record->accepted) l->in = record->x[0] < 0.5;
    if (++l->trials > HEARD) l->left += l->in;
}

/* A barrier of 1 at T = 0.08: small steps alone hardly ever cross it; replicas carry the coldest chain over it, which
 * is then where the energies say, in both wells. 20 seeds give the standard error. An exchange shows with the next
 * accepted trial only, some trials late: a blur of the times, not of the shares. */
Test(search_sampling, replicas_cross_a_barrier_that_a_chain_does_not)
{
    enum { SEEDS = 20 };
    const double T = 0.08, want = left_share(T, slight);
    double share[2], error[2];
    for (int q = 0; q < 2; q++) {
        double sum = 0, square = 0;
        for (int k = 0; k < SEEDS; k++) {
            given g = {.evaluate = double_well, .n = 1, .lower = {0}, .upper = {1}, .start = {0.75}};
            listener l = {.c = T};
            ves_search_hooks hooks = {.record = hear, .data = &l};
            ves_search_options o = only_anneal(q ? 160000 : 20000); /* as many of the coldest chain */
            ves_anneal *a = &o.stage[0].anneal;
            a->proposal = "fixed", a->schedule = "fixed", a->c0 = T, a->step = 0.06;
            a->population = q ? "tempering" : "chain";
            o.seed = (uint64_t)k + 1;
            ves_search_result *r;
            cr_assert(eq(int, run(&g, &o, &hooks, &r), VES_OK));
            double part = (double)l.left / (double)(l.trials - HEARD);
            sum += part / SEEDS, square += part * part / SEEDS;
            if (q) cr_expect(r->annealing[0].least_swap > 0.2, "%g", r->annealing[0].least_swap);
            ves_search_result_destroy(r);
        }
        share[q] = sum, error[q] = sqrt((square - sum * sum) / (SEEDS - 1));
    }
    cr_expect(share[0] < 0.3, "a chain alone: %g", share[0]);
    cr_expect(fabs(share[1] - want) < 4 * error[1] && error[1] < 0.03, "got %g, want %g +- %g", share[1],
              want, error[1]);
}

/* ---- Hastings ---- */

/* Steps that lean to one side: normal with mean 1/2 and width 1, times 0.03. Density of a step x: e^{-(x-1/2)^2/2}; of
 * the way back e^{-(x+1/2)^2/2}: the logarithm of their ratio is -x. */
static void lean(int n, double *state, double heat, ves_random *random, double *u)
{
    (void)n, (void)heat;
    state[0] = ves_random_normal(random) + 0.5;
    u[0] += 0.03 * state[0];
}

static double back(int n, const double *state)
{
    (void)n;
    return -state[0];
}

static int one(int n)
{
    (void)n;
    return 1;
}

static ves_status parabola(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)data, (void)worker;
    v->value = (ask->x[0] - 0.5) * (ask->x[0] - 0.5);
    return VES_OK;
}

/* A proposal that is not symmetric samples the same distribution with its ratio, and another one without. */
Test(search_sampling, proposals_that_lean_are_corrected)
{
    const double T = 1e-3, lower = 0, upper = 1, start = 0.5;
    const ves_search_problem problem = {
        .n = 1, .lower = &lower, .upper = &upper, .start = &start, .evaluate = parabola};
    for (int corrected = 0; corrected < 2; corrected++) {
        const ves_proposal leaning = {
            .name = "leaning", .room = one, .propose = lean, .log_ratio = corrected ? back : NULL};
        const ves_chain_make make = {.proposal = &leaning, .constraint = &ves_constraint_crude, .step = 0.1};
        const ves_search_options o = ves_search_options_default();
        ves_session session;
        ves_chain chain;
        cr_assert(eq(int, ves_session_init(&session, &problem, &o, NULL), VES_OK));
        cr_assert(eq(int, ves_search_begin(&session), VES_OK));
        cr_assert(ves_chain_init(&chain, &session, 0, &make));
        ves_chain_place(&chain, &session.end[0].point);
        double sum = 0, square = 0, x = 0;
        for (int b = 0; b < BATCHES; b++) {
            double batch = 0;
            for (int k = 0; k < 8000; k++) {
                ves_chain_step(&chain, T, 1);
                batch += chain.energy / 8000;
                x += (chain.current.x[0] - 0.5) / (8000 * BATCHES);
            }
            sum += batch / BATCHES, square += batch * batch / BATCHES;
            ves_asker_flush(&chain.asker);
        }
        double error = sqrt((square - sum * sum) / (BATCHES - 1));
        if (corrected)
            cr_expect(fabs(sum - T / 2) < 4 * error && error < 0.03 * sum && fabs(x) < 0.001,
                      "got %g, want %g +- %g, mean place %g", sum, T / 2, error, x);
        else
            cr_expect(x > 0.005, "without the ratio: mean place %g", x);
        ves_asker_destroy(&chain.asker);
        ves_session_destroy(&session);
    }
}

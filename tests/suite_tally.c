/* A suite small enough to be counted up by hand: two methods, two problems, four runs. */
#include <criterion/criterion.h>
#include <math.h>
#include <string.h>

#include "suite/profile.h"

enum { METHODS = 2, PROBLEMS = 2, RUNS = 4 };

static const ves_suite_problem problems[PROBLEMS] = {{.name = "known"}, {.name = "unknown"}};
static const ves_method methods[METHODS] = {{.name = "quick"}, {.name = "slow"}};
static const ves_suite suite = {.problems = PROBLEMS,
                                .methods = METHODS,
                                .problem = problems,
                                .method = methods,
                                .seeds = RUNS,
                                .seed = 1,
                                .per_dimension = 50,
                                .most = 1000,
                                .target = {1e-1, 1e-2, 1e-3}};

/* Of method 0 run k goes 10, 0.05, 0.0005 at costs 1, 10 + k, 20 + k, its last never; method 1 ten times
 * slower than the budget allows but for run 3: 10, 0.005 at 1, 80. On the unknown problem all values are
 * higher by 7, and run 0 of the slow method is infeasible throughout. */
static ves_step steps[METHODS][PROBLEMS][RUNS][3];
static ves_outcome outcome[METHODS * PROBLEMS * RUNS];

static void fill(void)
{
    for (int e = 0; e < METHODS; e++)
        for (int p = 0; p < PROBLEMS; p++)
            for (int k = 0; k < RUNS; k++) {
                ves_step *s = steps[e][p][k];
                ves_outcome *o = &outcome[(e * PROBLEMS + p) * RUNS + k];
                double bad = e == 1 && p == 1 && k == 0 ? 2 : 0;
                s[0] = (ves_step){1, 10 + 7 * p, bad};
                s[1] = e ? (ves_step){80, 0.005 + 7 * p, bad} : (ves_step){10 + k, 0.05 + 7 * p, bad};
                s[2] = (ves_step){20 + k, 0.0005 + 7 * p, bad};
                int count = e ? (k == 3 ? 2 : 1) : k == 3 ? 2 : 3;
                bool hit = !p && count == 3;
                *o = (ves_outcome){.done = true,
                                   .any = true,
                                   .hit = hit,
                                   .budget = 100,
                                   .spent = hit ? s[2].cost : 100,
                                   .evaluations = 100,
                                   .value = s[count - 1].value,
                                   .violation = bad,
                                   .steps = count,
                                   .step = s,
                                   .wall = 2e-3,
                                   .inside = 1e-3,
                                   .cpu = p ? NAN : 1e-3};
            }
}

static const double optimum[PROBLEMS] = {0, NAN};
static const int n[PROBLEMS] = {2, 2};
static const ves_tally_input input = {.suite = &suite, .outcome = outcome, .optimum = optimum, .n = n};

static void near(double got, double want, const char *what)
{
    cr_expect(fabs(got - want) <= 1e-12 * fmax(1, fabs(want)), "%s: got %.15g, want %.15g", what, got, want);
}

Test(suite_tally, scores, .init = fill)
{
    ves_tally t;
    cr_assert(ves_tally_init(&input, &t));
    cr_expect(t.reference[0].known && !t.reference[1].known);
    near(t.reference[1].value, 7.0005, "reference");
    cr_expect(t.reference[1].method == 0 && t.reference[1].seed == 0, "the first of equals");
    const ves_score *q = &t.score[0], *s = &t.score[2];
    cr_expect(q->hits[0] == 4 && q->hits[1] == 3 && q->hits[2] == 3 && q->runs == 4 && q->feasible == 4);
    near(q->ert[0].value, (10 + 11 + 12 + 13) / 4.0, "ert of the first target");
    near(q->ert[2].value, (20 + 21 + 22 + 100) / 3.0, "ert of the last");
    near(q->quartile[1], 0.0005, "median");
    near(q->best, 0.0005, "best");
    near(q->own, 5e-6, "own time: the processor worked half of the time");
    near(t.score[1].own, 1e-5, "own time by the clock alone");
    near(q->seconds.value, 4 * 2e-3 / 3, "seconds");
    cr_expect(s->hits[0] == 1 && s->hits[2] == 0 && isinf(s->ert[2].value));
    near(s->ert[0].value, 380, "ert of one hit");
    near(t.score[3].worst, 2, "worst violation");
    cr_expect(t.score[3].feasible == 3);
    cr_expect(t.total[0].hits[2] == 6 && t.total[0].runs == 8 && t.total[1].hits[2] == 1);
    near(t.total[0].share[2].value, 0.75, "share");
    /* Run 3 of the known problem: the quick one meets the first target at 13, the slow one two at 80: 2.37
     * against 2.27, the smallest of the eight differences, and the only one of its sign: P(W <= 1) = 2/2^8 on
     * each side. In 15 of 16 pairs there, and all of the other problem, the quick one is better. */
    near(t.pair[1].effect, (15.0 / 16 + 1) / 2, "effect");
    near(t.pair[1].p, 4.0 / 256, "p");
    near(t.pair[2].effect, 0.5 / 16, "mirrored");
    near(t.pair[1].least, 2.0 / 256, "eight runs");
    near(t.pair[1].lead, (35.0 - 1) / 36, "the smallest rank against all others");
    cr_expect(isnan(t.pair[1].by_problem), "two problems say nothing about others");
    cr_expect(ves_tally_finding(&t.pair[1]) == VES_FINDING_FIRST &&
              ves_tally_finding(&t.pair[2]) == VES_FINDING_SECOND);
    near(ves_tally_dearness(&suite, &problems[0], &outcome[0], 0), (log10(10) + 2 * log10(20)) / 3,
         "dearness");
    near(ves_tally_dearness(&suite, &problems[0], &outcome[8], 0), 3, "ten budgets");
    ves_tally_destroy(&t);
}

/* Its quarrel with the one that leads by ranks: a few runs of the first are far better, most are a little worse. */
Test(suite_tally, who_is_better_is_said_only_where_effect_and_ranks_agree)
{
    ves_pair pair = {.effect = 0.7, .lead = 0.3, .p = 0.01, .least = 0.001};
    cr_expect(ves_tally_finding(&pair) == VES_FINDING_FIRST);
    pair.effect = 0.4;
    cr_expect(ves_tally_finding(&pair) == VES_FINDING_MIXED);
    pair.lead = -0.3;
    cr_expect(ves_tally_finding(&pair) == VES_FINDING_SECOND);
    pair.p = 0.2;
    cr_expect(ves_tally_finding(&pair) == VES_FINDING_SAME);
    pair.least = 0.0625;
    cr_expect(ves_tally_finding(&pair) == VES_FINDING_FEW);
    pair.p = NAN;
    cr_expect(ves_tally_finding(&pair) == VES_FINDING_NONE);
}

/* A method that gives up early is billed the budget that it was given: else it looked cheap. */
Test(suite_tally, who_fails_pays, .init = fill)
{
    ves_tally t;
    outcome[3].failed = true; /* the quick method's run that never gets there */
    outcome[3].spent = 20;
    cr_assert(ves_tally_init(&input, &t));
    near(t.score[0].ert[2].value, (20 + 21 + 22 + 100) / 3.0, "ert of the last");
    ves_tally_destroy(&t);
    for (int k = 0; k < PROBLEMS * RUNS; k++) outcome[PROBLEMS * RUNS + k].failed = true;
    cr_assert(ves_tally_init(&input, &t));
    cr_expect(isnan(t.pair[1].p) && ves_tally_finding(&t.pair[1]) == VES_FINDING_NONE,
              "none to compare with");
    ves_tally_destroy(&t);
}

/* Six problems, the first method a little better on all: 2/2^6. */
Test(suite_tally, problems_are_what_others_are_inferred_from)
{
    enum { MANY = 6 };
    static ves_suite_problem problem[MANY];
    static ves_step step[2][3];
    static ves_outcome run[2 * MANY * 2];
    double known[MANY] = {0};
    int dimension[MANY];
    ves_suite many = suite;
    many.problems = MANY, many.problem = problem, many.seeds = 2;
    for (int e = 0; e < 2; e++) step[e][0] = (ves_step){10 + e, 0, 0};
    for (int k = 0; k < 2 * MANY * 2; k++)
        run[k] = (ves_outcome){.done = true,
                               .any = true,
                               .budget = 100,
                               .spent = 20,
                               .evaluations = 20,
                               .steps = 1,
                               .step = step[k / (MANY * 2)]};
    for (int p = 0; p < MANY; p++) problem[p].name = "a", dimension[p] = 2;
    const ves_tally_input in = {.suite = &many, .outcome = run, .optimum = known, .n = dimension};
    ves_tally t;
    cr_assert(ves_tally_init(&in, &t));
    near(t.pair[1].by_problem, 2.0 / 64, "by problem");
    near(t.pair[1].p, 2.0 / 4096, "by run");
    ves_tally_destroy(&t);
}

/* Run 0 of the quick method has used up what its constraint allows: 7.0005 at 0.9 of it. */
Test(suite_tally, what_the_tolerance_is_worth_is_no_reference, .init = fill)
{
    ves_tally t;
    ves_tally_input with = input;
    const double polished[PROBLEMS] = {NAN, 7.0007}, lost[PROBLEMS] = {NAN, 7.2};
    with.polished = polished;
    for (int k = 0; k < RUNS; k++) outcome[RUNS + k].violation = 0.9;
    cr_assert(ves_tally_init(&with, &t));
    near(t.reference[1].value, 7.0007, "polished");
    cr_expect(t.reference[1].polished && t.reference[1].method == 0);
    ves_tally_destroy(&t);
    outcome[RUNS + 2].violation = 1e-4;
    cr_assert(ves_tally_init(&with, &t));
    near(t.reference[1].value, 7.0005, "a run that met its constraints is taken as it is");
    cr_expect(t.reference[1].seed == 2);
    ves_tally_destroy(&t);
    outcome[RUNS + 2].violation = 0.9;
    with.polished = lost;
    cr_assert(ves_tally_init(&with, &t));
    near(t.reference[1].value, 7.0005, "a polish that went astray");
    cr_expect(t.reference[1].polished == false);
    ves_tally_destroy(&t);
}

/* 0.0005 below what is called the least value is clear, 0.0005 with a constraint at its limit is not. */
Test(suite_tally, a_known_optimum_may_be_wrong, .init = fill)
{
    ves_tally t;
    ves_suite fine = suite;
    ves_tally_input with = input;
    const double wrong[PROBLEMS] = {0.003, NAN};
    fine.target[2] = 1e-4;
    with.suite = &fine;
    with.optimum = wrong;
    cr_assert(ves_tally_init(&with, &t));
    near(t.reference[0].below, 0.0005, "below");
    ves_tally_destroy(&t);
    for (int k = 0; k < RUNS; k++) outcome[k].violation = 0.9;
    cr_assert(ves_tally_init(&with, &t));
    cr_expect(isnan(t.reference[0].below));
    ves_tally_destroy(&t);
    cr_assert(ves_tally_init(&input, &t));
    cr_expect(isnan(t.reference[0].below));
    ves_tally_destroy(&t);
}

Test(suite_tally, what_is_not_done_does_not_count, .init = fill)
{
    ves_tally t;
    for (int k = 1; k < METHODS * PROBLEMS * RUNS; k++) outcome[k].done = false;
    cr_assert(ves_tally_init(&input, &t));
    cr_expect(t.score[0].runs == 1 && t.score[0].hits[2] == 1 && t.score[2].runs == 0);
    cr_expect(isnan(t.score[2].share[0].value) && isnan(t.pair[1].p) && isnan(t.reference[1].value));
    cr_expect(t.score[1].runs == 0 && t.total[1].runs == 0);
    ves_tally_destroy(&t);
}

Test(suite_tally, profiles, .init = fill)
{
    ves_tally t;
    double x[PROBLEMS * RUNS * VES_PROFILE_TARGETS + 2], y[PROBLEMS * RUNS * VES_PROFILE_TARGETS + 2];
    cr_assert(ves_tally_init(&input, &t));
    /* 13 targets from 1e-1 to 1e-3: 0.05 is below two of them (1e-1, 6.8e-2) where the reference is 0, and
     * 0.0495 below seven (down to 1e-2) where it is 7.0005; 0.0005 is below all. Each first at 10 + k over 2
     * variables, the rest at 20 + k but for run 3. */
    int count = ves_profile_ecdf(&input, &t, 0, x, y);
    cr_assert(count == 7, "got %d", count);
    near(x[0], 5, "first");
    near(y[0], (2 + 7) / 104.0, "the first of each problem");
    near(x[6], 11, "last");
    near(y[6], (2 * 3 * 13 + 2 + 7) / 104.0, "all there is");
    /* f_0 = 10, f_L = 0.0005 (run 3: 0.005): tau 1e-2 asks for 0.1005 and 0.10495 */
    count = ves_profile_data(&input, &t, 0, 1e-2, x, y);
    cr_assert(count == 4, "got %d", count);
    near(x[0], 10 / 3.0, "n + 1");
    near(y[3], 1, "all");
    count = ves_profile_data(&input, &t, 1, 1e-2, x, y);
    cr_assert(count == 1, "got %d", count);
    near(x[0], 80 / 3.0, "slow");
    near(y[0], 0.25, "one run in four");
    ves_profile_band band;
    cr_assert(ves_profile_convergence(&input, &t, 0, 0, 1e-10, &band));
    near(band.x[0], 1, "from 1");
    near(band.x[VES_PROFILE_POINTS - 1], 100, "to the budget");
    near(band.y[0], 10, "begins");
    near(band.y[VES_PROFILE_POINTS - 1], 0.0005, "ends");
    near(band.high[VES_PROFILE_POINTS - 1], 0.0005 + 0.25 * (0.05 - 0.0005), "upper quartile");
    ves_tally_destroy(&t);
}

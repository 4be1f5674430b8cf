/* The annealer's slots: the book's loop to the bit, schedules, constraint handlings, pauses, the health report, and
 * the same bytes for any number of threads with every choice. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "search/anneal.h"
#include "search_problems.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

static ves_status rastrigin(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    const given *problem = data;
    (void)worker;
    double *g = gradient_of(ask, v);
    v->value = 0;
    for (int i = 0; i < problem->n; i++) {
        double d = ask->x[i] - 0.7 + 0.31 * i;
        v->value += d * d - 10 * cos(2 * PI * d) + 10;
        if (g) g[i] = 2 * d + 20 * PI * sin(2 * PI * d);
    }
    return VES_OK;
}

static given problem_of(ves_status (*evaluate)(void *, int, const ves_ask *, ves_verdict *), int n,
                        double size)
{
    given g = {.evaluate = evaluate, .n = n};
    for (int i = 0; i < n; i++) g.lower[i] = -0.9 * size, g.upper[i] = size, g.start[i] = 0.4 * size;
    return g;
}

/* ---- the book's loop ---- */

typedef struct path {
    long count;
    double x[4000][3];
    bool accepted[4000];
} path;

static void walk(void *data, const ves_record *record)
{
    path *p = data;
    if (isnan(record->temperature) || p->count == 4000) return;
    memcpy(p->x[p->count], record->x, sizeof p->x[0]);
    p->accepted[p->count++] = record->accepted;
}

/* [Ugail 2011, 7.4.1], with the crude penalty of 7.4.2, as written there: one loop in the other. */
static void book(const given *g, double c0, double s, long trials, double step, double penalty, path *p)
{
    double u[3], v[3], x[3], constraint[1], r[2], f = NAN;
    for (int i = 0; i < 3; i++) u[i] = (g->start[i] - g->lower[i]) / (g->upper[i] - g->lower[i]);
    for (long k = -1; k < p->count; k++) {
        ves_random random = {.seed = 1, .step = (uint64_t)k};
        ves_random_pair(&random, r);
        double c = c0 * exp((s - 1) * (double)(k / trials));
        for (int i = 0; i < 3; i++) v[i] = u[i];
        if (k >= 0) ves_random_uniforms(&random, 3, v);
        for (int i = 0; i < 3 && k >= 0; i++) v[i] = ves_point_reflect(u[i] + step * (2 * v[i] - 1));
        for (int i = 0; i < 3; i++) x[i] = g->lower[i] + v[i] * (g->upper[i] - g->lower[i]);
        ves_verdict verdict = {.constraint = constraint};
        g->evaluate(g->data, 0, &(ves_ask){.x = x}, &verdict);
        double next = verdict.value + (g->m && constraint[0] > 1e-6 ? penalty : 0), df = next - f;
        bool accept = k < 0 || df <= 0 || exp(-df / c) > r[1];
        if (accept) memcpy(u, v, sizeof u), f = next;
        if (k < 0) continue;
        double apart = 0; /* rounding: there products are merged into sums */
        for (int i = 0; i < 3; i++) apart = fmax(apart, fabs(x[i] - p->x[k][i]));
        cr_assert(apart < 1e-12 && accept == p->accepted[k], "trial %ld: %g apart", k, apart);
    }
}

static ves_status fenced(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    rastrigin(data, worker, ask, v);
    v->constraint[0] = ask->x[0] + ask->x[1] - 1;
    return VES_OK;
}

Test(search_slots, book_is_the_loop_of_the_book)
{
    for (int m = 0; m < 2; m++) {
        given g = problem_of(m ? fenced : rastrigin, 3, 5);
        path p = {0};
        g.data = &g, g.m = m;
        ves_search_hooks hooks = {.record = walk, .data = &p};
        ves_search_options o = only_anneal(4000);
        ves_anneal *a = &o.stage[0].anneal;
        a->as = "book", a->c0 = 20, a->s = 0.9, a->step = 0.07, a->weight = 1000;
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, &hooks, &r), VES_OK));
        const ves_annealing_report *report = &r->annealing[0];
        cr_expect(strcmp(report->proposal, "fixed") == 0 && !strcmp(report->schedule, "book") &&
                  !strcmp(report->population, "chain") && !strcmp(report->constraints, "crude") &&
                  !strcmp(report->polish, "none") && report->chains == 1 && report->legs == 1);
        cr_assert(r->temperatures > 40 && p.count > 1500, "%d temperatures, %ld trials", r->temperatures,
                  p.count);
        book(&g, 20, 0.9, r->temperature[0].trials, 0.07, 1000, &p);
        ves_search_result_destroy(r);
    }
}

/* ---- schedules ---- */

static ves_cooling cooling_of(ves_anneal *options, double c0, int n, long trials)
{
    if (options->c_end == 0) options->c_end = 1e-4;
    return (ves_cooling){.options = options,
                         .n = n,
                         .chains = 1,
                         .c0 = c0,
                         .c_end = options->c_end * c0,
                         .whole = trials,
                         .left = trials};
}

Test(search_slots, schedule_book_is_equation_7_3)
{
    const double s[] = {0, 0.3, 0.9, 0.999};
    const long budget[] = {1, 7, 100, 5000, 1000000};
    for (int k = 0; k < 4; k++)
        for (int b = 0; b < 5; b++) {
            ves_anneal options = {.s = s[k]};
            ves_cooling c = cooling_of(&options, 2.5, 9, budget[b]);
            cr_assert(ves_schedule_book.begin(&c));
            cr_assert(c.trials >= 1 && c.temperatures * c.trials <= budget[b], "s %g, budget %ld", s[k],
                      budget[b]);
            cr_assert(c.s > 0 && c.s < 1);
            if (s[k] > 0) cr_assert(c.s == s[k]);
            double last = 0;
            long m = 0, spent = 0;
            do {
                double want = 2.5 * exp((c.s - 1) * m++);
                cr_assert(fabs(c.c - want) <= 1e-15 * want); /* rounding */
                last = c.c;
                spent += c.trials;
            } while (ves_schedule_book.next(&c, &(ves_temperature){0}));
            cr_assert(spent <= budget[b]);
            /* rounding of the exponent: 5e-14 was seen */
            if (k == 0 && budget[b] >= 100)
                cr_expect(c.cold && fabs(last / c.c_end - 1) < 1e-12, "ends at %g, want %g", last, c.c_end);
            if (k == 2 && budget[b] >= 5000) cr_expect(c.cold && last <= c.c_end, "s 0.9 ends at %g", last);
            c.leg++, c.left -= spent;
            cr_expect(ves_schedule_book.begin(&c) == false);
        }
}

/* All legs of a schedule: how many trials each takes; never more than there are. */
static int legs_of(const ves_schedule *schedule, ves_cooling *c, long length[], bool fresh[])
{
    int legs = 0;
    for (; legs < 40 && schedule->begin(c); legs++, c->leg++) {
        length[legs] = 0;
        fresh[legs] = c->fresh;
        do {
            length[legs] += c->trials;
        } while (schedule->next(c, &(ves_temperature){.c = c->c, .trials = 100, .accepted = 40}));
        c->left -= length[legs];
        cr_assert(c->left >= 0, "%s: leg %d", schedule->name, legs);
    }
    return legs;
}

Test(search_slots, legs_double_within_the_budget)
{
    ves_anneal options = {0};
    long length[40];
    bool fresh[40];
    ves_cooling c = cooling_of(&options, 1, 5, 150000);
    cr_assert(eq(int, legs_of(&ves_schedule_budget, &c, length, fresh), 8));
    for (int k = 0; k < 8; k++)
        cr_expect(fabs(length[k] - 150000.0 / 255 * (1 << k)) < 250, "leg %d: %ld", k, length[k]);
    c = cooling_of(&options, 1, 40, 150000); /* fifty trials for each variable */
    cr_assert(eq(int, legs_of(&ves_schedule_budget, &c, length, fresh), 6));
    c = cooling_of(&options, 1, 5, 5000);
    cr_assert(eq(int, legs_of(&ves_schedule_budget, &c, length, fresh), 4));
    for (int k = 0; k < 4; k++) {
        cr_expect(fabs(length[k] - 5000.0 / 15 * (1 << k)) < 20, "leg %d: %ld", k, length[k]);
        cr_expect(fresh[k] == (k > 0));
    }
    c = cooling_of(&options, 1, 5, 400); /* too short for more than one */
    cr_assert(eq(int, legs_of(&ves_schedule_budget, &c, length, fresh), 1));
    cr_expect(length[0] > 380);
}

/* Six legs of one length, all but the first from where the heat capacity was largest. */
Test(search_slots, reheating_goes_back_to_the_peak)
{
    ves_anneal options = {0};
    long length[40];
    bool fresh[40];
    ves_cooling c = cooling_of(&options, 1, 5, 60000);
    cr_assert(ves_schedule_reheat.begin(&c));
    cr_expect(c.from == 1);
    c.peak = 0.02;
    int legs = legs_of(&ves_schedule_reheat, &c, length, fresh);
    cr_expect(legs >= 6, "%d legs", legs);
    for (int k = 0; k < 6; k++)
        cr_expect(labs(length[k] - 10000) < 250 && fresh[k] == false, "leg %d: %ld", k, length[k]);
    cr_expect(c.from == 0.02, "from %g", c.from);
}

/* The acceptance is 0.44 between a fifth and two thirds of the way, and goes to nothing in the end. */
Test(search_slots, lam_keeps_the_acceptance)
{
    const char *const proposal[] = {"heavy", "fixed", "mixture"};
    for (int p = 0; p < 3; p++) {
        given g = problem_of(rastrigin, 4, 5);
        g.data = &g;
        ves_search_options o = only_anneal(60000);
        ves_anneal *a = &o.stage[0].anneal;
        a->schedule = "lam", a->proposal = proposal[p], a->step = 0.1;
        ves_search_result *r;
        cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
        double trials = 0, accepted = 0, late = 0, late_accepted = 0;
        for (int k = 0; k < r->temperatures; k++) {
            double at = (double)k / r->temperatures;
            const ves_temperature *t = &r->temperature[k];
            if (at > 0.2 && at < 0.65) trials += t->trials, accepted += t->accepted;
            if (at > 0.95) late += t->trials, late_accepted += t->accepted;
        }
        cr_expect(fabs(accepted / trials - 0.44) < 0.01, "%s: %g", proposal[p], accepted / trials);
        /* 0.44 / 440 to 0.44 / 185 is wanted; steps that adapt or are too long for the bottom keep it higher */
        if (p == 0) cr_expect(late_accepted / late < 0.01, "in the end: %g", late_accepted / late);
        cr_expect(r->annealing[0].health != VES_HEALTH_SHORT && r->ending == VES_ENDED_DONE, "%s", r->stop);
        ves_search_result_destroy(r);
    }
}

/* ---- constraint handlings ---- */

/* An evaluator that stops at the cutoff changes no decision: what it cut would have been rejected. */
typedef struct cutting {
    bool cuts;
    long cut;
} cutting;

static ves_status cut_disk(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    cutting *c = data;
    disk(NULL, worker, ask, v);
    double excess = v->constraint[0] > 0 ? v->constraint[0] : 0;
    if (excess <= ask->cutoff || !c->cuts) return VES_OK;
    c->cut++;
    return VES_CUT;
}

static const char *constraint_at(int k)
{
    ves_choice choice;
    ves_search_choice(VES_SLOT_CONSTRAINTS, k, &choice);
    return choice.name;
}

enum { HANDLINGS = 4 };

Test(search_slots, a_cut_candidate_would_have_been_rejected)
{
    cr_assert(constraint_at(HANDLINGS) == NULL && constraint_at(HANDLINGS - 1) != NULL);
    for (int h = 0; h < HANDLINGS; h++) {
        cutting c[2] = {{false, 0}, {true, 0}};
        double value[2], x[2];
        for (int k = 0; k < 2; k++) {
            given g = problem_disk;
            g.evaluate = cut_disk;
            g.data = &c[k];
            ves_search_options o = only_anneal(8000);
            o.stage[0].anneal.constraints = constraint_at(h);
            ves_search_result *r;
            cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
            value[k] = r->value;
            x[k] = r->x[0];
            cr_expect(eq(int, (int)r->failed, 0)); /* cut is not failed */
            ves_search_result_destroy(r);
        }
        cr_expect(c[1].cut > 100, "%s: only %ld were cut", constraint_at(h), c[1].cut);
        cr_expect(value[0] == value[1] && x[0] == x[1], "%s: %.17g and %.17g", constraint_at(h), value[0],
                  value[1]);
    }
}

/* A cutoff is never below a violation whose energy is still low enough, whatever the multipliers: for the largest
 * violation of two constraints, an equation and an inequality. */
Test(search_slots, cutoffs_are_safe)
{
    const bool equality[] = {true, false};
    ves_random random = {.seed = 7};
    for (int h = 0; h < HANDLINGS; h++) {
        const ves_constraint *handling = ves_slots_constraint(constraint_at(h));
        long low = 0;
        for (int k = 0; k < 20000; k++) {
            double l[2], w[2], g[2], f[3];
            random.step++, random.draw = 0;
            for (int j = 0; j < 2; j++) {
                l[j] = (j ? 1 : 2) * ves_random_uniform(&random) - (j ? 0 : 1);
                w[j] = exp(3 * ves_random_normal(&random));
                g[j] = ves_random_normal(&random);
            }
            for (int j = 0; j < 3; j++) f[j] = ves_random_normal(&random);
            const ves_burden b = {.m = 2,
                                  .equality = equality,
                                  .tolerance = 1e-6,
                                  .weight = w[0],
                                  .worst = f[2],
                                  .multiplier = l,
                                  .stiffness = w};
            ves_verdict v = {
                .value = f[0] + fabs(f[1]), .violation = fmax(fabs(g[0]), fmax(g[1], 0)), .constraint = g};
            double energy = handling->energy(&b, &v), most = f[2] + 3,
                   cutoff = handling->cutoff(&b, most, f[0]);
            if (energy <= most) low++;
            if (energy <= most) cr_assert(v.violation <= cutoff * (1 + 1e-12), "%s", handling->name);
        }
        cr_expect(low > 1000, "%s: %ld", handling->name, low);
    }
}

/* g06 with one constraint an equation: thin, and with multipliers of a thousand. Without any polish. */
Test(search_slots, lagrangian_solves_what_crude_penalties_do_not)
{
    double worst[2];
    for (int h = 0; h < 2; h++) {
        worst[h] = 0;
        for (uint64_t seed = 1; seed <= 5; seed++) {
            ves_search_options o = only_anneal(40000);
            o.stage[0].anneal.constraints = h ? "lagrangian" : "crude";
            o.seed = seed;
            ves_search_result *r;
            cr_assert(eq(int, run(&problem_can, &o, NULL, &r), VES_OK));
            double gap = fabs(r->value + PI / sqrt(2)) + r->violation;
            if (gap > worst[h]) worst[h] = gap;
            ves_search_result_destroy(r);
        }
    }
    cr_expect(worst[0] > 0.05, "crude: %g", worst[0]); /* it cannot hold an equation */
    cr_expect(worst[1] < 1e-3, "lagrangian: %g", worst[1]);
}

/* ---- all choices together ---- */

static unsigned long long hash(unsigned long long h, const void *bytes, size_t size)
{
    for (const unsigned char *b = bytes; size--; b++) h = (h ^ *b) * 1099511628211ULL;
    return h;
}

static unsigned long long outcome(const given *g, const ves_anneal *anneal, int workers)
{
    given problem = *g;
    ves_search_options o = only_anneal(3000);
    ves_search_result *r;
    problem.workers = workers;
    o.stage[0].anneal = *anneal;
    o.stage[0].anneal.evaluations = 3000;
    cr_assert(eq(int, run(&problem, &o, NULL, &r), VES_OK), "%s %s %s %s %s", anneal->proposal,
              anneal->schedule, anneal->population, anneal->constraints, anneal->polish);
    cr_expect(r->evaluations <= r->budget && r->evaluations > 1000, "%s %s %s: %ld of %ld", anneal->proposal,
              anneal->schedule, anneal->population, r->evaluations, r->budget);
    cr_expect(r->annealings == 1 && r->annealing[0].health != VES_HEALTH_STOPPED);
    unsigned long long h = hash(14695981039346656037ULL, r->x, sizeof(double) * (size_t)g->n);
    h = hash(h, &r->value, sizeof r->value);
    h = hash(h, &r->evaluations, sizeof r->evaluations);
    for (int k = 0; k < r->temperatures; k++) h = hash(h, &r->temperature[k].mean, sizeof(double));
    ves_search_result_destroy(r);
    return h;
}

/* Each choice of each slot with the defaults of the others, and all pairs of schedule and population: the same bytes
 * for one and two threads, within the budget. */
Test(search_slots, every_choice_gives_the_same_bytes_for_any_number_of_threads)
{
    given g = problem_disk;
    g.gradients = true;
    for (int slot = 0; slot <= VES_SLOT_PRESET; slot++) {
        ves_choice choice;
        int k = 0;
        for (; ves_search_choice((ves_slot)slot, k, &choice); k++) {
            ves_anneal a = {0};
            const char **word[] = {&a.proposal, &a.schedule, &a.population, &a.constraints, &a.polish, &a.as};
            *word[slot] = choice.name;
            cr_expect(choice.about != NULL && *choice.about);
            cr_expect(outcome(&g, &a, 1) == outcome(&g, &a, 2), "%s", choice.name);
        }
        cr_expect(k > 0 && ves_search_choice((ves_slot)slot, -1, &choice) == false);
    }
    ves_choice schedule, population;
    for (int i = 0; ves_search_choice(VES_SLOT_SCHEDULE, i, &schedule); i++)
        for (int j = 0; ves_search_choice(VES_SLOT_POPULATION, j, &population); j++) {
            ves_anneal a = {.schedule = schedule.name, .population = population.name, .polish = "stages"};
            cr_expect(outcome(&g, &a, 1) == outcome(&g, &a, 2), "%s %s", schedule.name, population.name);
        }
}

Test(search_slots, unknown_words_are_refused)
{
    given g = problem_disk;
    for (int slot = 0; slot <= VES_SLOT_PRESET + 1; slot++) {
        ves_search_options o = only_anneal(100);
        ves_anneal *a = &o.stage[0].anneal;
        const char **word[] = {&a->proposal,    &a->schedule, &a->population,
                               &a->constraints, &a->polish,   &a->as};
        if (slot <= VES_SLOT_PRESET)
            *word[slot] = "paperclips";
        else
            a->population = "chain", a->chains = 2;
        ves_search_result *r;
        cr_expect(eq(int, run(&g, &o, NULL, &r), VES_RANGE));
    }
}

/* ---- pauses ---- */

/* An annealing that goes on by a few evaluations at a time ends where one in a single go does. */
Test(search_slots, a_paused_annealing_goes_the_same_way)
{
    double x[3][2], value[3];
    long spent[3], pieces[3] = {0};
    const long piece[] = {1000000, 1, 700};
    for (int k = 0; k < 3; k++) {
        const ves_search_problem problem = {.n = 2,
                                            .m = 1,
                                            .lower = problem_disk.lower,
                                            .upper = problem_disk.upper,
                                            .start = problem_disk.start,
                                            .evaluate = disk};
        ves_search_options o = only_anneal(5000);
        ves_session session;
        ves_annealing a;
        cr_assert(eq(int, ves_session_init(&session, &problem, &o, NULL), VES_OK));
        cr_assert(eq(int, ves_search_begin(&session), VES_OK));
        cr_assert(
            ves_annealing_create(&a, &session, &session.stage[0].anneal, 5000, ves_session_stream(0, 3)));
        for (; ves_annealing_done(&a) == false; pieces[k]++) {
            long before = a.spent;
            cr_assert(eq(int, ves_annealing_advance(&a, piece[k]), VES_OK));
            cr_expect(a.spent > before || ves_annealing_done(&a));
        }
        cr_assert(eq(int, ves_annealing_close(&a), VES_OK));
        memcpy(x[k], a.champion[0].point.x, sizeof x[k]);
        value[k] = a.champion[0].point.verdict.value;
        spent[k] = a.spent;
        cr_expect(spent[k] <= 5000 && spent[k] > 4000, "%ld", spent[k]);
        ves_annealing_destroy(&a);
        ves_session_destroy(&session);
        cr_expect(memcmp(x[k], x[0], sizeof x[0]) == 0 && value[k] == value[0] && spent[k] == spent[0],
                  "%g and %g", value[k], value[0]);
    }
    cr_expect(pieces[0] == 1 && pieces[1] > 100 && pieces[2] >= 4 && pieces[2] < 12, "%ld, %ld, %ld",
              pieces[0], pieces[1], pieces[2]);
}

/* ---- health ---- */

static ves_health health_of(const given *g, const ves_anneal *anneal, const char *word)
{
    given problem = *g;
    ves_search_options o = {.stages = 1, .seed = 3};
    ves_search_result *r;
    problem.data = &problem;
    o.stage[0] = (ves_stage){.kind = VES_STAGE_ANNEAL, .anneal = *anneal};
    cr_assert(eq(int, run(&problem, &o, NULL, &r), VES_OK));
    cr_assert(eq(int, r->annealings, 1));
    ves_annealing_report report = r->annealing[0];
    cr_expect(strstr(report.sentence, word) != NULL, "%s", report.sentence);
    long trials = 0, accepted = 0, all = 0, all_accepted = 0;
    for (int k = 0; k < report.moves; k++)
        trials += report.count[k].trials, accepted += report.count[k].accepted;
    for (int k = 0; k < r->temperatures; k++) {
        const ves_temperature *t = &r->temperature[k];
        long here = 0;
        all += t->trials, all_accepted += t->accepted;
        for (int j = 0; j < VES_MOVES; j++) here += t->move[j].trials;
        cr_assert(here == t->trials);
    }
    cr_expect(trials == all && accepted == all_accepted && all > 0);
    cr_expect(report.c0 == r->temperature[0].c && report.c == r->temperature[r->temperatures - 1].c);
    ves_search_result_destroy(r);
    return report.health;
}

Test(search_slots, health_tells_what_is_wrong)
{
    given easy = problem_of(quadratic, 3, 5), hard = problem_of(rastrigin, 6, 5);
    ves_anneal slow = {.evaluations = 40000}, fast = {.evaluations = 1500, .schedule = "book"},
               shorter = {.evaluations = 400, .s = 0.999}, fixed = {.evaluations = 4000, .schedule = "fixed"};
    cr_expect(eq(int, health_of(&easy, &slow, "frozen"), VES_HEALTH_FROZEN));
    cr_expect(eq(int, health_of(&hard, &fast, "not equilibrated"), VES_HEALTH_UNEVEN));
    cr_expect(eq(int, health_of(&easy, &shorter, "too short"), VES_HEALTH_SHORT));
    cr_expect(eq(int, health_of(&easy, &fixed, "sampled"), VES_HEALTH_SAMPLED));
}

/* In a quadratic well the mean energy is n T / 2 all the way down: so it is frozen (a hundredth of the fall is left) a
 * hundred times below c0, and the heat capacity is n / 2 everywhere. */
Test(search_slots, freezing_is_where_the_mean_energy_stops_falling)
{
    given g = problem_of(quadratic, 3, 100); /* so wide that it has no walls at c0 */
    for (int i = 0; i < 3; i++) g.start[i] = 1.3;
    g.data = &g;
    ves_search_options o = only_anneal(200000);
    ves_anneal *a = &o.stage[0].anneal;
    a->schedule = "book", a->c0 = 10;
    ves_search_result *r;
    cr_assert(eq(int, run(&g, &o, NULL, &r), VES_OK));
    const ves_annealing_report *report = &r->annealing[0];
    double ratio = report->freezing / report->c0;
    cr_expect(ratio > 0.001 && ratio < 0.02, "frozen at %g of c0",
              ratio); /* lower: of so few trials one strays */
    int fine = 0;
    for (int k = 0; k < r->temperatures; k++) {
        const ves_temperature *t = &r->temperature[k];
        fine += fabs((t->mean - 7) / (1.5 * t->c) - 1) < 0.5; /* few trials at each temperature */
    }
    cr_expect(fine > 0.8 * r->temperatures, "%d of %d", fine, r->temperatures);
    ves_search_result_destroy(r);
}

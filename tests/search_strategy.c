#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#include "suite/instance.h"
#include "vesica/search.h"

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

/* The strategies of a portfolio, alone and together, on landscapes where each has to be good for something. */

enum { MOST = 24 };

typedef struct trial {
    ves_instance instance;
    double room[2 * MOST];
    long asked, gradients, hit; /* hit: evaluations when the optimum was reached within 1e-6 */
} trial;

static ves_status evaluate(void *data, int worker, const ves_ask *ask, ves_verdict *v)
{
    (void)worker;
    trial *t = data;
    bool slopes = ask->want & VES_WANT_GRADIENT;
    ves_status status = ves_instance_eval(&t->instance, ask->x, slopes, v, t->room);
    t->asked++;
    t->gradients += slopes;
    if (!t->hit && v->value - t->instance.optimum <= 1e-6) t->hit = t->asked;
    return status;
}

static bool enough(void *data)
{
    return ((trial *)data)->hit;
}

typedef struct task {
    const char *name;
    bool turned;
    int n;
    const char *only; /* strategy; NULL: all */
    bool gradients;
    long budget;
} task;

/* Evaluations until the optimum; 0: not within the budget. */
static long search(const task *k, uint64_t seed)
{
    ves_arena arena = {0};
    trial t = {0};
    double lower[MOST] = {0}, upper[MOST], start[MOST];
    const ves_landscape *landscape = ves_landscape_find(k->name);
    cr_assert(ves_instance_init(&arena, landscape, k->n, k->turned, 1, (int)seed, &t.instance) == VES_OK);
    for (int i = 0; i < k->n; i++) upper[i] = 1;
    ves_instance_start(seed, 0, k->n, start);
    const ves_search_problem problem = {.n = k->n,
                                        .lower = lower,
                                        .upper = upper,
                                        .start = start,
                                        .gradients = k->gradients,
                                        .evaluate = evaluate,
                                        .data = &t};
    ves_search_options o = ves_search_options_default();
    o.seed = seed;
    o.stages = 1;
    o.stage[0] = (ves_stage){.kind = VES_STAGE_AUTO, .automatic = {.only = k->only}};
    o.evaluations = k->budget;
    const ves_search_hooks hooks = {.stopped = enough, .data = &t};
    ves_search_result *r;
    ves_status status = ves_search_run(&problem, &o, &hooks, &r);
    cr_assert(status == VES_OK || status == VES_INTERRUPTED, "%s: status %d", k->name, status);
    cr_expect(r->evaluations <= k->budget && r->evaluations == t.asked && r->gradients == t.gradients,
              "%ld of %ld", r->evaluations, k->budget);
    ves_search_result_destroy(r);
    ves_arena_destroy(&arena);
    return t.hit;
}

/* Budgets: some times what it takes in the middle; each of five seeds must do. */
Test(search_strategy, each_solves_what_it_is_for)
{
    static const task table[] = {
        {"rastrigin", false, 10, "lines", false, 20000}, {"rastrigin", false, 10, "lines", true, 20000},
        {"rastrigin", true, 5, "hop", true, 20000},      {"rastrigin", true, 5, "hop", false, 60000},
        {"rosenbrock", false, 5, "hop", true, 3000},     {"ellipsoid", true, 8, "cma", false, 20000},
        {"levy", false, 5, "cma", false, 40000},         {"griewank", false, 5, NULL, true, 60000},
        {"rastrigin", true, 5, NULL, false, 60000},      {"rastrigin", false, 10, NULL, true, 30000},
        {"ellipsoid", true, 8, NULL, true, 3000},
    };
    for (size_t k = 0; k < sizeof table / sizeof *table; k++)
        for (uint64_t seed = 1; seed <= 5; seed++)
            cr_expect(search(&table[k], seed) > 0,
                      "%s%s in %d variables by %s, gradients %d, seed %lu: not within %ld",
                      table[k].turned ? "turned " : "", table[k].name, table[k].n,
                      table[k].only ? table[k].only : "all", table[k].gradients, seed, table[k].budget);
}

Test(search_strategy, budgets_are_kept_to_the_last_evaluation)
{
    static const char *const only[] = {"hop", "lines", "cma", NULL};
    for (int k = 0; k < 4; k++)
        for (long budget = 1; budget < 3000; budget += 1 + budget / 3)
            for (int gradients = 0; gradients < 2; gradients++)
                search(&(task){"rastrigin", true, 7, only[k], gradients, budget}, 1);
}

/* The price of a gradient is believed: dearer than all differences together, none is asked for. */
Test(search_strategy, gradients_have_a_price)
{
    const ves_landscape *landscape = ves_landscape_find("rosenbrock");
    const double prices[] = {0, 3, 1, 6, 6.1, 0.5, -1, NAN};
    long gradients[8] = {0};
    for (int k = 0; k < 8; k++) {
        ves_arena arena = {0};
        trial t = {0};
        cr_assert(ves_instance_init(&arena, landscape, 5, false, 1, 0, &t.instance) == VES_OK);
        const double lower[5] = {0}, upper[5] = {1, 1, 1, 1, 1}, start[5] = {0.5, 0.5, 0.5, 0.5, 0.5};
        const ves_search_problem problem = {.n = 5,
                                            .lower = lower,
                                            .upper = upper,
                                            .start = start,
                                            .gradients = true,
                                            .evaluate = evaluate,
                                            .data = &t};
        ves_search_options o = ves_search_options_default();
        o.evaluations = 3000;
        o.gradient = prices[k];
        ves_search_result *r = NULL;
        ves_status status = ves_search_run(&problem, &o, NULL, &r);
        cr_expect(status == (k < 5 ? VES_OK : VES_RANGE), "price %g: status %d", prices[k], status);
        if (status == VES_OK) gradients[k] = r->gradients;
        ves_search_result_destroy(r);
        ves_arena_destroy(&arena);
    }
    cr_expect(gradients[0] == gradients[1] && gradients[0] > 0, "3 is what they usually cost");
    cr_expect(gradients[3] > 0 && gradients[4] == 0,
              "6 evaluations make a difference for each of 5 variables");
}

Test(search_strategy, an_unknown_one_is_refused)
{
    const double lower = 0, upper = 1, start = 0.5;
    const ves_search_problem problem = {
        .n = 1, .lower = &lower, .upper = &upper, .start = &start, .evaluate = evaluate};
    ves_search_options o = ves_search_options_default();
    o.stages = 1;
    o.stage[0] = (ves_stage){.kind = VES_STAGE_AUTO, .automatic = {.only = "luck"}};
    ves_search_result *r;
    cr_expect(ves_search_run(&problem, &o, NULL, &r) == VES_RANGE && r == NULL);
}

/* Own time of an annealing step: a search of 20 variables whose callback does next to nothing, for each proposal and
 * population, beside two of NLopt's global searches. Prints JSON Lines: CPU time of this thread for each evaluation,
 * and the ratio to the callback alone. */
#include <math.h>
#include <nlopt.h>
#include <stdio.h>
#include <time.h>

#include "vesica/search.h"

enum { N = 20, EVALUATIONS = 1000000 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void row(const char *name, double seconds, double base)
{
    printf("{\"step\":\"%s\",\"variables\":%d,\"ns\":%.0f,\"ratio\":%.1f}\n", name, N, 1e9 * seconds,
           seconds / base);
}

/* The first variable alone, so that it is no constant. */
static ves_status nothing(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    (void)data, (void)worker;
    verdict->value = ask->x[0] * ask->x[0];
    return VES_OK;
}

static double nothing_nlopt(unsigned n, const double *x, double *gradient, void *data)
{
    (void)n, (void)gradient, (void)data;
    return x[0] * x[0];
}

static void ours(const char *proposal, const char *population, double base)
{
    double lower[N], upper[N], start[N];
    for (int i = 0; i < N; i++) lower[i] = -1, upper[i] = 1.5, start[i] = 0.3;
    const ves_search_problem problem = {
        .n = N, .lower = lower, .upper = upper, .start = start, .evaluate = nothing};
    ves_search_options options = ves_search_options_default();
    options.stages = 1;
    options.stage[0] = (ves_stage){.kind = VES_STAGE_ANNEAL};
    options.stage[0].anneal = (ves_anneal){
        .proposal = proposal, .population = population, .schedule = "fixed", .evaluations = EVALUATIONS};
    ves_search_result *result;
    double t = now();
    if (ves_search_run(&problem, &options, NULL, &result) != VES_OK) return;
    t = now() - t;
    char name[64];
    snprintf(name, sizeof name, "%s, %s", proposal, population);
    row(name, t / (double)result->evaluations, base);
    ves_search_result_destroy(result);
}

static void theirs(nlopt_algorithm algorithm, const char *name, double base)
{
    double x[N], f;
    nlopt_opt opt = nlopt_create(algorithm, N);
    nlopt_set_lower_bounds1(opt, -1);
    nlopt_set_upper_bounds1(opt, 1.5);
    nlopt_set_min_objective(opt, nothing_nlopt, NULL);
    nlopt_set_maxeval(opt, EVALUATIONS / 5);
    for (int i = 0; i < N; i++) x[i] = 0.3;
    double t = now();
    nlopt_optimize(opt, x, &f);
    t = now() - t;
    row(name, t / nlopt_get_numevals(opt), base);
    nlopt_destroy(opt);
}

static double alone(void)
{
    double x[N] = {0.3}, sum = 0;
    ves_status (*volatile call)(void *, int, const ves_ask *, ves_verdict *) = nothing;
    double t = now();
    for (long k = 0; k < 20L * EVALUATIONS; k++) {
        ves_ask ask = {.x = x};
        ves_verdict verdict = {.value = 0};
        x[0] += 1e-9;
        call(NULL, 0, &ask, &verdict);
        sum += verdict.value;
    }
    t = now() - t;
    t /= sum < 0 ? 1 : 20.0 * EVALUATIONS;
    row("the callback alone", t, t);
    return t;
}

int main(void)
{
    double base = alone();
    ves_choice choice;
    for (int k = 0; ves_search_choice(VES_SLOT_PROPOSAL, k, &choice); k++) ours(choice.name, "chains", base);
    ours("mixture", "tempering", base);
    theirs(NLOPT_GN_ISRES, "NLopt ISRES", base);
    theirs(NLOPT_GN_CRS2_LM, "NLopt CRS2", base);
    return 0;
}

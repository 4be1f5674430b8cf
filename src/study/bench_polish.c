#include "study/bench_polish.h"

#include <math.h>

enum { SLOPES = 200, VALUES = 50 }; /* evaluations: with gradients; without, for each variable and one more */

static const double share = 1e-3; /* of what constraints are allowed */

static ves_status descend(const ves_search_problem *problem, long evaluations, const ves_search_hooks *hooks)
{
    ves_search_options options = ves_search_options_default();
    options.stages = 1;
    options.stage[0] = (ves_stage){.kind = VES_STAGE_POLISH};
    options.evaluations = evaluations;
    ves_search_result *result = NULL;
    ves_status status = ves_search_run(problem, &options, hooks, &result);
    ves_search_result_destroy(result);
    return status == VES_MEMORY ? status : VES_OK; /* what else fails has found nothing */
}

ves_status ves_bench_polish(ves_testbed *testbed, const ves_suite *suite, const ves_outcome *outcome,
                            bool (*stopped)(void *), void *data, double *value)
{
    ves_arena arena = {0};
    ves_pose pose;
    *value = NAN;
    ves_status status = ves_testbed_pose(testbed, 0, 0, &arena, &pose);
    ves_search_problem *p = &pose.problem;
    p->tolerance = share * (p->tolerance > 0 ? p->tolerance : VES_FEASIBLE);
    bool own = testbed->problem->kind == VES_SUITE_FILE;
    ves_meter meter = {.inner = p,
                       .budget = HUGE_VAL,
                       .cost = 1,
                       .cost_gradient = 1,
                       .inequality = own ? 0 : share * suite->inequality,
                       .equality = share * suite->equality,
                       .target = -HUGE_VAL};
    if (status == VES_OK && !ves_meter_begin(&meter)) status = VES_MEMORY;
    if (status == VES_OK) {
        const ves_search_hooks hooks = {.stopped = stopped, .data = data};
        ves_search_problem seen = ves_meter_problem(&meter, outcome->x);
        long evaluations = p->gradients ? SLOPES : VALUES * (p->n + 1);
        status = descend(&seen, (long)fmin((double)evaluations, outcome->budget), &hooks);
        if (meter.any && meter.violation <= 1) *value = meter.value;
    }
    ves_meter_end(&meter);
    ves_arena_destroy(&arena);
    return status;
}

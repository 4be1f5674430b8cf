/* Our own searches as methods: any that a `search:` block can say. */
#include <math.h>

#include "suite/instance.h"
#include "suite/trial.h"

enum { IDLE = 3, PARTS = 15 };

static bool stopped(void *data)
{
    const ves_trial *c = data;
    return c->meter->over || (c->stopped && c->stopped(c->data));
}

/* Methods that plan their whole way need to be told how long it is: what is left, or, doubling, 1/15, 2/15,
 * 4/15 and 8/15 of the budget. */
static long share(const ves_trial *c, int round)
{
    double left = floor(ves_meter_left(c->meter) / c->meter->cost);
    double part = floor(ldexp(c->meter->budget / c->meter->cost, round) / PARTS);
    bool whole = !c->method->doubling || round >= 4 || part > left;
    return (long)(whole ? left : part);
}

ves_status ves_trial_search(ves_trial *trial)
{
    ves_meter *meter = trial->meter;
    const ves_search_hooks hooks = {.stopped = stopped, .data = trial};
    for (int round = 0, idle = 0; !stopped(trial) && idle < IDLE; round++) {
        VES_TRY(ves_trial_start(trial));
        ves_search_problem problem = ves_meter_problem(meter, trial->start);
        if (trial->method->values) problem.gradients = false;
        ves_search_options options = trial->method->search;
        options.seed = ves_instance_hash("search", trial->seed + (uint64_t)round) >> 12;
        options.evaluations = share(trial, round);
        options.gradient = fmax(meter->cost_gradient / meter->cost, 1);
        if (options.evaluations < 1) break;
        long before = meter->evaluations;
        ves_search_result *result = NULL;
        ves_status status = ves_search_run(&problem, &options, &hooks, &result);
        ves_search_result_destroy(result);
        if (meter->fault) return meter->fault;
        if (status == VES_MEMORY) return status;
        if (status < VES_OK && status != VES_INTERRUPTED) {
            ves_trial_fail(trial, "the search cannot run: %s", ves_status_text(status));
            return VES_OK;
        }
        idle = meter->evaluations == before ? idle + 1 : 0;
    }
    return VES_OK;
}

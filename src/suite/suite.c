#include "suite/suite.h"

#include <math.h>

#include "suite/instance.h"

void ves_suite_destroy(ves_suite *suite)
{
    if (!suite) return;
    ves_arena_destroy(&suite->arena);
    ves_memory_free(suite);
}

double ves_suite_budget(const ves_suite *suite, int n)
{
    return floor(fmin(suite->per_dimension * n, suite->most));
}

double ves_suite_value(const ves_suite_problem *problem, double reference, double gap)
{
    double size = fabs(reference);
    if (problem->kind != VES_SUITE_FILE || size == 0) size = fmax(1, size);
    return reference + gap * size;
}

int ves_suite_runs(const ves_suite *suite)
{
    return suite->methods * suite->problems * suite->seeds;
}

ves_suite_place ves_suite_run(const ves_suite *suite, int index)
{
    int per_method = suite->problems * suite->seeds;
    return (ves_suite_place){.method = index / per_method,
                             .problem = index % per_method / suite->seeds,
                             .seed = index % suite->seeds};
}

uint64_t ves_suite_seed(const ves_suite *suite, const ves_suite_problem *problem, int seed)
{
    return ves_instance_hash(problem->name, suite->seed + ((uint64_t)seed << 40)) >> 12;
}

#include "suite/outcome.h"

#include <math.h>

void ves_outcome_clear(ves_outcome *outcome)
{
    ves_memory_free(outcome->x);
    ves_memory_free(outcome->step);
    *outcome = (ves_outcome){.done = false};
}

double ves_outcome_reach(const ves_outcome *outcome, double value)
{
    for (int k = 0; k < outcome->steps; k++)
        if (outcome->step[k].violation <= 1 && outcome->step[k].value <= value) return outcome->step[k].cost;
    return INFINITY;
}

double ves_outcome_value(const ves_outcome *outcome, double cost)
{
    double best = INFINITY;
    for (int k = 0; k < outcome->steps && outcome->step[k].cost <= cost; k++)
        if (outcome->step[k].violation <= 1) best = outcome->step[k].value;
    return best;
}

double ves_outcome_own(const ves_outcome *outcome)
{
    bool shared = outcome->cpu < outcome->wall; /* false for NAN */
    return (outcome->wall - outcome->inside) * (shared ? outcome->cpu / outcome->wall : 1);
}

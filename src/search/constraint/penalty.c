#include <math.h>

#include "search/constraint/constraint.h"

/* The exact penalty: f + weight * violation, exact once the weight is more than the sum of the multipliers. It
 * grows at each temperature while the chain's best is infeasible. */

static const double growth = 1.25;

static double energy(const ves_burden *burden, const ves_verdict *verdict)
{
    return ves_verdict_energy(verdict, burden->weight, burden->tolerance);
}

static double cutoff(const ves_burden *burden, double most, double lowest)
{
    return burden->weight > 0 ? burden->tolerance + (most - lowest) / burden->weight : HUGE_VAL;
}

static void settle(ves_burden *burden, const ves_verdict *current, bool feasible, double heat)
{
    (void)current, (void)heat;
    if (!feasible && burden->weight < burden->most) burden->weight *= growth;
}

const ves_constraint ves_constraint_penalty = {
    .name = "penalty",
    .about = "weight times the largest violation; the weight grows while the best is infeasible",
    .energy = energy,
    .cutoff = cutoff,
    .settle = settle,
};

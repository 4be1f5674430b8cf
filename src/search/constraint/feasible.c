#include <math.h>

#include "search/constraint/constraint.h"

/* Feasible first (Deb 2000): among feasible candidates f counts, among infeasible ones the violation, and any
 * feasible one is better than any infeasible one, for their energy begins at the largest f that the warm-up met or
 * a chain stood at. The weight only sets how hot a violation is. */

static double energy(const ves_burden *burden, const ves_verdict *verdict)
{
    if (verdict->violation <= burden->tolerance) return verdict->value;
    return burden->worst + burden->weight * verdict->violation;
}

static double cutoff(const ves_burden *burden, double most, double lowest)
{
    (void)lowest;
    return fmax(burden->tolerance, (most - burden->worst) / burden->weight);
}

static void settle(ves_burden *burden, const ves_verdict *current, bool feasible, double heat)
{
    (void)feasible, (void)heat;
    if (current->violation <= burden->tolerance) burden->worst = fmax(burden->worst, current->value);
}

const ves_constraint ves_constraint_feasible = {
    .name = "feasible",
    .about = "the objective counts among feasible candidates alone; others go by their violation",
    .energy = energy,
    .cutoff = cutoff,
    .settle = settle,
};

#include <math.h>

#include "search/constraint/constraint.h"

/* "A large positive number" is added to f where a constraint is violated [Ugail 2011, 7.4.2]: the same however
 * large the violation is, so that nothing leads back to what is allowed. */

static double energy(const ves_burden *burden, const ves_verdict *verdict)
{
    return verdict->value + (verdict->violation > burden->tolerance ? burden->weight : 0);
}

static double cutoff(const ves_burden *burden, double most, double lowest)
{
    return lowest + burden->weight > most ? burden->tolerance : HUGE_VAL;
}

const ves_constraint ves_constraint_crude = {
    .name = "crude",
    .about = "a large number is added to the objective: the book's",
    .energy = energy,
    .cutoff = cutoff,
};

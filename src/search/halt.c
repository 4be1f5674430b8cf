#include "search/descent.h"

/* Why a descent ended, and whether its end is one. */

bool ves_descent_spent(const ves_descent *d)
{
    return d->spent || d->used >= d->budget;
}

ves_halt ves_descent_halt(const ves_descent *d)
{
    if (ves_descent_spent(d) || d->hopeless) return VES_HALT_UNKNOWN;
    if (d->beside) return VES_HALT_EDGE;
    bool failed = d->code < 0 && d->code != NLOPT_ROUNDOFF_LIMITED;
    if (d->lost || failed) return VES_HALT_LOST;
    return d->recipe.gradient && d->session->problem->gradients ? VES_HALT_UNKNOWN : VES_HALT_REST;
}

const char *ves_descent_sentence(const ves_descent *d)
{
    if (ves_descent_spent(d)) return "the budget of evaluations is spent";
    if (d->hopeless) return "given up: it falls too slowly to come below what is known";
    if (d->lost) return d->lost;
    return d->beside ? "ended beside a candidate that cannot be measured" : ves_recipe_sentence(d->code);
}

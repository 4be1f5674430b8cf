#include <math.h>

#include "search/constraint/constraint.h"

/* The augmented Lagrangian, its multipliers l updated once a temperature from where the chain stands (Wah, Chen
 * and Wang 2007): with stiffness w
 *     equality   h = 0:   l h + w h^2 / 2,                          then l += w h;
 *     inequality g <= 0:  (max(0, l + w g)^2 - l^2) / (2 w),        then l = max(0, l + w g).
 * The state strays from a constraint by about sqrt(c / w): to be within the tolerance in the end w grows a little as
 * the temperature falls, as c^-0.2. Of twelve constrained problems, values only, no polish, one chain solves 70 %
 * of the runs to 1e-6 without it, 90 % with 0.2, 86 % with 0.3, 42 % with 0.75: what is too stiff is hard to walk in. */

static const double stiffening = 0.2;

static double one(const ves_burden *burden, const ves_verdict *verdict, int j)
{
    double l = burden->multiplier[j], w = burden->stiffness[j], g = verdict->constraint[j];
    if (burden->equality && burden->equality[j]) return g * (l + 0.5 * w * g);
    double t = l + w * g;
    return ((t > 0 ? t * t : 0) - l * l) / (2 * w);
}

static double energy(const ves_burden *burden, const ves_verdict *verdict)
{
    double sum = verdict->value;
    for (int j = 0; j < burden->m; j++) sum += one(burden, verdict, j);
    return sum;
}

/* A violation v of constraint j costs w v^2 / 2 - |l| v at least, and no other less than -l^2 / (2 w). */
static double cutoff(const ves_burden *burden, double most, double lowest)
{
    double room = most - lowest, beyond = burden->tolerance;
    for (int j = 0; j < burden->m; j++)
        room += burden->multiplier[j] * burden->multiplier[j] / (2 * burden->stiffness[j]);
    if (!(room > 0)) room = 0;
    for (int j = 0; j < burden->m; j++) {
        double l = fabs(burden->multiplier[j]), w = burden->stiffness[j];
        beyond = fmax(beyond, (l + sqrt(l * l + 2 * w * room)) / w);
    }
    return beyond;
}

static void settle(ves_burden *burden, const ves_verdict *current, bool feasible, double heat)
{
    (void)feasible;
    for (int j = 0; j < burden->m; j++) {
        double *l = &burden->multiplier[j], w = burden->stiffness[j], g = current->constraint[j];
        bool equal = burden->equality && burden->equality[j];
        double next = *l + w * g;
        if (isfinite(next)) *l = equal || next > 0 ? next : 0;
        burden->stiffness[j] *= pow(burden->heat / heat, stiffening);
    }
    burden->heat = heat;
}

const ves_constraint ves_constraint_lagrangian = {
    .name = "lagrangian",
    .about = "augmented Lagrangian; multipliers are updated at each temperature",
    .energy = energy,
    .cutoff = cutoff,
    .settle = settle,
};

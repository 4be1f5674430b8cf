#include <math.h>
#include <string.h>

#include "search/descent.h"

/* Augmented Lagrangian of Powell, Hestenes and Rockafellar, updated as by Birgin and Martinez (2008), for
 * algorithms that take no constraints of a kind:
 *     L = F + sum_eq (lambda c + r c^2 / 2) + sum_ineq (max(0, lambda + r c)^2 - lambda^2) / (2 r)
 * NLopt's own needs tolerances for its inner algorithm, or never ends, and stops where that happens to pause;
 * this one ends when the constraints hold and nothing moves.
 * test  g06, a can of given area and Rosenbrock in a disk, by every algorithm */

enum { ROUNDS = 40 };

static const double first_penalty = 10, most_penalty = 1e8, faster = 10, enough = 0.3;

/* mma and ccsa model L by diagonal quadratics, and end to the root of rounding, the worse the steeper it is:
 * what they leave, up to so many times what counts as rounding, does not fall for a penalty beyond. */
static const double blurred = 1e4, blurred_penalty = 1e4;

static bool held(const ves_descent *d, int j)
{
    return d->hold[j] == VES_HOLD_BELOW || d->hold[j] == VES_HOLD_EQUAL;
}

/* What the constraint pulls with: lambda + r c, c over its size, not negative for an inequality. */
static double pull(const ves_descent *d, int j)
{
    double t = d->multiplier[j] + d->penalty * d->last.constraint[j] / d->size[j];
    return d->hold[j] == VES_HOLD_EQUAL || t > 0 ? t : 0;
}

double ves_lagrange_value(const ves_descent *d)
{
    double sum = 0;
    for (int j = 0; j < d->session->m; j++) {
        if (!held(d, j)) continue;
        double t = pull(d, j), l = d->multiplier[j];
        sum += (t * t - l * l) / (2 * d->penalty);
    }
    return sum;
}

double ves_lagrange_slope(const ves_descent *d, int i)
{
    double sum = 0;
    for (int j = 0; j < d->session->m; j++)
        if (held(d, j)) sum += pull(d, j) * d->last.jacobian[j * d->session->n + i] / d->size[j];
    return sum;
}

/* New multipliers; returns how far the old ones were from right, in units of the constraints. */
static double update(ves_descent *d)
{
    double worst = 0;
    for (int j = 0; j < d->session->m; j++) {
        if (!held(d, j)) continue;
        double t = pull(d, j);
        worst = fmax(worst, fabs(t - d->multiplier[j]) / d->penalty * d->size[j]);
        d->multiplier[j] = t;
    }
    return worst;
}

static double moved(const ves_descent *d)
{
    double most = 0;
    for (int i = 0; i < d->session->n; i++) most = fmax(most, fabs(d->route[i] - d->from[i]));
    return most;
}

static double steepness(const ves_descent *d)
{
    double most = 0;
    for (int i = 0; d->recipe.gradient && i < d->session->n; i++)
        most = fmax(most, fabs(d->last.gradient[i] / d->scale + ves_lagrange_slope(d, i)) * d->range[i]);
    return most;
}

/* One round: minimise L, learn the multipliers. Returns the error of the constraints, HUGE_VAL when the end
 * cannot be judged. */
static ves_status inner(ves_descent *d, double step, double factor, double *error)
{
    *error = HUGE_VAL;
    VES_TRY(ves_descent_look(d, d->route, d->recipe.gradient));
    d->shrink = fmax(1, steepness(d));
    d->lowest = d->highest = ((d->last.value - d->offset) / d->scale + ves_lagrange_value(d)) / d->shrink;
    VES_TRY(ves_descent_minimise(d, step, factor));
    if (d->lost) return VES_OK;
    VES_TRY(ves_descent_look(d, d->route, false));
    if (d->last.status == VES_OK)
        *error = update(d);
    else
        memcpy(d->route, d->from, (size_t)d->session->n * sizeof(double));
    return VES_OK;
}

/* Early rounds are not worth full accuracy; the first step of a round is about as long as the way of the
 * last. */
ves_status ves_lagrange_run(ves_descent *d, double step)
{
    size_t bytes = (size_t)d->session->n * sizeof(double);
    double before = HUGE_VAL, factor = 1e5;
    memset(d->multiplier, 0, (size_t)d->session->m * sizeof(double));
    d->penalty = first_penalty;
    ves_status status = VES_OK;
    for (int k = 0; k < ROUNDS && !d->halted; k++) {
        double error;
        memcpy(d->from, d->route, bytes);
        status = inner(d, step, factor, &error);
        if (status != VES_OK || d->halted || d->lost) break;
        double way = moved(d);
        step = fmin(fmax(way, 1e-5), 0.1);
        if (error <= d->session->tight && way <= 100 * d->options->x_tolerance) break;
        double most = d->recipe.dual && error < blurred * d->session->tight ? blurred_penalty : most_penalty;
        if (!(error <= enough * before) && d->penalty < most) d->penalty *= faster;
        before = error;
        factor = fmax(1, 0.1 * factor);
    }
    d->penalty = 0;
    d->shrink = 1;
    return status;
}

#include "study/idle.h"

#include <math.h>

#include "base/random.h"
#include "study/run.h"

/* Slopes are looked at in a few designs off the start: on the plane of symmetry that a start often lies on, a
 * slope may vanish for another reason. Rounding leaves 1e-16 of the largest slope in one that should be 0. */
enum { TRIES = 16, ENOUGH = 3 };
static const double AWAY = 0.1, ROUNDING = 1e-12;

static void step_off(const ves_problem *p, ves_random *random, double *x)
{
    for (int k = 0; k < p->variables; k++) {
        const ves_variable *v = &p->variable[k];
        double to = v->start + AWAY * (v->max - v->min) * (2 * ves_random_uniform(random) - 1);
        x[k] = fmin(fmax(to, v->min), v->max);
    }
}

/* A variable that moves one output, by more than rounding, over its range is not idle. */
static void compare(const ves_problem *p, const double *slope, bool *idle)
{
    double largest = 0;
    for (int k = 0; k < p->variables; k++)
        largest = fmax(largest, fabs(slope[k]) * (p->variable[k].max - p->variable[k].min));
    for (int k = 0; k < p->variables; k++)
        if (fabs(slope[k]) * (p->variable[k].max - p->variable[k].min) > ROUNDING * largest) idle[k] = false;
}

bool ves_study_idle(ves_plan *plan, const ves_problem *p, ves_arena *arena, bool *idle)
{
    size_t n = (size_t)p->variables, m = (size_t)p->constraints;
    double *x = ves_arena_take(arena, n, sizeof *x);
    ves_verdict verdict = {.constraint = ves_arena_take(arena, m, sizeof(double)),
                           .gradient = ves_arena_take(arena, n, sizeof(double)),
                           .jacobian = ves_arena_take(arena, n * m, sizeof(double))};
    if (!x || !verdict.constraint || !verdict.gradient || !verdict.jacobian) return false;
    if (!ves_plan_search(&plan, 1).gradients) return false;
    for (int k = 0; k < p->variables; k++) idle[k] = true;
    int seen = 0;
    for (int t = 0; t < TRIES && seen < ENOUGH; t++) {
        ves_random random = {.step = (uint64_t)t};
        ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
        step_off(p, &random, x);
        if (ves_plan_evaluate(plan, &ask, &verdict) != VES_OK) return false;
        if (verdict.status != VES_OK) continue;
        if (p->objective) compare(p, verdict.gradient, idle);
        for (int k = 0; k < p->constraints; k++) compare(p, verdict.jacobian + (size_t)k * n, idle);
        seen++;
    }
    return seen == ENOUGH;
}

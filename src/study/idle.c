#include "study/idle.h"

#include <math.h>

#include "base/random.h"
#include "study/run.h"

/* Slopes are looked at in a few designs near the start, where most can be measured, and as many anywhere,
 * because a formula may read a variable in one place and not in another. Never at the start itself, nor at a
 * bound: on the plane of symmetry that either often lies on, a slope may vanish for another reason. Those
 * near the start come nearer, by half every few tries, where most others fail. Rounding leaves 1e-16 of the
 * largest slope in one that should be 0. */
enum { TRIES = 64, ENOUGH = 8, HALVED = 8 };
static const double AWAY = 0.1, ROUNDING = 1e-12;

/* At most `away` of each range from the start. */
static void draw(const ves_problem *p, ves_random *random, double away, double *x)
{
    for (int k = 0; k < p->variables; k++) {
        const ves_variable *v = &p->variable[k];
        double range = v->max - v->min, part = ves_random_uniform(random);
        double least = fmax(v->min, v->start - away * range), most = fmin(v->max, v->start + away * range);
        x[k] = least + (most - least) * part;
    }
}

/* What a goal names is not idle, whatever its slope. */
static bool named(const ves_problem *p, int slot)
{
    if (p->objective && ves_formula_uses_slot(p->objective, slot)) return true;
    for (int k = 0; k < p->constraints; k++)
        if (ves_formula_uses_slot(p->constraint[k].left, slot) ||
            ves_formula_uses_slot(p->constraint[k].right, slot))
            return true;
    return false;
}

/* A variable that moves one output, by more than rounding, over its range is not idle. */
static void compare(const ves_problem *p, const double *slope, bool *idle)
{
    double largest = 0;
    for (int k = 0; k < p->variables; k++)
        largest = fmax(largest, fabs(slope[k]) * (p->variable[k].max - p->variable[k].min));
    for (int k = 0; k < p->variables; k++)
        if (!(fabs(slope[k]) * (p->variable[k].max - p->variable[k].min) <= ROUNDING * largest))
            idle[k] = false;
}

static bool any(const bool *idle, int count)
{
    for (int k = 0; k < count; k++)
        if (idle[k]) return true;
    return false;
}

/* Only as long as some variable may be idle: a gradient may take seconds. */
bool ves_study_idle(ves_plan *plan, const ves_problem *p, ves_arena *arena, bool *idle)
{
    size_t n = (size_t)p->variables, m = (size_t)p->constraints;
    double *x = ves_arena_take(arena, n, sizeof *x);
    ves_verdict verdict = {.constraint = ves_arena_take(arena, m, sizeof(double)),
                           .gradient = ves_arena_take(arena, n, sizeof(double)),
                           .jacobian = ves_arena_take(arena, n * m, sizeof(double))};
    if (!x || !verdict.constraint || !verdict.gradient || !verdict.jacobian) return false;
    if (!ves_plan_search(&plan, 1).gradients) return false;
    for (int k = 0; k < p->variables; k++) idle[k] = !named(p, k);
    int seen = 0;
    for (int t = 0; t < TRIES && seen < ENOUGH && any(idle, p->variables); t++) {
        ves_random random = {.step = (uint64_t)t};
        ves_ask ask = {.x = x, .cutoff = HUGE_VAL, .want = VES_WANT_GRADIENT};
        draw(p, &random, t % 2 ? 1 : AWAY * exp2(-t / HALVED), x);
        if (ves_plan_evaluate(plan, &ask, &verdict) != VES_OK) return false;
        if (verdict.status != VES_OK) continue;
        if (p->objective) compare(p, verdict.gradient, idle);
        for (int k = 0; k < p->constraints; k++) compare(p, verdict.jacobian + (size_t)k * n, idle);
        seen++;
    }
    return seen == ENOUGH || !any(idle, p->variables);
}

static bool same(double a, double b)
{
    return fabs(a - b) <= ROUNDING * fmax(fabs(a), fabs(b));
}

void ves_study_rest(ves_plan *plan, const ves_problem *p, const bool *idle, ves_arena *arena, double *x)
{
    size_t n = (size_t)p->variables;
    double *y = ves_arena_take(arena, n, sizeof *y);
    ves_verdict before = {0}, after = {0};
    ves_ask ask = {.x = x, .level = 1, .cutoff = HUGE_VAL, .want = VES_WANT_PROOF};
    if (!y || ves_plan_evaluate(plan, &ask, &before) != VES_OK) return;
    for (size_t k = 0; k < n; k++) y[k] = idle[k] ? p->variable[k].start : x[k];
    ask.x = y;
    if (ves_plan_evaluate(plan, &ask, &after) != VES_OK || after.status != before.status) return;
    if (after.status != VES_OK || !same(after.value, before.value)) return;
    if (!same(after.violation, before.violation) && after.violation > before.violation) return;
    for (size_t k = 0; k < n; k++) x[k] = y[k];
}

#include "suite/outcome.h"

#include <math.h>

void ves_outcome_clear(ves_outcome *outcome)
{
    ves_memory_free(outcome->x);
    ves_memory_free(outcome->step);
    *outcome = (ves_outcome){.done = false};
}

bool ves_outcome_holds(const ves_outcome *o)
{
    bool counts = o->evaluations >= 0 && o->starts >= 0 && o->gradients >= 0 && o->failures >= 0 &&
                  o->gradients <= o->evaluations && o->failures <= o->evaluations;
    if (!counts || !isfinite(o->budget) || !(o->spent >= 0 && o->spent <= o->budget)) return false;
    if (!o->any) return !o->hit && o->value == HUGE_VAL && o->violation == HUGE_VAL;
    for (int i = 0; i < o->n; i++)
        if (!(o->x[i] >= 0 && o->x[i] <= 1)) return false;
    return isfinite(o->value) && isfinite(o->violation) && o->violation >= 0 && !(o->hit && o->violation > 1);
}

/* As ves_meter compares. */
static bool better(const ves_step *step, const ves_step *before)
{
    if (!before) return step->cost > 0;
    if (step->cost < before->cost) return false;
    if (step->violation <= 1) return !(before->violation <= 1) || step->value < before->value;
    return step->violation < before->violation;
}

bool ves_outcome_leads(const ves_outcome *o)
{
    const ves_step *last = NULL;
    for (int k = 0; k < o->steps; last = &o->step[k++]) {
        const ves_step *s = &o->step[k];
        bool holds = isfinite(s->cost) && s->cost <= o->spent && isfinite(s->value) && isfinite(s->violation);
        if (!holds || s->violation < 0 || !better(s, last)) return false;
    }
    if (!last) return !o->any;
    return o->any && last->value == o->value && last->violation == o->violation;
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

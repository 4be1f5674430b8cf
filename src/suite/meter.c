#include "suite/meter.h"

#include <math.h>
#include <string.h>

enum { FIRST = 64 };

bool ves_meter_begin(ves_meter *meter)
{
    size_t n = (size_t)meter->inner->n;
    meter->x = ves_memory_take(2 * n * sizeof *meter->x);
    meter->last = meter->x ? meter->x + n : NULL;
    meter->value = meter->violation = HUGE_VAL;
    return meter->x;
}

void ves_meter_end(ves_meter *meter)
{
    ves_memory_free(meter->x);
    ves_memory_free(meter->step);
    meter->x = meter->last = NULL;
    meter->step = NULL;
}

double ves_meter_left(const ves_meter *meter)
{
    return meter->over ? 0 : meter->budget - meter->spent;
}

/* The same point again with its slopes: the value has been paid for. */
static double price(const ves_meter *meter, const ves_ask *ask)
{
    if (!(ask->want & VES_WANT_GRADIENT)) return meter->cost;
    size_t size = (size_t)meter->inner->n * sizeof(double);
    bool again = meter->asked && !meter->sloped && !memcmp(meter->last, ask->x, size);
    return again ? meter->cost_gradient - meter->cost : meter->cost_gradient;
}

static double violation(const ves_meter *meter, const ves_verdict *v)
{
    const ves_search_problem *p = meter->inner;
    if (meter->inequality <= 0) return v->violation / (p->tolerance > 0 ? p->tolerance : VES_FEASIBLE);
    double worst = 0;
    for (int j = 0; j < p->m; j++) {
        bool equality = p->equality && p->equality[j];
        double part =
            equality ? fabs(v->constraint[j]) / meter->equality : v->constraint[j] / meter->inequality;
        if (!(part <= worst)) worst = part; /* NAN sticks */
        if (isnan(worst)) break;
    }
    return worst;
}

static void note(ves_meter *meter)
{
    if (meter->steps == meter->room) {
        int room = meter->room ? 2 * meter->room : FIRST;
        ves_step *more = ves_memory_grow(meter->step, (size_t)room * sizeof *more);
        if (!more) {
            meter->fault = VES_MEMORY;
            return;
        }
        meter->step = more;
        meter->room = room;
    }
    meter->step[meter->steps++] = (ves_step){meter->spent, meter->value, meter->violation};
}

static void compare(ves_meter *meter, const double *x, double value, double worst)
{
    bool feasible = worst <= 1, before = meter->violation <= 1;
    bool better = feasible ? !before || value < meter->value : !before && worst < meter->violation;
    if (!better) return;
    meter->any = true;
    meter->value = value;
    meter->violation = worst;
    memcpy(meter->x, x, (size_t)meter->inner->n * sizeof *x);
    note(meter);
    if (feasible && value <= meter->target) meter->hit = meter->over = true;
}

static ves_status charge(ves_meter *meter, const ves_ask *ask)
{
    double due = price(meter, ask);
    if (meter->over || meter->spent + due > meter->budget) {
        meter->over = true;
        return VES_INTERRUPTED;
    }
    meter->spent += due;
    meter->evaluations++;
    meter->gradients += ask->want & VES_WANT_GRADIENT ? 1 : 0;
    meter->asked = true;
    meter->sloped = ask->want & VES_WANT_GRADIENT;
    memcpy(meter->last, ask->x, (size_t)meter->inner->n * sizeof *ask->x);
    return VES_OK;
}

/* The problem has no values beyond its box; a method that ignores bounds must not win there. */
static bool inside(const ves_meter *meter, const double *x)
{
    for (int i = 0; i < meter->inner->n; i++)
        if (!(x[i] >= 0 && x[i] <= 1)) return false;
    return true;
}

static ves_status evaluate(void *data, int worker, const ves_ask *ask, ves_verdict *verdict)
{
    ves_meter *meter = data;
    const ves_search_problem *p = meter->inner;
    VES_TRY(charge(meter, ask));
    if (!inside(meter, ask->x)) {
        verdict->status = VES_OUTSIDE;
        meter->failed++;
        return VES_OK;
    }
    double begin = meter->clock ? meter->clock() : 0;
    ves_status status = p->evaluate(p->data, worker, ask, verdict);
    if (meter->clock) meter->inside += meter->clock() - begin;
    if (status < VES_OK || verdict->status < VES_OK) {
        meter->fault = status < VES_OK ? status : verdict->status;
        meter->over = true;
        return meter->fault;
    }
    if (status > VES_OK) verdict->status = status;
    double worst = verdict->status == VES_OK ? violation(meter, verdict) : NAN;
    if (verdict->status == VES_OK && (!isfinite(verdict->value) || isnan(worst)))
        verdict->status = VES_NO_NUMBER;
    if (verdict->status == VES_CUT) return VES_OK;
    if (verdict->status != VES_OK) {
        meter->failed++;
        return VES_OK;
    }
    if (meter->inequality > 0) verdict->violation = worst * VES_FEASIBLE;
    compare(meter, ask->x, verdict->value, worst);
    return meter->fault;
}

static ves_status same(void *data, const double *a, const double *b, bool *is)
{
    const ves_search_problem *p = ((const ves_meter *)data)->inner;
    return p->same(p->data, a, b, is);
}

ves_search_problem ves_meter_problem(ves_meter *meter, const double *start)
{
    ves_search_problem problem = *meter->inner;
    problem.evaluate = evaluate;
    if (problem.same) problem.same = same;
    problem.data = meter;
    problem.workers = 1;
    problem.start = start;
    problem.others = 0;
    return problem;
}

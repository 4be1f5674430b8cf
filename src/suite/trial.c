#include "suite/trial.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "suite/instance.h"

enum { DRAWS = 200 };

static bool measurable(const ves_trial *c, ves_verdict *room)
{
    const ves_search_problem *p = c->meter->inner;
    const ves_ask ask = {.x = c->start, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    room->status = VES_OK;
    return p->evaluate(p->data, 0, &ask, room) == VES_OK && room->status == VES_OK;
}

double ves_trial_clock(const ves_trial *trial)
{
    return trial->meter->clock ? trial->meter->clock() : 0;
}

ves_status ves_trial_start(ves_trial *trial)
{
    double begin = ves_trial_clock(trial);
    const ves_search_problem *p = trial->meter->inner;
    double *constraint = ves_memory_take((size_t)(p->m + 1) * sizeof *constraint);
    ves_verdict room = {.constraint = constraint};
    if (!constraint) return VES_MEMORY;
    int first = trial->starts++ * DRAWS;
    for (int k = 0; k < DRAWS; k++) {
        ves_instance_start(trial->seed, first + k, p->n, trial->start);
        if (measurable(trial, &room)) break;
    }
    ves_memory_free(constraint);
    trial->aside += ves_trial_clock(trial) - begin;
    return VES_OK;
}

void ves_trial_fail(ves_trial *trial, const char *format, ...)
{
    if (trial->failed) return;
    va_list list;
    va_start(list, format);
    vsnprintf(trial->reason, sizeof trial->reason, format, list);
    va_end(list);
    trial->failed = true;
}

ves_status ves_trial_run(ves_trial *trial)
{
    static ves_status (*const run[])(ves_trial *) = {ves_trial_search, ves_trial_nlopt, ves_trial_program};
    trial->starts = 0;
    trial->aside = 0;
    trial->failed = false;
    trial->reason[0] = 0;
    trial->start = ves_memory_take((size_t)trial->meter->inner->n * sizeof *trial->start);
    if (!trial->start) return VES_MEMORY;
    ves_status status = run[trial->method->kind](trial);
    ves_memory_free(trial->start);
    trial->start = NULL;
    if (trial->meter->fault) return trial->meter->fault;
    if (status == VES_OK && trial->stopped && trial->stopped(trial->data)) return VES_INTERRUPTED;
    return status;
}

#include "suite/contest.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

#include "suite/instance.h"

enum { DRAWS = 200 };

static bool measurable(const ves_contest *c, ves_verdict *room)
{
    const ves_search_problem *p = c->meter->inner;
    const ves_ask ask = {.x = c->start, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    room->status = VES_OK;
    return p->evaluate(p->data, 0, &ask, room) == VES_OK && room->status == VES_OK;
}

double ves_contest_clock(const ves_contest *contest)
{
    return contest->meter->clock ? contest->meter->clock() : 0;
}

ves_status ves_contest_start(ves_contest *contest)
{
    double begin = ves_contest_clock(contest);
    const ves_search_problem *p = contest->meter->inner;
    double *constraint = ves_memory_take((size_t)(p->m + 1) * sizeof *constraint);
    ves_verdict room = {.constraint = constraint};
    if (!constraint) return VES_MEMORY;
    int first = contest->starts++ * DRAWS;
    for (int k = 0; k < DRAWS; k++) {
        ves_instance_start(contest->seed, first + k, p->n, contest->start);
        if (measurable(contest, &room)) break;
    }
    ves_memory_free(constraint);
    contest->aside += ves_contest_clock(contest) - begin;
    return VES_OK;
}

void ves_contest_fail(ves_contest *contest, const char *format, ...)
{
    if (contest->failed) return;
    va_list list;
    va_start(list, format);
    vsnprintf(contest->reason, sizeof contest->reason, format, list);
    va_end(list);
    contest->failed = true;
}

ves_status ves_contest_run(ves_contest *contest)
{
    static ves_status (*const run[])(ves_contest *) = {ves_contest_search, ves_contest_nlopt,
                                                       ves_contest_program};
    contest->starts = 0;
    contest->aside = 0;
    contest->failed = false;
    contest->reason[0] = 0;
    contest->start = ves_memory_take((size_t)contest->meter->inner->n * sizeof *contest->start);
    if (!contest->start) return VES_MEMORY;
    ves_status status = run[contest->entrant->kind](contest);
    ves_memory_free(contest->start);
    contest->start = NULL;
    if (contest->meter->fault) return contest->meter->fault;
    if (status == VES_OK && contest->stopped && contest->stopped(contest->data)) return VES_INTERRUPTED;
    return status;
}

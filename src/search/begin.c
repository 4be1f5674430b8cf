#include <math.h>
#include <stdio.h>
#include <string.h>

#include "search/session.h"

/* The first measured point: the start or, when that fails, the first of some random draws that does not. */

enum { MOST_DRAWS = 2000, REASONS = 3 };

static ves_status judge(ves_asker *asker, ves_point *point, bool accepted)
{
    ves_ask ask = {.x = point->x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    ves_status status = ves_asker_judge(asker, &ask, &point->verdict);
    if (status == VES_OK) ves_asker_record(asker, false, NAN, accepted);
    return status;
}

/* By turns anywhere in the box and near the start, where near has any scale. */
static void draw(const ves_search_problem *problem, uint64_t seed, uint64_t step, const double *start,
                 double *u)
{
    ves_random random = {.seed = seed, .chain = VES_STREAM_BEGIN, .step = step};
    double width = pow(10, -3 * ves_random_uniform(&random));
    for (int i = 0; i < problem->n; i++)
        u[i] = step % 2 ? ves_point_reflect(start[i] + width * ves_random_normal(&random))
                        : ves_random_uniform(&random);
}

/* A callback may answer with any status: those that no list knows are counted together. */
static int kind_of(ves_status status)
{
    return status >= 0 && (int)status < VES_STATUS_KINDS ? (int)status : VES_STATUS_KINDS - 1;
}

/* What was wrong with the points that failed: the commonest reasons first. */
static void reasons_write(long *failed, char *text, size_t size)
{
    size_t length = 0;
    long others = 0;
    text[0] = 0;
    for (int turn = 0; turn < REASONS; turn++) {
        int most = 0;
        for (int k = 0; k < VES_STATUS_KINDS; k++)
            if (failed[k] > failed[most]) most = k;
        if (!failed[most]) return;
        length += (size_t)snprintf(text + length, size - length, "%s %ld: %s", turn ? ";" : "", failed[most],
                                   ves_status_text((ves_status)most));
        failed[most] = 0;
    }
    for (int k = 0; k < VES_STATUS_KINDS; k++) others += failed[k];
    if (others) snprintf(text + length, size - length, "; %ld: other reasons", others);
}

static ves_status look(ves_session *session, ves_asker *asker, ves_point *start)
{
    ves_status first = start->verdict.status;
    double *home = ves_arena_take(&session->arena, (size_t)session->n, sizeof *home);
    if (!home) return VES_MEMORY;
    memcpy(home, start->u, (size_t)session->n * sizeof *home);
    long half = (session->budget - session->reserved) / 2, most = half < MOST_DRAWS ? half : MOST_DRAWS;
    long k = 0, failed[VES_STATUS_KINDS] = {0};
    char reasons[512];
    while (start->verdict.status != VES_OK && k < most) {
        draw(session->problem, session->seed, (uint64_t)k++, home, start->u);
        ves_point_place(session->problem, start->u, start->x);
        VES_TRY(judge(asker, start, true));
        failed[kind_of(start->verdict.status)]++;
    }
    const char *reason = ves_status_text(first);
    reasons_write(failed, reasons, sizeof reasons);
    if (!most)
        ves_session_note(session, "the start cannot be measured (%s), and the budget allows no other point",
                         reason);
    else if (start->verdict.status != VES_OK)
        ves_session_note(session, "neither the start (%s) nor any of %ld random point%s can be measured:%s",
                         reason, k, k == 1 ? "" : "s", reasons);
    else
        ves_session_note(session,
                         "the start cannot be measured (%s); began at random point %ld, the first that can",
                         reason, k);
    return VES_OK;
}

static void place(const ves_search_problem *problem, const double *x, ves_point *point)
{
    for (int i = 0; i < problem->n; i++)
        point->u[i] = (x[i] - problem->lower[i]) / (problem->upper[i] - problem->lower[i]);
    memcpy(point->x, x, (size_t)problem->n * sizeof *x);
}

static ves_status others(ves_session *session, ves_asker *asker)
{
    const ves_search_problem *problem = session->problem;
    for (int k = 0; k < problem->others && ves_session_left(session) > asker->evaluations; k++) {
        ves_point *point = &session->end[session->ends].point;
        place(problem, problem->other[k], point);
        VES_TRY(judge(asker, point, true));
        session->ends += point->verdict.status == VES_OK;
    }
    ves_session_sort(session, session->end, session->ends);
    return VES_OK;
}

static void start_at(ves_session *session)
{
    ves_point_copy(&session->end[session->ends++].point, &session->start, session->n, session->m);
}

/* Where the start fails the best of the others stands for it or, when there is none, what a look round
 * finds. */
static ves_status elsewhere(ves_session *session, ves_asker *asker, ves_point *start)
{
    if (session->ends) {
        ves_point_copy(start, &session->end[0].point, session->n, session->m);
        return VES_OK;
    }
    VES_TRY(look(session, asker, start));
    if (start->verdict.status == VES_OK) start_at(session);
    return VES_OK;
}

ves_status ves_search_begin(ves_session *session)
{
    const ves_search_problem *problem = session->problem;
    ves_point *start = &session->start;
    session->end = ves_session_ends(session, 1 + problem->others);
    if (!session->end) return VES_MEMORY;
    place(problem, problem->start, start);
    ves_asker asker;
    ves_asker_init(&asker, session, 0);
    ves_status status = judge(&asker, start, true);
    if (start->verdict.status == VES_OK) start_at(session);
    if (status == VES_OK) status = others(session, &asker);
    if (status == VES_OK && start->verdict.status != VES_OK) status = elsewhere(session, &asker, start);
    ves_asker_flush(&asker);
    ves_asker_destroy(&asker);
    return status;
}

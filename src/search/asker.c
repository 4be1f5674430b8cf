#include <math.h>
#include <string.h>

#include "search/session.h"

enum { PROGRESS_EVERY = 10, FIRST_ROOM = 256 };

void ves_asker_init(ves_asker *asker, ves_session *session, int member)
{
    *asker = (ves_asker){.session = session, .member = member};
}

void ves_asker_destroy(ves_asker *asker)
{
    ves_memory_free(asker->journal.event);
    ves_memory_free(asker->journal.row);
    asker->journal = (ves_journal){0};
}

static double violation(const ves_session *session, const double *constraint)
{
    double worst = 0;
    for (int j = 0; j < session->m; j++) {
        double excess = ves_session_equality(session, j) ? fabs(constraint[j]) : constraint[j];
        if (!(excess <= worst)) worst = excess; /* NAN sticks */
        if (isnan(worst)) break;
    }
    return worst;
}

/* What a callback may get wrong: a value that is not a number, a violation left out. */
static void settle(const ves_session *session, ves_verdict *verdict)
{
    if (verdict->status == VES_OK) {
        if (isnan(verdict->violation)) verdict->violation = violation(session, verdict->constraint);
        if (!isfinite(verdict->value) || isnan(verdict->violation)) verdict->status = VES_NO_NUMBER;
    }
    if (verdict->status == VES_OK) return;
    verdict->value = HUGE_VAL;
    if (isnan(verdict->violation)) verdict->violation = HUGE_VAL;
}

ves_status ves_asker_judge(ves_asker *asker, const ves_ask *ask, ves_verdict *verdict)
{
    ves_session *session = asker->session;
    if (asker->fault) return asker->fault;
    if (session->fault) return session->fault;
    if (!asker->proves && ves_session_over(session)) return VES_INTERRUPTED;
    verdict->status = VES_OK;
    verdict->value = verdict->violation = NAN;
    ves_status status = session->problem->evaluate(session->problem->data, asker->worker, ask, verdict);
    if (status > VES_OK) { /* a callback may say it either way */
        verdict->status = status;
        status = VES_OK;
    }
    if (status == VES_OK && verdict->status < VES_OK) status = verdict->status;
    if (status == VES_INTERRUPTED) { /* the evaluator has heard of it first */
        atomic_store(&session->stopped, true);
        return status;
    }
    if (status != VES_OK) {
        asker->fault = status;
        atomic_store(&session->stopped, true); /* the other members need not go on */
        return status;
    }
    settle(session, verdict);
    asker->evaluations++;
    if (ask->want & VES_WANT_GRADIENT) asker->gradients++;
    if (verdict->status != VES_OK && verdict->status != VES_CUT) asker->failed++;
    return VES_OK;
}

static void tell(ves_asker *asker, const ves_event *event, const double *x, const double *constraint)
{
    ves_session *session = asker->session;
    ves_verdict verdict = {.status = event->status, .value = event->value, .violation = event->violation};
    if (ves_verdict_better(&verdict, &session->seen, session->tolerance)) session->seen = verdict;
    session->told++;
    if (session->hooks.record) {
        ves_record record = {.evaluation = session->told,
                             .stage = session->stage_index,
                             .chain = asker->member,
                             .x = x,
                             .constraint = constraint,
                             .value = event->value,
                             .violation = event->violation,
                             .temperature = event->temperature,
                             .status = event->status,
                             .accepted = event->accepted,
                             .gradient = event->gradient,
                             .proof = event->proof};
        session->hooks.record(session->hooks.data, &record);
    }
    if (session->told % PROGRESS_EVERY == 0) ves_session_progress(session);
}

static bool journal_grow(ves_journal *journal, int width, bool points)
{
    long room = journal->room ? 2 * journal->room : FIRST_ROOM;
    ves_event *event = ves_memory_grow(journal->event, (size_t)room * sizeof *event);
    if (!event) return false;
    journal->event = event;
    if (points) {
        double *row = ves_memory_grow(journal->row, (size_t)room * (size_t)width * sizeof *row);
        if (!row) return false;
        journal->row = row;
    }
    journal->room = room;
    return true;
}

/* With one worker the members run in their order anyway, and the hooks hear at once what they would hear
 * later. */
void ves_asker_record(ves_asker *asker, const double *x, const ves_verdict *verdict, bool gradient,
                      double temperature, bool accepted)
{
    ves_session *session = asker->session;
    if (!session->hooks.record && !session->hooks.progress) return;
    ves_event event = {.value = verdict->value,
                       .violation = verdict->violation,
                       .temperature = temperature,
                       .status = verdict->status,
                       .accepted = accepted,
                       .gradient = gradient,
                       .proof = asker->proves};
    if (ves_pool_workers(session->pool) == 1) {
        tell(asker, &event, x, verdict->constraint);
        return;
    }
    ves_journal *journal = &asker->journal;
    int n = session->n, m = session->m;
    bool points = session->hooks.record;
    if (journal->count == journal->room && !journal_grow(journal, n + m, points)) {
        asker->fault = VES_MEMORY;
        return;
    }
    if (points) {
        double *row = journal->row + journal->count * (n + m);
        memcpy(row, x, (size_t)n * sizeof *x);
        if (m) memcpy(row + n, verdict->constraint, (size_t)m * sizeof *row);
    }
    journal->event[journal->count++] = event;
}

void ves_asker_flush(ves_asker *asker)
{
    ves_session *session = asker->session;
    ves_journal *journal = &asker->journal;
    for (long k = 0; k < journal->count; k++) {
        const double *x = journal->row ? journal->row + k * (session->n + session->m) : NULL;
        tell(asker, &journal->event[k], x, x ? x + session->n : NULL);
    }
    journal->count = 0;
    session->evaluations += asker->evaluations;
    session->gradients += asker->gradients;
    session->failed += asker->failed;
    asker->evaluations = asker->gradients = asker->failed = 0;
    if (asker->fault && !session->fault) session->fault = asker->fault;
}

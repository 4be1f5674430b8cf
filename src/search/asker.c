#include <math.h>
#include <string.h>

#include "search/session.h"

enum { PROGRESS_EVERY = 10 };

/* Of an unfinished round no more than this is lost when the process is killed. */
static const double keep_every = 2; /* s */

/* For the journal alone: nothing else of a search may depend on the clock. */
static double now(const ves_session *session)
{
    return session->hooks.clock ? session->hooks.clock(session->hooks.data) : 0;
}

void ves_asker_init(ves_asker *asker, ves_session *session, int member)
{
    *asker = (ves_asker){.session = session, .member = member};
    asker->kept = now(session);
}

void ves_asker_destroy(ves_asker *asker)
{
    ves_bytes_free(&asker->said);
    ves_bytes_free(&asker->known);
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

/* What a callback may get wrong: a value or a constraint that is not a number, a violation left out. */
static void settle(const ves_session *session, ves_verdict *verdict)
{
    if (verdict->status == VES_OK) {
        const double told = violation(session, verdict->constraint);
        if (isnan(verdict->violation) || isnan(told)) verdict->violation = told;
        if (!isfinite(verdict->value) || isnan(verdict->violation)) verdict->status = VES_NO_NUMBER;
    }
    if (verdict->status == VES_OK) return;
    verdict->value = HUGE_VAL;
    if (isnan(verdict->violation)) verdict->violation = HUGE_VAL;
}

/* Asks the evaluator. */
static ves_status ask_now(ves_asker *asker, const ves_ask *ask, ves_verdict *verdict)
{
    ves_session *session = asker->session;
    verdict->status = VES_OK;
    verdict->value = verdict->violation = NAN;
    ves_status status = session->problem->evaluate(session->problem->data, asker->worker, ask, verdict);
    if (status > VES_OK) { /* a callback may say it either way */
        verdict->status = status;
        status = VES_OK;
    }
    if (status == VES_OK && verdict->status < VES_OK) status = verdict->status;
    if (status == VES_OK) settle(session, verdict);
    return status;
}

/* The answer that the journal has. One to another question shows that the journal is of another run. */
static ves_status recall(ves_asker *asker, const ves_ask *ask, ves_verdict *verdict)
{
    const ves_session *session = asker->session;
    const ves_bytes *known = &asker->known;
    size_t n = (size_t)session->n, m = (size_t)session->m, left = known->size - asker->heard;
    ves_event event;
    if (left < sizeof event) return VES_STALE;
    memcpy(&event, known->at + asker->heard, sizeof event);
    size_t size = sizeof(double) * ves_event_row(event.status, event.want, session->n, session->m);
    const double *row = (const double *)(const void *)(known->at + asker->heard + sizeof event);
    if (left < sizeof event + size || event.want != ask->want || memcmp(row, ask->x, n * sizeof *row))
        return VES_STALE;
    asker->heard += sizeof event + size;
    verdict->status = (ves_status)event.status;
    verdict->value = event.value;
    verdict->violation = event.violation;
    if (verdict->status != VES_OK) return VES_OK;
    if (m) memcpy(verdict->constraint, row + n, m * sizeof *row);
    if (!(ask->want & VES_WANT_GRADIENT)) return VES_OK;
    memcpy(verdict->gradient, row + n + m, n * sizeof *row);
    if (m) memcpy(verdict->jacobian, row + n + m + n, n * m * sizeof *row);
    return VES_OK;
}

/* Writes the answer down as a journal will have it. */
static bool say(ves_asker *asker, const ves_ask *ask, const ves_verdict *verdict)
{
    const ves_session *session = asker->session;
    size_t n = (size_t)session->n, m = (size_t)session->m;
    const ves_event event = {.value = verdict->value,
                             .violation = verdict->violation,
                             .temperature = NAN,
                             .status = verdict->status,
                             .want = (uint8_t)ask->want};
    size_t size = sizeof(double) * ves_event_row(event.status, event.want, session->n, session->m);
    unsigned char *to = ves_bytes_grow(&asker->said, sizeof event + size);
    if (!to) return false;
    memcpy(to, &event, sizeof event);
    double *row = (double *)(void *)(to + sizeof event);
    memcpy(row, ask->x, n * sizeof *row);
    if (verdict->status == VES_OK && m) memcpy(row + n, verdict->constraint, m * sizeof *row);
    if (verdict->status == VES_OK && (ask->want & VES_WANT_GRADIENT)) {
        memcpy(row + n + m, verdict->gradient, n * sizeof *row);
        if (m) memcpy(row + n + m + n, verdict->jacobian, n * m * sizeof *row);
    }
    asker->last = asker->said.size;
    asker->said.size += sizeof event + size;
    return true;
}

/* The caller's thread, as worker 0, tells how far all are. */
static void show(ves_asker *asker)
{
    ves_session *session = asker->session;
    long count = atomic_fetch_add_explicit(&session->under_way, 1, memory_order_relaxed) + 1;
    if (asker->worker == 0 && (session->told + count) % PROGRESS_EVERY == 0) ves_session_progress(session);
}

static ves_status fail(ves_asker *asker, ves_status status)
{
    if (status != VES_INTERRUPTED) asker->fault = status; /* else the evaluator has heard of it first */
    atomic_store(&asker->session->stopped, true);         /* the other members need not go on */
    return status;
}

/* In a round that ranks share this is the one place where a task hears of a stop: so the others can follow it. */
static bool ends(ves_session *session)
{
    return session->rounding ? ves_session_stopped(session) : ves_session_over(session);
}

ves_status ves_asker_judge(ves_asker *asker, const ves_ask *ask, ves_verdict *verdict)
{
    ves_session *session = asker->session;
    if (asker->fault) return asker->fault;
    if (session->fault) return session->fault;
    if (!asker->joined) VES_TRY(ves_round_join(session, &asker, 1));
    const bool more = asker->heard < asker->known.size, known = more || asker->whole;
    if (!known && !asker->proves && ends(session)) return VES_INTERRUPTED;
    if (!more && asker->broken) return VES_INTERRUPTED;
    ves_status status = known ? recall(asker, ask, verdict) : ask_now(asker, ask, verdict);
    if (status != VES_OK) return fail(asker, status);
    if (session->listens && !say(asker, ask, verdict)) return fail(asker, VES_MEMORY);
    asker->evaluations++;
    if (ask->want & VES_WANT_GRADIENT) asker->gradients++;
    if (verdict->status != VES_OK && verdict->status != VES_CUT) asker->failed++;
    if (!session->listens) return VES_OK;
    show(asker);
    if (!known && now(session) - asker->kept > keep_every) ves_asker_save(asker);
    return VES_OK;
}

static void tell(ves_session *session, const ves_record *record)
{
    ves_verdict verdict = {.status = record->status, .value = record->value, .violation = record->violation};
    if (ves_verdict_better(&verdict, &session->seen, session->tolerance)) session->seen = verdict;
    session->told++;
    atomic_fetch_sub_explicit(&session->under_way, 1, memory_order_relaxed);
    if (!session->hooks.record) return;
    ves_record told = *record;
    told.evaluation = session->told;
    told.stage = session->stage_index;
    session->hooks.record(session->hooks.data, &told);
}

/* Tells the hooks what they have not heard. */
static void catch_up(ves_asker *asker)
{
    ves_session *session = asker->session;
    ves_record record;
    while (ves_event_read(asker->said.at, asker->said.size, session->n, session->m, &asker->told, &record)) {
        record.chain = asker->member;
        tell(session, &record);
    }
}

/* With one worker the members run in their order anyway, and the hooks hear at once what they would hear
 * later. */
void ves_asker_record(ves_asker *asker, bool gradient, double temperature, bool accepted)
{
    ves_session *session = asker->session;
    if (!session->listens) return;
    ves_event event;
    memcpy(&event, asker->said.at + asker->last, sizeof event);
    event.temperature = temperature;
    event.gradient = gradient;
    event.accepted = accepted;
    memcpy(asker->said.at + asker->last, &event, sizeof event);
    if (ves_pool_workers(session->pool) == 1 && !session->shares) catch_up(asker);
}

void ves_asker_merge(ves_asker *asker)
{
    ves_session *session = asker->session;
    catch_up(asker);
    session->evaluations += asker->evaluations;
    session->gradients += asker->gradients;
    session->failed += asker->failed;
    asker->evaluations = asker->gradients = asker->failed = 0;
    asker->said.size = asker->known.size = 0;
    asker->last = asker->told = asker->saved = asker->heard = 0;
    asker->joined = asker->whole = asker->broken = false;
    asker->kept = now(session);
    if (asker->fault && !session->fault) session->fault = asker->fault;
}

void ves_asker_flush(ves_asker *asker)
{
    if (asker->joined) ves_round_leave(asker->session, &asker, 1);
}

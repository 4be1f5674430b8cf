#include "search/session.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { SENTENCE = 512 };

ves_status ves_session_init(ves_session *session, const ves_search_problem *problem,
                            const ves_search_options *options, const ves_search_hooks *hooks)
{
    *session = (ves_session){.problem = problem, .n = problem->n, .m = problem->m, .seed = options->seed};
    if (hooks) session->hooks = *hooks;
    session->tolerance = problem->tolerance > 0 ? problem->tolerance : VES_FEASIBLE;
    session->dear = options->gradient > 0 ? options->gradient : 3;
    session->tight = 1e-4 * session->tolerance;
    session->usual = session->tolerance / VES_FEASIBLE;
    session->seen = (ves_verdict){.status = VES_NO_NUMBER, .value = HUGE_VAL, .violation = HUGE_VAL};
    session->temperature = session->acceptance = NAN;
    session->ending = VES_ENDED_BUDGET;
    session->stop = "the budget allows no more than the start";
    session->stage_name = "start";
    atomic_init(&session->stopped, false);
    atomic_init(&session->under_way, 0);
    session->shares = session->hooks.exchange && session->hooks.ranks > 1;
    session->listens = session->shares || (hooks && (hooks->record || hooks->progress || hooks->keep));
    session->recalls = hooks && hooks->recall;
    ves_search_complete(session, options);
    session->pool = ves_pool_create(problem->workers);
    session->known =
        ves_arena_take(&session->arena, (size_t)VES_PROOFS_KNOWN * (size_t)session->n, sizeof(double));
    session->price = ves_arena_take(&session->arena, (size_t)session->m, sizeof(double));
    bool ok = session->pool && session->known && session->price &&
              ves_point_create(&session->arena, session->n, session->m, &session->start) &&
              ves_point_create(&session->arena, session->n, session->m, &session->best);
    return ok ? VES_OK : VES_MEMORY;
}

void ves_session_destroy(ves_session *session)
{
    ves_pool_destroy(session->pool);
    ves_bytes_free(&session->block);
    ves_bytes_free(&session->message);
    ves_memory_free(session->temperature_log);
    ves_memory_free(session->annealing_log);
    ves_arena_destroy(&session->arena);
    ves_arena_destroy(&session->kept);
}

bool ves_session_over(ves_session *session)
{
    if (session->fault) return true;
    if (!session->shares) return ves_session_stopped(session);
    return !session->rounding &&
           atomic_load(&session->stopped); /* the others must see it at the same place */
}

bool ves_session_stopped(ves_session *session)
{
    if (atomic_load(&session->stopped)) return true;
    if (!session->hooks.stopped || !session->hooks.stopped(session->hooks.data)) return false;
    atomic_store(&session->stopped, true);
    return true;
}

long ves_session_left(const ves_session *session)
{
    long left = session->budget - session->reserved - session->evaluations;
    return left > 0 ? left : 0;
}

bool ves_session_equality(const ves_session *session, int j)
{
    return session->problem->equality && session->problem->equality[j];
}

static double priced(const ves_session *session, const double *price, const ves_verdict *v)
{
    double sum = v->value;
    for (int j = 0; j < session->m; j++) {
        double excess = ves_session_equality(session, j) ? fabs(v->constraint[j]) : v->constraint[j];
        if (excess > session->tight) sum += price[j] * (excess - session->tight);
    }
    return sum;
}

bool ves_session_better_at(const ves_session *session, const double *price, const ves_verdict *a,
                           const ves_verdict *b)
{
    bool both = a->status == VES_OK && b->status == VES_OK && a->violation <= session->tolerance &&
                b->violation <= session->tolerance;
    if (!both) return ves_verdict_better(a, b, session->tolerance);
    return priced(session, price, a) < priced(session, price, b);
}

bool ves_session_better(const ves_session *session, const ves_verdict *a, const ves_verdict *b)
{
    return ves_session_better_at(session, session->price, a, b);
}

void ves_session_raise(ves_session *session, const double *const *price, int count)
{
    for (int j = 0; j < session->m; j++) {
        double least = HUGE_VAL;
        for (int k = 0; k < count; k++)
            if (price[k][j] > 0 && price[k][j] < least) least = price[k][j];
        if (least < HUGE_VAL) session->price[j] = fmax(session->price[j], least);
    }
}

/* By insertion: stable, and there are few ends. */
void ves_session_sort(const ves_session *session, ves_end *end, int count)
{
    for (int i = 1; i < count; i++) {
        ves_end moved = end[i];
        int j = i;
        for (; j && ves_session_better(session, &moved.point.verdict, &end[j - 1].point.verdict); j--)
            end[j] = end[j - 1];
        end[j] = moved;
    }
}

static const char *sentence(ves_session *session, const char *format, va_list list)
{
    char text[SENTENCE];
    vsnprintf(text, sizeof text, format, list);
    return ves_arena_text(&session->kept, text, strlen(text));
}

void ves_session_note(ves_session *session, const char *format, ...)
{
    if (session->notes == VES_NOTES) return;
    va_list list;
    va_start(list, format);
    const char *text = sentence(session, format, list);
    va_end(list);
    if (text)
        session->note[session->notes++] = text;
    else
        session->fault = VES_MEMORY;
}

void ves_session_stop(ves_session *session, ves_ending ending, const char *format, ...)
{
    va_list list;
    va_start(list, format);
    const char *text = sentence(session, format, list);
    va_end(list);
    session->ending = ending;
    if (text)
        session->stop = text;
    else
        session->fault = VES_MEMORY;
}

void ves_session_progress(ves_session *session)
{
    if (!session->hooks.progress) return;
    ves_progress progress = {.stage = session->stage_index,
                             .stage_name = session->stage_name,
                             .evaluations = session->told + atomic_load(&session->under_way),
                             .budget = session->budget,
                             .temperature = session->temperature,
                             .acceptance = session->acceptance,
                             .any = session->seen.status == VES_OK,
                             .value = session->seen.value,
                             .violation = session->seen.violation};
    session->hooks.progress(session->hooks.data, &progress);
}

/* The polish's own accuracy: two points so near are one shape. */
static const double near_refused = 1e-5;

static bool is_refused(const ves_session *session, const ves_point *point)
{
    long count = session->refused < VES_PROOFS_KNOWN ? session->refused : VES_PROOFS_KNOWN;
    for (long k = 0; k < count; k++) {
        const double *u = session->known + k * session->n;
        double apart = 0;
        for (int i = 0; i < session->n; i++) apart = fmax(apart, fabs(point->u[i] - u[i]));
        if (apart <= near_refused) return true;
    }
    return false;
}

bool ves_session_costs(const ves_session *session, const ves_point *point)
{
    return !point->proved && !is_refused(session, point);
}

/* Refusals are noted once for each reason. */
static void refuse(ves_session *session, const ves_point *point, ves_status status)
{
    size_t n = (size_t)session->n;
    memcpy(session->known + (size_t)(session->refused++ % VES_PROOFS_KNOWN) * n, point->u,
           n * sizeof(double));
    int kind = (int)status;
    bool listed = kind > 0 && kind < VES_STATUS_KINDS;
    if (!listed || !session->refusal[kind]) {
        char text[SENTENCE];
        const ves_search_problem *p = session->problem;
        bool more = p->why && p->why(p->data, point->x, status, text, sizeof text);
        ves_session_note(session, "a best was refused by its proof: %s%s%s", ves_status_text(status),
                         more ? ": " : "", more ? text : "");
    }
    if (listed) session->refusal[kind] = true;
}

/* In the caller's thread. An evaluator that is interrupted in its proof has neither passed nor refused it. */
ves_status ves_session_prove(ves_session *session, ves_point *point, ves_proof *proof)
{
    *proof = point->proved ? VES_PROOF_PASSED : VES_PROOF_REFUSED;
    if (!ves_session_costs(session, point)) return VES_OK;
    ves_asker asker;
    ves_asker_init(&asker, session, -1);
    asker.proves = true;
    double *constraint = ves_arena_take(&session->arena, (size_t)session->m, sizeof(double));
    if (!constraint) return VES_MEMORY;
    ves_verdict verdict = {.constraint = constraint};
    ves_ask ask = {.x = point->x, .level = 1, .cutoff = HUGE_VAL, .want = VES_WANT_PROOF};
    ves_status status = ves_asker_judge(&asker, &ask, &verdict);
    point->proved = status == VES_OK && verdict.status == VES_OK;
    if (status == VES_OK) ves_asker_record(&asker, false, NAN, point->proved);
    asker.failed = 0; /* refused, not failed */
    ves_asker_flush(&asker);
    ves_asker_destroy(&asker);
    if (status == VES_INTERRUPTED) *proof = VES_PROOF_STOPPED;
    if (status != VES_OK) return status == VES_INTERRUPTED ? VES_OK : status;
    if (point->proved)
        *proof = VES_PROOF_PASSED;
    else
        refuse(session, point, verdict.status);
    return VES_OK;
}

static int best_of(const ves_session *session, ves_point *const *point, int count, const bool *done)
{
    int best = -1;
    for (int k = 0; k < count; k++)
        if (!done[k] && (best < 0 || ves_session_better(session, &point[k]->verdict, &point[best]->verdict)))
            best = k;
    return best;
}

/* Best first, so that all but one of the proofs are saved when the first passes. */
ves_status ves_session_offer(ves_session *session, ves_point *const *point, int count, long most,
                             bool *refused)
{
    for (int k = 0; k < count; k++) refused[k] = false;
    for (int k; (k = best_of(session, point, count, refused)) >= 0;) {
        if (!ves_session_better(session, &point[k]->verdict, &session->best.verdict)) break;
        if (ves_session_costs(session, point[k]) && most-- <= 0) break;
        ves_proof proof;
        VES_TRY(ves_session_prove(session, point[k], &proof));
        if (proof == VES_PROOF_PASSED) ves_point_copy(&session->best, point[k], session->n, session->m);
        if (proof != VES_PROOF_REFUSED) break;
        refused[k] = true;
    }
    return VES_OK;
}

uint32_t ves_session_stream(int stage, int member)
{
    return ((uint32_t)stage * VES_STREAM_MEMBERS + (uint32_t)member) << 16;
}

ves_end *ves_session_ends(ves_session *session, int room)
{
    ves_end *end = ves_arena_take(&session->arena, (size_t)room, sizeof *end);
    for (int k = 0; end && k < room; k++)
        if (!ves_point_create(&session->arena, session->n, session->m, &end[k].point)) return NULL;
    return end;
}

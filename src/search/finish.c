#include <math.h>
#include <string.h>

#include "search/evidence.h"
#include "search/kkt.h"

/* What a search ends in: the proved best, the distinct ends, the result. */

static const double level = 1e-6;   /* relative: values that may belong to one flat optimum */
static const double barrier = 1e-9; /* relative: what lies between two points of one basin */
static const double golden = 0.61803398874989485;

enum {
    HALVINGS = 17, /* of a way through the box, until points are one shape: 1e-5 */
    PROFILE = 5    /* points between two ends that may belong to one flat optimum */
};

typedef struct box {
    ves_search_result result; /* first: what the caller holds */
    ves_arena arena;
} box;

/* Judges the point between a and b; HUGE_VAL where it fails or is not feasible. */
static ves_status between(ves_asker *asker, const ves_point *a, const ves_point *b, double t,
                          ves_point *point, double *value)
{
    const ves_session *session = asker->session;
    for (int i = 0; i < session->n; i++) point->u[i] = a->u[i] + t * (b->u[i] - a->u[i]);
    ves_point_place(session->problem, point->u, point->x);
    ves_ask ask = {.x = point->x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    VES_TRY(ves_asker_judge(asker, &ask, &point->verdict));
    ves_asker_record(asker, false, NAN, false);
    bool good = point->verdict.status == VES_OK && point->verdict.violation <= session->tolerance;
    *value = good ? point->verdict.value : HUGE_VAL;
    return VES_OK;
}

/* Two ends of the same value, far apart, are one optimum when the caller knows them to be one design, or when
 * the objective is flat between them: they differ only in variables that it does not feel. Flat is no higher than
 * the ends, and no lower than ends of one optimum may be, at multiples of the golden section: where optima lie
 * evenly a simple part of the way leads to one of them, but with k steps between the two ends the golden section
 * stays a third of a step, over k, away from each. */
static ves_status flat(ves_asker *asker, const ves_point *a, const ves_point *b, ves_point *point, bool *same)
{
    ves_session *session = asker->session;
    const ves_verdict *start = &session->start.verdict;
    double fa = a->verdict.value, fb = b->verdict.value;
    double way = start->status == VES_OK ? fabs(start->value - fa) : 0;
    double size = fmax(fmax(fabs(fa), fabs(fb)), 1e-3 * way);
    *same = false;
    if (fabs(fa - fb) > level * size) return VES_OK;
    if (session->problem->same) VES_TRY(session->problem->same(session->problem->data, a->x, b->x, same));
    if (*same || ves_session_left(session) < asker->evaluations + PROFILE) return VES_OK;
    for (int k = 1; k <= PROFILE; k++) {
        double value, t = golden * k;
        VES_TRY(between(asker, a, b, t - floor(t), point, &value));
        if (value > fmax(fa, fb) + barrier * size || value < fmin(fa, fb) - level * size) return VES_OK;
    }
    *same = true;
    return VES_OK;
}

static bool close_by(const ves_session *session, const ves_point *a, const ves_point *b)
{
    double apart = 0;
    for (int i = 0; i < session->n; i++) apart = fmax(apart, fabs(a->u[i] - b->u[i]));
    return apart < VES_ONE_OPTIMUM;
}

typedef struct clusters {
    int count;
    int skipped;    /* ends that are not listed: no evaluation was left for their proofs */
    long proofs;    /* that may still be asked for */
    ves_end *first; /* the best of each; its hits and blind are those of all */
    int *into;      /* [ends of the session] the cluster of each; -1: none */
    long merged;    /* ends of descents from random points that are one with another such */
} clusters;

static void cluster_new(clusters *c, ves_session *session, const ves_point *point, bool saddle)
{
    ves_point_copy(&c->first[c->count].point, point, session->n, session->m);
    c->first[c->count++].saddle = saddle;
}

/* At the end nothing is kept back. */
static long spare(const ves_session *session)
{
    return session->budget - session->evaluations;
}

static bool identical(const ves_session *session, const ves_point *a, const ves_point *b)
{
    return !memcmp(a->u, b->u, (size_t)session->n * sizeof(double));
}

/* The cluster that it belongs to; -1: none. */
static ves_status cluster_find(const clusters *c, ves_asker *asker, const ves_end *end, ves_point *point,
                               int *found)
{
    bool same;
    *found = -1;
    for (int k = 0; k < c->count && *found < 0; k++)
        if (close_by(asker->session, &c->first[k].point, &end->point)) *found = k;
    for (int k = 0; k < c->count && *found < 0 && !ves_session_over(asker->session); k++) {
        VES_TRY(flat(asker, &c->first[k].point, &end->point, point, &same));
        if (same) *found = k;
    }
    return VES_OK;
}

/* Into the one that it belongs to or, when it is feasible, proved and an end by its slope, into a new one. */
static ves_status cluster_sort(clusters *c, ves_asker *asker, ves_end *end, ves_point *point, int *into)
{
    ves_session *session = asker->session;
    *into = -1;
    if (end->point.verdict.violation > session->tolerance) return VES_OK;
    VES_TRY(cluster_find(c, asker, end, point, into));
    if (*into >= 0) {
        ves_end *first = &c->first[*into];
        if (!identical(session, &first->point, &end->point)) return VES_OK;
        first->saddle = first->saddle || end->saddle;
        first->halt = end->halt;
        return VES_OK;
    }
    if (end->halt == VES_HALT_KINK) return VES_OK;
    ves_proof proof = end->point.proved ? VES_PROOF_PASSED : VES_PROOF_STOPPED;
    ves_asker_flush(asker); /* the proof is told after what led to it, with any number of workers */
    if (!ves_session_over(session)) {
        if (ves_session_costs(session, &end->point) && (c->proofs-- <= 0 || spare(session) <= 0)) {
            c->skipped++;
            return VES_OK;
        }
        VES_TRY(ves_session_prove(session, &end->point, &proof));
    }
    if (proof != VES_PROOF_PASSED) return VES_OK;
    *into = c->count;
    cluster_new(c, session, &end->point, end->saddle);
    return VES_OK;
}

/* Descents of portfolios that have ended there. What is already known of the place is not asked again. */
static ves_status cluster_count(clusters *c, ves_asker *asker, const ves_end *seen, ves_point *point)
{
    const ves_session *session = asker->session;
    int at = -1;
    if (seen->point.verdict.violation > session->tolerance) return VES_OK;
    for (int k = 0; k < session->ends && at < 0; k++)
        if (identical(session, &session->end[k].point, &seen->point)) at = c->into[k];
    if (at < 0) VES_TRY(cluster_find(c, asker, seen, point, &at));
    if (at < 0) return VES_OK;
    c->merged += c->first[at].blind && seen->blind;
    c->first[at].hits += seen->hits;
    c->first[at].blind += seen->blind;
    return VES_OK;
}

/* Where no portfolio has been, the descents that led here count. */
static void cluster_credit(clusters *c, const ves_session *session)
{
    for (int at = 0; at < c->count; at++) {
        long own = 0;
        for (int k = 0; k < session->ends; k++) own += c->into[k] == at;
        if (!c->first[at].hits) c->first[at].hits = own ? own : 1;
    }
}

/* What stands for an optimum was chosen with a price on violations; among optima, which are all feasible,
 * only the value counts. */
static void cluster_order(clusters *c, double tolerance)
{
    for (int i = 1; i < c->count; i++) {
        ves_end end = c->first[i];
        int j = i;
        for (; j && ves_verdict_better(&end.point.verdict, &c->first[j - 1].point.verdict, tolerance); j--)
            c->first[j] = c->first[j - 1];
        c->first[j] = end;
    }
}

static ves_status cluster(clusters *c, ves_session *session, const ves_point *best)
{
    ves_point point;
    c->first = ves_session_ends(session, session->ends + 1);
    c->into = ves_arena_take(&session->arena, (size_t)session->ends, sizeof *c->into);
    if (!c->first || !c->into || !ves_point_create(&session->arena, session->n, session->m, &point))
        return VES_MEMORY;
    cluster_new(c, session, best, false);
    ves_asker asker;
    ves_asker_init(&asker, session, -1);
    ves_status status = VES_OK;
    for (int k = 0; k < session->ends; k++) c->into[k] = -1;
    for (int k = 0; k < session->ends && status == VES_OK; k++)
        status = cluster_sort(c, &asker, &session->end[k], &point, &c->into[k]);
    for (int k = 0; k < session->visits && status == VES_OK; k++)
        status = cluster_count(c, &asker, &session->visited[k], &point);
    ves_asker_flush(&asker);
    ves_asker_destroy(&asker);
    cluster_credit(c, session);
    cluster_order(c, session->tolerance);
    if (c->skipped && session->best.verdict.status == VES_OK)
        ves_session_note(session, "the budget left no proofs for %d more end%s: %s not listed", c->skipped,
                         c->skipped == 1 ? "" : "s", c->skipped == 1 ? "it is" : "they are");
    return status == VES_INTERRUPTED ? VES_OK : status;
}

/* All ends and the start are offered; of the proofs half, so that some are left for the optima. */
static ves_status offer(ves_session *session, long *proofs)
{
    int count = session->ends + 1;
    ves_point **point = ves_arena_take(&session->arena, (size_t)count, sizeof *point);
    bool *refused = ves_arena_take(&session->arena, (size_t)count, sizeof *refused);
    if (!point || !refused) return VES_MEMORY;
    for (int k = 0; k < session->ends; k++) point[k] = &session->end[k].point;
    point[count - 1] = &session->start;
    long before = session->evaluations, most = ves_session_over(session) ? VES_PROOFS_ROUND : VES_PROOFS / 2;
    if (most > spare(session)) most = spare(session);
    VES_TRY(ves_session_offer(session, point, count, most, refused));
    /* ends that are refused do not shut out the start, which people have looked at */
    if (session->best.verdict.status != VES_OK && session->start.verdict.status == VES_OK)
        VES_TRY(ves_session_offer(session, &point[count - 1], 1, spare(session) > 0, refused));
    *proofs = VES_PROOFS - (session->evaluations - before);
    return VES_OK;
}

/* The best of the ends that is better than all that was proved: none of them passed. */
static const ves_point *refused_best(const ves_session *session)
{
    const ves_point *best = NULL;
    for (int k = 0; k < session->ends; k++) {
        const ves_point *p = &session->end[k].point;
        if (!ves_session_better(session, &p->verdict, best ? &best->verdict : &session->best.verdict))
            continue;
        if (!ves_session_costs(session, p)) best = p;
    }
    return best;
}

/* Judges and, where it is better than the proved best, proves the point at t of the way to what was refused.
 * on: go on beyond it. */
static ves_status step_towards(ves_session *session, ves_asker *asker, ves_point *point, bool *on)
{
    ves_ask ask = {.x = point->x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    ves_proof proof = VES_PROOF_REFUSED;
    *on = false;
    VES_TRY(ves_asker_judge(asker, &ask, &point->verdict));
    ves_asker_record(asker, false, NAN, false);
    ves_asker_flush(asker);
    const ves_verdict *v = &point->verdict;
    bool good =
        v->status == VES_OK && v->violation <= fmax(session->tolerance, session->best.verdict.violation);
    *on = good;
    if (!good || !ves_session_better(session, v, &session->best.verdict)) return VES_OK;
    point->proved = false;
    VES_TRY(ves_session_prove(session, point, &proof));
    *on = proof == VES_PROOF_PASSED;
    if (*on) ves_point_copy(&session->best, point, session->n, session->m);
    return VES_OK;
}

/* Between the proved best and the best that was refused lies an edge of what passes: by halves, the best
 * design this side of it. */
static ves_status retreat(ves_session *session)
{
    const ves_point *refused = refused_best(session);
    if (!refused || session->best.verdict.status != VES_OK || !session->refused) return VES_OK;
    ves_point point;
    double *from = ves_arena_take(&session->arena, (size_t)session->n, sizeof *from);
    if (!from || !ves_point_create(&session->arena, session->n, session->m, &point)) return VES_MEMORY;
    memcpy(from, session->best.u, (size_t)session->n * sizeof *from);
    ves_asker asker;
    ves_asker_init(&asker, session, -1);
    ves_status status = VES_OK;
    double low = 0, high = 1;
    for (int k = 0; k < HALVINGS && spare(session) > 1 && status == VES_OK && !ves_session_over(session);
         k++) {
        double t = (low + high) / 2;
        bool on;
        for (int i = 0; i < session->n; i++) point.u[i] = from[i] + t * (refused->u[i] - from[i]);
        ves_point_place(session->problem, point.u, point.x);
        status = step_towards(session, &asker, &point, &on);
        *(on ? &low : &high) = t;
    }
    ves_asker_flush(&asker);
    ves_asker_destroy(&asker);
    return status == VES_INTERRUPTED ? VES_OK : status;
}

/* When better ones than the best were refused, what the last stage says of its end does not hold of it. */
static void tell_refused(ves_session *session)
{
    const ves_point *refused = refused_best(session);
    if (!refused || session->best.verdict.status != VES_OK) return;
    ves_session_note(session, "better designs were refused: this is the best that passed, sought by halves "
                              "on the way to them; it need be no optimum");
    ves_session_stop(session, session->ending, "%s; but its end was refused by its proof", session->stop);
}

/* The best that may be shown: proved or, when nothing passes, the best all the same, as infeasible. */
static ves_status choose(ves_session *session, const ves_point **best, bool *proved, long *proofs)
{
    ves_point *start = &session->start;
    VES_TRY(offer(session, proofs));
    VES_TRY(retreat(session));
    tell_refused(session);
    *proved = session->best.verdict.status == VES_OK;
    *best = *proved ? &session->best : start;
    if (*proved || (start->verdict.status != VES_OK && !session->ends)) return VES_OK;
    if (session->ends && ves_session_better(session, &session->end[0].point.verdict, &start->verdict))
        *best = &session->end[0].point;
    const char *why = session->refused ? "no best passed its proof" : "nothing was proved";
    ves_session_note(session, "%s: the result is unproved and counts as infeasible", why);
    return VES_OK;
}

static double *copy(ves_arena *arena, const double *from, int count)
{
    double *to = ves_arena_take(arena, (size_t)count, sizeof *to);
    if (to && count) memcpy(to, from, (size_t)count * sizeof *to);
    return to;
}

static bool fill_best(ves_search_result *r, ves_session *session, const ves_point *best, bool feasible)
{
    r->any = best->verdict.status == VES_OK;
    r->feasible = feasible;
    r->value = best->verdict.value;
    r->violation = best->verdict.violation;
    r->x = copy(&session->kept, best->x, session->n);
    r->constraint = copy(&session->kept, best->verdict.constraint, session->m);
    return r->x && r->constraint;
}

static bool fill_optima(ves_search_result *r, ves_session *session, const clusters *c)
{
    ves_optimum *optimum = ves_arena_take(&session->kept, (size_t)c->count, sizeof *optimum);
    for (int k = 0; optimum && k < c->count; k++) {
        const ves_end *end = &c->first[k];
        optimum[k] = (ves_optimum){.value = end->point.verdict.value,
                                   .violation = end->point.verdict.violation,
                                   .hits = (int)end->hits,
                                   .saddle = end->saddle,
                                   .x = copy(&session->kept, end->point.x, session->n)};
        if (!optimum[k].x) return false;
    }
    r->optimum = optimum;
    r->optima = c->count;
    return optimum;
}

static bool fill_logs(ves_search_result *r, ves_session *session)
{
    const char **note = ves_arena_take(&session->kept, (size_t)session->notes, sizeof *note);
    ves_temperature *log_copy =
        ves_arena_take(&session->kept, (size_t)session->temperatures, sizeof *log_copy);
    ves_annealing_report *report =
        ves_arena_take(&session->kept, (size_t)session->annealings, sizeof *report);
    if (!note || !log_copy || !report) return false;
    ves_strategy_report *strategy =
        ves_arena_take(&session->kept, (size_t)session->strategies, sizeof *strategy);
    if (!strategy) return false;
    for (int k = 0; k < session->strategies; k++) strategy[k] = session->strategy[k];
    r->strategy = strategy;
    r->strategies = session->strategies;
    for (int k = 0; k < session->notes; k++) note[k] = session->note[k];
    for (int k = 0; k < session->temperatures; k++) log_copy[k] = session->temperature_log[k];
    for (int k = 0; k < session->annealings; k++) report[k] = session->annealing_log[k];
    r->note = note;
    r->notes = session->notes;
    r->temperature = log_copy;
    r->temperatures = session->temperatures;
    r->annealing = report;
    r->annealings = session->annealings;
    r->ending = session->ending;
    r->stop = session->stop;
    r->evaluations = session->evaluations;
    r->budget = session->budget;
    r->gradients = session->gradients;
    r->failed = session->failed;
    r->refused = session->refused;
    return true;
}

static ves_status fill(box *b, ves_session *session)
{
    ves_search_result *r = &b->result;
    const ves_point *best;
    bool proved;
    clusters c = {0};
    r->kkt = (ves_kkt){.slope = NAN, .residual = NAN};
    VES_TRY(choose(session, &best, &proved, &c.proofs));
    bool feasible = proved && best->verdict.violation <= session->tolerance;
    if (feasible) {
        VES_TRY(cluster(&c, session, best));
        best = &c.first[0].point;
        VES_TRY(ves_kkt_find(session, best, spare(session), &r->kkt));
    }
    if (session->fault) return session->fault;
    r->n = session->n;
    r->m = session->m;
    if (atomic_load(&session->stopped)) {
        r->status = VES_INTERRUPTED;
        session->ending = VES_ENDED_STOPPED;
        session->stop = ves_status_text(VES_INTERRUPTED);
    }
    if (session->fault) return session->fault;
    const ves_witness witness = {.feasible = feasible,
                                 .refused = feasible && refused_best(session),
                                 .halt = feasible ? c.first[0].halt : VES_HALT_UNKNOWN,
                                 .residual = r->kkt.residual,
                                 .hits = feasible ? c.first[0].blind : 0,
                                 .merged = c.merged};
    r->evidence = ves_evidence_judge(session, &witness);
    if (session->fault) return session->fault;
    bool ok = fill_best(r, session, best, feasible) && fill_optima(r, session, &c) && fill_logs(r, session);
    return ok ? VES_OK : VES_MEMORY;
}

ves_status ves_search_finish(ves_session *session, ves_search_result **result)
{
    box *b = ves_memory_take(sizeof *b);
    if (!b) return VES_MEMORY;
    ves_status status = fill(b, session);
    if (status != VES_OK) {
        ves_memory_free(b);
        return status;
    }
    b->arena = session->kept;
    session->kept = (ves_arena){0};
    *result = &b->result;
    return b->result.status;
}

void ves_search_result_destroy(ves_search_result *result)
{
    if (!result) return;
    box *b = (box *)result;
    ves_arena_destroy(&b->arena);
    ves_memory_free(b);
}

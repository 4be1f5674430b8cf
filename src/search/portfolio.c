#include <math.h>
#include <string.h>

#include "search/descent.h"
#include "search/evidence.h"
#include "search/slots.h"
#include "search/spread.h"

/* The portfolio: strategies that take turns, each with a share of the evaluations that follows its progress.
 * Every one is paused, never thrown away, so that none loses what it has learned. */

enum { MEMBERS = VES_STRATEGIES / VES_STAGES - 1, SLICE = 16 };
_Static_assert((int)MEMBERS < (int)VES_STREAM_MEMBERS, "each has random numbers of its own");

/* What is enough to end before a budget that nobody gave is spent: so many descents from random points to the
 * best, and so little of the box that is expected to lead to minima which none of them has seen. */
enum { ENOUGH = 10, BLIND_ROOM = 512 };
static const double little = 0.01;

typedef struct member {
    const ves_strategy *strategy;
    void *state;
    double base, share; /* of the evaluations: at first, and now */
    double used;        /* cost so far: a gradient costs as much as two evaluations */
    bool done;
    ves_strategy_report *report;
} member;

typedef struct portfolio {
    ves_session *session;
    ves_team team;
    int members;
    member member[MEMBERS];
    long budget, before;
    ves_polish exact;
    ves_descent descent; /* from each new best */
    ves_asker *asker;
    ves_point refined; /* where it began last, or ended when that is the best */
    bool unfinished;   /* it had not converged */
    ves_halt halt;     /* what it says of its end, when refined is that */
    long proofs;       /* that may still be asked for */
    const char *only;  /* the one member, or NULL */
    long started;      /* ends that were there at first */
    ves_strategy_report *refining;
} portfolio;

bool ves_team_take(ves_team *team, const ves_point *point)
{
    const ves_session *session = team->session;
    if (!ves_session_better(session, &point->verdict, &team->best.verdict)) return false;
    ves_point_copy(&team->best, point, session->n, session->m);
    team->bests++;
    return true;
}

static ves_strategy_report *report_new(const portfolio *p, const char *name)
{
    ves_session *session = p->session;
    ves_strategy_report *report = &session->strategy[session->strategies++];
    *report = (ves_strategy_report){.stage = session->stage_index, .name = name};
    return report;
}

static bool add(portfolio *p, const ves_strategy *strategy, double share)
{
    member *m = &p->member[p->members];
    uint32_t stream = ves_session_stream(p->session->stage_index, 1 + p->members);
    *m = (member){.strategy = strategy, .base = share, .share = share};
    m->state = strategy->create(&p->team, stream);
    if (!m->state) return false;
    p->members++;
    m->report = report_new(p, strategy->name);
    return true;
}

static ves_ground ground_of(const ves_session *session)
{
    for (int j = 0; j < session->m; j++)
        if (ves_session_equality(session, j)) return VES_GROUND_EQUATIONS;
    if (session->m) return VES_GROUND_INEQUALITIES;
    return session->problem->gradients ? VES_GROUND_GRADIENTS : VES_GROUND_VALUES;
}

/* What independent descents of portfolios before have found tells as much as what those of this one will. */
static bool blind_create(ves_session *session, ves_archive *blind)
{
    if (!ves_archive_create(blind, session, BLIND_ROOM)) return false;
    blind->closes = true;
    for (int k = 0; k < session->visits; k++) {
        const ves_end *seen = &session->visited[k];
        if (!seen->blind) continue;
        int at = ves_archive_add(blind, &seen->point);
        if (at >= 0) blind->end[at].hits += seen->blind - 1;
    }
    blind->met = session->blind;
    blind->failed = session->unmeasured;
    return true;
}

static bool create(portfolio *p)
{
    ves_session *session = p->session;
    p->team = (ves_team){.session = session, .weight = 1};
    if (!ves_archive_create(&p->team.archive, session, VES_ARCHIVE_ROOM)) return false;
    if (!blind_create(session, &p->team.blind)) return false;
    if (!ves_point_create(&session->arena, session->n, session->m, &p->team.best)) return false;
    if (!ves_point_create(&session->arena, session->n, session->m, &p->refined)) return false;
    p->exact = (ves_polish){.algorithm = ves_search_algorithm(session->problem, &p->exact),
                            .x_tolerance = 1e-10,
                            .f_tolerance = 1e-15};
    if (!ves_descent_create(&p->descent, session, 0, &p->exact, 0)) return false;
    p->descent.runs = 2;
    p->asker = &p->descent.asker;
    for (int k = 0; k < session->ends; k++) {
        int at = ves_archive_add(&p->team.archive, &session->end[k].point);
        if (at >= 0) p->team.archive.end[at].hits = 0; /* no descent of this stage has been there */
        ves_team_take(&p->team, &session->end[k].point);
    }
    p->started = p->team.archive.met;
    p->refining = report_new(p, "refine");
    const ves_ground ground = ground_of(session);
    const bool saves = session->saves[session->stage_index];
    for (const ves_strategy *const *each = ves_slots_strategies(); *each; each++) {
        bool fits = (*each)->share[ground] > 0 && (saves || !(*each)->saves);
        bool chosen = p->only ? !strcmp(p->only, (*each)->name) : fits;
        if (chosen && p->members < MEMBERS && !add(p, *each, p->only ? 1 : (*each)->share[ground]))
            return false;
    }
    return true;
}

static long left(const portfolio *p)
{
    long own = p->budget - (p->session->evaluations - p->before), all = ves_session_left(p->session);
    return own < all ? own : all;
}

/* When its next round is due, in cost of all. */
static double due(const member *m)
{
    return (m->used + (double)m->strategy->least(m->state)) / m->share;
}

/* Who is furthest behind its share, of those whose next round the budget allows. */
static member *next(portfolio *p)
{
    member *chosen = NULL;
    for (int k = 0; k < p->members; k++) {
        member *m = &p->member[k];
        if (m->done || m->strategy->least(m->state) > left(p)) continue;
        if (!chosen || due(m) < due(chosen)) chosen = m;
    }
    return chosen;
}

static void descend(void *data, int worker, int index)
{
    portfolio *p = data;
    (void)index;
    p->descent.asker.worker = worker;
    (void)ves_descent_run(&p->descent, &p->refined, &p->refined);
}

/* Strategies come near; from each new best a descent goes to the end. */
static ves_status refine(portfolio *p)
{
    ves_session *session = p->session;
    const ves_point *best = &p->team.best;
    long n = session->n, cost = session->problem->gradients ? 200 + 40 * n : 400 + 200 * n;
    if (best->verdict.status != VES_OK || left(p) < 4 * (n + 2)) return VES_OK;
    bool same = !memcmp(best->u, p->refined.u, (size_t)n * sizeof(double));
    if (same && !p->unfinished) return VES_OK;
    ves_point_copy(&p->refined, best, session->n, session->m);
    p->descent.used = 0;
    p->descent.budget = cost < left(p) ? cost : left(p);
    VES_TRY(ves_session_round(session, &p->asker, 1, descend, p));
    bool lower = ves_session_better(session, &p->refined.verdict, &best->verdict);
    p->unfinished = lower && ves_descent_spent(&p->descent);
    ves_archive_add(&p->team.archive, &p->refined);
    p->halt = ves_descent_halt(&p->descent);
    if (ves_team_take(&p->team, &p->refined)) return VES_OK;
    if (memcmp(best->u, p->refined.u, (size_t)n * sizeof(double))) p->halt = VES_HALT_UNKNOWN;
    ves_point_copy(&p->refined, best, session->n, session->m);
    return VES_OK;
}

/* The best that has not been refused. Bests are proved when they have lasted for a turn: a proof may cost as much
 * as a thousand candidates. */
static ves_status prove(portfolio *p)
{
    ves_session *session = p->session;
    ves_archive *archive = &p->team.archive;
    ves_point *point[VES_ARCHIVE_ROOM];
    bool refused[VES_ARCHIVE_ROOM], any = false;
    for (int k = 0; k < archive->count; k++) point[k] = &archive->end[k].point;
    long before = session->evaluations, most = p->proofs < VES_PROOFS_ROUND ? p->proofs : VES_PROOFS_ROUND;
    VES_TRY(ves_session_offer(session, point, archive->count, most, refused));
    p->proofs -= session->evaluations - before;
    for (int k = archive->count - 1; k >= 0; k--)
        if (refused[k]) ves_archive_drop(archive, k), any = true;
    if (!any) return VES_OK;
    const ves_point *best = archive->count ? &archive->end[0].point : &session->best;
    ves_point_copy(&p->team.best, best, session->n, session->m);
    for (int k = 0; k < p->members; k++)
        if (p->member[k].strategy->refused) p->member[k].strategy->refused(p->member[k].state);
    return VES_OK;
}

/* What refines a best of another leaves it to that one. */
static void credit(portfolio *p, ves_strategy_report *finder)
{
    bool theirs = false;
    finder->bests++;
    for (int k = 0; k < p->members; k++) theirs = theirs || p->member[k].report->best;
    if (theirs && finder == p->refining) return;
    for (int k = 0; k < p->members; k++) p->member[k].report->best = false;
    p->refining->best = false;
    finder->best = true;
}

/* What the session has asked for since then goes to a report's account, and a new best to its credit. */
typedef struct account {
    long evaluations, gradients, bests;
} account;

static account account_open(const portfolio *p)
{
    return (account){p->session->evaluations, p->session->gradients, p->team.bests};
}

static void account_close(portfolio *p, const account *since, ves_strategy_report *report)
{
    report->evaluations += p->session->evaluations - since->evaluations;
    report->gradients += p->session->gradients - since->gradients;
    if (p->team.bests > since->bests) credit(p, report);
}

static ves_status turn(portfolio *p, member *m)
{
    ves_session *session = p->session;
    long slice = (session->evaluations - p->before) / SLICE, least = m->strategy->least(m->state);
    if (slice < least) slice = least;
    const account all = account_open(p);
    session->stage_name = m->strategy->name;
    VES_TRY(m->strategy->advance(m->state, slice, left(p)));
    account_close(p, &all, m->report);
    bool gained = p->team.bests > all.bests;
    const account refining = account_open(p);
    if (!gained && !ves_session_over(session)) VES_TRY(refine(p));
    account_close(p, &refining, p->refining);
    if (!gained && p->proofs > 1 && !ves_session_over(session)) VES_TRY(prove(p));
    long evaluations = session->evaluations - all.evaluations;
    m->used += (double)evaluations + (session->dear - 1) * (double)(session->gradients - all.gradients);
    if (!evaluations) m->done = true;
    m->share = gained ? fmin(4 * m->base, 2 * m->share) : fmax(m->base, 0.8 * m->share);
    ves_session_progress(session);
    return VES_OK;
}

/* The best is refined, and descents that know nothing of it have come to it often enough. */
static bool enough(const portfolio *p)
{
    const ves_archive *blind = &p->team.blind;
    const ves_session *session = p->session;
    const ves_point *best = &p->team.best;
    if (!session->saves[session->stage_index] || p->unfinished) return false;
    int at = ves_archive_find(blind, best);
    return at >= 0 && blind->end[at].hits >= ENOUGH &&
           ves_evidence_unseen(blind->met, blind->kinds) < little &&
           !memcmp(best->u, p->refined.u, (size_t)session->n * sizeof(double));
}

/* What is known of ends: those of the archive, and those of independent descents that it had no room for, as where a
 * flat optimum has filled it. */
static ves_status witness(portfolio *p)
{
    ves_session *session = p->session;
    const ves_archive *archive = &p->team.archive, *blind = &p->team.blind;
    ves_end *seen = ves_session_ends(session, archive->count + blind->count);
    if (!seen) return VES_MEMORY;
    int seens = archive->count, kinds = 0;
    for (int k = 0; k < archive->count; k++) {
        ves_point_copy(&seen[k].point, &archive->end[k].point, session->n, session->m);
        seen[k].hits = archive->end[k].hits;
    }
    for (int k = 0; k < blind->count; k++) {
        const ves_end *end = &blind->end[k];
        int at = ves_archive_find(archive, &end->point);
        if (at < 0) ves_point_copy(&seen[at = seens++].point, &end->point, session->n, session->m);
        seen[at].blind += end->hits;
        if (seen[at].hits < seen[at].blind) seen[at].hits = seen[at].blind; /* of portfolios before */
    }
    for (int k = 0; k < seens; k++) kinds += seen[k].blind > 0;
    session->visited = seen;
    session->visits = seens;
    session->blind = blind->met;
    session->kinds = kinds;
    session->unmeasured = blind->failed;
    return VES_OK;
}

/* The archive goes on to the next stage. */
static ves_status hand_over(portfolio *p)
{
    ves_session *session = p->session;
    ves_archive *archive = &p->team.archive;
    VES_TRY(witness(p));
    if (!archive->count) return VES_OK; /* all were refused: what the stage began with stays */
    int at = ves_archive_find(archive, &p->refined);
    bool same =
        at >= 0 && !memcmp(archive->end[at].point.u, p->refined.u, (size_t)session->n * sizeof(double));
    if (same) archive->end[at].halt = p->halt;
    session->end = archive->end;
    session->ends = archive->count;
    return VES_OK;
}

static ves_status finish(portfolio *p)
{
    ves_session *session = p->session;
    const ves_archive *blind = &p->team.blind;
    if (enough(p))
        ves_session_stop(
            session, VES_ENDED_DONE,
            "auto: %ld of %ld descents from random points ended at the best, and less than %g %% of the box "
            "is expected to lead elsewhere",
            blind->end[ves_archive_find(blind, &p->team.best)].hits, blind->met, 100 * little);
    else if (!ves_session_over(session))
        ves_session_stop(session, VES_ENDED_BUDGET, "auto: its budget of %ld evaluations is spent",
                         p->budget);
    if (!ves_session_over(session) && !p->only && p->team.archive.met <= p->started + 2)
        ves_session_note(
            session,
            "the budget of %ld evaluations was too short for auto to do more than descend from the start",
            p->budget);
    return hand_over(p);
}

/* --- a look round --- */

enum { LOOKERS = 8, LOOKS_MOST = 16 };

/* What the strategies that need one number pay for a violation has to come from the data. */
typedef struct look {
    ves_session *session;
    ves_asker asker[LOOKERS];
    ves_point trial[LOOKERS], best[LOOKERS];
    int looks; /* of each */
    double value[LOOKERS * LOOKS_MOST], violation[LOOKERS * LOOKS_MOST];
} look;

static void look_about(void *data, int worker, int index)
{
    look *l = data;
    ves_session *session = l->session;
    ves_asker *asker = &l->asker[index];
    ves_point *trial = &l->trial[index];
    asker->worker = worker;
    for (int k = 0; k < l->looks; k++) {
        int at = index * l->looks + k;
        ves_random random = {.seed = session->seed,
                             .chain = ves_session_stream(session->stage_index, 0),
                             .step = (uint64_t)at};
        for (int i = 0; i < session->n; i++) trial->u[i] = ves_random_uniform(&random);
        ves_point_place(session->problem, trial->u, trial->x);
        ves_ask ask = {.x = trial->x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
        l->value[at] = l->violation[at] = NAN;
        if (ves_asker_judge(asker, &ask, &trial->verdict) != VES_OK) return;
        bool better = ves_verdict_better(&trial->verdict, &l->best[index].verdict, session->tolerance);
        ves_asker_record(asker, false, NAN, better);
        if (better) ves_point_copy(&l->best[index], trial, session->n, session->m);
        if (trial->verdict.status != VES_OK) continue;
        l->value[at] = trial->verdict.value;
        l->violation[at] = trial->verdict.violation;
    }
}

/* Weight: a violation as large as the middle one of random points costs two spreads of the value. */
static ves_status look_round(portfolio *p)
{
    ves_session *session = p->session;
    look *l = ves_arena_take(&session->arena, 1, sizeof *l);
    if (!l) return VES_MEMORY;
    l->session = session;
    l->looks = 2 + session->n / 4;
    if (l->looks > LOOKS_MOST) l->looks = LOOKS_MOST;
    if (LOOKERS * l->looks > left(p) / 4) return VES_OK;
    ves_asker *asker[LOOKERS];
    for (int k = 0; k < LOOKERS; k++) {
        ves_asker_init(&l->asker[k], session, k);
        asker[k] = &l->asker[k];
        if (!ves_point_create(&session->arena, session->n, session->m, &l->trial[k])) return VES_MEMORY;
        if (!ves_point_create(&session->arena, session->n, session->m, &l->best[k])) return VES_MEMORY;
    }
    ves_status status = ves_session_round(session, asker, LOOKERS, look_about, l);
    for (int k = 0; k < LOOKERS; k++) {
        ves_team_take(&p->team, &l->best[k]);
        ves_asker_destroy(&l->asker[k]);
    }
    int measured = LOOKERS * l->looks;
    double width = ves_spread(l->value, &measured);
    double typical = ves_typical(l->violation, LOOKERS * l->looks, session->tolerance, session->usual);
    p->team.weight = ves_weight(width > 0 ? width : 1, typical);
    return status;
}

ves_status ves_portfolio_run(ves_session *session, const ves_auto *options, long budget)
{
    portfolio p = {
        .session = session, .only = options->only, .budget = budget, .before = session->evaluations};
    p.proofs = budget / 10 < VES_PROOFS ? budget / 10 : VES_PROOFS;
    ves_status status = create(&p) ? VES_OK : VES_MEMORY;
    if (status == VES_OK && session->m) status = look_round(&p);
    while (status == VES_OK && !ves_session_over(session)) {
        member *m = next(&p);
        if (!m) break;
        status = turn(&p, m);
        if (status == VES_OK && enough(&p)) break;
    }
    if (status == VES_OK) status = finish(&p);
    ves_descent_destroy(&p.descent);
    for (int k = 0; k < p.members; k++)
        if (p.member[k].strategy->destroy) p.member[k].strategy->destroy(p.member[k].state);
    return status;
}

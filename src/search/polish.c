#include <math.h>
#include <string.h>

#include "search/descent.h"
#include "search/saddle.h"

/* One polishing stage: a descent from each of the ends of the stage before, each a task of its own. A descent
 * that ends on a saddle goes on from both sides of it. */

enum { ESCAPES = 4, WAITING = ESCAPES + 2, ENDS = 2 * ESCAPES + 1, LEAST = 10 };

typedef struct task {
    ves_descent descent;
    bool checks; /* second order */
    ves_saddle saddle;
    const ves_point *start;
    int waiting; /* points to descend from */
    ves_point wait[WAITING];
    int above[WAITING]; /* the saddle that each has left: its place among the ends; -1: none */
    int ends;
    ves_end end[ENDS];
    int sides[ENDS];     /* descents from beside the saddle that are still to come, or broke off */
    bool loose[ENDS];    /* more touches it than has a multiplier */
    int acquitted;       /* that were none */
    int escapes, halves; /* saddles; those that were left to one side only */
    int mostly;          /* along which variable the first was */
    int edges, edge;     /* ends beside what cannot be measured; along which variable, at the first */
    ves_status beyond;   /* there: why not */
    bool running;        /* at one of them the value has not stopped falling */
} task;

typedef struct polish {
    ves_session *session;
    int tasks;
    long proofs; /* that may be asked for */
    task *task;
} polish;

static bool task_create(task *t, ves_session *session, int index, const ves_polish *options, long budget)
{
    if (!ves_descent_create(&t->descent, session, index, options, budget)) return false;
    t->start = &session->end[index].point;
    t->checks = !options->stay && t->descent.recipe.gradient && session->problem->gradients &&
                session->n <= VES_SADDLE_MOST;
    for (int k = 0; k < WAITING; k++)
        if (!ves_point_create(&session->arena, session->n, session->m, &t->wait[k])) return false;
    for (int k = 0; k < ENDS; k++)
        if (!ves_point_create(&session->arena, session->n, session->m, &t->end[k].point)) return false;
    return !t->checks || ves_saddle_create(&t->saddle, session, true);
}

/* Where more touches a point than has a multiplier, another choice of multipliers may have no negative curvature, and
 * it takes one for all of them to make a saddle [Nocedal and Wright 2006, 12.5]: there the descents decide. */
static void acquit(task *t, int at)
{
    if (t->sides[at] || !t->loose[at] || t->end[at].pass || ves_descent_spent(&t->descent)) return;
    t->end[at].saddle = false;
    t->acquitted++;
}

/* Steps off the saddle; what lies lower waits for its own descent. */
static ves_status leave(task *t, int at)
{
    ves_point *const side[2] = {&t->wait[t->waiting], &t->wait[t->waiting + 1]};
    bool found[2];
    if (!t->escapes++) t->mostly = t->saddle.mostly;
    ves_status status = ves_saddle_leave(&t->saddle, &t->descent, side, found);
    if (found[1] && !found[0]) {
        ves_point moved = *side[0];
        t->wait[t->waiting] = *side[1];
        t->wait[t->waiting + 1] = moved;
    }
    for (int k = found[0] + found[1]; k; k--) t->above[t->waiting++] = at;
    t->halves += found[0] != found[1];
    t->sides[at] = found[0] + found[1];
    t->loose[at] = t->saddle.near > t->saddle.active;
    acquit(t, at);
    return status;
}

/* Whether the end of a descent is worth leaving a saddle for: feasible, and lower by more than descents are
 * exact. */
static bool lower(const task *t, const ves_verdict *end, const ves_verdict *saddle)
{
    const ves_session *session = t->descent.session;
    if (end->violation > session->tolerance) return false;
    if (!ves_session_better_at(session, t->descent.price, end, saddle)) return false;
    double size = fmax(fabs(saddle->value), 1e-6 * t->descent.first_scale);
    return saddle->violation > session->tolerance ||
           saddle->value - end->value > 10 * t->descent.options->f_tolerance * size;
}

static void note_edge(task *t)
{
    bool runs = t->saddle.running && !t->running;
    if (!t->edges++ || runs) t->edge = t->saddle.edge, t->beyond = t->saddle.beyond;
    t->running = t->running || runs;
}

/* One descent and what follows from it. */
static ves_status advance(task *t)
{
    ves_session *session = t->descent.session;
    int at = t->ends++, from = --t->waiting, above = t->above[from];
    ves_end *end = &t->end[at];
    end->saddle = end->pass = false;
    end->halt = VES_HALT_UNKNOWN;
    ves_status status = ves_descent_run(&t->descent, &t->wait[from], &end->point);
    if (above >= 0 && lower(t, &end->point.verdict, &t->end[above].point.verdict)) t->end[above].pass = true;
    VES_TRY(status);
    if (above >= 0 && !ves_descent_spent(&t->descent)) t->sides[above]--;
    if (above >= 0) acquit(t, above);
    end->halt = ves_descent_halt(&t->descent);
    if (!t->checks || ves_descent_spent(&t->descent)) return VES_OK;
    VES_TRY(ves_saddle_check(&t->saddle, &t->descent, &end->point, &end->saddle));
    if (t->saddle.edge >= 0) note_edge(t);
    if (end->halt == VES_HALT_UNKNOWN) end->halt = VES_HALT_REST;
    if (t->saddle.running) end->halt = VES_HALT_EDGE;
    bool stalled = t->saddle.stalled && !t->descent.beside;
    if (stalled && end->point.verdict.violation <= session->tolerance) end->halt = VES_HALT_KINK;
    return end->saddle && t->escapes < ESCAPES ? leave(t, at) : VES_OK;
}

static void run(void *data, int worker, int index)
{
    polish *p = data;
    task *t = &p->task[index];
    t->descent.asker.worker = worker;
    ves_point_copy(&t->wait[0], t->start, p->session->n, p->session->m);
    t->above[0] = -1;
    t->waiting = 1;
    while (t->waiting) {
        ves_status status = advance(t);
        if (status != VES_OK) return;
    }
}

static const char *name_variable(ves_session *session, int i)
{
    if (session->problem->name) return session->problem->name[i];
    const char *text = ves_arena_format(&session->arena, "x[%d]", i);
    if (!text) session->fault = VES_MEMORY;
    return text ? text : "x";
}

/* Saddles from which no way led lower: more were met than could be left, or what seemed lower was not. */
static bool stuck(const task *t)
{
    for (int e = 0; e < t->ends; e++)
        if (t->end[e].saddle && !t->end[e].pass) return true;
    return false;
}

static void note_saddles(polish *p)
{
    const task *first = NULL;
    int met = 0, left = 1, saddles = 0, halves = 0;
    for (int k = 0; k < p->tasks; k++) {
        if (p->task[k].escapes == p->task[k].acquitted) continue;
        if (!first) first = &p->task[k];
        met++;
        left = left && !stuck(&p->task[k]);
        saddles += p->task[k].escapes - p->task[k].acquitted;
        halves += p->task[k].halves;
    }
    if (!met) return;
    const char *way = halves == 0        ? "left it both ways"
                      : halves < saddles ? "left it, not always both ways"
                                         : "left it one way";
    ves_session_note(p->session,
                     "%d of %d polish%s met a saddle: a direction whose curvature leads to better values "
                     "(mostly %s); %s",
                     met, p->tasks, p->tasks == 1 ? "" : "es", name_variable(p->session, first->mostly),
                     left ? way : "not every one could be left");
}

/* Beside an edge of what can be measured nothing is said of saddles; a value that runs into it deserves a
 * sentence. */
static void note_edges(polish *p)
{
    const task *first = NULL;
    int met = 0;
    for (int k = 0; k < p->tasks; k++) {
        const task *t = &p->task[k];
        if (!t->edges) continue;
        met++;
        if (!first || (t->running && !first->running)) first = t;
    }
    if (!met) return;
    ves_session_note(p->session,
                     "%d of %d polish%s ended beside designs that cannot be measured (along %s: %s): whether "
                     "at a saddle could not be judged%s",
                     met, p->tasks, p->tasks == 1 ? "" : "es", name_variable(p->session, first->edge),
                     ves_status_text(first->beyond),
                     first->running ? ", and the value runs into that edge: the optimum may lie beyond it"
                                    : "");
}

static void note_stalls(polish *p)
{
    int met = 0;
    for (int k = 0; k < p->tasks; k++) {
        bool stalled = false;
        for (int e = 0; e < p->task[k].ends; e++)
            stalled = stalled || p->task[k].end[e].halt == VES_HALT_KINK;
        met += stalled;
    }
    if (!met) return;
    ves_session_note(
        p->session,
        "%d of %d polish%s stopped where the slope has not vanished, as at a jump or at the kinks of "
        "max, min and abs: no such end is listed but for the best; a further polish by sbplx or cobyla "
        "needs no slopes and may find a better one",
        met, p->tasks, p->tasks == 1 ? "" : "es");
}

static const ves_end *best_end(const ves_session *session, const task *t)
{
    const ves_end *best = &t->end[0];
    for (int e = 1; e < t->ends; e++)
        if (ves_session_better(session, &t->end[e].point.verdict, &best->point.verdict)) best = &t->end[e];
    return best;
}

/* Where the gradient failed first, and how often. */
static ves_status note_mended(polish *p)
{
    enum { NAMED = 4 };
    ves_session *session = p->session;
    long mended = 0;
    const double *x = NULL;
    for (int k = p->tasks - 1; k >= 0; k--) {
        if (!p->task[k].descent.mended) continue;
        mended += p->task[k].descent.mended;
        x = p->task[k].descent.first_mended;
    }
    if (!mended) return VES_OK;
    char *text = NULL;
    for (int i = 0; i < session->n && i < NAMED; i++) {
        text = ves_arena_format(&session->arena, "%s%s%s = %.6g", text ? text : "", text ? ", " : "",
                                name_variable(session, i), x[i]);
        if (!text) return VES_MEMORY;
    }
    ves_session_note(
        session, "the gradient is no number at %ld candidate%s, first at %s%s: differences stood in for it",
        mended, mended == 1 ? "" : "s", text, session->n > NAMED ? " ..." : "");
    return session->fault;
}

/* The sentence of the best end's task. */
static void tell_stop(polish *p, const ves_polish *options)
{
    ves_session *session = p->session;
    const task *best = &p->task[0];
    const ves_end *end = best_end(session, best);
    for (int k = 1; k < p->tasks; k++) {
        const ves_end *other = best_end(session, &p->task[k]);
        if (!ves_session_better(session, &other->point.verdict, &end->point.verdict)) continue;
        best = &p->task[k];
        end = other;
    }
    bool spent = ves_descent_spent(&best->descent);
    const char *sentence = end->halt == VES_HALT_KINK && !spent
                               ? "no step leads on, but the slope has not vanished, as at a kink"
                               : ves_descent_sentence(&best->descent);
    ves_session_stop(session, spent ? VES_ENDED_BUDGET : VES_ENDED_DONE, "%s: %s", options->algorithm,
                     sentence);
}

/* A saddle that was left is no end, once something better is proved: what lies lower may yet be refused. */
static void forget_passes(const ves_session *session, ves_end *end, int *count)
{
    int kept = 0;
    for (int k = 0; k < *count; k++) {
        bool outdone = ves_session_better(session, &session->best.verdict, &end[k].point.verdict);
        if (!end[k].pass || !outdone) end[kept++] = end[k];
    }
    *count = kept;
}

/* Descents that are known to have ended where a task began go on with it. */
static void take_along(const polish *p)
{
    const ves_session *session = p->session;
    const size_t bytes = (size_t)session->n * sizeof(double);
    for (int s = 0; s < session->visits; s++)
        for (int k = 0; k < p->tasks; k++) {
            const ves_point *end = &p->task[k].end[0].point;
            ves_point *seen = &session->visited[s].point;
            if (!p->task[k].ends || memcmp(seen->u, p->task[k].start->u, bytes)) continue;
            ves_point_copy(seen, end, session->n, session->m);
            break;
        }
}

static ves_status collect(polish *p)
{
    ves_session *session = p->session;
    int count = 0;
    for (int k = 0; k < p->tasks; k++) count += p->task[k].ends;
    ves_end *end = ves_arena_take(&session->arena, (size_t)count, sizeof *end);
    ves_point **point = ves_arena_take(&session->arena, (size_t)count, sizeof *point);
    bool *refused = ves_arena_take(&session->arena, (size_t)count, sizeof *refused);
    if (!end || !point || !refused) return VES_MEMORY;
    int at = 0;
    for (int k = 0; k < p->tasks; k++)
        for (int e = 0; e < p->task[k].ends; e++) end[at++] = p->task[k].end[e];
    ves_session_sort(session, end, count);
    for (int k = 0; k < count; k++) point[k] = &end[k].point;
    VES_TRY(ves_session_offer(session, point, count, p->proofs, refused));
    forget_passes(session, end, &count);
    take_along(p);
    if (!count) return VES_OK;
    session->end = end;
    session->ends = count;
    return VES_OK;
}

static ves_status work(polish *p)
{
    ves_session *session = p->session;
    ves_asker **asker = ves_arena_take(&session->arena, (size_t)p->tasks, sizeof *asker);
    if (!asker) return VES_MEMORY;
    for (int k = 0; k < p->tasks; k++) asker[k] = &p->task[k].descent.asker;
    ves_status status = ves_session_round(session, asker, p->tasks, run, p);
    ves_session_progress(session);
    return status;
}

/* Few evaluations are better spent on few descents that arrive. */
static int population(const ves_session *session, const ves_polish *options, long budget)
{
    long most = budget / (LEAST * (2 + (long)session->n));
    int wanted = options->starts && options->starts < session->ends ? options->starts : session->ends;
    return most < 1 ? 1 : wanted < most ? wanted : (int)most;
}

ves_status ves_polish_run(ves_session *session, const ves_polish *options, long budget)
{
    polish p = {.session = session, .tasks = population(session, options, budget)};
    p.proofs = budget / 10 < VES_PROOFS_ROUND ? budget / 10 : VES_PROOFS_ROUND;
    budget -= p.proofs;
    session->stage_name = options->algorithm;
    p.task = ves_arena_take(&session->arena, (size_t)p.tasks, sizeof *p.task);
    if (!p.task) return VES_MEMORY;
    for (int k = 0; k < p.tasks; k++)
        if (!task_create(&p.task[k], session, k, options, budget / p.tasks)) return VES_MEMORY;
    if (!options->stay && session->problem->gradients && session->n > VES_SADDLE_MOST)
        ves_session_note(session, "no check for saddles: more than %d variables", VES_SADDLE_MOST);
    ves_status status = work(&p);
    const double **price = ves_arena_take(&session->arena, (size_t)p.tasks, sizeof *price);
    if (!price) return VES_MEMORY;
    for (int k = 0; k < p.tasks; k++) price[k] = p.task[k].descent.price;
    ves_session_raise(session, price, p.tasks);
    if (status == VES_OK) {
        tell_stop(&p, options);
        note_saddles(&p);
        note_edges(&p);
        note_stalls(&p);
        status = note_mended(&p);
        if (status == VES_OK) status = collect(&p);
    }
    for (int k = 0; k < p.tasks; k++) ves_descent_destroy(&p.task[k].descent);
    return status;
}

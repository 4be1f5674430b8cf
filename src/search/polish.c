#include <math.h>

#include "search/descent.h"
#include "search/saddle.h"

/* One polishing stage: a descent from each of the ends of the stage before, each a task of its own. A descent
 * that ends on a saddle goes on from both sides of it. */

enum { ESCAPES = 4, ENDS = ESCAPES + 1, LEAST = 10 };

typedef struct task {
    ves_descent descent;
    bool checks; /* second order */
    ves_saddle saddle;
    const ves_point *start;
    int waiting; /* points to descend from */
    ves_point wait[ENDS + 1];
    int ends;
    ves_end end[ENDS + 1];
    int escapes, halves;      /* saddles; those that were left to one side only */
    double curvature, height; /* of the first saddle met */
    int mostly;
    bool stuck; /* a saddle that could not be left */
    bool memory;
} task;

typedef struct polish {
    ves_session *session;
    int tasks, first;
    long proofs; /* that may be asked for */
    task *task;
} polish;

static bool task_create(task *t, ves_session *session, int index, const ves_polish *options, long budget)
{
    if (!ves_descent_create(&t->descent, session, index, options, budget)) return false;
    t->start = &session->end[index].point;
    t->checks = !options->stay && t->descent.recipe.gradient && session->problem->gradients &&
                session->n <= VES_SADDLE_MOST;
    for (int k = 0; k < ENDS + 1; k++) {
        if (!ves_point_create(&session->arena, session->n, session->m, &t->wait[k])) return false;
        if (!ves_point_create(&session->arena, session->n, session->m, &t->end[k].point)) return false;
    }
    return !t->checks || ves_saddle_create(&t->saddle, session);
}

/* Steps off the saddle; what lies lower waits for its own descent. Returns whether there was a way. */
static ves_status leave(task *t, const ves_point *saddle, bool *left)
{
    ves_point *const side[2] = {&t->wait[t->waiting], &t->wait[t->waiting + 1]};
    bool found[2];
    if (!t->escapes++) {
        t->curvature = t->saddle.lowest;
        t->mostly = t->saddle.mostly;
        t->height = saddle->verdict.value;
    }
    ves_status status = ves_saddle_leave(&t->saddle, &t->descent, side, found);
    if (found[1] && !found[0]) {
        ves_point moved = *side[0];
        t->wait[t->waiting] = *side[1];
        t->wait[t->waiting + 1] = moved;
    }
    t->waiting += found[0] + found[1];
    t->halves += found[0] != found[1];
    *left = found[0] || found[1];
    return status;
}

/* One descent and what follows from it. */
static ves_status advance(task *t)
{
    ves_session *session = t->descent.session;
    ves_end *end = &t->end[t->ends++];
    ves_point *from = &t->wait[--t->waiting];
    end->saddle = false;
    VES_TRY(ves_descent_run(&t->descent, from, &end->point));
    long cost = 2L * session->n + 20;
    if (!t->checks || t->descent.budget - t->descent.used < cost) return VES_OK;
    VES_TRY(ves_saddle_check(&t->saddle, &t->descent, &end->point, &end->saddle));
    if (!end->saddle) return VES_OK;
    bool left = false;
    if (t->escapes < ESCAPES) VES_TRY(leave(t, &end->point, &left));
    if (left)
        t->ends--; /* it was a pass, not an end */
    else
        t->stuck = true;
    return VES_OK;
}

static void run(void *data, int worker, int index)
{
    polish *p = data;
    task *t = &p->task[p->first + index];
    t->descent.asker.worker = worker;
    ves_point_copy(&t->wait[0], t->start, p->session->n, p->session->m);
    t->waiting = 1;
    while (t->waiting) {
        ves_status status = advance(t);
        if (status == VES_MEMORY) t->memory = true;
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

static void note_saddles(polish *p)
{
    const task *first = NULL;
    int met = 0, stuck = 0, saddles = 0, halves = 0;
    for (int k = 0; k < p->tasks; k++) {
        if (!p->task[k].escapes) continue;
        if (!first) first = &p->task[k];
        met++;
        stuck += p->task[k].stuck;
        saddles += p->task[k].escapes;
        halves += p->task[k].halves;
    }
    if (!met) return;
    const char *way = halves == 0        ? "left it both ways"
                      : halves < saddles ? "left it, not always both ways"
                                         : "left it one way";
    ves_session_note(p->session,
                     "%d of %d polish%s met a saddle (value %.9g): found a direction of negative curvature "
                     "(eigenvalue %.3g, "
                     "mostly %s); %s",
                     met, p->tasks, p->tasks == 1 ? "" : "es", first->height, first->curvature,
                     name_variable(p->session, first->mostly), stuck ? "not every one could be left" : way);
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
    for (int k = 1; k < p->tasks; k++) {
        const task *t = &p->task[k];
        if (ves_session_better(session, &t->end[0].point.verdict, &best->end[0].point.verdict)) best = t;
    }
    const ves_descent *descent = &best->descent;
    ves_session_stop(session, ves_descent_spent(descent) ? VES_ENDED_BUDGET : VES_ENDED_DONE, "%s: %s",
                     options->algorithm, ves_descent_sentence(descent));
}

static ves_status collect(polish *p)
{
    ves_session *session = p->session;
    int count = 0;
    for (int k = 0; k < p->tasks; k++) count += p->task[k].ends;
    ves_end *end = ves_session_ends(session, count);
    ves_point **point = ves_arena_take(&session->arena, (size_t)count, sizeof *point);
    bool *refused = ves_arena_take(&session->arena, (size_t)count, sizeof *refused);
    if (!end || !point || !refused) return VES_MEMORY;
    int at = 0;
    for (int k = 0; k < p->tasks; k++)
        for (int e = 0; e < p->task[k].ends; e++, at++) {
            ves_point_copy(&end[at].point, &p->task[k].end[e].point, session->n, session->m);
            end[at].saddle = p->task[k].end[e].saddle;
        }
    ves_session_sort(session, end, count);
    for (int k = 0; k < count; k++) point[k] = &end[k].point;
    if (count) {
        session->end = end;
        session->ends = count;
    }
    return ves_session_offer(session, point, count, p->proofs, refused);
}

/* Tasks run in waves of as many as there are workers, so that progress is told between; they do not depend on
 * one another. */
static ves_status work(polish *p)
{
    ves_session *session = p->session;
    int wave = ves_pool_workers(session->pool);
    for (p->first = 0; p->first < p->tasks && !ves_session_over(session); p->first += wave) {
        int count = p->tasks - p->first < wave ? p->tasks - p->first : wave;
        ves_pool_run(session->pool, count, run, p);
        for (int k = 0; k < count; k++) {
            ves_asker_flush(&p->task[p->first + k].descent.asker);
            ves_session_progress(session);
            if (p->task[p->first + k].memory) session->fault = VES_MEMORY;
        }
        if (session->fault) return session->fault;
    }
    return VES_OK;
}

/* Few evaluations are better spent on few descents that arrive. */
static int population(const ves_session *session, const ves_polish *options, long budget)
{
    long most = budget / (LEAST * (2 + (long)session->n));
    int wanted = options->starts && options->starts < session->ends ? options->starts : session->ends;
    return most < 1 ? 1 : wanted < most ? wanted : (int)most;
}

static void set_price(polish *p)
{
    double least = HUGE_VAL;
    for (int k = 0; k < p->tasks; k++) {
        double price = p->task[k].descent.price;
        if (price > 0 && price < least) least = price;
    }
    if (least < HUGE_VAL) p->session->price = least;
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
    if (session->price == 0) set_price(&p);
    if (status == VES_OK) {
        tell_stop(&p, options);
        note_saddles(&p);
        status = note_mended(&p);
        if (status == VES_OK) status = collect(&p);
    }
    for (int k = 0; k < p.tasks; k++) ves_descent_destroy(&p.task[k].descent);
    return status;
}

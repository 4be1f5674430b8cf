#include <math.h>
#include <string.h>

#include "search/descent.h"
#include "search/strategy/strategy.h"

/* Basin hopping [Li and Scheraga 1987; Wales and Doye 1997], monotonic [Leary 2000]: a descent from a point
 * beside the current minimum; a lower end is the next one. What is new to it are steps by the difference of two
 * minima that are known, as differential evolution makes them of points [Storn and Price 1997]: where minima
 * repeat themselves, along whatever directions, such steps lead from one to another. Kernels share the hops by
 * success. A round is `WIDTH` hops from one place, whatever the number of workers. After a drought the next
 * descents begin at random points, and the best of their ends is the next place.
 * test  tests/search_strategy.c */

enum { FALLS = 16, TRIES = 24, OTHERS = 6 };

enum { WIDTH = 4, KERNELS = 4, COORDINATES = 0, ALL = 1, DIFFERENCE = 2, BLIND = 3 };

static const double forget = 0.97; /* of what kernels have earned, each round */
static const double decades = 1.5; /* of widths below the range */
/* Hops without gain, which grow with each turn. Constraints leave few basins: hops fall back into the same one. */
static const double first_patience = 16, among_constraints = 2, impatience = 1.2;
static const double alike = 1e-6; /* relative: values of one minimum */
static const double first_step = 0.06;
static const double at_minima = 0.005, at_random = 0.1; /* first steps of descents without gradients */

/* What kernels are believed to earn before they are tried: as much as in so many trials. */
static const double hope[BLIND] = {0.5, 2, 0.5}, doubt = 6;

/* How far the last descents of a kernel have fallen. */
typedef struct falls {
    double fall[FALLS];
    long count;
} falls;

typedef struct task {
    ves_descent descent;
    ves_point from, end;
    int kernel, tries;
    double start; /* value that it descended from */
    long looks;   /* evaluations before the descent */
    ves_random random;
} task;

typedef struct hop {
    ves_team *team;
    ves_session *session;
    uint32_t stream;
    bool slopes;      /* descents follow gradients */
    ves_polish quick; /* only to tell where a descent leads */
    task task[WIDTH];
    ves_asker *asker[WIDTH];
    ves_point current;
    long rounds, drought, turns;
    double patience;
    double step;                           /* of the hops along all coordinates */
    double cost[KERNELS], earned[KERNELS]; /* evaluations, and new minima for them */
    falls fall[KERNELS];
} hop;

static void *create(ves_team *team, uint32_t stream)
{
    ves_session *session = team->session;
    hop *h = ves_arena_take(&session->arena, 1, sizeof *h);
    if (!h) return NULL;
    *h = (hop){.team = team,
               .session = session,
               .stream = stream,
               .step = first_step,
               .patience = session->m ? among_constraints : first_patience};
    h->slopes = session->problem->gradients;
    h->quick = ves_descent_quick(session, h->slopes);
    for (int k = 0; k < WIDTH; k++) {
        task *t = &h->task[k];
        if (!ves_descent_create(&t->descent, session, k, &h->quick, 0)) return NULL;
        t->descent.runs = 1;
        t->descent.window = h->slopes ? 10 : 10 + 10 * session->n;
        h->asker[k] = &t->descent.asker;
        if (!ves_point_create(&session->arena, session->n, session->m, &t->from)) return NULL;
        if (!ves_point_create(&session->arena, session->n, session->m, &t->end)) return NULL;
    }
    return ves_point_create(&session->arena, session->n, session->m, &h->current) ? h : NULL;
}

static void destroy(void *state)
{
    hop *h = state;
    for (int k = 0; k < WIDTH; k++) ves_descent_destroy(&h->task[k].descent);
}

/* --- where to descend from --- */

static int kernel_draw(const hop *h, ves_random *random)
{
    double weight[KERNELS], sum = 0, each = 10 + 2 * h->session->n;
    for (int k = 0; k < BLIND; k++) sum += weight[k] = (h->earned[k] + hope[k]) / (h->cost[k] / each + doubt);
    if (h->team->archive.count < 2 * WIDTH) sum -= weight[DIFFERENCE], weight[DIFFERENCE] = 0;
    double r = sum * ves_random_uniform(random);
    int k = 0;
    while (k < BLIND - 1 && r >= weight[k]) r -= weight[k++];
    return k;
}

/* One, two, three ... coordinates, each anywhere or by a step whose width is drawn log-uniformly. */
static void shake_some(const hop *h, ves_random *random, double *u)
{
    const int n = h->session->n;
    int count = 1;
    while (count < n && ves_random_uniform(random) < 0.5) count++;
    bool anywhere = ves_random_uniform(random) < 0.5;
    for (int k = 0; k < count; k++) {
        int i = ves_random_below(random, n);
        double width = pow(10, -decades * ves_random_uniform(random));
        u[i] = anywhere ? ves_random_uniform(random)
                        : ves_point_reflect(u[i] + width * ves_random_normal(random));
    }
}

static void shake_all(const hop *h, ves_random *random, double *u)
{
    for (int i = 0; i < h->session->n; i++)
        u[i] = ves_point_reflect(u[i] + h->step * ves_random_normal(random));
}

static double apart(const hop *h, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < h->session->n; i++) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

/* From one minimum to the nearest of some others. */
static void shake_alike(const hop *h, ves_random *random, double *u)
{
    const ves_archive *archive = &h->team->archive;
    int a = ves_random_below(random, archive->count), nearest = -1;
    const double *ua = archive->end[a].point.u;
    for (int k = 0; k < OTHERS || nearest < 0; k++) {
        int b = ves_random_below(random, archive->count);
        if (b == a) continue;
        if (nearest < 0 ||
            apart(h, ua, archive->end[b].point.u) < apart(h, ua, archive->end[nearest].point.u))
            nearest = b;
    }
    const double *ub = archive->end[nearest].point.u;
    double sign = ves_random_uniform(random) < 0.5 ? 1 : -1;
    for (int i = 0; i < h->session->n; i++) u[i] = ves_point_reflect(u[i] + sign * (ub[i] - ua[i]));
}

static void aim(hop *h, task *t, ves_random *random)
{
    const ves_session *session = h->session;
    bool lost = h->current.verdict.status != VES_OK;
    if (lost)
        for (int i = 0; i < session->n; i++) t->from.u[i] = ves_random_uniform(random);
    else {
        memcpy(t->from.u, h->current.u, (size_t)session->n * sizeof(double));
        (t->kernel == COORDINATES ? shake_some
         : t->kernel == ALL       ? shake_all
                                  : shake_alike)(h, random, t->from.u);
    }
    ves_point_place(session->problem, t->from.u, t->from.x);
    ves_point_fail(&t->from);
}

static void prepare(hop *h, int k)
{
    task *t = &h->task[k];
    t->random =
        (ves_random){.seed = h->session->seed, .chain = h->stream + (uint32_t)k, .step = (uint64_t)h->rounds};
    t->tries = 0;
    bool lost = h->current.verdict.status != VES_OK;
    if (!h->rounds && h->team->best.verdict.status == VES_OK) {
        ves_point_copy(&t->from, &h->team->best, h->session->n, h->session->m);
        t->kernel = ALL;
        t->tries = TRIES;
    } else
        t->kernel = lost ? BLIND : kernel_draw(h, &t->random);
}

/* Descents from where this kernel leads have never fallen so far that one from here could be worth it. */
static bool beyond(const hop *h, const task *t)
{
    const falls *r = &h->fall[t->kernel];
    if (r->count < FALLS || h->session->m || t->from.verdict.status != VES_OK) return false;
    int deeper = 0;
    for (int k = 0; k < FALLS; k++) deeper += t->from.verdict.value - r->fall[k] < h->current.verdict.value;
    return deeper <= FALLS / 4;
}

static void run(void *data, int worker, int index)
{
    hop *h = data;
    task *t = &h->task[index];
    t->descent.asker.worker = worker;
    t->looks = 0;
    while (t->tries < TRIES && t->looks < t->descent.budget / 2) {
        aim(h, t, &t->random);
        t->tries++;
        t->looks++;
        ves_ask ask = {.x = t->from.x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
        if (ves_asker_judge(&t->descent.asker, &ask, &t->from.verdict) != VES_OK) return;
        ves_asker_record(&t->descent.asker, false, NAN, false);
        if (!beyond(h, t)) break;
    }
    t->descent.step = t->kernel == BLIND        ? at_random
                      : t->kernel == DIFFERENCE ? at_minima
                                                : fmax(1e-3, h->step);
    t->descent.budget -= t->looks;
    t->start = t->from.verdict.value;
    (void)ves_descent_run(&t->descent, &t->from, &t->end); /* a fault stands in the asker */
}

/* --- what came of it --- */

static void judge(hop *h, task *t)
{
    const ves_session *session = h->session;
    bool same = ves_archive_near(&h->team->archive, &t->end, &h->current);
    /* A shape that has only turned is the same, too. */
    same =
        same || fabs(t->end.verdict.value - h->current.verdict.value) <= alike * fabs(t->end.verdict.value);
    bool better = ves_session_better(session, &t->end.verdict, &h->current.verdict);
    ves_archive_add(&h->team->archive, &t->end);
    if (t->kernel == BLIND) ves_archive_add(&h->team->blind, &t->end);
    h->cost[t->kernel] += (double)(t->looks + t->descent.used);
    ves_team_take(h->team, &t->end);
    if (t->descent.hopeless) return;
    if (t->from.verdict.status == VES_OK && t->end.verdict.status == VES_OK) {
        falls *r = &h->fall[t->kernel];
        r->fall[r->count++ % FALLS] = t->start - t->end.verdict.value;
    }
    if (t->kernel == ALL) h->step = fmin(0.5, fmax(1e-4, h->step * (same ? 1.1 : 0.96)));
    if (!better) return;
    if (!same) {
        h->earned[t->kernel] += 1;
        h->drought = 0;
    }
    ves_point_copy(&h->current, &t->end, session->n, session->m);
}

/* After a drought: at random points, or at the best of all, in turns. */
static void turn_back(hop *h)
{
    h->drought = 0;
    h->patience *= impatience;
    h->step = first_step;
    if (h->turns++ % 2 && ves_session_better(h->session, &h->team->best.verdict, &h->current.verdict)) {
        ves_point_copy(&h->current, &h->team->best, h->session->n, h->session->m);
        return;
    }
    ves_point_fail(&h->current);
}

static ves_status hop_round(hop *h, long each)
{
    ves_session *session = h->session;
    const ves_verdict *current = &h->current.verdict;
    bool feasible = current->status == VES_OK && current->violation <= session->tolerance;
    const double rival = feasible ? current->value : HUGE_VAL;
    const int width = h->rounds ? WIDTH : 1;
    for (int k = 0; k < width; k++) {
        prepare(h, k);
        h->task[k].descent.used = 0;
        h->task[k].descent.budget = each;
        h->task[k].descent.rival = rival;
    }
    VES_TRY(ves_session_round(session, h->asker, width, run, h));
    if (session->m) {
        const double *price[WIDTH];
        for (int k = 0; k < width; k++) price[k] = h->task[k].descent.price;
        ves_session_raise(session, price, width);
        ves_archive_sort(&h->team->archive);
    }
    h->rounds++;
    h->drought += width;
    for (int k = 0; k < KERNELS; k++) h->cost[k] *= forget, h->earned[k] *= forget;
    for (int k = 0; k < width; k++) judge(h, &h->task[k]);
    if (h->drought > h->patience) turn_back(h);
    return VES_OK;
}

static void refused(void *state)
{
    hop *h = state;
    h->turns &= ~1L; /* not to the best of all */
    turn_back(h);
}

/* A descent that can do no more than look at the slope is none. */
static long least(const void *state)
{
    const hop *h = state;
    return (h->rounds ? WIDTH : 1) * 4 * (2 + (long)h->session->n);
}

static ves_status advance(void *state, long some, long most)
{
    hop *h = state;
    ves_session *session = h->session;
    const long before = session->evaluations, usual = ves_descent_usual(session->n, h->slopes);
    for (long used = 0; used < some && most - used >= least(h) && !ves_session_over(session);
         used = session->evaluations - before) {
        long each = (most - used) / (h->rounds ? WIDTH : 1);
        VES_TRY(hop_round(h, each < usual ? each : usual));
    }
    return VES_OK;
}

const ves_strategy ves_strategy_hop = {
    .name = "hop",
    .about = "basin hopping: descents from beside the best minimum, also by differences of known minima",
    .share = {0.35, 0.6, 0.7, 0.9},
    .create = create,
    .least = least,
    .advance = advance,
    .refused = refused,
    .destroy = destroy,
};

#include <math.h>
#include <stdio.h>

#include "search/session.h"

/* Are gradients those of the values? Everything that descends believes them, and one that is wrong looks like a budget
 * that is too short. So at the end of a search that has used them differences along one direction stand against them,
 * at a point near the start that is not special, as starts and optima are: at a small step, and where these are
 * more than a hundredth of the slope apart at one ten times smaller. Only what both agree on counts: truncation would
 * be a hundred times smaller there, rounding ten times larger, at a kink the two sides would differ. So a difference
 * by rounding is never told, nor a gradient that is wrong by less than a hundredth of the slope.
 * cost  one gradient and two values; two values more in doubt
 * test  right gradients of all scales, with rounding, noise, kinks and edges; wrong ones of many kinds */

enum { DEAR = 5, KEPT = VES_PROOFS / 2 };

static const double away = 0.01;                /* of the way from the start to a random point */
static const double large = 1e-3, small = 1e-4; /* steps, of each range */
static const double wrong = 0.01;               /* of the slope */
static const double agree = 0.1;      /* differences that agree do so within this part of what is doubted */
static const double rounding = 1e-10; /* of the value, over the step */

typedef struct doubt {
    ves_session *session;
    ves_asker asker;
    ves_verdict here, on, back; /* here: with slopes */
    double *u, *x, *way;        /* [n]; way: each 1 or -1 */
    double *first;              /* [1 + m] differences at the larger step; NAN: no doubt */
} doubt;

static bool create(doubt *d, ves_session *session)
{
    ves_arena *arena = &session->arena;
    size_t n = (size_t)session->n, m = (size_t)session->m;
    *d = (doubt){.session = session};
    double **const rows[] = {&d->u, &d->x, &d->way, &d->here.gradient};
    double **const columns[] = {&d->here.constraint, &d->on.constraint, &d->back.constraint};
    for (int k = 0; k < 4; k++)
        if (!(*rows[k] = ves_arena_take(arena, n, sizeof(double)))) return false;
    for (int k = 0; k < 3; k++)
        if (!(*columns[k] = ves_arena_take(arena, m, sizeof(double)))) return false;
    d->first = ves_arena_take(arena, 1 + m, sizeof(double));
    d->here.jacobian = ves_arena_take(arena, m * n, sizeof(double));
    return d->first && d->here.jacobian;
}

static double range(const doubt *d, int i)
{
    return d->session->problem->upper[i] - d->session->problem->lower[i];
}

static ves_status ask(doubt *d, double step, unsigned want, ves_verdict *verdict)
{
    const ves_search_problem *problem = d->session->problem;
    for (int i = 0; i < problem->n; i++) d->x[i] = ves_point_scale(problem, i, d->u[i] + step * d->way[i]);
    const ves_ask question = {.x = d->x, .cutoff = HUGE_VAL, .want = want};
    VES_TRY(ves_asker_judge(&d->asker, &question, verdict));
    ves_asker_record(&d->asker, want == VES_WANT_GRADIENT, NAN, false);
    return VES_OK;
}

/* Of row 0, the value, or of constraint row - 1. */
static double height(const ves_verdict *v, int row)
{
    return row ? v->constraint[row - 1] : v->value;
}

/* Along the way; size: how large it might be along any. */
static double slope(const doubt *d, int row, double *size)
{
    int n = d->session->n;
    const double *g = row ? d->here.jacobian + (size_t)(row - 1) * (size_t)n : d->here.gradient;
    double sum = 0;
    *size = 0;
    for (int i = 0; i < n; i++) {
        sum += g[i] * range(d, i) * d->way[i];
        *size += fabs(g[i] * range(d, i));
    }
    return sum;
}

/* The difference, where it is clear of the slope; else NAN. sides: how far apart those of the two sides are. Where
 * nothing changes at all there are steps in the value, or it knows of no variable. */
static double apart(const doubt *d, int row, double step, double *sides)
{
    double here = height(&d->here, row), on = height(&d->on, row), back = height(&d->back, row), size;
    double by = (on - back) / (2 * step), off = fabs(by - slope(d, row, &size));
    double noise = rounding * fmax(fabs(here), fmax(fabs(on), fabs(back))) / step;
    *sides = fabs(on - 2 * here + back) / step;
    if (on == here && back == here) return NAN;
    return off > wrong * fmax(size, fabs(by)) + noise ? by : NAN;
}

/* On both sides. Where one of them cannot be measured nothing is said. */
static ves_status look(doubt *d, double step, bool *seen)
{
    VES_TRY(ask(d, step, VES_WANT_VALUE, &d->on));
    VES_TRY(ask(d, -step, VES_WANT_VALUE, &d->back));
    *seen = d->on.status == VES_OK && d->back.status == VES_OK;
    return VES_OK;
}

/* Down the slope in every variable; where it has none, to the middle, for it may be forgotten there. */
static ves_status begin(doubt *d, bool *seen)
{
    const ves_session *session = d->session;
    ves_random random = {.seed = session->seed, .chain = UINT32_MAX - 1};
    for (int i = 0; i < session->n; i++) {
        double u = session->start.u[i] + away * (ves_random_uniform(&random) - session->start.u[i]);
        d->u[i] = fmin(fmax(u, 2 * large), 1 - 2 * large);
    }
    VES_TRY(ask(d, 0, VES_WANT_GRADIENT, &d->here));
    *seen = d->here.status == VES_OK;
    for (int i = 0; i < session->n && *seen; i++) {
        double g = d->here.gradient[i];
        d->way[i] = g > 0 || (g == 0 && d->u[i] > 0.5) ? -1 : 1;
    }
    return VES_OK;
}

static void tell(const doubt *d, int row, double by)
{
    double size, g = slope(d, row, &size);
    char what[64] = "value", whose[64] = "gradient";
    if (row) snprintf(what, sizeof what, "constraint %d", row);
    if (row) snprintf(whose, sizeof whose, "gradient of constraint %d", row);
    ves_session_note(
        d->session,
        "the %s seems to be wrong: near the start, along one direction, the slope of the %s is %.6g by "
        "differences and %.6g by the gradient (for the ranges of all variables). Nothing that went by "
        "it can be trusted: mend it, or search without gradients",
        whose, what, by, g);
}

static ves_status judge(doubt *d)
{
    bool seen, any = false;
    double sides, size;
    VES_TRY(begin(d, &seen));
    if (!seen) return VES_OK;
    VES_TRY(look(d, large, &seen));
    for (int row = 0; row <= d->session->m && seen; row++) {
        d->first[row] = apart(d, row, large, &sides);
        any = any || !isnan(d->first[row]);
    }
    if (!any) return VES_OK;
    VES_TRY(look(d, small, &seen));
    for (int row = 0; row <= d->session->m && seen; row++) {
        double by = apart(d, row, small, &sides), off = agree * fabs(by - slope(d, row, &size));
        if (!(fabs(by - d->first[row]) <= off && sides <= off)) continue;
        tell(d, row, by);
        return VES_OK;
    }
    return VES_OK;
}

ves_status ves_search_doubt(ves_session *session)
{
    doubt d;
    bool used = session->problem->gradients && session->gradients;
    if (!used || session->start.verdict.status != VES_OK || ves_session_over(session)) return VES_OK;
    if (session->budget - session->evaluations < DEAR + KEPT) return VES_OK;
    if (!create(&d, session)) return VES_MEMORY;
    ves_asker_init(&d.asker, session, -1);
    ves_status status = judge(&d);
    d.asker.failed = 0; /* nobody wanted these */
    ves_asker_flush(&d.asker);
    ves_asker_destroy(&d.asker);
    return status == VES_INTERRUPTED ? VES_OK : status;
}

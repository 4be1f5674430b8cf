#include "search/kkt.h"

#include <math.h>
#include <string.h>

#include "base/basis.h"
#include "search/saddle.h"

/* Karush-Kuhn-Tucker conditions [Nocedal and Wright 2006, 12.3]; least-squares multipliers that are not negative
 * (saddle.c). They are unique when the slopes of all that touches the best, bounds too, are independent.
 * test  tests/search_honest.c: closed forms; the problem solved again with a limit moved */

static const double part = 1e-4; /* of the objective: as saddle.c, no slope below it says much */
static const double wall = 1e-9; /* in u */
static const double independent =
    1e-5; /* what is left of a slope beside the others: the best is exact to 1e-6 */

typedef struct work {
    ves_session *session;
    ves_descent descent;
    ves_saddle saddle;
    double start; /* |grad f| there */
} work;

static double norm_f(const ves_descent *d)
{
    double sum = 0;
    for (int i = 0; i < d->session->n; i++) {
        double g = d->last.gradient[i] * d->range[i];
        sum += g * g;
    }
    return sqrt(sum);
}

/* Whether the slopes of the touching constraints are independent in the variables that stand at no bound. */
static bool unique(const work *w, double *row)
{
    const ves_saddle *s = &w->saddle;
    const ves_descent *d = &w->descent;
    const int n = d->session->n;
    for (int r = 0; r < s->near; r++) {
        double *q = row + r * n, size = 0;
        for (int i = 0; i < n; i++) {
            bool off = s->base[i] > wall && s->base[i] < 1 - wall;
            double g = d->last.jacobian[s->touched[r] * n + i] * d->range[i];
            q[i] = off ? g : 0;
            size += g * g;
        }
        double left = ves_basis_strip_all(n, row, r, q, NULL);
        if (!(left > independent * sqrt(size))) return false;
        for (int i = 0; i < n; i++) q[i] /= left;
    }
    return true;
}

static ves_status fill(work *w, ves_kkt *kkt)
{
    ves_session *session = w->session;
    const ves_saddle *s = &w->saddle;
    const ves_descent *d = &w->descent;
    const int n = session->n, m = session->m;
    double *multiplier = ves_arena_take(&session->kept, (size_t)m, sizeof(double));
    double *bound = ves_arena_take(&session->kept, (size_t)n, sizeof(double));
    double *row = ves_arena_take(&session->arena, (size_t)s->near * (size_t)n, sizeof(double));
    if (!multiplier || !bound || !row) return VES_MEMORY;
    if (m) memcpy(multiplier, s->multiplier, (size_t)m * sizeof *multiplier);
    for (int i = 0; i < n; i++) bound[i] = s->slope[i] / d->range[i];
    double sum = 0;
    for (int k = 0; k < s->frees; k++) {
        int i = s->free[k];
        sum += s->slope[i] * s->slope[i];
        bound[i] = 0;
    }
    double size = fmax(fmax(norm_f(d), w->start), part * fabs(d->last.value));
    *kkt = (ves_kkt){.known = true,
                     .slope = sqrt(sum),
                     .residual = size > 0 ? sqrt(sum) / size : 0,
                     .unique = unique(w, row),
                     .multiplier = multiplier,
                     .bound = bound};
    return VES_OK;
}

static ves_status find(work *w, const ves_point *best, ves_kkt *kkt)
{
    ves_session *session = w->session;
    ves_descent *d = &w->descent;
    const ves_point *start = &session->start;
    if (d->budget > 1 && start->verdict.status == VES_OK) {
        VES_TRY(ves_descent_look(d, start->u, true));
        if (d->last.status == VES_OK) w->start = d->first_scale = norm_f(d);
    }
    VES_TRY(ves_saddle_slopes(&w->saddle, d, best->u));
    return d->last.status == VES_OK ? fill(w, kkt) : VES_OK;
}

ves_status ves_kkt_find(ves_session *session, const ves_point *best, long evaluations, ves_kkt *kkt)
{
    *kkt = (ves_kkt){.slope = NAN, .residual = NAN};
    if (!session->problem->gradients || evaluations < 1 || ves_session_over(session)) return VES_OK;
    work w = {.session = session};
    ves_polish options = {0};
    options.algorithm = ves_search_algorithm(session->problem, &options);
    if (!ves_descent_create(&w.descent, session, -1, &options, evaluations)) return VES_MEMORY;
    ves_status status = VES_MEMORY;
    if (ves_saddle_create(&w.saddle, session, false)) {
        ves_point_copy(&w.descent.best, best, session->n, session->m);
        status = find(&w, best, kkt);
    }
    ves_asker_flush(&w.descent.asker);
    ves_descent_destroy(&w.descent);
    return status == VES_INTERRUPTED || status == VES_NO_NUMBER ? VES_OK : status;
}

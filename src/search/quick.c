#include <math.h>
#include <string.h>

#include "search/descent.h"

/* What makes a descent quicker than its algorithm: a better place to begin, and an end before it is reached. */

enum { STRIDES = 20, WINDOWS = 30 };

static const double stride = 0.05, flatter = 0.3; /* of the box; of the slope before */

/* slsqp pays for its own O(n^3) in each step, and takes about twice the steps on rugged ground (docs/methods/hop.md);
 * lbfgs knows no constraints. */
ves_polish ves_descent_quick(const ves_session *session, bool slopes)
{
    ves_polish quick = {.f_tolerance = 1e-10};
    if (session->m) {
        quick.algorithm = slopes ? "slsqp" : "cobyla";
        quick.x_tolerance = slopes ? 1e-8 : 1e-5;
    } else if (slopes) {
        quick.algorithm = "lbfgs";
        quick.x_tolerance = 1e-5;
    } else {
        quick.algorithm = session->n < 2 ? "cobyla" : "bobyqa";
        quick.x_tolerance = 3e-4;
    }
    return quick;
}

long ves_descent_usual(int n, bool slopes)
{
    return 100 + (slopes ? 20 : 60) * (long)n;
}

/* Walks off a place where the slopes are of another size than everywhere else: scaled by them, no algorithm
 * would see the rest. Steps of a part of the box down the slope, as long as each leads to far less of it. */
ves_status ves_descent_relax(ves_descent *d, ves_point *point)
{
    const int n = d->session->n;
    VES_TRY(ves_descent_look(d, point->u, true));
    memcpy(d->route, point->u, (size_t)n * sizeof(double));
    for (int k = 0; k < STRIDES && d->last.status == VES_OK; k++) {
        double steep = ves_descent_steepest(d);
        for (int i = 0; steep > 0 && i < n; i++) {
            double to = d->route[i] - stride * d->last.gradient[i] * d->range[i] / steep;
            d->route[i] = to < 0 ? 0 : to > 1 ? 1 : to;
        }
        VES_TRY(ves_descent_look(d, d->route, true));
        if (d->last.status != VES_OK || !(ves_descent_steepest(d) < flatter * steep)) break;
    }
    if (d->best.verdict.status == VES_OK) ves_point_copy(point, &d->best, n, d->session->m);
    return VES_OK;
}

/* Falling on as in the last window, it would take more than a few of them to come below the rival. */
bool ves_descent_hopeless(ves_descent *d)
{
    const ves_verdict *best = &d->best.verdict;
    bool feasible = best->status == VES_OK && best->violation <= d->session->tolerance;
    double now = feasible ? best->value : HUGE_VAL;
    bool small = feasible && WINDOWS * (d->marked - now) < now - d->rival;
    d->mark = d->used;
    d->marked = now;
    return small;
}

#include <math.h>

#include "base/basis.h"
#include "search/descent.h"

/* SQP solves for all equations at once, which has no answer where their gradients depend on each other or
 * vanish, though the equations may well agree: an area said twice, or one that scale: has already met. So a
 * descent follows as many as are independent where it begins, and looks at the others where it ends. Gram-
 * Schmidt on the unit gradients in the unit box, the one that sticks out most next (Golub and Van Loan,
 * 5.4.2); violated equations come first. An inequality that these equations imply, to first order, is put off
 * like an equation: rounding would make it contradict them.
 * test  repeated, proportional, implied and empty equations; more of them than variables */

/* What sticks out of the others' span: for exact slopes, and for differences, whose noise is 1e-8. */
static const double alike[] = {1e-7, 1e-5};
static const double no_matter = 0.1; /* of the tolerance: what a slope may change across the box */

/* A row is a gradient and the constraint's value behind it, which follows every step of the elimination; both
 * over the constraint's size. */
static double *row_of(const ves_descent *d, int j)
{
    return d->row + (size_t)j * (size_t)(d->session->n + 1);
}

static void divide(int n, double *row, double by)
{
    for (int i = 0; i <= n; i++) row[i] /= by;
}

/* The value follows. */
static void subtract(int n, double *row, const double *unit)
{
    ves_basis_strip(n, n + 1, unit, row);
}

/* Returns the size of the gradient. */
static double read(ves_descent *d, int j)
{
    int n = d->session->n;
    double *row = row_of(d, j);
    for (int i = 0; i < n; i++) row[i] = d->last.jacobian[j * n + i] * d->range[i] / d->size[j];
    row[n] = d->last.constraint[j] / d->size[j];
    return ves_basis_size(n, row);
}

static bool violated(const ves_descent *d, int j)
{
    double c = d->last.constraint[j];
    return (ves_session_equality(d->session, j) ? fabs(c) : c) > d->session->tolerance;
}

/* Of the equations put off, the one to be followed next; -1: none is independent of those that are. */
static int next(const ves_descent *d)
{
    int best = -1;
    double most = 0, least = alike[!d->session->problem->gradients];
    for (int j = 0; j < d->session->m; j++) {
        double out = d->hold[j] == VES_HOLD_LATER ? ves_basis_size(d->session->n, row_of(d, j)) : 0;
        if (out <= least) continue;
        bool before = best >= 0 && violated(d, j) != violated(d, best) ? violated(d, j) : out > most;
        if (!before) continue;
        best = j;
        most = out;
    }
    return best;
}

static void choose(ves_descent *d)
{
    int n = d->session->n;
    for (int taken; (taken = next(d)) >= 0;) {
        double *unit = row_of(d, taken);
        d->hold[taken] = VES_HOLD_NLOPT;
        divide(n, unit, ves_basis_size(n, unit));
        for (int j = 0; j < d->session->m; j++)
            if (d->hold[j] == VES_HOLD_LATER) subtract(n, row_of(d, j), unit);
    }
}

static bool implied(ves_descent *d, int j)
{
    int n = d->session->n;
    double tolerance = d->session->tolerance / d->size[j], length = read(d, j), *row = row_of(d, j);
    for (int pass = 0; pass < 2; pass++)
        for (int k = 0; k < d->session->m; k++)
            if (d->hold[k] == VES_HOLD_NLOPT && ves_session_equality(d->session, k))
                subtract(n, row, row_of(d, k));
    double out = fmax(alike[!d->session->problem->gradients] * length, no_matter * tolerance);
    return ves_basis_size(n, row) <= out && row[n] <= tolerance;
}

void ves_rows_choose(ves_descent *d)
{
    const ves_session *session = d->session;
    for (int j = 0; j < session->m; j++) {
        if (d->hold[j] != VES_HOLD_NLOPT || !ves_session_equality(session, j)) continue;
        double length = read(d, j);
        bool matters = length > no_matter * session->tolerance / d->size[j];
        divide(session->n, row_of(d, j), matters ? length : HUGE_VAL);
        d->hold[j] = VES_HOLD_LATER;
    }
    choose(d);
    for (int j = 0; j < session->m; j++)
        if (d->hold[j] == VES_HOLD_NLOPT && !ves_session_equality(session, j) && implied(d, j))
            d->hold[j] = VES_HOLD_LATER;
}

bool ves_rows_owing(const ves_descent *d)
{
    for (int j = 0; j < d->session->m; j++)
        if (d->hold[j] == VES_HOLD_LATER && violated(d, j)) return true;
    return false;
}

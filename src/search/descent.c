#include "search/descent.h"

#include <math.h>
#include <string.h>

/* Scaling is what decides whether SQP works: F = (f - f_0) / max_i |df/du_i|, u in the unit box, c /
 * max(|c_0|, max_i |dc/du_i|): a constraint may be told in any units, if only its tolerance is told in them
 * too. What NLopt returns is not looked at but for the reason: the best is what we have seen ourselves. */

enum { RUNS = 5, CHOICES = 3 };

/* NLopt's own loops: questions in a row for one point (they come by threes, and a model that is stiffened ten
 * times each until it yields passes 300); steps for one dual problem, where NLopt itself allows ten times
 * that. */
enum { HANG = 2000, DUAL_STEPS = 10000 };
enum { PAIRS = 20 }; /* of steps and slopes that lbfgs keeps; unless told, NLopt takes ten megabytes */

static const double difference = 3e-8;    /* step in u: about sqrt(rounding) */
static const double proportional = 1e-12; /* exact slopes that differ by so little are those of one thing */
static const double squeezed =
    1e-6; /* in u: a line search that ends so near to a failed candidate ran into it */

/* Is constraint k the negative of constraint j, with all its slopes, each over its size? */
static bool opposite(const ves_descent *d, int j, int k)
{
    const int n = d->session->n;
    const double *a = d->last.jacobian + j * n, *b = d->last.jacobian + k * n;
    double size = d->size[j], other = d->size[k], most = 0, apart = 0;
    for (int i = 0; i < n; i++) {
        most = fmax(most, fabs(a[i] / size));
        apart = fmax(apart, fabs(a[i] / size + b[i] / other));
    }
    double rounding = d->session->tight / fmin(size, other);
    return apart < proportional * most &&
           fabs(d->last.constraint[j] / size + d->last.constraint[k] / other) <= rounding;
}

/* A dual problem has no bound where the constraints leave no room, and two halves of an equation leave none.
 */
static void join(ves_descent *d)
{
    for (int j = 0; j < d->session->m; j++)
        for (int k = j + 1; d->hold[j] == VES_HOLD_NLOPT && k < d->session->m; k++)
            if (d->hold[k] == VES_HOLD_NLOPT && opposite(d, j, k)) {
                d->hold[j] = VES_HOLD_EQUAL;
                d->hold[k] = VES_HOLD_TWIN;
            }
}

/* NLopt takes no more equations than variables. */
static bool too_many(const ves_descent *d)
{
    int count = 0;
    for (int j = 0; j < d->session->m; j++)
        count += d->hold[j] == VES_HOLD_NLOPT && ves_session_equality(d->session, j);
    return count > d->session->n;
}

/* Decides who sees to each constraint; where the last candidate tells, joins opposite ones and puts off what
 * depends on others. */
static void share(ves_descent *d, bool told)
{
    for (int j = 0; j < d->session->m; j++) {
        bool equal = ves_session_equality(d->session, j);
        bool held = d->halfway || (equal ? d->recipe.equalities : d->recipe.inequalities);
        d->hold[j] = !held ? VES_HOLD_NLOPT : equal ? VES_HOLD_EQUAL : VES_HOLD_BELOW;
    }
    if (d->recipe.dual && told) join(d);
    if (d->recipe.gradient && told) ves_rows_choose(d);
    bool many = too_many(d);
    for (int j = 0; many && j < d->session->m; j++)
        if (d->hold[j] == VES_HOLD_NLOPT && ves_session_equality(d->session, j)) d->hold[j] = VES_HOLD_EQUAL;
    d->inequalities = d->equalities = 0;
    d->wrapped = false;
    for (int j = 0; j < d->session->m; j++) {
        if (d->hold[j] == VES_HOLD_LATER) continue;
        if (d->hold[j] != VES_HOLD_NLOPT)
            d->wrapped = true;
        else if (ves_session_equality(d->session, j))
            d->equality[d->equalities++] = j;
        else
            d->inequality[d->inequalities++] = j;
    }
}

static bool share_create(ves_descent *d)
{
    ves_arena *arena = &d->session->arena;
    size_t m = (size_t)d->session->m;
    d->inequality = ves_arena_take(arena, m, sizeof(int));
    d->equality = ves_arena_take(arena, m, sizeof(int));
    d->hold = ves_arena_take(arena, m, sizeof *d->hold);
    return d->inequality && d->equality && d->hold;
}

bool ves_descent_create(ves_descent *d, ves_session *session, int member, const ves_polish *options,
                        long budget)
{
    size_t n = (size_t)session->n, m = (size_t)session->m;
    ves_arena *arena = &session->arena;
    *d = (ves_descent){.session = session,
                       .options = options,
                       .budget = budget,
                       .runs = RUNS,
                       .rival = HUGE_VAL,
                       .step = 0.1};
    ves_asker_init(&d->asker, session, member);
    if (!share_create(d)) return false;
    d->recipe = ves_recipe_find(options->algorithm, session->n, session->problem->gradients);
    double **rows[] = {&d->range,        &d->route,        &d->u, &d->x, &d->shifted, &d->from, &d->broken,
                       &d->first_mended, &d->last.gradient};
    for (int k = 0; k < 9; k++)
        if (!(*rows[k] = ves_arena_take(arena, n, sizeof(double)))) return false;
    double **columns[] = {&d->measured, &d->shifted_constraint, &d->last.constraint, &d->multiplier, &d->size,
                          &d->price};
    for (int k = 0; k < 6; k++)
        if (!(*columns[k] = ves_arena_take(arena, m, sizeof(double)))) return false;
    d->last.jacobian = ves_arena_take(arena, m * n, sizeof(double));
    d->row = ves_arena_take(arena, m * (n + 1), sizeof(double));
    if (!d->row || !ves_point_create(arena, session->n, session->m, &d->aside)) return false;
    for (int i = 0; i < session->n; i++)
        d->range[i] = session->problem->upper[i] - session->problem->lower[i];
    return d->last.jacobian && ves_point_create(arena, session->n, session->m, &d->best);
}

void ves_descent_destroy(ves_descent *d)
{
    ves_asker_destroy(&d->asker);
}

static ves_status halt(ves_descent *d, ves_status status)
{
    d->halted = true;
    d->asked = false;
    if (d->opt) nlopt_force_stop(d->opt);
    return status;
}

/* SLSQP would ask for ever. Another run may do better. */
static ves_status lose(ves_descent *d, const char *sentence)
{
    d->lost = sentence;
    d->asked = false;
    d->repeats = 0;
    if (d->opt) nlopt_force_stop(d->opt);
    return VES_NO_NUMBER;
}

void ves_descent_keep(const ves_descent *d, ves_point *point)
{
    ves_point from = {.verdict = d->last, .u = d->u, .x = d->x};
    ves_point_copy(point, &from, d->session->n, d->session->m);
    point->verdict.gradient = point->verdict.jacobian = NULL;
}

/* Returns whether the last candidate is the best. */
static bool remember(ves_descent *d)
{
    const ves_session *session = d->session;
    if (d->last.status != VES_OK) return false;
    if (session->m) memcpy(d->measured, d->last.constraint, (size_t)session->m * sizeof(double));
    if (!ves_session_better_at(session, d->price, &d->last, &d->best.verdict)) return false;
    ves_descent_keep(d, &d->best);
    return true;
}

/* Judges a candidate that has only one coordinate moved. The verdict's arrays are the spare ones. */
static ves_status shift(ves_descent *d, int i, double u, ves_verdict *verdict)
{
    memcpy(d->shifted, d->x, (size_t)d->session->n * sizeof(double));
    d->shifted[i] = ves_point_scale(d->session->problem, i, u);
    *verdict = (ves_verdict){.constraint = d->shifted_constraint};
    ves_ask ask = {.x = d->shifted, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    VES_TRY(ves_asker_judge(&d->asker, &ask, verdict));
    d->used++;
    ves_asker_record(&d->asker, false, NAN, false);
    return VES_OK;
}

/* Forward differences, backward at the upper wall and where the forward candidate fails; where both fail, or
 * the budget has no second one, the slope is 0. */
static ves_status slope(ves_descent *d, int i)
{
    const int n = d->session->n, m = d->session->m;
    ves_verdict near;
    double step = d->u[i] + difference <= 1 ? difference : -difference;
    VES_TRY(shift(d, i, d->u[i] + step, &near));
    if (near.status != VES_OK) {
        step = -step;
        double u = d->u[i] + step;
        bool affordable = d->budget - d->used > n - 1 - i; /* the others' come first */
        if (u >= 0 && u <= 1 && affordable) VES_TRY(shift(d, i, u, &near));
    }
    double h = d->shifted[i] - d->x[i];
    bool ok = near.status == VES_OK && h != 0;
    d->last.gradient[i] = ok ? (near.value - d->last.value) / h : 0;
    for (int j = 0; j < m; j++)
        d->last.jacobian[j * n + i] = ok ? (near.constraint[j] - d->last.constraint[j]) / h : 0;
    return VES_OK;
}

static bool all_finite(const double *value, int count)
{
    for (int k = 0; k < count; k++)
        if (!isfinite(value[k])) return false;
    return true;
}

/* Asks for the value alone: was it the slope that could not be had? */
static ves_status judge_plainly(ves_descent *d)
{
    const int n = d->session->n, m = d->session->m;
    ves_ask ask = {.x = d->x, .cutoff = HUGE_VAL, .want = VES_WANT_VALUE};
    ves_asker_record(&d->asker, true, NAN, false);
    VES_TRY(ves_asker_judge(&d->asker, &ask, &d->last));
    d->used++;
    for (int i = 0; i < n; i++) d->last.gradient[i] = NAN;
    for (int k = 0; k < n * m; k++) d->last.jacobian[k] = NAN;
    return VES_OK;
}

static bool has_slope(const ves_descent *d, int i)
{
    const int n = d->session->n;
    bool has = isfinite(d->last.gradient[i]);
    for (int j = 0; j < d->session->m; j++) has = has && isfinite(d->last.jacobian[j * n + i]);
    return has;
}

/* Differences stand in for exact slopes that are no numbers. */
static ves_status mend(ves_descent *d)
{
    const int n = d->session->n;
    int count = 0;
    for (int i = 0; i < n; i++) count += !has_slope(d, i);
    if (!count) return VES_OK;
    if (!d->mended++) memcpy(d->first_mended, d->x, (size_t)n * sizeof(double));
    d->spent = d->budget - d->used < count;
    if (d->spent) return VES_INTERRUPTED;
    for (int i = 0; i < n; i++)
        if (!has_slope(d, i)) VES_TRY(slope(d, i));
    return VES_OK;
}

static ves_status judge(ves_descent *d, bool slopes)
{
    const ves_session *session = d->session;
    bool exact = slopes && session->problem->gradients;
    ves_ask ask = {.x = d->x, .cutoff = HUGE_VAL, .want = exact ? VES_WANT_GRADIENT : VES_WANT_VALUE};
    ves_verdict *last = &d->last;
    VES_TRY(ves_asker_judge(&d->asker, &ask, last));
    d->used++;
    bool told = exact;
    if (exact && last->status == VES_NO_NUMBER && d->budget > d->used) {
        VES_TRY(judge_plainly(d));
        told = false;
    }
    if (last->status != VES_OK) {
        d->broke = true;
        memcpy(d->broken, d->u, (size_t)session->n * sizeof(double));
    }
    ves_asker_record(&d->asker, told, NAN, remember(d));
    if (d->rival < HUGE_VAL && d->used - d->mark >= d->window && ves_descent_hopeless(d)) {
        d->hopeless = true;
        return VES_INTERRUPTED;
    }
    if (exact && last->status == VES_OK) return mend(d);
    if (slopes && last->status == VES_OK)
        for (int i = 0; i < session->n; i++) VES_TRY(slope(d, i));
    return VES_OK;
}

ves_status ves_descent_look(ves_descent *d, const double *u, bool slopes)
{
    size_t bytes = (size_t)d->session->n * sizeof *u;
    if (d->asked && !memcmp(u, d->u, bytes) && (d->sloped || !slopes)) {
        if (ves_session_over(d->session)) return halt(d, VES_INTERRUPTED);
        if (++d->repeats <= HANG) return VES_OK;
        return lose(d, "the algorithm lost its way: it asked for the same point again and again");
    }
    d->repeats = 0;
    long cost = slopes && !d->session->problem->gradients ? 1 + (long)d->session->n : 1;
    if (d->budget - d->used < cost) {
        d->spent = true;
        return halt(d, VES_INTERRUPTED);
    }
    d->asked = false;
    if (!all_finite(u, d->session->n))
        return lose(d, "the algorithm lost its way: it asked for a point that is no number");
    for (int i = 0; i < d->session->n; i++) d->u[i] = u[i] < 0 ? 0 : u[i] > 1 ? 1 : u[i];
    ves_point_place(d->session->problem, d->u, d->x);
    ves_status status = judge(d, slopes);
    if (status != VES_OK) return halt(d, status);
    d->asked = true;
    d->sloped = slopes;
    return VES_OK;
}

/* Exact slopes come cheapest with the value: one question for each candidate. Differences only when they are
 * wanted. */
static ves_status look(ves_descent *d, const double *u, bool slopes)
{
    bool exact = d->recipe.gradient && d->session->problem->gradients;
    return ves_descent_look(d, u, slopes || exact);
}

/* A failed candidate is worse than all that was seen, but not by so much that models of f are spoiled. */
static double objective(unsigned n, const double *u, double *gradient, void *data)
{
    ves_descent *d = data;
    ves_status status = look(d, u, gradient != NULL);
    bool failed = status != VES_OK || d->last.status != VES_OK;
    for (unsigned i = 0; gradient && i < n; i++) {
        double slope = failed ? 0 : d->last.gradient[i] / d->scale;
        if (!failed && d->penalty > 0) slope += ves_lagrange_slope(d, (int)i);
        gradient[i] = slope * d->range[i] / d->shrink;
    }
    if (failed) return d->highest + 1 + (d->highest - d->lowest);
    double value = (d->last.value - d->offset) / d->scale;
    if (d->penalty > 0) value += ves_lagrange_value(d);
    value /= d->shrink;
    if (value < d->lowest) d->lowest = value;
    if (value > d->highest) d->highest = value;
    return value;
}

static void constraints(ves_descent *d, const int *index, unsigned count, double *result, unsigned n,
                        const double *u, double *gradient)
{
    ves_status status = look(d, u, gradient != NULL);
    bool failed = status != VES_OK || d->last.status != VES_OK;
    for (unsigned k = 0; k < count; k++) {
        int j = index[k];
        result[k] = (failed ? d->measured[j] : d->last.constraint[j]) / d->size[j];
        for (unsigned i = 0; gradient && i < n; i++)
            gradient[k * n + i] =
                failed ? 0 : d->last.jacobian[j * (int)n + (int)i] * d->range[i] / d->size[j];
    }
}

static void inequalities(unsigned count, double *result, unsigned n, const double *u, double *gradient,
                         void *data)
{
    ves_descent *d = data;
    constraints(d, d->inequality, count, result, n, u, gradient);
}

static void equalities(unsigned count, double *result, unsigned n, const double *u, double *gradient,
                       void *data)
{
    ves_descent *d = data;
    constraints(d, d->equality, count, result, n, u, gradient);
}

/* Tolerances are absolute in scaled quantities, which makes them relative to the range and to f itself. */
static nlopt_result tolerances(const ves_descent *d, nlopt_opt opt, double factor)
{
    double size = fmax(fabs(d->offset), 1e-6 * d->scale) / d->scale;
    nlopt_result code = nlopt_set_ftol_abs(opt, factor * d->options->f_tolerance * size);
    return code > 0 ? nlopt_set_xtol_abs1(opt, factor * d->options->x_tolerance) : code;
}

/* The unit box, or a part of it around the route when a run must not go far. */
static nlopt_result bounds(ves_descent *d)
{
    double *wall = d->shifted; /* spare here, and NLopt copies */
    for (int i = 0; i < d->session->n; i++) wall[i] = fmax(0, d->route[i] - d->reach);
    nlopt_result code = nlopt_set_lower_bounds(d->opt, wall);
    for (int i = 0; i < d->session->n; i++) wall[i] = fmin(1, d->route[i] + d->reach);
    return code > 0 ? nlopt_set_upper_bounds(d->opt, wall) : code;
}

/* What a violation may be and still be rounding, as NLopt sees it. */
static double *limits(ves_descent *d, const int *index, int count)
{
    double *limit = d->shifted_constraint; /* spare here, and NLopt copies */
    for (int k = 0; k < count; k++) limit[k] = d->session->tight / d->size[index[k]];
    return limit;
}

static nlopt_result set_up(ves_descent *d, double step, double factor)
{
    d->opt = nlopt_create(d->recipe.id, (unsigned)d->session->n);
    if (!d->opt) return NLOPT_OUT_OF_MEMORY;
    nlopt_result code = nlopt_set_min_objective(d->opt, objective, d);
    if (code > 0) code = bounds(d);
    if (code > 0) code = tolerances(d, d->opt, factor);
    if (code > 0 && !d->recipe.gradient) code = nlopt_set_initial_step1(d->opt, fmin(step, 0.4 * d->reach));
    if (code > 0 && d->recipe.dual) code = nlopt_set_param(d->opt, "dual_maxeval", DUAL_STEPS);
    if (code > 0 && d->recipe.id == NLOPT_LD_LBFGS) code = nlopt_set_vector_storage(d->opt, PAIRS);
    if (code > 0 && d->inequalities)
        code = nlopt_add_inequality_mconstraint(d->opt, (unsigned)d->inequalities, inequalities, d,
                                                limits(d, d->inequality, d->inequalities));
    if (code > 0 && d->equalities)
        code = nlopt_add_equality_mconstraint(d->opt, (unsigned)d->equalities, equalities, d,
                                              limits(d, d->equality, d->equalities));
    return code;
}

/* The largest slope at the candidate just looked at; without slopes, a guess from the spread or the size of
 * f. */
double ves_descent_steepest(const ves_descent *d)
{
    double most = 0;
    for (int i = 0; d->sloped && i < d->session->n; i++)
        most = fmax(most, fabs(d->last.gradient[i]) * d->range[i]);
    return most;
}

double ves_descent_slope(const ves_descent *d, int j)
{
    double most = 0;
    int n = d->session->n;
    for (int i = 0; i < n; i++) most = fmax(most, fabs(d->last.jacobian[j * n + i]) * d->range[i]);
    return most;
}

/* A multiplier is about the slope of f over that of the constraint, but many times that where constraints are
 * nearly parallel, or the slopes at the end are not those at the start. */
static void set_price(ves_descent *d)
{
    for (int j = 0; j < d->session->m; j++) d->price[j] = 1000 * d->first_scale / d->size[j];
}

static void resize(ves_descent *d)
{
    for (int j = 0; d->sloped && d->last.status == VES_OK && j < d->session->m; j++)
        d->size[j] = fmax(fmax(ves_descent_slope(d, j), fabs(d->last.constraint[j])), d->session->tolerance);
}

/* Scales f at u. A restart near a minimum keeps a part of the first scale: there the slopes are all but
 * gone. */
static ves_status rescale(ves_descent *d, const double *u, bool first)
{
    bool slopes = d->recipe.gradient || (first && d->budget - d->used > 10L * d->session->n);
    VES_TRY(ves_descent_look(d, u, slopes));
    bool told = slopes && d->last.status == VES_OK;
    resize(d);
    if (first || told) share(d, told);
    double size = fmax(fabs(d->last.value), d->session->spread);
    double most = ves_descent_steepest(d);
    if (first) {
        d->first_scale = most > 1e-12 * size ? most : size > 0 ? size : 1;
        d->scale = d->first_scale;
    } else
        d->scale = fmax(most, 1e-3 * d->first_scale);
    if (first) set_price(d);
    d->offset = d->last.value;
    d->lowest = d->highest = 0;
    return VES_OK;
}

ves_status ves_descent_minimise(ves_descent *d, double step, double factor)
{
    d->code = set_up(d, step, factor);
    double value;
    if (d->code > 0) d->code = nlopt_optimize(d->opt, d->route, &value);
    nlopt_destroy(d->opt);
    d->opt = NULL;
    if (d->code == NLOPT_OUT_OF_MEMORY) d->asker.fault = VES_MEMORY;
    return d->asker.fault == VES_MEMORY ? VES_MEMORY : VES_OK;
}

static ves_status once(ves_descent *d, double step)
{
    return d->wrapped ? ves_lagrange_run(d, step) : ves_descent_minimise(d, step, 1);
}

static bool progressed(const ves_descent *d, const ves_verdict *before, const ves_verdict *after)
{
    if (before->violation > d->session->tight && after->violation < 0.5 * before->violation) return true;
    double size = fmax(fabs(after->value), 1e-6 * d->first_scale);
    return before->value - after->value > 10 * d->options->f_tolerance * size;
}

static void forget(ves_descent *d, const ves_point *start)
{
    ves_point_copy(&d->best, start, d->session->n, d->session->m);
    for (int j = 0; j < d->session->m; j++) {
        d->measured[j] = start->verdict.constraint[j];
        d->size[j] = d->session->usual;
        d->price[j] = 0;
    }
    d->halted = d->spent = d->asked = d->hopeless = false;
    d->mark = d->used;
    d->marked = HUGE_VAL;
    d->scale = d->shrink = d->reach = 1;
    d->offset = d->lowest = d->highest = d->penalty = 0;
    d->choices = 0;
    d->turned = d->halfway = false;
}

/* A run that ends at a candidate that failed, or squeezed against one, has not converged, whatever NLopt
 * says: it saw a high plateau without slopes. The next one begins at our own best and goes less far: half the
 * way to the failure or, where that is next door, a step. Returns whether a next one is due. */
static bool ended_astray(ves_descent *d, double step)
{
    double way = 0;
    for (int i = 0; d->broke && i < d->session->n; i++) way = fmax(way, fabs(d->broken[i] - d->best.u[i]));
    bool last = d->asked && d->last.status != VES_OK;
    d->beside = d->broke && (last || way <= squeezed);
    if (d->beside || d->lost)
        d->reach = d->beside && way > squeezed ? 0.5 * way : step;
    else
        d->reach = 1;
    return d->beside || d->lost;
}

static ves_status descend(ves_descent *d, const ves_point *from, bool first, double step)
{
    d->lost = NULL;
    d->broke = d->beside = false;
    memcpy(d->route, from->u, (size_t)d->session->n * sizeof(double));
    ves_status status = rescale(d, from->u, first);
    if (status == VES_OK) status = once(d, step);
    return d->lost && status == VES_NO_NUMBER ? VES_OK : status;
}

/* Where a run ended some constraint that was put off may not hold: then the next one, which is due, begins
 * there and sees to it first; after some of these the augmented Lagrangian holds all. */
static ves_status look_back(ves_descent *d, bool *due)
{
    bool off = false;
    for (int j = 0; j < d->session->m; j++) off = off || d->hold[j] == VES_HOLD_LATER;
    d->turned = *due = false;
    if (!off || d->halted) return VES_OK;
    ves_status status = ves_descent_look(d, d->route, false);
    if (status != VES_OK) return d->lost && status == VES_NO_NUMBER ? VES_OK : status;
    *due = d->last.status == VES_OK && ves_rows_owing(d);
    d->turned = *due && d->choices++ < CHOICES;
    if (d->turned)
        ves_descent_keep(d, &d->aside);
    else if (*due)
        d->halfway = true;
    return VES_OK;
}

/* An algorithm that stopped beyond a constraint, where steps along it do not change the value, did not come back
 * to anything better than where it began: the next run, which is due, begins where it stopped. */
static bool go_on(ves_descent *d)
{
    bool beyond = d->recipe.gradient && d->asked && d->last.status == VES_OK &&
                  d->last.violation > d->session->tolerance;
    if (!beyond || d->halted || d->choices++ >= CHOICES) return false;
    ves_descent_keep(d, &d->aside);
    return true;
}

/* What a run that has nothing put off cannot meet contradicts the rest, as far as it can see: the augmented
 * Lagrangian meets it halfway. */
static bool contrary(const ves_descent *d)
{
    return d->recipe.gradient && d->best.verdict.violation > d->session->tolerance &&
           d->inequalities + d->equalities > 0;
}

ves_status ves_descent_run(ves_descent *d, const ves_point *start, ves_point *end)
{
    int n = d->session->n, m = d->session->m;
    forget(d, start);
    ves_point_copy(end, start, n, m);
    ves_status status = VES_OK;
    double step = d->step;
    bool due = true;
    if (d->recipe.gradient && d->session->problem->gradients && !m) status = ves_descent_relax(d, end);
    for (int k = 0; (k < d->runs || due) && status == VES_OK && !d->halted; k++, step *= 0.3) {
        bool limited = d->reach < 1;
        status = descend(d, d->turned ? &d->aside : end, k == 0, step);
        ves_verdict before = end->verdict;
        ves_point_copy(end, &d->best, n, m);
        bool astray = ended_astray(d, step);
        due = d->turned = false;
        if (astray || status != VES_OK) continue;
        status = look_back(d, &due);
        bool stuck = !due && !d->halted && !progressed(d, &before, &end->verdict);
        if (stuck && status == VES_OK && go_on(d)) {
            due = d->turned = true;
            continue;
        }
        if (!due && (stuck || !d->wrapped) && contrary(d))
            due = d->halfway = true;
        else if (stuck && k)
            break;
        due = due || limited; /* what stopped at the edge of its own reach has not converged */
    }
    return d->asker.fault ? d->asker.fault : status;
}

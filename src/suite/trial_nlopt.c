/* The algorithms of NLopt as methods, as a user would call them: in the unit box, with tolerances that let
 * local ones end, restarted from another random point when they do. Nothing is scaled for them. */
#include <math.h>
#include <nlopt.h>
#include <string.h>

#include "suite/instance.h"
#include "suite/trial.h"

/* A local search that moves less than this in the unit box, or changes the value by less, has converged: the
 * finest target is 1e-6. */
static const double x_tolerance = 1e-9, f_tolerance = 1e-11;

/* NLopt's augmented Lagrangian has been seen to ask for one point for ever (nlopt#538). How many such
 * questions, and how many runs without a single evaluation, are enough. */
enum { SPINS = 1000, IDLE = 20 };

typedef struct call {
    ves_trial *trial;
    ves_search_problem problem;
    nlopt_opt opt;
    double *u; /* [n] what `answer` answers */
    ves_verdict answer;
    bool known, sloped;
    double worst; /* of the values so far: candidates that fail are a little worse */
    int spins;
    ves_status status;
} call;

/* A constraint of NLopt: one of the problem. */
typedef struct row {
    call *c;
    int index;
} row;

static void ask(call *c, const double *u, bool slopes)
{
    size_t size = (size_t)c->problem.n * sizeof *u;
    if (c->known && (c->sloped || !slopes) && !memcmp(u, c->u, size)) return;
    const ves_ask question = {
        .x = u, .cutoff = HUGE_VAL, .want = slopes ? VES_WANT_GRADIENT : VES_WANT_VALUE};
    c->answer.status = VES_OK;
    c->answer.value = c->answer.violation = NAN;
    memcpy(c->u, u, size);
    c->known = true;
    c->sloped = slopes;
    c->status = c->problem.evaluate(c->problem.data, 0, &question, &c->answer);
    if (c->status != VES_OK) {
        c->answer.status = VES_NO_NUMBER;
        nlopt_force_stop(c->opt);
    }
    if (c->trial->stopped && c->trial->stopped(c->trial->data)) nlopt_force_stop(c->opt);
    if (c->answer.status == VES_OK && c->answer.value > c->worst) c->worst = c->answer.value;
}

static void take(const call *c, const double *slope, double *gradient)
{
    for (int i = 0; gradient && i < c->problem.n; i++)
        gradient[i] = c->answer.status == VES_OK ? slope[i] : 0;
}

static double objective(unsigned n, const double *u, double *gradient, void *data)
{
    call *c = data;
    long before = c->trial->meter->evaluations;
    (void)n;
    ask(c, u, gradient);
    c->spins = c->trial->meter->evaluations == before ? c->spins + 1 : 0;
    if (c->spins > SPINS) nlopt_force_stop(c->opt);
    take(c, c->answer.gradient, gradient);
    return c->answer.status == VES_OK ? c->answer.value : c->worst + 1 + fabs(c->worst);
}

static double constraint(unsigned n, const double *u, double *gradient, void *data)
{
    const row *r = data;
    ask(r->c, u, gradient);
    take(r->c, r->c->answer.jacobian + (size_t)r->index * n, gradient);
    return r->c->answer.status == VES_OK ? r->c->answer.constraint[r->index] : 1;
}

static bool tolerances(nlopt_opt opt)
{
    return nlopt_set_xtol_abs1(opt, x_tolerance) > 0 && nlopt_set_ftol_rel(opt, f_tolerance) > 0 &&
           nlopt_set_ftol_abs(opt, f_tolerance) > 0;
}

static bool wraps(const char *name)
{
    return strstr(name, "MLSL") || strstr(name, "AUGLAG");
}

/* What the algorithm does not take is told by NLopt itself. */
static bool constrain(call *c, row *rows)
{
    const ves_search_problem *p = &c->problem;
    const ves_meter *meter = c->trial->meter;
    bool own = meter->inequality <= 0;
    double tolerance = p->tolerance > 0 ? p->tolerance : VES_FEASIBLE;
    for (int j = 0; j < p->m; j++) {
        rows[j] = (row){c, j};
        bool equality = p->equality && p->equality[j];
        double allowed = own ? tolerance : equality ? meter->equality : meter->inequality;
        nlopt_result result = equality
                                  ? nlopt_add_equality_constraint(c->opt, constraint, &rows[j], allowed)
                                  : nlopt_add_inequality_constraint(c->opt, constraint, &rows[j], allowed);
        if (result > 0) continue;
        ves_trial_fail(c->trial, "NLopt's %s does not take %s", c->trial->method->algorithm,
                       equality ? "equations" : "inequalities");
        return false;
    }
    return true;
}

static bool set_local(call *c)
{
    const ves_method *e = c->trial->method;
    if (!e->local) return true;
    nlopt_opt local = nlopt_create(nlopt_algorithm_from_string(e->local), (unsigned)c->problem.n);
    bool good = local && tolerances(local) && nlopt_set_local_optimizer(c->opt, local) > 0;
    nlopt_destroy(local);
    if (!good) ves_trial_fail(c->trial, "NLopt's %s does not take %s inside", e->algorithm, e->local);
    return good;
}

static bool prepare(call *c, row *rows)
{
    const ves_method *e = c->trial->method;
    c->opt = nlopt_create(nlopt_algorithm_from_string(e->algorithm), (unsigned)c->problem.n);
    if (!c->opt) {
        ves_trial_fail(c->trial, "this NLopt was built without %s", e->algorithm);
        return false;
    }
    bool good = nlopt_set_lower_bounds1(c->opt, 0) > 0 && nlopt_set_upper_bounds1(c->opt, 1) > 0 &&
                nlopt_set_min_objective(c->opt, objective, c) > 0;
    if (good && !strstr(e->algorithm, "MLSL")) good = tolerances(c->opt);
    if (!good) ves_trial_fail(c->trial, "NLopt's %s does not take the problem", e->algorithm);
    return good && set_local(c) && constrain(c, rows);
}

/* Has it D in its name, or that inside? */
static bool wants_slopes(const ves_method *e)
{
    return strstr(e->algorithm, "D_") || (e->local && strstr(e->local, "D_"));
}

static ves_status descend(call *c)
{
    ves_trial *trial = c->trial;
    ves_meter *meter = trial->meter;
    for (int round = 0, idle = 0; !meter->over && !trial->failed; round++) {
        if (trial->stopped && trial->stopped(trial->data)) break;
        VES_TRY(ves_trial_start(trial));
        nlopt_srand((unsigned long)(ves_instance_hash("nlopt", trial->seed + (uint64_t)round) >> 33));
        nlopt_set_force_stop(c->opt, 0);
        c->known = false;
        c->spins = 0;
        long before = meter->evaluations;
        double value;
        nlopt_result result = nlopt_optimize(c->opt, trial->start, &value);
        if (meter->fault) return meter->fault;
        if (result == NLOPT_OUT_OF_MEMORY) return VES_MEMORY;
        const char *why = nlopt_get_errmsg(c->opt);
        if (result == NLOPT_INVALID_ARGS)
            ves_trial_fail(trial, "NLopt's %s does not take the problem%s%s", trial->method->algorithm,
                           why ? ": " : "", why ? why : "");
        idle = meter->evaluations == before ? idle + 1 : 0;
        if (idle > IDLE && !meter->over)
            ves_trial_fail(trial, "NLopt's %s ends without an evaluation", trial->method->algorithm);
    }
    return VES_OK;
}

ves_status ves_trial_nlopt(ves_trial *trial)
{
    call c = {.trial = trial, .problem = ves_meter_problem(trial->meter, trial->start), .worst = 0};
    size_t n = (size_t)c.problem.n, m = (size_t)c.problem.m;
    bool slopes = c.problem.gradients && !trial->method->values;
    if (!slopes && wants_slopes(trial->method)) {
        ves_trial_fail(trial, "NLopt's %s needs gradients, and there are none", trial->method->algorithm);
        return VES_OK;
    }
    ves_arena arena = {0};
    c.u = ves_arena_take(&arena, 2 * n + m + m * n, sizeof *c.u);
    row *rows = ves_arena_take(&arena, m, sizeof *rows);
    if (!c.u || !rows) {
        ves_arena_destroy(&arena);
        return VES_MEMORY;
    }
    c.answer.gradient = c.u + n;
    c.answer.constraint = c.u + 2 * n;
    c.answer.jacobian = c.u + 2 * n + m;
    ves_status status = prepare(&c, rows) ? descend(&c) : VES_OK;
    nlopt_destroy(c.opt);
    ves_arena_destroy(&arena);
    return status;
}

const char *ves_trial_algorithms(int k)
{
    return k >= 0 && k < NLOPT_NUM_ALGORITHMS ? nlopt_algorithm_to_string((nlopt_algorithm)k) : NULL;
}

bool ves_trial_algorithm(const char *name, bool *needs)
{
    const char *known;
    for (int k = 0; (known = ves_trial_algorithms(k)); k++)
        if (!strcmp(known, name)) {
            *needs = wraps(name);
            return true;
        }
    return false;
}

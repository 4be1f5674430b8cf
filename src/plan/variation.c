#include "plan/variation.h"

#include <math.h>
#include <string.h>

#include "base/diag.h"
#include "base/vector.h"

static const double STEP = 3e-5;     /* of the radius, of function 0 */
static const double UNSEEN = 1e-9;   /* relative: a motion changed nothing */
static const double NOTHING = 1e-9;  /* a motion that is none */
static const double TOUCHING = 1e-5; /* of its size: what an inequality may leave and yet hold the shape */

/* --- functions --- */

static double *function_at(const plan_variation *v, int which, int patch, int d, int k)
{
    const plan_meridian *m = v->shape.meridian;
    size_t before = 0;
    for (int p = 0; p < patch; p++) before += 3 * (size_t)(v->functions * m[p].nu);
    return v->basis[which] + before + (size_t)((d * v->functions + k) * m[patch].nu);
}

/* Legendre functions of cos S, of order n, orthonormal on a sphere's meridian: sin(S)^n q_k(cos S) by the recurrence of
 * q and its derivatives [Abramowitz and Stegun 1964, 8.5.3, normalised]. A smooth function of the surface of azimuthal
 * mode n vanishes like S^n at a pole. */
static double share(int l, int n)
{
    return sqrt((double)(l * l - n * n) / (4. * l * l - 1));
}

/* The last functions, one for each joint, have a jump of the second derivative there: x |x|, x = cos S - cos S of the
 * joint. They take away what the curvature of a design may jump by, which no sum of the smooth ones does. */
static void bend_at(double x, double q[3])
{
    q[0] = x * fabs(x), q[1] = 2 * fabs(x), q[2] = x < 0 ? -2 : 2;
}

static void functions_at(const plan_variation *v, int which, int patch, int i)
{
    const int n = v->n * which;
    const plan_meridian *m = &v->shape.meridian[patch];
    const double x = cos(m->S[0][i]), y = sin(m->S[0][i]), p = m->S[1][i], pp = m->S[2][i];
    double q[3] = {sqrt(0.5)}, before[3] = {0};
    for (int k = 1; k <= n; k++) q[0] *= sqrt((2 * k + 1) / (2. * k));
    const double s0 = pow(y, n), s1 = n ? n * pow(y, n - 1) * x : 0;
    const double s2 = (n > 1 ? n * (n - 1) * pow(y, n - 2) * x * x : 0) - n * s0;
    for (int k = 0; k < v->functions; k++) {
        const int bend = k - (v->functions - v->bends);
        if (bend >= 0) bend_at(x - cos(v->shape.meridian[bend].end), q);
        const double at = s0 * q[0], by = s1 * q[0] - s0 * y * q[1];
        const double twice = s2 * q[0] - 2 * s1 * y * q[1] + s0 * (y * y * q[2] - x * q[1]);
        function_at(v, which, patch, 0, k)[i] = at;
        function_at(v, which, patch, 1, k)[i] = by * p;
        function_at(v, which, patch, 2, k)[i] = twice * p * p + by * pp;
        if (bend >= 0) continue;
        const double up = share(n + k + 1, n), down = k ? share(n + k, n) : 0;
        const double next[3] = {(x * q[0] - down * before[0]) / up, (q[0] + x * q[1] - down * before[1]) / up,
                                (2 * q[1] + x * q[2] - down * before[2]) / up};
        memcpy(before, q, sizeof before);
        memcpy(q, next, sizeof q);
    }
}

void ves_variation_mode(plan_variation *v, int n)
{
    v->n = n;
    for (int k = 0; k < v->shape.patches; k++) {
        v->displacement[k].n = n;
        for (int i = 0; i < v->shape.meridian[k].nu; i++) functions_at(v, 1, k, i);
    }
    memset(v->wave, 0, sizeof(double) * (size_t)v->functions);
}

static void amplitude(const plan_variation *v, int which, const double *coefficient, double *const *to,
                      int patch)
{
    const int nu = v->shape.meridian[patch].nu;
    for (int d = 0; d < 3; d++) {
        memset(to[d], 0, sizeof(double) * (size_t)nu);
        for (int k = 0; k < v->functions; k++) {
            const double *f = function_at(v, which, patch, d, k);
            for (int i = 0; i < nu && coefficient[k] != 0; i++) to[d][i] += coefficient[k] * f[i];
        }
    }
}

/* --- making it --- */

static ves_status planes(double **plane, int count, int nu, ves_arena *arena)
{
    for (int k = 0; k < count; k++) {
        plane[k] = ves_arena_take(arena, (size_t)nu, sizeof(double));
        if (!plane[k]) return VES_MEMORY;
    }
    return VES_OK;
}

static ves_status displacements_make(plan_variation *v, ves_arena *arena)
{
    const int patches = v->shape.patches;
    size_t all = 0;
    v->displacement = ves_arena_take(arena, (size_t)patches, sizeof *v->displacement);
    v->metric = ves_arena_take(arena, (size_t)patches, sizeof *v->metric);
    if (!v->displacement || !v->metric) return VES_MEMORY;
    for (int k = 0; k < patches; k++) {
        const plan_meridian *m = &v->shape.meridian[k];
        plan_site *site = &v->plan->level[0].site[m->patch];
        plan_displacement *d = &v->displacement[k];
        memcpy(d->frame, v->shape.frame, sizeof d->frame);
        memcpy(d->radial, m->radial, sizeof d->radial);
        memcpy(d->axial, m->axial, sizeof d->axial);
        d->nu = m->nu, d->v = site->grid.v;
        VES_TRY(planes(d->even, 3, m->nu, arena));
        VES_TRY(planes(d->wave, 3, m->nu, arena));
        VES_TRY(planes(d->by, 3, m->nu, arena));
        VES_TRY(ves_metric_create(m->nu, arena, &v->metric[k]));
        site->displacement = d;
        all += 3 * (size_t)(m->nu * v->functions);
    }
    v->basis[0] = ves_arena_take(arena, all, sizeof(double));
    v->basis[1] = ves_arena_take(arena, all, sizeof(double));
    v->even = ves_arena_take(arena, (size_t)v->functions, sizeof(double));
    v->wave = ves_arena_take(arena, (size_t)v->functions, sizeof(double));
    for (int k = 0; k < 2; k++) v->side[k] = ves_arena_take(arena, (size_t)v->functions, sizeof(double));
    return v->basis[0] && v->basis[1] && v->even && v->wave && v->side[0] && v->side[1] ? VES_OK : VES_MEMORY;
}

/* Each judged measure must have a gradient, and read no more than the surfaces that are displaced. */
static ves_status measures_look(const ves_plan *plan, ves_diag *diag)
{
    const ves_problem *p = plan->problem;
    for (int m = 0; m < p->measures; m++) {
        const plan_instance *in = &plan->level[0].instance[m];
        bool elsewhere = false;
        if (!plan->runs[PROGRAM_JUDGE][m]) continue;
        for (int k = 0; k < in->input.samples; k++) elsewhere = elsewhere || in->site[k] >= p->patches;
        elsewhere = elsewhere || (p->measure[m].measure->shell && p->measure[m].measure->cost > 0);
        if (!p->measure[m].measure->gradient || elsewhere)
            return ves_diag_add(
                diag, VES_ERROR, VES_ABSENT, p->measure[m].mark,
                "%s: no stability with the measure \"%s\" (%s), which %s", p->name, p->measure[m].name,
                p->measure[m].measure->name,
                elsewhere
                    ? "reads more than surfaces: curves, places, caps or a shell, which are not displaced"
                    : "has no gradient");
    }
    return VES_OK;
}

/* What is read of them: an inequality that is not touched holds nothing. */
static void runs_choose(plan_variation *v)
{
    ves_plan *plan = v->plan;
    for (int m = 0; m < plan->problem->measures; m++) {
        bool used = ves_formula_uses_argument(plan->problem->objective, m);
        for (int k = 0; k < v->conditions; k++) {
            const plan_condition *c = &v->condition[k];
            used = used || c->measure == m ||
                   (c->left &&
                    (ves_formula_uses_argument(c->left, m) || ves_formula_uses_argument(c->right, m)));
        }
        plan->runs[PROGRAM_JUDGE][m] = used;
    }
}

/* scale:, solve:, equalities, and the inequalities that are met with equality. */
static ves_status conditions_make(plan_variation *v, ves_arena *arena)
{
    ves_plan *plan = v->plan;
    const ves_problem *p = plan->problem;
    v->condition = ves_arena_take(arena, (size_t)p->constraints + 2, sizeof *v->condition);
    for (int k = 0; k < 2; k++)
        v->missed[k] = ves_arena_take(arena, (size_t)p->constraints + 2, sizeof(double));
    v->against = ves_arena_take(arena, (size_t)p->constraints + 2, sizeof(double));
    if (!v->condition || !v->missed[0] || !v->missed[1] || !v->against) return VES_MEMORY;
    if (p->scale)
        v->condition[v->conditions++] = (plan_condition){.text = p->measure[p->scale->measure].name,
                                                         .measure = p->scale->measure,
                                                         .constraint = -1,
                                                         .turn = 1};
    if (p->solve)
        v->condition[v->conditions++] = (plan_condition){.text = "solve",
                                                         .left = p->solve->left,
                                                         .right = p->solve->right,
                                                         .measure = -1,
                                                         .constraint = -1,
                                                         .turn = 1};
    for (int k = 0; k < p->constraints; k++) {
        const ves_constraint_def *c = &p->constraint[k];
        const double turn = c->relation == VES_AT_LEAST ? -1 : 1;
        const double excess = turn * (ves_plan_formula(plan, c->left) - ves_plan_formula(plan, c->right));
        if (c->relation != VES_EQUAL && excess < -fmax(TOUCHING, c->within) * plan->size[k]) continue;
        v->condition[v->conditions++] = (plan_condition){.text = c->text,
                                                         .left = c->left,
                                                         .right = c->right,
                                                         .measure = -1,
                                                         .constraint = k,
                                                         .one_sided = c->relation != VES_EQUAL,
                                                         .turn = turn};
    }
    return VES_OK;
}

static double area(const plan_variation *v)
{
    double sum = 0;
    for (int k = 0; k < v->shape.patches; k++)
        for (int i = 0; i < v->shape.meridian[k].nu; i++) sum += v->metric[k].dA[i];
    return sum;
}

static double condition_value(const plan_variation *v, const plan_condition *c)
{
    ves_plan *plan = v->plan;
    if (c->measure >= 0) return plan->value[c->measure];
    return c->turn * (ves_plan_formula(plan, c->left) - ves_plan_formula(plan, c->right));
}

ves_status ves_variation_create(ves_plan *plan, int smooth, ves_arena *arena, plan_variation *v,
                                ves_diag *diag)
{
    *v = (plan_variation){.plan = plan, .functions = smooth, .sign = plan->problem->maximize ? -1 : 1};
    VES_TRY(ves_revolution_find(plan, arena, &v->shape, diag));
    v->bends = v->shape.patches - 1;
    v->functions += v->bends;
    if (displacements_make(v, arena) != VES_OK || conditions_make(v, arena) != VES_OK)
        return ves_diag_fail(diag, VES_MEMORY);
    runs_choose(v);
    VES_TRY(measures_look(plan, diag));
    plan->frozen = true;
    for (int k = 0; k < v->conditions; k++) v->condition[k].hold = condition_value(v, &v->condition[k]);
    for (int k = 0; k < v->shape.patches; k++)
        for (int i = 0; i < v->shape.meridian[k].nu; i++) functions_at(v, 0, k, i);
    ves_variation_mode(v, 0);
    for (int k = 0; k < v->shape.patches; k++) ves_metric_find(&v->shape.meridian[k], NULL, &v->metric[k]);
    v->unit = sqrt(area(v) / (4 * VES_PI));
    return VES_OK;
}

/* --- first variation --- */

ves_status ves_variation_value(plan_variation *v, double *objective, double *missed)
{
    for (int k = 0; k < v->shape.patches; k++) {
        amplitude(v, 0, v->even, v->displacement[k].even, k);
        amplitude(v, 1, v->wave, v->displacement[k].wave, k);
    }
    VES_TRY(ves_plan_run(v->plan, 0, PROGRAM_JUDGE, true));
    *objective = v->sign * ves_plan_formula(v->plan, v->plan->problem->objective);
    for (int k = 0; k < v->conditions; k++) {
        const plan_condition *c = &v->condition[k];
        /* an equality is met where the formula says so, what is only touched stays where it is */
        missed[k] = condition_value(v, c) - (c->measure >= 0 || c->one_sided ? c->hold : 0);
    }
    return isfinite(*objective) ? VES_OK : VES_NO_NUMBER;
}

static void seed(plan_variation *v, const ves_formula *formula, double by)
{
    ves_plan *plan = v->plan;
    if (by != 0)
        ves_formula_gradient(formula, plan->block, plan->value, by, plan->block_adjoint,
                             plan->measure_adjoint, plan->formula_room);
}

ves_status ves_variation_slope(plan_variation *v, double objective, const double *multiplier, double *slope)
{
    ves_plan *plan = v->plan;
    const ves_problem *p = plan->problem;
    double ignored;
    memset(plan->measure_adjoint, 0, sizeof(double) * (size_t)p->measures);
    memset(plan->block_adjoint, 0, sizeof(double) * (size_t)p->block);
    seed(v, p->objective, v->sign * objective);
    for (int k = 0; k < v->conditions; k++) {
        const plan_condition *c = &v->condition[k];
        if (c->measure >= 0) {
            plan->measure_adjoint[c->measure] += multiplier[k];
            continue;
        }
        seed(v, c->left, c->turn * multiplier[k]);
        seed(v, c->right, -c->turn * multiplier[k]);
    }
    for (int k = 0; k < v->shape.patches; k++)
        for (int d = 0; d < 3; d++)
            memset(v->displacement[k].by[d], 0, sizeof(double) * (size_t)v->shape.meridian[k].nu);
    VES_TRY(ves_plan_sweep(plan, 0, PROGRAM_JUDGE, &ignored));
    for (int f = 0; f < v->functions; f++) {
        slope[f] = 0;
        for (int k = 0; k < v->shape.patches; k++)
            for (int d = 0; d < 3; d++) {
                const double *phi = function_at(v, 1, k, d, f), *by = v->displacement[k].by[d];
                for (int i = 0; i < v->shape.meridian[k].nu; i++) slope[f] += phi[i] * by[i];
            }
    }
    return VES_OK;
}

/* --- second variation --- */

ves_status ves_variation_hessian(plan_variation *v, double *H)
{
    const int n = v->functions;
    double ignored;
    for (int k = 0; k < v->conditions; k++) v->against[k] = -v->condition[k].multiplier;
    memset(v->wave, 0, sizeof(double) * (size_t)n);
    for (int f = 0; f < n; f++) {
        const double l = v->n + (f < n - v->bends ? f : 16), step = STEP * v->unit / (1 + l * l / 8);
        for (int e = 0; e < 2; e++) {
            v->wave[f] = e ? -step : step;
            VES_TRY(ves_variation_value(v, &ignored, v->missed[0]));
            VES_TRY(ves_variation_slope(v, 1, v->against, v->side[e]));
        }
        v->wave[f] = 0;
        for (int k = 0; k < n; k++) H[f * n + k] = (v->side[0][k] - v->side[1][k]) / (2 * step);
    }
    return VES_OK;
}

static void metric_make(plan_variation *v)
{
    for (int k = 0; k < v->shape.patches; k++) {
        amplitude(v, 0, v->even, v->displacement[k].even, k);
        ves_metric_find(&v->shape.meridian[k], v->displacement[k].even, &v->metric[k]);
    }
}

double ves_variation_normal(const plan_variation *v, int function, int patch, int i)
{
    return function_at(v, 1, patch, 0, function)[i] * v->metric[patch].share[i];
}

/* The squares of cosines are one half on average. */
static double around(const plan_variation *v)
{
    return v->n ? 0.5 : 1;
}

void ves_variation_mass(plan_variation *v, double *M)
{
    const int n = v->functions;
    metric_make(v);
    for (int f = 0; f < n; f++)
        for (int g = 0; g <= f; g++) {
            double sum = 0;
            for (int k = 0; k < v->shape.patches; k++) {
                const plan_metric *m = &v->metric[k];
                const double *a = function_at(v, 1, k, 0, f), *b = function_at(v, 1, k, 0, g);
                for (int i = 0; i < v->shape.meridian[k].nu; i++)
                    sum += a[i] * b[i] * m->share[i] * m->share[i] * m->dA[i];
            }
            M[f * n + g] = M[g * n + f] = around(v) * sum;
        }
}

/* --- symmetries --- */

static void turn_about(const double axis[3], double angle, double turn[3][3])
{
    const double c = cos(angle), s = sin(angle);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int k = 3 - i - j;
            const double cross = i == j ? 0 : ((j - i + 3) % 3 == 1 ? -1 : 1) * axis[k];
            turn[i][j] = (1 - c) * axis[i] * axis[j] + s * cross + (i == j ? c : 0);
        }
}

/* About the axis, about one across it, along either, or in size. */
static plan_motion motion_of(const plan_variation *v, plan_symmetry which)
{
    static const double SOME = 0.3;
    plan_motion m = {.turn = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    const bool turns = which == PLAN_TILT || which == PLAN_SPIN;
    const double *frame = v->shape.frame[which == PLAN_LIFT || which == PLAN_SPIN ? 2 : 0];
    for (int c = 0; c < 3 && (which == PLAN_LIFT || which == PLAN_SHIFT); c++)
        m.shift[c] = SOME * v->unit * frame[c];
    if (turns) turn_about(frame, SOME, m.turn);
    for (int c = 0; c < 3 && which == PLAN_SIZE; c++) m.turn[c][c] = 1 + SOME;
    for (int c = 0; c < 3 && (turns || which == PLAN_SIZE); c++)
        for (int d = 0; d < 3; d++) m.shift[c] += ((c == d) - m.turn[c][d]) * v->shape.middle[d];
    return m;
}

ves_status ves_variation_symmetric(plan_variation *v, plan_symmetry which, bool *symmetric)
{
    double value[2], **missed = v->missed;
    const plan_motion motion = motion_of(v, which);
    ves_status status = ves_variation_value(v, &value[0], missed[0]);
    for (int k = 0; k < v->shape.patches; k++) v->displacement[k].motion = &motion;
    if (status == VES_OK) status = ves_variation_value(v, &value[1], missed[1]);
    for (int k = 0; k < v->shape.patches; k++) v->displacement[k].motion = NULL;
    *symmetric = fabs(value[1] - value[0]) <= UNSEEN * (fabs(value[0]) + fabs(value[1]));
    for (int k = 0; k < v->conditions; k++)
        *symmetric =
            *symmetric && fabs(missed[1][k] - missed[0][k]) <= UNSEEN * (1 + fabs(v->condition[k].hold));
    return status > VES_OK ? *symmetric = false, VES_OK : status;
}

/* The normal part of the motion: its amplitude of cos n v. */
static double normal_part(const plan_metric *m, plan_symmetry which, int i)
{
    switch (which) {
    case PLAN_LIFT:
        return m->Nz[i];
    case PLAN_SIZE:
        return m->r[i] * m->Nr[i] + m->z[i] * m->Nz[i];
    case PLAN_SHIFT:
        return m->Nr[i];
    default:
        return m->z[i] * m->Nr[i] - m->r[i] * m->Nz[i];
    }
}

static double lever(const plan_variation *v, plan_symmetry which)
{
    return which == PLAN_SIZE || which == PLAN_TILT ? 1 / v->unit : 1;
}

void ves_variation_rigid(const plan_variation *v, plan_symmetry which, double *row)
{
    double sum = 0, size = 0;
    for (int k = 0; k < v->shape.patches; k++)
        for (int i = 0; i < v->shape.meridian[k].nu; i++) {
            const plan_metric *m = &v->metric[k];
            const double w = normal_part(m, which, i) * lever(v, which);
            sum += w * w * m->dA[i], size += m->dA[i];
        }
    memset(row, 0, sizeof(double) * (size_t)v->functions);
    if (!(sum > NOTHING * NOTHING * size)) return; /* a sphere is not tilted */
    for (int f = 0; f < v->functions; f++) {
        for (int k = 0; k < v->shape.patches; k++) {
            const plan_metric *m = &v->metric[k];
            const double *phi = function_at(v, 1, k, 0, f);
            for (int i = 0; i < v->shape.meridian[k].nu; i++)
                row[f] += around(v) * phi[i] * m->share[i] * normal_part(m, which, i) * m->dA[i];
        }
    }
}

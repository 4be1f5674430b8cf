#include "vesica/stability.h"

#include <math.h>
#include <string.h>

#include "base/basis.h"
#include "base/diag.h"
#include "base/vector.h"
#include "plan/follow.h"
#include "plan/own.h"
#include "plan/spectrum.h"
#include "plan/variation.h"

enum { USUAL_MODES = 4, STEPS = 20, LEAST_NODES = 32, TIMES = 2 };

static const double ARRIVED = 1e-9;            /* e of a step that is the last */
static const double PLIANT = 0.3, NEAR = 1e-3; /* soft modes wait until the stiff ones have come so near */
static const double STRIDE = 0.02; /* e of a step along one mode: a soft one may ask for more than it holds */
static const double ENOUGH = 2e-3,
                    SMALL = 0.02; /* an error of the lowest eigenvalue that is no reason for more functions */
static const double FAR = 0.2;    /* e beyond which it is another shape */

typedef struct work {
    plan_variation v;
    plan_spectrum spectrum;
    double *H, *M, *row, *slope, *y;
    int rows;
    double value; /* of the objective, the least sought */
} work;

const char *ves_firmness_text(ves_firmness firmness)
{
    static const char *const text[] = {"stable", "soft", "unstable", "unknown"};
    return text[firmness];
}

static ves_status work_create(work *w, ves_arena *arena)
{
    const size_t n = (size_t)w->v.functions, rows = (size_t)w->v.conditions + PLAN_SYMMETRIES;
    w->H = ves_arena_take(arena, n * n, sizeof(double));
    w->M = ves_arena_take(arena, n * n, sizeof(double));
    w->row = ves_arena_take(arena, rows * n, sizeof(double));
    w->slope = ves_arena_take(arena, n, sizeof(double));
    w->y = ves_arena_take(arena, 2 * n, sizeof(double));
    if (!w->H || !w->M || !w->row || !w->slope || !w->y) return VES_MEMORY;
    return ves_spectrum_create((int)n, (int)rows, arena, &w->spectrum);
}

/* --- rows: what a displacement must not change, and the motions that change nothing --- */

static ves_status rigid_rows(work *w)
{
    const plan_symmetry from = w->v.n == 0 ? PLAN_LIFT : PLAN_SHIFT;
    for (int k = 0; k < 2 && w->v.n < 2; k++) {
        bool symmetric;
        VES_TRY(ves_variation_symmetric(&w->v, from + k, &symmetric));
        if (symmetric) ves_variation_rigid(&w->v, from + k, w->row + w->rows++ * w->v.functions);
    }
    return VES_OK;
}

static ves_status condition_rows(work *w)
{
    plan_variation *v = &w->v;
    for (int k = 0; k < v->conditions && v->n == 0; k++) {
        memset(v->against, 0, sizeof(double) * (size_t)v->conditions);
        v->against[k] = 1;
        VES_TRY(ves_variation_slope(v, 0, v->against, w->row + w->rows++ * v->functions));
    }
    return VES_OK;
}

/* At the shape displaced by `even`. */
static ves_status metric_make(work *w)
{
    plan_variation *v = &w->v;
    w->rows = 0;
    memset(v->wave, 0, sizeof(double) * (size_t)v->functions);
    VES_TRY(ves_variation_value(v, &w->value, v->missed[1]));
    VES_TRY(condition_rows(w));
    ves_variation_mass(v, w->M);
    VES_TRY(rigid_rows(w));
    VES_TRY(ves_variation_value(v, &w->value, v->missed[1]));
    return ves_spectrum_metric(&w->spectrum, v->functions, v->functions, w->M, w->rows, w->row);
}

/* --- the stationary shape --- */

static double product(int n, const double *a, const double *b)
{
    double sum = 0;
    for (int k = 0; k < n; k++) sum += a[k] * b[k];
    return sum;
}

/* Least squares: the slope of the objective as a sum of those of conditions. Leaves the rest of it, whitened. */
static ves_status multipliers(work *w, double *rest)
{
    plan_variation *v = &w->v;
    const plan_spectrum *s = &w->spectrum;
    const int n = v->functions;
    memset(v->against, 0, sizeof(double) * (size_t)v->conditions);
    VES_TRY(ves_variation_slope(v, 1, v->against, rest));
    ves_spectrum_whiten(s, rest);
    for (int k = 0; k < v->conditions; k++) v->condition[k].multiplier = 0;
    for (int j = s->kept - 1; j >= 0; j--) {
        double along = product(n, rest, s->unit + j * n);
        ves_basis_strip(n, n, s->unit + j * n, rest);
        if (s->from[j] >= v->conditions) continue;
        for (int k = 0; k < v->conditions; k++)
            along -= v->condition[k].multiplier * s->part[k * s->rows + j];
        v->condition[s->from[j]].multiplier = along / s->part[s->from[j] * s->rows + j];
    }
    return VES_OK;
}

/* An inequality that the shape leans on from the wrong side does not hold it. */
static bool condition_drop(plan_variation *v)
{
    for (int k = 0; k < v->conditions; k++) {
        if (!v->condition[k].one_sided || v->condition[k].multiplier <= 0) continue;
        for (int j = k + 1; j < v->conditions; j++) v->condition[j - 1] = v->condition[j];
        v->conditions--;
        return true;
    }
    return false;
}

/* One step of Newton's method, whitened, into y: back to the conditions, and along them to where the slope vanishes. */
static void newton(work *w, const double *rest, bool stiff, double *y)
{
    const plan_spectrum *s = &w->spectrum;
    const int n = s->n;
    double *by = w->y + n;
    memset(y, 0, sizeof(double) * (size_t)n);
    for (int j = 0; j < s->kept && s->from[j] < w->v.conditions; j++) {
        const double *part = s->part + s->from[j] * s->rows;
        double miss = -w->v.missed[1][s->from[j]];
        for (int l = 0; l < j; l++) miss -= part[l] * product(n, y, s->unit + l * n);
        for (int k = 0; k < n; k++) y[k] += miss / part[j] * s->unit[j * n + k];
    }
    for (int k = 0; k < n; k++) by[k] = rest[k] + product(n, s->form + k * n, y);
    for (int j = 0; j < s->count; j++) {
        const double *vector = s->vector + j * n, most = STRIDE * w->v.unit * w->v.unit;
        if (stiff && fabs(s->value[j]) * pow(w->v.unit, 4) < PLIANT) continue;
        const double f = fmax(-most, fmin(most, product(n, vector, by) / s->value[j]));
        for (int k = 0; k < n; k++) y[k] -= f * vector[k];
    }
}

/* e of an amplitude that is whitened. */
static double extent(const work *w, const double *y)
{
    return ves_basis_size(w->v.functions, y) / (w->v.unit * w->v.unit);
}

static ves_status second(work *w)
{
    VES_TRY(ves_variation_hessian(&w->v, w->H));
    ves_spectrum_find(&w->spectrum, w->v.functions, w->H);
    return VES_OK;
}

static ves_status settle(work *w)
{
    do {
        VES_TRY(metric_make(w));
        VES_TRY(multipliers(w, w->slope));
    } while (condition_drop(&w->v));
    return second(w);
}

/* Positive: the way leads nowhere. */
static ves_status relax(work *w, double *moved)
{
    plan_variation *v = &w->v;
    bool stiff = true;
    *moved = 0;
    for (int k = 0; k < STEPS; k++) {
        newton(w, w->slope, stiff, w->y);
        const double step = extent(w, w->y);
        *moved += step;
        if (!(*moved <= FAR)) return VES_NO_ROOT;
        ves_spectrum_colour(&w->spectrum, w->y);
        for (int f = 0; f < v->functions; f++) v->even[f] += w->y[f];
        VES_TRY(settle(w));
        if (step <= ARRIVED && !stiff) return VES_OK;
        if (step <= NEAR) stiff = false;
    }
    return VES_NO_ROOT;
}

/* Back to the design when that fails. */
static ves_status stationary_find(work *w, ves_stability *out)
{
    plan_variation *v = &w->v;
    VES_TRY(settle(w));
    out->objective = v->sign * w->value;
    out->slope = ves_basis_size(v->functions, w->slope) * v->unit * v->unit;
    ves_status status = relax(w, &out->moved);
    if (status < VES_OK) return status;
    out->relaxed = status == VES_OK;
    out->stationary = out->relaxed ? v->sign * w->value : NAN;
    if (out->relaxed) return VES_OK;
    out->moved = NAN;
    memset(v->even, 0, sizeof(double) * (size_t)v->functions);
    return settle(w);
}

/* --- modes --- */

/* What is left of the antisymmetric part of H, for a vector that is no longer white. */
static double crooked(const work *w, const double *c)
{
    const int n = w->v.functions;
    double *t = w->slope;
    for (int i = 0; i < n; i++) {
        t[i] = 0;
        for (int j = 0; j < n; j++) t[i] += (w->H[i * n + j] - w->H[j * n + i]) / 2 * c[j];
    }
    ves_spectrum_whiten(&w->spectrum, t);
    return ves_basis_size(n, t);
}

static double parity(int smooth, const double *c)
{
    double sum[2] = {0};
    for (int k = 0; k < smooth; k++) sum[k % 2] += c[k] * c[k];
    return (sum[0] - sum[1]) / (sum[0] + sum[1]);
}

static void mode_tell(work *w, ves_firmness_mode *mode)
{
    const plan_variation *v = &w->v;
    const int n = v->functions;
    const double unit = pow(v->unit, 4);
    mode->n = v->n;
    mode->values = w->spectrum.count < VES_STABILITY_VALUES ? w->spectrum.count : VES_STABILITY_VALUES;
    for (int k = 0; k < mode->values; k++) {
        memcpy(w->y, w->spectrum.vector + k * n, sizeof(double) * (size_t)n);
        ves_spectrum_colour(&w->spectrum, w->y);
        mode->value[k] = w->spectrum.value[k] * unit;
        mode->error[k] = crooked(w, w->y) * unit;
        mode->parity[k] = parity(n - v->bends, w->y);
    }
}

/* One node of a patch, counted from the first pole. */
static void profile_node(const work *w, int patch, int node, ves_stability_profile *p)
{
    const plan_variation *v = &w->v;
    const plan_meridian *m = &v->shape.meridian[patch];
    const plan_metric *g = &v->metric[patch];
    const int i = m->S[1][0] > 0 ? node : m->nu - 1 - node, at = p->points++;
    double along = 0;
    for (int f = 0; f < v->functions; f++)
        along += w->y[f] * v->unit * v->unit * ves_variation_normal(v, f, patch, i);
    p->r[at] = g->r[i], p->z[at] = g->z[i];
    p->wr[v->n][at] = along * g->Nr[i], p->wz[v->n][at] = along * g->Nz[i];
}

/* The lowest mode of the n at hand. */
static void profile_tell(work *w, ves_stability_profile *p)
{
    const plan_variation *v = &w->v;
    int nodes = 0, at = 0;
    memset(w->y, 0, sizeof(double) * (size_t)v->functions);
    if (w->spectrum.count) memcpy(w->y, w->spectrum.vector, sizeof(double) * (size_t)v->functions);
    ves_spectrum_colour(&w->spectrum, w->y);
    for (int k = 0; k < v->shape.patches; k++) nodes += v->shape.meridian[k].nu;
    const int stride = (nodes + VES_STABILITY_POINTS - 1) / VES_STABILITY_POINTS;
    p->points = 0;
    for (int k = 0; k < v->shape.patches; k++)
        for (int i = 0; i < v->shape.meridian[k].nu; i++)
            if (at++ % stride == 0) profile_node(w, k, i, p);
}

static ves_status modes_find(work *w, const ves_stability_options *o, ves_stability *out)
{
    const int modes = o->modes;
    for (int n = 0; n <= modes; n++) {
        if (n) {
            ves_variation_mode(&w->v, n);
            VES_TRY(metric_make(w));
            VES_TRY(second(w));
        }
        mode_tell(w, &out->mode[n]);
        if (o->profile) profile_tell(w, o->profile);
    }
    out->modes = modes + 1;
    return VES_OK;
}

/* The lowest mode as a change of the variables. */
static ves_status follow(work *w, const ves_stability_options *o, ves_stability *out)
{
    plan_variation *v = &w->v;
    const double small = SMALL * v->unit; /* the surface must still be one */
    double value;
    out->followed = o->along;
    for (int n = 0, low = 0; n < out->modes && o->along < 0; n++) {
        if (out->mode[n].value[0] < out->mode[low].value[0]) low = n;
        out->followed = out->mode[low].n;
    }
    ves_variation_mode(v, out->followed);
    VES_TRY(metric_make(w));
    VES_TRY(second(w));
    memcpy(w->y, w->spectrum.vector, sizeof(double) * (size_t)v->functions);
    ves_spectrum_colour(&w->spectrum, w->y);
    for (int k = 0; k < v->functions; k++) v->wave[k] = w->y[k] * v->unit * small;
    VES_TRY(ves_variation_value(v, &value, v->missed[1]));
    VES_TRY(ves_follow_fit(v, o->change, &out->made));
    for (int k = 0; k < v->plan->problem->variables; k++) o->change[k] *= v->unit / small;
    return VES_OK;
}

/* --- all of it --- */

static int up_to(int n, int multiple)
{
    return (n + multiple - 1) / multiple * multiple;
}

/* Twice as fine along u as the problem's own: the functions are no polynomials there. */
static ves_status grid_choose(const ves_problem *p, int modes, int functions, int grid[2])
{
    double change;
    memcpy(grid, p->quadrature, 2 * sizeof *grid);
    if (!grid[0]) {
        int chosen[2];
        VES_TRY(ves_plan_choose(p, NULL, chosen, &change));
        grid[0] = chosen[0];
    }
    const int own = TIMES * grid[0], needed = LEAST_NODES + 2 * functions / p->patches;
    grid[0] = up_to(own > needed ? own : needed, VES_LANES);
    grid[1] = up_to(4 * (modes + 1) + 8, 4);
    return VES_OK;
}

static ves_status at_design(ves_plan *plan, ves_diag *diag)
{
    ves_status status = ves_plan_forward(plan, plan->start, 0, PROGRAM_JUDGE, true);
    if (status > VES_OK) ves_plan_why(plan, status, plan->problem->name, diag);
    return status;
}

/* Modes of different n are strangers only where nothing changes when a shape is turned about the axis: looked at on one
 * that is dented. */
static ves_status spin(plan_variation *v, ves_diag *diag)
{
    static const double DENT = 0.01; /* of the radius */
    bool all = true;
    for (int n = 1; n <= 2 && all; n++) {
        ves_variation_mode(v, n);
        v->wave[0] = v->wave[1] = DENT * v->unit;
        ves_status status = ves_variation_symmetric(v, PLAN_SPIN, &all);
        if (status != VES_OK) return ves_diag_fail(diag, status);
    }
    ves_variation_mode(v, 0);
    if (all) return VES_OK;
    return ves_diag_add(
        diag, VES_ERROR, VES_ABSENT, (ves_mark){0},
        "%s: no stability where the objective or a constraint changes when the shape is turned "
        "about its own axis",
        v->plan->problem->name);
}

static ves_status with_plan(ves_plan *plan, const ves_stability_options *o, ves_stability *out,
                            ves_diag *diag)
{
    ves_arena arena = {0};
    work w = {0};
    ves_status status = at_design(plan, diag);
    if (status == VES_OK) status = ves_variation_create(plan, out->functions, &arena, &w.v, diag);
    if (status == VES_OK) status = spin(&w.v, diag);
    if (status == VES_OK) {
        status = work_create(&w, &arena);
        out->radius = w.v.unit;
        if (status == VES_OK) status = stationary_find(&w, out);
        if (status == VES_OK) status = modes_find(&w, o, out);
        if (status == VES_OK && o->change) status = follow(&w, o, out);
        out->held = w.v.conditions;
        for (int k = 0; k < w.v.conditions && k < VES_STABILITY_HOLDS; k++)
            out->holds[k] = w.v.condition[k].text;
        if (status < VES_OK) ves_diag_fail(diag, status);
        if (status > VES_OK) ves_plan_why(plan, status, "beside the design", diag);
    }
    ves_arena_destroy(&arena);
    return status;
}

static ves_status with_functions(const ves_problem *problem, const ves_stability_options *o, int functions,
                                 ves_stability *out, ves_diag *diag)
{
    ves_plan *plan = NULL;
    *out = (ves_stability){.stationary = NAN, .moved = NAN, .functions = functions};
    ves_status status = grid_choose(problem, o->modes, functions, out->quadrature);
    if (status != VES_OK) return ves_diag_fail(diag, status);
    VES_TRY(ves_plan_loose(problem, out->quadrature, &plan, diag));
    status = with_plan(plan, o, out, diag);
    ves_plan_destroy(plan);
    return status;
}

/* Errors are what fewer functions, on a coarser grid, tell otherwise. */
static void compare(const ves_stability *coarse, ves_stability *out)
{
    out->unsure = out->relaxed && coarse->relaxed ? fabs(out->stationary - coarse->stationary) : NAN;
    for (int n = 0; n < out->modes; n++) {
        ves_firmness_mode *m = &out->mode[n];
        for (int k = 0; k < m->values; k++) m->error[k] += fabs(m->value[k] - coarse->mode[n].value[k]);
        m->firmness = !out->relaxed                ? VES_UNKNOWN
                      : m->value[0] > m->error[0]  ? VES_FIRM
                      : m->value[0] < -m->error[0] ? VES_UNSTABLE
                                                   : VES_SOFT;
        if (m->value[0] < out->mode[out->softest].value[0]) out->softest = n;
        if (m->firmness > out->firmness) out->firmness = m->firmness;
    }
}

/* Are the lowest known well enough? */
static bool settled(const ves_stability *s)
{
    for (int n = 0; n < s->modes; n++)
        if (!(s->mode[n].error[0] <= ENOUGH * fmax(fabs(s->mode[n].value[0]), SMALL))) return false;
    return true;
}

static ves_status options_look(const ves_problem *p, const ves_stability_options *o, ves_diag *diag)
{
    if (!p->objective)
        return ves_diag_add(diag, VES_ERROR, VES_ABSENT, (ves_mark){0},
                            "%s: no objective, so nothing to be stable about", p->name);
    if (o->modes < 0 || o->modes > VES_STABILITY_MODES || (o->change && o->along > VES_STABILITY_MODES) ||
        o->functions < 0 || o->functions > VES_STABILITY_FUNCTIONS || (o->functions && o->functions < 6))
        return ves_diag_add(
            diag, VES_ERROR, VES_RANGE, (ves_mark){0},
            "stability is told of modes 0 to %d at most, in 6 to %d functions: %d, %d are not possible",
            VES_STABILITY_MODES, VES_STABILITY_FUNCTIONS, o->modes, o->functions);
    return VES_OK;
}

ves_status ves_stability_find(const ves_problem *problem, const ves_stability_options *options,
                              ves_stability *out, ves_diag *diag)
{
    ves_stability_options o = options ? *options : (ves_stability_options){0};
    int functions[] = {32, 48, 64, VES_STABILITY_FUNCTIONS}, choices = sizeof functions / sizeof *functions;
    ves_stability coarse;
    *out = (ves_stability){.stationary = NAN, .moved = NAN};
    VES_TRY(options_look(problem, &o, diag));
    if (!o.counted) o.modes = USUAL_MODES > o.along || !o.change ? USUAL_MODES : o.along;
    if (o.functions) functions[0] = 2 * o.functions / 3, functions[1] = o.functions, choices = 2;
    VES_TRY(with_functions(problem, &o, functions[0], out, diag));
    for (int k = 1; k < choices; k++) {
        coarse = *out;
        VES_TRY(with_functions(problem, &o, functions[k], out, diag));
        compare(&coarse, out);
        if (settled(out)) break;
    }
    return ves_own_find(problem, out, diag);
}

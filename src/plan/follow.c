#include "plan/follow.h"

#include <math.h>
#include <string.h>

#include "base/eigen.h"
#include "base/vector.h"

/* Normal equations, solved in the eigenvectors of their matrix: variables may do the same as others together, so that
 * directions which hardly move the surface are left alone.
 * test  tests/stability.c: a sphere's radii against its modes; an oblate that has lost its stability, followed */

enum { ROOM = 3 * VES_FIELDS };

static const double STEP = 1e-5; /* of the range */
static const double IDLE = 1e-6; /* of the largest eigenvalue: what a direction moves, squared */

typedef struct fit {
    const plan_variation *v;
    ves_plan *plan;
    int n, around, count;            /* variables, angles, points of all patches */
    double *u, *phi, *field;         /* of one patch */
    double *x, *at;                  /* design; [count] normal positions */
    double *wanted, *weight, *moves; /* [count]; [n][count] per range */
    double *G, *value, *vector, *b;  /* [n][n], [n] */
} fit;

static ves_status room(fit *f, ves_arena *arena)
{
    const plan_meridian *m = f->v->shape.meridian;
    const size_t n = (size_t)f->n;
    int most = 0;
    f->around = 4 * f->v->n + 8;
    for (int p = 0; p < f->v->shape.patches; p++) {
        f->count += m[p].nu * f->around;
        if (m[p].nu > most) most = m[p].nu;
    }
    const size_t all = (size_t)f->count, part = (size_t)(most * f->around);
    double **const plane[] = {&f->u,      &f->phi,   &f->field, &f->x, &f->at,    &f->wanted,
                              &f->weight, &f->moves, &f->G,     &f->b, &f->value, &f->vector};
    const size_t size[] = {part, part, ROOM * part, n, all, all, all, n * all, n * n, n, n, n * n};
    for (size_t k = 0; k < sizeof plane / sizeof *plane; k++)
        if (!(*plane[k] = ves_arena_take(arena, size[k], sizeof(double)))) return VES_MEMORY;
    return VES_OK;
}

/* Where the points stand along the normals, of design x. */
static ves_status normal_positions(fit *f, double *at)
{
    const plan_variation *v = f->v;
    const plan_revolution *s = &v->shape;
    VES_TRY(ves_plan_forward(f->plan, f->x, 0, PROGRAM_JUDGE, false));
    for (int p = 0; p < s->patches; p++) {
        const plan_meridian *m = &s->meridian[p];
        const double *node = v->plan->level[0].site[m->patch].grid.u;
        const int count = m->nu * f->around;
        for (int k = 0; k < count; k++)
            f->u[k] = node[k / f->around], f->phi[k] = VES_TWO_PI * (k % f->around) / f->around;
        VES_TRY(ves_plan_points(f->plan, m->patch, count, f->u, f->phi, f->field));
        for (int k = 0; k < count; k++) {
            const plan_metric *g = &v->metric[p];
            const int i = k / f->around;
            const double c = g->Nr[i] * cos(f->phi[k]), d = g->Nr[i] * sin(f->phi[k]);
            at[k] = 0;
            for (int e = 0; e < 3; e++)
                at[k] += f->field[e * count + k] *
                         (c * s->frame[0][e] + d * s->frame[1][e] + g->Nz[i] * s->frame[2][e]);
        }
        at += count;
    }
    return VES_OK;
}

static void wanted(fit *f)
{
    const plan_variation *v = f->v;
    int at = 0;
    for (int p = 0; p < v->shape.patches; p++) {
        const plan_metric *g = &v->metric[p];
        for (int k = 0; k < v->shape.meridian[p].nu * f->around; k++, at++) {
            const int i = k / f->around;
            f->wanted[at] = v->displacement[p].wave[0][i] * g->share[i] *
                            cos(v->n * VES_TWO_PI * (k % f->around) / f->around);
            f->weight[at] = g->dA[i] / f->around;
        }
    }
}

/* By differences, in the bounds. */
static ves_status move(fit *f, int k)
{
    const ves_variable *variable = &f->plan->problem->variable[k];
    const double x = f->x[k], range = variable->max - variable->min, step = STEP * range;
    const double high = fmin(x + step, variable->max), low = fmax(x - step, variable->min);
    double *row = f->moves + (size_t)k * (size_t)f->count;
    f->x[k] = high;
    ves_status status = normal_positions(f, row);
    f->x[k] = low;
    if (status == VES_OK) status = normal_positions(f, f->at);
    f->x[k] = x;
    for (int i = 0; i < f->count; i++)
        row[i] = status == VES_OK ? (row[i] - f->at[i]) * range / (high - low) : 0;
    return status < VES_OK ? status : VES_OK;
}

static double product(const fit *f, const double *a, const double *b)
{
    double sum = 0;
    for (int i = 0; i < f->count; i++) sum += f->weight[i] * a[i] * b[i];
    return sum;
}

static void solve(fit *f, double *change, double *made)
{
    const int n = f->n;
    double most = 0, met = 0;
    for (int k = 0; k < n; k++) {
        const double *row = f->moves + (size_t)k * (size_t)f->count;
        for (int j = 0; j <= k; j++)
            f->G[k * n + j] = f->G[j * n + k] = product(f, row, f->moves + (size_t)j * (size_t)f->count);
        f->b[k] = product(f, row, f->wanted);
        change[k] = 0;
    }
    ves_eigen_symmetric(n, f->G, f->value, f->vector);
    for (int k = 0; k < n; k++) most = fmax(most, f->value[k]);
    for (int k = 0; k < n; k++) {
        double along = 0;
        if (!(f->value[k] > IDLE * most)) continue;
        for (int i = 0; i < n; i++) along += f->vector[i * n + k] * f->b[i];
        met += along * along / f->value[k];
        for (int i = 0; i < n; i++) change[i] += f->vector[i * n + k] * along / f->value[k];
    }
    const double all = product(f, f->wanted, f->wanted);
    *made = all > 0 ? met / all : 0;
    for (int i = 0; i < n; i++)
        change[i] *= f->plan->problem->variable[i].max - f->plan->problem->variable[i].min;
}

ves_status ves_follow_fit(const plan_variation *v, double *change, double *made)
{
    const ves_problem *problem = v->plan->problem;
    fit f = {.v = v, .n = problem->variables};
    ves_arena arena = {0};
    *made = 0;
    if (!f.n) return VES_OK;
    ves_status status = ves_plan_create(problem, NULL, &f.plan, NULL);
    if (status == VES_OK) status = room(&f, &arena);
    if (status == VES_OK) memcpy(f.x, f.plan->start, sizeof *f.x * (size_t)f.n);
    if (status == VES_OK) wanted(&f);
    for (int k = 0; k < f.n && status == VES_OK; k++) status = move(&f, k);
    if (status == VES_OK) solve(&f, change, made);
    ves_plan_destroy(f.plan);
    ves_arena_destroy(&arena);
    return status;
}

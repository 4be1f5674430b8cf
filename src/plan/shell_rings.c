/* Rings around the parts of a shell, sampled densely at the designs that are looked at: how many waves they have, and of
 * which numbers. */
#include "plan/shell.h"

#include <math.h>

#include "base/random.h"
#include "base/vector.h"

enum { ROWS = 4, SAMPLES = 256, WAVES_MOST = 48, NODES_A_WAVE = 8, DRAWN = 64 };

/* What is left out of a mesh, of the first wave; what is no wave at all. */
static const double SEEN = 3e-3, NONE = 1e-9;

/* One patch that goes round, on its grid. */
typedef struct ring_sampler {
    ves_grid grid;
    ves_chart *chart;
    double *X; /* [3][ROWS * SAMPLES], row by row */
} ring_sampler;

static ves_status sampler_make(ves_plan *plan, int patch, ring_sampler *r)
{
    double u[ROWS], v[SAMPLES];
    for (int k = 0; k < ROWS; k++) u[k] = (k + 0.5) / ROWS;
    for (int k = 0; k < SAMPLES; k++) v[k] = VES_TWO_PI * k / SAMPLES;
    VES_TRY(ves_grid_given(ROWS, u, SAMPLES, v, true, &plan->arena, &r->grid));
    r->X = ves_arena_doubles(&plan->arena, 3 * ROWS * SAMPLES);
    if (!r->X) return VES_MEMORY;
    return ves_chart_create(plan->patch[patch], &r->grid, 1u << VES_FIELD_X, &plan->arena, &r->chart);
}

static bool sample(ves_plan *plan, ring_sampler *r)
{
    if (ves_chart_prepare(r->chart, &plan->bound, false) != VES_OK) return false;
    for (int t = 0; t < ves_tile_count(&r->grid); t++) {
        ves_tile tile;
        ves_tile_at(&r->grid, t, 1u << VES_FIELD_X, &tile);
        ves_chart_sample(r->chart, &tile, plan->field);
        for (int c = 0; c < 3; c++)
            for (int row = 0; row < tile.rows; row++)
                for (int i = 0; i < tile.lanes; i++) {
                    size_t node = tile.offset[row] + (size_t)i; /* u runs fastest */
                    size_t at = node % ROWS * SAMPLES + node / ROWS;
                    r->X[(size_t)c * ROWS * SAMPLES + at] =
                        plan->field->at[VES_FIELD_X * 3 + c][row * VES_LANES + i];
                }
    }
    return true;
}

/* |n-th coefficient|^2 of samples. */
static double power_of(const double *f, int n)
{
    double re = 0, im = 0;
    for (int k = 0; k < SAMPLES; k++) {
        re += f[k] * cos(VES_TWO_PI * (n * k % SAMPLES) / SAMPLES);
        im += f[k] * sin(VES_TWO_PI * (n * k % SAMPLES) / SAMPLES);
    }
    return (re * re + im * im) / SAMPLES / SAMPLES;
}

/* The largest wave that is seen; n waves of the radius are n - 1 and n + 1 of the coordinates across the axis. */
static int waves_of(const double *const X[3])
{
    int most = 1;
    double first = 0;
    for (int n = 1; n <= WAVES_MOST; n++) {
        double square = power_of(X[0], n) + power_of(X[1], n) + power_of(X[2], n);
        if (n == 1) first = square;
        if (square > SEEN * SEEN * first) most = n;
    }
    return most > 2 ? most - 1 : most;
}

static int common(int a, int b)
{
    while (b) {
        int rest = a % b;
        a = b, b = rest;
    }
    return a;
}

/* Distances from the middle of the ring, and the greatest number that divides all their waves: how often the ring may
 * come again in itself. 0: it has no waves. */
static int folds_of(const double *const X[3], int folds, double *largest)
{
    double r[SAMPLES], mean[3] = {0};
    for (int c = 0; c < 3; c++)
        for (int k = 0; k < SAMPLES; k++) mean[c] += X[c][k] / SAMPLES;
    for (int k = 0; k < SAMPLES; k++) {
        r[k] = 0;
        for (int c = 0; c < 3; c++) r[k] += (X[c][k] - mean[c]) * (X[c][k] - mean[c]);
        *largest = fmax(*largest, sqrt(r[k]));
    }
    double whole = power_of(r, 0);
    for (int n = 1; n <= SAMPLES / 2; n++)
        if (power_of(r, n) > NONE * NONE * whole) folds = common(n, folds);
    return folds;
}

/* Waves of buckling around: those of a cylinder end at (12 (1 - nu^2))^(1/4) sqrt(R / t), and want six nodes each. */
static int waves_of_buckling(ves_plan *plan, const plan_shell *shell, int part, double R)
{
    double nu = plan->block[shell->def->nu], at[VES_SHELL_ARGUMENTS] = {0}, least = HUGE_VAL;
    for (int k = 0; k <= ROWS; k++) {
        ves_plan_domain_at(plan, shell->def->part[part].patch, (double)k / ROWS, 0, &at[VES_SHELL_U]);
        double t = ves_formula_eval(shell->def->part[part].thickness, plan->block, at, plan->formula_room);
        if (t > 0) least = fmin(least, t);
    }
    double waves = pow(12 * (1 - nu * nu), 0.25) * sqrt(R / least) * 6 / NODES_A_WAVE;
    return waves < WAVES_MOST ? (int)ceil(waves) : WAVES_MOST;
}

static void part_look(ves_plan *plan, plan_shell *shell, int part, bool is_start, const ring_sampler *r)
{
    double R = 0;
    for (int row = 0; row < ROWS; row++) {
        const double *X[3];
        for (int c = 0; c < 3; c++) X[c] = r->X + (c * ROWS + row) * SAMPLES;
        int waves = waves_of(X);
        if (waves > shell->waves) shell->waves = waves;
        shell->folds = folds_of(X, shell->folds, &R);
    }
    int buckling = shell->buckles && is_start ? waves_of_buckling(plan, shell, part, R) : 0;
    if (buckling > shell->waves) shell->waves = buckling;
}

/* Drawn, each variable at its least, its most, or between: what one brings out another may smooth away. */
static void draw(ves_plan *plan, int k)
{
    const ves_problem *p = plan->problem;
    ves_random random = {.seed = 3, .step = (uint64_t)k};
    for (int i = 0; i < p->variables; i++) {
        double at = fmin(1, fmax(0, 2 * ves_random_uniform(&random) - 0.5));
        plan->reference[i] = p->variable[i].min + (p->variable[i].max - p->variable[i].min) * at;
    }
    ves_plan_bind(plan, plan->reference, p->solve ? (p->solve->lo + p->solve->hi) / 2 : 0);
}

static void look(ves_plan *plan, plan_shell *shell, bool is_start, ring_sampler *r)
{
    for (int k = 0; k < shell->def->parts; k++)
        if (r[k].chart && sample(plan, &r[k])) part_look(plan, shell, k, is_start, &r[k]);
}

ves_status ves_shell_rings(ves_plan *plan, plan_shell *shell)
{
    ring_sampler *r = ves_arena_take(&plan->arena, (size_t)shell->def->parts, sizeof *r);
    if (!r) return VES_MEMORY;
    shell->waves = 1, shell->folds = 0;
    for (int k = 0; k < shell->def->parts; k++) {
        int patch = shell->def->part[k].patch;
        if (ves_patch_periodic(plan->patch[patch])) VES_TRY(sampler_make(plan, patch, &r[k]));
    }
    for (int k = 0; k < DRAWN; k++) {
        draw(plan, k);
        look(plan, shell, false, r);
    }
    for (int d = SHELL_DESIGNS - 1; d >= 0; d--) {
        ves_shell_design(plan, d);
        look(plan, shell, d == 0, r);
    }
    return VES_OK;
}

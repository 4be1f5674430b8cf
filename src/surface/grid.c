#include "surface/grid.h"

#include <math.h>

#include "base/vector.h"

void ves_gauss_nodes(int n, double *node, double *weight)
{
    for (int k = 0; k < n; k++) {
        double x = cos(VES_PI * (k + 0.75) / (n + 0.5)), slope = 1;
        for (int step = 0; step < 100; step++) {
            double p = 1, q = 0;
            for (int m = 0; m < n; m++) {
                double r = q;
                q = p;
                p = ((2 * m + 1) * x * q - m * r) / (m + 1);
            }
            slope = n * (x * p - q) / (x * x - 1);
            double move = p / slope;
            x -= move;
            if (fabs(move) < 1e-16) break;
        }
        node[n - 1 - k] = (1 + x) / 2;
        weight[n - 1 - k] = 1 / ((1 - x * x) * slope * slope);
    }
}

static ves_status reserve(int nu, int nv, bool periodic, ves_arena *arena, ves_grid *grid)
{
    *grid = (ves_grid){.nu = nu, .nv = nv, .count = nu * nv, .periodic = periodic};
    grid->u = ves_arena_take(arena, (size_t)nu, sizeof(double));
    grid->v = ves_arena_take(arena, (size_t)nv, sizeof(double));
    grid->weight = ves_arena_take(arena, (size_t)grid->count, sizeof(double));
    return grid->u && grid->v && grid->weight ? VES_OK : VES_MEMORY;
}

/* v nodes with weights; a ring's weights are for dv alone. */
static void around(ves_grid *grid, double *weight)
{
    int n = grid->nv;
    if (grid->periodic) {
        for (int j = 0; j < n; j++) grid->v[j] = VES_TWO_PI * (j + 0.5) / n, weight[j] = VES_TWO_PI / n;
        grid->symmetric = n % 4 == 0;
    } else {
        ves_gauss_nodes(n, grid->v, weight);
        for (int j = 0; j < n; j++) grid->v[j] *= VES_TWO_PI, weight[j] *= VES_TWO_PI;
    }
}

ves_status ves_grid_quadrature(int nu, int nv, bool periodic, ves_arena *arena, ves_grid *grid)
{
    VES_TRY(reserve(nu, nv, periodic, arena, grid));
    double *wu = ves_arena_take(arena, (size_t)nu, sizeof(double));
    double *wv = ves_arena_take(arena, (size_t)nv, sizeof(double));
    if (!wu || !wv) return VES_MEMORY;
    ves_gauss_nodes(nu, grid->u, wu);
    around(grid, wv);
    for (int j = 0; j < nv; j++)
        for (int i = 0; i < nu; i++) grid->weight[j * nu + i] = wu[i] * wv[j];
    return VES_OK;
}

ves_status ves_grid_ring(double u, int nv, bool periodic, ves_arena *arena, ves_grid *grid)
{
    VES_TRY(reserve(1, nv, periodic, arena, grid));
    grid->u[0] = u;
    around(grid, grid->weight);
    return VES_OK;
}

ves_status ves_grid_given(int nu, const double *u, int nv, const double *v, bool periodic, ves_arena *arena,
                          ves_grid *grid)
{
    VES_TRY(reserve(nu, nv, periodic, arena, grid));
    for (int i = 0; i < nu; i++) grid->u[i] = u[i];
    for (int j = 0; j < nv; j++) grid->v[j] = v[j];
    return VES_OK;
}

/* Figures: the shape at one x on regular grids, edge to edge. */
#include "plan/inside.h"

#include <math.h>
#include <string.h>

static const double TWO_PI = 6.283185307179586;

/* At a pole Xv vanishes: forms are taken this far inside instead, and averaged over v, which is their limit.
 */
static const double INSIDE = 1e-3;

enum { EVERYTHING = (1 << VES_FIELDS) - 1 };

static ves_status patch_reserve(ves_figure *figure, ves_figure_patch *f)
{
    size_t count = (size_t)(f->rows * f->columns);
    double **plane[] = {&f->X[0],      &f->X[1], &f->X[2], &f->normal[0], &f->normal[1],
                        &f->normal[2], &f->H,    &f->K,    &f->k1,        &f->k2};
    for (size_t k = 0; k < sizeof plane / sizeof *plane; k++)
        if (!(*plane[k] = ves_arena_doubles(&figure->arena, count))) return VES_MEMORY;
    return VES_OK;
}

static ves_status grid_make(ves_figure *figure, const ves_figure_patch *f, double inside, ves_grid *grid)
{
    double *u = ves_arena_take(&figure->arena, (size_t)f->rows, sizeof *u);
    double *v = ves_arena_take(&figure->arena, (size_t)f->columns, sizeof *v);
    if (!u || !v) return VES_MEMORY;
    for (int i = 0; i < f->rows; i++) {
        u[i] = (double)i / f->nu;
        if (i == 0 && f->pole[0]) u[i] = inside;
        if (i == f->rows - 1 && f->pole[1]) u[i] = 1 - inside;
    }
    for (int j = 0; j < f->columns; j++) v[j] = TWO_PI * j / f->nv;
    return ves_grid_given(f->rows, u, f->columns, v, f->periodic, &figure->arena, grid);
}

/* Visits every tile of a patch on a grid. */
static ves_status patch_sample(ves_plan *plan, ves_figure *figure, int k, double inside,
                               void (*take)(ves_plan *, ves_figure_patch *, const ves_tile *))
{
    ves_figure_patch *f = &figure->patch[k];
    ves_grid *grid = ves_arena_take(&figure->arena, 1, sizeof *grid);
    ves_chart *chart;
    if (!grid) return VES_MEMORY;
    VES_TRY(grid_make(figure, f, inside, grid));
    VES_TRY(ves_chart_create(plan->patch[k], grid, EVERYTHING, &figure->arena, &chart));
    ves_chart_prepare(chart, &plan->bound, false);
    int tiles = ves_tile_count(grid);
    for (int t = 0; t < tiles; t++) {
        ves_tile tile;
        ves_tile_at(grid, t, EVERYTHING, &tile);
        ves_chart_sample(chart, &tile, plan->field);
        ves_tile_scale(&tile, plan->similarity, plan->field);
        ves_form_rows rows;
        ves_form_rows_init(plan->form, &rows);
        ves_forms_eval(&tile, plan->field, f->side, true, &rows);
        take(plan, f, &tile);
    }
    return VES_OK;
}

static void take_points(ves_plan *plan, ves_figure_patch *f, const ves_tile *tile)
{
    for (int r = 0; r < tile->rows; r++)
        for (int i = 0; i < tile->lanes; i++)
            for (int c = 0; c < 3; c++)
                f->X[c][(tile->block + i) * f->columns + tile->row[r]] =
                    plan->field->at[c][r * VES_LANES + i];
}

static void take_forms(ves_plan *plan, ves_figure_patch *f, const ves_tile *tile)
{
    for (int r = 0; r < tile->rows; r++)
        for (int i = 0; i < tile->lanes; i++) {
            int to = (tile->block + i) * f->columns + tile->row[r], from = r * VES_LANES + i;
            for (int c = 0; c < 3; c++) f->normal[c][to] = plan->form->at[VES_FORM_NX + c][from];
            double H = plan->form->at[VES_FORM_H][from], K = plan->form->at[VES_FORM_K][from];
            double root = H * H > K ? sqrt(H * H - K) : 0;
            f->H[to] = H, f->K[to] = K, f->k1[to] = H + root, f->k2[to] = H - root;
        }
}

/* One value for the whole row of a pole: the mean over v. */
static void pole_fill(ves_figure_patch *f, int end)
{
    size_t first = end ? (size_t)(f->nu * f->columns) : 0;
    double *plane[] = {f->normal[0], f->normal[1], f->normal[2], f->H, f->K, f->k1, f->k2};
    for (size_t k = 0; k < sizeof plane / sizeof *plane; k++) {
        double mean = 0;
        for (int j = 0; j < f->columns; j++) mean += plane[k][first + (size_t)j] / f->columns;
        for (int j = 0; j < f->columns; j++) plane[k][first + (size_t)j] = mean;
    }
    double length = hypot(hypot(f->normal[0][first], f->normal[1][first]), f->normal[2][first]);
    for (int c = 0; c < 3; c++)
        for (int j = 0; j < f->columns; j++) f->normal[c][first + (size_t)j] /= length > 0 ? length : 1;
}

static ves_status patch_figure(ves_plan *plan, ves_figure *figure, int k, int nu, int nv)
{
    ves_figure_patch *f = &figure->patch[k];
    bool periodic = ves_patch_periodic(plan->patch[k]);
    *f = (ves_figure_patch){.name = plan->problem->patch[k].name,
                            .nu = nu,
                            .nv = nv,
                            .rows = nu + 1,
                            .columns = periodic ? nv : nv + 1,
                            .periodic = periodic,
                            .side = plan->side[k]};
    for (int end = 0; end < 2; end++) {
        f->edge[end] = ves_end_curve(plan, k, end);
        f->pole[end] = ves_end_is_pole(plan, k, end);
        f->cap[end] = ves_end_is_capped(plan, k, end);
    }
    VES_TRY(patch_reserve(figure, f));
    VES_TRY(patch_sample(plan, figure, k, 0, take_points));
    VES_TRY(patch_sample(plan, figure, k, INSIDE, take_forms));
    for (int end = 0; end < 2; end++)
        if (f->pole[end]) pole_fill(f, end);
    return VES_OK;
}

static int finest(const ves_plan *plan)
{
    int band = 0;
    for (int k = 0; k < plan->problem->patches; k++)
        if (ves_patch_band(plan->patch[k]) > band) band = ves_patch_band(plan->patch[k]);
    return band;
}

ves_status ves_plan_figure_make(ves_plan *plan, int nu, int nv, ves_figure **out)
{
    *out = NULL;
    const ves_problem *p = plan->problem;
    int band = finest(plan);
    if (nu <= 0) nu = 48;
    if (nv <= 0) nv = band < 12 ? 96 : band < 24 ? 192 : 288;
    ves_figure *figure = ves_memory_take(sizeof *figure);
    if (!figure) return VES_MEMORY;
    figure->patches = p->patches;
    figure->closed = p->shape.closed;
    figure->unit = p->units ? "m" : NULL;
    figure->patch = ves_arena_take(&figure->arena, (size_t)p->patches, sizeof *figure->patch);
    figure->title = ves_arena_text(&figure->arena, p->title, strlen(p->title));
    ves_status status = figure->patch && figure->title ? VES_OK : VES_MEMORY;
    for (int k = 0; k < p->patches && status == VES_OK; k++) status = patch_figure(plan, figure, k, nu, nv);
    if (status == VES_OK)
        *out = figure;
    else
        ves_figure_destroy(figure);
    return status;
}

ves_status ves_plan_figure(ves_plan *plan, const double *x, int nu, int nv, ves_figure **figure,
                           ves_diag *diag)
{
    *figure = NULL;
    ves_status status = ves_plan_forward(plan, x, 0, PROGRAM_JUDGE, false);
    if (status > VES_OK)
        ves_diag_add(diag, VES_WARNING, status, (ves_mark){0}, "the shape is drawn although %s",
                     ves_status_text(status));
    if (status < VES_OK || status == VES_NO_ROOT) return status;
    return ves_plan_figure_make(plan, nu, nv, figure);
}

/* Figures: the shape at one x on regular grids, edge to edge. */
#include "base/vector.h"
#include "plan/inside.h"

#include <math.h>
#include <string.h>

/* Where an end has no forms they are taken this far inside, and half as far. Nearer, what cancels in them
 * would be seen: their rounding is 1e-16 over this distance. */
static const double INSIDE = 2e-3;

enum {
    EVERYTHING = (1 << VES_FIELDS) - 1,
    AT_POLE = (1 << VES_POLE_FIELDS) - 1,
    ALONG = 48,
    COARSE = 32,
    CELLS_MOST = 10000,
    ALL_MOST = 20000000
};

static ves_status patch_reserve(ves_figure *figure, ves_figure_patch *f)
{
    size_t count = (size_t)(f->rows * f->columns);
    double **plane[] = {&f->X[0],      &f->X[1], &f->X[2], &f->normal[0], &f->normal[1],
                        &f->normal[2], &f->H,    &f->K,    &f->k1,        &f->k2};
    for (size_t k = 0; k < sizeof plane / sizeof *plane; k++)
        if (!(*plane[k] = ves_arena_doubles(&figure->arena, count))) return VES_MEMORY;
    return VES_OK;
}

/* Some rows of a patch, each at its u, and what to take from them. */
typedef struct visit {
    int first, rows;
    const double *u; /* [rows] */
    double slide;
    bool pole;         /* one row, and it is a pole: the limits of forms */
    ves_status status; /* VES_DEGENERATE: somewhere there are no forms */
    void (*take)(const ves_plan *plan, ves_figure_patch *f, const struct visit *rows, const ves_tile *tile);
} visit;

static ves_status grid_make(ves_figure *figure, const ves_figure_patch *f, const visit *rows, ves_grid *grid)
{
    double *v = ves_arena_take(&figure->arena, (size_t)f->columns, sizeof *v);
    if (!v) return VES_MEMORY;
    for (int j = 0; j < f->columns; j++) {
        v[j] = VES_TWO_PI * j / f->nv + rows->slide;
        if (rows->slide != 0) v[j] -= VES_TWO_PI * floor(v[j] / VES_TWO_PI);
    }
    return ves_grid_given(rows->rows, rows->u, f->columns, v, f->periodic, &figure->arena, grid);
}

/* Visits every tile of some rows of a patch. */
static ves_status rows_sample(ves_plan *plan, ves_figure *figure, int k, visit *rows)
{
    ves_figure_patch *f = &figure->patch[k];
    unsigned fields = rows->pole ? AT_POLE : EVERYTHING;
    ves_grid *grid = ves_arena_take(&figure->arena, 1, sizeof *grid);
    ves_chart *chart;
    if (!grid) return VES_MEMORY;
    VES_TRY(grid_make(figure, f, rows, grid));
    VES_TRY(ves_chart_create(plan->patch[k], grid, fields, &figure->arena, &chart));
    VES_TRY(ves_chart_prepare(chart, &plan->bound, false));
    int tiles = ves_tile_count(grid);
    for (int t = 0; t < tiles; t++) {
        ves_tile tile;
        int pole[VES_LANES];
        ves_tile_at(grid, t, fields, &tile);
        ves_chart_sample(chart, &tile, plan->field);
        ves_tile_scale(&tile, plan->similarity, plan->field);
        ves_form_rows form;
        ves_form_rows_init(plan->form, &form);
        if (rows->pole && ves_pole_lanes(grid, &tile, f->pole, pole))
            ves_pole_unfold(&tile, pole, plan->field);
        if (ves_forms_eval(&tile, plan->field, f->side, true, &form) != VES_OK) rows->status = VES_DEGENERATE;
        rows->take(plan, f, rows, &tile);
    }
    return VES_OK;
}

static int node_of(const ves_figure_patch *f, const visit *rows, const ves_tile *tile, int row, int lane)
{
    return (rows->first + tile->block + lane) * f->columns + tile->row[row];
}

static void take_forms(const ves_plan *plan, ves_figure_patch *f, const visit *rows, const ves_tile *tile)
{
    for (int r = 0; r < tile->rows; r++)
        for (int i = 0; i < tile->lanes; i++) {
            int to = node_of(f, rows, tile, r, i), from = r * VES_LANES + i;
            for (int c = 0; c < 3; c++) f->normal[c][to] = plan->form->at[VES_FORM_NX + c][from];
            double H = plan->form->at[VES_FORM_H][from], K = plan->form->at[VES_FORM_K][from];
            double root = H * H > K ? sqrt(H * H - K) : 0;
            f->H[to] = H, f->K[to] = K, f->k1[to] = H + root, f->k2[to] = H - root;
        }
}

static void take_all(const ves_plan *plan, ves_figure_patch *f, const visit *rows, const ves_tile *tile)
{
    for (int r = 0; r < tile->rows; r++)
        for (int i = 0; i < tile->lanes; i++)
            for (int c = 0; c < 3; c++)
                f->X[c][node_of(f, rows, tile, r, i)] = plan->field->at[c][r * VES_LANES + i];
    take_forms(plan, f, rows, tile);
}

enum { FORMS = 5 }; /* normal, H, K */

static void form_planes(const ves_figure_patch *f, double *plane[FORMS])
{
    double *const all[FORMS] = {f->normal[0], f->normal[1], f->normal[2], f->H, f->K};
    memcpy(plane, all, sizeof all);
}

/* The mean over v of the forms of one row. */
static void row_mean(const ves_figure_patch *f, int row, double mean[FORMS])
{
    double *plane[FORMS];
    form_planes(f, plane);
    for (int k = 0; k < FORMS; k++) {
        mean[k] = 0;
        for (int j = 0; j < f->nv; j++) mean[k] += plane[k][row * f->columns + j] / f->nv;
    }
}

static void row_fill(const ves_figure_patch *f, int row, const double form[FORMS])
{
    double *plane[FORMS], root = sqrt(fmax(0, form[3] * form[3] - form[4]));
    form_planes(f, plane);
    for (int j = row * f->columns; j < (row + 1) * f->columns; j++) {
        for (int k = 0; k < FORMS; k++) plane[k][j] = form[k];
        f->k1[j] = form[3] + root, f->k2[j] = form[3] - root;
    }
}

/* The forms of an end, taken `inside` of it; 0: at the very end, a pole. *good: there are forms. */
static ves_status row_sample(ves_plan *plan, ves_figure *figure, int k, int end, double inside, bool *good)
{
    const ves_figure_patch *f = &figure->patch[k];
    double *u = ves_arena_take(&figure->arena, 1, sizeof *u);
    if (!u) return VES_MEMORY;
    *u = end ? 1 - inside : inside;
    visit row = {.first = end ? f->nu : 0, .rows = 1, .u = u, .pole = inside == 0, .take = take_forms};
    VES_TRY(rows_sample(plan, figure, k, &row));
    *good = row.status == VES_OK;
    return VES_OK;
}

/* Where a pole has no limit: the surface comes to a point, forms grow without bound, and what stands beside
 * the pole stands for it; or its formula has no slope there, the means of the forms over v are even in u, and
 * (4 f(h/2) - f(h)) / 3 is their limit but for h^4. */
static ves_status blunt_limit(ves_plan *plan, ves_figure *figure, int k, int end, double limit[FORMS])
{
    const ves_figure_patch *f = &figure->patch[k];
    double far[FORMS], near[FORMS], beside[FORMS];
    int row = end ? f->nu : 0;
    bool good;
    VES_TRY(row_sample(plan, figure, k, end, INSIDE, &good));
    row_mean(f, row, far);
    VES_TRY(row_sample(plan, figure, k, end, INSIDE / 2, &good));
    row_mean(f, row, near);
    row_mean(f, end ? f->nu - 1 : 1, beside);
    bool pointed = false;
    for (int q = 3; q < FORMS; q++) pointed = pointed || !(fabs(near[q]) <= 1.5 * fabs(far[q]));
    for (int q = 0; q < FORMS; q++)
        limit[q] = !pointed ? (4 * near[q] - far[q]) / 3 : q < 3 ? near[q] : beside[q];
    return VES_OK;
}

/* A pole has one normal and one H and K, the mean over v of their limits (surface/pole.h). */
static ves_status pole_limit(ves_plan *plan, ves_figure *figure, int k, int end)
{
    const ves_figure_patch *f = &figure->patch[k];
    int row = end ? f->nu : 0;
    double limit[FORMS];
    bool smooth;
    VES_TRY(row_sample(plan, figure, k, end, 0, &smooth));
    row_mean(f, row, limit);
    if (!smooth) VES_TRY(blunt_limit(plan, figure, k, end, limit));
    double length = hypot(hypot(limit[0], limit[1]), limit[2]);
    for (int c = 0; c < 3; c++) limit[c] = length > 0 ? limit[c] / length : 0;
    row_fill(f, row, limit);
    return VES_OK;
}

/* Where the formula of a sheet has no slope at its very end (a half circle), the forms just inside stand for
 * those of the end; where it has none anywhere, the normal is zero. */
static ves_status blunt_ends(ves_plan *plan, ves_figure *figure, int k)
{
    const ves_figure_patch *f = &figure->patch[k];
    for (int end = 0; end < 2; end++) {
        double sum = 0;
        for (int j = 0; j < f->columns; j++) {
            int at = (end ? f->nu * f->columns : 0) + j;
            sum += f->normal[0][at] + f->H[at] + f->K[at];
        }
        bool good;
        if (!isfinite(sum)) VES_TRY(row_sample(plan, figure, k, end, INSIDE / 2, &good));
    }
    for (int s = 0; s < f->rows * f->columns; s++)
        if (!isfinite(f->normal[0][s] + f->normal[1][s] + f->normal[2][s]))
            for (int c = 0; c < 3; c++) f->normal[c][s] = 0;
    return VES_OK;
}

/* All rows; the last one for itself when it is moved along v. */
static ves_status patch_sample(ves_plan *plan, ves_figure *figure, int k)
{
    const ves_figure_patch *f = &figure->patch[k];
    double *u = ves_arena_take(&figure->arena, (size_t)f->rows, sizeof *u);
    if (!u) return VES_MEMORY;
    for (int i = 0; i < f->rows; i++) u[i] = (double)i / f->nu;
    bool slid = f->slide != 0;
    visit most = {.rows = f->rows - slid, .u = u, .take = take_all};
    visit last = {.first = f->nu, .rows = 1, .u = u + f->nu, .slide = f->slide, .take = take_all};
    VES_TRY(rows_sample(plan, figure, k, &most));
    if (slid) VES_TRY(rows_sample(plan, figure, k, &last));
    VES_TRY(blunt_ends(plan, figure, k));
    for (int end = 0; end < 2; end++)
        if (f->pole[end]) VES_TRY(pole_limit(plan, figure, k, end));
    return VES_OK;
}

static int root_of(const int *same, int node)
{
    while (same[node] != node) node = same[node];
    return node;
}

static void unite(int *same, int a, int b)
{
    int p = root_of(same, a), q = root_of(same, b);
    same[p > q ? p : q] = p > q ? q : p;
}

/* Which nodes of a sheet lie on each other. The last row slides along v so that its nodes meet those of the
 * first. */
static ves_status seams_lay(const ves_plan *plan, ves_figure *figure, int k)
{
    ves_figure_patch *f = &figure->patch[k];
    const plan_sheet *always = &plan->sheet[k];
    plan_sheet now;
    f->sides_meet = always->sides.joined && !f->periodic;
    f->ends_meet = always->ends.joined;
    if (!f->sides_meet && !f->ends_meet) return VES_OK;
    VES_TRY(ves_sheet_look(plan, k, &now)); /* the shift may vary */
    f->ends_meet = now.ends.joined && now.ends.reversed == always->ends.reversed;
    f->one_sided = ves_sheet_one_sided(always);
    int count = f->rows * f->columns, last = f->nu * f->columns;
    int *same = ves_arena_take(&figure->arena, (size_t)count, sizeof *same);
    if (!same) return VES_MEMORY;
    for (int s = 0; s < count; s++) same[s] = s;
    for (int end = 0; end < 2; end++)
        for (int j = 1; f->pole[end] && j < f->columns; j++) unite(same, end * last, end * last + j);
    for (int i = 0; i < f->rows && f->sides_meet; i++)
        unite(same, (always->sides.reversed ? f->nu - i : i) * f->columns, i * f->columns + f->nv);
    if (f->ends_meet) {
        double steps = now.ends.shift / VES_TWO_PI * f->nv;
        int whole = (int)lround(steps), sign = now.ends.reversed ? -1 : 1;
        if (f->periodic) f->slide = sign * (whole - steps) * VES_TWO_PI / f->nv;
        if (fabs(f->slide) < 1e-12) f->slide = 0;
        for (int j = 0; j < f->columns; j++) {
            int meets = whole + sign * j;
            unite(same, f->periodic ? (meets % f->nv + f->nv) % f->nv : meets, last + j);
        }
    }
    for (int s = 0; s < count; s++) same[s] = root_of(same, s);
    f->same = same;
    return VES_OK;
}

static ves_status patch_figure(ves_plan *plan, ves_figure *figure, int k, int nu, int nv)
{
    ves_figure_patch *f = &figure->patch[k];
    const char *name = plan->problem->patch[k].name;
    bool periodic = ves_patch_periodic(plan->patch[k]);
    if (nu <= 0)
        nu = plan->sheet[k].ends.joined ? 2 * ALONG : ALONG; /* u goes all the way round, as v does */
    *f = (ves_figure_patch){.name = ves_arena_text(&figure->arena, name, strlen(name)),
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
    if (!f->name) return VES_MEMORY;
    VES_TRY(patch_reserve(figure, f));
    VES_TRY(seams_lay(plan, figure, k));
    VES_TRY(patch_sample(plan, figure, k));
    for (int end = 0; end < 2; end++)
        if (f->cap[end] && !f->pole[end]) VES_TRY(ves_lid_make(f, end, &figure->arena));
    return VES_OK;
}

static int finest(const ves_plan *plan)
{
    int band = 0;
    for (int k = 0; k < plan->problem->patches; k++)
        if (ves_patch_band(plan->patch[k]) > band) band = ves_patch_band(plan->patch[k]);
    return band;
}

static int around(const ves_plan *plan)
{
    int band = finest(plan);
    return band < 12 ? 96 : band < 24 ? 192 : 288;
}

/* along: cells of each patch along u, or NULL: nu of all. */
static ves_status figure_make(ves_plan *plan, const int *along, int nu, int nv, ves_figure **out)
{
    *out = NULL;
    const ves_problem *p = plan->problem;
    if (nv <= 0) nv = around(plan);
    ves_figure *figure = ves_memory_take(sizeof *figure);
    if (!figure) return VES_MEMORY;
    figure->patches = p->patches;
    figure->closed = p->shape.closed;
    figure->unit = p->units ? "m" : NULL;
    figure->patch = ves_arena_take(&figure->arena, (size_t)p->patches, sizeof *figure->patch);
    figure->title = ves_arena_text(&figure->arena, p->title, strlen(p->title));
    ves_status status = figure->patch && figure->title ? VES_OK : VES_MEMORY;
    for (int k = 0; k < p->patches && status == VES_OK; k++)
        status = patch_figure(plan, figure, k, along ? along[k] : nu, nv);
    if (status == VES_OK)
        *out = figure;
    else
        ves_figure_destroy(figure);
    return status;
}

ves_status ves_plan_figure_make(ves_plan *plan, int nu, int nv, ves_figure **figure)
{
    return figure_make(plan, NULL, nu, nv, figure);
}

/* On grids that are chosen for finite elements: a coarse figure shows how long the patches are and how wide
 * layers at their edges. */
static ves_status elements_make(ves_plan *plan, ves_figure **figure)
{
    ves_figure *coarse;
    VES_TRY(figure_make(plan, NULL, COARSE, 2 * COARSE, &coarse));
    ves_status status = ves_figure_shell_make(plan, coarse);
    int *along = ves_arena_take(&coarse->arena, (size_t)coarse->patches, sizeof *along), nv = around(plan);
    if (!along) status = VES_MEMORY;
    if (status == VES_OK) {
        ves_figure_cells(coarse, along, &nv);
        status = figure_make(plan, along, 0, nv, figure);
    }
    ves_figure_destroy(coarse);
    return status;
}

/* The spines, which a proof has no use for. */
static ves_status spines_sample(ves_plan *plan, ves_figure *figure)
{
    for (int k = 0; k < figure->patches; k++) {
        ves_figure_patch *f = &figure->patch[k];
        double *u = ves_arena_doubles(&figure->arena, (size_t)f->rows),
               *at = ves_arena_doubles(&figure->arena, 9 * (size_t)f->rows);
        if (!u || !at) return VES_MEMORY;
        for (int i = 0; i < f->rows; i++) u[i] = (double)i / f->nu;
        ves_status status = ves_plan_spine(plan, k, f->rows, u, at);
        if (status == VES_MEMORY) return status;
        for (int c = 0; c < 3 && status == VES_OK; c++) f->spine[c] = at + c * f->rows;
    }
    return VES_OK;
}

static ves_status whole_make(ves_plan *plan, int nu, int nv, ves_figure **figure)
{
    bool elements = nu == VES_FIGURE_ELEMENTS && plan->problem->shell;
    VES_TRY(elements ? elements_make(plan, figure)
                     : ves_plan_figure_make(plan, nu > 0 ? nu : 0, nv > 0 ? nv : 0, figure));
    ves_status status = spines_sample(plan, *figure);
    if (status == VES_OK) status = ves_figure_shell_make(plan, *figure);
    if (status == VES_OK) status = ves_figure_fields_make(plan, *figure);
    if (status != VES_OK) ves_figure_destroy(*figure), *figure = NULL;
    return status;
}

static bool drawable(const ves_plan *plan, int nu, int nv)
{
    if (nu == VES_FIGURE_ELEMENTS && nv == VES_FIGURE_ELEMENTS) return true;
    return nu >= 0 && nu <= CELLS_MOST && (nv == 0 || (nv >= 3 && nv <= CELLS_MOST)) &&
           (double)nu * nv * plan->problem->patches <= ALL_MOST;
}

ves_status ves_plan_figure(ves_plan *plan, const double *x, int nu, int nv, ves_figure **figure,
                           ves_diag *diag)
{
    *figure = NULL;
    if (!drawable(plan, nu, nv))
        return ves_diag_add(
            diag, VES_ERROR, VES_RANGE, (ves_mark){0},
            "a figure has 1 to %d cells along u and 3 to %d along v, %d in all: %d x %d on %d "
            "patch%s are not possible",
            CELLS_MOST, CELLS_MOST, ALL_MOST, nu, nv, plan->problem->patches,
            plan->problem->patches == 1 ? "" : "es");
    ves_status status = ves_plan_forward(plan, x, 0, PROGRAM_JUDGE, false);
    bool drawn =
        status >= VES_OK && status != VES_NO_ROOT && status != VES_NO_BRACKET && status != VES_NO_SCALE;
    ves_status wrong = drawn ? status : VES_OK;
    if (drawn) status = whole_make(plan, nu, nv, figure);
    if (*figure && !ves_plan_figure_finite(plan, *figure, "there is no shape to show", diag)) {
        ves_figure_destroy(*figure);
        *figure = NULL;
        return VES_NO_POINT;
    }
    if (wrong != VES_OK && *figure)
        ves_diag_add(diag, VES_WARNING, wrong, (ves_mark){0}, "the shape is drawn%s although %s",
                     plan->scaled ? "" : ", not scaled,", ves_status_text(wrong));
    if (status == VES_OK) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, status, (ves_mark){0}, "there is no shape to show: %s",
                        ves_status_text(status));
}

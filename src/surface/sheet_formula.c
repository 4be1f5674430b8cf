/* Sheets given by formulas of u and v: every derivative is a formula too, made once. */
#include "base/vector.h"
#include "surface/sheet.h"

#include <string.h>

typedef struct drawn {
    const ves_formula *formula[VES_FIELDS][3];
    double u_range[2], v_range[2];
    int room;
} drawn;

/* Surface coordinates -> the formula's, and the factor of a derivative. */
static double inward(const double range[2], double t)
{
    return range[0] + (range[1] - range[0]) * t;
}

static double factor(const drawn *d, int f)
{
    double u = d->u_range[1] - d->u_range[0], v = (d->v_range[1] - d->v_range[0]) / VES_TWO_PI, product = 1;
    for (int k = 0; k < ves_field_d[f]; k++) product *= u;
    for (int k = 0; k < ves_field_e[f]; k++) product *= v;
    return product;
}

static ves_status chart_create(ves_patch *patch, ves_chart *chart, ves_arena *arena)
{
    ves_sheet *sheet;
    return ves_sheet_create(chart, (size_t)((drawn *)patch->state)->room, arena, &sheet);
}

static void prepare(ves_chart *chart, const ves_bound *bound, bool gradient)
{
    const drawn *d = chart->patch->state;
    ves_sheet *s = chart->state;
    const ves_grid *grid = chart->grid;
    (void)gradient;
    if (!ves_sheet_stale(chart)) return;
    for (int f = 0; f < VES_FIELDS; f++)
        for (int c = 0; c < 3 && chart->fields & 1u << f; c++)
            for (int j = 0; j < grid->nv; j++)
                for (int i = 0; i < grid->nu; i++) {
                    double at[2] = {inward(d->u_range, grid->u[i]),
                                    inward(d->v_range, grid->v[j] / VES_TWO_PI)};
                    double value = ves_formula_eval(d->formula[f][c], bound->number, at, s->room);
                    s->plane[f][c][j * grid->nu + i] = factor(d, f) * value;
                }
}

static void gather(ves_chart *chart, const ves_bound *bound, double *number_adjoint)
{
    const drawn *d = chart->patch->state;
    ves_sheet *s = chart->state;
    const ves_grid *grid = chart->grid;
    for (int f = 0; f < VES_FIELDS; f++)
        for (int c = 0; c < 3 && chart->fields & 1u << f; c++)
            for (int j = 0; j < grid->nv; j++)
                for (int i = 0; i < grid->nu; i++) {
                    double at[2] = {inward(d->u_range, grid->u[i]),
                                    inward(d->v_range, grid->v[j] / VES_TWO_PI)};
                    double seed = factor(d, f) * s->adjoint[f][c][j * grid->nu + i];
                    if (seed == 0) continue;
                    ves_formula_gradient(d->formula[f][c], bound->number, at, seed, number_adjoint, NULL,
                                         s->room);
                }
}

static long point_room(const ves_patch *patch)
{
    return ((const drawn *)patch->state)->room;
}

static void point(const ves_patch *patch, const ves_bound *bound, int count, const double *u, const double *v,
                  double *out, double *room)
{
    const drawn *d = patch->state;
    for (int f = 0; f < VES_FIELDS; f++)
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < count; k++) {
                double at[2] = {inward(d->u_range, u[k]), inward(d->v_range, v[k] / VES_TWO_PI)};
                out[(f * 3 + c) * count + k] =
                    factor(d, f) * ves_formula_eval(d->formula[f][c], bound->number, at, room);
            }
}

static const ves_patch_ops FORMULA = {.chart = chart_create,
                                      .move = ves_sheet_move,
                                      .bind = ves_sheet_idle_bind,
                                      .prepare = prepare,
                                      .sample = ves_sheet_sample,
                                      .clear = ves_sheet_idle_clear,
                                      .clear_chart = ves_sheet_clear,
                                      .scatter = ves_sheet_scatter,
                                      .gather = gather,
                                      .unbind = ves_sheet_idle_unbind,
                                      .point_room = point_room,
                                      .point = point};

/* The formula of field f: derived once more from an earlier field. */
static ves_status derive(drawn *d, int c, ves_arena *arena)
{
    static const int parent[VES_FIELDS] = {0,           VES_FIELD_X, VES_FIELD_X,
                                           VES_FIELD_U, VES_FIELD_U, VES_FIELD_V};
    static const int argument[VES_FIELDS] = {0, 0, 1, 0, 1, 1};
    for (int f = 1; f < VES_FIELDS; f++) {
        d->formula[f][c] = ves_formula_derivative(d->formula[parent[f]][c], argument[f], arena);
        if (!d->formula[f][c]) return VES_MEMORY;
    }
    for (int f = 0; f < VES_FIELDS; f++) {
        int room = ves_formula_room(d->formula[f][c]);
        if (room > d->room) d->room = room;
    }
    return VES_OK;
}

ves_status ves_patch_formula(const ves_sheet_formula *sheet, const ves_bound *bound, ves_arena *arena,
                             ves_patch **patch)
{
    *patch = NULL;
    drawn *d = ves_arena_take(arena, 1, sizeof *d);
    ves_patch *made = ves_arena_take(arena, 1, sizeof *made);
    if (!d || !made) return VES_MEMORY;
    *made = (ves_patch){.ops = &FORMULA, .periodic = sheet->periodic, .state = d};
    memcpy(d->u_range, sheet->u_range, sizeof d->u_range);
    memcpy(d->v_range, sheet->v_range, sizeof d->v_range);
    for (int c = 0; c < 3; c++) {
        d->formula[0][c] = sheet->formula[c];
        VES_TRY(derive(d, c, arena));
        for (int slot = ves_formula_slots(sheet->formula[c]) - 1; slot >= 0; slot--)
            made->varies =
                made->varies || (bound->varying[slot] && ves_formula_uses_slot(sheet->formula[c], slot));
    }
    *patch = made;
    return VES_OK;
}

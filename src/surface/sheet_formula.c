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

/* What a chart that may see a pole needs besides. */
typedef struct drawn_pole {
    const ves_formula *formula[VES_POLE_FIELDS - VES_FIELDS][3];
} drawn_pole;

static const ves_formula *formula_of(const ves_chart *chart, int f, int c)
{
    const drawn *d = chart->patch->state;
    const drawn_pole *pole = ((const ves_sheet *)chart->state)->tables;
    return f < VES_FIELDS ? d->formula[f][c] : pole->formula[f - VES_FIELDS][c];
}

static int larger(int room, const ves_formula *formula)
{
    int own = ves_formula_room(formula);
    return own > room ? own : room;
}

/* Derived once more along v from an earlier field. */
static ves_status pole_derive(const drawn *d, int c, drawn_pole *pole, int *room, ves_arena *arena)
{
    const ves_formula *const parent[] = {d->formula[VES_FIELD_UV][c], d->formula[VES_FIELD_UU][c]};
    for (int f = 0; f < VES_POLE_FIELDS - VES_FIELDS; f++) {
        const ves_formula *from = f < 2 ? parent[f] : pole->formula[VES_FIELD_UUV - VES_FIELDS][c];
        pole->formula[f][c] = ves_formula_derivative(from, 1, arena);
        if (!pole->formula[f][c]) return VES_MEMORY;
        *room = larger(*room, pole->formula[f][c]);
    }
    return VES_OK;
}

static ves_status chart_create(ves_patch *patch, ves_chart *chart, ves_arena *arena)
{
    const drawn *d = patch->state;
    drawn_pole *pole = NULL;
    int room = d->room;
    if (chart->fields >> VES_FIELDS) {
        pole = ves_arena_take(arena, 1, sizeof *pole);
        if (!pole) return VES_MEMORY;
        for (int c = 0; c < 3; c++) VES_TRY(pole_derive(d, c, pole, &room, arena));
    }
    ves_sheet *sheet;
    VES_TRY(ves_sheet_create(chart, (size_t)room, arena, &sheet));
    sheet->tables = pole;
    return VES_OK;
}

static ves_status prepare(ves_chart *chart, const ves_bound *bound, bool gradient)
{
    const drawn *d = chart->patch->state;
    ves_sheet *s = chart->state;
    const ves_grid *grid = chart->grid;
    (void)gradient;
    if (!ves_sheet_stale(chart)) return VES_OK;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int c = 0; c < 3 && chart->fields & 1u << f; c++)
            for (int j = 0; j < grid->nv; j++)
                for (int i = 0; i < grid->nu; i++) {
                    double at[2] = {inward(d->u_range, grid->u[i]),
                                    inward(d->v_range, grid->v[j] / VES_TWO_PI)};
                    double value = ves_formula_eval(formula_of(chart, f, c), bound->number, at, s->room);
                    s->plane[f][c][j * grid->nu + i] = factor(d, f) * value;
                }
    return VES_OK;
}

static void gather(ves_chart *chart, const ves_bound *bound, double *number_adjoint)
{
    const drawn *d = chart->patch->state;
    ves_sheet *s = chart->state;
    const ves_grid *grid = chart->grid;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int c = 0; c < 3 && chart->fields & 1u << f; c++)
            for (int j = 0; j < grid->nv; j++)
                for (int i = 0; i < grid->nu; i++) {
                    double at[2] = {inward(d->u_range, grid->u[i]),
                                    inward(d->v_range, grid->v[j] / VES_TWO_PI)};
                    double seed = factor(d, f) * s->adjoint[f][c][j * grid->nu + i];
                    if (seed == 0) continue;
                    ves_formula_gradient(formula_of(chart, f, c), bound->number, at, seed, number_adjoint,
                                         NULL, s->room);
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
    for (int f = 0; f < VES_FIELDS; f++) d->room = larger(d->room, d->formula[f][c]);
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

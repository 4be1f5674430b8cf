#include "surface/sheet.h"

#include <string.h>

ves_status ves_sheet_create(ves_chart *chart, size_t room, ves_arena *arena, ves_sheet **sheet)
{
    ves_sheet *s = ves_arena_take(arena, 1, sizeof *s);
    if (!s) return VES_MEMORY;
    size_t count = (size_t)chart->grid->count;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int c = 0; c < 3 && chart->fields & 1u << f; c++) {
            s->plane[f][c] = ves_arena_doubles(arena, count);
            s->adjoint[f][c] = ves_arena_doubles(arena, chart->patch->varies ? count : 0);
            if (!s->plane[f][c] || !s->adjoint[f][c]) return VES_MEMORY;
        }
    s->room = ves_arena_doubles(arena, room);
    if (!s->room) return VES_MEMORY;
    chart->state = *sheet = s;
    return VES_OK;
}

bool ves_sheet_stale(ves_chart *chart)
{
    ves_sheet *s = chart->state;
    if (s->binding == chart->patch->binding) return false;
    s->binding = chart->patch->binding;
    return true;
}

void ves_sheet_move(ves_chart *chart)
{
    ((ves_sheet *)chart->state)->binding = -1;
}

void ves_sheet_clear(ves_chart *chart)
{
    ves_sheet *s = chart->state;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int c = 0; c < 3 && chart->fields & 1u << f; c++)
            memset(s->adjoint[f][c], 0, sizeof(double) * (size_t)chart->grid->count);
}

/* Lanes beyond the grid repeat the last node. */
static int node(const ves_chart *chart, const ves_tile *tile, int row, int lane)
{
    return tile->row[row] * chart->grid->nu + tile->block + (lane < tile->lanes ? lane : tile->lanes - 1);
}

void ves_sheet_sample(const ves_chart *chart, const ves_tile *tile, ves_tile_planes *field)
{
    const ves_sheet *s = chart->state;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int c = 0; c < 3 && tile->fields & 1u << f; c++)
            for (int r = 0; r < tile->rows; r++)
                for (int i = 0; i < VES_LANES; i++)
                    field->at[f * 3 + c][r * VES_LANES + i] = s->plane[f][c][node(chart, tile, r, i)];
}

void ves_sheet_scatter(ves_chart *chart, const ves_tile *tile, const ves_tile_planes *adjoint)
{
    ves_sheet *s = chart->state;
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int c = 0; c < 3 && tile->fields & 1u << f; c++)
            for (int r = 0; r < tile->rows; r++)
                for (int i = 0; i < VES_LANES; i++)
                    s->adjoint[f][c][node(chart, tile, r, i)] += adjoint->at[f * 3 + c][r * VES_LANES + i];
}

void ves_sheet_idle_bind(ves_patch *patch, const ves_bound *bound)
{
    (void)patch, (void)bound;
}

void ves_sheet_idle_clear(ves_patch *patch)
{
    (void)patch;
}

void ves_sheet_idle_unbind(ves_patch *patch, const ves_bound *bound, double *number_adjoint)
{
    (void)patch, (void)bound, (void)number_adjoint;
}

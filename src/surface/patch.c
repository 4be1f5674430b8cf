#include <math.h>

#include "surface/kind.h"

bool ves_patch_periodic(const ves_patch *patch)
{
    return patch->periodic;
}

bool ves_patch_varies(const ves_patch *patch)
{
    return patch->varies;
}

int ves_patch_modes(const ves_patch *patch)
{
    return patch->modes;
}

int ves_patch_band(const ves_patch *patch)
{
    return patch->band;
}

double ves_patch_tail(const ves_patch *patch)
{
    return patch->ops->tail ? patch->ops->tail(patch) : 0;
}

ves_status ves_chart_create(ves_patch *patch, const ves_grid *grid, unsigned fields, ves_arena *arena,
                            ves_chart **chart)
{
    *chart = NULL;
    ves_chart *c = ves_arena_take(arena, 1, sizeof *c);
    if (!c) return VES_MEMORY;
    *c = (ves_chart){.patch = patch, .grid = grid, .fields = fields};
    VES_TRY(patch->ops->chart(patch, c, arena));
    *chart = c;
    return VES_OK;
}

void ves_chart_move(ves_chart *chart)
{
    chart->patch->ops->move(chart);
}

void ves_patch_bind(ves_patch *patch, const ves_bound *bound)
{
    if (patch->varies || !patch->binding) {
        patch->binding++;
        patch->ops->bind(patch, bound);
    }
}

ves_status ves_patch_status(const ves_patch *patch)
{
    return patch->ops->status ? patch->ops->status(patch) : VES_OK;
}

const ves_layout *ves_patch_layout(const ves_patch *patch)
{
    return patch->ops->layout ? patch->ops->layout(patch) : NULL;
}

bool ves_patch_amplification(const ves_patch *patch, double n, ves_amplification *found)
{
    return patch->ops->amplification && patch->ops->amplification(patch, n, NAN, found);
}

bool ves_patch_amplification_at(const ves_patch *patch, double lam, ves_amplification *found)
{
    return patch->ops->amplification && patch->ops->amplification(patch, 1, lam, found);
}

double ves_patch_rest(const ves_patch *patch)
{
    return patch->rest;
}

ves_status ves_chart_prepare(ves_chart *chart, const ves_bound *bound, bool gradient)
{
    return chart->patch->ops->prepare(chart, bound, gradient && chart->patch->varies);
}

void ves_chart_sample(const ves_chart *chart, const ves_tile *tile, ves_tile_planes *field)
{
    chart->patch->ops->sample(chart, tile, field);
}

void ves_patch_clear(ves_patch *patch)
{
    if (patch->varies) patch->ops->clear(patch);
}

void ves_chart_clear(ves_chart *chart)
{
    if (chart->patch->varies) chart->patch->ops->clear_chart(chart);
}

void ves_chart_scatter(ves_chart *chart, const ves_tile *tile, const ves_tile_planes *adjoint)
{
    if (chart->patch->varies) chart->patch->ops->scatter(chart, tile, adjoint);
}

void ves_chart_gather(ves_chart *chart, const ves_bound *bound, double *number_adjoint)
{
    if (chart->patch->varies) chart->patch->ops->gather(chart, bound, number_adjoint);
}

void ves_patch_unbind(ves_patch *patch, const ves_bound *bound, double *number_adjoint)
{
    if (patch->varies) patch->ops->unbind(patch, bound, number_adjoint);
}

long ves_patch_point_room(const ves_patch *patch)
{
    return patch->ops->point_room(patch);
}

void ves_patch_point(const ves_patch *patch, const ves_bound *bound, int count, const double *u,
                     const double *v, double *out, double *room)
{
    patch->ops->point(patch, bound, count, u, v, out, room);
}

bool ves_patch_spine(const ves_patch *patch, const ves_bound *bound, int count, const double *u, double *out,
                     double *room)
{
    return patch->ops->spine && patch->ops->spine(patch, bound, count, u, out, room);
}

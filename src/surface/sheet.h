/* Sheets: patches given explicitly, by formulas or by points. Their charts keep whole planes of the fields: a
 * sheet that does not vary is evaluated once. */
#ifndef VES_SURFACE_SHEET_H
#define VES_SURFACE_SHEET_H

#include "surface/kind.h"

typedef struct ves_sheet {
    double *plane[VES_POLE_FIELDS][3],
        *adjoint[VES_POLE_FIELDS][3]; /* [count]; NULL where the chart does not have the field */
    double *room;
    long binding; /* of the planes */
    void *tables;
} ves_sheet;

ves_status ves_sheet_create(ves_chart *chart, size_t room, ves_arena *arena, ves_sheet **sheet);
bool ves_sheet_stale(ves_chart *chart); /* true once for each binding */
void ves_sheet_move(ves_chart *chart);  /* makes it so once more */
void ves_sheet_clear(ves_chart *chart);
void ves_sheet_sample(const ves_chart *chart, const ves_tile *tile, ves_tile_planes *field);
void ves_sheet_scatter(ves_chart *chart, const ves_tile *tile, const ves_tile_planes *adjoint);

/* What a sheet does not need. */
void ves_sheet_idle_bind(ves_patch *patch, const ves_bound *bound);
void ves_sheet_idle_clear(ves_patch *patch);
void ves_sheet_idle_unbind(ves_patch *patch, const ves_bound *bound, double *number_adjoint);

#endif

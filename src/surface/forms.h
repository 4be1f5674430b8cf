/* Fundamental forms of a tile: unit normal, area element, mean and Gaussian curvature [Ugail 2011, eqs 7.4-7.5],
 * and the transpose.
 *     n = Xu x Xv,  J = |n|,  N = side n / J
 *     H = -side (E n.Xvv - 2 F n.Xuv + G n.Xuu) / (2 J^3)
 *     K = (n.Xuu n.Xvv - (n.Xuv)^2) / J^4
 * Sign: with the outward normal H = +1/R on a sphere of radius R. One reciprocal square root a node.
 * test  sphere, torus, catenoid in closed form; gradient against differences; rigid motion */
#ifndef VES_SURFACE_FORMS_H
#define VES_SURFACE_FORMS_H

#include "surface/tile.h"
#include "vesica/status.h"

enum { VES_FORM_NX, VES_FORM_NY, VES_FORM_NZ, VES_FORM_J, VES_FORM_H, VES_FORM_K, VES_FORMS };

typedef struct ves_form_planes {
    _Alignas(64) double at[VES_FORMS][VES_TILE_STRIDE];
} ves_form_planes;

/* Where forms go: a plane for each, NULL where one is not wanted; row r of the tile begins at offset[r].
 * weight: J is multiplied by it (then it is dA), or NULL. */
typedef struct ves_form_rows {
    double *at[VES_FORMS];
    const size_t *offset;
    const double *weight;
} ves_form_rows;

/* All planes of a buffer, rows as in the tile. */
void ves_form_rows_init(ves_form_planes *planes, ves_form_rows *rows);

/* Fills normal and J; with `curvature` H and K too (the tile must then have the second derivatives).
 * VES_DEGENERATE when some node has no tangent plane: |Xu x Xv| below 1e-12 (|Xu|^2 + |Xv|^2), where rounding
 * decides the direction of the normal, or no number. */
ves_status ves_forms_eval(const ves_tile *tile, const ves_tile_planes *field, double side, bool curvature,
                          const ves_form_rows *form);

/* Overwrites d J / d (first and, with `curvature`, second derivatives), given d J / d forms (normal, J, H,
 * K). */
typedef struct ves_form_flow {
    bool normal, curvature; /* whether J depends on them; planes of what it does not depend on are not read */
} ves_form_flow;
void ves_forms_gradient(const ves_tile *tile, const ves_tile_planes *field, double side, ves_form_flow flow,
                        const ves_form_planes *form_adjoint, ves_tile_planes *field_adjoint);

#endif

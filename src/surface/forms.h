/* Fundamental forms of a tile: unit normal, area element, mean and Gaussian curvature [Ugail 2011,
 * eqs 7.4-7.5], and the transpose. n = Xu x Xv, J = |n|, N = side n / J, H = -side (E n.Xvv - 2 F n.Xuv + G
 * n.Xuu) / (2 J^3), K = (n.Xuu n.Xvv - (n.Xuv)^2) / J^4 Sign: with the outward normal H = +1/R on a sphere of
 * radius R. One square root and one division a node. test  sphere, torus, catenoid in closed form; gradient
 * against differences; rigid motion */
#ifndef VES_SURFACE_FORMS_H
#define VES_SURFACE_FORMS_H

#include "surface/tile.h"

enum { VES_FORM_NX, VES_FORM_NY, VES_FORM_NZ, VES_FORM_J, VES_FORM_H, VES_FORM_K, VES_FORMS };

typedef struct ves_form_planes {
    _Alignas(64) double at[VES_FORMS][VES_TILE_STRIDE];
} ves_form_planes;

/* Fills normal and J; H and K too when the second derivatives are in the tile. Returns the least J^2 over the
 * largest (E + G)^2 seen: near 0 the surface has a point without a tangent plane. */
double ves_forms_eval(const ves_tile *tile, const ves_tile_planes *field, double side, ves_form_planes *form);

/* Overwrites d J / d (first and second derivatives), given d J / d forms (normal, J, H, K). no_normal: J does
 * not depend on the normal, whose planes are then not read. */
void ves_forms_gradient(const ves_tile *tile, const ves_tile_planes *field, double side, bool no_normal,
                        const ves_form_planes *form_adjoint, ves_tile_planes *field_adjoint);

#endif

#include "surface/forms.h"

#include <math.h>

#define HOT static inline __attribute__((always_inline))

typedef ves_lanes lanes;

static const double FLAT = 1e-24; /* the square of 1e-12 */

typedef struct vector {
    lanes x, y, z;
} vector;

HOT vector load(const ves_tile_planes *planes, int field, int s)
{
    return (vector){ves_lanes_at(planes->at[field * 3] + s), ves_lanes_at(planes->at[field * 3 + 1] + s),
                    ves_lanes_at(planes->at[field * 3 + 2] + s)};
}

HOT void store(ves_tile_planes *planes, int field, int s, vector v)
{
    ves_lanes_put(planes->at[field * 3] + s, v.x);
    ves_lanes_put(planes->at[field * 3 + 1] + s, v.y);
    ves_lanes_put(planes->at[field * 3 + 2] + s, v.z);
}

HOT vector cross(vector a, vector b)
{
    return (vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

HOT lanes dot(vector a, vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

HOT vector scaled(lanes f, vector a)
{
    return (vector){f * a.x, f * a.y, f * a.z};
}

HOT vector sum(vector a, vector b)
{
    return (vector){a.x + b.x, a.y + b.y, a.z + b.z};
}

/* The first and second fundamental forms at eight nodes, the second with n instead of the unit normal. */
typedef struct forms {
    vector xu, xv, n, uu, uv, vv;
    lanes E, F, G, L, M, N, r; /* r = 1 / |n| */
} forms;

HOT forms forms_at(const ves_tile_planes *field, int s, bool second)
{
    forms f = {.xu = load(field, VES_FIELD_U, s), .xv = load(field, VES_FIELD_V, s)};
    f.n = cross(f.xu, f.xv);
    f.r = ves_lanes_rsqrt(dot(f.n, f.n));
    f.E = dot(f.xu, f.xu), f.G = dot(f.xv, f.xv);
    if (!second) return f;
    f.F = dot(f.xu, f.xv);
    f.uu = load(field, VES_FIELD_UU, s), f.uv = load(field, VES_FIELD_UV, s),
    f.vv = load(field, VES_FIELD_VV, s);
    f.L = dot(f.n, f.uu), f.M = dot(f.n, f.uv), f.N = dot(f.n, f.vv);
    return f;
}

#define ROW(r) (size_t)(r) * VES_LANES
static const size_t IN_ORDER[VES_TILE_ROWS] = {ROW(0),  ROW(1),  ROW(2),  ROW(3), ROW(4),  ROW(5),
                                               ROW(6),  ROW(7),  ROW(8),  ROW(9), ROW(10), ROW(11),
                                               ROW(12), ROW(13), ROW(14), ROW(15)};

void ves_form_rows_init(ves_form_planes *planes, ves_form_rows *rows)
{
    for (int k = 0; k < VES_FORMS; k++) rows->at[k] = planes->at[k];
    rows->offset = IN_ORDER;
    rows->weight = NULL;
}

HOT void put(double *plane, size_t at, lanes x)
{
    if (plane) ves_lanes_put(plane + at, x);
}

HOT ves_status eval(const ves_tile *tile, const ves_tile_planes *field, double side, bool second,
                    const ves_form_rows *form)
{
    lanes least = HUGE_VAL + (lanes){0}, total = {0};
    double *const *to = form->at, *nx = to[VES_FORM_NX], *ny = to[VES_FORM_NY], *nz = to[VES_FORM_NZ],
                  *dA = to[VES_FORM_J], *H = to[VES_FORM_H], *K = to[VES_FORM_K];
    const double *weight = form->weight;
    for (int row = 0; row < tile->rows; row++) {
        forms f = forms_at(field, row * VES_LANES, second);
        lanes j2 = dot(f.n, f.n), g = f.E + f.G, r2 = f.r * f.r, t = side * f.r, j = j2 * f.r;
        size_t at = form->offset[row];
        put(nx, at, t * f.n.x);
        put(ny, at, t * f.n.y);
        put(nz, at, t * f.n.z);
        put(dA, at, weight ? j * ves_lanes_at(weight + at) : j);
        least = ves_lanes_min(least, j2 - FLAT * g * g);
        total += j2;
        if (!second) continue;
        put(H, at, -0.5 * (f.E * f.N - 2 * f.F * f.M + f.G * f.L) * r2 * t);
        put(K, at, (f.L * f.N - f.M * f.M) * r2 * r2);
    }
    int good = 1; /* a minimum forgets what is no number, a sum does not */
    for (int k = 0; k < VES_LANES; k++) good &= (least[k] > 0) & (total[k] - total[k] == 0);
    return good ? VES_OK : VES_DEGENERATE;
}

ves_status ves_forms_eval(const ves_tile *tile, const ves_tile_planes *field, double side, bool curvature,
                          const ves_form_rows *form)
{
    return curvature ? eval(tile, field, side, true, form) : eval(tile, field, side, false, form);
}

/* p = E N - 2 F M + G L and q = L N - M^2 carry H and K; everything flows back through n, E, F, G. g?: d J /
 * d ?. */
HOT void gradient(const ves_tile *tile, const ves_tile_planes *field, double side, bool second, bool normal,
                  const ves_form_planes *form_adjoint, ves_tile_planes *field_adjoint)
{
    for (int s = 0; s < tile->rows * VES_LANES; s += VES_LANES) {
        forms f = forms_at(field, s, second);
        lanes r2 = f.r * f.r, t = side * f.r, along = ves_lanes_at(form_adjoint->at[VES_FORM_J] + s) * f.r;
        lanes gE = {0}, gF = {0}, gG = {0};
        vector gn = {{0}, {0}, {0}};
        if (normal) {
            vector g = {ves_lanes_at(form_adjoint->at[VES_FORM_NX] + s),
                        ves_lanes_at(form_adjoint->at[VES_FORM_NY] + s),
                        ves_lanes_at(form_adjoint->at[VES_FORM_NZ] + s)};
            gn = scaled(t, g);
            along -= t * r2 * dot(g, f.n); /* the normal is n over |n| */
        }
        if (second) {
            lanes gp = -0.5 * t * r2 * ves_lanes_at(form_adjoint->at[VES_FORM_H] + s);
            lanes gq = r2 * r2 * ves_lanes_at(form_adjoint->at[VES_FORM_K] + s);
            lanes p = f.E * f.N - 2 * f.F * f.M + f.G * f.L, q = f.L * f.N - f.M * f.M;
            lanes gL = gp * f.G + gq * f.N, gM = -2 * (gp * f.F + gq * f.M), gN = gp * f.E + gq * f.L;
            along -= (3 * gp * p + 4 * gq * q) * r2; /* |n|^3 and |n|^4 in the denominators of H and K */
            gE = gp * f.N, gF = -2 * gp * f.M, gG = gp * f.L;
            gn = sum(gn, sum(scaled(gL, f.uu), sum(scaled(gM, f.uv), scaled(gN, f.vv))));
            store(field_adjoint, VES_FIELD_UU, s, scaled(gL, f.n));
            store(field_adjoint, VES_FIELD_UV, s, scaled(gM, f.n));
            store(field_adjoint, VES_FIELD_VV, s, scaled(gN, f.n));
        }
        gn = sum(gn, scaled(along, f.n)); /* d|n| = n . dn / |n| */
        store(field_adjoint, VES_FIELD_U, s,
              sum(cross(f.xv, gn), sum(scaled(2 * gE, f.xu), scaled(gF, f.xv))));
        store(field_adjoint, VES_FIELD_V, s,
              sum(cross(gn, f.xu), sum(scaled(2 * gG, f.xv), scaled(gF, f.xu))));
    }
}

void ves_forms_gradient(const ves_tile *tile, const ves_tile_planes *field, double side, ves_form_flow flow,
                        const ves_form_planes *form_adjoint, ves_tile_planes *field_adjoint)
{
    /* Four kernels from one text: with constant flags each is one loop without branches. */
    if (flow.curvature && flow.normal)
        gradient(tile, field, side, true, true, form_adjoint, field_adjoint);
    else if (flow.curvature)
        gradient(tile, field, side, true, false, form_adjoint, field_adjoint);
    else if (flow.normal)
        gradient(tile, field, side, false, true, form_adjoint, field_adjoint);
    else
        gradient(tile, field, side, false, false, form_adjoint, field_adjoint);
}

#include "plan/displace.h"

#include <math.h>

/* In components along (cos v e1 + sin v e2), around, and along e3. */
typedef struct local {
    double at[VES_FIELDS][3];
} local;

/* D and its derivatives at a node. */
static local direction(const plan_displacement *d, int i)
{
    const double r = d->radial[0][i], ru = d->radial[1][i], ruu = d->radial[2][i];
    return (local){.at = {[VES_FIELD_X] = {r, 0, d->axial[0][i]},
                          [VES_FIELD_U] = {ru, 0, d->axial[1][i]},
                          [VES_FIELD_V] = {0, r, 0},
                          [VES_FIELD_UU] = {ruu, 0, d->axial[2][i]},
                          [VES_FIELD_UV] = {0, ru, 0},
                          [VES_FIELD_VV] = {-r, 0, 0}}};
}

/* The product rule: out = derivatives of a D, a those of the amplitude. */
static local product(const double a[VES_FIELDS], const local *D)
{
    local out;
    const double(*d)[3] = D->at;
    for (int c = 0; c < 3; c++) {
        out.at[VES_FIELD_X][c] = a[VES_FIELD_X] * d[VES_FIELD_X][c];
        out.at[VES_FIELD_U][c] = a[VES_FIELD_U] * d[VES_FIELD_X][c] + a[VES_FIELD_X] * d[VES_FIELD_U][c];
        out.at[VES_FIELD_V][c] = a[VES_FIELD_V] * d[VES_FIELD_X][c] + a[VES_FIELD_X] * d[VES_FIELD_V][c];
        out.at[VES_FIELD_UU][c] = a[VES_FIELD_UU] * d[VES_FIELD_X][c] +
                                  2 * a[VES_FIELD_U] * d[VES_FIELD_U][c] +
                                  a[VES_FIELD_X] * d[VES_FIELD_UU][c];
        out.at[VES_FIELD_UV][c] = a[VES_FIELD_UV] * d[VES_FIELD_X][c] + a[VES_FIELD_U] * d[VES_FIELD_V][c] +
                                  a[VES_FIELD_V] * d[VES_FIELD_U][c] + a[VES_FIELD_X] * d[VES_FIELD_UV][c];
        out.at[VES_FIELD_VV][c] = a[VES_FIELD_VV] * d[VES_FIELD_X][c] +
                                  2 * a[VES_FIELD_V] * d[VES_FIELD_V][c] +
                                  a[VES_FIELD_X] * d[VES_FIELD_VV][c];
    }
    return out;
}

static double along(const local *g, int f, const local *D, int of)
{
    return g->at[f][0] * D->at[of][0] + g->at[f][1] * D->at[of][1] + g->at[f][2] * D->at[of][2];
}

/* Its transpose: d J / d (derivatives of the amplitude). */
static void product_gradient(const local *g, const local *D, double a[VES_FIELDS])
{
    enum { X = VES_FIELD_X, U = VES_FIELD_U, V = VES_FIELD_V, UU = VES_FIELD_UU, UV = VES_FIELD_UV };
    enum { VV = VES_FIELD_VV };
    a[X] = 0;
    for (int f = 0; f < VES_FIELDS; f++) a[X] += along(g, f, D, f);
    a[U] = along(g, U, D, X) + 2 * along(g, UU, D, U) + along(g, UV, D, V);
    a[V] = along(g, V, D, X) + along(g, UV, D, U) + 2 * along(g, VV, D, V);
    a[UU] = along(g, UU, D, X);
    a[UV] = along(g, UV, D, X);
    a[VV] = along(g, VV, D, X);
}

/* The frame turned by v: outward, around, along the axis. */
static void turned(const plan_displacement *d, double v, double frame[3][3])
{
    const double c = cos(v), s = sin(v);
    for (int k = 0; k < 3; k++) {
        frame[0][k] = c * d->frame[0][k] + s * d->frame[1][k];
        frame[1][k] = c * d->frame[1][k] - s * d->frame[0][k];
        frame[2][k] = d->frame[2][k];
    }
}

static void move(const plan_motion *m, const ves_tile *tile, ves_tile_planes *field)
{
    for (int f = 0; f < VES_FIELDS; f++)
        for (int k = 0; k < tile->rows * VES_LANES && tile->fields & 1u << f; k++) {
            double x[3];
            for (int c = 0; c < 3; c++) x[c] = field->at[f * 3 + c][k];
            for (int c = 0; c < 3; c++)
                field->at[f * 3 + c][k] = m->turn[c][0] * x[0] + m->turn[c][1] * x[1] + m->turn[c][2] * x[2] +
                                          (f == VES_FIELD_X ? m->shift[c] : 0);
        }
}

/* Lanes beyond the grid repeat its last u. */
static int node_of(const plan_displacement *d, const ves_tile *tile, int lane)
{
    const int i = tile->block + lane;
    return i < d->nu ? i : d->nu - 1;
}

void ves_displace(const plan_displacement *d, const ves_tile *tile, ves_tile_planes *field)
{
    for (int r = 0; r < tile->rows; r++) {
        const double v = d->v[tile->row[r]], c = cos(d->n * v), s = -d->n * sin(d->n * v);
        double frame[3][3];
        turned(d, v, frame);
        for (int lane = 0; lane < VES_LANES; lane++) {
            const int i = node_of(d, tile, lane), at = r * VES_LANES + lane;
            const double w = d->wave[0][i], wu = d->wave[1][i];
            const double a[VES_FIELDS] = {[VES_FIELD_X] = d->even[0][i] + w * c,
                                          [VES_FIELD_U] = d->even[1][i] + wu * c,
                                          [VES_FIELD_V] = w * s,
                                          [VES_FIELD_UU] = d->even[2][i] + d->wave[2][i] * c,
                                          [VES_FIELD_UV] = wu * s,
                                          [VES_FIELD_VV] = -d->n * d->n * w * c};
            const local D = direction(d, i), add = product(a, &D);
            for (int f = 0; f < VES_FIELDS; f++)
                for (int k = 0; k < 3 && tile->fields & 1u << f; k++)
                    field->at[f * 3 + k][at] +=
                        add.at[f][0] * frame[0][k] + add.at[f][1] * frame[1][k] + add.at[f][2] * frame[2][k];
        }
    }
    if (d->motion) move(d->motion, tile, field);
}

void ves_displace_gradient(const plan_displacement *d, const ves_tile *tile, const ves_tile_planes *adjoint)
{
    for (int r = 0; r < tile->rows; r++) {
        const double v = d->v[tile->row[r]], c = cos(d->n * v), s = -d->n * sin(d->n * v);
        double frame[3][3];
        turned(d, v, frame);
        for (int lane = 0; lane < tile->lanes; lane++) {
            const int i = tile->block + lane, at = r * VES_LANES + lane;
            const local D = direction(d, i);
            local g = {{{0}}};
            double a[VES_FIELDS];
            for (int f = 0; f < VES_FIELDS; f++)
                for (int k = 0; k < 3 && tile->fields & 1u << f; k++)
                    for (int e = 0; e < 3; e++) g.at[f][e] += adjoint->at[f * 3 + k][at] * frame[e][k];
            product_gradient(&g, &D, a);
            d->by[0][i] += c * (a[VES_FIELD_X] - d->n * d->n * a[VES_FIELD_VV]) + s * a[VES_FIELD_V];
            d->by[1][i] += c * a[VES_FIELD_U] + s * a[VES_FIELD_UV];
            d->by[2][i] += c * a[VES_FIELD_UU];
        }
    }
}

/* Tiles: a patch is sampled a small piece at a time, 8 nodes along u by at most 16 rows along v, so that its
 * six fields and all that is derived from them stay in the first-level cache; only the planes that a measure
 * asked for are written out. (Storing all 18 planes of 16 x 32 nodes costs more time than computing them.)
 *
 * Inside a tile node (row r, lane i) of plane p is at[p][r * VES_LANES + i]. Lanes beyond the grid repeat its
 * last u. */
#ifndef VES_SURFACE_TILE_H
#define VES_SURFACE_TILE_H

#ifdef __AVX512F__
#include <immintrin.h>
#endif
#include <math.h>

#include "surface/grid.h"

enum { VES_FIELD_X, VES_FIELD_U, VES_FIELD_V, VES_FIELD_UU, VES_FIELD_UV, VES_FIELD_VV, VES_FIELDS };

/* What else is needed at a pole (surface/pole.h). */
enum { VES_FIELD_UVV = VES_FIELDS, VES_FIELD_UUV, VES_FIELD_UUVV, VES_POLE_FIELDS };

enum {
    VES_TILE_ROWS = 16,
    VES_TILE_STRIDE = (VES_TILE_ROWS + 1) * VES_LANES
}; /* the odd row keeps planes out of one cache set */

/* A register of nodes along u. GCC's vector extension: on narrower machines it becomes several registers. */
typedef double ves_lanes __attribute__((vector_size(VES_LANES * sizeof(double))));

static inline ves_lanes ves_lanes_at(const double *from)
{
    ves_lanes x;
    __builtin_memcpy(&x, from, sizeof x);
    return x;
}

static inline void ves_lanes_put(double *to, ves_lanes x)
{
    __builtin_memcpy(to, &x, sizeof x);
}

/* 1 / sqrt(x) to about one unit in the last place; not a number where x is 0. With AVX-512 from the 14-bit
 * estimate by two steps of Newton: a square root and a division of whole registers cost five times as much. */
static inline ves_lanes ves_lanes_rsqrt(ves_lanes x)
{
#ifdef __AVX512F__
    ves_lanes r = (ves_lanes)_mm512_rsqrt14_pd((__m512d)x), half = 0.5 * x;
    for (int k = 0; k < 2; k++) {
        ves_lanes miss = 0.5 - half * r * r; /* (1 - x r^2) / 2 */
        r += r * miss;
    }
    return r;
#else
    ves_lanes r;
    for (int k = 0; k < VES_LANES; k++) r[k] = 1 / sqrt(x[k]);
    return r;
#endif
}

static inline ves_lanes ves_lanes_min(ves_lanes a, ves_lanes b)
{
    typedef long long mask __attribute__((vector_size(sizeof(ves_lanes))));
    mask less = a < b;
    return (ves_lanes)((less & (mask)a) | (~less & (mask)b));
}

/* Halves on halves: three additions deep, not seven. */
static inline double ves_lanes_sum(ves_lanes x)
{
    double a = x[0] + x[4], b = x[1] + x[5], c = x[2] + x[6], d = x[3] + x[7];
    return (a + c) + (b + d);
}

/* Which derivative each field is: along u and along v. */
extern const int ves_field_d[VES_POLE_FIELDS], ves_field_e[VES_POLE_FIELDS];

typedef struct ves_tile {
    int block; /* first node along u */
    int lanes; /* how many of the 8 are nodes of the grid */
    int first,
        run; /* of a symmetric grid: quarter rows first .. first + run - 1, four rows each; else plain rows */
    int rows;                     /* rows in the tile */
    int row[VES_TILE_ROWS];       /* their index along v */
    size_t offset[VES_TILE_ROWS]; /* where they begin in a plane of the grid */
    unsigned fields;              /* bit f: field f is filled */
} ves_tile;

typedef struct ves_tile_planes {
    _Alignas(64) double at[VES_POLE_FIELDS * 3][VES_TILE_STRIDE];
} ves_tile_planes;

/* Number of tiles of a grid, and the k-th. */
int ves_tile_count(const ves_grid *grid);
void ves_tile_at(const ves_grid *grid, int index, unsigned fields, ves_tile *tile);

/* Multiplies the fields that the tile names. */
void ves_tile_scale(const ves_tile *tile, double factor, ves_tile_planes *field);

/* nu rounded up to whole registers. */
static inline int ves_padded(int nu)
{
    return (nu + VES_LANES - 1) / VES_LANES * VES_LANES;
}

#endif

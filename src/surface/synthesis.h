/* Synthesis: from the modes of a patch along u to fields on a grid, and back (the transpose) [Ugail 2011, eq 4.36].
 *     d_u^d d_v^e X(u_i, v_j) = sum_n A_n^(d)(u_i) (cos n v_j)^(e) + B_n^(d)(u_i) (sin n v_j)^(e)
 * Modes: mode[((d * 3 + c) * stride + k) * nup + i], stride = 1 + 2 * modes, nup = nu rounded up to whole
 * registers; k = 0 the mean, 2n-1 the cosine, 2n the sine of mode n. Allocates nothing but in create.
 * test  against direct sums; the transpose by random inner products */
#ifndef VES_SURFACE_SYNTHESIS_H
#define VES_SURFACE_SYNTHESIS_H

#include "surface/tile.h"

/* d^e/dv^e of cos(n v) and of sin(n v), e = 0 .. 2: what the coefficients a_n and b_n are multiplied by. */
void ves_wave(int n, double v, int e, double *of_cosine, double *of_sine);

/* Tables of n^e cos(n v_j) and n^e sin(n v_j) on a grid. */
typedef struct ves_synthesis {
    const ves_grid *grid;
    int modes;
    int rows;      /* v nodes in the tables: a quarter of them on a symmetric grid */
    double *table; /* [e][block of 4 rows][k][4], e = 0..2, k = 0 .. 2 modes: the factor of coefficient k in
                    * d^e/dv^e, in the order in which the loops read it */
} ves_synthesis;

ves_status ves_synthesis_create(const ves_grid *grid, int modes, ves_arena *arena, ves_synthesis *synthesis);

/* After the grid's v have changed. */
void ves_synthesis_move(const ves_synthesis *synthesis);

/* Overwrites the fields that the tile names. */
void ves_synthesis_eval(const ves_synthesis *synthesis, const double *mode, const ves_tile *tile,
                        ves_tile_planes *out);

/* Adds to d J / d mode, given d J / d fields of one tile. */
void ves_synthesis_gradient(const ves_synthesis *synthesis, const ves_tile *tile,
                            const ves_tile_planes *adjoint, double *mode_adjoint);

#endif

#include "surface/synthesis.h"

#include <math.h>
#include <stddef.h>

#include "curve/modes.h"

typedef ves_lanes lanes;

#define HOT static inline __attribute__((always_inline))

enum { FOUR = 4, TWO = 2 }; /* rows side by side in the tables, and in one pass of the sums */

static int blocks(const ves_synthesis *s)
{
    return (s->rows + FOUR - 1) / FOUR;
}

/* Factors of one row: coefficient k at [FOUR * k]. */
HOT double *row_table(const ves_synthesis *s, int e, int row)
{
    return s->table + (size_t)((e * blocks(s) + row / FOUR) * (1 + 2 * s->modes) * FOUR + row % FOUR);
}

void ves_wave(int n, double v, int e, double *of_cosine, double *of_sine)
{
    double c = cos(n * v), s = sin(n * v), p = e == 0 ? 1 : e == 1 ? n : (double)n * n;
    *of_cosine = p * (e == 0 ? c : e == 1 ? -s : -c);
    *of_sine = p * (e == 0 ? s : e == 1 ? c : -s);
}

/* Both derivatives sit in the place of the coefficient that they multiply. */
static void fill(const ves_synthesis *s)
{
    for (int e = 0; e < 3; e++)
        for (int j = 0; j < s->rows; j++) {
            double *t = row_table(s, e, j);
            t[0] = e == 0;
            for (int n = 1; n <= s->modes; n++)
                ves_wave(n, s->grid->v[j], e, &t[(2 * n - 1) * FOUR], &t[2 * n * FOUR]);
        }
}

ves_status ves_synthesis_create(const ves_grid *grid, int modes, ves_arena *arena, ves_synthesis *s)
{
    *s = (ves_synthesis){.grid = grid, .modes = modes, .rows = grid->symmetric ? grid->nv / 4 : grid->nv};
    s->table = ves_arena_take(arena, (size_t)(3 * (1 + 2 * modes) * blocks(s) * FOUR), sizeof(double));
    if (!s->table) return VES_MEMORY;
    fill(s);
    return VES_OK;
}

/* One sine and one cosine a row: looks between nodes come many to an evaluation. */
void ves_synthesis_move(const ves_synthesis *s)
{
    for (int j = 0; j < s->rows; j++) {
        const double step[2] = {cos(s->grid->v[j]), sin(s->grid->v[j])};
        double z[2] = {1, 0}, *t[3];
        for (int e = 0; e < 3; e++) t[e] = row_table(s, e, j);
        for (int n = 1; n <= s->modes; n++) {
            int c = (2 * n - 1) * FOUR, d = 2 * n * FOUR;
            ves_turn(z, step);
            t[0][c] = z[0], t[0][d] = z[1];
            t[1][c] = -n * z[1], t[1][d] = n * z[0];
            t[2][c] = -(double)n * n * z[0], t[2][d] = -(double)n * n * z[1];
        }
    }
}

/* Adds one coefficient of three coordinates, times its factors in `rows` rows. */
HOT void add(const double *const mode[3], ptrdiff_t m, const double *t, lanes sum[3][TWO], int rows)
{
    for (int c = 0; c < 3; c++) {
        lanes x = *(const lanes *)(mode[c] + m);
        for (int r = 0; r < rows; r++) sum[c][r] += x * t[r];
    }
}

/* The symmetric grid: v, pi - v, pi + v, 2 pi - v. Even and odd modes, functions even and odd in v: four
 * partial sums at a quarter of the nodes give all of them. For e = 1 the coefficient of a cosine multiplies a
 * sine, and the two swap roles. Two rows of three coordinates at a time: 24 sums in registers, and every load
 * serves two products or three. */
HOT void fold_rows(const ves_synthesis *s, const double *t, bool swapped, const double *const mode[3],
                   double *const out[3], int rows)
{
    int nu = ves_padded(s->grid->nu);
    lanes ce[3][TWO], co[3][TWO], se[3][TWO], so[3][TWO];
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < rows; r++) {
            ce[c][r] = *(const lanes *)mode[c] * t[r];
            co[c][r] = se[c][r] = so[c][r] = (lanes){0};
        }
    const double *tn = t + FOUR;
    ptrdiff_t m = nu;
    int n = 1;
    for (; n + 1 <= s->modes; n += 2, m += 4 * nu, tn += 4 * FOUR) {
        add(mode, m, tn, co, rows);
        add(mode, m + nu, tn + FOUR, so, rows);
        add(mode, m + 2 * nu, tn + 2 * FOUR, ce, rows);
        add(mode, m + 3 * nu, tn + 3 * FOUR, se, rows);
    }
    if (n <= s->modes) {
        add(mode, m, tn, co, rows);
        add(mode, m + nu, tn + FOUR, so, rows);
    }
    for (int c = 0; c < 3; c++)
        for (int r = 0; r < rows; r++) {
            lanes E = swapped ? se[c][r] : ce[c][r], O = swapped ? so[c][r] : co[c][r];
            lanes e = swapped ? ce[c][r] : se[c][r], o = swapped ? co[c][r] : so[c][r];
            lanes p = E + O, d = E - O, x = e + o, y = o - e, *w = (lanes *)out[c] + 4 * r;
            w[0] = p + x;
            w[1] = d + y;
            w[2] = d - y;
            w[3] = p - x;
        }
}

HOT void fold_field(const ves_synthesis *s, int e, bool swapped, const double *mode, const ves_tile *tile,
                    double (*out)[VES_TILE_STRIDE])
{
    size_t plane = (size_t)((1 + 2 * s->modes) * ves_padded(s->grid->nu));
    const double *const from[3] = {mode, mode + plane, mode + 2 * plane};
    for (int k = 0; k < tile->run; k += TWO) {
        const double *t = row_table(s, e, tile->first + k);
        int at = 4 * k * VES_LANES;
        double *const to[3] = {out[0] + at, out[1] + at, out[2] + at};
        if (k + TWO <= tile->run)
            fold_rows(s, t, swapped, from, to, TWO);
        else
            fold_rows(s, t, swapped, from, to, 1);
    }
}

/* Any grid. */
static void plain_field(const ves_synthesis *s, int e, const double *mode, const ves_tile *tile, double *out)
{
    int nu = ves_padded(s->grid->nu);
    for (int r = 0; r < tile->rows; r++) {
        const double *t = row_table(s, e, tile->row[r]);
        lanes sum = {0};
        for (int k = 0; k < 1 + 2 * s->modes; k++) sum += *(const lanes *)(mode + k * nu) * t[k * FOUR];
        ((lanes *)out)[r] = sum;
    }
}

/* Where the modes of a field begin for this tile. */
static size_t offset(const ves_synthesis *s, int d, int c, const ves_tile *tile)
{
    int nu = ves_padded(s->grid->nu);
    return (size_t)((d * 3 + c) * (1 + 2 * s->modes) * nu + tile->block);
}

void ves_synthesis_eval(const ves_synthesis *s, const double *mode, const ves_tile *tile,
                        ves_tile_planes *out)
{
    for (int f = 0; f < VES_POLE_FIELDS; f++) {
        if (!(tile->fields & 1u << f)) continue;
        int e = ves_field_e[f];
        const double *m = mode + offset(s, ves_field_d[f], 0, tile);
        double(*o)[VES_TILE_STRIDE] = &out->at[f * 3];
        if (!s->grid->symmetric)
            for (int c = 0; c < 3; c++)
                plain_field(s, e, mode + offset(s, ves_field_d[f], c, tile), tile, o[c]);
        else if (e == 1)
            fold_field(s, 1, true, m, tile, o);
        else
            fold_field(s, e, false, m, tile, o);
    }
}

/* The transpose of fold_rows for a run of rows: fold the four nodes first, then one product per mode. */
HOT void unfold_rows(const ves_synthesis *s, const double *t, bool swapped, const double *in, double *mode,
                     int run)
{
    int nu = ves_padded(s->grid->nu);
    lanes ce[4], co[4], se[4], so[4];
    for (int r = 0; r < run; r++) {
        const lanes *g = (const lanes *)in + 4 * r;
        lanes p = g[0] + g[3], m = g[0] - g[3], d = g[1] + g[2], y = g[1] - g[2];
        lanes E = p + d, O = p - d, e = m - y, o = m + y;
        ce[r] = swapped ? e : E, co[r] = swapped ? o : O;
        se[r] = swapped ? E : e, so[r] = swapped ? O : o;
    }
    lanes mean = *(lanes *)mode;
    for (int r = 0; r < run; r++) mean += ce[r] * t[r];
    *(lanes *)mode = mean;
    double *m = mode + nu;
    const double *tn = t + FOUR;
    int n = 1;
    for (; n + 1 <= s->modes; n += 2, m += 4 * nu, tn += 4 * FOUR) {
        lanes a1 = *(lanes *)m, b1 = *(lanes *)(m + nu), a2 = *(lanes *)(m + 2 * nu),
              b2 = *(lanes *)(m + 3 * nu);
        for (int r = 0; r < run; r++) {
            a1 += co[r] * tn[r], b1 += so[r] * tn[FOUR + r];
            a2 += ce[r] * tn[2 * FOUR + r], b2 += se[r] * tn[3 * FOUR + r];
        }
        *(lanes *)m = a1, *(lanes *)(m + nu) = b1, *(lanes *)(m + 2 * nu) = a2, *(lanes *)(m + 3 * nu) = b2;
    }
    if (n <= s->modes) {
        lanes a1 = *(lanes *)m, b1 = *(lanes *)(m + nu);
        for (int r = 0; r < run; r++) a1 += co[r] * tn[r], b1 += so[r] * tn[FOUR + r];
        *(lanes *)m = a1, *(lanes *)(m + nu) = b1;
    }
}

HOT void unfold_field(const ves_synthesis *s, int e, bool swapped, const double *in, const ves_tile *tile,
                      double *mode)
{
    int k = 0;
    for (; k + FOUR <= tile->run; k += FOUR)
        unfold_rows(s, row_table(s, e, tile->first + k), swapped, in + 4 * k * VES_LANES, mode, FOUR);
    for (; k < tile->run; k++)
        unfold_rows(s, row_table(s, e, tile->first + k), swapped, in + 4 * k * VES_LANES, mode, 1);
}

static void plain_transpose(const ves_synthesis *s, int e, const double *in, const ves_tile *tile,
                            double *mode)
{
    int nu = ves_padded(s->grid->nu);
    for (int r = 0; r < tile->rows; r++) {
        const double *t = row_table(s, e, tile->row[r]);
        for (int k = 0; k < 1 + 2 * s->modes; k++)
            *(lanes *)(mode + k * nu) += ((const lanes *)in)[r] * t[k * FOUR];
    }
}

void ves_synthesis_gradient(const ves_synthesis *s, const ves_tile *tile, const ves_tile_planes *adjoint,
                            double *mode_adjoint)
{
    for (int f = 0; f < VES_POLE_FIELDS; f++) {
        if (!(tile->fields & 1u << f)) continue;
        int e = ves_field_e[f];
        for (int c = 0; c < 3; c++) {
            double *m = mode_adjoint + offset(s, ves_field_d[f], c, tile);
            const double *in = adjoint->at[f * 3 + c];
            if (!s->grid->symmetric)
                plain_transpose(s, e, in, tile, m);
            else if (e == 1)
                unfold_field(s, 1, true, in, tile, m);
            else
                unfold_field(s, e, false, in, tile, m);
        }
    }
}

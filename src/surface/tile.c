#include "surface/tile.h"

const int ves_field_d[VES_POLE_FIELDS] = {0, 1, 0, 2, 1, 0, 1, 2, 2};
const int ves_field_e[VES_POLE_FIELDS] = {0, 0, 1, 0, 1, 2, 2, 1, 2};

/* What is cut along v: quarter rows of a symmetric grid, else rows. */
static int pieces(const ves_grid *grid)
{
    return grid->symmetric ? grid->nv / 4 : grid->nv;
}

static int run_length(const ves_grid *grid)
{
    return grid->symmetric ? VES_TILE_ROWS / 4 : VES_TILE_ROWS;
}

int ves_tile_count(const ves_grid *grid)
{
    int run = run_length(grid);
    return (pieces(grid) + run - 1) / run * (ves_padded(grid->nu) / VES_LANES);
}

void ves_tile_at(const ves_grid *grid, int index, unsigned fields, ves_tile *tile)
{
    int run = run_length(grid), all = pieces(grid), runs = (all + run - 1) / run;
    tile->fields = fields;
    tile->block = index / runs * VES_LANES;
    tile->lanes = grid->nu - tile->block < VES_LANES ? grid->nu - tile->block : VES_LANES;
    tile->first = index % runs * run;
    tile->run = all - tile->first < run ? all - tile->first : run;
    tile->rows = grid->symmetric ? 4 * tile->run : tile->run;
    int half = grid->nv / 2;
    for (int k = 0; k < tile->run; k++) {
        int q = tile->first + k;
        if (grid->symmetric) {
            tile->row[4 * k] = q, tile->row[4 * k + 1] = half - 1 - q;
            tile->row[4 * k + 2] = half + q, tile->row[4 * k + 3] = grid->nv - 1 - q;
        } else {
            tile->row[k] = q;
        }
    }
    for (int r = 0; r < tile->rows; r++) tile->offset[r] = (size_t)(tile->row[r] * grid->nu + tile->block);
}

void ves_tile_scale(const ves_tile *tile, double factor, ves_tile_planes *field)
{
    for (int f = 0; f < VES_POLE_FIELDS; f++)
        for (int c = 0; c < 3 && tile->fields & 1u << f; c++)
            for (int k = 0; k < tile->rows * VES_LANES; k++) field->at[f * 3 + c][k] *= factor;
}

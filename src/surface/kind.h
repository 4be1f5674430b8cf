/* Inside of patches: what each kind of patch implements. See patch.h for the order of calls. */
#ifndef VES_SURFACE_KIND_H
#define VES_SURFACE_KIND_H

#include "surface/patch.h"

typedef struct ves_patch_ops {
    ves_status (*chart)(ves_patch *patch, ves_chart *chart, ves_arena *arena);
    void (*move)(ves_chart *chart);
    void (*bind)(ves_patch *patch, const ves_bound *bound);
    ves_status (*prepare)(ves_chart *chart, const ves_bound *bound, bool gradient);
    void (*sample)(const ves_chart *chart, const ves_tile *tile, ves_tile_planes *field);
    void (*clear)(ves_patch *patch);
    void (*clear_chart)(ves_chart *chart);
    void (*scatter)(ves_chart *chart, const ves_tile *tile, const ves_tile_planes *adjoint);
    void (*gather)(ves_chart *chart, const ves_bound *bound, double *number_adjoint);
    void (*unbind)(ves_patch *patch, const ves_bound *bound, double *number_adjoint);
    long (*point_room)(const ves_patch *patch);
    void (*point)(const ves_patch *patch, const ves_bound *bound, int count, const double *u, const double *v,
                  double *out, double *room);
    bool (*spine)(const ves_patch *patch, const ves_bound *bound, int count, const double *u, double *out,
                  double *room);
    double (*tail)(const ves_patch *patch);              /* NULL: 0 */
    ves_status (*status)(const ves_patch *patch);        /* NULL: ok */
    const ves_layout *(*layout)(const ves_patch *patch); /* NULL: none */
    bool (*amplification)(const ves_patch *patch, double n, double lam,
                          ves_amplification *found); /* NULL: none */
} ves_patch_ops;

struct ves_patch {
    const ves_patch_ops *ops;
    bool periodic, varies;
    int modes, band;
    double rest;  /* ves_patch_rest */
    long binding; /* counts the bindings, so that charts know when their tables are stale */
    void *state;
};

struct ves_chart {
    ves_patch *patch;
    const ves_grid *grid;
    unsigned fields;
    void *state;
};

#endif

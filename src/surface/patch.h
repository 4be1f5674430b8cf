/* Patches: X(u, v) on [0, 1] x [0, 2 pi], however it is made. A patch is bound once for each x; a *chart* is
 * a patch on one grid with the tables that belong to it. The plan asks a chart for its fields tile by tile,
 * hands the adjoint of the fields back tile by tile, and at the end the patch hands its adjoint on to the
 * curves and numbers it was made of.
 *
 * Order of calls for one x:   bind, then for each chart: prepare, sample*        (values)
 *                             clear, then for each chart: clear, scatter*, gather; then unbind   (gradient)
 * Nothing here allocates after the chart is created. Everything lives in the plan's arena; one thread at a
 * time. */
#ifndef VES_SURFACE_PATCH_H
#define VES_SURFACE_PATCH_H

#include "curve/curve.h"
#include "surface/synthesis.h"
#include "surface/weights.h"

enum {
    VES_PATCH_MODES = 40, /* modes solved one by one unless the file says more; the rest is remainder */
    VES_PATCH_AMPLIFIED =
        1000 /* how much of the data conditions inside may make, unless the file says more */
};

typedef struct ves_patch ves_patch;
typedef struct ves_chart ves_chart;

/* Where the numbers come from: the number block and the curves bound to it. */
typedef struct ves_bound {
    const double *number;
    const bool *varying; /* [block] */
    ves_curves *curves;
} ves_bound;

/* A condition of a PDE patch: d_u^k X(u) = scale * sum of factor * curve. */
typedef struct ves_term {
    int curve;
    double factor;
} ves_term;

typedef struct ves_datum {
    int terms;
    const ves_term *term;
    int scale; /* number block index, -1: 1 */
} ves_datum;

/* A spine that is given: A_0(u), the mean of X over v, is this curve instead of what the equation makes of the
 * means of the conditions [Ugail 2011, 5.3]. It runs from the mean of the position at u = 0 to that at u = 1,
 * wherever these go, so that the surface stays joined to its ends. */
typedef enum ves_spine_kind {
    VES_SPINE_SOLVED,
    VES_SPINE_HERMITE, /* two vectors: the derivatives at u = 0 and u = 1 (eqs 5.5-5.8 as corrected) */
    VES_SPINE_BSPLINE /* clamped uniform cubic B-spline (of one vector: a parabola); they are its inner control points */
} ves_spine_kind;

typedef struct ves_spine {
    ves_spine_kind kind;
    int count; /* of vectors */
    int first; /* number block index of the first of 3 * count numbers */
} ves_spine;

/* What a PDE patch is made of. */
typedef struct ves_pde {
    ves_layout layout;
    const ves_datum *datum; /* [2N], one for each knot */
    bool general;
    int operators;    /* 1, or 3: x, y and z have one each */
    int parameter[3]; /* number block index of the first of the parameters of each (surface/operator.h) */
    /* Modes solved one by one; 0: all that the data at the start design have above 1e-5 of their largest, and
     * at least VES_PATCH_MODES; with conditions inside the patch, as many of them as are amplified less than
     * VES_PATCH_AMPLIFIED times. Modes beyond are all taken at lam = omega, the remainder of [Ugail 2011, eqs
     * 4.45-4.52 as corrected in docs/errata.md; Kubiesa 2004, eqs 22-28], so that all conditions are met
     * exactly. */
    int modes;
    int omega; /* number block index; -1: that of mode `modes` + 1, or lower where that cannot be solved */
    ves_spine spine;
} ves_pde;

/* VES_SINGULAR: the conditions do not determine the surface. The definition must outlive the patch. */
ves_status ves_patch_pde(const ves_pde *def, const ves_bound *bound, ves_arena *arena, ves_patch **patch);

/* X = (formula[0..2])(u', v') where u', v' run over the given ranges; arguments 0 and 1 of the formulas. */
typedef struct ves_sheet_formula {
    const ves_formula *formula[3];
    double u_range[2], v_range[2];
    bool periodic;
} ves_sheet_formula;
ves_status ves_patch_formula(const ves_sheet_formula *sheet, const ves_bound *bound, ves_arena *arena,
                             ves_patch **patch);

/* Interpolation of a grid of points by cubic splines: not-a-knot along u, and along v (periodic: closed).
 * points: number block index of the first of 3 * rows * columns numbers. */
ves_status ves_patch_points(int rows, int columns, int points, bool periodic, const ves_bound *bound,
                            ves_arena *arena, ves_patch **patch);

bool ves_patch_periodic(const ves_patch *patch);
bool ves_patch_varies(const ves_patch *patch);
int ves_patch_modes(const ves_patch *patch);   /* modes solved; 0 for other kinds */
int ves_patch_band(const ves_patch *patch);    /* band limit of the data; 0 for other kinds */
double ves_patch_tail(const ves_patch *patch); /* share of the bound data that the remainder carries */

/* fields: bit f for VES_FIELD_f, all that this chart will ever be asked for. The grid must outlive the chart. */
ves_status ves_chart_create(ves_patch *patch, const ves_grid *grid, unsigned fields, ves_arena *arena,
                            ves_chart **chart);

/* The nodes of the grid, as many as before, have other u and v now: the tables of the chart are stale. */
void ves_chart_move(ves_chart *chart);

void ves_patch_bind(ves_patch *patch, const ves_bound *bound);
/* VES_NOT_ELLIPTIC, when the operator of the design that is bound is not; VES_UNDETERMINED, when it is but cannot be
 * solved for the size of its numbers (surface/operator.h). */
ves_status ves_patch_status(const ves_patch *patch);
/* gradient: prepare also what gather needs. VES_UNDETERMINED: see surface/weights.h. */
ves_status ves_chart_prepare(ves_chart *chart, const ves_bound *bound, bool gradient);
void ves_chart_sample(const ves_chart *chart, const ves_tile *tile, ves_tile_planes *field);

void ves_patch_clear(ves_patch *patch);
void ves_chart_clear(ves_chart *chart);
void ves_chart_scatter(ves_chart *chart, const ves_tile *tile, const ves_tile_planes *adjoint);
void ves_chart_gather(ves_chart *chart, const ves_bound *bound, double *number_adjoint);
void ves_patch_unbind(ves_patch *patch, const ves_bound *bound, double *number_adjoint);

/* Exact values at scattered points: out[(f * 3 + c) * count + k]. room: ves_patch_point_room doubles, aligned
 * to 64 bytes. */
long ves_patch_point_room(const ves_patch *patch);
void ves_patch_point(const ves_patch *patch, const ves_bound *bound, int count, const double *u,
                     const double *v, double *out, double *room);

/* The spine A_0(u), the mean over v of X(u, .) [Ugail 2011, 5.3], of a PDE patch: out[(d * 3 + c) * count +
 * k], d = 0..2. false: this patch has none. */
bool ves_patch_spine(const ves_patch *patch, const ves_bound *bound, int count, const double *u, double *out,
                     double *room);

/* What the conditions make of mode n: the largest of the operators' (surface/weights.h). false: this patch has
 * none. */
bool ves_patch_amplification(const ves_patch *patch, double n, ves_amplification *found);
bool ves_patch_amplification_at(const ves_patch *patch, double lam,
                                ves_amplification *found); /* of a remainder */
double
ves_patch_rest(const ves_patch *patch); /* the mode, whole or not, as which that is solved if omega is auto */
const ves_layout *ves_patch_layout(const ves_patch *patch); /* NULL for other kinds */

#endif

/* Inside of PDE patches. Modes 0 .. M are solved one by one, A_n(u) = sum_j W_n(u)[j] F_n[j]; what the data
 * have beyond M is synthesised as residual curves r_j(v) and carried across the patch by one more weight
 * table. x, y and z share their tables unless they have operators of their own. A spine that is given takes
 * the place of A_0. */
#ifndef VES_SURFACE_PDE_H
#define VES_SURFACE_PDE_H

#include "surface/kind.h"

/* A spine that is given: A_0(u) = sum_q B_q(u) P_q, and P_q the means of the two ends, then the vectors. */
typedef struct pde_spine {
    int ends[2];             /* the conditions whose means it joins */
    int terms;               /* 0: A_0 is solved for */
    double *point, *adjoint; /* [terms][3] */
} pde_spine;

typedef struct pde {
    const ves_pde *def;
    ves_layout layout;
    int conditions; /* 2N */
    ves_operator op[3];
    ves_operator rest; /* of the remainder, where omega is given */
    ves_status status; /* of the operators of the current binding */
    int parameters;    /* of each operator */
    bool op_varies[3], omega_varies;
    int modes, band;      /* M and the data's band limit */
    double rest_mode;     /* as which the remainder is solved when omega is not given */
    double *data;         /* [conditions][3][1 + 2 band]: F */
    double *data_adjoint; /* same shape */
    double parameter_adjoint[3][VES_PARAMETERS_MAX], omega_adjoint;
    pde_spine spine;
} pde;

/* Weights of one operator on one grid, and the operator that they were made for. */
typedef struct pde_tables {
    double *table, *slope;     /* modes 0 .. M */
    double *rest, *rest_slope; /* the remainder [3][conditions][nup] */
    ves_operator made;
    double omega;
    bool fresh, has_slope; /* made, with slopes */
    ves_status modes_status, rest_status, status;
} pde_tables;

typedef struct pde_chart {
    int nup;
    int orders; /* derivatives along u that the chart's fields need: 0 .. orders - 1 */
    double *u;  /* nup places: the grid's, the last one repeated */
    pde_tables tables[3];
    double *spine; /* [3][terms][nup] */
    double *mode, *mode_adjoint;
    double *residual, *residual_adjoint; /* [conditions][e][3][nv] */
    double *wave;                        /* [e][n - M - 1][cos, sin][nv] for n > M */
    double *room;
    ves_synthesis synthesis;
    long binding;
} pde_chart;

/* Scattered points go this many at a time through a small table of their own. */
enum { PDE_CHUNK = VES_LANES };

/* Whole registers of places: the last one repeated. */
static inline void pde_places(int count, const double *u, int padded, double *place)
{
    for (int i = 0; i < padded; i++) place[i] = u[i < count ? i : count - 1];
}

/* Which operator coordinate k has. */
static inline int pde_operator(const pde *p, int k)
{
    return p->def->operators == 1 ? 0 : k;
}

/* pde_tables.c: weights at u for the design that is bound. */
ves_status ves_pde_tables_create(const pde *p, int nup, ves_arena *arena, pde_tables *tables);
ves_status ves_pde_tables_make(const pde *p, int op, int nup, const double *u, bool gradient,
                               pde_tables *tables, double *room);

/* pde_spine.c: the basis B_q(u) of a given spine, table[(d * terms + q) * nu + i], and its points. */
ves_status ves_pde_spine_create(pde *p, const ves_bound *bound, ves_arena *arena);
void ves_pde_spine_basis(const pde *p, int nu, const double *u, double *table);
void ves_pde_spine_bind(pde *p, const ves_bound *bound);
void ves_pde_spine_unbind(pde *p, double *number_adjoint); /* points' adjoint to data and numbers */

/* pde_gradient.c */
void ves_pde_clear(ves_patch *patch);
void ves_pde_clear_chart(ves_chart *chart);
void ves_pde_scatter(ves_chart *chart, const ves_tile *tile, const ves_tile_planes *adjoint);
void ves_pde_gather(ves_chart *chart, const ves_bound *bound, double *number_adjoint);
void ves_pde_unbind(ves_patch *patch, const ves_bound *bound, double *number_adjoint);

/* pde_point.c */
long ves_pde_point_room(const ves_patch *patch);
void ves_pde_point(const ves_patch *patch, const ves_bound *bound, int count, const double *u,
                   const double *v, double *out, double *room);
bool ves_pde_spine_points(const ves_patch *patch, const ves_bound *bound, int count, const double *u,
                          double *out, double *room);

#endif

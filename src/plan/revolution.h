/* A closed surface of revolution: patches in a row from pole to pole, seen as one meridian. */
#ifndef VES_PLAN_REVOLUTION_H
#define VES_PLAN_REVOLUTION_H

#include "base/arena.h"
#include "vesica/plan.h"

/* One patch, at the nodes along u of its site. Index of arrays of arrays: the derivative along u. */
typedef struct plan_meridian {
    int patch, nu;
    double end;          /* S where the next patch begins */
    double length;       /* m */
    double *weight;      /* [nu] du, times 2 pi around */
    double *bend;        /* curvature of the meridian, its size, 1/m */
    double *r[2], *z[2]; /* distance from the axis, height along it, m */
    double *S[3];        /* 0 at the first pole, pi at the last one: half by the arc length, half by how far
                                    the meridian turns, so that a neck has its share */
    double *radial[3], *axial[3]; /* a smooth field that leaves the surface: along r and z */
} plan_meridian;

typedef struct plan_revolution {
    int patches;
    plan_meridian *meridian; /* from the first pole to the last */
    double frame[3][3];      /* e1: where v is 0, e2: where it is pi/2; e3: the axis */
    double middle[3];        /* on the axis, where z is 0 */
    double length;           /* of the meridian, m */
} plan_revolution;

/* What a displacement by one amplitude along that field does there, [nu]: the part of it along the normal, dA in all
 * around, and the normal. `even` displaces the meridian first, [3][nu]; NULL: as it is. */
typedef struct plan_metric {
    double *share, *dA, *Nr, *Nz, *r, *z;
} plan_metric;

/* At the design that is bound. VES_ABSENT, with a message: the shape is no such surface. */
ves_status ves_revolution_find(ves_plan *plan, ves_arena *arena, plan_revolution *out, ves_diag *diag);
ves_status ves_metric_create(int nu, ves_arena *arena, plan_metric *out);
void ves_metric_find(const plan_meridian *m, double *const even[3], plan_metric *out);

#endif

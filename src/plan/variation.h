/* The first and second variation of a problem's objective and constraints at a surface of revolution, in functions of
 * the arc length: exact gradients (displace.h) and central differences of them. */
#ifndef VES_PLAN_VARIATION_H
#define VES_PLAN_VARIATION_H

#include "plan/inside.h"
#include "plan/revolution.h"

/* left - right, or a measure, which holds its value. */
typedef struct plan_condition {
    const char *text; /* as written; of scale: the name of its measure */
    const ves_formula *left, *right;
    int measure;       /* -1: left and right */
    int constraint;    /* of the problem, or -1 */
    bool one_sided;    /* an inequality: its multiplier must be <= 0 */
    double turn;       /* -1: at least; the excess is turn (left - right) */
    double hold;       /* what it was at the design */
    double multiplier; /* d objective / d excess, where the least is sought */
} plan_condition;

typedef struct plan_variation {
    ves_plan *plan;
    plan_revolution shape;
    plan_displacement *displacement; /* [patches] as in shape.meridian */
    plan_metric *metric;             /* [patches] of the surface that `even` makes */
    int functions, bends;            /* of them the last, see variation.c */
    double *basis[2];                /* [patch][derivative][function][nu], of n = 0 and of the n at hand */
    int n;
    double unit;  /* m: sqrt(area / 4 pi) at the design */
    double *even; /* [functions] what the surface is displaced by, m */
    double *wave; /* [functions] and the trial */
    int conditions;
    plan_condition *condition;
    double sign;                           /* of the objective: -1: it is maximised */
    double *missed[2], *against, *side[2]; /* scratch */
} plan_variation;

/* At the start design of the problem, whose plan is ves_plan_loose's and was evaluated there. */
ves_status ves_variation_create(ves_plan *plan, int smooth, ves_arena *arena, plan_variation *v,
                                ves_diag *diag);

/* Takes azimuthal mode n for what follows. */
void ves_variation_mode(plan_variation *v, int n);

/* The surface displaced by `even` and `wave`: its objective, and what each condition misses, [conditions]. */
ves_status ves_variation_value(plan_variation *v, double *objective, double *missed);

/* d objective weight + sum of multiplier[k] condition[k], by `wave`, after ves_variation_value there. */
ves_status ves_variation_slope(plan_variation *v, double objective, const double *multiplier, double *slope);

/* The Hessian of objective - sum multiplier condition, [functions][functions], not made symmetric; and the mass: the
 * integral of products of normal displacements. */
ves_status ves_variation_hessian(plan_variation *v, double *H);
void ves_variation_mass(plan_variation *v, double *M);

/* Of one function, displaced by 1, the part along the normal, at node i of a patch; after ves_variation_mass. */
double ves_variation_normal(const plan_variation *v, int function, int patch, int i);

/* Motions of the whole, a change of size among them: do objective and conditions not see it? And the products of its
 * normal displacement with those of the functions. */
typedef enum plan_symmetry {
    PLAN_LIFT,
    PLAN_SIZE,
    PLAN_SHIFT,
    PLAN_TILT,
    PLAN_SPIN,
    PLAN_SYMMETRIES
} plan_symmetry;
ves_status ves_variation_symmetric(plan_variation *v, plan_symmetry which, bool *symmetric);
void ves_variation_rigid(const plan_variation *v, plan_symmetry which, double *row);

#endif

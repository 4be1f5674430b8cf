/* Stability: is a design a minimum among all shapes near it, also among those that its variables cannot make? The second
 * variation of the objective under displacements of the surface that keep the constraints: its lowest eigenvalues, of
 * azimuthal mode n = 0 (axisymmetric), 1, 2, ...
 *
 * For closed surfaces of revolution and any objective and constraints made of measures that have gradients and read the
 * surface alone. The surface X is displaced by w(s) cos(n v) D(s, v), s the arc length of the meridian, w a sum of
 * Legendre functions of S, which runs from 0 to pi, half by the arc length and half by how far the meridian turns, D a
 * smooth field across the surface; first variations are the exact gradients of the measures, the second one their
 * central differences. First w of n = 0 leads from the design, which is the best of few
 * variables, to the stationary shape beside it (Newton's method); eigenvalues are those of the Lagrangian there,
 *     objective - sum of multiplier times constraint,
 * on the displacements that keep, in first order, scale:, solve: and the constraints that are met with equality. Motions
 * that change neither objective nor constraints (translations, rotations, a change of size where nothing has one) are
 * left out.
 *
 * An eigenvalue q says: displaced along its mode by e R0 along the normal, root of the mean square over the sphere of
 * the same area 4 pi R0^2, i.e. integral w^2 dA = e^2 R0^4, the objective (of a maximum: its negative) rises by
 * q e^2 / 2. So it has the unit of the objective. */
#ifndef VESICA_STABILITY_H
#define VESICA_STABILITY_H

#include <stdbool.h>

#include "vesica/diag.h"
#include "vesica/problem.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    VES_STABILITY_MODES = 12,
    VES_STABILITY_VALUES = 3,
    VES_STABILITY_FUNCTIONS = 96,
    VES_STABILITY_HOLDS = 8,
    VES_STABILITY_POINTS = 1024
};

/* The meridian that the eigenvalues belong to, from pole to pole, and its lowest modes: m. */
typedef struct ves_stability_profile {
    int points; /* not more than there are; of more nodes every second, third ... */
    double r[VES_STABILITY_POINTS], z[VES_STABILITY_POINTS]; /* from the axis, and along it */
    double wr[VES_STABILITY_MODES + 1]
             [VES_STABILITY_POINTS]; /* where v = 0: the displacement along the normal, e = 1 */
    double wz[VES_STABILITY_MODES + 1][VES_STABILITY_POINTS];
} ves_stability_profile;

/* All zeros: modes 0 .. 4, and functions as they are needed. */
typedef struct ves_stability_options {
    bool counted;  /* modes holds */
    int modes;     /* the highest n, 0 .. VES_STABILITY_MODES */
    int functions; /* of the arc length, 6 .. VES_STABILITY_FUNCTIONS; 0: chosen */

    /* Receives a change of the variables [variables], SI: added to the design it displaces the surface, as nearly as they
     * can, along the lowest mode by e = 1 (see above). Of n = along, or, if that is negative, of the softest. NULL: none. */
    double *change;
    int along;

    ves_stability_profile *profile; /* receives it; NULL: nobody wants it */
} ves_stability_options;

/* By the lowest eigenvalue: above its error, within it, below minus it. Unknown: there is no stationary shape near the
 * design, and what the eigenvalues of the others say nobody can tell. */
typedef enum ves_firmness { VES_FIRM, VES_SOFT, VES_UNSTABLE, VES_UNKNOWN } ves_firmness;

/* The lowest eigenvalues of one n. */
typedef struct ves_firmness_mode {
    int n, values;
    double value[VES_STABILITY_VALUES]; /* ascending */
    double error
        [VES_STABILITY_VALUES]; /* what fewer functions on a coarser grid change, and what differences leave */
    double parity
        [VES_STABILITY_VALUES]; /* +1: the amplitude is the same on both halves of the meridian, -1: opposite */
    ves_firmness firmness;
} ves_firmness_mode;

typedef struct ves_stability {
    int functions, quadrature[2];
    double radius;    /* R0 */
    double objective; /* of the design, in the sign of the file */
    int held; /* what a displacement may not change: the measure of scale:, solve, constraints met with equality */
    const char *holds[VES_STABILITY_HOLDS]; /* as written; the problem's. The first of them */
    double
        slope; /* how far the design is from stationary: the largest it falls by, per e (see above), at first order */
    bool relaxed;      /* the stationary shape was found: eigenvalues are its own, else those at the design */
    double stationary; /* the objective there */
    double unsure;     /* of it: what fewer functions on a coarser grid tell otherwise */
    double moved;      /* e of the way there */
    int modes;
    ves_firmness_mode mode[VES_STABILITY_MODES + 1];
    int softest; /* index of the mode with the lowest eigenvalue */
    ves_firmness firmness;
    int followed; /* the n that `change` is about */
    double made;  /* by it: the part of the mode's square that the variables can make, 0 .. 1 */

    /* The same in the variables of the file: eigenvalues of the Lagrangian's Hessian at the design itself, on the
     * variables that stand at no bound and the constraints, a variable's unit being its range; the lowest that are not
     * 0. flat: directions that change nothing, within the error of differences (of a shape that is scaled, its size). */
    int values, flat;
    double own[VES_STABILITY_VALUES], own_error[VES_STABILITY_VALUES];
    int own_along[VES_STABILITY_VALUES]; /* the variable that has the largest part of it */
} ves_stability;

/* Of the start design of the problem. VES_ABSENT, with a message: not of this shape or these measures. A positive status,
 * with a warning: the design cannot be measured. */
ves_status ves_stability_find(const ves_problem *problem, const ves_stability_options *options,
                              ves_stability *out, ves_diag *diag);

const char *ves_firmness_text(ves_firmness firmness); /* "stable", "soft", "unstable" */

#ifdef __cplusplus
}
#endif
#endif

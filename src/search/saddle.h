/* Second-order check at the end of a descent with gradients: is it a minimum or a saddle, and which way
 * down. */
#ifndef VES_SEARCH_SADDLE_H
#define VES_SEARCH_SADDLE_H

#include "search/descent.h"

enum { VES_SADDLE_MOST = 64 }; /* variables */

typedef struct ves_saddle {
    int active;         /* rows of constraints that hold as equations */
    int *row;           /* [m] their constraints */
    int near, *touched; /* [m] all constraints that the point touches */
    double *touching;   /* [m][n] the constraints' gradients at base */
    double *multiplier; /* [m]; 0 where not active */
    int frees;
    int *free;                    /* [n] variables that no wall holds */
    double *base;                 /* [n] the point, in the unit box */
    double *slope, *plus, *minus; /* [n] of the Lagrangian, scaled to the unit box */
    double *basis;                /* [m][n] orthonormal rows that span the active constraints' gradients */
    double *factor;               /* [m][n] their triangular factor; of both at most n rows */
    double *hessian, *vector, *value; /* [n][n], [n][n], [n] */
    double *direction;                /* [n] of lowest curvature, in the unit box */
    double *trial;                    /* [n] */
    double lagrangian;                /* at base */
    double lowest, largest;           /* curvatures: f per box width squared */
    int mostly;                       /* the variable that leads in direction */
    bool way[2];                      /* which sides of it the constraints and walls leave open */
    int edge; /* the variable along which there are designs that cannot be measured next to the point: then
                 it cannot be judged; -1: none */
    ves_status beyond; /* what is wrong with these */
    bool running;      /* there the value still falls or rises: no minimum of its own */
    bool stalled; /* away from any edge the slope has not vanished: no stationary point of a smooth value */
} ves_saddle;

/* second: also for the check, which needs n^2 numbers; without it multipliers alone can be had. */
bool ves_saddle_create(ves_saddle *saddle, ves_session *session, bool second);

/* Looks at u: what touches it, the multipliers and the slope of the Lagrangian. descent->last.status tells whether
 * it can be measured. */
ves_status ves_saddle_slopes(ves_saddle *saddle, ves_descent *descent, const double *u);

/* negative: the point is stationary, and there is a direction of negative curvature at it, clear of the noise
 * of the differences, that some feasible way follows. */
ves_status ves_saddle_check(ves_saddle *saddle, ves_descent *descent, const ves_point *point, bool *negative);

/* Steps along it, both ways where both are open; [0] and [1] are lower than the saddle when found[k]. */
ves_status ves_saddle_leave(ves_saddle *saddle, ves_descent *descent, ves_point *const side[2],
                            bool found[2]);

#endif

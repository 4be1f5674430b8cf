/* Gradients: how a number J made of one case's displacements and stresses changes with the shape, the walls, the loads and
 * the material. One solve with the factor that is there, K lambda = dJ/du; then with the bilinear form e(X, V; U, A) of
 * the strains, which is symmetric in (X, V) and (U, A),
 *     dJ = dJ|u + lambda' dF - e(dX, dV; lambda)' G e(u) - e(dX, dV; u)' G e(lambda) - e(lambda)' dG e(u),
 * and directors A = theta x V go along: theta is carried with the normal, whichever tangents it is counted in. Exact for
 * the discrete shell. Of a model with `gradients`. */
#ifndef VES_SHELL_ADJOINT_H
#define VES_SHELL_ADJOINT_H

#include "shell/shell.h"

/* dJ by what is read of a solved case; each may be NULL. */
typedef struct ves_shell_seed {
    const double *const (*U)[3], *const (*director)[3];     /* [sheets][s] ves_shell_displacement */
    const double (*stress)[VES_SHELL_LEVELS][VES_STRESSES]; /* [points] of ves_shell_stress, as the rest */
    const double *X[3], *thickness, *area;                  /* [points] */
    const double (*mean)[VES_SHELL_EDGES][3];               /* [sheets] ves_shell_edge_mean */
    double factor; /* of ves_shell_buckling of this case, called before; it must stand alone in its class */
    double work;   /* of ves_shell_work */
} ves_shell_seed;

/* Of the loads of one case on one sheet, as ves_shell_load. */
typedef struct ves_shell_load_gradient {
    double *area[3], *pressure, *line[VES_SHELL_EDGES][3];
} ves_shell_load_gradient;

/* What is added to; every plane may be NULL. The normal is one of its own, of any length: the gradient of a unit one has
 * no use for what lies along it. */
typedef struct ves_shell_gradient {
    double *const (*X)[3], *const (*normal)[3]; /* [sheets][s] */
    double *const *thickness;                   /* [sheets][s] */
    const ves_shell_load_gradient *load;        /* [sheets] */
    double (*force)[3];                         /* [points of the input] */
    double (*spring)[3], (*node_spring)[3];     /* [springs], [nodes] of the model */
    double E, nu, shear;
} ves_shell_gradient;

/* VES_DEGENERATE: seed->factor, and there is no mode of this case. VES_ABSENT: a sheet of order 1, whose interpolation of strains depends on the element's shape. */
ves_status ves_shell_adjoint(ves_shell *shell, int which, const ves_shell_seed *seed,
                             ves_shell_gradient *gradient);

/* Adds `by` times what the length of an edge (ves_shell_length) does. */
void ves_shell_length_pull(ves_shell *shell, int sheet, int edge, double by, double *const X[3]);

#endif

/* What loads and springs add to a gradient. */
#ifndef VES_SHELL_SIDE_H
#define VES_SHELL_SIDE_H

#include "shell/adjoint_inside.h"

/* Of one element: displacements u, and those that the forces of the case work on; adds to on_X [nodes] and to the planes of
 * the load. */
typedef struct shell_side {
    int which;
    const double (*U)[3], (*dual)[3],
        (*work)[3];                      /* [nodes]: u; lambda; lambda and what J reads of the work */
    double (*on_X)[3], (*spring)[3];     /* spring: [springs of the model]; NULL: not asked */
    const ves_shell_load_gradient *load; /* of the sheet; NULL: not asked */
} shell_side;
void ves_shell_loads_pull(const ves_shell *shell, const shell_element *element, const ves_shell_body *body,
                          const shell_side *side);
/* Springs alone: of - lambda' K u. */
void ves_shell_springs_pull(const ves_shell *shell, const shell_element *element, const ves_shell_body *body,
                            const shell_side *side);
/* Of `factor` times what pressure that follows the surface does on U (shell/geometric.h). */
void ves_shell_follow_pull(const ves_shell *shell, const shell_element *element, const ves_shell_body *body,
                           const shell_side *side, double factor);

/* The mean displacements along edges that J reads: begin, of the solved case; then of one element what they do on its
 * displacements, and on X. */
void ves_shell_means_begin(ves_shell *shell, int which, const ves_shell_seed *seed);
void ves_shell_means_read(const ves_shell *shell, const shell_element *element, const ves_shell_body *body,
                          double (*on_U)[3]);
void ves_shell_means_pull(const ves_shell *shell, const shell_element *element, const ves_shell_body *body,
                          const double (*U)[3], double (*on_X)[3]);

#endif

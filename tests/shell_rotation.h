/* The work of second order of a rigid rotation of a loaded shell, for tests of the shell room. */
#ifndef TEST_SHELL_ROTATION_H
#define TEST_SHELL_ROTATION_H

#include <criterion/criterion.h>

#include "base/vector.h"
#include "shell/geometric.h"

static inline double rotation_work(ves_shell *shell, const double theta[3])
{
    ves_arena arena = {0};
    shell_geometric g;
    double sum = 0;
    cr_assert(ves_shell_geometric_make(shell, &arena, &g) == VES_OK);
    for (int i = 0; i < shell->elements; i++) {
        const shell_element *e = &shell->element[i];
        cr_assert(ves_shell_geometric_take(shell, e, 0, &g) == VES_OK);
        ves_shell_body body = ves_shell_gather(shell, e);
        int count = ves_shell_columns_of(shell, &shell->layout[0], e);
        double x[6 * VES_SHELL_NODES];
        ves_shell_geometric(shell, &body, count, &g);
        for (int k = 0; k < count; k++) {
            const ves_shell_column *of = &shell->column[k];
            double move[3];
            ves_cross(theta, body.X[of->node], move);
            x[k] = of->turns ? ves_dot(theta, of->axis) : ves_dot(move, of->vector);
        }
        for (int k = 0; k < count; k++)
            for (int l = 0; l <= k; l++) sum += (k == l ? 1 : 2) * x[k] * x[l] * shell->K[l * count + k];
    }
    ves_arena_destroy(&arena);
    return sum;
}

#endif

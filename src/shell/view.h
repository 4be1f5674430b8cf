/* What measures see of a shell: the solved one, and how its sector makes the whole. */
#ifndef VES_SHELL_VIEW_H
#define VES_SHELL_VIEW_H

#include "shell/shell.h"

/* Where something is asked of the shell: an edge of a sheet, or (edge -1) its node s. What is asked there is that of
 * the whole shell, U -> map U, whose place is here by symmetry. */
typedef struct ves_shell_spot {
    int sheet, edge, s;
    double map[3][3];
} ves_shell_spot;

/* The key of measures of one load case. */
#define VES_SHELL_CASE                                                                                       \
    {                                                                                                        \
        .name = "case", .kind = VES_CASE, .about = "the load case; may be left out when there is one"        \
    }

/* What measures read of a solved case, as its gradient asks for it (shell/adjoint.h): they add d J by it. All zeros but
 * where they say that they did. */
typedef struct ves_shell_reading {
    double *(*U)[3];                    /* [sheets][s] */
    double (*mean)[VES_SHELL_EDGES][3]; /* [sheets] along edges */
    double (*stress)[VES_SHELL_LEVELS][VES_STRESSES];
    double *X[3], *thickness, *area; /* [points] of the stresses */
    double factor, work;
    bool moved, meant, stressed; /* U, mean, and what is of the stresses */
} ves_shell_reading;

typedef struct ves_shell_view {
    ves_shell *shell;
    const ves_shell_model *model;
    const ves_shell_input *input;
    double copies;              /* how many of the sector make the whole: of energies */
    double share[3][3];         /* a force of the sector adds copies * share * force to that of the whole */
    const ves_shell_spot *spot; /* [places that the file names] */
    const ves_shell_grip *grip; /* [the same] what supports do there */
    ves_shell_reading *reading; /* [cases]; NULL: there are no gradients */
    int density;                /* number block index, or -1 */
    const struct ves_formula *const *thickness; /* [patches] NULL: no part of the shell */
    /* [sheets] what formulas of u and v mean (ves_samples) */
    const double (*u_range)[2], (*v_range)[2];
} ves_shell_view;

#endif

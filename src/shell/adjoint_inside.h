/* Inside of the gradient: the fields that it is made of at the element at hand, and their adjoints. */
#ifndef VES_SHELL_ADJOINT_INSIDE_H
#define VES_SHELL_ADJOINT_INSIDE_H

#include "shell/adjoint.h"
#include "shell/inside.h"
#include "shell/law.h"

enum { STATE, DUAL, REAL, IMAGINARY, FIELDS }; /* u; lambda; the parts of a mode of buckling */

typedef struct shell_field {
    const shell_layout *layout;
    const double *vector; /* [freedoms] of the layout */
    /* The far side of a sector: near ones turned, times co, plus mix times the other part (of a mode). */
    double co, mix;
    struct shell_field *other;
    double (*turn)[3];                    /* [nodes] adjoints of rotations, of the near side */
    double (*U)[3], (*A)[3], (*theta)[3]; /* [nodes of the element] */
    double (*on_U)[3], (*on_A)[3];        /* adjoints */
    double *strain, *force;               /* [points][VES_GENERAL] */
} shell_field;

/* Of an edge: d J / d mean displacement along it; that mean, and the length. */
typedef struct shell_mean {
    double on[3], mean[3], length; /* length 0: not read */
} shell_mean;

struct shell_adjoint {
    double *right; /* [freedoms] dJ/du */
    shell_field field[FIELDS];
    int fields;                                     /* in use */
    double factor, weight;                          /* of buckling, and how J goes with it */
    double *part[2];                                /* [freedoms] of a mode */
    double (*on_X)[3], (*on_V)[3], (*work)[3];      /* [nodes of an element] */
    double (*twice)[3], (*none)[3], (*on_twice)[3]; /* likewise: second order of directors */
    double *second;                                 /* [points][VES_GENERAL] strains of second order */
    ves_shell_kind *free;                           /* [sheets] of strains that are not tied */
    shell_mean (*mean)[VES_SHELL_EDGES];            /* [sheets] */
    double (*spring)[3]; /* [springs of the model] of the gradient at hand, or NULL */
    cholmod_dense *solution, *Y, *E;
};

void ves_adjoint_field(ves_shell *shell, const shell_element *element, shell_field *field);
/* Adds `force` on the strains of a field to the adjoints of its displacements and directors, and to those of X and V,
 * which have the same part in the strains. */
void ves_adjoint_force(const ves_shell *shell, const ves_shell_body *body, const ves_shell_points *at,
                       const double *force, shell_field *field);
/* Adds adjoints of a frame at a point to those of the nodes. */
void ves_adjoint_frame(const ves_shell_table *table, int nodes, int q, const ves_shell_frame *on,
                       shell_adjoint *adjoint);

/* Adds an adjoint of a field's rotation at s to that of its node. */
void ves_adjoint_rotation(const ves_shell *shell, int sheet, int s, const double on[3],
                          const shell_field *field);

/* adjoint_mode.c: of the factor of buckling. begin: sets up the fields of the mode. right: what the
 * prestress of an element does on its displacements, left in on_U and on_A of STATE. give: all else. */
ves_status ves_adjoint_mode_make(ves_shell *shell, ves_arena *arena);
ves_status ves_adjoint_mode_begin(ves_shell *shell, int which, double weight);
void ves_adjoint_mode_right(ves_shell *shell, const shell_element *element, const ves_shell_body *body);
void ves_adjoint_mode_give(ves_shell *shell, int which, const shell_element *element,
                           const ves_shell_body *body, ves_law *law, const ves_shell_load_gradient *load);

#endif

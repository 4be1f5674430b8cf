/* Inside of the shell room. */
#ifndef VES_SHELL_INSIDE_H
#define VES_SHELL_INSIDE_H

#include <cholmod.h>

#include "shell/shell.h"

/* Degrees of freedom of a welded node, in this order: displacements along the axes of its frame that are not held,
 * then rotations. */
typedef struct shell_freedom {
    int first, count;
    int moves[3], turns[3]; /* offset from first, or -1 */
    int rank; /* of a smooth node: directions in the tangent plane about which it may not turn */
} shell_freedom;

typedef struct shell_element {
    int sheet, corner; /* s of its first node */
    int u, v;          /* its place in the sheet */
    int *s;            /* [nodes] of the sheet */
    int *place; /* [nodes][nodes]: where the block of node a (row) begins below the diagonal block of node b
                          (column), in rows; -1: above */
} shell_element;

enum { VES_SHELL_NODES = (VES_SHELL_ORDER + 1) * (VES_SHELL_ORDER + 1) };

/* A node with what it is turned about, for the candidate at hand. */
typedef struct shell_pivot {
    double axis[3][3]; /* of each rotation that is free */
} shell_pivot;

struct ves_shell {
    const ves_shell_model *model;
    const ves_shell_input *input;
    ves_shell_kind *kind; /* [sheets] */
    shell_freedom *freedom;
    shell_pivot *pivot;
    int *lead_sheet, *lead; /* [nodes] the first sheet and s that are welded there */
    int elements;
    shell_element *element;
    int freedoms, widest; /* columns of an element, most */
    int *below;           /* [nodes] rows below the diagonal block in a column of the node */
    ves_shell_scratch scratch;
    double (*X)[3], (*V)[3], (*U)[3], (*A)[3]; /* [nodes of an element] */
    ves_shell_column *column;
    int *freedom_of; /* [columns] of the element at hand */
    double *K;       /* [columns][columns] */
    double *strain;
    ves_shell_stresses stresses;
    bool asked; /* whether it is held: `held` */
    ves_status held;
    int stressed; /* the case that they are of, -1: none */
    cholmod_common common;
    cholmod_sparse *matrix;
    cholmod_factor *factor;
    cholmod_dense *force, *solution, *Y, *E;
};

/* topology.c: numbers freedoms, lists elements, lays out the matrix */
ves_status ves_shell_number(ves_shell *shell, ves_arena *arena);
ves_status ves_shell_layout(ves_shell *shell, ves_arena *arena);

/* gather.c: the element at hand: X, V; then columns, and which freedoms they are. */
ves_shell_body ves_shell_gather(ves_shell *shell, const shell_element *element);
int ves_shell_columns_of(ves_shell *shell, const shell_element *element);
/* Axes of all nodes for a candidate. */
void ves_shell_pivots(ves_shell *shell);
/* U and A of the nodes of an element, of column `which` of a block of vectors [freedoms]. */
void ves_shell_field(ves_shell *shell, const shell_element *element, const double *vector);

/* How many directions of its tangent plane a smooth node is held about, at the input at hand. */
int ves_shell_rank(const ves_shell *shell, int node);

/* rigid.c: VES_LOOSE: some part of it may move as a rigid body. Of the matrix at hand. */
ves_status ves_shell_held(ves_shell *shell);

/* stress.c */
ves_status ves_shell_stresses_make(ves_shell *shell, ves_arena *arena);

/* assemble.c, load.c. springs: of the element at hand, into K. */
ves_status ves_shell_assemble(ves_shell *shell);
void ves_shell_loads(ves_shell *shell);
void ves_shell_springs(ves_shell *shell, const shell_element *element, const ves_shell_body *body,
                       int columns);

#endif

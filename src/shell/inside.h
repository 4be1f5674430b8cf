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
} shell_freedom;

typedef struct shell_element {
    int sheet, corner; /* s of its first node */
    int u, v;          /* its place in the sheet */
    int *s;            /* [nodes] of the sheet */
} shell_element;

enum { VES_SHELL_NODES = (VES_SHELL_ORDER + 1) * (VES_SHELL_ORDER + 1) };

/* A node with what it is turned about, for the candidate at hand. */
typedef struct shell_pivot {
    double axis[3][3]; /* of each rotation that is free */
} shell_pivot;

/* What follows from the directions in which nodes are held: one for the loads, more for modes of buckling that are less
 * symmetric than they. */
typedef struct shell_layout {
    const unsigned *held; /* [nodes], or NULL: the nodes' own */
    shell_freedom *freedom;
    shell_pivot *pivot;
    int freedoms;
    int **
        place; /* [elements][nodes][nodes]: where the block of node a (row) begins below the diagonal block of
                    node b (column), in rows; -1: above */
    cholmod_sparse *matrix;
    cholmod_factor *factor;
} shell_layout;

typedef struct shell_buckling shell_buckling;
typedef struct shell_adjoint shell_adjoint;
typedef struct shell_rigid shell_rigid;

struct ves_shell {
    const ves_shell_model *model;
    const ves_shell_input *input;
    ves_shell_kind *kind; /* [sheets] */
    shell_layout *layout; /* [layouts] the first: of the loads */
    int layouts;
    int *lead_sheet, *lead; /* [nodes] the first sheet and s that are welded there */
    int *order, *rank;      /* [nodes] in which they are eliminated, and back */
    int elements;
    shell_element *element;
    int turned; /* the element that was assembled last */
    int widest; /* columns of an element, most */
    ves_shell_scratch scratch;
    double (*X)[3], (*V)[3], (*U)[3], (*A)[3]; /* [nodes of an element] */
    ves_shell_column *column;
    int *freedom_of; /* [columns] of the element at hand */
    double *K;       /* [columns][columns] */
    double *strain;
    ves_shell_stresses stresses;
    shell_rigid *rigid;
    int stressed; /* the case that they are of, -1: none */
    cholmod_common common;
    shell_buckling *buckling; /* NULL: not wanted */
    shell_adjoint *adjoint;   /* likewise */
    cholmod_dense *force, *solution, *Y, *E;
};

/* solve.c: the displacements of a case, [freedoms] of the first layout */
const double *ves_shell_state(const ves_shell *shell, int which);

/* topology.c: lists elements and layouts, numbers freedoms */
ves_status ves_shell_number(ves_shell *shell, ves_arena *arena);
/* pattern.c: finds the order of nodes; lays out the matrix of a layout */
ves_status ves_shell_order(ves_shell *shell, ves_arena *arena);
ves_status ves_shell_layout(ves_shell *shell, shell_layout *layout, ves_arena *arena);

/* gather.c: the element at hand: X, V; then columns, and which freedoms they are. */
ves_shell_body ves_shell_gather(ves_shell *shell, const shell_element *element);
int ves_shell_columns_of(ves_shell *shell, const shell_layout *layout, const shell_element *element);
/* Axes of all nodes for a candidate. */
void ves_shell_pivots(const ves_shell *shell, shell_layout *layout);
/* U and A of the nodes of an element, of column `which` of a block of vectors [freedoms]. */
void ves_shell_field(ves_shell *shell, const shell_layout *layout, const shell_element *element,
                     const double *vector);

/* How many directions of its tangent plane a smooth node is held about, at the input at hand. */
int ves_shell_rank(const ves_shell *shell, const shell_layout *layout, int node);
unsigned ves_shell_mask(const ves_shell *shell, const shell_layout *layout, int node);
bool ves_shell_is_far(const ves_shell *shell, int sheet, int s);

/* buckling.c; stale: there is another solution. */
ves_status ves_shell_buckling_make(ves_shell *shell, ves_arena *arena);
void ves_shell_buckling_free(ves_shell *shell);
void ves_shell_buckling_stale(ves_shell *shell);
/* The mode of a case that ves_shell_buckling was called for, as good as a gradient needs it, which is better than the
 * factor does: of norm 1 in K, parts in pairs when there are two; phase: to the far side. VES_DEGENERATE: there is none. */
typedef struct shell_mode {
    int layout, parts;
    double factor, phase, scale; /* times vector: of norm 1 */
    const double *vector;
} shell_mode;
ves_status ves_shell_mode_take(ves_shell *shell, int which, shell_mode *mode);

/* rigid.c: how firm the elements are: of the matrix shell->K of the element at hand, without springs. VES_LOOSE: some part
 * of the shell may move as a rigid body, in a layout, the far side with a phase (0: none); of the nodes at hand. */
ves_status ves_shell_rigid_make(ves_shell *shell, ves_arena *arena);
void ves_shell_firm_clear(ves_shell *shell);
void ves_shell_firm_add(ves_shell *shell, const shell_element *element, int columns);
ves_status ves_shell_held(ves_shell *shell, const shell_layout *layout, double phase);

/* adjoint.c */
ves_status ves_shell_adjoint_make(ves_shell *shell, ves_arena *arena);
void ves_shell_adjoint_free(ves_shell *shell);

/* gather.c: of a smooth node held about one direction of its tangent plane: by how much the normal's change dn turns its
 * axes within that plane, drift . dn, beside going along with the normal. */
void ves_shell_drift(const ves_shell *shell, const shell_layout *layout, int node, double drift[3]);

/* stress.c */
extern const double ves_shell_across[VES_SHELL_LEVELS]; /* the shear there over its mean */
ves_status ves_shell_stresses_make(ves_shell *shell, ves_arena *arena);

/* load.c: does an element touch an edge of its sheet? And Gauss along its side there: of each point, functions and slopes
 * of the nodes along it, the tangent, its length. */
bool ves_shell_on_edge(const ves_shell *shell, const shell_element *element, int edge);
enum { VES_SHELL_LINE = VES_SHELL_ORDER + 1 };
typedef struct shell_line {
    int count, node[VES_SHELL_LINE];
    double weight[VES_SHELL_LINE], N[VES_SHELL_LINE][VES_SHELL_LINE], slope[VES_SHELL_LINE][VES_SHELL_LINE];
    double t[VES_SHELL_LINE][3], length[VES_SHELL_LINE];
} shell_line;
void ves_shell_line_at(const ves_shell_body *body, int edge, shell_line *line);
/* Adds the forces of a case on the nodes of an element, those of points apart. */
void ves_shell_load_add(ves_shell *shell, const shell_element *element, const ves_shell_body *body, int which,
                        double (*force)[3]);

/* assemble.c, load.c. springs: of the element at hand, into K. */
ves_status ves_shell_assemble(ves_shell *shell, const shell_layout *layout);
/* The matrix of a layout, or (parts) what it is made of when the far side of a sector moves as the near one times
 * exp(i a): [0] + cos a [1] + i sin a [2]. Planes of values in the pattern of layout->matrix; [1] NULL: a = 0. */
typedef struct shell_parts {
    double *x[3];
} shell_parts;
void ves_shell_parts_clear(const shell_layout *layout, const shell_parts *parts);
/* The matrix shell->K of the element at hand; springs and drilling of nodes. */
void ves_shell_element_add(const ves_shell *shell, const shell_layout *layout, const shell_element *element,
                           int columns, const shell_parts *to);
double ves_shell_drilling(const ves_shell *shell, int node); /* of a fold: of each of its turns */
void ves_shell_nodes_add(const ves_shell *shell, const shell_layout *layout, const shell_parts *to);
void ves_shell_loads(ves_shell *shell);
void ves_shell_springs(ves_shell *shell, const shell_element *element, const ves_shell_body *body,
                       int columns);

#endif

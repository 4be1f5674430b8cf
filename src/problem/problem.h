/* Problem: a problem file, read, checked and resolved: every name is an index, every number a compiled
 * formula. Constant after reading; shared by all threads. Owns everything it points to.
 *
 * The number block that all rooms index is one flat array of doubles:
 *     [ variables | unknown of solve (0 or 1) | parameters | numbers ]
 * The first three are the *slots* that formulas read by name. A parameter may be a formula of slots before
 * it. */
#ifndef VES_PROBLEM_PROBLEM_H
#define VES_PROBLEM_PROBLEM_H

#include <stdio.h>

#include "curve/curve.h"
#include "formula/dimension.h"
#include "formula/formula.h"
#include "problem/shell.h"
#include "vesica/measure.h"
#include "vesica/problem.h"
#include "vesica/search.h"

/* Grids: nodes along u and v (fewer could not tell a surface that is round from one that folds back: between
 * neighbours its normal would turn by more than 120 degrees), and what may be chosen of them at most. */
enum { VES_NODES_LEAST = 5, VES_NODES_U = 4096, VES_NODES_V = 32768, VES_CHOSEN_U = 128, VES_CHOSEN_V = 512 };

/* Nodes of one of so many patches at most: 2^18 in all, so that both levels of a plan stay near 1 GB; but what
 * may be chosen is never too much. */
static inline int ves_nodes_most(int patches)
{
    int share = (1 << 18) / (patches > 0 ? patches : 1), chosen = VES_CHOSEN_U * VES_CHOSEN_V;
    return share > chosen ? share : chosen;
}

/* How the file writes a quantity, for people: value / factor in `unit`; "" and 1 without a unit. */
typedef struct ves_shown {
    char unit[VES_UNIT_TEXT];
    double factor;
} ves_shown;

typedef struct ves_variable {
    const char *name;
    ves_mark mark;
    double min, start, max;
    ves_dim dim;
    ves_shown shown;
} ves_variable;

typedef struct ves_parameter {
    const char *name;
    ves_mark mark;
    const ves_formula *formula; /* of earlier slots */
    ves_shown shown;
} ves_parameter;

/* solve: {unknown, in, equation}: the unknown's value is the root in [lo, hi]. Formulas read slots and, as
 * arguments, the values of the measures (index = measure instance). */
typedef struct ves_solve {
    ves_mark mark;
    const char *name;
    double lo, hi;
    ves_dim dim;
    ves_shown shown;
    const ves_formula *left, *right;
} ves_solve;

/* scale: {equation: MEASURE == formula of slots}: the whole shape is scaled by similarity about the origin. */
typedef struct ves_scale {
    ves_mark mark;
    int measure;
    const ves_formula *target;
} ves_scale;

/* A share of a curve in the data of a condition. */
typedef struct ves_share {
    int curve;
    double factor;
} ves_share;

/* d_u^derivative X(u) = scale * sum of factor * curve */
typedef struct ves_condition {
    ves_mark mark;
    double u;       /* 0 .. 1; -1: where, or which derivative, is not known, after an error */
    int derivative; /* 0: position, which has one share, with factor 1 */
    int shares;
    const ves_share *share;
    int scale; /* number block index, or -1: 1 */
} ves_condition;

/* A spine that is given [Ugail 2011, 5.3]; see ves_spine in surface/patch.h. */
typedef enum ves_spine_form { VES_SPINE_NONE, VES_SPINE_BY_HERMITE, VES_SPINE_BY_BSPLINE } ves_spine_form;

typedef enum ves_patch_kind { VES_PATCH_PDE, VES_PATCH_FORMULA, VES_PATCH_POINTS } ves_patch_kind;

typedef struct ves_patch_def {
    const char *name;
    ves_mark mark;
    ves_patch_kind kind;
    bool periodic; /* in v; a PDE patch always is */
    /* PDE */
    int power;        /* N: (d_uu + a^2 d_vv)^N, or sum_k c_k d_u^(2N-2k) d_v^(2k) */
    bool general;     /* the latter */
    int operators;    /* 1, or 3: one each for x, y, z */
    int parameter[3]; /* of each operator: number block index of a, or of the first of c_0 .. c_N */
    int modes;        /* modes solved exactly; 0: chosen */
    int omega;        /* number block index of the remainder's lam; -1: a (modes + 1) */
    int lower;        /* 0, or the power of the patch whose order is raised: its conditions come first, and
                         the others say how far the surface departs from it */
    int conditions;   /* 2N */
    const ves_condition *condition;
    ves_spine_form spine;
    int spine_vectors, spine_first; /* how many, and the number block index of the first of their numbers */
    /* FORMULA: arguments 0, 1 are u, v in the domain below */
    const ves_formula *formula[3];
    double u_range[2], v_range[2];
    /* POINTS: a grid of rows (along u) x columns (along v), three numbers each from `points`, interpolated by
     * cubic splines */
    int rows, columns, points;
} ves_patch_def;

/* A place: one named point of a patch. */
typedef struct ves_place {
    const char *name;
    ves_mark mark;
    int patch;
    int u, v; /* number block indices */
} ves_place;

typedef struct ves_end {
    ves_mark mark;
    int patch, end; /* end 0: u = 0, 1: u = 1 */
} ves_end;

typedef struct ves_shape_def {
    ves_mark mark;
    bool closed; /* the file says so; the plan checks it */
    int caps;
    const ves_end *cap;
} ves_shape_def;

typedef struct ves_measure_def {
    const char *name; /* as formulas use it */
    ves_mark mark;
    const ves_measure *measure;
    ves_args args;
    int over; /* number of patches named, 0: all */
    const int *patch;
    ves_dim dim;
    ves_shown shown;
} ves_measure_def;

/* left RELATION right. Formulas read slots and measures (arguments). */
typedef struct ves_constraint_def {
    ves_mark mark;
    const char *text; /* as written */
    ves_relation relation;
    const ves_formula *left, *right;
    ves_shown shown;
    double within; /* feasible when the violation relative to its size (vesica/plan.h) is at most this */
} ves_constraint_def;

/* expect: a formula that must not be 0. Arguments: the measures, then VES_EXPECT_... */
typedef struct ves_expect_def {
    ves_mark mark;
    const char *text;
    const ves_formula *formula;
} ves_expect_def;

/* kinds: a name for the designs for which a formula is not 0, and none before it. Arguments: the measures. */
typedef struct ves_kind_def {
    const char *name;
    ves_mark mark;
    const char *text;
    const ves_formula *formula;
} ves_kind_def;

enum {
    VES_EXPECT_OBJECTIVE,
    VES_EXPECT_VIOLATION,
    VES_EXPECT_FEASIBLE,
    VES_EXPECT_EVALUATIONS,
    VES_EXPECT_GRADIENTS,
    VES_EXPECT_OPTIMA,
    VES_EXPECT_NAMES
};

typedef struct ves_validity_def {
    bool jacobian;          /* default true */
    bool self_intersection; /* `best`: CGAL on accepted bests; default true, `never` false */
    int checks;             /* holds: what proofs ask on both grids; arguments: the measures */
    const ves_expect_def *check;
    /* least_radius: {value, axis, over}; monotone: {along, over}; absent: number index -1 */
    int least_radius, axis;
    int radius_patches;
    const int *radius_patch;
    int monotone;
    int monotone_patches;
    const int *monotone_patch;
} ves_validity_def;

/* A number whose key has a range, and which varies: it is looked at for every candidate. */
typedef struct ves_limit {
    int number; /* number block index */
    double low, high;
    const char *key;
    ves_dim dim;
    ves_mark mark;
} ves_limit;

/* sweep: walks along the values of the first parameter, for each value of the second. */
enum { VES_SWEEP_AXES = 2, VES_SWEEP_VALUES = 10000 };

typedef struct ves_sweep_axis {
    const char *name;
    int parameter; /* its index */
    int count;
    const double *value; /* as the file orders them; those of the first axis rise or fall */
} ves_sweep_axis;

typedef struct ves_sweep_branch {
    const char *name;
    ves_mark mark; /* of what it sets */
    int sets;
    const ves_override *set;
    int kind;          /* that of all its points, the others are lost; -1: any */
    const bool *skips; /* [values of the second parameter, or 1] it is not walked there; NULL: everywhere */
} ves_sweep_branch;

/* What others have found: where the best goes over from one branch to another. */
typedef struct ves_sweep_known {
    int from, to;       /* branches */
    double at;          /* of the first parameter */
    const char *source; /* or "" */
} ves_sweep_known;

typedef struct ves_sweep_def {
    ves_mark mark;
    int axes;
    ves_sweep_axis axis[VES_SWEEP_AXES];
    bool forth, back; /* which ways the values of the first axis are walked along */
    int branches;     /* 0: one without a name */
    const ves_sweep_branch *branch;
    ves_search_options search; /* of every point but the first of a walk */
    bool begins;               /* first holds; else the first point of a walk is searched as the file says */
    ves_search_options first;
    int knowns;
    const ves_sweep_known *known;
    double
        finest; /* where a walk would lose its branch it takes smaller steps, down to this; 0: it does not */
} ves_sweep_def;

/* Is the branch walked at this value of the second parameter? */
bool ves_sweep_walked(const ves_sweep_def *sweep, int branch, int second);

struct ves_problem {
    ves_arena arena;
    const char *path, *name, *title; /* name: the file's name without folder and ending */
    const char *text;                /* the file as run: with --set applied, comments kept */
    const char *const *plugin_file;  /* NULL-terminated, or NULL; see ves_read_options */
    bool units;                      /* some number of the file has a unit: then dimensions are checked */

    int variables, unknowns, parameters, slots, numbers,
        block; /* slots: first three; block: slots + numbers */
    const ves_variable *variable;
    const ves_solve *solve; /* NULL: none */
    const ves_parameter *parameter;
    const ves_formula *const *number; /* number k is block entry slots + k */
    const bool *varying;              /* [block]: depends on a variable or on the unknown */
    int limits;
    const ves_limit *limit; /* of numbers that something uses */

    int curves, patches, places, measures, constraints, expects, test_expects;
    int curve_limit;            /* most modes of a curve */
    const ves_curve_def *curve; /* inputs before users */
    const ves_patch_def *patch;
    const ves_place *place;
    ves_shape_def shape;
    const ves_measure_def *measure;
    const ves_scale *scale;       /* NULL: none */
    const ves_formula *objective; /* of slots and measures; NULL: nothing to optimise */
    const char *objective_text;
    ves_mark objective_mark;
    ves_shown objective_shown;
    bool maximize;
    const ves_constraint_def *constraint;
    ves_validity_def validity;
    int kinds;
    const ves_kind_def *kind; /* in the order in which they are tried */
    int quadrature[2];        /* nodes along u and v; 0: chosen from the problem */

    ves_search_options search; /* stages; `auto` when the file says nothing */
    const ves_expect_def *expect;
    ves_search_options test;           /* what `test:` overrides: budget and stages */
    const ves_expect_def *test_expect; /* replaces expect in a test run when given */
    const ves_sweep_def *sweep;        /* NULL: none */
    const ves_shell_def *shell;        /* NULL: none */
};

/* Loads a whole file, a little more than the reader takes at most; path is for messages. *text is to be freed
 * with ves_memory_free whatever the answer. */
ves_status ves_problem_load(FILE *file, const char *path, char **text, size_t *length, ves_diag *diag);

/* limit.c: "> 0", ">= 0", "in [0, 1]"; a number for people; and one with its SI unit, where there are units. */
enum { VES_QUANTITY = 96 };
void ves_limit_text(double low, double high, char text[96]);
void ves_number_text(double value, char text[32]);
void ves_quantity_text(double value, ves_dim dim, bool units, char text[VES_QUANTITY]);

#endif

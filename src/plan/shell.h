/* Shells in the plan: from the section `shell` to a model (shell/shell.h) for each level, and to its planes at each
 * candidate. */
#ifndef VES_PLAN_SHELL_H
#define VES_PLAN_SHELL_H

#include "plan/inside.h"
#include "shell/adjoint.h"
#include "shell/buckling.h"
#include "shell/view.h"

enum { SHELL_DESIGNS = 3 }; /* at which is looked what is always so: the start, and two drawn */

/* What the shell, its thickness, its supports and its loads have in common with themselves, turned or mirrored: found
 * for patches that go round in v, all in the same v. */
typedef struct plan_sector {
    bool whole;          /* nothing is used */
    bool ring;           /* of revolution: a strip */
    bool mirrored;       /* from mirror plane to mirror plane; else from one side to the same, turned */
    double from, to;     /* of v */
    int folds;           /* turned by 2 pi / folds it is itself */
    double turn[3][3];   /* by to - from */
    double mirror[2][3]; /* normals of the planes at from and to */
    double axis[3];
    double copies, share[3][3];
} plan_sector;

typedef struct plan_shell_part {
    int patch, site, count; /* site: index in the level; count: nodes */
    double *u, *v;          /* [rows], [columns] in 0 .. 1, 0 .. 2 pi */
    int *weld;
    bool *far;
    double *thickness;
} plan_shell_part;

typedef struct plan_shell_slopes plan_shell_slopes; /* shell_gradient.c */

/* A load, or (part -1) a spring, that is no number. */
typedef struct plan_shell_odd {
    bool found;
    ves_mark mark;
    double value;
    int part, s;
} plan_shell_odd;

struct plan_shell {
    const ves_shell_def *def;
    int level;
    bool buckles; /* some measure asks for its buckling */
    bool solid;   /* some measure asks for its solution; else there is only what the light ones read */
    plan_sector sector;
    int waves;             /* around */
    int folds;             /* how often its rings may come again in themselves; 0: they are round */
    plan_shell_part *part; /* [def->parts] */
    ves_shell_sheet *sheet;
    ves_shell_node *node;
    int nodes;
    ves_shell_model model;
    ves_shell_input input;
    ves_shell_load *load;
    ves_shell_spring *spring;
    ves_shell_point *point;
    ves_shell_spot *spot;
    ves_shell_grip *grip;
    const double *(*X)[3], *(*normal)[3], **thickness;
    double *side, (*u_range)[2], (*v_range)[2];
    const ves_formula **formula; /* [patches] of thickness */
    const unsigned **held;       /* [classes] of buckling */
    const int **weld;
    const bool **far;
    ves_shell *shell;
    plan_shell_slopes *slopes; /* NULL: there are no gradients */
    bool solved;               /* since the sites were sampled */
    ves_status outcome;        /* of that */
    plan_shell_odd odd;
    ves_shell_view view;
};

/* The design that is looked at as the k-th; binds it. */
void ves_shell_design(ves_plan *plan, int k);

/* shell_rings.c: waves and folds */
ves_status ves_shell_rings(ves_plan *plan, plan_shell *shell);

/* shell_sector.c: at the designs of ves_shell_design */
ves_status ves_shell_sector_find(ves_plan *plan, plan_shell *shell);
/* v of the place in the sector that stands for a place of the whole, where displacements are map times those there. */
double ves_sector_place(const plan_sector *sector, double v, double map[3][3]);

/* shell_mode.c: the same of a mode of buckling, which need not be as symmetric as the shell: in the whole it is
 * map (phase[0] U[0] - phase[1] U[1]), with ves_shell_mode at that place of the sector. */
double ves_sector_mode(const plan_sector *sector, const ves_shell_buckled *mode, double v, double map[3][3],
                       double phase[2]);
/* The mode that was found last at a place of the whole: u in 0 .. 1, v in 0 .. 2 pi. The largest is about 1. */
void ves_shell_mode_at(const plan_shell *shell, const ves_shell_buckled *mode, int part, double u, double v,
                       double U[3]);

/* shell_why.c: tells, "what: ...", what of the shell makes that status; false: nothing does. */
bool ves_shell_why(const ves_plan *plan, ves_status status, const char *what, ves_diag *diag);

/* shell_mesh.c: sheets and their nodes */
ves_status ves_shell_mesh(ves_plan *plan, plan_shell *shell, ves_diag *diag);

/* shell_weld.c: which nodes are one; folds; what is held */
ves_status ves_shell_weld(ves_plan *plan, plan_shell *shell);
ves_status ves_shell_hold(ves_plan *plan, plan_shell *shell, ves_diag *diag);

/* What supports hold at the places that measures name. */
ves_status ves_shell_grips_make(ves_plan *plan, plan_shell *shell);

/* The node at a place, or the one that stands for it. */
void ves_shell_spot_find(const ves_plan *plan, const plan_shell *shell, const ves_shell_at *at,
                         ves_shell_spot *spot);
int ves_shell_place(const ves_plan *plan, const plan_shell *shell, const ves_shell_at *at);

/* shell_load.c: planes that loads need, and what fills them */
ves_status ves_shell_loads_make(ves_plan *plan, plan_shell *shell);
void ves_shell_loads_fill(ves_plan *plan, plan_shell *shell);
/* A formula of x, y, z, u, v at node s of a part. pull: its value, and adds seed times its gradient to the numbers and to
 * the adjoint of the node. */
double ves_shell_formula(ves_plan *plan, const plan_shell *shell, int part, int s,
                         const ves_formula *formula);
double ves_shell_formula_pull(ves_plan *plan, const plan_shell *shell, int part, int s,
                              const ves_formula *formula, double seed);

/* The way back: from adjoints of what fill fills for one case, and of all springs, to the numbers, the nodes and the
 * thicknesses. */
typedef struct plan_shell_pull {
    double **thickness;                     /* [parts][s] */
    ves_shell_load_gradient *load;          /* [parts] */
    double (*force)[3];                     /* [points] */
    double (*spring)[3], (*node_spring)[3]; /* [springs], [nodes] */
} plan_shell_pull;
void ves_shell_loads_pull_back(ves_plan *plan, const plan_shell *shell, int which,
                               const plan_shell_pull *from);
void ves_shell_springs_pull_back(ves_plan *plan, const plan_shell *shell, const plan_shell_pull *from);

/* shell_gradient.c: in the sweep that measures have added to the readings of */
ves_status ves_shell_slopes_make(ves_plan *plan, plan_shell *shell);

#endif

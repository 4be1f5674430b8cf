/* Inside of the plan. */
#ifndef VES_PLAN_INSIDE_H
#define VES_PLAN_INSIDE_H

#include "plan/displace.h"
#include "problem/problem.h"
#include "surface/figure.h"
#include "surface/forms.h"
#include "surface/patch.h"
#include "surface/pole.h"
#include "vesica/plan.h"

enum { LEVELS = 2 };

/* What is sampled for what: the measures that a program runs, and the fields and forms that each site must
 * fill for them. */
typedef enum plan_program {
    PROGRAM_SCALE, /* the measure of scale:, on the shape before it is scaled */
    PROGRAM_SOLVE, /* the measures of the equation of solve: */
    PROGRAM_JUDGE, /* objective and constraints, validity */
    PROGRAM_PROOF, /* the checks of validity: holds */
    PROGRAM_ALL,   /* every measure */
    PROGRAMS
} plan_program;

/* One sampled place at one level: a patch's nodes, a cap, a named point, a curve, or a look. */
typedef struct plan_site {
    ves_samples samples;
    ves_adjoint adjoint;
    ves_grid grid;
    ves_chart *chart; /* NULL: a curve */
    int tiles;
    ves_tile *tile;        /* the pieces in which a chart is sampled */
    ves_tile_planes *kept; /* [tiles] their fields, as last sampled for a gradient */
    int patch;
    int curve, curve_modes;
    double *trig; /* curve: [e][k][nv] */
    double side;  /* orientation of the patch */
    bool varies;
    bool mesh;    /* nodes of a shell, ends included */
    bool looked;  /* a look: filled since the other sites were sampled */
    bool pole[2]; /* a look that has forms, on a patch whose end is a point: they are limits there */
    unsigned needs[PROGRAMS];              /* VES_X | ... */
    unsigned wants;                        /* all of them */
    const plan_displacement *displacement; /* NULL: sampled as it is */
    unsigned slopes; /* of the sweep at hand: planes whose adjoint some measure adds to */
} plan_site;

/* One measure at one level. */
typedef struct plan_instance {
    ves_measure_input input; /* first: `look` finds the instance by it */
    ves_plan *plan;
    const ves_adjoint **adjoint;
    int *site;      /* [input.samples] index into the level's sites */
    unsigned *need; /* [input.samples] what is read there */
    int looks;      /* for each surface */
} plan_instance;

typedef struct plan_shell plan_shell;

typedef struct plan_level {
    int quadrature[2];
    int sites;
    plan_site *site;         /* first one for each patch, then caps, then what keys name */
    int (*edge)[2];          /* [patches] sites of its two ends, and of the sides of a sheet; -1: none */
    plan_instance *instance; /* [measures] */
    plan_shell *shell;       /* NULL: no measure is of one */
} plan_level;

/* Two edges of a sheet that are one curve. */
typedef struct plan_seam {
    bool joined, reversed; /* reversed: they run against each other, and what they make has one side */
    double shift;
} plan_seam;

/* What was found at the edges of a sheet. */
typedef struct plan_sheet {
    bool pole[2];
    plan_seam ends;  /* X(1, v) = X(0, shift + v), reversed: X(0, shift - v) */
    plan_seam sides; /* X(u, 2 pi) = X(u, 0), reversed: X(1 - u, 0) */
    double gap;      /* between X(u, 2 pi) and X(u, 0), along the coordinates that are numbers */
    bool pointless;  /* some point there is no number */
    bool gaping;     /* it is more than rounding */
} plan_sheet;

struct ves_plan {
    ves_arena arena;
    const ves_problem *problem;
    double *block; /* the number block */
    double *block_adjoint;
    ves_curves *curves;
    ves_bound bound;
    ves_patch **patch;
    bool trial;     /* see ves_plan_try */
    bool displaced; /* see ves_plan_loose */
    bool frozen;    /* in its size: scale: is not asked again */
    bool branched;  /* no oriented mesh: more than two patches end on some curve, or a sheet has one side */
    plan_sheet *sheet; /* [patches] */
    double *side;      /* [patches] +1: Xu x Xv points outward */
    int *
        sense; /* [patches] sign of what its part encloses; -1: it is a hollow; 0: its outside is not known */
    double *enclosed;    /* [patches] by its part, at the first patch of each: scratch of validity */
    double *reference;   /* [variables] the design at which the outside was found */
    ves_status measured; /* what came of measuring it */
    int *part;           /* [patches] first patch of the connected part that it belongs to */
    plan_level level[LEVELS];
    bool *runs[PROGRAMS];   /* [measures] */
    double *value;          /* [measures] */
    double *fine;           /* [measures] on the finer grid, while a candidate is proved */
    double *fine_violation; /* [constraints] the same, in units of their sizes */
    double *natural;        /* [measures] change.c: what counts as nothing is a share of this; 0: unknown */
    double *size;   /* [constraints] the scale of each violation: its limit, or what it says at the start */
    bool *cheap;    /* [constraints] reads no dear measure */
    bool any_dear;  /* some judged measure is dear */
    double cutoff;  /* of the question at hand */
    int numberless; /* the measure that gave no number in the last program, or -1 */
    int broken;     /* the check that the last proof found broken, or -1 */
    int broken_level;
    double similarity; /* of the design that is bound */
    bool scaled;       /* that is known: found, or there is no scale: */
    double *formula_room;
    double *measure_adjoint;
    double *rows;           /* gradients: [1 + constraints + 1][slots] before the equations are followed */
    double *row_similarity; /* [1 + constraints + 1] d/d similarity */
    double *unit_row;       /* [slots] gradient of scale's measure */
    ves_tile_planes *field, *field_adjoint, *unfolded;
    ves_form_planes *form;
    double change; /* that the choice of the grid left; NAN: it was given */

    /* what ves_plan_measure tells */
    double *told;     /* [measures] */
    ves_sides *sides; /* [constraints] */
    bool *checked;    /* [checks] */

    /* what ves_plan_search hands out: [variables], [constraints] */
    double *lower, *upper, *start;
    const char **name;
    bool *equality;
    bool gradients;            /* every measure that is judged has one */
    double *shape[2], *planes; /* pose.c: points of two shapes that are compared */
};

/* plan.c: on a grid that is given, in range or not. try: to be measured with and thrown away: says nothing, and
 * does not ask whether the conditions are good. */
ves_status ves_plan_make(const ves_problem *problem, const int quadrature[2], ves_plan **plan,
                         ves_diag *diag);
ves_status ves_plan_try(const ves_problem *problem, const int quadrature[2], ves_plan **plan);
/* Its sites may be displaced: every one has adjoints, and what `scale:` holds is judged too. */
ves_status ves_plan_loose(const ves_problem *problem, const int quadrature[2], ves_plan **plan,
                          ves_diag *diag);

/* shell.c: the shell of a level. begin: before its sites are laid out; sites: lays out those of its nodes; finish: when
 * all sites have their planes. run: solves it for what was sampled last, once. end: of all levels. */
ves_status ves_shell_begin(ves_plan *plan, int level, ves_diag *diag);
ves_status ves_shell_sites(ves_plan *plan, int level);
ves_status ves_shell_finish(ves_plan *plan, int level, ves_diag *diag);
ves_status ves_shell_run(ves_plan *plan, int level);
/* Do the elements have gradients? (shell/adjoint.h) */
bool ves_shell_differentiable(const ves_plan *plan);
/* shell_gradient.c: from what measures read of it to the adjoints of its sites and to block_adjoint. */
ves_status ves_shell_sweep(ves_plan *plan, int level);
void ves_shell_end(ves_plan *plan);

/* level.c. face: its sites take the sides of their patches. */
ves_status ves_plan_level_build(ves_plan *plan, int index, ves_diag *diag);
void ves_plan_level_face(ves_plan *plan, int index);

/* sites.c: sampling and its transpose. finish: of a site whose kind, grid and needs are known. look: what
 * measures call. */
ves_status ves_site_finish(ves_plan *plan, plan_site *s, ves_site kind);
int ves_site_look(const ves_measure_input *input, int i, int k, const double u[3], const double v[3]);
ves_status ves_site_sample(ves_plan *plan, plan_site *s, unsigned needs, bool gradient);
/* Adds d J / d similarity; leaves adjoints 0, whatever the status. */
ves_status ves_site_scatter(ves_plan *plan, plan_site *s, double *by_similarity);
void ves_site_gather(ves_plan *plan, plan_site *s);

/* sites.c: what formulas over a patch mean by a place of it */
void ves_plan_domain_at(const ves_plan *plan, int patch, double u, double v, double at[2]);

/* bind.c: x -> block -> curves -> patches, and back. What is bound has no similarity yet. */
void ves_plan_bind(ves_plan *plan, const double *x, double unknown);
void ves_plan_bind_patches(ves_plan *plan);
void ves_plan_unscale(ves_plan *plan);
const ves_limit *ves_plan_limit(const ves_plan *plan); /* the first that is not kept, or NULL */
void ves_plan_pull(ves_plan *plan, const double *number_adjoint, double *slot_row);

/* forward.c: programs */
ves_status ves_plan_forward(ves_plan *plan, const double *x, int level, plan_program which, bool gradient);
ves_status ves_plan_run(ves_plan *plan, int level, plan_program which, bool gradient);
double ves_plan_formula(ves_plan *plan, const ves_formula *formula);

/* judge.c: the largest violation among the constraints that read no dear measure */
double ves_plan_cheap_violation(ves_plan *plan);

/* checks.c: measures what the checks read of the design that is bound, and asks them; VES_BROKEN: the first
 * that does not hold is plan->broken. holds: of what was measured last. */
ves_status ves_plan_checks(ves_plan *plan, int level);
bool ves_plan_holds(ves_plan *plan, const ves_formula *formula);

/* pose.c: what ves_plan_search hands out */
ves_status ves_plan_pose(ves_plan *plan);
bool ves_plan_differentiable(const ves_plan *plan); /* has every judged measure a gradient? */

/* judge.c: every measure at x, in plan->value */
ves_status ves_plan_measure_all(ves_plan *plan, const double *x, int level);

/* gradient.c */
ves_status ves_plan_gradient(ves_plan *plan, int level, int output, const ves_formula *const *formula,
                             const double *seed, int count, plan_program which);
ves_status ves_plan_follow(ves_plan *plan, int level, int outputs);
/* From plan->measure_adjoint to block_adjoint and displacements. */
ves_status ves_plan_sweep(ves_plan *plan, int level, plan_program which, double *by_similarity);

/* figure.c, after plan_forward; proof.c: does the shape of the last evaluation cross itself? */
ves_status ves_plan_figure_make(ves_plan *plan, int nu, int nv, ves_figure **figure);
ves_status ves_plan_crosses(ves_plan *plan);

/* figure_shell.c: figure->shell, of a problem that has one; and grids for its finite elements, by layers and
 * lengths on a coarse figure: cells of each patch along u (0: no part), and raises *nv where needed. */
ves_status ves_figure_shell_make(const ves_plan *plan, ves_figure *figure);
void ves_figure_cells(const ves_figure *coarse, int *nu, int *nv);

/* figure_field.c: what is known of its solution, of the design that is bound */
ves_status ves_figure_fields_make(ves_plan *plan, ves_figure *figure);

/* why.c: is every point of the figure finite? Else an error "what: ...". */
bool ves_plan_figure_finite(const ves_plan *plan, const ves_figure *figure, const char *what, ves_diag *diag);

/* validity.c: nodes, edges: what it reads at the nodes of a patch, and on its edges: two ends of so many
 * parts, each with a place before and after the nodes of that part. */
unsigned ves_validity_nodes(const ves_plan *plan, int patch, int level);
unsigned ves_validity_edges(const ves_plan *plan, int patch, int level);
int ves_edge_parts(const ves_grid *nodes);
ves_status ves_plan_validity(const ves_plan *plan, int level);

/* sheet.c: the edges of one sheet as it is bound, and of all of them in general position */
ves_status ves_sheet_look(const ves_plan *plan, int patch, plan_sheet *found);
bool ves_sheet_one_sided(const plan_sheet *sheet);
ves_status ves_plan_sheets(ves_plan *plan, ves_diag *diag);

/* conditions.c: refuses conditions that determine no surface at the start, or none that can be solved, warns of
 * those that amplify; and tells, "what: ...", of a patch that has none at the design that is bound (false: all
 * have). lam of the remainder, and the mode as which it is solved: NAN where there is none or it is not one
 * number. The mode that is amplified most. */
ves_status ves_plan_conditions(const ves_plan *plan, int patch, ves_diag *diag);
bool ves_plan_conditions_tell(const ves_plan *plan, const char *what, ves_diag *diag);
double ves_plan_omega(const ves_plan *plan, int patch);
double ves_plan_rest(const ves_plan *plan, int patch);
int ves_plan_worst(const ves_plan *plan, int patch);

/* elliptic.c: refuses a patch whose operator is not elliptic at the start, or beyond what can be solved; and tells,
 * "what: ...", of one whose is at the design that is bound (false: none is). */
ves_status ves_plan_elliptic(const ves_plan *plan, int patch, ves_diag *diag);
bool ves_plan_elliptic_tell(const ves_plan *plan, const char *what, ves_diag *diag);

/* orient.c: shared curves -> sides and closedness */
ves_status ves_plan_orient(ves_plan *plan, ves_diag *diag);
bool ves_end_is_pole(const ves_plan *plan, int patch, int end);
int ves_end_curve(const ves_plan *plan, int patch, int end);
int ves_ends_on(const ves_plan *plan, int curve); /* how many ends lie on it */
bool ves_end_is_capped(const ves_plan *plan, int patch, int end);

/* edge.c, at the start design: warns of end curves that cross themselves; the end that runs nearest to a free
 * one, and how far from it at most (false: none is near) */
void ves_edges_cross(const ves_plan *plan, ves_diag *diag);
bool ves_edge_near(const ves_plan *plan, int patch, int end, ves_end *other, double *gap);

/* lid.c: f->lid[end], where a fan would not do */
ves_status ves_lid_make(ves_figure_patch *f, int end, ves_arena *arena);

/* outward.c: turns each part outward as the design that is bound shows it. nested: on this figure the
 * hollows, and they alone, lie in other parts; corner: 6 for each cell of a patch. */
ves_status ves_plan_face(ves_plan *plan);
bool ves_plan_nested(const ves_plan *plan, const ves_figure *figure, int *corner);

/* plan.c: places for ves_plan_points, [along * around]: from end to end, and round without meeting. */
void ves_plan_lattice(int along, int around, double *u, double *v);

/* change.c: the natural size of each measure, at the design that is bound; and how two of its values
 * differ. */
ves_status ves_plan_sizes(ves_plan *plan);
double ves_plan_measure_change(const ves_plan *plan, int m, double a, double b);

/* reference.c: finds the design that shows where outside is, and turns the plan by it */
ves_status ves_plan_refer(ves_plan *plan, ves_diag *diag);

/* plan.c. Whether the limit of a constraint is its left side: 1 <= area. */
bool ves_plan_turned(const ves_problem *problem, const ves_constraint_def *constraint);

#endif

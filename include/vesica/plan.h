/* Plan: a Problem made ready to be evaluated. Everything that can be known before x is known is paid once, in
 * ves_plan_create; an evaluation allocates nothing, but for a proof (VES_WANT_PROOF), which makes a mesh.
 *
 *     x --bind--> numbers --curves--> modes --solve--> patches --sample--> samples --measure--> m[]
 *       --judge--> Verdict
 *
 * x[variables] holds the variables in the order of ves_problem_variable, inside or outside their ranges. All
 * numbers are in SI units (in a file without units: in its own), angles in radians.
 *
 * A plan keeps what it evaluated last, so it belongs to one thread at a time: make one plan for each thread.
 * The problem is shared by all of them and must outlive them. */
#ifndef VESICA_PLAN_H
#define VESICA_PLAN_H

#include "vesica/figure.h"
#include "vesica/problem.h"
#include "vesica/search.h"
#include "vesica/verdict.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ves_plan ves_plan;

typedef struct ves_plan_options {
    /* nodes along u, 5 to 4096, and along v, 5 to 32768, of each patch; 0: as the problem says; when that is
     * `auto`: chosen. u times v is at most 262144 over the number of patches, or 128 * 512, whichever is more;
     * one that is left to be chosen counts as 128 or 512. */
    int quadrature[2];
} ves_plan_options;

/* options NULL: as the problem says. Choosing a grid takes about as long as a hundred evaluations: give other
 * plans of the same problem the grid of the first (ves_plan_grid). On failure *plan is NULL and the reason is
 * in diag, which may be NULL. A start design that cannot be measured is no failure: normals then face outward
 * at the first of up to 31 others that can be measured and encloses a volume, the same for every plan.
 * VES_RANGE: no such grid. VES_SINGULAR where a measure needs an inside (volume) and no design that was tried
 * encloses anything. */
ves_status ves_plan_create(const ves_problem *problem, const ves_plan_options *options, ves_plan **plan,
                           ves_diag *diag);
void ves_plan_destroy(ves_plan *plan); /* NULL: nothing */

/* The grid of level 0: nodes along u and v of each patch; level 1 has twice as many of both. Where it was
 * chosen: from 16 nodes along u, and along v enough to see the modes that are solved, each direction was
 * refined by half until two refinements in a row changed no measure (extremes left out) by more
 * than 1e-9 of its size, up to 128 and 512 nodes (for a patch of more than 12 conditions, up to 10 for each of
 * them along u, and 65536 in all), at the start design or, if that cannot be measured or is a closed shape that
 * encloses nothing, at the first of up to 31 others that can and does. Returns the largest relative change that
 * was left; NAN when nothing was chosen or nothing could be measured. */
double ves_plan_grid(const ves_plan *plan, int quadrature[2]);

/* The same choice for the design x, or, where x is NULL or cannot be measured, as above; whatever the problem
 * says of its grid. *change: what ves_plan_grid returns. Returns VES_OK, or negative for faults. */
ves_status ves_plan_choose(const ves_problem *problem, const double *x, int quadrature[2], double *change);

/* Judges one candidate: objective (negated when the problem maximises), scaled constraints, violation: in
 * units of `within`, which counts 1e-6, where those of ves_design are in units of sizes. With
 * VES_WANT_PROOF the candidate is also measured at level 1, must agree within 1 %, must not violate a
 * constraint by 1 % of its size more, must not cross itself (validity: self_intersection), and the checks of
 * validity: {holds: ...} are asked at both levels (VES_BROKEN). The arrays of verdict are the caller's, and ask->level does not matter to a proof. A candidate that fails is
 * verdict->status > 0. Returns VES_OK; VES_RANGE: there is no such level (without a diagnostic: there is
 * nowhere to write it); VES_ABSENT: VES_WANT_GRADIENT where a measure that is judged has none
 * (ves_plan_search(...).gradients is false); VES_MEMORY: of a proof. */
ves_status ves_plan_evaluate(ves_plan *plan, const ves_ask *ask, ves_verdict *verdict);

/* The two sides of a constraint (ves_problem_constraint tells its text and relation). Its size is |limit| at
 * the start design, the limit being the side that no variable and no measure changes, or the right one when
 * both sides are so or neither; where that is 0, the size of the other side at the start; 1 where both are 0,
 * or where it is not a finite number. */
typedef struct ves_sides {
    double value, limit; /* left and right side */
    double violation;    /* how far it is not met, relative to its size: 0 when it is */
    bool holds;          /* within its tolerance: 1e-6, or what `within` says */
} ves_sides;

/* One candidate with all that is measured on it, in the sign and the units of the file. */
typedef struct ves_design {
    ves_status status;     /* VES_OK, or positive: it cannot be measured, and what has no value is NAN */
    const double *x;       /* [variables] */
    const double *slot;    /* [slots] variables, unknown of solve:, parameters, as in ves_problem_slot */
    const double *measure; /* [measures] */
    const ves_sides *side; /* [constraints] */
    const bool *check;     /* [checks] it holds, at this level; false: it does not, or status is not VES_OK */
    int kind;              /* the first of the kinds of the file that it is of; -1: none, or not VES_OK */
    double objective;      /* NAN: the file has none, or status is not VES_OK */
    double violation;      /* the largest of the constraints, 0 without any; NAN: status is not VES_OK */
    double similarity;     /* the factor of scale:, 1 without; NAN: it failed before that was known */
    bool feasible;         /* VES_OK, and every constraint holds */
} ves_design;

/* Measures everything at x, also what nothing judges; x may be NULL when there are no variables. The arrays
 * of design are the plan's and hold until it is used again. Returns design->status, or negative for faults,
 * VES_RANGE: no such level; design is then untouched. */
ves_status ves_plan_measure(ves_plan *plan, const double *x, int level, ves_design *design);

/* The largest relative difference between the measures and the objectives of two designs; NAN when one could
 * not be measured. A number that is 1e-9 of its natural size is the rounding of a zero and differs by
 * nothing: of a measure L^d, L the size of the shape that the plan began with and d the power of lengths that
 * the measure has (none is known of measures in kg or s; in a file without units, 1 where there is no d), of
 * the objective what its measures would make of it if they did not cancel. */
double ves_plan_change(ves_plan *plan, const ves_design *a, const ves_design *b);

/* That natural size of a measure, in its SI unit; 0: not known. */
double ves_plan_measure_size(const ves_plan *plan, int measure);

/* After a positive answer `status`: a warning "what: ..." that says why, with the place when diag is the one
 * that the problem was read with: which number has left the range of its key (VES_OUTSIDE), which measure or
 * formula has no value (VES_NO_NUMBER), which check is broken (VES_BROKEN), where which patch has no point (VES_NO_POINT), which coefficients are
 * not elliptic (VES_NOT_ELLIPTIC); else the sentence of the status. */
void ves_plan_why(ves_plan *plan, ves_status status, const char *what, ves_diag *diag);

/* After a proof that was answered VES_BROKEN, and before the plan is used again: which check of validity: {holds:
 * ...} does not hold, with the numbers that it reads: "willmore >= 4*pi", with willmore = 11.2 on the finer grid. Returns false, and *text is
 * untouched, when none is broken. */
bool ves_plan_broken(const ves_plan *plan, char *text, size_t size);

/* The problem as a search poses it: vesica/search.h with options, hooks and threads of one's own.
 *
 *     ves_search_problem search = ves_plan_search(&plan, 1);
 *     ves_search_run(&search, &options, NULL, &result);
 *     ves_plan_measure(plan, result->x, 0, &best);
 *
 * plan[workers]: one for each thread that may ask at once, all of one problem and one grid; the array and the
 * plans must outlive the search. A maximum is the minimum of the negative: result->value has the sign of a
 * verdict, ves_design.objective that of the file. Any member may be changed afterwards: search.start =
 * mine. */
ves_search_problem ves_plan_search(ves_plan **plan, int workers);

/* What the best objective changes by, per unit, when something is added to the limit of a constraint, which is the
 * side that told its size: from its multiplier (ves_kkt) to the sign of the file and SI units. */
double ves_plan_rate(const ves_plan *plan, int constraint, double multiplier);

/* What a PDE patch is made of; zero for other kinds. At the design last evaluated. */
typedef struct ves_patch_facts {
    int order;    /* of its equation */
    int band;     /* modes in the data of its conditions */
    int modes;    /* of these solved one by one */
    double tail;  /* share of the data beyond them: root of the sum of squares, of the condition with most */
    double omega; /* lam of all modes beyond; NAN: there are none, or coefficients have no single lam */
    double
        rest; /* the mode, M + 1 or lower, as which these are all solved; NAN: there are none, or omega is given */
    int worst;               /* of the modes solved the one that is amplified most */
    bool inside;             /* conditions stand between the ends: then, of modes 0, `modes` and `worst`, */
    double amplification[3]; /* the size of the surface that positions of size 1 may make, */
    double condition[3];     /* and an estimate of the condition number of the conditions */
} ves_patch_facts;
ves_patch_facts ves_plan_patch(const ves_plan *plan, int patch);

/* How the shell is analysed: in searches (level 0), and by what their results must agree with (1). order 0: no measure asks
 * for a solution. */
typedef struct ves_shell_facts {
    int order, elements, freedoms; /* of all parts together */
    int copies;    /* of what is solved that make the whole; 0: a strip of a surface of revolution */
    bool mirrored; /* it lies between mirror planes; else it comes again turned, or is the whole */
} ves_shell_facts;
ves_shell_facts ves_plan_shell(const ves_plan *plan, int level);

/* Exact values at scattered points (u[k], v[k]) of one patch, 0 <= u <= 1, of the design last evaluated:
 * out[(f * 3 + c) * count + k], f in the order X Xu Xv Xuu Xuv Xvv, c = x, y, z. In the size that `scale:`
 * gives it; not scaled where it failed before that was known (ves_design.similarity). VES_MEMORY; VES_RANGE:
 * no such patch. */
ves_status ves_plan_points(ves_plan *plan, int patch, int count, const double *u, const double *v,
                           double *out);

/* The spine of a PDE patch and its first two derivatives, of the design last evaluated, as above:
 * out[(d * 3 + c) * count + k]. VES_ABSENT: that patch has none; VES_MEMORY; VES_RANGE: no such patch. */
ves_status ves_plan_spine(ves_plan *plan, int patch, int count, const double *u, double *out);

/* Joints: where two ends of PDE patches lie on one curve, or the ends of a patch or sheet that is closed along v
 * lie on each other. The two surfaces share that curve and its v, so all derivatives along it agree; what may jump is what leads across. Let X_w be the derivative along u in the
 * direction that leaves the one patch and enters the other (X_u or -X_u, by the ends that meet), and the
 * curvature that of the normal section conormal to the curve, each side with the normal X_w x X_v. Then
 *     C0  both have the same points
 *     G1  and the same normal: no crease
 *     G2  and the same curvature across. With G1 the two other entries of the second fundamental form follow
 *         from the curve and its normals, so that all normal curvatures agree: highlights do not break
 *     C1  and the same X_w. It implies G1, X_v being shared and X_w, X_v independent
 *     C2  and the same X_w and X_uu. It implies C1 and G2: both forms are made of derivatives that agree
 * C1 says nothing of G2, nor G2 of C1 (two patches of unlike length have unlike X_w, however smooth).
 *
 * Of three or more ends on one curve every two are a joint: which two of them go on into each other, and at
 * what angle the third stands, is then seen. Ends that are points, and caps, are none.
 *
 * Tolerances: a gap of 1e-9 of the curve's radius (rounding is 1e-15 of it, and conditions inside a patch may
 * amplify that); 0.001 degrees (a hundredth of what car bodies ask for; rounding makes 1e-9); 1e-4 of the
 * curvature (what the eye sees in highlights begins at some percent); 1e-5 of |X_u|, which is 0.0006 degrees
 * where it is all sideways; 1e-4 of the larger of |X_u| and |X_uu|. A slope that a search makes equal within
 * 1e-6 meets them. */
typedef enum ves_joint_class {
    VES_JOINT_OPEN, /* not even C0: the conditions of a patch amplify rounding this much */
    VES_JOINT_C0,   /* a crease; or a side has no tangent plane somewhere (X_u = 0) */
    VES_JOINT_G1,
    VES_JOINT_C1,
    VES_JOINT_G2,
    VES_JOINT_C1_G2, /* both, and not C2 */
    VES_JOINT_C2
} ves_joint_class;

typedef struct ves_joint {
    int patch[2], end[2]; /* patch[k] ends at u = end[k] there; in the order of the file */
    const char *curve;    /* its name, of the problem: that at the first end; NULL: a sheet, which has none */
    double gap;           /* largest distance of the two surfaces, m */
    double angle;         /* largest angle between their normals, 0 .. pi: how far the surface turns there */
    double slope_jump;    /* largest |jump of X_w|, relative to the longer X_w there: 0 .. 2 */
    double second_jump;   /* largest |jump of X_uu|, relative to the largest |X_uu| or |X_u| of both ends */
    double curvature_jump;     /* largest jump of the curvature across, 1/m; tells of G2 where there is G1 */
    double curvature_relative; /* the same, relative to the largest such curvature of both ends, or to 1 over
                                  the curve's radius (its root mean square distance from its middle) */
    ves_joint_class continuity;
} ves_joint;

/* How many joints there are; the same for every design. */
int ves_plan_joints(const ves_plan *plan);

/* Joint 0 .. ves_plan_joints - 1 of the design last evaluated, in its size (see ves_plan_points). Its largest
 * values are those at 256 places around, or 16 for each mode of the two patches if these are more (4096 at most):
 * within 2 % of the largest anywhere for what is made of these modes. NAN: a side has no tangent plane somewhere. Takes memory
 * for a while. Positive (VES_UNDETERMINED, VES_NOT_ELLIPTIC): a patch has no surface; VES_RANGE: no such joint;
 * VES_MEMORY. *found is then untouched. */
ves_status ves_plan_joint(ves_plan *plan, int joint, ves_joint *found);

const char *ves_joint_text(ves_joint_class continuity); /* "open", "C0", "G1", "C1", "G2", "C1 G2", "C2" */

/* The shape at x on nu x nv cells a patch (1 to 10000 and 3 to 10000, 2e7 in all; 0: chosen; both
 * VES_FIGURE_ELEMENTS: chosen for the finite elements of its shell, without one as 0), for files, pictures and
 * meshes. Owned by the caller. A design that fails is drawn all the same, with a warning in diag, as long as it
 * has a shape: a positive status says that it has none (VES_NO_ROOT, VES_NO_BRACKET, VES_NO_SCALE,
 * VES_NO_POINT) and *figure is NULL, as after VES_RANGE and VES_MEMORY. One that failed before the factor of
 * `scale:` was known is drawn in the size of its curves; the warning then says "not scaled". */
enum { VES_FIGURE_ELEMENTS = -1 };
ves_status ves_plan_figure(ves_plan *plan, const double *x, int nu, int nv, ves_figure **figure,
                           ves_diag *diag);

#ifdef __cplusplus
}
#endif
#endif

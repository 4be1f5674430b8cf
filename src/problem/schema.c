#include "problem/schema.h"

#include <math.h>
#include <string.h>

#include "base/order.h"
#include "problem/problem.h"

#define END                                                                                                  \
    {                                                                                                        \
        .key = {.name = NULL }                                                                               \
    }
#define LATER(word, what)                                                                                    \
    {                                                                                                        \
        .key = {.name = word, .kind = (ves_kind)VES_LATER, .about = what }                                   \
    }
#define KIND(kind) ((ves_kind)(kind))

/* The tables read like a form: one entry a line, whatever its length. */
/* clang-format off */

static const ves_entry parameter[] = {
    {{"parameter", VES_NUMBER, .about = "a number: a formula of variables and of other parameters"}, "gap: 2 mm", NULL},
    END};

static const ves_entry variable[] = {
    {{"variable", KIND(VES_INTERVAL), .about = "[min, start, max]: formulas of constant parameters"}, "a: [0.01, 0.5, 9]", NULL},
    END};

static const ves_entry varied[] = {
    {{"varied curve", KIND(VES_VARIED), .about = "letters T, R, D or letters with an axis (Tx, Ry); or a map of letters to [min, start, max]"},
     "d1: [T, Rx, Rz, D]", NULL},
    END};

static const ves_entry start[] = {
    {{"start", VES_NUMBER, .about = "the start value of a variable, instead of the one that its range gives"}, "d1Tx: 0.1", NULL},
    END};

static const ves_entry move[] = {
    {{"move", KIND(VES_MOVE), .about = "{MOVE: what it needs}: see the moves"}, "translate: [0, gap, 0]", NULL},
    END};

static const ves_entry curve_keys[] = {
    {{"apply", KIND(VES_LIST), .about = "moves, applied in this order"}, "apply: [{dilate: 2}, {translate: [0, 0, 1]}]", move},
    {{"family", KIND(VES_NEW), .about = "with formula: a family of curves, not one; the name of the plain number that tells them apart, which the formula may use besides v. Sections of a patch use it, nothing else does"}, "family: w", NULL},
    END};

static const ves_entry curve[] = {
    {{"curve", KIND(VES_SOURCE), .about = "{KIND: what it needs, apply: [...]}: see the curve kinds"}, "p1: {circle: {radius: 1}}", curve_keys},
    END};

static const ves_entry operator_keys[] = {
    {{"power", VES_COUNT, .min = 1, .max = VES_POWER_MAX, .fallback = NAN, .about = "N of (d_uu + a^2 d_vv)^N X = 0, an equation of order 2N: it needs 2N conditions; with sections the power may be left out"}, "power: 2", NULL},
    {{"a", VES_NUMBER, .unit = "1", .min = 0, .max = 1e6, .fallback = 1, .about = "smoothing parameter: how fast the ends are forgotten inside; 0 is a polynomial of degree 2N - 1 in u, straight for N = 1, cubic for N = 2"}, "a: 0.925", NULL},
    {{"coefficients", VES_NUMBERS, .unit = "1", .about = "[c0, ..., cN] instead of power and a, N = 1 to 6: c0 d_u^(2N) X + c1 d_u^(2N-2) d_v^2 X + ... + cN d_v^(2N) X = 0; it must be elliptic, c0 t^N + c1 t^(N-1) + ... + cN > 0 for all t >= 0, as it is when all are positive"}, "coefficients: [1, 2, 1]", NULL},
    {{"x", VES_NUMBERS, .unit = "1", .about = "with y and z: coefficients as above, for each coordinate its own"}, "x: [1, 2, 1]", NULL},
    {{"y", VES_NUMBERS, .unit = "1", .about = "as x"}, "y: [1, 2, 1]", NULL},
    {{"z", VES_NUMBERS, .unit = "1", .about = "as x"}, "z: [1, 0.5, 2]", NULL},
    END};

static const ves_entry difference[] = {
    {{"curve", VES_CURVE, .about = "a curve, its weight a binomial number"}, "p1", NULL},
    END};

static const ves_entry condition_keys[] = {
    {{"u", VES_NUMBER, .required = true, .unit = "1", .min = 0, .max = 1, .about = "where across the patch: 0 and 1 are its ends; conditions inside amplify fine detail of their curves (vesica check tells how much)"}, "u: 0.5", NULL},
    {{"derivative", VES_COUNT, .min = 0, .max = VES_CONDITIONS_MAX - 1, .about = "k of d_u^k X, less than the order: 0: the surface itself; 1: X_u"}, "derivative: 1", NULL},
    {{"position", VES_CURVE, .about = "the curve that the surface meets"}, "position: p1", NULL},
    {{"field", VES_CURVE, .about = "d_u^k X = scale * field"}, "field: ring", NULL},
    {{"from", VES_CURVE, .about = "with `to`: d_u^k X = scale * (to - from)"}, "from: p1", NULL},
    {{"to", VES_CURVE, .about = "with `from`: d_u^k X = scale * (to - from)"}, "to: d1", NULL},
    {{"differences", KIND(VES_LIST), .min = 1, .max = VES_CONDITIONS_MAX, .about = "k + 1 curves [p0, ..., pk] for derivative k, as drawn one behind the other along u: d_u^k X = scale * their k-th difference, p1 - p0, p2 - 2 p1 + p0, ...; a scale of 1/h^k makes it the derivative when they are h apart"}, "differences: [p1, p2, p3]", difference},
    {{"scale", VES_NUMBER, .fallback = 1, .about = "length of the derivative"}, "scale: 2", NULL},
    END};

static const ves_entry condition[] = {
    {{"condition", KIND(VES_MAP), .about = "the surface or a derivative of it along one curve u = constant"}, "{u: 0, derivative: 1, from: p1, to: d1, scale: 2}", condition_keys},
    END};

static const ves_entry departure_keys[] = {
    {{"u", VES_NUMBER, .required = true, .unit = "1", .min = 0, .max = 1, .about = "where across the patch"}, "u: 0", NULL},
    {{"derivative", VES_COUNT, .min = 0, .max = VES_CONDITIONS_MAX - 1, .about = "k of d_u^k X, less than the raised order"}, "derivative: 2", NULL},
    {{"field", VES_CURVE, .about = "d_u^k X departs by scale * field"}, "field: bend", NULL},
    {{"from", VES_CURVE, .about = "with `to`: by scale * (to - from)"}, "from: p1", NULL},
    {{"to", VES_CURVE, .about = "with `from`: by scale * (to - from)"}, "to: d1", NULL},
    {{"differences", KIND(VES_LIST), .min = 1, .max = VES_CONDITIONS_MAX, .about = "by scale times the k-th difference of k + 1 curves"}, "differences: [p1, p2, p3]", difference},
    {{"scale", VES_NUMBER, .fallback = 1, .about = "how much of it"}, "scale: 0.5", NULL},
    END};

static const ves_entry raised[] = {
    {{"departure", KIND(VES_MAP), .about = "how far the surface or a derivative of it departs along one curve u = constant"}, "{u: 0, derivative: 2, field: bend, scale: 0.5}", departure_keys},
    END};

static const ves_entry remainder_keys[] = {
    {{"modes", VES_COUNT, .min = 0, .max = 4096, .about = "M, how many modes are solved one by one; 0: chosen: with conditions at the ends only, all that matter at the start, at least 40; with conditions inside, as many of these as come out less than 1000 times as large as their data"}, "modes: 6", NULL},
    {{"omega", VES_NUMBER, .unit = "1", .min = VES_POSITIVE, .max = 1e9, .fallback = NAN, .words = "auto", .about = "lam of all modes beyond; auto: a (M + 1), that of the first mode which is not solved, or less where that mode is beyond what can be solved; a number only with power"}, "omega: 4*a", NULL},
    END};

static const ves_entry spine_points[] = {
    {{"points", VES_POINTS, .required = true, .unit = "m", .about = "the inner control points"}, "points: [[0, 0, 1]]", NULL},
    END};

static const ves_entry spine_keys[] = {
    {{"hermite", VES_POINTS, .unit = "m", .about = "two vectors: the derivatives of the spine, by u, at u = 0 and u = 1; the spine is a cubic"}, "hermite: [[0, 0, 1], [1, 0, 0]]", NULL},
    {{"bspline", VES_POINTS, .unit = "m", .about = "1 to 100 inner control points of a cubic B-spline from end to end, evenly knotted"}, "bspline: [[0, 0, 1], [0, 1, 2]]", spine_points},
    END};

static const ves_entry surface_keys[] = {
    {{"formula", VES_FORMULAS, .about = "[x, y, z], formulas of u and v"}, "formula: [\"u*cos(v)\", \"u*sin(v)\", \"0\"]", NULL},
    {{"points", KIND(VES_GRID), .about = "rows along u of points along v, joined by cubic splines"}, "points: [[[0, 0, 0], [0, 1, 0]], [[1, 0, 0], [1, 1, 0]]]", NULL},
    END};

static const ves_entry domain_keys[] = {
    {{"u", KIND(VES_SPAN), .about = "[from, to], 0 to 1 unless given"}, "u: [0, 1]", NULL},
    {{"v", KIND(VES_SPAN), .about = "[from, to], 0 to 2*pi unless given"}, "v: [0, 2*pi]", NULL},
    END};

static const ves_entry section_curve[] = {
    {{"curve", VES_CURVE, .about = "a curve"}, "p1", NULL},
    END};

static const ves_entry sections_keys[] = {
    {{"of", VES_CURVE, .about = "the family that is sampled, at w = from + u (to - from)"}, "of: sec", NULL},
    {{"w", KIND(VES_SPAN), .about = "[from, to]: what the family's number runs over, whatever its name; may vary. Patches that end on the same section meet there: at equal numbers or, of those that vary, at numbers written alike"}, "w: [0, 2*pi]", NULL},
    {{"count", VES_COUNT, .min = 2, .max = VES_CONDITIONS_MAX, .fallback = NAN, .about = "how many sections of the family"}, "count: 40", NULL},
    {{"curves", KIND(VES_LIST), .min = 2, .max = VES_CONDITIONS_MAX, .about = "instead of of, w and count: the curves themselves, from u = 0 to u = 1"}, "curves: [p1, p2, p3, p4]", section_curve},
    {{"nodes", VES_CHOICE, .words = "chebyshev|equal", .about = "where they stand: section i of 0 ... K - 1 at u = (1 - cos(pi i/(K - 1)))/2, or equally spaced, which from some ten sections on swings wildly between them"}, "nodes: chebyshev", NULL},
    END};

static const ves_entry patch_keys[] = {
    {{"operator", KIND(VES_MAP), .about = "the partial differential equation: (d_uu + a^2 d_vv)^power X = 0, or one with coefficients"}, "operator: {power: 2, a: 1}", operator_keys},
    {{"conditions", KIND(VES_LIST), .max = HUGE_VAL, .about = "what the surface meets, at its ends and inside: as many as the order, 2 * power, with sections and those that joins give, none of them twice"}, "conditions: [{u: 0, position: p1}, {u: 1, position: p2}]", condition},
    {{"sections", KIND(VES_MAP), .about = "curves that the surface passes through, placed along u: each is a condition, and the order of the equation follows from how many there are, with a = 1 unless operator says it"}, "sections: {of: sec, w: [0, 2*pi], count: 40}", sections_keys},
    {{"modes", VES_COUNT, .min = 0, .max = 4096, .about = "how many Fourier modes are solved one by one; 0: chosen, see remainder, which may have it instead"}, "modes: 8", NULL},
    {{"remainder", KIND(VES_MAP), .about = "what becomes of the modes of the data beyond those that are solved: all of them cross the patch as one mode would, with lam = omega, so that every condition is met exactly; the equation is not, there. Conditions inside a patch amplify fine detail beyond all bounds, and this is what tames it"}, "remainder: {modes: 6, omega: auto}", remainder_keys},
    {{"raise", KIND(VES_LIST), .min = 2, .max = HUGE_VAL, .about = "conditions that raise the order, two for each power, and say how far the surface departs there from that of the lower order: by field, from and to, or differences at a derivative that is still free, or by nothing at all, which means 0; while all are 0 the surface is that of the lower order, with as many modes solved (only with power)"}, "raise: [{u: 0, derivative: 2, field: bend}, {u: 1, derivative: 2}]", raised},
    {{"spine", KIND(VES_MAP), .about = "the centre line, instead of the one that the equation gives: what the mean over v of the surface is at each u; it runs from the middle of the end curve at u = 0 to that at u = 1, wherever they go"}, "spine: {hermite: [[0, 0, 1], [1, 0, 0]]}", spine_keys},
    {{"surface", KIND(VES_MAP), .about = "instead of operator and conditions: the surface itself; edges of it that lie on each other are joined, but not with those of other patches"}, "surface: {formula: [u, v, \"u*v\"]}", surface_keys},
    {{"periodic", VES_FLAG, .fallback = 1, .about = "the surface closes in v (only with surface)"}, "periodic: false", NULL},
    {{"domain", KIND(VES_MAP), .about = "what u and v run over in the formulas of the surface, and of integral, min and max over it; places, vesica sample and files count u 0 to 1 and v 0 to 2*pi whatever stands here (only with surface: formula)"}, "domain: {u: [0, 1], v: [0, 2*pi]}", domain_keys},
    END};

static const ves_entry patch[] = {
    {{"patch", KIND(VES_MAP), .about = "operator and conditions, or a surface"}, "wall: {operator: {power: 1}, conditions: [{u: 0, position: p1}, {u: 1, position: p2}]}", patch_keys},
    END};

static const ves_entry place_keys[] = {
    {{"patch", VES_PATCHES, .required = true, .about = "the patch"}, "patch: wall", NULL},
    {{"u", VES_NUMBER, .required = true, .unit = "1", .min = 0, .max = 1, .about = "across the patch"}, "u: 0.5", NULL},
    {{"v", VES_NUMBER, .required = true, .unit = "1", .about = "around the patch"}, "v: pi", NULL},
    END};

static const ves_entry place[] = {
    {{"place", KIND(VES_MAP), .about = "one point of a patch"}, "tip: {patch: wall, u: 0.5, v: pi}", place_keys},
    END};

static const ves_entry end[] = {
    {{"end", KIND(VES_END), .about = "an end of a patch: its name, then .u0 or .u1"}, "wall.u0", NULL},
    END};

static const ves_entry join_keys[] = {
    {{"ends", KIND(VES_LIST), .min = 2, .max = 2, .required = true, .about = "the two ends"}, "ends: [top.u1, side.u0]", end},
    {{"tangent", VES_CURVE, .required = true, .about = "X_u = scale * tangent at the first end; so at the second, where u = 0 meets u = 1, and -scale * tangent where both are u = 0 or both u = 1: one condition of each patch"}, "tangent: tilt", NULL},
    {{"scale", KIND(VES_PAIR), .min = VES_POSITIVE, .max = HUGE_VAL, .fallback = 1, .about = "one number, which makes the surface once (with bend twice) continuously differentiable; or one for each end, which keeps the tangent planes (with bend the curvatures) together"}, "scale: [m1, m2]", NULL},
    {{"bend", VES_CURVE, .about = "X_uu = scale^2 * bend at both ends: one more condition of each patch"}, "bend: arch", NULL},
    END};

static const ves_entry join[] = {
    {{"join", KIND(VES_MAP), .about = "two ends on one curve, and the field that gives both their derivative"}, "{ends: [top.u1, side.u0], tangent: tilt, scale: [m1, m2]}", join_keys},
    END};

static const ves_entry shape_keys[] = {
    {{"closed", VES_FLAG, .about = "the patches, with the caps, enclose a volume"}, "closed: true", NULL},
    {{"caps", KIND(VES_LIST), .about = "free ends that are closed: by the cone from the mean point of the end, which for a flat end is the flat piece inside it"}, "caps: [wall.u0, wall.u1]", end},
    END};

static const ves_entry scale_keys[] = {
    {{"equation", KIND(VES_EQUATION), .required = true, .about = "MEASURE == formula: the shape is scaled until it holds"}, "equation: area == 4*pi", NULL},
    END};

static const ves_entry solve_keys[] = {
    {{"unknown", KIND(VES_NEW), .required = true, .about = "the name of the number to be found"}, "unknown: h", NULL},
    {{"in", KIND(VES_SPAN), .required = true, .about = "[from, to]: where it lies; in between the equation holds once, and every number keeps its range"}, "in: [20 mm, 80 mm]", NULL},
    {{"equation", KIND(VES_EQUATION), .required = true, .about = "what it makes true, for every candidate"}, "equation: volume == 150 ml", NULL},
    END};

static const ves_entry measure[] = {
    {{"measure", KIND(VES_INSTANCE), .about = "{MEASURE: what it needs}: see the measures"}, "lid: {area: {over: [wall]}}", NULL},
    END};

static const ves_entry relation_keys[] = {
    {{"require", KIND(VES_RELATION), .required = true, .about = "the relation"}, "require: area <= 14", NULL},
    {{"within", VES_NUMBER, .unit = "1", .min = VES_POSITIVE, .max = HUGE_VAL, .fallback = 1e-6, .about = "feasible when |excess| / |limit| is at most this; the limit is the side that is always the same, else the right one, at the start; where it is 0, the other side at the start stands for it, where both are, 1"}, "within: 1e-3", NULL},
    END};

static const ves_entry relation[] = {
    {{"constraint", KIND(VES_RELATION), .about = "a relation <=, >= or == of formulas of measures"}, "area <= 14", relation_keys},
    END};

static const ves_entry radius_keys[] = {
    {{"value", VES_NUMBER, .required = true, .unit = "m", .min = 0, .max = HUGE_VAL, .about = "the least distance from the axis"}, "value: 2 mm", NULL},
    {{"axis", VES_VECTOR, .unit = "1", .about = "direction of the axis through the origin, [0, 0, 1] unless given"}, "axis: [0, 1, 0]", NULL},
    {{"over", VES_PATCHES, .about = "the patches, all unless given"}, "over: [wall]", NULL},
    END};

static const ves_entry monotone_keys[] = {
    {{"along", VES_VECTOR, .required = true, .unit = "1", .about = "the direction in which the surface must rise with u"}, "along: [0, 1, 0]", NULL},
    {{"over", VES_PATCHES, .about = "the patches, all unless given"}, "over: [wall]", NULL},
    END};

static const ves_entry holds[] = {
    {{"check", KIND(VES_CHECK), .about = "a formula of measures, variables and parameters that must hold for a best to be accepted"}, "willmore >= 4*pi*(1 - 1e-6)", NULL},
    END};

static const ves_entry validity_keys[] = {
    {{"jacobian", VES_CHOICE, .words = "positive|any", .about = "positive: a candidate whose surface folds back on itself is refused"}, "jacobian: positive", NULL},
    {{"self_intersection", VES_CHOICE, .words = "best|never", .about = "best: every accepted best is checked for crossing itself"}, "self_intersection: best", NULL},
    {{"least_radius", KIND(VES_MAP), .about = "the surface keeps away from an axis"}, "least_radius: {value: 0.1}", radius_keys},
    {{"monotone", KIND(VES_MAP), .about = "the surface never turns back along a direction"}, "monotone: {along: [0, 1, 0]}", monotone_keys},
    {{"holds", KIND(VES_LIST), .max = HUGE_VAL, .about = "checks of every accepted best, on the grid of the search and on the finer one: what is true of all good shapes and false of those that cheat, as a bound from theory. No constraints: nothing pulls a search towards them, and measures that they alone read are measured for bests only"}, "holds: [willmore >= 4*pi*(1 - 1e-6), abs(gauss_curvature - 4*pi) < 1e-3]", holds},
    END};

static const ves_entry quadrature_keys[] = {
    {{"u", VES_COUNT, .min = 0, .max = VES_NODES_U, .about = "Gauss nodes across a patch, 5 at least; 0: chosen"}, "u: 16", NULL},
    {{"v", VES_COUNT, .min = 0, .max = VES_NODES_V, .about = "nodes around a patch, 5 at least; 0: chosen"}, "v: 32", NULL},
    END};

static const ves_entry anneal_keys[] = {
    {{"evaluations", VES_COUNT, .min = 0, .max = 2e9, .about = "budget, all chains together; 0: from the number of variables"}, "evaluations: 20000", NULL},
    {{"as", KIND(VES_SLOT_WORD), .max = VES_SLOT_PRESET, .about = "words for all that is not given. book: proposal fixed, schedule book, population chain, constraints crude"}, "as: book", NULL},
    {{"proposal", KIND(VES_SLOT_WORD), .max = VES_SLOT_PROPOSAL, .about = "how the next candidate is made; mixture unless given"}, "proposal: mixture", NULL},
    {{"schedule", KIND(VES_SLOT_WORD), .max = VES_SLOT_SCHEDULE, .about = "how the temperature falls; budget unless given, with s book"}, "schedule: lam", NULL},
    {{"population", KIND(VES_SLOT_WORD), .max = VES_SLOT_POPULATION, .about = "what the chains are to each other; chains unless given"}, "population: tempering", NULL},
    {{"constraints", KIND(VES_SLOT_WORD), .max = VES_SLOT_CONSTRAINTS, .about = "what a violation costs; lagrangian unless given"}, "constraints: penalty", NULL},
    {{"polish", KIND(VES_SLOT_WORD), .max = VES_SLOT_POLISH, .about = "descents from where the chains are; stages unless given, none before a stage that polishes"}, "polish: stages", NULL},
    {{"chains", VES_COUNT, .min = 0, .max = 4096, .about = "size of the population; 0: as many as it says"}, "chains: 4", NULL},
    {{"c0", VES_NUMBER, .unit = "1", .min = 0, .max = HUGE_VAL, .fallback = NAN, .about = "first temperature; unless given, measured"}, "c0: 1", NULL},
    {{"s", VES_NUMBER, .unit = "1", .min = 0, .max = 1, .fallback = NAN, .about = "schedule c_m = c0 exp((s-1) m); unless given, from the budget"}, "s: 0.9", NULL},
    {{"c_end", VES_NUMBER, .unit = "1", .min = 0, .max = 1, .fallback = NAN, .about = "frozen at c_end * c0; unless given 1e-4, or 1e-10 when nothing polishes the ends"}, "c_end: 1e-4", NULL},
    {{"step", VES_NUMBER, .unit = "1", .min = 0, .max = 1, .fallback = NAN, .about = "first step width as a fraction of each range; 0.1 unless given"}, "step: 0.1", NULL},
    {{"adapt", VES_FLAG, .fallback = 1, .about = "step widths follow the acceptance, covariances are learnt"}, "adapt: true", NULL},
    {{"weight", VES_NUMBER, .unit = "1", .min = 0, .max = HUGE_VAL, .fallback = NAN, .about = "penalty per unit of violation; unless given, from the data"}, "weight: 10", NULL},
    END};

static const ves_entry polish_keys[] = {
    {{"algorithm", KIND(VES_ALGORITHM), .about = "see the algorithms; unless given, by gradients and constraints"}, "algorithm: slsqp", NULL},
    {{"evaluations", VES_COUNT, .min = 0, .max = 2e9, .about = "budget; 0: from the number of variables"}, "evaluations: 2000", NULL},
    {{"x_tolerance", VES_NUMBER, .unit = "1", .min = 0, .max = 1, .fallback = NAN, .about = "stops when x moves less, relative to the ranges; 1e-9 unless given"}, "x_tolerance: 1e-8", NULL},
    {{"f_tolerance", VES_NUMBER, .unit = "1", .min = 0, .max = 1, .fallback = NAN, .about = "stops when the objective changes less, relatively; 1e-12 unless given"}, "f_tolerance: 1e-10", NULL},
    {{"starts", VES_COUNT, .min = 0, .max = 4096, .about = "how many ends of the stage before are polished; 0: all"}, "starts: 1", NULL},
    {{"escape", VES_FLAG, .fallback = 1, .about = "leaves a saddle along a direction of negative curvature"}, "escape: true", NULL},
    END};

static const ves_entry auto_keys[] = {
    {{"only", KIND(VES_SLOT_WORD), .max = VES_SLOT_STRATEGY, .about = "one strategy instead of all"}, "only: cma", NULL},
    {{"evaluations", VES_COUNT, .min = 0, .max = 2e9, .about = "budget; 0: from the number of variables"}, "evaluations: 20000", NULL},
    END};

static const ves_entry stages[] = {
    {{"auto", KIND(VES_MAP), .about = "a portfolio of strategies that share the budget by their progress"}, "auto: {evaluations: 20000}", auto_keys},
    {{"anneal", KIND(VES_MAP), .about = "Metropolis annealing"}, "anneal: {evaluations: 20000}", anneal_keys},
    {{"polish", KIND(VES_MAP), .about = "local search by NLopt"}, "polish: {algorithm: slsqp}", polish_keys},
    END};

const ves_entry ves_schema_stage[] = {
    {{"stage", KIND(VES_STAGE), .about = "one stage; it starts where the stage before ended"}, "anneal: {evaluations: 20000}", stages},
    END};

static const ves_entry check[] = {
    {{"check", KIND(VES_CHECK), .about = "a formula that must hold at the end of a run: of measures, variables, parameters, objective, violation, feasible, evaluations, gradients, optima"},
     "violation < 1e-6", NULL},
    END};

static const ves_entry test_keys[] = {
    {{"evaluations", VES_COUNT, .min = 1, .max = 2e9, .fallback = NAN, .about = "budget of a test run"}, "evaluations: 500", NULL},
    {{"search", KIND(VES_LIST), .words = "auto", .about = "stages of a test run"}, "search: [{polish: {}}]", ves_schema_stage},
    {{"expect", KIND(VES_LIST), .about = "checks of a test run, instead of those of expect"}, "expect: [feasible]", check},
    END};

static const ves_entry swept_keys[] = {
    {{"from", VES_NUMBER, .required = true, .about = "the first value"}, "from: 0.5", NULL},
    {{"to", VES_NUMBER, .required = true, .about = "the last value"}, "to: 1", NULL},
    {{"step", VES_NUMBER, .fallback = NAN, .about = "from each value to the next; this or count"}, "step: 0.01", NULL},
    {{"count", VES_COUNT, .min = 2, .max = VES_SWEEP_VALUES, .fallback = NAN, .about = "how many values, the first and the last included; this or step"}, "count: 51", NULL},
    {{"walk", VES_CHOICE, .words = "up|down|both", .fallback = NAN, .about = "towards which values; both: two walks, which need not meet the same shapes. Unless given, from `from` to `to`"}, "walk: both", NULL},
    END};

static const ves_entry swept[] = {
    {{"swept parameter", KIND(VES_SWEPT), .about = "the values of a constant under `parameters`: a range, a list, or a single one. The first parameter is walked along, each point begins at the best of its neighbour; for each value of the second there are walks of their own"}, "nu: {from: 0.5, to: 1, step: 0.01}", swept_keys},
    END};

static const ves_entry branch_setting[] = {
    {{"setting", VES_TEXT, .about = "what --set would say: a variable's start, a parameter, or a key"}, "zn: 0.4", NULL},
    END};

static const ves_entry kind[] = {
    {{"kind", KIND(VES_CHECK), .about = "a formula of measures, variables and parameters that tells the designs of this name"}, "oblate: width > 1.05*depth", NULL},
    END};

static const ves_entry branch_range[] = {
    {{"from", VES_NUMBER, .required = true, .fallback = NAN, .about = "the least of them"}, "from: 0", NULL},
    {{"to", VES_NUMBER, .required = true, .fallback = NAN, .about = "the largest"}, "to: 1", NULL},
    END};

static const ves_entry branch_at[] = {
    {{"where", KIND(VES_SWEPT), .about = "a value of the parameter, a list of them, or all in a range"}, "c0: {from: 0, to: 1}", branch_range},
    END};

static const ves_entry branch_keys[] = {
    {{"set", KIND(VES_NAMED), .about = "changes of the file, as --set makes them"}, "set: {zn: 0.4, R: 1.3}", branch_setting},
    {{"kind", VES_TEXT, .about = "one of `kinds`, the kind of all designs of the branch: a point that ends at another is lost, and the next one begins at the last that was of it. Unless given, any"}, "kind: oblate", NULL},
    {{"at", KIND(VES_NAMED), .about = "values of a parameter, of the second one that is swept or of one that is not, where the branch is walked; unless given, everywhere"}, "at: {c0: [0, 3]}", branch_at},
    END};

static const ves_entry branch[] = {
    {{"branch", KIND(VES_MAP), .about = "one family of shapes: where its walks begin"}, "oblate: {set: {zn: 0.4, R: 1.3}}", branch_keys},
    END};

static const ves_entry known_keys[] = {
    {{"from", VES_TEXT, .required = true, .about = "a branch"}, "from: oblate", NULL},
    {{"to", VES_TEXT, .required = true, .about = "the one that is better beyond"}, "to: prolate", NULL},
    {{"at", VES_NUMBER, .required = true, .fallback = NAN, .about = "the value of the first parameter"}, "at: 0.651", NULL},
    {{"source", VES_TEXT, .about = "who says so"}, "source: Seifert 1991", NULL},
    END};

static const ves_entry known[] = {
    {{"known", KIND(VES_MAP), .about = "one change of the best branch"}, "{from: oblate, to: prolate, at: 0.651}", known_keys},
    END};

static const ves_entry sweep_keys[] = {
    {{"over", KIND(VES_NAMED), .required = true, .about = "one or two parameters and their values"}, "over: {nu: {from: 0.5, to: 1, count: 51}}", swept},
    {{"branches", KIND(VES_NAMED), .about = "families of shapes that are walked each by itself; unless given, one, which begins where the file does"}, "branches: {oblate: {set: {zn: 0.4, R: 1.3}}, prolate: {}}", branch},
    {{"search", KIND(VES_LIST), .words = "auto", .about = "the search at every point of a walk but its first, from the best of the point before; a polish unless given"}, "search: [{polish: {}}]", ves_schema_stage},
    {{"first", KIND(VES_LIST), .words = "auto", .about = "the search at the first point of a walk; unless given, that of the file, or, with branches, which it might leave, that of all points"}, "first: [{anneal: {}}, {polish: {}}]", ves_schema_stage},
    {{"known", KIND(VES_LIST), .about = "where others have found that the best goes over from one branch to another: told beside what the sweep finds"}, "known: [{from: oblate, to: prolate, at: 0.651, source: Seifert 1991}]", known},
    {{"finest", VES_NUMBER, .fallback = NAN, .about = "where a walk would lose its branch its steps are halved, down to this, in the first parameter: the branch is followed as far as it goes, and the point that is lost all the same says how far (`reached`). Unless given, steps are what `over` says"}, "finest: 0.001", NULL},
    END};

static const ves_entry root[] = {
    {{"vesica", VES_COUNT, .required = true, .about = "version of the format: 1"}, "vesica: 1", NULL},
    {{"title", VES_TEXT, .about = "one line for people"}, "title: Least-curvature surface between two rings", NULL},
    {{"parameters", KIND(VES_NAMED), .about = "named numbers that stay fixed in a run, or follow the variables"}, "parameters: {gap: 2, half: gap/2}", parameter},
    {{"variables", KIND(VES_NAMED), .about = "named numbers that a search may change, each with its range"}, "variables: {a: [0.01, 0.5, 9]}", variable},
    {{"vary", KIND(VES_NAMED), .about = "declares variables that move a curve: translation, rotation, dilation along x, y, z"}, "vary: {d1: [T, R, D]}", varied},
    {{"start", KIND(VES_NAMED), .about = "start values of variables"}, "start: {d1Tx: 0.1}", start},
    {{"curves", KIND(VES_NAMED), .about = "closed curves, and fields along them"}, "curves: {p1: {circle: {radius: 1}}}", curve},
    {{"modes", VES_COUNT, .min = 1, .max = 4096, .fallback = VES_CURVE_MODES, .about = "most Fourier modes of a curve"}, "modes: 64", NULL},
    {{"patches", KIND(VES_NAMED), .required = true, .about = "surfaces between curves"}, "patches: {wall: {operator: {power: 1}, conditions: [{u: 0, position: p1}, {u: 1, position: p2}]}}", patch},
    {{"joins", KIND(VES_LIST), .max = HUGE_VAL, .about = "ends that lie on one curve and go on smoothly into each other: the conditions on the derivatives there, of both patches, come from one field"}, "joins: [{ends: [top.u1, side.u0], tangent: tilt, scale: [m1, m2], bend: arch}]", join},
    {{"places", KIND(VES_NAMED), .about = "named points of patches"}, "places: {tip: {patch: wall, u: 0.5, v: pi}}", place},
    {{"shape", KIND(VES_MAP), .about = "how the patches form one shape"}, "shape: {closed: true, caps: [wall.u0, wall.u1]}", shape_keys},
    {{"scale", KIND(VES_MAP), .about = "scales the whole shape about the origin so that an equation holds exactly"}, "scale: {equation: area == 4*pi}", scale_keys},
    {{"solve", KIND(VES_MAP), .about = "finds one more number from an equation, for every candidate"}, "solve: {unknown: h, in: [20 mm, 80 mm], equation: volume == 150 ml}", solve_keys},
    {{"measures", KIND(VES_NAMED), .about = "measures with settings of their own; plain measures need no entry"}, "measures: {lid: {area: {over: [wall]}}}", measure},
    {{"minimize", KIND(VES_GOAL), .about = "the objective: a formula of measures, variables and parameters"}, "minimize: bending", NULL},
    {{"maximize", KIND(VES_GOAL), .about = "the objective, when more is better"}, "maximize: volume/area", NULL},
    {{"constraints", KIND(VES_LIST), .about = "relations that the shape must meet"}, "constraints: [area <= 14]", relation},
    {{"validity", KIND(VES_MAP), .about = "which surfaces are refused"}, "validity: {jacobian: positive, self_intersection: best}", validity_keys},
    {{"kinds", KIND(VES_NAMED), .about = "names for designs: the first whose formula holds is the kind of a design; if none does, it is none of these. Runs and sweeps tell the kind of each result, and say where it changes"}, "kinds: {oblate: width > 1.05*depth, prolate: depth > 1.05*width}", kind},
    {{"quadrature", KIND(VES_MAP), .words = "auto", .about = "nodes of integrals on each patch; auto: chosen at the start design, and again at the best if that asks for more"}, "quadrature: {u: 16, v: 32}", quadrature_keys},
    {{"search", KIND(VES_LIST), .words = "auto", .about = "stages of the search; auto: a portfolio of basin hopping, CMA-ES and searches along the axes, then a polish of the best ends"}, "search: [{anneal: {evaluations: 20000}}, {polish: {algorithm: slsqp}}]", ves_schema_stage},
    {{"seed", KIND(VES_SEED), .fallback = 1, .about = "seed of the random numbers: same seed, same result"}, "seed: 7", NULL},
    {{"expect", KIND(VES_LIST), .about = "checks at the end of a run"}, "expect: [violation < 1e-6]", check},
    {{"test", KIND(VES_MAP), .about = "a smaller run for tests"}, "test: {evaluations: 500, expect: [feasible]}", test_keys},
    {{"sweep", KIND(VES_MAP), .about = "what vesica sweep walks over: the best shape for each value of a parameter, each search begun at the best of the value before"}, "sweep: {over: {nu: {from: 0.5, to: 1, step: 0.01, walk: both}, c0: [0, 3]}}", sweep_keys},
    {{"shell", KIND(VES_MAP), .about = "patches as thin shells: what they are made of, what holds them and what loads them"}, "shell: {parts: {wall: {thickness: 0.1}}, material: {E: 2e9, nu: 0.35}, supports: [{at: p1, fix: all}], cases: {stack: [{at: p2, line: [0, 0, -187]}]}}", ves_schema_shell},
    LATER("animate", "parameters that follow time"),
    END};

const ves_entry ves_schema_root = {{"problem", KIND(VES_MAP), .about = "a problem file"}, NULL, root};

/* clang-format on */

const ves_key ves_schema_over = {
    .name = "over", .kind = VES_PATCHES, .about = "the patches that are measured, all unless given"};

const ves_entry *ves_schema_find(const ves_entry *table, const char *name)
{
    for (const ves_entry *e = table; e && e->key.name; e++)
        if (!strcmp(e->key.name, name)) return e;
    return NULL;
}

const ves_entry *ves_schema_below(const ves_entry *entry)
{
    while (entry->table && ((int)entry->key.kind == VES_LIST || (int)entry->key.kind == VES_NAMED))
        entry = entry->table;
    return entry->table;
}

#include "problem/describe.h"

#include <math.h>
#include <string.h>

const char ves_describe_formulas[] = "Any number may be a formula of variables, parameters and the unknown "
                                     "of `solve`; goals and constraints read measures too.\n"
                                     "\n"
                                     "- Operators: `+ - * / ^` (`^` binds tighter than a minus sign and from "
                                     "the right), comparisons `< <= > >= == !=`, which give 0 or\n"
                                     "  1, and `and`, `or`, `not`.\n"
                                     "- Functions: `sin cos tan asin acos atan atan2 sinh cosh tanh exp log "
                                     "sqrt abs min max hypot sign floor mod`, `if(c, a, b)`;\n"
                                     "  and `pi`.\n"
                                     "- A unit follows a number: `2 mm`, `15 N/m`, `1050 kg/m^3`, `10 deg`, "
                                     "`30 %`. It takes every `*`, `/` and `^` that another unit or\n"
                                     "  exponent follows.\n"
                                     "- As soon as one number of a file has a unit, dimensions are checked "
                                     "everywhere in it, and a plain number is no length any more.\n"
                                     "- To YAML a comma ends an item of a list: a formula with commas inside "
                                     "brackets is quoted, `[\"max(a, b)\", 1]`.\n";

const char ves_describe_names[] = "A name has letters, digits and `_`, a letter first. In formulas the words "
                                  "`u v pi and or not if auto true false null`, the\n"
                                  "functions, and `objective violation feasible evaluations gradients "
                                  "optima` have meanings of their own. A variable or parameter may\n"
                                  "bear the name of a measure, which it then hides. `x y z H K k1 k2` mean "
                                  "the surface in formulas at its points.\n";

const char ves_describe_units[] =
    "Inside, everything is in SI units and radians. The screen shows numbers as the problem file writes "
    "them, "
    "`result.json` in SI units.\n"
    "Files of shapes (`vesica export`) have lengths in m, whatever the problem file writes; `--unit mm`, or "
    "any other unit of length here, writes\n"
    "them in that. Programs that print read STL and OBJ as mm. In a file without units the numbers stay its "
    "own.\n";

#define POINT "a name at the points of the surface"
#define CHECK "a name in the checks of expect"
#define JOINT "a word of check and of results, on joints"
#define JOINED                                                                                               \
    "where ends of patches lie on one curve, or a surface meets itself; every two of them are a joint. "     \
    "Both sides have there\n"                                                                                \
    "      open   not even the same points\n"                                                                \
    "      C0     the same points, within 1e-9 of the curve's radius\n"                                      \
    "      G1     and the same normals, within 0.001 degrees: no crease\n"                                   \
    "      G2     and the same curvature across, within 1e-4 of it: highlights do not break\n"               \
    "      C1     G1, and the same X_u (or opposite ones, where ends of one kind meet), within 1e-5 of it\n" \
    "      C1 G2  both of these\n"                                                                           \
    "      C2     C1, G2, and the same X_uu, within 1e-4\n"                                                  \
    "      What is better than C0 comes from `joins`, or from conditions that agree: both sides a "          \
    "derivative from one field (with one\n"                                                                  \
    "      scale C1, else G1), for G2 and C2 the second derivative as well"
#define AMPLIFIED                                                                                            \
    "the size of the surface that curves of size 1 may make, of mode 0 and of the highest mode that is "     \
    "solved (Lebesgue's number). Fine\n"                                                                     \
    "      detail of conditions inside a patch grows like e^(a n u) on the way to its ends; the condition "  \
    "number tells how many digits that\n"                                                                    \
    "      costs. Where mode 0 is large, move the places towards the ends (nodes: chebyshev); where the "    \
    "highest is, solve fewer modes: the\n"                                                                   \
    "      others go into the remainder"
#define REMAINDER "remainder: {modes: 6, omega: auto}"
#define JOINS     "joins: [{ends: [top.u1, side.u0], tangent: tilt, bend: arch}]"
const ves_term ves_describe_terms[] = {
    {"x", POINT, "the first coordinate; x, y, z are lengths", "far: {max: \"sqrt(x^2 + y^2 + z^2)\"}"},
    {"y", POINT, "the second coordinate, the direction of height", "top: {max: y}"},
    {"z", POINT, "the third coordinate, the axis of a circle unless it says another", "top: {max: z}"},
    {"u", POINT,
     "from 0 to 1 across a patch, from one end curve to the other; of a surface given by "
     "formulas, in its domain",
     "inner: {integral: \"u < 0.5\"}"},
    {"v", "a name in formulas of curves and at the points of the surface",
     "along the end curves of a patch, from 0 to 2 pi; of a surface given by formulas, in its domain",
     "curves: {ring: {formula: [\"cos(v)\", \"sin(v)\", \"0\"]}}"},
    {"H", POINT, "mean curvature (k1 + k2)/2, in 1/m: 1/R on a sphere seen from outside",
     "bend: {integral: \"H^2\"}"},
    {"K", POINT, "Gauss curvature k1 k2, in 1/m^2: 1/R^2 on a sphere, below 0 on a saddle", "dent: {min: K}"},
    {"k1", POINT, "the larger principal curvature, in 1/m, signed as H: 1/R on a sphere seen from outside",
     "sharp: {max: \"abs(k1)\"}"},
    {"k2", POINT, "the smaller principal curvature, in 1/m, signed as H", "hollow: {min: k2}"},
    {"objective", CHECK, "what is minimized or maximized, of the best design", "expect: [objective < 12.2]"},
    {"violation", CHECK, "the largest violation of a constraint by the best design, relative to its size",
     "expect: [violation < 1e-6]"},
    {"feasible", CHECK, "1 when the best design meets all constraints and passed its checks, else 0",
     "expect: [feasible]"},
    {"evaluations", CHECK, "how many designs the search has measured", "expect: [evaluations <= 5000]"},
    {"gradients", CHECK, "how many of them with their gradient", "expect: [gradients > 0]"},
    {"optima", CHECK, "how many different optima the search has found and lists, the best included",
     "expect: [optima >= 2]"},
    {"saddle", "a word of results",
     "an optimum from which a direction of negative curvature leads lower: no minimum; searches leave it "
     "where they can",
     "polish: {escape: true}"},
    {"joint", JOINT, JOINED, JOINS},
    {"joints", JOINT, JOINED, JOINS},
    {"open", JOINT,
     "the two sides do not even have the same points (within 1e-9 of the curve's radius), though both end on "
     "the curve: conditions\n"
     "      inside a patch amplify rounding that much. Fewer modes (remainder: {modes: 6}) or Chebyshev "
     "places "
     "help; see amplified",
     "remainder: {modes: 6}"},
    {"C0", JOINT,
     "the two sides have the same points and a crease between them, whose largest angle is told (G1 begins "
     "at 0.001 degrees), or one of\n"
     "      them has no tangent plane somewhere; `joins` make it smooth; see joints",
     JOINS},
    {"crease", JOINT,
     "how far the surface turns at a joint that is not smooth: the largest angle between the normals of its "
     "two sides. From 0.001 degrees\n"
     "      on the joint is C0, not G1; `joins` make it smooth",
     JOINS},
    {"G1", JOINT, JOINED, JOINS},
    {"G2", JOINT, JOINED, JOINS},
    {"C1", JOINT, JOINED, JOINS},
    {"C1 G2", JOINT, JOINED, JOINS},
    {"C2", JOINT, JOINED, JOINS},
    {"amplified", "a word of check, on patches with conditions inside", AMPLIFIED, REMAINDER},
    {"lebesgue", "the number that check lists as amplified", AMPLIFIED, REMAINDER},
    {"hits", "a word of results", "how many descents ended in an optimum (screen: found ... times)",
     "result.json: optima[0].hits"},
    {0}};
#undef POINT
#undef CHECK
#undef JOINT
#undef JOINED
#undef JOINS
#undef AMPLIFIED
#undef REMAINDER

static void list_kind(ves_writer *writer, const ves_key *key)
{
    ves_write(writer, "list");
    if (key->max == key->min)
        ves_write(writer, " of %g", key->min);
    else if (!isinf(key->max))
        ves_write(writer, " of %g to %g", key->min, key->max);
}

void ves_describe_kind(ves_writer *writer, const ves_key *key)
{
    static const char *const plain[] = {"",
                                        "number",
                                        "[x, y, z]",
                                        "number or [x, y, z]",
                                        "list of numbers",
                                        "list of points [[x, y, z], ...]",
                                        "list [[number, curve], ...]",
                                        "whole number",
                                        "true or false",
                                        "",
                                        "text",
                                        "curve",
                                        "place or curve",
                                        "patch, or list of patches",
                                        "three formulas",
                                        "formula of x, y, z, H, K, k1, k2, u, v",
                                        "load case",
                                        "curve, PATCH.u0, .u1, .v0 or .v1, or place",
                                        "formula of x, y, z, u, v, thickness",
                                        "curve, PATCH.u0, .u1, .v0 or .v1, or place that a support names"};
    static const char *const compound[] = {"mapping",
                                           "names",
                                           "list",
                                           "[min, start, max]",
                                           "[from, to]",
                                           "rows of points",
                                           "new name",
                                           "letters",
                                           "curve kind",
                                           "move",
                                           "measure",
                                           "stage",
                                           "algorithm",
                                           "word",
                                           "whole number",
                                           "formula of measures",
                                           "equation a == b",
                                           "relation a <= b, a >= b or a == b",
                                           "formula of measures",
                                           "PATCH.u0 or PATCH.u1",
                                           "number, or list of two",
                                           "mapping, or list of values",
                                           "formula of u, v, x, y, z",
                                           "[x, y, z], formulas of u, v, x, y, z",
                                           "word of the materials",
                                           "later"};
    int kind = (int)key->kind;
    if (kind == VES_CHOICE) {
        for (const char *c = key->words; *c; c++)
            if (*c == '|')
                ves_write(writer, " or ");
            else
                ves_write(writer, "%c", *c);
        return;
    }
    if (key->words) ves_write(writer, "%s, or a ", key->words);
    if (kind == VES_LIST && key->max != 0)
        list_kind(writer, key);
    else if (kind == VES_LIST && !key->words)
        ves_write(writer, "list, or one item of it");
    else
        ves_write(writer, "%s", kind < VES_MAP ? plain[kind] : compound[kind - VES_MAP]);
}

static bool number_kind(const ves_key *key)
{
    return key->kind == VES_NUMBER || key->kind == VES_COUNT || (int)key->kind == VES_SEED ||
           (int)key->kind == VES_PAIR;
}

void ves_describe_default(ves_writer *writer, const ves_key *key)
{
    if (key->required)
        ves_write(writer, "required");
    else if (key->kind == VES_FLAG)
        ves_write(writer, "default %s", key->fallback != 0 ? "true" : "false");
    else if (key->kind == VES_CHOICE && !isnan(key->fallback)) {
        const char *word = key->words;
        for (int k = 0; k < (int)key->fallback; k++) word = strchr(word, '|') + 1;
        ves_write(writer, "default %.*s", (int)strcspn(word, "|"), word);
    } else if (number_kind(key) && !isnan(key->fallback)) {
        ves_write(writer, "default %.12g", key->fallback);
    }
}

void ves_describe_limits(ves_writer *writer, const ves_key *key)
{
    bool bounded = key->min != 0 || key->max != 0, above = bounded && !isinf(key->min),
         below = bounded && !isinf(key->max);
    const char *gap = "";
    if ((int)key->kind == VES_LIST) return; /* its kind tells */
    if (key->min == VES_POSITIVE && below)
        ves_write(writer, "> 0, <= %.12g", key->max);
    else if (key->min == VES_POSITIVE)
        ves_write(writer, "> 0");
    else if (above && below)
        ves_write(writer, "%.12g .. %.12g", key->min, key->max);
    else if (above || below)
        ves_write(writer, "%s %.12g", above ? ">=" : "<=", above ? key->min : key->max);
    if (bounded) gap = ", ";
    if (key->unit && strcmp(key->unit, "1")) ves_write(writer, "%sin %s", gap, key->unit);
}

static void sample(ves_writer *writer, const ves_key *key)
{
    static const char *const text[] = {"",
                                       "",
                                       "[0, 0, 1]",
                                       "2",
                                       "[2, 1]",
                                       "[[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0]]",
                                       "[[1, p1]]",
                                       "",
                                       "true",
                                       "",
                                       "text",
                                       "p1",
                                       "p1",
                                       "[wall]",
                                       "[\"cos(v)\", \"sin(v)\", \"0\"]",
                                       "\"H^2\"",
                                       "stack",
                                       "p1",
                                       "\"u > 0.1\"",
                                       "p1"};
    if (number_kind(key))
        ves_write(writer, "%g", key->min > 1 ? ceil(key->min / 2) * 2 : 1.0);
    else if (key->kind == VES_CHOICE)
        ves_write(writer, "%.*s", (int)strcspn(key->words, "|"), key->words);
    else
        ves_write(writer, "%s", text[key->kind]);
}

void ves_describe_example(ves_writer *writer, const char *name, const ves_key *keys)
{
    int required = 0;
    for (const ves_key *key = keys; key && key->name; key++) required += key->required;
    ves_write(writer, "{%s: ", name);
    if (keys && keys->name && required <= 1 && keys->required) {
        sample(writer, keys);
    } else {
        const char *gap = "{";
        for (const ves_key *key = keys; key && key->name; key++) {
            if (!key->required) continue;
            ves_write(writer, "%s%s: ", gap, key->name);
            sample(writer, key);
            gap = ", ";
        }
        ves_write(writer, "%s}", *gap == '{' ? "{" : "");
    }
    ves_write(writer, "}");
}

const char *ves_describe_status(ves_status status)
{
    switch (status) {
    case VES_DEGENERATE:
        return "Two tangents are parallel, or one is zero: curves meet, or a slope has no length. Keep the "
               "lengths of "
               "slopes away\n      from 0 by their ranges.";
    case VES_FOLDED:
        return "The normal turns over: rows of the surface overtake each other, often because slopes are too "
               "long. "
               "Narrower ranges\n      help; validity: {jacobian: any} lets such shapes pass.";
    case VES_INVERTED:
        return "The volume is negative: curves have changed places. Narrow the ranges so that they cannot.";
    case VES_LOOSE:
        return "A part of the shell may move as a rigid body: hold it in more directions (shell: {supports: "
               "...}), or join "
               "it to what is\n      held.";
    case VES_NO_WALL:
        return "The formula of a part's thickness is 0 or less at some node of the shell. Keep it positive "
               "by the ranges of "
               "its\n      variables.";
    case VES_NO_CONVERGENCE:
        return "Lanczos' steps were used up before a factor of buckling had settled: its modes lie close "
               "together. A "
               "coarser mesh, or\n      symmetry: none, may help.";
    case VES_NARROW:
        return "Asked for by validity: {least_radius: ...}.";
    case VES_NOT_MONOTONE:
        return "Asked for by validity: {monotone: ...}.";
    case VES_NO_ROOT:
        return "Both ends of the interval `in` of `solve` lie on one side of its equation: no root "
               "between them, or two. Widen or narrow it, or\n      narrow the ranges of the variables. Or "
               "the equation jumps over 0, as 1/(area - 2) or sign() do.";
    case VES_NO_SCALE:
        return "The measure or the formula of `scale` is 0, infinite, or they have different signs. Narrow "
               "the ranges of the\n      variables.";
    case VES_NO_BRACKET:
        return "At `in` of `solve`, and up to 1 % inside it, the shape fails. Give ends where it can be "
               "measured,\n      or narrow the ranges of the variables.";
    case VES_NO_NUMBER:
        return "A formula or a measure gave infinity, 0/0 or the root of a negative number.";
    case VES_NO_POINT:
        return "A formula of a curve, a surface or a number that moves them gave infinity, 0/0 or the root "
               "of a "
               "negative\n      number there.";
    case VES_SELF_INTERSECTS:
    case VES_TOUCHES:
        return "Looked for at each best, not at every candidate; validity: {self_intersection: never} leaves "
               "it out.";
    case VES_COARSE:
        return "A best is measured again with twice as many nodes. Give more: quadrature: {u: 32, v: 64}.";
    case VES_CUT:
        return "No fault: the search needed no more of this candidate.";
    case VES_OUTSIDE:
        return "A formula of variables leads out of the range of its key, as a radius below 0. Narrow the "
               "ranges.";
    case VES_NOT_ELLIPTIC:
        return "c0 t^N + c1 t^(N-1) + ... + cN, with the coefficients of the patch, is 0 or less for some t "
               ">= "
               "0: in that direction waves\n      run along u instead of dying out. Narrow the ranges of the "
               "variables; coefficients that are all positive are safe.";
    case VES_UNDETERMINED:
        return "Conditions inside a patch, or derivatives without the lower ones, can leave a mode free for "
               "some coefficients or some a.\n      Narrow the ranges, or give positions and all lower "
               "derivatives where a derivative stands.";
    case VES_BROKEN:
        return "Asked for by validity: {holds: [...]}, at each best, not at every candidate. Where designs "
               "that "
               "are good break it, give the\n      formula the room that the grid needs, as in willmore >= "
               "4*pi*(1 - 1e-6).";
    case VES_SINGULAR:
        return "Conditions of a patch say the same, or leave a mode free.";
    case VES_FAULT:
        return "Please report it, with the problem file.";
    default:
        return "";
    }
}

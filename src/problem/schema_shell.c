/* What the section `shell` may hold: tables as in schema.c. */
#include <math.h>

#include "problem/schema.h"
#include "problem/shell.h"

#define END                                                                                                  \
    {                                                                                                        \
        .key = {.name = NULL }                                                                               \
    }
#define KIND(kind) ((ves_kind)(kind))

/* clang-format off */

static const ves_entry part_keys[] = {
    {{"thickness", KIND(VES_FIELD), .required = true, .unit = "m", .about = "of the wall, in m: a formula of u, v, x, y, z at its mid-surface, and of variables, as all numbers. Where it is not more than 0 a candidate is refused"}, "thickness: \"0.2*(1 - 0.3*u)\"", NULL},
    {{"elements", KIND(VES_PAIR), .min = 0, .max = VES_SHELL_ELEMENTS, .fallback = NAN, .about = "how many along u and v of the whole patch in searches, or one number for both; 0: chosen. Unless given, as `mesh` says"}, "elements: [8, 16]", NULL},
    END};

static const ves_entry part[] = {
    {{"part", KIND(VES_MAP), .about = "a patch that is a shell, by its name"}, "wall: {thickness: 0.1}", part_keys},
    END};

static const ves_entry material_keys[] = {
    {{"E", VES_NUMBER, .unit = "Pa", .min = VES_POSITIVE, .max = HUGE_VAL, .fallback = NAN, .about = "Young's modulus"}, "E: 2e9", NULL},
    {{"nu", VES_NUMBER, .unit = "1", .min = -0.9999, .max = 0.4999, .fallback = NAN, .about = "Poisson's ratio"}, "nu: 0.35", NULL},
    {{"density", VES_NUMBER, .unit = "kg/m^3", .min = 0, .max = HUGE_VAL, .fallback = NAN, .about = "for mass and gravity"}, "density: 1050", NULL},
    {{"yield", VES_NUMBER, .unit = "Pa", .min = VES_POSITIVE, .max = HUGE_VAL, .fallback = NAN, .about = "tensile yield strength, which formulas of measures compare stresses with: shear <= material.yield/2"}, "yield: 20e6", NULL},
    {{"shear", VES_NUMBER, .unit = "1", .min = VES_POSITIVE, .max = HUGE_VAL, .fallback = 5.0 / 6, .about = "shear correction: the share of the wall that carries transverse shear; 5/6 unless given"}, "shear: 5/6", NULL},
    {{"like", KIND(VES_MATERIAL), .about = "a material of the table, for all that is not given"}, "like: hips", NULL},
    END};

static const ves_entry fix_word[] = {
    {{"direction", VES_CHOICE, .words = "x|y|z|rx|ry|rz|all|pinned", .about = "a displacement along an axis or a rotation about it; all: all six; pinned: the three displacements"}, "x", NULL},
    END};

static const ves_entry support_keys[] = {
    {{"at", VES_SHELL_AT, .required = true, .about = "a curve that parts end on, an edge, or a place"}, "at: p1", NULL},
    {{"fix", KIND(VES_LIST), .about = "what is held: all, pinned (x, y, z), or a list of x, y, z, rx, ry, rz"}, "fix: [x, y, rz]", fix_word},
    {{"symmetry", VES_VECTOR, .unit = "1", .about = "the normal of a mirror plane that the shell ends on: held are the displacement along it and the rotations across it"}, "symmetry: [1, 0, 0]", NULL},
    {{"diaphragm", VES_VECTOR, .unit = "1", .about = "the axis of a stiff plate that closes the end: held are the displacements across it; along it, and to rotate, the edge is free"}, "diaphragm: [0, 1, 0]", NULL},
    {{"spring", VES_VECTOR, .min = 0, .max = HUGE_VAL, .about = "stiffness against displacements along x, y, z: in N/m^2 along a curve or an edge (N/m for each m of it), in N/m at a place"}, "spring: [0, 1000, 0]", NULL},
    END};

static const ves_entry support[] = {
    {{"support", KIND(VES_MAP), .about = "where, and one of fix, symmetry, diaphragm and spring; several may stand at one place"}, "{at: p1, fix: all}", support_keys},
    END};

static const ves_entry load_keys[] = {
    {{"at", VES_SHELL_AT, .about = "of line and force: a curve that parts end on, an edge; of force also a place"}, "at: p2", NULL},
    {{"over", VES_PATCHES, .about = "of pressure, area and gravity: the parts, all unless given"}, "over: [wall]", NULL},
    {{"line", KIND(VES_FIELDS), .unit = "N/m", .about = "force per length, along the curve or edge"}, "line: [0, -187, 0]", NULL},
    {{"force", VES_VECTOR, .unit = "N", .about = "at a place: a point load; at a curve or an edge: a total force, evenly spread along it"}, "force: [0, 0, 1]", NULL},
    {{"pressure", KIND(VES_FIELD), .unit = "Pa", .about = "along the normal of the patch, X_u x X_v, which points outward from closed shapes: there more than 0 pushes from inside"}, "pressure: 1000", NULL},
    {{"area", KIND(VES_FIELDS), .unit = "Pa", .about = "force per area of the mid-surface"}, "area: [0, -90, 0]", NULL},
    {{"gravity", VES_VECTOR, .unit = "m/s^2", .about = "acceleration, which is multiplied by density and thickness"}, "gravity: [0, -9.81, 0]", NULL},
    END};

static const ves_entry load[] = {
    {{"load", KIND(VES_MAP), .about = "one of line, force, pressure, area and gravity, and where"}, "{at: p2, line: [0, -187, 0]}", load_keys},
    END};

static const ves_entry load_case[] = {
    {{"case", KIND(VES_LIST), .about = "the loads that act together"}, "stack: [{at: p2, line: [0, -187, 0]}]", load},
    END};

static const ves_entry mesh_keys[] = {
    {{"order", VES_COUNT, .min = 0, .max = VES_SHELL_MOST, .about = "of the elements: 1 is MITC4+, 2 is MITC9, 6 to 10 are integrated fully; 3 to 5 would lock. 0: chosen"}, "order: 2", NULL},
    {{"elements", KIND(VES_PAIR), .min = 0, .max = VES_SHELL_ELEMENTS, .fallback = NAN, .about = "how many along u and v of each whole patch, or one number for both; 0: chosen"}, "elements: [12, 24]", NULL},
    {{"grading", VES_NUMBER, .unit = "1", .min = 1, .max = 10, .fallback = NAN, .about = "elements become smaller towards the edges, as this power of the distance; 1: they do not. Unless given, chosen"}, "grading: 1.8", NULL},
    END};

const ves_entry ves_schema_shell[] = {
    {{"parts", KIND(VES_NAMED), .required = true, .about = "the patches that are shells"}, "parts: {wall: {thickness: 0.1}}", part},
    {{"material", KIND(VES_MATERIAL), .required = true, .words = "mapping", .about = "what it is made of, linear and elastic: a word of the table (vesica list materials), in files with units, or E, nu and what else is needed. Objective, constraints, equations, checks and conditions of kinds read material.E, .nu, .density and .yield"}, "material: {E: 2e9, nu: 0.35, density: 1050, yield: 20e6}", material_keys},
    {{"supports", KIND(VES_LIST), .about = "what holds it; there must be some"}, "supports: [{at: p1, fix: all}]", support},
    {{"cases", KIND(VES_NAMED), .about = "load cases, each solved by itself; measures name them"}, "cases: {stack: [{at: p2, line: [0, -187, 0]}]}", load_case},
    {{"mesh", KIND(VES_MAP), .words = "auto", .about = "the elements in searches; auto: chosen"}, "mesh: {order: 2, elements: [12, 24], grading: 1.8}", mesh_keys},
    {{"verify", KIND(VES_MAP), .words = "auto", .about = "the elements of the finer analysis that every best must agree with, of order 6 at least; auto: chosen"}, "verify: {order: 8, elements: 6}", mesh_keys},
    {{"symmetry", VES_CHOICE, .words = "auto|none", .about = "auto: sectors and mirror planes of a design, its supports and loads are found, and only one of the sectors is analysed; none: always the whole"}, "symmetry: none", NULL},
    END};

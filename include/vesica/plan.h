/* Plan: a Problem made ready to be evaluated. Everything that can be known before x is known is paid once, in
 * ves_plan_create: x --bind--> numbers --curves--> modes --solve--> patches --sample--> samples --measure-->
 * m[] --judge--> Verdict An evaluation allocates nothing. One plan per thread; the problem is shared. */
#ifndef VESICA_PLAN_H
#define VESICA_PLAN_H

#include "vesica/figure.h"
#include "vesica/problem.h"
#include "vesica/verdict.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ves_plan ves_plan;

typedef struct ves_plan_options {
    int quadrature[2]; /* nodes along u and v; 0: as the problem says, and `auto` there means
                          ves_plan_quadrature */
} ves_plan_options;

/* A positive status: the start design cannot be sampled; the plan is made all the same. */
ves_status ves_plan_create(const ves_problem *problem, const ves_plan_options *options, ves_plan **plan,
                           ves_diag *diag);
void ves_plan_destroy(ves_plan *plan);

/* The quadrature that `auto` chooses: from 16 nodes along u, and along v enough to see the modes that are
 * solved, each direction is refined by half until two refinements in a row change no measure (extremes
 * left out) by more than 1e-9 of its size, up to 64 and 264 nodes. Measured at the start design or, if
 * that cannot be measured, at the first of 31 others that can. change: the largest relative change left on
 * the grid chosen; NAN when nothing could be measured. */
ves_status ves_plan_quadrature(const ves_problem *problem, int quadrature[2], double *change, ves_diag *diag);

/* The grid in use (level 1: twice as fine in each direction). */
void ves_plan_grid(const ves_plan *plan, int level, int quadrature[2]);

/* Judges one candidate: objective (negated when the problem maximises), scaled constraints, violation. With
 * VES_WANT_PROOF the candidate is also measured at level 1, must agree within 1 %, and must not cross itself
 * (validity: self_intersection). */
ves_status ves_plan_evaluate(ves_plan *plan, const ves_ask *ask, ves_verdict *verdict);

/* All measures at x, which may be NULL when the problem has no variables (also those that nothing judges),
 * and the rest of the number block: value[measures]. A positive status: as a verdict; the measures are then
 * NAN. */
ves_status ves_plan_measure(ves_plan *plan, const double *x, int level, double *value);

/* After an answer VES_OUTSIDE: a warning "what: ..." about the number that has left the range of its key,
 * with its place in the file. */
void ves_plan_outside(const ves_plan *plan, const char *what, ves_diag *diag);

/* After ves_plan_measure or ves_plan_evaluate: the slots (variables, unknown, parameters), and the similarity
 * factor of scale: */
const double *ves_plan_slots(const ves_plan *plan);
double ves_plan_similarity(const ves_plan *plan);

/* The sides of constraint k after ves_plan_measure or ves_plan_evaluate, in SI units. */
void ves_plan_constraint(const ves_plan *plan, int index, double *left, double *right, double *violation);

/* What a PDE patch is made of; zero for other kinds. tail: at the design last evaluated. */
typedef struct ves_patch_facts {
    int band;  /* modes in the data of its conditions */
    int modes; /* of these solved one by one */
    double
        tail; /* share of the data (root of the sum of squares of each condition, the largest) beyond them */
} ves_patch_facts;
ves_patch_facts ves_plan_patch(const ves_plan *plan, int patch);

/* Exact values at scattered points of one patch, after a measure or evaluate: out[(f * 3 + c) * count + k], f
 * in the order X Xu Xv Xuu Xuv Xvv. Allocates. */
ves_status ves_plan_points(ves_plan *plan, int patch, int count, const double *u, const double *v,
                           double *out);

/* The spine of a PDE patch, after a measure or evaluate: out[(d * 3 + c) * count + k]. VES_ABSENT: that patch
 * has none. */
ves_status ves_plan_spine(ves_plan *plan, int patch, int count, const double *u, double *out);

/* The shape at x on nu x nv cells a patch (0: chosen), for files and pictures. Owned by the caller. */
ves_status ves_plan_figure(ves_plan *plan, const double *x, int nu, int nv, ves_figure **figure,
                           ves_diag *diag);

/* Counters: evaluations, gradients and failed candidates by status so far. */
typedef struct ves_plan_counts {
    long values, gradients, proofs;
    long failed[16]; /* by positive status */
} ves_plan_counts;
const ves_plan_counts *ves_plan_counted(const ves_plan *plan);

#ifdef __cplusplus
}
#endif
#endif

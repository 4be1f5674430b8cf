/* Verdict: what one candidate is worth. One definition for every search, and one order of what it tells: the
 * best so far, the best, the list of optima. (On its way a search also weighs violations within the
 * tolerance, so that of two ends in one place it keeps the one that does not use the tolerance up.) */
#ifndef VESICA_VERDICT_H
#define VESICA_VERDICT_H

#include <stdbool.h>

#include "vesica/status.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    VES_WANT_VALUE = 0,    /* value, constraints, violation */
    VES_WANT_GRADIENT = 1, /* also gradient and jacobian */
    VES_WANT_PROOF = 2 /* also the dear checks that only accepted bests get (self-intersection, finer grid) */
};

/* Feasible: the largest scaled violation is at most this, unless the problem says otherwise. */
#define VES_FEASIBLE 1e-6

/* One question to the evaluator. */
typedef struct ves_ask {
    const double *x; /* [n] candidate */
    int level;       /* how fine: 0 in the loop, 1 with VES_WANT_PROOF: a plan then looks at both */
    double cutoff;   /* stop measuring (VES_CUT) once the violation exceeds this; HUGE_VAL: never */
    unsigned want;   /* VES_WANT_... */
} ves_ask;

/* The answer. The arrays belong to the asker; constraint may be NULL when not wanted, gradient and jacobian
 * too. */
typedef struct ves_verdict {
    ves_status status; /* VES_OK, or positive: the candidate failed and nothing below but violation holds */
    double value;      /* to be minimised */
    double violation;  /* largest scaled violation, >= 0; of a failed candidate HUGE_VAL. A search hands it in
                        * as NAN and, when it is left so, takes the largest of constraint */
    double *constraint; /* [m] scaled excess: an inequality holds when <= 0, an equality when 0 */
    double *gradient;   /* [n] of value */
    double *jacobian;   /* [m][n] of constraint */
} ves_verdict;

/* Feasible candidates come first, by value; then the others by violation. A failed candidate is last.
 * Returns true when a is strictly better than b. */
bool ves_verdict_better(const ves_verdict *a, const ves_verdict *b, double tolerance);

/* The one penalised energy: value + weight * (violation beyond tolerance); HUGE_VAL for a failed
 * candidate. */
double ves_verdict_energy(const ves_verdict *verdict, double weight, double tolerance);

#ifdef __cplusplus
}
#endif
#endif

/* Outcome: what one run of a suite came to. */
#ifndef VES_SUITE_OUTCOME_H
#define VES_SUITE_OUTCOME_H

#include "suite/trial.h"

typedef struct ves_outcome {
    bool done;   /* the rest holds */
    bool failed; /* the method could not be run to the end */
    bool hit;    /* it ended because it met the last target */
    bool any;    /* some candidate could be measured: value, violation, x hold */
    char reason[VES_REASON];
    double spent, budget;
    long evaluations, gradients, failures; /* failures: candidates without a value */
    int starts;                            /* how often the method began */
    double value, violation; /* of the best; violation in units of what is allowed: feasible when <= 1 */
    int n;
    double *x; /* [n] the best, in the unit box */
    int steps;
    ves_step *step;      /* its improvements */
    double wall, inside; /* s: of the run without what is not the method's (ves_trial.aside), and of it in
                            the problem; NAN: not known */
    double cpu;          /* s of its thread's processor; NAN: not known, or the method is another process */
} ves_outcome;

void ves_outcome_clear(ves_outcome *outcome); /* frees what it holds */

/* Can a meter have counted so? To be asked of what comes from a file; x is [n]. */
bool ves_outcome_holds(const ves_outcome *outcome); /* all but the steps */
bool ves_outcome_leads(const ves_outcome *outcome); /* the steps, from better to better, to the best */

/* Cost at which a feasible value up to `value` was first known; INFINITY: never. */
double ves_outcome_reach(const ves_outcome *outcome, double value);

/* The best feasible value known after `cost`; INFINITY: none. */
double ves_outcome_value(const ves_outcome *outcome, double cost);

/* s outside the problem. A machine that has other work too interrupts a run wherever it is: the time of the
 * processor, where it is known, is shared out in the proportion of the clock's. */
double ves_outcome_own(const ves_outcome *outcome);

#endif

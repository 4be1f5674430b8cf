/* Trial: one method on one problem with one seed, until the target is met or the budget is spent. A method
 * that ends earlier begins again at another random point. */
#ifndef VES_SUITE_TRIAL_H
#define VES_SUITE_TRIAL_H

#include "suite/meter.h"
#include "suite/suite.h"

enum { VES_REASON = 300 };

typedef struct ves_trial {
    const ves_method *method;
    ves_meter *meter; /* begun; stands before the problem */
    uint64_t seed;
    bool (*stopped)(void *data); /* asked to end; NULL: never */
    void *data;

    int starts;              /* how often it began */
    double aside;            /* s for what is not the method's: finding starts, programs that begin and end */
    double *start;           /* [n] where it began last */
    bool failed;             /* the method crashed, hung, made no sense or cannot take the problem: */
    char reason[VES_REASON]; /* why; of one that did not fail, what was odd about it, or "" */
} ves_trial;

/* The fields up to data are the caller's. Negative: a fault of ours or of the problem (meter->fault);
 * VES_INTERRUPTED: stopped said so. A failure of the method is VES_OK. */
ves_status ves_trial_run(ves_trial *trial);

/* --- for the three kinds of methods --- */

/* Draws the next point to begin at, in trial->start: one that can be measured, if there is one among many.
 * The same for every method. */
ves_status ves_trial_start(ves_trial *trial);

/* s, of the meter's clock; 0: it has none. */
double ves_trial_clock(const ves_trial *trial);

/* Notes why the method failed (printf format). The first reason holds. */
void ves_trial_fail(ves_trial *trial, const char *format, ...) __attribute__((format(printf, 2, 3)));

ves_status ves_trial_search(ves_trial *trial);
ves_status ves_trial_nlopt(ves_trial *trial);
ves_status ves_trial_program(ves_trial *trial);

/* Is it an algorithm of this NLopt, by NLopt's own name (LN_COBYLA)? needs: it needs one inside. */
bool ves_trial_algorithm(const char *name, bool *needs);
/* Name k of all, or NULL. */
const char *ves_trial_algorithms(int k);

#endif

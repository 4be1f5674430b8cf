/* Meter: stands between a method and a problem and counts. Costs are charged for every answer, whatever the
 * method says of itself; each improvement is written down; at the target or at the end of the budget it
 * answers no more. For one thread. */
#ifndef VES_SUITE_METER_H
#define VES_SUITE_METER_H

#include "base/arena.h"
#include "vesica/search.h"

/* The best so far improved: the first feasible one, or a lower value; before that, a smaller violation. */
typedef struct ves_step {
    double cost; /* spent up to and with this answer */
    double value;
    double violation; /* largest, in units of what is allowed: feasible when <= 1 */
} ves_step;

typedef struct ves_meter {
    const ves_search_problem *inner; /* in the unit box */
    double budget, cost, cost_gradient;
    double inequality, equality; /* what is allowed; 0: the problem's own violation and tolerance */
    double target;               /* value at which it ends; -HUGE_VAL: none */
    double (*clock)(void);       /* s; NULL: none */

    double spent;
    long evaluations, gradients, failed; /* evaluations: those with gradients too */
    bool over, hit;                      /* hit: over because the target is met */
    bool any;                            /* best holds */
    double value, violation;             /* the best; as in a step */
    double *x;                           /* [n] */
    int steps, room;
    ves_step *step;
    double inside;    /* s spent in the problem */
    ves_status fault; /* negative: of the problem, or memory */
    double *last;     /* [n] what was asked last, and whether its slopes were wanted */
    bool asked, sloped;
} ves_meter;

/* The fields up to clock are the caller's. False: out of memory. */
bool ves_meter_begin(ves_meter *meter);
void ves_meter_end(ves_meter *meter); /* frees */

/* The problem as the method sees it: ask through this. VES_INTERRUPTED from evaluate: it is over. A point
 * outside the unit box costs as any other and has no value (VES_OUTSIDE). */
ves_search_problem ves_meter_problem(ves_meter *meter, const double *start);

double ves_meter_left(const ves_meter *meter);

#endif

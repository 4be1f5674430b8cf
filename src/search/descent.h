/* One local descent by NLopt, with its habits hidden: scaled quantities, our own record of the best,
 * candidates that fail, restarts. Belongs to one task of a polish; allocates nothing but what NLopt takes. */
#ifndef VES_SEARCH_DESCENT_H
#define VES_SEARCH_DESCENT_H

#include "search/algorithms.h"
#include "search/session.h"

/* Who sees to a constraint: NLopt, the augmented Lagrangian as an inequality or an equation, or, where it is
 * the other half of an equation written as two inequalities, nobody; a constraint that follows
 * from others is looked at later. */
typedef enum ves_hold {
    VES_HOLD_NLOPT,
    VES_HOLD_BELOW,
    VES_HOLD_EQUAL,
    VES_HOLD_TWIN,
    VES_HOLD_LATER
} ves_hold;

typedef struct ves_descent {
    ves_session *session;
    ves_asker asker;
    const ves_polish *options;
    ves_recipe recipe;
    int inequalities, equalities;
    int *inequality, *equality; /* indices of the constraints that NLopt sees */
    ves_hold *hold;             /* [m] */
    bool wrapped;               /* some constraint is held by the Lagrangian */
    double *row;                /* [m][n + 1] for the choice among equations */
    int choices;                /* how often what was put off was violated in the end */
    bool turned;                /* the next run begins there */
    ves_point aside;            /* that is here */
    bool halfway;               /* the Lagrangian holds all: they contradict each other */
    double *range;              /* [n] upper - lower */

    double step;                /* first step of algorithms without gradients, in the unit box */
    double rival;               /* a descent that will not come below this is given up; HUGE_VAL: none */
    long window, mark;          /* evaluations between two looks at its progress; the last look */
    double marked;              /* value then; HUGE_VAL: not feasible */
    bool hopeless;              /* it was given up */
    int runs;                   /* of the algorithm at most, each from the end of the one before */
    long budget, used, repeats; /* evaluations of this task; questions for the same point in a row */
    nlopt_opt opt;              /* while it runs */
    nlopt_result code;          /* of the last run */
    bool halted;                /* budget or interrupt: NLopt has been told to stop */
    bool spent;                 /* the budget allows no further candidate */
    const char *lost;   /* a sentence: NLopt was stopped because it makes no sense any more; or NULL */
    bool broke, beside; /* a candidate of the last run failed; its last one, or one beside the best */
    double *broken;     /* [n] the last that failed */
    double reach;       /* how far from where it began a run may go, in the unit box */

    double *route; /* [n] NLopt's own x */
    double *u, *x; /* [n] the last candidate */
    ves_verdict last;
    bool asked, sloped; /* last holds a verdict for u; with derivatives */
    double *measured;   /* [m] constraints of the last candidate that did not fail */
    double *shifted;    /* [n] and [m]: candidates of the differences */
    double *shifted_constraint;

    long mended;          /* candidates whose exact slopes were no numbers: differences stand in */
    double *first_mended; /* [n] the first of them, in the caller's units */

    double offset, scale; /* NLopt sees (f - offset) / scale */
    double first_scale;
    double *size; /* [m] and constraint / size: so NLopt sees all alike, whatever their units */
    double
        *price; /* [m] of f for a unit of violation within the tolerance: more than any multiplier is likely
                      to be */
    double lowest, highest; /* of what NLopt was told, but for failures */
    double *multiplier;     /* [m] of an augmented Lagrangian; its penalty; 0: none runs */
    double penalty;
    double *from;   /* [n] where its round began */
    double shrink;  /* what NLopt sees is divided by this: L is steep far from the constraints */
    ves_point best; /* our own record */
} ves_descent;

/* False when out of memory. */
bool ves_descent_create(ves_descent *descent, ves_session *session, int member, const ves_polish *options,
                        long budget);
void ves_descent_destroy(ves_descent *descent);

/* From start to end. Returns a fault or VES_INTERRUPTED; end holds in any case. */
ves_status ves_descent_run(ves_descent *descent, const ves_point *start, ves_point *end);

/* Why it ended: had it no evaluations left; is its end one, as far as it knows; a sentence. */
bool ves_descent_spent(const ves_descent *descent);
ves_halt ves_descent_halt(const ves_descent *descent);
const char *ves_descent_sentence(const ves_descent *descent);

/* Judges u (unit box), once; the answer is in descent->last. A candidate that fails is last.status > 0.
 * VES_INTERRUPTED also when the budget is spent; VES_NO_NUMBER for a u that is none: nothing was asked. */
ves_status ves_descent_look(ves_descent *descent, const double *u, bool slopes);

/* quick.c: how descents go that only have to tell where they lead. slopes: by exact gradients. */
ves_polish ves_descent_quick(const ves_session *session, bool slopes);

/* Evaluations that one quick descent may take: it has arrived long before, or is lost. */
long ves_descent_usual(int n, bool slopes);

/* The steepest slope of the value at what was last looked at, across the box; 0 without slopes. */
double ves_descent_steepest(const ves_descent *descent);

/* quick.c: walks off a start that is steeper than everything else; is it worth going on? */
ves_status ves_descent_relax(ves_descent *descent, ves_point *point);
bool ves_descent_hopeless(ves_descent *descent);

/* The steepest slope of constraint j at what was last looked at with slopes, across the box. */
double ves_descent_slope(const ves_descent *descent, int j);

/* Copies what was last judged into a point. */
void ves_descent_keep(const ves_descent *descent, ves_point *point);

/* One run of NLopt from descent->route, and to there; tolerances times factor, first step for those without
 * gradients. */
ves_status ves_descent_minimise(ves_descent *descent, double step, double factor);

/* rows.c: puts off (VES_HOLD_LATER) those of the constraints that NLopt sees which depend, where the descent
 * has just looked, on equations that it keeps. Is one of them violated where it has just looked? */
void ves_rows_choose(ves_descent *descent);
bool ves_rows_owing(const ves_descent *descent);

/* lagrange.c: an augmented Lagrangian for the constraints that the algorithm does not take. */
ves_status ves_lagrange_run(ves_descent *descent, double step);
double ves_lagrange_value(const ves_descent *descent);
double ves_lagrange_slope(const ves_descent *descent, int i);

#endif

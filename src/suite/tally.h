/* Tally: what the runs of a suite add up to. */
#ifndef VES_SUITE_TALLY_H
#define VES_SUITE_TALLY_H

#include "suite/outcome.h"
#include "suite/statistics.h"

/* The runs, and what is known of the problems. */
typedef struct ves_tally_input {
    const ves_suite *suite;
    const ves_outcome *outcome; /* [ves_suite_runs]; those that are not done are left out */
    const double *optimum;      /* [problems]; NAN: not known */
    const double *polished; /* [problems] what a polish of the best run came to, its constraints met exactly;
                                   NAN: nothing; NULL: no polish */
    const int *n;           /* [problems] variables */
} ves_tally_input;

/* What gaps are measured from. */
typedef struct ves_reference {
    double value;     /* NAN: no run was feasible */
    bool known;       /* else the best of all runs: */
    int method, seed; /* by whom */
    bool polished;    /* ... and then a polish of that one, or a run that met its constraints as exactly */
    double below;     /* known: a value clearly below it, so that it cannot be the least; NAN: none */
} ves_reference;

/* One method on one problem. */
typedef struct ves_score {
    int runs, failed;
    const char *reason; /* of the first that failed; or of a run that did not, what was odd; NULL */
    int hits[VES_TARGETS];
    ves_interval share[VES_TARGETS], ert[VES_TARGETS]; /* ert in cost units */
    ves_interval seconds;     /* the ert of the last target, with the wall time of each run in proportion */
    double quartile[3], best; /* of the final feasible values; INFINITY: infeasible */
    int feasible;
    double worst; /* largest final violation, in units of what is allowed; NAN: none measured */
    double own;   /* s outside the problem, for each evaluation; NAN: not known */
} ves_score;

/* One method on all problems. */
typedef struct ves_total {
    int runs, failed, feasible;
    int hits[VES_TARGETS];
    ves_interval share[VES_TARGETS];
    double own;
} ves_total;

/* Two methods on all problems. By runs, paired by problem and seed: whether they differ on these problems. By
 * problems, of the means of their runs: whether they would on others of the kind; runs of one problem tell nothing
 * about the next. A method that failed in all its runs is compared with none: all is NAN. */
typedef struct ves_pair {
    double effect;     /* chance that a run of the first is better: the mean over the problems; NAN: none */
    double lead;       /* of the signed ranks, ves_paired: which of them has more; > 0: the first */
    double p;          /* of the runs, that there is no difference; corrected for all pairs */
    double by_problem; /* of the problems; NAN: fewer than VES_TALLY_PROBLEMS */
    double least;      /* the least p that so many runs could show, corrected */
} ves_pair;

enum { VES_TALLY_PROBLEMS = 6 }; /* fewer cannot show p < 0.05: 2^-5 = 0.06 */
#define VES_TALLY_LEVEL 0.05

typedef enum ves_finding {
    VES_FINDING_NONE,  /* no runs in common, or a method that failed in all */
    VES_FINDING_FEW,   /* too few runs to show anything */
    VES_FINDING_SAME,  /* no difference shown */
    VES_FINDING_MIXED, /* a difference, but effect and ranks disagree on who is better */
    VES_FINDING_FIRST, /* the first is better */
    VES_FINDING_SECOND
} ves_finding;

typedef struct ves_tally {
    ves_arena arena;
    const ves_suite *suite;
    ves_reference *reference; /* [problems] */
    ves_score *score;         /* [methods][problems] */
    ves_total *total;         /* [methods] */
    ves_pair *pair;           /* [methods][methods]; first against second */
} ves_tally;

/* False: out of memory. */
bool ves_tally_init(const ves_tally_input *input, ves_tally *tally);
void ves_tally_destroy(ves_tally *tally);

/* What gaps of a problem are measured from. */
ves_reference ves_tally_reference(const ves_tally_input *input, int problem);

/* What a pair says at the level of 5 %. */
ves_finding ves_tally_finding(const ves_pair *pair);

/* How dear a run was, for comparisons: the mean over the targets of log10 of the cost until each was met; one
 * that was not counts ten budgets. */
double ves_tally_dearness(const ves_suite *suite, const ves_suite_problem *problem,
                          const ves_outcome *outcome, double reference);

/* The value of a run that counts: feasible, at its end. INFINITY: none. */
double ves_tally_value(const ves_outcome *outcome);

#endif

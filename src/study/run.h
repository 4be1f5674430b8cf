/* Run: everything that one search produced, and the folder that keeps it.
 *
 * ves_run_create is the whole way from a problem to its best design: the quadrature is chosen once, one plan
 * is made for each job, the search runs, and the best is measured again on a grid twice as fine. A problem
 * without variables is measured once. */
#ifndef VES_STUDY_RUN_H
#define VES_STUDY_RUN_H

#include "study/design.h"
#include "vesica/run.h"

typedef struct ves_run_optimum {
    double *x; /* [variables] */
    double value, violation;
    int hits;
    bool saddle;
} ves_run_optimum;

typedef struct ves_run_expect {
    const char *text;
    bool passed;
} ves_run_expect;

enum { VES_RUN_KINDS = 16, VES_RUN_NAME = 16 };

typedef struct ves_run_stage {
    char name[VES_RUN_NAME];
    double wall; /* s */
    long evaluations;
} ves_run_stage;

/* Clock data: never in result.json. */
typedef struct ves_run_times {
    char started[32]; /* UTC, ISO 8601 */
    double wall, cpu; /* s, of everything */
    double search;    /* s, wall, of the search alone */
    int threads;      /* of the machine */
    int stages;
    ves_run_stage stage[VES_STAGES];
} ves_run_times;

struct ves_run {
    ves_arena arena;
    const ves_problem *problem;
    bool searched;    /* false: measured once */
    bool interrupted; /* stopped by the hook: the best so far */
    uint64_t seed;
    int jobs;
    int quadrature[2];
    double change;                 /* relative, that the choice of the quadrature left; NAN: it was given */
    const bool *idle;              /* [variables] nothing that is judged depends on it (idle.h) */
    bool any;                      /* some design could be measured: best holds */
    bool feasible;                 /* ... and proved */
    ves_status proof;              /* of a design measured once: why it did not pass its checks, or VES_OK */
    ves_design start, best, finer; /* finer: best on a grid twice as fine */
    double finer_change;
    long evaluations, gradients;
    const char *stop;
    int optima;
    ves_run_optimum *optimum;
    int notes;
    const char **note;
    int expects;
    ves_run_expect *expect;
    bool passed;                /* every expect held */
    long failed[VES_RUN_KINDS]; /* candidates that could not be measured, by status */
    int temperatures;
    ves_temperature *temperature;
    ves_run_times times;
    char *folder; /* NULL: none */
};

/* The grid that a study would use; change is NAN when the problem gives it. */
ves_status ves_study_quadrature(const ves_problem *problem, int quadrature[2], double *change,
                                ves_diag *diag);

/* A plan on that grid, with its messages. */
ves_status ves_study_plan(const ves_problem *problem, const int quadrature[2], ves_plan **plan,
                          ves_diag *diag);

/* Whether a search of this problem has exact gradients: every measure that is judged has one. */
bool ves_study_gradients(const ves_problem *problem);

/* Seconds of a clock that only goes forward. */
double ves_study_clock(void);

#endif

/* Suite: a benchmark as it is written down: problems x methods x seeds, and what a run may cost. Read by
 * ves_suite_read (problem/suite.h), run by the study. */
#ifndef VES_SUITE_SUITE_H
#define VES_SUITE_SUITE_H

#include <stdint.h>

#include "base/arena.h"
#include "suite/landscape.h"
#include "vesica/problem.h"
#include "vesica/search.h"

enum { VES_TARGETS = 3, VES_SUITE_WORDS = 32 };

typedef enum ves_suite_kind { VES_SUITE_LANDSCAPE, VES_SUITE_FILE, VES_SUITE_PLUGIN } ves_suite_kind;

/* A problem of a suite. */
typedef struct ves_suite_problem {
    ves_suite_kind kind;
    ves_mark mark;
    const char *name;               /* of its own: "rot_rastrigin 10" */
    const ves_landscape *landscape; /* LANDSCAPE */
    int n;
    bool turned;
    const char *path; /* FILE, PLUGIN: from where vesica was called */
    int sets;         /* FILE */
    const ves_override *set;
    const char *objective; /* PLUGIN: which of those in it */
    double optimum;        /* given; NAN: the landscape's, or not known */
} ves_suite_problem;

typedef enum ves_method_kind { VES_METHOD_SEARCH, VES_METHOD_NLOPT, VES_METHOD_PROGRAM } ves_method_kind;

/* A method of a suite. */
typedef struct ves_method {
    ves_method_kind kind;
    ves_mark mark;
    const char *name;
    bool values;               /* is not given gradients */
    ves_search_options search; /* SEARCH; 0 stages: auto */
    bool doubling;             /* SEARCH: 1, 2, 4 and 8 parts of 15 of the budget, not all at once */
    const char *algorithm;     /* NLOPT: as NLopt writes it, GN_ISRES */
    const char *local;         /* NLOPT: for those that need one inside, or NULL */
    const char *word[VES_SUITE_WORDS + 1]; /* PROGRAM: ends with NULL */
    double seconds;                        /* PROGRAM: the longest wait for a line */
} ves_method;

typedef struct ves_suite {
    ves_arena arena;
    const char *path, *name, *title; /* name: the file's without folder and ending */
    const char *text;                /* as run */
    int problems, methods;
    const ves_suite_problem *problem;
    const ves_method *method;
    int seeds;                   /* runs of each method on each problem; run k has instance k */
    uint64_t seed;               /* what all of them come from */
    double per_dimension, most;  /* budget: the lesser of per_dimension * n and most, in cost units */
    double cost, cost_gradient;  /* of an evaluation with all constraints; with gradients too */
    double target[VES_TARGETS];  /* gaps over max(1, |reference|), falling; a run ends at the last */
    double inequality, equality; /* what a constraint may be violated by */
} ves_suite;

void ves_suite_destroy(ves_suite *suite); /* NULL: nothing */

double ves_suite_budget(const ves_suite *suite, int n);

/* The value that meets a target: reference + gap max(1, |reference|); of a problem file, whose values have
 * units, reference + gap |reference|. */
double ves_suite_value(const ves_suite_problem *problem, double reference, double gap);

/* The runs in their order: methods, then problems, then seeds, so that a method that is added comes last. */
typedef struct ves_suite_place {
    int method, problem, seed;
} ves_suite_place;
int ves_suite_runs(const ves_suite *suite);
ves_suite_place ves_suite_run(const ves_suite *suite, int index);

/* What the random numbers of a run come from: the problem and the run's number alone, so that all methods
 * begin at the same points. */
uint64_t ves_suite_seed(const ves_suite *suite, const ves_suite_problem *problem, int seed);

#endif

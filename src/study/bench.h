/* Bench: a suite run, in a folder that can be gone on with.
 *
 *     suite.yaml, problems/   the suite and its problem files as run
 *     bench.json      where it was, which vesica ran it, and checksums of what it rests on
 *     runs.jsonl      one line a run, as they end; in the end in the order of the suite (of another rank of
 *                     mpirun runs.RANK.jsonl, until the end)
 *     times.jsonl     what clocks say of each        report.json  what they come to
 *     ecdf.png, profile-*.png, convergence/PROBLEM.png, optima/PROBLEM.png (of problem files)
 *     journals/NNNNN.jsonl   the improvements of run NNNNN: [cost, value, violation] */
#ifndef VES_STUDY_BENCH_H
#define VES_STUDY_BENCH_H

#include "suite/tally.h"
#include "vesica/diag.h"
#include "vesica/objective.h"
#include "vesica/run.h"

typedef struct ves_bench ves_bench;

typedef struct ves_bench_hooks {
    void (*begun)(void *data, const ves_bench *bench);              /* before the first run */
    void (*progress)(void *data, const ves_bench *bench, int done); /* after each, one call at a time */
    bool (*stopped)(void *data);                                    /* from any thread */
    /* Loads an objective of a plugin (name NULL: its first); who fails has told why. It must outlive the bench. */
    ves_status (*load)(void *data, const char *path, const char *name, const ves_objective **objective);
    void *data;
} ves_bench_hooks;

typedef struct ves_bench_options {
    int jobs;        /* 0: all threads of the machine */
    const char *out; /* this folder, new or empty; NULL: runs/NAME-NNNN */
    bool no_files;
    const ves_team *team; /* processes that share out the runs, the first has the folder; NULL: alone */
} ves_bench_options;

/* What a problem of the suite turned out to be. */
typedef struct ves_bench_problem {
    int n, m, equalities;
    const char *eliminated; /* "scale", "solve", "scale, solve": equations that every candidate meets; "" */
    const char *picture;    /* its name in convergence/ and optima/: PICTURE.png */
    bool gradients;
    bool maximize;                    /* values here are those of the negative goal */
    double optimum;                   /* NAN: not known */
    double seconds, seconds_gradient; /* of one evaluation, measured; NAN: not */
} ves_bench_problem;

/* A distinct end of a problem of files or plugins: where runs ended, converged or not. */
typedef struct ves_bench_optimum {
    int problem, run; /* run: the best that ended there */
    double value;
    int *hits; /* [methods] runs of each method that ended there */
} ves_bench_optimum;

struct ves_bench {
    ves_suite *suite;
    const char *folder; /* NULL: none */
    int jobs, runs, done;
    int before;           /* of them done by earlier processes */
    ves_outcome *outcome; /* [runs] */
    const ves_bench_problem *problem;
    double wall; /* s, of this process */
    ves_tally tally;
    int optima;
    ves_bench_optimum *optimum; /* the distinct ends, problem by problem, best first */
};

/* Takes the suite over, also when it fails. *bench is not NULL where runs were made, also after
 * VES_INTERRUPTED and when a file could not be written; of a team only for the first. All of a team call with the
 * same suite and options, and end with the same status, unless one is out of memory. */
ves_status ves_bench_run(ves_suite *suite, const ves_bench_options *options, const ves_bench_hooks *hooks,
                         ves_bench **bench, ves_diag *diag);

/* Goes on in a folder, from where it was left. added: no override, or one named methods.NAME: one more
 * method. */
ves_status ves_bench_resume(const char *folder, const ves_read_options *added,
                            const ves_bench_options *options, const ves_bench_hooks *hooks, ves_bench **bench,
                            ves_diag *diag);

void ves_bench_destroy(ves_bench *bench);

#endif

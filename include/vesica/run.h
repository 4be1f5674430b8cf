/* Run: from a problem to its best design and the folder that keeps it, as `vesica run` does: the grid is
 * chosen at the start design, the search of the file runs on `jobs` threads, and the best is measured again
 * on a grid twice as fine. When that changes it by more than 1e-6, the grid is chosen once more, at the best,
 * and the last polish of the search is repeated there on it, from all the optima and with what is left of the
 * budget; a note tells it, or, where the file gives the grid, asks for no polish, or no budget is left, what
 * grid to give. A problem without variables is measured once.
 *
 * Numbers have the sign and the units of the file (SI, angles in radians; in a file without units: its own).
 * The same seed gives the same result for any number of jobs. Several runs may go on at once, in threads of
 * their own; a diag belongs to one of them. */
#ifndef VESICA_RUN_H
#define VESICA_RUN_H

#include <stdint.h>

#include "vesica/plan.h"
#include "vesica/problem.h"
#include "vesica/search.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Which candidates trace.jsonl keeps. SHORT: each new best, and of the accepted ones ever fewer: each of the
 * first 2500, then every second until 2500 more stand there, then every fourth, and so on. */
typedef enum ves_trace { VES_TRACE_SHORT, VES_TRACE_ALL, VES_TRACE_ACCEPTED, VES_TRACE_NONE } ves_trace;

/* Processes that go through the same run and share out its search, as MPI starts them; see ves_search_hooks.
 * Problem and options are the same on all; rank 0 alone has files, and what it meets there ends all. `tell` gives
 * all ranks the bytes of rank 0. A rank that ends with an error must end the others. */
typedef struct ves_team {
    int rank, ranks;
    ves_status (*exchange)(void *data, const void *mine, size_t size, const void **all, size_t *total);
    ves_status (*tell)(void *data, void *bytes, size_t size);
    void *data;
} ves_team;

/* All zeros: what the file says, on all threads of the machine, and no files. */
typedef struct ves_run_options {
    bool seeded; /* seed holds; else the problem's */
    uint64_t seed;
    long evaluations;   /* budget of the search, 0: the problem's */
    int jobs;           /* threads, 0: as many as the machine has */
    bool test;          /* what `test:` says replaces budget, stages and expect */
    bool once;          /* no search and no `expect`: the start is measured */
    bool prove;         /* with `once`: and checked as the best of a search is */
    bool files;         /* make a run folder */
    const char *parent; /* of numbered run folders, NULL: "runs" */
    const char *out;    /* exactly this folder instead: new, or empty */
    const char *name;   /* of numbered run folders, NULL: the problem's */
    ves_trace trace;
    bool forget; /* keep no journal: such a run cannot be resumed */

    /* Go on with the run in the folder `out`, with the same problem and options (but for jobs) that it was begun
     * with, and end as if it had never been interrupted. One that is done is only gone through again. */
    bool resume;
    const ves_team *team; /* NULL: alone */

    /* Stages instead of those of the file, with its seed; NULL: those of the file. Without files only: a folder
     * does not keep them. */
    const ves_search_options *search;
} ves_run_options;

/* One line under `expect:`. */
typedef struct ves_run_expect {
    const char *text; /* as written */
    bool passed;
} ves_run_expect;

/* How many candidates could not be measured for one reason. */
typedef struct ves_run_failure {
    ves_status status;
    long count;
} ves_run_failure;

/* Clock data: all that may differ between two runs of one seed. */
enum { VES_RUN_NAME = 16 };
typedef struct ves_run_times {
    char started[32]; /* UTC, ISO 8601 */
    double wall, cpu; /* s, of everything */
    double search;    /* s, wall, of the search alone */
    int threads;      /* of the machine */
    int stages;
    struct {
        char name[VES_RUN_NAME];
        double wall; /* s */
        long evaluations;
    } stage[VES_STAGES];
} ves_run_times;

/* Everything that one run produced; it owns all that it points to but the problem. */
typedef struct ves_run {
    const ves_problem *problem; /* the one given, which must outlive the run */

    /* Known when the search begins. */
    bool searched; /* false: measured once */
    uint64_t seed;
    int jobs, quadrature[2]; /* nodes a patch; of the result when it is there */
    double change;           /* relative, that the choice of the quadrature left; NAN: it was given */
    ves_design start;
    const bool *idle;   /* [variables] no effect seen on what is judged; NULL: nobody looked */
    const char *folder; /* NULL: none */
    bool journaled;     /* it has a journal there */
    long recalled;      /* evaluations that the journal of a resumed run knows; -1: it was not resumed */
    bool over;          /* it was resumed, but is done: nothing is asked, no file is written */

    /* The result. */
    bool any;               /* some design could be measured: best holds */
    bool feasible;          /* ... and it meets its constraints and is proved: on a finer grid, uncrossed */
    ves_status proof;       /* of a design measured once: why it did not pass its checks, or VES_OK */
    ves_design best, finer; /* finer: best on a grid twice as fine */
    double finer_change;    /* largest relative difference of the two */
    int joints;             /* of the best, as ves_plan_joint tells them; 0: none, or it cannot be measured */
    const ves_joint *joint;
    int optima;                 /* distinct ends of the search */
    const ves_optimum *optimum; /* best first; value with the sign of the file, violation as in a design */
    const int *optimum_kind;    /* [optima] as in a design */
    ves_ending ending;
    const char *stop; /* a sentence: why the search ended */
    int notes;
    const char *const *note; /* sentences: what failed a check, saddles left, budget too short ... */
    long evaluations, gradients;
    long refused; /* of the evaluations: proofs that a best did not pass */
    int failures;
    const ves_run_failure *failure; /* by status, those that happened */
    int expects;
    const ves_run_expect *expect;
    bool passed; /* every expect held */
    int temperatures;
    const ves_temperature *temperature;
    int annealings;
    const ves_annealing_report *annealing;
    int strategies;
    const ves_strategy_report *strategy;
    ves_evidence evidence; /* sentence: NULL when nothing was searched */
    ves_kkt
        kkt; /* of best; here multiplier[k] is what the best objective changes by, per unit, when something is
                    added to the limit of constraint k (ves_sides), bound[k] when the bound that holds variable k is
                    moved up, both in the sign and units of the file; slope is that of a verdict */
    ves_run_times times;
} ves_run;

/* Called from the thread that called ves_run_create, but `stopped` from any. Values have the sign of the
 * file, violations are those of designs. */
typedef struct ves_run_hooks {
    void (*begun)(void *data,
                  const ves_run *run); /* all is ready, the search begins: run has no result yet */
    void (*progress)(void *data, const ves_progress *progress);
    bool (*stopped)(void *data); /* true: end cleanly with the best so far */
    void *data;
} ves_run_hooks;

/* options, hooks, diag: NULL for none. diag gets warnings and errors. VES_OK: see ending, feasible, passed.
 * VES_RANGE: a negative number among the options, a budget beyond 2^53, an unknown trace, or `search` with files.
 * VES_IO or VES_MEMORY with a result: it holds, but its folder could not be filled. VES_USAGE, VES_IO without
 * a result: its folder cannot be made, or another process works in it; nothing was searched. VES_STALE: the
 * journal in a folder to go on with is of another run or another version. Whenever there is no result, *run is NULL.
 * Destroy a run before its problem. */
ves_status ves_run_create(const ves_problem *problem, const ves_run_options *options,
                          const ves_run_hooks *hooks, ves_run **run, ves_diag *diag);
void ves_run_destroy(ves_run *run); /* NULL: nothing */

#ifdef __cplusplus
}
#endif
#endif

/* Run: from a problem to its best design and the folder that keeps it, as `vesica run` does. */
#ifndef VESICA_RUN_H
#define VESICA_RUN_H

#include <stdint.h>

#include "vesica/problem.h"
#include "vesica/search.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct ves_run ves_run;

/* Which candidates trace.jsonl keeps. SHORT: each new best, and of the accepted ones ever fewer: each of the
 * first 2500, then every second until 2500 more stand there, then every fourth, and so on. */
typedef enum ves_trace { VES_TRACE_SHORT, VES_TRACE_ALL, VES_TRACE_ACCEPTED, VES_TRACE_NONE } ves_trace;

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
} ves_run_options;

/* Called from the thread that runs the study, but `stopped` from any. Values have the sign of the file. */
typedef struct ves_run_hooks {
    void (*begun)(void *data, const ves_run *run); /* all is ready, the search begins */
    void (*progress)(void *data, const ves_progress *progress);
    bool (*stopped)(void *data);
    void *data;
} ves_run_hooks;

/* diag gets warnings and errors. VES_OK: see interrupted, feasible, passed. VES_IO or VES_MEMORY with a
 * result: it holds, but its folder could not be made or filled. VES_USAGE, VES_IO without a result: `out`
 * cannot be used; nothing was searched. Whenever there is no result, *run is NULL. */
ves_status ves_run_create(const ves_problem *problem, const ves_run_options *options,
                          const ves_run_hooks *hooks, ves_run **run, ves_diag *diag);
void ves_run_destroy(ves_run *run);

/* The best design, or NULL when no design could be measured: x[variables], and in the arguments that are not
 * NULL its objective with the sign of the file, its largest violation, its measures[measures]. Owned by the
 * run. */
const double *ves_run_best(const ves_run *run, double *objective, double *violation, const double **measures);
bool ves_run_feasible(const ves_run *run);    /* and proved on a finer grid, without crossing itself */
bool ves_run_passed(const ves_run *run);      /* every `expect` of the file held */
const char *ves_run_stop(const ves_run *run); /* a sentence: why it ended */
int ves_run_notes(const ves_run *run);        /* sentences: what failed a check, what was left out and why */
const char *ves_run_note(const ves_run *run, int index);
const char *ves_run_folder(const ves_run *run); /* NULL: none */

#ifdef __cplusplus
}
#endif
#endif

/* A run while it goes on: what its parts share. */
#ifndef VES_STUDY_INSIDE_H
#define VES_STUDY_INSIDE_H

#include "study/journal.h"
#include "study/lock.h"
#include "study/run.h"
#include "study/team.h"
#include "study/trace.h"

enum { VES_FAILURES = 64, VES_SENTENCE = 200 };

/* A grid that changes a measure by more than this is worth a word. */
static const double VES_UNSETTLED = 1e-6;

typedef struct ves_study {
    const ves_problem *problem;
    const ves_run_options *options;
    const ves_run_hooks *hooks;
    ves_diag *diag;
    ves_run *run;
    ves_arena *arena; /* of the run */
    ves_plan **plan;  /* [run->jobs] */
    ves_search_options search;
    ves_tracer tracer;
    ves_lock lock; /* of the run folder */
    ves_journal journal;
    bool recalls;              /* the journal of rank 0 may know answers */
    unsigned char *told_block; /* on the other ranks */
    size_t told_room;
    bool told;              /* that the journal cannot be written */
    double wall, cpu, mark; /* clocks: the beginning; the stage's beginning */
    int stage;
    int stages_before; /* of searches that are over, and their evaluations */
    long evaluations_before;
    long left;        /* of the budget */
    ves_verdict seen; /* the best that the search has told, and its violation as in a design */
    double seen_violation;
    long failed[VES_FAILURES]; /* candidates that could not be measured, by status */
    ves_status files;          /* the first file that could not be written */
    const double *from;        /* [variables] where the search at hand began */
} ves_study;

/* run.c. A sentence of what the result says of itself. */
ves_status ves_study_note(ves_study *study, const char *text);

/* One design, kept in the arena of the run. */
ves_status ves_study_measure(ves_study *study, const double *x, int level, ves_design *design);

/* As many as jobs; the others share the grid of the first, which speaks for all. */
ves_status ves_study_plans(ves_study *study, const ves_plan_options *options, ves_plan **plan,
                           ves_diag *diag);
void ves_study_plans_destroy(ves_plan **plan, int count);

/* search.c. One search, whose result becomes that of the run. from: where to begin, the first of `count`
 * points; NULL: at the start of the file. */
ves_status ves_study_search(ves_study *study, const ves_search_options *options, const double *const *from,
                            int count);
bool ves_study_stopped(ves_study *study); /* on all ranks alike */

/* A warning when the journal cannot be written any more. */
void ves_study_journal_tell(ves_study *study);

#endif

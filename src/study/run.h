/* The run from inside: its memory, and what the command line shares. */
#ifndef VES_STUDY_RUN_H
#define VES_STUDY_RUN_H

#include "study/design.h"
#include "vesica/run.h"

/* What ves_run_create makes: first what the caller holds. */
typedef struct ves_run_box {
    ves_run run;
    ves_arena arena;
} ves_run_box;

/* Seconds of a clock that only goes forward. */
double ves_study_clock(void);

/* Seconds that the processor has worked for this thread. */
double ves_study_thread_clock(void);

#endif

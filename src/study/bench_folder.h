/* The folder of a benchmark: lines that are written once and read back when it is gone on with. */
#ifndef VES_STUDY_BENCH_FOLDER_H
#define VES_STUDY_BENCH_FOLDER_H

#include <stdio.h>

#include "study/bench.h"
#include "study/lock.h"

/* Open files of a folder in use. */
typedef struct ves_bench_files {
    const char *folder;
    FILE *runs, *times;
    ves_lock lock;
    ves_diag *diag;
} ves_bench_files;

/* Takes a folder for this process alone: the first of all calls. It and the arena must outlive the files. */
ves_status ves_bench_files_take(ves_bench_files *files, const char *folder, ves_arena *arena, ves_diag *diag);
/* Makes what a new folder begins with. */
ves_status ves_bench_files_begin(ves_bench_files *files, const ves_suite *suite);
/* Opens those of a folder, whose first `runs` runs hold; what is behind them is cut off. */
ves_status ves_bench_files_again(ves_bench_files *files, const ves_suite *suite, ves_outcome *outcome,
                                 int *runs);
/* Closes them and lets the folder go. */
ves_status ves_bench_files_end(ves_bench_files *files);

/* The journal of a run; from any thread. The status is for the lines. */
ves_status ves_bench_journal_write(const char *folder, int index, const ves_outcome *outcome);

/* The lines of run `index`, in order. */
ves_status ves_bench_line_write(ves_bench_files *files, const ves_suite *suite, int index,
                                const ves_outcome *outcome);

/* What the runs came to: report.json. */
ves_status ves_bench_report_write(const ves_bench *bench, ves_diag *diag);

/* Rewrites suite.yaml and bench.json, when something was added. */
ves_status ves_bench_suite_write(const char *folder, const ves_suite *suite, ves_diag *diag);
/* What a folder says of its suite: where it was, its text, and its methods in the order of the runs. */
typedef struct ves_bench_about {
    const char *path;
    char *text;
    size_t length;
    int methods;
    const char **method;
} ves_bench_about;
ves_status ves_bench_about_read(const char *folder, ves_arena *arena, ves_bench_about *about, ves_diag *diag);

#endif

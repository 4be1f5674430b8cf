/* The folder of a benchmark: lines that are written as runs end, read back when it is gone on with, and put in
 * order at the end. */
#ifndef VES_STUDY_BENCH_FOLDER_H
#define VES_STUDY_BENCH_FOLDER_H

#include <stdio.h>

#include "study/bench.h"
#include "study/lock.h"

/* Open files of a folder in use. */
typedef struct ves_bench_files {
    const char *folder;
    int rank; /* of the processes that mpirun has started: others than 0 write to runs.RANK.jsonl */
    FILE *runs, *times;
    bool written; /* lines, since they were in order */
    ves_lock lock;
    ves_diag *diag;
} ves_bench_files;

/* Takes a folder for this process alone: the first of all calls. It and the arena must outlive the files. */
ves_status ves_bench_files_take(ves_bench_files *files, const char *folder, ves_arena *arena, ves_diag *diag);
/* Makes what a new folder begins with. */
ves_status ves_bench_files_begin(ves_bench_files *files);
/* Opens those of a folder, and reads the runs that hold into bench->outcome. bench->problem is known. What is damaged is
 * told, and done again. */
ves_status ves_bench_files_again(ves_bench_files *files, const ves_bench *bench);
/* Another rank joins the one that has the folder; in the end that one reads what the others have written. */
ves_status ves_bench_files_join(ves_bench_files *files, const char *folder, int rank, ves_diag *diag);
ves_status ves_bench_files_gather(ves_bench_files *files, const ves_bench *bench);
/* Puts the lines of the runs that are done in order, closes the files and lets the folder go. */
ves_status ves_bench_files_end(ves_bench_files *files, const ves_bench *bench);

/* The journal of a run, and then its lines. One call at a time. */
ves_status ves_bench_journal_write(const ves_bench_files *files, int index, const ves_outcome *outcome);
ves_status ves_bench_line_write(ves_bench_files *files, const ves_suite *suite, int index,
                                const ves_outcome *outcome);

/* What the runs came to: report.json. */
ves_status ves_bench_report_write(const ves_bench *bench, ves_diag *diag);

#endif

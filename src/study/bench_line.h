/* What a run of a benchmark came to as lines of its folder, and back. What is read back is what a meter may have
 * counted, or it is refused: whoever goes on from it may rely on it. */
#ifndef VES_STUDY_BENCH_LINE_H
#define VES_STUDY_BENCH_LINE_H

#include <stdio.h>

#include "problem/tree.h"
#include "suite/tally.h"

/* Lines of runs.jsonl and times.jsonl, and a journal. */
void ves_bench_run_write(const ves_suite *suite, int index, const ves_outcome *outcome, FILE *out);
void ves_bench_times_write(int index, const ves_outcome *outcome, FILE *out);
void ves_bench_steps_write(const ves_outcome *outcome, FILE *out);

/* The run that a line of runs.jsonl is about; -1: none of this suite. line: NULL is none either. */
int ves_bench_run_of(const ves_node *line, const ves_suite *suite);

/* Fills all but done, the steps and the times; n: variables of the problem. False: it does not hold; the caller
 * clears the outcome. */
bool ves_bench_run_read(const ves_node *line, int n, double budget, ves_outcome *outcome);

/* Fills the steps of what ves_bench_run_read has read. False: damaged, or of another run. */
bool ves_bench_steps_read(const char *text, size_t length, ves_outcome *outcome);

/* Fills the times of outcome[runs], where that is done. False: damaged. */
bool ves_bench_times_read(const ves_node *line, int runs, ves_outcome *outcome);

#endif

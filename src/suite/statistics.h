/* Statistics of runs: pure functions. Less is better; INFINITY is a run that never got there. */
#ifndef VES_SUITE_STATISTICS_H
#define VES_SUITE_STATISTICS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct ves_interval {
    double value, low, high; /* 95 % */
} ves_interval;

/* Share of hits among n runs, with the interval of [Wilson 1927]. n 0: NAN. */
ves_interval ves_statistics_share(int hits, int n);

/* Expected running time, sum of spent over hits [Hansen et al., COCO; Price 1997]: of each run what it spent
 * until it hit or, hit[k] false, until it ended. INFINITY without a hit. The interval: 2.5 and 97.5 % of 1000
 * bootstrap samples of the runs (drawn by counters from the seed; a sample without a hit is INFINITY). */
ves_interval ves_statistics_ert(const double *spent, const bool *hit, int n, uint64_t seed);

/* Sorts ascending; NAN last. */
void ves_statistics_sort(double *x, int n);

/* Of ascending x, between the two nearest by parts (Hyndman and Fan 1996, type 7); next to INFINITY:
 * INFINITY. */
double ves_statistics_quantile(const double *x, int n, double p);

/* Chance that a run of x is less than one of y, ties half: the effect size A12 [Vargha and Delaney 2000] */
double ves_statistics_effect(const double *x, int nx, const double *y, int ny);

/* [Wilcoxon 1945], paired: differences that are 0 say nothing; exact (all signs of the midranks) up to 600
 * pairs. x[k] and y[k] may both be INFINITY: no difference. */
typedef struct ves_paired {
    double p; /* two-sided; NAN: out of memory */
    double
        lead; /* rank sum of the pairs in which x is less, minus the other, over the sum of all: -1 ... 1 */
} ves_paired;
ves_paired ves_statistics_paired(const double *x, const double *y, int n);

/* The least two-sided p that n pairs could show. */
double ves_statistics_least(int n);

/* Step-down correction of count tests at once [Holm 1979], in place; NAN (no test) is left out. */
void ves_statistics_holm(double *p, int count);

#endif

/* CMA-ES: one run of the (mu/mu_w, lambda) evolution strategy with covariance matrix adaptation, as a state
 * machine that only makes points and takes values (Hansen 2016, arXiv 1604.00772, "the tutorial").
 *
 *     ves_cma_create(&arena, n, most, &options, &cma);
 *     ves_cma_restart(&cma, mean, sigma, lambda);
 *     do {
 *         for (int k = 0; k < lambda; k++) ves_cma_ask(&cma, k, NULL, u), value[k] = f(u);
 *         ves_cma_tell(&cma, value);
 *     } while (!ves_cma_stopped(&cma));
 *
 * The box: the objective is continued beyond the unit box by reflection at its walls (even, period 2), and the
 * distribution lives in R^n, so that no candidate is ever moved onto a wall. Where the mean leaves the box it is
 * reflected back, and the distribution with it: no candidate of the box changes by that. A minimum near a wall
 * competes with its own image beyond; so candidates are ranked lower the farther beyond the walls they were drawn.
 *
 * Candidate k of a generation depends on (seed, stream, generation, k) and on the values told before. Only ranks
 * of values steer the run; the values themselves are looked at by the stop criteria alone. */
#ifndef VES_SEARCH_CMA_H
#define VES_SEARCH_CMA_H

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"

/* X(name, sentence): why a run is over. The tutorial's B.3, but for FAILED and HOPELESS. */
#define VES_CMA_STOP_LIST(X)                                                                                 \
    X(RUNNING, "the run goes on")                                                                            \
    X(FAILED, "none of the candidates of the last generations could be measured")                            \
    X(CONDITION, "the covariance matrix is too ill-conditioned for double precision")                        \
    X(NO_AXIS, "a step along a principal axis no longer changes the mean")                                   \
    X(NO_COORDINATE, "a step along a coordinate no longer changes the mean")                                 \
    X(TOL_X, "the steps have become as small as was asked")                                                  \
    X(TOL_FUN, "the values of the last generations differ by no more than was asked")                        \
    X(TOL_UP, "the distribution has grown far beyond the box")                                               \
    X(STAGNATION, "neither the best nor the median value has improved for long")                             \
    X(HOPELESS, "what is still gained is little against what the best of an earlier run is ahead")

typedef enum ves_cma_stop {
#define VES_CMA_STOP_ENUM(name, sentence) VES_CMA_##name,
    VES_CMA_STOP_LIST(VES_CMA_STOP_ENUM)
#undef VES_CMA_STOP_ENUM
} ves_cma_stop;

typedef struct ves_cma_options {
    uint64_t seed;
    uint32_t stream; /* runs with different streams draw different numbers */
    double tol_x;    /* TOL_X: standard deviations below this part of the first ones */
    double tol_fun;  /* TOL_FUN: values within this part of the spread of the first generation */
    double hopeless; /* HOPELESS: gains below this part of the distance to the rival; 0: never */
} ves_cma_options;

ves_cma_options ves_cma_default(void);

enum { VES_CMA_RING = 4096 }; /* generations that the stop criteria remember */

/* What follows from n and lambda: the tutorial's Table 1. */
typedef struct ves_cma_rates {
    int mu;        /* candidates of positive weight */
    double mu_eff; /* 1 / sum of their squared weights */
    double c_sigma, d_sigma, c_c, c_1, c_mu;
    double normal; /* E |N(0, I)| */
    double gap;    /* generations between two decompositions */
} ves_cma_rates;

typedef struct ves_cma {
    ves_cma_options options;
    int n, most, lambda;
    ves_cma_rates rates;
    double *weight; /* [lambda] by rank: the first mu sum to 1, the others are negative */
    double rival;   /* the best value of earlier runs; HUGE_VAL: none. The caller's to set, after restart */
    uint64_t generation; /* since create: no two runs draw the same numbers */
    long age;            /* generations of this run */
    /* the distribution: mean + sigma N(0, C), C = basis' diag(axis^2) basis */
    double *mean, sigma, *covariance; /* C [n][n], lower triangle */
    double *basis, *axis;        /* [n][n] one axis a row, and their lengths [n]; lag behind C by the gap */
    double *path_sigma, *path_c; /* [n] */
    long decomposed;             /* age of the basis */
    bool broken;                 /* C has lost its positive eigenvalues */
    /* of the generation: steps and squared lengths before they are stretched, by candidate; ranks */
    double *step, *square; /* [lambda][n], [lambda] */
    double *told, *score;  /* [lambda] */
    int *order, *merged;   /* [lambda] candidates, best first; scratch */
    double *used;          /* [lambda] weights as used, by rank */
    double *scratch;       /* [3 n n] */
    /* what the stop criteria remember, by age modulo the size of the ring */
    double *best, *median, *sorted; /* [VES_CMA_RING] twice; scratch */
    double least, worst;            /* least value of the run; worst finite one of the last generation */
    double spread; /* of the first generation that was measured, from best to median; 0: all were equal */
    double first_sigma;
    int failed; /* generations in a row that could not be measured at all */
} ves_cma;

/* The tutorial's default, 4 + floor(3 ln n). */
int ves_cma_population(int n);

/* For n >= 1 variables and populations from 2 to most <= 2^20. False when out of memory. */
bool ves_cma_create(ves_arena *arena, int n, int most, const ves_cma_options *options, ves_cma *cma);

/* Begins a run: mean [n], sigma > 0 (in parts of the box), 2 <= lambda <= most. */
void ves_cma_restart(ves_cma *cma, const double *mean, double sigma, int lambda);

/* Candidate k < lambda of this generation: raw [n] as drawn, u [n] the same in the unit box; either may be NULL.
 * Different k may be asked at the same time by different threads. */
void ves_cma_ask(ves_cma *cma, int k, double *raw, double *u);

/* Ends the generation: value [lambda] of all candidates, each of which has been asked. HUGE_VAL or NaN: could not
 * be measured. Such a candidate never counts for its direction, and a generation of them changes nothing. */
void ves_cma_tell(ves_cma *cma, const double *value);

/* Reflects a mean that lies beyond the walls into the box; so are, in each coordinate past an odd number of walls,
 * the directions that the run remembers (rows and columns of C, axes, paths). The candidates stay the same. */
void ves_cma_fold(ves_cma *cma);

ves_cma_stop ves_cma_stopped(const ves_cma *cma);
const char *ves_cma_stop_text(ves_cma_stop stop);

#endif

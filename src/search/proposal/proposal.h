/* Proposals: how a chain makes its next candidate. One file each; the file's name is the descriptor's, and the
 * word in problem files. */
#ifndef VES_SEARCH_PROPOSAL_H
#define VES_SEARCH_PROPOSAL_H

#include <stdbool.h>

#include "base/random.h"

typedef struct ves_proposal ves_proposal;

/* One part of a mixture. */
typedef struct ves_share {
    const ves_proposal *proposal;
    double share; /* of the trials; those of a mixture sum to 1 */
} ves_share;

/* Every proposal here is symmetric (u -> v as likely as v -> u, reflection at the walls included), so that
 * Metropolis acceptance needs no Hastings ratio; `log_ratio` is for those that are not. What a proposal adapts
 * or learns depends on where the chain has been: a chain that samples calls neither `adapt` nor `learn`.
 * State: plain doubles. */
struct ves_proposal {
    const char *name, *about;
    int (*room)(int n); /* doubles of state; NULL: none */
    void (*init)(int n, double step, double *state);
    /* u holds the current point on entry and the candidate on return; both in the unit box. heat: temperature
     * over the first one, at most 1. */
    void (*propose)(int n, double *state, double heat, ves_random *random, double *u);
    void (*adapt)(int n, double *state, bool accepted);       /* after each trial of its own; NULL: nothing */
    void (*learn)(int n, double *state, const double *u);     /* where the chain stands; NULL: nothing */
    double (*log_ratio)(int n, const double *state);          /* log q(v -> u) / q(u -> v); NULL: 0 */
    double (*width)(int n, double heat, const double *state); /* of a typical step along one coordinate, now;
                                                                 NULL: none */
    const ves_share *share; /* of a mixture, which has nothing else: ends with proposal == NULL */
};

#endif

/* Proposals: how a chain makes its next candidate. One file each; the file's name is the descriptor's. */
#ifndef VES_SEARCH_PROPOSAL_H
#define VES_SEARCH_PROPOSAL_H

#include <stdbool.h>

#include "base/random.h"

/* Every proposal here is symmetric (u -> v as likely as v -> u, reflection at the walls included), so that
 * Metropolis acceptance needs no Hastings ratio; `log_ratio` is for those that are not. State: plain doubles,
 * so that a chain can be saved. */
typedef struct ves_proposal {
    const char *name, *about;
    int (*room)(int n); /* doubles of state */
    void (*init)(int n, double step, double *state);
    /* u holds the current point on entry and the candidate on return; both in the unit box. */
    void (*propose)(int n, double *state, ves_random *random, double *u);
    void (*adapt)(int n, double *state, bool accepted); /* after each trial; NULL: nothing to adapt */
    double (*log_ratio)(int n, const double *state);    /* log q(v -> u) / q(u -> v); NULL: 0 */
} ves_proposal;

extern const ves_proposal ves_proposal_gaussian, ves_proposal_heavy;

#endif

/* A Metropolis chain: a state machine that makes one trial at a time. All it knows is in this struct and the
 * arrays it points to; its random numbers are counters (seed, chain, step, draw). */
#ifndef VES_SEARCH_CHAIN_H
#define VES_SEARCH_CHAIN_H

#include "search/proposal/proposal.h"
#include "search/session.h"

enum { VES_MOVES = 2 }; /* proposals that are mixed */

typedef struct ves_move {
    const ves_proposal *proposal;
    double share;  /* of the trials */
    double *state; /* [proposal->room(n)] */
    long trials, accepted;
} ves_move;

typedef struct ves_chain {
    ves_asker asker;
    ves_random random;
    bool adapt;
    bool cut;        /* may stop measuring candidates that are surely rejected */
    double weight;   /* penalty per unit of violation */
    double heaviest; /* the weight grows up to this while the best is infeasible */
    double margin;   /* how far below the lowest value seen one may still lie, for the cutoff */
    double lowest;   /* value seen */
    double energy;   /* of current */
    ves_point current, candidate, best;
    ves_point home; /* where a refused chain goes back to */
    int moves;
    ves_move move[VES_MOVES];
    /* statistics of one temperature */
    long trials, accepted;
    double mean, square; /* of the energy: running mean and sum of squares (Welford) */
} ves_chain;

/* False when out of memory. */
bool ves_chain_init(ves_chain *chain, ves_session *session, int index, const ves_anneal *options);

/* Puts the chain at a measured point; NULL: at its own best. */
void ves_chain_place(ves_chain *chain, const ves_point *point);

/* One draw of the warm-up: into candidate, and into best when it is. */
ves_status ves_chain_explore(ves_chain *chain, const ves_point *start);

/* One trial at temperature c. */
ves_status ves_chain_step(ves_chain *chain, double c);

/* Ends a temperature: the penalty grows while the best is infeasible. */
void ves_chain_settle(ves_chain *chain);

/* After its best has been refused. */
void ves_chain_return(ves_chain *chain);

/* Where the chain ends: its best or, when that is the dearer one, where it stands. */
const ves_point *ves_chain_end(const ves_chain *chain);

#endif

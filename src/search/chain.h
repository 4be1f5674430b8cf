/* A Metropolis chain: a state machine that makes one trial at a time. All it knows is in this struct and the
 * arrays it points to; its random numbers are counters (seed, chain, step, draw). */
#ifndef VES_SEARCH_CHAIN_H
#define VES_SEARCH_CHAIN_H

#include "search/constraint/constraint.h"
#include "search/proposal/proposal.h"
#include "search/session.h"

enum { VES_CHAIN_DRAWS = 8 }; /* at most, of a new place to begin at */

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
    bool cut;      /* may stop measuring candidates that are surely rejected */
    double margin; /* how far below the lowest value seen one may still lie, for the cutoff */
    double lowest; /* value seen */
    double energy; /* of current */
    const ves_constraint *constraint;
    ves_burden burden;
    ves_point current, candidate, best; /* best: of the leg */
    ves_point home;                     /* where a refused chain goes back to */
    int moves;
    ves_move move[VES_MOVES];
    long learn;   /* every so many trials the proposals learn where the chain is */
    double step0; /* first step width */
    /* statistics of one temperature */
    long trials, accepted;
    double mean, square; /* of the energy: running mean and sum of squares (Welford) */
} ves_chain;

/* What all chains of an annealing are made with. */
typedef struct ves_chain_make {
    const ves_proposal *proposal;
    const ves_constraint *constraint;
    double step;
    uint32_t stream; /* its random numbers' first chain */
    bool cut;
} ves_chain_make;

/* False when out of memory. */
bool ves_chain_init(ves_chain *chain, ves_session *session, int index, const ves_chain_make *make);

/* Puts the chain at a measured point; NULL: at its own best. */
void ves_chain_place(ves_chain *chain, const ves_point *point);

/* One draw of the warm-up: into candidate, and into best when it is. */
ves_status ves_chain_explore(ves_chain *chain, const ves_point *start);

/* A new leg: from a random point that can be measured, if a few draws find one; else from where it is. What was
 * adapted is forgotten. */
ves_status ves_chain_restart(ves_chain *chain);

/* One trial at temperature c, which is heat times the first one. */
ves_status ves_chain_step(ves_chain *chain, double c, double heat);

/* Ends a temperature: the burden of the constraints, and the statistics, anew. */
void ves_chain_settle(ves_chain *chain, bool feasible, double heat);
void ves_chain_share(ves_chain *chain, const ves_chain *other); /* takes over the burden of another */

/* Two chains with the same burden exchange where they are. */
void ves_chain_exchange(ves_chain *a, ves_chain *b);

/* After its best has been refused. */
void ves_chain_return(ves_chain *chain);

/* Where the leg ends: its best or, when that is the dearer one, where the chain stands. */
const ves_point *ves_chain_end(const ves_chain *chain);

#endif

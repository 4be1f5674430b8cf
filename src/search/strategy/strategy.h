/* Strategies: ways to search that can be paused after any round and gone on with later. One file each; the
 * file's name is the descriptor's. A portfolio shares a budget out among them. */
#ifndef VES_SEARCH_STRATEGY_H
#define VES_SEARCH_STRATEGY_H

#include "search/archive.h"

/* What strategies that work together know of each other. */
typedef struct ves_team {
    ves_session *session;
    ves_archive archive;
    ves_archive
        blind; /* ends of descents from points drawn uniformly from the box alone: independent of all else */
    ves_point best; /* of all; failed while there is none */
    long bests;     /* how many there were */
    double weight;  /* penalty per unit of violation, for those that need one number */
} ves_team;

/* What decides which strategies lead. */
typedef enum ves_ground {
    VES_GROUND_VALUES,       /* no constraints and no gradients */
    VES_GROUND_GRADIENTS,    /* no constraints */
    VES_GROUND_INEQUALITIES, /* no equations */
    VES_GROUND_EQUATIONS,    /* thin feasible sets, where only descents find their way */
    VES_GROUNDS
} ves_ground;

typedef struct ves_strategy {
    const char *name, *about;
    double share[VES_GROUNDS]; /* of the evaluations at first, to those of others; 0: not there */
    bool saves; /* there only where nobody gave a budget: what it finds may show that enough is spent */
    /* Its random numbers are those of chains stream, stream + 1 ... stream + 255. NULL: out of memory. */
    void *(*create)(ves_team *team, uint32_t stream);
    long (*least)(const void *state); /* evaluations that its next round needs */
    /* Goes on by whole rounds until about `some` more evaluations were made, and never more than `most`. */
    ves_status (*advance)(void *state, long some, long most);
    void (*refused)(void *state); /* its last best did not pass the proof; NULL: it does not mind */
    void (*destroy)(void *state); /* what is not in the arena; NULL: nothing */
} ves_strategy;

/* Takes a measured point that may be the team's best. Returns whether it is. */
bool ves_team_take(ves_team *team, const ves_point *point);

#endif

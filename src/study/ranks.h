/* Ranks: the processes that mpirun has started together. Each runs the same command; they share out the search. */
#ifndef VES_STUDY_RANKS_H
#define VES_STUDY_RANKS_H

#include "vesica/run.h"

typedef struct ves_ranks {
    ves_team team;
    unsigned char *all; /* what all have said last */
    size_t room;
    bool begun;
} ves_ranks;

/* How many there are, and which this one is, as mpirun tells it in the environment; 1 and 0: none was used. */
int ves_ranks_asked(int *rank);

/* The version of the MPI standard that this build has, "none" without. */
const char *ves_ranks_mpi(void);

/* Meets the others; once in a process. VES_ABSENT: this build has no MPI. */
ves_status ves_ranks_begin(ves_ranks *ranks, ves_diag *diag);

/* Waits for the others, or, when something went wrong here, ends them too. */
void ves_ranks_end(ves_ranks *ranks, bool clean);

/* mpi.c, which is only built with -DVESICA_MPI=ON. */
ves_status ves_mpi_begin(ves_ranks *ranks);
const char *ves_mpi_version(void);
void ves_mpi_end(ves_ranks *ranks, bool clean);

#endif

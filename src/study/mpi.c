#include <limits.h>
#include <mpi.h>

#include "base/arena.h"
#include "study/ranks.h"

/* Messages are rows of eight bytes, so that a count of MPI reaches to 16 GB. */
enum { UNIT = 8, RANKS_MOST = 4096 };

#define TEXT(word)            #word
#define VERSION(major, minor) TEXT(major) "." TEXT(minor)

const char *ves_mpi_version(void)
{
    return VERSION(MPI_VERSION, MPI_SUBVERSION);
}

static ves_status exchange(void *data, const void *mine, size_t size, const void **all, size_t *total)
{
    ves_ranks *r = data;
    int ranks = r->team.ranks, count = (int)(size / UNIT), each[RANKS_MOST], at[RANKS_MOST];
    if (size % UNIT || size / UNIT > INT_MAX) return VES_FAULT;
    if (MPI_Allgather(&count, 1, MPI_INT, each, 1, MPI_INT, MPI_COMM_WORLD)) return VES_FAULT;
    size_t sum = 0;
    for (int k = 0; k < ranks; k++) {
        at[k] = (int)sum;
        sum += (size_t)each[k];
    }
    if (sum > INT_MAX) return VES_FAULT;
    if (sum * UNIT > r->room) {
        unsigned char *room = ves_memory_grow(r->all, sum * UNIT);
        if (!room) return VES_MEMORY;
        r->all = room;
        r->room = sum * UNIT;
    }
    if (MPI_Allgatherv(mine, count, MPI_UINT64_T, r->all, each, at, MPI_UINT64_T, MPI_COMM_WORLD))
        return VES_FAULT;
    *all = r->all;
    *total = sum * UNIT;
    return VES_OK;
}

static ves_status tell(void *data, void *bytes, size_t size)
{
    (void)data;
    if (size > INT_MAX) return VES_FAULT;
    return MPI_Bcast(bytes, (int)size, MPI_BYTE, 0, MPI_COMM_WORLD) ? VES_FAULT : VES_OK;
}

ves_status ves_mpi_begin(ves_ranks *r)
{
    int given;
    if (MPI_Init_thread(NULL, NULL, MPI_THREAD_FUNNELED, &given) || given < MPI_THREAD_FUNNELED)
        return VES_FAULT;
    r->team = (ves_team){.exchange = exchange, .tell = tell, .data = r};
    MPI_Comm_rank(MPI_COMM_WORLD, &r->team.rank);
    MPI_Comm_size(MPI_COMM_WORLD, &r->team.ranks);
    r->begun = true;
    return r->team.ranks <= RANKS_MOST ? VES_OK : VES_RANGE;
}

void ves_mpi_end(ves_ranks *r, bool clean)
{
    (void)r;
    if (clean)
        MPI_Finalize();
    else
        MPI_Abort(MPI_COMM_WORLD, 4);
}

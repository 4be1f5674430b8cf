#include "study/ranks.h"

#include <stdlib.h>

#include "base/arena.h"
#include "base/diag.h"

/* Open MPI's mpirun, and those that follow PMI (MPICH, Slurm's srun). */
static int number(const char *a, const char *b, int otherwise)
{
    const char *text = getenv(a);
    if (!text) text = getenv(b);
    return text && *text ? atoi(text) : otherwise;
}

int ves_ranks_asked(int *rank)
{
    int ranks = number("OMPI_COMM_WORLD_SIZE", "PMI_SIZE", 1);
    *rank = ranks > 1 ? number("OMPI_COMM_WORLD_RANK", "PMI_RANK", 0) : 0;
    return ranks > 1 ? ranks : 1;
}

const char *ves_ranks_mpi(void)
{
#ifdef VESICA_MPI
    return ves_mpi_version();
#else
    return "none";
#endif
}

ves_status ves_ranks_begin(ves_ranks *ranks, ves_diag *diag)
{
    *ranks = (ves_ranks){0};
#ifdef VESICA_MPI
    ves_status status = ves_mpi_begin(ranks);
    return status == VES_OK ? VES_OK : ves_diag_fail(diag, status);
#else
    int rank;
    return ves_diag_add(
        diag, VES_ERROR, VES_ABSENT, (ves_mark){0},
        "this is one of %d processes that mpirun has started, but this build of vesica has no MPI: "
        "build with -DVESICA_MPI=ON (VESICA_MPI=ON ./vesica ...), or run it alone with --jobs",
        ves_ranks_asked(&rank));
#endif
}

void ves_ranks_end(ves_ranks *ranks, bool clean)
{
#ifdef VESICA_MPI
    if (ranks->begun) ves_mpi_end(ranks, clean);
#else
    (void)clean;
#endif
    ves_memory_free(ranks->all);
    *ranks = (ves_ranks){0};
}

#include "study/team.h"

#include <limits.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "base/diag.h"

bool ves_team_leads(const ves_team *team)
{
    return !team || team->rank == 0;
}

ves_status ves_team_follow(const ves_team *team, ves_status status)
{
    int32_t said = (int32_t)status;
    if (team) VES_TRY(team->tell(team->data, &said, sizeof said));
    return (ves_status)said;
}

ves_status ves_team_meet(const ves_team *team, ves_status status)
{
    int64_t mine = status, said;
    const void *all;
    size_t total;
    if (!team) return status;
    VES_TRY(team->exchange(team->data, &mine, sizeof mine, &all, &total));
    status = VES_OK;
    for (size_t k = 0; k < total / sizeof said; k++) {
        memcpy(&said, (const char *)all + k * sizeof said, sizeof said);
        if (said && (status == VES_OK || status == VES_INTERRUPTED)) status = (ves_status)said;
    }
    return status;
}

ves_status ves_team_path(const ves_team *team, const char **path, ves_arena *arena, ves_diag *diag)
{
    char text[PATH_MAX] = "";
    if (!team) return VES_OK;
    if (team->rank == 0) snprintf(text, sizeof text, "%s", *path);
    VES_TRY(team->tell(team->data, text, sizeof text));
    if (team->rank == 0) return VES_OK;
    *path = ves_arena_text(arena, text, strlen(text));
    return *path ? VES_OK : ves_diag_fail(diag, VES_MEMORY);
}

static int bounded(long count)
{
    return count < 1 ? 1 : count > VES_JOBS_MOST ? VES_JOBS_MOST : (int)count;
}

int ves_machine_threads(void)
{
    return bounded(sysconf(_SC_NPROCESSORS_ONLN));
}

int ves_team_jobs(const ves_team *team, int asked)
{
    return asked > 0 ? bounded(asked) : team ? 1 : ves_machine_threads();
}

/* Teams: what processes that go through the same work say to each other, and how many threads each has. team NULL: one
 * process alone. */
#ifndef VES_STUDY_TEAM_H
#define VES_STUDY_TEAM_H

#include "base/arena.h"
#include "vesica/diag.h"
#include "vesica/run.h"

enum { VES_JOBS_MOST = 256 };

bool ves_team_leads(const ves_team *team); /* is this rank 0, or the only one */

/* What rank 0 met. */
ves_status ves_team_follow(const ves_team *team, ves_status status);

/* Waits for all. What they met: the first that is neither VES_OK nor an interruption, else that. */
ves_status ves_team_meet(const ves_team *team, ves_status status);

/* Gives all the path of rank 0: the others a copy in their arena. */
ves_status ves_team_path(const ves_team *team, const char **path, ves_arena *arena, ves_diag *diag);

/* Threads: as many as asked for; 0: 1 of each rank, alone as many as the machine has. */
int ves_team_jobs(const ves_team *team, int asked);
int ves_machine_threads(void);

#endif

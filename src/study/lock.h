/* Lock: one process at a time works in a run folder. The file `lock` holds its number, and goes with it; what a
 * killed process leaves locks nothing. */
#ifndef VES_STUDY_LOCK_H
#define VES_STUDY_LOCK_H

#include "base/arena.h"
#include "vesica/diag.h"

typedef struct ves_lock {
    int fd; /* -1: none */
    const char *path;
} ves_lock;

/* VES_USAGE: another process has it, or this one in another run. Where the file system cannot lock it is taken with a
 * warning. */
ves_status ves_lock_take(ves_lock *lock, const char *folder, ves_arena *arena, ves_diag *diag);
void ves_lock_drop(ves_lock *lock);

/* Processes that help the one who has the lock (file `helpers`): they may outlive it for a moment. Who takes the folder
 * next sees whether they are gone: VES_USAGE: not yet. */
ves_status ves_lock_help(ves_lock *lock, const char *folder, ves_arena *arena, ves_diag *diag);
ves_status ves_lock_alone(const char *folder, ves_arena *arena, ves_diag *diag);

#endif

#include "study/lock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/diag.h"
#include "study/folder.h"

enum { TRIES = 100, NUMBER = 32 };

static ves_status refuse(int fd, const char *folder, ves_diag *diag)
{
    char who[NUMBER] = "";
    ssize_t length = pread(fd, who, sizeof who - 1, 0);
    who[length < 0 ? 0 : length] = 0;
    who[strcspn(who, "\n")] = 0;
    return ves_diag_add(diag, VES_ERROR, VES_USAGE, (ves_mark){0},
                        "process %s works in \"%s\": wait until it is done, or end it", *who ? who : "?",
                        folder);
}

/* Some network file systems know no locks, or their server does not answer. A work that nobody else goes on with needs
 * none; so it goes on, but not silently. */
static void warn(const char *folder, int error, ves_diag *diag)
{
    ves_diag_add(
        diag, VES_WARNING, VES_IO, (ves_mark){0},
        "\"%s\" cannot be locked: %s. See to it that no other process works in it meanwhile, or take a "
        "folder on a local disk",
        folder, strerror(error));
}

/* Is the file still the one that the name stands for? Who had it may have removed it meanwhile. */
static bool is_there(int fd, const char *path)
{
    struct stat ours, there;
    return fstat(fd, &ours) == 0 && stat(path, &there) == 0 && ours.st_ino == there.st_ino &&
           ours.st_dev == there.st_dev;
}

static void sign(int fd)
{
    char who[NUMBER];
    int length = snprintf(who, sizeof who, "%ld\n", (long)getpid());
    if (ftruncate(fd, 0) == 0 && pwrite(fd, who, (size_t)length, 0) < 0) errno = 0; /* nobody needs it */
}

ves_status ves_lock_take(ves_lock *lock, const char *folder, ves_arena *arena, ves_diag *diag)
{
    *lock = (ves_lock){-1, ves_folder_path(folder, "lock", arena)};
    if (!lock->path) return ves_diag_fail(diag, VES_MEMORY);
    for (int attempt = 0; attempt < TRIES; attempt++) {
        int fd = open(lock->path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (fd < 0)
            return ves_diag_add(diag, VES_ERROR, VES_IO, (ves_mark){0}, "cannot write \"%s\": %s", lock->path,
                                strerror(errno));
        int error = flock(fd, LOCK_EX | LOCK_NB) ? errno : 0;
        if (error == EWOULDBLOCK) {
            ves_status status = refuse(fd, folder, diag);
            close(fd);
            return status;
        }
        if (is_there(fd, lock->path)) {
            if (error) warn(folder, error, diag);
            sign(fd);
            lock->fd = fd;
            return VES_OK;
        }
        close(fd);
    }
    return ves_diag_add(diag, VES_ERROR, VES_IO, (ves_mark){0}, "cannot lock \"%s\"", lock->path);
}

void ves_lock_drop(ves_lock *lock)
{
    if (lock->fd < 0) return;
    if (is_there(lock->fd, lock->path)) unlink(lock->path);
    close(lock->fd);
    lock->fd = -1;
}

static int helpers_open(ves_lock *lock, const char *folder, ves_arena *arena, ves_diag *diag)
{
    *lock = (ves_lock){-1, ves_folder_path(folder, "helpers", arena)};
    if (!lock->path) {
        ves_diag_fail(diag, VES_MEMORY);
        return -1;
    }
    int fd = open(lock->path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (fd < 0)
        ves_diag_add(diag, VES_ERROR, VES_IO, (ves_mark){0}, "cannot write \"%s\": %s", lock->path,
                     strerror(errno));
    return fd;
}

ves_status ves_lock_help(ves_lock *lock, const char *folder, ves_arena *arena, ves_diag *diag)
{
    int fd = helpers_open(lock, folder, arena, diag);
    if (fd < 0) return lock->path ? VES_IO : VES_MEMORY;
    lock->fd = fd;
    if (!flock(fd, LOCK_SH | LOCK_NB) || errno != EWOULDBLOCK) return VES_OK;
    return refuse(fd, folder, diag);
}

/* The file goes when nobody needs it any more. */
ves_status ves_lock_alone(const char *folder, ves_arena *arena, ves_diag *diag)
{
    ves_lock lock;
    int fd = helpers_open(&lock, folder, arena, diag);
    if (fd < 0) return lock.path ? VES_IO : VES_MEMORY;
    ves_status status = VES_OK;
    if (flock(fd, LOCK_EX | LOCK_NB) && errno == EWOULDBLOCK)
        status = refuse(fd, folder, diag);
    else
        unlink(lock.path);
    close(fd);
    return status;
}

#include "output/file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/diag.h"

enum { TRIES = 1000 };

ves_status ves_file_complain(const char *path, int error, ves_diag *diag)
{
    return ves_diag_add(diag, VES_ERROR, VES_IO, (ves_mark){0}, "cannot write \"%s\": %s", path,
                        strerror(error ? error : EIO));
}

static ves_status out_of_memory(ves_diag *diag)
{
    return ves_diag_fail(diag, VES_MEMORY);
}

/* FOLDER/.NAME.vesica-PID-TRY.ENDING, which no file of a user's is called (ves_folder_tidy). */
static void temporary_name(char *name, size_t size, const char *path, int attempt, const char *ending)
{
    const char *slash = strrchr(path, '/');
    int folder = slash ? (int)(slash + 1 - path) : 0;
    snprintf(name, size, "%.*s.%s.vesica-%ld-%d.%s", folder, path, path + folder, (long)getpid(), attempt,
             ending);
}

/* Opens a new file beside path; -1 with errno on failure. */
static int temporary_open(char *name, size_t size, const char *path, const char *ending)
{
    int fd = -1;
    for (int attempt = 0; fd < 0 && attempt < TRIES; attempt++) {
        temporary_name(name, size, path, attempt, ending);
        fd = open(name, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (fd < 0 && errno != EEXIST) break;
    }
    return fd;
}

static ves_status begin_beside(ves_file *file, const char *ending, ves_diag *diag)
{
    size_t size = strlen(file->path) + strlen(ending) + 56;
    file->temporary = ves_memory_take(size);
    if (!file->temporary) return out_of_memory(diag);
    int fd = temporary_open(file->temporary, size, file->path, ending);
    file->out = fd < 0 ? NULL : fdopen(fd, "wb");
    if (file->out) return VES_OK;
    ves_status status = ves_file_complain(file->path, errno, diag);
    if (fd >= 0) close(fd), unlink(file->temporary);
    ves_memory_free(file->temporary);
    file->temporary = NULL;
    return status;
}

ves_status ves_file_begin(ves_file *file, const char *path, const char *ending, ves_diag *diag)
{
    struct stat there;
    *file = (ves_file){.path = path};
    bool exists = stat(path, &there) == 0;
    if (exists && S_ISDIR(there.st_mode)) return ves_file_complain(path, EISDIR, diag);
    if (!exists || S_ISREG(there.st_mode)) return begin_beside(file, ending, diag);
    file->out = fopen(path, "wb");
    return file->out ? VES_OK : ves_file_complain(path, errno, diag);
}

ves_status ves_file_end(ves_file *file, ves_status status, ves_diag *diag)
{
    int error = errno; /* of the write that failed, when one did */
    bool failed = ferror(file->out) != 0;
    if (fclose(file->out) && !failed) failed = true, error = errno;
    if (status == VES_OK && failed) status = ves_file_complain(file->path, error, diag);
    if (file->temporary && status == VES_OK && rename(file->temporary, file->path))
        status = ves_file_complain(file->path, errno, diag);
    if (file->temporary && status != VES_OK) unlink(file->temporary);
    ves_memory_free(file->temporary);
    *file = (ves_file){0};
    return status;
}

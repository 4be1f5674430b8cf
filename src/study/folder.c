#include "study/folder.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/diag.h"

enum { NUMBERS = 1000000 };

static ves_status refuse(const char *path, ves_diag *diag)
{
    return ves_diag_add(diag, VES_ERROR, VES_IO, (ves_mark){0}, "cannot make the folder \"%s\": %s", path,
                        strerror(errno));
}

bool ves_folder_is(const char *path)
{
    struct stat there;
    return stat(path, &there) == 0 && S_ISDIR(there.st_mode);
}

/* Every folder above the last one, and that one too when `last`. Another process may make them meanwhile. */
static ves_status make_above(const char *path, bool last, ves_arena *arena, ves_diag *diag)
{
    char *part = ves_arena_text(arena, path, strlen(path));
    if (!part) return ves_diag_fail(diag, VES_MEMORY);
    for (char *slash = strchr(part + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        if (mkdir(part, 0777) && errno != EEXIST && !ves_folder_is(part)) return refuse(part, diag);
        *slash = '/';
    }
    if (last && mkdir(part, 0777) && !(errno == EEXIST && ves_folder_is(part))) return refuse(part, diag);
    return VES_OK;
}

ves_status ves_folder_open(const char *path, ves_arena *arena, ves_diag *diag)
{
    return make_above(path, true, arena, diag);
}

/* The number of an entry NAME-NNNN, else 0. */
static long number_of(const char *entry, const char *name)
{
    size_t length = strlen(name);
    if (strncmp(entry, name, length) || entry[length] != '-') return 0;
    const char *digits = entry + length + 1;
    size_t count = strspn(digits, "0123456789");
    if (!count || count > 6 || digits[count]) return 0;
    return strtol(digits, NULL, 10);
}

static long highest(const char *parent, const char *name)
{
    long most = 0;
    DIR *folder = opendir(parent);
    if (!folder) return 0;
    for (struct dirent *entry; (entry = readdir(folder));) {
        long number = number_of(entry->d_name, name);
        if (number > most) most = number;
    }
    closedir(folder);
    return most;
}

ves_status ves_folder_number(const char *parent, const char *name, ves_arena *arena, char **folder,
                             ves_diag *diag)
{
    *folder = NULL;
    VES_TRY(ves_folder_open(parent, arena, diag));
    for (long number = highest(parent, name) + 1; number < NUMBERS; number++) {
        char *path = ves_arena_format(arena, "%s/%s-%04ld", parent, name, number);
        if (!path) return ves_diag_fail(diag, VES_MEMORY);
        if (mkdir(path, 0777) == 0) {
            *folder = path;
            return VES_OK;
        }
        if (errno != EEXIST) return refuse(path, diag);
    }
    return ves_diag_add(diag, VES_ERROR, VES_IO, (ves_mark){0}, "\"%s\" holds %d runs of \"%s\" already",
                        parent, NUMBERS - 1, name);
}

static bool is_empty(const char *path)
{
    DIR *folder = opendir(path);
    bool empty = folder;
    for (struct dirent *entry; folder && (entry = readdir(folder));)
        if (strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..")) empty = false;
    if (folder) closedir(folder);
    return empty;
}

ves_status ves_folder_make(const char *path, ves_arena *arena, char **folder, ves_diag *diag)
{
    *folder = NULL;
    VES_TRY(make_above(path, false, arena, diag));
    if (mkdir(path, 0777) && errno != EEXIST) return refuse(path, diag);
    if (!ves_folder_is(path))
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, (ves_mark){0}, "\"%s\" is a file, not a folder",
                            path);
    if (!is_empty(path))
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, (ves_mark){0},
                            "the folder \"%s\" is not empty: nothing is overwritten, choose another one",
                            path);
    *folder = ves_arena_text(arena, path, strlen(path));
    return *folder ? VES_OK : ves_diag_fail(diag, VES_MEMORY);
}

char *ves_folder_path(const char *folder, const char *name, ves_arena *arena)
{
    size_t length = strlen(folder);
    return ves_arena_format(arena, length && folder[length - 1] == '/' ? "%s%s" : "%s/%s", folder, name);
}

static bool is_among(const char *const *list, int count, const char *text)
{
    for (int k = 0; k < count; k++)
        if (list[k] && strcmp(list[k], text) == 0) return true;
    return false;
}

/* Where it is one of those that are taken, with the first number that makes it another one. */
static const char *numbered(const char *name, const char *const *taken, int count, ves_arena *arena)
{
    const char *other = name;
    for (int k = 2; other && is_among(taken, count, other); k++)
        other = ves_arena_format(arena, "%s-%d", name, k);
    return other;
}

/* Two rounds: who is the first of a name keeps it, so that a number never takes a name that somebody has. */
bool ves_folder_names(const char **name, int count, ves_arena *arena)
{
    const char **later = ves_arena_take(arena, (size_t)count, sizeof *later);
    if (!later) return false;
    for (int k = 0; k < count; k++) {
        char *file = ves_arena_format(arena, "%.150s", name[k]);
        if (!file) return false;
        for (char *at = file; *at; at++)
            if (!isalnum((unsigned char)*at) && !strchr("._-", *at)) *at = '-';
        const bool taken = is_among(name, k, file);
        later[k] = taken ? file : NULL;
        name[k] = taken ? NULL : file;
    }
    for (int k = 0; k < count; k++)
        if (later[k] && !(name[k] = numbered(later[k], name, count, arena))) return false;
    return true;
}

ves_status ves_folder_picture(const char *folder, const char *kind, const char *name, ves_arena *arena,
                              char **path, ves_diag *diag)
{
    char *within = ves_folder_path(folder, kind, arena), *file = ves_arena_format(arena, "%s.png", name);
    *path = NULL;
    if (!within || !file) return ves_diag_fail(diag, VES_MEMORY);
    VES_TRY(ves_folder_open(within, arena, diag));
    *path = ves_folder_path(within, file, arena);
    return *path ? VES_OK : ves_diag_fail(diag, VES_MEMORY);
}

char *ves_folder_free(const char *stem, const char *ending, ves_arena *arena)
{
    char *path = ves_arena_format(arena, "%s.%s", stem, ending);
    for (int k = 2; path && access(path, F_OK) == 0 && k < NUMBERS; k++)
        path = ves_arena_format(arena, "%s-%d.%s", stem, k, ending);
    return path;
}

/* Where the digits begin that stand before `end`; NULL: none do. */
static const char *digits_before(const char *text, const char *end)
{
    const char *at = end;
    while (at > text && isdigit((unsigned char)at[-1])) at--;
    return at < end ? at : NULL;
}

/* .NAME.vesica-PID-TRY.ENDING, of any file that was to appear whole (output/file.c). */
static bool is_unfinished(const char *entry)
{
    const char *ending = *entry == '.' ? strrchr(entry, '.') : NULL;
    const char *attempt = ending ? digits_before(entry, ending) : NULL;
    if (!attempt || attempt[-1] != '-') return false;
    static const char mark[] = ".vesica-";
    const size_t length = sizeof mark - 1;
    const char *pid = digits_before(entry, attempt - 1);
    return pid && pid - entry > (ptrdiff_t)length && !strncmp(pid - length, mark, length);
}

void ves_folder_tidy(const char *path, ves_arena *arena)
{
    DIR *folder = opendir(path);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        char *name = is_unfinished(entry->d_name) ? ves_folder_path(path, entry->d_name, arena) : NULL;
        if (name) unlink(name);
    }
    if (folder) closedir(folder);
}

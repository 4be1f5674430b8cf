#include "study/bench_folder.h"

#include <dirent.h>
#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "base/diag.h"
#include "output/file.h"
#include "output/output.h"
#include "study/bench_json.h"
#include "study/bench_line.h"
#include "study/folder.h"
#include "study/open.h"

enum { NAME = 32 };

static const ves_mark NOWHERE = {0};

/* What is left to be read of a file. */
typedef struct text {
    const char *path, *at;
    size_t left;
    int number; /* of the line before */
} text;

/* errno tells why, or nothing does. */
static ves_status unreadable(const char *path, ves_diag *diag)
{
    return ves_diag_add(diag, VES_ERROR, VES_IO, NOWHERE, "cannot read \"%s\": %s", path,
                        errno ? strerror(errno) : "it is no file of a benchmark");
}

/* --- writing --- */

ves_status ves_bench_line_write(ves_bench_files *files, const ves_suite *suite, int index,
                                const ves_outcome *outcome)
{
    files->written = true;
    ves_bench_run_write(suite, index, outcome, files->runs);
    ves_bench_times_write(index, outcome, files->times);
    if (!fflush(files->times) && !fflush(files->runs)) return VES_OK; /* the line of a run holds its times */
    return ves_file_complain(files->folder, errno, files->diag);
}

static char *journal_path(const char *folder, int index, ves_arena *arena)
{
    return ves_arena_format(arena, "%s/journals/%05d.jsonl", folder, index);
}

/* path: NULL when out of memory. */
static ves_status begin(ves_file *file, const char *path, const char *ending, ves_diag *diag)
{
    return path ? ves_file_begin(file, path, ending, diag) : ves_diag_fail(diag, VES_MEMORY);
}

ves_status ves_bench_journal_write(const ves_bench_files *files, int index, const ves_outcome *outcome)
{
    ves_arena arena = {0};
    ves_file file;
    ves_status status = begin(&file, journal_path(files->folder, index, &arena), "jsonl", files->diag);
    if (status == VES_OK) {
        ves_bench_steps_write(outcome, file.out);
        status = ves_file_end(&file, VES_OK, files->diag);
    }
    ves_arena_destroy(&arena);
    return status;
}

ves_status ves_bench_report_write(const ves_bench *bench, ves_diag *diag)
{
    ves_arena arena = {0};
    ves_file file;
    ves_status status = begin(&file, ves_folder_path(bench->folder, "report.json", &arena), "json", diag);
    if (status == VES_OK) {
        ves_json json = {.out = file.out};
        ves_json_object(&json, NULL);
        ves_bench_json(bench, false, &json);
        ves_json_end(&json, '}');
        status = ves_file_end(&file, VES_OK, diag);
    }
    ves_arena_destroy(&arena);
    return status;
}

/* runs.jsonl; of another rank runs.1.jsonl */
static char *lines_path(const ves_bench_files *files, const char *name, int rank, ves_arena *arena)
{
    return rank ? ves_arena_format(arena, "%s/%s.%d.jsonl", files->folder, name, rank)
                : ves_arena_format(arena, "%s/%s.jsonl", files->folder, name);
}

static ves_status open_lines(ves_bench_files *files, const char *mode)
{
    ves_arena arena = {0};
    char *runs = lines_path(files, "runs", files->rank, &arena);
    char *times = lines_path(files, "times", files->rank, &arena);
    ves_status status = runs && times ? VES_OK : ves_diag_fail(files->diag, VES_MEMORY);
    if (status == VES_OK) {
        files->runs = fopen(runs, mode);
        if (!files->runs) status = ves_file_complain(runs, errno, files->diag);
    }
    if (status == VES_OK) {
        files->times = fopen(times, mode);
        if (!files->times) status = ves_file_complain(times, errno, files->diag);
    }
    ves_arena_destroy(&arena);
    return status;
}

ves_status ves_bench_files_take(ves_bench_files *files, const char *folder, ves_arena *arena, ves_diag *diag)
{
    *files = (ves_bench_files){.lock = {.fd = -1}, .diag = diag};
    VES_TRY(ves_lock_take(&files->lock, folder, arena, diag));
    files->folder = folder;
    return VES_OK;
}

static ves_status journals_open(const ves_bench_files *files)
{
    ves_arena arena = {0};
    char *journals = ves_folder_path(files->folder, "journals", &arena);
    ves_status status =
        journals ? ves_folder_open(journals, &arena, files->diag) : ves_diag_fail(files->diag, VES_MEMORY);
    ves_arena_destroy(&arena);
    return status;
}

ves_status ves_bench_files_begin(ves_bench_files *files)
{
    VES_TRY(journals_open(files));
    return open_lines(files, "wbx");
}

ves_status ves_bench_files_join(ves_bench_files *files, const char *folder, int rank, ves_diag *diag)
{
    *files = (ves_bench_files){.folder = folder, .rank = rank, .lock = {.fd = -1}, .diag = diag};
    return open_lines(files, "ab");
}

/* Each rank other than 0 that has left lines: runs.RANK.jsonl. */
static ves_status each_rank(ves_bench_files *files, void (*look)(ves_bench_files *, int rank, void *),
                            void *data)
{
    DIR *folder = opendir(files->folder);
    if (!folder) return unreadable(files->folder, files->diag);
    for (struct dirent *entry; (entry = readdir(folder));) {
        int rank = 0;
        char name[NAME];
        if (sscanf(entry->d_name, "runs.%9d", &rank) != 1 || rank <= 0) continue;
        snprintf(name, sizeof name, "runs.%d.jsonl", rank);
        if (!strcmp(entry->d_name, name)) look(files, rank, data);
    }
    closedir(folder);
    return VES_OK;
}

static void forget(ves_bench_files *files, int rank, void *data)
{
    ves_arena arena = {0};
    char *runs = lines_path(files, "runs", rank, &arena), *times = lines_path(files, "times", rank, &arena);
    (void)data;
    if (times) unlink(times);
    if (runs) unlink(runs);
    ves_arena_destroy(&arena);
}

/* All lines of one of the files, in the order of the runs. */
static ves_status lines_write(const ves_bench_files *files, const char *name, const ves_bench *bench)
{
    ves_arena arena = {0};
    ves_file file;
    ves_status status = begin(&file, lines_path(files, name, 0, &arena), "jsonl", files->diag);
    if (status == VES_OK) {
        for (int k = 0; k < bench->runs; k++)
            if (bench->outcome[k].done && *name == 'r')
                ves_bench_run_write(bench->suite, k, &bench->outcome[k], file.out);
            else if (bench->outcome[k].done)
                ves_bench_times_write(k, &bench->outcome[k], file.out);
        status = ves_file_end(&file, VES_OK, files->diag);
    }
    ves_arena_destroy(&arena);
    return status;
}

/* Those of all ranks, which are then not needed any more. */
static ves_status lines_sort(ves_bench_files *files, const ves_bench *bench)
{
    VES_TRY(lines_write(files, "times", bench));
    VES_TRY(lines_write(files, "runs", bench));
    return each_rank(files, forget, NULL);
}

ves_status ves_bench_files_end(ves_bench_files *files, const ves_bench *bench)
{
    bool bad = (files->runs && fclose(files->runs)) | (files->times && fclose(files->times));
    ves_status status = bad ? ves_file_complain(files->folder, errno, files->diag) : VES_OK;
    if (files->written && !files->rank) {
        ves_status sorted = lines_sort(files, bench);
        if (status == VES_OK) status = sorted;
    }
    if (files->folder && !files->rank) ves_lock_drop(&files->lock);
    files->runs = files->times = NULL;
    return status;
}

/* --- reading back --- */

static ves_status load(const char *path, ves_arena *arena, text *rest, ves_diag *diag)
{
    char *found = NULL;
    size_t length = 0;
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    errno = 0;
    ves_status status = ves_study_load(path, arena, &found, &length);
    *rest = (text){path, found, found ? length : 0, 0};
    if (status == VES_MEMORY) return ves_diag_fail(diag, VES_MEMORY);
    if (status == VES_OK || errno == ENOENT) return VES_OK; /* killed before it was made */
    return unreadable(path, diag);
}

/* The next whole line: the last may have been cut off. */
static bool next(text *rest, const char **line, size_t *length)
{
    const char *end = rest->left ? memchr(rest->at, '\n', rest->left) : NULL;
    if (!end) return false;
    *line = rest->at;
    *length = (size_t)(end - rest->at);
    rest->at = end + 1;
    rest->left -= *length + 1;
    rest->number++;
    return true;
}

/* One line of runs.jsonl. What it says of a run is lost only if it is damaged, or the journal is that or gone: then the
 * run is made again. */
static ves_status line_read(const ves_bench_files *files, const ves_bench *bench, const text *rest,
                            const ves_node *line, ves_arena *arena)
{
    const ves_suite *suite = bench->suite;
    int index = ves_bench_run_of(line, suite);
    ves_outcome *o = index < 0 ? NULL : &bench->outcome[index];
    if (o && o->done) return VES_OK; /* twice */
    ves_status status = VES_OK;
    int n = o ? bench->problem[ves_suite_run(suite, index).problem].n : 0;
    if (!o || !ves_bench_run_read(line, n, ves_suite_budget(suite, n), o)) {
        ves_diag_add(files->diag, VES_WARNING, VES_SYNTAX, NOWHERE,
                     "\"%s\": line %d is damaged, or of no run of this suite: left out", rest->path,
                     rest->number);
    } else {
        text journal;
        status = load(journal_path(files->folder, index, arena), arena, &journal, files->diag);
        o->done = status == VES_OK && ves_bench_steps_read(journal.at, journal.left, o);
        if (status == VES_OK && !o->done)
            ves_diag_add(files->diag, VES_WARNING, VES_SYNTAX, NOWHERE,
                         "\"%s\" is missing or damaged: run %d is made again", journal.path, index);
    }
    if (o && !o->done) ves_outcome_clear(o);
    return status;
}

/* Lines come in the order in which runs have ended. */
static ves_status lines_read(const ves_bench_files *files, const ves_bench *bench, text *rest)
{
    const char *line;
    size_t length;
    ves_status status = VES_OK;
    while (status == VES_OK && next(rest, &line, &length)) {
        ves_arena arena = {0};
        status = line_read(files, bench, rest, ves_study_json(line, length, &arena), &arena);
        ves_arena_destroy(&arena);
    }
    return status;
}

/* What clocks said of the runs that hold. */
static void times_read(const ves_bench_files *files, const ves_bench *bench, text *rest)
{
    const char *line;
    size_t length;
    while (next(rest, &line, &length)) {
        ves_arena arena = {0};
        if (!ves_bench_times_read(ves_study_json(line, length, &arena), bench->runs, bench->outcome))
            ves_diag_add(files->diag, VES_WARNING, VES_SYNTAX, NOWHERE,
                         "\"%s\": line %d is damaged: how long its run took is not known", rest->path,
                         rest->number);
        ves_arena_destroy(&arena);
    }
}

typedef struct reading {
    const ves_bench *bench;
    ves_status status;
} reading;

/* What one rank has left. */
static void read_back(ves_bench_files *files, int rank, void *data)
{
    reading *r = data;
    ves_arena arena = {0};
    text runs, times;
    ves_status status = load(lines_path(files, "runs", rank, &arena), &arena, &runs, files->diag);
    if (status == VES_OK)
        status = load(lines_path(files, "times", rank, &arena), &arena, &times, files->diag);
    const bool timeless = status == VES_OK && runs.left && !times.at;
    if (status == VES_OK) status = lines_read(files, r->bench, &runs);
    if (status == VES_OK) times_read(files, r->bench, &times);
    if (timeless)
        ves_diag_add(files->diag, VES_WARNING, VES_IO, NOWHERE,
                     "\"%s\" is missing: how long the runs before took is not known", times.path);
    if (r->status == VES_OK) r->status = status;
    ves_arena_destroy(&arena);
}

ves_status ves_bench_files_gather(ves_bench_files *files, const ves_bench *bench)
{
    reading r = {.bench = bench};
    ves_status status = each_rank(files, read_back, &r);
    if (status == VES_OK) status = r.status;
    files->written = status == VES_OK; /* else sorting would lose what could not be read */
    return status;
}

static void tidy(const ves_bench_files *files)
{
    static const char *const within[] = {"journals", "convergence", "optima"};
    ves_arena arena = {0};
    ves_folder_tidy(files->folder, &arena);
    for (size_t k = 0; k < sizeof within / sizeof *within; k++) {
        char *folder = ves_folder_path(files->folder, within[k], &arena);
        if (folder) ves_folder_tidy(folder, &arena);
    }
    ves_arena_destroy(&arena);
}

ves_status ves_bench_files_again(ves_bench_files *files, const ves_bench *bench)
{
    reading r = {.bench = bench};
    VES_TRY(journals_open(files));
    tidy(files);
    read_back(files, 0, &r);
    VES_TRY(r.status);
    VES_TRY(ves_bench_files_gather(files, bench));
    VES_TRY(lines_sort(files, bench)); /* without what was cut off or damaged */
    files->written = false;
    return open_lines(files, "ab");
}

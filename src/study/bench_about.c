#include "study/bench_about.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/diag.h"
#include "output/file.h"
#include "output/output.h"
#include "study/folder.h"
#include "study/load.h"
#include "study/open.h"

enum { COMMAND = 2 }; /* words of a command that may be its program: an interpreter and its script */

static const ves_mark NOWHERE = {0};

/* --- writing --- */

typedef struct writer {
    const char *folder;
    const ves_suite *suite;
    ves_arena arena;
    ves_diag *diag;
} writer;

char *ves_bench_about_problem(const char *folder, int problem, ves_arena *arena)
{
    return ves_arena_format(arena, "%s/problems/%d.yaml", folder, problem);
}

static ves_status text_write(writer *w, const char *path, const char *text)
{
    ves_file file;
    if (!path || !text) return ves_diag_fail(w->diag, VES_MEMORY);
    VES_TRY(ves_file_begin(&file, path, "text", w->diag));
    fwrite(text, 1, strlen(text), file.out);
    return ves_file_end(&file, VES_OK, w->diag);
}

static ves_status copies_write(writer *w, const char *const *problem)
{
    VES_TRY(text_write(w, ves_folder_path(w->folder, "suite.yaml", &w->arena), w->suite->text));
    for (int k = 0; k < w->suite->problems; k++) {
        if (!problem[k]) continue;
        char *folder = ves_folder_path(w->folder, "problems", &w->arena);
        if (!folder) return ves_diag_fail(w->diag, VES_MEMORY);
        VES_TRY(ves_folder_open(folder, &w->arena, w->diag));
        VES_TRY(text_write(w, ves_bench_about_problem(w->folder, k, &w->arena), problem[k]));
    }
    return VES_OK;
}

/* named: as bench.json calls it. */
static void sum_write(ves_json *json, const char *named, const char *path)
{
    ves_json_object(json, NULL);
    ves_json_text(json, "file", named);
    ves_json_count(json, "crc", ves_study_sum(path));
    ves_json_end(json, '}');
}

static bool is_file(const char *path)
{
    struct stat there;
    return strchr(path, '/') && !stat(path, &there) && S_ISREG(there.st_mode);
}

static ves_status sums_write(writer *w, const char *const *problem, ves_json *json)
{
    const ves_suite *s = w->suite;
    char *suite = ves_folder_path(w->folder, "suite.yaml", &w->arena);
    if (!suite) return VES_MEMORY;
    sum_write(json, "suite.yaml", suite);
    for (int k = 0; k < s->problems; k++) {
        const char *path = s->problem[k].path, *named = NULL;
        if (s->problem[k].kind == VES_SUITE_LANDSCAPE) continue;
        if (problem[k]) path = ves_bench_about_problem(w->folder, k, &w->arena);
        named = problem[k] ? ves_arena_format(&w->arena, "problems/%d.yaml", k)
                           : ves_study_absolute(path, &w->arena);
        if (!path || !named) return VES_MEMORY;
        sum_write(json, named, path);
    }
    for (int e = 0; e < s->methods; e++)
        for (int k = 0; k < COMMAND && s->method[e].word[k]; k++) {
            if (!is_file(s->method[e].word[k])) continue;
            const char *named = ves_study_absolute(s->method[e].word[k], &w->arena);
            if (!named) return VES_MEMORY;
            sum_write(json, named, s->method[e].word[k]);
        }
    return VES_OK;
}

static ves_status about_fill(writer *w, const char *const *problem, FILE *out)
{
    const ves_suite *suite = w->suite;
    const char *path = ves_study_absolute(suite->path, &w->arena);
    if (!path) return VES_MEMORY;
    ves_json json = {.out = out};
    ves_json_object(&json, NULL);
    ves_json_text(&json, "suite", path);
    ves_json_text(&json, "version", VESICA_VERSION);
    ves_json_array(&json, "methods");
    for (int k = 0; k < suite->methods; k++) ves_json_text(&json, NULL, suite->method[k].name);
    ves_json_end(&json, ']');
    ves_json_array(&json, "files");
    ves_status status = sums_write(w, problem, &json);
    ves_json_end(&json, ']');
    ves_json_end(&json, '}');
    return status;
}

static ves_status about_write(writer *w, const char *const *problem)
{
    ves_file file;
    char *path = ves_folder_path(w->folder, "bench.json", &w->arena);
    if (!path) return ves_diag_fail(w->diag, VES_MEMORY);
    VES_TRY(ves_file_begin(&file, path, "json", w->diag));
    ves_status status = about_fill(w, problem, file.out);
    if (status != VES_OK) ves_diag_fail(w->diag, status);
    return ves_file_end(&file, status, w->diag);
}

ves_status ves_bench_about_write(const char *folder, const ves_suite *suite, const char *const *problem,
                                 ves_diag *diag)
{
    writer w = {.folder = folder, .suite = suite, .diag = diag};
    ves_status status = copies_write(&w, problem);
    if (status == VES_OK) status = about_write(&w, problem);
    ves_arena_destroy(&w.arena);
    return status;
}

/* --- reading --- */

static ves_status damaged(const char *path, ves_diag *diag)
{
    return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, NOWHERE, "\"%s\" is damaged or not whole", path);
}

static ves_status methods_read(const ves_node *root, const char *path, ves_arena *arena,
                               ves_bench_about *about, ves_diag *diag)
{
    const ves_node *methods = ves_node_find(root, "methods");
    about->path = ves_json_word(root, "suite");
    if (!about->path || !methods || methods->kind != VES_NODE_LIST) return damaged(path, diag);
    about->method = ves_arena_take(arena, (size_t)methods->count, sizeof *about->method);
    if (!about->method) return ves_diag_fail(diag, VES_MEMORY);
    for (int k = 0; k < methods->count; k++)
        if (methods->item[k]->kind == VES_NODE_WORD) about->method[about->methods++] = methods->item[k]->text;
    return VES_OK;
}

static ves_status version_compare(const ves_node *root, const char *folder, ves_diag *diag)
{
    const char *version = ves_json_word(root, "version");
    if (version && !strcmp(version, VESICA_VERSION)) return VES_OK;
    return ves_diag_add(
        diag, VES_ERROR, VES_STALE, NOWHERE,
        "\"%s\" was made by vesica %s, and this is %s: its runs would not compare. Begin a new "
        "one with \"%s/suite.yaml\"",
        folder, version ? version : "?", VESICA_VERSION, folder);
}

static ves_status sums_compare(const ves_node *root, const char *folder, ves_arena *arena, ves_diag *diag)
{
    const ves_node *files = ves_node_find(root, "files");
    for (int k = 0; files && files->kind == VES_NODE_LIST && k < files->count; k++) {
        const char *named = ves_json_word(files->item[k], "file");
        const char *path = named && *named != '/' ? ves_folder_path(folder, named, arena) : named;
        if (named && !path) return ves_diag_fail(diag, VES_MEMORY);
        if (!path) continue;
        double want = ves_json_double(files->item[k], "crc", 0);
        if ((double)ves_study_sum(path) == want) continue;
        return ves_diag_add(diag, VES_ERROR, VES_STALE, NOWHERE,
                            "\"%s\" is not what it was when \"%s\" was begun, so that its runs would not "
                            "compare: put it back, or begin a new benchmark",
                            path, folder);
    }
    return VES_OK;
}

static ves_status suite_load(const char *folder, ves_arena *arena, ves_bench_about *about, ves_diag *diag)
{
    char *path = ves_folder_path(folder, "suite.yaml", arena);
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    errno = 0;
    ves_status status = ves_study_load(path, arena, &about->text, &about->length);
    if (status == VES_MEMORY) return ves_diag_fail(diag, VES_MEMORY);
    if (status == VES_OK) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_IO, NOWHERE, "cannot read \"%s\": %s", path,
                        errno ? strerror(errno) : "it is no file of a benchmark");
}

ves_status ves_bench_about_read(const char *folder, ves_arena *arena, ves_bench_about *about, ves_diag *diag)
{
    const ves_node *root = NULL;
    char *path = ves_folder_path(folder, "bench.json", arena);
    *about = (ves_bench_about){.methods = 0};
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    if (access(path, F_OK))
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, NOWHERE,
                            "\"%s\" is not the folder of a benchmark: it has no bench.json", folder);
    ves_status status = ves_json_load(path, arena, &root);
    if (status == VES_MEMORY) return ves_diag_fail(diag, VES_MEMORY);
    if (status != VES_OK) return damaged(path, diag);
    VES_TRY(methods_read(root, path, arena, about, diag));
    VES_TRY(version_compare(root, folder, diag));
    VES_TRY(sums_compare(root, folder, arena, diag));
    return suite_load(folder, arena, about, diag);
}

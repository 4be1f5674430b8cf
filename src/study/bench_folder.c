#include "study/bench_folder.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/diag.h"
#include "base/text.h"
#include "output/file.h"
#include "output/output.h"
#include "study/bench_json.h"
#include "study/folder.h"
#include "study/open.h"

enum { NUMBER = 32 };

static const ves_mark NOWHERE = {0};

static const char *const ENDS[] = {"failed", "target", "budget"};

/* --- writing --- */

static void run_write(FILE *out, const ves_suite *suite, int index, const ves_outcome *o)
{
    ves_suite_place place = ves_suite_run(suite, index);
    ves_json json = {.out = out, .line = true};
    ves_json_object(&json, NULL);
    ves_json_integer(&json, "run", index);
    ves_json_text(&json, "method", suite->entrant[place.entrant].name);
    ves_json_text(&json, "problem", suite->bout[place.bout].name);
    ves_json_integer(&json, "seed", place.seed);
    ves_json_text(&json, "end", ENDS[o->failed ? 0 : o->hit ? 1 : 2]);
    ves_json_text(&json, "reason", *o->reason ? o->reason : NULL);
    ves_json_number(&json, "budget", o->budget);
    ves_json_number(&json, "spent", o->spent);
    ves_json_integer(&json, "evaluations", o->evaluations);
    ves_json_integer(&json, "gradients", o->gradients);
    ves_json_integer(&json, "failures", o->failures);
    ves_json_integer(&json, "starts", o->starts);
    ves_json_flag(&json, "feasible", o->any && o->violation <= 1);
    ves_json_number(&json, "value", o->any ? o->value : NAN);
    ves_json_number(&json, "violation", o->any ? o->violation : NAN);
    ves_json_array(&json, "x");
    for (int i = 0; o->any && i < o->n; i++) ves_json_number(&json, NULL, o->x[i]);
    ves_json_end(&json, ']');
    ves_json_end(&json, '}');
}

static void times_write(FILE *out, int index, const ves_outcome *o)
{
    ves_json json = {.out = out, .line = true};
    ves_json_object(&json, NULL);
    ves_json_integer(&json, "run", index);
    ves_json_number(&json, "wall_s", o->wall);
    ves_json_number(&json, "inside_s", o->inside);
    ves_json_number(&json, "cpu_s", o->cpu);
    ves_json_end(&json, '}');
}

ves_status ves_bench_line_write(ves_bench_files *files, const ves_suite *suite, int index,
                                const ves_outcome *outcome)
{
    run_write(files->runs, suite, index, outcome);
    times_write(files->times, index, outcome);
    if (!fflush(files->times) && !fflush(files->runs)) return VES_OK; /* the line of a run holds its times */
    return ves_file_complain(files->folder, errno, files->diag);
}

static char *journal_path(const char *folder, int index, ves_arena *arena)
{
    return ves_arena_format(arena, "%s/journals/%05d.jsonl", folder, index);
}

ves_status ves_bench_journal_write(const char *folder, int index, const ves_outcome *outcome)
{
    ves_arena arena = {0};
    ves_file file;
    char *path = journal_path(folder, index, &arena);
    ves_status status = path ? ves_file_begin(&file, path, "jsonl", NULL) : VES_MEMORY;
    if (status == VES_OK) {
        ves_json json = {.out = file.out, .line = true};
        for (int k = 0; k < outcome->steps; k++) {
            ves_json_array(&json, NULL);
            ves_json_number(&json, NULL, outcome->step[k].cost);
            ves_json_number(&json, NULL, outcome->step[k].value);
            ves_json_number(&json, NULL, outcome->step[k].violation);
            ves_json_end(&json, ']');
        }
        status = ves_file_end(&file, VES_OK, NULL);
    }
    ves_arena_destroy(&arena);
    return status;
}

static ves_status text_write(const char *folder, const char *name, const char *text, ves_arena *arena,
                             ves_diag *diag)
{
    ves_file file;
    char *path = ves_folder_path(folder, name, arena);
    if (!path || !text) return ves_diag_fail(diag, VES_MEMORY);
    VES_TRY(ves_file_begin(&file, path, "text", diag));
    fwrite(text, 1, strlen(text), file.out);
    return ves_file_end(&file, VES_OK, diag);
}

static void about_write(FILE *out, const ves_suite *suite)
{
    ves_json json = {.out = out};
    ves_json_object(&json, NULL);
    ves_json_text(&json, "suite", suite->path);
    ves_json_text(&json, "version", VESICA_VERSION);
    ves_json_array(&json, "methods");
    for (int k = 0; k < suite->entrants; k++) ves_json_text(&json, NULL, suite->entrant[k].name);
    ves_json_end(&json, ']');
    ves_json_end(&json, '}');
}

ves_status ves_bench_suite_write(const char *folder, const ves_suite *suite, ves_diag *diag)
{
    ves_arena arena = {0};
    ves_file file;
    ves_status status = text_write(folder, "suite.yaml", suite->text, &arena, diag);
    char *path = ves_folder_path(folder, "bench.json", &arena);
    if (status == VES_OK && !path) status = ves_diag_fail(diag, VES_MEMORY);
    if (status == VES_OK) status = ves_file_begin(&file, path, "json", diag);
    if (status == VES_OK) {
        about_write(file.out, suite);
        status = ves_file_end(&file, VES_OK, diag);
    }
    ves_arena_destroy(&arena);
    return status;
}

ves_status ves_bench_report_write(const ves_bench *bench, ves_diag *diag)
{
    ves_arena arena = {0};
    ves_file file;
    char *path = ves_folder_path(bench->folder, "report.json", &arena);
    ves_status status = path ? ves_file_begin(&file, path, "json", diag) : ves_diag_fail(diag, VES_MEMORY);
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

static ves_status open_lines(ves_bench_files *files, const char *mode)
{
    ves_arena arena = {0};
    char *runs = ves_folder_path(files->folder, "runs.jsonl", &arena);
    char *times = ves_folder_path(files->folder, "times.jsonl", &arena);
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

ves_status ves_bench_files_begin(ves_bench_files *files, const ves_suite *suite)
{
    ves_arena arena = {0};
    ves_diag *diag = files->diag;
    char *journals = ves_folder_path(files->folder, "journals", &arena);
    ves_status status = journals ? ves_folder_open(journals, &arena, diag) : ves_diag_fail(diag, VES_MEMORY);
    ves_arena_destroy(&arena);
    if (status == VES_OK) status = ves_bench_suite_write(files->folder, suite, diag);
    return status == VES_OK ? open_lines(files, "wbx") : status;
}

ves_status ves_bench_files_end(ves_bench_files *files)
{
    bool bad = (files->runs && fclose(files->runs)) | (files->times && fclose(files->times));
    if (files->folder) ves_lock_drop(&files->lock);
    files->runs = files->times = NULL;
    return bad ? ves_file_complain(files->folder, errno, files->diag) : VES_OK;
}

/* --- reading back --- */

static ves_status load(const char *path, ves_arena *arena, char **text, size_t *length, ves_diag *diag)
{
    errno = 0;
    ves_status status = ves_study_load(path, arena, text, length);
    if (status == VES_MEMORY) return ves_diag_fail(diag, VES_MEMORY);
    if (status == VES_OK) return VES_OK;
    return ves_diag_add(diag, VES_ERROR, VES_IO, NOWHERE, "cannot read \"%s\": %s", path,
                        errno ? strerror(errno) : "it is no file of a benchmark");
}

static ves_status about_read(const ves_node *root, const char *folder, ves_bench_about *about,
                             ves_arena *arena, ves_diag *diag)
{
    const ves_node *path = root ? ves_node_find(root, "suite") : NULL;
    const ves_node *methods = root ? ves_node_find(root, "methods") : NULL;
    bool good = path && path->kind == VES_NODE_WORD && methods && methods->kind == VES_NODE_LIST;
    if (!good)
        return ves_diag_add(diag, VES_ERROR, VES_SYNTAX, NOWHERE, "\"%s/bench.json\" is damaged or not whole",
                            folder);
    about->path = path->text;
    about->method = ves_arena_take(arena, (size_t)methods->count, sizeof *about->method);
    if (!about->method) return ves_diag_fail(diag, VES_MEMORY);
    for (int k = 0; k < methods->count; k++)
        if (methods->item[k]->kind == VES_NODE_WORD) about->method[about->methods++] = methods->item[k]->text;
    return VES_OK;
}

ves_status ves_bench_about_read(const char *folder, ves_arena *arena, ves_bench_about *about, ves_diag *diag)
{
    char *suite = ves_folder_path(folder, "suite.yaml", arena), *text = NULL;
    char *json = ves_folder_path(folder, "bench.json", arena);
    size_t length = 0;
    *about = (ves_bench_about){.methods = 0};
    if (!suite || !json) return ves_diag_fail(diag, VES_MEMORY);
    if (access(json, F_OK))
        return ves_diag_add(diag, VES_ERROR, VES_USAGE, NOWHERE,
                            "\"%s\" is not the folder of a benchmark: it has no bench.json", folder);
    VES_TRY(load(json, arena, &text, &length, diag));
    VES_TRY(about_read(ves_study_json(text, length, arena), folder, about, arena, diag));
    return load(suite, arena, &about->text, &about->length, diag);
}

static double number_of(const ves_node *line, const char *key)
{
    const ves_node *node = ves_node_find(line, key);
    double value;
    return node && node->kind == VES_NODE_WORD && ves_text_number(node->text, &value) ? value : NAN;
}

static bool word_is(const ves_node *line, const char *key, const char *word)
{
    const ves_node *node = ves_node_find(line, key);
    return node && node->kind == VES_NODE_WORD && !strcmp(node->text, word);
}

static bool read_x(const ves_node *line, ves_outcome *o)
{
    const ves_node *x = ves_node_find(line, "x");
    if (!x || x->kind != VES_NODE_LIST) return false;
    o->any = x->count > 0;
    o->n = x->count;
    o->x = ves_memory_take((size_t)(x->count + 1) * sizeof *o->x);
    for (int i = 0; o->x && i < x->count; i++)
        if (x->item[i]->kind != VES_NODE_WORD || !ves_text_number(x->item[i]->text, &o->x[i])) return false;
    return o->x;
}

/* False: not a whole line, or not of this run. */
static bool run_read(const ves_node *line, const ves_suite *suite, int index, ves_outcome *o)
{
    ves_suite_place place = ves_suite_run(suite, index);
    const ves_node *reason = ves_node_find(line, "reason");
    bool fits = number_of(line, "run") == index && number_of(line, "seed") == place.seed &&
                word_is(line, "method", suite->entrant[place.entrant].name) &&
                word_is(line, "problem", suite->bout[place.bout].name);
    if (!fits || !read_x(line, o)) return false;
    o->failed = word_is(line, "end", ENDS[0]);
    o->hit = word_is(line, "end", ENDS[1]);
    if (reason && reason->kind == VES_NODE_WORD && !reason->plain)
        snprintf(o->reason, sizeof o->reason, "%s", reason->text);
    o->budget = number_of(line, "budget");
    o->spent = number_of(line, "spent");
    o->evaluations = (long)number_of(line, "evaluations");
    o->gradients = (long)number_of(line, "gradients");
    o->failures = (long)number_of(line, "failures");
    o->starts = (int)number_of(line, "starts");
    o->value = o->any ? number_of(line, "value") : HUGE_VAL;
    o->violation = o->any ? number_of(line, "violation") : HUGE_VAL;
    o->wall = o->inside = o->cpu = NAN;
    return isfinite(o->spent) && isfinite(o->budget);
}

/* [cost,value,violation] */
static bool step_read(const char *line, size_t length, ves_step *step)
{
    double *to[3] = {&step->cost, &step->value, &step->violation};
    const char *end = line + length;
    if (length < 2 || *line++ != '[' || end[-1] != ']') return false;
    for (int k = 0; k < 3; k++) {
        size_t part = strcspn(line, ",]");
        char word[NUMBER] = "";
        if (part >= NUMBER || line + part >= end) return false;
        memcpy(word, line, part);
        if (!ves_text_number(word, to[k]) && strcmp(word, "null")) return false;
        line += part + 1;
    }
    return line == end;
}

static bool journal_read(const char *folder, int index, ves_outcome *o)
{
    ves_arena arena = {0};
    size_t length = 0;
    char *text = NULL, *path = journal_path(folder, index, &arena);
    bool good = path && load(path, &arena, &text, &length, NULL) == VES_OK;
    int lines = 0;
    for (size_t k = 0; good && k < length; k++) lines += text[k] == '\n';
    o->step = good ? ves_memory_take((size_t)(lines + 1) * sizeof *o->step) : NULL;
    good = o->step;
    for (const char *at = text; good && *at; at += strcspn(at, "\n"), at += *at == '\n')
        good = step_read(at, strcspn(at, "\n"), &o->step[o->steps++]);
    ves_arena_destroy(&arena);
    return good;
}

/* The end of the last line that holds; *count of them. */
static size_t lines_read(const char *text, const ves_suite *suite, const char *folder, ves_outcome *outcome,
                         int *count)
{
    const char *at = text;
    for (*count = 0; *count < ves_suite_runs(suite); ++*count) {
        size_t length = strcspn(at, "\n");
        ves_arena arena = {0};
        ves_outcome *o = &outcome[*count];
        const ves_node *line = at[length] ? ves_study_json(at, length, &arena) : NULL;
        o->done = line && run_read(line, suite, *count, o) && journal_read(folder, *count, o);
        ves_arena_destroy(&arena);
        if (!o->done) {
            ves_outcome_clear(o);
            break;
        }
        at += length + 1;
    }
    return (size_t)(at - text);
}

static size_t times_read(const char *text, ves_outcome *outcome, int count)
{
    const char *at = text;
    for (int k = 0; k < count; k++) {
        size_t length = strcspn(at, "\n");
        ves_arena arena = {0};
        const ves_node *line = at[length] ? ves_study_json(at, length, &arena) : NULL;
        if (line) {
            outcome[k].wall = number_of(line, "wall_s");
            outcome[k].inside = number_of(line, "inside_s");
            outcome[k].cpu = number_of(line, "cpu_s");
        }
        ves_arena_destroy(&arena);
        if (!line) break;
        at += length + 1;
    }
    return (size_t)(at - text);
}

ves_status ves_bench_files_again(ves_bench_files *files, const ves_suite *suite, ves_outcome *outcome,
                                 int *runs)
{
    const char *folder = files->folder;
    ves_diag *diag = files->diag;
    ves_arena arena = {0};
    char *text = NULL, *clock = NULL, *path = ves_folder_path(folder, "runs.jsonl", &arena);
    char *clock_path = ves_folder_path(folder, "times.jsonl", &arena);
    size_t length = 0, clock_length = 0;
    ves_status status = path && clock_path ? VES_OK : ves_diag_fail(diag, VES_MEMORY);
    if (status == VES_OK) status = load(path, &arena, &text, &length, diag);
    if (status == VES_OK) status = load(clock_path, &arena, &clock, &clock_length, diag);
    if (status == VES_OK) {
        size_t end = lines_read(text, suite, folder, outcome, runs);
        size_t clock_end = times_read(clock, outcome, *runs);
        const char *rest = text + end;
        if (rest[strcspn(rest, "\n")] && *runs < ves_suite_runs(suite) &&
            strchr(strchr(rest, '\n') + 1, '\n'))
            status = ves_diag_add(diag, VES_ERROR, VES_SYNTAX, NOWHERE,
                                  "\"%s\": line %d is not run %d of this suite: another suite, or damaged",
                                  path, *runs + 1, *runs);
        else if (truncate(path, (off_t)end) || truncate(clock_path, (off_t)clock_end))
            status = ves_file_complain(path, errno, diag);
    }
    ves_arena_destroy(&arena);
    return status == VES_OK ? open_lines(files, "ab") : status;
}

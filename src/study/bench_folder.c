#include "study/bench_folder.h"

#include <dirent.h>
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
    files->written = true;
    run_write(files->runs, suite, index, outcome);
    times_write(files->times, index, outcome);
    if (!fflush(files->times) && !fflush(files->runs)) return VES_OK; /* the line of a run holds its times */
    return ves_file_complain(files->folder, errno, files->diag);
}

static char *journal_path(const char *folder, int index, ves_arena *arena)
{
    return ves_arena_format(arena, "%s/journals/%05d.jsonl", folder, index);
}

ves_status ves_bench_journal_write(const ves_bench_files *files, int index, const ves_outcome *outcome)
{
    ves_arena arena = {0};
    ves_file file;
    char *path = journal_path(files->folder, index, &arena);
    ves_status status =
        path ? ves_file_begin(&file, path, "jsonl", files->diag) : ves_diag_fail(files->diag, VES_MEMORY);
    if (status == VES_OK) {
        ves_json json = {.out = file.out, .line = true};
        for (int k = 0; k < outcome->steps; k++) {
            ves_json_array(&json, NULL);
            ves_json_number(&json, NULL, outcome->step[k].cost);
            ves_json_number(&json, NULL, outcome->step[k].value);
            ves_json_number(&json, NULL, outcome->step[k].violation);
            ves_json_end(&json, ']');
        }
        status = ves_file_end(&file, VES_OK, files->diag);
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
static void each_rank(ves_bench_files *files, void (*look)(ves_bench_files *, int rank, void *), void *data)
{
    DIR *folder = opendir(files->folder);
    for (struct dirent *entry; folder && (entry = readdir(folder));) {
        int rank = 0, end = 0;
        if (sscanf(entry->d_name, "runs.%d.jsonl%n", &rank, &end) == 1 && rank > 0 && end &&
            !entry->d_name[end])
            look(files, rank, data);
    }
    if (folder) closedir(folder);
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
static ves_status lines_write(const ves_bench_files *files, const char *name, const ves_suite *suite,
                              const ves_outcome *outcome)
{
    ves_arena arena = {0};
    ves_file file;
    char *path = ves_folder_path(files->folder, name, &arena);
    ves_status status =
        path ? ves_file_begin(&file, path, "jsonl", files->diag) : ves_diag_fail(files->diag, VES_MEMORY);
    if (status == VES_OK) {
        for (int k = 0; k < ves_suite_runs(suite); k++)
            if (outcome[k].done && *name == 'r')
                run_write(file.out, suite, k, &outcome[k]);
            else if (outcome[k].done)
                times_write(file.out, k, &outcome[k]);
        status = ves_file_end(&file, VES_OK, files->diag);
    }
    ves_arena_destroy(&arena);
    return status;
}

/* Those of all ranks, which are then not needed any more. */
static ves_status lines_sort(ves_bench_files *files, const ves_suite *suite, const ves_outcome *outcome)
{
    VES_TRY(lines_write(files, "times.jsonl", suite, outcome));
    VES_TRY(lines_write(files, "runs.jsonl", suite, outcome));
    each_rank(files, forget, NULL);
    return VES_OK;
}

ves_status ves_bench_files_end(ves_bench_files *files, const ves_suite *suite, const ves_outcome *outcome)
{
    bool bad = (files->runs && fclose(files->runs)) | (files->times && fclose(files->times));
    ves_status status = bad ? ves_file_complain(files->folder, errno, files->diag) : VES_OK;
    if (files->written && !files->rank) {
        ves_status sorted = lines_sort(files, suite, outcome);
        if (status == VES_OK) status = sorted;
    }
    if (files->folder && !files->rank) ves_lock_drop(&files->lock);
    files->runs = files->times = NULL;
    return status;
}

/* --- reading back --- */

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

/* The run that a line is about; -1: none of this suite. */
static int run_of(const ves_node *line, const ves_suite *suite)
{
    double run = line ? number_of(line, "run") : NAN;
    if (!(run >= 0 && run < ves_suite_runs(suite)) || run != floor(run)) return -1;
    ves_suite_place place = ves_suite_run(suite, (int)run);
    bool fits = number_of(line, "seed") == place.seed &&
                word_is(line, "method", suite->entrant[place.entrant].name) &&
                word_is(line, "problem", suite->bout[place.bout].name);
    return fits ? (int)run : -1;
}

/* False: not a whole line. */
static bool run_read(const ves_node *line, ves_outcome *o)
{
    const ves_node *reason = ves_node_find(line, "reason");
    if (!read_x(line, o)) return false;
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
    bool good = path && ves_study_load(path, &arena, &text, &length) == VES_OK;
    int lines = 0;
    for (size_t k = 0; good && k < length; k++) lines += text[k] == '\n';
    o->step = good ? ves_memory_take((size_t)(lines + 1) * sizeof *o->step) : NULL;
    good = o->step;
    for (const char *at = text; good && *at; at += strcspn(at, "\n"), at += *at == '\n')
        good = step_read(at, strcspn(at, "\n"), &o->step[o->steps++]);
    ves_arena_destroy(&arena);
    return good;
}

static ves_status load(const char *path, ves_arena *arena, const char **text, ves_diag *diag)
{
    size_t length = 0;
    char *found = NULL;
    if (!path) return ves_diag_fail(diag, VES_MEMORY);
    errno = 0;
    ves_status status = ves_study_load(path, arena, &found, &length);
    *text = found ? found : "";
    if (status == VES_MEMORY) return ves_diag_fail(diag, VES_MEMORY);
    if (status == VES_OK) return VES_OK;
    if (errno == ENOENT) return VES_OK; /* killed before it was made */
    return ves_diag_add(diag, VES_ERROR, VES_IO, NOWHERE, "cannot read \"%s\": %s", path,
                        errno ? strerror(errno) : "it is no file of a benchmark");
}

/* One line of runs.jsonl. What it says of a run is lost only if it, or the journal, is damaged: then the run is
 * made again. */
static void line_read(const ves_bench_files *files, const ves_suite *suite, const char *path, int number,
                      const char *text, size_t length, ves_outcome *outcome)
{
    ves_arena arena = {0};
    const ves_node *line = ves_study_json(text, length, &arena);
    int index = run_of(line, suite);
    ves_outcome *o = index < 0 ? NULL : &outcome[index];
    char *journal = o ? journal_path(files->folder, index, &arena) : NULL;
    bool twice = o && o->done;
    bool good = o && !twice && run_read(line, o);
    if (o && !twice) o->done = good && journal_read(files->folder, index, o);
    if (!o || (!good && !twice))
        ves_diag_add(files->diag, VES_WARNING, VES_SYNTAX, NOWHERE,
                     "\"%s\": line %d is damaged, or of no run of this suite: left out", path, number);
    else if (!o->done)
        ves_diag_add(files->diag, VES_WARNING, VES_SYNTAX, NOWHERE,
                     "\"%s\" is missing or damaged: run %d is made again", journal ? journal : "", index);
    if (o && !o->done) ves_outcome_clear(o);
    ves_arena_destroy(&arena);
}

/* Lines come in the order in which runs have ended. The last may have been cut off. */
static void lines_read(const ves_bench_files *files, const ves_suite *suite, const char *path,
                       const char *text, ves_outcome *outcome)
{
    size_t length = strcspn(text, "\n");
    for (int number = 1; text[length]; number++, length = strcspn(text, "\n")) {
        line_read(files, suite, path, number, text, length, outcome);
        text += length + 1;
    }
}

/* What clocks said of the runs that hold. */
static void times_read(const char *text, int runs, ves_outcome *outcome)
{
    size_t length = strcspn(text, "\n");
    for (; text[length]; text += length + 1, length = strcspn(text, "\n")) {
        ves_arena arena = {0};
        const ves_node *line = ves_study_json(text, length, &arena);
        double run = line ? number_of(line, "run") : NAN;
        ves_outcome *o = run >= 0 && run < runs ? &outcome[(int)run] : NULL;
        if (o && o->done) {
            o->wall = number_of(line, "wall_s");
            o->inside = number_of(line, "inside_s");
            o->cpu = number_of(line, "cpu_s");
        }
        ves_arena_destroy(&arena);
    }
}

typedef struct reading {
    const ves_suite *suite;
    ves_outcome *outcome;
    ves_status status;
} reading;

/* What one rank has left. */
static void read_back(ves_bench_files *files, int rank, void *data)
{
    reading *r = data;
    ves_arena arena = {0};
    const char *text = NULL, *clock = NULL, *path = lines_path(files, "runs", rank, &arena);
    ves_status status = load(path, &arena, &text, files->diag);
    if (status == VES_OK)
        status = load(lines_path(files, "times", rank, &arena), &arena, &clock, files->diag);
    if (status == VES_OK) {
        lines_read(files, r->suite, path, text, r->outcome);
        times_read(clock, ves_suite_runs(r->suite), r->outcome);
    }
    if (r->status == VES_OK) r->status = status;
    ves_arena_destroy(&arena);
}

ves_status ves_bench_files_gather(ves_bench_files *files, const ves_suite *suite, ves_outcome *outcome)
{
    reading r = {.suite = suite, .outcome = outcome};
    each_rank(files, read_back, &r);
    if (r.status == VES_OK) files->written = true; /* else sorting would lose what could not be read */
    return r.status;
}

static void tidy(const ves_bench_files *files)
{
    ves_arena arena = {0};
    char *journals = ves_folder_path(files->folder, "journals", &arena);
    ves_folder_tidy(files->folder, &arena);
    if (journals) ves_folder_tidy(journals, &arena);
    ves_arena_destroy(&arena);
}

ves_status ves_bench_files_again(ves_bench_files *files, const ves_suite *suite, ves_outcome *outcome)
{
    reading r = {.suite = suite, .outcome = outcome};
    VES_TRY(journals_open(files));
    tidy(files);
    read_back(files, 0, &r);
    VES_TRY(r.status);
    VES_TRY(ves_bench_files_gather(files, suite, outcome));
    VES_TRY(lines_sort(files, suite, outcome)); /* without what was cut off or damaged */
    files->written = false;
    return open_lines(files, "ab");
}

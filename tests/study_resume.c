/* Runs that are broken off and go on: the same bytes as without. */
#define _DEFAULT_SOURCE /* syscall */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include <errno.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fonts.h"
#include "slurp.h"
#include "study/entries.h"
#include "study/lock.h"
#include "study/run.h"

/* Of all tori, the Willmore energy is least for R = sqrt(2) r: 2 pi^2. A thin one needs fewer nodes: there are two
 * searches, the second on a finer grid. The constraint holds everywhere. */
#define TORUS                                                                                                \
    "vesica: 1\nvariables: {R: [1.1, 3, 5]}\npatches:\n  t:\n    surface: {formula: [\"(R + "                \
    "cos(u))*cos(v)\", \"(R + cos(u))*sin(v)\", \"sin(u)\"]}\n    domain: {u: [0, 2*pi], v: [0, 2*pi]}\n"    \
    "shape: {closed: true}\nmeasures: {hh: {integral: \"H^2\"}}\nmaximize: -hh\nconstraints: [hh >= 3]\n"    \
    "quadrature: auto\nsearch: [{anneal: {evaluations: 250}}, {polish: {}}]\n"

/* The file system's: some have no locks. */
static int no_locks;

int flock(int fd, int operation)
{
    if (!no_locks) return (int)syscall(SYS_flock, fd, operation);
    errno = no_locks;
    return -1;
}

static char root[400];

static void root_make(void)
{
    snprintf(root, sizeof root, "%s/test_resume.%ld", VESICA_BUILD, (long)getpid());
    cr_assert(mkdir(root, 0777) == 0);
}

static void root_remove(void)
{
    char command[500];
    snprintf(command, sizeof command, "rm -rf '%s'", root);
    cr_assert(system(command) == 0);
}

static const char *place(const char *folder, const char *name)
{
    static char path[8][600];
    static int turn;
    turn = (turn + 1) % 8;
    snprintf(path[turn], sizeof path[turn], "%s/%s%s%s", root, folder, *name ? "/" : "", name);
    return path[turn];
}

static void spill(const char *path, const char *text, size_t size)
{
    FILE *out = fopen(path, "wb");
    cr_assert(out != NULL && fwrite(text, 1, size, out) == size && fclose(out) == 0, "%s", path);
}

static size_t size_of(const char *path)
{
    struct stat there;
    return stat(path, &there) == 0 ? (size_t)there.st_size : 0;
}

/* --- runs --- */

typedef struct trial {
    ves_diag *diag;
    ves_problem *problem;
    ves_run *run;
    ves_status status;
} trial;

static trial run_text(const char *text, const ves_run_options *options, const ves_run_hooks *hooks)
{
    trial t = {.diag = ves_diag_create()};
    t.status = ves_problem_read_text("torus.yaml", text, strlen(text), NULL, &t.problem, t.diag);
    cr_assert(t.status == VES_OK);
    t.status = ves_run_create(t.problem, options, hooks, &t.run, t.diag);
    return t;
}

static void finish(trial *t)
{
    ves_run_destroy(t->run);
    ves_problem_destroy(t->problem);
    ves_diag_destroy(t->diag);
}

static ves_run_options options_of(const char *folder, int jobs)
{
    return (ves_run_options){
        .seeded = true, .seed = 7, .evaluations = 700, .jobs = jobs, .files = true, .out = place(folder, "")};
}

static void begin(const char *folder, int jobs)
{
    const ves_run_options options = options_of(folder, jobs);
    trial t = run_text(TORUS, &options, NULL);
    cr_assert(t.status == VES_OK && t.run->any && t.run->recalled == -1);
    finish(&t);
}

static trial resume(const char *folder, int jobs)
{
    ves_run_options options = options_of(folder, jobs);
    options.resume = true;
    return run_text(TORUS, &options, NULL);
}

static int said(const ves_diag *diag, const char *words)
{
    char text[2000];
    int count = 0;
    for (int k = 0; k < ves_diag_count(diag); k++) {
        ves_diag_text(diag, k, text, sizeof text);
        count += strstr(text, words) != NULL;
    }
    return count;
}

static void same(const char *a, const char *b, const char *name, const char *what)
{
    size_t size[2];
    char *text[2] = {slurp_bytes(place(a, name), &size[0]), slurp_bytes(place(b, name), &size[1])};
    cr_expect(size[0] == size[1] && !memcmp(text[0], text[1], size[0]), "%s: %s differs (%zu, %zu bytes)",
              what, name, size[0], size[1]);
    free(text[0]);
    free(text[1]);
}

static void same_run(const char *a, const char *b, const char *what)
{
    same(a, b, "result.json", what);
    same(a, b, "trace.jsonl", what);
    same(a, b, "journal", what);
    cr_expect(access(place(b, "journal.part"), F_OK) != 0 && access(place(b, "lock"), F_OK) != 0, "%s", what);
}

/* A folder as a kill may leave it: the journal as far as `size`, and a trace that is a little behind. */
static void killed(const char *whole, const char *folder, size_t size)
{
    static const char *const names[] = {"journal", "trace.jsonl", "problem.yaml"};
    size_t all;
    cr_assert(mkdir(place(folder, ""), 0777) == 0);
    for (int k = 0; k < 3; k++) {
        char *text = slurp_bytes(place(whole, names[k]), &all);
        size_t left = k == 0 ? size : k == 1 ? (size_t)((double)all * 0.9 * (double)size / 2e5) : all;
        spill(place(folder, names[k]), text, left < all ? left : all);
        free(text);
    }
}

static void remove_run(const char *folder)
{
    char command[700];
    snprintf(command, sizeof command, "rm -rf '%s'", place(folder, ""));
    cr_assert(system(command) == 0);
}

static void cut_and_resume(size_t size, int jobs)
{
    char what[80];
    snprintf(what, sizeof what, "cut at %zu, %d jobs", size, jobs);
    killed("whole", "cut", size);
    trial t = resume("cut", jobs);
    cr_assert(t.status == VES_OK, "%s: %s", what, ves_status_text(t.status));
    cr_expect(t.run->recalled >= 0 && t.run->recalled <= t.run->evaluations && !t.run->over, "%s", what);
    same_run("whole", "cut", what);
    finish(&t);
    remove_run("cut");
}

/* Where the frames of a journal end, the head first. */
static int frames_of(const char *path, size_t *end, int most)
{
    ves_arena arena = {0};
    ves_journal_head head;
    ves_frames frames;
    int count = 0;
    cr_assert(ves_journal_open(path, &arena, &head, &frames, NULL) == VES_OK);
    do end[count++] = frames.at;
    while (count < most && ves_frames_next(&frames));
    ves_frames_close(&frames);
    ves_arena_destroy(&arena);
    return count;
}

enum { FRAMES = 2000 };

Test(study_resume, killed_between_rounds, .timeout = 300)
{
    static size_t end[FRAMES];
    root_make();
    begin("whole", 1);
    int count = frames_of(place("whole", "journal"), end, FRAMES);
    cr_assert(count > 10 && count < FRAMES && end[count - 1] == size_of(place("whole", "journal")));
    for (int k = 0; k < count - 1; k += 1 + count / 8) cut_and_resume(end[k], 1 + k % 3);
    cut_and_resume(end[count - 2], 2);
    root_remove();
}

Test(study_resume, killed_within_rounds, .timeout = 300)
{
    root_make();
    begin("whole", 3);
    size_t all = size_of(place("whole", "journal"));
    for (size_t k = 0; k < 8; k++)
        cut_and_resume((k * 7919 + 13 * k * k) % (k < 3 ? 400 : all), 1 + (int)k % 3);
    root_remove();
}

/* Without the search: a journal that ends after any number of bytes tells the rounds that are whole, and no more;
 * with those behind them kept again it is what it was. */
Test(study_resume, a_journal_may_end_at_any_byte, .timeout = 300)
{
    static size_t end[FRAMES];
    static struct {
        char *bytes;
        size_t size;
        int stages;
    } block[FRAMES];
    ves_arena arena = {0};
    ves_journal_head head;
    ves_frames frames;
    size_t all, size, wrong = 0;
    int count = 0;
    root_make();
    begin("whole", 1);
    char *text = slurp_bytes(place("whole", "journal"), &all);
    cr_assert(ves_journal_open(place("whole", "journal"), &arena, &head, &frames, NULL) == VES_OK);
    for (end[0] = frames.at; ves_frames_next(&frames) && frames.frame.kind == VES_JOURNAL_WHOLE; count++) {
        block[count].size = frames.frame.size;
        block[count].stages = frames.frame.stages;
        block[count].bytes = memcpy(malloc(frames.frame.size), frames.block, frames.frame.size);
        end[count + 1] = frames.at;
    }
    ves_frames_close(&frames);
    cr_assert(mkdir(place("cut", ""), 0777) == 0);
    for (size_t cut = 0; cut <= all; cut += cut < 600 ? 1 : 23) {
        ves_arena scratch = {0};
        ves_journal j;
        const void *got;
        bool whole;
        int told = 0;
        spill(place("cut", "journal"), text, cut);
        cr_assert(ves_journal_reopen(&j, place("cut", ""), &head, &scratch, NULL) == VES_OK, "%zu", cut);
        for (; ves_journal_recall(&j, &got, &size, &whole); told++)
            wrong += !whole || size != block[told].size || memcmp(got, block[told].bytes, size) != 0;
        bool first = told == 0 || end[told] <= cut, last = told == count || end[told + 1] > cut;
        cr_expect(first && last, "%zu: %d", cut, told);
        for (int k = 0; k < count; k++)
            ves_journal_keep(&j, block[k].bytes, block[k].size, true, block[k].stages);
        cr_expect(j.stale == false && j.error == 0);
        ves_journal_end(&j, true);
        char *again = slurp_bytes(place("cut", "journal"), &size);
        wrong += size != all || memcmp(again, text, all) != 0;
        free(again);
        ves_arena_destroy(&scratch);
    }
    cr_expect(eq(sz, wrong, 0));
    for (int k = 0; k < count; k++) free(block[k].bytes);
    free(text);
    ves_arena_destroy(&arena);
    root_remove();
}

Test(study_resume, what_is_damaged_is_asked_again)
{
    static size_t end[FRAMES];
    root_make();
    begin("whole", 2);
    int count = frames_of(place("whole", "journal"), end, FRAMES);
    for (int k = 1; k < 5; k++) {
        int frame = k * (count - 2) / 5;
        size_t size;
        killed("whole", "cut", end[count - 1]);
        char *text = slurp_bytes(place("cut", "journal"), &size);
        text[end[frame] + (size_t)k * 5] ^= (char)(1 << k);
        spill(place("cut", "journal"), text, size);
        free(text);
        trial t = resume("cut", k % 3 + 1);
        cr_assert(t.status == VES_OK && t.run->recalled < t.run->evaluations);
        cr_expect(said(t.diag, "bytes") == 1, "nothing was said of what is dropped");
        same_run("whole", "cut", "damaged");
        finish(&t);
        remove_run("cut");
    }
    root_remove();
}

/* --- stopped --- */

typedef struct stopper {
    int asked, stop;
} stopper;

static bool stopped(void *data)
{
    stopper *s = data;
    return ++s->asked > s->stop;
}

Test(study_resume, stopped_in_the_middle_of_rounds, .timeout = 300)
{
    root_make();
    begin("whole", 2);
    int parts = 0;
    for (int k = 0; k < 9; k++) {
        char what[80];
        stopper s = {.stop = 3 + 41 * k};
        const ves_run_hooks hooks = {.stopped = stopped, .data = &s};
        ves_run_options options = options_of("cut", 1 + k % 2);
        trial t = run_text(TORUS, &options, &hooks);
        cr_assert(t.status == VES_OK);
        finish(&t);
        size_t part = size_of(place("cut", "journal.part"));
        parts += part > 0;
        snprintf(what, sizeof what, "stopped after %d, %zu bytes of parts", s.stop, part);
        if (k % 3 == 2 && part) cr_assert(truncate(place("cut", "journal.part"), (off_t)(part * 2 / 3)) == 0);
        t = resume("cut", 1 + k % 3);
        cr_assert(t.status == VES_OK, "%s", what);
        same_run("whole", "cut", what);
        finish(&t);
        remove_run("cut");
    }
    cr_expect(parts > 2, "%d runs left parts", parts);
    root_remove();
}

Test(study_resume, a_run_that_is_done_is_only_gone_through)
{
    root_make();
    begin("whole", 1);
    size_t size, later;
    struct stat before, after;
    char *times = slurp_bytes(place("whole", "times.json"), &size);
    stat(place("whole", "journal"), &before);
    trial t = resume("whole", 2);
    cr_assert(t.status == VES_OK && t.run->over && t.run->recalled == t.run->evaluations);
    cr_expect(t.run->any && t.run->feasible && t.run->ending != VES_ENDED_STOPPED);
    char *again = slurp_bytes(place("whole", "times.json"), &later);
    cr_expect(size == later && !memcmp(times, again, size));
    stat(place("whole", "journal"), &after);
    cr_expect(before.st_mtim.tv_sec == after.st_mtim.tv_sec &&
              before.st_mtim.tv_nsec == after.st_mtim.tv_nsec);
    free(times);
    free(again);
    finish(&t);
    /* unless its result is gone */
    char *want = slurp_bytes(place("whole", "result.json"), &size);
    remove(place("whole", "result.json"));
    t = resume("whole", 1);
    cr_assert(t.status == VES_OK && !t.run->over);
    char *got = slurp_bytes(place("whole", "result.json"), &later);
    cr_expect(size == later && !memcmp(want, got, size));
    free(want);
    free(got);
    finish(&t);
    root_remove();
}

/* --- journals of others --- */

static void refused(const char *text, uint64_t seed, const char *words)
{
    size_t size, later;
    char *before = slurp_bytes(place("whole", "journal"), &size);
    ves_run_options options = options_of("whole", 1);
    options.resume = true;
    options.seed = seed;
    trial t = run_text(text, &options, NULL);
    cr_expect(t.status == VES_STALE && t.run == NULL, "%s", words);
    cr_expect(said(t.diag, words) == 1, "not said: %s", words);
    char *after = slurp_bytes(place("whole", "journal"), &later);
    cr_expect(size == later && !memcmp(before, after, size), "the journal was touched");
    finish(&t);
    free(before);
    free(after);
}

Test(study_resume, a_journal_of_another_run_is_refused)
{
    root_make();
    begin("whole", 1);
    refused(TORUS "title: x\n", 7, "belongs to another problem than the problem.yaml beside it");
    refused(TORUS, 8, "(its \"seed\" is not the same)");
    /* another version */
    ves_arena arena = {0};
    ves_journal j;
    const ves_journal_head head = {1, 1, "{\"vesica\":\"99.0\",\"problem\":1}"};
    remove(place("whole", "journal"));
    cr_assert(ves_journal_create(&j, place("whole", ""), &head, &arena, NULL) == VES_OK);
    ves_journal_end(&j, false);
    refused(TORUS, 7, "was written by another version of vesica");
    ves_arena_destroy(&arena);
    /* no journal at all */
    spill(place("whole", "journal"), "vesica\r\nis no journal, but a text that is long enough for a head",
          64);
    ves_run_options options = options_of("whole", 1);
    options.resume = true;
    trial t = run_text(TORUS, &options, NULL);
    cr_expect(t.status == VES_STALE && t.run == NULL);
    finish(&t);
    root_remove();
}

/* --- two on one folder --- */

Test(study_resume, one_process_at_a_time)
{
    root_make();
    begin("whole", 1);
    int pipes[2];
    char byte, words[80];
    cr_assert(pipe(pipes) == 0);
    pid_t child = fork();
    if (!child) {
        ves_arena arena = {0};
        ves_lock lock;
        byte = ves_lock_take(&lock, place("whole", ""), &arena, NULL) == VES_OK;
        if (write(pipes[1], &byte, 1) == 1) pause();
        _exit(0);
    }
    cr_assert(read(pipes[0], &byte, 1) == 1 && byte == 1);
    trial t = resume("whole", 1);
    snprintf(words, sizeof words, "process %ld works in", (long)child);
    cr_expect(t.status == VES_USAGE && t.run == NULL && said(t.diag, words) == 1);
    finish(&t);
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    cr_expect(access(place("whole", "lock"), F_OK) == 0, "what a killed process leaves");
    t = resume("whole", 1);
    cr_expect(t.status == VES_OK && t.run && t.run->over);
    finish(&t);
    /* nor two runs of one process */
    ves_arena arena = {0};
    ves_lock first, second;
    cr_assert(ves_lock_take(&first, place("whole", ""), &arena, NULL) == VES_OK);
    cr_expect(ves_lock_take(&second, place("whole", ""), &arena, NULL) == VES_USAGE);
    ves_lock_drop(&first);
    cr_expect(access(place("whole", "lock"), F_OK) != 0);
    ves_arena_destroy(&arena);
    root_remove();
}

/* Network file systems without locks: a run goes on, but says that nothing guards its folder. */
Test(study_resume, a_folder_that_cannot_be_locked_is_told)
{
    static const int error[] = {ENOLCK, EOPNOTSUPP};
    root_make();
    begin("whole", 1);
    for (int k = 0; k < 2; k++) {
        no_locks = error[k];
        trial t = resume("whole", 1);
        cr_expect(t.status == VES_OK && t.run && t.run->over);
        cr_expect(said(t.diag, "cannot be locked") == 1 && said(t.diag, strerror(error[k])) == 1);
        cr_expect(said(t.diag, "See to it that no other process works in it") == 1);
        finish(&t);
    }
    no_locks = 0;
    trial t = resume("whole", 1);
    cr_expect(said(t.diag, "cannot be locked") == 0);
    finish(&t);
    root_remove();
}

/* --- disks --- */

/* In a child, whose files may have so many bytes at most. Its exit code: what went wrong, 0 nothing. */
static int within(rlim_t limit)
{
    pid_t child = fork();
    int status;
    if (child) {
        waitpid(child, &status, 0);
        return WIFEXITED(status) ? WEXITSTATUS(status) : 100;
    }
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &(struct rlimit){limit, limit});
    const ves_run_options options = options_of("full", 2);
    trial t = run_text(TORUS, &options, NULL);
    if (!t.run || t.status != VES_IO) _exit(1);
    if (!t.run->any || t.run->ending == VES_ENDED_STOPPED) _exit(2);
    if (said(t.diag, "/journal\": File too large. The search goes on") != 1) _exit(3);
    _exit(0);
}

Test(study_resume, a_full_disk_does_not_stop_the_search)
{
    root_make();
    begin("whole", 1);
    cr_expect(eq(int, within(6000), 0));
    cr_expect(size_of(place("full", "journal")) <= 6000);
    trial t = resume("full", 1); /* somebody has made room */
    cr_assert(t.status == VES_OK && t.run->recalled > 0);
    same_run("whole", "full", "full");
    finish(&t);
    root_remove();
}

static bool take_away(void *data)
{
    if (++*(int *)data == 90) remove_run("gone");
    return false;
}

Test(study_resume, a_folder_that_vanishes_does_not_stop_the_search)
{
    root_make();
    int asked = 0;
    const ves_run_hooks hooks = {.stopped = take_away, .data = &asked};
    const ves_run_options options = options_of("gone", 1);
    trial t = run_text(TORUS, &options, &hooks);
    cr_assert(t.run != NULL && t.status == VES_IO);
    cr_expect(t.run->any && asked > 90);
    cr_expect(eq(int, said(t.diag, "/journal\": No such file or directory. The search goes on"), 1));
    finish(&t);
    root_remove();
}

/* --- reading --- */

Test(study_resume, a_journal_tells_what_a_trace_of_all_tells)
{
    root_make();
    ves_run_options options = options_of("whole", 2);
    options.trace = VES_TRACE_ALL;
    trial t = run_text(TORUS, &options, NULL);
    ves_arena arena = {0};
    ves_entries entries;
    ves_entry e;
    size_t size;
    char *text = slurp_bytes(place("whole", "trace.jsonl"), &size), *line = text;
    cr_assert(ves_entries_open(&entries, place("whole", ""), &arena, NULL) == VES_OK);
    cr_assert(entries.n == 1 && entries.m == 1 && !strcmp(entries.variable[0], "R"));
    cr_expect(eq(str, (char *)entries.constraint[0], "hh >= 3"));
    long stages = 0;
    for (; ves_entries_next(&entries, &e); line += strcspn(line, "\n") + 1) {
        char want[300];
        int at =
            snprintf(want, sizeof want,
                     "{\"evaluation\":%ld,\"stage\":%d,\"chain\":%d,\"x\":[%.17g],\"value\":", e.evaluation,
                     e.stage, e.chain, e.x[0]);
        if (e.status == VES_OK)
            snprintf(want + at, sizeof want - (size_t)at, "%.17g,\"violation\":%.9g,", e.value, e.violation);
        cr_assert(strncmp(line, want, strlen(want)) == 0, "want %s\ngot %.300s", want, line);
        const char *accepted = strstr(line, "\"accepted\":true");
        cr_assert(e.accepted == (accepted && accepted < line + strcspn(line, "\n")));
        if (e.excess) cr_assert(e.excess[0] <= e.violation + 1e-15 && e.value < -19);
        stages = e.stage;
    }
    cr_expect(strlen(line) == 0 && entries.evaluation == t.run->evaluations);
    bool again = false;
    for (int k = 0; k < t.run->notes; k++) again = again || strstr(t.run->note[k], "polished once more");
    cr_expect(again && stages >= 1, "one search only, %ld stages", stages);
    cr_expect(eq(long, ves_entries_torn(&entries), 0));
    ves_entries_close(&entries);
    ves_arena_destroy(&arena);
    free(text);
    finish(&t);
    root_remove();
}

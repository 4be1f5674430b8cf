/* Runs and their folders. */
#include <criterion/criterion.h>
#include <criterion/new/assert.h>

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include <dirent.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "fonts.h"
#include "problem/tree.h"
#include "slurp.h"
#include "study/folder.h"
#include "study/open.h"
#include "study/run.h"

static const double PI = 3.14159265358979323846;

/* --- places and files --- */

static char root[512];

static void root_make(void)
{
    snprintf(root, sizeof root, "%s/test_study.%ld", VESICA_BUILD, (long)getpid());
    mkdir(root, 0777);
}

static void root_remove(void)
{
    char command[600];
    snprintf(command, sizeof command, "rm -rf '%s'", root);
    cr_assert(system(command) == 0);
}

static const char *place(const char *name)
{
    static char path[4][700];
    static int turn;
    turn = (turn + 1) % 4;
    snprintf(path[turn], sizeof path[turn], "%s/%s", root, name);
    return path[turn];
}

static bool same_file(const char *folder_a, const char *folder_b, const char *name)
{
    char path[2][900];
    size_t length[2];
    snprintf(path[0], sizeof path[0], "%s/%s", folder_a, name);
    snprintf(path[1], sizeof path[1], "%s/%s", folder_b, name);
    char *text[2] = {slurp_bytes(path[0], &length[0]), slurp_bytes(path[1], &length[1])};
    bool same = length[0] == length[1] && !memcmp(text[0], text[1], length[0]);
    free(text[0]);
    free(text[1]);
    return same;
}

static bool exists(const char *folder, const char *name)
{
    char path[900];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return access(path, F_OK) == 0;
}

/* --- problems --- */

/* Two discs and a wall: V = pi r^2 h, A = 2 pi r (r + h). The largest volume of area 3 pi is pi / sqrt 2 at
 * r = 1 / sqrt 2. */
#define BOTTLE                                                                                               \
    "vesica: 1\n"                                                                                            \
    "title: bottle\n"                                                                                        \
    "variables: {r: [0.2, 0.5, 1.1], h: [0.2, 1.0, 4.0]}\n"                                                  \
    "curves:\n"                                                                                              \
    "  floor: {point: [0, 0, 0]}\n"                                                                          \
    "  lid: {point: [0, 0, h]}\n"                                                                            \
    "  low: {circle: {radius: r}}\n"                                                                         \
    "  high: {like: low, apply: [{translate: [0, 0, h]}]}\n"                                                 \
    "patches:\n"                                                                                             \
    "  base: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: floor}, {u: 1, position: low}]}\n"   \
    "  wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: high}]}\n"    \
    "  top: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: high}, {u: 1, position: lid}]}\n"     \
    "shape: {closed: true}\n"                                                                                \
    "maximize: volume\n"                                                                                     \
    "constraints: [area == 3*pi]\n"

/* A cylinder of radius 1 and height 2. */
#define TUBE                                                                                                 \
    "vesica: 1\n"                                                                                            \
    "title: tube\n"                                                                                          \
    "curves:\n"                                                                                              \
    "  low: {circle: {radius: 1}}\n"                                                                         \
    "  high: {like: low, apply: [{translate: [0, 0, 2]}]}\n"                                                 \
    "patches:\n"                                                                                             \
    "  wall: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: low}, {u: 1, position: high}]}\n"

typedef struct trial {
    ves_diag *diag;
    ves_problem *problem;
    ves_run *run;
    ves_status status;
} trial;

static void speak(const ves_diag *diag)
{
    char text[2000];
    for (int k = 0; k < ves_diag_count(diag); k++) {
        ves_diag_text(diag, k, text, sizeof text);
        cr_log_error("%s", text);
    }
}

static trial run_with(const char *text, const ves_run_options *options, const ves_run_hooks *hooks)
{
    trial t = {.diag = ves_diag_create()};
    t.status = ves_problem_read_text("test.yaml", text, strlen(text), NULL, &t.problem, t.diag);
    if (t.status != VES_OK) speak(t.diag);
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

static bool said(const ves_diag *diag, const char *words)
{
    char text[2000];
    for (int k = 0; k < ves_diag_count(diag); k++) {
        ves_diag_text(diag, k, text, sizeof text);
        if (strstr(text, words)) return true;
    }
    return false;
}

static void near(double got, double want, double tolerance, const char *what)
{
    cr_assert(fabs(got - want) <= tolerance, "%s: got %.17g, want %.17g", what, got, want);
}

/* A number of result.json, by a path of keys. */
static double number_at(const ves_node *node, const char *path)
{
    char copy[100], *rest = copy;
    snprintf(copy, sizeof copy, "%s", path);
    for (char *dot; node && rest; rest = dot) {
        dot = strchr(rest, '.');
        if (dot) *dot++ = 0;
        node = node->kind == VES_NODE_LIST ? node->item[atoi(rest)] : ves_node_find(node, rest);
    }
    cr_assert(node && node->kind == VES_NODE_WORD, "no \"%s\"", path);
    return strtod(node->text, NULL);
}

static const ves_node *json_read(const char *folder, const char *name, ves_arena *arena)
{
    char path[900];
    size_t length;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    char *text = slurp_bytes(path, &length);
    const char *kept = ves_arena_text(arena, text, length);
    const ves_node *node = NULL;
    ves_script *script = ves_arena_take(arena, 1, sizeof *script);
    free(text);
    cr_assert(ves_script_init(script, kept, length, arena) == VES_OK);
    cr_assert(ves_tree_read(script, arena, &node, NULL) == VES_OK, "%s cannot be parsed", path);
    return node;
}

/* --- the result --- */

Test(study, same_seed_same_bytes_for_any_number_of_jobs)
{
    static const int jobs[] = {1, 1, 2, 3};
    root_make();
    for (int k = 0; k < 4; k++) {
        char name[32];
        snprintf(name, sizeof name, "jobs%d", k);
        ves_run_options options = {.seeded = true,
                                   .seed = 7,
                                   .evaluations = 1200,
                                   .jobs = jobs[k],
                                   .files = true,
                                   .out = place(name)};
        trial t = run_with(BOTTLE, &options, NULL);
        cr_assert(t.status == VES_OK);
        cr_assert(eq(int, t.run->jobs, jobs[k]));
        cr_assert(same_file(place("jobs0"), t.run->folder, "result.json"), "result.json differs for %d jobs",
                  jobs[k]);
        cr_assert(same_file(place("jobs0"), t.run->folder, "trace.jsonl"), "trace.jsonl differs for %d jobs",
                  jobs[k]);
        finish(&t);
    }
    root_remove();
}

Test(study, the_best_bottle_is_that_of_the_closed_form)
{
    root_make();
    ves_arena arena = {0};
    ves_run_options options = {.evaluations = 4000, .jobs = 1, .files = true, .out = place("bottle")};
    trial t = run_with(BOTTLE, &options, NULL);
    cr_assert(t.status == VES_OK);
    const ves_run *run = t.run;
    cr_assert(run->any && run->feasible && run->searched && run->ending != VES_ENDED_STOPPED);
    /* the constraint may be off by 1e-6 of its size, which moves the volume by as much */
    near(run->best.objective, PI / sqrt(2), 5e-6, "volume, with its own sign");
    /* polynomials are integrated exactly: rounding */
    near(run->start.objective, PI / 4, 1e-12, "volume of the start");
    near(run->start.violation, 0.5, 1e-12, "1.5 pi instead of 3 pi");
    cr_assert(run->best.violation <= 1e-6, "violation %g", run->best.violation); /* VES_FEASIBLE */
    cr_assert(run->finer_change < 1e-12, "the quadrature of a polynomial is exact, changed by %g",
              run->finer_change);
    const ves_node *json = json_read(run->folder, "result.json", &arena);
    cr_assert(number_at(json, "objective") == run->best.objective, "read back exactly");
    cr_assert(number_at(json, "variables.r") == run->best.x[0]);
    cr_assert(number_at(json, "measures.volume") == run->best.objective);
    cr_assert(number_at(json, "constraints.0.limit") == 3 * PI);
    cr_assert(number_at(json, "evaluations") == (double)run->evaluations);
    cr_assert(number_at(json, "optima.0.value") > 0, "the file's sign");
    cr_assert(number_at(json, "start.violation") == run->start.violation);
    near(number_at(json, "joints.0.angle_deg"), 90, 1e-12, "the floor stands on the wall");
    cr_assert(number_at(json, "joints.1.gap") == run->joint[1].gap);
    ves_arena_destroy(&arena);
    finish(&t);
    root_remove();
}

Test(study, the_trace_has_a_line_for_each_evaluation)
{
    root_make();
    size_t length;
    ves_run_options options = {
        .evaluations = 500, .jobs = 2, .files = true, .trace = VES_TRACE_ALL, .out = place("traced")};
    trial t =
        run_with(BOTTLE "search: [{anneal: {}}, {polish: {}}]\n", &options, NULL); /* candidates are cut */
    char *text = slurp_bytes(place("traced/trace.jsonl"), &length);
    cr_expect(t.run->temperatures > 0);
    long lines = 0, failed = 0, cut = 0;
    double best = 0;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n"), lines++) {
        double value, violation;
        const char *at = strstr(line, "\"value\":");
        cr_assert(at && strstr(line, "\"x\":["), "line %ld: %s", lines + 1, line);
        if (sscanf(at, "\"value\":%lf,\"violation\":%lf", &value, &violation) != 2)
            *(strstr(line, "\"CUT\"") ? &cut : &failed) += 1;
        else if (violation <= 1e-6 && value > best)
            best = value;
    }
    cr_assert(lines == t.run->evaluations, "%ld lines, %ld evaluations", lines, t.run->evaluations);
    /* a violation within 1e-6 of the area buys as much of the volume */
    near(best, t.run->best.objective, 5e-6, "the best of the trace, with the file's sign");
    long counted = 0;
    for (int k = 0; k < t.run->failures; k++) counted += t.run->failure[k].count;
    cr_assert(failed == counted && cut > 0, "%ld failed in the trace, %ld counted, %ld cut", failed, counted,
              cut);
    free(text);
    finish(&t);
    root_remove();
}

/* By what they are, not by who spoke last: a portfolio and a polish have many voices, a short stage has none. */
Test(study, stages_are_named_by_their_kind)
{
    static const struct {
        const char *search;
        long evaluations;
        const char *name[3];
    } list[] = {{"", 400, {"auto", "polish"}},
                {"", 2, {"auto"}},
                {"search: [{auto: {}}]\n", 400, {"auto"}},
                {"search: [{anneal: {polish: stages}}]\n", 900, {"anneal"}},
                {"search: [{anneal: {}}, {polish: {algorithm: cobyla}}]\n", 400, {"anneal", "polish"}}};
    for (size_t k = 0; k < sizeof list / sizeof *list; k++) {
        char text[4000];
        snprintf(text, sizeof text, "%s%s", BOTTLE, list[k].search);
        const ves_run_options options = {.evaluations = list[k].evaluations, .jobs = 1};
        trial t = run_with(text, &options, NULL);
        const ves_run_times *times = &t.run->times;
        cr_expect(times->stages >= 1, "%zu: no stages", k);
        for (int s = 0; s < times->stages && s < 3 && list[k].name[s]; s++)
            cr_expect(strcmp(times->stage[s].name, list[k].name[s]) == 0, "%zu: stage %d is called \"%s\"", k,
                      s, times->stage[s].name);
        finish(&t);
    }
}

Test(study, a_problem_without_variables_is_measured_once)
{
    trial t = run_with(
        TUBE "measures: {area: area, height: {extent: {along: [0, 0, 1]}}}\n"
             "expect: [abs(area - 4*pi) < 1e-9, height == 3, feasible, evaluations == 1, gradients == 0]\n",
        &(ves_run_options){0}, NULL);
    cr_assert(t.status == VES_OK);
    cr_assert(t.run->searched == false && t.run->any && t.run->feasible);
    cr_assert(eq(str, (char *)t.run->stop, "nothing to vary"));
    cr_assert(t.run->evaluations == 1 && t.run->gradients == 0);
    cr_assert(eq(int, t.run->expects, 5));
    static const bool want[] = {true, false, true, true, true};
    for (int k = 0; k < 5; k++) cr_assert(t.run->expect[k].passed == want[k], "%s", t.run->expect[k].text);
    cr_assert(t.run->passed == false);
    cr_assert(t.run->folder == NULL);
    finish(&t);
}

Test(study, what_is_wrong_with_a_design_is_a_note)
{
    trial t = run_with(TUBE "expect: [area > 0]\n", &(ves_run_options){0}, NULL);
    cr_assert(t.run->feasible && t.run->notes == 0);
    finish(&t);
    t = run_with(TUBE "quadrature: {u: 8, v: 8}\nmeasures: {m: {max: {of: log(z - 9)}}}\nexpect: [m > 0]\n",
                 &(ves_run_options){0}, NULL);
    cr_assert(t.run && t.run->notes == 1);
    cr_assert(eq(str, (char *)t.run->note[0],
                 "the start design cannot be measured: a measure is not a finite number"));
    finish(&t);
}

Test(study, a_test_run_has_its_own_budget_and_checks)
{
    static const char text[] = BOTTLE "expect: [evaluations < 0]\ntest: {evaluations: 300, expect: "
                                      "[evaluations <= 300, volume > 1, optima >= 1]}\n";
    trial t = run_with(text, &(ves_run_options){.test = true, .jobs = 1}, NULL);
    cr_assert(t.run->expects == 3 && t.run->passed);
    finish(&t);
    t = run_with(text, &(ves_run_options){.evaluations = 200, .jobs = 1}, NULL);
    cr_assert(t.run->expects == 1 && !t.run->passed);
    finish(&t);
}

Test(study, a_given_quadrature_is_used_and_an_unsettled_one_is_told)
{
    trial t = run_with(TUBE "quadrature: {u: 24, v: 40}\nexpect: [area > 0]\n", &(ves_run_options){0}, NULL);
    cr_assert(t.run->quadrature[0] == 24 && t.run->quadrature[1] == 40);
    cr_assert(isnan(t.run->change), "nothing was chosen");
    finish(&t);
    t = run_with(TUBE "expect: [area > 0]\n", &(ves_run_options){0}, NULL);
    cr_assert(t.run->quadrature[0] > 0 && t.run->change < 1e-9);
    finish(&t);
}

/* Frustums over the unit disc: area pi (1 + q) sqrt((1 - q)^2 + h^2) is least for the cone, q = 0, where the
 * range of the radius ends. */
Test(study, a_search_goes_round_numbers_that_leave_their_range)
{
    trial t =
        run_with("vesica: 1\nvariables: {r: [0.2, 1.4, 2]}\n"
                 "curves: {p: {circle: {radius: 1}}, q: {circle: {radius: r - 0.5, centre: [0, 0, 1.5]}}}\n"
                 "patches: {w: {operator: {power: 1, a: 0}, conditions: [{u: 0, position: p}, {u: 1, "
                 "position: q}]}}\n"
                 "minimize: area\n",
                 &(ves_run_options){.evaluations = 1000, .seeded = true, .seed = 3}, NULL);
    cr_assert(t.status == VES_OK && t.run->any && t.run->feasible);
    long outside = 0;
    for (int k = 0; k < t.run->failures; k++)
        if (t.run->failure[k].status == VES_OUTSIDE) outside = t.run->failure[k].count;
    cr_expect(outside > 0, "no candidate was outside");
    cr_expect(t.run->best.x[0] >= 0.5);
    near(t.run->best.objective, PI * sqrt(1 + 1.5 * 1.5), 1e-4, "area"); /* its slope there is 3.9 */
    finish(&t);
}

Test(study, a_start_whose_root_lies_outside_is_told_with_its_place)
{
    trial t = run_with(
        TUBE "  cone: {operator: {power: 1, a: h - 0.5}, conditions: [{u: 0, position: high}, {u: 1, "
             "position: low}]}\nsolve: {unknown: h, in: [0.25, 1.5], equation: area + h == 26}\n",
        &(ves_run_options){.once = true}, NULL);
    cr_assert(t.status == VES_OK && t.run->start.status == VES_OUTSIDE);
    cr_expect(said(t.diag,
                   "test.yaml:8:34: warning: the start design cannot be measured: \"a\" must be in [0, "
                   "1000000], got -0.25, with h = 0.25"));
    finish(&t);
}

/* --- stopping --- */

static bool after_some(void *data)
{
    return ++*(int *)data > 300;
}

Test(study, an_interrupted_run_keeps_the_best_so_far)
{
    root_make();
    int asked = 0;
    ves_run_hooks hooks = {.stopped = after_some, .data = &asked};
    ves_run_options options = {.evaluations = 1000000, .jobs = 1, .files = true, .out = place("stopped")};
    trial t = run_with(BOTTLE, &options, &hooks);
    cr_assert(t.status == VES_OK && t.run->ending == VES_ENDED_STOPPED);
    cr_assert(t.run->any && t.run->evaluations < 1000, "%ld evaluations", t.run->evaluations);
    static const char *const files[] = {"problem.yaml", "result.json", "times.json", "trace.jsonl",
                                        "log.txt",      "best.vtp",    "start.vtp",  "best.png"};
    for (size_t k = 0; k < sizeof files / sizeof *files; k++)
        cr_assert(exists(t.run->folder, files[k]), "%s is missing", files[k]);
    finish(&t);
    root_remove();
}

/* --- folders --- */

Test(study, numbers_go_on_after_the_highest)
{
    static const char *const there[] = {"x-0003", "x-0007",  "x-abc",  "x-y-0050",
                                        "x-00",   "xy-0099", "x-0012z"};
    root_make();
    ves_arena arena = {0};
    char *folder;
    for (size_t k = 0; k < sizeof there / sizeof *there; k++) mkdir(place(there[k]), 0777);
    cr_assert(ves_folder_number(root, "x", &arena, &folder, NULL) == VES_OK);
    cr_assert(eq(str, folder, (char *)place("x-0008")));
    cr_assert(ves_folder_number(place("a/b/c"), "x", &arena, &folder, NULL) == VES_OK);
    cr_assert(eq(str, folder, (char *)place("a/b/c/x-0001")));
    ves_arena_destroy(&arena);
    root_remove();
}

enum { MAKERS = 4, EACH = 40 };

static void make_many(void)
{
    for (int k = 0; k < EACH; k++) {
        ves_arena arena = {0};
        char *folder, mine[800];
        if (ves_folder_number(place("shared"), "run", &arena, &folder, NULL) != VES_OK) _exit(1);
        snprintf(mine, sizeof mine, "%s/mine", folder);
        FILE *out = fopen(mine, "wx"); /* fails in a folder that somebody else has got too */
        if (!out) _exit(2);
        fclose(out);
        ves_arena_destroy(&arena);
    }
    _exit(0);
}

Test(study, processes_never_share_a_folder)
{
    root_make();
    pid_t child[MAKERS];
    for (int k = 0; k < MAKERS; k++)
        if (!(child[k] = fork())) make_many();
    for (int k = 0; k < MAKERS; k++) {
        int status;
        waitpid(child[k], &status, 0);
        cr_assert(eq(int, status, 0), "maker %d: status %d", k, status);
    }
    cr_assert(exists(root, "shared/run-0160/mine"), "numbers have no holes");
    root_remove();
}

Test(study, nothing_is_overwritten)
{
    root_make();
    mkdir(place("full"), 0777);
    fclose(fopen(place("full/thing"), "w"));
    fclose(fopen(place("file"), "w"));
    mkdir(place("empty"), 0777);
    static const char *const name[] = {"full", "file", "empty", "new/below"};
    for (int k = 0; k < 4; k++) {
        ves_run_options options = {.files = true, .out = place(name[k])};
        trial t = run_with(TUBE "expect: [area > 0]\n", &options, NULL);
        cr_assert(eq(int, t.status, k < 2 ? VES_USAGE : VES_OK));
        cr_assert(eq(int, t.run != NULL, k >= 2), "%s", name[k]);
        finish(&t);
    }
    ves_arena arena = {0};
    cr_assert(eq(str, ves_folder_free(place("shape"), "vtp", &arena), (char *)place("shape.vtp")));
    fclose(fopen(place("shape.vtp"), "w"));
    cr_assert(eq(str, ves_folder_free(place("shape"), "vtp", &arena), (char *)place("shape-2.vtp")));
    ves_arena_destroy(&arena);
    root_remove();
}

Test(study, a_folder_that_cannot_be_made_is_told_before_the_search)
{
    root_make();
    fclose(fopen(place("file"), "w"));
    ves_run_options options = {.evaluations = 300, .jobs = 1, .files = true, .parent = place("file/runs")};
    trial t = run_with(BOTTLE, &options, NULL);
    cr_assert(eq(int, t.status, VES_IO));
    cr_assert(said(t.diag, "cannot make the folder"));
    cr_assert(t.run == NULL);
    finish(&t);
    root_remove();
}

/* A file size limit stands for a full disk. */
Test(study, the_result_survives_a_full_disk)
{
    root_make();
    ves_run_options options = {.evaluations = 2000, .jobs = 1, .files = true, .out = place("full")};
    struct rlimit little = {20000, 20000};
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &little);
    trial t = run_with(BOTTLE, &options, NULL);
    cr_assert(eq(int, t.status, VES_IO));
    cr_assert(said(t.diag, "trace.jsonl") && said(t.diag, "best.vtp"));
    cr_assert(t.run && t.run->feasible);
    cr_assert(exists(t.run->folder, "best.vtp") == false, "half a file was left");
    cr_assert(exists(t.run->folder, "result.json"), "what fits is kept");
    finish(&t);
    root_remove();
}

/* --- opening --- */

static ves_status open_run(const char *path, const char *start, ves_opened *opened, ves_diag *diag)
{
    ves_open_options options = {.start = start};
    return ves_study_open(path, &options, opened, diag);
}

Test(study, a_run_folder_opens_at_its_best)
{
    static const char *const text[] = {
        BOTTLE,
        "vesica: 1\n"
        "variables: {r: [20 mm, 31.7 mm, 80 mm], tilt: [-20 deg, 3 deg, 20 deg]}\n"
        "curves:\n"
        "  low: {circle: {radius: r}}\n"
        "  high: {circle: {radius: 0.05 m}, apply: [{rotate: [tilt, 0, 0]}, {translate: [0 m, 0 m, 0.1 "
        "m]}]}\n"
        "patches:\n"
        "  wall: {operator: {power: 1, a: 1}, conditions: [{u: 0, position: low}, {u: 1, position: high}]}\n"
        "minimize: area\n"};
    root_make();
    for (int k = 0; k < 2; k++) {
        ves_opened opened;
        ves_run_options options = {
            .evaluations = 700, .jobs = 1, .files = true, .parent = root, .name = "cup"};
        trial t = run_with(text[k], &options, NULL);
        cr_assert(t.status == VES_OK);
        ves_status status = open_run(t.run->folder, NULL, &opened, t.diag);
        if (status != VES_OK) speak(t.diag);
        cr_assert(eq(int, status, VES_OK));
        cr_assert(eq(str, (char *)opened.name, k ? "cup-0002" : "cup-0001"));
        for (int i = 0; i < 2; i++)
            cr_assert(opened.problem->variable[i].start == t.run->best.x[i], "%s: %.17g, want %.17g",
                      opened.problem->variable[i].name, opened.problem->variable[i].start, t.run->best.x[i]);
        ves_study_close(&opened);
        finish(&t);
    }
    root_remove();
}

Test(study, a_start_needs_a_variable_in_common)
{
    root_make();
    ves_opened opened;
    trial t = run_with(
        BOTTLE, &(ves_run_options){.evaluations = 100, .jobs = 1, .files = true, .out = place("run")}, NULL);
    FILE *out = fopen(place("other.yaml"), "w");
    fputs("vesica: 1\nvariables: {r: [0.1, 2, 3], s: [1, 2, 3], t: [1, 2, 3]}\n"
          "curves: {p: {circle: {radius: r}}, q: {circle: {radius: s, centre: [0, 0, t]}}}\n"
          "patches: {w: {operator: {power: 1}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"
          "minimize: area\n",
          out);
    fclose(out);
    cr_assert(open_run(place("other.yaml"), place("run"), &opened, t.diag) == VES_OK);
    cr_assert(said(t.diag, "note: the run \""));
    cr_assert(said(t.diag, "no variable \"s\", \"t\": they stand at the start that the file gives"));
    const ves_variable *v = opened.problem->variable;
    cr_assert(v[0].start == t.run->best.x[0] && v[1].start == 2 && v[2].start == 2, "%g %g %g", v[0].start,
              v[1].start, v[2].start);
    ves_study_close(&opened);
    out = fopen(place("strange.yaml"), "w");
    fputs("vesica: 1\nvariables: {s: [1, 2, 3], t: [1, 2, 3]}\n"
          "curves: {p: {circle: {radius: s}}, q: {circle: {radius: s, centre: [0, 0, t]}}}\n"
          "patches: {w: {operator: {power: 1}, conditions: [{u: 0, position: p}, {u: 1, position: q}]}}\n"
          "minimize: area\n",
          out);
    fclose(out);
    cr_assert(open_run(place("strange.yaml"), place("run"), &opened, t.diag) == VES_NAME);
    cr_assert(said(t.diag, "has none of the variables of the problem: \"s\", \"t\""));
    cr_assert(open_run(place("other.yaml"), root, &opened, t.diag) == VES_IO);
    cr_assert(said(t.diag, "is not the folder of a finished run"));
    cr_assert(open_run(root, NULL, &opened, t.diag) == VES_IO);
    finish(&t);
    root_remove();
}

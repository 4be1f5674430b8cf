/* The text of a problem file: --set written into it, strange bytes, files that cannot be read, memory that
 * runs out. */
#include <criterion/criterion.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "memory.h"
#include "problem/problem.h"

#define CURVES "curves: {p1: {circle: {radius: 1}}, p2: {circle: {radius: 2}}}\n"
#define PATCHES                                                                                              \
    "patches: {wall: {operator: {power: 1}, conditions: [{u: 0, position: p1}, {u: 1, position: p2}]}}\n"
#define BASE "vesica: 1\n" CURVES PATCHES

static const char sample[] = "# head\n"
                             "vesica: 1\n"
                             "title: A tube   # said here\n"
                             "parameters: {gap: 2, half: gap/2}   # two\n"
                             "variables:\n"
                             "  a: [0.01, 0.5, 9]   # smooth\n"
                             "  b:\n"
                             "    - 1\n"
                             "    - 2\n"
                             "    - 3\n"
                             "vary: {p2: [T]}\n"
                             "curves:\n"
                             "  p1: &one {circle: {radius: 1}}\n"
                             "  p2: {circle: {radius: b}, apply: [{translate: [0, 0, gap]}]}\n"
                             "  p3: *one\n"
                             "patches:\n"
                             "  wall:\n"
                             "    operator: {power: 1, a: a}\n"
                             "    conditions: [{u: 0, position: p1}, {u: 1, position: p2}]   # ends\n"
                             "minimize: area\n";

typedef struct outcome {
    ves_status status;
    ves_problem *problem;
    char message[3000]; /* the first one */
} outcome;

static outcome set(const char *text, int count, const ves_override *override)
{
    outcome o = {.problem = NULL};
    ves_diag *diag = ves_diag_create();
    const ves_read_options options = {.overrides = count, .override = override};
    o.status = ves_problem_read_text("sample.yaml", text, strlen(text), &options, &o.problem, diag);
    if (ves_diag_count(diag)) ves_diag_text(diag, 0, o.message, sizeof o.message);
    ves_diag_destroy(diag);
    return o;
}

/* One --set changes this line of the text to that, and nothing else. */
static void expect_change(const char *name, const char *value, const char *line, const char *changed)
{
    const ves_override override = {name, value};
    outcome o = set(sample, 1, &override);
    cr_assert(o.status == VES_OK, "%s=%s: %s", name, value, o.message);
    char want[3000];
    const char *at = strstr(sample, line);
    cr_assert(at != NULL);
    snprintf(want, sizeof want, "%.*s%s%s", (int)(at - sample), sample, changed, at + strlen(line));
    cr_expect(!strcmp(o.problem->text, want), "%s=%s:\n%s", name, value, o.problem->text);
    ves_problem_destroy(o.problem);
}

Test(problem_text, set_changes_the_value_and_keeps_all_else)
{
    static const char *const row[][4] = {
        {"gap", "3", "gap: 2,", "gap: 3,"},
        {"half", "2*gap", "half: gap/2", "half: '2*gap'"},
        {"half", "max(gap, 3)", "half: gap/2", "half: 'max(gap, 3)'"},
        {"a", "1.5", "[0.01, 0.5, 9]", "[0.01, 1.5, 9]"},
        {"a", "[0, 1, 2]", "[0.01, 0.5, 9]", "[0, 1, 2]"},
        {"b", "2.5", "- 2\n", "- 2.5\n"},
        {"title", "It's: here # now", "A tube ", "'It''s: here # now' "},
        {"patches.wall.operator.a", "0", "a: a}", "a: 0}"},
        {"patches.wall.conditions.1.position", "p3", "u: 1, position: p2", "u: 1, position: p3"},
        {"patches.wall.operator.power", "1", "power: 1", "power: 1"},
        {"curves.p3", "{circle: 4}", "*one", "{circle: 4}"},
        {"minimize", "area + bending", "minimize: area\n", "minimize: area + bending\n"},
        {"p2Tx", "0.25", "# head\n", "# head\nstart: {p2Tx: 0.25}\n"},
        {"seed", "7", "# head\n", "# head\nseed: 7\n"},
        {"patches.wall.modes", "4", "  wall:\n    ", "  wall:\n    modes: 4\n    "},
        {"curves.p1.circle.axis", "[0, 1, 0]", "{radius: 1}", "{axis: [0, 1, 0], radius: 1}"},
        {"validity.self_intersection", "never", "# head\n", "# head\nvalidity: {self_intersection: never}\n"},
        {"validity.least_radius.value", "0.1", "# head\n",
         "# head\nvalidity: {least_radius: {value: 0.1}}\n"},
        {"quadrature.u", "8", "# head\n", "# head\nquadrature: {u: 8}\n"},
        {"test.evaluations", "8", "# head\n", "# head\ntest: {evaluations: 8}\n"},
        {"start.a", "2", "# head\n", "# head\nstart: {a: 2}\n"},
    };
    for (size_t k = 0; k < sizeof row / sizeof *row; k++)
        expect_change(row[k][0], row[k][1], row[k][2], row[k][3]);
}

Test(problem_text, set_fills_a_section_that_is_empty)
{
    static const char *const section[] = {"validity:\n", "validity: {}\n", "validity:   # none\n",
                                          "validity: {jacobian: any}\n", "validity:\n  jacobian: any\n"};
    const ves_override list[] = {{"validity.self_intersection", "never"},
                                 {"validity.least_radius.value", "0.25"}};
    for (size_t k = 0; k < sizeof section / sizeof *section; k++) {
        char text[1000];
        snprintf(text, sizeof text, "%s%s", BASE, section[k]);
        outcome o = set(text, 2, list);
        cr_assert(o.status == VES_OK, "%s: %s", section[k], o.message);
        cr_expect(!o.problem->validity.self_intersection && o.problem->validity.least_radius >= 0, "%s: %s",
                  section[k], o.problem->text);
        ves_problem_destroy(o.problem);
    }
}

Test(problem_text, several_sets_meet_in_one_text)
{
    const ves_override list[] = {{"gap", "30"},
                                 {"gap", "4"},
                                 {"p2Tx", "0.25"},
                                 {"p2Ty", "0.5"},
                                 {"p2Tx", "-1"},
                                 {"a", "[1, 2, 3]"},
                                 {"a", "2.5"},
                                 {"seed", "12"},
                                 {"title", "new"},
                                 {"search", "[{anneal: {evaluations: 3}}]"},
                                 {"search.0.anneal.evaluations", "99"}};
    outcome o = set(sample, sizeof list / sizeof *list, list);
    cr_assert(o.status == VES_OK, "%s", o.message);
    cr_expect(strstr(o.problem->text, "{gap: 4,") && strstr(o.problem->text, "a: [1, 2.5, 3]   # smooth"),
              "%s", o.problem->text);
    cr_expect(strstr(o.problem->text, "start: {p2Ty: 0.5, p2Tx: -1}\n") != NULL, "%s", o.problem->text);
    cr_expect(o.problem->search.seed == 12 && o.problem->search.stage[0].anneal.evaluations == 99);
    cr_expect(o.problem->variable[2].start == -1 && o.problem->variable[3].start == 0.5 &&
              o.problem->variable[0].start == 2.5);
    outcome again = set(o.problem->text, 0, NULL);
    cr_expect(again.status == VES_OK, "what ran can be run again: %s", again.message);
    ves_problem_destroy(again.problem);
    ves_problem_destroy(o.problem);
}

Test(problem_text, errors_of_a_set_point_at_it)
{
    static const struct {
        const char *name, *value, *want;
    } row[] = {
        {"gap", "wxyz",
         "--set gap:1:11: error: unknown name \"wxyz\"\n    1 | --set gap=wxyz\n      |           ^~~~"},
        {"gap", "2*(1", "--set gap:1:13: error: \"(\" is never closed\n"},
        {"half", "max(gap, q)", "--set half:1:21: error: unknown name \"q\"\n"},
        {"gapp", "3", "--set gapp:1:7: error: no variable or parameter \"gapp\", did you mean \"gap\"?\n"},
        {"a", "100", "--set a:1:9: error: start 100 is outside [0.01, 9]\n"},
        {"a", "[0, 1", "--set a:1:9: error: this is not one value of YAML\n"},
        {"a", "1\nb: 2", "--set a:1:9: error: a value must be one line of text\n"},
        {"", "1", "--set :1:7: error: expected --set name=value\n"},
        {"curves.p9.circle", "1",
         "--set curves.p9.circle:1:7: error: the file has no \"curves.p9.circle\", did you mean \"p1\"?\n"},
        {"patches.wal.operator.a", "2",
         "--set patches.wal.operator.a:1:7: error: the file has no \"patches.wal.operator.a\", did you mean "
         "\"wall\"?\n"},
        {"variabels.a.1", "2",
         "--set variabels.a.1:1:7: error: the file has no \"variabels.a.1\", did you mean \"variables\"?\n"},
        {"measures.lid.area.over", "[wall]", "--set measures.lid.area.over:1:7: error: the file has no"},
        {"validity..value", "2", "--set validity..value:1:7: error: the file has no"},
        {"validity.self_intersecton", "never",
         "--set validity.self_intersecton:1:7: error: unknown key \"self_intersecton\" in \"validity\", did "
         "you mean "},
        {"validity.self_intersection", "newer", "--set validity.self_intersection:1:34: error: "},
        {"patches.wall.operator.aa", "2",
         "--set patches.wall.operator.aa:1:7: error: unknown key \"aa\" in \"operator\", did you mean "
         "\"a\"?\n"},
        {"patches.wall.conditions.7.u", "2", "--set patches.wall.conditions.7.u:1:7: error: the file has no"},
        {"patches.wall.conditions.x", "2", "--set patches.wall.conditions.x:1:7: error: the file has no"},
        {"curves", "{}",
         "--set curves:1:7: error: \"curves\" is written over several lines; set one of the values in it\n"},
        {"curves.p3.circle.radius", "3",
         "--set curves.p3.circle.radius:1:7: error: \"curves.p3.circle.radius\" lies in what *name stands "
         "for"},
        {"vesica", "2", "--set vesica:1:14: error: this file is for format 2"},
        {"p2Tx", "9", "--set p2Tx:1:12: error: start 9 is outside [-1.2, 1.2]\n"},
        {"p2Tw", "9", "--set p2Tw:1:7: error: no variable or parameter \"p2Tw\"\n"},
    };
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        const ves_override override = {row[k].name, row[k].value};
        outcome o = set(sample, 1, &override);
        cr_expect(o.status < 0 && !o.problem, "%s=%s was taken", row[k].name, row[k].value);
        cr_expect(!strncmp(o.message, row[k].want, strlen(row[k].want)), "%s=%s:\n  got  %s\n  want %s",
                  row[k].name, row[k].value, o.message, row[k].want);
        ves_problem_destroy(o.problem);
    }
}

Test(problem_text, what_stands_behind_a_set_keeps_its_place)
{
    const ves_override list[] = {{"gap", "123456"}, {"seed", "7"}};
    const char *text = "vesica: 1\nparameters: {gap: 2, bad: q}\n" CURVES PATCHES;
    outcome o = set(text, 2, list);
    cr_expect(!strncmp(o.message,
                       "sample.yaml:2:27: error: unknown name \"q\"\n    2 | parameters: {gap: 2, bad: q}\n",
                       60),
              "%s", o.message);
}

/* ---- bytes ---- */

static outcome read_bytes(const char *bytes, size_t length)
{
    outcome o = {.problem = NULL};
    ves_diag *diag = ves_diag_create();
    o.status = ves_problem_read_text("x", bytes, length, NULL, &o.problem, diag);
    if (ves_diag_count(diag)) ves_diag_text(diag, 0, o.message, sizeof o.message);
    ves_diag_destroy(diag);
    return o;
}

Test(problem_text, marks_of_editors_do_no_harm)
{
    static const char marked[] = "\xEF\xBB\xBF" BASE,
                      windows[] = "vesica: 1\r\ntitle: \xC3\xA9t\xC3\xA9\r\n" CURVES "\r\n" PATCHES;
    outcome a = read_bytes(marked, sizeof marked - 1), b = read_bytes(windows, sizeof windows - 1);
    cr_expect(a.status == VES_OK && b.status == VES_OK, "%s %s", a.message, b.message);
    cr_expect(!strcmp(b.problem->title, "\xC3\xA9t\xC3\xA9"));
    ves_problem_destroy(a.problem);
    ves_problem_destroy(b.problem);
    static const char wrong[] = "\xEF\xBB\xBFvesica: 1\r\ntitle: \xC3\xA9, zz\r\nparameters: {\xC3\xA9: 1, "
                                "a: \"\xC3\xA9\" }\r\n" CURVES PATCHES;
    outcome c = read_bytes(wrong, sizeof wrong - 1);
    cr_expect(!strncmp(c.message, "x:3:14: error: \"\xC3\xA9\" cannot be the name", 30),
              "bytes are counted: %s", c.message);
}

Test(problem_text, strange_bytes_are_refused_with_their_place)
{
    static const struct {
        const char *bytes;
        size_t length;
        const char *want;
    } row[] = {
        {"\xFF\xFEv\0e\0", 6, "x:1:1: error: this file is UTF-16; save it as UTF-8"},
        {"\xFE\xFF\0v\0e", 6, "x:1:1: error: this file is UTF-16; save it as UTF-8"},
        {"vesica: 1\ntitle: a\0b\n", 21,
         "x:2:9: error: byte 0x00 has no place in a text (UTF-8): control characters are not allowed"},
        {"vesica: 1\ntitle: \x80\n", 19,
         "x:2:8: error: byte 0x80 has no place in a text (UTF-8): invalid leading UTF-8 octet"},
        {"vesica: 1\ntitle: \xC3", 18,
         "x:2:8: error: byte 0xC3 has no place in a text (UTF-8): incomplete UTF-8 octet sequence"},
        {"\x7F"
         "ELF\x02\x01\x01",
         7, "x:1:1: error: byte 0x7F has no place in a text (UTF-8): control characters are not allowed"},
    };
    for (size_t k = 0; k < sizeof row / sizeof *row; k++) {
        outcome o = read_bytes(row[k].bytes, row[k].length);
        cr_expect(o.status == VES_SYNTAX && !strncmp(o.message, row[k].want, strlen(row[k].want)),
                  "%zu: got %s, want %s", k, o.message, row[k].want);
    }
}

Test(problem_text, what_is_too_large_is_refused)
{
    size_t length = 17u << 20;
    char *text = malloc(length);
    memset(text, ' ', length);
    outcome o = read_bytes(text, length);
    cr_expect(o.status == VES_SYNTAX && strstr(o.message, "at most 16 MB"), "%s", o.message);
    size_t at = (size_t)sprintf(text, "title: [");
    while (at < 4000000) at += (size_t)sprintf(text + at, "1, ");
    at += (size_t)sprintf(text + at, "1]\n");
    o = read_bytes(text, at);
    cr_expect(o.status == VES_SYNTAX && strstr(o.message, "too large: more than 300000 entries"), "%s",
              o.message);
    at = (size_t)sprintf(text, "title: [");
    for (int k = 0; k < 2000; k++) at += (size_t)sprintf(text + at, "&a%d 1, ", k);
    at += (size_t)sprintf(text + at, "1]\n");
    o = read_bytes(text, at);
    cr_expect(o.status == VES_SYNTAX && strstr(o.message, "too many anchors"), "%s", o.message);
    static const char *const many[][3] = {
        {"parameters: {", "q%d: 1, ", "more than 999 variables and parameters"},
        {"curves: {", "q%d: {point: [0, 0, 1]}, ", "more than 1000 names in one section"},
        {"curves: {p1: {circle: 1, apply: [", "{dilate: 2}, ", "more than 256 moves"},
    };
    for (size_t m = 0; m < sizeof many / sizeof *many; m++) {
        at = (size_t)sprintf(text, "vesica: 1\n%s", many[m][0]);
        for (int k = 0; k < 2500; k++) at += (size_t)sprintf(text + at, many[m][1], k);
        at += (size_t)sprintf(text + at, "%s\n%s", m == 2 ? "]}, p2: {circle: 2}}" : "}", PATCHES);
        o = read_bytes(text, at);
        cr_expect(o.status < 0 && strstr(o.message, many[m][2]), "got %s, want %s", o.message, many[m][2]);
    }
    free(text);
}

Test(problem_text, files_that_cannot_be_read_say_why)
{
    static const char *const row[][2] = {{VESICA_BUILD "/no such file.yaml", "No such file or directory"},
                                         {VESICA_SOURCE, "Is a directory"}};
    for (int k = 0; k < 2; k++) {
        ves_problem *problem;
        char message[2000] = "";
        ves_diag *diag = ves_diag_create();
        cr_expect(ves_problem_read(row[k][0], NULL, &problem, diag) == VES_IO && !problem);
        ves_diag_text(diag, 0, message, sizeof message);
        cr_expect(!strncmp(message, "error: cannot ", 14) && strstr(message, row[k][1]), "%s", message);
        ves_diag_destroy(diag);
    }
}

static int read_folder(const char *folder)
{
    int count = 0;
    DIR *dir = opendir(folder);
    for (struct dirent *e; dir && (e = readdir(dir));) {
        char path[1000], message[2000] = "";
        size_t length = strlen(e->d_name);
        if (length < 5 || strcmp(e->d_name + length - 5, ".yaml")) continue;
        ves_problem *problem;
        ves_diag *diag = ves_diag_create();
        snprintf(path, sizeof path, "%s/%s", folder, e->d_name);
        ves_status status = ves_problem_read(path, NULL, &problem, diag);
        if (ves_diag_count(diag)) ves_diag_text(diag, 0, message, sizeof message);
        cr_expect(status == VES_OK && ves_diag_count(diag) == 0, "%s", message);
        cr_expect(!problem || (!strncmp(problem->name, e->d_name, length - 5) && !problem->name[length - 5]));
        ves_problem_destroy(problem);
        ves_diag_destroy(diag);
        count++;
    }
    if (dir) closedir(dir);
    return count;
}

Test(problem_text, the_shipped_problems_are_read_without_a_word)
{
    cr_expect(read_folder(VESICA_SOURCE "/problems") >= 3);
    cr_expect(read_folder(VESICA_SOURCE "/problems/surfaces") >= 5);
    cr_expect(read_folder(VESICA_SOURCE "/problems/templates") >= 1);
}

Test(problem_text, a_set_may_leave_a_variable_idle)
{
    const ves_override override = {"patches.wall.operator.a", "0"};
    outcome o = set(sample, 1, &override);
    cr_expect(o.status == VES_OK && strstr(o.message, "warning: variable \"a\" drives nothing"), "%s",
              o.message);
    ves_problem_destroy(o.problem);
}

/* sound: the text has no error. Memory runs out at the first, second, ... call, libyaml's included:
 * VES_MEMORY each time, nothing is lost. (What does not fit into a message is left out of it: the reading
 * goes on.) */
static void starve(const char *text, int overrides, const ves_override *override, bool sound)
{
    const ves_read_options options = {.overrides = overrides, .override = override};
    for (long k = 1;; k++) {
        ves_problem *problem = NULL;
        memory_begin(k, true);
        ves_diag *diag = ves_diag_create();
        ves_status status = ves_problem_read_text("x", text, strlen(text), &options, &problem, diag);
        bool any = problem != NULL;
        ves_problem_destroy(problem);
        ves_diag_destroy(diag);
        memory_end();
        bool reached = memory.asked >= k;
        cr_assert(!sound || status == VES_OK || (reached && status == VES_MEMORY), "call %ld: %d", k, status);
        cr_assert(any == (status == VES_OK), "call %ld: status %d, problem %d", k, status, any);
        cr_assert(memory.live == 0, "call %ld: %ld blocks lost", k, memory.live);
        if (!reached) return;
        cr_assert(k < 100000);
    }
}

Test(problem_text, memory_may_run_out_anywhere)
{
    const ves_override list[] = {{"gap", "3"}, {"p2Tx", "0.25"}};
    starve(sample, 2, list, true);
    starve("vesica: 1\nparameters: {a: 2 mm, b: a}\n" CURVES PATCHES
           "measures: {s: {integral: {of: x*K}}}\nsolve: {unknown: h, in: [1, 2], equation: area == h}\n"
           "constraints: [area <= 3, {require: s <= 2, within: 1}]\nsearch: [anneal, {polish: "
           "slsqp}]\nexpect: [feasible, h > 2, nonsense]\n",
           0, NULL, false);
}

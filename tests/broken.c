/* Broken problem files: tests/broken/NAME.yaml begin with the messages that they must give, one a line:
 *     # want: LINE:COLUMN: error: text
 * These and no other errors must come, in this order, from the reader or, where the text is right but the
 * shape is not, from the plan. And every sentence of the reader must be provoked by one of them. */
#include <criterion/criterion.h>
#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "problem/problem.h"
#include "problem/suite.h"
#include "shell_probe.h"
#include "slurp.h"
#include "surface/figure.h"
#include "vesica/plan.h"

enum { FILES = 400, TEXT = 4000, FOUND = 400000 };

static int by_name(const void *a, const void *b)
{
    return strcmp(*(char *const *)a, *(char *const *)b);
}

/* Names of the files with this ending, sorted. */
static int list_files(const char *folder, const char *ending, char *name[FILES])
{
    int count = 0;
    DIR *dir = opendir(folder);
    cr_assert(dir != NULL, "cannot open %s", folder);
    for (struct dirent *e; (e = readdir(dir)) && count < FILES;) {
        size_t length = strlen(e->d_name), tail = strlen(ending);
        if (length > tail && !strcmp(e->d_name + length - tail, ending)) name[count++] = strdup(e->d_name);
    }
    closedir(dir);
    qsort(name, (size_t)count, sizeof *name, by_name);
    return count;
}

/* "12:3: error: ..." of message k; the name of the file and the excerpt are cut off; files do not name the
 * version. */
static const char *message(const ves_diag *diag, int k, char text[TEXT])
{
    ves_diag_text(diag, k, text, TEXT);
    char *excerpt = strstr(text, "\n ");
    if (excerpt) *excerpt = 0;
    char *version = strstr(text, VESICA_VERSION), rest[TEXT];
    if (version) {
        snprintf(rest, sizeof rest, "%s", version + strlen(VESICA_VERSION));
        snprintf(version, TEXT - (size_t)(version - text), "VERSION%s", rest);
    }
    return !strncmp(text, "broken:", 7) ? text + 7 : text;
}

/* suite-NAME.yaml is a suite. */
static void read_suite(const char *text, ves_diag *diag, ves_status *status)
{
    ves_suite *suite = NULL;
    *status = ves_suite_read_text("broken", text, strlen(text), NULL, &suite, diag);
    cr_expect((suite == NULL) == (*status != VES_OK));
    ves_suite_destroy(suite);
}

static ves_diag *read_file(const char *name, const char *text, ves_status *status)
{
    ves_problem *problem = NULL;
    ves_diag *diag = ves_diag_create();
    ves_plan *plan = NULL;
    if (!strncmp(name, "suite-", 6)) {
        read_suite(text, diag, status);
        return diag;
    }
    const ves_read_options options = {.plugin = shell_probes};
    *status = ves_problem_read_text("broken", text, strlen(text), &options, &problem, diag);
    cr_expect((problem == NULL) == (*status != VES_OK));
    if (problem) *status = ves_plan_create(problem, &(ves_plan_options){{8, 8}}, &plan, diag);
    cr_expect(plan == NULL, "a broken file was planned");
    ves_plan_destroy(plan);
    ves_problem_destroy(problem);
    return diag;
}

/* The next line "# want: ..." copied; false when there is none. */
static bool next_want(const char **at, char want[TEXT])
{
    static const char mark[] = "# want: ";
    if (strncmp(*at, mark, sizeof mark - 1)) return false;
    size_t length = strcspn(*at, "\n") - (sizeof mark - 1);
    snprintf(want, TEXT, "%.*s", (int)length, *at + sizeof mark - 1);
    *at += strcspn(*at, "\n") + 1;
    return true;
}

static void check_file(const char *name, const char *text)
{
    char want[TEXT], got[TEXT];
    const char *at = text;
    ves_status status;
    ves_diag *diag = read_file(name, text, &status);
    int k = 0;
    for (; next_want(&at, want); k++) {
        while (k < ves_diag_count(diag) && ves_diag_severity(diag, k) != VES_ERROR) k++;
        const char *m = k < ves_diag_count(diag) ? message(diag, k, got) : "nothing";
        cr_expect(!strcmp(m, want), "%s:\n  got  %s\n  want %s", name, m, want);
    }
    for (; k < ves_diag_count(diag); k++)
        cr_expect(ves_diag_severity(diag, k) != VES_ERROR, "%s:\n  also got %s", name, message(diag, k, got));
    cr_expect(at != text && status < 0, "%s: status %d", name, status);
    ves_diag_destroy(diag);
}

Test(broken, each_file_gives_its_messages_and_no_other)
{
    char *name[FILES], path[1000];
    int count = list_files(VESICA_SOURCE "/tests/broken", ".yaml", name);
    cr_expect(count >= 40, "only %d files", count);
    for (int k = 0; k < count; k++) {
        snprintf(path, sizeof path, "%s/tests/broken/%s", VESICA_SOURCE, name[k]);
        char *text = slurp(path);
        check_file(name[k], text);
        free(text);
        free(name[k]);
    }
}

/* All messages of all broken files, one after the other. */
static char *all_messages(void)
{
    char *name[FILES], path[1000], text[TEXT], *all = calloc(FOUND, 1);
    int count = list_files(VESICA_SOURCE "/tests/broken", ".yaml", name);
    size_t at = 0;
    for (int k = 0; k < count; k++) {
        snprintf(path, sizeof path, "%s/tests/broken/%s", VESICA_SOURCE, name[k]);
        char *file = slurp(path);
        ves_status status;
        ves_diag *diag = read_file(name[k], file, &status);
        for (int i = 0; i < ves_diag_count(diag); i++)
            at += (size_t)snprintf(all + at, FOUND - at, "%s\n", message(diag, i, text));
        cr_assert(at < FOUND);
        ves_diag_destroy(diag);
        free(file);
        free(name[k]);
    }
    return all;
}

/* The longest stretch of a format without a conversion. `from` is behind the opening quote; literals side by
 * side are one. */
static const char *longest_stretch(const char *from, char stretch[TEXT])
{
    char now[TEXT] = "";
    size_t length = 0, best = 0;
    for (;;) {
        bool end = *from == '"', conversion = *from == '%';
        if (!end && !conversion) {
            if (*from == '\\') from++;
            now[length++] = *from++;
            continue;
        }
        if (length > best) memcpy(stretch, now, length), best = length;
        stretch[best] = 0;
        if (conversion) {
            from += strcspn(from, "sdgXl") + 1;
            while (*from == 'd' && from[-1] == 'l') from++;
            length = 0;
            continue;
        }
        const char *next = from + 1 + strspn(from + 1, " \n");
        if (*next != '"') return from;
        from = next + 1;
    }
}

/* Is the sentence about something that a file cannot show: --set, reading, memory? tests/problem.c has those.
 */
static bool elsewhere(const char *file, const char *sentence)
{
    static const char *const other[] = {"this file is UTF-16",
                                        "a problem file may have",
                                        "cannot %s",
                                        "has no place in a text",
                                        "more than ",
                                        "too many anchors",
                                        "too large: more than 300000 entries\"",
                                        "\" moves only",
                                        "is too large: %ld"};
    if (!strcmp(file, "override.c")) return true;
    for (size_t k = 0; k < sizeof other / sizeof *other; k++)
        if (strstr(sentence, other[k]) && strstr(sentence, other[k]) < sentence + 60) return true;
    return false;
}

static int check_calls(const char *file, const char *code, const char *call, const char *all)
{
    int sentences = 0;
    for (const char *at = strstr(code, call); at; at = strstr(at + 1, call)) {
        if (isalnum((unsigned char)at[-1]) || at[-1] == '_') continue;
        const char *quote = at + strcspn(at, "\";");
        if (*quote != '"') continue;
        char stretch[TEXT];
        longest_stretch(quote + 1, stretch);
        if (strlen(stretch) < 3 || elsewhere(file, quote)) continue;
        sentences++;
        cr_expect(strstr(all, stretch) != NULL, "%s: no broken file provokes \"%s\"", file, stretch);
    }
    return sentences;
}

Test(broken, every_sentence_of_the_reader_is_provoked)
{
    static const char *const call[] = {"ves_reader_error(", "ves_reader_fail(", "ves_diag_add(", "fail("};
    char *name[FILES], path[1000], *all = all_messages();
    int count = list_files(VESICA_SOURCE "/src/problem", ".c", name), sentences = 0;
    for (int k = 0; k < count; k++) {
        snprintf(path, sizeof path, "%s/src/problem/%s", VESICA_SOURCE, name[k]);
        char *code = slurp(path);
        for (size_t c = 0; c < sizeof call / sizeof *call; c++)
            sentences += check_calls(name[k], code, call[c], all);
        free(code);
        free(name[k]);
    }
    cr_expect(sentences > 90, "only %d sentences found: does the search still understand the source?",
              sentences);
    free(all);
}

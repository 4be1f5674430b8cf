/* The program itself, as a user meets it, in a folder of its own. */
#ifndef TESTS_PROGRAM_H
#define TESTS_PROGRAM_H

#pragma GCC diagnostic ignored "-Wconversion" /* Criterion's own macros */

#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "problem/tree.h"
#include "slurp.h"

#define PROBLEMS VESICA_SOURCE "/problems/"

enum { WORDS = 32, TEXT = 4096 };

static char root[512];

/* fontconfig keeps what it has read about the fonts until the process ends, and nothing of it points there:
 * under the leak sanitizer that is no leak of ours. */
static inline void hush(void)
{
    FILE *out = fopen("quiet", "w");
    cr_assert(out != NULL);
    fputs("leak:libfontconfig\n", out);
    fclose(out);
}

static inline void root_make(void)
{
    snprintf(root, sizeof root, "%s/test_program.%ld", VESICA_BUILD, (long)getpid());
    cr_assert(mkdir(root, 0777) == 0);
    cr_assert(chdir(root) == 0);
    hush();
}

static inline void root_remove(void)
{
    char command[600];
    snprintf(command, sizeof command, "rm -rf '%s'", root);
    cr_assert(chdir("/") == 0);
    cr_assert(system(command) == 0);
}

/* --- running it --- */

typedef struct outcome {
    int code;
    char *out, *err;
} outcome;

static inline void become(const char *words, const char *in, const char *out)
{
    static char copy[TEXT];
    char *word[WORDS] = {VESICA_BUILD "/vesica"};
    int count = 1;
    snprintf(copy, sizeof copy, "%s", words);
    for (char *w = strtok(copy, " "); w && count < WORDS - 1; w = strtok(NULL, " ")) word[count++] = w;
    dup2(open(in ? in : "/dev/null", O_RDONLY), 0);
    dup2(open(out, O_WRONLY | O_CREAT | O_TRUNC, 0666), 1);
    dup2(open("stderr", O_WRONLY | O_CREAT | O_TRUNC, 0666), 2);
    setenv("LSAN_OPTIONS", "suppressions=quiet:print_suppressions=0", 1);
    execv(word[0], word);
    _exit(127);
}

static inline pid_t launch(const char *words, const char *in, const char *out)
{
    pid_t child = fork();
    if (!child) become(words, in, out);
    return child;
}

static inline int wait_for(pid_t child)
{
    int status;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

/* Words are separated by single blanks; %-formats are filled in. */
static inline outcome vesica(const char *in, const char *format, ...)
{
    char words[TEXT];
    va_list list;
    va_start(list, format);
    vsnprintf(words, sizeof words, format, list);
    va_end(list);
    int code = wait_for(launch(words, in, "stdout"));
    return (outcome){code, slurp("stdout"), slurp("stderr")};
}

static inline void done(outcome *o)
{
    free(o->out);
    free(o->err);
}

static inline void expect(outcome o, int code, const char *out, const char *err, const char *what)
{
    cr_assert(o.code == code, "%s: exit %d, want %d\nstdout: %s\nstderr: %s", what, o.code, code, o.out,
              o.err);
    if (out) cr_assert(strstr(o.out, out) != NULL, "%s: no \"%s\" on stdout:\n%s", what, out, o.out);
    if (err) cr_assert(strstr(o.err, err) != NULL, "%s: no \"%s\" on stderr:\n%s", what, err, o.err);
    done(&o);
}

static inline void write_file(const char *path, const char *text)
{
    FILE *out = fopen(path, "w");
    cr_assert(out != NULL);
    fputs(text, out);
    fclose(out);
}

static inline void same_file(const char *a, const char *b)
{
    char *x = slurp(a), *y = slurp(b);
    cr_expect(strcmp(x, y) == 0, "%s and %s differ", a, b);
    free(x);
    free(y);
}

/* How often a word stands in a file. */
static inline int count_of(const char *path, const char *word)
{
    char *text = slurp(path);
    int count = 0;
    for (const char *at = text; (at = strstr(at, word)); at++) count++;
    free(text);
    return count;
}

/* In the copy of a file, for a test that spoils it. */
static inline void replace(const char *path, const char *old, const char *new)
{
    char *text = slurp(path), *at = strstr(text, old);
    cr_assert(at != NULL, "no %s in %s", old, path);
    FILE *out = fopen(path, "w");
    cr_assert(out != NULL);
    fprintf(out, "%.*s%s%s", (int)(at - text), text, new, at + strlen(old));
    fclose(out);
    free(text);
}

/* Until there is something in a file: a sign that the program is at work. */
static inline void wait_for_file(const char *path)
{
    for (int k = 0; k < 1000; k++) {
        struct stat there;
        if (stat(path, &there) == 0 && there.st_size > 0) return;
        nanosleep(&(struct timespec){.tv_nsec = 10000000}, NULL);
    }
    cr_assert(false, "%s never came", path);
}

/* --- JSON --- */

typedef struct json {
    ves_arena arena;
    const ves_node *root;
    char *text;
} json;

static inline json json_of(const char *text)
{
    json j = {.text = strdup(text)};
    ves_script *script = ves_arena_take(&j.arena, 1, sizeof *script);
    cr_assert(ves_script_init(script, j.text, strlen(text), &j.arena) == VES_OK);
    cr_assert(ves_tree_read(script, &j.arena, &j.root, NULL) == VES_OK, "this is no single JSON value:\n%s",
              text);
    cr_assert(j.root && j.root->kind == VES_NODE_MAP && *text == '{', "this is no object:\n%s", text);
    return j;
}

static inline double number(const json *j, const char *key, const char *inner)
{
    const ves_node *node = ves_node_find(j->root, key);
    if (node && inner) node = ves_node_find(node, inner);
    cr_assert(node && node->kind == VES_NODE_WORD, "no number %s %s", key, inner ? inner : "");
    return strtod(node->text, NULL);
}

static inline void json_done(json *j)
{
    free(j->text);
    ves_arena_destroy(&j->arena);
}

#endif

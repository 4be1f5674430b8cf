/* The command line: the only main. Results go to stdout, talk goes to stderr. */
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "app/app.h"
#include "base/text.h"
#include "study/ranks.h"

enum { MESSAGE = 8192, TEXT = 1000 };

int app_code(ves_status status)
{
    switch (status) {
    case VES_OK:
        return APP_DONE;
    case VES_MEMORY:
    case VES_IO:
        return APP_MISSING;
    case VES_INTERRUPTED:
        return APP_INTERRUPTED;
    case VES_FAULT:
        return APP_FAULT;
    default:
        return status > VES_OK ? APP_UNMET : APP_WRONG;
    }
}

int app_fail(app *a, ves_status status, const char *format, ...)
{
    char text[TEXT];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    ves_diag_add(a->diag, VES_ERROR, status, (ves_mark){0}, "%s", text);
    return app_code(status);
}

void app_say(app *a)
{
    char text[MESSAGE];
    for (; a->said < ves_diag_count(a->diag); a->said++) {
        ves_diag_text(a->diag, a->said, text, sizeof text);
        fprintf(stderr, "%s\n", text);
    }
}

/* After the last message. */
static void say_rest(const app *a)
{
    int kept = 0, errors = ves_diag_errors(a->diag);
    for (int k = 0; k < ves_diag_count(a->diag); k++) kept += ves_diag_severity(a->diag, k) == VES_ERROR;
    if (errors > kept)
        fprintf(stderr, "... and %d more %s\n", errors - kept, errors - kept == 1 ? "error" : "errors");
}

bool app_open(app *a, ves_opened *opened, int *code)
{
    const app_options *o = &a->options;
    ves_open_options options = {.read = {o->sets, o->set, a->measure, o->plugin}, .start = o->start};
    ves_status status = ves_study_open(a->operand[0], &options, opened, a->diag);
    app_say(a);
    *code = status == VES_IO ? APP_WRONG : app_code(status); /* a file that is not there was misspelt */
    return status == VES_OK;
}

const char *app_called(void)
{
    const char *name = getenv("VESICA_AS"); /* by the launcher */
    return name && *name ? name : "vesica";
}

/* Words that a later version will understand. */
static const char *later(const char *word)
{
    static const char *const words[][2] = {
        {"report", "report pages"},
        {"compare", "comparing runs"},
        {"serve", "the live designer"},
        {"animate", "parameters that follow time"},
        {"fit", "fitting boundary curves to a mesh"},
        {"rerun", "repeating a run"},
    };
    for (size_t k = 0; k < sizeof words / sizeof *words; k++)
        if (!strcmp(words[k][0], word)) return words[k][1];
    return NULL;
}

static int unknown(app *a, const char *word)
{
    const char *name[64], *about = later(word);
    int count = 0;
    if (about)
        return app_fail(a, VES_ABSENT, "\"%s\": this version of vesica (%s) does not have %s yet", word,
                        VESICA_VERSION, about);
    for (const app_command *c = app_commands; c->name && count < 64; c++) name[count++] = c->name;
    int near = ves_text_nearest(word, name, count);
    if (near >= 0) return app_fail(a, VES_USAGE, "no command \"%s\", did you mean \"%s\"?", word, name[near]);
    return app_fail(a, VES_USAGE, "no command and no file \"%s\" (vesica help lists the commands)", word);
}

/* Commands that mpirun may start: its processes share the work, or there is none that they could do to each other. */
static bool shares(const app_command *command)
{
    static const char *const word[] = {"run",    "sweep",   "bench",   "list",
                                       "schema", "explain", "version", "help"};
    for (size_t k = 0; k < sizeof word / sizeof *word; k++)
        if (!strcmp(word[k], command->name)) return true;
    return false;
}

/* Rank 0 speaks for all. */
static int refuse_ranks(app *a, const app_command *command, int ranks, int rank)
{
    if (rank) return app_code(VES_USAGE);
    return app_fail(
        a, VES_USAGE,
        "this is one of %d processes that mpirun has started, and they cannot share `vesica %s` out: "
        "run it without mpirun",
        ranks, command->name);
}

static int command_run(app *a, const app_command *command, int count, char **word)
{
    int code;
    if (!app_options_read(a, command, count, word, &code)) return code;
    if (a->options.help) {
        app_help_command(command, stdout);
        return APP_DONE;
    }
    int rank, ranks = ves_ranks_asked(&rank);
    if (ranks > 1 && !shares(command)) return refuse_ranks(a, command, ranks, rank);
    ves_status status = app_plugins_load(a);
    return status == VES_OK ? command->run(a) : app_code(status);
}

static bool is_file(const char *word)
{
    FILE *file = fopen(word, "rb");
    if (file) fclose(file);
    return file;
}

/* `vesica FILE` is `vesica run FILE`. */
static int dispatch(app *a, int count, char **word)
{
    if (count < 2) {
        app_help_command(NULL, stderr);
        return APP_WRONG;
    }
    const char *first = word[1];
    if (!strcmp(first, "--help") || !strcmp(first, "-h")) first = "help";
    if (!strcmp(first, "--version") || !strcmp(first, "-V")) first = "version";
    const app_command *command = app_command_find(first);
    if (command) return command_run(a, command, count - 2, word + 2);
    bool path = strchr(first, '/') || strchr(first, '.') || is_file(first);
    if (path && *first != '-') return command_run(a, app_command_find("run"), count - 1, word + 1);
    if (*first == '-')
        return app_fail(a, VES_USAGE, "a command comes first, then \"%s\" (vesica help)", first);
    return unknown(a, first);
}

/* What is written to a full disk or a closed pipe must not pass for done. */
static int flushed(app *a, int code)
{
    if (fflush(stdout) == 0 && !ferror(stdout)) return code;
    return app_fail(a, VES_IO, "cannot write to standard output: %s", strerror(errno));
}

int main(int count, char **word)
{
    app *a = ves_memory_take(sizeof *a);
    if (a) a->diag = ves_diag_create();
    if (!a || !a->diag) {
        fprintf(stderr, "error: %s\n", ves_status_text(VES_MEMORY));
        ves_memory_free(a);
        return APP_MISSING;
    }
    int code = flushed(a, dispatch(a, count, word));
    app_say(a);
    say_rest(a);
    app_plugins_close(a);
    ves_arena_destroy(&a->arena);
    ves_diag_destroy(a->diag);
    ves_memory_free(a);
    return code;
}

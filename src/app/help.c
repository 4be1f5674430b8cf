#include <string.h>

#include "app/app.h"
#include "base/text.h"

const app_command *app_command_find(const char *name)
{
    for (const app_command *c = app_commands; c->name; c++)
        if (!strcmp(c->name, name)) return c;
    return NULL;
}

static void overview(FILE *out)
{
    fprintf(out,
            "vesica %s: shape optimization with surfaces made by their boundary curves\n\n"
            "usage: vesica COMMAND [FILE] [options]        vesica FILE is short for vesica run FILE\n\n",
            VESICA_VERSION);
    for (const app_command *c = app_commands; c->name; c++) fprintf(out, "  %-9s %s\n", c->name, c->about);
    fprintf(
        out,
        "\nvesica help COMMAND tells its options. A RUN is a folder that a run has made; FILE may be - for "
        "stdin.\n"
        "Exit code: 0 done and feasible, 1 infeasible or an expectation failed, 2 wrong file or command, or\n"
        "more than this version can do, 3 something is missing on this machine, 4 a fault of vesica,\n"
        "130 interrupted.\n");
}

void app_help_command(const app_command *command, FILE *out)
{
    if (!command) {
        overview(out);
        return;
    }
    fprintf(out, "usage: vesica %s%s\n  %s\n", command->usage, *command->options ? " [options]" : "",
            command->about);
    if (*command->options) fputc('\n', out);
    app_options_list(command, out);
    if (command->more) fprintf(out, "\n%s\n", command->more);
}

int app_help(app *a)
{
    const app_command *command = a->operands ? app_command_find(a->operand[0]) : NULL;
    if (a->operands && !command) {
        const char *name[64];
        int count = 0;
        for (const app_command *c = app_commands; c->name && count < 64; c++) name[count++] = c->name;
        int near = ves_text_nearest(a->operand[0], name, count);
        return app_fail(a, VES_USAGE,
                        near < 0 ? "no command \"%s\"" : "no command \"%s\", did you mean \"%s\"?",
                        a->operand[0], near < 0 ? "" : name[near]);
    }
    app_help_command(command, stdout);
    return APP_DONE;
}

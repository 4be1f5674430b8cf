/* What the commands of the command line share. */
#ifndef VES_APP_APP_H
#define VES_APP_APP_H

#include "base/arena.h"
#include "output/output.h"
#include "study/open.h"
#include "study/run.h"
#include "study/saved.h"
#include "vesica/objective.h"

/* Exit codes: a contract with scripts. */
enum {
    APP_DONE = 0,  /* done, feasible, all that was expected holds */
    APP_UNMET = 1, /* done, but infeasible, or an expectation failed */
    APP_WRONG = 2, /* the command line or the problem file is wrong, or asks for what this version has not */
    APP_MISSING = 3,      /* something is missing on this machine: memory, room on the disk, a right */
    APP_FAULT = 4,        /* a fault of vesica itself */
    APP_INTERRUPTED = 130 /* stopped by Ctrl-C; everything so far is kept */
};

enum { APP_OPERANDS = 8, APP_SETS = 1000, APP_PLUGINS = 32 };

typedef struct app_options {
    int sets, plugins;
    ves_override set[APP_SETS];
    const char *plugin[APP_PLUGINS + 1]; /* ends with NULL */
    bool seeded, counted, follows, json, test, no_files, reference, viewed, spines, suite, forget, help;
    uint64_t seed;
    long evaluations;
    int jobs, spine, modes, functions, factors, along, grid[2]; /* along: -1: softest */
    double metres;       /* of the unit of export; 0: none is asked for */
    double view[2];      /* radians: azimuth, height */
    const char *decides; /* an option that a resumed run has decided already, or NULL */
    const char *start, *resume, *out, *patch, *points, *to, *unit, *png, *colour, *add;
    const char *over; /* what is under `sweep.over`, or NULL */
    ves_progress_style progress;
    ves_trace trace;
} app_options;

typedef struct app {
    ves_arena arena;
    ves_diag *diag;
    int said; /* messages of diag that are on stderr already */
    app_options options;
    int operands;
    const char *operand[APP_OPERANDS];
    const ves_team *team; /* of a run under mpirun, or NULL */
    bool torn;            /* that run ended where the other ranks may not have */
    int shared;           /* loaded plugins */
    void *handle[APP_PLUGINS];
    const ves_measure **measure; /* of the plugins, NULL-terminated; or NULL */
} app;

typedef struct app_command {
    const char *name, *usage, *about;
    int least, most;     /* operands */
    const char *options; /* "set|seed|..." */
    int (*run)(app *a);
    const char *more; /* what help says last, or NULL */
} app_command;

/* commands.c: ends with a NULL name. */
extern const app_command app_commands[];

int app_run(app *a);
int app_bench(app *a);
int app_sweep(app *a);
int app_journal(app *a);
int app_eval(app *a);
int app_stability(app *a);
int app_check(app *a);
int app_sample(app *a);
int app_export(app *a);
int app_show(app *a);
int app_new(app *a);
int app_list(app *a);
int app_schema(app *a);
int app_explain(app *a);
int app_version(app *a);
int app_help(app *a);

/* main.c: adds an error (printf format) and returns its exit code. */
int app_fail(app *a, ves_status status, const char *format, ...) __attribute__((format(printf, 3, 4)));
int app_code(ves_status status); /* the exit code that a status means */
void app_say(app *a);            /* puts what diag has gained on stderr */

/* main.c: opens operand 0. On failure *code is to be returned. */
bool app_open(app *a, ves_opened *opened, int *code);

/* options.c: reads the words after the command into options and operands. false: *code is to be returned. */
bool app_options_read(app *a, const app_command *command, int count, char **word, int *code);
void app_options_list(const app_command *command, FILE *out);

/* plugin.c */
ves_status app_plugins_load(app *a);
/* name NULL: the first that it brings */
ves_status app_objective_load(app *a, const char *path, const char *name, const ves_objective **objective);
void app_plugins_close(app *a);

/* interrupt.c: Ctrl-C asks for an end; a second one kills. */
void app_interrupt_listen(void);
bool app_interrupt_asked(void);

/* patience.c: from begin to end one line on stderr, if that takes long. */
void app_patience_begin(void);
void app_patience_end(void);

/* main.c: how the program was called, for commands that it proposes: "./vesica", "vesica". */
const char *app_called(void);

/* help.c */
void app_help_command(const app_command *command, FILE *out);
const app_command *app_command_find(const char *name);

/* cmd_run.c: loads the measures that a folder was made with, unless they are given anew. */
ves_status app_plugins_again(app *a, const ves_saved *saved);

/* cmd_run.c: what mpirun starts together works as one; rank 0 speaks for all. */
int app_together(app *a, int (*work)(app *a));

/* screen.c: the result of a run, for people. */
void app_screen_run(const ves_run *run, FILE *out);
void app_screen_variables(const ves_run *run, FILE *out);
void app_screen_joints(const ves_run *run, FILE *out);
/* screen_shell.c: nothing where there is none */
/* facts: of both levels */
void app_screen_shell(const ves_problem *problem, const ves_shell_facts facts[2], FILE *out);
void app_screen_shell_json(const ves_problem *problem, const ves_shell_facts facts[2], ves_json *json);
void app_screen_design(const ves_problem *problem, const ves_design *design, const ves_design *finer,
                       FILE *out); /* finer: on a finer grid */
const char *app_screen_number(double value, char buffer[32]);
const char *app_screen_thousands(long value, char buffer[32]);
const char *app_screen_time(double seconds, char buffer[32]);
const char *app_screen_plural(long count, const char *one, const char *many, char buffer[64]);

#endif

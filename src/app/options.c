/* Options: one table says how each is written, what it is for, and how it is read. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "app/app.h"
#include "base/text.h"
#include "base/vector.h"
#include "formula/dimension.h"
#include "vesica/stability.h"

enum { OPTIONS = 64 };

typedef struct option {
    const char *name, *argument; /* argument NULL: it takes none */
    const char *about;
    bool (*take)(app *a, const char *value); /* false: a message is in diag */
} option;

static bool wrong(app *a, const char *format, const char *value)
{
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
    app_fail(a, VES_USAGE, format, value);
#pragma GCC diagnostic pop
    return false;
}

static bool whole(const char *text, long least, long most, long *value)
{
    char *end;
    errno = 0;
    *value = strtol(text, &end, 10);
    return *text && !*end && !errno && *value >= least && *value <= most;
}

static bool take_set(app *a, const char *value)
{
    app_options *o = &a->options;
    const char *equals = strchr(value, '=');
    if (!equals || equals == value) return wrong(a, "--set needs name=value, got \"%s\"", value);
    if (o->sets == APP_SETS) return wrong(a, "too many --set, at \"%s\"", value);
    const char *name = ves_arena_text(&a->arena, value, (size_t)(equals - value));
    o->set[o->sets++] = (ves_override){name, equals + 1};
    return name || wrong(a, "%s", ves_status_text(VES_MEMORY));
}

/* A number as a value of YAML, quoted where it could be read as more than one. */
static bool over_word(app *a, const char *text, size_t length, char **word)
{
    static const char safe[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.+-_*/^() ";
    *word = ves_arena_text(&a->arena, text, length);
    bool plain = *word && strspn(*word, safe) == length && *text != '-' && *text != '*';
    double number;
    if (*word && !plain && !ves_text_number(*word, &number))
        *word = strchr(*word, '\'') ? NULL : ves_arena_format(&a->arena, "'%s'", *word);
    return *word;
}

/* FROM..TO:COUNT, or values with commas between them, as `sweep.over` would have it. */
static const char *over_values(app *a, const char *text)
{
    const char *dots = strstr(text, ".."), *colon = strrchr(text, ':');
    char *from, *to, *list = NULL;
    long count;
    if (dots && dots > text && colon > dots + 2 && whole(colon + 1, 2, VES_SWEEP_VALUES, &count) &&
        over_word(a, text, (size_t)(dots - text), &from) &&
        over_word(a, dots + 2, (size_t)(colon - dots - 2), &to))
        return ves_arena_format(&a->arena, "{from: %s, to: %s, count: %ld}", from, to, count);
    if (dots || colon || !*text) return NULL;
    for (const char *at = text; at; at = strchr(at, ',') ? strchr(at, ',') + 1 : NULL) {
        if (!over_word(a, at, strcspn(at, ","), &from) || !*from) return NULL;
        list = list ? ves_arena_format(&a->arena, "%s, %s", list, from) : from;
        if (!list) return NULL;
    }
    return ves_arena_format(&a->arena, "[%s]", list);
}

static bool take_over(app *a, const char *value)
{
    app_options *o = &a->options;
    const char *equals = strchr(value, '='), *values = equals ? over_values(a, equals + 1) : NULL;
    const char *before = o->over ? o->over : "", *gap = o->over ? ", " : "";
    if (!values || equals == value)
        return wrong(a,
                     "--over needs NAME=FROM..TO:COUNT or NAME=VALUE,VALUE,..., as --over nu=0.5..1:11, got "
                     "\"%s\"",
                     value);
    o->over = ves_arena_format(&a->arena, "%s%s%.*s: %s", before, gap, (int)(equals - value), value, values);
    return o->over || wrong(a, "%s", ves_status_text(VES_MEMORY));
}

static bool take_seed(app *a, const char *value)
{
    long seed;
    if (!whole(value, 0, 1L << 53, &seed))
        return wrong(a, "--seed needs a whole number from 0 to 2^53, got \"%s\"", value);
    a->options.seed = (uint64_t)seed;
    return a->options.seeded = true;
}

static bool take_evaluations(app *a, const char *value)
{
    return whole(value, 1, 1L << 53, &a->options.evaluations) ||
           wrong(a, "--evaluations needs a whole number from 1 on, got \"%s\"", value);
}

static bool take_jobs(app *a, const char *value)
{
    long jobs;
    if (!whole(value, 1, 256, &jobs))
        return wrong(a, "--jobs needs a whole number from 1 to 256, got \"%s\"", value);
    a->options.jobs = (int)jobs;
    return true;
}

static bool take_modes(app *a, const char *value)
{
    long modes;
    if (!whole(value, 0, VES_STABILITY_MODES, &modes))
        return wrong(a, "--modes needs the highest azimuthal mode, 0 to 12, got \"%s\"", value);
    a->options.modes = (int)modes;
    return a->options.counted = true;
}

static bool take_follow(app *a, const char *value)
{
    long n = -1;
    if (strcmp(value, "softest") && !whole(value, 0, VES_STABILITY_MODES, &n))
        return wrong(a, "--follow needs softest or an azimuthal mode, 0 to 12, got \"%s\"", value);
    a->options.along = (int)n;
    return a->options.follows = true;
}

static bool take_functions(app *a, const char *value)
{
    long functions;
    if (!whole(value, 6, VES_STABILITY_FUNCTIONS, &functions))
        return wrong(a, "--functions needs a whole number from 6 to 96, got \"%s\"", value);
    a->options.functions = (int)functions;
    return true;
}

static bool take_buckling(app *a, const char *value)
{
    long factors;
    if (!whole(value, 1, 100, &factors))
        return wrong(a, "--buckling needs a whole number from 1 to 100, got \"%s\"", value);
    a->options.factors = (int)factors;
    return true;
}

static bool take_spine(app *a, const char *value)
{
    long count;
    if (!whole(value, 2, 1000000, &count))
        return wrong(a, "--spine needs a whole number from 2 to 1000000, got \"%s\"", value);
    a->options.spine = (int)count;
    return true;
}

static bool take_grid(app *a, const char *value)
{
    char *end;
    long nu = strtol(value, &end, 10), nv = *end == 'x' ? strtol(end + 1, &end, 10) : 0;
    bool good = !*end && nu >= 1 && nu <= 10000 && nv >= 3 && nv <= 10000;
    a->options.grid[0] = (int)nu, a->options.grid[1] = (int)nv;
    return good ||
           wrong(a, "--grid needs cells along u and v as 48x96 (1 to 10000, 3 to 10000), got \"%s\"", value);
}

static bool take_view(app *a, const char *value)
{
    double angle[2];
    char *copy = ves_arena_text(&a->arena, value, strlen(value)), *comma = copy ? strchr(copy, ',') : NULL;
    if (comma) *comma = 0;
    if (!comma || !ves_text_number(copy, &angle[0]) || !ves_text_number(comma + 1, &angle[1]))
        return wrong(a, "--view needs azimuth,height in degrees as 35,25, got \"%s\"", value);
    for (int k = 0; k < 2; k++) a->options.view[k] = angle[k] * VES_PI / 180;
    return a->options.viewed = true;
}

static bool take_progress(app *a, const char *value)
{
    int word = ves_words_find("auto|plain|none", value);
    a->options.progress = (ves_progress_style)word;
    return word >= 0 || wrong(a, "--progress is auto, plain or none, not \"%s\"", value);
}

static bool take_trace(app *a, const char *value)
{
    int word = ves_words_find("short|all|accepted|none", value);
    a->options.trace = (ves_trace)word;
    return word >= 0 || wrong(a, "--trace is short, all, accepted or none, not \"%s\"", value);
}

static bool take_colour(app *a, const char *value)
{
    a->options.colour = value; /* what there is depends on the file */
    return *value || wrong(a, "--colour needs a word, got \"%s\"", value);
}

static bool take_unit(app *a, const char *value)
{
    ves_dim dim;
    const ves_dim length = {.m = 6};
    bool known = ves_dim_read(value, &dim, &a->options.metres);
    a->options.unit = value;
    return (known && !dim.any && ves_dim_equal(dim, length)) ||
           wrong(a, "--unit needs a unit of length as mm, cm or m (vesica list units), got \"%s\"", value);
}

static bool take_plugin(app *a, const char *value)
{
    app_options *o = &a->options;
    if (o->plugins == APP_PLUGINS) return wrong(a, "too many --plugin, at \"%s\"", value);
    o->plugin[o->plugins++] = value;
    return true;
}

static bool take_journal(app *a, const char *value)
{
    int word = ves_words_find("all|none", value);
    a->options.forget = word == 1;
    return word >= 0 || wrong(a, "--journal is all or none, not \"%s\"", value);
}

#define TEXT(field)                                                                                          \
    static bool take_##field(app *a, const char *value)                                                      \
    {                                                                                                        \
        a->options.field = value;                                                                            \
        return *value || wrong(a, "--%s needs a value", #field);                                             \
    }
TEXT(start)
TEXT(resume)
TEXT(out)
TEXT(patch)
TEXT(points)
TEXT(to)
TEXT(png)
TEXT(add)
#undef TEXT

#define FLAG(field)                                                                                          \
    static bool take_##field(app *a, const char *value)                                                      \
    {                                                                                                        \
        (void)value;                                                                                         \
        return a->options.field = true;                                                                      \
    }
FLAG(json)
FLAG(test)
FLAG(no_files)
FLAG(reference)
FLAG(spines)
FLAG(suite)
FLAG(help)
#undef FLAG

/* clang-format off */
static const option table[] = {
    {"set", "NAME=VALUE", "instead of what the file says: the start of a variable, a parameter, or a path of keys (patches.wall.operator.a)", take_set},
    {"over", "NAME=FROM..TO:COUNT", "which parameter takes which values, instead of what `sweep` in the file says; or NAME=VALUE,VALUE,...; twice: the first is walked along, for each value of the second", take_over},
    {"start", "RUN[:K]", "begin at the best design of that run, or at its optimum K; or SWEEP:N, at point N of a sweep", take_start},
    {"seed", "N", "of the random numbers; same seed, same result", take_seed},
    {"evaluations", "N", "budget of the search", take_evaluations},
    {"jobs", "N", "threads (all of the machine); the result does not depend on it", take_jobs},
    {"out", "DIR", "write into this folder, new or empty for a run", take_out},
    {"progress", "auto|plain|none", "how to show it on stderr", take_progress},
    {"trace", "short|all|accepted|none", "which candidates trace.jsonl keeps; short (unless said): each new best, of the accepted ones ever fewer", take_trace},
    {"test", NULL, "with the budget and the checks that `test:` gives", take_test},
    {"no-files", NULL, "make no run folder", take_no_files},
    {"json", NULL, "one JSON object on stdout", take_json},
    {"plugin", "FILE", "load measures from a shared object; may be repeated", take_plugin},
    {"patch", "NAME", "which patch (needed when there are several)", take_patch},
    {"points", "FILE", "CSV of u (0 to 1), v (0 to 2 pi), whatever `domain` says; - is stdin", take_points},
    {"modes", "N", "azimuthal modes n = 0 ... N (4, unless said; 12 at most)", take_modes},
    {"follow", "N|softest", "a descent from beside the shape, both ways along the lowest mode of n = N, or the softest", take_follow},
    {"functions", "N", "of the meridian, that displacements are made of (6 to 96; chosen, unless said)", take_functions},
    {"spine", "N", "N points of the spine, the mean over v, from end to end, with its first two derivatives by u", take_spine},
    {"spines", NULL, "the spines of PDE patches too: drawn over the shape, or in files NAME-spines.vtp, .obj, .csv", take_spines},
    {"to", "FORMAT[,FORMAT]", "see vesica list formats; a journal: csv (unless said), jsonl", take_to},
    {"buckling", "N", "in a deck inp: a step for each load case too that asks for its first N buckling factors", take_buckling},
    {"unit", "UNIT", "of the lengths in the files: mm, cm ...; m, unless said, whatever the problem file writes", take_unit},
    {"grid", "NUxNV", "cells along u and v of each patch", take_grid},
    {"png", "FILE", "where to; the ending png, svg or pdf says what (a shape: NAME.png unless said)", take_png},
    {"colour", "WHAT", "patch, H (unless said), K, k1, k2; of a shell thickness, max_shear, von_mises, displacement or mode, of several load cases as max_shear:CASE", take_colour},
    {"view", "AZIMUTH,HEIGHT", "where the viewer stands, in degrees", take_view},
    {"reference", NULL, "the reference chapter of the manual instead, in Markdown", take_reference},
    {"suite", NULL, "of suite files (vesica bench)", take_suite},
    {"journal", "all|none", "whether the run keeps all evaluations, to be resumed and read (vesica journal)", take_journal},
    {"resume", "RUN", "go on in the folder of a run, a benchmark or a sweep that was interrupted or killed; it ends as one that was not", take_resume},
    {"help", NULL, "this text", take_help},
    {"add", "NAME={...}", "with --resume: one more method, as under `methods`", take_add},
};
/* clang-format on */

/* What a resumed run has decided when it was begun. */
static const char DECIDED[] = "set|start|over|seed|evaluations|out|trace|journal|test|no-files";

enum { KNOWN = sizeof table / sizeof *table };

static bool belongs(const app_command *command, const option *o)
{
    return !strcmp(o->name, "help") || ves_words_find(command->options, o->name) >= 0;
}

static int unknown(app *a, const app_command *command, const char *word, size_t length)
{
    const char *name[KNOWN], *text = ves_arena_text(&a->arena, word, length);
    int count = 0;
    for (int k = 0; k < KNOWN; k++)
        if (belongs(command, &table[k])) name[count++] = table[k].name;
    int near = text ? ves_text_nearest(text, name, count) : -1;
    if (near >= 0)
        return app_fail(a, VES_USAGE, "vesica %s has no option \"--%s\", did you mean \"--%s\"?",
                        command->name, text, name[near]);
    return app_fail(a, VES_USAGE, "vesica %s has no option \"--%.*s\" (vesica help %s)", command->name,
                    (int)length, word, command->name);
}

static const option *find(const app_command *command, const char *word, size_t length)
{
    for (int k = 0; k < KNOWN; k++) {
        bool same = strlen(table[k].name) == length && !strncmp(table[k].name, word, length);
        if (same && belongs(command, &table[k])) return &table[k];
    }
    return NULL;
}

/* One option at word[*at], with or without its value in the same word. */
static bool option_read(app *a, const app_command *command, int count, char **word, int *at)
{
    const char *name = word[*at] + 2, *equals = strchr(name, '=');
    size_t length = equals ? (size_t)(equals - name) : strlen(name);
    const option *o = find(command, name, length);
    if (!o) return unknown(a, command, name, length), false;
    if (ves_words_find(DECIDED, o->name) >= 0) a->options.decides = o->name;
    if (!o->argument && equals) return wrong(a, "--%s takes no value", o->name);
    if (!o->argument) return o->take(a, "");
    if (equals) return o->take(a, equals + 1);
    if (*at + 1 >= count) {
        app_fail(a, VES_USAGE, "--%s needs a value: --%s %s", o->name, o->name, o->argument);
        return false;
    }
    return o->take(a, word[++*at]);
}

static bool operand_read(app *a, const app_command *command, const char *word)
{
    if (a->operands < command->most) {
        a->operand[a->operands++] = word;
        return true;
    }
    app_fail(a, VES_USAGE, "what is \"%s\" for? usage: vesica %s", word, command->usage);
    return false;
}

bool app_options_read(app *a, const app_command *command, int count, char **word, int *code)
{
    bool options = true, good = true;
    for (int k = 0; k < count && good; k++) {
        bool dashes = options && word[k][0] == '-' && word[k][1];
        if (dashes && !strcmp(word[k], "--"))
            options = false;
        else if (dashes && !strcmp(word[k], "-h"))
            a->options.help = true;
        else if (dashes && word[k][1] != '-')
            good = wrong(a, "options begin with two dashes, got \"%s\"", word[k]);
        else
            good = dashes ? option_read(a, command, count, word, &k) : operand_read(a, command, word[k]);
    }
    if (good && !a->options.help && a->operands < command->least) {
        app_fail(a, VES_USAGE, "something is missing: vesica %s", command->usage);
        good = false;
    }
    int last = ves_diag_count(a->diag) - 1;
    *code = good ? APP_DONE : app_code(ves_diag_status(a->diag, last));
    return good;
}

void app_options_list(const app_command *command, FILE *out)
{
    for (int k = 0; k < KNOWN; k++) {
        const option *o = &table[k];
        char text[80];
        if (!belongs(command, o) || !strcmp(o->name, "help")) continue;
        snprintf(text, sizeof text, "--%s%s%s", o->name, o->argument ? " " : "",
                 o->argument ? o->argument : "");
        fprintf(out, "  %-28s %s\n", text, o->about);
    }
}

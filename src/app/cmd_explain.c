/* vesica schema, explain, version: what this program understands, and what it is made of. */
#include <cairo.h>
#include <nlopt.h>
#include <string.h>
#include <yaml.h>

#include "app/app.h"
#include "bridge/bridge.h"
#include "problem/schema.h"
#include "study/ranks.h"
#include "suite/landscape.h"

enum { TOPICS = 128 };

static int text_print(app *a, const char *text)
{
    if (!text) return app_fail(a, VES_MEMORY, "%s", ves_status_text(VES_MEMORY));
    size_t length = strlen(text);
    fputs(text, stdout);
    if (length && text[length - 1] != '\n') putchar('\n');
    return APP_DONE;
}

int app_schema(app *a)
{
    if (a->options.suite) return text_print(a, ves_schema_suite_json(&a->arena));
    return text_print(a, a->options.reference ? ves_schema_reference(&a->arena, a->measure)
                                              : ves_schema_json(&a->arena, a->measure));
}

static void topic_add(app *a, ves_topic *topic, int *count, const char *word, const char *text)
{
    if (!text || *count == TOPICS - 1) return;
    topic[(*count)++] = (ves_topic){ves_arena_text(&a->arena, word, strlen(word)), text};
}

/* What files of problems do not speak of: formats, pictures, commands. */
static void topics(app *a, ves_topic *topic)
{
    static const char *const picture[] = {"png", "svg", "pdf"};
    int count = 0;
    for (const ves_format *const *f = ves_formats(); *f; f++)
        topic_add(a, topic, &count, (*f)->name,
                  ves_arena_format(&a->arena,
                                   "a format\n      %s\n      lengths in m, or in what --unit says (mm for "
                                   "printing); in a file without units its own\n"
                                   "      example: vesica export problem.yaml --to %s --unit mm",
                                   (*f)->about, (*f)->name));
    for (int k = 0; k < 3; k++)
        topic_add(a, topic, &count, picture[k],
                  ves_arena_format(
                      &a->arena, "a kind of picture\n      example: vesica show problem.yaml --png shape.%s",
                      picture[k]));
    for (const ves_landscape *const *l = ves_landscapes(); *l; l++)
        topic_add(a, topic, &count, (*l)->name,
                  ves_arena_format(
                      &a->arena,
                      "a function of suites (vesica bench)\n      %s\n      example: {function: %s, n: %d%s}",
                      (*l)->about, (*l)->name,
                      (*l)->least > 5 ? (*l)->least
                      : (*l)->most    ? (*l)->most
                                      : 10,
                      (*l)->free ? ", rotate: true" : ""));
    topic_add(a, topic, &count, "trace",
              "the candidates of a run, trace.jsonl in its folder: one JSON object a line\n"
              "      with evaluation, stage, chain, x (SI), value, violation, T, accepted, status; x in the "
              "order of\n"
              "      `variables` in result.json; violation as there, in units of each constraint's size; "
              "value and\n"
              "      violation are null where status says why the candidate was not measured, or refused.\n"
              "      --trace short|all|accepted|none says which are kept\n"
              "      example: vesica run problem.yaml --trace all");
    for (const app_command *c = app_commands; c->name; c++)
        topic_add(a, topic, &count, c->name,
                  ves_arena_format(&a->arena, "a command: vesica %s\n      %s (vesica help %s)", c->usage,
                                   c->about, c->name));
}

int app_explain(app *a)
{
    bool found = false;
    ves_topic topic[TOPICS] = {0};
    topics(a, topic);
    const char *text = ves_schema_explain(&a->arena, a->operand[0], a->measure, topic, &found);
    if (text && !found) return app_fail(a, VES_NAME, "%.*s", (int)strcspn(text, "\n"), text);
    return text_print(a, text);
}

int app_version(app *a)
{
    int major, minor, patch;
    char nlopt[32];
    nlopt_version(&major, &minor, &patch);
    snprintf(nlopt, sizeof nlopt, "%d.%d.%d", major, minor, patch);
    const char *part[][2] = {{"vesica", VESICA_VERSION},        {"compiler", __VERSION__},
                             {"CGAL", ves_bridge_version()},    {"NLopt", nlopt},
                             {"cairo", cairo_version_string()}, {"libyaml", yaml_get_version_string()},
                             {"MPI", ves_ranks_mpi()}};
    enum { PARTS = sizeof part / sizeof *part };
    ves_json json = {.out = stdout};
    if (a->options.json) ves_json_object(&json, NULL);
    for (int k = 0; k < PARTS; k++) {
        if (a->options.json)
            ves_json_text(&json, part[k][0], part[k][1]);
        else
            printf("%-9s %s\n", part[k][0], part[k][1]);
    }
    if (a->options.json) ves_json_end(&json, '}');
    return APP_DONE;
}

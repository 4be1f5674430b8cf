/* vesica list, schema, explain, version: what there is. */
#include <cairo.h>
#include <nlopt.h>
#include <string.h>
#include <yaml.h>

#include "app/app.h"
#include "app/table.h"
#include "app/template.h"
#include "base/text.h"
#include "bridge/bridge.h"
#include "formula/dimension.h"
#include "measure/registry.h"
#include "problem/schema.h"

/* "radius, axis": the keys that an entry understands. */
static void keys_cell(app_table *t, const ves_key *key)
{
    char text[300] = "";
    size_t at = 0;
    for (; key && key->name && at < sizeof text; key++) {
        int length = snprintf(text + at, sizeof text - at, "%s%s", at ? ", " : "", key->name);
        at += length > 0 ? (size_t)length : 0;
    }
    app_table_cell(t, "%s", text);
}

static void operations(app_table *t, bool move)
{
    for (const ves_curve_op *const *op = ves_curve_ops(); *op; op++) {
        if ((*op)->move != move) continue;
        app_table_cell(t, "%s", (*op)->name);
        app_table_cell(t, "%s", (*op)->about);
        keys_cell(t, (*op)->keys);
    }
}

static void curves(app *a, app_table *t)
{
    (void)a;
    operations(t, false);
}

static void moves(app *a, app_table *t)
{
    (void)a;
    operations(t, true);
}

static void measures(app *a, app_table *t)
{
    const ves_measure *const *lists[2] = {ves_measures(), a->measure};
    for (int l = 0; l < 2; l++)
        for (const ves_measure *const *m = lists[l]; m && *m; m++) {
            app_table_cell(t, "%s", (*m)->name);
            app_table_cell(t, "%s%s%s", (*m)->about, (*m)->closed ? " (closed shapes)" : "",
                           (*m)->gradient ? "" : " (no gradient)");
            keys_cell(t, (*m)->keys);
        }
}

static void algorithms(app *a, app_table *t)
{
    (void)a;
    for (const ves_algorithm *k = ves_search_algorithms(); k->name; k++) {
        app_table_cell(t, "%s", k->name);
        app_table_cell(t, "%s", k->about);
        app_table_end(t);
    }
}

static void formats(app *a, app_table *t)
{
    (void)a;
    for (const ves_format *const *f = ves_formats(); *f; f++) {
        app_table_cell(t, "%s", (*f)->name);
        app_table_cell(t, "%s", (*f)->about);
        app_table_end(t);
    }
}

static void units(app *a, app_table *t)
{
    int count;
    const char *const *name = ves_unit_names(&count);
    (void)a;
    for (int k = 0; k < count; k++) {
        ves_dim dim;
        double factor;
        char text[48];
        if (!ves_dim_read(name[k], &dim, &factor)) continue;
        ves_dim_text(dim, text);
        app_table_cell(t, "%s", name[k]);
        app_table_cell(t, "%.15g%s%s", factor, strcmp(text, "1") ? " " : "", strcmp(text, "1") ? text : "");
        app_table_end(t);
    }
}

static const struct list {
    const char *name;
    void (*fill)(app *a, app_table *t);
} lists[] = {{"measures", measures}, {"curves", curves}, {"moves", moves},   {"algorithms", algorithms},
             {"formats", formats},   {"units", units},   {"templates", NULL}};

enum { LISTS = sizeof lists / sizeof *lists };

static void list_print(app *a, const struct list *l)
{
    app_table t = {.align = "lll"};
    if (!l->fill) {
        app_templates_list(stdout);
        return;
    }
    l->fill(a, &t);
    app_table_print(&t, stdout);
}

int app_list(app *a)
{
    const char *name[LISTS], *word = a->operands ? a->operand[0] : NULL;
    for (int k = 0; k < LISTS; k++) {
        name[k] = lists[k].name;
        if (!word || strcmp(word, name[k])) continue;
        list_print(a, &lists[k]);
        return APP_DONE;
    }
    int near = word ? ves_text_nearest(word, name, LISTS) : -1;
    if (near >= 0) return app_fail(a, VES_USAGE, "no list \"%s\", did you mean \"%s\"?", word, name[near]);
    return app_fail(a, VES_USAGE,
                    "list what? measures, curves, moves, algorithms, formats, units or templates");
}

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
    return text_print(a, a->options.reference ? ves_schema_reference(&a->arena, a->measure)
                                              : ves_schema_json(&a->arena, a->measure));
}

int app_explain(app *a)
{
    bool found = false;
    const char *text = ves_schema_explain(&a->arena, a->operand[0], a->measure, &found);
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
                             {"cairo", cairo_version_string()}, {"libyaml", yaml_get_version_string()}};
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
